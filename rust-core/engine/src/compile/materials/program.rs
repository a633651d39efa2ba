//! A material's graph as code: names resolved to columns and textures.

use crate::{
    compile::{
        primvars::{COORDINATES, column},
        textures::CompiledTextures,
    },
    error::{Error, Result},
    graph::{HitStep, Occlusion, Program, Wanted, WantedOutput},
    scene::{Input, LightPathValue, Material, Node, Operation, Space, TextureFilter, WrapMode},
    texture::{Filter, Wrap},
};
use gonio_nodes::{Code, Hit, Kernel};
use std::sync::Arc;

/// Most rows of a curve's table.
const MOST_ROWS: usize = 1 << 16;
/// Most rays of a step that looks around a hit.
const MOST_RAYS: u32 = 1024;

/// A graph laid out, and the primvar column that tangents and footprints follow.
pub(super) struct CompiledGraph {
    pub(super) code: Arc<Code<HitStep>>,
    /// The graph as light sampling has it, which looks from no ray of any kind, where it asks what rays are; else as `code`.
    pub(super) sampled: Arc<Code<HitStep>>,
    pub(super) uv: Option<usize>,
}

/// Whether a node tells of which kind the ray is that shades a hit.
fn tells_kind_of_ray(operation: &Operation) -> bool {
    use LightPathValue as V;
    let Operation::LightPath(value) = operation else { return false };
    matches!(
        value,
        V::IsCameraRay
            | V::IsShadowRay
            | V::IsDiffuseRay
            | V::IsGlossyRay
            | V::IsSingularRay
            | V::IsReflectionRay
            | V::IsTransmissionRay
            | V::IsVolumeScatterRay
    )
}

/// The part of a graph that light sampling runs to know what is emitted; none where that depends on what happened to the path before, which light
/// sampling cannot tell.
pub(super) fn sampled_program(graph: &CompiledGraph, outputs: Vec<WantedOutput>) -> Option<Box<Program>> {
    use LightPathValue as V;
    let program = Program::new(&graph.sampled, &Wanted { outputs, uv: graph.uv, ..Wanted::default() });
    let counts = |value: &V| matches!(value, V::RayDepth | V::DiffuseDepth | V::GlossyDepth | V::TransmissionDepth | V::TransparentDepth);
    let unknown = |kernel: &Kernel<HitStep>| matches!(kernel, Kernel::Hit(HitStep::Point(Operation::LightPath(value))) if counts(value));
    let known = !program.kernels().any(unknown);
    known.then(|| Box::new(program))
}

/// What is known of a node's coordinates while the graph is laid out.
#[derive(Clone, Copy, Debug)]
struct NodeFacts {
    /// Primvar column its value follows.
    column: Option<usize>,
    /// How much transforms scaled its coordinates; 0 where they are bent.
    scale: f32,
}

impl NodeFacts {
    /// Size of a unit of coordinates for the footprints of the column `uv`; 0, which asks for the finest level, where they follow something else.
    fn footprint(self, uv: Option<usize>) -> f32 {
        if self.column.is_some() && self.column == uv { self.scale } else { 0.0 }
    }
}

/// Lays out a material's graph.
pub(super) fn compile_graph(material: &Material, textures: &CompiledTextures, names: &[String]) -> Result<CompiledGraph> {
    let nodes = &material.graph.nodes;
    let mut facts: Vec<NodeFacts> = Vec::new();
    for (number, node) in nodes.iter().enumerate() {
        if let Some(problem) = problem(number, node) {
            return Err(Error::scene(&material.origin, problem));
        }
        facts.push(facts_of(node, &facts, names));
    }
    let is_image = |node: &Node| matches!(&node.operation, Operation::Image { texture, .. } if textures.number(*texture).is_some());
    let images = nodes.iter().zip(&facts).filter(|(node, _)| is_image(node));
    let uv = images.filter_map(|(_, facts)| facts.column).next();
    let shown = |number: usize, operation: &Operation| hit(operation, facts[number].footprint(uv), textures, names);
    let code = Arc::new(Code::new(&material.graph, shown));
    let sampled = if nodes.iter().any(|node| tells_kind_of_ray(&node.operation)) {
        let none = |number: usize, operation: &Operation| match operation {
            kind if tells_kind_of_ray(kind) => Hit::Constant([0.0; 4]),
            other => shown(number, other),
        };
        Arc::new(Code::new(&material.graph, none))
    } else {
        code.clone()
    };
    // A tangent is wanted even where no image is: for anisotropy.
    Ok(CompiledGraph { code, sampled, uv: uv.or_else(|| COORDINATES.into_iter().find_map(|name| column(names, name))) })
}

/// What is wrong with a node, if anything.
fn problem(number: usize, node: &Node) -> Option<String> {
    if node.inputs.iter().any(|input| matches!(input, Input::Node(id, _) if usize::from(id.0) >= number)) {
        return Some(format!("node {number} of the material's graph reads a node that comes after it"));
    }
    match &node.operation {
        Operation::Curve { table, .. } if table.len() > MOST_ROWS => {
            Some(format!("the curve of node {number} of the material's graph has {} rows, expected {MOST_ROWS} at most", table.len()))
        }
        _ => None,
    }
}

fn facts_of(node: &Node, facts: &[NodeFacts], names: &[String]) -> NodeFacts {
    let inherited = node.inputs.iter().find_map(|input| match input {
        Input::Node(id, _) => Some(facts[usize::from(id.0)]),
        Input::Constant(_) => None,
    });
    let inherited = inherited.unwrap_or(NodeFacts { column: None, scale: 1.0 });
    let scaled = |determinant: f32| NodeFacts { scale: inherited.scale * determinant.abs().sqrt(), ..inherited };
    match &node.operation {
        Operation::Primvar { name, .. } => NodeFacts { column: column(names, name), scale: 1.0 },
        Operation::Transform2d { scale, .. } => scaled(scale[0] * scale[1]),
        // Of the part that turns the first two coordinates into the first two.
        Operation::Transform3d { rows: [x, y, _] } => scaled(x[0] * y[1] - x[1] * y[0]),
        Operation::Multiply => match node.inputs.get(1) {
            Some(Input::Constant(value)) => scaled(value[0] * value[1]),
            _ => inherited,
        },
        Operation::Power
        | Operation::SquareRoot
        | Operation::Exponential
        | Operation::Logarithm
        | Operation::Sine
        | Operation::Cosine
        | Operation::ArcSine
        | Operation::ArcCosine
        | Operation::ArcTangent2
        | Operation::Normalize => NodeFacts { scale: 0.0, ..inherited },
        _ => inherited,
    }
}

/// What an operation of the table's section `hit` is in this scene.
fn hit(operation: &Operation, footprint: f32, textures: &CompiledTextures, names: &[String]) -> Hit<HitStep> {
    let along = |name: &String, step: &dyn Fn(usize) -> HitStep, absent: [f32; 4]| match column(names, name) {
        Some(column) => Hit::Step(step(column)),
        None => Hit::Constant(absent),
    };
    match operation {
        Operation::Image { texture, wrap, filter, scale, bias, fallback } => match textures.number(*texture) {
            Some(texture) => Hit::Step(HitStep::Image {
                texture,
                wrap: wrap.map(wrap_of),
                filter: filter_of(*filter),
                scale: *scale,
                bias: *bias,
                fallback: *fallback,
                footprint,
            }),
            None => Hit::Constant(*fallback),
        },
        Operation::Primvar { name, fallback } => along(name, &|column| HitStep::Primvar { column, fallback: *fallback }, *fallback),
        Operation::PrimvarStep { name, axis } => along(name, &|column| HitStep::PrimvarStep { column, axis: *axis }, [0.0; 4]),
        Operation::UvTangent { uv } => along(uv, &|column| HitStep::UvTangent { column }, [0.0; 4]),
        Operation::Transform { from, to, .. } if from == to => Hit::Same,
        Operation::Transform { to, quantity, .. } => Hit::Step(HitStep::Transform { to_world: *to == Space::World, quantity: *quantity }),
        Operation::NormalMap { scale, uv } => {
            Hit::Step(HitStep::NormalMap { scale: *scale, uv: uv.as_ref().and_then(|name| column(names, name)) })
        }
        Operation::Occlusion { samples, inside, only_local } => {
            let samples = (*samples).clamp(1, MOST_RAYS);
            Hit::Step(HitStep::Occlusion(Occlusion { samples, inside: *inside, only_local: *only_local }))
        }
        Operation::RoundedNormal { samples } => Hit::Step(HitStep::RoundedNormal { samples: (*samples).clamp(1, MOST_RAYS) }),
        _ => Hit::Step(HitStep::Point(operation.clone())),
    }
}

/// Whether any step asks for the ray.
pub(super) fn asks_for_ray(code: &Code<HitStep>) -> bool {
    code.steps.iter().any(|step| matches!(&step.kernel, Kernel::Hit(step) if step.asks_for_ray()))
}

fn filter_of(filter: TextureFilter) -> Filter {
    match filter {
        TextureFilter::Linear => Filter::Trilinear,
        TextureFilter::Closest => Filter::Nearest,
        TextureFilter::Cubic => Filter::Cubic,
        TextureFilter::LinearCodes => Filter::TrilinearCodes,
        TextureFilter::CubicCodes => Filter::CubicCodes,
    }
}

fn wrap_of(mode: WrapMode) -> Wrap {
    match mode {
        WrapMode::Repeat => Wrap::Repeat,
        WrapMode::Clamp => Wrap::Clamp,
        WrapMode::Mirror => Wrap::Mirror,
        WrapMode::Black => Wrap::Black,
    }
}
