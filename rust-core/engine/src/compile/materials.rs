//! Materials: parameter blocks and programs.

mod displacement;
pub(super) mod media;
mod parameters;
mod program;

use super::{
    fields::{self, KeptFields},
    glasses::{self, Glasses},
    measured::CompiledMeasured,
    metals::{self, Metals},
    standard_passes,
    textures::CompiledTextures,
    wavelengths::LampSpectra,
};
use crate::{
    bsdf::{Bump, Closure as Single, Distribution, Fuzz, Metal, SubsurfaceMethod, Surface, Switches, parameter},
    error::{Diagnostic, Error, Result},
    graph::{Program, Wanted, WantedOutput},
    scene::{self, Closure, FibreDirection, Input, Material, Model, NodeId, Origin, Scene},
    transport::{MaterialTable, Mix, ShaderOutput, ShaderOutputs, Shading, SurfaceMaterial},
};
pub(super) use displacement::{displaces, program, pruned};
use gonio_nodes::{Channel, Operand, Value};
pub(super) use parameters::Parameters;
use parameters::{WEIGHT, tell_weights};
use program::{CompiledGraph, asks_for_ray, compile_graph, sampled_program};

/// Nodes that a graph may have: their numbers are of two bytes.
const MOST_NODES: usize = 1 << 16;
/// Reflectance of surfaces without a material, and of measured ones without a measurement.
const DEFAULT_REFLECTANCE: [f32; 3] = [0.18; 3];

/// What materials name: measurements, metals and glasses.
type Named<'a> = (&'a CompiledMeasured, &'a Metals, &'a Glasses);

/// Compiles all materials; the default one stands last. Gives their surfaces and mixes.
pub(super) fn compile(
    scene: &Scene,
    textures: &CompiledTextures,
    (named, spectra): (Named<'_>, &LampSpectra),
    names: &[String],
    kept: &KeptFields,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<(MaterialTable, KeptFields)> {
    let mut default = Material::diffuse(Origin::new("default material"), DEFAULT_REFLECTANCE);
    standard_passes::add_outputs(scene, &mut default);
    let mut table = MaterialTable::default();
    let usable;
    (table.media.fields, usable) = fields::compile(scene, kept, diagnostics);
    for (number, material) in scene.materials.iter().chain([&default]).enumerate() {
        let first = table.surfaces.len() as u32;
        if let Some(node) = nodes_of(material).find(|node| usize::from(node.0) >= material.graph.nodes.len()) {
            let problem = format!("the material refers to node {} of its graph, which does not exist", node.0);
            return Err(Error::scene(&material.origin, problem));
        }
        let spectrum = spectra.number_of_material(number);
        if spectrum != 0 && material.graph.nodes.len() + 2 * material.closures.len() > MOST_NODES {
            return Err(Error::scene(&material.origin, "the graph has no room left for the nodes of its spectrum"));
        }
        let coloured = spectra.coloured_material(number, material);
        let material = coloured.as_ref().unwrap_or(material);
        let graph = compile_graph(material, textures, names)?;
        tell_weights(material, &graph, diagnostics);
        metals::tell_unused(material, diagnostics);
        glasses::tell(material, diagnostics);
        let interior = media::add(&material.medium, &material.origin, &usable, &mut table.media, diagnostics);
        for closure in &material.closures {
            let solid_medium = match closure.thin_walled {
                true => None,
                false => media::add(&closure.solid, &material.origin, &usable, &mut table.media, diagnostics),
            };
            let mut surface = surface(material, closure, named, &graph, diagnostics);
            surface.surface.spectrum = spectrum;
            let bounds_alone = interior.is_some() && is_nothing(material, closure);
            table.surfaces.push(SurfaceMaterial { interior, solid_medium, bounds_alone, ..surface });
        }
        if !material.shader_outputs.is_empty() {
            table.shader_outputs.push(shader_outputs(material, &graph, first as usize));
        }
        table.numbers.push(match material.closures.as_slice() {
            [only] if only.weight == Input::Constant([1.0; 4]) => Shading::Surface(first),
            closures => {
                table.mixes.push(mix(closures, first, &graph, &table.surfaces));
                Shading::Mix(table.mixes.len() as u32 - 1)
            }
        });
    }
    if let Some(row) = media::add(&scene.atmosphere, &Origin::new("atmosphere"), &usable, &mut table.media, diagnostics) {
        table.media.everywhere = row;
    }
    table.any_exit = table.surfaces.iter().any(|surface| surface.exit.is_some());
    let kept = KeptFields::of(scene, usable, &table.media.fields);
    Ok((table, kept))
}

/// The nodes that closures and shader outputs read.
fn nodes_of(material: &Material) -> impl Iterator<Item = NodeId> {
    let closures = &material.closures;
    let parameters = closures.iter().flat_map(|closure| closure.parameters.iter().map(|(_, input)| input).chain([&closure.weight]));
    let outputs = material.shader_outputs.iter().flat_map(|output| [&output.color, &output.value]);
    let displaced = material.displacement.iter().map(|displacement| &displacement.value);
    let inputs = parameters.chain(outputs).chain(displaced).filter_map(|input| match input {
        Input::Node(node, _) => Some(*node),
        Input::Constant(_) => None,
    });
    inputs
        .chain(closures.iter().flat_map(|closure| [closure.normal, closure.coat_normal, closure.tangent]).flatten())
        .chain(material.normal)
}

/// What a material shows in passes of its own.
fn shader_outputs(material: &Material, graph: &CompiledGraph, first: usize) -> ShaderOutputs {
    let output = |output: &scene::ShaderOutput| ShaderOutput {
        name: output.name.clone(),
        color: graph.code.value(output.color),
        value: graph.code.value(output.value),
    };
    let surfaces = first..first + material.closures.len();
    ShaderOutputs { surfaces, code: graph.code.clone(), uv: graph.uv, outputs: material.shader_outputs.iter().map(output).collect() }
}

/// A material of several closures, or of one with a weight.
fn mix(closures: &[Closure], first: u32, graph: &CompiledGraph, surfaces: &[SurfaceMaterial]) -> Mix {
    let weight = |(i, value): (usize, Value)| WantedOutput { offset: i * 3, width: 3, value, range: Some(WEIGHT) };
    let outputs = closures.iter().map(|closure| graph.code.value(closure.weight)).enumerate().map(weight).collect();
    let program = Program::new(&graph.code, &Wanted { outputs, uv: graph.uv, ..Wanted::default() });
    let own = &surfaces[first as usize..];
    let emissive = own.iter().any(|surface| surface.emissive);
    let even_emission = even_emission(closures, own, graph);
    let known = own.iter().all(|surface| !surface.emissive || surface.even_emission.is_some() || surface.textured_emission.is_some());
    let textured_emission = if emissive && even_emission.is_none() && known {
        let outputs = closures.iter().map(|closure| graph.sampled.value(closure.weight)).enumerate().map(weight).collect();
        sampled_program(graph, outputs)
    } else {
        None
    };
    Mix {
        first,
        count: closures.len(),
        program,
        lets_light_pass: own.iter().any(|surface| surface.lets_light_pass),
        emissive,
        even_emission,
        textured_emission,
        emits_apart: own.iter().any(|surface| surface.emits_apart),
    }
}

/// What all closures emit together for light sampling, where that is the same everywhere.
fn even_emission(closures: &[Closure], surfaces: &[SurfaceMaterial], graph: &CompiledGraph) -> Option<[f32; 3]> {
    let mut sum = [0.0; 3];
    for (closure, surface) in closures.iter().zip(surfaces).filter(|(_, surface)| surface.emissive) {
        let (weight, emission) = (constant(&graph.sampled.value(closure.weight), WEIGHT)?, surface.even_emission?);
        (0..3).for_each(|c| sum[c] += weight[c] * emission[c]);
    }
    Some(sum)
}

/// A colour that is the same everywhere, within a range.
fn constant(value: &[Operand; 4], [low, high]: [f32; 2]) -> Option<[f32; 3]> {
    let mut colour = [0.0; 3];
    for (component, operand) in colour.iter_mut().zip(value) {
        let Operand::Constant(number) = operand else { return None };
        *component = if number.is_nan() { 0.0f32.clamp(low, high) } else { number.clamp(low, high) };
    }
    Some(colour)
}

fn surface(
    material: &Material,
    closure: &Closure,
    (measured, metals, glasses): Named<'_>,
    graph: &CompiledGraph,
    diagnostics: &mut Vec<Diagnostic>,
) -> SurfaceMaterial {
    let measured = measured.of(closure);
    if closure.model == Model::Measured && measured.is_none() {
        let mut grey = Closure { model: Model::Diffuse, parameters: Vec::new(), ..closure.clone() };
        grey.set_colour("base_color", DEFAULT_REFLECTANCE);
        return surface(material, &grey, (&CompiledMeasured::default(), metals, glasses), graph, diagnostics);
    }
    let mut switches = switches_of(closure);
    let mut parameters = Parameters::new(material, closure, (&switches, measured.is_some()), graph, diagnostics);
    let metal = metals.row_of(closure);
    if let Some(row) = metal {
        metals.set(row, closure, &mut switches, &mut parameters);
    }
    let glass = glasses.row_of(closure);
    if let Some(row) = glass {
        glasses.set(row, closure, &mut parameters);
    }
    let Parameters { constants, varying, outputs, sampled } = parameters;
    let mut wanted = Wanted { outputs, free_normal: switches.bump == Bump::Cycles, uv: graph.uv, ..Wanted::default() };
    let code = &graph.code;
    let direction = |node: Option<NodeId>| node.map(|node| code.value(Input::Node(node, Channel::Rgb)));
    wanted.normal = direction(closure.normal);
    wanted.smooth_normal = direction(material.normal);
    wanted.coat_normal = direction(closure.coat_normal);
    wanted.tangent = direction(closure.tangent);
    wanted.edge = edge(closure);
    let mut program = Program::new(code, &wanted);
    // Shader outputs run on the same surface points.
    program.light_path |= !material.shader_outputs.is_empty() && asks_for_ray(code);
    let surface = match measured {
        Some(measured) => Surface::measured(constants, &varying, switches, measured.clone()),
        None => Surface { metal, ..Surface::new(constants, &varying, switches) }.of_glass(glass),
    };
    let lobes = surface.lobes;
    let exit = (lobes.walk && wanted.normal.is_some()).then(|| {
        // As in Cycles, what is under the surface takes no normal about which the way out would be mirrored into it.
        let normal_alone = Wanted { normal: wanted.normal, smooth_normal: wanted.smooth_normal, uv: wanted.uv, ..Wanted::default() };
        Box::new(Program::new(code, &normal_alone))
    });
    let (even_emission, textured_emission) = sampled_emission(&surface, sampled, graph);
    SurfaceMaterial {
        transparent: surface.is_see_through(),
        lets_light_pass: surface.is_see_through() && material.transparent_shadows,
        emissive: lobes.emission,
        even_emission,
        textured_emission,
        emits_apart: material.closures.len() > 1 && closure.model == Model::Emission && lobes.emission && !lobes.cut_out,
        interior: None,
        solid_medium: None,
        anisotropic: lobes.anisotropic,
        bounds_alone: false,
        holdout: closure.model == Model::Holdout,
        pass_index: material.pass_index,
        matte_id: scene::matte_id(&material.origin.name),
        surface,
        program,
        exit,
        opacity_threshold: closure.opacity_threshold,
    }
}

/// Whether a closure is all of its material, and lets everything pass as it is.
fn is_nothing(material: &scene::Material, closure: &Closure) -> bool {
    let is_white = |input: Option<Input>| matches!(input, Some(Input::Constant([r, g, b, _])) if [r, g, b] == [1.0; 3]);
    let is_whole = matches!(closure.weight, Input::Constant([r, g, b, _]) if [r, g, b] == [1.0; 3]);
    material.closures.len() == 1 && closure.model == Model::Transparent && is_whole && is_white(closure.input("base_color"))
}

/// What a surface emits for light sampling: the same everywhere, or what a program computes of the parameters that vary, given as light sampling
/// has them.
fn sampled_emission(surface: &Surface, varying: Vec<WantedOutput>, graph: &CompiledGraph) -> (Option<[f32; 3]>, Option<Box<Program>>) {
    let colour = varying.iter().find(|output| output.offset == parameter::EMISSION_COLOR);
    let plain = || Some([0, 1, 2].map(|c| surface.constants[parameter::EMISSION_COLOR + c]));
    let covered = surface.covers_emission();
    let even = colour.map_or_else(plain, |output| constant(&output.value, parameter::LIGHT)).filter(|_| !covered && !surface.lobes.cut_out);
    if !surface.lobes.emission || even.is_some() {
        return (even, None);
    }
    let wanted = |offset: usize| covered || offset == parameter::EMISSION_COLOR || offset == parameter::OPACITY;
    let outputs = varying.into_iter().filter(|output| wanted(output.offset)).collect();
    (None, sampled_program(graph, outputs))
}

/// The edge of triangles that fibres lie along.
fn edge(closure: &Closure) -> Option<usize> {
    let fibre = closure.model.is_fibre();
    match closure.fibres {
        FibreDirection::FirstEdge if fibre && closure.tangent.is_none() => Some(0),
        FibreDirection::SecondEdge if fibre && closure.tangent.is_none() => Some(1),
        _ => None,
    }
}

fn switches_of(closure: &Closure) -> Switches {
    let single = |closure| Switches { bump: Bump::Cycles, ..Switches::single(closure) };
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
        Model::DiffuseToon => single(Single::DiffuseToon),
        Model::GlossyToon => single(Single::GlossyToon),
        Model::Hair => single(Single::Hair),
        Model::HairElliptic => single(Single::HairElliptic),
        Model::HairReflection => single(Single::HairReflection),
        Model::HairTransmission => single(Single::HairTransmission),
        Model::Translucent => single(Single::Translucent),
        Model::Subsurface => single(Single::Subsurface),
        Model::Transparent => single(Single::Transparent),
        Model::Portal => single(Single::Portal),
        Model::Measured => single(Single::Measured),
        Model::Emission | Model::Holdout => single(Single::Emission),
    };
    let distribution = match closure.distribution {
        scene::Distribution::MultiGgx => Distribution::MultiGgx,
        scene::Distribution::Ggx => Distribution::Ggx,
        scene::Distribution::Beckmann => Distribution::Beckmann,
        scene::Distribution::AshikhminShirley => Distribution::AshikhminShirley,
    };
    let subsurface = match closure.subsurface {
        scene::SubsurfaceMethod::RandomWalk => SubsurfaceMethod::RandomWalk,
        scene::SubsurfaceMethod::RandomWalkLegacy => SubsurfaceMethod::RandomWalkLegacy,
        scene::SubsurfaceMethod::RandomWalkSkin => SubsurfaceMethod::RandomWalkSkin,
        scene::SubsurfaceMethod::Burley => SubsurfaceMethod::Burley,
    };
    Switches { thin_walled: closure.thin_walled, distribution, subsurface, ..switches }
}
