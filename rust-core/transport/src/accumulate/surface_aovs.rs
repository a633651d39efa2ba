//! AOVs of the first surface that a camera ray meets.

use crate::accumulate::add::{add, add_rgb};
use crate::accumulate::tile_sums::TileSums;
use crate::words::code;
use gonio_simd::{Column, F, Lanes, M, Rgb, U, Vec3};

/// A first surface, by lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FirstSurface<L: Lanes> {
    pub(crate) slot: U<L>,
    /// Share of the camera ray's sample that it is.
    pub(crate) share: F<L>,
    /// Whether it hides what is behind it.
    pub(crate) covers: M<L>,
    pub(crate) look: Option<SurfaceLook<L>>,
    /// Instance set, the pass indices of the instance and of the material, number in the set, and triangle.
    pub(crate) numbers: Option<[U<L>; 5]>,
    pub(crate) clearness: Option<F<L>>,
    pub(crate) uv: Option<[F<L>; 2]>,
    /// Motion vectors, see [`crate::tables::motion_vectors`].
    pub(crate) motion: Option<[F<L>; 4]>,
    /// Albedos of the kinds of scattering.
    pub(crate) kinds: Option<[Rgb<L>; 3]>,
}

/// Where a first surface is, and what it is like.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceLook<L: Lanes> {
    pub(crate) depth: F<L>,
    pub(crate) normal: Vec3<L>,
    pub(crate) position: Vec3<L>,
    pub(crate) albedo: Rgb<L>,
}

impl TileSums {
    /// Adds what the chosen lanes' camera rays met.
    #[inline(always)]
    pub(crate) fn add_first_surface<L: Lanes>(&mut self, l: L, surface: &FirstSurface<L>, chosen: M<L>) {
        if !chosen.any() {
            return;
        }
        let (slot, share) = (surface.slot, surface.share);
        add(&mut self.alpha, slot, share, chosen & surface.covers);
        if let Some(look) = &surface.look {
            add(&mut self.depth, slot, look.depth * share, chosen);
            add_rgb(&mut self.normal, slot, (look.normal * share).into(), chosen);
            add_rgb(&mut self.position, slot, (look.position * share).into(), chosen);
            add_rgb(&mut self.albedo, slot, look.albedo * share, chosen);
        }
        if let Some(clearness) = surface.clearness {
            add(&mut self.clearness, slot, clearness * share, chosen);
        }
        if let Some([u, v]) = surface.uv {
            add_rgb(&mut self.uv, slot, Rgb::new(u, v, l.f(1.0)) * share, chosen);
        }
        if let Some(vectors) = surface.motion {
            let [ways @ .., weight] = &mut self.motion;
            for (column, way) in ways.iter_mut().zip(vectors) {
                add(column, slot, way * share, chosen);
            }
            add(weight, slot, share, chosen);
        }
        if let Some(kinds) = surface.kinds {
            for (kind, albedo) in kinds.into_iter().enumerate() {
                self.lights.add(l.u(code::COLOUR + kind as u32), slot, albedo * share, chosen);
            }
        }
        if let Some([set, object, material, instance, element]) = surface.numbers {
            keep_first(&mut self.instance_id, slot, instance, chosen);
            keep_first(&mut self.element_id, slot, element, chosen);
            keep_first(&mut self.prim_id, slot, set, chosen);
            keep_first(&mut self.object_index, slot, object, chosen);
            keep_first(&mut self.material_index, slot, material, chosen);
        }
    }
}

/// Keeps a number, one higher, in slots that have none yet.
#[inline(always)]
fn keep_first<L: Lanes>(column: &mut Column<u32>, slot: U<L>, number: U<L>, chosen: M<L>) {
    let (slots, numbers) = (slot.to_array(), number.to_array());
    let mut bits = chosen.bits();
    while bits != 0 {
        let lane = bits.trailing_zeros() as usize;
        let known = &mut column[slots[lane] as usize];
        if *known == 0 {
            *known = numbers[lane] + 1;
        }
        bits &= bits - 1;
    }
}
