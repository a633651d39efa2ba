//! Guides of denoisers: trees of specular rays find what mirrors and smooth glass show. `accumulate/guides.rs` sums it.

use crate::schedule::tracer::Tracer;
use crate::state::workspace::Workspace;
use crate::tables::transport::{Estimator, Limits, Passes, PathFilter, Transport};
use gonio_camera::sampler::Runs;
use std::ops::Range;

/// Makes the random numbers of specular rays differ from those of samples.
const SEED: u32 = 0x5f35_6495;

impl Tracer<'_> {
    /// Adds light and guides of specular paths by camera rays of their own, `rays` for each sample of some zones (see [`Runs::batches`]).
    /// The samples themselves must have been traced with [`PathFilter::ExceptSpecular`].
    pub fn trace_specular(
        &self,
        [min, max]: [[u32; 2]; 2],
        zones: u64,
        samples: Range<u32>,
        rays: u32,
        ws: &mut Workspace,
        cancelled: &dyn Fn() -> bool,
    ) {
        let own = &self.transport;
        let transport = Transport {
            passes: Passes {
                guides: own.passes.guides,
                specular: own.passes.guides,
                groups: own.passes.groups.clone(),
                expressions: own.passes.expressions.clone(),
                ..Passes::default()
            },
            path_filter: PathFilter::SpecularOnly,
            estimator: Estimator::Trees([].into()),
            // Paths see what emits beyond the last bounce.
            limits: Limits { max_bounces: own.limits.max_bounces.saturating_add(1), ..own.limits },
            seed: own.seed ^ SEED,
            samples: own.samples.saturating_mul(rays),
            ..own.clone()
        };
        let tracer = Tracer { tables: self.tables, start: self.start, transport };
        ws.begin_specular();
        for runs in Runs::batches(zones, samples.start * rays..samples.end * rays).take_while(|_| !cancelled()) {
            tracer.trace(min, max, &runs, ws, cancelled);
        }
        ws.end_specular(rays);
    }
}
