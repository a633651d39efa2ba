//! Surfaces by lobe: from parameters to lobes, sampling (with evaluation and density at the sample), evaluation alone.

use crate::{
    kernel::{Case, Kernel, Outcome, ROUNDING},
    numbers::{BATCH, cube, cube_of},
    scenes,
};
use gonio::bsdf::{Closure, Distribution, Hits, Lobes, MeasuredBsdf, ParameterValues, Surface, Switches, parameter as p};
use gonio::error::Result;
use gonio::transport::kernels;
use gonio_simd::{Column, Execution, Lanes, Spectrum, SpectrumColumns, Vec3, dispatch};
use std::sync::Arc;

/// The view of sampling and evaluation: 40 degrees off the normal.
const VIEW: [f32; 3] = [0.642_787_6, 0.0, 0.766_044_45];

/// What is done with the surface.
#[derive(Clone, Copy)]
enum Task {
    Resolve,
    Sample,
    Evaluate,
}

struct Shading {
    surface: Surface,
    task: Task,
    numbers: [Column; 3],
    /// Unit vectors over the upper hemisphere.
    directions: [Column; 3],
    light: SpectrumColumns,
    pdf: Column,
}

/// Named surfaces.
fn surfaces() -> Vec<(&'static str, Surface)> {
    let glossy = |distribution| Switches { distribution, ..Switches::single(Closure::Glossy) };
    let rough: (usize, &[f32]) = (p::ROUGHNESS, &[0.4]);
    vec![
        ("lambert", surface(Switches::single(Closure::Diffuse), &[])),
        ("rough diffuse", surface(Switches::single(Closure::Diffuse), &[(p::DIFFUSE_ROUGHNESS, &[0.7])])),
        ("GGX", surface(glossy(Distribution::Ggx), &[rough])),
        ("multiple-scattering GGX", surface(glossy(Distribution::MultiGgx), &[rough])),
        ("Beckmann", surface(glossy(Distribution::Beckmann), &[rough])),
        ("glass", surface(Switches { distribution: Distribution::Ggx, ..Switches::single(Closure::Glass) }, &[rough])),
        ("fuzz", surface(Switches::single(Closure::Sheen), &[])),
        ("toon", surface(Switches::single(Closure::DiffuseToon), &[])),
        ("hair", surface(Switches::single(Closure::Hair), &[])),
        ("elliptic hair", surface(Switches::single(Closure::HairElliptic), &[(p::ROUGHNESS, &[0.55]), (p::HAIR_ASPECT, &[0.85])])),
        ("plastic", surface(Switches::default(), &[rough])),
        (
            "coated metal and plastic",
            surface(
                Switches::default(),
                &[rough, (p::METALNESS, &[0.5]), (p::COAT_WEIGHT, &[1.0]), (p::COAT_ROUGHNESS, &[0.1]), (p::COAT_COLOR, &[0.9, 0.6, 0.4])],
            ),
        ),
    ]
}

fn surface(switches: Switches, values: &[(usize, &[f32])]) -> Surface {
    let mut constants = p::DEFAULTS;
    for (offset, value) in values {
        constants[*offset..offset + value.len()].copy_from_slice(value);
    }
    Surface::new(constants, &[false; p::COUNT], switches)
}

pub(super) fn cases() -> Vec<Case> {
    let case = |name: &str, surface: &Surface, task: Task, what: &str| {
        let kernel = Shading {
            surface: surface.clone(),
            task,
            numbers: cube(),
            directions: directions(BATCH),
            light: SpectrumColumns::new(BATCH),
            pdf: Column::new(BATCH),
        };
        Case::new(format!("{name}: {what}"), "hit", BATCH, kernel)
    };
    let mut surfaces = surfaces();
    let measured = scenes::table().and_then(|table| MeasuredBsdf::new(&table).ok()).map(Arc::new);
    if let Some(measured) = &measured {
        surfaces.push((
            "17 × 7 × 17 × 13 table",
            Surface::measured(p::DEFAULTS, &[false; p::COUNT], Switches::single(Closure::Measured), measured.clone()),
        ));
    }
    let tasks = [(Task::Resolve, "resolve"), (Task::Sample, "sample + eval + pdf"), (Task::Evaluate, "eval + pdf")];
    let mut cases: Vec<Case> =
        surfaces.iter().flat_map(|(name, surface)| tasks.map(|(task, what)| case(name, surface, task, what))).collect();
    if let Some(measured) = measured {
        cases.push(Case::new("17 × 7 × 17 × 13 table: lookup", "lookup", BATCH, Lookup::new(measured, BATCH)));
    }
    cases
}

/// So many lookups in the paper's table, each of directions of its own.
pub(super) fn lookups(counts: &[usize]) -> Vec<Case> {
    let Some(measured) = scenes::table().and_then(|table| MeasuredBsdf::new(&table).ok()).map(Arc::new) else { return Vec::new() };
    counts.iter().map(|count| Case::new(format!("{count} calls"), "call", *count, Lookup::new(measured.clone(), *count))).collect()
}

/// Directions all over the hemisphere about +z, by equal solid angles.
fn directions(count: usize) -> [Column; 3] {
    let [u, v, _] = cube_of(count);
    let mut directions = [Column::new(count), Column::new(count), Column::new(count)];
    for i in 0..count {
        let (z, turn) = (0.02 + 0.98 * u[i], v[i] * std::f32::consts::TAU);
        let ring = (1.0 - z * z).max(0.0).sqrt();
        (directions[0][i], directions[1][i], directions[2][i]) = (ring * turn.cos(), ring * turn.sin(), z);
    }
    directions
}

/// The same in another order.
fn views(count: usize) -> [Column; 3] {
    let mut views = directions(count);
    views.iter_mut().for_each(|column| column.rotate_left(count / 3));
    views
}

/// The BSDF between pairs of directions all over the hemisphere, from a table: search and interpolation alone.
struct Lookup {
    measured: Arc<MeasuredBsdf>,
    directions: [Column; 3],
    views: [Column; 3],
    colour: [Column; 3],
}

impl Lookup {
    fn new(measured: Arc<MeasuredBsdf>, count: usize) -> Self {
        let colour = [Column::new(count), Column::new(count), Column::new(count)];
        Self { measured, directions: directions(count), views: views(count), colour }
    }
}

#[inline(always)]
fn look_up<L: Lanes>(l: L, job: &mut Lookup) {
    let Lookup { measured, directions: [x, y, z], views: [a, b, c], colour: [red, green, blue] } = job;
    for at in (0..x.len()).step_by(L::COUNT) {
        let (wi, wo) = (Vec3::load(l, [&x[..], &y[..], &z[..]], at), Vec3::load(l, [&a[..], &b[..], &c[..]], at));
        measured.reflected(l, wi, wo).store([red, green, blue], at);
    }
}

impl Kernel for Lookup {
    fn run(&mut self, execution: Execution) -> Result<()> {
        dispatch!(execution, l => look_up(l, self));
        Ok(())
    }
    fn outcome(&self) -> Outcome {
        Outcome::of(self.colour.iter().map(|column| &column[..]))
    }
}

#[inline(always)]
fn shade<L: Lanes>(l: L, job: &mut Shading) {
    match job.task {
        Task::Resolve => resolve(l, job),
        Task::Sample => sample(l, job),
        Task::Evaluate => evaluate(l, job),
    }
}

#[inline(always)]
fn resolve<L: Lanes>(l: L, job: &mut Shading) {
    let Shading { surface, directions: [x, y, z], light, .. } = job;
    let values = ParameterValues::constant(&surface.constants);
    let mut lobes = Lobes::empty(l);
    for at in (0..BATCH).step_by(L::COUNT) {
        let wo = Vec3::load(l, [&x[..], &y[..], &z[..]], at);
        surface.resolve(
            l,
            &Hits { values: &values, at: 0, wo, entering: l.m(true), normals: None, walks: true, carried: None, numbers: None },
            &mut lobes,
        );
        light.store(lobes.albedo(), at);
    }
}

#[inline(always)]
fn sample<L: Lanes>(l: L, job: &mut Shading) {
    let Shading { surface, numbers: [u, v, w], light, pdf, .. } = job;
    let (values, wo) = (ParameterValues::constant(&surface.constants), Vec3::splat(l, VIEW));
    let mut lobes = Lobes::empty(l);
    surface.resolve(
        l,
        &Hits { values: &values, at: 0, wo, entering: l.m(true), normals: None, walks: true, carried: None, numbers: None },
        &mut lobes,
    );
    for at in (0..BATCH).step_by(L::COUNT) {
        let sample = kernels::sample(l, &lobes, wo, [l.load(u, at), l.load(v, at), l.load(w, at)]);
        // The value goes with the direction, so that each is computed and shows in the outcome.
        let wi = sample.wi;
        light.store(sample.value + Spectrum::constant(wi.x + wi.y + wi.z), at);
        sample.pdf.min(1e3).store(pdf, at);
    }
}

#[inline(always)]
fn evaluate<L: Lanes>(l: L, job: &mut Shading) {
    let Shading { surface, directions: [x, y, z], light, pdf, .. } = job;
    let (values, wo) = (ParameterValues::constant(&surface.constants), Vec3::splat(l, VIEW));
    let mut lobes = Lobes::empty(l);
    surface.resolve(
        l,
        &Hits { values: &values, at: 0, wo, entering: l.m(true), normals: None, walks: true, carried: None, numbers: None },
        &mut lobes,
    );
    for at in (0..BATCH).step_by(L::COUNT) {
        let (value, density) = lobes.eval(l, wo, Vec3::load(l, [&x[..], &y[..], &z[..]], at));
        light.store(value, at);
        density.store(pdf, at);
    }
}

impl Kernel for Shading {
    fn run(&mut self, execution: Execution) -> Result<()> {
        dispatch!(execution, l => shade(l, self));
        Ok(())
    }
    fn outcome(&self) -> Outcome {
        let outcome = Outcome::of(self.light.columns().iter().chain([&self.pdf]).map(|column| &column[..]));
        // A way inside may end at total reflection by rounding: some hits of the batch then have other light.
        let tolerance = if self.surface.lobes.drawn { 20.0 * ROUNDING } else { outcome.tolerance };
        Outcome { tolerance, ..outcome }
    }
}
