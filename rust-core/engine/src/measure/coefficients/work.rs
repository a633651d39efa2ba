//! Work that threads share, and who watches it.

use super::Tracing;
use crate::{
    error::{Error, Result},
    measure::watch::Watch,
    render::Progress,
    threads::{panic_message, start, workers},
    transport::Workspace,
};
use std::{
    any::Any,
    sync::atomic::{AtomicBool, AtomicU64, AtomicUsize, Ordering},
    time::{Duration, Instant},
};

/// How often progress is told.
const TELL_EVERY: Duration = Duration::from_millis(50);

/// How far workers are, and whether they are to stop.
pub(super) struct Work {
    pub(super) done: AtomicU64,
    pub(super) rays: AtomicU64,
    cancel: AtomicBool,
}

impl Work {
    pub(super) fn new() -> Self {
        Self { done: AtomicU64::new(0), rays: AtomicU64::new(0), cancel: AtomicBool::new(false) }
    }

    /// Does so many pieces of work on threads of their own, each with a workspace, in any order.
    pub(super) fn share_out(&self, tracing: &Tracing<'_>, pieces: usize, piece: impl Fn(usize, &mut Workspace) + Sync) -> Result<()> {
        let next = AtomicUsize::new(0);
        let run = || {
            let mut workspace = tracing.scene.workspaces.take();
            while let Some(number) = Some(next.fetch_add(1, Ordering::Relaxed)).filter(|number| *number < pieces && !self.is_cancelled()) {
                piece(number, &mut workspace);
            }
            workspace.deposits.sky = None;
            if !self.is_cancelled() {
                tracing.scene.workspaces.leave(workspace);
            }
        };
        std::thread::scope(|scope| {
            let helpers: Vec<_> = (1..workers(tracing.settings.threads)).map_while(|_| start(scope, run)).collect();
            run();
            helpers.into_iter().try_for_each(|helper| helper.join().map_err(failed))
        })?;
        if self.is_cancelled() { Err(Error::Cancelled) } else { Ok(()) }
    }

    pub(super) fn is_cancelled(&self) -> bool {
        self.cancel.load(Ordering::Relaxed)
    }

    /// Does something on other threads while this one tells how far it is.
    pub(super) fn watched<T: Send>(
        &self,
        total: u64,
        samples: u32,
        watch: &mut Watch<'_>,
        work: impl FnOnce() -> Result<T> + Send,
    ) -> Result<T> {
        let start = Instant::now();
        std::thread::scope(|scope| {
            let working = scope.spawn(work);
            while !working.is_finished() {
                std::thread::sleep(TELL_EVERY.min(start.elapsed() / 4 + Duration::from_millis(1)));
                let fraction = self.done.load(Ordering::Relaxed) as f64 / total.max(1) as f64;
                let elapsed = start.elapsed();
                let remaining = (fraction > 0.0).then(|| elapsed.mul_f64((1.0 - fraction).max(0.0) / fraction));
                let done = (fraction * f64::from(samples)) as u32;
                let rays = self.rays.load(Ordering::Relaxed);
                let progress = Progress { fraction, samples: done, samples_total: samples, elapsed, remaining, rays };
                if watch.cancel.load(Ordering::Relaxed) || !(watch.progress)(&progress) {
                    self.cancel.store(true, Ordering::Relaxed);
                }
            }
            working.join().unwrap_or_else(|panic| Err(failed(panic)))
        })
    }
}

fn failed(panic: Box<dyn Any + Send>) -> Error {
    Error::Internal(panic_message(&*panic))
}
