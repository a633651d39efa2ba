//! Luminaires that are larger than the scene they hang in: an opening or a scene in the wrong unit.

use super::bounds::Bounds;
use crate::{
    error::Diagnostic,
    scene::{Light, LightShape, Scene},
};

/// Says which luminaires' openings are longer than everything else together.
pub(super) fn report(scene: &Scene, bounds: &Bounds, diagnostics: &mut Vec<Diagnostic>) {
    if bounds.is_empty() {
        return;
    }
    let room = 2.0 * bounds.radius();
    for light in &scene.lights {
        let length = longest(light);
        if length > room {
            let message = format!(
                "the luminaire's opening is {length:.2} m long in a scene {room:.2} m across; are the file's lengths and the scene's unit right?"
            );
            diagnostics.push(Diagnostic::warning(&light.origin, message));
        }
    }
}

/// The greatest extent of a luminaire's opening in the world, metres; 0 for other lights.
fn longest(light: &Light) -> f64 {
    let LightShape::Opening(opening) = light.shape else { return 0.0 };
    let along = |axis: usize| opening.size[axis] * light.transform.columns[axis].iter().map(|x| x * x).sum::<f64>().sqrt();
    (0..3).map(along).fold(0.0, f64::max)
}
