"""Clamping as Cycles does it: which limit light gets by how often it was scattered, and what of a colour is limited."""

import pytest

SIZE = 16


def lit_wall(mirrored):
    """A grey wall under a coloured spark, all over the picture; `mirrored` shows it in a mirror."""
    import bpy
    import scenes

    scene = scenes.empty(width=SIZE, height=SIZE, samples=16)
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    bpy.context.object.data.materials.append(scenes.diffuse("Wall", (0.8, 0.6, 0.4)))
    bpy.ops.object.light_add(type="POINT", location=(0, 0, 1))
    lamp = bpy.context.object.data
    lamp.energy, lamp.shadow_soft_size, lamp.color = 200.0, 0.0, (1.0, 0.7, 0.3)
    bpy.ops.object.camera_add(location=(0, 0, 3), rotation=(3.141592653589793 if mirrored else 0.0, 0, 0))
    scene.camera = bpy.context.object
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 0.2
    if mirrored:
        bpy.ops.mesh.primitive_plane_add(size=20.0, location=(0, 0, 5))
        mirror = bpy.data.materials.new("Mirror")
        mirror.use_nodes = True
        tree = mirror.node_tree
        shader = tree.nodes.new("ShaderNodeBsdfAnisotropic")
        shader.inputs["Roughness"].default_value, shader.inputs["Color"].default_value = 0.0, (1, 1, 1, 1)
        tree.links.new(shader.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
        bpy.context.object.data.materials.append(mirror)
    # Without light from wall to mirror to wall.
    scene.cycles.max_bounces = 1 if mirrored else 0
    return scene


def colour(engine, path, direct, indirect):
    import bpy
    import scenes

    scene = bpy.context.scene
    scene.render.engine, settings = "CYCLES", scene.cycles
    settings.samples, settings.use_denoising, settings.use_adaptive_sampling = 16, False, False
    settings.sample_clamp_direct, settings.sample_clamp_indirect, settings.blur_glossy = direct, indirect, 0.0
    if engine == "GONIO":
        scene.render.engine = engine
        bpy.ops.gonio.settings_from_cycles()
        # What the mirror throws back onto the wall is lost in Cycles.
        scene.gonio.caustics = "OFF"
    scenes.render(path)
    channels = scenes.read(path)
    return [float(channels[f"ViewLayer.Combined.{channel}"].mean()) for channel in "RGB"]


@pytest.mark.blender
@pytest.mark.parametrize("mirrored", [False, True])
def test_limits_are_those_of_cycles(tmp_path, mirrored):
    lit_wall(mirrored)
    for number, limits in enumerate([(0.0, 0.0), (0.5, 0.0), (0.0, 0.3), (0.5, 0.3)]):
        found, expected = (colour(engine, tmp_path / f"{engine}{number}.exr", *limits) for engine in ("GONIO", "CYCLES"))
        assert found == pytest.approx(expected, rel=0.01), limits
        if limit := limits[mirrored]:
            assert sum(found) / 3 == pytest.approx(limit, rel=0.01)
