//! Materials: parameter blocks and programs.

use super::{primvars::column, textures::CompiledTextures};
use crate::{
    bsdf::{Bump, Closure as Single, Distribution, Fuzz, Metal, SubsurfaceMethod, Surface, Switches, parameter},
    error::{Diagnostic, Error, Result},
    graph::{Arithmetic, Output, Program, Source, Step},
    integrator::{MaterialTable, Mix, Shading, SurfaceMaterial},
    scene::{self, Channel, Closure, Input, Material, Model, Node, NodeId, Operation, Origin, Scene, TextureFilter, WrapMode},
    texture::{Filter, Wrap},
};

/// Reflectance of surfaces without a material.
const DEFAULT_REFLECTANCE: [f32; 3] = [0.18; 3];

/// Compiles all materials; the default one stands last. Gives their surfaces and mixes.
pub(super) fn compile(
    scene: &Scene,
    textures: &CompiledTextures,
    names: &[String],
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<MaterialTable> {
    let default = Material::diffuse(Origin::new("default material"), DEFAULT_REFLECTANCE);
    let mut table = MaterialTable::default();
    for material in scene.materials.iter().chain([&default]) {
        let steps = steps(material, textures, names)?;
        let known = |node: &NodeId| usize::from(node.0) < steps.steps.len();
        let first = table.surfaces.len() as u32;
        for closure in &material.closures {
            let normals = [closure.normal, closure.coat_normal, closure.tangent];
            if !normals.iter().flatten().all(known) {
                return Err(Error::scene(&material.origin, "the material's normal refers to a node that does not exist"));
            }
            table.surfaces.push(surface(material, closure, steps.clone(), diagnostics));
        }
        table.numbers.push(match material.closures.as_slice() {
            [only] if only.weight == Input::Constant([1.0; 4]) => Shading::Surface(first),
            closures => {
                table.mixes.push(mix(closures, first, steps, &table.surfaces));
                Shading::Mix(table.mixes.len() as u32 - 1)
            }
        });
    }
    Ok(table)
}

/// A material of several closures, or of one with a weight.
fn mix(closures: &[Closure], first: u32, program: Program, surfaces: &[SurfaceMaterial]) -> Mix {
    let weights: Vec<Source> = closures.iter().map(|closure| source(closure.weight)).collect();
    let outputs = weights.iter().enumerate().map(|(i, weight)| Output { offset: i * 3, width: 3, source: *weight }).collect();
    let own = &surfaces[first as usize..];
    let constant = closures.iter().all(|closure| matches!(closure.weight, Input::Constant(_)));
    Mix {
        first,
        count: closures.len(),
        program: Program { outputs, ..program },
        transparent: own.iter().any(|surface| surface.transparent),
        emissive: own.iter().any(|surface| surface.emissive),
        even_emission: (constant && own.iter().all(SurfaceMaterial::emits_evenly)).then(|| {
            let glow = |closure: &Closure, surface: &SurfaceMaterial, c: usize| match closure.weight {
                Input::Constant(weight) => weight[c].max(0.0) * surface.surface.constants[parameter::EMISSION_COLOR + c],
                Input::Node(..) => 0.0,
            };
            std::array::from_fn(|c| closures.iter().zip(own).map(|(closure, surface)| glow(closure, surface, c)).sum())
        }),
    }
}

fn surface(material: &Material, closure: &Closure, mut program: Program, diagnostics: &mut Vec<Diagnostic>) -> SurfaceMaterial {
    let mut constants = parameter::DEFAULTS;
    let mut varying = [false; parameter::COUNT];
    for (name, input) in &closure.parameters {
        let Some(parameter) = parameter::find(name) else {
            diagnostics.push(Diagnostic::warning(&material.origin, format!("surface parameter '{name}' is not known; it is ignored")));
            continue;
        };
        let places = parameter.offset..parameter.offset + parameter.width();
        match input {
            Input::Constant(value) => constants[places].iter_mut().zip(value).for_each(|(place, value)| *place = finite(*value)),
            Input::Node(..) => {
                program.outputs.push(Output { offset: parameter.offset, width: parameter.width(), source: source(*input) });
                varying[places].fill(true);
            }
        }
    }
    let step = |node: Option<NodeId>| node.map(|node| node.0);
    program.normal = step(closure.normal);
    program.free_normal = switches_of(closure).bump == Bump::Cycles;
    program.coat_normal = step(closure.coat_normal);
    program.tangent = step(closure.tangent);
    let switches = switches_of(closure);
    let surface = Surface::new(constants, &varying, switches);
    let lobes = surface.lobes;
    SurfaceMaterial {
        transparent: surface.is_see_through(),
        emissive: lobes.emission,
        anisotropic: lobes.anisotropic,
        holdout: closure.model == Model::Holdout,
        pass_index: material.pass_index,
        surface,
        program,
        opacity_threshold: closure.opacity_threshold,
    }
}

fn finite(value: f32) -> f32 {
    if value.is_finite() { value } else { 0.0 }
}

fn switches_of(closure: &Closure) -> Switches {
    let single = Switches::single;
    let switches = match closure.model {
        Model::OpenPbr => Switches::default(),
        Model::Principled => Switches { bump: Bump::Cycles, ..Switches::principled() },
        Model::PreviewSurface => Switches::preview_surface(),
        Model::StandardSurface => Switches::standard_surface(),
        Model::Gltf => Switches::gltf(),
        Model::Diffuse => single(Single::Diffuse),
        Model::Glossy => single(Single::Glossy),
        Model::Glass => single(Single::Glass),
        Model::Refraction => single(Single::Refraction),
        Model::Metallic => single(Single::Metallic),
        Model::Conductor => Switches { metal: Metal::Conductor, ..single(Single::Metallic) },
        Model::Sheen => single(Single::Sheen),
        Model::Velvet => Switches { fuzz: Fuzz::Velvet, ..single(Single::Sheen) },
        Model::Translucent => single(Single::Translucent),
        Model::Subsurface => single(Single::Subsurface),
        Model::Transparent => single(Single::Transparent),
        Model::Emission | Model::Holdout => single(Single::Emission),
    };
    let distribution = match closure.distribution {
        scene::Distribution::MultiGgx => Distribution::MultiGgx,
        scene::Distribution::Ggx => Distribution::Ggx,
        scene::Distribution::Beckmann => Distribution::Beckmann,
        scene::Distribution::AshikhminShirley => Distribution::AshikhminShirley,
    };
    let walks = matches!(closure.model, Model::Principled | Model::Subsurface);
    let subsurface = match closure.subsurface {
        _ if !walks => SubsurfaceMethod::Diffuse,
        scene::SubsurfaceMethod::RandomWalk => SubsurfaceMethod::RandomWalk,
        scene::SubsurfaceMethod::RandomWalkLegacy => SubsurfaceMethod::RandomWalkLegacy,
        scene::SubsurfaceMethod::RandomWalkSkin => SubsurfaceMethod::RandomWalkSkin,
        scene::SubsurfaceMethod::Burley => SubsurfaceMethod::Burley,
    };
    Switches { thin_walled: closure.thin_walled, distribution, subsurface, ..switches }
}

fn source(input: Input) -> Source {
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
#[derive(Clone, Copy, Debug, Default)]
struct NodeFacts {
    /// Primvar column its value follows.
    column: Option<usize>,
    /// How much transforms scaled its coordinates.
    scale: f32,
}

fn steps(material: &Material, textures: &CompiledTextures, names: &[String]) -> Result<Program> {
    let mut program = Program::default();
    let mut facts: Vec<NodeFacts> = Vec::new();
    for (number, node) in material.graph.nodes.iter().enumerate() {
        let late = node.inputs.iter().find(|input| matches!(input, Input::Node(id, _) if usize::from(id.0) >= number));
        if late.is_some() {
            return Err(Error::scene(&material.origin, format!("node {number} of the material's graph reads a node that comes after it")));
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
    program.uv = program.uv.or_else(|| ["st", "UVMap", "map1", "uv"].iter().find_map(|name| column(names, name)));
    Ok(program)
}

fn facts_of(node: &Node, facts: &[NodeFacts], names: &[String]) -> NodeFacts {
    let inherited = node.inputs.iter().find_map(|input| match input {
        Input::Node(id, _) => Some(facts[usize::from(id.0)]),
        Input::Constant(_) => None,
    });
    let inherited = inherited.unwrap_or(NodeFacts { column: None, scale: 1.0 });
    match &node.operation {
        Operation::Primvar { name, .. } => NodeFacts { column: column(names, name), scale: 1.0 },
        Operation::Transform2d { scale, .. } => NodeFacts { scale: inherited.scale * (scale[0] * scale[1]).abs().sqrt(), ..inherited },
        Operation::Multiply => match node.inputs.get(1) {
            Some(Input::Constant(value)) => NodeFacts { scale: inherited.scale * (value[0] * value[1]).abs().sqrt(), ..inherited },
            _ => inherited,
        },
        _ => inherited,
    }
}

fn step_of(node: &Node, fact: NodeFacts, textures: &CompiledTextures, names: &[String]) -> Step {
    let input = |i: usize| node.inputs.get(i).map_or(Source::Constant([0.0; 4]), |input| source(*input));
    let three = || [input(0), input(1), input(2)];
    match &node.operation {
        Operation::Image { texture, wrap, filter, scale, bias, fallback } => match textures.number(*texture) {
            Some(texture) => Step::Image {
                texture,
                uv: input(0),
                wrap: wrap.map(wrap_of),
                filter: match filter {
                    TextureFilter::Linear => Filter::Trilinear,
                    TextureFilter::Closest => Filter::Nearest,
                },
                scale: *scale,
                bias: *bias,
                footprint: fact.scale,
            },
            None => Step::Combine(fallback.map(|x| Source::Constant([x; 4]))),
        },
        Operation::Primvar { name, fallback } => match column(names, name) {
            Some(column) => Step::Primvar { column, fallback: *fallback },
            None => Step::Combine(fallback.map(|x| Source::Constant([x; 4]))),
        },
        Operation::Transform2d { scale, rotation_deg, translation } => {
            let (sin, cos) = rotation_deg.to_radians().sin_cos();
            let matrix = [[cos * scale[0], -sin * scale[1]], [sin * scale[0], cos * scale[1]]];
            Step::Transform2d { input: input(0), matrix, offset: *translation }
        }
        Operation::NormalMap { scale } => Step::NormalMap { input: input(0), scale: *scale },
        Operation::Add => Step::Arithmetic(Arithmetic::Add, three()),
        Operation::Subtract => Step::Arithmetic(Arithmetic::Subtract, three()),
        Operation::Multiply => Step::Arithmetic(Arithmetic::Multiply, three()),
        Operation::Divide => Step::Arithmetic(Arithmetic::Divide, three()),
        Operation::Mix => Step::Arithmetic(Arithmetic::Mix, three()),
        Operation::Power => Step::Arithmetic(Arithmetic::Power, three()),
        Operation::Invert => Step::Arithmetic(Arithmetic::Invert, three()),
        Operation::Clamp => Step::Arithmetic(Arithmetic::Clamp, three()),
        Operation::Luminance => Step::Arithmetic(Arithmetic::Luminance, three()),
        Operation::Combine => Step::Combine([input(0), input(1), input(2), input(3)]),
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
