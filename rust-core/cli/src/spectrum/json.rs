//! What a spectrum says, for machines.

use super::Lamp;
use gonio_spectrum::{AlphaOpic, CieObserver, Figures, HueBin, OPSINS, TOLERANCE};
use serde_json::{Map, Value, json};

/// Everything in one object; what is undefined is null.
pub(super) fn as_json(lamp: &Lamp) -> Value {
    let mut all = figures_json(&lamp.figures);
    let chromaticities = CieObserver::ALL.map(|observer| (observer.name().to_owned(), json!(observer.chromaticity(&lamp.spectrum))));
    let of_data = [
        ("source", json!(lamp.asked)),
        ("name", json!(lamp.spectrum.name)),
        ("chromaticities", Value::from_iter(chromaticities)),
        ("points", json!(lamp.spectrum.power.len())),
        ("first_nm", json!(lamp.spectrum.wavelengths_nm.first())),
        ("last_nm", json!(lamp.spectrum.wavelengths_nm.last())),
    ];
    all.extend(of_data.map(|(name, value)| (name.to_owned(), value)));
    Value::Object(all)
}

/// All figures of a spectrum; what is undefined is null.
pub(in super::super) fn figures_json(figures: &Figures) -> Map<String, Value> {
    let white = figures.white.as_ref();
    let rendering = white.and_then(|white| white.rendering.as_ref());
    let tm30 = white.and_then(|white| white.rendition.as_ref());
    let receptor = |((short, _), found): (&(&str, &str), &AlphaOpic)| {
        ((*short).to_owned(), json!({ "elr_mw_per_lm": found.elr_mw_per_lm, "der": found.der }))
    };
    let alpha_opic = figures.alpha_opic.as_ref().map(|all| OPSINS.iter().zip(all).map(receptor).collect::<Map<String, Value>>());
    let all = [
        ("peak_nm", json!(figures.peak_nm)),
        ("x", json!(figures.xy[0])),
        ("y", json!(figures.xy[1])),
        ("u_prime", json!(figures.uv[0])),
        ("v_prime", json!(figures.uv[1])),
        ("cct", json!(white.map(|white| white.cct))),
        ("duv", json!(white.map(|white| white.duv))),
        ("ra", json!(rendering.map(|rendering| rendering.ra))),
        ("r", json!(rendering.map(|rendering| rendering.r))),
        ("ra_in_range", json!(rendering.map(|rendering| rendering.distance <= TOLERANCE))),
        ("reference_distance", json!(rendering.map(|rendering| rendering.distance))),
        ("rf", json!(tm30.map(|tm30| tm30.rf))),
        ("rg", json!(tm30.map(|tm30| tm30.rg))),
        ("rf_samples", json!(tm30.map(|tm30| &tm30.samples))),
        ("hue_bins", json!(tm30.map(|tm30| tm30.bins.iter().map(bin_json).collect::<Vec<_>>()))),
        ("melanopic_der", json!(figures.melanopic_der())),
        ("alpha_opic", json!(alpha_opic)),
        ("ler", json!(figures.ler)),
        ("notes", json!(figures.notes)),
    ];
    all.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

fn bin_json(bin: &HueBin) -> Value {
    json!({
        "rf": bin.fidelity,
        "rcs_percent": bin.chroma_shift,
        "rhs": bin.hue_shift,
        "test_ab": bin.test,
        "reference_ab": bin.reference,
    })
}
