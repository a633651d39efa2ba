"""Tangents along UV maps, and normal maps in their space, against Cycles."""

import pytest


def shown(kind, **fields):
    """A maker of materials that shine with a node's vector, halved and moved up so that nothing is negative."""

    def make():
        from beside_cycles import shining

        made, tree, colour = shining(kind)
        node, moved = tree.nodes.new(f"ShaderNode{kind}"), tree.nodes.new("ShaderNodeVectorMath")
        for name, value in fields.items():
            if name[0].islower():
                setattr(node, name, value)
            else:
                node.inputs[name].default_value = value
        moved.operation = "MULTIPLY_ADD"
        moved.inputs[1].default_value = moved.inputs[2].default_value = (0.5, 0.5, 0.5)
        tree.links.new(node.outputs[0], moved.inputs[0])
        tree.links.new(moved.outputs[0], colour)
        return made

    return make


CASES = {
    "tangent": shown("Tangent", direction_type="UV_MAP"),
    "other map": shown("Tangent", direction_type="UV_MAP", uv_map="Other"),
    "map": shown("NormalMap", Color=(0.75, 0.35, 0.8, 1.0)),
    "half": shown("NormalMap", Color=(0.75, 0.35, 0.8, 1.0), Strength=0.5, uv_map="Other"),
    "twice": shown("NormalMap", Color=(0.6, 0.35, 0.8, 1.0), Strength=2.0),
}


def ball(number, is_smooth, cover):
    """A coarse ball with a face of five corners, mirrored UVs on one side, and another map."""
    import bmesh
    import bpy
    import numpy as np
    from beside_cycles import link

    shape = bmesh.new()
    shape.loops.layers.uv.new("Map")
    bmesh.ops.create_uvsphere(shape, u_segments=12, v_segments=7, radius=0.45, calc_uvs=True)
    bmesh.ops.join_triangles(shape, faces=shape.faces[:6], angle_face_threshold=3.0, angle_shape_threshold=3.0)
    mesh = bpy.data.meshes.new("Ball")
    shape.to_mesh(mesh)
    shape.free()
    mesh.polygons.foreach_set("use_smooth", [is_smooth] * len(mesh.polygons))
    uv = np.empty(2 * len(mesh.loops), dtype=np.float32)
    mesh.uv_layers[0].uv.foreach_get("vector", uv)
    uv = uv.reshape(-1, 2)
    uv[:, 0] = np.where(uv[:, 0] > 0.5, 1.0 - uv[:, 0], uv[:, 0])
    mesh.uv_layers[0].uv.foreach_set("vector", uv.ravel())
    mesh.uv_layers.new(name="Other").uv.foreach_set(
        "vector", (uv @ np.array([[0.6, 0.8], [-0.8, 0.6]]) + uv[:, ::-1] ** 2).astype("f4").ravel()
    )
    mesh.materials.append(cover)
    thing = link(bpy.data.objects.new("Ball", mesh))
    # Two objects of a mesh: meshes of one alone are transformed by Cycles beforehand.
    twin = link(bpy.data.objects.new("Twin", mesh))
    twin.location = (0.0, 0.0, 200.0)
    thing.location, thing.scale, thing.rotation_euler = (number % 5 - 2.0, 0.5 - number // 5, 0.0), (1.0, 0.8, 0.6), (0.4, 0.3, 0.2)


@pytest.mark.blender(seconds=400)
def test_normal_maps_and_tangents_are_those_of_cycles(tmp_path):
    import numpy as np
    from beside_cycles import both, scene

    scene(40 * 5, 80, scale=5.0, samples=36)
    for number, make in enumerate([*CASES.values()] * 2):
        ball(number, number < 5, make())
    cycles, gonio = both(tmp_path)
    wrong = {}
    for number, name in enumerate([*CASES, *(f"flat {name}" for name in CASES)]):
        row, column = divmod(number, 5)
        one, other = (picture[40 * row : 40 * row + 40, 40 * column : 40 * column + 40] for picture in (cycles, gonio))
        apart = np.abs(one - other).max(axis=2)[one.max(axis=2) > 0.0]
        # Flat faces have one tangent a corner, in Cycles one for each of their triangles.
        median, most = (3e-3, 0.02) if number < 5 else (0.02, 0.05)
        if not (one.max() > 0.5 and np.median(apart) < median and np.quantile(apart, 0.8) < most):
            wrong[name] = np.median(apart), np.quantile(apart, [0.5, 0.8, 0.9, 1.0]), one.max()
    assert not wrong, wrong
