//! `NurbsPatch` prims: rational surfaces, cut into a grid of quads with exact normals.

use crate::build::{MeshSource, Surface};
use crate::context::Context;
use crate::mesh::{self, ReadMesh};
use crate::options::Complexity;
use crate::prim::Prim;
use crate::primvar;
use gonio::mesh::{FacePrimvar, Interpolation, PolygonMesh};

/// Highest order that is read.
const HIGHEST: usize = 32;
/// Most quads along a direction.
const MOST_QUADS: usize = 2048;

/// One direction of a patch.
#[derive(Debug)]
struct Direction {
    count: usize,
    order: usize,
    knots: Vec<f64>,
    range: [f64; 2],
}

/// A control point in homogeneous coordinates.
type Control = [f64; 4];

/// Reads a patch; `None`, with a report, where it cannot be shown.
pub fn read<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<ReadMesh<'py>> {
    let origin = prim.origin();
    let points = mesh::points(context, prim).unwrap_or_default();
    let (u, v) = (direction(context, prim, 'u'), direction(context, prim, 'v'));
    let (Some(u), Some(v), false) = (u, v, points.is_empty()) else {
        context.warn(&origin, "orders, knots and numbers of points do not make a surface; the patch is left out");
        return None;
    };
    if points.len() != u.count * v.count {
        context.warn(&origin, format!("{} points were found, expected {} x {}; the patch is left out", points.len(), u.count, v.count));
        return None;
    }
    if prim.has_authored("trimCurve:counts") {
        context.unsupported("trim curves of NURBS patches (the whole patch is shown)", &origin);
    }
    let weights = context.get_authored::<Vec<f32>>(prim, "pointWeights").filter(|weights| weights.len() == points.len());
    let weights: Vec<f64> = weights.map_or_else(|| vec![1.0; points.len()], |weights| weights.into_iter().map(f64::from).collect());
    let control: Vec<Control> = points.iter().zip(&weights).map(|([x, y, z], w)| [*x, *y, *z, 1.0].map(|x| f64::from(x) * w)).collect();
    let pieces = pieces(context.options.complexity);
    let grid = Grid { u: u.samples(pieces), v: v.samples(pieces), width: u.count };
    let mut polygons = grid.polygons(&control);
    polygons.left_handed = context.left_handed(prim);
    for primvar in primvar::authored(context, prim) {
        match primvar.interpolation {
            Interpolation::Constant => polygons.primvars.push(primvar),
            Interpolation::Vertex if primvar.place_count() == points.len() => polygons.primvars.push(grid.carried(&primvar, &weights)),
            _ => context.unsupported(
                &format!("primvar '{}' of a NurbsPatch that is neither constant nor one value a point", primvar.name),
                &origin,
            ),
        }
    }
    let source = MeshSource { origin, polygons, surface: Surface::Polygons, face_slots: None };
    Some(ReadMesh { source, slot_prims: vec![prim.clone()] })
}

/// Quads between two knots.
fn pieces(complexity: Complexity) -> usize {
    match complexity {
        Complexity::Low => 4,
        Complexity::Medium => 8,
        Complexity::High | Complexity::Auto => 16,
        Complexity::VeryHigh => 32,
    }
}

/// What a prim says of a direction, if it makes sense.
fn direction<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, axis: char) -> Option<Direction> {
    let mut number = |name: &str| usize::try_from(context.get_authored::<i32>(prim, &format!("{axis}{name}"))?).ok();
    let (count, order) = (number("VertexCount")?, number("Order")?);
    let knots: Vec<f64> = context.get_authored::<Vec<f32>>(prim, &format!("{axis}Knots"))?.into_iter().map(f64::from).collect();
    let rises = knots.windows(2).all(|pair| pair[0] <= pair[1]) && knots.iter().all(|knot| knot.is_finite());
    if !(2..=HIGHEST).contains(&order) || order > count || knots.len() != count + order || !rises {
        return None;
    }
    let whole = [knots[order - 1], knots[count]];
    let stated = context.get_authored::<[f64; 2]>(prim, &format!("{axis}Range"));
    let range = stated.map_or(whole, |[low, high]| [low.max(whole[0]), high.min(whole[1])]);
    (range[0] < range[1]).then_some(Direction { count, order, knots, range })
}

/// Which control points count at a parameter, and by how much; the second row is the derivative.
#[derive(Debug)]
struct Sample {
    first: usize,
    values: Vec<[f64; 2]>,
}

impl Direction {
    /// Samples at evenly spaced parameters within each of the spans that are not empty.
    fn samples(&self, pieces: usize) -> Vec<Sample> {
        let [low, high] = self.range;
        let mut ends: Vec<f64> = self.knots.iter().copied().filter(|knot| (low..=high).contains(knot)).chain(self.range).collect();
        ends.sort_unstable_by(f64::total_cmp);
        ends.dedup();
        let pieces = pieces.min((MOST_QUADS / ends.len()).max(1));
        let mut samples = vec![self.sample(low)];
        for pair in ends.windows(2) {
            samples.extend((1..=pieces).map(|piece| self.sample(pair[0] + (pair[1] - pair[0]) * piece as f64 / pieces as f64)));
        }
        samples
    }

    /// The basis functions at a parameter (Cox and de Boor), and their derivatives.
    fn sample(&self, t: f64) -> Sample {
        let degree = self.order - 1;
        // The last span that begins before t and is not empty; the range's end belongs to the last one.
        let begins = |span: usize| self.knots[span] <= t && self.knots[span] < self.knots[span + 1];
        let span = (degree..self.count).rev().find(|&span| begins(span)).unwrap_or(degree);
        let (mut values, mut lower) = (vec![0.0; self.order], vec![0.0; self.order]);
        values[degree] = 1.0;
        for level in 1..=degree {
            if level == degree {
                lower.copy_from_slice(&values);
            }
            // Functions of this level that are not zero here, from the first on.
            for at in degree - level..=degree {
                let number = span - degree + at;
                let rising = self.share(number, level, t) * values[at];
                let falling = if at < degree { (1.0 - self.share(number + 1, level, t)) * values[at + 1] } else { 0.0 };
                values[at] = rising + falling;
            }
        }
        let slope = |at: usize| {
            let number = span - degree + at;
            let part = |number: usize, value: f64| {
                let width = self.knots[number + degree] - self.knots[number];
                if width > 0.0 { degree as f64 * value / width } else { 0.0 }
            };
            part(number, lower[at]) - if at < degree { part(number + 1, lower[at + 1]) } else { 0.0 }
        };
        Sample { first: span - degree, values: (0..self.order).map(|at| [values[at], slope(at)]).collect() }
    }

    /// How far t is on the way over `level` spans from a knot on.
    fn share(&self, knot: usize, level: usize, t: f64) -> f64 {
        let [low, high] = [self.knots[knot], self.knots[knot + level]];
        if high > low { (t - low) / (high - low) } else { 0.0 }
    }
}

/// Samples of a patch.
struct Grid {
    u: Vec<Sample>,
    v: Vec<Sample>,
    /// Control points along u, which go fastest.
    width: usize,
}

impl Grid {
    /// Sums over the control points at a place of the grid: values, and derivatives along u and v.
    fn sums<const N: usize>(&self, [i, j]: [usize; 2], control: &[[f64; N]]) -> [[f64; N]; 3] {
        let mut sums = [[0.0; N]; 3];
        for (row, [v, dv]) in self.v[j].values.iter().enumerate() {
            for (column, [u, du]) in self.u[i].values.iter().enumerate() {
                let point = &control[(self.v[j].first + row) * self.width + self.u[i].first + column];
                for (axis, x) in point.iter().enumerate() {
                    sums[0][axis] += u * v * x;
                    sums[1][axis] += du * v * x;
                    sums[2][axis] += u * dv * x;
                }
            }
        }
        sums
    }

    fn places(&self) -> impl Iterator<Item = [usize; 2]> {
        let width = self.u.len();
        (0..width * self.v.len()).map(move |at| [at % width, at / width])
    }

    fn polygons(&self, control: &[Control]) -> PolygonMesh {
        let (mut points, mut normals) = (Vec::new(), Vec::new());
        for place in self.places() {
            let [at, along_u, along_v] = self.sums(place, control);
            let weight = if at[3] == 0.0 { 1.0 } else { at[3] };
            let point = [0, 1, 2].map(|k| at[k] / weight);
            // The quotient rule, but for a factor that the normal does not see.
            let slope = |d: [f64; 4]| [0, 1, 2].map(|k| d[k] - d[3] * point[k]);
            points.push(point.map(|x| x as f32));
            normals.push(unit_cross(slope(along_u), slope(along_v)));
        }
        let (width, height) = (self.u.len() as u32, self.v.len() as u32);
        let mut corners = Vec::new();
        for j in 0..height - 1 {
            for i in 0..width - 1 {
                let first = j * width + i;
                corners.extend([first, first + 1, first + width + 1, first + width]);
            }
        }
        let mut polygons = PolygonMesh { points, face_counts: vec![4; corners.len() / 4], corners, ..PolygonMesh::default() };
        // At poles a direction vanishes; there the normal beside does.
        let beside = |[i, j]: [usize; 2]| {
            let near = [[i, j + 1], [i, j.wrapping_sub(1)], [i + 1, j], [i.wrapping_sub(1), j]];
            near.into_iter().filter(|[i, j]| *i < self.u.len() && *j < self.v.len()).find_map(|[i, j]| normals[j * self.u.len() + i])
        };
        let filled: Option<Vec<[f32; 3]>> = self.places().zip(&normals).map(|(place, normal)| normal.or_else(|| beside(place))).collect();
        if let Some(filled) = filled {
            polygons.primvars.push(of_points("normals", 3, filled.into_flattened()));
        }
        polygons
    }

    /// A primvar of the control points over the grid.
    fn carried(&self, primvar: &FacePrimvar, weights: &[f64]) -> FacePrimvar {
        let mut values = vec![0.0; self.u.len() * self.v.len() * primvar.components];
        for component in 0..primvar.components {
            let value = |point: usize| primvar.at(point).map_or(0.0, |value| f64::from(value[component]));
            let control: Vec<[f64; 2]> = weights.iter().enumerate().map(|(point, weight)| [value(point) * weight, *weight]).collect();
            for (at, place) in self.places().enumerate() {
                let [[sum, weight], ..] = self.sums(place, &control);
                values[at * primvar.components + component] = (sum / if weight == 0.0 { 1.0 } else { weight }) as f32;
            }
        }
        of_points(&primvar.name, primvar.components, values)
    }
}

fn of_points(name: &str, components: usize, values: Vec<f32>) -> FacePrimvar {
    FacePrimvar { name: name.to_owned(), interpolation: Interpolation::Vertex, components, values, indices: None }
}

fn unit_cross(a: [f64; 3], b: [f64; 3]) -> Option<[f32; 3]> {
    let n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let length = n.iter().map(|x| x * x).sum::<f64>().sqrt();
    let size = |v: [f64; 3]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    (length > 1e-9 * size(a) * size(b) && length.is_finite()).then(|| n.map(|x| (x / length) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter of a circle as a rational curve of order 3.
    fn quarter() -> Direction {
        Direction { count: 3, order: 3, knots: vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], range: [0.0, 1.0] }
    }

    fn straight() -> Direction {
        Direction { count: 2, order: 2, knots: vec![0.0, 0.0, 1.0, 1.0], range: [0.0, 1.0] }
    }

    #[test]
    fn a_quarter_of_a_cylinder_is_round_with_exact_normals() {
        let half = std::f64::consts::FRAC_1_SQRT_2;
        let arc = [[1.0, 0.0, 1.0], [1.0, 1.0, half], [0.0, 1.0, 1.0]];
        let control: Vec<Control> = [0.0, 2.0].iter().flat_map(|z| arc.map(|[x, y, w]| [x * w, y * w, z * w, w])).collect();
        let grid = Grid { u: quarter().samples(8), v: straight().samples(2), width: 3 };
        let polygons = grid.polygons(&control);
        assert_eq!((polygons.points.len(), polygons.face_counts.len()), (9 * 3, 16));
        let normals = &polygons.primvars[0].values;
        for (at, [x, y, _]) in polygons.points.iter().enumerate() {
            assert!((x.hypot(*y) - 1.0).abs() < 1e-6);
            assert!((normals[3 * at] - x).abs() < 1e-6 && (normals[3 * at + 1] - y).abs() < 1e-6);
        }
    }

    #[test]
    fn basis_functions_sum_to_one_and_their_slopes_to_zero() {
        let knots = vec![0.0, 0.0, 0.0, 0.0, 0.3, 0.3, 0.8, 1.0, 1.0, 1.0, 1.0];
        let direction = Direction { count: 7, order: 4, knots, range: [0.0, 1.0] };
        for step in 0..=50 {
            let t = f64::from(step) / 50.0;
            let sample = direction.sample(t);
            let sums = sample.values.iter().fold([0.0; 2], |sum, value| [sum[0] + value[0], sum[1] + value[1]]);
            assert!((sums[0] - 1.0).abs() < 1e-12 && sums[1].abs() < 1e-9, "{t}: {sums:?}");
        }
    }
}
