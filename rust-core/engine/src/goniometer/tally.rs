//! What escapes from the luminaire, counted by direction and place.

use super::{angles::Cells, extent::ExtentAxes, frame::Frame, screen::ScreenPlane};
use crate::{
    light_paths::{Batch, BatchEstimates, BatchSums, Channels, Collector, Estimate, FixedSums},
    transport::{Arrivals, Escapes, LIGHT_BATCH, Receiver},
};

/// Fluxes of a batch that are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flux {
    Emitted,
    Escaped,
    CutOff,
    Absorbed,
}

const FLUXES: usize = 4;
/// One ray of so many tells where light leaves: it costs more than all else here.
const SEEN: usize = 8;

/// What rays are sorted by.
#[derive(Clone, Debug)]
pub(super) struct Instrument {
    pub(super) frame: Frame,
    /// The frame's origin in the rebased world.
    pub(super) origin: [f64; 3],
    pub(super) cells: Cells,
    pub(super) extent: ExtentAxes,
    pub(super) screen: Option<ScreenPlane>,
    /// World position of the rebased origin.
    pub(super) rebased: [f64; 3],
}

/// Sums over the batches of one kind of source.
#[derive(Debug)]
pub(super) struct Tally<'a> {
    instrument: &'a Instrument,
    directions: BatchEstimates,
    screen: BatchEstimates,
    fluxes: BatchEstimates,
    extent: FixedSums,
}

/// A worker's batch.
#[derive(Debug)]
pub(super) struct Room<'a> {
    instrument: &'a Instrument,
    directions: BatchSums,
    screen: BatchSums,
    extent: BatchSums,
    escaped: Channels,
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
            extent: FixedSums::new(ExtentAxes::len(), power, most),
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

    /// Flux by place along the opening's axes, in units of all batches.
    pub(super) fn extent(&self, cell: usize) -> Channels {
        self.extent.get(cell)
    }
}

impl<'a> Collector for Tally<'a> {
    type Room = Room<'a>;

    fn room(&self) -> Room<'a> {
        let instrument = self.instrument;
        Room {
            instrument,
            directions: BatchSums::new(instrument.cells.len()),
            screen: BatchSums::new(instrument.screen.as_ref().map_or(0, ScreenPlane::len)),
            extent: BatchSums::new(ExtentAxes::len()),
            escaped: [0.0; 3],
        }
    }

    fn add(&self, batch: &Batch<'_>, room: &mut Room<'a>) {
        let escaped = std::mem::take(&mut room.escaped);
        let (emitted, cut_off) = (batch.flux.emitted, batch.flux.cut_off);
        let absorbed = [0, 1, 2].map(|k| emitted[k] - escaped[k] - cut_off[k]);
        let mut fluxes = BatchSums::new(FLUXES);
        for (flux, value) in [(Flux::Emitted, emitted), (Flux::Escaped, escaped), (Flux::CutOff, cut_off), (Flux::Absorbed, absorbed)] {
            fluxes.add(flux as usize, value);
        }
        self.fluxes.add(&mut fluxes);
        self.directions.add(&mut room.directions);
        self.screen.add(&mut room.screen);
        room.extent.drain(|cell, value| self.extent.add(cell, value));
    }
}

impl Receiver for Room<'_> {
    fn arrived(&mut self, _: &Arrivals) {}

    fn escaped(&mut self, escapes: &Escapes) {
        let Instrument { frame, origin, cells, extent, screen, rebased } = self.instrument;
        let three = |columns: &[gonio_simd::Column; 3], entry: usize| [0, 1, 2].map(|k| f64::from(columns[k][entry]));
        for entry in 0..escapes.count {
            let [place, direction, flux] = [&escapes.origin, &escapes.direction, &escapes.flux].map(|columns| three(columns, entry));
            for (sum, flux) in self.escaped.iter_mut().zip(flux) {
                *sum += flux;
            }
            if let Some(cell) = cells.find(frame.direction(direction)) {
                self.directions.add(cell, flux);
            }
            if entry % SEEN == 0 {
                for cell in extent.find([0, 1, 2].map(|k| place[k] - origin[k])) {
                    self.extent.add(cell, flux);
                }
            }
            if let Some(screen) = screen
                && let Some(cell) = screen.find([0, 1, 2].map(|k| place[k] + rebased[k]), direction)
            {
                self.screen.add(cell, flux);
            }
        }
    }
}
