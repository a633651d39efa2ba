//! The deposit: the one way by which light enters the sums of a block (radiance, light passes, light groups, light on specular paths).

use crate::accumulate::add::add_rgb;
use crate::accumulate::guiding_notes::GuidingNotes;
use crate::accumulate::sky_arrivals::SkyArrivals;
use crate::accumulate::tile_sums::TileSums;
use crate::state::wavelengths::{SlotWavelengths, at_slots};
use crate::tables::light_groups::{GroupPasses, UNSEEN};
use crate::tables::transport::{PathFilter, Transport};
use crate::words::{code, flag};
use gonio_light::Arrival;
use gonio_simd::{Lanes, M, Rgb, Spectrum, U};
use std::sync::Arc;

/// What stages add to: the sums of the block, and what the light cache learns from.
#[derive(Debug, Default)]
pub struct Deposits {
    /// Sums of the sample block under way.
    pub sums: TileSums,
    /// Lights that arrived and where, for the learned light cache; `None` where nothing learns.
    pub arrivals: Option<Vec<Arrival>>,
    /// Light that paths found, for the guiding field; `None` where nothing learns.
    pub guiding: Option<GuidingNotes>,
    /// Light of the sky by direction, for daylight coefficients; `None` where nobody asks for it.
    pub sky: Option<SkyArrivals>,
    /// Wavelengths of the slots' paths, where light has any.
    pub(crate) wavelengths: Option<Arc<SlotWavelengths>>,
}

/// One register of light that paths found or sampled, clamped; what measured points are sent at once is not.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contribution<L: Lanes> {
    /// Where it goes: a pixel's slot, a measured point's, or a half's at shadow catchers.
    pub(crate) slot: U<L>,
    pub(crate) value: Spectrum<L>,
    /// The light pass, see [`code`]; where expressions are followed, with the state of the path.
    pub(crate) code: U<L>,
    /// Where light passes are wanted, the diffuse and the glossy share of what first surfaces scatter; the rest is transmitted.
    pub(crate) shares: Option<[Spectrum<L>; 2]>,
    /// Whether it came by mirrors and smooth glass alone.
    pub(crate) specular: M<L>,
    pub(crate) source: Source<L>,
}

/// What sent the light, for light groups.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Source<L: Lanes> {
    /// A light by its number.
    Light(U<L>),
    /// A surface that emits, by its instance set.
    Set(U<L>),
    /// Several lights, whose groups are told apart by [`Deposits::deposit_to_group`].
    Several,
}

impl<L: Lanes> Contribution<L> {
    /// Light of a light sample: never on a specular path, as those end in no sample.
    #[inline(always)]
    pub(crate) fn sampled(light: U<L>, slot: U<L>, value: Spectrum<L>, code: U<L>, shares: Option<[Spectrum<L>; 2]>) -> Self {
        Self { slot, value, code, shares, specular: slot.lanes().m(false), source: Source::Light(light) }
    }
}

impl Deposits {
    /// Adds the chosen lanes' light; returns those that count under the path filter.
    #[inline(always)]
    pub(crate) fn deposit<L: Lanes>(&mut self, transport: &Transport, light: &Contribution<L>, chosen: M<L>) -> M<L> {
        let counted = self.filter(transport, light, chosen);
        if let Some(notes) = &mut self.guiding {
            notes.found(light.slot, light.value, counted);
        }
        let colour = self.to_film(light.slot, light.value);
        add_rgb(&mut self.sums.radiance, light.slot, colour, counted);
        if self.sums.lights.wanted() {
            self.deposit_to_passes(light, counted);
        }
        if let Some(expressions) = &transport.passes.expressions {
            self.deposit_to_expressions(expressions, light, counted);
        }
        self.deposit_to_group(&transport.passes.groups, light, counted);
        counted
    }

    /// Keeps the light on specular paths apart, where that is wanted, and applies the path filter.
    #[inline(always)]
    fn filter<L: Lanes>(&mut self, transport: &Transport, light: &Contribution<L>, chosen: M<L>) -> M<L> {
        if !transport.passes.guides {
            return chosen;
        }
        let specular = chosen & light.specular;
        if transport.passes.specular {
            let colour = self.to_film(light.slot, light.value);
            add_rgb(&mut self.sums.specular, light.slot, colour, specular);
        }
        match transport.path_filter {
            PathFilter::All => chosen,
            PathFilter::SpecularOnly => specular,
            PathFilter::ExceptSpecular => chosen.and_not(specular),
        }
    }

    #[inline(always)]
    fn deposit_to_passes<L: Lanes>(&mut self, light: &Contribution<L>, chosen: M<L>) {
        let Contribution { slot, value, .. } = *light;
        let code = light.code & code::CODES;
        let at_first = code.eq(code::SHARED);
        let colour = self.to_film(slot, value);
        self.sums.lights.add(code, slot, colour, chosen.and_not(at_first));
        let Some([diffuse, glossy]) = light.shares else { return };
        let (diffuse, glossy) = (value * diffuse, value * glossy);
        let transmitted = (value - diffuse - glossy).part_of(value);
        for (kind, part) in [diffuse, glossy, transmitted].into_iter().enumerate() {
            let colour = self.to_film(slot, part);
            self.sums.lights.add(slot.lanes().u(kind as u32), slot, colour, chosen & at_first & part.is_lit());
        }
    }

    /// Whether light samples are to say what which kind of scattering sends of them.
    #[inline(always)]
    pub(crate) fn wants_shares(&self, transport: &Transport) -> bool {
        self.sums.lights.wanted() || transport.passes.expressions.is_some()
    }

    /// Adds light to the sums of its source's group.
    #[inline(always)]
    pub(crate) fn deposit_to_group<L: Lanes>(&mut self, passes: &GroupPasses, light: &Contribution<L>, chosen: M<L>) {
        if !passes.wanted() || !chosen.any() {
            return;
        }
        let l = light.slot.lanes();
        let group = match light.source {
            Source::Light(number) => l.gather_integers(&passes.of_light, number.keep_if(chosen)),
            Source::Set(set) => l.gather_integers(&passes.of_set, set.keep_if(chosen)),
            Source::Several => return,
        };
        let colour = self.to_film(light.slot, light.value);
        self.sums.groups.add(group, light.slot, colour, chosen & group.ne(UNSEEN));
    }

    /// Door for light: light of some slots' paths that arrived as colour of the film; see ARCHITECTURE.md.
    #[inline(always)]
    pub(crate) fn to_film<L: Lanes>(&self, slot: U<L>, light: Spectrum<L>) -> Rgb<L> {
        at_slots(slot.lanes(), self.wavelengths.as_deref(), slot).to_rgb(light)
    }
}

/// The light pass of light that a path finds: `seen` if the camera sees it, direct after one scattering, indirect after more.
#[inline(always)]
pub(crate) fn code_of_found<L: Lanes>(flags: U<L>, seen: u32) -> U<L> {
    let bounces = flags >> flag::BOUNCE_SHIFT;
    let first = (flags >> flag::FIRST_SHIFT) & 3;
    let scattered = bounces.eq(1).select(first, first + code::INDIRECT);
    bounces.eq(0).select(first.lanes().u(seen), scattered)
}

/// The light pass of light from next event estimation (NEE).
#[inline(always)]
pub(crate) fn code_of_sampled<L: Lanes>(flags: U<L>) -> U<L> {
    let first = (flags >> flag::FIRST_SHIFT) & 3;
    (flags >> flag::BOUNCE_SHIFT).eq(0).select(first.lanes().u(code::SHARED), first + code::INDIRECT)
}
