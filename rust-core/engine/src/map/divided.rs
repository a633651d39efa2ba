//! Divided triangles as USD meshes: what a primvar on a coarse mesh cannot hold.

use super::{
    cells::CellChart,
    gather::{Chart, IlluminationMaps, SurfaceMap},
    side::SideMap,
};
use crate::{
    output::FalseColourScale,
    scene::{Mesh, Scene},
};
use std::fmt::Write;

/// Steps of the colours that meshes are shown in.
const STEPS: u32 = 20;

/// The text of a scope `/IlluminationMaps` with a mesh a lit side, to put behind a layer's: a triangle a part, in the stage's own units, with
/// `primvars:gonio:illuminance` in lux and false colours; of purpose guide, so that renders leave them out.
///
/// # Errors
/// None but those of the colours' scale.
pub fn divided_meshes(scene: &Scene, maps: &IlluminationMaps, metres_per_unit: f64) -> crate::Result<String> {
    let mut text = String::from("\ndef Scope \"IlluminationMaps\"\n{\n");
    let all: Vec<f32> =
        maps.surfaces.iter().flat_map(|map| map.sides.iter().flatten()).flat_map(|side| side.illuminance.iter().copied()).collect();
    let scale = FalseColourScale::new(FalseColourScale::round_max(&all), STEPS, None)?;
    for (number, map) in maps.surfaces.iter().enumerate() {
        let Chart::Cells(chart) = &map.chart else { continue };
        for (side, name) in map.sides.iter().zip(["front", "back"]) {
            if let Some(side) = side {
                let prim = map.surface.origin.name.rsplit('/').next().unwrap_or_default();
                let prim: String = prim.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
                let parts = parts(&scene.meshes[map.surface.mesh.index()], map, chart, side, metres_per_unit);
                write_mesh(&mut text, &format!("_{number}_{prim}_{name}"), &parts, &scale);
            }
        }
    }
    text.push_str("}\n");
    Ok(text)
}

/// Corners in the stage's units, and lux.
type Part = ([[f64; 3]; 3], f32);

/// The parts of a side, joined ones whole.
fn parts(mesh: &Mesh, map: &SurfaceMap, chart: &CellChart, side: &SideMap, metres_per_unit: f64) -> Vec<Part> {
    let mut out = Vec::new();
    for (triangle, points) in mesh.triangles.iter().enumerate().filter(|(triangle, _)| map.surface.areas[*triangle] > 0.0) {
        let [a, b, c] = points.map(|point| mesh.points.get(point as usize).map_or([0.0; 3], |point| point.map(f64::from)));
        for (cell, place) in chart.parts(triangle, &side.level) {
            let world = place.map(|[u, v]| map.surface.transform.point([0, 1, 2].map(|k| a[k] * (1.0 - u - v) + b[k] * u + c[k] * v)));
            out.push((world.map(|point| point.map(|x| x / metres_per_unit)), side.illuminance[cell]));
        }
    }
    out
}

fn write_mesh(text: &mut String, name: &str, parts: &[Part], scale: &FalseColourScale) {
    let list = |values: &mut dyn Iterator<Item = String>| values.collect::<Vec<_>>().join(", ");
    let triple = |values: [f64; 3]| format!("({}, {}, {})", values[0] as f32, values[1] as f32, values[2] as f32);
    let points = list(&mut parts.iter().flat_map(|(corners, _)| corners).map(|point| triple(*point)));
    let lux = list(&mut parts.iter().map(|(_, lux)| lux.to_string()));
    let colour = |lux: f32| scale.colour(scale.step(lux).unwrap_or(0)).map(|byte| (f64::from(byte) / 255.0).powf(2.2));
    let colours = list(&mut parts.iter().map(|(_, lux)| triple(colour(*lux))));
    let indices = list(&mut (0..3 * parts.len()).map(|index| index.to_string()));
    // Writing to a string does not fail.
    let _ = write!(
        text,
        "    def Mesh \"{name}\"\n    {{\n        uniform token purpose = \"guide\"\n        uniform token subdivisionScheme = \"none\"\n        bool doubleSided = 1\n        \
         int[] faceVertexCounts = [{}]\n        int[] faceVertexIndices = [{indices}]\n        point3f[] points = [{points}]\n        \
         float[] primvars:gonio:illuminance = [{lux}] (interpolation = \"uniform\")\n        \
         color3f[] primvars:displayColor = [{colours}] (interpolation = \"uniform\")\n    }}\n",
        vec!["3"; parts.len()].join(", ")
    );
}
