//! Filters before lights.

use super::Transform;
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// What stands before a light and takes part of its light away, on the way from each point of the light: barn doors, a slide. It is not seen and
/// blocks nothing else.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LightFilter {
    /// The filter's space to the light's own. Its plane is z = 0.
    pub to_light: Transform,
    /// What the plane lets through.
    pub slide: Slide,
    /// What passes of light that does not come to the plane, because it goes away or ends before it.
    pub missed: [f32; 3],
    /// Whether what passes is what did not.
    #[serde(default)]
    pub inverted: bool,
    /// On what passes.
    pub factor: [f32; 3],
    /// 0 is no filter, 1 all of it.
    pub density: f32,
}

/// What a plane lets through, in the units of the filter's own space.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Slide {
    /// An opening in an endless black card.
    Opening {
        /// Left and bottom.
        low: [f32; 2],
        /// Right and top.
        high: [f32; 2],
        /// Of its corners.
        radius: f32,
        /// Width of the border outside in which light fades linearly.
        edge: f32,
    },
    /// A picture about the middle, x to its right and y up.
    Picture {
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
        /// Linear Rec.709, row by row from the top.
        rgb: Arc<[f32]>,
        /// Width and height of its frame.
        size: [f32; 2],
        /// What passes where there is no picture; none: it goes on beyond its frame.
        fill: Option<[f32; 3]>,
        /// Beyond its frame it stands again and again; else its border goes on.
        repeats: bool,
        /// Factor and summand that make texture coordinates, left to right and top to bottom, of places in the frame from 0 to 1.
        to_texture: [[f32; 2]; 2],
    },
}
