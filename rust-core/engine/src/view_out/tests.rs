//! Figures of made rays, and levels by hand.

use super::{AreaView, Criterion, FARTHEST_M, Layer, View, ViewLevel, fan::Fan, figures::Outside};
use std::f64::consts::PI;

const STEP: f64 = PI / 360.0;

fn fan() -> Fan {
    Fan::new([0.0, 0.0, 2.0], STEP, PI / 2.0).expect("a way up")
}

fn out(layer: Layer, distance_m: f64) -> Option<Outside> {
    Some(Outside { layer, distance_m, by_hole: false, is_open: false })
}

/// A view whose azimuths see one thing each, or nothing.
fn of_azimuths(seen: impl Fn(usize) -> Option<Outside>) -> View {
    let fan = Fan::new([0.0, 0.0, 1.0], STEP, STEP).expect("a way up");
    let ends: Vec<_> = (0..fan.azimuths).flat_map(|azimuth| vec![seen(azimuth); fan.elevations.len()]).collect();
    View::new([0.0; 3], &fan, &ends)
}

#[test]
fn a_fan_covers_the_sphere_once() {
    let fan = fan();
    assert_eq!((fan.azimuths, fan.elevations.len()), (720, 361));
    let whole: f64 = (0..fan.elevations.len()).map(|elevation| fan.azimuths as f64 * fan.solid_angle(elevation)).sum();
    assert!((whole - 4.0 * PI).abs() < 1e-3, "{whole}");
    assert!(fan.elevations[0] == 0.0 && fan.elevations.windows(2).all(|pair| pair[0].abs() <= pair[1].abs() + 1e-12));
    for (azimuth, elevation) in [(0, 0), (17, 5), (719, 360)] {
        let [x, y, z] = fan.direction(azimuth, elevation);
        assert!((x * x + y * y + z * z - 1.0).abs() < 1e-12 && (z.asin() - fan.elevations[elevation]).abs() < 1e-9);
    }
    assert!(Fan::new([0.0; 3], STEP, STEP).is_none());
}

#[test]
fn parts_on_both_sides_of_the_first_azimuth_are_one() {
    let view =
        of_azimuths(|azimuth| if !(20..700).contains(&azimuth) || (300..310).contains(&azimuth) { out(Layer::Sky, 9.0) } else { None });
    assert!((view.sight_angle_deg - 25.0).abs() < 1e-9 && (view.widest_deg - 20.0).abs() < 1e-9);
    assert_eq!(of_azimuths(|_| out(Layer::Sky, 9.0)).widest_deg, 360.0);
    assert_eq!((of_azimuths(|_| None).distances_m, of_azimuths(|_| None).level()), (None, ViewLevel::Below));
}

#[test]
fn distances_have_quartiles_and_an_end() {
    let view = of_azimuths(|azimuth| if azimuth < 101 { out(Layer::Landscape, azimuth as f64) } else { None });
    assert_eq!((view.distances_m, view.distance_m()), (Some([0.0, 25.0, 50.0, 75.0, 100.0]), 50.0));
    assert_eq!(of_azimuths(|_| out(Layer::Sky, f64::INFINITY)).distance_m(), FARTHEST_M);
}

/// So many half degrees, metres, and layers: what the limits of the three levels say of them.
#[test]
fn levels_are_the_least_of_three_criteria() {
    use ViewLevel::{Below, High, Medium, Minimum};
    let view = |halves: usize, metres: f64, layers: &[Layer]| {
        let seen = |azimuth: usize| if azimuth < halves { out(layers[azimuth % layers.len()], metres) } else { None };
        of_azimuths(seen)
    };
    let all = [Layer::Sky, Layer::Landscape, Layer::Ground];
    let two = [Layer::Landscape, Layer::Ground];
    let cases = [
        (view(27, 60.0, &all), [Below, High, High]),
        (view(28, 60.0, &all), [Minimum, High, High]),
        (view(56, 20.0, &all), [Medium, Medium, High]),
        (view(108, 19.99, &two), [High, Minimum, Medium]),
        (view(108, 5.99, &[Layer::Landscape]), [High, Below, Minimum]),
        (view(108, 50.0, &[Layer::Sky, Layer::Ground]), [High, High, Below]),
        (view(108, 50.0, &all), [High, High, High]),
    ];
    for (view, levels) in cases {
        assert_eq!(Criterion::ALL.map(|criterion| view.level_by(criterion)), levels);
        assert_eq!(Some(view.level()), levels.into_iter().min());
    }
}

#[test]
fn an_area_has_what_three_quarters_of_its_points_have() {
    let view =
        |degrees: usize, metres: f64| of_azimuths(|azimuth| if azimuth < 2 * degrees { out(Layer::Landscape, metres) } else { None });
    // Three of four by the angle, three others by the distance: two of four by both.
    let views = [view(60, 60.0), view(54, 10.0), view(56, 70.0), view(10, 80.0)];
    let area = AreaView::new(&views);
    assert_eq!(area.levels, [ViewLevel::High, ViewLevel::High, ViewLevel::Minimum]);
    assert_eq!(area.level(), ViewLevel::Minimum);
    assert_eq!((area.shares[0], area.shares[1]), ([0.75; 3], [1.0, 0.75, 0.75]));
    assert_eq!(area.shares_of_all, [0.75, 0.0, 0.0]);
    assert!((area.sight_angle_deg - 54.0).abs() < 1e-9 && area.distance_m == 60.0);
    let fewer = AreaView::new(&[view(60, 60.0), view(60, 60.0), view(10, 60.0)]);
    assert_eq!((fewer.level(), fewer.levels[0]), (ViewLevel::Below, ViewLevel::Below));
    assert_eq!(AreaView::new(&[]).level(), ViewLevel::Below);
}
