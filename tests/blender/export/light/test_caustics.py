"""Lamps in clear glass light what is around them."""

import pytest


def lamp_in_a_globe():
    """A point lamp in a hollow glass globe above a white floor, seen past the globe from above."""
    import bpy
    import scenes

    scene = scenes.empty(width=32, height=32, samples=256)
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    bpy.context.object.data.materials.append(scenes.diffuse("White", (0.5, 0.5, 0.5)))
    bpy.ops.object.light_add(type="POINT", location=(0, 0, 1.5))
    bpy.context.object.data.energy, bpy.context.object.data.shadow_soft_size = 100.0, 0.0
    glass = bpy.data.materials.new("Glass")
    glass.use_nodes = True
    tree = glass.node_tree
    tree.nodes.clear()
    shader, output = tree.nodes.new("ShaderNodeBsdfGlass"), tree.nodes.new("ShaderNodeOutputMaterial")
    shader.inputs["Roughness"].default_value, shader.inputs["IOR"].default_value = 0.0, 1.5
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    for radius, inward in ((0.25, False), (0.2, True)):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=96, ring_count=48, radius=radius, location=(0, 0, 1.5))
        globe = bpy.context.object
        globe.name = f"Globe {radius}"
        if inward:
            globe.data.flip_normals()
        globe.data.materials.append(glass)
    bpy.ops.object.camera_add(location=(1.5, 0, 5), rotation=(0, 0, 0))
    scene.camera = bpy.context.object
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 1.0
    return scene


@pytest.mark.blender
def test_a_lamp_in_a_globe_lights_the_floor(tmp_path):
    import math

    import bpy
    import scenes

    scene = lamp_in_a_globe()
    scenes.render(tmp_path / "lit.exr")
    found = float(scenes.read(tmp_path / "lit.exr")["ViewLayer.Combined.G"].mean())
    # Glass keeps no light: what it throws back passes on the other side.
    places = [(1.5 + (i + 0.5) / 32 - 0.5, (j + 0.5) / 32 - 0.5) for i in range(32) for j in range(32)]
    irradiance = sum(100.0 / (4 * math.pi) / math.pi * 1.5 / (x * x + y * y + 2.25) ** 1.5 for x, y in places) / len(places)
    bare = 0.5 * irradiance
    assert found == pytest.approx(bare, rel=0.03)
    scene.gonio.caustics = "OFF"
    scenes.render(tmp_path / "dark.exr")
    assert float(scenes.read(tmp_path / "dark.exr")["ViewLayer.Combined.G"].mean()) == 0.0
