//! Paths under way: ray, throughput, pdf, ray cone, previous vertex, slot and flags of each.
//!
//! Rays lie in plain columns, as the TLAS traverses them. What stages gather of chosen paths lies in items of four words, one load a lane.

use crate::media::set::{FAR, MediaColumns};
use crate::media::track::{Track, seed};
use crate::state::columns::gather3;
use crate::state::passed::PassedLanes;
use crate::state::path_core::PathCore;
use crate::state::rays::{RayLanes, Rays};
use crate::state::sample::SampleContext;
use crate::state::times::SlotTimes;
use crate::state::wavelengths::SlotWavelengths;
use crate::tables::Tables;
use crate::words::{flag, ray_mask};
use gonio_camera::sampler::CAPACITY;
use gonio_light::LightSampleContext;
use gonio_simd::{Column, F, Lanes, M, Spectrum, SpectrumItems, U, Vec3, Wavelengths, padded};

/// Paths with a ray each.
#[derive(Debug)]
pub struct Paths {
    /// Paths in the columns.
    pub count: usize,
    /// Their rays; visibility bits are those of [`Self::set_masks`].
    pub rays: Rays,
    /// What the rays go through.
    pub(crate) media: MediaColumns,
    /// Items of throughput and pdf, see [`CarriedLanes`].
    pub(crate) carried: SpectrumItems,
    /// Ray cones: items of directions and widths, see [`ConeLanes`].
    cone: Column,
    /// Previous vertices: items of points with the bits of classes of receivers, and of normals, see [`Paths::previous`], with [`PathCore::unguided`].
    vertex: Column,
    normal: Column,
    /// Items of slots, flags, counts and the bits of spreads, see [`TrackLanes`].
    track: Column<u32>,
}

/// One register of paths, to be appended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PathLanes<L: Lanes> {
    pub(crate) ray: RayLanes<L>,
    /// What the ray has passed, if it has gone straight on.
    pub(crate) passed: Option<PassedLanes<L>>,
    /// The vertex that the ray leaves.
    pub(crate) from: LightSampleContext<L>,
    /// As in [`CarriedLanes`].
    pub(crate) pdf: F<L>,
    pub(crate) core: PathCore<L>,
}

impl<L: Lanes> PathLanes<L> {
    /// Paths that start with a ray.
    #[inline(always)]
    pub(crate) fn start(ray: RayLanes<L>, core: PathCore<L>) -> Self {
        let l = core.unguided.lanes();
        Self {
            ray,
            passed: None,
            from: LightSampleContext { position: ray.origin, normal: ray.direction, receiver: l.u(0) },
            pdf: l.f(1.0),
            core,
        }
    }

    /// The same from another vertex, from which they found their directions with a density.
    #[inline(always)]
    pub(crate) fn leaving(self, from: LightSampleContext<L>, pdf: F<L>) -> Self {
        Self { from, pdf, ..self }
    }

    /// The same, which went straight on through what they have passed, if they did.
    #[inline(always)]
    pub(crate) fn having_passed(self, passed: Option<PassedLanes<L>>) -> Self {
        Self { passed, ..self }
    }
}

/// Throughput of paths and the pdf of their directions: what light found along them counts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CarriedLanes<L: Lanes> {
    pub(crate) throughput: Spectrum<L>,
    /// Pdf of the direction per solid angle, for MIS; of a camera ray, the share of its sample that it stands for.
    pub(crate) pdf: F<L>,
}

/// Ray cones (ray footprints, pbrt's ray differentials); the growth is in [`TrackLanes::spread`].
#[derive(Clone, Copy, Debug)]
pub(crate) struct ConeLanes<L: Lanes> {
    pub(crate) direction: Vec3<L>,
    /// Width at the ray's start, metres.
    pub(crate) width: F<L>,
}

/// Where contributions of paths go, and what the paths have met.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TrackLanes<L: Lanes> {
    /// As in [`PathCore`].
    pub(crate) slot: U<L>,
    pub(crate) flags: U<L>,
    pub(crate) counts: U<L>,
    pub(crate) spread: F<L>,
}

/// Places in an item of [`TrackLanes`].
const SLOT: usize = 0;
const FLAGS: usize = 1;

impl Default for Paths {
    fn default() -> Self {
        // A register's room behind the last path: appending writes whole registers.
        let room = padded(CAPACITY) + gonio_simd::PADDING;
        Self {
            count: 0,
            rays: Rays::new(room, 0),
            media: MediaColumns::new(room),
            carried: SpectrumItems::new(room),
            cone: Column::new(4 * room),
            vertex: Column::new(4 * room),
            normal: Column::new(4 * room),
            track: Column::new(4 * room),
        }
    }
}

impl Paths {
    /// Leaves no path.
    pub(crate) fn clear(&mut self) {
        self.count = 0;
        self.rays.passed.clear();
    }

    /// Appends the chosen lanes; their visibility bits are set later by [`Self::set_masks`].
    #[inline(always)]
    pub(crate) fn append<L: Lanes>(&mut self, p: &PathLanes<L>, chosen: M<L>) {
        let (l, n) = (p.pdf.lanes(), self.count);
        let (direction, from, core) = (p.ray.direction, &p.from, &p.core);
        self.rays.append(&p.ray, chosen, n);
        self.rays.passed.append(l, p.passed.as_ref(), chosen, [n, self.rays.t_max.len()]);
        self.media.append(core.media, chosen, n);
        self.carried.append(core.throughput, p.pdf, chosen, n);
        l.append_quads([direction.x, direction.y, direction.z, core.width], chosen, &mut self.cone, n);
        l.append_quads([from.position.x, from.position.y, from.position.z, F::from_bits(from.receiver)], chosen, &mut self.vertex, n);
        l.append_quads([from.normal.x, from.normal.y, from.normal.z, core.unguided], chosen, &mut self.normal, n);
        let [slot, flags, counts] = [F::from_bits(core.slot), F::from_bits(core.flags), F::from_bits(core.counts)];
        l.append_quads([slot, flags, counts, core.spread], chosen, bytemuck::cast_slice_mut(&mut self.track), n);
        self.count += chosen.count();
    }

    /// Throughput and pdf of some paths.
    #[inline(always)]
    pub(crate) fn carried<L: Lanes>(&self, l: L, path: U<L>) -> CarriedLanes<L> {
        let (throughput, pdf) = self.carried.gather(l, path);
        CarriedLanes { throughput, pdf }
    }

    /// What some paths carry, but for what is seldom asked: their ray cones' widths are 0, they are in nothing, and unguided. And their pdfs.
    #[inline(always)]
    pub(crate) fn core<L: Lanes>(&self, l: L, path: U<L>) -> (PathCore<L>, F<L>) {
        let CarriedLanes { throughput, pdf } = self.carried(l, path);
        let TrackLanes { slot, flags, counts, spread } = self.track(l, path);
        (PathCore { throughput, counts, spread, ..PathCore::new(l, slot, flags) }, pdf)
    }

    /// The ray cones of some paths.
    #[inline(always)]
    pub(crate) fn cone<L: Lanes>(&self, l: L, path: U<L>) -> ConeLanes<L> {
        let [x, y, z, width] = l.gather_quads(&self.cone, path << 2);
        ConeLanes { direction: Vec3::new(x, y, z), width }
    }

    /// The previous vertices of some paths: NEE sampled lights from there, so MIS asks for its pdf from there.
    #[inline(always)]
    pub(crate) fn previous<L: Lanes>(&self, l: L, path: U<L>) -> LightSampleContext<L> {
        let [x, y, z, receiver] = l.gather_quads(&self.vertex, path << 2);
        let normal = Vec3::gather(l, &self.normal, path << 2);
        LightSampleContext { position: Vec3::new(x, y, z), normal, receiver: receiver.to_bits() }
    }

    /// Throughput as it were without guiding, over throughput, of some paths.
    #[inline(always)]
    pub(crate) fn unguided<L: Lanes>(&self, l: L, path: U<L>) -> F<L> {
        l.gather(&self.normal, (path << 2) + 3)
    }

    /// Slots, flags, bounce counts and cone growth of some paths.
    #[inline(always)]
    pub(crate) fn track<L: Lanes>(&self, l: L, path: U<L>) -> TrackLanes<L> {
        let [slot, flags, counts, spread] = l.gather_integer_quads(&self.track, path << 2);
        TrackLanes { slot, flags, counts, spread: F::from_bits(spread) }
    }

    /// What media leave of light on the ways of some paths, from behind what they have passed to a distance from their origins; an estimate where they vary,
    /// another one for each sample.
    #[inline(always)]
    pub(crate) fn transmittance<L: Lanes>(
        &self,
        l: L,
        (tables, wavelengths, sample): (&Tables, Option<&SlotWavelengths>, Option<&SampleContext<'_>>),
        path: U<L>,
        to: F<L>,
        chosen: M<L>,
    ) -> Spectrum<L> {
        let (set, from) = (self.media.gather(l, path), self.rays.passed.distance(l, path));
        let media = tables.materials.media.at(match wavelengths {
            Some(wavelengths) => wavelengths.at(l, self.track(l, path).slot),
            None => Wavelengths::rgb(l),
        });
        let left = set.transmittance(media, to - from);
        let (origin, direction) = (gather3(l, &self.rays.origin, path), self.cone(l, path).direction);
        let Some(track) = Track::of(l, media, set, [origin, direction], || self.rays.times(l, path)) else {
            return left;
        };
        // Light paths start anywhere: no two are alike.
        let salt = sample.map_or_else(|| l.u(0), |sample| sample.salt(l, self.track(l, path).slot));
        left * track.transmittance([from, to.min(FAR)], chosen, seed(origin, direction, from, salt))
    }

    /// The slot of a path.
    pub(crate) fn slot(&self, path: usize) -> u32 {
        self.track[4 * path + SLOT]
    }

    /// See [`Self::slot`].
    pub(crate) fn slot_mut(&mut self, path: usize) -> &mut u32 {
        &mut self.track[4 * path + SLOT]
    }

    /// The flags of a path.
    pub(crate) fn flags(&self, path: usize) -> u32 {
        self.track[4 * path + FLAGS]
    }

    /// Moves a path to another place of the columns, over what is there.
    pub(crate) fn copy(&mut self, from: usize, to: usize) {
        self.rays.copy(from, to);
        self.media.copy(from, to);
        self.carried.copy(from, to);
        let items = [&mut self.cone, &mut self.vertex, &mut self.normal];
        items.into_iter().for_each(|items| items.copy_within(4 * from..4 * from + 4, 4 * to));
        self.track.copy_within(4 * from..4 * from + 4, 4 * to);
    }

    /// Sets the times of all rays by their slots.
    pub(crate) fn set_times(&mut self, times: &SlotTimes) {
        let slots = self.track.chunks_exact(4).take(self.count).map(|track| track[SLOT]);
        self.rays.set_times(times.of(slots));
    }

    /// Sets the visibility bits of all rays by their flags.
    pub(crate) fn set_masks(&mut self) {
        for (mask, track) in self.rays.mask[..self.count].iter_mut().zip(self.track.chunks_exact(4)) {
            let flags = track[FLAGS];
            *mask = match flags {
                _ if flags & flag::CAMERA != 0 => ray_mask::CAMERA,
                // What a light sends is seen by what casts shadows.
                _ if flags & flag::FROM_LIGHT != 0 && flags >> flag::BOUNCE_SHIFT == 0 => ray_mask::SHADOW,
                _ => ray_mask::OF_KIND[(flags >> flag::LAST_SHIFT & 3) as usize],
            };
        }
    }
}
