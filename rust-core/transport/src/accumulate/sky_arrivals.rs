//! Light of an even sky by the direction that it came from, of which daylight coefficients are made.

use crate::accumulate::deposit::{Contribution, Deposits};
use crate::words::{code, flag};
use gonio_camera::sampler::BATCH;
use gonio_simd::{F, Lanes, M, PADDING, Vec3};

/// Entries that there is room for at first.
const ROOM: usize = 1 << 14;

/// Light that arrived from infinitely far, an entry each.
#[derive(Debug, Default)]
pub struct SkyArrivals {
    /// Entries.
    pub count: usize,
    /// Where the light goes, as contributions have it: measured points come behind all pixels.
    pub slot: Vec<u32>,
    /// Unit direction that it came from, world space.
    pub direction: [Vec<f32>; 3],
    /// What it adds to the slot's sum, the luminance of that.
    pub value: Vec<f32>,
    /// Its light pass, or of light from given directions the number of that.
    code: Vec<u32>,
}

impl SkyArrivals {
    /// Whether nothing scattered an entry's light on its way.
    pub fn is_direct(&self, entry: usize) -> bool {
        let pass = self.code[entry] & code::CODES;
        // Pixels see it; measured points are lit by it as first surfaces are.
        if (self.slot[entry] as usize) < BATCH { matches!(pass, code::EMISSION | code::ENVIRONMENT) } else { pass < code::INDIRECT }
    }

    /// The number of the direction that an entry came from, see [`crate::Tracer::light_from`].
    pub fn number(&self, entry: usize) -> usize {
        (self.code[entry] >> code::NUMBER_SHIFT) as usize
    }

    /// The group of the first opening that an entry's light came through, seen from where it goes; 0 is none. See [`crate::Openings`].
    pub fn opening(&self, entry: usize) -> usize {
        ((self.code[entry] >> code::STATE_SHIFT) & flag::STATES) as usize
    }

    #[inline(always)]
    fn append<L: Lanes>(&mut self, light: &Contribution<L>, luminance: F<L>, direction: Vec3<L>, chosen: M<L>) {
        let n = self.count;
        if n + PADDING > self.value.len() {
            self.grow();
        }
        light.slot.append(chosen, &mut self.slot, n);
        let [x, y, z] = &mut self.direction;
        direction.x.append(chosen, x, n);
        direction.y.append(chosen, y, n);
        direction.z.append(chosen, z, n);
        luminance.append(chosen, &mut self.value, n);
        light.code.append(chosen, &mut self.code, n);
        self.count += chosen.count();
    }

    #[cold]
    fn grow(&mut self) {
        let room = (2 * self.value.len()).max(ROOM);
        [&mut self.slot, &mut self.code].into_iter().for_each(|column| column.resize(room, 0));
        self.direction.iter_mut().chain([&mut self.value]).for_each(|column| column.resize(room, 0.0));
    }
}

impl Deposits {
    /// Notes light that arrived from a direction, where anybody asks for it.
    #[inline(always)]
    pub(crate) fn note_sky<L: Lanes>(&mut self, light: &Contribution<L>, direction: Vec3<L>, arrived: M<L>) {
        if self.sky.is_none() {
            return;
        }
        let luminance = self.to_film(light.slot, light.value).luminance();
        if let Some(sky) = &mut self.sky {
            sky.append(light, luminance, direction, arrived);
        }
    }
}
