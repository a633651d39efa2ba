//! Plans of fields, their points, and CIE 112's rating.

use super::{glare::worst, *};
use crate::Reading;

const UP: [f64; 3] = [0.0, 0.0, 1.0];

fn plan(text: &str) -> Plan {
    Plan::read(text).expect("a plan")
}

fn pitch(more: &str) -> String {
    format!("[[field]]\nname = 'Pitch'\ncorner = [0, 0, 0]\nalong = [105, 0, 0]\nacross = [0, 68, 0]\n{more}\n")
}

#[test]
fn a_football_pitch_has_odd_numbers_of_points() {
    // p = 0.2 · 5^log₁₀ 105 = 5.17 m.
    let found = plan(&pitch(""));
    let spots = found.spots(UP);
    assert_eq!(spots.len(), 21 * 13);
    assert_eq!(spots[0].position, [2.5, 68.0 / 26.0, 0.0]);
    let middle = spots[spots.len() / 2].position;
    assert!((middle[0] - 52.5).abs() < 1e-9 && (middle[1] - 34.0).abs() < 1e-9);
}

#[test]
fn planes_face_their_camera_upright_or_inclined() {
    let camera = "[[camera]]\nname = 'Main'\nposition = [52.5, -60, 20]\n[[camera]]\nname = 'Up'\nposition = [52.5, -60, 20]\ninclined = true\n[[camera]]\nname = 'Far'\nfacing = [0, 2, 1]\n";
    let found = plan(&(pitch("points = [1, 1]") + camera));
    let spots = found.spots(UP);
    assert_eq!(spots.len(), 4);
    assert_eq!((spots[1].position, spots[1].normal), ([52.5, 34.0, 1.5], [0.0, -1.0, 0.0]));
    let length = (94.0_f64.powi(2) + 18.5 * 18.5).sqrt();
    assert!((spots[2].normal[2] - 18.5 / length).abs() < 1e-12);
    assert_eq!(spots[3].normal, [0.0, 1.0, 0.0]);
}

#[test]
fn the_rating_is_cie_112s() {
    // One lamp 10° above a level line of sight, 20 lx; 100 lx on ground of 0.25.
    let angle = 10.0_f64.to_radians();
    let source = Source { direction: [angle.cos(), 0.0, angle.sin()], lx: 20.0 };
    let ground = Reading { lx: 100.0, error: 1.0 };
    let looks = [(0.0, [1.0, 0.0, 0.0]), (90.0, [0.0, 1.0, 0.0])];
    let found = worst(&[source], &looks, 0.25, ground);
    let veil: f64 = 10.0 * 20.0 * angle.cos() / 100.0;
    let own: f64 = 0.035 * 0.25 * 100.0 / std::f64::consts::PI;
    let expected = 27.0 + 24.0 * (veil / own.powf(0.9)).log10();
    assert!((found.gr.expect("a rating") - expected).abs() < 1e-9, "{found:?} {expected}");
    assert_eq!(found.look_deg, 0.0);
    // 24 · 0.9 / ln 10 of one per cent.
    assert!((found.error - 0.0938).abs() < 1e-3);
    // Beyond 60° there is no veil.
    assert_eq!(worst(&[source], &looks[1..], 0.25, ground).gr, None);
    assert_eq!(worst(&[source], &looks, 0.25, Reading::default()).gr, None);
}

#[test]
fn who_looks_around_meets_the_lamp_behind() {
    let found = plan(&(pitch("points = [1, 1]") + "[[observer]]\nname = 'Keeper'\nposition = [50, 34, 1.5]\n"));
    assert_eq!(found.eyes(UP), [[50.0, 34.0, 1.5]]);
    let source = Source { direction: [-0.8, 0.0, 0.6], lx: 10.0 };
    let figures = Figures::new(&found, UP, &[Reading { lx: 200.0, error: 0.0 }], &[vec![source]]);
    let json = figures.json();
    assert_eq!(json["observers"][0]["look_deg"], 180.0);
    assert_eq!(json["fields"][0]["horizontal"]["average_lx"], 200.0);
    assert!(!figures.has_nearer());
}

#[test]
fn maintenance_is_of_light_and_not_of_glare() {
    let text = pitch("points = [1, 1]\nglare = true");
    let rated = |factor: &str| {
        let found = plan(&format!("{factor}\n{text}"));
        let source = Source { direction: [0.8, 0.0, 0.6], lx: 10.0 };
        Figures::new(&found, UP, &[Reading { lx: 200.0, error: 0.0 }], &[vec![source]]).json()
    };
    let (new, old) = (rated(""), rated("maintenance_factor = 0.5"));
    assert_eq!(old["fields"][0]["horizontal"]["average_lx"], 100.0);
    let [a, b] = [&new, &old].map(|json| json["fields"][0]["glare"]["gr"].as_f64().expect("a rating"));
    assert!((a - b).abs() < 1e-12);
}

#[test]
fn what_is_no_plan_is_told() {
    for (text, message) in [
        (String::new(), "missing field `field`"),
        (pitch("point = 3"), "unknown field `point`"),
        (pitch("points = [0, 3]"), "one at least"),
        (pitch("").replace("[0, 68, 0]", "[68, 68, 0]"), "no right angle"),
        (pitch("").replace("[0, 68, 0]", "[0, 0, 0]"), "sides of some length"),
        (pitch("[[camera]]\nname = 'c'"), "camera 'c': expected a position"),
        (pitch("[[observer]]\nname = 'o'\nposition = [0, 0, 0]\nfield = 'Court'"), "expected one of Pitch"),
        (format!("reflectance = 0\n{}", pitch("")), "reflectance is 0, expected 0.01 to 1"),
    ] {
        let error = Plan::read(&text).expect_err(&text);
        assert!(error.problem.contains(message), "{text}: {}", error.problem);
    }
}

#[test]
fn the_steepest_change_between_neighbours() {
    // Points 4 m apart along and 5 m across; the greatest ratio is across, the greatest change in 5 m along.
    let text = "[[field]]\nname = 'f'\ncorner = [0, 0, 0]\nalong = [8, 0, 0]\nacross = [0, 10, 0]\npoints = [2, 2]\n";
    let found = plan(text);
    let lx = [100.0, 80.0, 80.0, 70.0];
    let readings: Vec<Reading> = lx.iter().map(|lx| Reading { lx: *lx, error: 0.01 * lx }).collect();
    let json = Figures::new(&found, UP, &readings, &[]).json();
    let flat = &json["fields"][0]["horizontal"];
    let number = |key: &str| flat[key].as_f64().expect("a number");
    assert!((number("gradient_ratio") - 1.25).abs() < 1e-12);
    assert!((number("gradient_ratio_error") - 1.25 * 0.01 * 2.0_f64.sqrt()).abs() < 1e-12);
    // 20 % in 4 m are 25 % in 5 m.
    assert!((number("gradient_percent") - 25.0).abs() < 1e-12);
    assert!((number("gradient_percent_error") - 100.0 * 0.8 * 0.01 * 2.0_f64.sqrt() * 1.25).abs() < 1e-12);
    let wide = plan(&format!("gradient_over = 4\n{text}"));
    assert_eq!(Figures::new(&wide, UP, &readings, &[]).json()["fields"][0]["horizontal"]["gradient_percent"], 100.0 * (1.0 - 0.8));
    let one = plan(&text.replace("[2, 2]", "[1, 1]"));
    assert!(Figures::new(&one, UP, &readings[..1], &[]).json()["fields"][0]["horizontal"]["gradient_ratio"].is_null());
    let dark = Figures::new(&found, UP, &[Reading::default(); 4], &[]).json();
    assert!(dark["fields"][0]["horizontal"]["gradient_percent"].is_null());
}
