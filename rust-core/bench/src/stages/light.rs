//! One light sampled from points on a floor, by type of light.

use crate::scenes::compiled;
use crate::{
    kernel::{Case, Kernel, Outcome},
    numbers::{BATCH, columns3, cube},
    scenes::{self, aimed, light, place},
};
use gonio::compile::CompiledScene;
use gonio::error::{Error, Result};
use gonio::light::LightSampleContext;
use gonio::scene::{
    Closure, DomeFormat, Goniogram, Light, LightShape, Material, Mesh, Opening, OpeningShape, Origin, Scene, Shaping, Spot, Texture,
    Transform,
};
use gonio::transport::kernels;
use gonio_simd::{Column, Execution, Lanes, SpectrumColumns, Vec3, Wavelengths, dispatch};
use std::sync::{Arc, atomic::AtomicBool};

struct Sampling {
    scene: Arc<CompiledScene>,
    points: [Column; 3],
    numbers: [Column; 3],
    direction: [Column; 3],
    radiance: SpectrumColumns,
    pdf: Column,
}

pub(super) fn cases(cancel: &AtomicBool) -> Result<Vec<Case>> {
    let case = |(name, scene): (&str, Scene)| Ok(Case::new(name, "sample", BATCH, Sampling::new(&scene, cancel)?));
    lights().into_iter().map(case).collect()
}

/// The eight kinds that the paper compares. Its lights of an extent are sums over samples; here one sample is counted, as of all others.
pub(super) fn paper(cancel: &AtomicBool) -> Result<Vec<Case>> {
    let [spot, directed, goniogram] = beams().map(|(_, beam)| Scene { lights: vec![beam], ..Scene::default() });
    let kinds = [
        ("omnidirectional", alone(LightShape::Point)),
        ("spot", spot),
        ("parallel", alone(LightShape::Distant { angle_deg: 0.0 })),
        ("directed", directed),
        ("linear", alone(LightShape::Cylinder { radius: 0.005, length: 1.2 })),
        ("circular", alone(LightShape::Disk { radius: 0.4 })),
        ("rectangular", alone(LightShape::Rectangle { width: 1.0, height: 0.6 })),
        ("with a goniogram", goniogram),
    ];
    kinds.into_iter().map(|(name, scene)| Ok(Case::new(name, "sample", BATCH, Sampling::new(&scene, cancel)?))).collect()
}

/// What is sampled, by name.
fn lights() -> Vec<(&'static str, Scene)> {
    let shapes = [
        ("rectangle", LightShape::Rectangle { width: 1.0, height: 0.6 }),
        ("disk", LightShape::Disk { radius: 0.4 }),
        ("sphere", LightShape::Sphere { radius: 0.3 }),
        ("cylinder", LightShape::Cylinder { radius: 0.1, length: 1.2 }),
        ("facing disk", LightShape::FacingDisk { radius: 0.3 }),
        ("point", LightShape::Point),
        ("distant", LightShape::Distant { angle_deg: 0.53 }),
        ("parallel", LightShape::Distant { angle_deg: 0.0 }),
        ("dome", LightShape::Dome { format: DomeFormat::LatLong }),
    ];
    let mut lights: Vec<_> = shapes.map(|(name, shape)| (name, alone(shape))).into();
    lights.extend(beams().map(|(name, beam)| (name, Scene { lights: vec![beam], ..Scene::default() })));
    lights.extend([
        ("dome with an image", sky()),
        ("triangle", triangle()),
        ("luminaire", luminaire()),
        ("nine lights of five kinds", scenes::room()),
    ]);
    lights
}

/// Points whose intensity depends on the direction: a spot's cone, a power of the cosine, a table.
fn beams() -> [(&'static str, Light); 3] {
    let point = || light(LightShape::Point, 1.0, aimed([0.0, 2.0, 0.0], [0.0; 3]));
    let spot = Spot { angle_deg: 120.0, blend: 0.3, stretch: [1.0; 2] };
    let shaping = Shaping { focus: 4.0, cone_angle_deg: Some(90.0), ..Shaping::default() };
    [
        ("spot", Light { spot: Some(spot), ..point() }),
        ("directed", Light { shaping, ..point() }),
        ("goniogram", Light { goniogram: Some(goniogram()), ..point() }),
    ]
}

/// One light two metres above the floor, facing it.
fn alone(shape: LightShape) -> Scene {
    Scene { lights: vec![light(shape, 1.0, aimed([0.0, 2.0, 0.0], [0.0; 3]))], ..Scene::default() }
}

/// A dome with the image of a sky.
fn sky() -> Scene {
    let mut scene = Scene::default();
    let texture = Texture { origin: Origin::new("sky"), source: scenes::sky(256, 128), colour_space: "raw".into() };
    let dome = light(LightShape::Dome { format: DomeFormat::LatLong }, 1.0, Transform::IDENTITY);
    let texture = Some(scene.add_texture(texture));
    scene.lights.push(Light { texture, ..dome });
    scene
}

/// Intensities to all sides, by planes of 15° and polar angles of 5°.
fn goniogram() -> Arc<Goniogram> {
    let horizontal_deg: Vec<f32> = (0..=24).map(|plane| 15.0 * plane as f32).collect();
    let vertical_deg: Vec<f32> = (0..=36).map(|angle| 5.0 * angle as f32).collect();
    // One value at each pole, whatever the plane.
    let factor = |plane: f32, angle: f32| 120.0 + 80.0 * angle.to_radians().sin() * plane.to_radians().cos();
    let factors = horizontal_deg.iter().flat_map(|plane| vertical_deg.iter().map(move |angle| factor(*plane, *angle))).collect();
    Arc::new(Goniogram { horizontal_deg, vertical_deg, factors, ..Goniogram::default() })
}

/// A box of a luminaire that shines so.
fn luminaire() -> Scene {
    let shape = LightShape::Opening(Opening::new(OpeningShape::Box, [1.2, 0.3, 0.1]));
    let plain = light(shape, 1.0, aimed([0.0, 2.0, 0.0], [0.0; 3]));
    Scene { lights: vec![Light { goniogram: Some(goniogram()), ..plain }], ..Scene::default() }
}

/// An emissive triangle, its front down.
fn triangle() -> Scene {
    let mut scene = Scene::default();
    let points = Arc::from([[-0.5, 2.0, -0.4], [0.5, 2.0, -0.4], [0.0, 2.0, 0.5]]);
    let mesh = Mesh { points, triangles: Arc::from([[0, 1, 2]]), ..Mesh::default() };
    let mut glow = Closure::default();
    glow.set_colour("emission_color", [1.0; 3]);
    place(&mut scene, mesh, Material::of(Origin::new("glow"), glow), Transform::IDENTITY);
    scene
}

#[inline(always)]
fn sample<L: Lanes>(l: L, job: &mut Sampling) {
    let Sampling { scene, points: [x, y, z], numbers: [u, v, w], direction: [dx, dy, dz], radiance, pdf } = job;
    let up = Vec3::splat(l, [0.0, 1.0, 0.0]);
    for at in (0..BATCH).step_by(L::COUNT) {
        let point = Vec3::load(l, [x, y, z], at);
        let from = LightSampleContext { position: point, normal: up, receiver: l.u(0) };
        let sample = kernels::sample_li(l, &scene.tables, None, &from, &[l.load(u, at), l.load(v, at), l.load(w, at)]);
        sample.wi.store([dx, dy, dz], at);
        radiance.store(Wavelengths::rgb(l).radiance(sample.radiance), at);
        sample.pdf.store(pdf, at);
    }
}

impl Sampling {
    /// Of a scene's lights, from places on its floor.
    fn new(scene: &Scene, cancel: &AtomicBool) -> Result<Self> {
        let (scene, numbers, mut points) = (compiled(scene, cancel)?, cube(), columns3());
        let origin = scene.tables.origin;
        for i in 0..BATCH {
            let place = [4.0 * numbers[0][i] - 2.0, 0.0, 4.0 * numbers[2][i] - 2.0];
            for (axis, column) in points.iter_mut().enumerate() {
                column[i] = (f64::from(place[axis]) - origin[axis]) as f32;
            }
        }
        let mut kernel =
            Self { scene, points, numbers, direction: columns3(), radiance: SpectrumColumns::new(BATCH), pdf: Column::new(BATCH) };
        kernel.run(Execution::best())?;
        let lit = kernel.pdf.iter().filter(|pdf| **pdf > 0.0).count();
        if lit > BATCH / 2 {
            Ok(kernel)
        } else {
            Err(Error::Internal(format!("{lit} of {BATCH} samples bring light: nothing is measured")))
        }
    }
}

impl Kernel for Sampling {
    fn run(&mut self, execution: Execution) -> Result<()> {
        dispatch!(execution, l => sample(l, self));
        Ok(())
    }
    fn outcome(&self) -> Outcome {
        Outcome::of(self.direction.iter().chain(self.radiance.columns()).chain([&self.pdf]).map(|column| &column[..]))
    }
}
