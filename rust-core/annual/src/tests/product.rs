//! Products against sums in double precision.

use crate::Panels;

/// Numbers from 0 to 1 by a rule.
fn numbers(count: usize, seed: u32) -> Vec<f32> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as f32 / (1 << 24) as f32
    };
    (0..count).map(|_| next()).collect()
}

#[test]
fn products_are_the_sums() {
    for (points, patches, steps, threads) in [(1, 1, 1, 1), (3, 146, 5, 2), (8, 63, 4, 3), (17, 578, 9, 4), (20, 2306, 3, 2)] {
        let (rows, columns) = (numbers(points * patches, 1), numbers(steps * patches, 2));
        let found = Panels::new(points, patches, &rows).times(&columns, threads);
        assert_eq!(found.len(), points * steps);
        for (point, row) in rows.chunks(patches).enumerate() {
            for (step, column) in columns.chunks(patches).enumerate() {
                let expected: f64 = row.iter().zip(column).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum();
                let value = f64::from(found[point * steps + step]);
                assert!((value / expected - 1.0).abs() < 2e-6, "{points} {patches}: {value} {expected}");
            }
        }
    }
}

#[test]
fn no_steps_make_no_products() {
    assert!(Panels::new(2, 3, &[1.0; 6]).times(&[], 2).is_empty());
}
