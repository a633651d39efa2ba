"""What the Geometry, Wireframe and Attribute nodes know of a mesh, against Cycles."""

import pytest


def shown(kind, output, **fields):
    """A maker of materials that shine with an output of a node."""

    def make():
        from beside_cycles import shining

        made, tree, colour = shining(str(output))
        node = tree.nodes.new(f"ShaderNode{kind}")
        for name, value in fields.items():
            if name[0].islower():
                setattr(node, name, value)
            else:
                node.inputs[name].default_value = value
        tree.links.new(node.outputs[output], colour)
        return made

    return make


CASES = {
    "Pointiness": shown("NewGeometry", "Pointiness"),
    "Island": shown("NewGeometry", "Random Per Island"),
    "Parametric": shown("NewGeometry", "Parametric"),
    "Wire": shown("Wireframe", 0, Size=0.08),
    "Pixel wire": shown("Wireframe", 0, Size=3.0, use_pixel_size=True),
    **{
        f"{name} {output}": shown("Attribute", output, attribute_name=name)
        for name in ("bend", "count", "seam", "flow")
        for output in (0, 3)
    },
    **{f"{name} {output}": shown("Attribute", output, attribute_name=name) for name in ("flat", "Map") for output in (0, 1, 2, 3)},
    "flow 2": shown("Attribute", 2, attribute_name="flow"),
    "unnamed": shown("Attribute", 3),
    "none": shown("Attribute", 3, attribute_name="nothing of this name"),
}


def lumps():
    """A smooth ball, a box of quads with a hole, and three loose parts, as one mesh of a metre; edges have attributes."""
    import bmesh
    import bpy
    import numpy as np
    from mathutils import Matrix

    shape = bmesh.new()
    bmesh.ops.create_icosphere(shape, subdivisions=2, radius=0.3, matrix=Matrix.Translation((-0.15, -0.1, 0)))
    bmesh.ops.create_cube(shape, size=0.35, matrix=Matrix.Translation((0.25, 0.2, 0)) @ Matrix.Rotation(0.6, 4, "Y"))
    for place in ((-0.3, 0.35, 0), (-0.1, 0.38, 0), (0.3, -0.3, 0)):
        bmesh.ops.create_grid(shape, x_segments=2, y_segments=1, size=0.09, matrix=Matrix.Translation(place) @ Matrix.Rotation(0.3, 4, "X"))
    mesh = bpy.data.meshes.new("Lumps")
    shape.to_mesh(mesh)
    shape.free()
    mesh.polygons.foreach_set("use_smooth", [number % 7 > 0 for number in range(len(mesh.polygons))])
    random = np.random.default_rng(1)
    for name, kind, key, width in (("bend", "FLOAT", "value", 1), ("flow", "FLOAT_COLOR", "color", 4)):
        count = len(mesh.edges)
        mesh.attributes.new(name, kind, "EDGE").data.foreach_set(key, random.uniform(0.1, 1.0, count * width).astype(np.float32))
    mesh.attributes.new("count", "INT", "EDGE").data.foreach_set("value", random.integers(0, 9, len(mesh.edges)).astype(np.int32))
    mesh.attributes.new("seam", "BOOLEAN", "EDGE").data.foreach_set("value", random.uniform(0, 1, len(mesh.edges)) > 0.8)
    flat = random.uniform(0, 1, 2 * len(mesh.vertices)).astype(np.float32)
    mesh.attributes.new("flat", "FLOAT2", "POINT").data.foreach_set("vector", flat)
    mesh.uv_layers.new(name="Map").uv.foreach_set("vector", random.uniform(0, 1, 2 * len(mesh.loops)).astype(np.float32))
    return mesh


@pytest.mark.blender(seconds=400)
def test_what_is_known_of_a_mesh_is_what_cycles_knows(tmp_path):
    import bpy
    import numpy as np
    from beside_cycles import both, link, scene

    scene(32 * len(CASES), 32, scale=len(CASES), samples=100)
    for number, make in enumerate(CASES.values()):
        mesh = lumps()
        mesh.materials.append(make())
        thing = link(bpy.data.objects.new("Lumps", mesh))
        thing.location, thing.scale = (number - 0.5 * len(CASES) + 0.5, 0.0, 0.0), (1.0, 1.0, 0.5)
    cycles, gonio = both(tmp_path)
    wrong = {}
    for number, name in enumerate(CASES):
        one, other = (picture[:, 32 * number : 32 * number + 32] for picture in (cycles, gonio))
        # Noise of edges and of wires aside.
        apart = np.abs(one - other).max(axis=2) / max(1.0, one.max())
        if not (np.median(apart[one.max(axis=2) > 0.0]) < 3e-3 and apart.mean() < 8e-3 and one.max() > 0.1):
            wrong[name] = np.median(apart[one.max(axis=2) > 0.0]), apart.mean(), apart.max(), one.max(), other.max()
    assert not wrong, wrong


@pytest.mark.blender
def test_parametric_coordinates_of_every_kind_of_mesh():
    """Meshes whose corners are as many as their points, and of triangles alone, among them."""
    import bpy
    import numpy as np
    from beside_cycles import link
    from recorder import depsgraph, exporter

    bpy.ops.wm.read_factory_settings(use_empty=True)
    shapes = {
        "square": ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2, 3)]),
        "triangle": ([(0, 0, 0), (1, 0, 0), (1, 1, 0)], [(0, 1, 2)]),
        "six points": ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (5, 5, 5), (6, 6, 6)], [(0, 1, 2, 3)]),
    }
    for name, (points, faces) in shapes.items():
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(points, [], faces)
        mesh.uv_layers.new(name="Map")
        mesh.materials.append(CASES["Wire"]())
        link(bpy.data.objects.new(name, mesh))
    export, report = exporter()
    for mesh in export.sync(depsgraph()).meshes:
        count = 3 * len(mesh["triangles"])
        corners = mesh["triangles"].reshape(-1) if mesh["corners"] is None else mesh["corners"]
        assert len(corners) == count and np.array_equal(mesh["triangles"].reshape(-1), np.arange(count))
        for number in range(3):
            assert np.array_equal(mesh["primvars"][f"blender triangle {number + 1}"][number::3], mesh["points"][corners[number::3]])
        assert len(mesh["primvars"]["st"]) == count
    assert not report.diagnostics
