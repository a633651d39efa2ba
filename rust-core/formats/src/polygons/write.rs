//! The writer of Wavefront OBJ.

use std::fmt::Write;

/// The bytes of triangles as one object; places in the shortest numbers that are read back the same.
pub fn to_obj(name: &str, points: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<u8> {
    let mut text = format!("o {name}\n");
    for point in points {
        // −0 is 0.
        let [x, y, z] = point.map(|x| x + 0.0);
        let _ = writeln!(text, "v {x} {y} {z}");
    }
    for triangle in triangles {
        let [a, b, c] = triangle.map(|corner| u64::from(corner) + 1);
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    text.into_bytes()
}
