//! A measurement under way: batches of all incident patches, until they are exact enough.

use super::{
    Options, SampleReading, Side, Stop, Window,
    incident::{Incident, add_batch},
    place::Place,
    reading::FromPatch,
    tally::{InOrder, Sum, Tally},
};
use crate::{
    compile::CompiledScene,
    error::Result,
    goniometer::{Frame, Value},
    light_paths::{Channels, Estimate, Job, Progress, Watch, trace_batches},
    threads::in_pool,
    transport::{Arriving, Emission, LIGHT_BATCH, LightTracer, RayTable, Statistics, Transport, Wanted},
};
use rayon::prelude::*;
use std::{sync::atomic::AtomicBool, time::Instant};

/// A measurement under way.
pub(super) struct Run<'a> {
    options: &'a Options,
    place: &'a Place,
    tally: &'a Tally<'a>,
    incident: &'a [Incident],
    /// Batches of each incident patch.
    batches: Vec<u64>,
    /// The next batch's number is this one or greater.
    number: u64,
    start: Instant,
    statistics: Statistics,
    converged: bool,
}

impl<'a> Run<'a> {
    pub(super) fn new(options: &'a Options, place: &'a Place, tally: &'a Tally<'a>, incident: &'a [Incident], start: Instant) -> Self {
        let batches = vec![0; incident.len()];
        Self { options, place, tally, incident, batches, number: 0, start, statistics: Statistics::default(), converged: false }
    }

    /// Traces until the rule says that it is enough for every patch; those that have enough are left alone.
    pub(super) fn trace(
        &mut self,
        scene: &CompiledScene,
        transport: &Transport,
        cancel: &AtomicBool,
        progress: &mut dyn FnMut(&Progress) -> bool,
    ) -> Result<()> {
        let stop = &self.options.stop;
        let deadline = stop.time.and_then(|time| self.start.checked_add(time));
        let mut open: Vec<usize> = (0..self.incident.len()).collect();
        let (mut done, mut error) = (0, None);
        while !open.is_empty() && done < stop.batches() {
            let next = stop.next(done);
            for batch in done..next {
                let (before, most) = (self.paths(), stop.batches() * self.incident.len() as u64 * LIGHT_BATCH as u64);
                let start = self.start;
                let mut tell = |more: u64| {
                    let paths = before + more * LIGHT_BATCH as u64;
                    progress(&Progress { paths, most, error, elapsed: start.elapsed() })
                };
                // Without the first two batches nothing would be known.
                let deadline = deadline.filter(|_| batch >= 2);
                let traced = self.trace_one(scene, transport, &open, batch, deadline, &mut Watch { cancel, progress: &mut tell })?;
                if traced < open.len() {
                    return Ok(());
                }
            }
            done = next;
            let errors = open.iter().map(|incident| self.error(*incident));
            error = Some(errors.fold(0.0, f64::max));
            open.retain(|incident| stop.error == 0.0 || self.error(*incident) > stop.error);
        }
        self.converged = open.is_empty();
        Ok(())
    }

    /// Traces a batch of each of some incident patches; gives how many of them it came to.
    fn trace_one(
        &mut self,
        scene: &CompiledScene,
        transport: &Transport,
        order: &[usize],
        batch: u64,
        deadline: Option<Instant>,
        watch: &mut Watch<'_>,
    ) -> Result<usize> {
        let table = self.table(order, batch);
        let wanted = Wanted { arrivals: Arriving::No, specular_only: false, picture: None };
        let tracer = LightTracer { tables: &scene.tables, transport, emission: Emission::Rays(&table), wanted };
        let job = Job { scene, tracer: &tracer, threads: self.options.threads, deadline };
        // Numbers tell which rays of the table a batch takes: the first one is a multiple of the table's batches.
        let count = order.len() as u64;
        let first = self.number.next_multiple_of(count);
        self.number = first + count;
        let (traced, statistics) = trace_batches(&job, first..first + count, &InOrder { tally: self.tally, order }, watch)?;
        self.statistics.add(&statistics);
        order.iter().take(traced as usize).for_each(|incident| self.batches[*incident] += 1);
        Ok(traced as usize)
    }

    /// The rays of a batch of each of some incident patches, in their order.
    fn table(&self, order: &[usize], batch: u64) -> RayTable {
        let one = |incident: &usize| {
            let mut table = RayTable::default();
            add_batch(&mut table, self.place, &self.options.basis, self.incident[*incident], batch, self.options.seed);
            table
        };
        let parts: Vec<RayTable> = in_pool(|| order.par_iter().map(one).collect());
        let joined = |column: fn(&RayTable) -> &[Vec<f32>; 3]| {
            [0, 1, 2].map(|k| parts.iter().flat_map(|part| &column(part)[k]).copied().collect::<Vec<f32>>())
        };
        RayTable { origin: joined(|table| &table.origin), direction: joined(|table| &table.direction), flux: joined(|table| &table.flux) }
    }

    fn paths(&self) -> u64 {
        self.batches.iter().sum::<u64>() * LIGHT_BATCH as u64
    }

    fn share(&self, incident: usize, to_front: bool, patch: usize) -> Estimate {
        self.tally.share(incident, to_front, patch, self.batches[incident])
    }

    fn error(&self, incident: usize) -> f64 {
        let patches = self.options.basis.count();
        Stop::error_of((0..2 * patches).map(|cell| {
            let share = self.share(incident, cell < patches, cell % patches);
            [share.luminance(), share.variance]
        }))
    }

    pub(super) fn reading(&self, frame: Frame, window: Window) -> SampleReading {
        let patches = self.options.basis.count();
        SampleReading {
            basis: self.options.basis.clone(),
            colour: self.options.colour,
            frame,
            window,
            body: SampleReading::body(self.place),
            sides: (0..self.incident.len()).step_by(patches).map(|first| self.side(first..first + patches)).collect(),
            paths: self.paths(),
            elapsed: self.start.elapsed(),
            converged: self.converged,
            statistics: self.statistics,
            diagnostics: Vec::new(),
        }
    }

    fn side(&self, range: std::ops::Range<usize>) -> Side {
        let from_front = self.incident[range.start].from_front;
        let all = |to_front: bool| -> (Vec<Channels>, Vec<f64>) {
            let patches = 0..self.options.basis.count();
            let shares = range.clone().flat_map(|incident| patches.clone().map(move |patch| self.share(incident, to_front, patch)));
            shares.map(|share| (share.mean, share.error())).unzip()
        };
        let ((reflected, reflected_errors), (transmitted, transmitted_errors)) = (all(from_front), all(!from_front));
        let from = range.map(|incident| self.found(incident)).collect();
        Side { from_front, from, reflected, transmitted, reflected_errors, transmitted_errors }
    }

    fn found(&self, incident: usize) -> FromPatch {
        let sum = |sum: Sum| {
            let found = self.tally.sum(incident, sum, self.batches[incident]);
            Value { value: found.luminance(), error: found.error() }
        };
        let [reflected, transmitted] =
            if self.incident[incident].from_front { [Sum::Front, Sum::Back] } else { [Sum::Back, Sum::Front] }.map(sum);
        FromPatch {
            reflected,
            transmitted,
            lost: sum(Sum::Lost),
            cut_off: sum(Sum::CutOff),
            absorbed: sum(Sum::Absorbed),
            rays: self.batches[incident] * LIGHT_BATCH as u64,
            error: self.error(incident),
        }
    }
}
