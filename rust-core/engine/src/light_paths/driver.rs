//! The driver: worker threads take batches by their numbers, and hand what these bring to a collector.

use crate::{
    compile::CompiledScene,
    error::{Error, Result},
    threads::{panic_message, start, workers},
    transport::{BatchFlux, LightTracer, Receiver, Splat, Statistics, Workspace},
};
use std::{
    ops::Range,
    panic::{AssertUnwindSafe, catch_unwind},
    sync::{
        Mutex, PoisonError,
        atomic::{AtomicBool, AtomicU64, Ordering},
        mpsc::{Receiver as Ends, RecvTimeoutError, Sender, channel},
    },
    time::{Duration, Instant},
};

/// How often progress is told.
const TELL_EVERY: Duration = Duration::from_millis(50);

/// What all workers together make of light paths.
pub trait Collector: Sync {
    /// What a worker keeps from batch to batch; it is told what the batch under way brings.
    type Room: Receiver;

    /// Room for one worker.
    fn room(&self) -> Self::Room;

    /// Adds a batch that is complete, and empties the room for the next.
    ///
    /// Workers call it in any order and at the same time: sums must not hang on that. See [`super::FixedSums`].
    fn add(&self, batch: &Batch<'_>, room: &mut Self::Room);

    /// Takes what a worker kept to itself, when its work is done.
    fn join(&self, _: &mut Self::Room) {}
}

/// A batch that is complete.
#[derive(Clone, Copy, Debug)]
pub struct Batch<'a> {
    /// Its number; what it brings depends on that alone.
    pub number: u64,
    /// What its paths started with, and what was cut off.
    pub flux: BatchFlux,
    /// What it brings to the picture.
    pub splats: &'a [Splat],
}

/// What is traced, and on how many threads.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// Whose workspaces are used.
    pub scene: &'a CompiledScene,
    /// Traces the scene's light paths.
    pub tracer: &'a LightTracer<'a>,
    /// Worker threads; 0 means one a core.
    pub threads: u32,
    /// No batch starts behind this time.
    pub deadline: Option<Instant>,
}

/// Who watches, and may end it.
pub struct Watch<'a> {
    /// Ends it; what was under way is lost.
    pub cancel: &'a AtomicBool,
    /// Is told how many of the batches asked for are done, now and then; false ends it.
    pub progress: &'a mut dyn FnMut(u64) -> bool,
}

impl std::fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Watch").field("cancel", self.cancel).finish_non_exhaustive()
    }
}

/// What workers share.
struct Shared<'a, C> {
    job: &'a Job<'a>,
    collector: &'a C,
    batches: Range<u64>,
    next: AtomicU64,
    done: AtomicU64,
    ending: AtomicBool,
    cancel: &'a AtomicBool,
    failure: Mutex<Option<String>>,
    statistics: Mutex<Statistics>,
}

/// Traces batches of light paths. Gives how many of them were traced, the first ones, fewer than asked for where the deadline came first; and
/// counts of rays.
///
/// # Errors
/// [`Error::Cancelled`]; a worker's panic as [`Error::Internal`].
pub fn trace_batches<C: Collector>(job: &Job<'_>, batches: Range<u64>, collector: &C, watch: &mut Watch<'_>) -> Result<(u64, Statistics)> {
    let shared = Shared {
        job,
        collector,
        batches: batches.clone(),
        next: AtomicU64::new(batches.start),
        done: AtomicU64::new(0),
        ending: AtomicBool::new(false),
        cancel: watch.cancel,
        failure: Mutex::new(None),
        statistics: Mutex::default(),
    };
    let threads = (workers(job.threads) as u64).min(batches.end.saturating_sub(batches.start)).max(1);
    std::thread::scope(|scope| {
        let (running, ends) = channel();
        let worker = || {
            let (shared, running) = (&shared, running.clone());
            start(scope, move || work(shared, running))
        };
        let started = (0..threads).map_while(|_| worker()).count();
        if started == 0 {
            work(&shared, running);
        } else {
            drop(running);
        }
        shared.watch(&ends, watch.progress);
    });
    let Shared { done, ending, failure, statistics, .. } = shared;
    if let Some(message) = failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
        return Err(Error::Internal(message));
    }
    if ending.into_inner() || watch.cancel.load(Ordering::Relaxed) {
        return Err(Error::Cancelled);
    }
    Ok((done.into_inner(), statistics.into_inner().unwrap_or_else(PoisonError::into_inner)))
}

impl<C: Collector> Shared<'_, C> {
    /// Tells how far it is until all workers have ended.
    fn watch(&self, ends: &Ends<()>, progress: &mut dyn FnMut(u64) -> bool) {
        // Workers send nothing: they hang up.
        while ends.recv_timeout(TELL_EVERY) == Err(RecvTimeoutError::Timeout) {
            if !progress(self.done.load(Ordering::Relaxed)) {
                self.ending.store(true, Ordering::Relaxed);
            }
        }
    }

    fn is_ending(&self) -> bool {
        self.ending.load(Ordering::Relaxed) || self.cancel.load(Ordering::Relaxed)
    }

    /// The next batch's number. Numbers are taken in order, and what is taken gets done, so that those traced are always the first.
    fn take(&self) -> Option<u64> {
        if self.is_ending() || self.job.deadline.is_some_and(|deadline| Instant::now() >= deadline) {
            return None;
        }
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        (number < self.batches.end).then_some(number)
    }

    fn trace(&self, workspace: &mut Workspace) {
        let mut room = self.collector.room();
        let mut splats = Vec::new();
        while let Some(number) = self.take() {
            splats.clear();
            let flux = self.job.tracer.trace(number, &mut room, &mut splats, workspace, &|| self.is_ending());
            if self.is_ending() {
                return;
            }
            self.collector.add(&Batch { number, flux, splats: &splats }, &mut room);
            self.done.fetch_add(1, Ordering::Relaxed);
        }
        self.collector.join(&mut room);
    }
}

/// Traces batches until none is left; a panic ends all of it. Who waits learns of the end when `_running` is dropped.
fn work<C: Collector>(shared: &Shared<'_, C>, _running: Sender<()>) {
    let result = catch_unwind(AssertUnwindSafe(|| {
        let scene = shared.job.scene;
        let mut workspace = scene.workspaces.take();
        workspace.prepare(&scene.tables, shared.job.tracer.transport, false);
        shared.trace(&mut workspace);
        shared.statistics.lock().unwrap_or_else(PoisonError::into_inner).add(&workspace.statistics);
        // What was cancelled may have left paths on their way.
        if !shared.is_ending() {
            scene.workspaces.leave(workspace);
        }
    }));
    if let Err(panic) = result {
        *shared.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(panic_message(&*panic));
        shared.ending.store(true, Ordering::Relaxed);
    }
}
