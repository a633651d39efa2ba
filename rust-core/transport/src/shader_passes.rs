//! Shader passes: what materials compute for passes of their own, summed where the camera sees them first.

use super::{flag, scatter::add, shade::Point, transport::Transport, workspace::Workspace};
use crate::graph::{Program, Source};
use gonio_camera::sampler::{BATCH, pixel};
use gonio_simd::{Column, Lanes, M};
use std::{ops::Range, sync::Arc};

/// What a material shows in the passes of a name.
#[derive(Clone, Debug)]
pub struct ShaderOutput {
    /// Name of the passes.
    pub name: String,
    /// What a pass of colours shows.
    pub color: Source,
    /// What a pass of numbers shows.
    pub value: Source,
}

/// The outputs of one material.
#[derive(Clone, Debug)]
pub struct ShaderOutputs {
    /// The material's surfaces.
    pub surfaces: Range<usize>,
    /// The steps of the material's graph.
    pub program: Program,
    /// The outputs.
    pub outputs: Vec<ShaderOutput>,
}

/// The shader passes of a view.
#[derive(Clone, Debug, Default)]
pub struct ShaderPasses {
    /// By surface, what computes the passes there; outputs of three places are colours. Empty where no pass is wanted.
    pub programs: Arc<[Option<Program>]>,
    /// Columns of the sums.
    pub columns: usize,
}

/// Sums by pixel slot, one column a channel; none where no pass is wanted.
#[derive(Debug, Default)]
pub struct ShaderSums {
    /// Channel after channel.
    pub columns: Vec<Column>,
}

impl ShaderSums {
    /// Makes room for what the passes of a view show.
    pub fn prepare(&mut self, passes: &ShaderPasses) {
        self.columns.resize_with(passes.columns, || Column::new(BATCH));
    }
}

impl Workspace {
    /// The program of a surface's passes, if the camera sees any of the chunk's hits.
    pub(super) fn shader_program<'a>(&self, transport: &'a Transport, surface: usize, first: usize, count: usize) -> Option<&'a Program> {
        let program = transport.passes.shader.programs.get(surface)?.as_ref()?;
        let seen = |path: &u32| self.paths.flags(*path as usize) & flag::CAMERA != 0;
        self.order[first..first + count].iter().any(seen).then_some(program)
    }
}

/// Adds what a program computed at the chosen hits.
#[inline(always)]
pub(super) fn record<L: Lanes>(l: L, program: &Program, point: &Point<L>, chosen: M<L>, at: usize, ws: &mut Workspace) {
    let slot = pixel(point.slot);
    let mut place = 0;
    for output in &program.outputs {
        for channel in 0..output.width {
            let value = l.load(ws.shader_outputs.column(place), at);
            add(&mut ws.first_hit.shader.columns[output.offset + channel], slot, value * point.share, chosen & value.is_finite());
            place += 1;
        }
        if output.width == 3 {
            add(&mut ws.first_hit.shader.columns[output.offset + 3], slot, point.share, chosen);
        }
    }
}
