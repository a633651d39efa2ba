//! Lookups on lanes against a plain implementation in `f64`.

use super::made::{Random, build, bytes, floats, halves};
use crate::colour::{ColourSpace, Stated, Transfer};
use crate::texture::{Filter, MipMap, TextureTable, Wrap};
use gonio_simd::{Execution, Lanes, PADDING, Vec2, dispatch};
use std::sync::Arc;

const WRAPS: [Wrap; 4] = [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror, Wrap::Black];

/// Lookups of one texture: u, v and footprints in; RGBA out.
pub(super) struct Batch {
    pub(super) columns: [Vec<f32>; 3],
    pub(super) rgba: [Vec<f32>; 4],
}

impl Batch {
    pub(super) fn new(lookups: &[[f32; 3]]) -> Self {
        let len = lookups.len().next_multiple_of(PADDING);
        let column = |k: usize| (0..len).map(|i| lookups[i % lookups.len()][k]).collect();
        Self { columns: [column(0), column(1), column(2)], rgba: std::array::from_fn(|_| vec![f32::NAN; len]) }
    }

    pub(super) fn run(&mut self, execution: Execution, table: &TextureTable, wrap: [Wrap; 2], filter: Filter) {
        dispatch!(execution, l => sample_batch(l, self, table, wrap, filter));
    }
}

#[inline(always)]
fn sample_batch<L: Lanes>(l: L, batch: &mut Batch, table: &TextureTable, wrap: [Wrap; 2], filter: Filter) {
    for i in (0..batch.columns[0].len()).step_by(L::COUNT) {
        let uv = Vec2 { x: l.load(&batch.columns[0], i), y: l.load(&batch.columns[1], i) };
        let rgba = table.sample(l, 0, uv, l.load(&batch.columns[2], i), wrap, filter);
        for (channel, column) in rgba.into_iter().zip(&mut batch.rgba) {
            channel.store(column, i);
        }
    }
}

/// The texel's place in the image, or nothing where it is black.
fn wrapped(wrap: Wrap, texel: i64, size: i64) -> Option<usize> {
    let inside = match wrap {
        Wrap::Repeat => texel.rem_euclid(size),
        Wrap::Clamp => texel.clamp(0, size - 1),
        Wrap::Mirror => {
            let folded = texel.rem_euclid(2 * size);
            if folded < size { folded } else { 2 * size - 1 - folded }
        }
        Wrap::Black => Some(texel).filter(|t| (0..size).contains(t))?,
    };
    Some(inside as usize)
}

fn bilinear(map: &MipMap, level: usize, [u, v]: [f64; 2], wrap: [Wrap; 2]) -> [f64; 4] {
    let size = [f64::from(map.levels.widths[level]), f64::from(map.levels.heights[level])];
    let (x, y) = (u * size[0] - 0.5, (1.0 - v) * size[1] - 0.5);
    let mut sum = [0.0; 4];
    for dy in 0..2 {
        for dx in 0..2 {
            let share = |c: f64, upper: i32| if upper == 1 { c - c.floor() } else { 1.0 - (c - c.floor()) };
            let place = |c: f64, upper: i32, axis: usize| wrapped(wrap[axis], c.floor() as i64 + i64::from(upper), size[axis] as i64);
            let (Some(tx), Some(ty)) = (place(x, dx, 0), place(y, dy, 1)) else { continue };
            let texel = map.texel(level, tx, ty).unwrap();
            for (s, value) in sum.iter_mut().zip(texel) {
                *s += share(x, dx) * share(y, dy) * f64::from(value);
            }
        }
    }
    sum
}

fn trilinear(map: &MipMap, [u, v, width]: [f64; 3], wrap: [Wrap; 2]) -> [f64; 4] {
    let is_beyond = [u, v].iter().zip(wrap).any(|(x, wrap)| wrap == Wrap::Clamp && !(0.0..=1.0).contains(x));
    let width = if is_beyond { 0.0 } else { width };
    let last = (map.level_count() - 1) as f64;
    let level = (width * f64::from(map.resolution().into_iter().max().unwrap())).max(1.0).log2().min(last);
    let (finer, coarser) = (level.floor(), (level.floor() + 1.0).min(last));
    let (a, b) = (bilinear(map, finer as usize, [u, v], wrap), bilinear(map, coarser as usize, [u, v], wrap));
    std::array::from_fn(|c| a[c] + (b[c] - a[c]) * (level - finer))
}

fn lookups(count: usize) -> Vec<[f32; 3]> {
    let mut random = Random(17);
    (0..count)
        .map(|i| {
            let (u, v) = (random.unit() * 6.0 - 3.0, random.unit() * 6.0 - 3.0);
            let width = if i % 3 == 0 { 0.0 } else { (random.unit() * 12.0 - 9.0).exp2() };
            [u, v, width]
        })
        .collect()
}

#[test]
fn lookups_agree_with_the_oracle_at_every_level() {
    let lookups = lookups(400);
    let maps = [
        build(&bytes(16, 16, 4, 1), ColourSpace::SRGB_TEXTURE),
        build(&bytes(13, 9, 3, 2), ColourSpace::G22),
        build(&bytes(1, 7, 2, 3), ColourSpace::Raw),
        build(&halves(33, 20, 4, 4), ColourSpace::Raw),
        build(&floats(20, 31, 1, 5), ColourSpace::Raw),
        build(&floats(12, 12, 4, 6), ColourSpace::Raw),
        build(&bytes(1, 1, 3, 7), ColourSpace::SRGB_TEXTURE),
    ];
    for map in maps {
        let map = Arc::new(map);
        let mut table = TextureTable::new();
        table.push(map.clone());
        for wrap in WRAPS.map(|wrap| [wrap, wrap]).into_iter().chain([[Wrap::Repeat, Wrap::Clamp], [Wrap::Black, Wrap::Mirror]]) {
            for execution in Execution::all() {
                let mut batch = Batch::new(&lookups);
                batch.run(execution, &table, wrap, Filter::Trilinear);
                for (i, lookup) in lookups.iter().enumerate() {
                    let expected = trilinear(&map, lookup.map(f64::from), wrap);
                    for (channel, exact) in expected.into_iter().enumerate() {
                        let found = f64::from(batch.rgba[channel][i]);
                        // A coordinate near 3 is rounded by 2e-7, times 33 texels, times a contrast of 1.
                        assert!(
                            (found - exact).abs() < 3e-5,
                            "{} {wrap:?} {lookup:?} {:?} {channel}: {found}, not {exact}",
                            execution.name(),
                            map.format()
                        );
                    }
                }
            }
        }
    }
}

#[test]
fn codes_are_mixed_in_the_finest_level_and_light_in_the_others() {
    let image = bytes(16, 16, 4, 1);
    let [codes, light] = [ColourSpace::Raw, ColourSpace::SRGB_TEXTURE].map(|space| Arc::new(build(&image, space)));
    let mut table = TextureTable::new();
    table.push(light.clone());
    let lookups = lookups(400);
    for execution in Execution::all() {
        let mut batch = Batch::new(&lookups);
        batch.run(execution, &table, [Wrap::Repeat; 2], Filter::TrilinearCodes);
        for (i, lookup) in lookups.iter().map(|lookup| lookup.map(f64::from)).enumerate() {
            let is_finest = lookup[2] * 16.0 <= 1.0;
            let expected = if is_finest {
                let [r, g, b, a] = bilinear(&codes, 0, [lookup[0], lookup[1]], [Wrap::Repeat; 2]);
                let [r, g, b] = [r, g, b].map(|x| Transfer::Srgb.decode(x));
                [r, g, b, a]
            } else {
                trilinear(&light, lookup, [Wrap::Repeat; 2])
            };
            for (channel, exact) in expected.into_iter().enumerate() {
                let found = f64::from(batch.rgba[channel][i]);
                assert!((found - exact).abs() < 3e-5, "{} {lookup:?} {channel}: {found}, not {exact}", execution.name());
            }
        }
    }
}

#[test]
fn every_finite_half_is_read_exactly() {
    let values: Vec<_> = (0..=u16::MAX).map(half::f16::from_bits).map(|x| if x.is_finite() { x } else { half::f16::ONE }).collect();
    let expected: Vec<_> = values.iter().map(|x| x.to_f32()).collect();
    let texels = crate::texture::Texels::Half(values);
    let map = build(&crate::texture::Image { width: 16_384, height: 1, channels: 4, texels, stated: Stated::Nothing }, ColourSpace::Raw);
    let mut table = TextureTable::new();
    table.push(Arc::new(map));
    let lookups: Vec<_> = (0..16_384).map(|i| [(i as f32 + 0.5) / 16_384.0, 0.5, 0.0]).collect();
    for execution in Execution::all() {
        let mut batch = Batch::new(&lookups);
        batch.run(execution, &table, [Wrap::Clamp; 2], Filter::Nearest);
        for (i, exact) in expected.iter().enumerate() {
            assert_eq!(batch.rgba[i % 4][i / 4].to_bits(), exact.to_bits(), "{} {i:#x}", execution.name());
        }
    }
}

#[test]
fn nearest_takes_the_texel_in_which_the_point_lies() {
    let map = Arc::new(build(&floats(5, 3, 3, 9), ColourSpace::Raw));
    let mut table = TextureTable::new();
    table.push(map.clone());
    let lookups = lookups(300);
    for wrap in WRAPS {
        for execution in Execution::all() {
            let mut batch = Batch::new(&lookups);
            batch.run(execution, &table, [wrap; 2], Filter::Nearest);
            for (i, [u, v, _]) in lookups.iter().enumerate() {
                let place = |c: f32, size: i64| wrapped(wrap, (f64::from(c) * size as f64).floor() as i64, size);
                let expected = match (place(*u, 5), place(1.0 - *v, 3)) {
                    (Some(x), Some(y)) => map.texel(0, x, y).unwrap(),
                    _ => [0.0; 4],
                };
                assert_eq!([0, 1, 2, 3].map(|c| batch.rgba[c][i]), expected, "{} {wrap:?} {u} {v}", execution.name());
            }
        }
    }
}

#[test]
fn the_origin_is_the_bottom_left() {
    // Two texels, the top one bright.
    let image = crate::texture::Image {
        width: 1,
        height: 2,
        channels: 1,
        texels: crate::texture::Texels::Byte(vec![255, 0]),
        stated: Stated::Nothing,
    };
    let mut table = TextureTable::new();
    table.push(Arc::new(build(&image, ColourSpace::Raw)));
    let mut batch = Batch::new(&[[0.5, 0.1, 0.0], [0.5, 0.9, 0.0]]);
    batch.run(Execution::best(), &table, [Wrap::Clamp; 2], Filter::Trilinear);
    assert_eq!((batch.rgba[0][0], batch.rgba[0][1], batch.rgba[3][0]), (0.0, 1.0, 1.0));
}

#[test]
fn odd_arguments_are_safe() {
    let odd = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, f32::MAX, -f32::MAX, 1e9, -1e9, -1e-30, -0.0, 1.0, 16_777_217.0];
    let mut lookups = Vec::new();
    for u in odd {
        for v in odd {
            lookups.extend(odd.map(|width| [u, v, width]));
        }
    }
    for image in [bytes(7, 5, 3, 1), floats(7, 5, 3, 1), floats(7, 5, 1, 1), halves(7, 5, 3, 1)] {
        let map = Arc::new(build(&image, ColourSpace::Raw));
        let (mut table, mut tiles) = (TextureTable::new(), TextureTable::new());
        table.push(map.clone());
        tiles.push_tiles([(1001, map.clone()), (1013, map)]);
        for wrap in WRAPS {
            for filter in [Filter::Trilinear, Filter::Nearest] {
                for (execution, table) in Execution::all().into_iter().flat_map(|execution| [(execution, &table), (execution, &tiles)]) {
                    let mut batch = Batch::new(&lookups);
                    batch.run(execution, table, [wrap; 2], filter);
                    // A weighted mean of values in [0, 1], whatever the arguments.
                    assert!(batch.rgba.iter().flatten().all(|x| (-1e-6..=1.00001).contains(x)), "{} {wrap:?}", execution.name());
                }
            }
        }
    }
}

#[test]
fn tiles_are_found_by_their_numbers() {
    let flat = |code: u8| {
        Arc::new(build(
            &crate::texture::Image {
                width: 1,
                height: 1,
                channels: 1,
                texels: crate::texture::Texels::Byte(vec![code]),
                stated: Stated::Nothing,
            },
            ColourSpace::Raw,
        ))
    };
    let mut table = TextureTable::new();
    table.push_tiles([(1001, flat(51)), (1002, flat(102)), (1012, flat(153)), (1000, flat(9)), (10_000, flat(9))]);
    let cases = [
        ([0.5, 0.5], 0.2),
        ([1.5, 0.5], 0.4),
        ([1.5, 1.5], 0.6),
        ([0.5, 1.5], 0.0),
        ([-0.5, 0.5], 0.0),
        ([10.5, 0.5], 0.0),
        ([0.5, 99.5], 0.0),
        ([f32::NAN, 0.5], 0.0),
    ];
    for execution in Execution::all() {
        let mut batch = Batch::new(&cases.map(|([u, v], _)| [u, v, 0.01]));
        batch.run(execution, &table, [Wrap::Repeat; 2], Filter::Trilinear);
        for (i, (uv, expected)) in cases.into_iter().enumerate() {
            assert!((batch.rgba[1][i] - expected).abs() < 1e-6, "{} {uv:?}: {}", execution.name(), batch.rgba[1][i]);
            assert_eq!(batch.rgba[3][i], if expected > 0.0 { 1.0 } else { 0.0 });
        }
    }
    assert_eq!((table.len(), table.resolution(0)), (1, [1, 1]));
}
