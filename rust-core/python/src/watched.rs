//! Long work without the interpreter's lock, on which Python looks now and then.

use crate::error::exception;
use crossbeam_channel::{Receiver, RecvTimeoutError, Sender, bounded};
use gonio::Error;
use pyo3::prelude::*;
use std::{
    sync::atomic::{AtomicBool, Ordering},
    thread::{Builder, scope},
    time::Duration,
};

/// How long work may be silent before Python is asked whether it is still wanted.
const SILENCE: Duration = Duration::from_millis(50);
/// The stack of the work's thread, as the main thread has it.
const STACK: usize = 8 << 20;

/// Runs `work` on a thread of its own, with a flag that cancels it and a function that tells how far it is. `ask` decides whether it goes on, each time that
/// something is told, and every 50 ms where nothing is, as while a scene is compiled. Signals, and exceptions of `ask`, end it and are raised.
pub(crate) fn watched<P: Copy + Send, R: Send>(
    py: Python<'_>,
    ask: impl Fn(Python<'_>, Option<&P>) -> PyResult<bool> + Sync,
    work: impl FnOnce(&AtomicBool, &mut dyn FnMut(&P) -> bool) -> Result<R, Error> + Send,
) -> PyResult<R> {
    let stop = AtomicBool::new(false);
    let (tell, told) = bounded(0);
    let (answer, answered) = bounded(1);
    scope(|scope| {
        // The sender is dropped where the work ends, however it does.
        let run = || work(&stop, &mut telling(tell, answered));
        let worker = Builder::new().stack_size(STACK).spawn_scoped(scope, run);
        let worker = worker.map_err(|error| exception(Error::Internal(format!("the system gives no thread: {error}"))))?;
        let raised = watch(py, ask, &stop, (&told, &answer));
        let found = py.detach(|| worker.join()).unwrap_or_else(|panic| std::panic::resume_unwind(panic));
        raised.map_or_else(|| found.map_err(exception), Err)
    })
}

/// What the work calls with how far it is, until whoever watches has answered.
fn telling<P: Copy>(tell: Sender<P>, answered: Receiver<bool>) -> impl FnMut(&P) -> bool {
    move |now: &P| tell.send(*now).is_ok() && answered.recv().unwrap_or(false)
}

/// Asks about the work until it has ended. Gives the exception that ended it.
fn watch<P: Send>(
    py: Python<'_>,
    ask: impl Fn(Python<'_>, Option<&P>) -> PyResult<bool>,
    stop: &AtomicBool,
    (told, answer): (&Receiver<P>, &Sender<bool>),
) -> Option<PyErr> {
    let mut raised: Option<PyErr> = None;
    loop {
        let now = match py.detach(|| told.recv_timeout(SILENCE)) {
            Ok(now) => Some(now),
            Err(RecvTimeoutError::Timeout) => None,
            Err(RecvTimeoutError::Disconnected) => return raised,
        };
        let goes_on = raised.is_none() && !stop.load(Ordering::Relaxed);
        let goes_on = goes_on
            && py.check_signals().and_then(|()| ask(py, now.as_ref())).unwrap_or_else(|error| {
                raised = Some(error);
                false
            });
        stop.store(!goes_on, Ordering::Relaxed);
        if now.is_some() {
            let _ = answer.send(goes_on);
        }
    }
}

/// Asks a function that says when to stop, if there is one.
pub(crate) fn unless(py: Python<'_>, cancelled: Option<&Py<PyAny>>) -> PyResult<bool> {
    cancelled.map_or(Ok(true), |cancelled| Ok(!cancelled.bind(py).call0()?.is_truthy()?))
}

/// Tells a function how far work on rays is: rays, most rays, error, seconds. One that says nothing goes on.
pub(crate) fn tell_rays(py: Python<'_>, told: Option<&Py<PyAny>>, now: Option<&gonio::light_paths::Progress>) -> PyResult<bool> {
    let Some((told, now)) = told.zip(now) else { return Ok(true) };
    let answer = told.bind(py).call1((now.paths, now.most, now.error, now.elapsed.as_secs_f64()))?;
    Ok(answer.is_none() || answer.is_truthy()?)
}
