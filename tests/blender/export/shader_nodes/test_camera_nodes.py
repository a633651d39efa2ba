"""Nodes that know the camera against Cycles, through cameras of several kinds, and when the camera moves."""

import pytest

SPACES = ("WORLD", "OBJECT", "CAMERA")


def cases():
    from beside_cycles import shining

    found = {}

    def shown(name, kind, output, weight, **fields):
        def make():
            made, tree, colour = shining(name)
            node = tree.nodes.new(f"ShaderNode{kind}")
            for field, value in fields.items():
                setattr(node, field, value)
            if kind == "VectorTransform":
                place = tree.nodes.new("ShaderNodeNewGeometry")
                tree.links.new(place.outputs["Position" if fields["vector_type"] == "POINT" else "Normal"], node.inputs[0])
            # Nothing that shines is negative.
            moved = tree.nodes.new("ShaderNodeVectorMath")
            moved.operation = "MULTIPLY_ADD"
            moved.inputs[1].default_value, moved.inputs[2].default_value = (weight,) * 3, (0.5,) * 3
            tree.links.new(node.outputs[output], moved.inputs[0])
            tree.links.new(moved.outputs[0], colour)
            return made

        found[name] = make

    for output in ("View Vector", "View Z Depth", "View Distance"):
        shown(output, "CameraData", output, 0.1)
    for output, weight in (("Camera", 0.1), ("Window", 1.0)):
        shown(output, "TexCoord", output, weight)
    for kind in ("POINT", "VECTOR", "NORMAL"):
        for start in SPACES:
            for end in SPACES:
                shown(f"{kind} {start} {end}", "VectorTransform", 0, 0.1, vector_type=kind, convert_from=start, convert_to=end)
    return found


LENSES = {
    "ortho": {"type": "ORTHO", "ortho_scale": 9.0, "shift_x": 0.1},
    "lens": {"type": "PERSP", "lens": 30.0, "shift_x": 0.1, "shift_y": -0.05},
}


def leaves(shown):
    """Tilted squares side by side, one for each case, in the plane of z = 0."""
    import bpy
    from beside_cycles import link

    made = []
    for number, make in enumerate(shown.values()):
        x, y = number % 8, number // 8
        mesh = bpy.data.meshes.new("Leaf")
        mesh.from_pydata([(0, 0, 0), (0.5, 0, 0), (0.5, 0.5, 0), (0, 0.5, 0)], [], [(0, 1, 2, 3)])
        mesh.materials.append(make())
        thing = link(bpy.data.objects.new("Leaf", mesh))
        thing.location, thing.scale, thing.rotation_euler = (x - 4, y - 2, 0.1 * x), (2.0, 1.9, 1.5), (0.1, 0.2, 0.3)
        made.append(thing)
    return made


@pytest.mark.blender
def test_what_the_camera_sees_is_what_cycles_computes(tmp_path):
    import numpy as np
    from beside_cycles import both, scene
    from bpy_extras.object_utils import world_to_camera_view
    from mathutils import Vector

    for fields in LENSES.values():
        made = scene(96, 64, samples=64)
        shown = leaves(cases())
        made.camera.location, made.camera.rotation_euler, made.camera.scale = (0.5, -1.0, 6.0), (0.15, 0.1, 0.2), (2.0, 2.0, 2.0)
        for name, value in fields.items():
            setattr(made.camera.data, name, value)
        cycles, gonio = both(tmp_path)
        middles = [leaf.matrix_world @ Vector((0.25, 0.25, 0.0)) for leaf in shown]
        places = [world_to_camera_view(made, made.camera, middle) for middle in middles]
        pixels = [(int((1.0 - y) * 64), int(x * 96)) for x, y, z in places if z > 0.0 and 0.05 < x < 0.95 and 0.05 < y < 0.95]
        apart = [np.abs(cycles[pixel] - gonio[pixel]).max() for pixel in pixels]
        assert len(apart) > 20 and max(apart) < 2e-3 and min(cycles[pixel].max() for pixel in pixels) > 0.2, (len(apart), max(apart))


@pytest.mark.blender
def test_materials_follow_the_camera_and_the_view_layer():
    import bpy
    from beside_cycles import scene, shining
    from recorder import depsgraph, exporter

    made = scene(8)

    def speed():
        material, tree, colour = shining("speed")
        node = tree.nodes.new("ShaderNodeAttribute")
        node.attribute_type, node.attribute_name = "VIEW_LAYER", "speed"
        tree.links.new(node.outputs["Color"], colour)
        return material

    leaves({"Window": cases()["Window"], "plain": cases()["NORMAL OBJECT WORLD"], "speed": speed})
    export, report = exporter()
    recorded = export.sync(depsgraph())
    assert "Transform3d" in str(recorded.materials[0]) and not report.diagnostics, report.diagnostics

    def watch(_, graph):
        export.update(graph)

    bpy.app.handlers.depsgraph_update_post.append(watch)

    def after(edit):
        recorded.calls.clear()
        before = [str(material) for material in recorded.materials]
        edit()
        bpy.context.view_layer.update()
        return [str(material) != old for material, old in zip(recorded.materials, before, strict=True)], sorted(set(recorded.calls))

    assert after(lambda: setattr(made.camera, "location", (3, 0, 5))) == ([True, False, False], ["cameras", "materials"])
    assert after(lambda: (made.__setitem__("speed", 2.0), made.update_tag())) == ([False, False, True], ["materials"])
    assert dict(recorded.materials[2]["closures"][0]["parameters"])["emission_color"]["Constant"][0] > 300.0
    bpy.app.handlers.depsgraph_update_post.remove(watch)


@pytest.mark.blender
def test_worlds_have_no_camera_and_say_so():
    import bpy
    from beside_cycles import scene
    from recorder import depsgraph, exporter

    made = scene(8)
    tree = made.world.node_tree
    tree.links.new(tree.nodes.new("ShaderNodeCameraData").outputs[0], tree.nodes["Background"].inputs["Color"])
    export, report = exporter()
    export.sync(depsgraph())
    assert [line.node for line in report.diagnostics if line.severity == "WARNING"] == ["Camera Data"]
    assert bpy.context.scene is made


@pytest.mark.blender
def test_materials_follow_the_object_that_they_lie_along():
    import bpy
    from beside_cycles import link, scene, shining
    from recorder import depsgraph, exporter

    scene(8)
    guide = link(bpy.data.objects.new("Guide", None))

    def along():
        material, tree, colour = shining("along")
        node = tree.nodes.new("ShaderNodeTexCoord")
        node.object = guide
        tree.links.new(node.outputs["Object"], colour)
        return material

    leaves({"along": along})
    export, _ = exporter()
    recorded = export.sync(depsgraph())
    seen = []
    bpy.app.handlers.depsgraph_update_post.append(lambda _, graph: seen.append(export.update(graph)))
    guide.location = (1.0, 2.0, 3.0)
    bpy.context.view_layer.update()
    bpy.app.handlers.depsgraph_update_post.pop()
    assert [changes.shading for changes in seen if changes.anything] == [True]
    moved = [
        node["operation"]["Transform3d"]["rows"] for node in recorded.materials[0]["graph"]["nodes"] if "Transform3d" in node["operation"]
    ]
    assert [[round(row[3], 5) for row in rows] for rows in moved] == [[-1.0, -2.0, -3.0]], moved
