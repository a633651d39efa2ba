//! The wavelengths of each slot's path, where light has any. A path keeps its slot, so all its vertices ask here; nothing is carried along.

use gonio_camera::sampler::{BATCH, Runs, Sampler, dimension};
use gonio_simd::{Execution, Lanes, PADDING, U, WavelengthColumn, WavelengthTable, Wavelengths, dispatch};
use std::sync::Arc;

/// Rotations of the wavelengths of a batch, by the place of a slot's pixel.
#[derive(Clone, Debug)]
pub(crate) struct SlotWavelengths {
    table: Arc<WavelengthTable>,
    rotations: Vec<u32>,
}

impl SlotWavelengths {
    /// Draws those of a batch into the room that is there; nothing where light has no wavelengths.
    pub(crate) fn draw(
        execution: Execution,
        table: Option<&Arc<WavelengthTable>>,
        (sampler, runs): (&Sampler, &Runs),
        room: &mut Option<Arc<Self>>,
    ) {
        let Some(table) = table else { return *room = None };
        let fresh = || Arc::new(Self { table: table.clone(), rotations: vec![0; BATCH + PADDING] });
        let slots = Arc::make_mut(room.get_or_insert_with(fresh));
        if !Arc::ptr_eq(&slots.table, table) {
            slots.table = table.clone();
        }
        dispatch!(execution, l => draw(l, sampler, runs, table.rotations, &mut slots.rotations));
    }

    /// By slot of paths.
    pub(crate) fn column(&self) -> WavelengthColumn<'_> {
        WavelengthColumn::new(Some(&self.table), &self.rotations)
    }

    /// Those of some slots of any kind.
    #[inline(always)]
    pub(crate) fn at<L: Lanes>(&self, l: L, slot: U<L>) -> Wavelengths<'_, L> {
        Wavelengths::new(Some(&self.table), l.gather_integers(&self.rotations, slot & (BATCH as u32 - 1)))
    }
}
const _: () = assert!(BATCH.is_power_of_two());

/// Those of slots where light has wavelengths; else it is computed as colour.
#[inline(always)]
pub(crate) fn at_slots<L: Lanes>(l: L, wavelengths: Option<&SlotWavelengths>, slot: U<L>) -> Wavelengths<'_, L> {
    match wavelengths {
        Some(wavelengths) => wavelengths.at(l, slot),
        None => Wavelengths::rgb(l),
    }
}

/// Even numbers: a pixel's samples have one in each of as many parts.
#[inline(always)]
fn draw<L: Lanes>(l: L, sampler: &Sampler, runs: &Runs, count: u32, rotations: &mut [u32]) {
    for slot in (0..BATCH).step_by(L::COUNT) {
        let index = runs.index(l, sampler, l.iota() + slot as u32);
        let u = sampler.third(l, index, dimension::LENS);
        (u * count as f32).min((count - 1) as f32).to_i32().store(rotations, slot);
    }
}

/// The wavelengths of a chunk of hits, or of rays that wait.
#[derive(Clone, Debug, Default)]
pub(crate) struct ChunkWavelengths {
    table: Option<Arc<WavelengthTable>>,
    rotations: Vec<u32>,
}

impl ChunkWavelengths {
    /// Fills them by slots, one after the other.
    pub(crate) fn fill(&mut self, wavelengths: Option<&SlotWavelengths>, slots: impl Iterator<Item = u32>) {
        self.rotations.clear();
        let Some(wavelengths) = wavelengths else {
            self.table = None;
            return;
        };
        if !self.table.as_ref().is_some_and(|table| Arc::ptr_eq(table, &wavelengths.table)) {
            self.table = Some(wavelengths.table.clone());
        }
        self.rotations.extend(slots.map(|slot| wavelengths.rotations[slot as usize % BATCH]));
        self.rotations.resize(self.rotations.len() + PADDING, 0);
    }
    /// By hit or ray.
    pub(crate) fn column(&self) -> WavelengthColumn<'_> {
        WavelengthColumn::new(self.table.as_deref(), &self.rotations)
    }
}
