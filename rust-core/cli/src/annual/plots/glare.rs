//! A year of glare at an eye as a plot.

use super::Times;
use crate::words::Words;
use gonio::annual_glare::Eye;
use gonio_annual::EyeGlare;
use gonio_page::{
    fill,
    plot::{Carpet, Head, Scale},
};

/// Edges of the classes of DGP: 0.35, 0.40 and 0.45 are those that EN 17037 names.
const EDGES: &[f64] = &[0.0, 0.1, 0.2, 0.25, 0.3, 0.35, 0.4, 0.45];

/// DGP over days and hours.
pub(in crate::annual) fn glare(
    eye: &Eye,
    (found, error): &(EyeGlare, Option<EyeGlare>),
    (times, values): (&Times, &[f32]),
    words: &Words,
) -> String {
    let say = &words.year;
    let value = words.figure(found.dgp_5_percent, error.as_ref().map_or(f64::NAN, |error| error.dgp_5_percent), "");
    let share = |of: fn(&EyeGlare) -> f64| words.figure(100.0 * of(found), error.as_ref().map_or(f64::NAN, |error| 100.0 * of(error)), "%");
    let [first, second, third] = [share(|found| found.above_035), share(|found| found.above_040), share(|found| found.above_045)];
    let above = fill(&say.glare_above, &[("first", &first), ("second", &second), ("third", &third)]);
    let title = fill(&say.glare, &[("eye", &eye.origin.name), ("facing", &words.place(eye.facing))]);
    Carpet {
        head: Head { title, lines: vec![fill(&say.glare_value, &[("value", &value)]), above, say.carpet_lines.clone()] },
        values,
        a_day: times.a_day(),
        months: times.months(&say.months),
        sun: &times.sunrise_sunset_h,
        scale: &Scale::new(EDGES, true, "DGP"),
    }
    .svg(words.numbers)
}
