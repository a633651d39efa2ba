//! From a scene's description to the tables that kernels read.
//!
//! Meshes whose arrays did not change keep their trees; moving instances rebuilds the top level alone.

mod ahead;
mod bands;
mod bodies;
mod bounds;
mod cancel;
mod casters;
mod catchers;
mod colour_spectra;
mod compiled;
mod cut;
mod dice;
mod displace;
mod expressions;
mod fields;
mod fill;
mod filters;
mod geometry;
mod glasses;
mod goniograms;
mod indices;
mod instances;
mod kept;
mod lamps_in_media;
mod light_alone;
mod light_groups;
mod light_images;
pub(crate) mod light_paths_measure;
pub(crate) mod light_paths_pay;
mod lights;
mod linking;
mod looks;
mod luminaires;
mod materials;
mod measured;
mod metals;
mod motion;
mod motion_vectors;
mod moving_fields;
mod numbers;
mod openings;
mod oversized;
mod primvars;
mod quantity;
mod samples;
mod shader_passes;
mod shapes;
mod shining;
mod smooth;
mod smooth_primvars;
mod smooth_tables;
mod standard_passes;
mod strand_materials;
mod textures;
mod times;
mod trees;
mod unfollowed;
mod view;
mod wavelengths;
mod whitted;

use cancel::check;
use compiled::Kept;
use lights::{CompiledLights, KeptLights};
use looks::Looks;
use numbers::geometry_number;
use shapes::Shapes;
use trees::KeptTree;

pub use ahead::TreesAhead;
pub(crate) use bands::BandedScene;
pub use bounds::Bounds;
pub(crate) use casters::Casters;
pub use compiled::{CompileStatistics, CompiledScene};
pub(crate) use dice::is_diced;
pub(crate) use luminaires::{Luminaire, luminaires, luminous_fluxes_of_all};
pub use luminaires::{luminous_fluxes, luminous_intensities, stated_directions};
pub(crate) use unfollowed::unfollowed;
pub use view::View;
pub(crate) use view::{check_tiles, picture_view, transport, window};

use crate::{
    accel::Tlas,
    error::{Diagnostic, Result},
    film::Besides,
    light::LightTable,
    scene::{Integrator, Manifests, MatteName, Scene, matte_id},
    threads::in_pool,
    transport::{MaterialTable, MatteNames, NameRun, Tables},
};
use std::{
    mem,
    sync::{Arc, atomic::AtomicBool},
    time::Instant,
};

/// Lays a scene out; `previous` lends what did not change. Cancelling gives [`Error::Cancelled`](crate::error::Error::Cancelled) within a tenth of a
/// second or so.
pub fn compile(scene: &Scene, previous: Option<&CompiledScene>, cancel: &AtomicBool) -> Result<CompiledScene> {
    in_pool(|| laid_out(scene, previous, &[], cancel))
}

/// The same with trees that were built while the scene was described. Not to be called on a thread of the pool.
pub fn compile_ahead(scene: &Scene, previous: Option<&CompiledScene>, ahead: TreesAhead, cancel: &AtomicBool) -> Result<CompiledScene> {
    let trees = ahead.finish();
    in_pool(|| laid_out(scene, previous, &trees, cancel))
}

fn laid_out(scene: &Scene, previous: Option<&CompiledScene>, ahead: &[KeptTree], cancel: &AtomicBool) -> Result<CompiledScene> {
    let start = Instant::now();
    let complete = standard_passes::complete(scene);
    let mut diagnostics = Vec::new();
    let adapted = strand_materials::without_subsurface(&complete, &mut diagnostics);
    let scene = adapted.as_ref().unwrap_or(&complete);
    let none = Kept::default();
    let kept = previous.map_or(&none, |previous| &previous.kept);
    let diced = dice::apply(scene, &kept.diced, cancel, &mut diagnostics)?;
    let scene = diced.as_ref().map_or(scene, |diced| &diced.scene);
    let mut looks = Looks::compile(scene, kept, cancel, &mut diagnostics)?;
    check(cancel)?;
    let displaced = displace::apply(scene, looks.laid(), &kept.displaced, cancel, &mut diagnostics)?;
    let scene = displaced.as_ref().map_or(scene, |displaced| &displaced.scene);
    let mut shapes = Shapes::compile(scene, &looks, kept, ahead, cancel, &mut diagnostics)?;
    let mut lights = lit(scene, &mut looks, &mut shapes, &kept.lights, cancel, &mut diagnostics)?;
    let bvh = shapes.top_level(cancel)?;
    let statistics = CompileStatistics { total_s: start.elapsed().as_secs_f64(), ..statistics(scene, &looks, &shapes, &lights) };
    report(scene, &looks.materials, &lights.table, &mut diagnostics);
    let casters = Casters::of(scene, &shapes.mesh_bounds, &looks.materials, shapes.origin);
    let (of_light, kept_lights) = (mem::take(&mut lights.of_light), mem::take(&mut lights.kept));
    let mut tables = tables(scene, bvh, &mut looks, &mut shapes, lights);
    diagnostics.extend(light_groups::own_media(scene, &mut tables.materials));
    tables.set_wavelengths(looks.spectra.table(scene, (&looks.metals, &looks.glasses)));
    lamps_in_media::find(scene, &mut tables, &of_light, &mut diagnostics);
    if scene.settings.integrator == Integrator::Light {
        diagnostics.extend(unfollowed(scene, &tables));
    }
    let mut compiled = CompiledScene {
        tables,
        cameras: scene.cameras.clone(),
        bounds: shapes.bounds,
        diagnostics,
        statistics,
        manifests: Arc::new(Manifests::of(scene)),
        besides: Besides::of(scene),
        casters,
        primvars: looks.names,
        light_images: looks.textures.of_lights,
        spectra: looks.spectra,
        metals: looks.metals,
        glasses: looks.glasses,
        workspaces: previous.map(|p| p.workspaces.clone()).unwrap_or_default(),
        kept: Kept {
            trees: shapes.trees,
            smooth: shapes.smooth,
            diced: diced.map(|diced| diced.kept).unwrap_or_default(),
            displaced: displaced.map(|displaced| displaced.kept).unwrap_or_default(),
            images: looks.textures.kept,
            lights: kept_lights,
            measured: looks.measured,
            fields: looks.fields,
        },
    };
    light_paths_pay::decide(&mut compiled, &complete, &of_light, cancel)?;
    Ok(compiled)
}

/// Lays the lights out, and places those that rays can meet. Shading programs say what surfaces emit.
fn lit(
    scene: &Scene,
    looks: &mut Looks,
    shapes: &mut Shapes,
    kept: &KeptLights,
    cancel: &AtomicBool,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<CompiledLights> {
    let shading = (mem::take(&mut shapes.geometry.table), mem::take(&mut looks.materials), mem::take(&mut looks.textures.table));
    let probe = textured_emission::Probe::new(shading, shapes.origin, cancel)?;
    let lights = lights::compile(scene, &probe, (&looks.textures, &looks.spectra), kept, shapes.origin, diagnostics)?;
    (shapes.geometry.table, looks.materials, looks.textures.table) = probe.into_parts();
    lights.linking.set_masks(&shapes.geometry.table, &mut shapes.geometry.instances);
    shapes.geometry.instances.extend(&lights.instances);
    Ok(lights)
}

fn statistics(scene: &Scene, looks: &Looks, shapes: &Shapes, lights: &CompiledLights) -> CompileStatistics {
    CompileStatistics {
        triangles: scene.meshes.iter().map(|mesh| mesh.triangles.len() as u64).sum(),
        instanced_triangles: instanced_triangles(scene),
        instances: u64::from(shapes.geometry.first_light),
        lights: lights.table.len() as u64,
        segments: shapes.segments,
        points: scene.points.iter().map(|points| points.points.len() as u64).sum(),
        geometry_bytes: (shapes.tree_bytes() + shapes.geometry.table.memory() + looks.materials.media.fields.memory()) as u64,
        texture_bytes: looks.textures.table.bytes() as u64,
        textures_s: looks.textures.seconds,
        build_s: shapes.built.as_secs_f64(),
        total_s: 0.0,
    }
}

/// Tells what renders will leave out.
fn report(scene: &Scene, materials: &MaterialTable, lights: &LightTable, diagnostics: &mut Vec<Diagnostic>) {
    let emits = |number: usize| materials.is_sampled(materials.number(number)) || materials.emits_unknown(number);
    smooth::report_emission(scene, emits, diagnostics);
    whitted::report(scene, materials, lights, diagnostics);
    light_alone::report(scene, materials, lights, diagnostics);
    moving_fields::report(scene, diagnostics);
    materials::media::report(&scene.atmosphere, lights, diagnostics);
}

/// What kernels read; takes it from what was compiled.
fn tables(scene: &Scene, bvh: Tlas, looks: &mut Looks, shapes: &mut Shapes, lights: CompiledLights) -> Tables {
    let (geometry, mut materials) = (mem::take(&mut shapes.geometry.table), mem::take(&mut looks.materials));
    let (first_light_instance, origin) = (shapes.geometry.first_light, shapes.origin);
    fields::place(scene, origin, &mut materials.media.fields);
    materials.media.fields.set_moving(moving_fields::moving(scene, origin));
    let any_absorbing = !materials.media.is_empty()
        || scene.materials.iter().flat_map(|material| &material.closures).any(|closure| closure.input("transmission_depth").is_some());
    let rows = geometry.instances.iter().take(first_light_instance as usize).map(|row| (row.set, row.number, row.mesh));
    let bodies = bodies::of(scene, &shapes.mesh_bounds, rows, (&materials, &lights.table), origin);
    Tables {
        bvh,
        first_light_instance,
        neighbours: shapes.neighbours.take(),
        textures: mem::take(&mut looks.textures.table),
        instance_light: lights.instance_light,
        light_instances: lights.light_instances,
        object_lights: catchers::object_lights(scene, &geometry, &lights.triangle_lights, lights.table.len()),
        triangle_lights: lights.triangle_lights,
        lights: lights.table,
        groups: lights.groups,
        links: lights.linking.tables,
        matte_names: matte_names(scene),
        any_transparent: materials.surfaces.iter().any(|surface| surface.lets_light_pass),
        any_absorbing,
        bodies,
        emission_in_media: Vec::new(),
        wavelengths: None,
        origin,
        geometry,
        materials,
    }
}

/// What placements are called in cryptomattes.
fn matte_names(scene: &Scene) -> MatteNames {
    let run = |name: &MatteName| NameRun { first: name.first, object: matte_id(&name.object), asset: matte_id(&name.asset) };
    MatteNames::new(scene.instances.iter().map(|set| set.names_in_mattes().iter().map(run).collect()))
}

fn instanced_triangles(scene: &Scene) -> u64 {
    let mesh =
        |i: &crate::scene::Instances| scene.meshes.get(geometry_number(scene, i.geometry)).map_or(0, |mesh| mesh.triangles.len() as u64);
    scene.instances.iter().map(|instances| mesh(instances) * instances.transforms.len() as u64).sum()
}

#[cfg(test)]
mod tests;
mod textured_emission;
