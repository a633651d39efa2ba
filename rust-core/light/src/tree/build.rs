//! Building the light tree: sets of lights split where that brings the least cost, up to eight children a node.

use super::bound::Bound;
use super::node;
use std::ops::Range;

/// Children of a node below the top.
pub(super) const WIDTH: usize = 8;
/// Nodes at the top, all weighed at each point.
pub(super) const TOP: usize = 64;
/// No node.
pub(super) const NONE: u32 = u32::MAX;
const BINS: usize = 12;

/// Nodes of the tree; the first `top` of them have no parent.
#[derive(Clone, Debug, Default)]
pub(super) struct Nodes {
    /// [`node::WORDS`] values a node.
    pub(super) words: Vec<f32>,
    pub(super) parents: Vec<u32>,
    pub(super) top: usize,
}

struct Builder<'a> {
    /// Light and bound.
    lights: &'a mut [(u32, Bound)],
    nodes: Nodes,
}

/// A tree over these lights.
pub(super) fn build(lights: &mut [(u32, Bound)]) -> Nodes {
    let count = lights.len();
    let mut builder = Builder { lights, nodes: Nodes::default() };
    if count > 0 {
        builder.emit(count);
    }
    builder.nodes
}

impl Builder<'_> {
    fn emit(&mut self, count: usize) {
        let mut pending = Vec::new();
        self.nodes.top = self.add_children(0..count, TOP, NONE, &mut pending);
        while let Some((number, range)) = pending.pop() {
            let first = self.nodes.parents.len();
            let children = self.add_children(range, WIDTH, number, &mut pending);
            node::set_children(&mut self.nodes.words, number, first, children);
        }
    }

    /// Appends the children of a set; those that are sets themselves are left to do.
    fn add_children(&mut self, range: Range<usize>, most: usize, parent: u32, pending: &mut Vec<(u32, Range<usize>)>) -> usize {
        let children = self.opened(range, most);
        for range in &children {
            let number = self.nodes.parents.len() as u32;
            self.nodes.parents.push(parent);
            let lights = &self.lights[range.clone()];
            let words = match lights {
                [(light, bound)] => node::leaf(bound, *light),
                _ => node::inner(&united(lights)),
            };
            self.nodes.words.extend_from_slice(&words);
            if lights.len() > 1 {
                pending.push((number, range.clone()));
            }
        }
        children.len()
    }

    /// A set as up to `most` sets: the costliest is split again and again.
    fn opened(&mut self, range: Range<usize>, most: usize) -> Vec<Range<usize>> {
        let mut sets = vec![(self.bound(&range).cost(), range)];
        while sets.len() < most {
            let open = |(_, (_, range)): &(usize, &(f64, Range<usize>))| range.len() > 1;
            let order = |(_, a): &(usize, &(f64, Range<usize>)), (_, b): &(usize, &(f64, Range<usize>))| {
                a.0.total_cmp(&b.0).then(a.1.len().cmp(&b.1.len()))
            };
            let Some((costliest, _)) = sets.iter().enumerate().filter(open).max_by(order) else { break };
            let (_, range) = sets.swap_remove(costliest);
            let middle = self.split(&range);
            for part in [range.start..middle, middle..range.end] {
                sets.push((self.bound(&part).cost(), part));
            }
        }
        sets.into_iter().map(|(_, range)| range).collect()
    }

    fn bound(&self, range: &Range<usize>) -> Bound {
        united(&self.lights[range.clone()])
    }

    /// Reorders a set in two parts; gives the first of the second.
    fn split(&mut self, range: &Range<usize>) -> usize {
        let lights = &mut self.lights[range.clone()];
        let halved = range.start + lights.len() / 2;
        let Some(plane) = best_plane(lights) else { return halved };
        let mut first = 0;
        for at in 0..lights.len() {
            if plane.is_below(&lights[at].1) {
                lights.swap(first, at);
                first += 1;
            }
        }
        if first == 0 || first == lights.len() { halved } else { range.start + first }
    }
}

/// The bound of some lights.
fn united(lights: &[(u32, Bound)]) -> Bound {
    let mut all = lights[0].1;
    for (_, bound) in &lights[1..] {
        all = all.union(bound);
    }
    all
}

/// Between two bins along an axis.
struct Plane {
    axis: usize,
    low: f64,
    /// Bins per metre.
    density: f64,
    last_below: usize,
}

impl Plane {
    fn bin(&self, bound: &Bound) -> usize {
        (((bound.centre[self.axis] - self.low) * self.density) as usize).min(BINS - 1)
    }
    fn is_below(&self, bound: &Bound) -> bool {
        self.bin(bound) <= self.last_below
    }
}

/// Where splitting costs least; `None` where all lights are at one place.
fn best_plane(lights: &[(u32, Bound)]) -> Option<Plane> {
    let mut best: Option<(f64, Plane)> = None;
    for axis in 0..3 {
        let centres = || lights.iter().map(|(_, bound)| bound.centre[axis]);
        let (low, high) = (centres().fold(f64::INFINITY, f64::min), centres().fold(f64::NEG_INFINITY, f64::max));
        let density = BINS as f64 / (high - low);
        if high <= low || !density.is_finite() {
            continue;
        }
        let mut plane = Plane { axis, low, density, last_below: 0 };
        if let Some((cost, last_below)) = best_bin(lights, &plane) {
            plane.last_below = last_below;
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                best = Some((cost, plane));
            }
        }
    }
    best.map(|(_, plane)| plane)
}

/// The least cost along an axis, and the last bin below the plane.
fn best_bin(lights: &[(u32, Bound)], plane: &Plane) -> Option<(f64, usize)> {
    let mut bins: [Option<Bound>; BINS] = [None; BINS];
    let with = |sum: Option<Bound>, bound: &Bound| Some(sum.map_or(*bound, |sum| sum.union(bound)));
    for (_, bound) in lights {
        let bin = &mut bins[plane.bin(bound)];
        *bin = with(*bin, bound);
    }
    let mut above = [0.0; BINS];
    let mut sum = None;
    for at in (1..BINS).rev() {
        sum = bins[at].as_ref().map_or(sum, |bin| with(sum, bin));
        above[at - 1] = sum.as_ref().map_or(f64::INFINITY, Bound::cost);
    }
    let mut below = None;
    let mut best = None;
    for at in 0..BINS - 1 {
        below = bins[at].as_ref().map_or(below, |bin| with(below, bin));
        let cost = below.as_ref().map_or(f64::INFINITY, Bound::cost) + above[at];
        if cost.is_finite() && best.is_none_or(|(least, _)| cost < least) {
            best = Some((cost, at));
        }
    }
    best
}
