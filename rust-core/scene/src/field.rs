//! Fields: what varies from place to place within a medium, by a lattice of numbers.

use super::{Flow, Mesh, Origin, Transform, blob};
use gonio_volume::{BRICK_EDGE, BRICK_VOXELS, Grid, open};
use serde::{Deserialize, Serialize};
use std::{path::Path, sync::Arc};

/// Numbers at points of whole coordinates, trilinear between them: bricks of 8³ points, evenly filled blocks, and 0 elsewhere.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Lattice {
    /// The box that it fills, lattice coordinates: least and greatest.
    pub domain: [[f32; 3]; 2],
    /// Points outside have the value of the nearest within these, both inclusive; `None` where they are 0.
    pub extended: Option<[[i32; 3]; 2]>,
    /// The least point of each brick, multiples of 8.
    #[serde(with = "blob")]
    pub bricks: Arc<[[i32; 3]]>,
    /// 512 values a brick, z fastest.
    #[serde(with = "blob")]
    pub values: Arc<[f32]>,
    /// The least point of each block that is filled evenly, multiples of 8.
    #[serde(with = "blob")]
    pub blocks: Arc<[[i32; 3]]>,
    /// Value of each.
    #[serde(with = "blob")]
    pub block_values: Arc<[f32]>,
    /// How many of its values were no finite numbers, and count as 0.
    #[serde(skip_serializing_if = "is_none")]
    pub unknown: u64,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for it")]
fn is_none(count: &u64) -> bool {
    *count == 0
}

/// Blocks of 8³ points that even tiles of a grid may come to.
const MOST_BLOCKS: u64 = 1 << 24;

impl Lattice {
    /// That of a volume grid. Where `edges` is set, its array reaches to the outer faces of its voxels, and keeps its value there; else it fades to
    /// the background over one voxel beyond the active ones. Vectors count by their mean, values that are no finite numbers as 0.
    ///
    /// # Errors
    ///
    /// If nothing is active, no value is a finite number, or tiles come to too many blocks.
    pub fn of_grid(grid: &Grid, edges: Option<[usize; 3]>) -> Result<Self, String> {
        Self::of(grid, edges, |[x, y, z]| if x == y && y == z { x } else { (x + y + z) / 3.0 })
    }

    /// The same with what a function makes of the grid's values.
    pub(super) fn of(grid: &Grid, edges: Option<[usize; 3]>, value: impl Fn([f32; 3]) -> f32) -> Result<Self, String> {
        let scalar = |found: [f32; 3]| Some(value(found)).filter(|x| x.is_finite()).unwrap_or(0.0);
        let unknown = grid.not_finite();
        if unknown > 0 && unknown >= grid.active_voxels() {
            return Err(format!("grid '{}': none of its {unknown} values is a finite number", grid.name));
        }
        let (domain, extended) = match edges {
            Some(shape) => {
                let last = shape.map(|n| n as i32 - 1);
                ([[-0.5; 3], last.map(|x| x as f32 + 0.5)], Some([[0; 3], last]))
            }
            None => {
                let [min, max] = grid.bounds().ok_or_else(|| format!("grid '{}' is empty: no voxel is active", grid.name))?;
                ([min.map(|x| x as f32 - 1.0), max.map(|x| x as f32 + 1.0)], None)
            }
        };
        let tiles = grid.tiles.iter().filter(|tile| tile.value != [0.0; 3]);
        let count: u64 = tiles.clone().map(|tile| 1u64 << (3 * (u32::from(tile.log2_edge) - 3))).sum();
        if count > MOST_BLOCKS {
            return Err(format!(
                "grid '{}': its even tiles come to {count} blocks of 8³ voxels, at most {MOST_BLOCKS} are held",
                grid.name
            ));
        }
        let (mut blocks, mut block_values) = (Vec::new(), Vec::new());
        for tile in tiles {
            let edge = 1 << (tile.log2_edge - 3);
            for n in 0..edge * edge * edge {
                let step = [n / (edge * edge), n / edge % edge, n % edge];
                blocks.push([0, 1, 2].map(|axis| tile.origin[axis] + BRICK_EDGE * step[axis]));
                block_values.push(scalar(tile.value));
            }
        }
        let values = (0..grid.bricks.len() * BRICK_VOXELS).map(|voxel| scalar(grid.values.get(voxel)));
        Ok(Self {
            domain,
            extended,
            bricks: grid.bricks.iter().map(|brick| brick.origin).collect(),
            values: values.collect(),
            blocks: blocks.into(),
            block_values: block_values.into(),
            unknown,
        })
    }

    /// That of an array of voxels, z fastest, whose middles are whole numbers and which reaches to its outer faces.
    ///
    /// # Errors
    ///
    /// If there are not as many values as voxels, or one is no finite number.
    pub fn of_values(values: &[f32], shape: [usize; 3]) -> Result<Self, String> {
        let unit = gonio_volume::Transform::uniform(1.0, [0.0; 3]);
        let grid = Grid::from_dense("values", values, shape, unit).map_err(|error| error.to_string())?;
        Self::of_grid(&grid, Some(shape))
    }

    /// Whether both hold the very same arrays, in the same box.
    pub fn holds_arrays_of(&self, other: &Self) -> bool {
        (self.domain, self.extended) == (other.domain, other.extended)
            && Arc::ptr_eq(&self.bricks, &other.bricks)
            && Arc::ptr_eq(&self.values, &other.values)
            && Arc::ptr_eq(&self.blocks, &other.blocks)
            && Arc::ptr_eq(&self.block_values, &other.block_values)
    }

    /// The greatest value, 0 where there is none above.
    pub fn most(&self) -> f32 {
        self.values.iter().chain(&*self.block_values).copied().fold(0.0, f32::max)
    }
}

/// What varies within a medium. A medium that names one absorbs and scatters by its coefficients times the density, and sends its emission times what
/// the heat says.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Field {
    /// Where it came from.
    pub origin: Origin,
    /// From the lattice to the world.
    pub to_world: Transform,
    /// By how many points its box goes on before and beyond its arrays, whose outermost values stay there.
    #[serde(skip_serializing_if = "ends_with_arrays")]
    pub beyond: [[f32; 3]; 2],
    /// The density; below 0 it counts as 0.
    pub density: Lattice,
    /// What the emission follows; `None` where that is even.
    pub heat: Option<Lattice>,
    /// Factors on the emission, R, G, B, evenly from no heat to the greatest, linear between them; the heat itself where there are none.
    pub glow: Vec<[f32; 3]>,
    /// The heat of the last factor; above it, that stays.
    pub hottest: f32,
    /// Where colours vary: factors on the medium's extinction, R, G, B, and on its scattering, R, G, B, in place of the density, which is at least the
    /// greatest of them everywhere; else empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub taken: Vec<Lattice>,
    /// Where the colour that is sent varies: factors on the medium's emission, R, G, B, in place of the heat; else empty.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub sent: Vec<Lattice>,
    /// How all of it moves while the shutter is open, within the box; `None` where it does not.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flow: Option<Flow>,
}

fn ends_with_arrays(beyond: &[[f32; 3]; 2]) -> bool {
    *beyond == [[0.0; 3]; 2]
}

/// Lattices of [`Field::taken`] and of [`Field::sent`], where there are any.
pub const COLOURS: [usize; 2] = [6, 3];

impl Field {
    /// That of a file's grids, placed by a map from the file's space to the world.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, has no such grid, or the two grids lie on different lattices.
    pub fn read(origin: Origin, path: &Path, density: &str, heat: Option<&str>, to_world: &Transform) -> Result<Self, String> {
        let file = open(path).map_err(|error| error.to_string())?;
        let grid = |name: &str| file.read_named(name).map_err(|error| error.to_string());
        let density = grid(density)?;
        let heat = heat.map(grid).transpose()?;
        if let Some(heat) = heat.as_ref().filter(|heat| heat.transform != density.transform) {
            return Err(format!("the grids '{}' and '{}' have voxels of different places or sizes; resample one", density.name, heat.name));
        }
        let inner = Transform::from_row_vector_matrix(&density.transform.0);
        let heat = heat.map(|grid| Lattice::of_grid(&grid, None)).transpose()?;
        let hottest = heat.as_ref().map_or(0.0, Lattice::most);
        let density = Lattice::of_grid(&density, None)?;
        Ok(Self { origin, to_world: to_world.after(&inner), density, heat, hottest, ..Self::default() })
    }

    /// Whether both are the same but for their names and where they lie.
    pub fn holds_arrays_of(&self, other: &Self) -> bool {
        let heats_are_one = match (&self.heat, &other.heat) {
            (Some(a), Some(b)) => a.holds_arrays_of(b),
            (a, b) => a.is_none() && b.is_none(),
        };
        let are_one = |a: &[Lattice], b: &[Lattice]| a.len() == b.len() && a.iter().zip(b).all(|(a, b)| a.holds_arrays_of(b));
        let colours_are_one = are_one(&self.taken, &other.taken) && are_one(&self.sent, &other.sent);
        let flows_are_one = match (&self.flow, &other.flow) {
            (Some(a), Some(b)) => a.rests == b.rests && are_one(&a.cells, &b.cells),
            (a, b) => a.is_none() && b.is_none(),
        };
        heats_are_one
            && colours_are_one
            && flows_are_one
            && self.density.holds_arrays_of(&other.density)
            && (&self.glow, self.hottest, self.beyond) == (&other.glow, other.hottest, other.beyond)
    }

    /// All of its lattices.
    pub fn lattices(&self) -> impl Iterator<Item = &Lattice> {
        let flow = self.flow.iter().flat_map(|flow| &flow.cells);
        [&self.density].into_iter().chain(&self.heat).chain(&self.taken).chain(&self.sent).chain(flow)
    }

    /// The box about all of it, lattice coordinates.
    pub fn domain(&self) -> [[f32; 3]; 2] {
        let [mut min, mut max] = self.density.domain;
        if let Some([low, high]) = self.heat.as_ref().map(|heat| heat.domain) {
            (min, max) = ([0, 1, 2].map(|axis| min[axis].min(low[axis])), [0, 1, 2].map(|axis| max[axis].max(high[axis])));
        }
        let [before, behind] = self.beyond;
        [[0, 1, 2].map(|axis| min[axis] - before[axis]), [0, 1, 2].map(|axis| max[axis] + behind[axis])]
    }

    /// The box that it comes to as it flows, at most half as wide again on each side.
    pub fn reach(&self) -> [[f32; 3]; 2] {
        let [min, max] = self.domain();
        let Some(flow) = &self.flow else { return [min, max] };
        let wider = [0, 1, 2].map(|axis| {
            let way = flow.most[axis] * flow.rests.abs().max((1.0 - flow.rests).abs());
            way.min(0.5 * (max[axis] - min[axis]))
        });
        [[0, 1, 2].map(|axis| min[axis] - wider[axis]), [0, 1, 2].map(|axis| max[axis] + wider[axis])]
    }

    /// The box as a mesh in lattice coordinates, whose faces look outwards; [`Field::to_world`] places it.
    pub fn mesh(&self) -> Mesh {
        let [min, max] = self.reach();
        Mesh { origin: self.origin.clone(), ..Mesh::of_box(min, max) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_of_the_box_look_outwards() {
        let field = Field { density: Lattice::of_values(&[1.0; 24], [2, 3, 4]).expect("a lattice"), ..Field::default() };
        assert_eq!(field.domain(), [[-0.5; 3], [1.5, 2.5, 3.5]]);
        let mesh = field.mesh();
        let volume: f32 = mesh.triangles.iter().map(|triangle| determinant(triangle.map(|point| mesh.points[point as usize]))).sum();
        assert!((volume / 6.0 - 24.0).abs() < 1e-4, "{volume}");
    }

    fn determinant([a, b, c]: [[f32; 3]; 3]) -> f32 {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0])
    }
}
