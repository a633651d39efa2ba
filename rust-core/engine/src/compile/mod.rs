//! From a scene's description to the tables that kernels read.
//!
//! Meshes whose arrays did not change keep their trees; moving instances rebuilds the top level alone.

mod bodies;
mod bounds;
mod casters;
mod catchers;
mod cut;
mod dice;
mod displace;
mod expressions;
mod fill;
mod filters;
mod geometry;
mod glow;
mod goniograms;
mod instances;
mod kept;
mod light_alone;
mod light_groups;
mod light_images;
pub(crate) mod light_paths_measure;
pub(crate) mod light_paths_pay;
mod lights;
mod linking;
mod luminaires;
mod materials;
mod measured;
mod motion;
mod motion_vectors;
mod numbers;
mod openings;
mod oversized;
mod primvars;
mod quantity;
mod samples;
mod shader_passes;
mod smooth;
mod smooth_primvars;
mod smooth_tables;
mod standard_passes;
mod strand_materials;
mod textures;
mod times;
mod trees;
mod view;
mod whitted;

use numbers::geometry_number;

pub use bounds::Bounds;
pub(crate) use casters::Casters;
pub(crate) use dice::is_diced;
pub use luminaires::luminous_fluxes;
pub(crate) use luminaires::{Luminaire, is_luminaire, luminaires};
pub use view::View;
pub(crate) use view::{check_tiles, picture_view, transport, window};

use crate::{
    accel::{Blas, Tlas},
    error::{Diagnostic, Error, Result},
    film::Besides,
    scene::{Camera, Manifests, MatteName, Scene, matte_id},
    threads::in_pool,
    transport::{MatteNames, NameRun, Tables, Workspaces},
};
use std::{
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Instant,
};

/// A scene laid out for rendering.
#[derive(Debug)]
pub struct CompiledScene {
    /// What the kernels read.
    pub tables: Tables,
    /// The scene's cameras.
    pub cameras: Vec<Camera>,
    /// World bounds of all instances, metres.
    pub bounds: Bounds,
    /// What differs from what was asked for.
    pub diagnostics: Vec<Diagnostic>,
    /// Sizes and times.
    pub statistics: CompileStatistics,
    /// The names in the mattes that the scene's passes show.
    pub(crate) manifests: Arc<Manifests>,
    /// What films of the scene keep besides passes.
    pub(crate) besides: Besides,
    /// What casts caustics.
    pub(crate) casters: Casters,
    /// Names of the primvars in the tables, whose columns follow that of the normals.
    primvars: Vec<String>,
    /// What renders leave for the next.
    pub(crate) workspaces: Arc<Workspaces>,
    trees: Vec<trees::KeptTree>,
    smooth: Vec<smooth::KeptSmooth>,
    diced: Vec<dice::KeptDiced>,
    displaced: Vec<displace::KeptDisplaced>,
    images: kept::KeptImages,
    kept_lights: lights::KeptLights,
    measured: measured::CompiledMeasured,
}

/// Sizes and times of a compiled scene.
#[derive(Clone, Copy, Debug, Default)]
pub struct CompileStatistics {
    /// Triangles of all meshes, each once.
    pub triangles: u64,
    /// Triangles of all instances.
    pub instanced_triangles: u64,
    /// Straight pieces that curves were cut into, all curves once.
    pub segments: u64,
    /// Points with a size, all once.
    pub points: u64,
    /// Instances.
    pub instances: u64,
    /// Lights, triangles of emissive meshes among them.
    pub lights: u64,
    /// Bytes of trees and tables.
    pub geometry_bytes: u64,
    /// Bytes of textures.
    pub texture_bytes: u64,
    /// Seconds spent on textures: reading, decoding, filtering.
    pub textures_s: f64,
    /// Seconds spent on building trees.
    pub build_s: f64,
    /// Seconds spent in all.
    pub total_s: f64,
}

/// Lays a scene out; `previous` lends what did not change. Cancelling gives [`Error::Cancelled`] within a tenth of a second or so.
pub fn compile(scene: &Scene, previous: Option<&CompiledScene>, cancel: &AtomicBool) -> Result<CompiledScene> {
    in_pool(|| laid_out(scene, previous, cancel))
}

fn laid_out(scene: &Scene, previous: Option<&CompiledScene>, cancel: &AtomicBool) -> Result<CompiledScene> {
    let start = Instant::now();
    let complete = standard_passes::complete(scene);
    let scene = complete.as_ref();
    let mut diagnostics = Vec::new();
    let adapted = strand_materials::without_subsurface(scene, &mut diagnostics);
    let scene = adapted.as_ref().unwrap_or(scene);
    let none = (kept::KeptImages::default(), lights::KeptLights::default());
    let (images, kept_lights) = previous.map_or((&none.0, &none.1), |p| (&p.images, &p.kept_lights));
    let diced = dice::apply(scene, previous.map_or(&[], |p| &p.diced), cancel, &mut diagnostics)?;
    let scene = diced.as_ref().map_or(scene, |diced| &diced.scene);
    let mut textures = textures::compile(scene, images, cancel, &mut diagnostics)?;
    let none = measured::CompiledMeasured::default();
    let measured = measured::compile(scene, previous.map_or(&none, |p| &p.measured), &mut diagnostics);
    let names = primvars::used_names(scene, &measured);
    let materials = materials::compile(scene, &textures, &measured, &names, &mut diagnostics)?;
    check(cancel)?;
    let laid = displace::Laid { textures: &textures, materials: &materials, names: &names };
    let displaced = displace::apply(scene, laid, previous.map_or(&[], |p| &p.displaced), cancel, &mut diagnostics)?;
    let scene = displaced.as_ref().map_or(scene, |displaced| &displaced.scene);
    let trees_start = Instant::now();
    let trees = trees::build_trees(scene, previous.map_or(&[], |p| &p.trees), cancel, &mut diagnostics)?;
    let built = trees_start.elapsed();
    let mut cuts = cut::cut_all(scene, &names, &mut diagnostics);
    let segments = cuts.iter().map(|cut| cut.pieces.len() as u64).sum();
    let blurs = times::blurs(&scene.settings);
    let mesh_bounds: Vec<Bounds> = trees.iter().map(|kept| kept.bounds).chain(cuts.iter().map(|cut| smooth::bounds(cut, blurs))).collect();
    let bounds = bounds::of_instances(scene, &mesh_bounds);
    oversized::report(scene, &bounds, &mut diagnostics);
    let origin = bounds.rebase_origin();
    let mut geometry = geometry::tables(scene, &mut cuts, &mesh_bounds, &names, &materials, origin, &mut diagnostics)?;
    let trees_start = Instant::now();
    let smooth = smooth::build(scene, &cuts, &geometry.table, previous.map_or(&[], |p| &p.smooth), cancel)?;
    let built = built + trees_start.elapsed();
    motion::report_cameras(scene, &mut diagnostics);
    motion_vectors::report(scene, &mut diagnostics);
    let neighbours = motion_vectors::neighbours(scene, &cuts, &geometry, origin, &mut diagnostics);
    let shading = (std::mem::take(&mut geometry.table), materials, std::mem::take(&mut textures.table));
    let probe = glow::Probe::new(shading, origin, cancel)?;
    let lights = lights::compile(scene, &probe, &textures, kept_lights, origin, &mut diagnostics)?;
    let materials;
    (geometry.table, materials, textures.table) = probe.into_parts();
    lights.linking.set_masks(&geometry.table, &mut geometry.instances);
    geometry.instances.extend(&lights.instances);
    check(cancel)?;
    drop(cuts);
    let blases: Vec<Arc<Blas>> = trees.iter().map(|kept| &kept.tree).chain(smooth.iter().map(|kept| &kept.tree)).cloned().collect();
    let tree_bytes: usize = blases.iter().map(|tree| tree.memory().bytes()).sum();
    let first_light = geometry.first_light as usize;
    let bvh = Tlas::build_moving(blases, &geometry.instances, &geometry.moving, first_light, cancel).map_err(|_| Error::Cancelled)?;
    let statistics = CompileStatistics {
        triangles: scene.meshes.iter().map(|mesh| mesh.triangles.len() as u64).sum(),
        instanced_triangles: instanced_triangles(scene),
        instances: u64::from(geometry.first_light),
        lights: lights.table.len() as u64,
        segments,
        points: scene.points.iter().map(|points| points.points.len() as u64).sum(),
        geometry_bytes: (tree_bytes + geometry.table.memory()) as u64,
        texture_bytes: textures.table.bytes() as u64,
        textures_s: textures.seconds,
        build_s: built.as_secs_f64(),
        total_s: start.elapsed().as_secs_f64(),
    };
    let any_volume = materials.surfaces.iter().any(|surface| surface.interior.is_some());
    let any_absorbing = any_volume
        || scene.materials.iter().flat_map(|material| &material.closures).any(|closure| closure.input("transmission_depth").is_some());
    let emits = |number: usize| materials.is_sampled(materials.number(number)) || materials.glows_unknown(number);
    smooth::report_emission(scene, emits, &mut diagnostics);
    whitted::report(scene, &materials, &lights.table, &mut diagnostics);
    light_alone::report(scene, &materials, &lights.table, &mut diagnostics);
    let casters = Casters::of(scene, &mesh_bounds, &materials, origin);
    let rows = geometry.table.instances.iter().take(geometry.first_light as usize).map(|row| (row.set, row.number, row.mesh));
    let bodies = bodies::of(scene, &mesh_bounds, rows, &lights.table, origin);
    let any_transparent = materials.surfaces.iter().any(|surface| surface.lets_light_pass);
    let object_lights = catchers::object_lights(scene, &geometry.table, &lights.triangle_lights, lights.table.len());
    let tables = Tables {
        bvh,
        first_light_instance: geometry.first_light,
        geometry: geometry.table,
        neighbours,
        materials,
        textures: textures.table,
        lights: lights.table,
        instance_light: lights.instance_light,
        triangle_lights: lights.triangle_lights,
        light_instances: lights.light_instances,
        object_lights,
        groups: lights.groups,
        links: lights.linking.tables,
        matte_names: matte_names(scene),
        any_transparent,
        any_absorbing,
        any_volume,
        bodies,
        origin,
    };
    let (cameras, manifests) = (scene.cameras.clone(), Arc::new(Manifests::of(scene)));
    let mut compiled = CompiledScene {
        tables,
        cameras,
        bounds,
        diagnostics,
        statistics,
        manifests,
        besides: Besides::of(scene),
        casters,
        primvars: names,
        workspaces: previous.map(|p| p.workspaces.clone()).unwrap_or_default(),
        trees,
        smooth,
        diced: diced.map(|diced| diced.kept).unwrap_or_default(),
        displaced: displaced.map(|displaced| displaced.kept).unwrap_or_default(),
        images: textures.kept,
        kept_lights: lights.kept,
        measured,
    };
    light_paths_pay::decide(&mut compiled, complete.as_ref(), &lights.of_light, cancel)?;
    Ok(compiled)
}

impl CompiledScene {
    /// The column of a primvar in the tables.
    pub(crate) fn primvar_column(&self, name: &str) -> Option<usize> {
        primvars::column(&self.primvars, name)
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

fn check(cancel: &AtomicBool) -> Result<()> {
    if cancel.load(Ordering::Relaxed) { Err(Error::Cancelled) } else { Ok(()) }
}

#[cfg(test)]
mod tests;
