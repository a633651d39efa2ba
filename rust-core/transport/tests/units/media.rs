//! Media against Beer and Lambert's law, lane for lane.

use gonio_accel::TransparentHit;
use gonio_simd::{Column, Lanes, One, PADDING, Rgb, Spectrum, WavelengthColumn, Wavelengths};
use gonio_transport::media::{
    set::{MediaColumns, MediaSet, Solid},
    shadow::OpticalDepth,
};
use gonio_transport::{Coefficients, Medium, MediumTable};

const GLASS: [f32; 3] = [0.3, 0.8, 1.5];
const WATER: [f32; 3] = [0.2, 0.1, 0.05];

fn light(colour: [f32; 3]) -> Spectrum<One> {
    Wavelengths::rgb(One).coefficient(Rgb::splat(One, colour))
}

/// A table as it is without wavelengths.
fn colour(table: &MediumTable) -> Coefficients<'_, One> {
    table.at(Wavelengths::rgb(One))
}

fn solid(colour: [f32; 3]) -> Option<Solid<One>> {
    Some(Solid { absorption: light(colour), row: 0 })
}

fn near(found: Spectrum<One>, right: impl Fn(usize) -> f64, what: &str) {
    let found = found.to_rgb();
    for (c, found) in [found.r.0, found.g.0, found.b.0].into_iter().enumerate() {
        assert!((f64::from(found) / right(c) - 1.0).abs() < 1e-5, "{what}: {found} for {}", right(c));
    }
}

/// Glass, water and their rows.
fn table() -> (MediumTable, [u32; 2]) {
    let mut table = MediumTable::default();
    let rows = [GLASS, WATER].map(|absorption| table.add(Medium { absorption, ..Medium::default() }));
    assert_eq!(table.add(Medium { absorption: GLASS, ..Medium::default() }), rows[0], "media that are alike share a row");
    (table, rows)
}

fn beer(metres: [f64; 2]) -> impl Fn(usize) -> f64 {
    move |c| (-metres[0] * f64::from(GLASS[c]) - metres[1] * f64::from(WATER[c])).exp()
}

#[test]
fn what_fills_meshes_adds_up_and_is_left_again() {
    let (table, [glass, water]) = table();
    let (yes, open) = (One.m(true), MediaSet::open(One));
    let both = open.entered(glass, yes).entered(water, yes);
    near(both.transmittance(colour(&table), One.f(2.0)), beer([2.0, 2.0]), "both");
    near(both.left(glass, yes).transmittance(colour(&table), One.f(2.0)), beer([0.0, 2.0]), "what is left of them");
    near(both.left(water, yes).left(glass, yes).transmittance(colour(&table), One.f(f32::MAX)), beer([0.0; 2]), "the open");
    assert!(!both.transmittance(colour(&table), One.f(f32::MAX)).is_lit().any(), "nothing comes through what has no end");
}

#[test]
fn each_body_of_a_medium_counts_and_strangers_are_not_left() {
    let (table, [glass, water]) = table();
    let yes = One.m(true);
    let mut media = MediaSet::open(One).left(glass, yes);
    for _ in 0..2 {
        media = media.entered(glass, yes);
    }
    near(media.left(water, yes).transmittance(colour(&table), One.f(1.0)), beer([2.0, 0.0]), "two bodies of glass");
    near(media.left(glass, yes).transmittance(colour(&table), One.f(1.0)), beer([1.0, 0.0]), "one of them");
    // Three have room.
    let full = media.entered(water, yes).entered(water, yes);
    near(full.transmittance(colour(&table), One.f(1.0)), beer([2.0, 1.0]), "three");
    near(full.left(glass, One.m(false)).transmittance(colour(&table), One.f(1.0)), beer([2.0, 1.0]), "lanes that were not chosen");
}

#[test]
fn solids_with_a_row_are_left_by_what_bends_rays_alone() {
    let (table, [glass, water]) = table();
    let (yes, no) = (One.m(true), One.m(false));
    let milk = Some(Solid { absorption: Spectrum::zero(One), row: glass });
    let filled = MediaSet::open(One).entered(water, yes).behind(milk, None, yes);
    near(filled.transmittance(colour(&table), One.f(1.0)), beer([1.0, 1.0]), "in the solid");
    near(filled.left(glass, yes).transmittance(colour(&table), One.f(1.0)), beer([1.0, 1.0]), "names of what fills are others");
    let out = filled.behind(milk, None, no);
    near(out.transmittance(colour(&table), One.f(1.0)), beer([0.0, 1.0]), "out of it");
    near(filled.towards(out, yes, yes).transmittance(colour(&table), One.f(1.0)), beer([1.0, 1.0]), "straight on");
    near(filled.towards(out, yes, no).transmittance(colour(&table), One.f(1.0)), beer([0.0, 1.0]), "bent");
    near(filled.behind(solid(WATER), None, yes).transmittance(colour(&table), One.f(1.0)), beer([0.0, 2.0]), "another solid in it");
}

#[test]
fn solids_take_the_place_of_what_is_before_them() {
    let (table, [_, water]) = table();
    let (yes, no) = (One.m(true), One.m(false));
    let inside = MediaSet::open(One).behind(solid(WATER), None, yes).behind(solid(GLASS), None, yes);
    near(inside.transmittance(colour(&table), One.f(1.0)), beer([1.0, 0.0]), "inside");
    near(inside.behind(solid(GLASS), None, no).transmittance(colour(&table), One.f(1.0)), beer([0.0; 2]), "behind");
    near(inside.transmittance(colour(&table), One.f(f32::MAX)), beer([0.0; 2]), "no solid is infinite");
    near(inside.behind(None, None, yes).transmittance(colour(&table), One.f(1.0)), beer([1.0, 0.0]), "behind a thin wall in it");
    // What fills a solid adds to it, and what goes straight on through its surface is in the filling alone.
    let (open, filled) = (MediaSet::open(One), MediaSet::open(One).behind(solid(GLASS), Some(water), yes));
    near(filled.transmittance(colour(&table), One.f(1.0)), beer([1.0, 1.0]), "a filled solid");
    near(open.towards(filled, yes, yes).transmittance(colour(&table), One.f(1.0)), beer([0.0, 1.0]), "straight on");
    near(open.towards(filled, yes, no).transmittance(colour(&table), One.f(1.0)), beer([1.0, 1.0]), "bent");
    near(open.towards(filled, no, no).transmittance(colour(&table), One.f(1.0)), beer([0.0; 2]), "before it");
}

/// A ray of 10 m that starts in water, enters glass at 2 m, leaves the water at 5 m and the glass at 9 m, whatever order its surfaces come in.
#[test]
fn optical_depth_is_that_of_the_segments() {
    let (table, [glass, water]) = table();
    let mut media = MediaColumns::new(PADDING);
    media.append(MediaSet::open(One).entered(water, One.m(true)), One.m(true), 0);
    let hit = |t: f32| TransparentHit { ray: 0, instance: 0, primitive: 0, u: 0.0, v: 0.0, t };
    let side = |x: f32| {
        let mut side = Column::new(1);
        side[0] = x;
        side
    };
    let mut crossings = [(glass, 2.0, 1.0), (water, 5.0, -1.0), (glass, 9.0, -1.0)];
    for _ in 0..3 {
        crossings.rotate_left(1);
        for end in [10.0, f32::MAX] {
            let mut depth = OpticalDepth::new(PADDING);
            for (row, t, sign) in crossings {
                depth.add(row, &[hit(t)], &side(sign));
            }
            depth.add_up(One, (&table, WavelengthColumn::default()), &media, &[end; PADDING], 1);
            near(depth.transmittance(One, 0), beer([7.0, 5.0]), "seven metres of glass, five of water");
        }
    }
}
