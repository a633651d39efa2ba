//! Light groups: radiance by the group of the light that it comes from.

use crate::accumulate::light_sums::LightSums;
use crate::state::vertex::Stage;
use crate::state::workspace::Workspace;
use crate::tables::light_groups::{GroupPasses, UNSEEN};
use gonio_simd::{Lanes, M, Rgb, U};

/// Adds light of lights that were sampled (NEE) or hit to the sums of their groups.
#[inline(always)]
pub(crate) fn add_of_lights<L: Lanes>(
    l: L,
    passes: &GroupPasses,
    light: U<L>,
    slot: U<L>,
    value: Rgb<L>,
    chosen: M<L>,
    sums: &mut LightSums,
) {
    if passes.wanted() && chosen.any() {
        let group = l.gather_integers(&passes.of_light, light.keep_if(chosen));
        sums.add(group, slot, value, chosen & group.ne(UNSEEN));
    }
}

/// Adds what the surfaces at `at` of the chunk emit to the sums of their groups.
#[inline(always)]
pub(crate) fn add_of_surfaces<L: Lanes>(stage: &Stage<'_, L>, at: usize, slot: U<L>, value: Rgb<L>, chosen: M<L>, ws: &mut Workspace) {
    let Stage { l, tables, transport, .. } = *stage;
    let passes = &transport.passes.groups;
    if passes.wanted() && chosen.any() {
        let set = tables.geometry.set_lanes(l, l.load_integers(&ws.surface.instance, at).keep_if(chosen));
        let group = l.gather_integers(&passes.of_set, set);
        ws.sums.groups.add(group, slot, value, chosen & group.ne(UNSEEN));
    }
}
