//! Every primitive of the lanes at every level against plain scalar code.

use gonio_simd::{Execution, F, Lanes, M, U, dispatch};

const FLOATS: [f32; 32] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    -0.5,
    1.5,
    2.5,
    -2.5,
    3.7,
    -3.7,
    1e-40,
    -1e-40,
    f32::MIN_POSITIVE,
    f32::MAX,
    f32::MIN,
    f32::INFINITY,
    f32::NEG_INFINITY,
    f32::NAN,
    1e10,
    -1e10,
    8_388_607.5,
    8_388_609.0,
    -8_388_607.5,
    0.499_999_97,
    -0.499_999_97,
    1.0 / 3.0,
    -7.25,
    123.456,
    -0.001,
    2_147_483_520.0,
    -2_147_483_648.0,
];
const INTEGERS: [u32; 16] = [
    0,
    1,
    2,
    31,
    32,
    33,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_ffff,
    0xffff_fffe,
    0x0100_0001,
    0x8000_0080,
    0x8000_0081,
    0x00ff_ffff,
    12_345,
    0xdead_beef,
];

/// Pairs of values such that each meets each other one, a register at a time: `check` gets both registers and the scalar values by lane.
#[inline(always)]
fn pairs_of_floats<L: Lanes>(l: L, check: impl Fn(F<L>, F<L>, &[f32], &[f32])) {
    for shift in 0..FLOATS.len() {
        let turned: Vec<f32> = (0..FLOATS.len()).map(|i| FLOATS[(i + shift) % FLOATS.len()]).collect();
        for at in (0..FLOATS.len()).step_by(L::COUNT) {
            check(l.load(&FLOATS, at), l.load(&turned, at), &FLOATS[at..], &turned[at..]);
        }
    }
}
#[inline(always)]
fn pairs_of_integers<L: Lanes>(l: L, check: impl Fn(U<L>, U<L>, &[u32], &[u32])) {
    for shift in 0..INTEGERS.len() {
        let turned: Vec<u32> = (0..INTEGERS.len()).map(|i| INTEGERS[(i + shift) % INTEGERS.len()]).collect();
        for at in (0..INTEGERS.len()).step_by(L::COUNT) {
            check(l.load_integers(&INTEGERS, at), l.load_integers(&turned, at), &INTEGERS[at..], &turned[at..]);
        }
    }
}

/// Equal bits, or both NaN.
fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || (a.is_nan() && b.is_nan())
}
#[inline(always)]
fn floats_are<L: Lanes>(what: &str, got: F<L>, expected: impl Fn(usize) -> f32) {
    for (i, got) in got.to_array().into_iter().enumerate().take(L::COUNT) {
        assert!(same(got, expected(i)), "{what}, {} lanes, lane {i}: {got:?}, expected {:?}", L::COUNT, expected(i));
    }
}
#[inline(always)]
fn integers_are<L: Lanes>(what: &str, got: U<L>, expected: impl Fn(usize) -> u32) {
    for (i, got) in got.to_array().into_iter().enumerate().take(L::COUNT) {
        assert_eq!(got, expected(i), "{what}, {} lanes, lane {i}", L::COUNT);
    }
}
#[inline(always)]
fn mask_is<L: Lanes>(what: &str, got: M<L>, expected: impl Fn(usize) -> bool) {
    for i in 0..L::COUNT {
        assert_eq!(got.bits() >> i & 1 == 1, expected(i), "{what}, {} lanes, lane {i}", L::COUNT);
    }
    assert_eq!(got.bits() >> L::COUNT, 0, "{what}: bits beyond the lanes");
}

/// Runs a check at every level.
macro_rules! at_every_level {
    ($name:ident, $check:ident) => {
        #[test]
        fn $name() {
            for execution in Execution::all() {
                dispatch!(execution, l => $check(l));
            }
        }
    };
}

at_every_level!(float_arithmetic, check_float_arithmetic);
#[inline(always)]
fn check_float_arithmetic<L: Lanes>(l: L) {
    pairs_of_floats(l, |x, y, a, b| {
        floats_are("add", x + y, |i| a[i] + b[i]);
        floats_are("sub", x - y, |i| a[i] - b[i]);
        floats_are("mul", x * y, |i| a[i] * b[i]);
        floats_are("div", x / y, |i| a[i] / b[i]);
        floats_are("neg", -x, |i| -a[i]);
        floats_are("abs", x.abs(), |i| a[i].abs());
        floats_are("sqrt", x.sqrt(), |i| a[i].sqrt());
        floats_are("floor", x.floor(), |i| a[i].floor());
        floats_are("round", x.round(), |i| a[i].round_ties_even());
        floats_are("copysign", x.copysign(y), |i| a[i].copysign(b[i]));
        floats_are("bits", F::from_bits(x.to_bits()), |i| a[i]);
        integers_are("to_bits", x.to_bits(), |i| a[i].to_bits());
        let (low, high, sum) = (x.min(y).to_array(), x.max(y).to_array(), x.mul_add(y, x).to_array());
        for i in 0..L::COUNT {
            if !a[i].is_nan() && !b[i].is_nan() {
                // By value: which of two zeros wins is the hardware's affair.
                assert_eq!((low[i], high[i]), (a[i].min(b[i]), a[i].max(b[i])), "min and max of {} and {}", a[i], b[i]);
            }
            assert!(same(sum[i], a[i].mul_add(b[i], a[i])) || same(sum[i], a[i] * b[i] + a[i]), "{} * {} + itself", a[i], b[i]);
        }
    });
}

at_every_level!(float_comparisons, check_float_comparisons);
#[inline(always)]
fn check_float_comparisons<L: Lanes>(l: L) {
    pairs_of_floats(l, |x, y, a, b| {
        mask_is("lt", x.lt(y), |i| a[i] < b[i]);
        mask_is("le", x.le(y), |i| a[i] <= b[i]);
        mask_is("gt", x.gt(y), |i| a[i] > b[i]);
        mask_is("ge", x.ge(y), |i| a[i] >= b[i]);
        mask_is("eq", x.eq(y), |i| a[i] == b[i]);
        mask_is("is_finite", x.is_finite(), |i| a[i].is_finite());
        floats_are("select", x.lt(y).select(x, y), |i| if a[i] < b[i] { a[i] } else { b[i] });
        floats_are("keep_if", x.keep_if(x.lt(y)), |i| if a[i] < b[i] { a[i] } else { 0.0 });
    });
}

at_every_level!(integer_arithmetic, check_integer_arithmetic);
#[inline(always)]
fn check_integer_arithmetic<L: Lanes>(l: L) {
    pairs_of_integers(l, |x, y, a, b| {
        integers_are("add", x + y, |i| a[i].wrapping_add(b[i]));
        integers_are("sub", x - y, |i| a[i].wrapping_sub(b[i]));
        integers_are("mul", x * y, |i| a[i].wrapping_mul(b[i]));
        integers_are("and", x & y, |i| a[i] & b[i]);
        integers_are("or", x | y, |i| a[i] | b[i]);
        integers_are("xor", x ^ y, |i| a[i] ^ b[i]);
        integers_are("min", x.min(y), |i| a[i].min(b[i]));
        integers_are("max", x.max(y), |i| a[i].max(b[i]));
        integers_are("reverse_bits", x.reverse_bits(), |i| a[i].reverse_bits());
        mask_is("lt", x.lt(y), |i| a[i] < b[i]);
        mask_is("eq", x.eq(y), |i| a[i] == b[i]);
        mask_is("ne", x.ne(y), |i| a[i] != b[i]);
        integers_are("select", x.lt(y).select(x, y), |i| a[i].min(b[i]));
        for by in [0, 1, 7, 23, 31] {
            integers_are("shl", x << by, |i| a[i] << by);
            integers_are("shr", x >> by, |i| a[i] >> by);
            integers_are("sar", x.sar(by), |i| ((a[i] as i32) >> by) as u32);
        }
    });
}

at_every_level!(conversions, check_conversions);
#[inline(always)]
fn check_conversions<L: Lanes>(l: L) {
    pairs_of_integers(l, |x, _, a, _| {
        floats_are("unsigned to float", x.to_float(), |i| a[i] as f32);
        floats_are("signed to float", x.i32_to_float(), |i| a[i] as i32 as f32);
    });
    pairs_of_floats(l, |x, _, a, _| {
        let got = x.to_i32().to_array();
        for i in (0..L::COUNT).filter(|&i| a[i].abs() < 2_147_483_648.0) {
            assert_eq!(got[i], a[i] as i32 as u32, "{} to an integer", a[i]);
        }
    });
    floats_are("splat", l.f(2.5), |_| 2.5);
    integers_are("splat", l.u(77), |_| 77);
    integers_are("iota", l.iota(), |i| i as u32);
}

at_every_level!(masks, check_masks);
#[inline(always)]
fn check_masks<L: Lanes>(l: L) {
    for count in (0..=16).chain([63, 64, 100]) {
        let first = l.first(count);
        mask_is("first", first, |i| i < count);
        assert_eq!(first.count(), count.min(L::COUNT));
        assert_eq!((first.any(), first.all()), (count > 0, count >= L::COUNT));
        mask_is("not", !first, |i| i >= count);
        integers_are("to_integers", first.to_integers(), |i| u32::from(i < count));
        integers_are("count_if", l.iota().count_if(first), |i| i as u32 + u32::from(i < count));
        integers_are("to_ones", first.to_ones(), |i| if i < count { u32::MAX } else { 0 });
        for other in 0..=16 {
            let second = !l.first(other);
            mask_is("and", first & second, |i| i < count && i >= other);
            mask_is("or", first | second, |i| i < count || i >= other);
            mask_is("and_not", first.and_not(second), |i| i < count && i < other);
            mask_is("select", first.select(second, !second), |i| (i < count) == (i >= other));
        }
    }
    mask_is("true", l.m(true), |_| true);
    mask_is("false", l.m(false), |_| false);
}

at_every_level!(compaction, check_compaction);
#[inline(always)]
fn check_compaction<L: Lanes>(l: L) {
    let values = l.iota().to_float() + 0.5;
    for bits in 0..1_u64 << L::COUNT {
        let mask = M(l.mask_from_bits(bits));
        let (mut floats, mut integers) = ([-1.0; 40], [99; 40]);
        values.append(mask, &mut floats, 3);
        l.iota().append(mask, &mut integers, 3);
        let chosen = (0..L::COUNT as u32).filter(|i| bits >> i & 1 == 1);
        for (place, lane) in (3..).zip(chosen) {
            assert_eq!((floats[place], integers[place]), (lane as f32 + 0.5, lane), "mask {bits:b}, {} lanes", L::COUNT);
        }
        assert!(floats[..3].iter().chain(&floats[3 + L::COUNT..]).all(|x| *x == -1.0), "written outside the register's room");
        assert!(integers[..3].iter().chain(&integers[3 + L::COUNT..]).all(|x| *x == 99), "written outside the register's room");
        let mut items = [-1.0; 4 * 20];
        l.append_quads([values, values + 100.0, values + 200.0, values + 300.0], mask, &mut items, 2);
        let chosen = (0..L::COUNT).filter(|i| bits >> i & 1 == 1);
        for (place, lane) in (2..).zip(chosen) {
            let expected = [0.5, 100.5, 200.5, 300.5].map(|first| first + lane as f32);
            assert_eq!(items[4 * place..4 * place + 4], expected, "mask {bits:b}, {} lanes", L::COUNT);
        }
        assert!(items[..8].iter().chain(&items[4 * (2 + L::COUNT)..]).all(|x| *x == -1.0), "written outside the register's room");
    }
}

at_every_level!(table_reads, check_table_reads);
#[inline(always)]
fn check_table_reads<L: Lanes>(l: L) {
    for len in [1, 2, 3, 17, 1000] {
        let table: Vec<f32> = (0..len).map(|i| i as f32 * 1.5 - 3.0).collect();
        // NaN payloads must pass unharmed.
        let integers: Vec<u32> = (0..len).map(|i| 0x7f80_0001 ^ (i as u32).wrapping_mul(0x9e37_79b9)).collect();
        let last = len - 1;
        let ends = [last as u32, len as u32, u32::MAX, 0x8000_0000, 0x7fff_ffff, 0];
        for start in 0..ends.len() {
            let list: Vec<u32> = (0..16).map(|i| if i % 3 == 0 { ends[(start + i / 3) % 6] } else { (i * 61 % len) as u32 }).collect();
            let index = l.load_integers(&list, 0);
            floats_are("gather", l.gather(&table, index), |i| table[(list[i] as usize).min(last)]);
            integers_are("gather_integers", l.gather_integers(&integers, index), |i| integers[(list[i] as usize).min(last)]);
            if len > 1 {
                let [low, high] = l.gather_pairs(&table, index);
                floats_are("gather_pairs, low", low, |i| table[(list[i] as usize).min(last - 1)]);
                floats_are("gather_pairs, high", high, |i| table[(list[i] as usize).min(last - 1) + 1]);
            }
            if len > 3 {
                for (k, value) in l.gather_quads(&table, index).into_iter().enumerate() {
                    floats_are("gather_quads", value, |i| table[(list[i] as usize).min(last - 3) + k]);
                }
                for (k, value) in l.gather_integer_quads(&integers, index).into_iter().enumerate() {
                    integers_are("gather_integer_quads", value, |i| integers[(list[i] as usize).min(last - 3) + k]);
                }
            }
        }
    }
    let table: [f32; 32] = core::array::from_fn(|i| i as f32 * 0.25);
    pairs_of_integers(l, |_, y, _, b| floats_are("lookup32", l.lookup32(&table, y), |i| table[b[i] as usize % 32]));
    let items: [f32; 4 * 20] = core::array::from_fn(|i| i as f32);
    for at in 0..4 {
        for (k, value) in l.load_quads(&items, at).into_iter().enumerate() {
            floats_are("load_quads", value, |i| items[4 * (at + i) + k]);
        }
    }
    let mut stored = [-1.0; 4 * 20];
    l.store_quads(l.load_quads(&items, 1), &mut stored, 3);
    assert_eq!(stored[12..4 * (3 + L::COUNT)], items[4..4 * (1 + L::COUNT)], "{} lanes", L::COUNT);
    for at in 0..32 {
        floats_are("lookup32", l.lookup32(&table, l.iota() + at), |i| table[(i + at as usize) % 32]);
    }
}

at_every_level!(sums_of_octets, check_sums_of_octets);
#[inline(always)]
fn check_sums_of_octets<L: Lanes>(l: L) {
    for (len, offsets) in [(8, &[0][..]), (13, &[5, 0]), (1000, &[0, 4, 40, 44, 300, 304, 340, 344])] {
        // Small integers, whose sums are exact in any order.
        let table: Vec<f32> = (0..len).map(|i| (i * 37 % 101) as f32 - 50.0).collect();
        let last = len - 8 - offsets.iter().max().map_or(0, |most| *most as usize);
        let list: Vec<u32> = (0..16).map(|i| if i % 5 == 0 { u32::MAX - i } else { i * 61 % len as u32 }).collect();
        let weight = |term: usize, lane: usize| (term * 3 + lane) as f32 - 7.0;
        let weights: Vec<F<L>> = (0..offsets.len()).map(|term| l.iota().i32_to_float() + weight(term, 0)).collect();
        for (k, value) in l.sum_octets(&table, l.load_integers(&list, 0), offsets, &weights).into_iter().enumerate() {
            floats_are("sum_octets", value, |lane| {
                let first = (list[lane] as usize).min(last) + k;
                let terms = offsets.iter().enumerate().map(|(term, offset)| weight(term, lane) * table[first + *offset as usize]);
                // The empty sum of floats is -0.
                0.0 + terms.sum::<f32>()
            });
        }
    }
}

at_every_level!(loads_and_stores, check_loads_and_stores);
#[inline(always)]
fn check_loads_and_stores<L: Lanes>(l: L) {
    let source: Vec<f32> = (0..64).map(|i| i as f32).collect();
    let mut target = [-1.0; 64];
    l.load(&source, 5).store(&mut target, 7);
    for (i, x) in target.into_iter().enumerate() {
        let inside = (7..7 + L::COUNT).contains(&i);
        assert_eq!(x, if inside { (i - 2) as f32 } else { -1.0 }, "place {i}");
    }
    let integers = l.load_integers(&INTEGERS, 0);
    let mut target = [7; 32];
    integers.store(&mut target, 16);
    assert_eq!(target[16..16 + L::COUNT], INTEGERS[..L::COUNT]);
    assert!(target[..16].iter().chain(&target[16 + L::COUNT..]).all(|x| *x == 7));
    assert_eq!(l.vectorize(|| L::COUNT), L::COUNT);
}
