//! One point's way through the tree, with nodes in the lanes instead of points: for the few points of a register that need it.

use super::{Below, LightTree, Node, Receiver, TOP};
use gonio_simd::{F, Lanes, M, One, U, Vec3};

/// One of several weights, drawn.
#[derive(Clone, Copy, Debug)]
struct Drawn {
    index: usize,
    probability: f32,
    /// The number that drew it, spread over `[0, 1)` again.
    rest: f32,
}

/// Draws one of the weights; the last that has any stands for what rounding leaves.
fn draw(weights: &[f32], u: f32) -> Drawn {
    let total: f32 = weights.iter().sum();
    let target = u * total;
    let (mut index, mut own, mut before, mut sum) = (0, 0.0, 0.0, 0.0);
    for (number, weight) in weights.iter().enumerate() {
        if sum <= target && *weight > 0.0 {
            (index, own, before) = (number, *weight, sum);
        }
        sum += weight;
    }
    let rest = ((target - before) / own.max(f32::MIN_POSITIVE)).clamp(0.0, 1.0 - f32::EPSILON);
    Drawn { index, probability: if total > 0.0 { own / total } else { 0.0 }, rest }
}

/// Room for the estimates of the top and of the lights at infinity, written a register at a time.
const ROOM: usize = 1 + TOP + 16;

impl LightTree {
    /// [`Self::choose`] for the points of a mask, one after the other; the other lanes are left at zero.
    #[inline(always)]
    pub(super) fn choose_each<L: Lanes>(&self, l: L, rows: &[f32], p: Vec3<L>, n: Vec3<L>, u: F<L>, mask: M<L>) -> (U<L>, F<L>) {
        let (mut lights, mut probabilities) = ([0; 16], [0.0; 16]);
        let [p, n] = [p, n].map(|v| [v.x, v.y, v.z].map(F::to_array));
        let u = u.to_array();
        let mut left = mask.bits();
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            left &= left - 1;
            let at = |v: [[f32; 16]; 3]| Vec3::splat(l, v.map(|values| values[lane]));
            (lights[lane], probabilities[lane]) = self.choose_one(rows, Receiver { l, p: at(p), n: at(n) }, u[lane]);
        }
        (l.load_integers(&lights, 0), l.load(&probabilities, 0))
    }

    /// The same for the one point that fills all lanes.
    #[inline(always)]
    fn choose_one<L: Lanes>(&self, rows: &[f32], receiver: Receiver<L>, u: f32) -> (u32, f32) {
        let mut weights = [0.0; ROOM];
        weights[0] = self.infinity(rows, receiver).to_array()[0];
        self.weigh(receiver, 0, self.top.len(), &mut weights[1..]);
        let drawn = draw(&weights[..=self.top.len()], u);
        if drawn.index == 0 {
            let (light, share) = self.draw_far(rows, receiver, receiver.l.f(drawn.rest));
            return (light.to_array()[0], share.to_array()[0] * drawn.probability);
        }
        let (mut probability, mut rest) = (drawn.probability, drawn.rest);
        let mut node = drawn.index - 1;
        loop {
            let below = Below::gather(One, &self.nodes.words, U(node as u32));
            if below.is_leaf().0 {
                return (below.index().0, probability);
            }
            let (first, count) = (below.index().0 as usize, below.count().0 as usize);
            self.weigh(receiver, first, count, &mut weights);
            let drawn = draw(&weights[..count], rest);
            node = first + drawn.index;
            probability *= drawn.probability;
            rest = drawn.rest;
        }
    }

    /// Estimates of neighbouring nodes; a register's worth more may be written behind them.
    #[inline(always)]
    fn weigh<L: Lanes>(&self, Receiver { l, p, n }: Receiver<L>, first: usize, count: usize, weights: &mut [f32]) {
        for at in (0..count).step_by(L::COUNT) {
            let node = (l.iota() + at as u32).min(count as u32 - 1) + first as u32;
            Node::gather(l, &self.nodes.words, node).illuminance(l, p, n).store(weights, at);
        }
    }
}
