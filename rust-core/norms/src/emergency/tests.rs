//! Plans, their points, and what readings come to.

use super::*;
use crate::Reading;

const UP: [f64; 3] = [0.0, 0.0, 1.0];

fn plan(text: &str) -> Plan {
    Plan::read(text).expect("a plan")
}

#[test]
fn a_route_has_its_centre_line_and_the_half_of_its_width() {
    let found = plan("[[route]]\nname = 'r'\nline = [[0, 0, 0], [2, 0, 0], [2, 1, 0]]\nwidth = 2\nspacing = 0.5\n");
    let spots = found.spots(UP);
    let along = 7;
    assert_eq!(spots.len(), 5 * along);
    assert_eq!(spots[0].position, [0.0, 0.0, 0.02]);
    assert_eq!(spots[along - 1].position, [2.0, 1.0, 0.02]);
    let sides: Vec<f64> = (0..5).map(|line| spots[line * along].position[1]).collect();
    assert_eq!(sides, [0.0, -0.5, -0.25, 0.25, 0.5]);
    assert!(spots.iter().all(|spot| spot.normal == UP));
}

#[test]
fn an_area_keeps_off_its_edges_whatever_its_shape() {
    let found = plan("[[area]]\nname = 'L'\noutline = [[0, 0, 1], [4, 0, 1], [4, 2, 1], [2, 2, 1], [2, 4, 1], [0, 4, 1]]\nspacing = 0.5\n");
    let spots = found.spots(UP);
    let at = |x: f64, y: f64| spots.iter().any(|spot| (spot.position[0] - x).abs() < 1e-9 && (spot.position[1] - y).abs() < 1e-9);
    assert!(at(0.5, 0.5) && at(3.5, 1.5) && at(1.5, 3.5) && at(1.5, 1.5));
    assert!(!at(2.0, 2.0) && !at(3.5, 2.0) && !at(3.0, 3.0) && !at(0.0, 0.5));
    assert!(spots.iter().all(|spot| spot.position[2] == 1.02));
}

#[test]
fn where_y_is_up_floors_lie_along_x_and_z() {
    let found = plan("height = 0\n[[area]]\nname = 'a'\noutline = [[0, 2, 0], [2, 2, 0], [2, 2, 3], [0, 2, 3]]\nspacing = 1\n");
    let spots = found.spots([0.0, 1.0, 0.0]);
    assert_eq!(spots.len(), 2 * 3);
    assert!(spots.iter().all(|spot| spot.position[1] == 2.0 && spot.normal == [0.0, 1.0, 0.0]));
}

#[test]
fn figures_are_of_their_own_points() {
    let text = "flux = 0.5\n[[route]]\nname = 'r'\nline = [[0, 0, 0], [1, 0, 0]]\nspacing = 1\n[[place]]\nname = 'p'\nposition = [0, 0, 1]\nfacing = [0, 1, 0]\n";
    let found = plan(text);
    let spots = found.spots(UP);
    assert_eq!(spots.len(), 11);
    let readings: Vec<Reading> = (0..11).map(|k| Reading { lx: 2.0 + 2.0 * f64::from(k), error: 0.2 }).collect();
    let json = Figures::new(&found, &spots, &readings, Vec::new()).json();
    assert_eq!(json["routes"][0]["centre"]["min_lx"], 1.0);
    assert_eq!(json["routes"][0]["centre"]["max_lx"], 2.0);
    assert_eq!(json["routes"][0]["centre"]["max_to_min"], 2.0);
    assert_eq!(json["routes"][0]["band"]["max_lx"], 10.0);
    assert_eq!(json["places"][0]["lx"], 11.0);
    assert_eq!(json["places"][0]["standard_error"], 0.1);
}

#[test]
fn what_is_no_plan_is_told_with_its_line() {
    for (text, message) in [
        ("", "nothing to measure"),
        ("[[route]]\nname = 'r'\nlin = [[0,0,0]]\n", "unknown field `lin`"),
        ("[[route]]\nname = 'r'\nline = [[0,0,0]]\n", "two corners"),
        ("flux = 2\n[[place]]\nname='p'\nposition=[0,0,0]\nfacing=[0,0,1]\n", "flux is 2, expected 0 to 1"),
        ("[[place]]\nname='p'\nposition=[0,0,0]\nfacing=[0,0,0]\n", "facing"),
        ("[[area]]\nname='a'\noutline=[[0,0,0],[1e6,0,0],[0,1e6,0]]\n", "expected 200000 at most"),
        ("glare_deg = [90, 60]\n[[place]]\nname='p'\nposition=[0,0,0]\nfacing=[0,0,1]\n", "rising"),
    ] {
        let error = Plan::read(text).expect_err(text);
        assert!(error.problem.contains(message), "{text}: {}", error.problem);
    }
    assert!(Plan::read("flux = 1\nheight = 'low'\n").expect_err("words").to_string().contains('2'));
}
