//! Light straight from given directions, for daylight coefficients of suns at their places.

use crate::schedule::steps;
use crate::schedule::tracer::{Start, Tracer};
use crate::stage::light::measure::{MeasureContext, light_from_directions};
use crate::stage::start::sensors::queue_sensors;
use crate::state::queue::shadow_rays::hits_together;
use crate::state::sample::SampleContext;
use crate::state::workspace::Workspace;
use gonio_camera::sampler::{BATCH, Runs, Sampler};
use gonio_simd::dispatch;
use std::ops::Range;

impl Tracer<'_> {
    /// Lights some sensors, at most as many as a batch has slots, from all of the directions (unit vectors with a number each), as a radiance of 1 does
    /// within a steradian about each: what arrives is noted among the sky's arrivals, in the slots that follow those of pixels. Sensors that look along a direction, and cylinders, are none that it knows.
    pub fn light_from(&self, chosen: Range<usize>, directions: &[([f32; 3], u32)], ws: &mut Workspace) {
        let Start::Sensors(sensors) = self.start else { return };
        let chosen = chosen.start..chosen.end.min(chosen.start + BATCH);
        let sampler = Sampler::new(self.transport.seed, [0; 2], 1);
        let context = SampleContext { sampler, runs: &Runs::whole(0), depth: 0, wavelengths: None };
        ws.deposits.wavelengths = None;
        let together = hits_together(directions.len().max(1));
        dispatch!(self.transport.execution, l => queue_sensors(l, sensors, chosen.clone(), &mut ws.queues.measure));
        for first in (0..ws.queues.measure.count).step_by(together) {
            let range = first..(first + together).min(ws.queues.measure.count);
            if !ws.queues.shadows.has_room(range.len(), directions.len()) {
                steps::trace_shadows(self, &context, ws);
            }
            let (queues, deposits) = (&mut ws.queues, &mut ws.deposits);
            dispatch!(self.transport.execution, l => {
                let chunk =
                    MeasureContext { l, tables: self.tables, transport: &self.transport, sample: &context, points: &queues.measure, range: range.clone() };
                light_from_directions(&chunk, directions, &mut queues.shadows, deposits);
            });
        }
        ws.queues.measure.count = 0;
        steps::trace_shadows(self, &context, ws);
    }
}
