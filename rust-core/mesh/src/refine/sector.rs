//! Walks around vertices: the corners between two edges that are not to be crossed.

use super::topology::{INFINITE, Level, NONE};

/// The corners around a vertex from one barrier edge to the next, counter-clockwise; closed where there is no barrier.
pub(crate) struct Sector<'a> {
    pub(crate) vertex: u32,
    pub(crate) corners: &'a [u32],
    pub(crate) is_closed: bool,
}

/// Calls `visit` for each sector of the level, in order of their first corners. Sectors are parted by boundaries,
/// non-manifold edges and the edges that are a `is_barrier`.
pub(crate) fn for_each_sector(level: &Level, is_barrier: impl Fn(usize) -> bool, mut visit: impl FnMut(&Sector)) {
    let walker = Walker { level, is_barrier };
    let mut visited = vec![false; level.corner_vertex.len()];
    let mut corners = Vec::new();
    for seed in 0..level.corner_vertex.len() {
        if visited[seed] {
            continue;
        }
        let is_closed = walker.collect(seed, &mut corners);
        for &corner in &corners {
            visited[corner as usize] = true;
        }
        visit(&Sector { vertex: level.corner_vertex[seed], corners: &corners, is_closed });
    }
}

struct Walker<'a, Barrier> {
    level: &'a Level,
    is_barrier: Barrier,
}

impl<Barrier: Fn(usize) -> bool> Walker<'_, Barrier> {
    /// Sets `corners` to the sector of `seed`; returns whether it is closed, in which case it starts at `seed`.
    fn collect(&self, seed: usize, corners: &mut Vec<u32>) -> bool {
        corners.clear();
        corners.push(seed as u32);
        let mut corner = seed;
        while let Some(next) = self.after(corner) {
            if next == seed {
                return true;
            }
            corners.push(next as u32);
            corner = next;
        }
        let forward = corners.len();
        corner = seed;
        while let Some(previous) = self.before(corner) {
            corners.push(previous as u32);
            corner = previous;
        }
        // What lies clockwise of the seed comes first.
        corners[forward..].reverse();
        corners.rotate_left(forward);
        false
    }

    /// The next corner counter-clockwise around the same vertex.
    fn after(&self, corner: usize) -> Option<usize> {
        self.across(self.level.before(corner))
    }

    /// The next corner clockwise around the same vertex.
    fn before(&self, corner: usize) -> Option<usize> {
        self.across(corner).map(|opposite| self.level.after(opposite))
    }

    /// The corner that runs along the same edge as `corner` on the other side.
    fn across(&self, corner: usize) -> Option<usize> {
        let edge = self.level.corner_edge[corner] as usize;
        let [a, b] = self.level.edge_corners[edge];
        if b == NONE || !self.level.is_manifold(edge) || (self.is_barrier)(edge) {
            return None;
        }
        if a as usize == corner {
            Some(b as usize)
        } else if b as usize == corner {
            Some(a as usize)
        } else {
            // A third face at this edge: a walk across it could not be walked back.
            None
        }
    }
}

/// Number of sectors around each vertex when only boundaries and non-manifold edges part them: more than one means a
/// non-manifold vertex.
pub(crate) fn fan_counts(level: &Level, is_crowded: impl Fn(usize) -> bool) -> Vec<u32> {
    let mut counts = vec![0; level.vertex_count];
    for_each_sector(level, is_crowded, |sector| counts[sector.vertex as usize] += 1);
    counts
}

/// Whether no surface is smooth across the edge at this level.
pub(crate) fn is_sharp(level: &Level, edge: usize) -> bool {
    level.edge_sharpness[edge] > 0.0
}

/// Whether the edge is sharp at all levels.
pub(crate) fn is_infinitely_sharp(level: &Level, edge: usize) -> bool {
    level.edge_sharpness[edge] >= INFINITE
}
