//! Running a program over a chunk of hits.

use super::{Arithmetic, CHUNK, Program, Source, Step};
use crate::{geometry::GeometryTable, texture::TextureTable};
use gonio_simd::{Column, F, Frame, Lanes, PADDING, Rgb, Vec2, Vec3};

/// Surface points of a chunk, one entry a hit; normals lie on the side of `wo`.
#[derive(Clone, Debug)]
pub struct SurfaceColumns {
    /// Instance numbers.
    pub instance: Column<u32>,
    /// Triangle numbers in their meshes.
    pub primitive: Column<u32>,
    /// Barycentric coordinates of corners 1 and 2.
    pub barycentric: [Column; 2],
    /// Positions, world space.
    pub position: [Column; 3],
    /// Error bounds of the positions along the normals.
    pub error: Column,
    /// Unit triangle normals.
    pub geometric_normal: [Column; 3],
    /// Unit shading normals.
    pub shading_normal: [Column; 3],
    /// Unit shading normals before the program bent them; only where it does.
    pub smooth_normal: [Column; 3],
    /// Unit normals of the coat; only where the program gives them.
    pub coat_normal: [Column; 3],
    /// Tangents along the first texture coordinate, not unit; zero where there is none.
    pub tangent: [Column; 3],
    /// Width of a pixel in texture coordinates.
    pub uv_width: Column,
    /// 1 on the front side, −1 on the back.
    pub side: Column,
    /// Unit directions to where the ray came from.
    pub wo: [Column; 3],
}

impl Default for SurfaceColumns {
    fn default() -> Self {
        let column = || Column::new(CHUNK);
        let three = || [column(), column(), column()];
        Self {
            instance: Column::new(CHUNK),
            primitive: Column::new(CHUNK),
            barycentric: [column(), column()],
            position: three(),
            error: column(),
            geometric_normal: three(),
            shading_normal: three(),
            smooth_normal: three(),
            coat_normal: three(),
            tangent: three(),
            uv_width: column(),
            side: column(),
            wo: three(),
        }
    }
}

/// The parameters that a program computed, `CHUNK` values a place, in the order of its outputs.
#[derive(Clone, Debug, Default)]
pub struct OutputColumns {
    values: Vec<f32>,
}

impl OutputColumns {
    /// The column of the `place`-th computed place.
    pub fn column(&self, place: usize) -> &[f32] {
        &self.values[place * CHUNK..(place + 1) * CHUNK]
    }
}

/// Registers of the steps for one register's worth of hits.
#[derive(Clone, Debug, Default)]
pub struct GraphScratch {
    registers: Vec<f32>,
}

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
            let side = l.load(&points.side, at);
            let [x, y, z, _] = direction(step);
            let smooth = Vec3::load(l, [&points.shading_normal[0], &points.shading_normal[1], &points.shading_normal[2]], at);
            let [a, b, c] = &mut points.coat_normal;
            (Vec3::new(x, y, z) * side).normalize_or(smooth).store([a, b, c], at);
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
            Step::NormalMap { input, scale } => normal_map(l, points, at, read(l, registers, *input), *scale),
            Step::Arithmetic(operation, sources) => {
                let [a, b, c] = [read(l, registers, sources[0]), read(l, registers, sources[1]), read(l, registers, sources[2])];
                arithmetic(l, *operation, a, b, c)
            }
            Step::Combine(sources) => [0, 1, 2, 3].map(
                #[inline(always)]
                |i| read(l, registers, sources[i])[0],
            ),
        };
        for (i, component) in value.iter().enumerate() {
            component.store(registers, (number * 4 + i) * PADDING);
        }
    }
}

#[inline(always)]
fn read<L: Lanes>(l: L, registers: &[f32], source: Source) -> [F<L>; 4] {
    let component = |number: u16, i: usize| l.load(registers, (usize::from(number) * 4 + i) * PADDING);
    match source {
        Source::Constant([x, y, z, w]) => [l.f(x), l.f(y), l.f(z), l.f(w)],
        Source::Register(n) => [component(n, 0), component(n, 1), component(n, 2), component(n, 3)],
        Source::Component(n, i) => [component(n, usize::from(i)); 4],
    }
}

#[inline(always)]
fn arithmetic<L: Lanes>(l: L, operation: Arithmetic, a: [F<L>; 4], b: [F<L>; 4], c: [F<L>; 4]) -> [F<L>; 4] {
    let zero = l.f(0.0);
    let mut out = a;
    for i in 0..4 {
        out[i] = match operation {
            Arithmetic::Add => a[i] + b[i],
            Arithmetic::Subtract => a[i] - b[i],
            Arithmetic::Multiply => a[i] * b[i],
            Arithmetic::Divide => b[i].eq(0.0).select(zero, a[i] / b[i]),
            Arithmetic::Mix => a[i].lerp(b[i], c[i]),
            Arithmetic::Power => a[i].lt(0.0).select(zero, a[i].max(0.0).pow(b[i])),
            Arithmetic::Invert => b[i] - a[i],
            Arithmetic::Clamp => a[i].max(b[i]).min(c[i]),
            Arithmetic::Luminance => Rgb::new(a[0], a[1], a[2]).luminance(),
        };
    }
    out
}

/// A tangent-space normal in world space, on the front side.
#[inline(always)]
fn normal_map<L: Lanes>(l: L, points: &SurfaceColumns, at: usize, map: [F<L>; 4], scale: f32) -> [F<L>; 4] {
    let load = |columns: &[Column; 3]| Vec3::load(l, [&columns[0], &columns[1], &columns[2]], at);
    let front = load(&points.shading_normal) * l.load(&points.side, at);
    let frame = Frame::from_tangent(front, load(&points.tangent));
    let local = Vec3::new(map[0] * scale, map[1] * scale, map[2]);
    let bent = frame.to_world(local).normalize_or(front);
    [bent.x, bent.y, bent.z, l.f(0.0)]
}

/// Puts the mapped normals in place, turned to the side of `wo`, where they are usable.
#[inline(always)]
fn bend_normals<L: Lanes>(l: L, points: &mut SurfaceColumns, at: usize, normal: [F<L>; 4], free: bool) {
    let load = |columns: &[Column; 3]| Vec3::load(l, [&columns[0], &columns[1], &columns[2]], at);
    let smooth = load(&points.shading_normal);
    let bent = Vec3::new(normal[0], normal[1], normal[2]) * l.load(&points.side, at);
    let (geometric, wo) = (load(&points.geometric_normal), load(&points.wo));
    let bent = bent.normalize_or(smooth);
    let bent = if free { bent } else { facing(l, bent, geometric, wo) };
    let [x, y, z] = &mut points.smooth_normal;
    smooth.store([x, y, z], at);
    let [x, y, z] = &mut points.shading_normal;
    bent.store([x, y, z], at);
}

/// The normal nearest to `bent` about which the mirror direction of `wo` stays above the surface by at least
/// min(0.9 n_g·wo, 0.01), so that mapped reflections never point into the surface.
#[inline(always)]
fn facing<L: Lanes>(l: L, bent: Vec3<L>, geometric: Vec3<L>, wo: Vec3<L>) -> Vec3<L> {
    let limit = (geometric.dot(wo) * 0.9).min(0.01);
    let mirror = wo.reflect(bent);
    let short = mirror.dot(geometric).lt(limit);
    if !short.any() {
        return bent;
    }
    // In the plane of wo and the surface normal, halfway between wo and the lowest allowed mirror direction.
    let flat = (mirror - geometric * mirror.dot(geometric)).normalize_or(Frame::from_normal(geometric).x);
    let lowest = flat.mul_add((l.f(1.0) - limit * limit).safe_sqrt(), geometric * limit);
    short.select((wo + lowest).normalize_or(geometric), bent)
}
