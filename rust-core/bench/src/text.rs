//! The table for people.

use super::report::{Breakdown, LevelBreakdown, Machine, Row};
use gonio_simd::Execution;
use std::fmt::{self, Display, Formatter};

/// The table's first lines: this machine, and the columns.
pub fn heading() -> String {
    let machine = Machine::here();
    let processor = machine.processor.as_deref().unwrap_or("unknown processor");
    let company = machine.load.map(|load| format!(", load {load:.1}")).unwrap_or_default();
    let mut levels: Vec<_> = Execution::all().into_iter().filter(|execution| execution.lanes() > 1).collect();
    levels.reverse();
    let columns: String = levels.iter().map(|level| format!(" {:>20}", format!("{} x{}", level.name(), level.lanes()))).collect();
    format!(
        "gonio {}, {processor}, {} threads{company}\n{:10} {:40} {:>8} {:>7} {:>11}{columns}",
        machine.version, machine.threads, "stage", "kernel", "unit", "over", "ns a unit"
    )
}

impl Display for Row {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "{:10} {:40} {:>8} {:>7} {:>11.2}", self.stage, self.name, self.unit, self.baseline, self.baseline_ns)?;
        self.levels.iter().try_for_each(|figure| {
            let spread = format!("({:.2}-{:.2})", figure.ratio.low, figure.ratio.high);
            write!(f, " {:>6.2} {spread:>13}", figure.ratio.median)
        })
    }
}

impl Display for Breakdown {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {} triangles, {} lights", self.scene, self.triangles, self.lights)?;
        self.levels.iter().try_for_each(|level| writeln!(f, "  {level}"))?;
        let Some(best) = self.levels.last() else { return Ok(()) };
        writeln!(f, "  lanes of use at {}, bounce by bounce (lanes shaded over those of the first):", best.level)?;
        for at in &best.lanes {
            let alive: Vec<String> = at.alive.iter().map(|share| format!("{} {:3.0} %", share.stage, share.share * 100.0)).collect();
            writeln!(f, "    {:>2} ({:4.2})  {}", at.bounce, at.work, alive.join("  "))?;
        }
        Ok(())
    }
}

impl Display for LevelBreakdown {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let shares: Vec<String> = self.time.iter().map(|share| format!("{} {:4.1} %", share.stage, share.share * 100.0)).collect();
        write!(f, "{:8} {:7.3} Mrays/s  {}", self.level, self.mrays, shares.join("  "))
    }
}
