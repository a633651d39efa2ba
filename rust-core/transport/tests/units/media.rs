//! Media against Beer and Lambert's law, lane for lane.

use gonio_accel::TransparentHit;
use gonio_simd::{Column, Lanes, One, PADDING, Rgb, Spectrum};
use gonio_transport::media::{
    set::{MediaColumns, MediaSet},
    shadow::OpticalDepth,
};
use gonio_transport::{Medium, MediumTable};

const GLASS: [f32; 3] = [0.3, 0.8, 1.5];
const WATER: [f32; 3] = [0.2, 0.1, 0.05];

fn light(colour: [f32; 3]) -> Spectrum<One> {
    Spectrum::coefficient(Rgb::splat(One, colour))
}

fn near(found: Spectrum<One>, right: impl Fn(usize) -> f64, what: &str) {
    let found = found.to_rgb();
    for (c, found) in [found.r.0, found.g.0, found.b.0].into_iter().enumerate() {
        // What sums leave of media that were left is taken off as a hundred thousandth of them.
        assert!((f64::from(found) / right(c) - 1.0).abs() < 1e-4, "{what}: {found} for {}", right(c));
    }
}

#[test]
fn volumes_add_up_and_are_left_again() {
    let (enters, leaves) = (One.m(true), One.m(false));
    let both = MediaSet::open(One).behind(light(GLASS), enters, true).behind(light(WATER), enters, true);
    near(both.transmittance(One.f(2.0)), |c| (-2.0 * f64::from(GLASS[c] + WATER[c])).exp(), "both");
    let water = both.behind(light(GLASS), leaves, true);
    near(water.transmittance(One.f(2.0)), |c| (-2.0 * f64::from(WATER[c])).exp(), "what is left of them");
    // Nothing is left over that would darken what is infinitely far.
    near(water.behind(light(WATER), leaves, true).transmittance(One.f(f32::MAX)), |_| 1.0, "the open");
}

#[test]
fn solids_take_the_place_of_what_is_before_them() {
    let water = MediaSet::absorbing(light(WATER));
    near(water.behind(light(GLASS), One.m(true), false).transmittance(One.f(1.0)), |c| (-f64::from(GLASS[c])).exp(), "inside");
    near(water.behind(light(GLASS), One.m(false), false).transmittance(One.f(1.0)), |_| 1.0, "behind");
}

/// A ray of 10 m that starts in water, enters glass at 2 m, leaves the water at 5 m and the glass at 9 m, whatever order its surfaces come in.
#[test]
fn optical_depth_is_that_of_the_segments() {
    let mut table = MediumTable::default();
    let [glass, water] = [GLASS, WATER].map(|absorption| table.add(Medium { absorption }));
    assert_eq!(table.add(Medium { absorption: GLASS }), glass, "media that are alike share a row");
    let mut media = MediaColumns::new(PADDING);
    media.append(MediaSet::absorbing(light(WATER)), One.m(true), 0);
    let hit = |t: f32| TransparentHit { ray: 0, instance: 0, primitive: 0, u: 0.0, v: 0.0, t };
    let side = |x: f32| {
        let mut side = Column::new(1);
        side[0] = x;
        side
    };
    let mut crossings = [(glass, 2.0, 1.0), (water, 5.0, -1.0), (glass, 9.0, -1.0)];
    for _ in 0..3 {
        crossings.rotate_left(1);
        let mut depth = OpticalDepth::new(PADDING);
        depth.begin(One, &media, 1);
        for (row, t, sign) in crossings {
            depth.add(One, (&table, row), &[hit(t)], &side(sign));
        }
        let ends = [10.0; PADDING];
        near(depth.transmittance(One, &ends, 0), |c| (-7.0 * f64::from(GLASS[c]) - 5.0 * f64::from(WATER[c])).exp(), "ten metres");
    }
}
