//! Where a grid's points lie.

use super::{
    eyes::facings,
    outline::{Lattice, Outline},
    vector::{Vector, across, add, cross, length, scaled, unit},
};
use crate::{
    error::{Error, Result},
    scene::{Grid, GridArea, MeshId, Meter, Scene, Transform},
};

/// Most points of all grids and meters of a scene.
pub const MOST_POINTS: usize = 1 << 18;

/// The points of a grid, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct GridPoints {
    /// Points in a row, and rows.
    pub size: [usize; 2],
    /// Metres from point to point, along a row and from row to row.
    pub spacing: [f64; 2],
    /// World space, metres; none where the area does not reach.
    pub positions: Vec<Option<Vector>>,
    /// Unit normal of the area.
    pub normal: Vector,
    /// Square metres of the whole surface, margins included, seen along the normal.
    pub area: f64,
    /// Where eyes at each point look, unit vectors; empty where the area's plane is measured.
    pub facings: Vec<Vector>,
}

impl GridPoints {
    /// Lays a grid out.
    ///
    /// # Errors
    /// An area without extent, lengths that are not finite, more than [`MOST_POINTS`] points, or eyes that look nowhere.
    pub fn new(scene: &Scene, grid: &Grid) -> Result<Self> {
        let lengths = [grid.spacing, grid.margin, grid.height];
        if lengths.iter().any(|length| !length.is_finite()) || grid.spacing < 0.0 || grid.margin < 0.0 {
            let [spacing, margin, height] = lengths;
            let found = format!("a grid with spacing {spacing} m, margin {margin} m and height {height} m");
            return Err(Error::scene(&grid.origin, format!("{found}, expected finite ones, the first two not below 0")));
        }
        let planes = match &grid.area {
            GridArea::Rectangle { corner, edges } => rectangle(grid, *corner, *edges),
            GridArea::Mesh { mesh, transform } => self::mesh(scene, grid, *mesh, transform),
        }?;
        Ok(Self { facings: facings(grid, planes.normal)?, ..planes })
    }

    /// The points as meters of the grid's plane.
    pub fn planes<'a>(&'a self, grid: &'a Grid) -> impl Iterator<Item = Meter> + 'a {
        self.known().map(|position| Meter {
            origin: grid.origin.clone(),
            position,
            normal: self.normal,
            facing: grid.facing,
            measurand: grid.measurand,
        })
    }

    /// What the grid measures: its planes, or point by point its eyes, each of which is the plane before it.
    pub fn meters<'a>(&'a self, grid: &'a Grid) -> impl Iterator<Item = Meter> + 'a {
        let looking = |plane: Meter| self.facings.iter().map(move |facing| Meter { normal: *facing, facing: *facing, ..plane.clone() });
        let planes = self.planes(grid).filter(|_| self.facings.is_empty());
        planes.chain(self.planes(grid).flat_map(looking))
    }

    /// How many of [`Self::meters`] there are.
    pub fn count(&self) -> usize {
        self.known().count() * self.facings.len().max(1)
    }

    /// Lays a scene's grids out, beside its meters.
    ///
    /// # Errors
    /// As [`Self::new`], or more than [`MOST_POINTS`] points in all.
    pub fn of_scene(scene: &Scene) -> Result<Vec<Self>> {
        let mut count = scene.meters.len();
        let laid_out = |grid| {
            let points = Self::new(scene, grid)?;
            count += points.count();
            if count > MOST_POINTS {
                return Err(Error::setting("grids", format!("more than {MOST_POINTS} points in all; take a wider spacing")));
            }
            Ok(points)
        };
        scene.grids.iter().map(laid_out).collect()
    }

    /// Where the points are.
    pub fn known(&self) -> impl Iterator<Item = Vector> {
        self.positions.iter().copied().flatten()
    }
}

/// Metres from point to point by EN 12464-1: d over the whole number next to d / p with p = 0.2 · 5^(log10 d), at most 10, where d is the longer
/// side, or the shorter where that is less than half.
fn standard_spacing(sides: [f64; 2]) -> f64 {
    let (long, short) = (sides[0].max(sides[1]), sides[0].min(sides[1]));
    let d = if long >= 2.0 * short { short } else { long };
    let most = (0.2 * 5f64.powf(d.log10())).min(10.0);
    d / (d / most).round().max(1.0)
}

/// Points and metres from one to the next along sides of a length.
fn cells(grid: &Grid, sides: [f64; 2]) -> Result<([usize; 2], [f64; 2])> {
    if sides.iter().any(|side| !(side.is_finite() && *side > 0.0)) {
        let [width, depth] = sides;
        let problem = format!("the grid's area is {width:.3} × {depth:.3} m without its margin; there is nothing to measure");
        return Err(Error::scene(&grid.origin, problem));
    }
    let spacing = if grid.spacing > 0.0 { grid.spacing } else { standard_spacing(sides) };
    let counts = sides.map(|side| (side / spacing).round().max(1.0));
    if counts[0] * counts[1] > MOST_POINTS as f64 {
        let problem = format!("the grid has {:.0} points, expected at most {MOST_POINTS}; take a wider spacing", counts[0] * counts[1]);
        return Err(Error::scene(&grid.origin, problem));
    }
    Ok((counts.map(|count| count as usize), [0, 1].map(|axis| sides[axis] / counts[axis])))
}

fn rectangle(grid: &Grid, corner: Vector, edges: [Vector; 2]) -> Result<GridPoints> {
    let flat = || Error::scene(&grid.origin, "the grid's rectangle has no area");
    let normal = unit(cross(edges[0], edges[1])).ok_or_else(flat)?;
    let sides = edges.map(length);
    // The margin is across the edges, which a parallelogram's other edge meets at an angle.
    let area = length(cross(edges[0], edges[1]));
    let inset = grid.margin * sides[0] * sides[1] / area;
    let (size, spacing) = cells(grid, sides.map(|side| side - 2.0 * inset))?;
    let along = [0, 1].map(|axis| scaled(edges[axis], 1.0 / sides[axis]));
    let first = add(add(corner, scaled(normal, grid.height)), scaled(add(along[0], along[1]), inset));
    let place = |index: usize| {
        let [column, row] = [index % size[0], index / size[0]].map(|number| number as f64 + 0.5);
        Some(add(first, add(scaled(along[0], column * spacing[0]), scaled(along[1], row * spacing[1]))))
    };
    Ok(GridPoints { size, spacing, positions: (0..size[0] * size[1]).map(place).collect(), normal, area, facings: Vec::new() })
}

fn mesh(scene: &Scene, grid: &Grid, mesh: MeshId, transform: &Transform) -> Result<GridPoints> {
    let missing = || Error::scene(&grid.origin, format!("the grid wants mesh {}, the scene has {}", mesh.0, scene.meshes.len()));
    let outline = Outline::new(scene.meshes.get(mesh.index()).ok_or_else(missing)?, transform, grid)?;
    let [low, high] = outline.extent();
    let (size, spacing) = cells(grid, [0, 1].map(|axis| high[axis] - low[axis] - 2.0 * grid.margin))?;
    let first = [0, 1].map(|axis| low[axis] + grid.margin + 0.5 * spacing[axis]);
    let positions = outline.above(&Lattice { first, spacing, size }, grid.margin, grid.height);
    if positions.iter().all(Option::is_none) {
        return Err(Error::scene(&grid.origin, "the margin leaves nothing of the grid's surface, or it is narrower than a cell"));
    }
    Ok(GridPoints { size, spacing, positions, normal: outline.normal(), area: outline.area(), facings: Vec::new() })
}

/// Two unit vectors across a normal: the first as near to `wish` as can be.
pub(super) fn axes(normal: Vector, wish: Vector) -> [Vector; 2] {
    let first = across(normal, wish);
    [first, cross(normal, first)]
}
