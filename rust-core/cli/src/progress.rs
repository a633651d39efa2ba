//! Progress: a bar on a terminal, a line now and then elsewhere.

use super::messages::say;
use gonio::render::Progress;
use indicatif::{ProgressBar, ProgressStyle};
use std::{
    io::IsTerminal,
    time::{Duration, Instant},
};

/// How often a line is written where there is no terminal.
const LINE_EVERY: Duration = Duration::from_secs(10);

/// Shows how far a render is.
pub(super) struct Reporter {
    bar: Option<ProgressBar>,
    last: Instant,
    quiet: bool,
}

impl Reporter {
    /// A reporter for one picture, named in lines.
    pub(super) fn new(quiet: bool) -> Self {
        let bar = (!quiet && std::io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::new(1000);
            // The wide message is cut to the terminal, so that the bar stays one line.
            let style = ProgressStyle::with_template("{bar:32} {percent:>3} %  {wide_msg}");
            bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
            bar
        });
        Self { bar, last: Instant::now(), quiet }
    }

    /// Shows a new state.
    pub(super) fn show(&mut self, progress: &Progress) {
        let done = format!("{}/{} samples", progress.samples, progress.samples_total);
        let speed = progress.rays as f64 * 1e-6 / progress.elapsed.as_secs_f64().max(1e-3);
        self.tell(progress.fraction, &done, progress.remaining, &format!("{speed:.1} Mrays/s"));
    }

    /// Shows a new state in words: what is done, from 0 to 1 and as text, the time that is left if that can be told, and what goes on.
    pub(super) fn tell(&mut self, fraction: f64, done: &str, remaining: Option<Duration>, under_way: &str) {
        let message = format!("{done}, {} left, {under_way}", remaining.map_or_else(|| "?".to_owned(), clock));
        if let Some(bar) = &self.bar {
            bar.set_position((fraction * 1000.0) as u64);
            bar.set_message(message);
        } else if !self.quiet && self.last.elapsed() >= LINE_EVERY {
            self.last = Instant::now();
            say(&format!("{:.0} %, {message}", fraction * 100.0));
        }
    }

    /// Takes the bar away.
    pub(super) fn clear(&self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

/// Minutes and seconds.
pub(super) fn clock(time: Duration) -> String {
    let seconds = time.as_secs();
    match seconds {
        0..60 => format!("{:.1} s", time.as_secs_f64()),
        60..3600 => format!("{}:{:02} min", seconds / 60, seconds % 60),
        _ => format!("{}:{:02} h", seconds / 3600, seconds / 60 % 60),
    }
}
