//! A fitted OpenPBR surface, as numbers, as text and as a USD material.

use gonio::{Error, Result};
use gonio_formats::bsdf::{Fit, FittedAlbedo};
use serde_json::{Value, json};
use std::path::Path;

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

/// The path of a file as a layer at another path names it: relative where both lie in one folder or below it.
///
/// # Errors
/// One of them has no absolute path.
pub(super) fn asset_path(layer: &Path, file: &Path) -> Result<String> {
    let absolute = |path: &Path| std::path::absolute(path).map_err(|error| Error::io(path, error));
    let (layer, file) = (absolute(layer)?, absolute(file)?);
    let relative = layer.parent().and_then(|folder| file.strip_prefix(folder).ok());
    // USD's paths have slashes on every system.
    let text = |path: &Path| path.to_string_lossy().replace('\\', "/");
    Ok(relative.map_or_else(|| text(&file), |relative| format!("./{}", text(relative))))
}

/// A layer with the material: the measurement at `asset` for gonio, and an OpenPBR surface of MaterialX.
pub(super) fn as_usda(fit: &Fit, name: &str, asset: &str) -> String {
    let [r, g, b] = fit.base_color;
    // A name cannot end the comment or the path that it stands in.
    let plain = |text: &str| text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect::<String>();
    let quotes = if asset.contains('@') { "@@@" } else { "@" };
    let (name, asset) = (plain(name), plain(asset));
    let turned = if fit.specular_roughness_anisotropy > 0.0 {
        format!("# The wider way of the lobe is {:.1} degrees from the tangent.\n", fit.rotation_deg)
    } else {
        String::new()
    };
    format!(
        "#usda 1.0\n(\n    defaultPrim = \"Fitted\"\n)\n\n\
         # Fitted to {name}; residual {:.1} % (RMS of cube roots of BSDF x cosine).\n{turned}\
         def Material \"Fitted\"\n{{\n    token outputs:gonio:surface.connect = </Fitted/Measured.outputs:surface>\n    \
         token outputs:mtlx:surface.connect = </Fitted/Surface.outputs:out>\n\n    \
         def Shader \"Measured\"\n    {{\n        uniform token info:id = \"gonio:MeasuredBSDF\"\n        \
         asset inputs:file = {quotes}{asset}{quotes}\n        \
         token outputs:surface\n    }}\n\n    \
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_below_the_layer_are_named_from_there() {
        let path = |layer: &str, file: &str| asset_path(Path::new(layer), Path::new(file)).expect("absolute paths");
        assert_eq!(path("/a/gold.usda", "/a/gold.binary"), "./gold.binary");
        assert_eq!(path("/a/gold.usda", "/a/measured/gold.binary"), "./measured/gold.binary");
        assert_eq!(path("/a/b/gold.usda", "/a/gold.binary"), "/a/gold.binary");
        let fit = Fit {
            base_color: [0.5; 3],
            base_metalness: 0.0,
            specular_roughness: 0.3,
            specular_roughness_anisotropy: 0.0,
            specular_ior: 1.5,
            rotation_deg: 0.0,
            residual: 0.0,
            albedo: Vec::new(),
        };
        assert!(as_usda(&fit, "a", "./me@home.bsdf").contains("inputs:file = @@@./me@home.bsdf@@@"));
    }
}
