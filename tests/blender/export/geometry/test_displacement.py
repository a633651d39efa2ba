"""Surfaces that move by their displacement, and adaptive subdivision: against Cycles, and as they are exported."""

import pytest


def relief(method, smooth=True, faces=48):
    """A plate of many faces that waves move, under a lamp, seen askew."""
    import bpy
    from recorder import link, material

    bpy.ops.mesh.primitive_grid_add(x_subdivisions=faces, y_subdivisions=faces, size=2.0)
    plate = bpy.context.object
    plate.scale, plate.rotation_euler = (1.0, 1.5, 2.0), (0.2, 0.1, 0.6)
    if smooth:
        bpy.ops.object.shade_smooth()
    made, tree, end = material("Relief")
    shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    place, wave, moved = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("TexCoord", "TexWave", "Displacement"))
    wave.inputs["Scale"].default_value, wave.inputs["Distortion"].default_value = 1.2, 3.0
    tree.links.new(place.outputs["Object"], wave.inputs["Vector"])
    tree.links.new(wave.outputs["Fac"], moved.inputs["Height"])
    moved.inputs["Scale"].default_value, moved.inputs["Midlevel"].default_value = 0.25, 0.3
    tree.links.new(moved.outputs[0], end.inputs["Displacement"])
    # What the moved surface knows of its place.
    split = tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(place.outputs["Object"], split.inputs[0])
    ramp = tree.nodes.new("ShaderNodeMath")
    ramp.operation = "MULTIPLY_ADD"
    tree.links.new(split.outputs["Z"], ramp.inputs[0])
    ramp.inputs[1].default_value, ramp.inputs[2].default_value = 2.0, 0.5
    tree.links.new(ramp.outputs[0], shader.inputs["Color"])
    made.displacement_method = method
    plate.data.materials.append(made)
    lamp = bpy.data.lights.new("Lamp", "SUN")
    lamp.energy, lamp.angle = 3.0, 0.05
    light = link(bpy.data.objects.new("Lamp", lamp))
    light.rotation_euler = (0.6, 0.5, 0.0)
    return plate


@pytest.mark.blender
@pytest.mark.parametrize("method", ["DISPLACEMENT", "BOTH"])
def test_moved_surfaces_look_as_in_cycles(tmp_path, method):
    import numpy as np
    from beside_cycles import both, scene

    scene(64, 64, scale=4.0, samples=64)
    plate = relief(method)
    if method == "BOTH":
        tree = plate.data.materials[0].node_tree
        next(node for node in tree.nodes if node.bl_idname == "ShaderNodeDisplacement").inputs["Scale"].default_value = 0.1
    cycles, gonio = both(tmp_path)
    assert cycles.std() > 0.1 * cycles.mean()
    blocks = [picture.reshape(8, 8, 8, 8, 3).mean(axis=(1, 3)) for picture in (cycles, gonio)]
    apart = np.abs(blocks[0] - blocks[1]).max()
    assert apart < 0.02 * cycles.max(), apart
    assert abs(cycles.mean() / gonio.mean() - 1.0) < 0.006, (cycles.mean(), gonio.mean())


@pytest.mark.blender
def test_adaptive_subdivision_is_exported():
    import bpy
    from recorder import depsgraph, empty, exporter, module

    empty()
    bpy.context.scene.render.engine = "GONIO"
    plate = relief("DISPLACEMENT", faces=4)
    modifier = plate.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = modifier.render_levels = 1
    scene = bpy.context.scene
    scene.cycles.preview_dicing_rate, scene.cycles.max_subdivisions = 6.0, 5

    def dicing():
        made, report = exporter()
        made.sync(depsgraph())
        return [mesh.get("dicing") for mesh in made.scene.meshes], report

    assert dicing()[0] == [None]
    if bpy.app.version >= (5, 0, 0):
        modifier.use_adaptive_subdivision, modifier.adaptive_pixel_size = True, 0.5
    else:
        scene.cycles.feature_set, plate.cycles.use_adaptive_subdivision, plate.cycles.dicing_rate = "EXPERIMENTAL", True, 0.5
    modifier.subdivision_type = "SIMPLE"
    assert dicing()[0] == [{"pixels": 3.0, "levels": 5, "smooth": False}]
    if bpy.app.version >= (5, 0, 0):
        modifier.adaptive_space, modifier.adaptive_object_edge_length = "OBJECT", 0.01
        assert dicing()[0] == [{"length": pytest.approx(0.06), "levels": 5, "smooth": False}]
    plate.modifiers.new("After", "TRIANGULATE")
    assert dicing()[0] == [None]
    assert module("export.dicing").dicing_of(bpy.data.objects["Lamp"], depsgraph()) is None
