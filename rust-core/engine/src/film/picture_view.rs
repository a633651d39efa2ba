//! How a picture was taken: what its places mean, as files say it.

use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};
use std::f64::consts::{FRAC_PI_2, PI};

/// What a place in the plane of a picture means; x grows to the right, y up.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum PictureProjection {
    /// The direction through a point of the plane at distance 1 (Radiance's `-vtv`).
    Perspective,
    /// Parallel rays; metres.
    Orthographic,
    /// Longitude (0 is ahead) and latitude, radians.
    Equirectangular,
    /// The distance from the middle is the angle to the axis in radians (Radiance's `-vta`), up to `limit`.
    Equidistant {
        /// Half the field of view.
        limit: f64,
    },
    /// The distance from the middle is the sine of half the angle to the axis, up to `limit`.
    Equisolid {
        /// Sine of a quarter of the field of view.
        limit: f64,
    },
    /// The distance from the middle is the sine of the angle to the axis (Radiance's `-vth`), up to `limit`.
    Hemispherical {
        /// Sine of half the field of view.
        limit: f64,
    },
}

/// How a picture was taken.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PictureView {
    /// What places mean.
    pub projection: PictureProjection,
    /// Places of the picture's left, right, bottom and top edge.
    pub window: [f64; 4],
    /// Where it was taken, where it looks and what is up, world space, metres; where that is known.
    pub placed: Option<[[f64; 3]; 3]>,
}

impl PictureView {
    /// What projections are called where fields of view are stated.
    pub const NAMES: [&'static str; 4] = ["perspective", "equidistant", "equisolid", "hemispherical"];

    /// A whole picture of a projection by name. `fov_deg` is the full field of view: across of a perspective, all around of a fisheye, whose circle (or
    /// ellipse) touches the four edges. `aspect` is a perspective's width over its height.
    ///
    /// # Errors
    /// Another name than those of [`Self::NAMES`], or a field of view that the projection does not have.
    pub fn by_name(name: &str, fov_deg: f64, aspect: f64) -> Result<Self> {
        let most = match name {
            "perspective" => 179.9,
            "hemispherical" => 180.0,
            "equidistant" | "equisolid" => 360.0,
            _ => {
                let expected = Self::NAMES.join(", ");
                return Err(Error::setting("projection", format!("'{name}' was found, expected one of {expected}")));
            }
        };
        if !(fov_deg > 0.0 && fov_deg <= most) {
            return Err(Error::setting("fov", format!("{fov_deg} was found, expected degrees above 0 and at most {most}")));
        }
        let half = 0.5 * fov_deg.to_radians();
        let (projection, side) = match name {
            "perspective" => (PictureProjection::Perspective, half.tan()),
            "equidistant" => (PictureProjection::Equidistant { limit: half }, half),
            "equisolid" => (PictureProjection::Equisolid { limit: (0.5 * half).sin() }, (0.5 * half).sin()),
            _ => (PictureProjection::Hemispherical { limit: half.sin() }, half.sin()),
        };
        let up = if projection == PictureProjection::Perspective { side / aspect } else { side };
        Ok(Self { projection, window: [-side, side, -up, up], placed: None })
    }

    /// The projection's name in files.
    pub fn name(&self) -> &'static str {
        match self.projection {
            PictureProjection::Perspective => "perspective",
            PictureProjection::Orthographic => "orthographic",
            PictureProjection::Equirectangular => "equirectangular",
            PictureProjection::Equidistant { .. } => "equidistant",
            PictureProjection::Equisolid { .. } => "equisolid",
            PictureProjection::Hemispherical { .. } => "hemispherical",
        }
    }

    /// The full field of view in degrees: of fisheyes all around, of others across and down; none of parallel rays.
    pub fn fov_deg(&self) -> Vec<f64> {
        let [left, right, bottom, top] = self.window;
        match self.projection {
            PictureProjection::Perspective => vec![(right.atan() - left.atan()).to_degrees(), (top.atan() - bottom.atan()).to_degrees()],
            PictureProjection::Orthographic => Vec::new(),
            PictureProjection::Equirectangular => vec![(right - left).to_degrees(), (top - bottom).to_degrees()],
            PictureProjection::Equidistant { limit } => vec![(2.0 * limit).to_degrees()],
            PictureProjection::Equisolid { limit } => vec![(4.0 * limit.asin()).to_degrees()],
            PictureProjection::Hemispherical { limit } => vec![(2.0 * limit.min(1.0).asin()).to_degrees()],
        }
    }

    /// The notes that state it in the headers of files; see [`Self::from_notes`].
    pub fn notes(&self) -> Vec<(&'static str, String)> {
        let join = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
        let mut notes = vec![("gonio:projection", self.name().to_owned()), ("gonio:window", join(&self.window))];
        let fov = self.fov_deg();
        if !fov.is_empty() {
            notes.push(("gonio:fov", join(&fov)));
        }
        if let Some(placed) = self.placed {
            let names = ["gonio:position", "gonio:direction", "gonio:up"];
            notes.extend(names.into_iter().zip(placed).map(|(name, vector)| (name, join(&vector))));
        }
        notes
    }

    /// What notes state; none where they do not, or not in whole.
    pub fn from_notes<'a>(note: impl Fn(&str) -> Option<&'a str>) -> Option<Self> {
        let numbers = |name: &str| -> Option<Vec<f64>> {
            let numbers: Option<Vec<f64>> = note(name)?.split_whitespace().map(|word| word.parse().ok()).collect();
            numbers.filter(|numbers| numbers.iter().all(|number| number.is_finite()))
        };
        let half_fov = || numbers("gonio:fov").and_then(|fov| Some(0.5 * fov.first()?.to_radians()));
        let projection = match note("gonio:projection")? {
            "perspective" => PictureProjection::Perspective,
            "orthographic" => PictureProjection::Orthographic,
            "equirectangular" => PictureProjection::Equirectangular,
            "equidistant" => PictureProjection::Equidistant { limit: half_fov()? },
            "equisolid" => PictureProjection::Equisolid { limit: (0.5 * half_fov()?).sin() },
            "hemispherical" => PictureProjection::Hemispherical { limit: half_fov()?.sin() },
            _ => return None,
        };
        let window: [f64; 4] = numbers("gonio:window")?.try_into().ok()?;
        let vector = |name: &str| -> Option<[f64; 3]> { numbers(name)?.try_into().ok() };
        let placed = match (vector("gonio:position"), vector("gonio:direction"), vector("gonio:up")) {
            (Some(position), Some(direction), Some(up)) => Some([position, direction, up]),
            _ => None,
        };
        Some(Self { projection, window, placed })
    }

    /// The direction of a place, a unit vector in the eye's frame (right, up, ahead), and the steradians of a unit of area there; none where nothing is
    /// seen.
    pub fn direction(&self, [x, y]: [f64; 2]) -> Option<([f64; 3], f64)> {
        let radius = x.hypot(y);
        // By the angle to the axis and the steradians to a unit of area.
        let around = |angle: f64, limit: f64, area: f64| {
            let across = if radius > 0.0 { angle.sin() / radius } else { 0.0 };
            (radius <= limit).then_some(([x * across, y * across, angle.cos()], area))
        };
        match self.projection {
            PictureProjection::Perspective => {
                let length = (x * x + y * y + 1.0).sqrt();
                Some(([x / length, y / length, 1.0 / length], length.powi(-3)))
            }
            PictureProjection::Orthographic => None,
            PictureProjection::Equirectangular => {
                let known = x.abs() <= PI && y.abs() <= FRAC_PI_2;
                known.then(|| ([y.cos() * x.sin(), y.sin(), y.cos() * x.cos()], y.cos()))
            }
            PictureProjection::Equidistant { limit } => around(radius, limit, if radius > 1e-8 { radius.sin() / radius } else { 1.0 }),
            PictureProjection::Equisolid { limit } => around(2.0 * radius.min(1.0).asin(), limit, 4.0),
            PictureProjection::Hemispherical { limit } => {
                let angle = radius.min(1.0).asin();
                // The rim's pixels are seen edge on; their middles are not quite.
                around(angle, limit, 1.0 / angle.cos().max(1e-6))
            }
        }
    }

    /// Whether all of the hemisphere about the axis is in the picture, to a pixel of these sides.
    pub fn covers_hemisphere(&self, pixel: [f64; 2]) -> bool {
        let [left, right, bottom, top] = self.window;
        let within = |across: f64, up: f64| {
            // Cameras are laid out in single precision.
            let [x, y] = pixel.map(|side| side.abs() + 1e-6);
            left.min(right) <= x - across && left.max(right) >= across - x && bottom.min(top) <= y - up && bottom.max(top) >= up - y
        };
        let round = |radius: f64, limit: f64| limit >= radius * (1.0 - 1e-6) && within(radius, radius);
        match self.projection {
            PictureProjection::Perspective | PictureProjection::Orthographic => false,
            PictureProjection::Equirectangular => within(FRAC_PI_2, FRAC_PI_2),
            PictureProjection::Equidistant { limit } => round(FRAC_PI_2, limit),
            PictureProjection::Equisolid { limit } => round((0.25 * PI).sin(), limit),
            PictureProjection::Hemispherical { limit } => round(1.0, limit),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_notes_state_is_read() {
        let placed = Some([[1.0, 2.5, -3.0], [0.0, 0.6, 0.8], [0.0, 1.0, 0.0]]);
        for name in PictureView::NAMES {
            let view = PictureView { placed, ..PictureView::by_name(name, 120.0, 1.5).expect("a view") };
            let notes = view.notes();
            let find = |key: &str| notes.iter().find(|(known, _)| *known == key).map(|(_, text)| text.as_str());
            let read = PictureView::from_notes(find).expect("notes");
            assert_eq!((read.placed, read.window, read.name()), (placed, view.window, name));
            assert!((read.fov_deg()[0] - 120.0).abs() < 1e-9, "{name}: {:?}", read.fov_deg());
        }
        assert_eq!(PictureView::from_notes(|_| None), None);
        let part = |key: &str| (key == "gonio:projection").then_some("perspective");
        assert_eq!(PictureView::from_notes(part), None);
    }

    #[test]
    fn steradians_are_those_of_directions_between_neighbours() {
        let views = PictureView::NAMES.map(|name| PictureView::by_name(name, 100.0, 1.0).expect("a view"));
        let map = PictureView { projection: PictureProjection::Equirectangular, window: [-PI, PI, -FRAC_PI_2, FRAC_PI_2], placed: None };
        for view in views.into_iter().chain([map]) {
            let (at, step) = ([0.3, 0.2], 1e-5);
            let [middle, right, up] = [at, [at[0] + step, at[1]], [at[0], at[1] + step]].map(|at| view.direction(at).expect("seen"));
            let edge = |other: [f64; 3]| [0, 1, 2].map(|i| (other[i] - middle.0[i]) / step);
            let (a, b) = (edge(right.0), edge(up.0));
            let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
            let area = cross.iter().map(|x| x * x).sum::<f64>().sqrt();
            assert!((area / middle.1 - 1.0).abs() < 1e-3, "{}: {area} instead of {}", view.name(), middle.1);
        }
    }

    #[test]
    fn half_a_world_is_told_from_less() {
        let covers = |name: &str, fov: f64| PictureView::by_name(name, fov, 1.0).expect("a view").covers_hemisphere([0.0; 2]);
        assert!(covers("equidistant", 180.0) && covers("equisolid", 200.0) && covers("hemispherical", 180.0));
        assert!(!covers("equidistant", 170.0) && !covers("perspective", 170.0));
        let whole = PictureView::by_name("equidistant", 180.0, 1.0).expect("a view");
        assert!(!PictureView { window: [-1.0, 1.58, -1.58, 1.58], ..whole }.covers_hemisphere([0.01; 2]), "a part of it");
    }
}
