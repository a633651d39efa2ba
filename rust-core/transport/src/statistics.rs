//! Counts and times of the wavefront stages, for benchmarks and progress.

use std::time::Instant;

/// The stages that are timed.
pub const STAGES: [&str; 6] = ["generate", "intersect", "surface", "graph", "shade", "shadow"];

/// What is counted lane by lane: rays that escaped, hits shaded, shadow rays sent by them, paths that go on.
pub const LANE_STAGES: [&str; 4] = ["surroundings", "shade", "light", "scatter"];
/// Bounces told apart; deeper ones count as the last.
pub const LANE_BOUNCES: usize = 16;

/// Lanes that were run, and those among them that held something of use.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LaneCount {
    /// Whole registers' lanes.
    pub run: u64,
    /// Lanes of use.
    pub alive: u64,
}

/// Counts for benchmarks and progress.
#[derive(Clone, Copy, Debug, Default)]
pub struct Statistics {
    /// Rays that looked for their nearest hit.
    pub rays: u64,
    /// Shadow rays.
    pub shadow_rays: u64,
    /// Camera rays: samples.
    pub camera_rays: u64,
    /// Lanes by bounce, in the order of [`LANE_STAGES`].
    pub lanes: [[LaneCount; LANE_STAGES.len()]; LANE_BOUNCES],
    /// Nanoseconds spent in each stage, in the order of [`STAGES`].
    pub time_ns: [u64; STAGES.len()],
}

impl Statistics {
    /// Adds the time since `start` to a stage and gives the time now.
    pub(crate) fn spent(&mut self, stage: usize, start: Instant) -> Instant {
        let now = Instant::now();
        self.time_ns[stage] += (now - start).as_nanos() as u64;
        now
    }
    /// Counts `alive` lanes of use among `run` at a depth.
    pub(crate) fn count_lanes(&mut self, depth: u32, stage: usize, run: usize, alive: usize) {
        let count = &mut self.lanes[(depth as usize).min(LANE_BOUNCES - 1)][stage];
        count.run += run as u64;
        count.alive += alive as u64;
    }
    /// Adds another's counts.
    pub fn add(&mut self, other: &Self) {
        self.rays += other.rays;
        self.shadow_rays += other.shadow_rays;
        self.camera_rays += other.camera_rays;
        for (count, more) in self.lanes.iter_mut().flatten().zip(other.lanes.iter().flatten()) {
            count.run += more.run;
            count.alive += more.alive;
        }
        self.time_ns.iter_mut().zip(other.time_ns).for_each(|(sum, time)| *sum += time);
    }
}
