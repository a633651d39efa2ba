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


@pytest.mark.blender
def test_what_light_paths_bring_is_limited(tmp_path):
    import bpy
    import scenes

    scene = scenes.empty(width=24, height=24, samples=32)
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    bpy.context.object.data.materials.append(scenes.diffuse("Floor", (0.5, 0.5, 0.5)))
    bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, radius=0.4, location=(-1.0, 0.0, 0.8))
    bpy.ops.object.shade_smooth()
    glass = bpy.data.materials.new("Glass")
    glass.use_nodes = True
    tree = glass.node_tree
    shader = tree.nodes.new("ShaderNodeBsdfGlass")
    shader.inputs["Roughness"].default_value, shader.inputs["IOR"].default_value = 0.0, 1.5
    tree.links.new(shader.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    bpy.context.object.data.materials.append(glass)
    bpy.ops.object.light_add(type="POINT", location=(-2.5, 0.0, 2.0))
    bpy.context.object.data.energy, bpy.context.object.data.shadow_soft_size = 100.0, 0.05
    bpy.ops.object.camera_add(location=(0.2, 0.0, 4.0))
    scene.camera = bpy.context.object
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 1.5
    layer = scene.view_layers[0]
    layer.use_pass_diffuse_indirect = layer.use_pass_diffuse_color = True
    scene.gonio.caustics = "ON"
    found = []
    # As radiance in Blender's watts, as Cycles has it.
    for number, limit in enumerate((0.0, 0.15)):
        scene.gonio.clamp_indirect = limit
        scenes.render(tmp_path / f"{number}.exr")
        channels = scenes.read(tmp_path / f"{number}.exr")
        of = lambda *names: next(values for name, values in channels.items() if any(part in name for part in names) and name.endswith(".G"))  # noqa: E731
        found.append(of("DiffInd", "Diffuse Indirect") * of("DiffCol", "Diffuse Color"))
    free, held = found
    assert free.max() > 4 * 0.15 and held.max() == pytest.approx(0.15, rel=0.05), (free.max(), held.max())
