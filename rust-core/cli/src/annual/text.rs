//! A grid's year as lines for a reader.

use gonio_annual::{Grid, Method};

/// The lines of a grid.
pub(super) fn lines(name: &str, grid: &Grid) -> Vec<String> {
    let errors = grid.standard_errors.as_ref();
    let error =
        |value: Option<f64>, factor: f64, digits: usize| value.map_or(String::new(), |value| format!(" ± {:.digits$}", factor * value));
    let per_cent = |value: f64, of: Option<f64>| format!("{:.1}{} %", 100.0 * value, error(of, 100.0, 1));
    let exposure = grid.ase_1000_250.map(|value| per_cent(value, errors.and_then(|errors| errors.ase_1000_250)));
    let area = |method: &Method| {
        let [low, middle, high, highest] = method.area_100_300_500_750.map(|share| 100.0 * share);
        format!(
            "{:?}; 100 lx on {low:.0} %, 300 lx on {middle:.0} %, 500 lx on {high:.0} %, 750 lx on {highest:.0} % of the points",
            method.level
        )
    };
    vec![
        format!("{name}: {} points, {:.0} used hours", grid.points.len(), grid.used_hours),
        format!("  sDA 300/50 %: {} of the points", per_cent(grid.sda_300_50, errors.map(|errors| errors.sda_300_50))),
        match exposure {
            Some(exposure) => format!("  ASE 1000/250 h: {exposure} of the points"),
            None => "  ASE 1000/250 h: not known without --sun-coefficients".into(),
        },
        format!("  mean illuminance: {:.0}{} lx", grid.mean_lx, error(errors.map(|errors| errors.mean_lx), 1.0, 0)),
        format!("  UDI 100-3000 lx: {} of the used hours", per_cent(grid.udi_100_3000, errors.map(|errors| errors.udi_100_3000))),
        format!(
            "  median daylight factor: {:.2}{} %",
            grid.median_daylight_factor,
            error(errors.map(|errors| errors.median_daylight_factor), 1.0, 2)
        ),
        format!("  EN 17037 by hours: {}", area(&grid.en17037.hourly)),
        format!(
            "  EN 17037 by daylight factors, {:.0} lx outside: {}",
            grid.en17037.median_diffuse_lx,
            area(&grid.en17037.daylight_factor)
        ),
    ]
}
