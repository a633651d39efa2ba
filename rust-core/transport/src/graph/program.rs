//! A material's program: what its graph computes for one closure, one mix or one set of passes.

use super::HitStep;
use gonio_nodes::{Code, Kernel, Operand, Source, Value};

/// A parameter that the graph computes.
#[derive(Clone, Debug, PartialEq)]
pub struct Output {
    /// First place in the parameter block.
    pub offset: usize,
    /// Where its components are found: 1 or 3.
    pub sources: Vec<Source>,
    /// What it is held within; what is no number becomes the least.
    pub range: Option<[f32; 2]>,
}

/// A parameter that is asked of a graph.
#[derive(Clone, Copy, Debug)]
pub struct WantedOutput {
    /// First place in the parameter block.
    pub offset: usize,
    /// How many places.
    pub width: usize,
    /// What the graph has for it.
    pub value: Value,
    /// What it is held within, if anything.
    pub range: Option<[f32; 2]>,
}

/// What is asked of a graph.
#[derive(Clone, Debug, Default)]
pub struct Wanted {
    /// Parameters.
    pub outputs: Vec<WantedOutput>,
    /// The shading normal.
    pub normal: Option<Value>,
    /// The normal that it is bent from; the mesh's without it.
    pub smooth_normal: Option<Value>,
    /// The coat's normal.
    pub coat_normal: Option<Value>,
    /// The direction of anisotropy.
    pub tangent: Option<Value>,
    /// The edge of triangles that fibres lie along, 0 or 1, about the triangles' normals.
    pub edge: Option<usize>,
    /// Whether the normal is taken as it is; else it is turned so that mirror directions leave the surface.
    pub free_normal: bool,
    /// Primvar column that tangents and footprints follow.
    pub uv: Option<usize>,
}

/// A direction that the graph computes.
pub type Direction = [Source; 3];

/// A material's graph.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// The steps.
    pub(super) steps: gonio_nodes::Program<HitStep>,
    /// Parameters computed.
    pub outputs: Vec<Output>,
    /// The shading normal.
    pub normal: Option<Direction>,
    /// The normal that it is bent from; the mesh's without it.
    pub smooth_normal: Option<Direction>,
    /// Whether that normal is taken as it is; else it is turned so that mirror directions leave the surface.
    pub free_normal: bool,
    /// The coat's normal.
    pub coat_normal: Option<Direction>,
    /// The direction of anisotropy.
    pub tangent: Option<Direction>,
    /// The edge of triangles that fibres lie along, 0 or 1, about the triangles' normals.
    pub edge: Option<usize>,
    /// Primvar column that tangents and footprints follow.
    pub uv: Option<usize>,
    /// Whether surface points keep the ray, for this program or for one that runs on the same points.
    pub light_path: bool,
}

impl Program {
    /// The part of a graph that computes what is wanted.
    pub fn new(code: &Code<HitStep>, wanted: &Wanted) -> Self {
        let directions = [wanted.normal, wanted.smooth_normal, wanted.coat_normal, wanted.tangent];
        let parameters = wanted.outputs.iter().flat_map(|output| output.value.iter().take(output.width));
        let operands: Vec<Operand> =
            parameters.chain(directions.iter().flatten().flat_map(|value| value.iter().take(3))).copied().collect();
        let (steps, sources) = gonio_nodes::Program::new(code, &operands);
        let mut sources = sources.into_iter();
        let outputs = wanted.outputs.iter();
        let outputs = outputs.map(|WantedOutput { offset, width, range, .. }| {
            let sources = sources.by_ref().take(*width).collect();
            Output { offset: *offset, sources, range: *range }
        });
        let outputs = outputs.collect();
        let mut direction = |value: Option<Value>| value.map(|_| std::array::from_fn(|_| sources.next().unwrap_or(Source::Constant(0.0))));
        let [normal, smooth_normal, coat_normal, tangent] = directions.map(&mut direction);
        let light_path = steps.kernels().any(|kernel| matches!(kernel, Kernel::Hit(step) if step.asks_for_ray()));
        let Wanted { free_normal, edge, uv, .. } = *wanted;
        Self { steps, outputs, normal, smooth_normal, free_normal, coat_normal, tangent, edge, uv, light_path }
    }
    /// Whether there is nothing to run.
    pub fn is_empty(&self) -> bool {
        self.outputs.is_empty() && self.normal.is_none() && self.coat_normal.is_none() && self.tangent.is_none()
    }
    /// The kernels in order.
    pub fn kernels(&self) -> impl Iterator<Item = &Kernel<HitStep>> {
        self.steps.kernels()
    }
}
