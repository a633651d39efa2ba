//! Plans of rooms, their points, and what readings come to.

use super::*;
use crate::{Reading, Spot};

const UP: [f64; 3] = [0.0, 0.0, 1.0];
const ROOM: &str = "[[room]]\nname = 'Office'\nfloor = [[0, 0, 0], [6, 0, 0], [6, 4, 0], [0, 4, 0]]\nheight = 2.8\n";
const DESK: &str = "[[task]]\nname = 'Desk'\noutline = [[2, 1, 0.75], [3.6, 1, 0.75], [3.6, 1.8, 0.75], [2, 1.8, 0.75]]\n";

fn plan(text: &str) -> Plan {
    Plan::read(text).expect("a plan")
}

/// Figures whose readings are these of their spots.
fn figures(text: &str, lx: impl Fn(&Spot) -> f64) -> serde_json::Value {
    let plan = plan(text);
    let readings: Vec<Reading> = plan.spots(UP).iter().map(|spot| Reading { lx: lx(spot), error: 0.0 }).collect();
    Figures::new(&plan, UP, &readings).json()
}

fn places(of: &serde_json::Value) -> Vec<[f64; 3]> {
    let point = |point: &serde_json::Value| [0, 1, 2].map(|k| point["position_m"][k].as_f64().expect("a number"));
    of["points"].as_array().expect("points").iter().map(point).collect()
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

#[test]
fn tasks_have_the_norms_points() {
    let found = figures(&format!("{ROOM}{DESK}"), |_| 1.0);
    let desk = places(&found["tasks"][0]["task"]);
    // Twice as long as wide: d = 0.8 m, p = 0.2 · 5^log₁₀ 0.8 = 0.171 m: 5 points of 0.16 m, and 10 along.
    assert_eq!(desk.len(), 50);
    assert!(close(desk[0][0], 2.08) && close(desk[0][1], 1.08) && close(desk[0][2], 0.755), "{:?}", desk[0]);
    assert_eq!(found["tasks"][0]["room"], "Office");
    let task = &found["tasks"][0]["task"];
    assert_eq!((&task["size"], task["cells"].as_array().map(Vec::len)), (&serde_json::json!([10, 5]), Some(50)));
    let around = &found["tasks"][0]["surround"];
    assert_eq!(around["cells"].as_array().map(Vec::len), around["points"].as_array().map(Vec::len));
}

#[test]
fn surrounds_go_around_within_the_room_and_off_other_tasks() {
    let second = "[[task]]\nname = 'Side'\noutline = [[3.6, 1, 0.75], [4.2, 1, 0.75], [4.2, 1.8, 0.75], [3.6, 1.8, 0.75]]\n";
    let corner = "[[task]]\nname = 'Corner'\noutline = [[0, 3, 0.75], [1, 3, 0.75], [1, 4, 0.75], [0, 4, 0.75]]\n";
    let found = figures(&format!("{ROOM}{DESK}{second}{corner}"), |_| 1.0);
    let around = places(&found["tasks"][0]["surround"]);
    let away = |[x, y, _]: &[f64; 3]| (2.0 - x).max(x - 3.6).max(0.0).hypot((1.0 - y).max(y - 1.8).max(0.0));
    assert!(!around.is_empty() && around.iter().all(|at| away(at) > 0.0 && away(at) <= 0.5 + 1e-9));
    assert!(around.iter().all(|[x, y, _]| !(*x > 3.6 && *x < 4.2 && *y > 1.0 && *y < 1.8)));
    // About a desk in a corner two sides are left.
    let corner = places(&found["tasks"][2]["surround"]);
    assert!(!corner.is_empty() && corner.iter().all(|[x, y, _]| *x > 0.0 && *y < 4.0 && (*x > 1.0 || *y < 3.0)));
}

#[test]
fn the_background_is_the_floor_beyond_surrounds() {
    let found = figures(&format!("{ROOM}background = 1\n{DESK}"), |_| 1.0);
    let floor = places(&found["rooms"][0]["background"]);
    let away = |[x, y, _]: &[f64; 3]| (2.0 - x).max(x - 3.6).max(0.0).hypot((1.0 - y).max(y - 1.8).max(0.0));
    assert!(!floor.is_empty() && floor.iter().all(|at| away(at) > 0.5 && away(at) <= 1.5 && close(at[2], 0.005)));
    // 15 % of 4 m is more than half a metre.
    assert!(floor.iter().all(|[x, y, _]| *x > 0.5 && *y > 0.5 && *x < 5.5 && *y < 3.5));
    let whole = figures(ROOM, |_| 1.0);
    assert!(places(&whole["rooms"][0]["background"]).len() > floor.len());
}

#[test]
fn walls_face_inwards_whichever_way_the_floor_turns() {
    let turned = ROOM.replace("[6, 0, 0], [6, 4, 0], [0, 4, 0]", "[0, 4, 0], [6, 4, 0], [6, 0, 0]");
    for text in [ROOM, &turned] {
        let spots = plan(text).spots(UP);
        let walls: Vec<&Spot> = spots.iter().filter(|spot| spot.normal[2].abs() < 0.5).collect();
        assert!(!walls.is_empty());
        for spot in walls {
            let [x, y, z] = spot.position;
            assert!(x > 0.0 && x < 6.0 && y > 0.0 && y < 4.0 && z > 0.0 && z < 2.8);
            let to_middle = spot.normal[0] * (3.0 - x) + spot.normal[1] * (2.0 - y);
            assert!(to_middle > 0.0, "{spot:?}");
        }
        let ceiling: Vec<&Spot> = spots.iter().filter(|spot| spot.normal[2] < -0.5).collect();
        assert!(!ceiling.is_empty() && ceiling.iter().all(|spot| close(spot.position[2], 2.795)));
        let on_ceiling =
            |spot: &&Spot| spot.position[0] > 0.0 && spot.position[0] < 6.0 && spot.position[1] > 0.0 && spot.position[1] < 4.0;
        assert!(ceiling.iter().all(on_ceiling));
    }
}

#[test]
fn the_mean_of_all_walls_counts_each_by_its_size() {
    // 10 lx on the two walls of 6 m, 40 lx on those of 4 m.
    let found = figures(&format!("maintenance_factor = 0.5\n{ROOM}"), |spot| if spot.normal[1].abs() > 0.5 { 10.0 } else { 40.0 });
    let room = &found["rooms"][0];
    let mean = room["walls"]["average_lx"].as_f64().expect("a mean");
    assert!(close(mean, 0.5 * (6.0 * 10.0 + 4.0 * 40.0) / 10.0), "{mean}");
    assert!(close(room["walls"]["u0"].as_f64().expect("a ratio"), 5.0 / mean));
    assert_eq!(room["each_wall"].as_array().map(Vec::len), Some(4));
    assert_eq!(room["each_wall"][1]["average_lx"], 20.0);
}

#[test]
fn modelling_is_of_the_means_at_the_same_points() {
    let found = figures(&format!("{ROOM}{DESK}"), |spot| match (spot.is_cylinder, spot.position[2]) {
        (true, _) => 150.0,
        (false, z) if close(z, 1.2) => 500.0,
        _ => 1.0,
    });
    assert_eq!(found["rooms"][0]["modelling"], 0.3);
    assert_eq!(found["tasks"][0]["modelling"], 0.3);
    assert_eq!(found["tasks"][0]["cylindrical"]["average_lx"], 150.0);
    assert!(places(&found["tasks"][0]["cylindrical"]).iter().all(|at| close(at[2], 1.2)));
}

#[test]
fn boards_on_walls_and_rooms_of_any_shape() {
    // A board on the wall x = 0 that looks along +x, corners anticlockwise as seen from the room.
    let board = "[[task]]\nname = 'Board'\noutline = [[0, 3, 1], [0, 3, 2], [0, 1, 2], [0, 1, 1]]\n";
    let found = plan(&format!("{ROOM}{board}"));
    let spots = found.spots(UP);
    let last = spots.last().expect("points");
    assert_eq!(last.normal.map(f64::round), [1.0, 0.0, 0.0]);
    assert!(close(last.position[0], 0.005));
    let shaped =
        "[[room]]\nname = 'L'\nfloor = [[0, 0, 1], [6, 0, 1], [6, 2, 1], [2, 2, 1], [2, 5, 1], [0, 5, 1]]\nheight = 3\nborder = 0\n";
    let found = figures(shaped, |_| 1.0);
    assert!(places(&found["rooms"][0]["background"]).iter().all(|[x, y, z]| (*x < 2.0 || *y < 2.0) && close(*z, 1.005)));
    assert_eq!(found["rooms"][0]["each_wall"].as_array().map(Vec::len), Some(6));
}

#[test]
fn doubts_name_what_has_no_point_and_no_room() {
    let found = plan(&format!("{DESK}border = 0.5\n"));
    let doubts = Figures::new(&found, UP, &[]).doubts();
    assert!(doubts[0].contains("'Desk' lies in no room") && doubts[1].contains("no point lies within 'task'"), "{doubts:?}");
}

#[test]
fn floors_are_those_of_surfaces() {
    let named = plan(&ROOM.replace("floor = [[0, 0, 0], [6, 0, 0], [6, 4, 0], [0, 4, 0]]", "surface = 'Floor'"));
    let floor = vec![[0.0, 0.0, 0.0], [6.0, 0.0, 0.0], [6.0, 4.0, 0.0], [0.0, 4.0, 0.0]];
    let placed = named.clone().placed(|name| if name == "Floor" { Ok(floor.clone()) } else { Err(()) }).expect("a floor");
    assert_eq!(placed.check(), Ok(()));
    assert_eq!(placed.spots(UP), plan(ROOM).spots(UP));
    let line = named.placed(|_| Ok::<_, ()>(vec![[0.0; 3]; 3])).expect("a line");
    assert!(line.check().expect_err("no area").contains("lie in one plane"));
}

#[test]
fn what_is_no_plan_is_told() {
    for (text, message) in [
        ("".to_owned(), "nothing to measure"),
        (ROOM.replace("floor", "#"), "expected a floor, or the surface that is one"),
        (ROOM.replace("height", "hight"), "unknown field `hight`"),
        (ROOM.replace("2.8", "0"), "height is 0"),
        (ROOM.replace("[6, 4, 0]", "[6, 4, 1]"), "lie in one plane"),
        (ROOM.replace("6,", "nan,"), "lie in one plane"),
        (ROOM.replace("[6, 0, 0], [6, 4, 0], [0, 4, 0]", "[6, 0, 0]"), "three corners"),
        (format!("{ROOM}spacing = 0.001\n"), "spacing is 0.001"),
        (format!("{ROOM}{DESK}room = 'Hall'\n"), "expected one of Office"),
        (format!("{ROOM}{DESK}surround = -1\n"), "surround is -1"),
        (ROOM.replace('6', "60000"), "expected 200000 at most"),
    ] {
        let error = Plan::read(&text).expect_err(&text);
        assert!(error.problem.contains(message), "{text}: {}", error.problem);
    }
}
