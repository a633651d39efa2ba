"""Coordinates of a Texture Coordinate node in a world: against Cycles, and when the camera moves."""

import pytest

OUTPUTS = ("Generated", "Normal", "UV", "Object", "Camera", "Window", "Reflection")


def world_of(made, output):
    """A world whose light is one of the node's outputs, made positive."""
    tree = made.world.node_tree
    node, moved = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeVectorMath")
    moved.operation = "MULTIPLY_ADD"
    moved.inputs[1].default_value, moved.inputs[2].default_value = (0.3,) * 3, (0.5,) * 3
    tree.links.new(node.outputs[output], moved.inputs[0])
    tree.links.new(moved.outputs[0], tree.nodes["Background"].inputs["Color"])


@pytest.mark.blender
@pytest.mark.parametrize("output", OUTPUTS)
def test_a_world_knows_where_it_is_seen(tmp_path, output):
    from beside_cycles import both, close, scene

    made = scene(48, 32, samples=64)
    made.camera.rotation_euler, made.camera.data.type, made.camera.data.lens = (1.2, 0.1, 0.6), "PERSP", 30.0
    made.camera.data.shift_x = 0.1
    world_of(made, output)
    # Baked to pixels of a third of a degree.
    close(both(tmp_path, lines=["baked"] if output != "UV" else []), 5e-3)


@pytest.mark.blender
def test_a_world_follows_the_camera_that_it_asked_for():
    import bpy
    from beside_cycles import scene
    from recorder import depsgraph, exporter

    for output, follows in (("Window", True), ("Generated", False)):
        made = scene(8)
        made.camera.data.type = "PERSP"
        world_of(made, output)
        export, report = exporter()
        recorded = export.sync(depsgraph())
        assert not [line for line in report.diagnostics if line.severity == "WARNING"], report.diagnostics
        bpy.app.handlers.depsgraph_update_post.clear()
        bpy.app.handlers.depsgraph_update_post.append(lambda _, graph, export=export: export.update(graph))
        recorded.calls.clear()
        made.camera.rotation_euler = (1.0, 0.0, 0.0)
        bpy.context.view_layer.update()
        assert ("lights" in recorded.calls) == follows, recorded.calls
        bpy.app.handlers.depsgraph_update_post.clear()


@pytest.mark.blender
def test_a_world_without_perspective_says_that_it_has_no_window():
    from beside_cycles import scene
    from recorder import depsgraph, exporter

    made = scene(8)
    world_of(made, "Window")
    export, report = exporter()
    export.sync(depsgraph())
    assert [line.node for line in report.diagnostics if line.severity == "WARNING"] == ["Texture Coordinate"]
