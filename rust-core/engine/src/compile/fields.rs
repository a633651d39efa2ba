//! Fields of media as tables of bricks.

use super::times::blurs;
use crate::{
    error::Diagnostic,
    scene::{BRICK_EDGE, BRICK_VOXELS, COLOURS, Field, Lattice, Scene},
    transport::{FieldLayout, FieldRow, FieldTable, GLOW, Numbers, POINTS},
};
use std::collections::HashMap;

/// Points of a brick.
type Points = [f32; POINTS * POINTS * POINTS];
/// More bricks than these are not laid out: their bounds alone would take a gigabyte.
const MOST_BRICKS: usize = 1 << 26;
/// More bricks that vary have no place in a table: 7 GB.
const MOST_FILLED: usize = 2_800_000;

/// Fields as they were laid out.
#[derive(Clone, Debug, Default)]
pub(super) struct KeptFields {
    /// Whether they flow that can.
    blurred: bool,
    fields: Vec<Field>,
    usable: Vec<bool>,
    table: FieldTable,
}

impl KeptFields {
    /// What is kept of a scene whose fields are laid out.
    pub(super) fn of(scene: &Scene, usable: Vec<bool>, table: &FieldTable) -> Self {
        Self { blurred: blurs(&scene.settings), fields: scene.fields.clone(), usable, table: table.clone() }
    }

    /// Whether a scene's fields are these, and can be used as they could.
    fn is_of(&self, scene: &Scene, usable: &[bool]) -> bool {
        let both = || self.fields.iter().zip(&scene.fields);
        self.blurred == blurs(&scene.settings)
            && self.usable == usable
            && self.fields.len() == scene.fields.len()
            && both().all(|(old, new)| old.holds_arrays_of(new))
    }
}

/// Fields laid out, row 1 on, and which can be used; the others are told and stay empty.
pub(super) fn compile(scene: &Scene, before: &KeptFields, diagnostics: &mut Vec<Diagnostic>) -> (FieldTable, Vec<bool>) {
    let alike = alike(&scene.fields);
    let mut filled = 0;
    let usable = |(field, alike): (&Field, &Option<usize>)| match problem(field, alike.is_none().then_some(&mut filled)) {
        Some(problem) => {
            diagnostics.push(Diagnostic::warning(&field.origin, format!("{problem}; the volume is left out")));
            false
        }
        None => {
            // Lattices of one grid share its voxels.
            let unknown = field.lattices().map(|lattice| lattice.unknown).max().unwrap_or(0);
            if unknown > 0 {
                let problem = format!("{unknown} of its values are no finite numbers, and count as 0");
                diagnostics.push(Diagnostic::warning(&field.origin, problem));
            }
            true
        }
    };
    let mut kept: Vec<bool> = scene.fields.iter().zip(&alike).map(usable).collect();
    for number in 0..kept.len() {
        kept[number] &= alike[number].is_none_or(|first| kept[first]);
    }
    if before.is_of(scene, &kept) {
        return (before.table.clone(), kept);
    }
    let numbers = 0..scene.fields.len();
    let lay = |number: usize| (kept[number] && alike[number].is_none()).then(|| Laid::new(&scene.fields[number], blurs(&scene.settings)));
    let laid: Vec<Option<Laid<'_>>> = numbers.clone().map(lay).collect();
    let row = |number: usize| match (&laid[number], alike[number]) {
        (Some(laid), _) => FieldRow::New(Box::new(laid.layout())),
        (None, Some(number)) => FieldRow::Alike(number as u32 + 1),
        (None, None) => FieldRow::Empty,
    };
    let rows: Vec<FieldRow<'_>> = numbers.map(row).collect();
    (FieldTable::new(&rows), kept)
}

/// By field, the first one before it that has the same numbers.
fn alike(fields: &[Field]) -> Vec<Option<usize>> {
    let mut known: HashMap<*const f32, Vec<usize>> = HashMap::new();
    let find = |(number, field): (usize, &Field)| {
        let same = known.entry(field.density.values.as_ptr()).or_default();
        let first = same.iter().copied().find(|other| fields[*other].holds_arrays_of(field));
        if first.is_none() && field.to_world.inverse().is_some() {
            same.push(number);
        }
        first
    };
    fields.iter().enumerate().map(find).collect()
}

/// Tells where fields lie, in world space rebased to an origin.
pub(super) fn place(scene: &Scene, origin: [f64; 3], table: &mut FieldTable) {
    for (field, row) in scene.fields.iter().zip(1..) {
        let Some(inverse) = field.to_world.inverse() else { continue };
        let (shift, base) = (inverse.point(origin), base(field));
        let axis = |axis: usize| {
            let [x, y, z, _] = inverse.columns.map(|column| column[axis] as f32);
            [x, y, z, (shift[axis] - f64::from(base[axis])) as f32]
        };
        table.place(row, [axis(0), axis(1), axis(2)]);
    }
}

/// What makes a field useless; `filled` counts the bricks of those that are laid out.
fn problem(field: &Field, filled: Option<&mut usize>) -> Option<String> {
    let [min, max] = field.domain();
    let is_box = (0..3).all(|axis| min[axis].is_finite() && max[axis].is_finite() && min[axis] < max[axis]);
    if field.to_world.inverse().is_none() || !is_box {
        return Some("it is flat, or lies at no finite place".into());
    }
    if [&field.taken, &field.sent].iter().zip(COLOURS).any(|(colours, count)| ![0, count].contains(&colours.len())) {
        return Some("its colours are not of three components each".into());
    }
    if field
        .lattices()
        .any(|lattice| lattice.values.len() != lattice.bricks.len() * BRICK_VOXELS || lattice.blocks.len() != lattice.block_values.len())
    {
        return Some("its arrays have other lengths than its bricks".into());
    }
    let bricks = bricks(field).iter().try_fold(1usize, |product, n| product.checked_mul(*n)).unwrap_or(usize::MAX);
    if bricks > MOST_BRICKS {
        return Some(format!("its box has {bricks} bricks of 8³ voxels, at most {MOST_BRICKS} are laid out: resample it"));
    }
    let filled = filled?;
    // The neighbours on the side of lesser coordinates of each brick vary with it.
    *filled += field.lattices().map(|lattice| (lattice.bricks.len() + lattice.blocks.len()) * 2).sum::<usize>();
    (*filled > MOST_FILLED)
        .then(|| format!("all volumes together have {filled} bricks that vary, at most {MOST_FILLED} are held: resample it"))
}

/// The lattice point that the first brick begins at.
pub(super) fn base(field: &Field) -> [i32; 3] {
    let [min, _] = field.reach();
    // Arrays reach half a voxel beyond their points, bricks of grids keep their places.
    min.map(|x| if field.density.extended.is_some() { x.floor() as i32 } else { (x.floor() as i32).div_euclid(BRICK_EDGE) * BRICK_EDGE })
}

/// Bricks along the axes.
fn bricks(field: &Field) -> [usize; 3] {
    let ([_, max], base) = (field.reach(), base(field));
    [0, 1, 2].map(|axis| ((f64::from(max[axis]).floor() as i64 - i64::from(base[axis])) / i64::from(BRICK_EDGE) + 1).max(1) as usize)
}

/// A field to be laid out.
struct Laid<'a> {
    field: &'a Field,
    density: Places<'a>,
    heat: Option<Places<'a>>,
    taken: Vec<Places<'a>>,
    sent: Vec<Places<'a>>,
    flow: Vec<Places<'a>>,
}

impl<'a> Laid<'a> {
    fn new(field: &'a Field, blurred: bool) -> Self {
        let base = base(field);
        let flow = field.flow.as_ref().filter(|_| blurred);
        let all = |lattices: &'a [Lattice]| lattices.iter().map(|lattice| Places::new(lattice, base)).collect();
        Self {
            field,
            density: Places::new(&field.density, base),
            heat: field.heat.as_ref().map(|heat| Places::new(heat, base)),
            taken: all(&field.taken),
            sent: all(&field.sent),
            flow: flow.map_or_else(Vec::new, |flow| all(&flow.cells)),
        }
    }

    fn layout(&self) -> FieldLayout<'_> {
        let (field, base) = (self.field, base(self.field));
        let reach = if self.flow.is_empty() { field.domain() } else { field.reach() };
        let [domain, reach] = [field.domain(), reach].map(|ends| ends.map(|corner| [0, 1, 2].map(|axis| corner[axis] - base[axis] as f32)));
        let all = [&self.taken, &self.sent, &self.flow];
        let [taken, sent, flow] = all.map(|places| places.iter().map(|places| places as &dyn Numbers).collect());
        FieldLayout {
            bricks: bricks(field),
            domain,
            reach,
            density: &self.density,
            heat: self.heat.as_ref().map(|heat| heat as &dyn Numbers),
            taken,
            sent,
            flow,
            rests: field.flow.as_ref().map_or(0.0, |flow| flow.rests),
            glow: glow(field),
            hottest: field.hottest,
        }
    }
}

/// Factors on the emission, as many as tables have.
fn glow(field: &Field) -> [[f32; 3]; GLOW] {
    let factor = |i: usize| {
        let part = i as f32 / (GLOW - 1) as f32;
        let Some(last) = field.glow.len().checked_sub(1) else { return [part * field.hottest; 3] };
        let at = part * last as f32;
        let (low, high) = (field.glow[at as usize], field.glow[(at as usize + 1).min(last)]);
        [0, 1, 2].map(|c| (high[c] - low[c]).mul_add(at.fract(), low[c])).map(|x| if x.is_finite() { x } else { 0.0 })
    };
    std::array::from_fn(factor)
}

/// Where a lattice has its numbers.
#[derive(Debug)]
struct Places<'a> {
    lattice: &'a Lattice,
    base: [i32; 3],
    bricks: HashMap<[i32; 3], usize>,
    blocks: HashMap<[i32; 3], f32>,
}

/// What lies in a block of 8³ points.
#[derive(Clone, Copy, Debug)]
enum Block<'a> {
    Even(f32),
    Brick(&'a [f32]),
}

impl<'a> Places<'a> {
    fn new(lattice: &'a Lattice, base: [i32; 3]) -> Self {
        let block = |point: &[i32; 3]| point.map(|x| x.div_euclid(BRICK_EDGE));
        let bricks = lattice.bricks.iter().map(block).zip(0..).collect();
        let blocks = lattice.blocks.iter().map(block).zip(lattice.block_values.iter().copied()).collect();
        Self { lattice, base, bricks, blocks }
    }

    fn block(&self, block: [i32; 3]) -> Block<'a> {
        match self.bricks.get(&block) {
            Some(brick) => Block::Brick(&self.lattice.values[brick * BRICK_VOXELS..][..BRICK_VOXELS]),
            None => Block::Even(self.blocks.get(&block).copied().unwrap_or(0.0)),
        }
    }

    /// The points of a brick along an axis, held within the array where that goes on beyond its edges.
    fn along(&self, axis: usize, brick: usize) -> [i32; POINTS] {
        let first = self.base[axis] + brick as i32 * BRICK_EDGE;
        std::array::from_fn(|i| {
            let point = first + i as i32;
            self.lattice.extended.map_or(point, |[min, max]| point.clamp(min[axis], max[axis]))
        })
    }
}

impl Numbers for Places<'_> {
    fn like(&self, brick: [usize; 3]) -> [usize; 3] {
        let Some([min, max]) = self.lattice.extended else { return brick };
        let edge = BRICK_EDGE as usize;
        [0, 1, 2].map(|axis| {
            let first = self.base[axis] + (brick[axis] * edge) as i32;
            if first + BRICK_EDGE <= min[axis] {
                0
            } else if first >= max[axis] {
                ((max[axis] - self.base[axis]).max(0) as usize).div_ceil(edge)
            } else {
                brick[axis]
            }
        })
    }

    fn brick(&self, brick: [usize; 3], points: &mut Points) -> Option<f32> {
        let [x, y, z] = [0, 1, 2].map(|axis| self.along(axis, brick[axis]));
        let first = [x[0], y[0], z[0]].map(|point| point.div_euclid(BRICK_EDGE));
        let last = [x[8], y[8], z[8]].map(|point| point.div_euclid(BRICK_EDGE));
        // Nine points in a row lie in two blocks at most.
        let blocks: [Block<'_>; 8] = std::array::from_fn(|n| self.block([0, 1, 2].map(|axis| [first, last][n >> axis & 1][axis])));
        let even = |block: &Block<'_>| if let Block::Even(value) = block { Some(*value) } else { None };
        if let Some(value) = even(&blocks[0])
            && blocks.iter().all(|block| even(block) == Some(value))
        {
            return Some(value);
        }
        let side = |axis: usize, point: i32| usize::from(point.div_euclid(BRICK_EDGE) != first[axis]) << axis;
        let mut at = 0;
        for x in x {
            for y in y {
                let (sides, row) = (side(0, x) | side(1, y), x.rem_euclid(BRICK_EDGE) * 64 + y.rem_euclid(BRICK_EDGE) * 8);
                for z in z {
                    points[at] = match blocks[sides | side(2, z)] {
                        Block::Even(value) => value,
                        Block::Brick(values) => values[(row + z.rem_euclid(BRICK_EDGE)) as usize],
                    };
                    at += 1;
                }
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Transform;

    #[test]
    fn fields_of_the_same_numbers_share_their_bricks() {
        let values: Vec<f32> = (0..20 * 20 * 20).map(|n| (n % 7) as f32).collect();
        let density = Lattice::of_values(&values, [20; 3]).expect("as many values as voxels");
        let field = Field { density, ..Field::default() };
        let memory = |fields: Vec<Field>| {
            let mut diagnostics = Vec::new();
            let (table, usable) = compile(&Scene { fields, ..Scene::default() }, &KeptFields::default(), &mut diagnostics);
            (table.memory(), usable, diagnostics.len())
        };
        let moved = Field { to_world: Transform::translation([3.0, 0.0, 0.0]), ..field.clone() };
        let flat = Field { to_world: Transform::scale(0.0), ..field.clone() };
        let (once, ..) = memory(vec![field.clone()]);
        assert_eq!(memory(vec![flat, field, moved]), (once, vec![false, true, true], 1));
    }

    #[test]
    fn bricks_beyond_an_array_are_those_at_its_edge() {
        let values: Vec<f32> = (0..20 * 9 * 16).map(|n| (n * n % 101) as f32).collect();
        let density = Lattice::of_values(&values, [20, 9, 16]).expect("as many values as voxels");
        let field = Field { density, beyond: [[37.0, 100.0, 0.0], [64.0, 3.0, 20.5]], ..Field::default() };
        let (laid, count) = (Laid::new(&field, false), bricks(&field));
        let points = |brick: [usize; 3]| {
            let mut points = [0.0; POINTS * POINTS * POINTS];
            laid.density.brick(brick, &mut points).map_or(points, |value| [value; POINTS * POINTS * POINTS])
        };
        let mut own = 0;
        for n in 0..count.iter().product() {
            let brick = [n / (count[1] * count[2]), n / count[2] % count[1], n % count[2]];
            let like = laid.density.like(brick);
            own += usize::from(like == brick);
            assert!((0..3).all(|axis| like[axis] <= brick[axis]) && laid.density.like(like) == like);
            assert_eq!(points(like), points(brick), "{like:?} {brick:?}");
        }
        assert!(own < 150 && count.iter().product::<usize>() > 900, "{own} of {count:?}");
    }
}
