//! Shader AOVs (Cycles' AOV Output node): what materials compute for passes of their own.

use crate::graph::{HitStep, Program};
use gonio_nodes::{Code, Value};
use std::{ops::Range, sync::Arc};

/// What a material shows in the passes of a name.
#[derive(Clone, Debug)]
pub struct ShaderOutput {
    /// Name of the passes.
    pub name: String,
    /// What a pass of colours shows.
    pub color: Value,
    /// What a pass of numbers shows.
    pub value: Value,
}

/// The outputs of one material.
#[derive(Clone, Debug)]
pub struct ShaderOutputs {
    /// The material's surfaces.
    pub surfaces: Range<usize>,
    /// The material's graph.
    pub code: Arc<Code<HitStep>>,
    /// Primvar column that tangents and footprints follow.
    pub uv: Option<usize>,
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
