//! A USD layer that puts maps onto the prims that they are of.

use super::{
    gather::{Chart, IlluminationMaps, SurfaceMap},
    view::Quantity,
};
use crate::scene::{Mesh, Scene};
use std::{
    collections::{BTreeMap, HashMap},
    fmt::Write,
};

/// A prim's own faces, before they were divided into triangles.
#[derive(Clone, Debug, Default)]
pub struct FaceTable {
    /// Corners of each face.
    pub counts: Vec<u32>,
    /// Points of the corners.
    pub indices: Vec<u32>,
    /// Points.
    pub points: usize,
}

/// Normals of triangles that meet in a point may differ by so much, as a cosine, where their values are joined.
pub(super) const SAME_SURFACE: f64 = 0.866;

/// The text of a layer over the stage: `primvars:gonio:illuminance` (lux of the front; `…:back` of the back), or the texture's name where one is
/// told. `faces` tells a prim's faces; surfaces without are left out, as is what is placed several times. Gives how many were written.
pub fn map_layer(
    scene: &Scene,
    maps: &IlluminationMaps,
    faces: &dyn Fn(&str) -> Option<FaceTable>,
    textures: &HashMap<usize, String>,
) -> (String, usize) {
    let mut root = Node::default();
    let mut written = 0;
    for (number, map) in maps.surfaces.iter().enumerate() {
        let name = &*map.surface.origin.name;
        let Some(faces) = faces(name).filter(|_| map.surface.placement[1] == 1 && name.starts_with('/')) else { continue };
        let node =
            name.split('/').filter(|part| !part.is_empty()).fold(&mut root, |node, part| node.children.entry(part.into()).or_default());
        if let Some(texture) = textures.get(&number) {
            node.lines.push(format!("asset gonio:illuminance:map = @{texture}@"));
        }
        if matches!(map.chart, Chart::Cells(_)) {
            let mesh = &scene.meshes[map.surface.mesh.index()];
            for (side, suffix) in [(0, ""), (1, ":back")] {
                if map.sides[side].is_some() {
                    node.lines.push(primvar(map, mesh, &faces, side, suffix));
                }
            }
        }
        written += 1;
    }
    let mut text = String::from("#usda 1.0\n(\n    doc = \"Illuminance in lux, by gonio\"\n)\n");
    root.write(&mut text, 0);
    (text, written)
}

/// A prim of the layer.
#[derive(Default)]
struct Node {
    lines: Vec<String>,
    children: BTreeMap<String, Node>,
}

impl Node {
    fn write(&self, text: &mut String, depth: usize) {
        let indent = "    ".repeat(depth);
        for line in &self.lines {
            // Writing to a string does not fail.
            let _ = writeln!(text, "{indent}{line}");
        }
        for (name, child) in &self.children {
            let _ = writeln!(text, "\n{indent}over \"{name}\"\n{indent}{{");
            child.write(text, depth + 1);
            let _ = writeln!(text, "{indent}}}");
        }
    }
}

/// The primvar of a side: by corners where the mesh has the prim's points, else by faces.
fn primvar(map: &SurfaceMap, mesh: &Mesh, faces: &FaceTable, side: usize, suffix: &str) -> String {
    let (values, interpolation) = match by_corner(map, mesh, faces, side) {
        Some(values) => (values, "faceVarying"),
        None => (by_face(map, mesh, faces, side), "uniform"),
    };
    let list: Vec<String> = values.iter().map(ToString::to_string).collect();
    format!("float[] primvars:gonio:illuminance{suffix} = [{}] (interpolation = \"{interpolation}\")", list.join(", "))
}

/// The prim's face that a triangle is of.
fn face_of(mesh: &Mesh, triangle: usize) -> u32 {
    mesh.faces.as_ref().and_then(|faces| faces.get(triangle).copied()).unwrap_or(triangle as u32)
}

/// Means over faces; 0 of faces without area.
fn by_face(map: &SurfaceMap, mesh: &Mesh, faces: &FaceTable, side: usize) -> Vec<f32> {
    let mut sums = vec![[0.0; 2]; faces.counts.len()];
    for (triangle, area) in map.surface.areas.iter().enumerate() {
        if let Some(sum) = sums.get_mut(face_of(mesh, triangle) as usize) {
            *sum = [sum[0] + area * map.mean_of(side, triangle, Quantity::Illuminance), sum[1] + area];
        }
    }
    sums.iter().map(|[sum, area]| if *area > 0.0 { (sum / area) as f32 } else { 0.0 }).collect()
}

/// Values at the faces' corners; none where triangles do not stand on the prim's points.
fn by_corner(map: &SurfaceMap, mesh: &Mesh, faces: &FaceTable, side: usize) -> Option<Vec<f32>> {
    if mesh.points.len() != faces.points {
        return None;
    }
    let values = map.at_corners(mesh, side, Quantity::Illuminance);
    let mut found: HashMap<(u32, u32), f32> = HashMap::new();
    for (triangle, corners) in mesh.triangles.iter().enumerate() {
        for (corner, point) in corners.iter().enumerate() {
            found.insert((face_of(mesh, triangle), *point), values[triangle][corner]);
        }
    }
    let mut out = Vec::with_capacity(faces.indices.len());
    let mut at = 0;
    for (face, count) in faces.counts.iter().enumerate() {
        let corners = faces.indices.get(at..at + *count as usize)?;
        // Corners that no triangle has lie on an edge or in a face without area.
        out.extend(corners.iter().map(|point| found.get(&(face as u32, *point)).copied().unwrap_or(0.0)));
        at += *count as usize;
    }
    Some(out)
}

/// Unit normal of a triangle in the mesh's space; zero where it has none.
fn normal(mesh: &Mesh, corners: [u32; 3]) -> [f64; 3] {
    let [Some(a), Some(b), Some(c)] = corners.map(|corner| mesh.points.get(corner as usize).map(|point| point.map(f64::from))) else {
        return [0.0; 3];
    };
    let (u, v) = ([0, 1, 2].map(|k| b[k] - a[k]), [0, 1, 2].map(|k| c[k] - a[k]));
    let cross = [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3]);
    let length = cross.iter().map(|x| x * x).sum::<f64>().sqrt();
    if length > 0.0 { cross.map(|x| x / length) } else { [0.0; 3] }
}

impl SurfaceMap {
    /// Lux at the corners of the mesh's triangles: those of neighbours that lie in the same surface are joined; 0 where nothing arrived.
    pub fn at_corners(&self, mesh: &Mesh, side: usize, quantity: Quantity) -> Vec<[f32; 3]> {
        let normals: Vec<[f64; 3]> = mesh.triangles.iter().map(|corners| normal(mesh, *corners)).collect();
        let mut around: Vec<Vec<(u32, f64)>> = vec![Vec::new(); mesh.points.len()];
        const CORNERS: [[f32; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        for (triangle, corners) in mesh.triangles.iter().enumerate() {
            for (corner, point) in corners.iter().enumerate() {
                let value = f64::from(self.at(side, triangle as u32, CORNERS[corner], quantity));
                if let (Some(list), true) = (around.get_mut(*point as usize), value.is_finite()) {
                    list.push((triangle as u32, value));
                }
            }
        }
        let mean = |triangle: usize, point: u32| {
            let (mut sum, mut weights) = (0.0, 0.0);
            for (other, value) in around.get(point as usize).into_iter().flatten() {
                let cosine: f64 = (0..3).map(|k| normals[triangle][k] * normals[*other as usize][k]).sum();
                if *other as usize == triangle || cosine >= SAME_SURFACE {
                    sum += value;
                    weights += 1.0;
                }
            }
            if weights > 0.0 { (sum / weights) as f32 } else { 0.0 }
        };
        mesh.triangles.iter().enumerate().map(|(triangle, corners)| corners.map(|point| mean(triangle, point))).collect()
    }

    /// Mean lux of a triangle of divided ones; 0 of texels, and where nothing arrived.
    pub fn mean_of(&self, side: usize, triangle: usize, quantity: Quantity) -> f64 {
        let (Chart::Cells(chart), Some(map)) = (&self.chart, &self.sides[side]) else { return 0.0 };
        let known = chart.cells(triangle).map(|cell| f64::from(map.value(cell, quantity))).filter(|value| value.is_finite());
        let (sum, count) = known.fold((0.0, 0.0), |(sum, count), value| (sum + value, count + 1.0));
        if count > 0.0 { sum / count } else { 0.0 }
    }
}
