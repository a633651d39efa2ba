//! What a path carries from vertex to vertex.
//!
//! The record is embedded whole wherever a path waits: in [`crate::state::paths::PathLanes`], vertices, and points that are measured. What is added to it needs
//! a column there, and somebody who decides its value at scattering ([`crate::state::vertex::Vertex`]'s makers).

use crate::media::set::{MediaColumns, MediaSet};
use crate::tables::Tables;
use crate::words::flag;
use gonio_camera::Surroundings;
use gonio_simd::{Column, F, Lanes, One, Spectrum, U, Wavelengths};

/// One register of what paths carry.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathCore<L: Lanes> {
    pub(crate) throughput: Spectrum<L>,
    /// Where contributions go: the pixel's Morton number, plus `BATCH` for paths that measure illuminance. [`crate::stage::shade::catcher`] adds more.
    pub(crate) slot: U<L>,
    /// What the path has met, bits of [`crate::words::flag`].
    pub(crate) flags: U<L>,
    /// Bounces so far by kind, a byte each: diffuse, glossy, transmitted, straight through.
    pub(crate) counts: U<L>,
    /// Ray cone (pbrt's ray differentials): width here, metres, and growth a metre.
    pub(crate) width: F<L>,
    pub(crate) spread: F<L>,
    /// What the path is in.
    pub(crate) media: MediaSet<L>,
    /// Throughput as it were without guiding, over throughput: roulette goes by that.
    pub(crate) unguided: F<L>,
}

/// What cameras and meters stand in, as columns.
#[derive(Debug)]
pub(crate) struct SurroundingsColumns {
    media: MediaColumns,
    tints: Column,
    squared_index: Column,
}

impl SurroundingsColumns {
    pub(crate) fn new(all: &[Surroundings]) -> Self {
        let room = gonio_simd::padded(all.len()) + gonio_simd::PADDING;
        let (mut media, mut tints, mut squared_index) = (MediaColumns::new(room), Column::new(room), Column::new(room));
        for (place, one) in all.iter().enumerate() {
            media.store(MediaSet::at_place(One, one), place);
            tints[place] = one.tints;
            squared_index[place] = one.squared_index;
        }
        Self { media, tints, squared_index }
    }
}

impl<L: Lanes> PathCore<L> {
    /// That of paths which start at a camera.
    #[inline(always)]
    pub(crate) fn of_camera(l: L, wavelengths: Wavelengths<'_, L>, slot: U<L>, camera: &Surroundings) -> Self {
        let throughput = Spectrum::constant(l.f(camera.squared_index));
        let media = MediaSet::at_place(l, camera).seen_at(wavelengths, l.f(camera.tints));
        Self { throughput, media, ..Self::new(l, slot, l.u(flag::CAMERA | flag::DELTA)) }
    }

    /// That of paths which start at meters.
    #[inline(always)]
    pub(crate) fn of_sensors(l: L, wavelengths: Wavelengths<'_, L>, slot: U<L>, (sensors, sensor): (&SurroundingsColumns, U<L>)) -> Self {
        let throughput = Spectrum::constant(l.gather(&sensors.squared_index, sensor));
        let media = sensors.media.gather(l, sensor).seen_at(wavelengths, l.gather(&sensors.tints, sensor));
        Self { throughput, media, ..Self::new(l, slot, l.u(flag::CAMERA | flag::DELTA)) }
    }

    /// That of a path which begins, a line, in what fills all of space.
    #[inline(always)]
    pub(crate) fn of_world(l: L, tables: &Tables, slot: U<L>, flags: U<L>) -> Self {
        Self { media: MediaSet::everywhere(l, &tables.materials.media), ..Self::new(l, slot, flags) }
    }

    /// That of a path which begins, a line, in the open.
    #[inline(always)]
    pub(crate) fn new(l: L, slot: U<L>, flags: U<L>) -> Self {
        Self {
            throughput: Spectrum::one(l),
            slot,
            flags,
            counts: l.u(0),
            width: l.f(0.0),
            spread: l.f(0.0),
            media: MediaSet::open(l),
            unguided: l.f(1.0),
        }
    }
}
