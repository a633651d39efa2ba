//! Light groups (Cycles' light groups): which light belongs to which sums.

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
    /// The group of what each instance set emits.
    pub of_set: Vec<u32>,
}

/// The light groups that a view shows; empty where it shows none.
#[derive(Clone, Debug, Default)]
pub struct GroupPasses {
    /// By light, the number of its group's sums, or [`UNSEEN`].
    pub of_light: Arc<[u32]>,
    /// By instance set, the same.
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
