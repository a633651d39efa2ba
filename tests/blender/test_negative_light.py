"""Lamps, surfaces and worlds of negative strength are told by name."""

import pytest


@pytest.mark.blender
def test_negative_strength_is_told():
    import bpy
    from beside_cycles import shining
    from recorder import depsgraph, empty, exporter, link, quad

    def lines(**changes):
        """The report's lines on a scene of a lamp, a shining quad and a world of these strengths."""
        empty()
        scene = bpy.context.scene
        scene.world = bpy.data.worlds.new("World")
        if bpy.app.version < (5, 0, 0):
            scene.world.use_nodes = True
        scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = changes.get("world", 1.0)
        lamp = link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
        lamp.data.energy = changes.get("lamp", 1.0)
        if "nodes" in changes:
            lamp.data.use_nodes = True
            emission = next(node for node in lamp.data.node_tree.nodes if node.bl_idname == "ShaderNodeEmission")
            emission.inputs["Strength"].default_value = changes["nodes"]
        made, _, color = shining()
        color.node.inputs["Strength"].default_value = changes.get("surface", 1.0)
        thing = link(bpy.data.objects.new("Thing", quad()))
        thing.data.materials.append(made)
        exported, report = exporter()
        exported.sync(depsgraph())
        return [(line.kind, line.name) for line in report.diagnostics if line.message.endswith("dark: they take no light away")]

    assert not lines()
    assert lines(lamp=-2.0) == [("Light", "Lamp")]
    assert lines(nodes=-1.0) == [("Light", "Lamp")]
    assert lines(surface=-1.0) == [("Material", "Shining")]
    assert lines(world=-1.0) == [("World", "World")]


@pytest.mark.blender
def test_patterns_that_are_negative_in_parts_are_told():
    import bpy
    from recorder import depsgraph, empty, exporter, link

    empty()
    lamp = link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
    lamp.data.use_nodes = True
    tree = lamp.data.node_tree
    emission = next(node for node in tree.nodes if node.bl_idname == "ShaderNodeEmission")
    place, parts = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(place.outputs["Normal"], parts.inputs[0])
    tree.links.new(parts.outputs[0], emission.inputs["Strength"])
    exported, report = exporter()
    exported.sync(depsgraph())
    assert [line.name for line in report.diagnostics if "negative in parts" in line.message] == ["Lamp"]
