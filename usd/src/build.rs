//! From what was read of a mesh to triangles: checked, subdivided, cut, with normals and primvars. Knows nothing of USD's interpreter.

use gonio::mesh::refine::{Creases, RefineError, RefineOptions, refine};
use gonio::mesh::{FacePrimvar, Interpolation, MeshProblem, PolygonMesh, Severity, Triangulation, smooth_normals, triangulate};
use gonio::scene::{Dicing, Mesh, Origin, Primvar, PrimvarInterpolation};
use std::sync::atomic::AtomicBool;

/// What kind of surface a mesh is the control mesh of.
#[derive(Clone, Debug)]
pub enum Surface {
    /// The polygons themselves.
    Polygons,
    /// A subdivision surface; level 0 means the control mesh with smooth normals. It may be cut further to the size of pixels.
    Subdivision(Creases, RefineOptions, Option<Dicing>),
}

/// A mesh as read; authored normals are its primvar `normals`.
#[derive(Clone, Debug)]
pub struct MeshSource {
    /// Where it came from.
    pub origin: Origin,
    /// Points, faces, primvars.
    pub polygons: PolygonMesh,
    /// What they are the control mesh of.
    pub surface: Surface,
    /// Material slot of each face.
    pub face_slots: Option<Vec<u16>>,
}

/// A mesh and what was left out or repaired on the way.
#[derive(Debug)]
pub struct BuiltMesh {
    /// The triangles.
    pub mesh: Mesh,
    /// Problems that cost a part.
    pub problems: Vec<String>,
}

/// Why there are no triangles.
#[derive(Debug, PartialEq)]
pub enum BuildError {
    /// The caller asked to stop.
    Cancelled,
    /// What was found and expected.
    Problem(String),
}

/// Makes triangles.
///
/// # Errors
/// Broken topology, or no face with an area's worth of corners, or cancellation.
pub fn build(source: MeshSource, cancel: &AtomicBool) -> Result<BuiltMesh, BuildError> {
    let MeshSource { origin, polygons, surface, face_slots } = source;
    let level_zero = |options: &RefineOptions| options.level == 0;
    let dicing = match &surface {
        Surface::Polygons => None,
        Surface::Subdivision(_, _, dicing) => *dicing,
    };
    let mut cut = match surface {
        Surface::Polygons => polygons_as_they_are(polygons, false)?,
        Surface::Subdivision(_, options, _) if level_zero(&options) => polygons_as_they_are(polygons, true)?,
        Surface::Subdivision(creases, options, _) => subdivided(&polygons, &creases, &options, cancel)?,
    };
    let triangulation = triangulate(&cut.polygons);
    if triangulation.triangles.is_empty() {
        return Err(BuildError::Problem("no face has a surface".into()));
    }
    let faces: Vec<u32> = match &cut.face_of {
        Some(face_of) => triangulation.face_of.iter().map(|&face| face_of[face as usize]).collect(),
        None => triangulation.face_of.clone(),
    };
    let slots = face_slots.map(|slots| faces.iter().map(|&face| slots.get(face as usize).copied().unwrap_or(0)).collect());
    let normals = cut.normals.take().map(|normals| over_triangles(normals, &triangulation));
    let primvars = std::mem::take(&mut cut.polygons.primvars);
    let mesh = Mesh {
        origin,
        points: cut.polygons.points.into(),
        motion: Vec::new(),
        dicing,
        normals: normals.and_then(usable_normals),
        primvars: primvars.into_iter().filter(|primvar| primvar.components <= 4).map(|p| over_triangles(p, &triangulation)).collect(),
        slots,
        faces: (!is_identity(&faces)).then(|| faces.into()),
        triangles: triangulation.triangles.into(),
    };
    Ok(BuiltMesh { mesh, problems: cut.problems })
}

/// Polygons that are ready to be cut.
struct Cut {
    polygons: PolygonMesh,
    normals: Option<FacePrimvar>,
    /// Face of the source for each face; `None` means its own number.
    face_of: Option<Vec<u32>>,
    problems: Vec<String>,
}

fn polygons_as_they_are(polygons: PolygonMesh, is_smooth: bool) -> Result<Cut, BuildError> {
    let (mut polygons, problems) = polygons.checked().map_err(|problems| fatal(&problems))?;
    let authored = polygons.primvars.iter().position(|primvar| primvar.name == "normals");
    let authored = authored.map(|place| polygons.primvars.remove(place));
    let normals = authored.or_else(|| is_smooth.then(|| point_normals(&polygons)));
    Ok(Cut { polygons, normals, face_of: None, problems: texts(&problems) })
}

fn point_normals(polygons: &PolygonMesh) -> FacePrimvar {
    FacePrimvar {
        name: "normals".into(),
        interpolation: Interpolation::Vertex,
        components: 3,
        values: smooth_normals(polygons).into_flattened(),
        indices: None,
    }
}

fn subdivided(polygons: &PolygonMesh, creases: &Creases, options: &RefineOptions, cancel: &AtomicBool) -> Result<Cut, BuildError> {
    let refined = refine(polygons, creases, options, Some(cancel)).map_err(|error| match error {
        RefineError::Cancelled => BuildError::Cancelled,
        RefineError::Invalid(problems) => fatal(&problems),
    })?;
    let mut problems = texts(&refined.problems);
    if refined.level < options.level {
        let (wanted, level, faces) = (options.level, refined.level, options.max_faces);
        problems.push(format!("subdivided {level} times in place of {wanted}, to stay below {faces} faces"));
    }
    Ok(Cut { polygons: refined.mesh, normals: refined.normals, face_of: Some(refined.face_of), problems })
}

fn fatal(problems: &[MeshProblem]) -> BuildError {
    let worst = problems.iter().find(|problem| problem.severity() == Severity::Fatal).or(problems.first());
    BuildError::Problem(worst.map_or_else(|| "the topology is broken".into(), ToString::to_string))
}

fn texts(problems: &[MeshProblem]) -> Vec<String> {
    problems
        .iter()
        .map(|problem| match problem.severity() {
            Severity::Primvar(_) => format!("{problem}; it is ignored"),
            _ => problem.to_string(),
        })
        .collect()
}

/// The primvar with one index a triangle or a triangle corner.
fn over_triangles(primvar: FacePrimvar, triangulation: &Triangulation) -> Primvar {
    let indices = match primvar.interpolation {
        Interpolation::Uniform | Interpolation::FaceVarying => {
            let element = |place: u32| primvar.element_of(place as usize).unwrap_or(0);
            Some(match primvar.interpolation {
                Interpolation::Uniform => triangulation.face_of.iter().map(|&face| element(face)).collect::<Vec<u32>>(),
                _ => triangulation.corner_of.iter().flatten().map(|&corner| element(corner)).collect(),
            })
        }
        _ => primvar.indices,
    };
    let element_count = primvar.values.len() / primvar.components.max(1);
    let indices = indices.filter(|indices| indices.len() != element_count || !is_identity(indices));
    Primvar {
        name: primvar.name,
        interpolation: match primvar.interpolation {
            Interpolation::Constant => PrimvarInterpolation::Constant,
            Interpolation::Uniform => PrimvarInterpolation::Uniform,
            Interpolation::Varying | Interpolation::Vertex => PrimvarInterpolation::Vertex,
            Interpolation::FaceVarying => PrimvarInterpolation::FaceVarying,
        },
        components: primvar.components as u8,
        values: primvar.values.into(),
        indices: indices.map(Into::into),
    }
}

fn is_identity(indices: &[u32]) -> bool {
    indices.iter().enumerate().all(|(place, &index)| place == index as usize)
}

/// Normals a face or for the whole mesh say no more than the triangles do: only those that vary over a face are kept.
fn usable_normals(normals: Primvar) -> Option<Primvar> {
    matches!(normals.interpolation, PrimvarInterpolation::Vertex | PrimvarInterpolation::FaceVarying).then_some(normals)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn quad() -> MeshSource {
        let points = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let polygons = PolygonMesh { points, face_counts: vec![4], corners: vec![0, 1, 2, 3], ..PolygonMesh::default() };
        MeshSource { origin: Origin::new("/quad"), polygons, surface: Surface::Polygons, face_slots: Some(vec![3]) }
    }

    #[test]
    fn a_quad_becomes_two_triangles_with_slots_and_faces() {
        let built = build(quad(), &AtomicBool::new(false)).expect("valid");
        assert_eq!(built.mesh.triangles.as_ref(), &[[0, 1, 2], [0, 2, 3]]);
        assert_eq!(built.mesh.slots.as_deref(), Some(&[3, 3][..]));
        assert_eq!(built.mesh.faces.as_deref(), Some(&[0, 0][..]));
        assert!(built.mesh.normals.is_none());
    }

    #[test]
    fn broken_topology_is_a_problem() {
        let mut source = quad();
        source.polygons.corners[2] = 9;
        assert!(matches!(build(source, &AtomicBool::new(false)), Err(BuildError::Problem(_))));
    }

    #[test]
    fn subdivision_keeps_the_way_back_to_faces() {
        let mut source = quad();
        source.surface = Surface::Subdivision(Creases::default(), RefineOptions { level: 1, ..RefineOptions::default() }, None);
        let built = build(source, &AtomicBool::new(false)).expect("valid");
        assert_eq!(built.mesh.triangles.len(), 8);
        assert_eq!(built.mesh.faces.as_deref(), Some(&[0; 8][..]));
        assert!(built.mesh.normals.is_some());
    }
}
