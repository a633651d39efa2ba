"""OBJ and PLY files as meshes."""

import struct

import gonio
import numpy
import pytest

# A pentagon with a dent and a square above it, in two materials.
OBJ = """mtllib none.mtl
v 0 0 0
v 4 0 0
v 4 4 0
v 2 1 0
v 0 4 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
vt 0 0
vt 1 0
vt 1 1
vt 0 1
vn 0 0 1
usemtl floor
f 1 2 3 4 5
usemtl table
f 6/1/1 7/2/1 8/3/1 9/4/1
"""


def down(scene, places):
    origins = numpy.array([[x, y, 5.0] for x, y in places])
    return gonio.RayCaster(scene).first_hits(origins, numpy.array([0.0, 0.0, -1.0]))


def test_obj_by_material_groups(tmp_path):
    (tmp_path / "two.obj").write_text(OBJ)
    scene = gonio.Scene()
    mesh, names = scene.add_mesh_file(tmp_path / "two.obj")
    assert names == ["floor", "table"]
    scene.add_instance(mesh, [scene.add_material(name) for name in names])
    hits = down(scene, [(0.25, 0.75), (3.0, 0.5), (2.0, 2.0), (0.5, 2.5)])
    assert numpy.asarray(hits.material).tolist() == [1, 0, -1, 0]
    assert numpy.asarray(hits.uv)[0] == pytest.approx([0.25, 0.75], abs=1e-5)
    assert numpy.asarray(hits.normal)[[0, 1, 3]] == pytest.approx(numpy.array([[0, 0, 1]] * 3))


def test_ply_in_binary(tmp_path):
    header = "ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
    header += "".join(f"property float {name}\n" for name in ("x", "y", "z", "nx", "ny", "nz", "u", "v"))
    header += "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    tilted = (0.6, 0.0, 0.8)
    rows = [(0, 0, 0, *tilted, 0, 0), (2, 0, 0, *tilted, 1, 0), (0, 2, 0, *tilted, 0, 1)]
    body = b"".join(struct.pack("<8f", *row) for row in rows) + struct.pack("<B3i", 3, 0, 1, 2)
    (tmp_path / "one.ply").write_bytes(header.encode() + body)
    scene = gonio.Scene()
    mesh, names = scene.add_mesh_file(str(tmp_path / "one.ply"))
    scene.add_instance(mesh, [scene.add_material()])
    hits = down(scene, [(0.5, 1.0)])
    assert names == [""] and numpy.asarray(hits.normal)[0] == pytest.approx(tilted, abs=1e-5)
    assert numpy.asarray(hits.uv)[0] == pytest.approx([0.25, 0.5], abs=1e-5)


def test_bad_files_are_told_by_file_and_line(tmp_path):
    path = tmp_path / "bad.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nf 1 2 9\n")
    with pytest.raises(gonio.FormatError, match="bad.obj") as raised:
        gonio.Scene().add_mesh_file(path)
    assert raised.value.line == 3 and "number 9" in str(raised.value)
    with pytest.raises(FileNotFoundError):
        gonio.Scene().add_mesh_file(tmp_path / "none.ply")
