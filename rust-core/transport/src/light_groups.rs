//! Light groups: radiance by the group of the light that it comes from.

use super::{light_sums::LightSums, shade::Stage, workspace::Workspace};
use gonio_simd::{Lanes, M, Rgb, U};
use std::sync::Arc;

/// A group that no pass shows.
pub const UNSEEN: u32 = u32::MAX;

/// The light groups of a scene, by number.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct LightGroups {
    /// Their names.
    pub names: Vec<String>,
    /// The group of each light.
    pub of_light: Vec<u32>,
    /// The group of what each set of instances emits.
    pub of_set: Vec<u32>,
}

/// The light groups that a view shows; empty where it shows none.
#[derive(Clone, Debug, Default)]
pub struct GroupPasses {
    /// By light, the number of its group's sums, or [`UNSEEN`].
    pub of_light: Arc<[u32]>,
    /// By set of instances, the same.
    pub of_set: Arc<[u32]>,
    /// Sums there are.
    pub count: usize,
}

impl GroupPasses {
    /// Whether any group is shown.
    #[inline(always)]
    pub fn wanted(&self) -> bool {
        self.count > 0
    }
}

/// Adds light of sampled or met lights to the sums of their groups.
#[inline(always)]
pub(super) fn add_of_lights<L: Lanes>(
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
pub(super) fn add_of_surfaces<L: Lanes>(stage: &Stage<'_, L>, at: usize, slot: U<L>, value: Rgb<L>, chosen: M<L>, ws: &mut Workspace) {
    let Stage { l, tables, transport, .. } = *stage;
    let passes = &transport.passes.groups;
    if passes.wanted() && chosen.any() {
        let set = tables.geometry.set_lanes(l, l.load_integers(&ws.surface.instance, at).keep_if(chosen));
        let group = l.gather_integers(&passes.of_set, set);
        ws.first_hit.groups.add(group, slot, value, chosen & group.ne(UNSEEN));
    }
}
