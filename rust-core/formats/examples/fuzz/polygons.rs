//! OBJ and PLY.

use crate::Reader;
use gonio_formats::polygons::read;

/// The reader of both.
pub(crate) fn readers() -> Vec<Reader> {
    vec![Reader { name: "polygons", seeds, read: |bytes| read(bytes).is_ok(), memory: 1 << 20 }]
}

fn seeds() -> Vec<Vec<u8>> {
    let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 1\nvn 0 0 1\nusemtl a\nf 1/1/1 2//1 -1\n";
    let header = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let text = format!("ply\nformat ascii 1.0\n{header}0 0 0\n1 0 0\n1 1 0\n3 0 1 2\n");
    let mut binary = format!("ply\nformat binary_little_endian 1.0\n{header}").into_bytes();
    [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0].into_iter().for_each(|x| binary.extend(x.to_le_bytes()));
    binary.push(3);
    [0i32, 1, 2].into_iter().for_each(|index| binary.extend(index.to_le_bytes()));
    vec![obj.into(), text.into(), binary]
}
