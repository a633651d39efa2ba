//! The comparisons: which pixels hold a discontinuity and along which side, and in which zones it lies.

use super::{
    Rule,
    places::CORNERS,
    samples::{CHANNELS, Samples},
    tables::{DISCONTINUITIES, QUADS, STEP_WEIGHT, VALUES, WEIGHTS},
};
use crate::camera::sampler::TILE;
use gonio_simd::{Column, F, Lanes, Rgb, U};

/// Places from one row of a tile's corners to the next.
pub(super) const STRIDE: usize = TILE + gonio_simd::PADDING;
/// Places of a tile's corners.
pub(super) const CORNER_ROOM: usize = (TILE + 1) * STRIDE;

/// What level one finds out about a pixel.
pub(super) mod kind {
    /// Nothing.
    pub(in crate::antialias) const EVEN: u32 = 0;
    /// A discontinuity between left and right, or one that only the visibility map knows of.
    pub(in crate::antialias) const UPRIGHT: u32 = 1;
    /// A discontinuity between above and below: the square is turned.
    pub(in crate::antialias) const TURNED: u32 = 2;
}

/// Pixels of level two.
#[derive(Debug, Default)]
pub(super) struct Suspects {
    /// Morton numbers of the pixels.
    pub(super) codes: Vec<u32>,
    /// Place of the corner A of the upright square.
    pub(super) corner: Vec<u32>,
    /// 1 where the square is turned.
    pub(super) turned: Vec<u32>,
    /// Bits of the zones to be traced.
    pub(super) zones: Vec<u32>,
}

impl Suspects {
    pub(super) fn clear(&mut self) {
        [&mut self.codes, &mut self.corner, &mut self.turned, &mut self.zones].into_iter().for_each(Vec::clear);
    }

    /// How many there are.
    pub(super) fn count(&self) -> usize {
        self.codes.len()
    }

    /// Pads the columns that kernels read to whole registers.
    pub(super) fn pad(&mut self) {
        let room = gonio_simd::padded(self.count());
        [&mut self.corner, &mut self.turned, &mut self.zones].into_iter().for_each(|column| column.resize(room, 0));
    }
}

/// The largest difference of the three channels.
#[inline(always)]
fn difference<L: Lanes>(a: Rgb<L>, b: Rgb<L>) -> F<L> {
    (a.r - b.r).abs().max((a.g - b.g).abs()).max((a.b - b.b).abs())
}

/// Level one: tells for every pixel of the tile whether its corners differ, row after row.
#[inline(always)]
pub(super) fn classify<L: Lanes>(l: L, rule: &Rule, corners: &Samples, kinds: &mut Column<u32>) {
    for at in (0..TILE * TILE).step_by(L::COUNT) {
        let first = at / TILE * STRIDE + at % TILE;
        let [a, b] = [0, 1].map(|x| corners.shown_at(l, first + x));
        let [c, d] = [0, 1].map(|x| corners.shown_at(l, first + STRIDE + x));
        let across = difference(a, b).max(difference(c, d));
        let down = difference(a, c).max(difference(b, d));
        let (left_right, up_down) = (across.gt(rule.first), down.gt(rule.first));
        let turned = if rule.steeper { up_down & (!left_right | down.gt(across)) } else { up_down.and_not(left_right) };
        let kind = turned.select(l.u(kind::TURNED), left_right.select(l.u(kind::UPRIGHT), l.u(kind::EVEN)));
        kind.store(kinds, at);
    }
}

/// Place of a corner of a pixel in the version of its square.
#[inline(always)]
fn corner_of<L: Lanes>(l: L, corner: U<L>, turned: U<L>, name: usize) -> U<L> {
    let step = |version: usize| CORNERS[version][name][1] * STRIDE as u32 + CORNERS[version][name][0];
    corner + turned.ne(0).select(l.u(step(1)), l.u(step(0)))
}

/// Level two: the zones of each suspect whose zigzags are to be traced.
#[inline(always)]
pub(super) fn find_zones<L: Lanes>(l: L, rule: &Rule, corners: &Samples, inner: &Samples, suspects: &mut Suspects) {
    for at in (0..suspects.count()).step_by(L::COUNT) {
        let (corner, turned) = (l.load_integers(&suspects.corner, at), l.load_integers(&suspects.turned, at));
        let first = (l.iota() + at as u32) << 2;
        let mut values = [Rgb::zero(l); VALUES];
        for (name, value) in values.iter_mut().enumerate() {
            *value = match name.checked_sub(4) {
                None => corners.shown_of(l, corner_of(l, corner, turned, name)),
                Some(name) => inner.shown_of(l, first + name as u32),
            };
        }
        let mut zones = l.u(0);
        for (quad, table) in QUADS.iter().zip(&DISCONTINUITIES) {
            let mut mask = l.u(0);
            for (bit, [one, other]) in quad.iter().enumerate() {
                let differs = difference(values[*one], values[*other]).gt(rule.second);
                mask = mask | differs.select(l.u(1 << bit), l.u(0));
            }
            zones = zones | l.gather_integers(table, mask);
        }
        zones.store(&mut suspects.zones, at);
    }
}

/// Means of each pixel's corners, row after row.
#[inline(always)]
pub(super) fn average<L: Lanes>(l: L, corners: &Samples, means: &mut [Column; CHANNELS]) {
    for (values, means) in corners.values.iter().zip(means) {
        for at in (0..TILE * TILE).step_by(L::COUNT) {
            let first = at / TILE * STRIDE + at % TILE;
            let rows = [first, first + STRIDE].map(|row| l.load(values, row) + l.load(values, row + 1));
            ((rows[0] + rows[1]) * 0.25).store(means, at);
        }
    }
}

/// The suspects' colours: what was traced and what is interpolated, by weights known in advance.
#[inline(always)]
pub(super) fn weigh<L: Lanes>(
    l: L,
    corners: &Samples,
    inner: &Samples,
    zigzags: &Samples,
    suspects: &Suspects,
    sums: &mut [Column; CHANNELS],
) {
    for at in (0..suspects.count()).step_by(L::COUNT) {
        let (corner, turned) = (l.load_integers(&suspects.corner, at), l.load_integers(&suspects.turned, at));
        let first = (l.iota() + at as u32) << 2;
        let row = l.load_integers(&suspects.zones, at) * VALUES as u32;
        for (channel, sums) in sums.iter_mut().enumerate() {
            let mut sum = l.load(&zigzags.values[channel], at) * STEP_WEIGHT;
            for name in 0..VALUES {
                let value = match name.checked_sub(4) {
                    None => l.gather(&corners.values[channel], corner_of(l, corner, turned, name)),
                    Some(name) => l.gather(&inner.values[channel], first + name as u32),
                };
                sum = value.mul_add(l.gather(&WEIGHTS, row + name as u32), sum);
            }
            sum.store(sums, at);
        }
    }
}
