//! Brick, Gabor, Radial Tiling, Wavelength and Blackbody against Cycles, between levels, and with awkward inputs.

mod common;

use common::{Group, Node, Numbers, hostile, inputs, run, table};
use gonio_nodes::{Blackbody, BrickTexture, GaborTexture, RadialTiling, RgbWhite, TilingPart, Wavelength};
use gonio_simd::Execution;

node!(BrickTexture, 8, 2);
node!(GaborTexture, 10, 3);
node!(RadialTiling, 4, 3);
node!(Wavelength, 1, 3);
node!(Blackbody, 1, 3);

/// Our results beside Cycles's, with the inputs, for the groups of a name at each level.
fn compare<K: Node<N, M>, const N: usize, const M: usize>(
    text: &str,
    node: impl Fn(&Group) -> K,
    mut check: impl FnMut(&Group, &[f32], [f32; M], &[f32]),
) {
    let groups = table(text);
    assert!(!groups.is_empty());
    for group in &groups {
        for execution in Execution::all() {
            for (own, (at, theirs)) in run(execution, &node(group), &inputs::<N>(group)).into_iter().zip(&group.points) {
                check(group, at, own, theirs);
            }
        }
    }
}

fn close(a: f32, b: f32, tolerance: f32) -> bool {
    (a - b).abs() <= tolerance * b.abs().max(1.0)
}

fn brick(group: &Group) -> BrickTexture {
    let word = |at: usize| &group.words[at];
    BrickTexture {
        offset: word(2).parse().expect("a number"),
        offset_frequency: word(3).parse().expect("a number"),
        squash: word(4).parse().expect("a number"),
        squash_frequency: word(5).parse().expect("a number"),
    }
}

#[test]
fn bricks_are_what_cycles_computes() {
    compare(include_str!("data/brick.txt"), brick, |group, at, [tint, mortar], theirs| {
        // The colours are red and green, the mortar blue.
        let own = [(1.0 - tint) * (1.0 - mortar), tint * (1.0 - mortar), mortar, mortar];
        assert!(own.iter().zip(theirs).all(|(a, b)| close(*a, *b, 1e-5)), "{:?} {at:?}: {own:?}, not {theirs:?}", group.words);
    });
}

fn gabor(group: &Group) -> GaborTexture {
    GaborTexture { dimensions: if group.words[2] == "2D" { 2 } else { 3 } }
}

#[test]
fn gabor_is_what_cycles_computes() {
    compare(include_str!("data/gabor.txt"), gabor, |group, at, own: [f32; 3], theirs| {
        let [value, phase, intensity] = own;
        assert!(close(value, theirs[0], 1e-5) && close(intensity, theirs[2], 1e-5), "{:?} {at:?}: {own:?}, not {theirs:?}", group.words);
        // The angle of a short vector is ill-defined.
        let turn = (phase - theirs[1]).abs();
        assert!(turn.min(1.0 - turn) * intensity < 1e-5, "{:?} {at:?}: {own:?}, not {theirs:?}", group.words);
    });
}

#[test]
fn tiles_are_what_cycles_computes() {
    for part in [TilingPart::Coordinates, TilingPart::Segment] {
        let node = |group: &Group| RadialTiling { normalize: group.words[2] == "1", part };
        compare(include_str!("data/radial_tiling.txt"), node, |group, at, own: [f32; 3], theirs| {
            let theirs = if part == TilingPart::Coordinates { [theirs[0], theirs[1], 0.0] } else { [theirs[2], theirs[3], theirs[4]] };
            assert!(own.iter().zip(theirs).all(|(a, b)| close(*a, b, 1e-5)), "{:?} {at:?}: {own:?}, not {theirs:?}", group.words);
        });
    }
}

#[test]
fn colors_are_what_cycles_computes() {
    let wavelength =
        |group: &Group| Wavelength { white: if group.words[1] == "pcg" { RgbWhite::Chromaticity } else { RgbWhite::Tristimulus } };
    compare(include_str!("data/wavelength.txt"), wavelength, |group, at, own: [f32; 3], theirs| {
        assert!(own.iter().zip(theirs).all(|(a, b)| close(*a, *b, 1e-5)), "{:?} {at:?}: {own:?}, not {theirs:?}", group.words);
    });
    compare(
        include_str!("data/blackbody.txt"),
        |_| Blackbody,
        |_, at, own: [f32; 3], theirs| {
            assert!(own.iter().zip(theirs).all(|(a, b)| close(*a, *b, 1e-5)), "{at:?}: {own:?}, not {theirs:?}");
        },
    );
}

/// The ranges of inputs in which nodes are compared between levels.
fn points<const N: usize>(ranges: [(f32, f32); N]) -> Vec<[f32; N]> {
    let mut numbers = Numbers(3);
    let mut points = Vec::new();
    for _ in 0..512 {
        points.push(ranges.map(|(low, high)| low + (high - low) * numbers.next()));
    }
    points
}

/// That levels agree but for a few steps by rounding, and that nothing awkward does harm.
fn stands<K: Node<N, M>, const N: usize, const M: usize>(node: &K, ranges: [(f32, f32); N]) {
    let points = points(ranges);
    let scalar = run(Execution::Scalar, node, &points);
    let awkward = hostile::<N>(256);
    for execution in Execution::all() {
        let own = run(execution, node, &points);
        let off = own.iter().zip(&scalar).filter(|(a, b)| !a.iter().zip(*b).all(|(a, b)| close(*a, *b, 1e-4))).count();
        assert!(off <= 2, "{off} points differ between levels");
        for (at, own) in awkward.iter().zip(run(execution, node, &awkward)) {
            let finite = at.iter().all(|value| value.is_finite());
            assert!(!finite || own.iter().all(|value| value.is_finite()), "{} {at:?}: {own:?}", execution.name());
        }
    }
}

#[test]
fn they_stand() {
    let at = (-5.0, 5.0);
    for offset_frequency in [0, 1, 3] {
        let brick = BrickTexture { offset: 0.3, offset_frequency, squash: 0.7, squash_frequency: 2 };
        stands(&brick, [at, at, (0.5, 4.0), (0.02, 0.1), (0.0, 1.0), (-0.5, 0.5), (0.3, 1.0), (0.2, 0.5)]);
    }
    for dimensions in [2, 3] {
        let unit = (-1.0, 1.0);
        stands(&GaborTexture { dimensions }, [at, at, at, (0.5, 2.0), (0.0, 5.0), (0.0, 1.0), (-3.0, 3.0), unit, unit, unit]);
    }
    for normalize in [false, true] {
        for part in [TilingPart::Coordinates, TilingPart::Segment] {
            stands(&RadialTiling { normalize, part }, [at, at, (2.1, 9.0), (0.0, 1.0)]);
        }
    }
    stands(&Wavelength { white: RgbWhite::Chromaticity }, [(300.0, 900.0)]);
    stands(&Blackbody, [(100.0, 15_000.0)]);
}
