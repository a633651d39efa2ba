//! The openings that shadow rays go through.

use crate::state::queue::shadow_rays::ShadowRays;
use crate::state::queue::shadow_trace::ShadowTrace;
use crate::tables::openings::Openings;
use crate::words::{code, flag};

/// Notes with the light of each ray the group of the first opening on its way, where its path has come through none before.
pub(crate) fn note_openings(openings: &Openings, trace: &ShadowTrace, shadows: &mut ShadowRays) {
    let mut passed: Vec<_> = trace.passed.iter().filter(|hit| openings.group(hit.instance) != 0).collect();
    passed.sort_unstable_by(|a, b| a.ray.cmp(&b.ray).then(a.t.total_cmp(&b.t)).then(a.instance.cmp(&b.instance)));
    passed.dedup_by_key(|hit| hit.ray);
    for hit in passed {
        let code = &mut shadows.code[hit.ray as usize];
        if *code & (flag::STATES << code::STATE_SHIFT) == 0 {
            *code |= openings.group(hit.instance) << code::STATE_SHIFT;
        }
    }
}
