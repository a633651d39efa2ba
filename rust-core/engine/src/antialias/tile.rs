//! A tile, level by level.

use super::{
    Rule,
    compare::{CORNER_ROOM, STRIDE, Suspects, average, classify, find_zones, kind, weigh},
    places::{INNER, STEPS, ZIGZAGS, ZONES, turned},
    samples::{CHANNELS, Samples},
    visibility::{Mapped, VisibilityMap},
};
use crate::camera::sampler::{BATCH, TILE, tile_place};
use crate::transport::{Tracer, Workspace};
use gonio_simd::{Column, dispatch};

/// A tile to be traced.
#[derive(Clone, Copy, Debug)]
pub struct TileTask<'a> {
    /// What traces, from a camera.
    pub tracer: &'a Tracer<'a>,
    /// What is compared how.
    pub rule: Rule,
    /// Factor from radiance to what is shown, where 1 is white.
    pub scale: f32,
    /// First pixel, and the one behind the last.
    pub min: [u32; 2],
    /// See `min`; at most a tile's width further.
    pub max: [u32; 2],
    /// Whether passes beside the colour are wanted: they come from a ray through each pixel's middle.
    pub passes: bool,
}

/// Antialiases tiles, one after the other; holds what a worker needs for it.
#[derive(Debug, Default)]
pub struct Antialiaser {
    corners: Samples,
    inner: Samples,
    zigzags: Samples,
    suspects: Suspects,
    map: VisibilityMap,
    kinds: Column<u32>,
    sums: [Column; CHANNELS],
    queue: Queue,
}

/// Places that are to be traced, and where their values go.
#[derive(Debug, Default)]
struct Queue {
    places: [Vec<f32>; 2],
    targets: Vec<u32>,
}

impl Queue {
    fn push(&mut self, [x, y]: [f32; 2], target: usize) {
        self.places[0].push(x);
        self.places[1].push(y);
        self.targets.push(target as u32);
    }

    /// Traces all places in full batches.
    fn trace(&mut self, task: &TileTask<'_>, samples: &mut Samples, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
        let slots: Vec<u32> = (0..BATCH as u32).collect();
        for first in (0..self.targets.len()).step_by(BATCH) {
            let batch = first..(first + BATCH).min(self.targets.len());
            ws.deposits.sums.clear_colour();
            let places = [&self.places[0][batch.clone()], &self.places[1][batch.clone()]];
            task.tracer.trace_at(places, &slots[..batch.len()], ws, cancelled);
            samples.add(&self.targets[batch], &ws.deposits.sums);
        }
        self.places.iter_mut().for_each(Vec::clear);
        self.targets.clear();
    }
}

impl TileTask<'_> {
    fn size(&self) -> [usize; 2] {
        [0, 1].map(|axis| (self.max[axis] - self.min[axis]) as usize)
    }

    /// A place in a pixel of the tile, in the raster.
    fn place(&self, pixel: [usize; 2], inside: [f32; 2]) -> [f32; 2] {
        [0, 1].map(|axis| (self.min[axis] + pixel[axis] as u32) as f32 + inside[axis])
    }

    /// Morton numbers and places of the tile's pixels.
    fn pixels(&self) -> impl Iterator<Item = (usize, [usize; 2])> {
        let [width, height] = self.size();
        (0..BATCH).map(|code| (code, tile_place(code))).filter(move |(_, [x, y])| *x < width && *y < height)
    }
}

impl Antialiaser {
    /// Leaves the tile's colour, coverage and number of rays in the workspace's sums, and what passes show, as of one sample a pixel.
    ///
    /// `cancelled` is asked at every stage; a cancelled tile leaves the sums incomplete.
    pub fn trace(&mut self, task: &TileTask<'_>, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
        self.clear();
        self.trace_corners(task, ws, cancelled);
        self.find_seams(task, ws);
        self.list_suspects(task);
        self.trace_inner(task, ws, cancelled);
        self.trace_zigzags(task, ws, cancelled);
        ws.deposits.sums.clear();
        if task.passes {
            trace_middles(task, ws, cancelled);
        }
        self.write(task, ws);
    }

    fn clear(&mut self) {
        self.corners.clear(CORNER_ROOM);
        self.inner.clear(INNER.len() * BATCH);
        self.zigzags.clear(BATCH);
        self.suspects.clear();
        if self.kinds.is_empty() {
            self.kinds = Column::new(BATCH);
            self.sums = std::array::from_fn(|_| Column::new(BATCH));
        }
    }

    /// Level one: the corners, blocks of four by four together.
    fn trace_corners(&mut self, task: &TileTask<'_>, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
        let [columns, rows] = task.size().map(|side| side + 1);
        let blocks = (0..rows).step_by(4).flat_map(|y| (0..columns).step_by(4).map(move |x| [x, y]));
        for [left, top] in blocks {
            for y in top..(top + 4).min(rows) {
                for x in left..(left + 4).min(columns) {
                    self.queue.push(task.place([x, y], [0.0; 2]), y * STRIDE + x);
                }
            }
        }
        self.queue.trace(task, &mut self.corners, ws, cancelled);
        self.corners.show(task.tracer.transport.execution, CORNER_ROOM, task.scale);
    }

    /// Compares the corners, and looks for seams where they are even.
    fn find_seams(&mut self, task: &TileTask<'_>, ws: &mut Workspace) {
        dispatch!(task.tracer.transport.execution, l => classify(l, &task.rule, &self.corners, &mut self.kinds));
        let even: Vec<_> = task.pixels().map(|(_, pixel)| pixel).filter(|[x, y]| self.kinds[y * TILE + x] == kind::EVEN).collect();
        let Self { map, kinds, .. } = self;
        let tile = Mapped { min: task.min, size: task.size(), side: task.rule.map_side };
        map.look(task.tracer, tile, &even, ws, |[x, y]| kinds[y * TILE + x] = kind::UPRIGHT);
    }

    /// Lists the pixels of level two.
    fn list_suspects(&mut self, task: &TileTask<'_>) {
        for (code, [x, y]) in task.pixels() {
            let found = self.kinds[y * TILE + x];
            if found != kind::EVEN {
                self.suspects.codes.push(code as u32);
                self.suspects.corner.push((y * STRIDE + x) as u32);
                self.suspects.turned.push(u32::from(found == kind::TURNED));
            }
        }
        self.suspects.pad();
    }

    /// Where a point lies in the raster that is told in the upright version of a suspect's square.
    fn place(&self, task: &TileTask<'_>, suspect: usize, point: [f32; 2]) -> [f32; 2] {
        let pixel = tile_place(self.suspects.codes[suspect] as usize);
        task.place(pixel, if self.suspects.turned[suspect] == 0 { point } else { turned(point) })
    }

    /// Level two: the inner points of all suspects, four squares to a packet.
    fn trace_inner(&mut self, task: &TileTask<'_>, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
        for suspect in 0..self.suspects.count() {
            for (number, point) in INNER.into_iter().enumerate() {
                self.queue.push(self.place(task, suspect, point), INNER.len() * suspect + number);
            }
        }
        let execution = task.tracer.transport.execution;
        self.queue.trace(task, &mut self.inner, ws, cancelled);
        self.inner.show(execution, INNER.len() * self.suspects.count(), task.scale);
        dispatch!(execution, l => find_zones(l, &task.rule, &self.corners, &self.inner, &mut self.suspects));
    }

    /// Level three: the zigzags of the zones with a discontinuity, four to a packet.
    fn trace_zigzags(&mut self, task: &TileTask<'_>, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
        for suspect in 0..self.suspects.count() {
            for zone in (0..ZONES).filter(|zone| self.suspects.zones[suspect] >> zone & 1 == 1) {
                for point in ZIGZAGS[zone] {
                    self.queue.push(self.place(task, suspect, point), suspect);
                }
            }
        }
        self.queue.trace(task, &mut self.zigzags, ws, cancelled);
    }

    /// Puts colours and numbers of rays into the workspace's sums.
    fn write(&mut self, task: &TileTask<'_>, ws: &mut Workspace) {
        let execution = task.tracer.transport.execution;
        let sums = &mut ws.deposits.sums;
        dispatch!(execution, l => average(l, &self.corners, &mut self.sums));
        for (code, [x, y]) in task.pixels() {
            let value = [0, 1, 2, 3].map(|channel| self.sums[channel][y * TILE + x]);
            sums.set_pixel(code, value, 1);
        }
        dispatch!(execution, l => weigh(l, &self.corners, &self.inner, &self.zigzags, &self.suspects, &mut self.sums));
        for (suspect, code) in self.suspects.codes.iter().enumerate() {
            let value = [0, 1, 2, 3].map(|channel| self.sums[channel][suspect]);
            let zones = self.suspects.zones[suspect].count_ones();
            sums.set_pixel(*code as usize, value, 1 + INNER.len() as u32 + zones * STEPS as u32);
        }
    }
}

/// A ray through the middle of every pixel, for passes.
fn trace_middles(task: &TileTask<'_>, ws: &mut Workspace, cancelled: &dyn Fn() -> bool) {
    let (mut places, mut slots) = ([Vec::new(), Vec::new()], Vec::new());
    for (code, pixel) in task.pixels() {
        let [x, y] = task.place(pixel, [0.5; 2]);
        places[0].push(x);
        places[1].push(y);
        slots.push(code as u32);
    }
    task.tracer.trace_at([&places[0], &places[1]], &slots, ws, cancelled);
}
