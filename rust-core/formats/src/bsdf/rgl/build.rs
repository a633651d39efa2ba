//! An RGL measurement of a known BRDF, as if it had been measured: Dupuy and Jakob (2018), sections 3 and 4.
//!
//! Departure: the backscatter that the distribution of normals is found from is asked of the BRDF at as many directions as the table has.

use core::f64::consts::{PI, TAU};

use super::super::colour::{Channels, LUMINANCE};
use super::super::direction::{Direction, angles_of, dot, reflected, solid_angle_per_square, spherical};
use super::super::warp::{Interpolant, Warp};
use super::Rgl;
use crate::error::{FormatError, Result};

/// Rounds of the power iteration; its error falls by a factor of about ten in each.
const ROUNDS: usize = 8;

/// The least share of the largest density of normals, so that dividing by it stays possible.
const LEAST_DENSITY: f32 = 1e-6;

/// On what grid a BRDF is written down.
#[derive(Clone, Debug, PartialEq)]
pub struct RglGrid {
    /// φo, radians: one for an isotropic material, else a full turn with both ends.
    pub phi: Vec<f32>,
    /// θo, radians.
    pub theta: Vec<f32>,
    /// Nodes over normals: polar and azimuth.
    pub normals: [usize; 2],
    /// Nodes along each side of the warped square.
    pub resolution: usize,
}

impl RglGrid {
    /// An isotropic grid: `theta` angles from 0 to `last` radians at equal steps.
    pub fn isotropic(theta: usize, last: f64, normals: [usize; 2], resolution: usize) -> Self {
        let step = last / (theta.max(2) - 1) as f64;
        Self { phi: vec![0.0], theta: (0..theta).map(|i| (step * i as f64) as f32).collect(), normals, resolution }
    }

    /// An anisotropic grid: `phi` azimuths over a full turn with both ends.
    pub fn anisotropic(phi: usize, theta: usize, last: f64, normals: [usize; 2], resolution: usize) -> Self {
        let step = TAU / (phi.max(4) - 1) as f64;
        let phi = (0..phi.max(4)).map(|i| (step * i as f64 - PI) as f32).collect();
        Self { phi, ..Self::isotropic(theta, last, normals, resolution) }
    }

    fn check(&self) -> Result<()> {
        let increasing = |knots: &[f32]| !knots.is_empty() && knots.windows(2).all(|w| w[0] < w[1]);
        let fits = increasing(&self.phi) && increasing(&self.theta) && self.normals.iter().all(|&n| n >= 2) && self.resolution >= 2;
        if fits { Ok(()) } else { Err(FormatError::whole("a grid needs increasing angles and at least two nodes along each side")) }
    }
}

impl Rgl {
    /// A BRDF as RGL's database would have it. `value` gives BRDF × |cos| of `wi` in linear Rec.709 for (wi, wo).
    ///
    /// # Errors
    /// When the grid has less than two nodes along a side or its angles do not increase.
    pub fn from_function(grid: &RglGrid, description: &str, value: impl Fn(Direction, Direction) -> [f64; 3]) -> Result<Self> {
        grid.check()?;
        let (ndf, sigma) = normals(grid, &value);
        let vndf = visible_normals(grid, &ndf);
        let mut rgb = Vec::new();
        let mut luminance = Vec::new();
        for &phi in &grid.phi {
            for &theta in &grid.theta {
                let slice = warped(grid, &ndf, &sigma, &vndf, [phi.into(), theta.into()], &value);
                (0..3).for_each(|c| rgb.extend(slice.iter().map(|v| v[c] as f32)));
                luminance.extend(slice.iter().map(|v| (v[0] * LUMINANCE[0] + v[1] * LUMINANCE[1] + v[2] * LUMINANCE[2]) as f32));
            }
        }
        let (rows, columns) = (grid.resolution, grid.resolution);
        let parameters = vec![grid.phi.clone(), grid.theta.clone()];
        let channels = vec![0.0, 1.0, 2.0];
        Ok(Self {
            description: description.into(),
            jacobian: true,
            channels: Channels::Rgb,
            ndf,
            sigma,
            vndf,
            luminance: Warp::new(Interpolant { parameters: parameters.clone(), columns, rows, data: luminance }),
            spectra: Interpolant { parameters: [parameters, vec![channels]].concat(), columns, rows, data: rgb },
        })
    }
}

/// A node's place in the square.
fn node(column: usize, row: usize, columns: usize, rows: usize) -> [f64; 2] {
    [column as f64 / (columns - 1) as f64, row as f64 / (rows - 1) as f64]
}

/// Distribution of normals and projected area by power iteration: backscatter at a direction is `D(i) / (4 σ(i) cos θi)`.
fn normals(grid: &RglGrid, value: &impl Fn(Direction, Direction) -> [f64; 3]) -> (Interpolant, Interpolant) {
    // An isotropic distribution has one row to find; the file wants two.
    let isotropic = grid.phi.len() == 1;
    let (columns, rows) = (grid.normals[0], if isotropic { 2 } else { grid.normals[1] });
    let found = if isotropic { 1 } else { rows };
    let directions: Vec<Direction> = (0..found * columns)
        .map(|i| angles_of(node(i % columns, i / columns, columns, rows)))
        .map(|(theta, phi)| spherical(theta, if isotropic { 0.0 } else { phi }))
        .collect();
    let backscatter: Vec<f64> = directions.iter().map(|&d| value(d, d).iter().zip(LUMINANCE).map(|(v, w)| v * w).sum()).collect();

    let quadrature = quadrature(columns, if isotropic { 2 * grid.normals[1] } else { rows }, isotropic);
    let mut density = vec![1.0; directions.len()];
    let mut area = projected_areas(&directions, &density, &quadrature);
    for _ in 0..ROUNDS {
        density = backscatter.iter().zip(&area).map(|(b, a)| 4.0 * a * b).collect();
        let total: f64 = quadrature.iter().map(|q| q.weight * q.direction[2] * density[q.node]).sum();
        let largest = density.iter().copied().fold(0.0, f64::max);
        let scale = if total > 0.0 { 1.0 / total } else { 1.0 };
        density.iter_mut().for_each(|d| *d = d.max(largest * f64::from(LEAST_DENSITY)).max(f64::MIN_POSITIVE) * scale);
        area = projected_areas(&directions, &density, &quadrature);
    }
    let plane = |values: &[f64]| {
        let data = values.iter().cycle().take(rows * columns).map(|&v| v as f32).collect();
        Interpolant { parameters: Vec::new(), columns, rows, data }
    };
    (plane(&density), plane(&area))
}

/// A direction of a quadrature over the hemisphere, its solid angle, and the node whose density holds there.
struct Point {
    direction: Direction,
    weight: f64,
    node: usize,
}

/// The trapezoidal rule over the square of normals.
fn quadrature(columns: usize, rows: usize, isotropic: bool) -> Vec<Point> {
    let end = |i: usize, n: usize| if i == 0 || i + 1 == n { 0.5 } else { 1.0 } / (n - 1) as f64;
    (0..rows * columns)
        .map(|i| {
            let (column, row) = (i % columns, i / columns);
            let square = node(column, row, columns, rows);
            let (theta, phi) = angles_of(square);
            let weight = solid_angle_per_square(square[0]) * end(column, columns) * end(row, rows);
            Point { direction: spherical(theta, phi), weight, node: if isotropic { column } else { i } }
        })
        .collect()
}

/// The projected area of facets with that density of normals, seen from each direction.
fn projected_areas(directions: &[Direction], density: &[f64], quadrature: &[Point]) -> Vec<f64> {
    let seen = |d: &Direction| quadrature.iter().map(|q| q.weight * density[q.node] * dot(*d, q.direction).max(0.0)).sum::<f64>();
    directions.iter().map(|d| seen(d).max(f64::MIN_POSITIVE)).collect()
}

/// The visible normals from each parameter direction. The projected area drops out when slices are scaled.
fn visible_normals(grid: &RglGrid, ndf: &Interpolant) -> Warp {
    let [columns, rows] = grid.normals;
    let still = ndf.blend(&[]);
    let mut data = Vec::with_capacity(grid.phi.len() * grid.theta.len() * rows * columns);
    for &phi in &grid.phi {
        for &theta in &grid.theta {
            let wo = spherical(theta.into(), phi.into());
            for i in 0..rows * columns {
                let square = node(i % columns, i / columns, columns, rows);
                let (theta, about) = angles_of(square);
                let normal = spherical(theta, about + if grid.phi.len() == 1 { f64::from(phi) } else { 0.0 });
                data.push((ndf.eval(square, &still) * dot(wo, normal).max(0.0) * solid_angle_per_square(square[0])) as f32);
            }
        }
    }
    Warp::new(Interpolant { parameters: vec![grid.phi.clone(), grid.theta.clone()], columns, rows, data })
}

/// The BRDF over the warped square of one parameter direction, with `ndf / (4 sigma)` taken out.
fn warped(
    grid: &RglGrid,
    ndf: &Interpolant,
    sigma: &Interpolant,
    vndf: &Warp,
    [phi, theta]: [f64; 2],
    value: &impl Fn(Direction, Direction) -> [f64; 3],
) -> Vec<[f64; 3]> {
    let wo = spherical(theta, phi);
    let still = ndf.blend(&[]);
    let blend = vndf.density.blend(&[phi, theta]);
    let area = 4.0 * sigma.eval(super::square_of(theta, phi), &still);
    let n = grid.resolution;
    (0..n * n)
        .map(|i| {
            let (square, _) = vndf.sample(node(i % n, i / n, n, n), &blend);
            let (polar, about) = angles_of(square);
            let normal = spherical(polar, about + if grid.phi.len() == 1 { phi } else { 0.0 });
            let wi = reflected(wo, normal);
            if wi[2] <= 0.0 {
                return [0.0; 3];
            }
            value(wi, wo).map(|v| v * area / ndf.eval(square, &still))
        })
        .collect()
}
