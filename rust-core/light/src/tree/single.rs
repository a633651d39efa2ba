//! One point's way through the tree, with nodes in the lanes instead of points: for the few points of a register that need it.

use super::{Below, Drawn, LightTree, Node, Point, Receiver, TOP, below_one};
use gonio_simd::{F, Lanes, M, One, U, Vec3};

/// Room for the importances of the top and of the infinite lights, written a register at a time.
const ROOM: usize = 1 + TOP + 16;

/// Weights that are added up together: sums of several groups do not wait for one another.
const GROUP: usize = 8;

/// Draws one of the weights: first a group of them, then one of it.
#[inline(always)]
fn draw_one(weights: &[f32], u: F<One>) -> Drawn<One> {
    let mut sums = [0.0; ROOM.div_ceil(GROUP)];
    for (sum, group) in sums.iter_mut().zip(weights.chunks(GROUP)) {
        *sum = group.iter().sum();
    }
    let total: f32 = sums.iter().sum();
    let target = u.0 * total;
    let (group, before) = reached(&sums, 0.0, target);
    let first = group * GROUP;
    let members = weights.get(first..).map_or(&[][..], |rest| &rest[..rest.len().min(GROUP)]);
    let (member, before) = reached(members, before, target);
    let own = F(members.get(member).copied().unwrap_or(0.0));
    let rest = below_one((F(target) - F(before)) / own.max(f32::MIN_POSITIVE));
    Drawn { index: U((first + member) as u32), probability: own.share_of(F(total)), rest }
}

/// The last weight above zero up to whose start the weights, added to `sum`, do not exceed the target, and that start.
#[inline(always)]
fn reached(weights: &[f32], mut sum: f32, target: f32) -> (usize, f32) {
    let (mut index, mut before) = (0, sum);
    for (number, weight) in weights.iter().enumerate() {
        if sum <= target && *weight > 0.0 {
            (index, before) = (number, sum);
        }
        sum += weight;
    }
    (index, before)
}

impl LightTree {
    /// [`Self::sample_light`] for the points of a mask, one after the other; the other lanes are left at zero.
    #[inline(always)]
    pub(super) fn sample_each<L: Lanes>(&self, l: L, rows: &[f32], p: Vec3<L>, n: Vec3<L>, u: F<L>, mask: M<L>) -> (U<L>, F<L>) {
        let (mut lights, mut probabilities) = ([0; 16], [0.0; 16]);
        let [p, n] = [p, n].map(|v| [v.x, v.y, v.z].map(F::to_array));
        let u = u.to_array();
        let mut left = mask.bits();
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            left &= left - 1;
            let at = |v: [[f32; 16]; 3]| Vec3::splat(l, v.map(|values| values[lane]));
            (lights[lane], probabilities[lane]) = self.sample_one(l, rows, Point { p: at(p), n: at(n) }, u[lane]);
        }
        (l.load_integers(&lights, 0), l.load(&probabilities, 0))
    }

    /// The same for the one point that fills all lanes.
    #[inline(always)]
    fn sample_one<L: Lanes>(&self, l: L, rows: &[f32], receiver: Point<L>, u: f32) -> (u32, f32) {
        let mut weights = [0.0; ROOM];
        weights[0] = self.infinite_importance(l, rows, receiver).to_array()[0];
        self.weigh(l, receiver, 0, self.top.len(), &mut weights[1..]);
        let drawn = draw_one(&weights[..=self.top.len()], F(u));
        if drawn.index.0 == 0 {
            let (light, share) = self.sample_infinite(l, rows, receiver, l.f(drawn.rest.0));
            return (light.to_array()[0], share.to_array()[0] * drawn.probability.0);
        }
        let (mut probability, mut rest) = (drawn.probability, drawn.rest);
        let mut node = drawn.index.0 - 1;
        loop {
            let below = Below::gather(One, &self.nodes.words, U(node));
            if below.is_leaf().0 {
                return (below.index().0, probability.0);
            }
            let (first, count) = (below.index().0, below.count().0 as usize);
            self.weigh(l, receiver, first as usize, count, &mut weights);
            let drawn = draw_one(&weights[..count], rest);
            node = first + drawn.index.0;
            probability *= drawn.probability;
            rest = drawn.rest;
        }
    }

    /// Importances of neighbouring nodes; a register's worth more may be written behind them.
    #[inline(always)]
    fn weigh<L: Lanes>(&self, l: L, receiver: Point<L>, first: usize, count: usize, weights: &mut [f32]) {
        for at in (0..count).step_by(L::COUNT) {
            let node = (l.iota() + at as u32).min(count as u32 - 1) + first as u32;
            receiver.weigh_node(l, &Node::gather(l, &self.nodes.words, node)).store(weights, at);
        }
    }
}
