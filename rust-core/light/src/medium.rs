//! Lamps that stand in glass, resin or water: a factor on what is seen of them.
//!
//! Camera paths keep radiance where light passes an interface. So what they carry is radiance over the squared index of what it goes through, and lamps
//! have to be told in the same measure. Rays that a lamp sends carry its flux, which needs no factor.

use super::row::{ROW, field, flag};
use super::table::LightTable;
use gonio_simd::{F, Lanes, Rgb, U};

/// How far a place is off a light's surface, over the light's radius, and over the size of its coordinates at least.
const OFF: [f32; 2] = [1e-4, 4e-6];

impl LightTable {
    /// Lets lights count by factors, one a light: 1 over the squared index of what each stands in. None at all where no light stands in anything.
    pub fn set_media(&mut self, factors: Vec<f32>) {
        debug_assert!(factors.is_empty() || factors.len() == self.count);
        self.media = factors;
    }
    /// Whether some light stands in glass or the like.
    pub fn has_media(&self) -> bool {
        !self.media.is_empty()
    }
    /// Each lane's factor.
    #[inline(always)]
    pub fn medium_factor<L: Lanes>(&self, l: L, light: U<L>) -> F<L> {
        if self.media.is_empty() { l.f(1.0) } else { l.gather(&self.media, light) }
    }
    /// The middle of a light that has a place and sends light; of flat ones just before their front.
    pub fn front(&self, light: u32) -> Option<[f32; 3]> {
        let (centre, radius) = self.ball(light)?;
        let row = self.rows.as_chunks::<ROW>().0.get(light as usize)?;
        let is_flat = row[field::FLAGS].to_bits() & flag::FLAT != 0;
        let largest = centre.iter().fold(0.0, |most: f32, x| most.max(x.abs()));
        let off = if is_flat { (OFF[0] * radius).max(OFF[1] * largest) } else { 0.0 };
        Some(std::array::from_fn(|axis| row[field::NORMAL + axis].mul_add(off, centre[axis])))
    }
    /// What paths see of lights that send so much.
    #[inline(always)]
    pub(crate) fn seen_outside<L: Lanes>(&self, l: L, light: U<L>, sent: Rgb<L>) -> Rgb<L> {
        if self.media.is_empty() {
            return sent;
        }
        sent * self.medium_factor(l, light)
    }
}
