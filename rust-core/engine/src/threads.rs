//! How much work is done at once, where, and what is left of a worker that failed.

use crate::memory::free_memory;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::{
    any::Any,
    mem::forget,
    process,
    sync::{Arc, Mutex, TryLockError},
    thread::{Builder, Scope, ScopedJoinHandle, sleep},
    time::Duration,
};

/// The threads over which loops are spread, and the process that they belong to.
static POOL: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// How often, and how many times, the pool is asked for while another thread has it: a process that was split off meanwhile would wait for ever.
const ASK_AGAIN: Duration = Duration::from_millis(1);
const MOST_ASKED: u32 = 1000;

/// Memory of a worker: its batch, its sums, and the stack and heap that the system reserves for a thread.
const WORKER_BYTES: u64 = 80 << 20;

/// Threads that the machine runs at once.
pub fn available_threads() -> usize {
    std::thread::available_parallelism().map_or(1, std::num::NonZero::get)
}

/// Workers for a number of threads that was asked for, 0 for all that the machine runs at once; fewer where there is no memory for their room.
pub(crate) fn workers(asked: u32) -> usize {
    let wanted = if asked == 0 { available_threads() } else { asked as usize };
    let most = if wanted > 1 { free_memory() } else { None };
    most.map_or(wanted, |free| wanted.min((free / WORKER_BYTES) as usize)).max(1)
}

/// Runs work whose loops are spread over threads of this process. A process that was split off (`fork`) has none of its parent's, and gets its own.
pub fn in_pool<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    if rayon::current_thread_index().is_some() {
        return work();
    }
    match pool() {
        Some(pool) => pool.install(work),
        None => {
            // This thread is the whole pool from now on.
            let alone = ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
            let found = work();
            forget(alone);
            found
        }
    }
}

/// Has a thread of the pool do something meanwhile, or does it now where there is none.
pub fn in_pool_later(work: impl FnOnce() + Send + 'static) {
    match pool() {
        Some(pool) => pool.spawn(work),
        None => work(),
    }
}

/// Starts a worker within a scope; none where the system has no more threads to give.
pub fn start<'scope, T: Send + 'scope>(
    scope: &'scope Scope<'scope, '_>,
    work: impl FnOnce() -> T + Send + 'scope,
) -> Option<ScopedJoinHandle<'scope, T>> {
    Builder::new().spawn_scoped(scope, work).ok()
}

/// The pool of this process; none where the system gives no threads.
fn pool() -> Option<Arc<ThreadPool>> {
    for _ in 0..MOST_ASKED {
        let mut known = match POOL.try_lock() {
            Ok(known) => known,
            Err(TryLockError::Poisoned(known)) => known.into_inner(),
            Err(TryLockError::WouldBlock) => {
                sleep(ASK_AGAIN);
                continue;
            }
        };
        if let Some((_, pool)) = known.as_ref().filter(|(owner, _)| *owner == process::id()) {
            return Some(pool.clone());
        }
        let pool = Arc::new(made()?);
        // Threads of another process cannot be ended from here.
        forget(known.replace((process::id(), pool.clone())));
        return Some(pool);
    }
    made().map(Arc::new)
}

/// A pool of as many threads as the system gives.
fn made() -> Option<ThreadPool> {
    // Rayon's own choice, then fewer and fewer.
    let halves = std::iter::successors(Some(available_threads() / 2), |threads| Some(threads / 2)).take_while(|threads| *threads > 0);
    std::iter::once(0).chain(halves).find_map(|threads| ThreadPoolBuilder::new().num_threads(threads).build().ok())
}

/// What a panic has to say.
pub(crate) fn panic_message(panic: &(dyn Any + Send)) -> String {
    let message = panic.downcast_ref::<&str>().map(ToString::to_string).or_else(|| panic.downcast_ref::<String>().cloned());
    message.unwrap_or_else(|| "unknown panic".into())
}
