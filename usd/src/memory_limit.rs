//! A limit on memory while `pxr` opens files: counts in a corrupt crate file may ask for more than the machine has, and the system would end the process.

use gonio::memory::machine_memory;
use pyo3::prelude::*;
use std::fs::read_to_string;

/// Of the memory that is free, as much as opening may take.
const SHARE: f64 = 0.8;

/// The limit, until it is dropped. None where the system tells nothing of its memory.
pub struct MemoryLimit<'py>(Option<Former<'py>>);

struct Former<'py> {
    resource: Bound<'py, PyModule>,
    limits: Bound<'py, PyAny>,
}

impl<'py> MemoryLimit<'py> {
    /// Lowers the limit on the process's addresses to what it has and a share of what is free.
    pub fn new(py: Python<'py>) -> Self {
        Self(
            addresses()
                .zip(machine_memory())
                .and_then(|(used, free)| Former::lower(py, used + (free as f64 * SHARE) as u64).ok().flatten()),
        )
    }
}

impl std::fmt::Debug for MemoryLimit<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("MemoryLimit").field(&self.0.is_some()).finish()
    }
}

impl<'py> Former<'py> {
    fn lower(py: Python<'py>, bytes: u64) -> PyResult<Option<Self>> {
        let resource = py.import("resource")?;
        let addresses = resource.getattr("RLIMIT_AS")?;
        let limits = resource.call_method1("getrlimit", (&addresses,))?;
        let (soft, hard): (i64, i64) = limits.extract()?;
        // Without a limit the value is negative.
        if (0..=bytes as i64).contains(&soft) {
            return Ok(None);
        }
        resource.call_method1("setrlimit", (addresses, (bytes as i64, hard)))?;
        Ok(Some(Self { resource, limits }))
    }
}

impl Drop for Former<'_> {
    fn drop(&mut self) {
        let restore = || self.resource.call_method1("setrlimit", (self.resource.getattr("RLIMIT_AS")?, &self.limits));
        // Raising a soft limit to what it was is always allowed.
        let _ = restore();
    }
}

/// Bytes of addresses that the process has.
fn addresses() -> Option<u64> {
    let text = read_to_string("/proc/self/status").ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix("VmSize:"))?;
    Some(line.trim().trim_end_matches(" kB").parse::<u64>().ok()? << 10)
}
