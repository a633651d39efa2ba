"""Final renders through Blender's own operator, read back from the files that it writes."""

import importlib
from pathlib import Path

import pytest


def part(name):
    """A module of the extension."""
    return importlib.import_module(f"gonio_extension.{name}")


@pytest.mark.blender
def test_values_are_watts_candelas_and_lux(tmp_path: Path):
    import math

    import scenes

    scene = scenes.lit_floor(watts=100.0)
    layer = scene.view_layers[0]
    layer.gonio.use_pass_luminance = layer.gonio.use_pass_illuminance = True
    scenes.render(tmp_path / "a.exr")
    channels = scenes.read(tmp_path / "a.exr")
    irradiance = scenes.expected_irradiance(100.0)
    for channel, expected in (
        ("Combined.R", irradiance / math.pi),
        ("Luminance.X", scenes.LUMENS_PER_WATT * irradiance / math.pi),
        ("Illuminance.X", scenes.LUMENS_PER_WATT * irradiance),
    ):
        found = float(channels[f"ViewLayer.{channel}"].mean())
        assert math.isclose(found, expected, rel_tol=5e-3), (channel, found, expected)
    assert channels["ViewLayer.Combined.A"].min() == 1.0
    scene.gonio.film_exposure = 2.0
    scenes.render(tmp_path / "b.exr")
    brighter = scenes.read(tmp_path / "b.exr")
    assert math.isclose(brighter["ViewLayer.Combined.R"].mean(), 2.0 * channels["ViewLayer.Combined.R"].mean(), rel_tol=1e-5)
    assert math.isclose(brighter["ViewLayer.Luminance.X"].mean(), channels["ViewLayer.Luminance.X"].mean(), rel_tol=1e-5)
    assert brighter["ViewLayer.Combined.A"].max() == 1.0


@pytest.mark.blender
def test_all_passes_are_in_the_file(tmp_path: Path):
    import math

    import scenes

    scene = scenes.lit_floor()
    scene.gonio.max_bounces = 4
    layer = scene.view_layers[0]
    for name in layer.bl_rna.properties.keys():
        if name.startswith("use_pass_") and not any(
            word in name for word in ("accurate", "grease", "subsurface", "shadow", "vector")
        ):
            setattr(layer, name, True)
    for name in layer.gonio.bl_rna.properties.keys():
        if name not in ("rna_type", "name"):
            setattr(layer.gonio, name, True)
    scenes.render(tmp_path / "a.exr")
    channels = scenes.read(tmp_path / "a.exr")
    wanted = list(part("session.passes").enabled_passes(layer))
    # Three mattes of three layers each, and ambient occlusion.
    assert len(wanted) == 37, [kind.name for kind in wanted]
    for kind in wanted:
        for channel in kind.channels:
            assert f"ViewLayer.{kind.name}.{channel}" in channels, kind.name
    value = lambda name: float(channels[f"ViewLayer.{name}"].mean())  # noqa: E731
    long = part("compat").pass_name
    assert math.isclose(value("Depth.Z"), 5.0, rel_tol=1e-4)
    assert math.isclose(value("Normal.Z"), 1.0, rel_tol=1e-4)
    assert abs(value("Position.Z")) < 1e-4
    assert math.isclose(value(f"{long('Diffuse Color')}.R"), 1.0, rel_tol=1e-3)
    together = value(f"{long('Diffuse Direct')}.R") + value(f"{long('Diffuse Indirect')}.R")
    assert math.isclose(together, value("Combined.R"), rel_tol=1e-2)


@pytest.mark.blender
def test_border_and_crop_show_the_same_pixels(tmp_path: Path):
    import numpy
    import scenes

    scene = scenes.lit_floor(width=80, height=60, samples=16)
    scene.camera.data.ortho_scale = 4.0
    scenes.render(tmp_path / "whole.exr")
    whole = scenes.read(tmp_path / "whole.exr")["ViewLayer.Combined.R"]
    render = scene.render
    render.use_border = True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.25, 0.75, 0.5, 0.9
    scenes.render(tmp_path / "border.exr")
    border = scenes.read(tmp_path / "border.exr")["ViewLayer.Combined.R"]
    render.use_crop_to_border = True
    scenes.render(tmp_path / "crop.exr")
    crop = scenes.read(tmp_path / "crop.exr")["ViewLayer.Combined.R"]
    assert border.shape == whole.shape and crop.shape == (24, 40)
    inside = (slice(6, 30), slice(20, 60))
    assert numpy.allclose(border[inside], crop)
    assert numpy.abs(crop - whole[inside]).mean() < 0.05 * whole.mean()
    border[inside] = 0.0
    assert border.max() == 0.0


@pytest.mark.blender
def test_view_layers_and_overrides(tmp_path: Path):
    import math

    import bpy
    import scenes

    scene = scenes.lit_floor()
    second = scene.view_layers.new("Dark")
    second.material_override = scenes.diffuse("Half", (0.5, 0.5, 0.5))
    second.samples = 8
    scenes.render(tmp_path / "a.exr")
    channels = scenes.read(tmp_path / "a.exr")
    first = channels["ViewLayer.Combined.R"].mean()
    assert math.isclose(channels["Dark.Combined.R"].mean(), 0.5 * first, rel_tol=2e-2)
    second.material_override = None
    world = bpy.data.worlds.new("Glow")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    second.world_override = world
    scenes.render(tmp_path / "b.exr")
    channels = scenes.read(tmp_path / "b.exr")
    assert math.isclose(channels["ViewLayer.Combined.R"].mean(), first, rel_tol=2e-2)
    assert channels["Dark.Combined.R"].mean() > first + 0.5


@pytest.mark.blender
def test_an_animation_is_the_same_with_persistent_data(tmp_path: Path):
    import bpy
    import numpy
    import scenes

    scene = scenes.lit_floor(samples=4, width=32, height=32)
    lamp = bpy.data.objects["Lamp"]
    lamp.keyframe_insert("location", frame=1)
    lamp.location.z = 3.0
    lamp.keyframe_insert("location", frame=3)
    scene.frame_start, scene.frame_end = 1, 3
    pictures = {}
    for persistent in (False, True):
        scene.render.use_persistent_data = persistent
        scenes.render(tmp_path / f"{persistent}_", animation=True)
        pictures[persistent] = [scenes.read(tmp_path / f"{persistent}_{frame:04d}.exr")["ViewLayer.Combined.R"] for frame in (1, 2, 3)]
    means = [picture.mean() for picture in pictures[True]]
    assert means[0] > 2.0 * means[1] > 2.0 * means[2]
    for kept, fresh in zip(pictures[True], pictures[False], strict=True):
        assert numpy.array_equal(kept, fresh)


@pytest.mark.blender
def test_a_failure_is_a_message(tmp_path: Path):
    import unittest

    import scenes

    scenes.lit_floor(samples=1, width=16, height=16)
    exporter = part("session.final").Exporter
    check = unittest.TestCase()
    for name in ("sync", "settings"):
        true = getattr(exporter, name)
        setattr(exporter, name, lambda *_, **__: (_ for _ in ()).throw(ValueError("the cat sat on it")))
        try:
            with check.assertRaisesRegex(RuntimeError, "the cat sat on it"):
                scenes.render(tmp_path / "a.exr")
        finally:
            setattr(exporter, name, true)
        scenes.render(tmp_path / "a.exr")


@pytest.mark.blender
def test_film_transparent(tmp_path: Path):
    import bpy
    import scenes

    scene = scenes.lit_floor(samples=4)
    bpy.data.objects.remove(bpy.data.objects["Floor"])
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    scenes.render(tmp_path / "a.exr")
    assert scenes.read(tmp_path / "a.exr")["ViewLayer.Combined.A"].min() == 1.0
    scene.render.film_transparent = True
    scenes.render(tmp_path / "b.exr")
    channels = scenes.read(tmp_path / "b.exr")
    assert channels["ViewLayer.Combined.A"].max() == 0.0 and channels["ViewLayer.Combined.R"].max() == 0.0


@pytest.mark.blender
def test_the_denoise_node_denoises(tmp_path: Path):
    import bpy
    import numpy
    import scenes

    scene = scenes.lit_floor(samples=2, width=96, height=96)
    bpy.data.objects["Lamp"].data.shadow_soft_size = 0.8
    bpy.data.objects["Lamp"].location.z = 0.9
    scene.camera.data.ortho_scale = 1.0
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    noise = []
    for name in ("noisy", "quiet"):
        scene.render.filepath = str(tmp_path / f"{name}.exr")
        assert bpy.ops.render.render(write_still=True) == {"FINISHED"}
        picture = next(values for channel, values in scenes.read(tmp_path / f"{name}.exr").items() if channel.endswith("R"))
        noise.append(numpy.abs(numpy.diff(picture, axis=1)).mean() / picture.mean())
        scene.gonio.use_denoising = True
    assert noise[1] < 0.3 * noise[0], noise


@pytest.mark.blender
def test_previews_of_materials_lights_and_worlds():
    import bpy
    import scenes

    scenes.empty()
    red = scenes.diffuse("Red", (0.9, 0.05, 0.05))
    world = bpy.context.scene.world
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.2, 0.4, 1.0, 1.0)
    lamp = bpy.data.lights.new("Lamp", "POINT")
    for block in (red, world, lamp):
        block.asset_mark()
        block.asset_generate_preview()
        width, height = block.preview.image_size
        assert width >= 64 and height >= 64, block
    values = list(red.preview.image_pixels_float)
    reds, greens = values[0::4], values[1::4]
    assert any(r > 0.3 and r > 2.0 * g for r, g in zip(reds, greens, strict=True))


@pytest.mark.blender
def test_the_noise_threshold_is_the_scene_s(tmp_path: Path):
    import math

    import scenes

    # A pass of sample counts shows shares of the most samples.
    scene = scenes.lit_floor(samples=1024, width=32, height=32)
    scene.gonio.max_bounces = 4
    scene.view_layers[0].gonio.pass_debug_sample_count = True
    means = {}
    for on in (True, False):
        scene.gonio.use_adaptive_sampling = on
        scenes.render(tmp_path / "a.exr")
        channels = scenes.read(tmp_path / "a.exr")
        means[on] = float(channels["ViewLayer.Combined.R"].mean())
        count = channels["ViewLayer.Debug Sample Count.X"]
        # Even light from a point has no noise: 64 samples are the least for the usual threshold of 0.01.
        assert math.isclose(float(count.max()), 64 / 1024 if on else 1.0, rel_tol=1e-6)
    assert math.isclose(means[True], means[False], rel_tol=2e-3)


@pytest.mark.blender
def test_thresholds_are_those_of_cycles():
    import bpy
    import scenes

    scene = scenes.lit_floor()
    settings = part("export.settings").settings
    size = {"width": 8, "height": 8, "crop": None, "passes": ["color"]}
    found = lambda preview: settings(bpy.context.evaluated_depsgraph_get(), preview=preview, **size)  # noqa: E731
    assert abs(found(False)["noise_threshold"] - 0.01) < 1e-7 and abs(found(True)["noise_threshold"] - 0.1) < 1e-7
    scene.gonio.adaptive_threshold, scene.gonio.samples, scene.gonio.film_exposure = 0.0, 500, 2.0
    assert abs(found(False)["noise_threshold"] - 0.002) < 1e-9
    assert abs(found(False)["noise_white"] - 177.83 / 2.0) < 1e-3
    scene.gonio.use_adaptive_sampling = scene.gonio.use_preview_adaptive_sampling = False
    assert found(False)["noise_threshold"] == found(True)["noise_threshold"] == 0.0
