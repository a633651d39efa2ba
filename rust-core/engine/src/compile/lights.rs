//! Lights as records, and the shapes of those that rays can meet.

use super::{
    filters::CompiledFilters,
    geometry::slots_of,
    goniograms::CompiledGoniograms,
    instances::{rebased, rows},
    light_groups::GroupNames,
    linking::CompiledLinking,
    motion,
    numbers::geometry_number,
    openings::{self, Part},
    quantity::{self, FarFields},
    textured_emission::{Mean, Probe},
    textures::CompiledTextures,
    wavelengths::LampSpectra,
};
use crate::{
    accel::{Geometry, Instance, RayMask, Shape},
    error::{Diagnostic, Result},
    geometry::NONE,
    light::{Falloff, Goniogram, LightKind, LightLinks, LightRecord, LightTable, LightTexture, Shaping, Spot, size_factor},
    scene::{self, Light, LightShape, Mesh, Scene, Transform, Visibility},
    transport::{LightGroups, Tables, ray_mask},
};
use std::sync::Arc;

/// Emissive triangles beyond this many are found by scattered rays alone: a table of more would cost more than it saves.
pub(super) const MOST_EMISSIVE_TRIANGLES: usize = 200_000;

/// The most that light off the axis may be of that along it.
const MOST_TINT: f32 = 1e3;

/// A light table and what it was laid out from.
#[derive(Clone, Debug, Default)]
pub(super) struct KeptLights {
    records: Vec<LightRecord>,
    images: Vec<Arc<LightTexture>>,
    goniograms: CompiledGoniograms,
    links: Option<LightLinks>,
    filters: CompiledFilters,
    table: Option<Arc<LightTable>>,
}

impl KeptLights {
    /// The lights as they stand in the table.
    pub(super) fn records(&self) -> &[LightRecord] {
        &self.records
    }
    /// Images on domes and rectangles.
    pub(super) fn images(&self) -> &[Arc<LightTexture>] {
        &self.images
    }

    /// The table of these lights: the one at hand if nothing differs, for images are slow to lay out.
    fn table(
        &self,
        records: &[LightRecord],
        images: &[Arc<LightTexture>],
        goniograms: &CompiledGoniograms,
        links: &Option<LightLinks>,
        filters: &CompiledFilters,
    ) -> Arc<LightTable> {
        let same_images = self.images.len() == images.len() && self.images.iter().zip(images).all(|(a, b)| Arc::ptr_eq(a, b));
        let same_filters = self.filters.is_of_same(filters);
        match &self.table {
            Some(table)
                if same_images
                    && same_filters
                    && self.goniograms.is_of_same(goniograms)
                    && self.records == records
                    && self.links == *links =>
            {
                table.clone()
            }
            _ => {
                let table = LightTable::build(records, images, &goniograms.tables);
                let table = if filters.gates.is_empty() { table } else { table.with_filters(&filters.gates, &filters.numbers) };
                Arc::new(match links {
                    Some(links) => table.with_links(links.clone()),
                    None => table,
                })
            }
        }
    }
}

/// The light table and what belongs to it.
#[derive(Debug)]
pub(super) struct CompiledLights {
    pub(super) table: Arc<LightTable>,
    /// For the next compilation.
    pub(super) kept: KeptLights,
    pub(super) instances: Vec<Instance>,
    pub(super) instance_light: Vec<u32>,
    /// Lights of the scene that the first lights of the table belong to; the others are triangles.
    pub(super) of_light: Vec<u32>,
    pub(super) triangle_lights: Vec<u32>,
    /// The first triangle among the lights, and the instance of each from there on.
    pub(super) light_instances: (u32, Vec<u32>),
    pub(super) groups: LightGroups,
    pub(super) linking: CompiledLinking,
}

/// Lays out the scene's lights, then the triangles of emissive meshes.
pub(super) fn compile(
    scene: &Scene,
    probe: &Probe<'_>,
    (textures, spectra): (&CompiledTextures, &LampSpectra),
    previous: &KeptLights,
    origin: [f64; 3],
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<CompiledLights> {
    let geometry = &probe.tables.geometry;
    let mut records = Vec::new();
    let mut instances = Vec::new();
    let mut instance_light = Vec::new();
    let mut goniograms = CompiledGoniograms::default();
    let mut far_fields = FarFields::default();
    let mut groups = GroupNames::default();
    let mut light_of = Vec::new();
    let mut filters = CompiledFilters::default();
    for (number, light) in scene.lights.iter().enumerate() {
        let coloured = spectra.coloured(number, light);
        let light = coloured.as_ref().unwrap_or(light);
        let goniogram = goniograms.number(light, diagnostics);
        report_unused(light, kind(light.shape), diagnostics);
        let group = groups.number(&light.group);
        for (light, share) in motion::lamps(light, &scene.settings, diagnostics) {
            let first = records.len();
            let parts = emitters(&light, origin, goniogram.and_then(|number| goniograms.tables.get(number as usize)));
            for part in &parts {
                let plain = record(&light, part, textures.of_lights.numbers[number], diagnostics);
                records.push(LightRecord { goniogram, ..plain });
            }
            groups.of_light.resize(records.len(), group);
            filters.add(&light, &rebased(&light.transform, origin), records.len(), diagnostics);
            quantity::apply(&light, &mut records[first..], &mut goniograms, &mut far_fields, diagnostics);
            if share < 1.0 {
                records[first..].iter_mut().for_each(|record| record.radiance = record.radiance.map(|x| x * share));
            }
            // Rays pass lamps one after the other: those that send nothing are not worth meeting.
            let shining = parts.iter().zip(first..).filter(|(_, number)| records[*number].radiance != [0.0; 3]);
            for (instance, number) in shining.filter_map(|(part, number)| Some((shape_instance(&light, part)?, number))) {
                instance_light.push(number as u32);
                instances.push(instance);
            }
        }
        light_of.resize(records.len(), number as u32);
    }
    if scene.atmosphere.ends_light() {
        // Who sampled them would find nothing.
        records.iter_mut().filter(|record| record.kind.is_infinite()).for_each(|record| record.visible_to_scattered = false);
    }
    instance_light.push(0);
    let first_triangle = records.len() as u32;
    let triangle_lights = emissive_triangles(scene, probe, origin, &mut records, diagnostics)?;
    let light_instances = (first_triangle, instances_of(&triangle_lights, records.len() - first_triangle as usize, first_triangle));
    let groups = groups.with_instances(scene, geometry, &triangle_lights, records.len());
    let images = textures.of_lights.images.clone();
    let (linking, links) = CompiledLinking::new(scene, geometry, &light_of, &triangle_lights, &mut records, diagnostics);
    let table = previous.table(&records, &images, &goniograms, &links, &filters);
    let kept = KeptLights { records, images, goniograms, links, filters, table: Some(table.clone()) };
    let mut table = table;
    spectra.set(&mut table, &light_of, |light| {
        let instance = light_instances.1[light - first_triangle as usize];
        let material = geometry.material(instance, light as u32 - triangle_lights[instance as usize]);
        // What programs know has its spectrum already.
        if kept.records[light].shaded { 0 } else { probe.tables.materials.spectrum(material) }
    });
    Ok(CompiledLights { table, kept, instances, instance_light, of_light: light_of, triangle_lights, light_instances, groups, linking })
}

/// The instance of each light that is a triangle, by the first light of each instance.
fn instances_of(triangle_lights: &[u32], count: usize, first_triangle: u32) -> Vec<u32> {
    let (mut instances, mut last) = (Vec::with_capacity(count), 0);
    for (instance, first) in triangle_lights.iter().enumerate().filter(|(_, first)| **first != NONE) {
        instances.resize((first - first_triangle) as usize, last);
        last = instance as u32;
    }
    instances.resize(count, last);
    instances
}

/// What the light is made of, in the rebased world.
pub(super) fn emitters(light: &Light, origin: [f64; 3], goniogram: Option<&Arc<Goniogram>>) -> Vec<Part> {
    match &light.shape {
        LightShape::Opening(opening) => openings::parts(opening, &rebased(&light.transform, origin), goniogram.map(|table| &**table)),
        shape => vec![Part { kind: kind(*shape), placed: rebased(&sized(light), origin), opening: None }],
    }
}

/// The light's map with its size in the axes: half sides, radii, half length.
pub(super) fn sized(light: &Light) -> Transform {
    let [x, y, z] = match light.shape {
        LightShape::Rectangle { width, height } => [0.5 * width, 0.5 * height, 1.0],
        LightShape::Disk { radius } => [radius, radius, 1.0],
        LightShape::Ellipse { width, height } => [0.5 * width, 0.5 * height, 1.0],
        LightShape::Sphere { radius } | LightShape::FacingDisk { radius } => [radius; 3],
        LightShape::Cylinder { radius, length } => [0.5 * length, radius, radius],
        LightShape::Point | LightShape::Opening(_) | LightShape::Distant { .. } | LightShape::Dome { .. } => [1.0; 3],
    };
    let mut transform = light.transform;
    for (column, size) in transform.columns.iter_mut().zip([x, y, z]) {
        column.iter_mut().for_each(|value| *value *= size);
    }
    transform
}

fn kind(shape: LightShape) -> LightKind {
    match shape {
        LightShape::Rectangle { .. } => LightKind::Rectangle,
        LightShape::Disk { .. } | LightShape::Ellipse { .. } => LightKind::Disk,
        LightShape::Sphere { .. } => LightKind::Sphere,
        LightShape::FacingDisk { .. } => LightKind::FacingDisk,
        LightShape::Point | LightShape::Opening(_) => LightKind::Point,
        LightShape::Cylinder { .. } => LightKind::Cylinder,
        LightShape::Distant { .. } => LightKind::Distant,
        LightShape::Dome { .. } => LightKind::Dome,
    }
}

/// One emitter of a light, which wants its goniogram yet.
pub(super) fn record(light: &Light, part: &Part, texture: Option<u32>, diagnostics: &mut Vec<Diagnostic>) -> LightRecord {
    let (kind, placed) = (part.kind, &part.placed);
    let angle = if let LightShape::Distant { angle_deg } = light.shape { angle_deg.to_radians() } else { 0.0 };
    let mut radiance = light.emission.radiance;
    if light.emission.normalized && light.quantity.is_none() && part.opening.is_none() {
        // The factor is an area in the stage's own units.
        let units = placed.columns.map(|column| column.map(|x| x / light.emission.metres_per_unit));
        let factor = size_factor(kind, [units[0], units[1], units[2]], angle);
        if factor > 0.0 {
            radiance = radiance.map(|x| (f64::from(x) / factor) as f32);
        } else {
            diagnostics.push(Diagnostic::warning(&light.origin, "the light has no extent to normalize by; it stays dark"));
            radiance = [0.0; 3];
        }
    }
    let (shaping, scattered) = (&light.shaping, scattered(light));
    LightRecord {
        to_world: placed.columns.map(|column| column.map(|x| x as f32)),
        radiance,
        shaping: Shaping {
            cone_angle: shaping.cone_angle_deg.map_or(f32::INFINITY, f32::to_radians),
            softness: shaping.cone_softness,
            focus: shaping.focus,
            focus_tint: shaping.focus_tint.map(|x| x.clamp(0.0, MOST_TINT)).map(finite),
        },
        spot: light.spot.map(|spot| Spot { angle: spot.angle_deg.to_radians(), blend: spot.blend, stretch: spot.stretch }),
        spread: if light.spread_deg < 180.0 { light.spread_deg.to_radians() } else { std::f32::consts::PI },
        portal: light.portal,
        texture,
        angle: angle as f32,
        visible_to_camera: light.visibility.camera,
        visible_to_scattered: light.visibility.scattered(),
        sampled_alone: scattered.iter().any(|factor| *factor != 0.0 && *factor != 1.0),
        scattered,
        falloff: falloff(light, diagnostics),
        casts_shadow: light.casts_shadow,
        opening: part.opening,
        ..LightRecord::new(kind)
    }
}

fn finite(value: f32) -> f32 {
    if value.is_finite() { value } else { 0.0 }
}

/// How a light falls with distance.
fn falloff(light: &Light, diagnostics: &mut Vec<Diagnostic>) -> Falloff {
    let scene::Falloff { power, smooth } = light.falloff;
    if power <= 2 && smooth.is_finite() && smooth >= 0.0 {
        return Falloff { power, smooth };
    }
    let problem =
        format!("its falloff has the power {power} and is smoothed by {smooth}, expected 0, 1 or 2, and 0 m² or more; it falls by nature");
    diagnostics.push(Diagnostic::warning(&light.origin, problem));
    Falloff::NATURAL
}

/// Factors on what is scattered of a light.
fn scattered(light: &Light) -> [f32; 4] {
    let factor = |x: f32| if x.is_finite() { x.max(0.0) } else { 1.0 };
    let [diffuse, glossy, transmitted, volume] = seen_by(&light.visibility);
    [diffuse * factor(light.diffuse), glossy * factor(light.specular), transmitted * factor(light.specular), volume * factor(light.volume)]
}

/// 0 for the kinds of scattered rays that do not see what others see.
fn seen_by(visibility: &Visibility) -> [f32; 4] {
    let Visibility { diffuse, glossy, transmission, volume, .. } = *visibility;
    [diffuse, glossy, transmission, volume].map(|seen| if seen || !visibility.scattered() { 1.0 } else { 0.0 })
}

/// Says what this kind of light has no use for.
fn report_unused(light: &Light, kind: LightKind, diagnostics: &mut Vec<Diagnostic>) {
    let mut warn = |message: &str| diagnostics.push(Diagnostic::warning(&light.origin, message));
    if light.portal && kind != LightKind::Rectangle {
        warn("only rectangles can be portals; the light is left out");
    }
    if light.spread_deg < 180.0 && !kind.is_flat() {
        warn("only rectangles, disks and ellipses have a spread; it is ignored");
    }
    if light.shaping.focus_tint.iter().any(|x| !(0.0..=MOST_TINT).contains(x)) {
        warn(&format!("its focus tint is {:?}, outside 0 to {MOST_TINT}; it is held there", light.shaping.focus_tint));
    }
    if light.goniogram.is_some() && kind.is_infinite() {
        warn("lights at infinity have no goniogram; it is ignored");
    }
    if light.spot.is_some() && kind.is_infinite() {
        warn("lights at infinity have no spot cone; it is ignored");
    }
}

/// An emitter's shape for the tree: scattered rays find every light, camera rays those that are visible.
fn shape_instance(light: &Light, part: &Part) -> Option<Instance> {
    if light.portal {
        return None;
    }
    let mut transform = part.placed;
    let mut double = |axis: usize| transform.columns[axis].iter_mut().for_each(|x| *x *= 2.0);
    let shape = match part.kind {
        LightKind::Rectangle => {
            double(0);
            double(1);
            Shape::Rectangle
        }
        LightKind::Disk => Shape::Disk,
        LightKind::Sphere => Shape::Sphere,
        // Rays that meet the disk meet this sphere, and the light's density tells them from the others.
        LightKind::FacingDisk => {
            let radius = transform.columns[0].iter().map(|x| x * x).sum::<f64>().sqrt();
            transform.columns[..3].copy_from_slice(&Transform::scale(radius).columns[..3]);
            Shape::Sphere
        }
        LightKind::Cylinder => {
            double(0);
            Shape::Cylinder
        }
        LightKind::Point | LightKind::Distant | LightKind::Dome | LightKind::Triangle => return None,
    };
    let seen = |visible: bool, bit: RayMask| if visible { bit } else { 0 };
    let visibility = light.visibility;
    let mask = seen(visibility.camera, ray_mask::CAMERA)
        | seen(visibility.diffuse, ray_mask::DIFFUSE)
        | seen(visibility.glossy, ray_mask::GLOSSY)
        | seen(visibility.transmission, ray_mask::TRANSMISSION)
        | seen(visibility.volume, ray_mask::VOLUME)
        | seen(visibility.scattered(), ray_mask::CATCHER_SCATTERED);
    Some(Instance { geometry: Geometry::Shape(shape), object_to_world: rows(&transform), mask, transparent: false })
}

/// Adds a light for each triangle of meshes with a material that emits; gives the first light of each instance.
fn emissive_triangles(
    scene: &Scene,
    probe: &Probe<'_>,
    origin: [f64; 3],
    records: &mut Vec<LightRecord>,
    diagnostics: &mut Vec<Diagnostic>,
) -> Result<Vec<u32>> {
    let Tables { geometry, materials, .. } = &probe.tables;
    if !(0..materials.numbers.len()).any(|material| materials.is_sampled(materials.number(material))) {
        return Ok(Vec::new());
    }
    let mut first_light = Vec::with_capacity(geometry.instances.len());
    let mut number = 0;
    for group in &scene.instances {
        if group.geometry.mesh().is_none() && geometry_number(scene, group.geometry) != usize::MAX {
            // Curves and points shine too, but rays alone find them.
            first_light.resize(first_light.len() + group.transforms.len(), NONE);
            number += group.transforms.len() as u32;
            continue;
        }
        let Some(mesh) = scene.meshes.get(geometry_number(scene, group.geometry)).filter(|_| !group.transforms.is_empty()) else {
            continue;
        };
        // Placements of a set have the same materials.
        let first = geometry.instances[number as usize].first_material as usize;
        let emits = geometry.materials[first..first + slots_of(mesh)].iter().any(|m| materials.is_sampled(*m));
        let moves = motion::moves(group, &scene.settings) || motion::deforms(mesh, &scene.settings);
        if emits && moves {
            let message = "it shines and moves; its light is found by chance, without light sampling";
            diagnostics.push(Diagnostic::info(&group.origin, message));
        }
        let all = records.len() + mesh.triangles.len() * group.transforms.len();
        if emits && !moves && all > MOST_EMISSIVE_TRIANGLES {
            let message = format!(
                "it shines with more than {MOST_EMISSIVE_TRIANGLES} triangles, with those before it; light of what is beyond is found by chance, \
                 without light sampling"
            );
            diagnostics.push(Diagnostic::info(&group.origin, message));
        }
        for transform in &group.transforms {
            let fits = !moves && records.len() + mesh.triangles.len() <= MOST_EMISSIVE_TRIANGLES;
            if emits && fits && group.visibility.diffuse {
                first_light.push(records.len() as u32);
                let placed = rebased(transform, origin);
                let scattered = seen_by(&group.visibility);
                let emission = |triangle: usize| materials.even_emission(geometry.material(number, triangle as u32));
                let record = |t: usize| LightRecord { scattered, ..triangle_record(mesh, t, &placed, emission(t)) };
                let first = records.len();
                records.extend((0..mesh.triangles.len()).map(record));
                shade(probe, number, &mut records[first..])?;
            } else {
                first_light.push(NONE);
            }
            number += 1;
        }
    }
    if first_light.iter().all(|first| *first == NONE) {
        first_light.clear();
    }
    Ok(first_light)
}

/// Gives the triangles of an instance that programs know their means.
fn shade(probe: &Probe<'_>, instance: u32, records: &mut [LightRecord]) -> Result<()> {
    let normals: Vec<[f32; 3]> = records.iter().map(|record| record.to_world[2].map(|x| -x)).collect();
    for (record, mean) in records.iter_mut().zip(probe.means(instance, &normals)?) {
        if let Some(Mean { luminance, two_sided }) = mean {
            *record = LightRecord { radiance: [luminance; 3], shaded: true, two_sided, ..*record };
        }
    }
    Ok(())
}

fn triangle_record(mesh: &Mesh, triangle: usize, placed: &Transform, emission: Option<[f32; 3]>) -> LightRecord {
    let corners = mesh.triangles[triangle].map(|i| mesh.points.get(i as usize).map_or([0.0; 3], |p| placed.point(p.map(f64::from))));
    let edge = |i: usize| -> [f32; 3] { std::array::from_fn(|k| (corners[i][k] - corners[0][k]) as f32) };
    let (x, y) = (edge(1), edge(2));
    let z = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]].map(|c| -c);
    LightRecord {
        to_world: [x, y, z, corners[0].map(|c| c as f32)],
        radiance: emission.unwrap_or_default(),
        two_sided: true,
        ..LightRecord::new(LightKind::Triangle)
    }
}
