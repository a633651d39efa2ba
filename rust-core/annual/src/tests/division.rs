//! Tregenza's and Reinhart's divisions by closed forms.

use crate::Division;
use std::f64::consts::{PI, TAU};

fn all() -> impl Iterator<Item = Division> {
    (1..=6).map(|factor| Division::new(factor).expect("a division"))
}

#[test]
fn patches_are_as_many_as_radiance_has() {
    let counts: Vec<usize> = all().map(|division| division.patches().len()).collect();
    assert_eq!(counts, [146, 578, 1298, 2306, 3602, 5186]);
    assert!(counts.iter().all(|count| Division::of_count(*count).is_some_and(|division| division.patches().len() == *count)));
    assert!(Division::new(0).is_none() && Division::new(7).is_none() && Division::of_count(145).is_none());
}

#[test]
fn solid_angles_make_the_hemisphere() {
    for division in all() {
        let sky: f64 = division.patches()[1..].iter().map(|patch| patch.solid_angle).sum();
        assert!((sky - TAU).abs() < 1e-12, "{sky}");
        assert!((division.patches()[0].solid_angle - TAU).abs() < 1e-15);
    }
}

#[test]
fn an_even_sky_gives_pi_within_the_width_of_rows() {
    for division in all() {
        let level: f64 = division.patches()[1..].iter().map(|patch| patch.direction()[2] * patch.solid_angle).sum();
        // A row's light is that of its middle over the cosine of half its height: π within 0.5 per cent for Tregenza's patches.
        let rows = 7.0 * f64::from(division.factor());
        let height = PI / 2.0 / (rows + 0.5);
        let expected = PI * (rows * height).sin().powi(2) / (0.5 * height).cos() + TAU * (1.0 - (0.5 * height).cos());
        assert!((level / expected - 1.0).abs() < 1e-12 && (level / PI - 1.0).abs() < 0.006, "{level}");
    }
}

#[test]
fn centres_are_within_their_patches() {
    for division in all() {
        for (index, patch) in division.patches().iter().enumerate() {
            assert_eq!(division.patch_of(patch.direction()), index);
        }
    }
}

#[test]
fn rows_begin_in_the_north_and_turn_to_the_east() {
    let division = Division::new(1).expect("a division");
    assert_eq!(division.patch_of([0.0, 1.0, 0.05]), 1);
    assert_eq!(division.patch_of([1.0, 0.0, 0.05]), 1 + 8);
    assert_eq!(division.patch_of([-0.01, 1.0, 0.05]), 1);
    assert_eq!(division.patch_of([-0.2, 1.0, 0.05]), 30);
    assert_eq!(division.patch_of([0.0, 0.0, -1.0]), 0);
}

#[test]
fn places_lie_in_their_patches() {
    for factor in 1..=3 {
        let division = Division::new(factor).unwrap();
        assert!(division.place(0, [0.5; 2]).is_none() && division.place(division.patches().len(), [0.5; 2]).is_none());
        for patch in 1..division.patches().len() {
            let steps = [0.01, 0.3, 0.7, 0.99];
            let places = steps.iter().flat_map(|u| steps.iter().map(|v| division.place(patch, [*u, *v]).unwrap()));
            places.for_each(|place| assert_eq!(division.patch_of(place), patch));
        }
    }
}
