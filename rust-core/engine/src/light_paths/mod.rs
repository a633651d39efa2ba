//! What is made of light paths: batches of them are traced by worker threads, and their sums are the same bits for any number of threads.

mod batch_sums;
mod driver;
mod estimates;
mod sums;

pub use batch_sums::BatchSums;
pub use driver::{Batch, Collector, Job, Watch, trace_batches};
pub use estimates::{BatchEstimates, Estimate};
pub use sums::{Channels, FixedSums};
