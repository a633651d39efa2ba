//! Densities on the unit square that depend on parameters, and their maps (Dupuy and Jakob 2018), on lanes.
//!
//! The reference is [`gonio_formats::bsdf::Warp`]: slices of bilinear densities and their cumulative sums, blended linearly.

use gonio_formats::bsdf;
use gonio_simd::{F, Lanes, Rgb, U};

/// Slices that are blended: two along each of two parameters.
pub(super) const MOST_SLICES: usize = 4;

/// Slices and their weights.
#[derive(Clone, Copy, Debug)]
pub(super) struct Blend<L: Lanes> {
    pub(super) slice: [U<L>; MOST_SLICES],
    pub(super) weight: [F<L>; MOST_SLICES],
    /// How many there are.
    pub(super) count: usize,
}

/// Functions on the unit square, bilinear between nodes: slices of rows of columns.
#[derive(Clone, Debug)]
pub(super) struct Interpolant {
    columns: usize,
    rows: usize,
    data: Vec<f32>,
}

/// The same of colours, four values a node.
#[derive(Clone, Debug)]
pub(super) struct ColourInterpolant {
    columns: usize,
    rows: usize,
    data: Vec<f32>,
}

/// A patch between four nodes: its first node, and the place inside it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch<L: Lanes> {
    pub(super) column: U<L>,
    pub(super) row: U<L>,
    pub(super) x: F<L>,
    pub(super) y: F<L>,
}

/// A density with the cumulative sums that its map needs. Each run of sums begins with 0.
#[derive(Clone, Debug)]
pub(super) struct Warp {
    density: Interpolant,
    marginal: Vec<f32>,
    conditional: Vec<f32>,
    /// Halvings of rows and columns until one is left.
    steps: [u32; 2],
}

impl<L: Lanes> Blend<L> {
    /// One slice alone.
    #[inline(always)]
    pub(super) fn one(slice: U<L>) -> Self {
        let l = slice.lanes();
        Self { slice: [slice; MOST_SLICES], weight: [l.f(1.0); MOST_SLICES], count: 1 }
    }

    /// The blend of one value of all slices of `stride` values.
    #[inline(always)]
    fn sum(&self, l: L, data: &[f32], stride: usize, at: U<L>) -> F<L> {
        let mut sum = l.f(0.0);
        for (slice, weight) in self.slice.iter().zip(&self.weight).take(self.count) {
            sum = l.gather(data, *slice * stride as u32 + at).mul_add(*weight, sum);
        }
        sum
    }
}

/// The patch around a place of a square of this many nodes.
#[inline(always)]
pub(super) fn patch<L: Lanes>(at: [F<L>; 2], columns: usize, rows: usize) -> Patch<L> {
    let ((column, x), (row, y)) = (between(at[0], columns), between(at[1], rows));
    Patch { column, row, x, y }
}

/// The node before a place on a line of nodes, and how far it is to the next.
#[inline(always)]
fn between<L: Lanes>(x: F<L>, nodes: usize) -> (U<L>, F<L>) {
    let x = x.saturate() * (nodes - 1) as f32;
    let low = x.to_i32().min(nodes as u32 - 2);
    (low, x - low.i32_to_float())
}

impl Interpolant {
    /// The reference's slices. `None` if there are 2³¹ values or more.
    pub(super) fn new(found: &bsdf::Interpolant) -> Option<Self> {
        i32::try_from(found.data.len() + 1).ok()?;
        let mut data = found.data.clone();
        data.push(0.0);
        Some(Self { columns: found.columns, rows: found.rows, data })
    }

    /// The value at a place.
    #[inline(always)]
    pub(super) fn eval<L: Lanes>(&self, l: L, at: [F<L>; 2], blend: &Blend<L>) -> F<L> {
        let patch = patch(at, self.columns, self.rows);
        let [left, right] = self.edges(l, &patch, blend);
        left.lerp(right, patch.x)
    }

    /// Values at the left and the right edge of a patch, at its `y`.
    #[inline(always)]
    fn edges<L: Lanes>(&self, l: L, patch: &Patch<L>, blend: &Blend<L>) -> [F<L>; 2] {
        let at = patch.row * self.columns as u32 + patch.column;
        let mut edges = [l.f(0.0); 2];
        for (slice, weight) in blend.slice.iter().zip(&blend.weight).take(blend.count) {
            let node = *slice * (self.rows * self.columns) as u32 + at;
            let lower = l.gather_pairs(&self.data, node);
            let upper = l.gather_pairs(&self.data, node + self.columns as u32);
            for side in 0..2 {
                edges[side] = lower[side].lerp(upper[side], patch.y).mul_add(*weight, edges[side]);
            }
        }
        edges
    }
}

impl ColourInterpolant {
    /// Colours of nodes, four values each. `None` if there are 2³¹ values or more.
    pub(super) fn new(columns: usize, rows: usize, data: Vec<f32>) -> Option<Self> {
        i32::try_from(data.len()).ok()?;
        Some(Self { columns, rows, data })
    }

    /// The colour at a place.
    #[inline(always)]
    pub(super) fn eval<L: Lanes>(&self, l: L, at: [F<L>; 2], blend: &Blend<L>) -> Rgb<L> {
        let Patch { column, row, x, y } = patch(at, self.columns, self.rows);
        let at = row * self.columns as u32 + column;
        let stride = (self.rows * self.columns) as u32;
        let corners =
            [(0, (1.0 - x) * (1.0 - y)), (1, x * (1.0 - y)), (self.columns as u32, (1.0 - x) * y), (self.columns as u32 + 1, x * y)];
        let mut sum = Rgb::zero(l);
        for (slice, weight) in blend.slice.iter().zip(&blend.weight).take(blend.count) {
            for (offset, share) in corners {
                let [r, g, b, _] = l.gather_quads(&self.data, (*slice * stride + at + offset) << 2);
                sum = Rgb::new(r, g, b).mul_add(*weight * share, sum);
            }
        }
        sum
    }
}

impl Warp {
    /// The reference's density and sums. `None` if there are 2³¹ values or more.
    pub(super) fn new(found: &bsdf::Warp) -> Option<Self> {
        let (columns, rows) = (found.density.columns, found.density.rows);
        let led = |sums: &[f32], run: usize| -> Vec<f32> {
            sums.chunks_exact(run).flat_map(|run| core::iter::once(0.0).chain(run.iter().copied())).collect()
        };
        let steps = [rows, columns].map(|nodes| usize::BITS - (nodes - 1).leading_zeros());
        Some(Self {
            density: Interpolant::new(&found.density)?,
            marginal: led(&found.marginal, rows - 1),
            conditional: led(&found.conditional, columns - 1),
            steps,
        })
    }

    /// The density at a place.
    #[inline(always)]
    pub(super) fn density<L: Lanes>(&self, l: L, at: [F<L>; 2], blend: &Blend<L>) -> F<L> {
        self.density.eval(l, at, blend)
    }

    /// Moves uniform places to the density.
    #[inline(always)]
    pub(super) fn sample<L: Lanes>(&self, l: L, u: [F<L>; 2], blend: &Blend<L>) -> [F<L>; 2] {
        let (columns, rows) = (self.density.columns as u32, self.density.rows as u32);
        let y = u[1] * self.marginal(l, l.u(rows - 1), blend);
        let row = last_below(
            l,
            rows - 2,
            self.steps[0],
            y,
            #[inline(always)]
            |i| self.marginal(l, i, blend),
        );
        let whole = l.u(columns - 1);
        let [r0, r1] = [self.conditional(l, row, whole, blend), self.conditional(l, row + 1, whole, blend)];
        let fy = sample_segment((y - self.marginal(l, row, blend)) * (rows - 1) as f32, r0, r1);

        let x = u[0] * r0.lerp(r1, fy);
        let column = last_below(
            l,
            columns - 2,
            self.steps[1],
            x,
            #[inline(always)]
            |c| self.along(l, [row, c], fy, blend),
        );
        let [left, right] = self.density.edges(l, &Patch { column, row, x: l.f(0.0), y: fy }, blend);
        let fx = sample_segment((x - self.along(l, [row, column], fy, blend)) * (columns - 1) as f32, left, right);
        [(column.i32_to_float() + fx) * ((columns - 1) as f32).recip(), (row.i32_to_float() + fy) * ((rows - 1) as f32).recip()]
    }

    /// [`Self::sample`] undone: the uniform place and the density.
    #[inline(always)]
    pub(super) fn invert<L: Lanes>(&self, l: L, at: [F<L>; 2], blend: &Blend<L>) -> ([F<L>; 2], F<L>) {
        let (columns, rows) = (self.density.columns as u32, self.density.rows as u32);
        let patch = patch(at, self.density.columns, self.density.rows);
        let [left, right] = self.density.edges(l, &patch, blend);
        let whole = l.u(columns - 1);
        let [r0, r1] = [self.conditional(l, patch.row, whole, blend), self.conditional(l, patch.row + 1, whole, blend)];
        let before = self.along(l, [patch.row, patch.column], patch.y, blend);
        let x = segment_integral(patch.x, left, right).mul_add(((columns - 1) as f32).recip(), before);
        let y = segment_integral(patch.y, r0, r1).mul_add(((rows - 1) as f32).recip(), self.marginal(l, patch.row, blend));
        let whole = [r0.lerp(r1, patch.y), self.marginal(l, l.u(rows - 1), blend)];
        ([x.share_of(whole[0]).saturate(), y.share_of(whole[1]).saturate()], left.lerp(right, patch.x))
    }

    /// The integral at a place between a row and the next, over the first columns of patches.
    #[inline(always)]
    fn along<L: Lanes>(&self, l: L, [row, columns]: [U<L>; 2], y: F<L>, blend: &Blend<L>) -> F<L> {
        self.conditional(l, row, columns, blend).lerp(self.conditional(l, row + 1, columns, blend), y)
    }

    /// The integral over the first `rows` rows of patches.
    #[inline(always)]
    fn marginal<L: Lanes>(&self, l: L, rows: U<L>, blend: &Blend<L>) -> F<L> {
        blend.sum(l, &self.marginal, self.density.rows, rows)
    }

    /// The integral along a row of nodes over the first `columns` columns of patches.
    #[inline(always)]
    fn conditional<L: Lanes>(&self, l: L, row: U<L>, columns: U<L>, blend: &Blend<L>) -> F<L> {
        let width = self.density.columns;
        blend.sum(l, &self.conditional, self.density.rows * width, row * width as u32 + columns)
    }
}

/// The last number up to `last` whose sum is below `x`, or 0; sums do not decrease.
#[inline(always)]
fn last_below<L: Lanes>(l: L, last: u32, steps: u32, x: F<L>, sum: impl Fn(U<L>) -> F<L>) -> U<L> {
    let mut found = l.u(0);
    for step in (0..steps).rev() {
        let next = found + (1 << step);
        let below = next.lt(last + 1) & sum(next.min(last)).lt(x);
        found = below.select(next, found);
    }
    found
}

/// The integral from 0 to `x` of a linear function with these ends.
#[inline(always)]
fn segment_integral<L: Lanes>(x: F<L>, v0: F<L>, v1: F<L>) -> F<L> {
    x * v0.lerp(v1, x * 0.5)
}

/// Where the integral of a linear function with these ends reaches `area`.
#[inline(always)]
fn sample_segment<L: Lanes>(area: F<L>, v0: F<L>, v1: F<L>) -> F<L> {
    // The root without cancellation when the ends are nearly equal.
    let root = v0.mul_add(v0, area * 2.0 * (v1 - v0)).max(0.0).sqrt();
    let sum = v0 + root;
    (area * 2.0 / sum.max(f32::MIN_POSITIVE)).saturate().keep_if(sum.gt(0.0))
}
