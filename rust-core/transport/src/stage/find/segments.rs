//! The ways of light paths in one bounce, each from a scattering to the next surface, or out of the scene.

use crate::state::light_paths::LightStarts;
use crate::state::paths::Paths;
use crate::state::wavelengths::{SlotWavelengths, at_slots};
use crate::tables::Tables;
use crate::words::flag;
use gonio_accel::{Hits, NONE};
use gonio_simd::{Lanes, One};

/// The segments of a batch in one bounce, by their numbers.
#[derive(Clone, Copy, Debug)]
pub struct Segments<'a> {
    tables: &'a Tables,
    paths: &'a Paths,
    hits: &'a Hits,
    starts: &'a LightStarts,
    wavelengths: Option<&'a SlotWavelengths>,
}

/// One of them; rebased world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Where its distances count from.
    pub origin: [f32; 3],
    /// Unit direction.
    pub direction: [f32; 3],
    /// Metres from the origin at which it begins: behind what its ray has passed.
    pub from: f32,
    /// And ends; infinite where it leaves the scene.
    pub to: f32,
}

impl<'a> Segments<'a> {
    pub(crate) fn new(
        tables: &'a Tables,
        (paths, hits): (&'a Paths, &'a Hits),
        starts: &'a LightStarts,
        wavelengths: Option<&'a SlotWavelengths>,
    ) -> Self {
        Self { tables, paths, hits, starts, wavelengths }
    }

    /// How many there are.
    pub fn count(&self) -> usize {
        self.paths.count
    }

    /// Scatterings of a segment's path before it, by mirrors and smooth glass where nothing else was asked for.
    pub fn bounces(&self, segment: usize) -> u32 {
        self.paths.flags(segment) >> flag::BOUNCE_SHIFT
    }

    /// Where one lies.
    pub fn get(&self, segment: usize) -> Segment {
        let rays = &self.paths.rays;
        let three = |columns: &[gonio_simd::Column; 3]| [0, 1, 2].map(|axis| columns[axis][segment]);
        let met = self.hits.instance[segment] != NONE;
        Segment {
            origin: three(&rays.origin),
            direction: three(&rays.direction),
            from: rays.passed.distance(One, One.u(segment as u32)).0,
            to: if met { self.hits.t[segment] } else { f32::INFINITY },
        }
    }

    /// Flux that one carries at a distance from its origin, R, G, B in the units of the emission.
    pub fn flux(&self, segment: usize, distance: f32) -> [f32; 3] {
        let path = One.u(segment as u32);
        let left = self.paths.transmittance(One, (self.tables, self.wavelengths, None), path, One.f(distance), One.m(true));
        let flux = self.starts.carried(One, self.paths.track(One, path).slot, self.paths.carried(One, path).throughput);
        at_slots(One, self.wavelengths, self.paths.track(One, path).slot).to_rgb(flux * left).into()
    }
}
