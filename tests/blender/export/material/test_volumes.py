"""Even volumes of materials and worlds beside Cycles: each shader node, overlaps, cameras inside, lamps in haze."""

import pytest


def fog(name, node, **inputs):
    """A material that is a volume alone."""
    from recorder import material

    made, tree, end = material(name)
    tree.links.new(filled(tree, node, **inputs).outputs[0], end.inputs["Volume"])
    return made


def filled(tree, node, **inputs):
    shader = tree.nodes.new(f"ShaderNode{node}")
    for key, value in inputs.items():
        if key == "phase":
            shader.phase = value
        else:
            shader.inputs[key].default_value = value
    return shader


def cube(material, location, scale):
    import bpy

    bpy.ops.mesh.primitive_cube_add(size=1, location=location, scale=scale)
    bpy.context.object.data.materials.append(material)


def floor():
    import bpy
    from recorder import material

    made, tree, end = material("Floor")
    tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], end.inputs["Surface"])
    bpy.ops.mesh.primitive_plane_add(size=12, location=(0, 0, -1))
    bpy.context.object.data.materials.append(made)


def lamp(location, energy=500.0, radius=0.3):
    import bpy
    from recorder import link

    data = bpy.data.lights.new("Lamp", "POINT")
    data.energy, data.shadow_soft_size = energy, radius
    link(bpy.data.objects.new("Lamp", data)).location = location


def look(samples=256, bounces=3):
    import bpy
    from beside_cycles import scene

    made = scene(32, 32, scale=6.0, samples=samples)
    made.cycles.volume_bounces = bounces
    made.cycles.use_adaptive_sampling = False
    # Marching by short steps: null scattering draws one order of its series for a whole picture, whose mean so wavers by a percent.
    if bpy.app.version >= (5, 0, 0):
        made.cycles.volume_biased = True
    made.cycles.volume_step_rate = 0.1
    return made


def alike(path, lines=(), mean=0.015, block=0.06):
    """The means of both pictures, and of blocks of 8 by 8 pixels."""
    import numpy as np
    from beside_cycles import both

    cycles, gonio = both(path, lines=lines)
    blocks = [picture.reshape(4, 8, 4, 8, 3).mean((1, 3)) for picture in (cycles, gonio)]
    assert blocks[0].max() > 0.0 and np.isfinite(gonio).all()
    assert gonio.mean((0, 1)) == pytest.approx(cycles.mean((0, 1)), rel=mean), (cycles.mean((0, 1)), gonio.mean((0, 1)))
    apart = np.abs(blocks[1] - blocks[0]) / np.maximum(blocks[0], 0.05 * blocks[0].mean())
    assert np.quantile(apart, 0.95) < block, apart.max(-1).round(3)


NODES = {
    "scatter": ("VolumeScatter", {"Color": (0.8, 0.6, 0.3, 1.0), "Density": 0.6, "Anisotropy": 0.4}),
    "absorption": ("VolumeAbsorption", {"Color": (0.8, 0.6, 0.3, 1.0), "Density": 0.6}),
    "principled": ("VolumePrincipled", {"Color": (0.5, 0.7, 0.9, 1.0), "Density": 0.5, "Absorption Color": (0.2, 0.1, 0.4, 1.0)}),
    "emission": ("VolumePrincipled", {"Density": 0.3, "Emission Strength": 0.5, "Emission Color": (1.0, 0.5, 0.1, 1.0)}),
    "blackbody": ("VolumePrincipled", {"Density": 0.2, "Blackbody Intensity": 1.0, "Temperature": 1200.0}),
    "coefficients": ("VolumeCoefficients", {"Absorption Coefficients": (0.1, 0.3, 0.5), "Scatter Coefficients": (0.5, 0.2, 0.4)}),
    "rayleigh": ("VolumeScatter", {"phase": "RAYLEIGH", "Color": (0.8, 0.6, 0.3, 1.0), "Density": 0.6}),
    "draine": ("VolumeScatter", {"phase": "DRAINE", "Color": (0.8, 0.6, 0.3, 1.0), "Density": 0.6, "Anisotropy": 0.5, "Alpha": 2.0}),
    "ocean": ("VolumeCoefficients", {"phase": "FOURNIER_FORAND", "Scatter Coefficients": (0.5, 0.2, 0.4), "IOR": 1.2, "Backscatter": 0.1}),
    "mie": ("VolumeScatter", {"phase": "MIE", "Color": (0.8, 0.6, 0.3, 1.0), "Density": 0.6, "Diameter": 8.0}),
    "shining": ("Emission", {"Color": (0.2, 0.4, 1.0, 1.0), "Strength": 0.3}),
}


@pytest.mark.blender
@pytest.mark.parametrize("kind", NODES)
def test_each_shader_in_a_box(kind, tmp_path):
    look()
    node, inputs = NODES[kind]
    cube(fog("Fog", node, **inputs), (0, 0, 0.2), (4, 4, 2))
    floor()
    lamp((1.2, 0.6, 2.5))
    # Cycles leaves the blue of fire below zero, which the Blackbody node holds at zero. What scatters straight on above all has bright samples in
    # dark blocks.
    alike(tmp_path, mean=0.02 if kind == "blackbody" else 0.015, block=0.25 if kind == "ocean" else 0.06)


@pytest.mark.blender
def test_overlapping_volumes_of_different_anisotropy(tmp_path):
    look()
    # Cycles weighs phase functions by the mean of their colours, where each colour has weights of its own: grey ones are alike.
    cube(fog("Forwards", "VolumeScatter", Color=(0.9, 0.9, 0.9, 1.0), Density=0.7, Anisotropy=0.7), (-0.6, 0, 0.2), (3, 3, 2))
    cube(fog("Back", "VolumeScatter", Color=(0.5, 0.5, 0.5, 1.0), Density=0.7, Anisotropy=-0.5), (0.9, 0.3, 0.4), (2.5, 3.3, 1.5))
    floor()
    lamp((0.3, 0.2, 2.4))
    alike(tmp_path)


@pytest.mark.blender
def test_a_lamp_and_a_camera_within(tmp_path):
    made = look()
    made.camera.location.z = 1.1
    made.camera.data.clip_start = 1e-3
    cube(fog("Fog", "VolumeScatter", Color=(0.8, 0.8, 0.8, 1.0), Density=0.4, Anisotropy=0.3), (0, 0, 0.6), (9, 9, 3))
    floor()
    lamp((1.0, -0.8, 0.4))
    alike(tmp_path)


@pytest.mark.blender
def test_haze_of_the_world_about_a_spot(tmp_path):
    import bpy
    from recorder import link

    made = look(samples=1024)
    tree = made.world.node_tree
    shader = filled(tree, "VolumeScatter", Color=(0.9, 0.9, 0.9, 1.0), Density=0.15, Anisotropy=0.5)
    tree.links.new(shader.outputs[0], next(node for node in tree.nodes if node.type == "OUTPUT_WORLD").inputs["Volume"])
    floor()
    data = bpy.data.lights.new("Spot", "SPOT")
    data.energy, data.spot_size, data.spot_blend, data.shadow_soft_size = 3000.0, 0.6, 0.2, 0.05
    spot = link(bpy.data.objects.new("Spot", data))
    spot.location, spot.rotation_euler = (2.5, 0, 2.0), (0, 0.9, 0)
    alike(tmp_path, block=0.08)


@pytest.mark.blender
def test_phases_and_what_is_no_volume_are_told(tmp_path):
    from recorder import empty, material, translated

    empty()
    made = fog("Rain", "VolumeScatter", phase="MIE", Diameter=20.0)
    description, lines = translated(made)
    assert description["medium"]["phase"] == {"Mie": {"diameter": 20.0}} and not lines
    made = fog("Sea", "VolumeScatter", phase="FOURNIER_FORAND", IOR=1.33, Backscatter=0.1)
    assert translated(made)[0]["medium"]["phase"] == {"FournierForand": {"ior": pytest.approx(1.33), "backscatter": pytest.approx(0.1)}}
    made = fog("Dust", "VolumeScatter", phase="DRAINE", Anisotropy=0.5, Alpha=0.5)
    dust = translated(made)[0]["medium"]
    assert dust["anisotropy"] == 0.5 and dust["phase"] == {"Draine": {"alpha": 0.5}}
    # Several together are told: they scatter by the mean of their mean cosines, 0.54 of the dust and 0 of the air.
    made, tree, end = material("Dusty air")
    both = tree.nodes.new("ShaderNodeAddShader")
    parts = [filled(tree, "VolumeScatter", phase="DRAINE", Anisotropy=0.5, Alpha=0.5), filled(tree, "VolumeScatter", phase="RAYLEIGH")]
    for part, socket in zip(parts, both.inputs, strict=True):
        tree.links.new(part.outputs[0], socket)
    tree.links.new(both.outputs[0], end.inputs["Volume"])
    description, lines = translated(made)
    assert "phase" not in description["medium"] and description["medium"]["anisotropy"] == pytest.approx(0.27, abs=1e-3)
    assert len(lines) == 1 and "Henyey" in lines[0]
    made, tree, end = material("Cloud")
    tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], end.inputs["Volume"])
    description, lines = translated(made)
    assert "medium" not in description and len(lines) == 1 and "the inside stays empty" in lines[0]
