//! A road's results for readers, line by line.

use crate::{
    optimise::Best,
    results::{Classed, Footing, Illuminances, Observed, Results, Verdict},
};
use gonio_formats::tame;

/// A number that may have no meaning.
pub fn number(value: Option<f64>, digits: usize) -> String {
    value.map_or("–".to_owned(), |value| format!("{value:.digits$}"))
}

/// Names of the columns of [`observer_rows`].
pub const OBSERVER_COLUMNS: [&str; 7] = ["lane", "y, m", "Lav, cd/m²", "Uo", "Ul", "TI, %", "Lav initial, cd/m²"];

/// A row of values for the observer in each lane.
pub fn observer_rows(results: &Results) -> Vec<Vec<String>> {
    let row = |seen: &Observed| {
        vec![
            seen.lane.to_string(),
            format!("{:.2}", seen.position[1]),
            format!("{:.3}", seen.l_av),
            number(seen.uo, 3),
            number(seen.ul, 3),
            number(seen.ti, 1),
            format!("{:.3}", seen.l_av_initial),
        ]
    };
    results.observers.iter().map(row).collect()
}

/// Results of the road as a whole, in lines.
pub fn summary(results: &Results) -> Vec<String> {
    let mut lines = vec![
        format!("average luminance Lav: {:.3} cd/m²", results.l_av),
        format!("overall uniformity Uo: {}", number(results.uo, 3)),
        format!("longitudinal uniformity Ul: {}", number(results.ul, 3)),
        format!("threshold increment TI: {} %", number(results.ti, 1)),
        format!("edge illuminance ratio EIR: {}", number(results.eir, 3)),
    ];
    if results.wet_surface.is_some() {
        lines.push(format!("overall uniformity of the wet road Uow: {}", number(results.uo_wet, 3)));
    }
    lines.push(format!("carriageway: {}", illuminances(&results.illuminances)));
    if let Some(energy) = results.energy {
        lines.push(format!(
            "energy: {:.1} W/km, power density indicator {} mW/(lx·m²), {:.3} kWh/m² a year",
            energy.power_w_per_km,
            number(energy.pdi, 1),
            energy.aeci
        ));
    }
    lines
}

/// Illuminances of an area in a line.
fn illuminances(of: &Illuminances) -> String {
    format!(
        "E average {:.2} lx, least {:.2} lx, greatest {:.2} lx, U0 {}; hemispherical average {:.2} lx, U0 {}; \
         least semicylindrical {:.2} lx, least vertical {:.2} lx",
        of.e_av,
        of.e_min,
        of.e_max,
        number(of.u0, 3),
        of.e_hs_av,
        number(of.u0_hs, 3),
        of.e_sc_min,
        of.e_v_min
    )
}

/// Everything, line by line.
pub fn lines(results: &Results) -> Vec<String> {
    let field = &results.field;
    let surface = &results.surface;
    let mut lines = vec![
        format!("conventions: {}", results.standard),
        format!(
            "field: {:.2} m between luminaires, points of luminance {} along × {} across, of illuminance {} × {}",
            field.length,
            field.along,
            field.across,
            field.along,
            results.illuminance_y.len()
        ),
        format!("surface: {}, Q0 {:.4}, S1 {}", surface.name, surface.q0, number(surface.s1, 3)),
    ];
    lines.extend(results.wet_surface.iter().map(|wet| format!("wet surface: {}, Q0 {:.4}, S1 {}", wet.name, wet.q0, number(wet.s1, 3))));
    lines.extend(summary(results));
    for seen in &results.observers {
        lines.push(format!(
            "observer in lane {} (y {:.2} m): Lav {:.3} cd/m², Uo {}, Ul {}, TI {} %",
            seen.lane,
            seen.position[1],
            seen.l_av,
            number(seen.uo, 3),
            number(seen.ul, 3),
            number(seen.ti, 1)
        ));
    }
    for edge in &results.edges {
        let ratio = number(edge.ratio, 3);
        lines.push(format!("{} edge: {:.2} lx outside, {:.2} lx inside, ratio {ratio}", edge.side, edge.outside, edge.inside));
    }
    lines.extend(results.footpaths.iter().map(|path| format!("{}: {}", path.name, illuminances(&path.illuminances))));
    lines.extend(requirements(results));
    lines.extend(results.notes.iter().map(|note| format!("note: {note}")));
    // Texts of files must not reach into the terminal.
    lines.iter().map(|line| tame(line)).collect()
}

/// The class that is met, and what the others miss.
fn classes(results: &Results) -> Vec<String> {
    let first = results.class.as_ref().map_or("class: none of the file's is met".to_owned(), |class| format!("class: {class}"));
    let missed = |class: &Classed| -> Vec<String> {
        class.required.iter().filter(|verdict| !verdict.met).map(|verdict| told(&format!("class {}", class.name), verdict)).collect()
    };
    let lines = std::iter::once(first).chain(results.classes.iter().flat_map(missed));
    lines.filter(|_| !results.classes.is_empty()).collect()
}

/// What was required, with what became of it, and classes.
pub fn requirements(results: &Results) -> Vec<String> {
    let own = results.required.iter().map(|verdict| told("road", verdict));
    let of_path = |path: &Footing| path.required.iter().map(|verdict| told(&path.name, verdict)).collect::<Vec<_>>();
    own.chain(results.footpaths.iter().flat_map(of_path)).chain(classes(results)).collect()
}

fn told(of: &str, verdict: &Verdict) -> String {
    let Verdict { key, required, at_most, found, met } = verdict;
    let bound = if *at_most { "at most" } else { "at least" };
    format!("{of}: {key} {}, {bound} {required} required: {}", number(*found, 3), if *met { "met" } else { "not met" })
}

/// What a search for the largest spacing found.
pub fn optimised(best: &Best) -> String {
    let Some(spacing) = best.spacing else {
        return format!("no road within the ranges meets what is required, of {} that were tried; the road of the file:", best.tried);
    };
    let height = best.height.map_or(String::new(), |height| format!(", height {height:.2} m"));
    let tilt = best.tilt.map_or(String::new(), |tilt| format!(", tilt {tilt:.1}°"));
    format!("largest spacing that meets what is required: {spacing:.2} m{height}{tilt}, of {} roads that were tried", best.tried)
}
