//! Numbers without a pattern, the same in every run.

use gonio_simd::Column;

/// Entries of most stages' batches: inside the first two caches, as the renderer's batches are.
pub(super) const BATCH: usize = 4096;

/// Values in [0, 1) of an additive recurrence: the multiples of `step` modulo 1.
pub(super) fn column(step: f64) -> Column {
    column_of(step, BATCH)
}

/// So many of them.
fn column_of(step: f64, count: usize) -> Column {
    let mut column = Column::new(count);
    for (i, x) in column.iter_mut().enumerate() {
        *x = ((0.5 + i as f64 * step).fract() as f32).min(0.999_999_94);
    }
    column
}

/// Steps whose recurrences do not follow one another (roots of x⁴ = x + 1 and powers of their inverses, as in Roberts' R3 sequence).
pub(super) const STEPS: [f64; 3] = [0.819_172_513_4, 0.671_043_606_7, 0.549_700_477_9];

/// Three columns that fill the unit cube evenly.
pub(super) fn cube() -> [Column; 3] {
    STEPS.map(column)
}

/// The same with so many points.
pub(super) fn cube_of(count: usize) -> [Column; 3] {
    STEPS.map(|step| column_of(step, count))
}

/// Three empty columns.
pub(super) fn columns3() -> [Column; 3] {
    [Column::new(BATCH), Column::new(BATCH), Column::new(BATCH)]
}

/// A generator for scenes and rays (SplitMix64).
#[derive(Clone, Copy, Debug)]
pub(super) struct Random(pub(super) u64);

impl Random {
    /// A number in [0, 1).
    pub(super) fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u32 << 24) as f32
    }
}
