//! How the pixels of a picture lie around the eye.

use crate::{
    error::{Error, Result},
    film::{PictureProjection, PictureView},
};

/// A picture as an eye along its axis sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EyeView {
    picture: PictureView,
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

impl EyeView {
    /// A picture of so many columns and rows.
    ///
    /// # Errors
    /// Parallel rays, which no eye sees by, and pictures without extent.
    pub fn new(picture: PictureView, size: [usize; 2]) -> Result<Self> {
        if picture.projection == PictureProjection::Orthographic {
            let problem = "the picture was taken by parallel rays, which no eye sees by; expected a perspective or a fisheye picture";
            return Err(Error::setting("projection", problem));
        }
        let [left, right, bottom, top] = picture.window;
        if !((right - left) * (top - bottom)).is_normal() {
            return Err(Error::setting("fov", "the picture's field of view has no extent"));
        }
        Ok(Self { picture, size })
    }

    /// Columns and rows.
    pub fn size(&self) -> [usize; 2] {
        self.size
    }

    /// Width and height of a pixel in the picture's plane.
    fn pixel_sides(&self) -> [f64; 2] {
        let [left, right, bottom, top] = self.picture.window;
        [(right - left) / self.size[0] as f64, (top - bottom) / self.size[1] as f64]
    }

    /// Whether the picture shows all that lights the eye.
    pub fn covers_hemisphere(&self) -> bool {
        self.picture.covers_hemisphere(self.pixel_sides())
    }

    /// A pixel by its column and row from the top; none where nothing is seen.
    pub fn pixel(&self, [x, y]: [usize; 2]) -> Option<PixelView> {
        let [left, _, _, top] = self.picture.window;
        let [width, height] = self.pixel_sides();
        let place = [left + (x as f64 + 0.5) * width, top - (y as f64 + 0.5) * height];
        let (direction, density) = self.picture.direction(place)?;
        Some(PixelView { direction, solid_angle: density * (width * height).abs() })
    }
}
