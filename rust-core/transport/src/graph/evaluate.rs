//! Running a program over a chunk of hits.

use super::{
    CHUNK, GraphScratch, OutputColumns, Program, Source, Step, SurfaceColumns,
    arithmetic::arithmetic,
    columns::load3,
    normals::{bend_normals, normal_map},
    shading::{Place, hit_value, instance_transform, matrix_transform},
    vector::vector,
};
use crate::geometry::GeometryTable;
use gonio_image::texture::TextureTable;
use gonio_simd::{F, Lanes, PADDING, Vec2, Vec3};

/// Runs a program over the first `count` hits of a chunk: fills `outputs`, and bends the shading normals if it says so.
#[expect(clippy::too_many_arguments, reason = "tables, hits, scratch and results")]
#[inline(always)]
pub fn evaluate<L: Lanes>(
    l: L,
    program: &Program,
    geometry: &GeometryTable,
    textures: &TextureTable,
    points: &mut SurfaceColumns,
    count: usize,
    scratch: &mut GraphScratch,
    outputs: &mut OutputColumns,
) {
    scratch.registers.resize(program.steps.len() * 4 * PADDING, 0.0);
    let places = program.outputs.iter().map(|output| output.width).sum::<usize>();
    outputs.values.resize(places * CHUNK, 0.0);
    for at in (0..count).step_by(L::COUNT) {
        run_steps(l, program, geometry, textures, points, at, &mut scratch.registers);
        let mut place = 0;
        for output in &program.outputs {
            let value = read(l, &scratch.registers, output.source);
            for component in &value[..output.width] {
                component.store(&mut outputs.values[place * CHUNK..(place + 1) * CHUNK], at);
                place += 1;
            }
        }
        let direction = |step: u16| read(l, &scratch.registers, Source::Register(step));
        if let Some(step) = program.tangent {
            let [x, y, z, _] = direction(step);
            let [a, b, c] = &mut points.tangent;
            Vec3::new(x, y, z).store([a, b, c], at);
        }
        if let Some(step) = program.coat_normal {
            let [x, y, z, _] = direction(step);
            let smooth = load3(l, &points.shading_normal, at);
            let [a, b, c] = &mut points.coat_normal;
            Vec3::new(x, y, z).normalize_or(smooth).store([a, b, c], at);
        }
        if let Some(step) = program.normal {
            bend_normals(l, points, at, direction(step), program.free_normal);
        }
    }
}

#[inline(always)]
fn run_steps<L: Lanes>(
    l: L,
    program: &Program,
    geometry: &GeometryTable,
    textures: &TextureTable,
    points: &SurfaceColumns,
    at: usize,
    registers: &mut [f32],
) {
    let instance = l.load_integers(&points.instance, at);
    let primitive = l.load_integers(&points.primitive, at);
    let hit = geometry.hit_lanes(l, instance, primitive, l.load(&points.barycentric[0], at), l.load(&points.barycentric[1], at));
    let place = Place { geometry, hit, points, at };
    for (number, step) in program.steps.iter().enumerate() {
        let value = match step {
            Step::Image { texture, uv, wrap, filter, scale, bias, footprint } => {
                let uv = read(l, registers, *uv);
                let width = l.load(&points.uv_width, at) * *footprint;
                let texel = textures.sample(l, *texture, Vec2 { x: uv[0], y: uv[1] }, width, *wrap, *filter);
                let mut value = texel;
                for (i, component) in value.iter_mut().enumerate() {
                    *component = texel[i].mul_add(scale[i], bias[i]);
                }
                value
            }
            Step::Primvar { column, fallback } => {
                let (value, present) = geometry.primvar(l, &hit, *column);
                let mut chosen = value;
                for (i, component) in chosen.iter_mut().enumerate() {
                    *component = present.select(value[i], l.f(fallback[i]));
                }
                chosen
            }
            Step::Transform2d { input, matrix, offset } => {
                let uv = read(l, registers, *input);
                let row = |r: usize| uv[0] * matrix[r][0] + uv[1] * matrix[r][1] + offset[r];
                [row(0), row(1), uv[2], uv[3]]
            }
            Step::Transform3d { input, rows } => matrix_transform(read(l, registers, *input), rows),
            Step::Transform { input, to_world, quantity } => {
                instance_transform(l, &place, read(l, registers, *input), *to_world, *quantity)
            }
            Step::NormalMap { input, scale, uv } => normal_map(l, &place, read(l, registers, *input), *scale, *uv),
            Step::Hit(value) => hit_value(l, points, at, *value),
            Step::PositionStep { axis } => place.position_step(l, *axis),
            Step::PrimvarStep { column, axis } => place.primvar_step(l, *column, *axis),
            Step::UvTangent { column } => place.uv_tangent(l, *column),
            Step::Curve { input, curve } => curve.value(l, read(l, registers, *input)),
            Step::Vector(operation, [a, b]) => vector(l, *operation, read(l, registers, *a), read(l, registers, *b)),
            Step::Arithmetic { operation, inputs, even } => {
                arithmetic(l, *operation, *inputs, *even, registers, number);
                continue;
            }
            Step::Combine(sources) => [
                read_component(l, registers, sources[0], 0),
                read_component(l, registers, sources[1], 0),
                read_component(l, registers, sources[2], 0),
                read_component(l, registers, sources[3], 0),
            ],
        };
        for (i, component) in value.iter().enumerate() {
            component.store(registers, (number * 4 + i) * PADDING);
        }
    }
}

#[inline(always)]
pub(super) fn read<L: Lanes>(l: L, registers: &[f32], source: Source) -> [F<L>; 4] {
    let component = |number: u16, i: usize| l.load(registers, (usize::from(number) * 4 + i) * PADDING);
    match source {
        Source::Constant([x, y, z, w]) => [l.f(x), l.f(y), l.f(z), l.f(w)],
        Source::Register(n) => [component(n, 0), component(n, 1), component(n, 2), component(n, 3)],
        Source::Component(n, i) => [component(n, usize::from(i)); 4],
    }
}

#[inline(always)]
pub(super) fn read_component<L: Lanes>(l: L, registers: &[f32], source: Source, component: usize) -> F<L> {
    let (number, place) = match source {
        Source::Constant(value) => return l.f(value[component]),
        Source::Register(number) => (number, component),
        Source::Component(number, place) => (number, usize::from(place)),
    };
    l.load(registers, (usize::from(number) * 4 + place) * PADDING)
}
