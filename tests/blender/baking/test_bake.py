"""Blender's Bake operator with Gonio: against closed forms, pictures, and Cycles."""

from pathlib import Path

import pytest

EVERYTHING = {"use_pass_direct": True, "use_pass_indirect": True, "use_pass_color": True}


def image_of(thing, width: int, height: int):
    """A float image that is active in each of an object's materials."""
    import bpy

    image = bpy.data.images.new("Baked", width, height, float_buffer=True)
    for slot in thing.material_slots:
        node = slot.material.node_tree.nodes.new("ShaderNodeTexImage")
        node.image = image
        slot.material.node_tree.nodes.active = node
    return image


def choose(active, *others):
    import bpy

    bpy.ops.object.select_all(action="DESELECT")
    for thing in (active, *others):
        thing.select_set(True)
    bpy.context.view_layer.objects.active = active


def pixels(image):
    """(height, width, 4), rows from the bottom."""
    import numpy as np

    flat = np.empty(len(image.pixels), dtype=np.float32)
    image.pixels.foreach_get(flat)
    return flat.reshape(image.size[1], image.size[0], 4)


def bake(kind: str, engine: str = "GONIO", **keywords):
    import bpy

    bpy.context.scene.render.engine = engine
    assert bpy.ops.object.bake(type=kind, margin=0, **keywords) == {"FINISHED"}


@pytest.mark.blender
def test_texels_are_watts_and_lux_by_the_inverse_square_law(tmp_path: Path):
    import math

    import bpy
    import numpy as np
    import scenes

    scene = scenes.lit_floor(watts=100.0, samples=64)
    thing = bpy.data.objects["Floor"]
    thing.scale = (0.1, 0.1, 1.0)
    choose(thing)
    image = image_of(thing, 32, 24)
    across, up = np.meshgrid((np.arange(32) + 0.5) / 32 * 2.0 - 1.0, (np.arange(24) + 0.5) / 24 * 2.0 - 1.0)
    irradiance = 100.0 / (4.0 * math.pi) / (across**2 + up**2 + 1.0) ** 1.5
    for kind, keywords, expected in (
        ("COMBINED", {}, irradiance / math.pi),
        ("COMBINED", {"pass_filter": {"DIRECT", "DIFFUSE"}}, irradiance / math.pi),
        ("DIFFUSE", {"pass_filter": {"DIRECT"}}, irradiance / math.pi),
        ("DIFFUSE", {"pass_filter": {"COLOR"}}, np.ones_like(irradiance)),
        ("GLOSSY", {}, np.zeros_like(irradiance)),
        ("POSITION", {}, across),
    ):
        bake(kind, **keywords)
        found = pixels(image)
        # A texel is as bright as its middle but for what bends within it.
        apart = np.abs(found[..., 0] - expected) / max(np.abs(expected).max(), 1e-6)
        assert apart.max() < 0.01, (kind, keywords, apart.max(), found[12, 16], expected[12, 16])
        assert (found[..., 3] == 1.0).all()
    assert bpy.ops.gonio.bake_illuminance() == {"FINISHED"}
    assert np.allclose(pixels(image)[..., 0], scenes.LUMENS_PER_WATT * irradiance, rtol=0.01)
    # The next bake is Blender's own again.
    scene.gonio.bake_type = "EMIT"
    bake("EMIT")
    assert pixels(image)[..., :3].max() == 0.0


@pytest.mark.blender
def test_data_is_that_of_the_surface(tmp_path: Path):
    import bpy
    import numpy as np
    import scenes

    scenes.lit_floor()
    thing = bpy.data.objects["Floor"]
    choose(thing)
    material = thing.material_slots[0].material
    shader = material.node_tree.nodes.new("ShaderNodeBsdfPrincipled")
    shader.inputs["Roughness"].default_value = 0.3
    shader.inputs["Emission Color"].default_value = (0.2, 0.4, 0.8, 1.0)
    shader.inputs["Emission Strength"].default_value = 2.0
    output = next(node for node in material.node_tree.nodes if node.type == "OUTPUT_MATERIAL")
    material.node_tree.links.new(shader.outputs[0], output.inputs["Surface"])
    image = image_of(thing, 8, 8)
    for kind, keywords, expected in (
        ("NORMAL", {"normal_space": "TANGENT"}, (0.5, 0.5, 1.0)),
        ("NORMAL", {"normal_space": "OBJECT"}, (0.5, 0.5, 1.0)),
        ("ROUGHNESS", {}, (0.3, 0.3, 0.3)),
        ("EMIT", {}, (0.4, 0.8, 1.6)),
        ("AO", {}, (1.0, 1.0, 1.0)),
    ):
        bake(kind, **keywords)
        assert np.allclose(pixels(image)[..., :3], expected, atol=2e-4), (kind, pixels(image)[4, 4])
    bake("UV")
    middle = (np.arange(8) + 0.5) / 8
    assert np.allclose(pixels(image)[..., 0], middle[None, :], atol=2e-3) and np.allclose(pixels(image)[..., 1], middle[:, None], atol=2e-3)
    # Stand-ins for materials are gone after their bake.
    bake("EMIT")
    assert np.allclose(pixels(image)[..., :3], (0.4, 0.8, 1.6), atol=1e-4)


def corner(scene):
    """A floor and a wall of other colours under a lamp."""
    import bpy
    import scenes

    bpy.ops.mesh.primitive_plane_add(size=2.0)
    floor = bpy.context.object
    floor.data.materials.append(scenes.diffuse("Floor", (0.8, 0.6, 0.4)))
    bpy.ops.mesh.primitive_plane_add(size=2.0, location=(1.0, 0.0, 1.0), rotation=(0.0, -1.5707963, 0.0))
    bpy.context.object.data.materials.append(scenes.diffuse("Wall", (0.2, 0.7, 0.9)))
    bpy.ops.object.light_add(type="POINT", location=(-0.3, 0.2, 1.5))
    bpy.context.object.data.energy, bpy.context.object.data.shadow_soft_size = 100.0, 0.1
    choose(floor)
    return floor


@pytest.mark.blender
def test_the_environment_is_that_of_cycles(tmp_path: Path):
    import bpy
    import numpy as np
    import scenes

    scene = scenes.empty(samples=16)
    tree = scene.world.node_tree
    place, half = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeVectorMath")
    half.operation = "MULTIPLY_ADD"
    half.inputs[1].default_value = half.inputs[2].default_value = (0.5, 0.5, 0.5)
    tree.links.new(place.outputs["Generated"], half.inputs[0])
    tree.links.new(half.outputs[0], tree.nodes["Background"].inputs["Color"])
    bpy.ops.mesh.primitive_plane_add(size=2.0, location=(0.4, -0.7, 0.8))
    thing = bpy.context.object
    thing.data.materials.append(scenes.diffuse("White", (1, 1, 1)))
    choose(thing)
    image = image_of(thing, 8, 8)
    bake("ENVIRONMENT")
    found = pixels(image)[..., :3].copy()
    middle = (np.arange(8) + 0.5) / 4.0 - 1.0
    towards = np.stack([*np.meshgrid(middle + 0.4, middle - 0.7), np.full((8, 8), 0.8)], axis=-1)
    expected = 0.5 * towards / np.linalg.norm(towards, axis=-1, keepdims=True) + 0.5
    assert np.allclose(found, expected, atol=5e-3), np.abs(found - expected).max()
    if hasattr(scene, "cycles"):
        scene.cycles.samples, scene.cycles.use_denoising = 64, False
        bake("ENVIRONMENT", engine="CYCLES")
        # Cycles' jitter reaches into the neighbours.
        assert np.allclose(found, pixels(image)[..., :3], atol=0.08), np.abs(found - pixels(image)[..., :3]).max()


@pytest.mark.blender
@pytest.mark.parametrize("kind", ["COMBINED", "DIFFUSE", "AO"])
def test_bakes_are_those_of_cycles(kind, tmp_path: Path):
    import unittest

    import numpy as np
    import scenes

    scene = scenes.empty(samples=256)
    if not hasattr(scene, "cycles"):
        raise unittest.SkipTest("this bpy has no Cycles")
    floor = corner(scene)
    image = image_of(floor, 16, 16)
    bake(kind)
    found = pixels(image)[..., :3].copy()
    scene.cycles.samples, scene.cycles.use_denoising = 512, False
    bake(kind, engine="CYCLES")
    expected = pixels(image)[..., :3]
    # Whole parts of the texture: Cycles jitters texels its own way.
    means = [each.reshape(4, 4, 4, 4, 3).mean(axis=(1, 3)) for each in (found, expected)]
    assert np.allclose(*means, rtol=0.03, atol=1e-3), np.abs(means[0] / means[1] - 1.0).max()
    assert np.isclose(found.mean(), expected.mean(), rtol=0.01), (found.mean(), expected.mean())


@pytest.mark.blender
def test_vertex_colours_and_other_objects(tmp_path: Path):
    import bpy
    import numpy as np
    import scenes

    scene = scenes.lit_floor()
    floor = bpy.data.objects["Floor"]
    floor.scale = (0.1, 0.1, 1.0)
    choose(floor)
    attribute = floor.data.color_attributes.new("Baked", "FLOAT_COLOR", "CORNER")
    floor.data.color_attributes.active_color = attribute
    bake("COMBINED", target="VERTEX_COLORS")
    found = np.array([corner.color[:] for corner in floor.data.color_attributes["Baked"].data])
    expected = scenes.expected_irradiance(100.0) / 3.0**1.5 / np.pi
    assert np.allclose(found[:, :3], expected, rtol=0.02), (found, expected)
    # What shines just above the floor, baked into the floor's texture.
    bpy.ops.mesh.primitive_plane_add(size=1.0, location=(0.0, 0.0, 0.05))
    other = bpy.context.object
    shining = bpy.data.materials.new("Shining")
    shining.use_nodes = True
    shader = shining.node_tree.nodes.new("ShaderNodeEmission")
    shader.inputs["Color"].default_value = (0.25, 0.5, 0.75, 1.0)
    node = next(node for node in shining.node_tree.nodes if node.type == "OUTPUT_MATERIAL")
    shining.node_tree.links.new(shader.outputs[0], node.inputs["Surface"])
    other.data.materials.append(shining)
    image = image_of(floor, 16, 16)
    choose(floor, other)
    bake("EMIT", use_selected_to_active=True, cage_extrusion=0.1, max_ray_distance=0.5)
    inner = pixels(image)[5:11, 5:11, :3]
    assert np.allclose(inner, (0.25, 0.5, 0.75), atol=1e-4), inner
    assert scene.render.engine == "GONIO"


@pytest.mark.blender
def test_what_cannot_be_baked_is_told(tmp_path: Path):
    import bpy
    import scenes

    scenes.lit_floor()
    floor = bpy.data.objects["Floor"]
    choose(floor)
    image_of(floor, 4, 4)
    with pytest.raises(RuntimeError, match="nothing to bake"):
        bpy.ops.object.bake(type="SHADOW")


@pytest.mark.blender
@pytest.mark.parametrize("joined", [False, True])
def test_a_box_is_dark_where_it_stands_on_a_floor(joined, tmp_path: Path):
    import unittest

    import bpy
    import numpy as np
    import scenes

    scene = scenes.empty(samples=64)
    if not hasattr(scene, "cycles"):
        raise unittest.SkipTest("this bpy has no Cycles")
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    bpy.ops.mesh.primitive_plane_add(size=6.0)
    floor = bpy.context.object
    floor.data.materials.append(scenes.diffuse("Floor", (0.35, 0.35, 0.35)))
    bpy.ops.mesh.primitive_cube_add(size=1.2, location=(-1.0, 0.0, 0.6))
    box = bpy.context.object
    box.data.materials.append(scenes.diffuse("Box", (0.7, 0.5, 0.3)))
    if joined:
        # Its coordinates lie beside the texture.
        for corner in floor.data.uv_layers.active.uv:
            corner.vector.x += 2.0
        choose(box, floor)
        bpy.ops.object.join()
    choose(box)
    image = image_of(box, 64, 64)
    scene.cycles.samples, scene.cycles.use_denoising = 64, False
    for kind in ("AO", "COMBINED"):
        bake(kind)
        found = pixels(image)[..., :3].copy()
        bake(kind, engine="CYCLES")
        expected = pixels(image)[..., :3].copy()
        means = [each.reshape(8, 8, 8, 8, 3).mean(axis=(1, 3)) for each in (found, expected)]
        # Blocks that lie within the underside.
        dark = means[1].max(axis=-1) < 1e-6
        assert dark.sum() >= 2 and means[0][dark].max() < 1e-6, (kind, dark.sum(), means[0][dark].max())
        assert np.isclose(found.mean(), expected.mean(), rtol=0.01), (kind, found.mean(), expected.mean())


@pytest.mark.blender
def test_denoised_bakes_have_less_noise_or_say_why_not(tmp_path: Path):
    import importlib.util

    import bpy
    import numpy as np
    import scenes

    scene = scenes.lit_floor(watts=100.0, samples=4)
    floor = bpy.data.objects["Floor"]
    floor.scale = (0.1, 0.1, 1.0)
    bpy.ops.mesh.primitive_cube_add(size=0.5, location=(0.0, 0.0, 0.6))
    choose(floor)
    image = image_of(floor, 32, 32)
    scene.gonio.use_denoising = False
    bake("COMBINED")
    noisy = pixels(image).copy()
    scene.gonio.use_denoising = True
    bake("COMBINED")
    quiet = pixels(image)
    lines = [line.text for line in importlib.import_module("gonio_extension.report").latest().diagnostics]
    if importlib.util.find_spec("pyoidn") is None:
        assert sum("Denoising of bakes" in line for line in lines) == 1 and np.array_equal(noisy, quiet)
    else:
        assert not lines and not np.array_equal(noisy, quiet)
