//! Long work without the interpreter's lock, on which Python looks now and then.

use crate::error::exception;
use gonio::Error;
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};

/// Runs `work` with a flag that cancels it and a function that tells how far it is. Then `ask` decides whether it goes on; signals, and exceptions
/// of `ask`, end it and are raised.
pub(crate) fn watched<P, R: Send>(
    py: Python<'_>,
    ask: impl Fn(Python<'_>, &P) -> PyResult<bool> + Sync,
    work: impl FnOnce(&AtomicBool, &mut dyn FnMut(&P) -> bool) -> Result<R, Error> + Send,
) -> PyResult<R> {
    let stop = AtomicBool::new(false);
    let mut raised: Option<PyErr> = None;
    let mut progress = |now: &P| {
        let goes_on = Python::attach(|py| {
            py.check_signals()?;
            ask(py, now)
        });
        let goes_on = goes_on.unwrap_or_else(|error| {
            raised = Some(error);
            false
        });
        stop.store(!goes_on, Ordering::Relaxed);
        goes_on
    };
    let found = py.detach(|| work(&stop, &mut progress));
    match (found, raised) {
        (_, Some(error)) => Err(error),
        (found, None) => found.map_err(exception),
    }
}

/// Asks a function that says when to stop, if there is one.
pub(crate) fn unless(py: Python<'_>, cancelled: Option<&Py<PyAny>>) -> PyResult<bool> {
    cancelled.map_or(Ok(true), |cancelled| Ok(!cancelled.bind(py).call0()?.is_truthy()?))
}

/// Tells a function how far work on rays is: rays, most rays, error, seconds. One that says nothing goes on.
pub(crate) fn tell_rays(py: Python<'_>, told: Option<&Py<PyAny>>, now: &gonio::light_paths::Progress) -> PyResult<bool> {
    let Some(told) = told else { return Ok(true) };
    let answer = told.bind(py).call1((now.paths, now.most, now.error, now.elapsed.as_secs_f64()))?;
    Ok(answer.is_none() || answer.is_truthy()?)
}
