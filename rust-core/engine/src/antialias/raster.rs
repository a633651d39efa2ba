//! The map of a tile by rasterisation: which of its triangles lies in front at each place of a grid in each pixel.
//!
//! Edge functions in homogeneous coordinates (Olano and Greer, 1997), so that nothing is clipped: triangles may reach behind the camera. Those of
//! neighbours are the same but for their sign, to the bit: there are no gaps.

use super::{triangles::Triangles, view::TileView};
use crate::{accel::NONE, camera::sampler::TILE};
use gonio_simd::{Column, F, Lanes, Vec3};

/// The grid of places in a pixel, padded to whole registers by places that come twice.
#[derive(Debug, Default)]
pub(super) struct Grid {
    side: u32,
    pub(super) places: [Column; 2],
}

impl Grid {
    /// So many places along a pixel's side.
    pub(super) fn prepare(&mut self, side: u32) {
        if self.side == side {
            return;
        }
        self.side = side;
        let (count, room) = ((side * side) as usize, gonio_simd::padded((side * side) as usize));
        self.places = [0, 1].map(|_| Column::new(room));
        for place in 0..room {
            let number = place.min(count - 1) as u32;
            for (column, step) in self.places.iter_mut().zip([number % side, number / side]) {
                column[place] = (step as f32 + 0.5) / side as f32;
            }
        }
    }

    /// Places of a pixel, those that come twice as well.
    pub(super) fn count(&self) -> usize {
        self.places[0].len()
    }
}

/// What lies in front: reciprocals of depths, and numbers of triangles or [`NONE`]; pixel after pixel, row after row.
#[derive(Debug, Default)]
pub(super) struct Front {
    pub(super) nearness: Column,
    pub(super) triangle: Column<u32>,
}

impl Front {
    /// Nothing in any pixel of a tile.
    pub(super) fn clear(&mut self, places: usize, farthest: f32) {
        let room = TILE * TILE * places;
        if self.nearness.len() < room {
            (self.nearness, self.triangle) = (Column::new(room), Column::new(room));
        }
        self.nearness[..room].fill(farthest.recip());
        self.triangle[..room].fill(NONE);
    }
}

/// A register of triangles, ready to be drawn: rows of numbers by lane.
struct Ready {
    /// Factors of x, y and one in the three edge functions; all are positive inside.
    edges: [[[f32; 16]; 3]; 3],
    /// The same for the reciprocal of the depth, and its least and its largest value.
    nearness: [[f32; 16]; 3],
    limits: [[f32; 16]; 2],
    /// First and last column and row of pixels, in two arrays; none where the last is less.
    pixels: [[[f32; 16]; 2]; 2],
}

/// Draws all triangles of a tile, and finds their normals.
#[inline(always)]
pub(super) fn draw<L: Lanes>(l: L, view: &TileView, grid: &Grid, triangles: &mut Triangles, front: &mut Front) {
    let count = triangles.count();
    for at in (0..count).step_by(L::COUNT) {
        let ready = make_ready(l, view, triangles, at);
        for lane in 0..L::COUNT.min(count - at) {
            if ready.pixels[1][0][lane] >= ready.pixels[0][0][lane] && ready.pixels[1][1][lane] >= ready.pixels[0][1][lane] {
                draw_one(l, grid, &ready, lane, (at + lane) as u32, view.clipping[0].recip(), front);
            }
        }
    }
}

/// Edge functions, depths, normals and the pixels around a register of triangles.
#[inline(always)]
fn make_ready<L: Lanes>(l: L, view: &TileView, triangles: &mut Triangles, at: usize) -> Ready {
    let mut corners = [Vec3::splat(l, [0.0; 3]); 3];
    for (corner, [x, y, z]) in corners.iter_mut().zip(&triangles.corners) {
        *corner = Vec3::load(l, [x, y, z], at);
    }
    let [a, b, c] = corners;
    let hand = l.load(&triangles.hand, at);
    let normal = normal(l, view, corners) * hand;
    let [x, y, z] = &mut triangles.normal;
    normal.store([x, y, z], at);
    let mut edges = [exact_cross(b, c), exact_cross(c, a), exact_cross(a, b)];
    let determinant = a.dot(edges[0]);
    let sign = l.f(1.0).copysign(determinant);
    for edge in &mut edges {
        *edge = *edge * sign;
    }
    let nearness = (edges[0] + edges[1] + edges[2]) * determinant.abs().recip();
    let mut ready = Ready { edges: [[[0.0; 16]; 3]; 3], nearness: [[0.0; 16]; 3], limits: [[0.0; 16]; 2], pixels: [[[0.0; 16]; 2]; 2] };
    for (rows, edge) in ready.edges.iter_mut().zip(&edges) {
        [rows[0], rows[1], rows[2]] = [edge.x.to_array(), edge.y.to_array(), edge.z.to_array()];
    }
    ready.nearness = [nearness.x.to_array(), nearness.y.to_array(), nearness.z.to_array()];
    let (least, most) = (a.z.min(b.z).min(c.z), a.z.max(b.z).max(c.z));
    let before = least.gt(0.0);
    ready.limits = [before.select(most.recip(), l.f(0.0)).to_array(), before.select(least.recip(), l.f(f32::INFINITY)).to_array()];
    let drawn = most.gt(0.0) & determinant.abs().gt(0.0) & nearness.x.is_finite() & nearness.y.is_finite() & nearness.z.is_finite();
    let over = [a.z.recip(), b.z.recip(), c.z.recip()];
    let places = [[a.x * over[0], b.x * over[1], c.x * over[2]], [a.y * over[0], b.y * over[1], c.y * over[2]]];
    for (axis, [p, q, r]) in places.into_iter().enumerate() {
        let end = view.size[axis] as f32 - 1.0;
        let first = before.select(p.min(q).min(r).floor().max(0.0), l.f(0.0));
        let last = before.select(p.max(q).max(r).floor().min(end), l.f(end));
        ready.pixels[0][axis] = first.to_array();
        ready.pixels[1][axis] = drawn.select(last, l.f(-1.0)).to_array();
    }
    ready
}

/// The cross product, each product rounded by itself: that of the same two in the other order is the same but for its sign.
#[inline(always)]
fn exact_cross<L: Lanes>(a: Vec3<L>, b: Vec3<L>) -> Vec3<L> {
    Vec3::new(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x)
}

/// Unit normals in the camera's space.
#[inline(always)]
fn normal<L: Lanes>(l: L, view: &TileView, mut corners: [Vec3<L>; 3]) -> Vec3<L> {
    for corner in &mut corners {
        corner.x = corner.x.mul_add(view.pixel[0], corner.z * view.corner[0]);
        corner.y = corner.y.mul_add(view.pixel[1], corner.z * view.corner[1]);
    }
    (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or(Vec3::splat(l, [0.0, 0.0, 1.0]))
}

/// Draws a triangle of a register.
#[inline(always)]
fn draw_one<L: Lanes>(l: L, grid: &Grid, ready: &Ready, lane: usize, number: u32, nearest: f32, front: &mut Front) {
    let mut edges = [Vec3::splat(l, [0.0; 3]); 3];
    for (edge, rows) in edges.iter_mut().zip(&ready.edges) {
        *edge = Vec3::splat(l, [rows[0][lane], rows[1][lane], rows[2][lane]]);
    }
    let nearness = Vec3::splat(l, [ready.nearness[0][lane], ready.nearness[1][lane], ready.nearness[2][lane]]);
    let limits = [ready.limits[0][lane], ready.limits[1][lane]];
    let [columns, rows] = [0, 1].map(|axis| ready.pixels[0][axis][lane] as usize..ready.pixels[1][axis][lane] as usize + 1);
    for row in rows {
        for at in (0..grid.count()).step_by(L::COUNT) {
            let y = l.load(&grid.places[1], at) + row as f32;
            let inside_x = l.load(&grid.places[0], at);
            let starts = [edges[0].y.mul_add(y, edges[0].z), edges[1].y.mul_add(y, edges[1].z), edges[2].y.mul_add(y, edges[2].z)];
            let start = nearness.y.mul_add(y, nearness.z);
            for column in columns.clone() {
                let x: F<L> = inside_x + column as f32;
                let [e, f, g] = [edges[0].x.mul_add(x, starts[0]), edges[1].x.mul_add(x, starts[1]), edges[2].x.mul_add(x, starts[2])];
                let inside = e.min(f).min(g).ge(0.0);
                if !inside.any() {
                    continue;
                }
                let place = (row * TILE + column) * grid.count() + at;
                let before = l.load(&front.nearness, place);
                let near = nearness.x.mul_add(x, start).max(limits[0]).min(limits[1]);
                let shown = inside & near.gt(before) & near.le(nearest);
                shown.select(near, before).store(&mut front.nearness, place);
                shown.select(l.u(number), l.load_integers(&front.triangle, place)).store(&mut front.triangle, place);
            }
        }
    }
}
