//! Counts and times of the wavefront stages, for benchmarks and progress.

use std::time::Instant;

/// The stages that are timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Camera rays.
    Generate,
    /// Nearest hits, the light of lights among them, closures and the sort.
    Intersect,
    /// Surface points.
    Surface,
    /// Shading programs.
    Graph,
    /// Lobes, next event estimation and scattering.
    Shade,
    /// Walks under surfaces, measured points and shadow rays; of sensors' first batch they count as generation.
    Shadow,
}

impl Stage {
    /// All of them, in the order of [`Statistics::time_ns`], with their names.
    pub const ALL: [(Self, &str); 6] = [
        (Self::Generate, "generate"),
        (Self::Intersect, "intersect"),
        (Self::Surface, "surface"),
        (Self::Graph, "graph"),
        (Self::Shade, "shade"),
        (Self::Shadow, "shadow"),
    ];
}

/// What is counted lane by lane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LaneStage {
    /// Rays that escaped.
    Escaped,
    /// Hits shaded.
    Shade,
    /// Shadow rays that these sent.
    Light,
    /// Paths that go on.
    Scatter,
}

impl LaneStage {
    /// All of them, in the order of [`Statistics::lanes`], with their names.
    pub const ALL: [(Self, &str); 4] =
        [(Self::Escaped, "escaped"), (Self::Shade, "shade"), (Self::Light, "light"), (Self::Scatter, "scatter")];
}

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
    /// Lanes by bounce, in the order of [`LaneStage::ALL`].
    pub lanes: [[LaneCount; LaneStage::ALL.len()]; LANE_BOUNCES],
    /// Nanoseconds spent in each stage, in the order of [`Stage::ALL`].
    pub time_ns: [u64; Stage::ALL.len()],
}

impl Statistics {
    /// Adds the time since `start` to a stage and gives the time now.
    pub(crate) fn spent(&mut self, stage: Stage, start: Instant) -> Instant {
        let now = Instant::now();
        self.time_ns[stage as usize] += (now - start).as_nanos() as u64;
        now
    }
    /// Counts `alive` lanes of use among `run` at a depth.
    pub(crate) fn count_lanes(&mut self, depth: u32, stage: LaneStage, run: usize, alive: usize) {
        let count = &mut self.lanes[(depth as usize).min(LANE_BOUNCES - 1)][stage as usize];
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
