//! Velocities of volumes, by which what their fields hold flows while the shutter is open. They are read when that is known.

use super::{Field, Volume, grid};
use gonio::Diagnostic;
use gonio::scene::{FieldId, Flow, MeshId, Scene, Transform};
use pyo3::prelude::*;
use std::collections::HashMap;

/// What the usual programs call grids of velocities.
const NAMES: [&str; 3] = ["velocity", "vel", "v"];

/// A field of the scene that has velocities.
#[derive(Clone, Debug)]
struct Flowing {
    field: FieldId,
    /// The box about it.
    mesh: MeshId,
    /// One of vectors, or those of x, y and z.
    velocity: Vec<Field>,
    /// From the field's lattice to the space of the volume prim.
    to_volume: Transform,
}

/// All fields of a scene that have velocities.
#[derive(Clone, Debug, Default)]
pub struct Flows(Vec<Flowing>);

impl Flows {
    /// Whether none has.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Adds the volume that comes next into a scene, with the map from its field's lattice to the space of the volume prim.
    pub(super) fn add(&mut self, scene: &Scene, velocity: &[Field], to_volume: Transform) {
        let (field, mesh) = (FieldId(scene.fields.len() as u32), MeshId(scene.meshes.len() as u32));
        self.0.push(Flowing { field, mesh, velocity: velocity.to_vec(), to_volume });
    }
}

/// When the shutter is open, seconds from the frame on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exposure {
    pub(crate) open: f64,
    pub(crate) close: f64,
}

impl Volume {
    /// The fields of its velocities; none where it has none.
    pub(super) fn velocity(&self) -> Vec<Field> {
        let parts = |name: &str| ["x", "y", "z"].map(|axis| self.field(&format!("{name}_{axis}")).cloned());
        let whole = NAMES.iter().find_map(|name| Some(vec![self.field(name)?.clone()]));
        whole.or_else(|| NAMES.iter().find_map(|name| parts(name).into_iter().collect())).unwrap_or_default()
    }
}

/// Has the fields of a scene flow that have velocities, and widens their boxes; gives what cannot be used.
pub(crate) fn put(py: Python<'_>, scene: &mut Scene, flows: &Flows, exposure: Exposure) -> Vec<Diagnostic> {
    let (mut told, mut known) = (Vec::new(), HashMap::new());
    for Flowing { field, mesh, velocity, to_volume } in &flows.0 {
        let Some(field) = scene.fields.get_mut(field.index()) else { continue };
        // Placements share their numbers.
        let key = (velocity[0].path.clone(), field.density.values.as_ptr());
        let flow = known.entry(key).or_insert_with(|| {
            let found = read(py, velocity, field, to_volume, exposure);
            found.map_err(|problem| told.push(Diagnostic::warning(&field.origin, format!("{problem}; it does not flow")))).ok()
        });
        field.flow.clone_from(flow);
        if field.flow.is_some() {
            scene.meshes[mesh.index()].points = field.mesh().points;
        }
    }
    told
}

/// A flow by the grids of velocities.
fn read(
    py: Python<'_>,
    velocity: &[Field],
    field: &gonio::scene::Field,
    to_volume: &Transform,
    Exposure { open, close }: Exposure,
) -> Result<Flow, String> {
    let named = |problem: String| format!("its field '{}' cannot be used: {problem}", velocity[0].name);
    let grids = velocity.iter().map(|one| grid::open_grid(py, one)).collect::<Result<Vec<_>, _>>().map_err(named)?;
    let Some(back) = velocity[0].to_volume.inverse() else { return Err(named("it is flat".into())) };
    let rests = (-open / (close - open)) as f32;
    py.detach(|| Flow::of_grids(&grids, (&field.density, &back.after(to_volume)), close - open, rests)).map_err(named)
}
