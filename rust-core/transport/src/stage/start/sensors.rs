//! Ray generation without a camera: the sensors of meters, with a block of a tile's pixels for each.
//!
//! A sensor owns a square block of pixels, which follow one another along the Morton curve. So their samples together are one net of the
//! sampler's sequence, and the lanes of a register lie side by side.

use crate::stage::start::generate::TileArea;
use crate::state::columns::gather3;
use crate::state::path_core::{PathCore, SurroundingsColumns};
use crate::state::paths::{PathLanes, Paths};
use crate::state::queue::measure_points::{MeasureLanes, MeasurePoints};
use crate::state::rays::RayLanes;
use gonio_camera::Surroundings;
use gonio_camera::sampler::{Runs, TILE, morton_even};
use gonio_camera::sampler::{Sampler, dimension};
use gonio_simd::{Column, Lanes, WavelengthColumn, Wavelengths};
use std::ops::Range;

/// A sensor, rebased world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensor {
    /// Metres.
    pub position: [f32; 3],
    /// How far the true point may lie from `position`, metres.
    pub error: f32,
    /// Unit normal of the surface that is measured, or the direction that is looked along.
    pub normal: [f32; 3],
    /// Unit vector towards which the normal turns.
    pub side: [f32; 3],
    /// Radians that the normal turns to either side: 0 is a plane, π/2 half a cylinder, π a whole one, whose curved surface gets the mean.
    pub turn: f32,
    /// Measures luminance along the normal instead of illuminance.
    pub looks: bool,
    /// What it stands in.
    pub surroundings: Surroundings,
}

/// The sensors of a measurement as columns, and how pixels belong to them.
#[derive(Debug)]
pub struct SensorTable {
    count: u32,
    /// Logarithm of the pixels along a block's side.
    side_log2: u32,
    /// Logarithm of the blocks in a row.
    across_log2: u32,
    position: [Column; 3],
    error: Column,
    normal: [Column; 3],
    side: [Column; 3],
    turn: Column,
    looks: Column<u32>,
    surroundings: SurroundingsColumns,
}

/// Logarithm of a tile's side.
const TILE_LOG2: u32 = TILE.trailing_zeros();
/// Logarithm of the smallest block's side: the spread of 16 pixels tells how far their mean may be off.
const LEAST_SIDE_LOG2: u32 = 2;

impl SensorTable {
    /// Blocks are as large as lets all sensors fit into one tile, of at most so many pixels each, and no smaller than 4 × 4.
    pub fn new(sensors: &[Sensor], most_pixels: usize) -> Self {
        let fits = |side_log2: &u32| sensors.len() <= 1 << (2 * (TILE_LOG2 - side_log2)) && 1 << (2 * side_log2) <= most_pixels;
        let side_log2 = (LEAST_SIDE_LOG2..=TILE_LOG2).rev().find(fits).unwrap_or(LEAST_SIDE_LOG2);
        let room = gonio_simd::padded(sensors.len()) + gonio_simd::PADDING;
        let column = |value: &dyn Fn(&Sensor) -> f32| {
            let mut column = Column::new(room);
            column.iter_mut().zip(sensors).for_each(|(place, sensor)| *place = value(sensor));
            column
        };
        let mut looks = Column::new(room);
        looks.iter_mut().zip(sensors).for_each(|(place, sensor)| *place = u32::from(sensor.looks));
        Self {
            count: sensors.len() as u32,
            side_log2,
            across_log2: TILE_LOG2 - side_log2,
            position: std::array::from_fn(|axis| column(&|sensor| sensor.position[axis])),
            error: column(&|sensor| sensor.error),
            normal: std::array::from_fn(|axis| column(&|sensor| sensor.normal[axis])),
            side: std::array::from_fn(|axis| column(&|sensor| sensor.side[axis])),
            turn: column(&|sensor| sensor.turn),
            looks,
            surroundings: SurroundingsColumns::new(&sensors.iter().map(|sensor| sensor.surroundings).collect::<Vec<_>>()),
        }
    }

    /// Pixels along a block's side.
    pub fn side(&self) -> usize {
        1 << self.side_log2
    }

    /// Width and height of the picture that holds all blocks; the width is a tile's.
    pub fn resolution(&self) -> [u32; 2] {
        let rows = self.count.div_ceil(1 << self.across_log2).max(1);
        [TILE as u32, rows << self.side_log2]
    }

    /// First column and row of a sensor's block.
    pub fn block(&self, sensor: usize) -> [usize; 2] {
        let across = 1 << self.across_log2;
        [sensor % across, sensor / across].map(|place| place << self.side_log2)
    }
}

/// Queues the points that some sensors measure, each once, in slots of their order.
#[inline(always)]
pub(crate) fn queue_sensors<L: Lanes>(l: L, sensors: &SensorTable, chosen: Range<usize>, points: &mut MeasurePoints) {
    points.count = 0;
    for first in chosen.clone().step_by(L::COUNT) {
        let number = l.iota() + first as u32;
        let inside = number.lt(chosen.end as u32);
        let sensor = number.keep_if(inside);
        let normal = gather3(l, &sensors.normal, sensor);
        let point = MeasureLanes {
            position: gather3(l, &sensors.position, sensor),
            error: l.gather(&sensors.error, sensor),
            geometric_normal: normal,
            shading_normal: normal,
            receiver: l.u(0),
            core: PathCore::of_sensors(l, Wavelengths::rgb(l), number - chosen.start as u32, (&sensors.surroundings, sensor)),
        };
        points.append(&point, inside);
    }
}

/// Queues the points that the tile's sensors measure in this batch, and starts the paths of those that measure luminance.
#[inline(always)]
pub(crate) fn start_sensors<L: Lanes>(
    l: L,
    sensors: &SensorTable,
    sampler: &Sampler,
    area: TileArea,
    (runs, wavelengths): (&Runs, WavelengthColumn<'_>),
    points: &mut MeasurePoints,
    paths: &mut Paths,
) {
    (paths.count, points.count) = (0, 0);
    for [first_slot, first_pixel, sample] in runs.registers(L::COUNT) {
        let (slot, pixel) = (l.iota() + first_slot, l.iota() + first_pixel);
        let (x, y) = (morton_even(pixel) + area.min[0], morton_even(pixel >> 1) + area.min[1]);
        let sensor = ((y >> sensors.side_log2) << sensors.across_log2) + (x >> sensors.side_log2);
        let inside = x.lt(area.max[0]) & y.lt(area.max[1]) & sensor.lt(sensors.count);
        if !inside.any() {
            continue;
        }
        let sensor = sensor.keep_if(inside);
        let [u, _] = sampler.pair(l, sampler.index(pixel, l.u(sample)), dimension::PIXEL);
        let (sin, cos) = ((u * 2.0 - 1.0) * l.gather(&sensors.turn, sensor)).sin_cos();
        let normal = (gather3(l, &sensors.normal, sensor) * cos + gather3(l, &sensors.side, sensor) * sin).normalize();
        let position = gather3(l, &sensors.position, sensor);
        let looks = l.gather_integers(&sensors.looks, sensor).ne(0);
        let core = PathCore::of_sensors(l, wavelengths.load(l, first_slot as usize), slot, (&sensors.surroundings, sensor));
        let point = MeasureLanes {
            position,
            error: l.gather(&sensors.error, sensor),
            geometric_normal: normal,
            shading_normal: normal,
            // No light is hidden from a meter.
            receiver: l.u(0),
            core,
        };
        points.append(&point, inside.and_not(looks));
        let ray = RayLanes { origin: position, direction: normal, t_min: l.f(0.0), t_max: l.f(f32::MAX) };
        paths.append(&PathLanes::start(ray, core), inside & looks);
    }
}
