//! A register of ways through media: from where rays start, or went straight on last, to what they hit.

use super::context::MediumContext;
use crate::media::phase::PhaseMix;
use crate::media::set::FAR;
use crate::media::track::Track;
use crate::state::columns::load3;
use crate::state::path_core::PathCore;
use crate::state::paths::Paths;
use crate::tables::transport::Limits;
use crate::words::flag;
use gonio_accel::{Hits, NONE};
use gonio_simd::{F, Lanes, M, Spectrum, U, Vec3};

/// The least albedo that distances are drawn by.
const LEAST_ALBEDO: f32 = 0.1;

/// Where some paths go, and through what.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way<L: Lanes> {
    /// The number of the register's first path.
    pub(super) at: usize,
    pub(super) origin: Vec3<L>,
    pub(super) direction: Vec3<L>,
    /// Metres from the origin at which it begins, and how many it is long.
    pub(super) from: F<L>,
    pub(super) length: F<L>,
    /// What the paths carry where it begins, and the density of their directions.
    pub(super) core: PathCore<L>,
    pub(super) pdf: F<L>,
    /// A metre.
    pub(super) extinction: Spectrum<L>,
    pub(super) phase: PhaseMix<L>,
    /// Ways through anything, those through what scatters, and among them those through even media that do.
    pub(super) alive: M<L>,
    pub(super) scatters: M<L>,
    pub(super) scatters_evenly: M<L>,
    /// Those that end at a surface.
    pub(super) met: M<L>,
}

impl<L: Lanes> Way<L> {
    /// Those of a register of paths; `None` where all go through the open or through solids that do not scatter.
    #[inline(always)]
    pub(super) fn load(l: L, context: &MediumContext<'_>, paths: &Paths, hits: &Hits, at: usize) -> Option<Self> {
        let set = paths.media.load(l, at);
        let present = l.first(paths.count - at) & set.is_filled();
        if !present.any() {
            return None;
        }
        let path = l.iota() + at as u32;
        let (core, pdf) = paths.core(l, path);
        let cone = paths.cone(l, path);
        let from = paths.rays.passed.distance(l, path);
        let met = l.load_integers_to_end(&hits.instance, at).ne(NONE);
        let end = met.select(l.load_to_end(&hits.t, at), l.f(FAR));
        let media = context.media(l, core.slot);
        let phase = PhaseMix::of(l, set, media);
        let core = PathCore { width: cone.width, media: set, unguided: paths.unguided(l, path), ..core };
        let lit = present & core.throughput.is_lit();
        let scatters_evenly = lit & phase.scattering.is_lit();
        Some(Self {
            at,
            origin: load3(l, &paths.rays.origin, at),
            direction: cone.direction,
            from,
            length: (end - from).clamp(0.0, FAR),
            core,
            pdf,
            extinction: set.extinction(media),
            phase,
            alive: present,
            scatters: scatters_evenly | (lit & set.varies(media.table)),
            scatters_evenly,
            met,
        })
    }

    /// The media along it that vary; the paths are those that it was loaded from.
    #[inline(always)]
    pub(super) fn track<'a>(&self, context: &MediumContext<'a>, paths: &Paths) -> Option<Track<'a, L>> {
        let l = self.pdf.lanes();
        Track::of(l, context.media(l, self.core.slot), self.core.media, [self.origin, self.direction], || {
            paths.rays.times(l, l.iota() + self.at as u32)
        })
    }

    /// What even media leave of light after so many metres of it.
    #[inline(always)]
    pub(super) fn transmittance(&self, distance: F<L>) -> Spectrum<L> {
        (self.extinction * -distance).exp()
    }

    /// The place after so many metres of it.
    #[inline(always)]
    pub(super) fn place(&self, distance: F<L>) -> Vec3<L> {
        self.direction.mul_add(self.from + distance, self.origin)
    }

    /// Scatterings before it.
    #[inline(always)]
    pub(super) fn bounces(&self) -> U<L> {
        self.core.flags >> flag::BOUNCE_SHIFT
    }

    /// The paths that may scatter once more.
    #[inline(always)]
    pub(super) fn going_on(&self, limits: &Limits) -> M<L> {
        let bounces = self.bounces();
        self.scatters & bounces.lt(limits.max_bounces + 1) & limits.allow(self.core.counts, bounces)
    }

    /// Probabilities of the components of light to draw distances by: their share in what scattering would leave. Those that are absorbed alone have some
    /// as well: they come through where the others hardly do.
    #[inline(always)]
    pub(super) fn channels(&self) -> Spectrum<L> {
        (self.core.throughput.abs() * (self.phase.scattering / self.extinction.max(f32::MIN_POSITIVE)).max(LEAST_ALBEDO)).shares()
    }
}
