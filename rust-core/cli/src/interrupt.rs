//! Ctrl-C and other signals through Python's own machinery, so that nothing unsafe is needed.

use super::snapshot::SNAPSHOT_ASKED;
use pyo3::{prelude::*, types::PyCFunction};
use std::sync::atomic::{AtomicBool, Ordering};

/// Set by the first Ctrl-C, and by signals that ask to end.
pub(super) static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// What asks to end: a terminal, a scheduler or a system that shuts down, a terminal that is gone.
const ENDING: [&str; 3] = ["SIGINT", "SIGTERM", "SIGHUP"];
/// What asks for a picture of a render under way.
const LOOKING: &str = "SIGUSR1";

/// Makes the first signal that asks to end finish the render in order, and later ones as well; outside the main thread nothing is installed.
pub(super) fn install() {
    Python::attach(|py| {
        // Python installs handlers in its main thread alone; elsewhere signals belong to the host.
        let _ = installed(py);
    });
}

/// Has signals end the process at once, as without an interpreter: for what is short, and asks nobody whether to go on. Files are whole or not there.
pub(super) fn leave_to_system() {
    Python::attach(|py| {
        let default = || -> PyResult<()> {
            let signal = py.import("signal")?;
            for name in ENDING {
                let Ok(number) = signal.getattr(name) else { continue };
                if !signal.call_method1("getsignal", (&number,))?.eq(signal.getattr("SIG_IGN")?)? {
                    signal.call_method1("signal", (number, signal.getattr("SIG_DFL")?))?;
                }
            }
            Ok(())
        };
        // Outside the main thread signals belong to the host.
        let _ = default();
    });
}

/// Whether nothing has asked to end; asked now and then while something runs without the interpreter's lock.
pub(super) fn goes_on(interrupted: &AtomicBool) -> bool {
    let heard = Python::attach(|py| py.check_signals()).is_ok();
    heard && !interrupted.load(Ordering::Relaxed)
}

fn installed(py: Python<'_>) -> PyResult<()> {
    let signal = py.import("signal")?;
    let mut flags: Vec<(u8, &'static AtomicBool)> = Vec::new();
    for (name, flag) in ENDING.map(|name| (name, &INTERRUPTED)).into_iter().chain([(LOOKING, &SNAPSHOT_ASKED)]) {
        // Not all systems have all of them.
        let Ok(number) = signal.getattr(name) else { continue };
        // What was started to outlive its terminal (nohup) does.
        if name == "SIGHUP" && signal.call_method1("getsignal", (&number,))?.eq(signal.getattr("SIG_IGN")?)? {
            continue;
        }
        flags.push((number.extract()?, flag));
        let handler = PyCFunction::new_closure(py, None, None, move |_, _| flag.store(true, Ordering::Relaxed))?;
        signal.call_method1("signal", (number, handler))?;
    }
    #[cfg(unix)]
    heard_at_once(&signal, flags)?;
    Ok(())
}

/// Sets flags while the main thread is busy outside the interpreter, whose handlers run between its own steps alone.
#[cfg(unix)]
fn heard_at_once(signal: &Bound<'_, PyModule>, flags: Vec<(u8, &'static AtomicBool)>) -> PyResult<()> {
    use std::{
        io::Read,
        os::{fd::AsRawFd, unix::net::UnixStream},
        thread::Builder,
    };
    let (mut heard, told) = UnixStream::pair()?;
    told.set_nonblocking(true)?;
    Builder::new().spawn(move || {
        let mut number = [0];
        while heard.read_exact(&mut number).is_ok() {
            flags.iter().filter(|(known, _)| *known == number[0]).for_each(|(_, flag)| flag.store(true, Ordering::Relaxed));
        }
    })?;
    signal.call_method1("set_wakeup_fd", (told.as_raw_fd(),))?;
    // Open as long as the process is there.
    std::mem::forget(told);
    Ok(())
}
