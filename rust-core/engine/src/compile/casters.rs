//! What casts caustics: instances that mirror or refract light sharply. Light paths are aimed at them.

use super::{bounds::Bounds, numbers::geometry_number};
use crate::{
    bsdf::Surface,
    error::Diagnostic,
    scene::{Instances, Link, Origin, Scene},
    transport::{Links, MaterialTable, Shading},
};

/// Most targets of light paths; more are joined with their neighbours.
const MOST_TARGETS: usize = 16;

/// What casts caustics, in rebased world space.
#[derive(Clone, Debug, Default)]
pub(crate) struct Casters {
    /// Spheres around them, all of them covered.
    pub(crate) targets: Vec<([f32; 3], f32)>,
    /// The first of them.
    pub(super) first: Option<Origin>,
    /// Whether light paths bring what they cast where settings leave it open.
    pub(crate) pay: bool,
}

impl Casters {
    /// Those of a scene.
    pub(super) fn of(scene: &Scene, meshes: &[Bounds], materials: &MaterialTable, origin: [f64; 3]) -> Self {
        let (mut boxes, mut first) = (Vec::new(), None);
        for instances in &scene.instances {
            let Some(mesh) = meshes.get(geometry_number(scene, instances.geometry)) else { continue };
            if !is_one(instances, materials, |surface| surface.lobes.smooth) {
                continue;
            }
            for transform in &instances.transforms {
                let placed = mesh.transformed(transform);
                if placed.is_empty() {
                    continue;
                }
                boxes.push(placed);
                first.get_or_insert_with(|| instances.origin.clone());
            }
        }
        Self { targets: joined(boxes).iter().map(|one| sphere(one, origin)).collect(), first, pay: false }
    }
}

/// Says what light paths do not know of.
pub(super) fn report_blockers(scene: &Scene, links: &Links, diagnostics: &mut Vec<Diagnostic>) {
    let linked = scene.lights.iter().find(|light| light.linking.blockers != Link::All);
    if let (false, Some(light)) = (links.shadows.is_empty(), linked) {
        let message = "light paths are blocked by all that casts shadows, also those of lights with blockers of their own";
        diagnostics.push(Diagnostic::warning(&light.origin, message));
    }
}

/// Whether a closure of any of the materials is of some kind.
pub(super) fn is_one(instances: &Instances, materials: &MaterialTable, of_kind: impl Fn(&Surface) -> bool) -> bool {
    let shading = |material: usize| materials.numbers.get(material).copied();
    instances.materials.iter().filter_map(|material| shading(material.index())).any(|shading| {
        let surfaces = match shading {
            Shading::Surface(surface) => surface as usize..surface as usize + 1,
            Shading::Mix(mix) => {
                let mix = &materials.mixes[mix as usize];
                mix.first as usize..mix.first as usize + mix.count
            }
        };
        materials.surfaces[surfaces].iter().any(|surface| of_kind(&surface.surface))
    })
}

/// Joins the two boxes whose common box is least larger, until few are left. Of very many those that follow one another are joined first.
fn joined(mut boxes: Vec<Bounds>) -> Vec<Bounds> {
    while boxes.len() > 4 * MOST_TARGETS {
        boxes = boxes.chunks(2).map(|pair| pair.iter().copied().reduce(union).unwrap_or_default()).collect();
    }
    while boxes.len() > MOST_TARGETS {
        let pairs = (0..boxes.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let growth = |(i, j): (usize, usize)| union(boxes[i], boxes[j]).radius();
        let Some((i, j)) = pairs.min_by(|a, b| growth(*a).total_cmp(&growth(*b))) else { break };
        let last = boxes.swap_remove(i);
        boxes[j] = union(boxes[j], last);
    }
    boxes
}

fn union(a: Bounds, b: Bounds) -> Bounds {
    Bounds { min: std::array::from_fn(|i| a.min[i].min(b.min[i])), max: std::array::from_fn(|i| a.max[i].max(b.max[i])) }
}

fn sphere(bounds: &Bounds, origin: [f64; 3]) -> ([f32; 3], f32) {
    let (centre, radius) = bounds.sphere(origin);
    (centre, (radius * (1.0 + 1e-6)) as f32)
}
