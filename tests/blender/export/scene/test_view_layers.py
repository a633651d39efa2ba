"""What view layers leave out and replace, subsets of samples, transparent glass, and Take Settings from Cycles."""

import importlib
from pathlib import Path

import pytest


def picture(path, layer="ViewLayer"):
    """RGBA of a layer's Combined pass."""
    import numpy as np
    import scenes

    scenes.render(path)
    channels = scenes.read(path)
    return np.stack([channels[f"{layer}.Combined.{channel}"] for channel in "RGBA"], axis=-1)


@pytest.mark.blender
def test_filters_leave_out_the_world_and_surfaces(tmp_path: Path):
    import bpy
    import numpy as np
    import scenes

    scene = scenes.lit_floor(samples=16, width=16, height=16)
    scene.camera.data.ortho_scale = 40.0
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.2, 0.4, 0.8, 1.0)
    layer = bpy.context.view_layer
    whole = picture(tmp_path / "whole.exr")
    assert np.allclose(whole[0, 0], (0.2, 0.4, 0.8, 1.0), atol=1e-3) and whole[8, 8, 0] > 0.2
    for engine in ("GONIO", "CYCLES") if hasattr(scene, "cycles") else ("GONIO",):
        scene.render.engine = engine
        layer.use_sky, layer.use_solid = False, True
        without_world = picture(tmp_path / f"{engine}sky.exr")
        assert np.allclose(without_world[0, 0], (0.0, 0.0, 0.0, 1.0)), (engine, without_world[0, 0])
        assert without_world[8, 8, 0] > 0.2, engine
        layer.use_sky, layer.use_solid = True, False
        without_floor = picture(tmp_path / f"{engine}solid.exr")
        assert np.allclose(without_floor[8, 8], (0.2, 0.4, 0.8, 1.0), atol=5e-3), (engine, without_floor[8, 8])


@pytest.mark.blender
def test_overrides_and_samples_are_those_of_the_layer(tmp_path: Path):
    import bpy
    import numpy as np
    import scenes

    scene = scenes.lit_floor(samples=16, width=8, height=8)
    scene.view_layers.new("Other")
    other = scene.view_layers["Other"]
    other.material_override = scenes.diffuse("Half", (0.5, 0.25, 0.125))
    other.samples = 4
    grey = bpy.data.worlds.new("Grey")
    grey.use_nodes = True
    grey.node_tree.nodes["Background"].inputs["Color"].default_value = (0.4, 0.4, 0.4, 1.0)
    has_override = hasattr(other, "world_override")
    if has_override:
        other.world_override = grey
    scenes.render(tmp_path / "a.exr")
    channels = scenes.read(tmp_path / "a.exr")
    plain, replaced = (channels[f"{layer}.Combined.G"].mean() for layer in ("ViewLayer", "Other"))
    # An even world of the radiance L lights a surface by π L.
    assert np.isclose(replaced, 0.25 * (plain + 0.4 * has_override), rtol=5e-3), (replaced, plain)


@pytest.mark.blender
def test_collections_that_are_indirect_only_or_cut_holes(tmp_path: Path):
    import bpy
    import numpy as np
    import scenes

    scene = scenes.lit_floor(samples=16, width=8, height=8)
    scene.camera.data.ortho_scale = 0.1
    made = bpy.data.collections.new("Made")
    scene.collection.children.link(made)
    bpy.ops.mesh.primitive_plane_add(size=0.4, location=(0.0, 0.0, 3.0))
    thing = bpy.context.object
    for collection in thing.users_collection:
        collection.objects.unlink(thing)
    made.objects.link(thing)
    layer = bpy.context.view_layer.layer_collection.children["Made"]
    scene.render.film_transparent = True
    assert picture(tmp_path / "a.exr")[4, 4, 0] < 0.01
    layer.indirect_only = True
    assert picture(tmp_path / "b.exr")[4, 4, 0] > 0.2
    layer.indirect_only, layer.holdout = False, True
    assert np.allclose(picture(tmp_path / "c.exr")[4, 4], 0.0)


@pytest.mark.blender
def test_subsets_of_samples_make_up_the_whole(tmp_path: Path):
    import numpy as np
    import scenes

    scene = scenes.lit_floor(samples=64, width=8, height=8)
    import bpy

    bpy.data.objects["Lamp"].data.shadow_soft_size = 0.5
    scene.gonio.use_adaptive_sampling = False
    whole = picture(tmp_path / "whole.exr")
    scene.gonio.use_sample_subset = True
    parts = []
    # Ends are moved to where blocks of samples end: 0, 32, 64.
    for offset, length in ((0, 30), (30, 100)):
        scene.gonio.sample_offset, scene.gonio.sample_subset_length = offset, length
        parts.append(picture(tmp_path / f"{offset}.exr"))
    assert not np.allclose(parts[0], whole, rtol=1e-5) and np.allclose(0.5 * (parts[0] + parts[1]), whole, rtol=1e-5)
    subset = importlib.import_module("gonio_extension.export.settings")._subset
    asked = lambda first, length: lambda name, usual: {"sample_offset": first, "sample_subset_length": length}[name]  # noqa: E731
    found = [
        subset(asked(*case), samples) for *case, samples in ((0, 64, 64), (3, 2, 64), (70, 5, 64), (0, 2, 8), (16, 16, 40), (32, 99, 40))
    ]
    assert found == [None, (0, 16), (48, 64), None, (16, 32), (32, 40)], found


@pytest.mark.blender
def test_glass_before_a_transparent_film(tmp_path: Path):
    import bpy
    import scenes

    scene = scenes.empty(samples=256, width=8, height=8)
    bpy.ops.mesh.primitive_cube_add(size=2.0, scale=(5.0, 5.0, 0.1))
    glass = bpy.data.materials.new("Glass")
    glass.use_nodes = True
    shader = glass.node_tree.nodes.new("ShaderNodeBsdfGlass")
    shader.inputs["Roughness"].default_value = 0.0
    output = next(node for node in glass.node_tree.nodes if node.type == "OUTPUT_MATERIAL")
    glass.node_tree.links.new(shader.outputs[0], output.inputs["Surface"])
    bpy.context.object.data.materials.append(glass)
    bpy.ops.object.camera_add(location=(0, 0, 5))
    scene.camera = bpy.context.object
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 0.1
    scene.render.film_transparent = True
    alphas = {}
    for engine in ("GONIO", "CYCLES") if hasattr(scene, "cycles") else ("GONIO",):
        scene.render.engine = engine
        if engine == "CYCLES":
            scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.film_transparent_glass = 256, False, True
        scene.gonio.film_transparent_glass = True
        alphas[engine] = float(picture(tmp_path / f"{engine}.exr")[..., 3].mean())
    assert alphas["GONIO"] == pytest.approx(0.077, abs=0.01)
    assert alphas.get("CYCLES", alphas["GONIO"]) == pytest.approx(alphas["GONIO"], abs=0.01), alphas
    scene.render.engine, scene.gonio.film_transparent_glass = "GONIO", False
    assert picture(tmp_path / "opaque.exr")[..., 3].min() == 1.0


@pytest.mark.blender
def test_rough_and_tinted_glass_is_clear_to_the_film_as_in_cycles(tmp_path: Path):
    import unittest

    import bpy
    import numpy as np
    import scenes

    scene = scenes.empty(samples=256, width=16, height=8)
    if not hasattr(scene, "cycles"):
        raise unittest.SkipTest("this bpy has no Cycles")
    # Left of the middle below the limit of roughness, right of it above.
    for name, x, roughness in (("Smooth", -5.0, 0.15), ("Rough", 5.0, 0.4)):
        bpy.ops.mesh.primitive_cube_add(size=2.0, location=(x, 0, 0), scale=(5.0, 5.0, 0.1))
        glass = bpy.data.materials.new(name)
        glass.use_nodes = True
        inputs = next(node for node in glass.node_tree.nodes if node.type == "BSDF_PRINCIPLED").inputs
        inputs["Base Color"].default_value = (0.5, 0.8, 0.9, 1.0)
        inputs["Transmission Weight"].default_value, inputs["Roughness"].default_value = 1.0, roughness
        bpy.context.object.data.materials.append(glass)
    bpy.ops.object.camera_add(location=(0, 0, 5))
    scene.camera = bpy.context.object
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 4.0
    scene.render.film_transparent = True
    settings = scene.cycles
    settings.samples, settings.use_denoising, settings.use_adaptive_sampling = 256, False, False
    settings.film_transparent_glass, settings.film_transparent_roughness = True, 0.2
    scene.render.engine = "CYCLES"
    theirs = picture(tmp_path / "cycles.exr")[..., 3]
    # As the file is: nothing was set here, so Cycles' settings count, and the panel shows them.
    scene.render.engine = "GONIO"
    scene.gonio.samples = 256
    assert scene.gonio.shown_transparent_glass and abs(scene.gonio.shown_transparent_roughness - 0.2) < 1e-6
    mine = picture(tmp_path / "gonio.exr")[..., 3]
    sides = [[float(alpha[:, columns].mean()) for columns in (slice(0, 7), slice(9, 16))] for alpha in (mine, theirs)]
    assert np.allclose(*sides, atol=0.02) and sides[0][0] < 0.6 and sides[0][1] > 0.99, sides
    assert bpy.ops.gonio.settings_from_cycles() == {"FINISHED"}
    assert abs(picture(tmp_path / "taken.exr")[..., 3].mean() - mine.mean()) < 0.02
    scene.gonio.shown_transparent_glass = False
    assert not scene.gonio.film_transparent_glass and picture(tmp_path / "opaque.exr")[..., 3].min() == 1.0


@pytest.mark.blender
def test_what_is_not_carried_over_from_cycles_is_said(tmp_path: Path):
    import unittest

    import bpy
    import scenes

    scene = scenes.lit_floor()
    if not hasattr(scene, "cycles"):
        raise unittest.SkipTest("this bpy has no Cycles")
    scene.cycles.caustics_reflective, scene.cycles.blur_glossy, scene.cycles.use_fast_gi = False, 3.0, True
    assert bpy.ops.gonio.settings_from_cycles() == {"FINISHED"}
    assert not scene.gonio.caustics_reflective
    lines = importlib.import_module("gonio_extension.report").latest().diagnostics
    names = {line.message.partition(":")[0] for line in lines}
    assert {"Fast GI Approximation", "Filter Glossy other than 1"} <= names, names
