//! Radiance's views as cameras.

use crate::vector::{Vec3, cross, length, unit};
use gonio_scene::{Camera, Origin, Projection, Transform};

/// What a view says; lengths in metres.
#[derive(Clone, Debug)]
pub(crate) struct View {
    /// `-vt`'s letter.
    pub(crate) kind: char,
    pub(crate) position: Vec3,
    pub(crate) direction: Vec3,
    pub(crate) up: Vec3,
    /// Horizontally and vertically: degrees, of parallel views metres.
    pub(crate) size: [f64; 2],
    /// Shift and lift, in pictures.
    pub(crate) shift: [f64; 2],
    /// Fore and aft; 0 is none.
    pub(crate) clip: [f64; 2],
}

impl Default for View {
    fn default() -> Self {
        Self {
            kind: 'v',
            position: [0.0; 3],
            direction: [0.0, 1.0, 0.0],
            up: [0.0, 0.0, 1.0],
            size: [45.0; 2],
            shift: [0.0; 2],
            clip: [0.0; 2],
        }
    }
}

impl View {
    /// The camera, and what of the view it does not show.
    ///
    /// # Errors
    /// What makes it no view.
    pub(crate) fn camera(&self, origin: Origin) -> Result<(Camera, Option<&'static str>), String> {
        let numbers = [&self.position[..], &self.direction, &self.up, &self.size, &self.shift, &self.clip];
        if numbers.iter().any(|numbers| numbers.iter().any(|x| !x.is_finite())) {
            return Err("a number of the view is not finite".into());
        }
        let ahead = unit(self.direction).ok_or("the view's direction is no direction")?;
        let right = unit(cross(ahead, self.up)).filter(|_| length(cross(ahead, self.up)) > 1e-9 * length(self.up));
        let right = right.ok_or("the view's up vector lies along its direction")?;
        let (projection, aperture, told) = self.projection()?;
        let [fore, aft] = self.clip;
        let transform = Transform { columns: [right, cross(right, ahead), ahead.map(|x| -x), self.position] };
        let offset = std::array::from_fn(|i| self.shift[i] * aperture[i]);
        let clipping = [fore.max(0.0), if aft > 0.0 { aft } else { f64::MAX }];
        Ok((Camera { origin, projection, aperture, aperture_offset: offset, clipping, transform, ..Camera::default() }, told))
    }

    fn projection(&self) -> Result<(Projection, [f64; 2], Option<&'static str>), String> {
        let [width, height] = self.size;
        let limit = if matches!(self.kind, 'v') { 180.0 } else { 360.0 };
        if self.kind != 'l' && !(width > 0.0 && width <= limit && height > 0.0 && height <= limit) || !(width > 0.0 && height > 0.0) {
            return Err(format!("the view is {width} × {height} wide, expected numbers above 0 and at most {limit}"));
        }
        let fisheye = Projection::FisheyeEquidistant { fov_deg: width.max(height) };
        Ok(match self.kind {
            'v' if width >= 180.0 || height >= 180.0 => return Err("a perspective view of 180° or more".into()),
            'v' => (Projection::Perspective { focal_length: 1.0 }, self.size.map(|x| 2.0 * (0.5 * x.to_radians()).tan()), None),
            'l' => (Projection::Orthographic, self.size, None),
            'a' => (fisheye, [1.0; 2], None),
            'h' => (fisheye, [1.0; 2], Some("hemispherical fisheye views (-vth) are drawn as angular ones (-vta)")),
            's' => (fisheye, [1.0; 2], Some("planispheric views (-vts) are drawn as angular ones (-vta)")),
            'c' => {
                let half = |x: f64| [-0.5 * x.to_radians(), 0.5 * x.to_radians()];
                let projection = Projection::Equirectangular { longitude: half(width), latitude: half(height.min(180.0)) };
                (projection, [1.0; 2], Some("cylindrical views (-vtc) are drawn with even latitudes"))
            }
            other => return Err(format!("view type '{other}' was found, expected v, l, a, h, s or c")),
        })
    }
}
