"""Volume objects beside Cycles: where voxels stand, how dense they are, how fire shines."""

import pytest


def look(bounces=2, samples=16):
    import bpy
    from beside_cycles import scene

    made = scene(32, 32, scale=4.0, samples=samples)
    made.cycles.volume_bounces = bounces
    # Marching by short steps: null scattering draws one order of its series for a whole picture, whose mean so wavers by a percent.
    if bpy.app.version >= (5, 0, 0):
        made.cycles.volume_biased = True
    made.cycles.volume_step_rate = 0.1
    return made


def lit():
    """A sun and a lamp."""
    import bpy
    from recorder import link

    sun, lamp = bpy.data.lights.new("Sun", "SUN"), bpy.data.lights.new("Lamp", "POINT")
    sun.energy, sun.angle = 3.0, 0.1
    link(bpy.data.objects.new("Sun", sun)).rotation_euler = (0.7, 0.3, 0)
    lamp.energy, lamp.shadow_soft_size = 150.0, 0.3
    link(bpy.data.objects.new("Lamp", lamp)).location = (2.0, -1.0, 1.5)


def alike(path, channels=3, mean=0.03, block=0.12, lines=()):
    """The means of both pictures' first channels, of blocks of 8 by 8 pixels, and the middle of the light; the report may hold these words' lines."""
    import numpy as np
    from beside_cycles import both

    cycles, gonio = pictures = [picture[..., :channels] for picture in both(path, lines=lines)]
    blocks = [picture.reshape(4, 8, 4, 8, channels).mean((1, 3)) for picture in pictures]
    apart = np.abs(blocks[1] - blocks[0]) / np.maximum(blocks[0], 0.1 * blocks[0].max())
    middles = [[(picture.sum(-1) * np.indices((32, 32))[axis]).sum() / picture.sum() for axis in (0, 1)] for picture in pictures]
    assert blocks[0].max() > 0.0 and np.isfinite(gonio).all()
    assert gonio.mean((0, 1)) == pytest.approx(cycles.mean((0, 1)), rel=mean)
    assert np.quantile(apart, 0.95) < block, apart.max(-1).round(3)
    assert np.allclose(*middles, atol=0.3), middles


@pytest.mark.blender(seconds=900)
@pytest.mark.parametrize("space", ["OBJECT", pytest.param("WORLD", marks=pytest.mark.validate)])
def test_a_cloud_in_sun_and_lamp(tmp_path, space):
    from clouds import ball, cloud, filled, stored

    look(samples=64)
    made, _, _ = filled("VolumePrincipled", Color=(0.8, 0.7, 0.5, 1.0), Density=3.0, Anisotropy=0.3)
    # Aside, so that half a voxel shows.
    thing = cloud(stored(tmp_path / "cloud.vdb", voxel=0.25, corner=(-4, -6, -6), density=ball()), made)
    thing.scale, thing.rotation_euler, thing.data.render.space = (1.2, 1.0, 0.9), (0.2, 0.3, 0.5), space
    lit()
    alike(tmp_path)


@pytest.mark.blender(seconds=900)
def test_fire_by_temperature(tmp_path):
    from clouds import ball, cloud, filled, stored

    look()
    made, _, _ = filled("VolumePrincipled", Density=0.5, Blackbody_Intensity=1.0, Temperature=1000.0)
    # Since 5.0 Cycles takes one voxel by chance for each sample, so that it mixes light where Gonio mixes temperatures: fine voxels.
    fine = ball(40)
    thing = cloud(stored(tmp_path / "fire.vdb", voxel=0.075, corner=(-20, -20, -20), density=fine, temperature=2.0 * fine), made)
    thing.scale = (1.3, 1.3, 1.3)
    # Cycles leaves the blue of fire below zero, and the green under 800 K: red alone.
    alike(tmp_path, channels=1)


@pytest.mark.blender(seconds=900)
def test_glow_by_density_and_a_ramp(tmp_path):
    from clouds import attribute, ball, cloud, filled, stored

    look()
    made, tree, shader = filled("VolumePrincipled", Color=(0.5, 0.5, 0.5, 1.0), Emission_Color=(1.0, 0.5, 0.2, 1.0))
    shader.inputs["Density Attribute"].default_value = ""
    power = tree.nodes.new("ShaderNodeMath")
    power.operation, power.inputs[1].default_value = "POWER", 2.0
    tree.links.new(attribute(tree, "density"), power.inputs[0])
    tree.links.new(power.outputs[0], shader.inputs["Density"])
    tree.links.new(attribute(tree, "density"), shader.inputs["Emission Strength"])
    thing = cloud(stored(tmp_path / "glow.vdb", corner=(-6, -6, -6), density=ball()), made)
    thing.scale = (1.5, 1.5, 1.5)
    alike(tmp_path)


@pytest.mark.blender(seconds=900)
@pytest.mark.parametrize("what", ["Color", "Emission Color"])
def test_colours_that_vary_over_a_cloud(tmp_path, what):
    """From red on one side to blue on the other: what is scattered, or what is sent."""
    from clouds import ball, cloud, filled, stored

    look(samples=64)
    made, tree, shader = filled("VolumePrincipled", Density=3.0)
    if what == "Emission Color":
        # Where there is smoke: Cycles takes light from whole blocks of voxels else.
        tree.links.new(tree.nodes.new("ShaderNodeVolumeInfo").outputs["Density"], shader.inputs["Emission Strength"])
    place, apart, ramp = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("TexCoord", "SeparateXYZ", "ValToRGB"))
    moved = tree.nodes.new("ShaderNodeMath")
    moved.operation, moved.inputs[1].default_value, moved.inputs[2].default_value = "MULTIPLY_ADD", 0.4, 0.5
    ramp.color_ramp.elements[0].color, ramp.color_ramp.elements[1].color = (0.9, 0.2, 0.1, 1.0), (0.1, 0.3, 0.95, 1.0)
    tree.links.new(place.outputs["Object"], apart.inputs[0])
    tree.links.new(apart.outputs["X"], moved.inputs[0])
    tree.links.new(moved.outputs[0], ramp.inputs[0])
    tree.links.new(ramp.outputs["Color"], shader.inputs[what])
    cloud(stored(tmp_path / "cloud.vdb", voxel=0.25, corner=(-6, -6, -6), density=ball()), made)
    lit()
    alike(tmp_path)
