//! Tests of the mesh module.

mod dice;
mod garbage;
mod polygons;
mod shapes;
mod subdivision;
mod subdivision_rules;
mod weld;

use super::{FacePrimvar, Interpolation, PolygonMesh};

/// xorshift64*: a fixed sequence for every seed.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 16
    }

    fn below(&mut self, limit: usize) -> usize {
        (self.next() % limit as u64) as usize
    }

    /// In [0, 1).
    fn float(&mut self) -> f32 {
        (self.next() % (1 << 24)) as f32 / (1 << 24) as f32
    }
}

fn cube() -> PolygonMesh {
    let mut cube = super::quadrics::cube(2.0);
    cube.primvars.clear();
    cube
}

/// `width` × `height` unit squares in the plane z = 0.
fn grid(width: u32, height: u32) -> PolygonMesh {
    let points = (0..=height).flat_map(|y| (0..=width).map(move |x| [x as f32, y as f32, 0.0])).collect();
    let at = |x: u32, y: u32| y * (width + 1) + x;
    let corners = (0..height).flat_map(|y| (0..width).flat_map(move |x| [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)]));
    PolygonMesh { points, face_counts: vec![4; (width * height) as usize], corners: corners.collect(), ..PolygonMesh::default() }
}

fn primvar(name: &str, interpolation: Interpolation, components: usize, values: Vec<f32>, indices: Option<Vec<u32>>) -> FacePrimvar {
    FacePrimvar { name: name.into(), interpolation, components, values, indices }
}

fn assert_close(found: &[f32], expected: &[f32], tolerance: f32) {
    assert_eq!(found.len(), expected.len());
    let far = found.iter().zip(expected).any(|(a, b)| (a - b).abs() > tolerance);
    assert!(!far, "found {found:?}, expected {expected:?}");
}

/// Vertices − edges + faces, counting only vertices in use.
fn euler_characteristic(mesh: &PolygonMesh) -> i64 {
    let mut edges = std::collections::HashSet::new();
    let mut faces = 0;
    for (_, range) in mesh.usable_faces() {
        faces += 1;
        for corner in range.clone() {
            let next = if corner + 1 == range.end { range.start } else { corner + 1 };
            let (a, b) = (mesh.corners[corner], mesh.corners[next]);
            edges.insert((a.min(b), a.max(b)));
        }
    }
    let vertices: std::collections::HashSet<u32> = mesh.corners.iter().copied().collect();
    vertices.len() as i64 - edges.len() as i64 + faces
}
