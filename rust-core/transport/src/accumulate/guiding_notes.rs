//! What the guiding field learns from: where paths went on from diffuse lobes, and the light that they found from there on.

use crate::geometry::NONE;
use crate::state::paths::Paths;
use crate::tables::guiding::GuidingNote;
use crate::words::{event, flag};
use gonio_camera::sampler::hash;
use gonio_simd::{Lanes, M, One, Spectrum, U};

/// Slots of a block of neighbouring pixels, whose light is compared: slots are Morton numbers.
const BLOCK: usize = 64;

/// The notes of paths that learn. Each slot has one path at a time.
#[derive(Clone, Debug, Default)]
pub struct GuidingNotes {
    /// Vertices from which light was found.
    pub notes: Vec<GuidingNote>,
    /// Decides with the slot to which half of the notes a path's belong.
    salt: u32,
    /// Shares of the light that diffuse lobes bring from elsewhere than from lights, summed over blocks of pixels, and the blocks' number.
    indirect: [f64; 2],
    /// Vertices of the paths under way, each with the number of the one before.
    open: Vec<(GuidingNote, u32)>,
    /// By slot, its path's last vertex.
    last: Vec<u32>,
    /// By block, light of all kinds, and that which was found from a diffuse vertex on.
    blocks: Vec<[f64; 2]>,
}

impl GuidingNotes {
    /// For paths of some samples; `number` is another one for others.
    pub fn new(number: u32) -> Self {
        Self { salt: hash(number), ..Self::default() }
    }

    /// Notes where paths go on from diffuse lobes, before their rays are traced.
    pub(crate) fn go_on(&mut self, paths: &Paths) {
        for path in 0..paths.count {
            let flags = paths.flags(path);
            let bounces = flags >> flag::BOUNCE_SHIFT;
            let diffuse = flags & flag::DELTA == 0 && flags >> flag::LAST_SHIFT & 3 == event::DIFFUSE;
            if bounces == 0 || !diffuse {
                continue;
            }
            let slot = paths.slot(path) as usize;
            if slot >= self.last.len() {
                self.last.resize(slot + 1, NONE);
            }
            let before = self.last[slot];
            // What goes straight through is on its way from the same vertex.
            if self.open.get(before as usize).is_some_and(|(note, _)| note.bounces == bounces) {
                continue;
            }
            let note = GuidingNote { half: hash(paths.slot(path) ^ self.salt) & 1 != 0, ..note(paths, path, bounces) };
            if let Some((previous, _)) = self.open.get_mut(before as usize) {
                previous.distance = (0..3).map(|axis| (previous.position[axis] - note.position[axis]).powi(2)).sum::<f32>().sqrt();
            }
            self.last[slot] = self.open.len() as u32;
            self.open.push((note, before));
        }
    }

    /// Counts light for all vertices that its path went on from.
    #[inline(always)]
    pub(crate) fn found<L: Lanes>(&mut self, slots: U<L>, value: Spectrum<L>, chosen: M<L>) {
        self.count(&slots.to_array(), &value.abs().mean().to_array(), chosen.bits());
    }

    #[inline(never)]
    fn count(&mut self, slots: &[u32], values: &[f32], chosen: u64) {
        for (lane, (slot, value)) in slots.iter().zip(values).enumerate() {
            if chosen >> lane & 1 != 0 {
                self.count_one(*slot as usize, *value);
            }
        }
    }

    fn count_one(&mut self, slot: usize, value: f32) {
        let mut number = self.last.get(slot).copied().unwrap_or(NONE);
        let block = slot / BLOCK;
        if block >= self.blocks.len() {
            self.blocks.resize(block + 1, [0.0; 2]);
        }
        self.blocks[block][0] += f64::from(value);
        if number != NONE {
            self.blocks[block][1] += f64::from(value);
        }
        while let Some((note, before)) = self.open.get_mut(number as usize) {
            note.found += value;
            number = *before;
        }
    }

    /// Ends the paths under way; vertices that found nothing are forgotten.
    pub(crate) fn settle(&mut self) {
        self.notes.extend(self.open.drain(..).map(|(note, _)| note).filter(|note| note.found > 0.0));
        self.last.clear();
        for [all, indirect] in self.blocks.drain(..).filter(|block| block[0] > 0.0) {
            self.indirect[0] += indirect / all;
            self.indirect[1] += 1.0;
        }
    }

    /// Adds the notes of other paths, which come after.
    pub fn append(&mut self, other: &mut Self) {
        self.notes.append(&mut other.notes);
        self.indirect = [0, 1].map(|part| self.indirect[part] + other.indirect[part]);
    }

    /// The share of the light that came by diffuse lobes from elsewhere than from lights, in the mean over the picture.
    pub fn indirect(&self) -> f64 {
        self.indirect[0] / self.indirect[1].max(1.0)
    }
}

/// The vertex that a path leaves.
fn note(paths: &Paths, path: usize, bounces: u32) -> GuidingNote {
    let lane = U::<One>(path as u32);
    let (carried, from) = (paths.carried(One, lane), paths.previous(One, lane));
    GuidingNote {
        position: [from.position.x.0, from.position.y.0, from.position.z.0],
        normal: [from.normal.x.0, from.normal.y.0, from.normal.z.0],
        direction: [0, 1, 2].map(|axis| paths.rays.direction[axis][path]),
        pdf: carried.pdf.0,
        throughput: carried.throughput.max_component().0,
        bounces,
        half: false,
        distance: 0.0,
        found: 0.0,
    }
}
