//! How a fisheye picture's pixels lie around the eye.

use crate::error::{Error, Result};
use std::f64::consts::PI;

/// A fisheye's projection.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FisheyeProjection {
    /// The angle to the axis grows evenly from the middle (Radiance's `-vta`).
    Equidistant,
    /// Equal solid angles are equal areas.
    Equisolid,
    /// The sine of the angle grows evenly (Radiance's `-vth`).
    Hemispherical,
}

impl FisheyeProjection {
    /// All with their names.
    pub const NAMES: [(Self, &'static str); 3] =
        [(Self::Equidistant, "equidistant"), (Self::Equisolid, "equisolid"), (Self::Hemispherical, "hemispherical")];

    /// What has the name.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(_, known)| *known == name).map(|(projection, _)| *projection)
    }
}

/// A picture around the line of sight: the field of view is a circle, or an ellipse, that touches the picture's four edges.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FisheyeView {
    projection: FisheyeProjection,
    half_fov: f64,
    size: [usize; 2],
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PixelView {
    /// Unit vector in the eye's frame: right, up, ahead.
    pub direction: [f64; 3],
    /// Steradians.
    pub solid_angle: f64,
}

impl FisheyeView {
    /// `fov_deg` is the full field of view.
    ///
    /// # Errors
    /// A field of view that the projection does not have.
    pub fn new(projection: FisheyeProjection, fov_deg: f64, size: [usize; 2]) -> Result<Self> {
        let most = if projection == FisheyeProjection::Hemispherical { 180.0 } else { 360.0 };
        if !(fov_deg > 0.0 && fov_deg <= most) {
            return Err(Error::setting("fov", format!("{fov_deg} was found, expected degrees above 0 and at most {most}")));
        }
        Ok(Self { projection, half_fov: 0.5 * fov_deg.to_radians(), size })
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Whether the picture shows all that lights the eye.
    pub fn covers_hemisphere(&self) -> bool {
        self.half_fov >= 0.5 * PI * (1.0 - 1e-9)
    }

    /// A pixel by its column and row from the top; none beyond the field of view.
    pub fn pixel(&self, [x, y]: [usize; 2]) -> Option<PixelView> {
        let place = [2.0 * (x as f64 + 0.5) / self.size[0] as f64 - 1.0, 1.0 - 2.0 * (y as f64 + 0.5) / self.size[1] as f64];
        let radius = place[0].hypot(place[1]);
        if radius > 1.0 {
            return None;
        }
        let area = 4.0 / (self.size[0] * self.size[1]) as f64;
        let (angle, solid_angle) = match self.projection {
            FisheyeProjection::Equidistant => {
                let angle = radius * self.half_fov;
                (angle, sinc(angle) * self.half_fov * self.half_fov * area)
            }
            FisheyeProjection::Equisolid => {
                let edge = (0.5 * self.half_fov).sin();
                (2.0 * (radius * edge).asin(), 4.0 * edge * edge * area)
            }
            FisheyeProjection::Hemispherical => {
                let edge = self.half_fov.sin();
                let angle = (radius * edge).asin();
                // The rim's pixels are seen edge on; their middles are not quite.
                (angle, edge * edge * area / angle.cos().max(1e-6))
            }
        };
        let across = if radius > 0.0 { angle.sin() / radius } else { 0.0 };
        Some(PixelView { direction: [place[0] * across, place[1] * across, angle.cos()], solid_angle })
    }
}

fn sinc(x: f64) -> f64 {
    if x.abs() < 1e-8 { 1.0 } else { x.sin() / x }
}
