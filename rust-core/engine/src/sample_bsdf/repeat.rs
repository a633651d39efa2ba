//! A sample that goes on: the same again on every side, by the window's size.

use super::Window;
use crate::{
    error::{Error, Result},
    goniometer::Frame,
    scene::{PrimvarInterpolation, Scene},
};

/// Most repeats on each side.
pub const MOST_REPEATS: u32 = 200;
/// Most instances that repeats may make.
const MOST_INSTANCES: usize = 20_000_000;

/// The scene with all that is placed in it repeated.
///
/// # Errors
/// Too many repeats, and too many instances.
pub(super) fn repeated(scene: &Scene, frame: &Frame, window: &Window, repeats: u32) -> Result<Scene> {
    if repeats > MOST_REPEATS {
        return Err(Error::setting("repeat", format!("{repeats} was found, expected 0 to {MOST_REPEATS}")));
    }
    let count: usize = scene.instances.iter().map(|set| set.transforms.len()).sum();
    let copies = (2 * repeats as usize + 1).pow(2);
    if count.saturating_mul(copies) > MOST_INSTANCES {
        return Err(Error::setting("repeat", format!("{count} instances {copies} times are more than {MOST_INSTANCES}")));
    }
    let mut scene = scene.clone();
    let [width, height] = window.size();
    let reach = -i64::from(repeats)..=i64::from(repeats);
    let steps = reach.clone().flat_map(|row| reach.clone().map(move |column| [column as f64 * width, row as f64 * height, 0.0]));
    let moves: Vec<[f64; 3]> = steps.map(|step| frame.world_vector(step)).collect();
    for set in &mut scene.instances {
        let placed = std::mem::take(&mut set.transforms);
        for step in &moves {
            set.transforms.extend(placed.iter().map(|transform| {
                let mut moved = *transform;
                (0..3).for_each(|k| moved.columns[3][k] += step[k]);
                moved
            }));
        }
        for primvar in set.primvars.iter_mut().filter(|primvar| primvar.interpolation == PrimvarInterpolation::Uniform) {
            match &primvar.indices {
                Some(indices) => primvar.indices = Some(indices.repeat(copies).into()),
                None => primvar.values = primvar.values.repeat(copies).into(),
            }
        }
    }
    Ok(scene)
}
