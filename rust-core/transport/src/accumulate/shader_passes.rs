//! Shader AOVs: what materials compute for passes of their own, summed where the camera sees them first.

use crate::accumulate::add::add;
use crate::accumulate::tile_sums::TileSums;
use crate::graph::{OutputColumns, Program};
use crate::state::paths::Paths;
use crate::state::vertex::Vertex;
use crate::tables::shader_passes::ShaderPasses;
use crate::words::flag;
use gonio_camera::sampler::pixel;
use gonio_simd::{Lanes, M};

/// The program of a surface's passes, if the camera sees any of a chunk's hits; `order` has the chunk's paths.
pub(crate) fn shader_program<'a>(passes: &'a ShaderPasses, surface: usize, order: &[u32], paths: &Paths) -> Option<&'a Program> {
    let program = passes.programs.get(surface)?.as_ref()?;
    let seen = |path: &u32| paths.flags(*path as usize) & flag::CAMERA != 0;
    order.iter().any(seen).then_some(program)
}

/// Adds what a program computed at the chosen hits.
#[inline(always)]
pub(crate) fn add_shader_passes<L: Lanes>(
    program: &Program,
    outputs: &OutputColumns,
    point: &Vertex<L>,
    chosen: M<L>,
    at: usize,
    sums: &mut TileSums,
) {
    let (l, slot) = (point.core.slot.lanes(), pixel(point.core.slot));
    let mut place = 0;
    for output in &program.outputs {
        for channel in 0..output.sources.len() {
            let value = l.load(outputs.column(place), at);
            add(&mut sums.shader.columns[output.offset + channel], slot, value * point.share, chosen & value.is_finite());
            place += 1;
        }
        if output.sources.len() == 3 {
            add(&mut sums.shader.columns[output.offset + 3], slot, point.share, chosen);
        }
    }
}
