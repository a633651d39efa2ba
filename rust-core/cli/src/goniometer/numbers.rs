//! Numbers of the command line that are written in several ways.

use crate::daylight::number;
use gonio::{
    Error, Result,
    goniometer::{Angles, MOST_DIRECTIONS, Screen},
};

/// Points of a screen each way that nothing is said of.
const SCREEN_POINTS: usize = 32;

/// Directions with γ in ranges.
pub(super) fn angles(c_step: f64, list: &str) -> Result<Angles> {
    let planes = Angles::regular(c_step, 90.0)?.c;
    let mut gamma: Vec<f64> = Vec::new();
    for part in list.split(',') {
        let numbers = part.split(':').map(|text| number("gammas", text)).collect::<Result<Vec<f64>>>()?;
        match numbers[..] {
            [one] => gamma.push(one),
            [first, last, step] if step > 0.0 && last >= first && (last - first) / step < MOST_DIRECTIONS as f64 => {
                let count = ((last - first) / step + 1e-6).floor() as usize;
                gamma.extend((0..=count).map(|i| first + step * i as f64));
            }
            _ => return Err(Error::setting("gammas", format!("'{part}' was found, expected a number or FIRST:LAST:STEP"))),
        }
    }
    Angles { c: planes, gamma }.checked()
}

/// A screen below the luminaire.
pub(super) fn screen(text: &str) -> Result<Screen> {
    let numbers = text.split(',').map(|part| number("screen", part)).collect::<Result<Vec<f64>>>()?;
    let points = |x: f64| if x >= 1.0 && x.fract() == 0.0 { x as usize } else { 0 };
    match numbers[..] {
        [distance, width, height] => Ok(Screen::below(distance, [width, height], [SCREEN_POINTS; 2])),
        [distance, width, height, columns, rows] => Ok(Screen::below(distance, [width, height], [points(columns), points(rows)])),
        _ => Err(Error::setting("screen", format!("'{text}' was found, expected DISTANCE,WIDTH,HEIGHT[,COLUMNS,ROWS]"))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::share::share;

    #[test]
    fn numbers_are_written_in_several_ways() {
        assert_eq!(
            [share("error", "1%").ok(), share("error", " 0.5 %").ok(), share("error", "0.02").ok()],
            [Some(0.01), Some(0.005), Some(0.02)]
        );
    }

    #[test]
    fn angles_come_in_ranges() {
        let found = angles(90.0, "0:2:0.5,5,10:20:5").expect("ranges");
        assert_eq!(found.c, [0.0, 90.0, 180.0, 270.0]);
        assert_eq!(found.gamma, [0.0, 0.5, 1.0, 1.5, 2.0, 5.0, 10.0, 15.0, 20.0]);
        for bad in ["0:2", "0:2:0", "2:0:1", "0:180:1e-9", "0,x", "5,3", "0"] {
            assert!(angles(90.0, bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn screens_have_points() {
        let found = screen("2,4,3").expect("a screen");
        assert_eq!((found.corner, found.size), ([-2.0, -1.5, -2.0], [32, 32]));
        assert!(screen("2,4").is_err() && screen("2,4,x").is_err());
    }
}
