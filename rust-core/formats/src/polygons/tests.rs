use super::read;
use crate::Place;

const SQUARE: &str = "# a square of two materials\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0 0.5\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n\
    usemtl dark oak\nf 1/1/1 2/2/1 3/3/1\ng top\nusemtl steel\nf -4 -2/3 -1\nusemtl dark oak\nf 1//1 2//1 \\\n 4//1\n";

fn text_of(faces: &str) -> String {
    let header = "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
        property float s\nproperty float t\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n";
    format!("{header}0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n{faces}")
}

fn binary(big: bool) -> Vec<u8> {
    let name = if big { "big" } else { "little" };
    let header = format!(
        "ply\nformat binary_{name}_endian 1.0\nelement vertex 3\nproperty double x\nproperty float y\nproperty short z\nproperty float nx\n\
         property float ny\nproperty float nz\nelement edge 1\nproperty list uchar short parts\nelement face 2\n\
         property list uint8 uint16 vertex_index\nproperty int material_index\nend_header\n"
    );
    let mut bytes = header.into_bytes();
    let mut put = |word: &[u8]| bytes.extend_from_slice(word);
    let (f64s, f32s) =
        (|x: f64| if big { x.to_be_bytes() } else { x.to_le_bytes() }, |x: f32| if big { x.to_be_bytes() } else { x.to_le_bytes() });
    let (u16s, i32s) =
        (|x: u16| if big { x.to_be_bytes() } else { x.to_le_bytes() }, |x: i32| if big { x.to_be_bytes() } else { x.to_le_bytes() });
    for (x, y) in [(0.0, 0.0), (2.0, 0.0), (2.0, 3.0)] {
        put(&f64s(x));
        put(&f32s(y));
        put(&u16s(7));
        [0.0, 0.0, 1.0].into_iter().for_each(|n| put(&f32s(n)));
    }
    put(&[2]);
    [5, 6].into_iter().for_each(|part| put(&u16s(part)));
    for (corners, material) in [([0, 1, 2], 9), ([2, 1, 0], -3)] {
        put(&[3]);
        corners.into_iter().for_each(|corner| put(&u16s(corner)));
        put(&i32s(material));
    }
    bytes
}

#[test]
fn obj_has_corners_materials_and_normals() {
    let mesh = read(SQUARE.as_bytes()).unwrap();
    assert_eq!(mesh.points, [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!((mesh.face_counts, mesh.corners), (vec![3, 3, 3], vec![0, 1, 2, 0, 2, 3, 0, 1, 3]));
    assert_eq!((mesh.materials, mesh.face_materials), (vec!["dark oak".to_owned(), "steel".to_owned()], vec![0, 1, 0]));
    assert_eq!(mesh.uvs[..5], [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0], [1.0, 1.0]]);
    assert!(mesh.normals.iter().all(|[x, y, z]| *x == 0.0 && *y == 0.0 && *z > 0.0) && mesh.normals.len() == 9);
}

#[test]
fn ply_is_read_as_text_and_in_both_byte_orders() {
    let mesh = read(text_of("3 0 1 2\n\n4 0 1 2 3\n").as_bytes()).unwrap();
    assert_eq!((mesh.face_counts, mesh.corners), (vec![3, 4], vec![0, 1, 2, 0, 1, 2, 3]));
    assert_eq!((mesh.uvs[2], mesh.uvs[6], mesh.materials), ([1.0, 1.0], [0.0, 1.0], vec![String::new()]));
    let [little, big] = [false, true].map(|big| read(&binary(big)).unwrap());
    assert_eq!(little, big);
    assert_eq!(little.points, [[0.0, 0.0, 7.0], [2.0, 0.0, 7.0], [2.0, 3.0, 7.0]]);
    assert_eq!((little.corners, little.face_materials), (vec![0, 1, 2, 2, 1, 0], vec![1, 0]));
    assert_eq!((little.materials, little.normals.len()), (vec!["-3".to_owned(), "9".to_owned()], 6));
}

#[test]
fn bad_files_are_told_by_line_or_byte() {
    let problem = |bytes: &[u8]| read(bytes).unwrap_err();
    let at = |bytes: &[u8], line| assert_eq!(problem(bytes).place, Some(Place::Line(line)), "{}", problem(bytes));
    at(b"v 0 0 0\nv 1 x 0\n", 2);
    at(b"v 0 0 0\nv 1 0 nan\n", 2);
    at(b"v 0 0 0\n\nf 1 2 3\n", 3);
    at(b"v 0 0 0\nv 1 0 0\nf 1 2\n", 3);
    at(b"v 0 0 0\nv 1 0 0\nv \\\n 1 1 0\nf 1 2 3/1\n", 5);
    at(text_of("3 0 1 2\n3 0 1\n").as_bytes(), 18);
    at(text_of("3 0 1 2\n2 0 1\n").as_bytes(), 18);
    at(text_of("3 0 1 2\n").as_bytes(), 18);
    at(b"ply\nformat ascii 1.0\nelement vertex many\n", 3);
    let short = binary(true);
    assert!(matches!(problem(&short[..short.len() - 1]).place, Some(Place::Byte(_))));
    assert!(problem(text_of("3 0 1 2\n3 0 1 4\n").as_bytes()).problem.contains("vertex 4"));
    assert!(problem(b"ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n").problem.contains("4000000000"));
    assert!(problem(b"solid cube\n").problem.contains("no face"));
    assert_eq!(read(b""), Err(problem(b"v 1 2 3")));
}
