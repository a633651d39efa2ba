//! What the solid under a surface is, where it scatters: OpenPBR 1.1, "Transparent base", and standard_surface say so by what is left of light at a depth.

use crate::material::emit::constant_scalar;
use gonio::scene::{Closure, Input, Medium};

/// The medium of a closure with absorption by depth and what it scatters, over that depth; `None` where anything varies.
pub(super) fn scattering(closure: &Closure, scatter: Input, anisotropy: f32) -> Option<Medium> {
    let three = |input: Input| if let Input::Constant([r, g, b, _]) = input { Some([r, g, b]) } else { None };
    let depth = closure.input("transmission_depth").and_then(constant_scalar)?;
    let (left, scattered) = (three(closure.input("transmission_color")?)?, three(scatter)?);
    let extinction = left.map(|left| -left.clamp(1e-6, 1.0).ln() / depth);
    let scattering = scattered.map(|scattered| scattered.max(0.0) / depth);
    let absorption = [0, 1, 2].map(|part| extinction[part] - scattering[part]);
    // No component absorbs less than nothing.
    let raised = absorption.iter().copied().fold(0.0_f32, |least, x| least.max(-x));
    Some(Medium { absorption: absorption.map(|x| x + raised), scattering, emission: [0.0; 3], anisotropy, ..Medium::default() })
}
