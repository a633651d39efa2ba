//! What spectra say, for readers.

use super::Lamp;
use gonio_formats::tame;
use gonio_spectrum::{CieObserver, OPSINS, Rendering, Rendition, TOLERANCE, White};

/// The longest name in a table.
const LONGEST_NAME: usize = 32;

/// One lamp, line by line.
pub(super) fn as_text(lamp: &Lamp) -> Vec<String> {
    let (spectrum, figures) = (&lamp.spectrum, &lamp.figures);
    let [first, last] = [spectrum.wavelengths_nm.first(), spectrum.wavelengths_nm.last()].map(|nm| nm.copied().unwrap_or(0.0));
    let ([x, y], [u, v]) = (figures.xy, figures.uv);
    let mut lines = vec![
        format!("{}: {} points from {first} to {last} nm, most power at {} nm", spectrum.name, spectrum.power.len(), figures.peak_nm),
        format!("chromaticity: x {x:.4}, y {y:.4} (CIE 1931); u' {u:.4}, v' {v:.4} (CIE 1976)"),
    ];
    let [_, others @ ..] = CieObserver::ALL.map(|observer| (observer.name(), observer.chromaticity(spectrum)));
    let others = others.map(|(name, [x, y])| format!("x {x:.4}, y {y:.4} ({name})"));
    lines.push(format!("  by other observers: {}", others.join("; ")));
    match &figures.white {
        Some(white) => lines.extend(white_lines(white)),
        None => lines.push("CCT, Duv, Ra, Rf, Rg: undefined".to_owned()),
    }
    lines.push(format!("luminous efficacy of radiation: {:.1} lm/W within {first} to {last} nm", figures.ler));
    lines.extend(figures.melanopic_der().map(|der| {
        format!("melanopic DER: {der:.3} (CIE S 026), so 100 lx are {:.1} lx of melanopic equivalent daylight (EDI)", 100.0 * der)
    }));
    let receptors = OPSINS.iter().zip(figures.alpha_opic.iter().flatten());
    let receptors = receptors.map(|((_, name), found)| format!("{name} {:.4} mW/lm (DER {:.3})", found.elr_mw_per_lm, found.der));
    lines.push(format!("alpha-opic efficacies: {}", receptors.collect::<Vec<_>>().join(", ")));
    lines.extend(figures.notes.iter().map(|note| format!("note: {note}")));
    // Texts of a file must not reach into the terminal.
    lines.iter().map(|line| tame(line)).collect()
}

fn white_lines(white: &White) -> Vec<String> {
    let mut lines = vec![format!("CCT: {:.0} K, Duv {:+.4}", white.cct, white.duv)];
    if let Some(rendering) = &white.rendering {
        let special: Vec<String> = rendering.r.iter().enumerate().map(|(k, r)| format!("R{} {r:.0}", k + 1)).collect();
        lines.extend([format!("CRI (CIE 13.3): Ra {}", marked(rendering)), format!("  {}", special.join("  "))]);
    }
    match &white.rendition {
        Some(tm30) => lines.extend(tm30_lines(tm30)),
        None => lines.push("TM-30-20: undefined".to_owned()),
    }
    lines
}

/// Ra, with a star where the method does not hold.
fn marked(rendering: &Rendering) -> String {
    let star = if rendering.distance > TOLERANCE { "*" } else { "" };
    format!("{:.1}{star}", rendering.ra)
}

fn tm30_lines(tm30: &Rendition) -> Vec<String> {
    let row = |name: &str, cell: &dyn Fn(usize) -> String| {
        format!("  {name:<10}{}", (0..tm30.bins.len()).map(|k| format!("{:>6}", cell(k))).collect::<String>())
    };
    vec![
        format!("TM-30-20: Rf {:.1}, Rg {:.1}", tm30.rf, tm30.rg),
        row("hue bin", &|k| (k + 1).to_string()),
        row("Rf,h", &|k| format!("{:.0}", tm30.bins[k].fidelity)),
        row("Rcs,h, %", &|k| format!("{:+.0}", tm30.bins[k].chroma_shift)),
        row("Rhs,h", &|k| format!("{:+.2}", tm30.bins[k].hue_shift)),
    ]
}

/// Several lamps, a row each, and their notes.
pub(super) fn as_table(lamps: &[Lamp]) -> Vec<String> {
    let names: Vec<String> = lamps.iter().map(|lamp| lamp.spectrum.name.chars().take(LONGEST_NAME).collect()).collect();
    let width = names.iter().map(|name| name.chars().count()).max().unwrap_or(0).max("lamp".len());
    let mut lines = vec![format!(
        "{:<width$} {:>7} {:>7} {:>7} {:>8} {:>6} {:>5} {:>6} {:>6} {:>8} {:>7}",
        "lamp", "x", "y", "CCT, K", "Duv", "Ra", "R9", "Rf", "Rg", "mel DER", "lm/W"
    )];
    for (lamp, name) in lamps.iter().zip(&names) {
        let figures = &lamp.figures;
        let white = figures.white.as_ref();
        let tm30 = white.and_then(|white| white.rendition.as_ref());
        let cell = |text: Option<String>| text.unwrap_or_else(|| "–".to_owned());
        lines.push(format!(
            "{name:<width$} {:>7.4} {:>7.4} {:>7} {:>8} {:>6} {:>5} {:>6} {:>6} {:>8} {:>7.1}",
            figures.xy[0],
            figures.xy[1],
            cell(white.map(|white| format!("{:.0}", white.cct))),
            cell(white.map(|white| format!("{:+.4}", white.duv))),
            cell(white.and_then(|white| white.rendering.as_ref()).map(marked)),
            cell(white.and_then(|white| white.special_index(9)).map(|r9| format!("{r9:.0}"))),
            cell(tm30.map(|tm30| format!("{:.1}", tm30.rf))),
            cell(tm30.map(|tm30| format!("{:.1}", tm30.rg))),
            cell(figures.melanopic_der().map(|der| format!("{der:.3}"))),
            figures.ler,
        ));
    }
    let notes =
        lamps.iter().zip(&names).flat_map(|(lamp, name)| lamp.figures.notes.iter().map(move |note| format!("note: {name}: {note}")));
    lines.extend(notes);
    // Texts of a file must not reach into the terminal.
    lines.iter().map(|line| tame(line)).collect()
}
