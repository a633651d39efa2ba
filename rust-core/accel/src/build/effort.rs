//! The effort of a build.

/// How much time goes into a binary tree.
#[derive(Clone, Copy)]
pub(crate) struct Effort {
    /// Looks 24 neighbours far rather than 6.
    pub(super) far: bool,
    /// First rounds of the clustering that look at direct neighbours alone.
    pub(super) short_rounds: usize,
    /// Share of the nodes that is tried at other places.
    pub(super) reinsertion: f32,
}

impl Effort {
    /// For what is built often or is large.
    pub(crate) const QUICK: Effort = Effort { far: false, short_rounds: 2, reinsertion: 0.02 };
    /// For what is small and met by many rays.
    pub(crate) const THOROUGH: Effort = Effort { far: true, short_rounds: 1, reinsertion: 0.5 };

    /// For one of many parts, whose upper nodes are put together anew.
    pub(super) fn part(self) -> Self {
        Effort { short_rounds: 1, reinsertion: if self.far { self.reinsertion } else { 0.0 }, ..self }
    }

    /// For the tree over the pieces of parts: reinsertion of all where they are few, of half of more.
    pub(super) fn top(pieces: usize) -> Self {
        Effort { reinsertion: (8192.0 / pieces as f32).clamp(0.5, 1.0), ..Effort::THOROUGH }
    }
}
