//! Tables against a plain search and plain interpolation.

use super::{Axis, Colours, Table};
use gonio_simd::{Column, Execution, Lanes, dispatch};

/// Uniform numbers in [0, 1): a counter through a 64-bit mixer (SplitMix64).
fn uniform(counter: u64) -> f32 {
    let mut z = counter.wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((z ^ (z >> 31)) >> 40) as f32 / (1 << 24) as f32
}

/// Knots at uneven steps, some of them a thousand times as long as others.
fn knots(count: usize, seed: u64) -> Vec<f32> {
    let step = |i: usize| 10.0_f32.powf(-3.0 * uniform(seed + i as u64));
    (0..count).scan(-1.0, |knot, i| Some(std::mem::replace(knot, *knot + step(i)))).collect()
}

fn interval(knots: &[f32], x: f32) -> (usize, f32) {
    let index = knots.partition_point(|knot| *knot <= x).saturating_sub(1).min(knots.len().saturating_sub(2));
    let Some(next) = knots.get(index + 1) else { return (0, 0.0) };
    (index, ((x - knots[index]) / (next - knots[index])).clamp(0.0, 1.0))
}

/// Values inside, at knots, and beyond the ends.
fn places(knots: &[f32]) -> Vec<f32> {
    let [first, last] = [knots[0], knots[knots.len() - 1]];
    let between = (0..2000).map(|i| first - 0.1 + (last - first + 0.2) * uniform(977 + i));
    knots.iter().copied().chain(between).chain([-1e30, 1e30, f32::INFINITY, f32::NEG_INFINITY]).collect()
}

#[inline(always)]
fn locate<L: Lanes>(l: L, axis: &Axis, x: &Column, index: &mut Column<u32>, fraction: &mut Column) {
    for at in (0..x.len()).step_by(L::COUNT) {
        let place = axis.locate(l, l.load(x, at));
        place.index.store(index, at);
        place.fraction.store(fraction, at);
    }
}

#[test]
fn every_value_is_found_on_axes_of_any_length() {
    for count in [1, 2, 3, 7, 17, 32, 33, 34, 64, 65, 181, 721, 3000] {
        let knots = knots(count, 13);
        let axis = Axis::new(knots.clone()).expect("increasing knots");
        let values = places(&knots);
        let mut x = Column::new(values.len().next_multiple_of(16));
        x[..values.len()].copy_from_slice(&values);
        let (mut index, mut fraction) = (Column::<u32>::new(x.len()), Column::new(x.len()));
        for execution in Execution::all() {
            dispatch!(execution, l => locate(l, &axis, &x, &mut index, &mut fraction));
            for (i, value) in values.iter().enumerate() {
                let (expected, part) = interval(&knots, *value);
                assert_eq!(index[i] as usize, expected, "{value} among {count} knots");
                assert!((fraction[i] - part).abs() < 1e-5, "{value} among {count} knots: {} for {part}", fraction[i]);
            }
        }
    }
}

#[test]
fn axes_without_order_are_refused() {
    for bad in [vec![], vec![0.0, 0.0], vec![1.0, 0.5], vec![0.0, f32::NAN], vec![0.0, f32::INFINITY]] {
        assert!(Axis::new(bad.clone()).is_none(), "{bad:?}");
    }
    let axis = || Axis::new(vec![0.0, 1.0]).expect("increasing knots");
    assert!(Table::new([axis(), axis()], vec![0.0; 3]).is_none());
}

#[inline(always)]
fn look_up<L: Lanes>(l: L, table: &Table<4>, places: &[Column; 4], out: &mut Column) {
    for at in (0..out.len()).step_by(L::COUNT) {
        let place = [l.load(&places[0], at), l.load(&places[1], at), l.load(&places[2], at), l.load(&places[3], at)];
        table.value(l, place).store(out, at);
    }
}

/// Multilinear interpolation in double precision, axis by axis.
fn multilinear(axes: &[Vec<f32>; 4], values: &[f32], place: [f32; 4]) -> f64 {
    let intervals: Vec<(usize, f32)> = axes.iter().zip(place).map(|(knots, x)| interval(knots, x)).collect();
    (0..16)
        .map(|corner: usize| {
            let (mut at, mut weight) = (0, 1.0);
            for (axis, (index, fraction)) in intervals.iter().enumerate() {
                let upper = corner >> axis & 1;
                at = at * axes[axis].len() + (index + upper).min(axes[axis].len() - 1);
                weight *= f64::from(if upper == 1 { *fraction } else { 1.0 - fraction });
            }
            f64::from(values[at]) * weight
        })
        .sum()
}

#[test]
fn values_are_linear_between_uneven_knots() {
    for sizes in [[17, 7, 17, 13], [1, 5, 1, 4], [3, 2, 6, 1], [40, 1, 90, 2]] {
        let axes: [Vec<f32>; 4] = std::array::from_fn(|k| knots(sizes[k], 100 * k as u64));
        let values: Vec<f32> = (0..sizes.iter().product()).map(|i: usize| uniform(5000 + i as u64)).collect();
        let lists = axes.clone().map(|knots| Axis::new(knots).expect("increasing knots"));
        let table = Table::new(lists, values.clone()).expect("a value for each cell");
        let count = 1024;
        let mut out = Column::new(count);
        let places: [Column; 4] = std::array::from_fn(|k| {
            let mut column = Column::new(count);
            let (low, high) = (axes[k][0] - 0.1, axes[k][sizes[k] - 1] + 0.1);
            column.iter_mut().enumerate().for_each(|(i, x)| *x = low + (high - low) * uniform((9 * i + k) as u64));
            column
        });
        for execution in Execution::all() {
            dispatch!(execution, l => look_up(l, &table, &places, &mut out));
            for i in 0..count {
                let expected = multilinear(&axes, &values, [0, 1, 2, 3].map(|k| places[k][i]));
                assert!((f64::from(out[i]) - expected).abs() < 2e-5, "{sizes:?} {i}: {} for {expected}", out[i]);
            }
        }
    }
}

/// Where single values are found, at the scalar level: interval and fraction.
fn place(axis: &Axis, x: f32) -> (u32, f32) {
    let mut values = Column::new(16);
    values.fill(x);
    let (mut index, mut fraction) = (Column::<u32>::new(16), Column::new(16));
    dispatch!(Execution::Scalar, l => locate(l, axis, &values, &mut index, &mut fraction));
    (index[0], fraction[0])
}

#[test]
fn angles_are_brought_to_the_knots() {
    let near = |found: (u32, f32), expected: (u32, f32)| found.0 == expected.0 && (found.1 - expected.1).abs() < 1e-5;
    let periodic = Axis::periodic(vec![0.0, 1.0, 2.5], 4.0).expect("increasing knots");
    for (x, expected) in [(-0.5, (2, 2.0 / 3.0)), (0.25, (0, 0.25)), (3.25, (2, 0.5)), (8.5, (0, 0.5)), (-4.0, (0, 0.0))] {
        assert!(near(place(&periodic, x), expected), "{x}: {:?} for {expected:?}", place(&periodic, x));
    }
    let turning = Axis::new(vec![-0.5, 1.5]).expect("increasing knots").turning();
    for (x, expected) in [(0.5, (0, 0.5)), (6.0, (0, 0.108_407_35)), (2.0, (0, 1.0)), (5.0, (0, 0.0)), (-5.0, (0, 0.891_592_6))] {
        assert!(near(place(&turning, x), expected), "{x}: {:?} for {expected:?}", place(&turning, x));
    }
    let nearest = Axis::new(vec![0.0, 1.0, 2.0]).expect("increasing knots").nearest();
    assert!(place(&nearest, 0.4) == (0, 0.0) && place(&nearest, 0.6) == (0, 1.0) && place(&nearest, 1.7) == (1, 1.0));
    assert!(Axis::periodic(vec![0.0, 4.0], 4.0).is_none() && Axis::periodic(Vec::new(), 1.0).is_none());
}

#[inline(always)]
fn colour<L: Lanes>(l: L, table: &Colours<2>, place: [f32; 2], out: &mut [f32; 4]) {
    let (value, known) = table.value(l, [l.f(place[0]), l.f(place[1])]);
    *out = [value.r, value.g, value.b, known].map(|x| x.to_array()[0]);
}

#[test]
fn unknown_cells_weigh_nothing() {
    let axes = [Axis::new(vec![0.0, 1.0]).expect("increasing knots"), Axis::periodic(vec![0.0, 1.0], 2.0).expect("increasing knots")];
    // Cells (0, 0), (0, 1), (1, 0), (1, 1); the last is unknown.
    let table = Colours::new(axes, |cell| (cell < 3).then_some([cell as f32, 1.0, 2.0 * cell as f32])).expect("a small table");
    assert!(table.has_gaps());
    let expected = [
        ([0.0, 0.5], [0.5, 1.0, 1.0, 1.0]),
        ([0.5, 0.0], [1.0, 1.0, 2.0, 1.0]),
        // Of the four corners the three known ones.
        ([0.5, 1.5], [1.0, 1.0, 2.0, 0.75]),
        ([1.0, 1.0], [0.0; 4]),
    ];
    for execution in Execution::all() {
        for (place, expected) in expected {
            let mut found = [0.0; 4];
            dispatch!(execution, l => colour(l, &table, place, &mut found));
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-5), "{place:?}: {found:?} for {expected:?}");
        }
    }
}
