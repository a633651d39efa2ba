//! Outlines with holes against their areas.

use crate::outline::cut;
use crate::vector::{Vec3, cross, length, sub};

fn square(from: f64, to: f64) -> Vec<Vec3> {
    vec![[from, from, 1.0], [to, from, 1.0], [to, to, 1.0], [from, to, 1.0]]
}

fn area(cut: &crate::outline::Cut) -> f64 {
    let twice = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|i| cut.points[i as usize]);
        cross(sub(b, a), sub(c, a))
    };
    cut.triangles.iter().map(twice).map(|v| 0.5 * length(v)).sum()
}

#[test]
fn holes_are_cut_out() {
    let found = cut(&square(0.0, 4.0), &[square(1.0, 2.0), square(2.5, 3.5)]).expect("an outline");
    assert_eq!(found.doubt, None);
    assert!((area(&found) - 14.0).abs() < 1e-9, "{}", area(&found));
    for triangle in &found.triangles {
        let [a, b, c] = triangle.map(|i| found.points[i as usize]);
        assert!(cross(sub(b, a), sub(c, a))[2] > 0.0, "triangles face as the outline does");
    }
}

#[test]
fn a_hole_with_a_seam_is_cut_out_as_radiance_writes_it() {
    let mut outline = square(0.0, 4.0);
    outline.push([0.0, 0.0, 1.0]);
    let mut hole = square(1.0, 3.0);
    hole.reverse();
    let first = hole[0];
    outline.extend(hole);
    outline.push(first);
    let found = cut(&outline, &[]).expect("an outline");
    assert_eq!(found.doubt, None);
    assert!((area(&found) - 12.0).abs() < 1e-9, "{}", area(&found));
}

#[test]
fn a_hole_may_touch_the_edge_or_take_all() {
    let door = vec![[1.0, 0.0, 1.0], [2.0, 0.0, 1.0], [2.0, 2.0, 1.0], [1.0, 2.0, 1.0]];
    let found = cut(&square(0.0, 4.0), &[door]).expect("an outline");
    assert!((area(&found) - 14.0).abs() < 1e-9, "{}", area(&found));
    assert!(area(&cut(&square(0.0, 4.0), &[square(0.0, 4.0)]).expect("an outline")) < 1e-9);
}

#[test]
fn what_is_no_surface_is_told() {
    let problem = |corners: &[Vec3]| cut(corners, &[]).expect_err("no surface");
    assert!(problem(&square(0.0, 1.0)[..2]).contains("2 corners"));
    assert!(problem(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]).contains("on a line"));
    assert!(problem(&[[0.0; 3], [f64::NAN, 0.0, 0.0], [2.0, 1.0, 0.0]]).contains("finite"));
    let crossed = [[0.0; 3], [2.0, 2.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
    assert!(cut(&crossed, &[]).is_err() || cut(&crossed, &[]).is_ok_and(|cut| cut.doubt.is_some()));
    let bent = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.4], [0.0, 1.0, 0.0]];
    assert!(cut(&bent, &[]).expect("an outline").doubt.is_some_and(|doubt| doubt.contains("plane")));
}
