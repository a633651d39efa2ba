//! A grid's year as lines for a reader.

use crate::arguments::MetricArgument as Metric;
use gonio_annual::{Electric, Grid, Method};

/// The lines of a grid; of all figures, or of those that were chosen.
pub(super) fn lines(name: &str, grid: &Grid, chosen: &[Metric]) -> Vec<String> {
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
    let exposure = exposure.map_or("not known without coefficients of the sun".into(), |exposure| format!("{exposure} of the points"));
    let mean = format!("{:.0}{} lx", grid.mean_lx, error(errors.map(|errors| errors.mean_lx), 1.0, 0));
    let factor = format!("{:.2}{} %", grid.median_daylight_factor, error(errors.map(|errors| errors.median_daylight_factor), 1.0, 2));
    let autonomy = per_cent(grid.sda_300_50, errors.map(|errors| errors.sda_300_50));
    let useful = per_cent(grid.udi_100_3000, errors.map(|errors| errors.udi_100_3000));
    let provision = &grid.en17037;
    let figures = [
        (Metric::Sda, format!("sDA 300/50 %: {autonomy} of the points")),
        (Metric::Ase, format!("ASE 1000/250 h: {exposure}")),
        (Metric::Mean, format!("mean illuminance: {mean}")),
        (Metric::Udi, format!("UDI 100-3000 lx: {useful} of the used hours")),
        (Metric::DaylightFactor, format!("median daylight factor: {factor}")),
        (Metric::En17037, format!("EN 17037 by hours: {}", area(&provision.hourly))),
        (
            Metric::En17037,
            format!("EN 17037 by daylight factors, {:.0} lx outside: {}", provision.median_diffuse_lx, area(&provision.daylight_factor)),
        ),
    ];
    let head = format!("{name}: {} points, {:.0} used hours", grid.points.len(), grid.used_hours);
    let electric = grid.electric.as_ref().map(|found| electric(found, errors.and_then(|errors| errors.electric.as_ref())));
    let told = figures.into_iter().filter(|(metric, _)| chosen.is_empty() || chosen.contains(metric));
    std::iter::once(head).chain(told.map(|(_, line)| line).chain(electric).map(indented)).collect()
}

/// How long the blinds of groups of windows are closed, where there are any.
pub(super) fn closed(facades: &[&str], hours: &[f64]) -> Option<String> {
    let told = |(name, hours): (&&str, &f64)| format!("{name}{}{hours:.0}", if name.is_empty() { "" } else { " " });
    let told: Vec<String> = facades.iter().zip(hours).map(told).collect();
    (!told.is_empty()).then(|| indented(format!("blinds closed, used hours: {}", told.join(", "))))
}

fn indented(line: String) -> String {
    format!("  {line}")
}

/// Electric light beside daylight, with its standard errors.
fn electric(found: &Electric, errors: Option<&Electric>) -> String {
    let error = |of: &dyn Fn(&Electric) -> f64, digits: usize| errors.map_or(String::new(), |errors| format!(" ± {:.digits$}", of(errors)));
    let dependency = |found: &Electric| found.daylight_dependency.unwrap_or(0.0);
    format!(
        "electric light: LENI {:.2}{} kWh/m², {:.2} without daylight; F_D {:.3}{} in {:.0} hours with daylight",
        found.leni_kwh_m2,
        error(&|found| found.leni_kwh_m2, 2),
        found.leni_without_daylight_kwh_m2,
        dependency(found),
        error(&dependency, 3),
        found.daylight_hours,
    )
}
