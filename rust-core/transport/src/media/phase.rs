//! How the media about a place scatter together: a mixture of their phase functions, weighed by their scattering.
//!
//! Where all of a scene are Henyey and Greenstein's, these are evaluated and inverted as they are; else all are rows of a table.

use crate::media::set::MediaSet;
use crate::tables::media::{Coefficients, MediumTable};
use gonio_bsdf::phase::{henyey_greenstein, sample_henyey_greenstein};
use gonio_simd::{F, Lanes, M, Spectrum, U, Vec3};

/// One of the media.
#[derive(Clone, Copy, Debug)]
struct Part<L: Lanes> {
    scattering: Spectrum<L>,
    /// Mean cosine where the table has Henyey and Greenstein's functions alone, and the row of the phase function elsewhere.
    anisotropy: F<L>,
    phase: U<L>,
}

/// The phase functions of up to four media.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PhaseMix<L: Lanes> {
    parts: [Option<Part<L>>; 4],
    /// Scattering a metre of all together.
    pub(crate) scattering: Spectrum<L>,
}

/// A direction that was drawn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PhaseSample<L: Lanes> {
    pub(crate) direction: Vec3<L>,
    /// Per solid angle.
    pub(crate) pdf: F<L>,
    /// Value over density.
    pub(crate) factor: Spectrum<L>,
}

impl<L: Lanes> PhaseMix<L> {
    /// That of the even media which rays are in.
    #[inline(always)]
    pub(crate) fn of(l: L, set: MediaSet<L>, media: Coefficients<'_, L>) -> Self {
        let mut even = [l.f(1.0); 4];
        if media.table.varies() {
            for (even, row) in even.iter_mut().zip(set.rows()) {
                if let Some(row) = row {
                    *even = even.keep_if(media.table.field(l, row).eq(0));
                }
            }
        }
        Self::at(l, set, media, even)
    }

    /// That of a place where the media have these densities, by their order.
    #[inline(always)]
    pub(crate) fn at(l: L, set: MediaSet<L>, media: Coefficients<'_, L>, densities: [F<L>; 4]) -> Self {
        let mut scattering = Spectrum::zero(l);
        let mut parts = [None; 4];
        let (table, varied) = (media.table, media.table.phases.is_varied());
        for ((part, row), density) in parts.iter_mut().zip(set.rows()).zip(densities) {
            if let Some(row) = row {
                let own = media.scattering(l, row) * density;
                scattering += own;
                let phase = if varied { table.phase(l, row) } else { l.u(0) };
                *part = Some(Part { scattering: own, anisotropy: table.anisotropy(l, row), phase });
            }
        }
        Self { parts, scattering }
    }

    /// Another one in some lanes.
    #[inline(always)]
    pub(crate) fn or(&self, other: Self, chosen: M<L>) -> Self {
        let mut parts = [None; 4];
        for ((part, own), new) in parts.iter_mut().zip(self.parts).zip(other.parts) {
            if let (Some(own), Some(new)) = (own, new) {
                *part = Some(Part { scattering: chosen.select(new.scattering, own.scattering), ..own });
            }
        }
        Self { parts, scattering: chosen.select(other.scattering, self.scattering) }
    }

    /// Value and density of light that went along a direction and goes along another.
    #[inline(always)]
    pub(crate) fn eval(&self, table: &MediumTable, from: Vec3<L>, to: Vec3<L>) -> (Spectrum<L>, F<L>) {
        let l = from.x.lanes();
        let (mut sum, mut density) = (Spectrum::zero(l), l.f(0.0));
        let (varied, cos) = (table.phases.is_varied(), from.dot(to));
        for part in self.parts.iter().flatten() {
            let phase = if varied { table.phases.value(l, part.phase, from, to) } else { henyey_greenstein(part.anisotropy, cos) };
            sum += part.scattering * phase;
            density = part.scattering.mean().mul_add(phase, density);
        }
        let safe = self.scattering.max(f32::MIN_POSITIVE);
        (sum / safe, density / safe.mean())
    }

    /// Draws a direction for light that goes along another: `u[0]` chooses the medium.
    #[inline(always)]
    pub(crate) fn sample(&self, table: &MediumTable, along: Vec3<L>, u: [F<L>; 3]) -> PhaseSample<L> {
        let l = u[0].lanes();
        let mut point = u[0] * self.scattering.mean();
        let (mut anisotropy, mut phase, mut passed) = (l.f(0.0), l.u(0), l.m(false));
        for part in self.parts.iter().flatten() {
            let share = part.scattering.mean();
            let here = point.lt(share).and_not(passed);
            anisotropy = here.select(part.anisotropy, anisotropy);
            phase = here.select(part.phase, phase);
            passed |= here;
            point -= share;
        }
        if table.phases.is_varied() {
            // What is drawn comes a little more or less often than the density says, by which samples of lights weigh theirs too.
            let (direction, factor) = table.phases.sample(l, phase, along, [u[1], u[2]]);
            let (value, pdf) = self.eval(table, along, direction);
            return PhaseSample { direction, pdf, factor: value * (factor / pdf.max(f32::MIN_POSITIVE)) };
        }
        let direction = sample_henyey_greenstein(anisotropy, along, [u[1], u[2]]);
        let (value, pdf) = self.eval(table, along, direction);
        PhaseSample { direction, pdf, factor: value * pdf.max(f32::MIN_POSITIVE).recip() }
    }
}
