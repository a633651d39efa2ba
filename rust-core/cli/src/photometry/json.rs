//! What a luminaire's file holds, for machines.

use super::{
    text::{percents, shape_name, symmetry_name, type_name},
    ugr,
};
use crate::arguments::PhotometryOptions;
use gonio_formats::photometry::{Aside, Figures, Goniogram, LampSet, UgrTable};
use serde_json::{Value, json};

/// Everything in one object.
pub(super) fn as_json(options: &PhotometryOptions, goniogram: &Goniogram, figures: &Figures, table: Option<&UgrTable>) -> Value {
    let front = options.front.unwrap_or_else(|| goniogram.street_side());
    let zones = goniogram.zones(front);
    json!({
        "file": options.file.to_string_lossy(),
        "photometric_type": type_name(goniogram.photometric_type),
        "symmetry": symmetry_name(goniogram.symmetry),
        "symmetry_found": symmetry_name(figures.symmetry),
        "planes": goniogram.horizontal.len(),
        "angles": goniogram.vertical.len(),
        "flux_lm": figures.flux,
        "downward_fraction": figures.downward_fraction,
        "light_output_ratio": figures.light_output_ratio,
        "watts": figures.watts,
        "efficacy_lm_per_w": figures.efficacy,
        "peak_cd": figures.peak,
        "peak_direction_deg": figures.peak_direction,
        "beam_angle_deg": figures.beam.map(|spread| spread.angle()),
        "field_angle_deg": figures.field.map(|spread| spread.angle()),
        "beam_aside": figures.aside.as_ref().map(aside_json),
        "cie_flux_codes": goniogram.flux_codes().map(percents),
        "bug": zones.rating(goniogram.is_square()).to_string(),
        "zones_lm": json!({ "forward": zones.forward, "back": zones.back, "up": zones.up, "front_deg": front }),
        "ugr_table": table.map(ugr::as_json),
        "opening": json!({
            "shape": shape_name(goniogram.opening.shape),
            "size_m": goniogram.opening.size,
            "heights_m": goniogram.opening.heights,
        }),
        "lamp_set": goniogram.lamp_set + 1,
        "lamp_sets": goniogram.lamp_sets.iter().map(lamps_json).collect::<Vec<_>>(),
        "tilt": goniogram.tilt.as_ref().map(|tilt| json!({
            "lamp_to_luminaire": tilt.lamp_to_luminaire,
            "angles_deg": tilt.angles,
            "factors": tilt.factors,
        })),
        "spectrum": goniogram.spectrum.as_ref().map(|spectrum| json!({
            "name": spectrum.name,
            "wavelengths_nm": spectrum.wavelengths_nm,
            "power": spectrum.power,
        })),
        "header": goniogram.header.iter().map(|line| [&line.keyword, &line.text]).collect::<Vec<_>>(),
        "warnings": goniogram.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
    })
}

/// A beam whose axis is in neither C0–C180 nor C90–C270.
pub(crate) fn aside_json(aside: &Aside) -> Value {
    json!({ "c_deg": aside.c, "beam_angle_deg": aside.beam.angle(), "field_angle_deg": aside.field.angle() })
}

fn lamps_json(set: &LampSet) -> Value {
    json!({
        "count": set.count,
        "name": set.name,
        "flux_lm": set.flux,
        "absolute": set.absolute,
        "watts": set.watts,
        "colour": set.colour,
        "colour_rendering": set.colour_rendering,
    })
}
