//! Dicing: triangles cut until no edge is longer than is asked for, each edge by itself, so that no crack opens between neighbours.
//!
//! Where triangles are smooth, new points lie on the cubic of their edge's points and normals (Vlachos and others, Curved PN Triangles, 2001).
//! An edge has one new point, the mean of what its triangles say, so that creases stay where they are.

use super::Weld;
use super::vector::{Vec3, add, dot, normalized, scale, sub};
use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

/// What is diced.
#[derive(Clone, Copy, Debug)]
pub struct Undiced<'a> {
    /// Points.
    pub points: &'a [[f32; 3]],
    /// Points of the triangles, all of them there.
    pub triangles: &'a [[u32; 3]],
    /// Normals of the corners, three a triangle; empty where triangles are flat.
    pub normals: &'a [[f32; 3]],
    /// Whether new points lie on the curves of points and normals, else on the edges themselves.
    pub smooth: bool,
}

/// When dicing ends.
#[derive(Clone, Copy, Debug)]
pub struct DiceLimits {
    /// How often an edge is cut in two.
    pub levels: u32,
    /// Triangles beyond which nothing more is cut.
    pub triangles: usize,
}

/// A triangle of a diced mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DicedTriangle {
    /// Its points.
    pub points: [u32; 3],
    /// The triangle that it is a part of.
    pub source: u32,
    /// Barycentric coordinates of its corners in that: the weights of corners 1 and 2.
    pub places: [[f32; 2]; 3],
    /// Normals of its corners; zero where there are none.
    pub normals: [[f32; 3]; 3],
}

/// A diced mesh.
#[derive(Clone, Debug, Default)]
pub struct Diced {
    /// Points, those of the mesh first.
    pub points: Vec<[f32; 3]>,
    /// Of each further point the two that it lies between, and how far it is off their middle.
    pub parents: Vec<([u32; 2], [f32; 3])>,
    /// Triangles.
    pub triangles: Vec<DicedTriangle>,
    /// Whether edges are left that are too long, for there would be too many triangles.
    pub is_cut_short: bool,
}

/// Hashes pairs of numbers, which are spread well by a product.
#[derive(Default)]
struct PairHasher(u64);

impl Hasher for PairHasher {
    fn finish(&self) -> u64 {
        self.0 ^ (self.0 >> 32)
    }
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|byte| self.write_u64(u64::from(*byte)));
    }
    fn write_u64(&mut self, pair: u64) {
        self.0 = (self.0.rotate_left(5) ^ pair).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
}

type Pairs<T> = HashMap<u64, T, BuildHasherDefault<PairHasher>>;

fn pair(a: u32, b: u32) -> u64 {
    u64::from(a.min(b)) << 32 | u64::from(a.max(b))
}

/// Dices a mesh: `length` says how many times too long an edge between two points is.
#[must_use]
pub fn dice(mesh: &Undiced<'_>, limits: DiceLimits, length: &dyn Fn(&[f32; 3], &[f32; 3]) -> f32) -> Diced {
    let mut diced = cut(mesh, limits, length);
    if !mesh.smooth {
        spread_evenly(mesh, &mut diced.triangles);
    }
    diced
}

/// Gives corners the normals between those of the triangles that they are parts of: where these stay flat, they are as they were.
fn spread_evenly(mesh: &Undiced<'_>, triangles: &mut [DicedTriangle]) {
    for triangle in triangles {
        let first = 3 * triangle.source as usize;
        let Some([a, b, c]) = mesh.normals.get(first..first + 3) else { continue };
        for (normal, [u, v]) in triangle.normals.iter_mut().zip(triangle.places) {
            *normal = add(scale(*a, 1.0 - u - v), add(scale(*b, u), scale(*c, v)));
        }
    }
}

fn cut(mesh: &Undiced<'_>, limits: DiceLimits, length: &dyn Fn(&[f32; 3], &[f32; 3]) -> f32) -> Diced {
    let whole = |(number, points): (usize, &[u32; 3])| {
        let normals = mesh.normals.get(3 * number..3 * number + 3).map_or([[0.0; 3]; 3], |n| [n[0], n[1], n[2]]);
        DicedTriangle { points: *points, source: number as u32, places: [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], normals }
    };
    let triangles = mesh.triangles.iter().enumerate().map(whole).collect();
    let mut diced = Diced { points: mesh.points.to_vec(), triangles, ..Diced::default() };
    let mut places = Weld::new(mesh.points);
    for _ in 0..limits.levels {
        let cuts = cuts(&diced, &places, mesh.smooth && !mesh.normals.is_empty(), length);
        if cuts.is_empty() {
            return diced;
        }
        let made = diced.triangles.iter().map(|triangle| 1 + cut_edges(triangle, &cuts, &places).iter().filter(|cut| **cut).count());
        if made.sum::<usize>() > limits.triangles {
            diced.is_cut_short = true;
            return diced;
        }
        split_all(&mut diced, &mut places, &cuts);
    }
    diced
}

/// The edges that are too long, by the places of their ends: the sum of what triangles say how far off the middle the new point is, and how
/// many they are.
fn cuts(diced: &Diced, places: &Weld, smooth: bool, length: &dyn Fn(&[f32; 3], &[f32; 3]) -> f32) -> Pairs<(Vec3, f32)> {
    let mut cuts: Pairs<(Vec3, f32)> = Pairs::default();
    for triangle in &diced.triangles {
        for k in 0..3 {
            let [a, b] = [triangle.points[k], triangle.points[(k + 1) % 3]];
            let [p, q] = [diced.points[a as usize], diced.points[b as usize]];
            // Both sides ask in the same order.
            let [first, second] = if places.place[a as usize] < places.place[b as usize] { [&p, &q] } else { [&q, &p] };
            if first != second && length(first, second) > 1.0 {
                let off = if smooth { bulge(p, q, triangle.normals[k], triangle.normals[(k + 1) % 3]) } else { [0.0; 3] };
                let (sum, count) = cuts.entry(pair(places.place[a as usize], places.place[b as usize])).or_default();
                (*sum, *count) = (add(*sum, off), *count + 1.0);
            }
        }
    }
    cuts
}

/// How far the middle of the cubic between two points with normals is off the middle of the points.
fn bulge(p: Vec3, q: Vec3, n: Vec3, m: Vec3) -> Vec3 {
    let (Some(n), Some(m)) = (normalized(n), normalized(m)) else { return [0.0; 3] };
    let way = sub(q, p);
    let off = add(scale(n, -dot(way, n)), scale(m, dot(way, m)));
    let off = scale(off, 0.125);
    if off.iter().all(|x| x.is_finite()) { off } else { [0.0; 3] }
}

/// The normal in the middle of an edge: the mean of those of its ends.
fn normal_between(n: Vec3, m: Vec3) -> Vec3 {
    normalized(add(n, m)).unwrap_or(n)
}

fn cut_edges(triangle: &DicedTriangle, cuts: &Pairs<(Vec3, f32)>, places: &Weld) -> [bool; 3] {
    let place = triangle.points.map(|point| places.place[point as usize]);
    [0, 1, 2].map(|k| cuts.contains_key(&pair(place[k], place[(k + 1) % 3])))
}

/// Cuts all triangles along their edges that are cut.
fn split_all(diced: &mut Diced, places: &mut Weld, cuts: &Pairs<(Vec3, f32)>) {
    let mut points: Pairs<u32> = Pairs::default();
    let mut new_places: Pairs<u32> = Pairs::default();
    let old = std::mem::take(&mut diced.triangles);
    for triangle in &old {
        let cut = cut_edges(triangle, cuts, places);
        let mut middle = [Corner::default(); 3];
        for k in (0..3).filter(|k| cut[*k]) {
            let [a, b] = [triangle.points[k], triangle.points[(k + 1) % 3]];
            let number = *points.entry(pair(a, b)).or_insert_with(|| {
                let key = pair(places.place[a as usize], places.place[b as usize]);
                let off = cuts.get(&key).map_or([0.0; 3], |(sum, count)| scale(*sum, 1.0 / count));
                let [p, q] = [diced.points[a as usize], diced.points[b as usize]];
                diced.points.push(add(scale(add(p, q), 0.5), off));
                diced.parents.push(([a, b], off));
                let next = places.count as u32;
                let place = *new_places.entry(key).or_insert(next);
                places.count += usize::from(place == next);
                places.place.push(place);
                diced.points.len() as u32 - 1
            });
            middle[k] = between(triangle, k, number);
        }
        split(diced, triangle, cut, middle);
    }
}

#[derive(Clone, Copy, Default)]
struct Corner {
    point: u32,
    place: [f32; 2],
    normal: Vec3,
}

fn corner(triangle: &DicedTriangle, k: usize) -> Corner {
    Corner { point: triangle.points[k], place: triangle.places[k], normal: triangle.normals[k] }
}

fn between(triangle: &DicedTriangle, k: usize, point: u32) -> Corner {
    let [a, b] = [corner(triangle, k), corner(triangle, (k + 1) % 3)];
    let place = [0, 1].map(|axis| 0.5 * (a.place[axis] + b.place[axis]));
    let none = a.normal == [0.0; 3] && b.normal == [0.0; 3];
    let normal = if none { [0.0; 3] } else { normal_between(a.normal, b.normal) };
    Corner { point, place, normal }
}

/// Cuts a triangle at the middles of one, two or three of its edges.
fn split(diced: &mut Diced, triangle: &DicedTriangle, cut: [bool; 3], middle: [Corner; 3]) {
    let source = triangle.source;
    let mut put = |corners: [Corner; 3]| {
        let (points, places, normals) = (corners.map(|c| c.point), corners.map(|c| c.place), corners.map(|c| c.normal));
        diced.triangles.push(DicedTriangle { points, source, places, normals });
    };
    // Turned so that the edge that is cut, or not cut, comes first.
    let first = match cut.iter().filter(|cut| **cut).count() {
        0 => return diced.triangles.push(*triangle),
        1 => cut.iter().position(|cut| *cut),
        2 => cut.iter().position(|cut| !*cut),
        _ => Some(0),
    };
    let at = |k: usize| (first.unwrap_or(0) + k) % 3;
    let [a, b, c] = [0, 1, 2].map(|k| corner(triangle, at(k)));
    let [ab, bc, ca] = [0, 1, 2].map(|k| middle[at(k)]);
    match cut.iter().filter(|cut| **cut).count() {
        1 => [[a, ab, c], [ab, b, c]].into_iter().for_each(&mut put),
        2 => [[bc, c, ca], [a, b, bc], [a, bc, ca]].into_iter().for_each(&mut put),
        _ => [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]].into_iter().for_each(&mut put),
    }
}
