//! A year's days: steps, months, sunrise and sunset.

use gonio_annual::{SUN_ANGLE_DEG, Step, Year};
use serde::{Deserialize, Serialize};

/// Days of the months of a common year.
const MONTHS: [usize; 12] = [31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31];

/// How a year's steps fall on its days.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Times {
    pub(crate) step_hours: f64,
    /// By day when the sun's disc comes over the horizon and when it is below it again, hours of the weather file's clock; `None` on days without it.
    pub(crate) sunrise_sunset_h: Vec<Option<[f64; 2]>>,
}

impl Times {
    pub(crate) fn new(year: &Year) -> Self {
        let of_day = year.steps.chunk_by(|a, b| a.day_of_year == b.day_of_year);
        Self { step_hours: year.step_hours, sunrise_sunset_h: of_day.map(|steps| sun(steps, 0.5 * year.step_hours)).collect() }
    }

    pub(crate) fn a_day(&self) -> usize {
        ((24.0 / self.step_hours).round() as usize).max(1)
    }

    /// The first days of the months, counted from 0, with their names.
    pub(crate) fn months(&self, names: &[String; 12]) -> Vec<(usize, String)> {
        let leap = usize::from(self.sunrise_sunset_h.len() > MONTHS.iter().sum());
        let mut start = 0;
        let first = |(month, name): (usize, &String)| {
            let here = start;
            start += MONTHS[month] + if month == 1 { leap } else { 0 };
            (here, name.clone())
        };
        names.iter().enumerate().map(first).collect()
    }
}

/// Sunrise and sunset of a day's steps of so many half hours: the ends of the parts in which the sun is up, where it stands in the middle of such a
/// part, else between the middles of steps on either side; the day's ends where the sun is up there.
fn sun(steps: &[Step], half: f64) -> Option<[f64; 2]> {
    let above = |step: &Step| step.sun.altitude + (0.5 * SUN_ANGLE_DEG).to_radians();
    let first = steps.iter().position(|step| step.sun.is_up())?;
    let last = steps.iter().rposition(|step| step.sun.is_up())?;
    let crossing =
        |down: &Step, up: &Step| down.hour + (up.hour - down.hour) * -above(down) / (above(up) - above(down)).max(f64::MIN_POSITIVE);
    let rise = match steps[first] {
        step if step.sun_hour > step.hour => 2.0 * step.sun_hour - (step.hour + half),
        step => first.checked_sub(1).map_or(0.0, |before| crossing(&steps[before], &step)),
    };
    let set = match steps[last] {
        step if step.sun_hour < step.hour => 2.0 * step.sun_hour - (step.hour - half),
        step => steps.get(last + 1).map_or(24.0, |after| crossing(after, &step)),
    };
    Some([rise, set])
}

#[cfg(test)]
mod tests {
    use super::*;
    use gonio_annual::Sun;

    fn day(altitude: impl Fn(f64) -> f64) -> Vec<Step> {
        let step = |hour: usize| {
            let hour = hour as f64 + 0.5;
            let sun = Sun { altitude: altitude(hour), azimuth: 0.0 };
            Step {
                calendar_year: None,
                month: 1,
                day: 1,
                hour,
                day_of_year: 1,
                direct: 0.0,
                diffuse: 0.0,
                dew_point_c: 11.0,
                sun,
                sun_hour: hour,
            }
        };
        (0..24).map(step).collect()
    }

    #[test]
    fn the_sun_rises_between_steps() {
        // 0.1 rad an hour; the disc is up where its middle is 0.00465 rad below the horizon.
        let found = sun(&day(|hour| 0.1 * (4.2 - (hour - 12.0).abs())), 0.5).expect("a day");
        assert!((found[0] - (7.8 - 0.0465)).abs() < 1e-3 && (found[1] - (16.2 + 0.0465)).abs() < 1e-3, "{found:?}");
        assert_eq!((sun(&day(|_| -0.1), 0.5), sun(&day(|_| 0.1), 0.5)), (None, Some([0.0, 24.0])));
    }

    #[test]
    fn the_sun_is_up_in_parts_of_steps() {
        let mut steps = day(|hour| 0.1 * (4.2 - (hour - 12.0).abs()));
        // Up from 7.2 h, which is before the middle of that step; until 16.9 h.
        (steps[7].sun_hour, steps[7].sun.altitude) = (7.6, 0.01);
        (steps[16].sun_hour, steps[16].sun.altitude) = (16.45, 0.01);
        let found = sun(&steps, 0.5).expect("a day");
        assert!((found[0] - 7.2).abs() < 1e-9 && (found[1] - 16.9).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn months_begin_where_they_do() {
        let names: [String; 12] = std::array::from_fn(|month| month.to_string());
        for (days, march) in [(365, 59), (366, 60)] {
            let times = Times { step_hours: 0.5, sunrise_sunset_h: vec![None; days] };
            assert_eq!((times.months(&names)[2].0, times.months(&names)[11].0, times.a_day()), (march, days - 31, 48));
        }
    }
}
