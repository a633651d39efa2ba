//! A fitted OpenPBR surface, as numbers, as text and as a USD material.

use gonio_formats::bsdf::{Fit, FittedAlbedo};
use serde_json::{Value, json};

/// The parameters by their names in OpenPBR, the residual, and albedos beside the measured ones.
pub(super) fn as_json(fit: &Fit) -> Value {
    let albedo = |row: &FittedAlbedo| json!({ "theta_deg": row.theta_deg, "measured": row.measured, "fitted": row.fitted });
    json!({
        "base_color": fit.base_color,
        "base_metalness": fit.base_metalness,
        "specular_roughness": fit.specular_roughness,
        "specular_roughness_anisotropy": fit.specular_roughness_anisotropy,
        "specular_ior": fit.specular_ior,
        "rotation_deg": fit.rotation_deg,
        "residual": fit.residual,
        "albedo": fit.albedo.iter().map(albedo).collect::<Vec<_>>(),
    })
}

/// The fit in lines.
pub(super) fn as_text(fit: &Value) -> Vec<String> {
    let number = |key: &str| fit[key].as_f64().unwrap_or(0.0);
    let colour = |colour: &Value| {
        let channels = colour.as_array().map_or(&[][..], Vec::as_slice).iter();
        channels.map(|c| format!("{:.3}", c.as_f64().unwrap_or(0.0))).collect::<Vec<_>>().join(" ")
    };
    if fit.is_null() {
        return Vec::new();
    }
    let mut lines = vec![format!(
        "fit to OpenPBR: base_color {}, base_metalness {:.3}, specular_roughness {:.3}, specular_ior {:.3}",
        colour(&fit["base_color"]),
        number("base_metalness"),
        number("specular_roughness"),
        number("specular_ior")
    )];
    if number("specular_roughness_anisotropy") > 0.0 {
        let (anisotropy, rotation) = (number("specular_roughness_anisotropy"), number("rotation_deg"));
        lines.push(format!("  specular_roughness_anisotropy {anisotropy:.3}, its wider way {rotation:.1}° from the tangent"));
    }
    lines.push(format!("  residual: {:.1} % (RMS of cube roots of BSDF × cosine)", 100.0 * number("residual")));
    for row in fit["albedo"].as_array().map_or(&[][..], Vec::as_slice) {
        let theta = row["theta_deg"].as_f64().unwrap_or(0.0);
        lines.push(format!("  albedo at {theta}°: {} measured, {} fitted", colour(&row["measured"]), colour(&row["fitted"])));
    }
    lines
}

/// A layer with the material: an OpenPBR surface of MaterialX.
pub(super) fn as_usda(fit: &Fit, name: &str) -> String {
    let [r, g, b] = fit.base_color;
    // A name cannot end the comment that it stands in.
    let name: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let turned = if fit.specular_roughness_anisotropy > 0.0 {
        format!("# The wider way of the lobe is {:.1} degrees from the tangent.\n", fit.rotation_deg)
    } else {
        String::new()
    };
    format!(
        "#usda 1.0\n(\n    defaultPrim = \"Fitted\"\n)\n\n\
         # Fitted to {name}; residual {:.1} % (RMS of cube roots of BSDF x cosine).\n{turned}\
         def Material \"Fitted\"\n{{\n    token outputs:mtlx:surface.connect = </Fitted/Surface.outputs:out>\n\n    \
         def Shader \"Surface\"\n    {{\n        uniform token info:id = \"ND_open_pbr_surface_surfaceshader\"\n        \
         color3f inputs:base_color = ({r:.5}, {g:.5}, {b:.5})\n        \
         float inputs:base_metalness = {:.5}\n        \
         float inputs:specular_roughness = {:.5}\n        \
         float inputs:specular_roughness_anisotropy = {:.5}\n        \
         float inputs:specular_ior = {:.5}\n        \
         token outputs:out\n    }}\n}}\n",
        100.0 * fit.residual,
        fit.base_metalness,
        fit.specular_roughness,
        fit.specular_roughness_anisotropy,
        fit.specular_ior,
    )
}
