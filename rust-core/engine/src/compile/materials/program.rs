//! A material's graph as steps.

use crate::{
    compile::{
        primvars::{COORDINATES, column},
        textures::CompiledTextures,
    },
    error::{Error, Result},
    graph::{Arithmetic, Curve, HitValue, LightPathValue, Program, Quantity, Source, Step, VectorOperation},
    scene::{self, Channel, Input, Material, Node, Operation, Space, TextureFilter, WrapMode},
    texture::{Filter, Wrap},
};
use std::sync::Arc;

/// Most rows of a curve's table.
const MOST_ROWS: usize = 1 << 16;

pub(super) fn source(input: Input) -> Source {
    match input {
        Input::Constant(value) => Source::Constant(value),
        Input::Node(node, Channel::Rgb) => Source::Register(node.0),
        Input::Node(node, Channel::R) => Source::Component(node.0, 0),
        Input::Node(node, Channel::G) => Source::Component(node.0, 1),
        Input::Node(node, Channel::B) => Source::Component(node.0, 2),
        Input::Node(node, Channel::A) => Source::Component(node.0, 3),
    }
}

/// What is known of a node while the graph is laid out.
#[derive(Clone, Copy, Debug)]
struct NodeFacts {
    /// Primvar column its value follows.
    column: Option<usize>,
    /// How much transforms scaled its coordinates.
    scale: f32,
    /// Whether its four components are the same.
    even: bool,
}

/// Lays out a material's graph; outputs are the caller's business.
pub(super) fn steps(material: &Material, textures: &CompiledTextures, names: &[String]) -> Result<Program> {
    let mut program = Program::default();
    let mut facts: Vec<NodeFacts> = Vec::new();
    for (number, node) in material.graph.nodes.iter().enumerate() {
        if let Some(problem) = problem(number, node) {
            return Err(Error::scene(&material.origin, problem));
        }
        let fact = facts_of(node, &facts, names);
        let step = step_of(node, fact, textures, names);
        if matches!(step, Step::Image { .. }) {
            program.uv = program.uv.or(fact.column);
        }
        program.steps.push(step);
        facts.push(fact);
    }
    // A tangent is wanted even where no image is: for anisotropy.
    program.uv = program.uv.or_else(|| COORDINATES.into_iter().find_map(|name| column(names, name)));
    Ok(program)
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
    let inherited = NodeFacts { even: false, ..inherited.unwrap_or(NodeFacts { column: None, scale: 1.0, even: false }) };
    let scaled = |determinant: f32| NodeFacts { scale: inherited.scale * determinant.abs().sqrt(), ..inherited };
    let fact = match &node.operation {
        Operation::Primvar { name, .. } => NodeFacts { column: column(names, name), scale: 1.0, even: false },
        Operation::Transform2d { scale, .. } => scaled(scale[0] * scale[1]),
        // Of the part that turns the first two coordinates into the first two.
        Operation::Transform3d { rows: [x, y, _] } => scaled(x[0] * y[1] - x[1] * y[0]),
        Operation::Multiply => match node.inputs.get(1) {
            Some(Input::Constant(value)) => scaled(value[0] * value[1]),
            _ => inherited,
        },
        _ => inherited,
    };
    NodeFacts { even: is_even(node, facts), ..fact }
}

/// Whether all four components of a node's value are the same.
fn is_even(node: &Node, facts: &[NodeFacts]) -> bool {
    match node.operation {
        Operation::Dot | Operation::Luminance | Operation::FrontFacing | Operation::LightPath(_) => true,
        _ if arithmetic_of(&node.operation).is_some() => node.inputs.iter().all(|input| match input {
            Input::Constant([x, rest @ ..]) => rest.iter().all(|other| other.to_bits() == x.to_bits()),
            Input::Node(id, Channel::Rgb) => facts[usize::from(id.0)].even,
            Input::Node(..) => true,
        }),
        _ => false,
    }
}

fn step_of(node: &Node, fact: NodeFacts, textures: &CompiledTextures, names: &[String]) -> Step {
    let input = |i: usize| node.inputs.get(i).map_or(Source::Constant([0.0; 4]), |input| source(*input));
    let constant = |value: [f32; 4]| Step::Combine(value.map(|x| Source::Constant([x; 4])));
    let absent = || constant([0.0; 4]);
    if let Some(operation) = arithmetic_of(&node.operation) {
        return Step::Arithmetic { operation, inputs: [input(0), input(1), input(2)], even: fact.even };
    }
    if let Some(operation) = vector_operation_of(&node.operation) {
        return Step::Vector(operation, [input(0), input(1)]);
    }
    if let Some(value) = hit_value_of(&node.operation) {
        return Step::Hit(value);
    }
    match &node.operation {
        Operation::Image { texture, wrap, filter, scale, bias, fallback } => match textures.number(*texture) {
            Some(texture) => Step::Image {
                texture,
                uv: input(0),
                wrap: wrap.map(wrap_of),
                filter: filter_of(*filter),
                scale: *scale,
                bias: *bias,
                footprint: fact.scale,
            },
            None => constant(*fallback),
        },
        Operation::Primvar { name, fallback } => match column(names, name) {
            Some(column) => Step::Primvar { column, fallback: *fallback },
            None => constant(*fallback),
        },
        Operation::PrimvarStep { name, axis } => {
            column(names, name).map_or_else(absent, |column| Step::PrimvarStep { column, axis: *axis })
        }
        Operation::UvTangent { uv } => column(names, uv).map_or_else(absent, |column| Step::UvTangent { column }),
        Operation::PositionStep { axis } => Step::PositionStep { axis: *axis },
        Operation::Transform2d { scale, rotation_deg, translation } => {
            let (sin, cos) = rotation_deg.to_radians().sin_cos();
            let matrix = [[cos * scale[0], -sin * scale[1]], [sin * scale[0], cos * scale[1]]];
            Step::Transform2d { input: input(0), matrix, offset: *translation }
        }
        Operation::Transform3d { rows } => Step::Transform3d { input: input(0), rows: *rows },
        Operation::Transform { from, to, quantity } if from != to => {
            Step::Transform { input: input(0), to_world: *to == Space::World, quantity: quantity_of(*quantity) }
        }
        Operation::NormalMap { scale, uv } => {
            Step::NormalMap { input: input(0), scale: *scale, uv: uv.as_ref().and_then(|name| column(names, name)) }
        }
        Operation::Curve { table, range, linear, extrapolate } => {
            Step::Curve { input: input(0), curve: Arc::new(Curve::new(table, *range, *linear, *extrapolate)) }
        }
        Operation::Combine => Step::Combine([input(0), input(1), input(2), input(3)]),
        // What is left is a change of space that changes nothing.
        _ => Step::Arithmetic {
            operation: Arithmetic::Add,
            inputs: [input(0), Source::Constant([0.0; 4]), Source::Constant([0.0; 4])],
            even: false,
        },
    }
}

fn arithmetic_of(operation: &Operation) -> Option<Arithmetic> {
    Some(match operation {
        Operation::Add => Arithmetic::Add,
        Operation::Subtract => Arithmetic::Subtract,
        Operation::Multiply => Arithmetic::Multiply,
        Operation::Divide => Arithmetic::Divide,
        Operation::Mix => Arithmetic::Mix,
        Operation::Power => Arithmetic::Power,
        Operation::Invert => Arithmetic::Invert,
        Operation::Clamp => Arithmetic::Clamp,
        Operation::Minimum => Arithmetic::Minimum,
        Operation::Maximum => Arithmetic::Maximum,
        Operation::Absolute => Arithmetic::Absolute,
        Operation::Sign => Arithmetic::Sign,
        Operation::Floor => Arithmetic::Floor,
        Operation::SquareRoot => Arithmetic::SquareRoot,
        Operation::Exponential => Arithmetic::Exponential,
        Operation::Logarithm => Arithmetic::Logarithm,
        Operation::Sine => Arithmetic::Sine,
        Operation::Cosine => Arithmetic::Cosine,
        Operation::ArcSine => Arithmetic::ArcSine,
        Operation::ArcCosine => Arithmetic::ArcCosine,
        Operation::ArcTangent2 => Arithmetic::ArcTangent2,
        Operation::Less => Arithmetic::Less,
        Operation::Fresnel => Arithmetic::Fresnel,
        _ => return None,
    })
}

fn vector_operation_of(operation: &Operation) -> Option<VectorOperation> {
    Some(match operation {
        Operation::Luminance => VectorOperation::Luminance,
        Operation::Dot => VectorOperation::Dot,
        Operation::Cross => VectorOperation::Cross,
        Operation::Normalize => VectorOperation::Normalize,
        Operation::RgbToHsv => VectorOperation::RgbToHsv,
        Operation::HsvToRgb => VectorOperation::HsvToRgb,
        _ => return None,
    })
}

fn hit_value_of(operation: &Operation) -> Option<HitValue> {
    Some(match operation {
        Operation::Position => HitValue::Position,
        Operation::Normal => HitValue::Normal,
        Operation::GeometricNormal => HitValue::GeometricNormal,
        Operation::Incoming => HitValue::Incoming,
        Operation::FrontFacing => HitValue::FrontFacing,
        Operation::LightPath(value) => HitValue::LightPath(light_path_of(*value)),
        _ => return None,
    })
}

fn light_path_of(value: scene::LightPathValue) -> LightPathValue {
    match value {
        scene::LightPathValue::IsCameraRay => LightPathValue::Camera,
        scene::LightPathValue::IsShadowRay => LightPathValue::Shadow,
        scene::LightPathValue::IsDiffuseRay => LightPathValue::Diffuse,
        scene::LightPathValue::IsGlossyRay => LightPathValue::Glossy,
        scene::LightPathValue::IsSingularRay => LightPathValue::Singular,
        scene::LightPathValue::IsReflectionRay => LightPathValue::Reflection,
        scene::LightPathValue::IsTransmissionRay => LightPathValue::Transmission,
        scene::LightPathValue::RayLength => LightPathValue::Length,
        scene::LightPathValue::RayDepth => LightPathValue::Depth,
        scene::LightPathValue::DiffuseDepth => LightPathValue::DepthOf(0),
        scene::LightPathValue::GlossyDepth => LightPathValue::DepthOf(1),
        scene::LightPathValue::TransmissionDepth => LightPathValue::DepthOf(2),
        scene::LightPathValue::TransparentDepth => LightPathValue::DepthOf(3),
    }
}

fn quantity_of(quantity: scene::Quantity) -> Quantity {
    match quantity {
        scene::Quantity::Point => Quantity::Point,
        scene::Quantity::Vector => Quantity::Vector,
        scene::Quantity::Normal => Quantity::Normal,
    }
}

fn filter_of(filter: TextureFilter) -> Filter {
    match filter {
        TextureFilter::Linear => Filter::Trilinear,
        TextureFilter::Closest => Filter::Nearest,
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
