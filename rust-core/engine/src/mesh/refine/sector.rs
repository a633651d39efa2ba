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
        let (start, is_closed) = walker.first_of(seed);
        corners.clear();
        let mut corner = Some(start);
        while let Some(here) = corner {
            visited[here] = true;
            corners.push(here as u32);
            corner = walker.after(here).filter(|&next| next != start);
        }
        visit(&Sector { vertex: level.corner_vertex[seed], corners: &corners, is_closed });
    }
}

struct Walker<'a, Barrier> {
    level: &'a Level,
    is_barrier: Barrier,
}

impl<Barrier: Fn(usize) -> bool> Walker<'_, Barrier> {
    /// Turns clockwise from `seed` to the first corner of its sector.
    fn first_of(&self, seed: usize) -> (usize, bool) {
        let mut corner = seed;
        while let Some(before) = self.before(corner) {
            if before == seed {
                return (seed, true);
            }
            corner = before;
        }
        (corner, false)
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
