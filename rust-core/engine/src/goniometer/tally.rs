//! What escapes from the luminaire, counted by direction and place.

use super::{
    angles::{Cells, LEVEL, OUTSIDE},
    frame::{Frame, dot},
    opening::{Departure, Sample},
    screen::ScreenPlane,
};
use crate::{
    light_paths::{Batch, BatchEstimates, Channels, Collector, Estimate, WorkerSums},
    transport::{Arrivals, Escapes, LIGHT_BATCH, Receiver},
};
use gonio_simd::{Column, Execution, Lanes, Vec3, dispatch};

/// Fluxes of a batch that are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flux {
    Emitted,
    Escaped,
    /// Of what escaped, that which goes up.
    Up,
    CutOff,
    Absorbed,
}

const FLUXES: usize = 5;
/// One ray of so many tells where light leaves: that is enough of them.
const SEEN: usize = 8;

/// What rays are sorted by.
#[derive(Clone, Debug)]
pub(super) struct Instrument {
    pub(super) frame: Frame,
    /// The frame's origin in the rebased world.
    pub(super) origin: [f64; 3],
    pub(super) cells: Cells,
    pub(super) screen: Option<ScreenPlane>,
    /// World position of the rebased origin.
    pub(super) rebased: [f64; 3],
    pub(super) execution: Execution,
}

/// Sums over the batches of one kind of source.
#[derive(Debug)]
pub(super) struct Tally<'a> {
    instrument: &'a Instrument,
    directions: BatchEstimates,
    screen: BatchEstimates,
    fluxes: BatchEstimates,
    departures: Sample,
}

/// A worker's batch.
#[derive(Debug)]
pub(super) struct Room<'a> {
    instrument: &'a Instrument,
    directions: WorkerSums,
    screen: WorkerSums,
    fluxes: WorkerSums,
    /// What escaped, and what of it goes up.
    escaped: [Channels; 2],
    departures: Option<Vec<Departure>>,
    /// Rays that escaped in this batch.
    count: usize,
    /// Cells of what escapes in a bounce, by entry.
    cells: Vec<u32>,
}

impl Instrument {
    /// The cells of directions that light leaves in.
    #[inline(always)]
    fn find_cells<L: Lanes>(&self, l: L, escapes: &Escapes, cells: &mut [u32]) {
        let [x, y, z] = &escapes.direction;
        let axes = self.frame.axes.map(|axis| Vec3::splat(l, axis.map(|x| x as f32)));
        for at in (0..escapes.count).step_by(L::COUNT) {
            let direction = Vec3::load(l, [x, y, z], at);
            let [x, y, z] = axes;
            self.cells.find(Vec3::new(x.dot(direction), y.dot(direction), z.dot(direction))).store(cells, at);
        }
    }
}

impl<'a> Tally<'a> {
    /// Empty sums for paths that carry `power`, of which there may be `most`.
    pub(super) fn new(instrument: &'a Instrument, power: Channels, most: u64) -> Self {
        let estimates = |cells| BatchEstimates::new(cells, power, most);
        Self {
            instrument,
            directions: estimates(instrument.cells.len()),
            screen: estimates(instrument.screen.as_ref().map_or(0, ScreenPlane::len)),
            fluxes: estimates(FLUXES),
            departures: Sample::default(),
        }
    }

    /// Flux into a cell of directions after so many batches.
    pub(super) fn direction(&self, cell: usize, batches: u64) -> Estimate {
        self.directions.get(cell, batches, LIGHT_BATCH)
    }

    /// Flux onto a cell of the screen.
    pub(super) fn on_screen(&self, cell: usize, batches: u64) -> Estimate {
        self.screen.get(cell, batches, LIGHT_BATCH)
    }

    /// A flux.
    pub(super) fn flux(&self, flux: Flux, batches: u64) -> Estimate {
        self.fluxes.get(flux as usize, batches, LIGHT_BATCH)
    }

    /// Where light leaves.
    pub(super) fn departures(&self) -> &Sample {
        &self.departures
    }
}

impl<'a> Collector for Tally<'a> {
    type Room = Room<'a>;

    fn room(&self) -> Room<'a> {
        let instrument = self.instrument;
        Room {
            instrument,
            directions: WorkerSums::new(instrument.cells.len()),
            screen: WorkerSums::new(instrument.screen.as_ref().map_or(0, ScreenPlane::len)),
            fluxes: WorkerSums::new(FLUXES),
            escaped: [[0.0; 3]; 2],
            departures: self.departures.is_wanted().then(Vec::new),
            count: 0,
            cells: Vec::new(),
        }
    }

    fn add(&self, batch: &Batch<'_>, room: &mut Room<'a>) {
        let [escaped, up] = std::mem::take(&mut room.escaped);
        room.count = 0;
        let (emitted, cut_off) = (batch.flux.emitted, batch.flux.cut_off);
        let absorbed = [0, 1, 2].map(|k| emitted[k] - escaped[k] - cut_off[k]);
        let fluxes =
            [(Flux::Emitted, emitted), (Flux::Escaped, escaped), (Flux::Up, up), (Flux::CutOff, cut_off), (Flux::Absorbed, absorbed)];
        fluxes.into_iter().for_each(|(flux, value)| room.fluxes.add(flux as usize, value));
        if let Some(departures) = &mut room.departures {
            self.departures.add(batch.number, std::mem::take(departures));
        }
        self.fluxes.complete(&mut room.fluxes);
        self.directions.complete(&mut room.directions);
        self.screen.complete(&mut room.screen);
    }

    fn join(&self, room: &mut Room<'a>) {
        self.fluxes.join(&mut room.fluxes);
        self.directions.join(&mut room.directions);
        self.screen.join(&mut room.screen);
    }
}

impl Receiver for Room<'_> {
    fn arrived(&mut self, _: &Arrivals) {}

    fn escaped(&mut self, escapes: &Escapes) {
        self.cells.resize(gonio_simd::padded(escapes.count), OUTSIDE);
        dispatch!(self.instrument.execution, l => self.instrument.find_cells(l, escapes, &mut self.cells));
        let upwards = self.instrument.frame.axes[2];
        for entry in 0..escapes.count {
            let flux = three(&escapes.flux, entry);
            add(&mut self.escaped[0], flux);
            if dot(upwards, three(&escapes.direction, entry)) > f64::from(LEVEL) {
                add(&mut self.escaped[1], flux);
            }
            if self.cells[entry] != OUTSIDE {
                self.directions.add(self.cells[entry] as usize, flux);
            }
        }
        self.find_places(escapes);
    }
}

impl Room<'_> {
    /// Adds to the places that light leaves at, and to those of the screen.
    fn find_places(&mut self, escapes: &Escapes) {
        let Instrument { frame, origin, screen, rebased, .. } = self.instrument;
        if let Some(departures) = &mut self.departures {
            let first = (SEEN - self.count % SEEN) % SEEN;
            departures.extend((first..escapes.count).step_by(SEEN).map(|entry| {
                let place = three(&escapes.origin, entry);
                let from_origin = [0, 1, 2].map(|k| place[k] - origin[k]);
                Departure { place: frame.direction(from_origin), direction: frame.direction(three(&escapes.direction, entry)) }
            }));
            self.count += escapes.count;
        }
        let Some(screen) = screen else { return };
        for entry in 0..escapes.count {
            let [place, direction] = [&escapes.origin, &escapes.direction].map(|columns| three(columns, entry));
            if let Some(cell) = screen.find([0, 1, 2].map(|k| place[k] + rebased[k]), direction) {
                self.screen.add(cell, three(&escapes.flux, entry));
            }
        }
    }
}

#[inline(always)]
fn add(sum: &mut Channels, flux: Channels) {
    sum.iter_mut().zip(flux).for_each(|(sum, flux)| *sum += flux);
}

#[inline(always)]
fn three([x, y, z]: &[Column; 3], entry: usize) -> [f64; 3] {
    [f64::from(x[entry]), f64::from(y[entry]), f64::from(z[entry])]
}
