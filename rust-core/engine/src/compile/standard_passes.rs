//! Passes that shading nodes compute without being asked by materials: primvars, camera space, ambient occlusion. All materials get their outputs.

use crate::scene::{
    AMBIENT_OCCLUSION, Camera, Channel, EYE_NORMAL, EYE_POSITION, Graph, Input, Material, NodeId, Operation, PRIMVARS, Scene, ShaderOutput,
};
use std::borrow::Cow;

/// The scene with the outputs that its passes show; itself if they show none of these.
pub(super) fn complete(scene: &Scene) -> Cow<'_, Scene> {
    let names = &scene.settings.shader_passes;
    if !names.iter().any(|name| is_standard(name)) {
        return Cow::Borrowed(scene);
    }
    let mut complete = scene.clone();
    complete.materials.iter_mut().for_each(|material| add_outputs(scene, material));
    Cow::Owned(complete)
}

/// Adds the outputs that a scene's passes show to a material.
pub(super) fn add_outputs(scene: &Scene, material: &mut Material) {
    for name in scene.settings.shader_passes.iter().filter(|name| is_standard(name)) {
        let node = node(scene, name, &mut material.graph);
        // What the host meant by the name gives way.
        material.shader_outputs.retain(|output| output.name != *name);
        let [color, value] = [Channel::Rgb, Channel::R].map(|channel| Input::Node(node, channel));
        material.shader_outputs.push(ShaderOutput { name: name.clone(), color, value });
    }
}

fn is_standard(name: &str) -> bool {
    name.starts_with(PRIMVARS) || [EYE_NORMAL, EYE_POSITION, AMBIENT_OCCLUSION].contains(&name)
}

fn node(scene: &Scene, name: &str, graph: &mut Graph) -> NodeId {
    if let Some(primvar) = name.strip_prefix(PRIMVARS) {
        return graph.add(Operation::Primvar { name: primvar.to_owned(), fallback: [0.0; 4] }, Vec::new());
    }
    let camera = scene.cameras.get(scene.settings.camera as usize);
    match name {
        EYE_NORMAL => to_eye(graph, Operation::Normal, camera, false),
        EYE_POSITION => to_eye(graph, Operation::Position, camera, true),
        _ => {
            let normal = graph.add(Operation::Normal, Vec::new());
            let distance = Input::Constant([scene.settings.occlusion_distance; 4]);
            let rays = Operation::Occlusion { samples: 1, inside: false, only_local: false };
            graph.add(rays, vec![Input::Node(normal, Channel::Rgb), distance])
        }
    }
}

/// A node's value carried from the world to the camera's space.
fn to_eye(graph: &mut Graph, operation: Operation, camera: Option<&Camera>, is_point: bool) -> NodeId {
    let columns = camera.cloned().unwrap_or_default().transform.columns;
    let rows = std::array::from_fn(|axis| {
        let length = columns[axis].iter().map(|x| x * x).sum::<f64>().sqrt();
        let unit = columns[axis].map(|x| if length > 0.0 { x / length } else { 0.0 });
        let offset: f64 = if is_point { -(0..3).map(|i| unit[i] * columns[3][i]).sum::<f64>() } else { 0.0 };
        [unit[0] as f32, unit[1] as f32, unit[2] as f32, offset as f32]
    });
    let world = graph.add(operation, Vec::new());
    graph.add(Operation::Transform3d { rows }, vec![Input::Node(world, Channel::Rgb)])
}
