//! What a spectrum says, for machines.

use super::Lamp;
use gonio_spectrum::{HueBin, OPSINS, TOLERANCE};
use serde_json::{Map, Value, json};

/// Everything in one object; what is undefined is null.
pub(super) fn as_json(lamp: &Lamp) -> Value {
    let figures = &lamp.figures;
    let white = figures.white.as_ref();
    let rendering = white.map(|white| &white.rendering);
    let tm30 = white.and_then(|white| white.rendition.as_ref());
    let receptors = OPSINS.iter().zip(&figures.alpha_opic);
    let alpha_opic: Map<String, Value> = receptors
        .map(|((short, _), found)| ((*short).to_owned(), json!({ "elr_mw_per_lm": found.elr_mw_per_lm, "der": found.der })))
        .collect();
    json!({
        "source": lamp.asked,
        "name": lamp.spectrum.name,
        "points": lamp.spectrum.power.len(),
        "first_nm": lamp.spectrum.wavelengths_nm.first(),
        "last_nm": lamp.spectrum.wavelengths_nm.last(),
        "peak_nm": figures.peak_nm,
        "x": figures.xy[0],
        "y": figures.xy[1],
        "u_prime": figures.uv[0],
        "v_prime": figures.uv[1],
        "cct": white.map(|white| white.cct),
        "duv": white.map(|white| white.duv),
        "ra": rendering.map(|rendering| rendering.ra),
        "r": rendering.map(|rendering| rendering.r),
        "ra_in_range": rendering.map(|rendering| rendering.distance <= TOLERANCE),
        "reference_distance": rendering.map(|rendering| rendering.distance),
        "rf": tm30.map(|tm30| tm30.rf),
        "rg": tm30.map(|tm30| tm30.rg),
        "rf_samples": tm30.map(|tm30| &tm30.samples),
        "hue_bins": tm30.map(|tm30| tm30.bins.iter().map(bin_json).collect::<Vec<_>>()),
        "melanopic_der": figures.alpha_opic[4].der,
        "alpha_opic": alpha_opic,
        "ler": figures.ler,
        "notes": figures.notes,
    })
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
