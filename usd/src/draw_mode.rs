//! `model:drawMode`: what stands for a model in its place — cards with pictures of it, the edges of its box, or its axes (UsdGeomModelAPI).

use crate::build::{MeshSource, Surface};
use crate::context::Context;
use crate::material::texture;
use crate::prim::Prim;
use crate::pxr::Module;
use crate::vt::AssetPath;
use gonio::mesh::{FacePrimvar, Interpolation, PolygonMesh};
use gonio::scene::{Channel, Closure, Graph, Input, Material, MaterialId, Operation, TextureFilter, TextureId, WrapMode};
use pyo3::{intern, prelude::*};

/// Opacity below which a card is not there.
const OPACITY_THRESHOLD: f32 = 0.1;
/// Width of an edge over the box's diagonal.
const EDGE_WIDTH: f32 = 0.004;
/// Distance between the two sides of a card over the box's diagonal.
const CARD_GAP: f32 = 1e-4;

/// What is drawn in the place of a model.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum DrawMode {
    /// The model itself.
    #[default]
    Default,
    /// Its axes.
    Origin,
    /// The edges of its box.
    Bounds,
    /// Pictures of it.
    Cards,
}

/// The mode that a prim states for itself and what is below it.
pub(crate) fn stated<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<DrawMode> {
    match context.get_authored::<String>(prim, "model:drawMode")?.as_str() {
        "default" => Some(DrawMode::Default),
        "origin" => Some(DrawMode::Origin),
        "bounds" => Some(DrawMode::Bounds),
        "cards" => Some(DrawMode::Cards),
        "inherited" => None,
        other => {
            let message =
                || format!("model:drawMode is '{other}', expected default, origin, bounds, cards or inherited; the model is shown");
            context.once("drawMode", other, &prim.origin(), message);
            None
        }
    }
}

/// Whether a mode takes effect at a prim: at components, and at other models that say so.
pub(crate) fn applies<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> bool {
    let py = prim.py();
    let is_model = prim.object().call_method0(intern!(py, "IsModel")).and_then(|flag| flag.is_truthy()).unwrap_or(false);
    let is_component = || prim.object().call_method0(intern!(py, "IsComponent")).and_then(|flag| flag.is_truthy()).unwrap_or(false);
    is_model && (context.get_authored::<bool>(prim, "model:applyDrawMode").unwrap_or(false) || is_component())
}

/// The stand-in of a model in its own space, with a material for each slot; `None` for models without extent.
pub(crate) fn stand_in<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, mode: DrawMode) -> Option<(MeshSource, Vec<MaterialId>)> {
    let colour = context.get::<[f32; 3]>(prim, "model:drawModeColor").unwrap_or([0.18; 3]);
    let plain = |context: &mut Context<'_, 'py>| vec![context.scene.add_material(Material::diffuse(prim.origin(), colour))];
    let mut quads = Quads::default();
    if mode == DrawMode::Origin {
        (0..3).for_each(|axis| quads.edge([0.0; 3], axis, 1.0, EDGE_WIDTH));
        return Some((quads.source(prim), plain(context)));
    }
    let [min, max] = bounds(context, prim)?;
    let size: [f32; 3] = std::array::from_fn(|axis| max[axis] - min[axis]);
    let diagonal = size.iter().map(|x| x * x).sum::<f32>().sqrt();
    if mode == DrawMode::Bounds {
        for axis in 0..3 {
            for corner in 0..4 {
                let mut start = min;
                start[(axis + 1) % 3] += size[(axis + 1) % 3] * (corner % 2) as f32;
                start[(axis + 2) % 3] += size[(axis + 2) % 3] * (corner / 2) as f32;
                quads.edge(start, axis, size[axis], EDGE_WIDTH * diagonal);
            }
        }
        return Some((quads.source(prim), plain(context)));
    }
    let pictures = FACES.map(|(name, ..)| picture(context, prim, name));
    let is_box = matches!(context.get::<String>(prim, "model:cardGeometry").as_deref(), Some("box" | "fromTexture"));
    if context.get::<String>(prim, "model:cardGeometry").as_deref() == Some("fromTexture") {
        context.unsupported("card geometry from textures (a box is drawn)", &prim.origin());
    }
    let mut materials = Vec::new();
    for (number, (_, axis, is_positive)) in FACES.into_iter().enumerate() {
        // In a cross a picture stands for the other side too.
        let (own, other) = (pictures[number], pictures[number ^ 1]);
        let shown = if is_box { own } else { own.or(other) };
        if shown.is_none() && pictures.iter().any(Option::is_some) {
            continue;
        }
        let middle = 0.5 * (min[axis] + max[axis]);
        let sign = if is_positive { 1.0 } else { -1.0 };
        let place = match (is_box, is_positive) {
            (true, true) => max[axis],
            (true, false) => min[axis],
            (false, _) => middle + sign * CARD_GAP * diagonal,
        };
        let is_mirrored = own.is_none();
        quads.card([min, max], axis, place, is_positive != is_mirrored, materials.len() as u16);
        materials.push(card_material(context, prim, shown, colour));
    }
    Some((quads.source(prim), materials))
}

/// The faces of a box: the name in attributes, the axis, and whether it looks along it.
const FACES: [(&str, usize, bool); 6] =
    [("XPos", 0, true), ("XNeg", 0, false), ("YPos", 1, true), ("YNeg", 1, false), ("ZPos", 2, true), ("ZNeg", 2, false)];

/// The box of a model in its own space.
fn bounds<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>) -> Option<[[f32; 3]; 2]> {
    let py = context.py;
    let compute = || -> PyResult<[[f32; 3]; 2]> {
        let purposes = ["default", "render", "proxy"];
        let cache = Module::UsdGeom.item(py, "BBoxCache")?.call1((&context.time, purposes.to_vec(), true))?;
        let range = cache.call_method1("ComputeUntransformedBound", (prim.object(),))?.call_method0("ComputeAlignedRange")?;
        let corner = |name: &str| -> PyResult<[f32; 3]> {
            let corner = range.call_method0(name)?;
            Ok([corner.get_item(0)?.extract()?, corner.get_item(1)?.extract()?, corner.get_item(2)?.extract()?])
        };
        Ok([corner("GetMin")?, corner("GetMax")?])
    };
    let result = compute();
    let [min, max] = context.attempt_at(prim, "the model's bounds cannot be had, it is left out", result)?;
    let is_sound = (0..3).all(|axis| min[axis].is_finite() && max[axis].is_finite() && min[axis] <= max[axis]);
    is_sound.then_some([min, max])
}

fn picture<'py>(context: &mut Context<'_, 'py>, prim: &Prim<'py>, face: &str) -> Option<TextureId> {
    let name = format!("model:cardTexture{face}");
    let attribute = if prim.has_authored(&name) { prim.attribute(&name)? } else { return None };
    let path: AssetPath = context.get_attribute(&attribute)?;
    if path.authored.is_empty() { None } else { texture(context, &prim.origin(), &path, &attribute, "auto") }
}

/// A diffuse card, cut out by the picture's alpha.
fn card_material(context: &mut Context<'_, '_>, prim: &Prim<'_>, picture: Option<TextureId>, colour: [f32; 3]) -> MaterialId {
    let Some(texture) = picture else { return context.scene.add_material(Material::diffuse(prim.origin(), colour)) };
    let mut graph = Graph::default();
    let st = graph.add(Operation::Primvar { name: "st".into(), fallback: [0.0; 4] }, vec![]);
    let (wrap, filter) = ([WrapMode::Clamp; 2], TextureFilter::Linear);
    let image =
        Operation::Image { texture, wrap, filter, scale: [1.0; 4], bias: [0.0; 4], fallback: [colour[0], colour[1], colour[2], 1.0] };
    let image = graph.add(image, vec![Input::Node(st, Channel::Rgb)]);
    let mut closure = Closure::default();
    closure.set_input("base_color", Input::Node(image, Channel::Rgb));
    closure.set_input("geometry_opacity", Input::Node(image, Channel::A));
    closure.set("specular_weight", 0.0);
    closure.opacity_threshold = OPACITY_THRESHOLD;
    context.scene.add_material(Material { graph, ..Material::of(prim.origin(), closure) })
}

/// Quads under construction.
#[derive(Debug, Default)]
struct Quads {
    points: Vec<[f32; 3]>,
    st: Vec<f32>,
    slots: Vec<u16>,
}

impl Quads {
    fn quad(&mut self, corners: [[f32; 3]; 4], slot: u16) {
        self.points.extend(corners);
        self.st.extend([0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0]);
        self.slots.push(slot);
    }

    /// A card across an axis, whose picture stands upright on z (on y where it lies) to who looks against the axis, or along it.
    fn card(&mut self, [min, max]: [[f32; 3]; 2], axis: usize, place: f32, faces_positive: bool, slot: u16) {
        let (across, up) = [(1, 2), (0, 2), (0, 1)][axis];
        // Seen from the positive side, the second axis runs to the left about y alone.
        let runs_left = (axis == 1) == faces_positive;
        let (left, right) = if runs_left { (max[across], min[across]) } else { (min[across], max[across]) };
        let corner = |side: f32, height: f32| {
            let mut point = [place; 3];
            (point[across], point[up]) = (side, height);
            point
        };
        self.quad([corner(left, min[up]), corner(right, min[up]), corner(right, max[up]), corner(left, max[up])], slot);
    }

    /// A thin beam along an axis.
    fn edge(&mut self, start: [f32; 3], axis: usize, length: f32, width: f32) {
        let (b, c) = ((axis + 1) % 3, (axis + 2) % 3);
        let corner = |along: f32, turn: usize| {
            let mut point = start;
            point[axis] += along;
            point[b] += width * if matches!(turn % 4, 1 | 2) { 0.5 } else { -0.5 };
            point[c] += width * if turn % 4 >= 2 { 0.5 } else { -0.5 };
            point
        };
        let (near, far) = (-0.5 * width, length + 0.5 * width);
        for side in 0..4 {
            self.quad([corner(near, side), corner(near, side + 1), corner(far, side + 1), corner(far, side)], 0);
        }
        for end in [near, far] {
            self.quad([corner(end, 0), corner(end, 1), corner(end, 2), corner(end, 3)], 0);
        }
    }

    fn source(self, prim: &Prim<'_>) -> MeshSource {
        let corners = (0..self.points.len() as u32).collect();
        let st =
            FacePrimvar { name: "st".into(), interpolation: Interpolation::FaceVarying, components: 2, values: self.st, indices: None };
        let face_counts = vec![4; self.slots.len()];
        let polygons = PolygonMesh { points: self.points, face_counts, corners, primvars: vec![st], ..PolygonMesh::default() };
        MeshSource { origin: prim.origin(), polygons, surface: Surface::Polygons, face_slots: Some(self.slots) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cards_show_their_picture_upright_to_who_looks_at_them() {
        let corners = |axis, faces_positive| {
            let mut quads = Quads::default();
            quads.card([[0.0; 3], [1.0, 2.0, 3.0]], axis, 0.5, faces_positive, 0);
            (quads.points[0], quads.points[2])
        };
        assert_eq!(corners(0, true), ([0.5, 0.0, 0.0], [0.5, 2.0, 3.0]));
        assert_eq!(corners(0, false), ([0.5, 2.0, 0.0], [0.5, 0.0, 3.0]));
        assert_eq!(corners(1, true), ([1.0, 0.5, 0.0], [0.0, 0.5, 3.0]));
        assert_eq!(corners(2, true), ([0.0, 0.0, 0.5], [1.0, 2.0, 0.5]));
        assert_eq!(corners(2, false), ([1.0, 0.0, 0.5], [0.0, 2.0, 0.5]));
    }
}
