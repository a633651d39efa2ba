//! What varies within media: numbers on lattices, as bricks of 8³ cells with their bounds.
//!
//! A brick holds the 9³ points about its cells, so that one brick serves a lookup, in 16 bits between its least and its greatest value. Two that follow
//! each other along z share a word: four gathers are a trilinear lookup.

mod moving;
mod spread;

use gonio_simd::{Column, PADDING};
use spread::Spread;
use std::sync::Arc;

pub use moving::MovingFields;

/// Cells along a brick's edge, as a power of two.
pub(crate) const LOG2_BRICK: u32 = 3;
/// Bricks along the edge of what is skipped together where it is empty, as a power of two.
pub(crate) const LOG2_COARSE: u32 = 2;
/// Points along a brick's edge.
pub const POINTS: usize = 9;
/// Words of a brick: 9 × 9 rows of 8 pairs.
pub(crate) const WORDS: usize = POINTS * POINTS * 8;
/// Words of a brick's bounds, and of a field's row.
pub(crate) const ROW: usize = 4;
/// The greatest code of a value.
const CODES: f32 = 65535.0;
/// Factors of a field's glow.
pub const GLOW: usize = 256;

/// A lattice of numbers that is to be laid out.
pub trait Numbers: std::fmt::Debug {
    /// Fills the points of a brick, z fastest, or says that all of them have one value.
    fn brick(&self, brick: [usize; 3], points: &mut [f32; POINTS * POINTS * POINTS]) -> Option<f32>;
    /// The first brick whose points are those of a brick.
    fn like(&self, brick: [usize; 3]) -> [usize; 3];
}

/// A field that is to be laid out.
#[derive(Debug)]
pub struct FieldLayout<'a> {
    /// Bricks along the axes.
    pub bricks: [usize; 3],
    /// The box that it fills, lattice coordinates of 0 or more.
    pub domain: [[f32; 3]; 2],
    /// The box that it may fill as it flows: at least the one before.
    pub reach: [[f32; 3]; 2],
    /// The density; below 0 it counts as 0.
    pub density: &'a dyn Numbers,
    /// What the emission follows.
    pub heat: Option<&'a dyn Numbers>,
    /// Where colours vary, factors on extinction and scattering, R, G, B each; else empty.
    pub taken: Vec<&'a dyn Numbers>,
    /// Where the colour that is sent varies, factors on it, R, G, B; else empty.
    pub sent: Vec<&'a dyn Numbers>,
    /// Where what it holds flows, cells along x, y and z from the shutter's opening to its closing; else empty.
    pub flow: Vec<&'a dyn Numbers>,
    /// The time of the shutter at which all of its numbers hold.
    pub rests: f32,
    /// Factors on the emission, evenly from heat 0 to `hottest`.
    pub glow: [[f32; 3]; GLOW],
    /// The heat of the last.
    pub hottest: f32,
}

/// How a field comes into the table.
#[derive(Debug)]
pub enum FieldRow<'a> {
    /// It is laid out.
    New(Box<FieldLayout<'a>>),
    /// It has the numbers of the field of a row before, and may lie elsewhere.
    Alike(u32),
    /// It stays empty.
    Empty,
}

/// All of a scene, whose clones share their bricks. Row 0 is an empty field.
#[derive(Clone, Debug)]
pub struct FieldTable {
    /// By axis, from rebased world space to the lattice: three factors and what is added.
    pub(crate) to_lattice: [Column; 3],
    /// Those that move, by their rows; `None` where none does.
    pub(crate) moving: Option<MovingFields>,
    /// Least coordinates that it reaches and the hottest heat; greatest coordinates.
    pub(crate) reach: [Column; 2],
    /// The same of where its numbers are, and the time at which they hold.
    pub(crate) domain: [Column; 2],
    /// First bricks of flows along x, y and z, 0 for none, and a blank.
    pub(crate) flow: Column<u32>,
    /// Whether any field flows.
    pub(crate) flows: bool,
    /// Bricks along y and z, the first brick's bounds of the density, and of the heat (0 for none).
    pub(crate) bricks: Column<u32>,
    /// Bricks along y and z of the coarse ones, the first of those, and the number of the field's glow.
    pub(crate) coarse: Column<u32>,
    /// The first brick's bounds of the extinction's colours, R, G, B, and a blank; the same of the scattering's and of the emission's. 0 for none.
    pub(crate) colours: [Column<u32>; 3],
    /// Whether any field has colours that vary.
    pub(crate) is_coloured: bool,
    /// By brick: least value, span of its codes, greatest value, place of its words over [`WORDS`], as bits.
    pub(crate) bounds: Arc<Column>,
    /// By coarse brick, 1 where there is any density or heat.
    pub(crate) filled: Arc<Column>,
    /// Pairs of codes.
    pub(crate) words: Arc<Column<u32>>,
    /// Factors on emission, R, G, B, and a blank.
    pub(crate) glow: Column,
}

impl Default for FieldTable {
    fn default() -> Self {
        Layout::default().table()
    }
}

impl FieldTable {
    /// Lays fields out, in their order from row 1 on.
    pub fn new(fields: &[FieldRow<'_>]) -> Self {
        let mut layout = Layout::default();
        for field in fields {
            match field {
                FieldRow::New(field) => layout.add(field),
                FieldRow::Alike(row) => layout.repeat(*row as usize),
                FieldRow::Empty => layout.repeat(0),
            }
        }
        layout.table()
    }
    /// Places a field: from rebased world space to its lattice, a row an axis, three factors and what is added.
    pub fn place(&mut self, row: u32, to_lattice: [[f32; 4]; 3]) {
        for (rows, values) in self.to_lattice.iter_mut().zip(to_lattice) {
            rows[row as usize * ROW..][..ROW].copy_from_slice(&values);
        }
    }
    /// Has fields move that this names by their rows.
    pub fn set_moving(&mut self, moving: MovingFields) {
        self.moving = (!moving.is_empty()).then_some(moving);
    }
    /// Whether any field is another at another time of the shutter.
    pub fn moves(&self) -> bool {
        self.flows || self.moving.is_some()
    }
    /// Bytes of it.
    pub fn memory(&self) -> usize {
        4 * (self.words.len() + self.bounds.len() + self.filled.len())
    }
}

/// A table that grows.
struct Layout {
    to_lattice: [Vec<f32>; 3],
    reach: [Vec<f32>; 2],
    domain: [Vec<f32>; 2],
    flow: Vec<u32>,
    bricks: Vec<u32>,
    coarse: Vec<u32>,
    colours: [Vec<u32>; 3],
    bounds: Vec<f32>,
    filled: Vec<f32>,
    words: Vec<u32>,
    glow: Vec<f32>,
}

impl Default for Layout {
    fn default() -> Self {
        // An empty field of one brick; word 0 is that of all even bricks.
        Self {
            to_lattice: [0; 3].map(|_| vec![0.0; ROW]),
            reach: [vec![0.0; ROW], vec![0.0; ROW]],
            domain: [vec![0.0; ROW], vec![0.0; ROW]],
            flow: vec![0; ROW],
            bricks: vec![1, 1, 0, 0],
            coarse: vec![1, 1, 0, 0],
            colours: [0; 3].map(|_| vec![0; ROW]),
            bounds: vec![0.0; ROW],
            filled: vec![0.0],
            words: vec![0; WORDS],
            glow: vec![0.0; ROW * GLOW],
        }
    }
}

impl Layout {
    fn add(&mut self, field: &FieldLayout<'_>) {
        self.to_lattice.iter_mut().for_each(|rows| rows.extend([0.0; ROW]));
        for (rows, boxes, last) in
            [(&mut self.reach, field.reach, [field.hottest, 0.0]), (&mut self.domain, field.domain, [field.rests, 0.0])]
        {
            for (row, ([x, y, z], last)) in rows.iter_mut().zip(boxes.into_iter().zip(last)) {
                row.extend([x, y, z, last]);
            }
        }
        let [_, ny, nz] = field.bricks.map(|n| n as u32);
        let density = self.numbers(field.bricks, field.density, 0.0);
        let heat = field.heat.map_or(0, |heat| self.numbers(field.bricks, heat, 0.0));
        self.bricks.extend([ny, nz, density, heat]);
        let all = [field.taken.get(..3), field.taken.get(3..), field.sent.get(..)].map(Option::unwrap_or_default);
        let colours = all.map(|all| [0, 1, 2].map(|part| all.get(part).map_or(0, |numbers| self.numbers(field.bricks, *numbers, 0.0))));
        for (rows, [r, g, b]) in self.colours.iter_mut().zip(colours) {
            rows.extend([r, g, b, 0]);
        }
        let flow = [0, 1, 2].map(|axis| field.flow.get(axis).map_or(0, |numbers| self.numbers(field.bricks, *numbers, f32::MIN)));
        self.flow.extend([flow[0], flow[1], flow[2], 0]);
        if flow[0] != 0 {
            let spread = Spread { bricks: field.bricks, flow, times: [-field.rests, 1.0 - field.rests] };
            let of_light = colours[2].into_iter().filter(|first| *first != 0);
            [density, heat].into_iter().filter(|first| *first != 0).chain(of_light).for_each(|first| spread.apply(first, &mut self.bounds));
        }
        let coarse = field.bricks.map(|n| n.div_ceil(1 << LOG2_COARSE));
        let first = self.filled.len();
        self.coarse.extend([coarse[1] as u32, coarse[2] as u32, first as u32, (self.glow.len() / (ROW * GLOW)) as u32]);
        self.filled.resize(first + coarse.iter().product::<usize>(), 0.0);
        for (number, [x, y, z]) in places(field.bricks).enumerate() {
            let any = |first: u32| first != 0 && self.bounds[(first as usize + number) * ROW + 2] > 0.0;
            if any(density) || any(heat) || colours[2].iter().any(|first| any(*first)) {
                let [x, y, z] = [x, y, z].map(|n| n >> LOG2_COARSE);
                self.filled[first + (x * coarse[1] + y) * coarse[2] + z] = 1.0;
            }
        }
        self.glow.extend(field.glow.iter().flat_map(|[r, g, b]| [*r, *g, *b, 0.0]));
    }

    /// Adds a field with the numbers of one before.
    fn repeat(&mut self, row: usize) {
        let row = row * ROW..(row + 1) * ROW;
        let floats = self.to_lattice.iter_mut().chain(&mut self.reach).chain(&mut self.domain);
        floats.for_each(|rows| rows.extend_from_within(row.clone()));
        self.flow.extend_from_within(row.clone());
        self.bricks.extend_from_within(row.clone());
        self.colours.iter_mut().for_each(|rows| rows.extend_from_within(row.clone()));
        self.coarse.extend_from_within(row);
    }

    /// Adds the bricks of a lattice, whose numbers count as `lowest` below that, and gives the number of the first.
    fn numbers(&mut self, bricks: [usize; 3], numbers: &dyn Numbers, lowest: f32) -> u32 {
        let first = self.bounds.len() / ROW;
        let mut points = [0.0; POINTS * POINTS * POINTS];
        for brick in places(bricks) {
            let [x, y, z] = numbers.like(brick);
            if [x, y, z] != brick {
                let known = (first + (x * bricks[1] + y) * bricks[2] + z) * ROW;
                self.bounds.extend_from_within(known..known + ROW);
                continue;
            }
            let row = match numbers.brick(brick, &mut points) {
                Some(value) => [value.max(lowest), 0.0, value.max(lowest), f32::from_bits(0)],
                None => self.brick(&mut points, lowest),
            };
            self.bounds.extend(row);
        }
        first as u32
    }

    /// Adds a brick's words and gives its bounds.
    fn brick(&mut self, points: &mut [f32; POINTS * POINTS * POINTS], lowest: f32) -> [f32; ROW] {
        points.iter_mut().for_each(|point| *point = point.max(lowest));
        let (least, most) = points.iter().fold((f32::MAX, lowest), |(least, most), point| (least.min(*point), most.max(*point)));
        if least == most {
            return [least, 0.0, most, f32::from_bits(0)];
        }
        let place = (self.words.len() / WORDS) as u32;
        let code = |point: f32| ((point - least) / (most - least) * CODES).round() as u32;
        for row in points.as_chunks::<POINTS>().0 {
            self.words.extend((0..8).map(|z| code(row[z]) | code(row[z + 1]) << 16));
        }
        [least, (most - least) / CODES, most, f32::from_bits(place)]
    }

    fn table(self) -> FieldTable {
        FieldTable {
            to_lattice: self.to_lattice.map(|rows| column(&rows)),
            moving: None,
            reach: self.reach.map(|rows| column(&rows)),
            domain: self.domain.map(|rows| column(&rows)),
            flows: self.flow.iter().any(|first| *first != 0),
            flow: column(&self.flow),
            bricks: column(&self.bricks),
            coarse: column(&self.coarse),
            is_coloured: self.colours.iter().flatten().any(|first| *first != 0),
            colours: self.colours.map(|rows| column(&rows)),
            bounds: column(&self.bounds).into(),
            filled: column(&self.filled).into(),
            words: column(&self.words).into(),
            glow: column(&self.glow),
        }
    }
}

/// All bricks of a lattice, z fastest.
fn places([nx, ny, nz]: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..nx * ny * nz).map(move |n| [n / (ny * nz), n / nz % ny, n % nz])
}

fn column<T: bytemuck::Pod>(values: &[T]) -> Column<T> {
    let mut column = Column::new(values.len() + PADDING);
    column[..values.len()].copy_from_slice(values);
    column
}
