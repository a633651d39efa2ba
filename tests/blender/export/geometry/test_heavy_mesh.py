"""Heavy meshes: what the export leaves in memory, what it tells of triangles, and that nothing is told twice."""

import pytest


def status(name):
    """Bytes of this process by their name in /proc, once what is free has gone back to the system."""
    import ctypes
    import unittest
    from pathlib import Path

    file = Path("/proc/self/status")
    if not file.exists() or not hasattr(ctypes.CDLL(None), "malloc_trim"):
        raise unittest.SkipTest("memory is measured on Linux with the GNU C library")
    if name == "VmRSS":
        ctypes.CDLL(None).malloc_trim(0)
    return 1024 * next(int(line.split()[1]) for line in file.read_text().splitlines() if line.startswith(f"{name}:"))


def ground(side, corners=3):
    """A smooth grid of 2 × side × side triangles, or of half as many squares, linked to the scene."""
    import bpy
    import numpy as np
    from recorder import link

    mesh = bpy.data.meshes.new("Ground")
    mesh.vertices.add((side + 1) ** 2)
    across = np.linspace(-1.0, 1.0, side + 1, dtype=np.float32)
    x, y = np.meshgrid(across, across)
    points = np.stack([x, y, 0.1 * np.sin(9.0 * x) * np.sin(8.0 * y)], axis=2)
    mesh.attributes["position"].data.foreach_set("vector", points.ravel())
    first = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).reshape(-1, 1)
    around = [0, 1, side + 2, side + 1] if corners == 4 else [0, 1, side + 2, 0, side + 2, side + 1]
    loops = (first + np.array(around)).astype(np.int32).ravel()
    mesh.loops.add(len(loops))
    mesh.loops.foreach_set("vertex_index", loops)
    mesh.polygons.add(len(loops) // corners)
    mesh.polygons.foreach_set("loop_start", np.arange(0, len(loops), corners, dtype=np.int32))
    mesh.update(calc_edges=True)
    mesh.shade_smooth()
    return link(bpy.data.objects.new("Ground", mesh))


@pytest.mark.blender
@pytest.mark.parametrize("corners,most", [(3, 75), (4, 80)])
def test_memory_of_a_heavy_mesh(corners, most, tmp_path):
    """The scene's own arrays take 24 bytes a triangle, or 28; what Blender computes and keeps for the next time, 34 or 38."""
    from pathlib import Path

    from recorder import depsgraph, empty, module

    empty()
    ground(700, corners)
    shown, exported = depsgraph(), module("export").Exporter(module("report").Report())
    before = status("VmRSS")
    Path("/proc/self/clear_refs").write_text("5")
    exported.sync(shown)
    peak, left = ((status(name) - before) / (2 * 700**2) for name in ("VmHWM", "VmRSS"))
    print(f"{peak:.1f} bytes a triangle, {left:.1f} after it")
    assert left < most and peak < 175


@pytest.mark.blender
def test_triangles_are_told_with_little(tmp_path):
    """Corners of triangles are their points; those of squares are found by triangles, where that is less than to tell them apart."""
    import bpy
    import numpy as np
    from recorder import depsgraph, empty, exporter

    told = []
    for corners in (3, 4):
        empty()
        mesh = ground(2, corners).data
        mesh.uv_layers.new(name="Map").uv.foreach_set("vector", np.arange(2 * len(mesh.loops), dtype=np.float32))
        told.append(exporter()[0].sync(depsgraph()).meshes[0])
        loops = np.empty(len(mesh.loops), dtype=np.int32)
        mesh.loops.foreach_get("vertex_index", loops)
        if corners == 3:
            assert np.array_equal(told[0]["triangles"].ravel(), loops)
        else:
            assert set(told[1]["triangles"][:2].ravel()) == set(loops[:4])
        assert len(told[-1]["primvars"]["st"]) == 24
    assert told[0]["corners"] is None and told[0]["faces"] is None
    assert told[1]["faces"].tolist() == [0, 0, 1, 1, 2, 2, 3, 3]
    bpy.ops.wm.read_factory_settings()


@pytest.mark.blender
def test_coordinates_without_seams_are_told_by_points(tmp_path):
    """As long as all corners around a point have the same bits, and nothing cuts the mesh later."""
    import bpy
    import numpy as np
    from recorder import depsgraph, empty, exporter

    for corners in (3, 4):
        empty()
        thing = ground(5, corners)
        points, loops = np.empty((36, 3), dtype=np.float32), np.empty(len(thing.data.loops), dtype=np.int32)
        thing.data.attributes["position"].data.foreach_get("vector", points.ravel())
        thing.data.loops.foreach_get("vertex_index", loops)
        layer = thing.data.uv_layers.new(name="Map")
        layer.uv.foreach_set("vector", points[loops, :2].ravel())
        assert np.array_equal(exporter()[0].sync(depsgraph()).meshes[0]["primvars"]["st"], points[:, :2])
        layer.uv[22].vector[0] += 0.25
        mesh = exporter()[0].sync(depsgraph()).meshes[0]
        # A square's corner may be that of both its triangles.
        differing = np.count_nonzero(mesh["primvars"]["st"] != points[mesh["triangles"].ravel(), :2])
        assert mesh["corners"] is None and differing in ((1,) if corners == 3 else (1, 2))
        layer.uv.foreach_set("vector", np.zeros(2 * len(loops), dtype=np.float32))
        layer.uv[22].vector[0] = -0.0
        assert len(exporter()[0].sync(depsgraph()).meshes[0]["primvars"]["st"]) == 150
        layer.uv.foreach_set("vector", points[loops, :2].ravel())
        modifier = thing.modifiers.new("Finely", "SUBSURF")
        modifier.levels = modifier.render_levels = 0
        if bpy.app.version >= (5, 0, 0):
            modifier.use_adaptive_subdivision = True
            assert len(exporter()[0].sync(depsgraph()).meshes[0]["primvars"]["st"]) == 150


@pytest.mark.blender
def test_what_shows_is_noticed(tmp_path):
    """Values of every kind tell meshes apart; what is selected does not."""
    import numpy as np
    from recorder import empty, module

    empty()
    mesh = ground(3, 4).data
    fingerprint = module("export.fingerprint").fingerprint
    paint = mesh.color_attributes.new("paint", "BYTE_COLOR", "CORNER")
    heat, crease = mesh.attributes.new("heat", "FLOAT", "POINT"), mesh.attributes.new("crease_edge", "FLOAT", "EDGE")
    changes = {
        "points": lambda: mesh.vertices[0].co.__setitem__(2, 1.0),
        "bytes": lambda: paint.data.foreach_set("color", [0.5, 0.25, 0.125, 1.0] * len(mesh.loops)),
        "values": lambda: heat.data.foreach_set("value", np.ones(len(mesh.vertices), dtype=np.float32)),
        "edges": lambda: crease.data.foreach_set("value", np.ones(len(mesh.edges), dtype=np.float32)),
        "flat faces": lambda: mesh.polygons.foreach_set("use_smooth", [False] * len(mesh.polygons)),
        "own normals": lambda: mesh.normals_split_custom_set_from_vertices([(0.0, 0.0, 1.0)] * len(mesh.vertices)),
        "other own normals": lambda: mesh.normals_split_custom_set_from_vertices([(0.6, 0.0, 0.8)] * len(mesh.vertices)),
    }
    for name, change in changes.items():
        before = fingerprint(mesh, frozenset())
        assert fingerprint(mesh, frozenset()) == before, name
        change()
        assert fingerprint(mesh, frozenset()) != before, name
    before = fingerprint(mesh, frozenset())
    mesh.polygons.foreach_set("select", [True, False, True] * 3)
    assert fingerprint(mesh, frozenset()) == before


@pytest.mark.blender
def test_where_faces_begin_is_noticed(tmp_path):
    """The same points and corners as two squares, or as a triangle and a face of five."""
    import bpy
    from recorder import empty, module

    empty()
    found = set()
    for faces in ([(0, 1, 2, 3), (0, 3, 4, 5)], [(0, 1, 2), (3, 0, 3, 4, 5)], [(0, 1, 2, 3, 0), (3, 4, 5)]):
        mesh = bpy.data.meshes.new("Mesh")
        mesh.vertices.add(6)
        corners = [corner for face in faces for corner in face]
        mesh.loops.add(8)
        mesh.loops.foreach_set("vertex_index", corners)
        mesh.polygons.add(2)
        mesh.polygons.foreach_set("loop_start", [0, len(faces[0])])
        found.add(module("export.fingerprint").fingerprint(mesh, frozenset()))
    assert len(found) == 3


@pytest.mark.blender
def test_one_mesh_is_told_once(tmp_path):
    """For all objects that show it, and over frames in which it stays as it is."""
    import bpy
    from recorder import depsgraph, empty, exporter, link

    empty()
    mesh = ground(8).data
    for number in range(3):
        link(bpy.data.objects.new(f"Other {number}", mesh)).location.x = number
    exported, _ = exporter()
    scene = exported.sync(depsgraph())
    for frame in (2, 3):
        bpy.context.scene.frame_set(frame)
        exported.sync(depsgraph())
    assert scene.calls.count("meshes") == 1 and len(scene.meshes) == 1 and len(scene.instances) == 4


@pytest.mark.blender
def test_a_texture_that_is_placed_asks_for_nothing_else(tmp_path):
    """Coordinates that stand in where none are linked are no matter of meshes whose materials link some."""
    import bpy
    from recorder import depsgraph, empty, exporter, material

    empty()
    thing = ground(2)
    made, tree, end = material()
    shader, checker, place = (tree.nodes.new(f"ShaderNode{name}") for name in ("BsdfDiffuse", "TexChecker", "UVMap"))
    tree.links.new(checker.outputs["Color"], shader.inputs["Color"])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    thing.data.materials.append(made)
    assert set(exporter()[0].sync(depsgraph()).meshes[0]["primvars"]) == {"blender generated"}
    tree.links.new(place.outputs["UV"], checker.inputs["Vector"])
    assert set(exporter()[0].sync(depsgraph()).meshes[0]["primvars"]) == set()
    bpy.ops.wm.read_factory_settings()


@pytest.mark.blender
def test_a_scene_goes_with_its_exporter(tmp_path):
    """No circle keeps it until Python looks for circles, which may be frames later."""
    import gc
    import weakref

    from recorder import depsgraph, empty, material, module

    empty()
    made, tree, end = material()
    tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], end.inputs["Surface"])
    ground(2).data.materials.append(made)
    exported = module("export").Exporter(module("report").Report())
    kept = weakref.ref(exported.sync(depsgraph()))
    gc.disable()
    try:
        del exported
        assert kept() is None
    finally:
        gc.enable()
