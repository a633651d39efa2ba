"""Tone mapping in Gonio: the picture that Blender shows with its Standard view transform, in final renders and in the viewport."""

import importlib
from pathlib import Path

import pytest


def part(name):
    """A module of the extension."""
    return importlib.import_module(f"gonio_extension.{name}")


def lit_and_standard():
    """A floor that grows dark away from a lamp, and the Standard view."""
    import scenes

    scene = scenes.lit_floor(samples=4, width=32, height=32)
    scene.camera.data.ortho_scale = 4.0
    scene.gonio.use_adaptive_sampling = False
    scene.render.dither_intensity = 0.0
    part("operators.standard_view").show_as_is(scene.view_settings)
    return scene


def picture(scene, path: Path):
    """What Blender writes as an 8-bit PNG file, rows from the top, from 0 to 255."""
    import bpy

    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_mode, settings.color_depth = "PNG", "RGB", "8"
    scene.render.filepath = str(path)
    assert bpy.ops.render.render(write_still=True) == {"FINISHED"}
    bpy.utils.expose_bundled_modules()
    import OpenImageIO

    return 255.0 * OpenImageIO.ImageBuf(str(path)).get_pixels(OpenImageIO.FLOAT)[..., :3]


@pytest.mark.blender
def test_standard_shows_the_mapped_picture(tmp_path: Path):
    import numpy
    import scenes

    scene = lit_and_standard()
    scene.view_layers[0].gonio.use_pass_luminance = True
    scenes.render(tmp_path / "linear.exr")
    linear = scenes.read(tmp_path / "linear.exr")
    scene.gonio.tone_map, scene.gonio.tone_map_ev100, scene.gonio.film_exposure = "EV100", 8.0, 2.0
    scenes.render(tmp_path / "mapped.exr")
    mapped = scenes.read(tmp_path / "mapped.exr")
    light = numpy.stack([linear[f"ViewLayer.Combined.{channel}"] for channel in "RGB"], -1) * scenes.LUMENS_PER_WATT
    value = numpy.clip(2.0 * light / (1.2 * 2.0**8), 0.0, 1.0)
    assert 0.01 < value.min() < 0.2 and value.max() == 1.0
    found = numpy.stack([mapped[f"ViewLayer.Combined.{channel}"] for channel in "RGB"], -1)
    assert numpy.abs(found - value).max() < 1e-5
    # Measurements stay.
    assert numpy.array_equal(mapped["ViewLayer.Luminance.X"], linear["ViewLayer.Luminance.X"])
    curve = numpy.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)
    assert numpy.abs(picture(scene, tmp_path / "a.png") - 255.0 * curve).max() < 1.0


@pytest.mark.blender
def test_the_photographic_operators_bring_any_light_to_the_same_picture(tmp_path: Path):
    import bpy
    import numpy

    scene = lit_and_standard()
    for operator in ("PHOTOGRAPHIC", "LOCAL"):
        scene.gonio.tone_map = operator
        pictures = []
        for watts in (1.0, 1000.0):
            bpy.data.objects["Lamp"].data.energy = watts
            pictures.append(picture(scene, tmp_path / "a.png"))
        assert numpy.abs(pictures[0] - pictures[1]).max() <= 1.0 and 60.0 < pictures[0].mean() < 200.0


@pytest.mark.blender
def test_the_standard_view_is_one_click_away():
    import bpy

    is_standard, view = part("operators.standard_view").is_standard, bpy.context.scene.view_settings
    view.view_transform, view.exposure = "AgX", 1.0
    assert not is_standard(view)
    assert bpy.ops.gonio.use_standard_view() == {"FINISHED"}
    assert is_standard(view)
    view.gamma = 1.2
    assert not is_standard(view)


@pytest.mark.blender
def test_the_viewport_shows_the_mapped_picture_without_its_noise():
    import numpy
    from mathutils import Matrix
    from viewport import Viewport

    scene = lit_and_standard()
    scene.gonio.preview_samples = 2
    # A large lamp: two samples of its shadowless light are noisy.
    import bpy

    bpy.data.objects["Lamp"].data.shadow_soft_size = 0.5
    view = Viewport(Matrix.Translation((0, 0, 3)))
    noise = []
    for denoises in (False, True):
        scene.gonio.tone_map, scene.gonio.use_preview_denoising = "PHOTOGRAPHIC", denoises
        view.draw()
        shown = view.finish()
        pixels = numpy.asarray(shown.pixels).reshape(shown.height, shown.width, 4)[..., 1]
        assert pixels.min() >= 0.0 and pixels.max() <= 1.0
        noise.append(float(numpy.abs(numpy.diff(pixels[200:340, 200:300], axis=1)).mean()))
    view.close()
    assert noise[1] < 0.3 * noise[0]
