//! What camera rays met, for cryptomattes: names and shares by slot, as they come. The film counts them.

use crate::geometry::GeometryTable;
use crate::tables::matte_names::MatteNames;
use gonio_simd::{F, Lanes, M, U};

/// A first surface, or a part of one that lets light pass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Met {
    /// Slot of the pixel.
    pub slot: u32,
    /// Values of the names of object, material and asset.
    pub names: [u32; 3],
    /// Share of the camera ray's sample.
    pub share: f32,
}

/// What the camera rays of a block met; empty where no matte is wanted.
#[derive(Debug, Default)]
pub struct MatteSums {
    /// In any order.
    pub met: Vec<Met>,
}

impl MatteSums {
    /// Notes the chosen lanes' surfaces, which are all of one material.
    #[inline(always)]
    pub(crate) fn add<L: Lanes>(
        &mut self,
        (names, geometry): (&MatteNames, &GeometryTable),
        material: u32,
        (slot, instance): (U<L>, U<L>),
        share: F<L>,
        chosen: M<L>,
    ) {
        let (slots, instances, shares) = (slot.to_array(), instance.to_array(), share.to_array());
        let mut bits = chosen.bits();
        while bits != 0 {
            let lane = bits.trailing_zeros() as usize;
            let [object, asset] = names.of(&geometry.instances[instances[lane] as usize]);
            self.met.push(Met { slot: slots[lane], names: [object, material, asset], share: shares[lane] });
            bits &= bits - 1;
        }
    }
}
