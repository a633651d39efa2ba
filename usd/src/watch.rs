//! Tells the process that watches this one when the USD library is at work: what ends the process then is the library's, or the file's.

use pyo3::prelude::*;

/// While it lives, a stage is being read.
#[derive(Debug)]
pub(crate) struct Reading<'py> {
    note: Option<Bound<'py, PyAny>>,
}

impl<'py> Reading<'py> {
    /// Begins to read.
    pub(crate) fn start(py: Python<'py>) -> Self {
        // Only the command line has a watcher; others read without one.
        let note = || py.import("gonio._watch")?.getattr("reading");
        let reading = Self { note: note().ok() };
        reading.tell(true);
        reading
    }

    fn tell(&self, is_reading: bool) {
        // Nothing is lost where nobody listens.
        let _ = self.note.as_ref().map(|note| note.call1((is_reading,)));
    }
}

impl Drop for Reading<'_> {
    fn drop(&mut self) {
        self.tell(false);
    }
}
