//! Light by light path expressions: each contribution goes to those that ask for its path.

use crate::accumulate::deposit::{Contribution, Deposits, Source};
use crate::accumulate::light_sums::LightSums;
use crate::tables::expressions::{PathExpressions, scattering};
use crate::tables::transport::Passes;
use crate::words::{code, flag};
use gonio_camera::sampler::BATCH;
use gonio_simd::{Lanes, M, Rgb, U};

/// With the code of light that a path finds, the path's state; where nobody follows it, the code alone.
#[inline(always)]
pub(crate) fn with_state<L: Lanes>(passes: &Passes, code: U<L>, flags: U<L>) -> U<L> {
    if passes.states_are_followed() { code | (PathExpressions::state(flags) << code::STATE_SHIFT) } else { code }
}

/// The same with the code of a light sample, of which the last scattering is still to be told: `through` says where light comes from behind.
#[inline(always)]
pub(crate) fn with_sample<L: Lanes>(passes: &Passes, code: U<L>, flags: U<L>, through: M<L>) -> U<L> {
    let code = with_state(passes, code, flags);
    match passes.expressions {
        Some(_) => code | through.select(flags.lanes().u(code::SAMPLED | code::THROUGH), flags.lanes().u(code::SAMPLED)),
        None => code,
    }
}

/// Which scattering a path samples.
#[inline(always)]
pub(crate) fn scattering_of<L: Lanes>(l: L, [diffuse, delta, through]: [M<L>; 3]) -> U<L> {
    let mode = diffuse.select(l.u(scattering::DIFFUSE), delta.select(l.u(scattering::SHARP), l.u(scattering::GLOSSY)));
    mode + through.select(l.u(scattering::THROUGH), l.u(0))
}

impl Deposits {
    /// Adds light to the sums of the expressions that ask for it.
    #[inline(always)]
    pub(crate) fn deposit_to_expressions<L: Lanes>(&mut self, expressions: &PathExpressions, light: &Contribution<L>, chosen: M<L>) {
        let chosen = chosen & light.slot.lt(BATCH as u32);
        if !chosen.any() {
            return;
        }
        let l = light.slot.lanes();
        let kind = match (light.source, expressions.infinite) {
            (Source::Light(number), _) => l.gather_integers(&expressions.of_light, number.keep_if(chosen)),
            (Source::Set(set), _) => l.gather_integers(&expressions.of_set, set.keep_if(chosen)),
            (Source::Several, Some(infinite)) => l.u(infinite),
            // They are added one by one.
            (Source::Several, None) => return,
        };
        let state = (light.code >> code::STATE_SHIFT) & flag::STATES;
        let sampled = chosen & (light.code & code::SAMPLED).ne(0);
        let found = expressions.accepted(state, kind, chosen.and_not(sampled));
        let colour = self.to_film(light.slot, light.value);
        add(&mut self.sums.expressions, found, light.slot, colour);
        let Some([diffuse, glossy]) = light.shares else { return };
        if !sampled.any() {
            return;
        }
        let (diffuse, glossy) = (light.value * diffuse, light.value * glossy);
        let through = (light.code & code::THROUGH).ne(0).select(l.u(scattering::THROUGH), l.u(0));
        let parts = [
            (diffuse, through + scattering::DIFFUSE),
            (glossy, l.u(scattering::GLOSSY)),
            ((light.value - diffuse - glossy).part_of(light.value), l.u(scattering::THROUGH + scattering::GLOSSY)),
        ];
        for (part, scattering) in parts {
            let asked = expressions.accepted(expressions.after(state, scattering), kind, sampled & part.is_lit());
            let colour = self.to_film(light.slot, part);
            add(&mut self.sums.expressions, asked, light.slot, colour);
        }
    }
}

/// Adds to the sums of each lane's bits.
#[inline(always)]
fn add<L: Lanes>(sums: &mut LightSums, asked: U<L>, slot: U<L>, value: Rgb<L>) {
    if asked.ne(0).any() {
        sums.add_to_many(asked, slot, value);
    }
}
