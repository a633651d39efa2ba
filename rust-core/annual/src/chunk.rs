//! A chunk of a year's steps at all points.

/// What a chunk of steps brings: `[point][step]` in lx.
#[derive(Debug)]
pub struct Chunk<'a> {
    /// The steps, all of them with light; in those that no chunk names it is dark.
    pub steps: &'a [usize],
    /// Sky and sun, with blinds as they are operated.
    pub total: &'a [f32],
    /// The block of the coefficients that this is without; `None` where it is of all.
    pub without: Option<usize>,
    /// The sun alone, through open blinds; `None` where it is not known.
    pub direct: Option<&'a [f32]>,
    /// The sun alone, with blinds as they are operated; `None` where it is not known.
    pub sun: Option<&'a [f32]>,
    /// By group of windows, in which of the steps its blinds are closed; empty where they never are.
    pub closed: &'a [Vec<bool>],
}
