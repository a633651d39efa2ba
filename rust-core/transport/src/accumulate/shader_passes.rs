//! Shader AOVs: what materials compute for passes of their own, summed where the camera sees them first.

use crate::accumulate::add::add;
use crate::graph::Program;
use crate::state::flag;
use crate::state::vertex::Vertex;
use crate::state::workspace::Workspace;
use crate::tables::transport::Transport;
use gonio_camera::sampler::pixel;
use gonio_simd::{Lanes, M};

impl Workspace {
    /// The program of a surface's passes, if the camera sees any of the chunk's hits.
    pub(crate) fn shader_program<'a>(&self, transport: &'a Transport, surface: usize, first: usize, count: usize) -> Option<&'a Program> {
        let program = transport.passes.shader.programs.get(surface)?.as_ref()?;
        let seen = |path: &u32| self.paths.flags(*path as usize) & flag::CAMERA != 0;
        self.order[first..first + count].iter().any(seen).then_some(program)
    }
}

/// Adds what a program computed at the chosen hits.
#[inline(always)]
pub(crate) fn record<L: Lanes>(l: L, program: &Program, point: &Vertex<L>, chosen: M<L>, at: usize, ws: &mut Workspace) {
    let slot = pixel(point.slot);
    let mut place = 0;
    for output in &program.outputs {
        for channel in 0..output.width {
            let value = l.load(ws.shader_outputs.column(place), at);
            add(&mut ws.sums.shader.columns[output.offset + channel], slot, value * point.share, chosen & value.is_finite());
            place += 1;
        }
        if output.width == 3 {
            add(&mut ws.sums.shader.columns[output.offset + 3], slot, point.share, chosen);
        }
    }
}
