//! The room about a place: its floor area, by a level section under the ceiling that is filled from wall to wall.

use super::vector::{Vector, across, add, cross, dot, scaled, subtract, unit};
use crate::{
    accel::{Hits, RayBatch},
    compile::CompiledScene,
    transport::ray_mask,
};
use gonio_simd::Execution;
use std::collections::HashMap;

/// Metres from row to row of the section, and along a row from one look at the next row to another.
const STEP: f64 = 0.1;
/// Share of a step by which rows lie beside the place: walls stand at round numbers of centimetres, and a row within a wall would see past it.
const BESIDE: f64 = 0.1372;
/// Share of the way from the place to the ceiling at which the section lies: above doors, windows and furniture.
const SECTION: f64 = 0.9;
/// Most looks: those of a hall of 200 m by 200 m.
const MOST: usize = 8_000_000;
/// Metres that luminaires may hang above what a ray takes for the ceiling, and lie below the place.
const REACH: [f64; 2] = [0.5, 2.0];
/// Metres by which luminaires on a wall may lie in it.
const AT_WALL: f64 = 0.02;

/// A closed room.
#[derive(Clone, Debug)]
pub struct Room {
    /// Square metres between the walls, columns left out.
    pub area: f64,
    /// Metres from the place up to the ceiling.
    pub height: f64,
    place: Vector,
    /// Along a row, from row to row, and up; unit.
    axes: [Vector; 3],
    /// From wall to wall on each row.
    rows: HashMap<i64, Vec<[f64; 2]>>,
}

impl Room {
    /// The room about a place in world space; none without a ceiling and walls all around. Rectangular walls along the world's axes give the area to
    /// rounding, others by the midpoint rule over rows of 0.1 m.
    pub fn about(scene: &CompiledScene, place: [f64; 3], up: [f64; 3]) -> Option<Self> {
        let up = unit(up)?;
        let along = across(up, [1.0, 0.0, 0.0]);
        let mut room = Self { area: 0.0, height: 0.0, place, axes: [along, cross(up, along), up], rows: HashMap::new() };
        room.height = distance(scene, &[place], up)[0]?;
        room.fill(scene)?;
        Some(room)
    }

    /// Whether a place, such as a luminaire's, is in it.
    pub fn contains(&self, place: [f64; 3]) -> bool {
        let [x, y, z] = self.axes.map(|axis| dot(axis, subtract(place, self.place)));
        let [above, below] = REACH;
        // The rows on both sides, since a wall may stand between them.
        let row = y / STEP - BESIDE;
        let mut rows = [row.floor(), row.ceil()].into_iter().filter_map(|row| self.rows.get(&(row as i64))).flatten();
        z > -below && z < self.height + above && rows.any(|[from, to]| x > from - AT_WALL && x < to + AT_WALL)
    }

    /// Metres from the place up to the section, above doors and windows.
    pub(crate) fn section(&self) -> f64 {
        SECTION * self.height
    }

    /// A place of the section.
    fn at(&self, x: f64, row: i64) -> Vector {
        let [along, across, up] = self.axes;
        let level = add(self.place, scaled(up, self.section()));
        add(level, add(scaled(along, x), scaled(across, (row as f64 + BESIDE) * STEP)))
    }

    /// Row by row from the place on; none where a row has no end.
    fn fill(&mut self, scene: &CompiledScene) -> Option<()> {
        let (mut waiting, mut looks) = (vec![(0i64, 0.0f64)], 0);
        while let Some((row, x)) = waiting.pop() {
            if self.rows.get(&row).is_some_and(|known| known.iter().any(|[from, to]| x >= *from && x <= *to)) {
                continue;
            }
            let here = self.at(x, row);
            let [back, on] = [-1.0, 1.0].map(|sign| distance(scene, &[here], scaled(self.axes[0], sign))[0]);
            let [from, to] = [x - back?, x + on?];
            self.rows.entry(row).or_default().push([from, to]);
            self.area += STEP * (to - from);
            let count = ((to - from) / STEP).ceil().max(1.0);
            let width = (to - from) / count;
            looks += 2 * count as usize;
            if looks > MOST {
                return None;
            }
            let xs: Vec<f64> = (0..count as usize).map(|k| from + (k as f64 + 0.5) * width).collect();
            let places: Vec<Vector> = xs.iter().map(|x| self.at(*x, row)).collect();
            for step in [-1, 1] {
                let ways = distance(scene, &places, scaled(self.axes[1], step as f64));
                for (x, way) in xs.iter().zip(ways) {
                    match way.filter(|way| *way < STEP) {
                        // A row stands for half a step to both sides; the wall is where it is.
                        Some(way) => self.area += width * (way - 0.5 * STEP),
                        None => waiting.push((row + step, *x)),
                    }
                }
            }
        }
        Some(())
    }
}

/// Metres from places along a unit direction to what is met first.
fn distance(scene: &CompiledScene, places: &[Vector], direction: Vector) -> Vec<Option<f64>> {
    let count = places.len();
    let origin = [0, 1, 2].map(|k| places.iter().map(|place| (place[k] - scene.tables.origin[k]) as f32).collect::<Vec<_>>());
    let direction = direction.map(|x| vec![x as f32; count]);
    let rays = RayBatch {
        origin: origin.each_ref().map(|x| &x[..]),
        direction: direction.each_ref().map(|x| &x[..]),
        t_min: &vec![0.0; count],
        t_max: &vec![f32::INFINITY; count],
        mask: &vec![ray_mask::SHADOW; count],
        time: &[],
        passed: &[],
    };
    let mut hits = Hits::default();
    scene.tables.bvh.first_hit(Execution::Scalar, &rays, false, &mut hits);
    hits.t.iter().map(|t| Some(f64::from(*t)).filter(|t| t.is_finite())).collect()
}
