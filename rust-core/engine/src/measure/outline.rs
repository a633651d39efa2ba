//! A nearly flat surface seen along its mean normal: what a grid on a mesh covers.

use super::{
    points::axes,
    vector::{Vector, add, cross, dot, length, scaled, subtract, unit},
};
use crate::{
    error::{Error, Result},
    scene::{Grid, Mesh, Transform},
};
use std::{cmp::Ordering, collections::HashMap};

/// The mean normal of a surface is shorter the more it turns; below this share it has no side.
const LEAST_FLATNESS: f64 = 0.5;

type Point = [f64; 2];

/// Triangles in the coordinates of their plane.
#[derive(Clone, Debug)]
pub(super) struct Outline {
    /// Along rows, from row to row, and the normal.
    axes: [Vector; 3],
    /// Corners in the plane, with heights above the world's origin.
    triangles: Vec<[(Point, f64); 3]>,
    /// Edges that belong to one triangle alone.
    border: Vec<[Point; 2]>,
}

impl Outline {
    /// Of a placed mesh.
    pub(super) fn new(mesh: &Mesh, transform: &Transform, grid: &Grid) -> Result<Self> {
        let corners = world_triangles(mesh, transform);
        let twice_area = |t: &[Vector; 3]| cross(subtract(t[1], t[0]), subtract(t[2], t[0]));
        let sum = corners.iter().map(twice_area).fold([0.0; 3], add);
        let total: f64 = corners.iter().map(|t| length(twice_area(t))).sum();
        let normal = unit(sum).filter(|_| length(sum) >= LEAST_FLATNESS * total);
        let problem =
            "a grid wants a surface with one side, such as a floor or a table's top; this one has no area or turns back on itself";
        let normal = normal.ok_or_else(|| Error::scene(&grid.origin, problem))?;
        let [u, v] = axes(normal, longest_border(&corners));
        let flat = |p: Vector| ([dot(p, u), dot(p, v)], dot(p, normal));
        // What faces the other way is the underside of something.
        let upper = corners.iter().filter(|t| dot(twice_area(t), normal) > 0.0);
        let triangles: Vec<[(Point, f64); 3]> = upper.map(|t| t.map(flat)).collect();
        let border = border(&triangles);
        Ok(Self { axes: [u, v, normal], triangles, border })
    }

    pub(super) fn normal(&self) -> Vector {
        self.axes[2]
    }

    /// Square metres in the plane.
    pub(super) fn area(&self) -> f64 {
        self.triangles.iter().map(|[(a, _), (b, _), (c, _)]| 0.5 * twice_area(*a, *b, *c)).sum()
    }

    /// Least and greatest coordinates in the plane.
    pub(super) fn extent(&self) -> [Point; 2] {
        let points = || self.triangles.iter().flatten().map(|(point, _)| point);
        let along = |axis: usize, pick: fn(f64, f64) -> f64, start: f64| points().map(|p| p[axis]).fold(start, pick);
        [[0, 1].map(|axis| along(axis, f64::min, f64::INFINITY)), [0, 1].map(|axis| along(axis, f64::max, f64::NEG_INFINITY))]
    }

    /// The world's points so far above the surface, at the lattice's points where the surface is and its border is not nearer than `margin`.
    pub(super) fn above(&self, lattice: &Lattice, margin: f64, height: f64) -> Vec<Option<Vector>> {
        let mut heights: Vec<Option<f64>> = vec![None; lattice.size[0] * lattice.size[1]];
        for triangle in &self.triangles {
            for index in lattice.within(triangle.map(|(point, _)| point), 0.0) {
                let here = height_in(triangle, lattice.point(index));
                heights[index] = here.into_iter().chain(heights[index]).reduce(f64::max);
            }
        }
        for edge in self.border.iter().filter(|_| margin > 0.0) {
            for index in lattice.within(*edge, margin) {
                if distance(lattice.point(index), edge) < margin * (1.0 - 1e-9) {
                    heights[index] = None;
                }
            }
        }
        let [u, v, normal] = self.axes;
        let place = |(index, surface): (usize, Option<f64>)| {
            let [x, y] = lattice.point(index);
            surface.map(|surface| add(add(scaled(u, x), scaled(v, y)), scaled(normal, surface + height)))
        };
        heights.into_iter().enumerate().map(place).collect()
    }
}

/// Points in even rows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lattice {
    pub(super) first: Point,
    pub(super) spacing: [f64; 2],
    pub(super) size: [usize; 2],
}

impl Lattice {
    fn point(&self, index: usize) -> Point {
        let number = [index % self.size[0], index / self.size[0]];
        [0, 1].map(|axis| self.first[axis] + number[axis] as f64 * self.spacing[axis])
    }

    /// Numbers of the points in the box about some points, widened to all sides.
    fn within<const N: usize>(&self, points: [Point; N], widened: f64) -> impl Iterator<Item = usize> + use<N> {
        let range = |axis: usize| {
            let along = || points.iter().map(|point| point[axis]);
            let [low, high] = [along().fold(f64::INFINITY, f64::min) - widened, along().fold(f64::NEG_INFINITY, f64::max) + widened];
            let number = |at: f64| (at - self.first[axis]) / self.spacing[axis];
            // Casts hold numbers to the lattice.
            (number(low).floor().max(0.0) as usize).min(self.size[axis])
                ..((number(high).ceil() + 1.0).max(0.0) as usize).min(self.size[axis])
        };
        let (columns, rows, across) = (range(0), range(1), self.size[0]);
        rows.flat_map(move |row| columns.clone().map(move |column| row * across + column))
    }
}

fn world_triangles(mesh: &Mesh, transform: &Transform) -> Vec<[Vector; 3]> {
    let mirrored = transform.determinant() < 0.0;
    let point = |number: u32| mesh.points.get(number as usize).map(|p| transform.point(p.map(f64::from)));
    let placed = |t: &[u32; 3]| {
        let [a, b, c] = [point(t[0])?, point(t[1])?, point(t[2])?];
        Some(if mirrored { [a, c, b] } else { [a, b, c] })
    };
    mesh.triangles.iter().filter_map(placed).filter(|t| t.iter().flatten().all(|x| x.is_finite())).collect()
}

/// Ends of an edge.
type Edge<const N: usize> = [[f64; N]; 2];

/// Edges of one triangle alone. Corners that do not share a point meet where their coordinates are the same to single precision.
fn lone_edges<const N: usize>(triangles: &[[[f64; N]; 3]]) -> Vec<Edge<N>> {
    let Some([start, ..]) = triangles.first() else { return Vec::new() };
    // From the first corner on: far from the world's origin single precision is coarser than a table. Adding zero makes both zeros one.
    let key = |end: &[f64; N]| -> [u32; N] { std::array::from_fn(|k| ((end[k] - start[k]) as f32 + 0.0).to_bits()) };
    let mut edges = HashMap::new();
    for triangle in triangles {
        for (a, b) in [(0, 1), (1, 2), (2, 0)] {
            let ends = [triangle[a], triangle[b]];
            let mut name = ends.each_ref().map(key);
            name.sort();
            edges.entry(name).or_insert((0, ends)).0 += 1;
        }
    }
    edges.into_values().filter(|(count, _)| *count == 1).map(|(_, ends)| ends).collect()
}

fn border(triangles: &[[(Point, f64); 3]]) -> Vec<[Point; 2]> {
    let flat: Vec<[Point; 3]> = triangles.iter().map(|t| t.map(|(point, _)| point)).collect();
    lone_edges(&flat)
}

/// The direction of the longest edge of the surface's border: rows run along it.
fn longest_border(triangles: &[[Vector; 3]]) -> Vector {
    let edges = lone_edges(triangles);
    let along = |edge: [Vector; 2]| {
        let v = subtract(edge[1], edge[0]);
        // One sense of the two, so that the order of edges does not matter.
        let first = v.iter().copied().find(|x| x.abs() > 1e-9 * length(v)).unwrap_or(1.0);
        scaled(v, first.signum())
    };
    // To the micrometre, then by direction: of a rectangle's equal edges always the same.
    let rank = |v: &Vector| [(length(*v) * 1e6).round(), v[0], v[1], v[2]];
    let longer =
        |a: &Vector, b: &Vector| rank(a).iter().zip(rank(b)).map(|(a, b)| a.total_cmp(&b)).find(|o| o.is_ne()).unwrap_or(Ordering::Equal);
    edges.into_iter().map(along).max_by(longer).unwrap_or([1.0, 0.0, 0.0])
}

/// Positive where the corners go round against the clock.
fn twice_area(p: Point, q: Point, r: Point) -> f64 {
    (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0])
}

/// The height of a triangle over a point of the plane, where it is there.
fn height_in(triangle: &[(Point, f64); 3], point: Point) -> Option<f64> {
    let [(a, ha), (b, hb), (c, hc)] = *triangle;
    let whole = twice_area(a, b, c);
    let weights = [twice_area(b, c, point), twice_area(c, a, point), twice_area(a, b, point)].map(|w| w / whole);
    let inside = whole != 0.0 && weights.iter().all(|w| *w >= -1e-12);
    inside.then(|| weights[0] * ha + weights[1] * hb + weights[2] * hc)
}

fn distance(point: Point, [a, b]: &[Point; 2]) -> f64 {
    let along = [b[0] - a[0], b[1] - a[1]];
    let from = [point[0] - a[0], point[1] - a[1]];
    let square = along[0] * along[0] + along[1] * along[1];
    let t = if square > 0.0 { ((from[0] * along[0] + from[1] * along[1]) / square).clamp(0.0, 1.0) } else { 0.0 };
    (from[0] - t * along[0]).hypot(from[1] - t * along[1])
}
