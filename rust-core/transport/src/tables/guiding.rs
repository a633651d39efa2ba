//! The guiding field (path guiding): from which directions indirect light comes, by part of space. Camera paths that leave diffuse lobes go there more
//! often.
//!
//! Space is divided into cells, each for surfaces that face one of the six ways along the axes. A cell keeps the density of incident light times the
//! cosine over the hemisphere of its way (Vorba et al., On-line Learning of Parametric Mixture Models for Light Transport Simulation, 2014, learn the
//! same by mixtures), in equal parts of solid angle, and the share of samples that follow it.

mod learn;

pub use learn::{GuidingNote, Learning};

use gonio_simd::{F, Lanes, M, One, U, Vec3};
use std::f32::consts::TAU;

/// Parts of the hemisphere: rows of equal height, columns of equal azimuth.
const ROWS: usize = 16;
const COLUMNS: usize = 16;
const PARTS: usize = ROWS * COLUMNS;
/// Words of a cell: key, share, and the sums of the parts before each, which end in 1.
const WORDS: usize = 2 + PARTS + 1;
const SHARE: u32 = 1;
const SUMS: u32 = 2;
/// Where the grid begins, in cells: walls and floors stand at round numbers, and must not lie in between.
const SHIFT: f32 = 0.377;

/// Where indirect light comes from, cell by cell.
#[derive(Clone, Debug)]
pub struct GuidingField {
    cells: Vec<f32>,
    /// Cells less one; a power of two.
    mask: u32,
    per_metre: f32,
}

/// What a register of vertices knows of its directions.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Guided<L: Lanes> {
    /// Where the cell's sums begin.
    sums: U<L>,
    face: Face<L>,
    /// Share of samples that the field gives.
    pub(crate) share: F<L>,
}

/// The way that surfaces of a cell face: an axis, and to which side.
#[derive(Clone, Copy, Debug)]
struct Face<L: Lanes> {
    axis: U<L>,
    below: M<L>,
}

impl<L: Lanes> Face<L> {
    #[inline(always)]
    fn of(l: L, n: Vec3<L>) -> Self {
        let (x, y, z) = (n.x.abs(), n.y.abs(), n.z.abs());
        let is_z = z.ge(x) & z.ge(y);
        let is_x = x.ge(y).and_not(is_z);
        let axis = is_z.select(l.u(2), is_x.select(l.u(0), l.u(1)));
        Self { axis, below: is_z.select(n.z, is_x.select(n.x, n.y)).lt(0.0) }
    }
    #[inline(always)]
    fn number(&self) -> U<L> {
        let l = self.axis.lanes();
        (self.axis << 1) | self.below.select(l.u(1), l.u(0))
    }
    /// Into the frame whose z is the way.
    #[inline(always)]
    fn to_local(self, d: Vec3<L>) -> Vec3<L> {
        let (is_x, is_y) = (self.axis.eq(0), self.axis.eq(1));
        let turned = Vec3::new(
            is_x.select(d.y, is_y.select(d.z, d.x)),
            is_x.select(d.z, is_y.select(d.x, d.y)),
            is_x.select(d.x, is_y.select(d.y, d.z)),
        );
        Vec3::new(turned.x, turned.y, self.below.select(-turned.z, turned.z))
    }
    #[inline(always)]
    fn to_world(self, d: Vec3<L>) -> Vec3<L> {
        let z = self.below.select(-d.z, d.z);
        let (is_x, is_y) = (self.axis.eq(0), self.axis.eq(1));
        Vec3::new(is_x.select(z, is_y.select(d.y, d.x)), is_x.select(d.x, is_y.select(z, d.y)), is_x.select(d.y, is_y.select(d.x, z)))
    }
}

/// Which cell a coordinate lies in.
#[inline(always)]
fn step<L: Lanes>(x: F<L>, per_metre: f32) -> U<L> {
    (x * per_metre + SHIFT).floor().to_i32()
}

/// Place in a table and key of the cell of a point on surfaces that face a way.
#[inline(always)]
fn hashed<L: Lanes>(p: Vec3<L>, per_metre: f32, face: U<L>) -> [U<L>; 2] {
    let (x, y, z) = (step(p.x, per_metre), step(p.y, per_metre), step(p.z, per_metre));
    let mixed = (x * 0x8da6_b343) ^ (y * 0xd816_3841) ^ (z * 0xcb1a_b31f) ^ (face * 0x1656_67b1);
    let key = ((x * 0x9e37_79b1) ^ (y * 0x85eb_ca77) ^ (z * 0xc2b2_ae3d) ^ (face * 0x27d4_eb2f)) | 1;
    [mixed ^ (mixed >> 15), key]
}

/// The part of the hemisphere that a direction with `z` above 0 lies in.
#[inline(always)]
fn part_of<L: Lanes>(d: Vec3<L>) -> U<L> {
    let l = d.z.lanes();
    let row = (d.z * ROWS as f32).to_i32().min(l.u(ROWS as u32 - 1));
    let turn = d.y.atan2(d.x) * (1.0 / TAU);
    let turn = turn.lt(0.0).select(turn + 1.0, turn);
    let column = (turn * COLUMNS as f32).to_i32().min(l.u(COLUMNS as u32 - 1));
    (row * COLUMNS as u32) + column
}

impl GuidingField {
    /// What is known at some vertices.
    #[inline(always)]
    pub(crate) fn at<L: Lanes>(&self, l: L, p: Vec3<L>, n: Vec3<L>, chosen: M<L>) -> Guided<L> {
        let face = Face::of(l, n);
        let [place, key] = hashed(p, self.per_metre, face.number());
        let start = ((place & self.mask) * WORDS as u32).keep_if(chosen);
        let found = chosen & l.gather(&self.cells, start).to_bits().eq(key);
        let share = l.gather(&self.cells, start + SHARE).keep_if(found);
        Guided { sums: start + SUMS, face, share }
    }

    /// A direction of the field, world space.
    #[inline(always)]
    pub(crate) fn sample<L: Lanes>(&self, l: L, guided: &Guided<L>, u: [F<L>; 2]) -> Vec3<L> {
        let mut part = l.u(0);
        let mut half = PARTS as u32 / 2;
        while half > 0 {
            let sum = l.gather(&self.cells, guided.sums + part + half);
            part += l.u(half).keep_if(!u[0].lt(sum));
            half /= 2;
        }
        let before = l.gather(&self.cells, guided.sums + part);
        let width = l.gather(&self.cells, guided.sums + part + 1) - before;
        let rest = ((u[0] - before) / width.max(f32::MIN_POSITIVE)).clamp(0.0, 0.999_999_94);
        let row = (part >> COLUMNS.trailing_zeros()).to_float();
        let column = (part & (COLUMNS as u32 - 1)).to_float();
        let z = (row + rest) * (1.0 / ROWS as f32);
        let (sin, cos) = ((column + u[1]) * (1.0 / COLUMNS as f32)).sin_cos_turns();
        let r = (l.f(1.0) - z * z).safe_sqrt();
        guided.face.to_world(Vec3::new(r * cos, r * sin, z))
    }

    /// Density of [`Self::sample`] per solid angle.
    #[inline(always)]
    pub(crate) fn pdf<L: Lanes>(&self, l: L, guided: &Guided<L>, direction: Vec3<L>) -> F<L> {
        let local = guided.face.to_local(direction);
        let above = local.z.gt(0.0);
        let part = part_of(local).keep_if(above);
        let width = l.gather(&self.cells, guided.sums + part + 1) - l.gather(&self.cells, guided.sums + part);
        (width * (PARTS as f32 / TAU)).keep_if(above)
    }
}

/// The face's number and the part of a direction, of one point.
fn place_of(normal: [f32; 3], direction: [f32; 3]) -> (u32, Option<usize>) {
    let face = Face::of(One, Vec3::splat(One, normal));
    let local = face.to_local(Vec3::splat(One, direction));
    let part = local.z.gt(0.0).any().then(|| part_of(local).0 as usize);
    (face.number().0, part)
}
