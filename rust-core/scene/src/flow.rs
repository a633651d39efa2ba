//! Flows: how what fields hold moves while the shutter is open, by straight ways.

use super::{Lattice, Transform};
use gonio_volume::{BRICK_EDGE, BRICK_VOXELS, Grid, Sampler, Storage, open};
use serde::{Deserialize, Serialize};
use std::{collections::BTreeSet, path::Path};

/// The flow of a field.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Flow {
    /// Cells of the field's lattice along x, y and z, from time 0 of the shutter to time 1.
    pub cells: [Lattice; 3],
    /// The time at which the field's numbers hold.
    pub rests: f32,
    /// The greatest way along each axis, cells.
    pub most: [f32; 3],
}

/// Most blocks of 8³ points on each side of a lattice's own in which a flow is looked for.
const MOST_BESIDE: i32 = 4;

impl Flow {
    /// That of cells along x, y and z of the field's lattice.
    pub fn new(cells: [Lattice; 3], rests: f32) -> Self {
        let most =
            cells.each_ref().map(|lattice| lattice.values.iter().chain(&*lattice.block_values).fold(0.0f32, |most, x| most.max(x.abs())));
        Self { cells, rests, most }
    }

    /// The same by a file's grids, which [`Flow::of_grids`] takes, by their names.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, has no such grids, or they are of no use.
    pub fn read(path: &Path, names: &[String], field: (&Lattice, &Transform), time: f64, rests: f32) -> Result<Self, String> {
        let file = open(path).map_err(|error| error.to_string())?;
        let grids: Result<Vec<Grid>, _> = names.iter().map(|name| file.read_named(name)).collect();
        let grids = grids.map_err(|error| error.to_string())?;
        Self::of_grids(&grids, field, time, rests).map_err(|problem| format!("{}: {problem}", path.display()))
    }

    /// That of a field whose lattice this is, with the map from there to the file's space, by a grid of velocities in that space or by three of one
    /// component each. `time` is how long the shutter is open, in the velocities' unit of time.
    ///
    /// # Errors
    ///
    /// If no velocity is a number, or the grids are neither one of vectors nor three of numbers.
    pub fn of_grids(velocity: &[Grid], (field, to_file): (&Lattice, &Transform), time: f64, rests: f32) -> Result<Self, String> {
        if ![1, 3].contains(&velocity.len()) {
            return Err(format!("{} grids of velocities, expected one of vectors or three of numbers", velocity.len()));
        }
        if let [grid] = velocity
            && grid.values.storage() != Storage::Vector
        {
            return Err(format!("the grid '{}' holds numbers, expected vectors", grid.name));
        }
        let Some(to_lattice) = to_file.inverse() else { return Err("the velocities' voxels are flat".into()) };
        let cells = |velocity: [f64; 3]| to_lattice.vector(velocity).map(|way| (way * time) as f32);
        let cells = match velocity {
            [grid] if is_like(&Transform::from_row_vector_matrix(&grid.transform.0), to_file) => {
                let along = |axis: usize| Lattice::of(grid, None, |v| cells(v.map(f64::from))[axis]);
                [along(0)?, along(1)?, along(2)?]
            }
            _ => resampled(velocity, (field, to_file), cells),
        };
        Ok(Self::new(cells, rests))
    }
}

/// Whether two maps are one but for rounding.
fn is_like(map: &Transform, other: &Transform) -> bool {
    let size = map.columns[..3].as_flattened().iter().fold(0.0f64, |most, x| most.max(x.abs()));
    let room =
        |column: usize| 1e-6 * if column == 3 { size.max(map.columns[3].iter().fold(0.0, |most, x| x.abs().max(most))) } else { size };
    (0..4).all(|column| (0..3).all(|row| (map.columns[column][row] - other.columns[column][row]).abs() <= room(column)))
}

/// A flow at the points of another lattice than its grids', in its blocks and those near by.
fn resampled(velocity: &[Grid], (field, to_file): (&Lattice, &Transform), cells: impl Fn([f64; 3]) -> [f32; 3]) -> [Lattice; 3] {
    let samplers: Vec<(Sampler<'_>, Option<Transform>)> =
        velocity.iter().map(|grid| (Sampler::new(grid), Transform::from_row_vector_matrix(&grid.transform.0).inverse())).collect();
    let component = |of: usize, place: [f64; 3]| {
        let (sampler, to_grid) = &samplers[of.min(samplers.len() - 1)];
        let found = to_grid.as_ref().map_or([0.0; 3], |to_grid| sampler.trilinear(to_grid.point(place)));
        let x = if samplers.len() == 1 { found[of] } else { found[0] };
        if x.is_finite() { x } else { 0.0 }
    };
    let at = |point: [i32; 3]| {
        let place = to_file.point(point.map(f64::from));
        cells([0, 1, 2].map(|axis| component(axis, place)))
    };
    let blocks: Vec<[i32; 3]> = near(field, beside(velocity, &cells)).into_iter().collect();
    let mut values = [0; 3].map(|_| Vec::with_capacity(blocks.len() * BRICK_VOXELS));
    for block in &blocks {
        for n in 0..BRICK_VOXELS as i32 {
            let way = at([block[0] + n / 64, block[1] + n / 8 % 8, block[2] + n % 8]);
            values.iter_mut().zip(way).for_each(|(values, way)| values.push(way));
        }
    }
    values.map(|values| Lattice { domain: field.domain, bricks: blocks.as_slice().into(), values: values.into(), ..Lattice::default() })
}

/// How many blocks the fastest comes.
fn beside(velocity: &[Grid], cells: &impl Fn([f64; 3]) -> [f32; 3]) -> i32 {
    let speed = |grid: &Grid| {
        let voxels = (0..grid.values.len()).map(|n| grid.values.get(n)).chain(grid.tiles.iter().map(|tile| tile.value));
        voxels.flatten().filter(|x| x.is_finite()).fold(0.0f32, |most, x| most.max(x.abs()))
    };
    let most = f64::from(velocity.iter().map(speed).fold(0.0, f32::max));
    let way =
        [[most, 0.0, 0.0], [0.0, most, 0.0], [0.0, 0.0, most]].map(cells).as_flattened().iter().fold(0.0f32, |most, x| most.max(x.abs()));
    (way / BRICK_EDGE as f32).ceil().clamp(1.0, MOST_BESIDE as f32) as i32
}

/// The blocks of a lattice and so many more on each side.
fn near(field: &Lattice, beside: i32) -> BTreeSet<[i32; 3]> {
    let steps = || -beside..=beside;
    let about = |block: &[i32; 3]| {
        let [x, y, z] = block.map(|x| x.div_euclid(BRICK_EDGE));
        steps().flat_map(move |i| steps().flat_map(move |j| steps().map(move |k| [x + i, y + j, z + k].map(|n| n * BRICK_EDGE))))
    };
    field.bricks.iter().chain(&*field.blocks).flat_map(about).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_volume::Values;

    /// A grid of vectors of one value in a cube of 8 voxels.
    fn velocity(edge: f64, value: [f32; 3]) -> Grid {
        let mut grid = Grid::from_dense("v", &[1.0; 512], [8; 3], gonio_volume::Transform::uniform(edge, [0.0; 3])).expect("a grid");
        grid.tiles.clear();
        grid.bricks = vec![gonio_volume::Brick { origin: [0; 3], active: [u64::MAX; 8] }];
        grid.values = Values::Vector(vec![value; BRICK_VOXELS]);
        grid
    }

    #[test]
    fn flows_are_in_cells_of_the_field() {
        let field = Lattice::of_values(&[1.0; 64], [4; 3]).expect("a lattice");
        let to_file = Transform::scale(0.5);
        for edge in [0.5, 1.0] {
            let flow = Flow::of_grids(&[velocity(edge, [1.0, -2.0, 0.0])], (&field, &to_file), 2.0, 0.5).expect("a flow");
            assert_eq!(flow.most, [4.0, 8.0, 0.0], "{edge}");
            let block = flow.cells[1].bricks.iter().position(|block| *block == [0; 3]).expect("the field's own block");
            assert_eq!(flow.cells[1].values[block * BRICK_VOXELS + 73], -8.0, "{edge}");
        }
        assert!(Flow::of_grids(&[], (&field, &to_file), 1.0, 0.5).is_err());
    }
}
