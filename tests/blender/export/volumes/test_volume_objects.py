"""Volume objects as fields, boxes and materials of the scene."""

import pytest


@pytest.mark.blender
def test_a_file_is_read_by_the_renderer_and_fills_its_box(tmp_path):
    import bpy
    import numpy as np
    from clouds import ball, cloud, exported, filled, stored
    from recorder import empty

    empty()
    made, _, _ = filled("VolumePrincipled", Color=(0.6, 0.8, 1.0, 1.0), Density=5.0, Anisotropy=0.3)
    path = stored(tmp_path / "cloud.vdb", density=ball())
    thing = cloud(path, made)
    thing.location, thing.scale = (1, 2, 3), (2, 2, 2)
    _, scene, lines = exported()
    assert not lines
    (field,), (instance,) = scene.fields, scene.instances
    assert field["density"] == (str(path), "density") and field["heat"] is None
    # Before 5.0 values stood in the middles of voxels.
    shift = 0.0 if bpy.app.version >= (5, 0, 0) else 0.25
    assert np.allclose(field["to_world"]["columns"], [[2, 0, 0], [0, 2, 0], [0, 0, 2], [1 + shift, 2 + shift, 3 + shift]])
    medium = scene.materials[instance["materials"][0]]["medium"]
    # Twice as wide, half as dense.
    assert np.allclose(medium["scattering"], np.array([0.6, 0.8, 1.0]) * 2.5)
    assert np.allclose(medium["absorption"], np.array([0.4, 0.2, 0.0]) * 2.5)
    assert medium["anisotropy"] == pytest.approx(0.3) and medium["field"] == 0 and scene.meshes[instance["mesh"]]["field"] == 0
    thing.data.render.space = "WORLD"
    _, scene, _ = exported()
    assert np.allclose(scene.materials[0]["medium"]["scattering"], np.array([0.6, 0.8, 1.0]) * 5.0)


@pytest.mark.blender
def test_no_material_is_the_usual_smoke_and_no_volume_is_nothing(tmp_path):
    import numpy as np
    from clouds import ball, cloud, exported, filled, stored
    from recorder import empty, material

    empty()
    path = stored(tmp_path / "cloud.vdb", density=ball())
    thing = cloud(path)
    _, scene, lines = exported()
    assert not lines and np.allclose(scene.materials[0]["medium"]["scattering"], 0.5)
    thing.data.materials.append(material()[0])
    assert not exported()[1].instances
    # As in Cycles, one that asks for no grid has no extent.
    thing.data.materials[0] = filled("VolumeScatter", Density=1.0)[0]
    _, scene, lines = exported()
    assert not lines and not scene.instances


@pytest.mark.blender
def test_grids_that_are_not_there_are_told_by_name(tmp_path):
    from clouds import attribute, ball, cloud, exported, filled, stored
    from recorder import empty

    empty()
    made, tree, shader = filled("VolumePrincipled", Density_Attribute="smoke", Blackbody_Intensity=1.0)
    tree.links.new(attribute(tree, "flames"), shader.inputs["Emission Strength"])
    cloud(stored(tmp_path / "cloud.vdb", density=ball()), made)
    lines = exported()[2]
    # As in Cycles Principled Volume counts what is not there as 1.
    assert sorted(lines) == [
        f"Cloud: it has no grid '{name}', which its shader asks for; {instead} in its place, as in Cycles"
        for name, instead in (("flames", 0), ("smoke", 1), ("temperature", 1))
    ]


@pytest.mark.blender
def test_fire_is_a_table_over_heat(tmp_path):
    import numpy as np
    from clouds import ball, cloud, exported, filled, stored
    from recorder import empty

    empty()
    made, _, _ = filled("VolumePrincipled", Density=1.0, Blackbody_Intensity=1.0, Temperature=1000.0)
    path = stored(tmp_path / "fire.vdb", density=ball(), temperature=2.5 * ball())
    cloud(path, made)
    _, scene, lines = exported()
    (field,) = scene.fields
    assert not lines and field["heat"] == (str(path), "temperature")
    highest = float(2.5 * ball().max())
    assert field["hottest"] == pytest.approx(highest) and len(field["glow"]) == 256
    glow, emission = np.array(field["glow"]), np.array(scene.materials[0]["medium"]["emission"])
    # Stefan and Boltzmann's law in Cycles' units, at the highest and at the half of it; all light counts alike in the sum of a hue of unit luminance.
    sent = (glow * emission) @ [0.2126390, 0.7151687, 0.0721923]
    for share in (1.0, 0.5):
        kelvins = 1000.0 * highest * share
        wanted = 177.83 * 5.670373e-8 * 1e-6 / np.pi * kelvins**4
        assert np.interp(share * 255, np.arange(256), sent) == pytest.approx(wanted, rel=0.02)


@pytest.mark.blender
def test_what_varies_otherwise_is_asked_point_by_point(tmp_path):
    import numpy as np
    from clouds import attribute, ball, cloud, exported, filled, stored
    from recorder import empty

    empty()
    made, tree, shader = filled("VolumeScatter", Color=(0.5, 0.5, 0.5, 1.0))
    ramp = tree.nodes.new("ShaderNodeMath")
    ramp.operation = "POWER"
    ramp.inputs[1].default_value = 2.0
    tree.links.new(attribute(tree, "density"), ramp.inputs[0])
    tree.links.new(ramp.outputs[0], shader.inputs["Density"])
    cloud(stored(tmp_path / "cloud.vdb", density=ball()), made)
    _, scene, lines = exported()
    (field,), medium = scene.fields, scene.materials[0]["medium"]
    assert not lines
    dense = field["density"] * medium["scattering"][0]
    low = [int(np.nonzero(ball().any(axis=tuple({0, 1, 2} - {axis})))[0][0]) for axis in range(3)]
    # One voxel more on each side, in which it fades.
    inner = ball()[tuple(slice(a, a + edge - 2) for a, edge in zip(low, dense.shape, strict=True))]
    assert np.allclose(dense[1:-1, 1:-1, 1:-1], 0.5 * inner**2, atol=1e-5)
    assert not dense[0].any() and not dense[..., -1].any()


def red_and_blue(path):
    """A cloud that is red in its lower half along x and blue in the other, by an attribute of its file."""
    import numpy as np
    from clouds import ball, cloud, filled, stored
    from recorder import empty

    empty()
    made, _, shader = filled("VolumePrincipled", Color=(1.0, 1.0, 1.0, 1.0))
    shader.inputs["Color Attribute"].default_value = "color"
    colour = np.zeros((12, 12, 12, 3), dtype=np.float32)
    colour[:6, ..., 0], colour[6:, ..., 2] = 1.0, 1.0
    cloud(stored(path, density=ball(), color=colour), made)


@pytest.mark.blender
def test_colours_by_voxel_are_kept(tmp_path):
    import numpy as np
    from clouds import ball, exported

    red_and_blue(tmp_path / "cloud.vdb")
    _, scene, lines = exported()
    assert not lines
    medium, field = scene.materials[0]["medium"], scene.fields[0]
    assert medium["absorption"] == [0.0] * 3 and medium["scattering"][0] == medium["scattering"][2]
    scattering = medium["scattering"][0] * field["taken"][1:-1, 1:-1, 1:-1, 3:]
    density = np.asarray(field["density"])
    # Red on one side and blue on the other; what is not scattered of a colour is absorbed.
    assert scattering[:6, ..., 0] == pytest.approx(ball()[:6], abs=1e-5)
    assert scattering[6:, ..., 2] == pytest.approx(ball()[6:], abs=1e-5)
    assert not scattering[..., 1].any() and not scattering[6:, ..., 0].any()
    assert np.allclose(density, field["taken"][..., :3].max(-1)) and (field["taken"][..., 3:] <= field["taken"][..., :3] + 1e-6).all()


@pytest.mark.blender
def test_colours_of_very_many_voxels_are_their_mean_and_told(tmp_path):
    import sys

    import numpy as np
    from clouds import ball, exported

    red_and_blue(tmp_path / "cloud.vdb")
    baked = sys.modules["gonio_extension.export.volumes.baked"]
    before, baked.COLOURED = baked.COLOURED, 100
    try:
        _, scene, lines = exported()
    finally:
        baked.COLOURED = before
    assert len(lines) == 1 and "the mean colour" in lines[0]
    scattering = np.array(scene.materials[0]["medium"]["scattering"])
    assert scattering[0] == pytest.approx(scattering[2]) and scattering[1] == 0.0
    # What all of it takes is what it was.
    assert float((scene.fields[0]["density"] * scattering[0]).sum()) == pytest.approx(0.5 * float(ball().sum()), rel=1e-4)


@pytest.mark.blender
def test_noise_varies_with_the_place(tmp_path):
    from clouds import ball, cloud, exported, filled, stored
    from recorder import empty

    empty()
    made, tree, shader = filled("VolumePrincipled")
    noise, place = tree.nodes.new("ShaderNodeTexNoise"), tree.nodes.new("ShaderNodeTexCoord")
    tree.links.new(place.outputs["Object"], noise.inputs["Vector"])
    tree.links.new(noise.outputs[0], shader.inputs["Density"])
    cloud(stored(tmp_path / "cloud.vdb", density=ball()), made)
    _, scene, lines = exported()
    assert not lines
    density = scene.fields[0]["density"]
    shares = density[1:-1, 1:-1, 1:-1][density[1:-1, 1:-1, 1:-1] > 0.05]
    assert shares.std() > 0.0 and density.max() > 0.1


@pytest.mark.blender
def test_what_shines_alone_over_too_many_voxels_does_not_and_is_told(tmp_path):
    from unittest.mock import patch

    from clouds import attribute, ball, cloud, exported, filled, stored
    from recorder import empty, module

    empty()
    made, tree, shader = filled("Emission")
    product = tree.nodes.new("ShaderNodeMath")
    product.operation = "MULTIPLY"
    for name, socket in zip(("density", "heat"), product.inputs, strict=False):
        tree.links.new(attribute(tree, name), socket)
    tree.links.new(product.outputs[0], shader.inputs["Strength"])
    cloud(stored(tmp_path / "fire.vdb", density=ball(), heat=2.0 * ball()), made)
    _, scene, lines = exported()
    assert not lines and any(scene.materials[0]["medium"]["emission"])
    with patch.object(module("export.volumes.filling"), "MOST", 100):
        _, scene, lines = exported()
    assert len(lines) == 1 and "voxels" in lines[0], lines
    medium = scene.materials[0]["medium"]
    assert not any(medium["scattering"]) and not any(medium["absorption"]) and not any(medium["emission"])


@pytest.mark.blender
def test_a_missing_file_is_told(tmp_path):
    from clouds import cloud, exported
    from recorder import empty

    empty()
    cloud(tmp_path / "nowhere.vdb")
    _, scene, lines = exported()
    assert not scene.instances and len(lines) == 1 and "it is left out" in lines[0]


@pytest.mark.blender
def test_instances_are_placed_and_switched(tmp_path):
    import bpy
    import numpy as np
    from clouds import ball, cloud, exported, stored
    from recorder import empty, link

    empty()
    inner = bpy.data.collections.new("Clouds")
    thing = cloud(stored(tmp_path / "cloud.vdb", density=ball()))
    bpy.context.scene.collection.objects.unlink(thing)
    inner.objects.link(thing)
    thing.visible_camera, thing.is_holdout = False, True
    for x in (0.0, 5.0):
        bearer = link(bpy.data.objects.new("Bearer", None))
        bearer.instance_type, bearer.instance_collection, bearer.location = "COLLECTION", inner, (x, 0, 0)
    _, scene, lines = exported()
    assert len(scene.fields) == len(scene.instances) == 2 and not lines
    places = sorted(float(each["transforms"][0, 0, 3]) for each in scene.instances)
    assert places[1] - places[0] == pytest.approx(5.0)
    assert all(not each["visibility"]["camera"] and each["visibility"]["shadow"] for each in scene.instances)
    assert np.unique([each["materials"][0] for each in scene.instances]).size == 2
