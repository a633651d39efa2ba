//! What is made of light paths: batches of them are traced by worker threads, and their sums are the same bits for any number of threads.

mod driver;
mod estimates;
mod rounds;
mod sums;
#[cfg(test)]
pub(crate) mod test_scenes;
mod worker_sums;

pub use driver::{Batch, Collector, Job, Watch, trace_batches};
pub use estimates::{BatchEstimates, Estimate};
pub use rounds::Progress;
pub(crate) use rounds::{batches, check_rule, next_round};
pub use sums::{Channels, FixedSums};
pub use worker_sums::WorkerSums;
