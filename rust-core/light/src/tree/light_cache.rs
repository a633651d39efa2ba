//! The learned light cache (light guiding): lights that are known to arrive in a part of space. Importance alone does not see the walls
//! that keep the others out.
//!
//! Space is divided into cells, and a pilot pass tells which lights arrive in each. There most selections are among those. The others are
//! among all lights by the light tree, less those in the cache. So each light is selected in one way, and its probability is simple.
//! Classes of receivers that see other lights have cells of their own.

use super::{Below, LightTree, NONE, Node, Point, below_one, draw};
use crate::context::LightSampleContext;
use gonio_simd::{F, Lanes, M, One, U, Vec3};

/// Most lights of a cell.
pub(super) const MOST: usize = 16;
/// Words of a cell: key, share, count, and the leaves of its lights.
pub(super) const WORDS: usize = 3 + MOST;
const SHARE: u32 = 1;
const COUNT: u32 = 2;
const FIRST: u32 = 3;
/// Where the grid begins, in cells: walls and floors stand at round numbers, and must not lie in between.
const SHIFT: f32 = 0.377;

/// So many points of a register go through the tree one by one sooner than together.
const FEW: usize = 4;

/// Lights by cell.
#[derive(Clone, Debug)]
pub struct LightCache {
    pub(super) cells: Vec<f32>,
    /// Cells less one; a power of two.
    pub(super) mask: u32,
    pub(super) per_metre: f32,
}

/// The cell at each lane's place.
#[derive(Clone, Copy, Debug)]
struct Cell<L: Lanes> {
    leaves: [U<L>; MOST],
    count: U<L>,
    /// Share of selections that are among these lights.
    share: F<L>,
}

/// Which cell a coordinate lies in; a function, as closures that `map` calls may stay calls, without lanes.
#[inline(always)]
fn step<L: Lanes>(x: F<L>, per_metre: f32) -> U<L> {
    (x * per_metre + SHIFT).floor().to_i32()
}

/// Place in a table and key of the cell that holds a point, for a class of receivers.
#[inline(always)]
fn hashed<L: Lanes>(p: Vec3<L>, per_metre: f32, class: u32) -> [U<L>; 2] {
    let (x, y, z) = (step(p.x, per_metre), step(p.y, per_metre), step(p.z, per_metre));
    let mixed = (x * 0x8da6_b343) ^ (y * 0xd816_3841) ^ (z * 0xcb1a_b31f) ^ class.wrapping_mul(0x1656_67b1);
    let key = ((x * 0x9e37_79b1) ^ (y * 0x85eb_ca77) ^ (z * 0xc2b2_ae3d) ^ class.wrapping_mul(0x27d4_eb2f)) | 1;
    [mixed ^ (mixed >> 15), key]
}

/// The same for one point.
pub(super) fn place(position: [f32; 3], per_metre: f32, class: u32) -> [u32; 2] {
    hashed(Vec3::splat(One, position), per_metre, class).map(|word| word.0)
}

impl LightCache {
    #[inline(always)]
    fn cell<L: Lanes>(&self, l: L, class: u32, p: Vec3<L>) -> Cell<L> {
        let [place, key] = hashed(p, self.per_metre, class);
        let start = (place & self.mask) * WORDS as u32;
        let found = l.gather(&self.cells, start).to_bits().eq(key);
        let count = l.gather(&self.cells, start + COUNT).to_bits().keep_if(found);
        let share = l.gather(&self.cells, start + SHARE).keep_if(found);
        let mut leaves = [l.u(NONE); MOST];
        for (number, leaf) in leaves.iter_mut().enumerate() {
            let present = l.u(number as u32).lt(count);
            if !present.any() {
                break;
            }
            *leaf = present.select(l.gather(&self.cells, start + (FIRST + number as u32)).to_bits(), *leaf);
        }
        Cell { leaves, count, share }
    }

    /// Selects a light for each point of a class of receivers, whose tree it is, and gives its probability: 0 where no light can arrive, and where
    /// the selection is given up.
    #[inline(always)]
    pub(crate) fn sample_light<L: Lanes>(
        &self,
        l: L,
        tree: &LightTree,
        rows: &[f32],
        class: u32,
        from: &LightSampleContext<L>,
        u: F<L>,
    ) -> (U<L>, F<L>) {
        let (p, n) = (from.position, from.normal);
        let cell = self.cell(l, class, p);
        let in_cache = u.lt(cell.share);
        let rest = l.f(1.0) - cell.share;
        let (mut light, mut probability) = (l.u(0), l.f(0.0));
        if in_cache.any() {
            let (weights, total) = cell.weigh(l, tree, p, n);
            let drawn = draw(l, &weights, total, below_one(u / cell.share.max(f32::MIN_POSITIVE)));
            let mut leaf = cell.leaves[0];
            for (number, other) in cell.leaves.iter().enumerate().skip(1) {
                leaf = drawn.index.eq(number as u32).select(*other, leaf);
            }
            light = Below::gather(l, &tree.nodes.words, leaf.keep_if(in_cache)).index();
            probability = drawn.probability * cell.share;
        }
        if !(!in_cache).any() {
            return (light, probability);
        }
        let u = below_one((u - cell.share) / rest);
        let others = !in_cache;
        let (other, chance) =
            if others.count() <= FEW { tree.sample_each(l, rows, p, n, u, others) } else { tree.sample_light(l, rows, Point { p, n }, u) };
        let lost = cell.holds(l.gather_integers(&tree.leaves, other));
        let chance = (chance * rest).keep_if(!lost);
        (in_cache.select(light, other), in_cache.select(probability, chance))
    }

    /// Probability that [`Self::sample_light`] selects `light` at a point.
    #[inline(always)]
    pub(crate) fn probability<L: Lanes>(
        &self,
        l: L,
        tree: &LightTree,
        rows: &[f32],
        class: u32,
        from: &LightSampleContext<L>,
        light: U<L>,
    ) -> F<L> {
        let (p, n) = (from.position, from.normal);
        let cell = self.cell(l, class, p);
        let leaf = l.gather_integers(&tree.leaves, light);
        let cached = cell.holds(leaf);
        let mut probability = l.f(0.0);
        if cached.any() {
            let (weights, total) = cell.weigh(l, tree, p, n);
            for (other, weight) in cell.leaves.iter().zip(&weights) {
                probability = other.eq(leaf).select(weight.share_of(total) * cell.share, probability);
            }
        }
        if !(!cached).any() {
            return probability;
        }
        cached.select(probability, tree.probability(l, rows, Point { p, n }, light) * (l.f(1.0) - cell.share))
    }
}

impl<L: Lanes> Cell<L> {
    /// Importances of the cell's lights, and their sum.
    #[inline(always)]
    fn weigh(&self, l: L, tree: &LightTree, p: Vec3<L>, n: Vec3<L>) -> ([F<L>; MOST], F<L>) {
        let (mut weights, mut total) = ([l.f(0.0); MOST], l.f(0.0));
        for (number, (leaf, weight)) in self.leaves.iter().zip(&mut weights).enumerate() {
            let present = l.u(number as u32).lt(self.count);
            if !present.any() {
                break;
            }
            *weight = Node::gather(l, &tree.nodes.words, leaf.keep_if(present)).importance(l, p, n).keep_if(present);
            total += *weight;
        }
        (weights, total)
    }

    /// Whether a leaf is among the cell's.
    #[inline(always)]
    fn holds(&self, leaf: U<L>) -> M<L> {
        let mut found = self.leaves[0].eq(leaf);
        for other in &self.leaves[1..] {
            found |= other.eq(leaf);
        }
        found & leaf.ne(NONE)
    }
}
