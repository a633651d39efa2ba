//! Nothing panics, whatever the input.

use super::{Random, primvar};
use crate::refine::*;
use crate::*;

fn some(random: &mut Random, count: usize, limit: usize) -> Vec<u32> {
    (0..count).map(|_| if random.below(300) == 0 { u32::MAX - random.below(3) as u32 } else { random.below(limit) as u32 }).collect()
}

fn mesh(random: &mut Random) -> PolygonMesh {
    let points = 1 + random.below(12);
    let faces = random.below(14);
    let sane = random.below(3) > 0;
    let face_counts: Vec<u32> = (0..faces).map(|_| random.below(7) as u32).collect();
    let corner_count = if sane { face_counts.iter().sum::<u32>() as usize } else { random.below(50) };
    let corners =
        if sane { (0..corner_count).map(|_| random.below(points) as u32).collect() } else { some(random, corner_count, points + 1) };
    let coordinate = |random: &mut Random| if !sane && random.below(40) == 0 { f32::NAN } else { (random.below(5) as f32) * 1e3 };
    let points: Vec<[f32; 3]> = (0..points).map(|_| [coordinate(random), coordinate(random), coordinate(random)]).collect();
    let interpolations =
        [Interpolation::Constant, Interpolation::Uniform, Interpolation::Varying, Interpolation::Vertex, Interpolation::FaceVarying];
    let mut mesh =
        PolygonMesh { points, face_counts, corners, hole_faces: some(random, 2, 20), left_handed: random.below(2) == 0, primvars: vec![] };
    for interpolation in interpolations {
        let components = 1 + random.below(7);
        let places = if random.below(4) == 0 { random.below(20) } else { mesh.place_count(interpolation) };
        let indices = (random.below(2) == 0).then(|| some(random, places, 4));
        let elements = if indices.is_some() { 4 } else { places };
        let values = (0..elements * components).map(|_| random.below(3) as f32).collect();
        mesh.primvars.push(primvar("p", interpolation, components, values, indices));
    }
    mesh
}

fn creases(random: &mut Random) -> Creases {
    let lengths: Vec<u32> = (0..random.below(4)).map(|_| random.below(4) as u32).collect();
    let total = lengths.iter().sum::<u32>() as usize + usize::from(random.below(10) == 0);
    let sharp = |random: &mut Random| [f32::NAN, -1.0, 0.3, 1.5, 10.0, f32::INFINITY][random.below(6)];
    let corner_count = random.below(3);
    Creases {
        crease_sharpnesses: (0..lengths.len()).map(|_| sharp(random)).collect(),
        crease_indices: some(random, total, 12),
        crease_lengths: lengths,
        corner_indices: some(random, corner_count, 14),
        corner_sharpnesses: (0..corner_count).map(|_| sharp(random)).collect(),
    }
}

fn options(random: &mut Random) -> RefineOptions {
    use BoundaryInterpolation as Boundary;
    use FaceVaryingInterpolation as FaceVarying;
    let face_varying = [
        FaceVarying::None,
        FaceVarying::CornersOnly,
        FaceVarying::CornersPlus1,
        FaceVarying::CornersPlus2,
        FaceVarying::Boundaries,
        FaceVarying::All,
    ];
    RefineOptions {
        scheme: [Scheme::CatmullClark, Scheme::Loop, Scheme::Bilinear][random.below(3)],
        level: if random.below(20) == 0 { u32::MAX } else { random.below(3) as u32 },
        boundary: [Boundary::None, Boundary::EdgeOnly, Boundary::EdgeAndCorner][random.below(3)],
        face_varying: face_varying[random.below(6)],
        triangles: [TriangleRule::CatmullClark, TriangleRule::Smooth][random.below(2)],
        to_limit: random.below(2) == 0,
        normals: random.below(2) == 0,
        max_faces: 2000,
    }
}

#[test]
fn random_meshes_never_panic() {
    let mut random = Random(99);
    let mut refined_count = 0;
    for _ in 0..4000 {
        let mesh = mesh(&mut random);
        let _ = mesh.validate();
        let triangulation = triangulate(&mesh);
        assert!(triangulation.triangles.iter().flatten().all(|&vertex| (vertex as usize) < mesh.points.len()));
        let _ = (smooth_normals(&mesh), corner_normals(&mesh, 1.0));
        let uvs: Vec<[f32; 2]> = (0..random.below(40)).map(|_| [random.float(), f32::NAN]).collect();
        let _ = corner_tangents(&mesh.points, &triangulation.triangles, &[], &uvs);
        for primvar in &mesh.primvars {
            let _ = primvar.triangulated(&triangulation);
        }
        let (creases, options) = (creases(&mut random), options(&mut random));
        if let Ok(refined) = refine(&mesh, &creases, &options, None) {
            refined_count += 1;
            assert_eq!(
                refined.mesh.checked().map(|(mesh, problems)| (mesh.face_counts.len(), problems)),
                Ok((refined.face_of.len(), vec![]))
            );
        }
    }
    assert!(refined_count > 1000, "{refined_count}");
}
