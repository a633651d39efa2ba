//! Texels of a surface's texture coordinates, and how many square metres of it lie in each: triangles are cut by the texels' borders.

use super::{options::MOST_SIDE, surface::MappedSurface};
use crate::{
    error::{Error, Result},
    scene::{Mesh, Primvar, PrimvarInterpolation},
};

/// The texels of a surface; rows from the top, where the second coordinate is 1. Coordinates beyond 0 to 1 repeat.
#[derive(Clone, Debug)]
pub struct TexelChart {
    /// Width and height.
    size: [u32; 2],
    /// Coordinates of the triangles' corners; all the same where they enclose nothing.
    corners: Vec<[[f32; 2]; 3]>,
    /// Square metres of the surface in each texel.
    areas: Vec<f64>,
    /// Texels that several parts of the surface share.
    shared: usize,
}

/// A texel that is covered beyond this is shared.
const FULL: f32 = 1.0 + 1e-3;
/// Coordinates beyond this make no map.
const FARTHEST: f32 = 1024.0;

/// The coordinates of a mesh's corners.
pub(super) fn coordinates(mesh: &Mesh, name: &str, surface: &MappedSurface) -> Result<Vec<[[f32; 2]; 3]>> {
    let wrong = |problem: String| Error::scene(&surface.origin, problem);
    let primvar = mesh.primvar(name).ok_or_else(|| {
        let known: Vec<&str> = mesh.primvars.iter().filter(|primvar| primvar.components >= 2).map(|primvar| &*primvar.name).collect();
        let known = if known.is_empty() { "it has none".to_owned() } else { format!("it has {}", known.join(", ")) };
        wrong(format!("there are no texture coordinates '{name}' ({known}); without a name of coordinates triangles are divided instead"))
    })?;
    let corner =
        |triangle: usize, corner: usize| value(primvar, mesh, triangle, corner).filter(|uv| uv.iter().all(|x| x.abs() <= FARTHEST));
    let of_triangle = |triangle: usize| {
        let [Some(a), Some(b), Some(c)] = [0, 1, 2].map(|number| corner(triangle, number)) else {
            return Err(wrong(format!(
                "texture coordinates '{name}' of triangle {triangle} are missing, not finite, or beyond {FARTHEST}"
            )));
        };
        Ok([a, b, c])
    };
    (0..mesh.triangles.len()).map(of_triangle).collect()
}

/// The first two components at a corner.
fn value(primvar: &Primvar, mesh: &Mesh, triangle: usize, corner: usize) -> Option<[f32; 2]> {
    let components = usize::from(primvar.components);
    let element = match primvar.interpolation {
        PrimvarInterpolation::Vertex | PrimvarInterpolation::Varying => mesh.triangles[triangle][corner] as usize,
        PrimvarInterpolation::FaceVarying => 3 * triangle + corner,
        PrimvarInterpolation::Constant | PrimvarInterpolation::Uniform => return None,
    };
    let element = match &primvar.indices {
        Some(indices) => *indices.get(element)? as usize,
        None => element,
    };
    let values = primvar.values.get(element * components..(element + 1) * components)?;
    Some([*values.first()?, *values.get(1)?])
}

/// Width and height at which texels are so many metres wide and high in the mean.
pub(super) fn resolution(surface: &MappedSurface, mesh: &Mesh, corners: &[[[f32; 2]; 3]], metres: f64) -> [u32; 2] {
    let mut squares = [0.0; 2];
    for (triangle, (uv, area)) in corners.iter().zip(&surface.areas).enumerate() {
        let [a, b, c] = uv.map(|corner| corner.map(f64::from));
        let ([du1, dv1], [du2, dv2]) = ([b[0] - a[0], b[1] - a[1]], [c[0] - a[0], c[1] - a[1]]);
        let determinant = du1 * dv2 - du2 * dv1;
        if determinant.abs() < LEAST_EXTENT {
            continue;
        }
        let [p, q, r] = mesh.triangles[triangle].map(|corner| mesh.points[corner as usize].map(f64::from));
        let edge = |end: [f64; 3]| surface.transform.vector([0, 1, 2].map(|k| end[k] - p[k]));
        let (e1, e2) = (edge(q), edge(r));
        let along = |x1: f64, x2: f64| (0..3).map(|k| ((e1[k] * x1 - e2[k] * x2) / determinant).powi(2)).sum::<f64>();
        squares[0] += area * along(dv2, dv1);
        squares[1] += area * along(-du2, -du1);
    }
    let total = surface.area();
    squares.map(|square| ((square / total).sqrt() / metres).ceil().clamp(1.0, f64::from(MOST_SIDE)) as u32)
}

/// Twice the area in texture coordinates below which a triangle encloses nothing.
const LEAST_EXTENT: f64 = 1e-14;

impl TexelChart {
    /// Finds out what lies in each texel.
    pub(super) fn new(size: [u32; 2], mut corners: Vec<[[f32; 2]; 3]>, areas: &[f64]) -> Self {
        let count = size[0] as usize * size[1] as usize;
        let (mut texels, mut covers) = (vec![0.0; count], vec![0.0f32; count]);
        for (uv, area) in corners.iter_mut().zip(areas) {
            let placed = uv.map(|[u, v]| [f64::from(u) * f64::from(size[0]), (1.0 - f64::from(v)) * f64::from(size[1])]);
            let extent = polygon_area(&placed);
            if extent < LEAST_EXTENT * f64::from(size[0]) * f64::from(size[1]) {
                // Its light goes where its middle is.
                *uv = [[0, 1].map(|k| (uv[0][k] + uv[1][k] + uv[2][k]) / 3.0); 3];
                texels[texel_at(size, uv[0])] += area;
                continue;
            }
            cut(&placed, size, |texel, part| {
                texels[texel] += area * part / extent;
                covers[texel] += part as f32;
            });
        }
        let shared = covers.iter().filter(|cover| **cover > FULL).count();
        Self { size, corners, areas: texels, shared }
    }

    /// Width and height.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }
    /// Texels.
    pub fn len(&self) -> usize {
        self.areas.len()
    }
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.areas.is_empty()
    }
    /// Square metres of the surface in each texel; 0 where there is nothing of it.
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }
    /// Texels that several parts of the surface share, which get their mean.
    pub fn shared(&self) -> usize {
        self.shared
    }
    /// Texture coordinates at barycentric coordinates of corners 1 and 2.
    pub fn coordinates(&self, triangle: u32, [u, v]: [f32; 2]) -> [f32; 2] {
        let [a, b, c] = self.corners[triangle as usize];
        let w = 1.0 - u - v;
        [0, 1].map(|k| a[k] * w + b[k] * u + c[k] * v)
    }
    /// The texel at barycentric coordinates of corners 1 and 2.
    pub fn cell(&self, triangle: u32, place: [f32; 2]) -> usize {
        texel_at(self.size, self.coordinates(triangle, place))
    }
    /// Bytes held.
    pub(super) fn memory(triangles: usize, texels: u64) -> u64 {
        // The covers are needed while it is made.
        triangles as u64 * 24 + texels * 12
    }
}

/// The texel that coordinates lie in.
fn texel_at([width, height]: [u32; 2], [u, v]: [f32; 2]) -> usize {
    let place = |x: f64, side: u32| (x.floor() as i64).rem_euclid(i64::from(side)) as usize;
    let column = place(f64::from(u) * f64::from(width), width);
    // Rows are counted from the top, where 1 is.
    let row = place((1.0 - f64::from(v)) * f64::from(height), height);
    row * width as usize + column
}

/// Area of a polygon.
fn polygon_area(points: &[[f64; 2]]) -> f64 {
    let Some(first) = points.first() else { return 0.0 };
    let edge = |p: &[f64; 2]| [p[0] - first[0], p[1] - first[1]];
    let cross = |pair: &[[f64; 2]]| {
        let ([ax, ay], [bx, by]) = (edge(&pair[0]), edge(&pair[1]));
        ax * by - bx * ay
    };
    0.5 * points.windows(2).map(cross).sum::<f64>().abs()
}

/// The part of a polygon where a coordinate is at least (or, turned, at most) a bound (Sutherland and Hodgman).
fn clip(points: &[[f64; 2]], axis: usize, bound: f64, sign: f64, out: &mut Vec<[f64; 2]>) {
    out.clear();
    let inside = |p: &[f64; 2]| sign * (p[axis] - bound);
    for (number, point) in points.iter().enumerate() {
        let before = &points[(number + points.len() - 1) % points.len()];
        let (a, b) = (inside(before), inside(point));
        if (a < 0.0) != (b < 0.0) {
            let t = a / (a - b);
            out.push([0, 1].map(|k| if k == axis { bound } else { before[k] + t * (point[k] - before[k]) }));
        }
        if b >= 0.0 {
            out.push(*point);
        }
    }
}

/// Tells the texels that a triangle meets, and how much of it lies in each, in texels.
fn cut(triangle: &[[f64; 2]; 3], [width, height]: [u32; 2], mut tell: impl FnMut(usize, f64)) {
    let (mut half, mut row, mut rest, mut part) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let bounds = |points: &[[f64; 2]], axis: usize| {
        let values = || points.iter().map(|point| point[axis]);
        (values().fold(f64::MAX, f64::min).floor() as i64, values().fold(f64::MIN, f64::max).ceil() as i64)
    };
    let (top, bottom) = bounds(triangle, 1);
    for y in top..bottom.max(top + 1) {
        clip(triangle, 1, y as f64, 1.0, &mut half);
        clip(&half, 1, (y + 1) as f64, -1.0, &mut row);
        if row.len() < 3 {
            continue;
        }
        let (left, right) = bounds(&row, 0);
        for x in left..right.max(left + 1) {
            clip(&row, 0, x as f64, 1.0, &mut rest);
            clip(&rest, 0, (x + 1) as f64, -1.0, &mut part);
            let area = polygon_area(&part);
            if area > 0.0 {
                let wrapped = |at: i64, side: u32| at.rem_euclid(i64::from(side)) as usize;
                tell(wrapped(y, height) * width as usize + wrapped(x, width), area);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(side: f32, offset: [f32; 2]) -> Vec<[[f32; 2]; 3]> {
        let at = |x: f32, y: f32| [offset[0] + x * side, offset[1] + y * side];
        vec![[at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0)], [at(0.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]]
    }

    #[test]
    fn texels_hold_the_surface_to_the_border() {
        let chart = TexelChart::new([8, 4], square(0.55, [0.1, 0.2]), &[3.0, 3.0]);
        assert!((chart.areas().iter().sum::<f64>() - 6.0).abs() < 1e-12);
        // A whole texel is 1/32 of the coordinates' square, the surface 0.3025 of it.
        let whole = 6.0 / 0.3025 / 32.0;
        assert!((chart.areas()[2 * 8 + 2] - whole).abs() < 1e-6, "{:?}", chart.areas());
        // The first column is covered from 0.1 to 0.125, the last row from 0.2 to 0.25.
        assert!((chart.areas()[2 * 8] / whole - 0.2).abs() < 1e-5, "{:?}", chart.areas());
        assert!((chart.areas()[3 * 8 + 2] / whole - 0.2).abs() < 1e-5);
        assert_eq!(chart.shared(), 0);
    }

    #[test]
    fn coordinates_repeat_and_shared_texels_are_told() {
        let chart = TexelChart::new([4, 4], square(2.0, [0.0, 0.0]), &[1.0, 1.0]);
        assert_eq!(chart.shared(), 16);
        assert!(chart.areas().iter().all(|area| (area - 0.125).abs() < 1e-9));
        assert_eq!(chart.cell(0, [0.9, 0.05]), texel_at([4, 4], [1.9, 0.1]));
        assert_eq!(texel_at([4, 4], [0.1, 0.9]), 0);
        assert_eq!(texel_at([4, 4], [-0.1, 0.1]), 15);
    }

    #[test]
    fn triangles_without_extent_keep_their_light_in_one_texel() {
        let chart = TexelChart::new([4, 4], vec![[[0.1, 0.1], [0.9, 0.9], [0.5, 0.5]]], &[2.0]);
        let texel = chart.cell(0, [0.9, 0.05]);
        assert_eq!((texel, chart.areas()[texel]), (chart.cell(0, [0.0, 0.9]), 2.0));
    }
}
