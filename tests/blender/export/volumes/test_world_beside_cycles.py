"""Volumes of worlds that vary, and holdouts, beside Cycles."""

import pytest


@pytest.mark.blender(seconds=900)
@pytest.mark.timeout(900)
@pytest.mark.parametrize("kind", ["height", pytest.param("noise", marks=pytest.mark.validate)])
def test_fog_in_a_room_with_a_lamp(tmp_path, kind):
    """Nothing escapes from the room: before nothing Cycles' steps are endless."""
    import bpy
    from recorder import link
    from test_clouds_beside_cycles import alike, look
    from test_world_volumes import foggy, maths, thinning

    look(samples=32)

    def density(tree, along):
        height = maths(tree, "MULTIPLY", thinning(tree, along), 0.6)
        if kind == "height":
            return height
        noise = tree.nodes.new("ShaderNodeTexNoise")
        noise.inputs["Scale"].default_value, noise.inputs["Detail"].default_value = 0.7, 0.0
        return maths(tree, "MULTIPLY", height, noise.outputs[0])

    tree, shader, world = foggy(density)
    # Metres, times the scene's rate of a tenth.
    world.cycles.volume_step_size = 2.0
    shader.inputs["Color"].default_value, shader.inputs["Anisotropy"].default_value = (0.9, 0.8, 0.6, 1.0), 0.3
    for size, place in ((6.0, (0.0, 0.0, 2.5)), (0.6, (0.9, 0.6, 0.3))):
        bpy.ops.mesh.primitive_cube_add(size=size, location=place)
    lamp = bpy.data.lights.new("Lamp", "POINT")
    lamp.energy, lamp.shadow_soft_size = 100.0, 0.3
    link(bpy.data.objects.new("Lamp", lamp)).location = (-0.5, -0.3, 1.2)
    alike(tmp_path, lines=("far from the scene",))


@pytest.mark.blender(seconds=900)
@pytest.mark.parametrize("is_mesh", [False, True])
def test_volumes_on_holdouts_are_seen_as_others(tmp_path, is_mesh):
    import bpy
    from clouds import ball, cloud, filled, stored
    from test_clouds_beside_cycles import alike, lit, look

    look(samples=64).render.film_transparent = True
    made, _, _ = filled("VolumePrincipled", Color=(0.8, 0.7, 0.5, 1.0), Density=2.0)
    if is_mesh:
        bpy.ops.mesh.primitive_cube_add(size=1.6)
        thing = bpy.context.object
        thing.data.materials.append(made)
    else:
        thing = cloud(stored(tmp_path / "cloud.vdb", voxel=0.25, corner=(-6, -6, -6), density=ball()), made)
    thing.is_holdout = True
    lit()
    alike(tmp_path)
