//! Plots hold what they are given.

use super::{Band, Bands, Carpet, Head, Map, Scale, axis::ticks};
use crate::Numbers;

const COMMA: Numbers = Numbers { comma: true };

fn head() -> Head {
    Head { title: "A <b> & c".into(), lines: vec!["± 2".into()] }
}

#[test]
fn long_titles_stay_within() {
    let title = "a very long name of a grid on the second floor of a house: mean illuminance of the points, hour by hour";
    let scale = Scale::new(&[0.0, 1.0], false, "");
    let map = Map {
        head: Head { title: title.into(), lines: Vec::new() },
        size: [1, 1],
        spacing: [1.0; 2],
        values: &[Some(0.5)],
        scale: &scale,
        decimals: 1,
    };
    let svg = map.svg(Numbers::default());
    let size: f64 = svg.split("font-size=\"").nth(2).and_then(|rest| rest.split('"').next()?.parse().ok()).expect("a size");
    assert!(size < 13.0 && size * 0.58 * title.len() as f64 <= 725.0, "{size}");
}

#[test]
fn ticks_are_round() {
    assert_eq!(ticks(3.6, 10), [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 3.5]);
    assert_eq!(ticks(10.0, 10), [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0]);
    assert_eq!(ticks(144.0, 10), [0.0, 20.0, 40.0, 60.0, 80.0, 100.0, 120.0, 140.0]);
    assert_eq!((ticks(0.0, 3), ticks(f64::NAN, 3)), (vec![0.0], vec![0.0]));
}

#[test]
fn classes_begin_at_their_edges() {
    let scale = Scale::new(&[0.0, 100.0, 300.0], true, "lx");
    assert_eq!([-1.0, 0.0, 99.9, 100.0, 299.0, 300.0, 1e9].map(|value| scale.class(value)), [0, 0, 0, 1, 1, 2, 2]);
    let closed = Scale::new(&[0.0, 50.0, 100.0], false, "%");
    assert_eq!([0.0, 50.0, 100.0].map(|value| closed.class(value)), [0, 1, 1]);
    assert_ne!(scale.colour(0), scale.colour(2));
}

#[test]
fn a_map_has_values_metres_and_a_legend() {
    let scale = Scale::new(&[0.0, 50.0, 100.0], false, "%");
    let values = [Some(12.5), None, Some(99.0), Some(50.0)];
    let map = Map { head: head(), size: [2, 2], spacing: [1.5, 1.0], values: &values, scale: &scale, decimals: 1 };
    let svg = map.svg(COMMA);
    for part in [
        "A &lt;b&gt; &amp; c",
        ">± 2<",
        ">12,5</text>",
        ">99,0</text>",
        ">0,5</text>",
        ">m</text>",
        ">%</text>",
        "prefers-color-scheme:dark",
    ] {
        assert!(svg.contains(part), "{part}: {svg}");
    }
    // Three cells, two classes in the legend, the paper.
    assert_eq!(svg.matches("<rect").count(), 6);
    // The first value lies at the lower left.
    let place = |value: &str| {
        let before = svg.split_once(&format!(">{value}</text>")).map(|(before, _)| before).unwrap_or_default();
        let number =
            |name: &str| before.rsplit_once(name).and_then(|(_, rest)| rest.split('"').next()?.parse::<f64>().ok()).unwrap_or(f64::NAN);
        [number(" x=\""), number(" y=\"")]
    };
    let ([x, y], [right, top]) = (place("12,5"), place("50,0"));
    assert!(x < right && y > top, "{x} {y} {right} {top}");
}

#[test]
fn a_carpet_has_runs_of_hours_months_and_the_sun() {
    let scale = Scale::new(&[0.0, 100.0], true, "lx");
    let mut values = vec![0.0; 24 * 3];
    values[8..12].fill(50.0);
    values[12..14].fill(500.0);
    values[24 + 9] = 100.0;
    let sun = [Some([8.0, 14.0]), Some([8.0, 14.5]), None];
    let months = vec![(0, "J".to_owned()), (2, "F".to_owned())];
    let carpet = Carpet { head: head(), values: &values, a_day: 24, months, sun: &sun, scale: &scale };
    let svg = carpet.svg(Numbers::default());
    assert!(svg.contains("d=\"M0 8h1v4h-1z\"") && svg.contains("d=\"M0 12h1v2h-1zM1 9h1v1h-1z\""), "{svg}");
    assert_eq!(svg.matches("class=\"curve\"").count(), 2);
    assert!(svg.contains(">J</text>") && svg.contains(">F</text>") && svg.contains(">24</text>"));
}

#[test]
fn bands_stand_on_each_other() {
    let band = |name: &str, colour, shares: [f64; 2]| Band { name: name.into(), colour, shares: shares.into() };
    let bands = vec![band("low", "#000000", [0.25, 0.5]), band("high", "#ffffff", [0.75, 0.5])];
    let svg = Bands { head: head(), bands, points: "points".into() }.svg(COMMA);
    // The second band begins where the first one ends.
    assert!(svg.contains("M46.00 180.00h250.00v-180.00h-250.00z") && svg.contains("M296.00 120.00h250.00v-120.00h-250.00z"), "{svg}");
    assert!(svg.contains("∅ 37,5\u{a0}%") && svg.contains(">points</text>"));
}
