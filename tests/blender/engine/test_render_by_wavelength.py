"""Pictures by wavelength that Blender renders: radiance by closed forms, the view beside that of final renders, files, words and ESC."""

from pathlib import Path

import pytest

EFFICACY = 683.002
# The CIE's ȳ of 1931 at the middles of bands of 10 nm from 380 to 780.
LUMINOUS = (
    *(0.000064, 0.000217, 0.00064, 0.00218, 0.0073, 0.01684, 0.0298, 0.048, 0.0739, 0.1126),
    *(0.1693, 0.2586, 0.4073, 0.6082, 0.7932, 0.91485, 0.9803, 1.0, 0.9786, 0.9154),
    *(0.8163, 0.6949, 0.5668, 0.4412, 0.321, 0.217, 0.1382, 0.0816, 0.04458, 0.0232),
    *(0.01192, 0.005723, 0.002929, 0.001484, 0.00074, 0.000361, 0.000172, 0.000085, 0.000042, 0.000021),
)


def per_lumen(name, band):
    """Power of a lamp in bands, W/nm for each lm."""
    import gonio
    import numpy

    lamp = gonio.illuminant(name)
    nm = numpy.arange(380.0, 780.01, 0.1)
    power = numpy.interp(nm, lamp["wavelengths_nm"], lamp["power"])
    energy = numpy.concatenate([[0.0], numpy.cumsum(0.05 * (power[1:] + power[:-1]))])
    return numpy.diff(energy[:: 10 * band]) / band / (gonio.spectrum_figures(nm, power)["ler"] * energy[-1])


def spectral(path):
    """The bands of an EXR file: rows from the top, columns, bands; and their names."""
    import numpy
    import scenes

    channels = scenes.read(path)
    names = sorted(name for name in channels if name.startswith("S0."))
    return numpy.stack([channels[name] for name in names], axis=-1), names


def lamp_floor(spectrum, lumens=1000.0):
    """A white floor a metre under a point lamp of a spectrum, seen straight on."""
    import bpy
    import scenes

    scene = scenes.lit_floor(samples=1, width=32, height=18)
    settings = bpy.data.objects["Lamp"].data.gonio
    settings.use_photometry, settings.unit, settings.quantity, settings.spectrum = True, "LUMEN", lumens, spectrum
    return scene


def glow(name, strength=1.0):
    """A material that sends light evenly, in W/(m² sr)."""
    import bpy

    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    emission, output = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
    emission.inputs["Strength"].default_value = strength
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    return material


def failure(**options):
    """What the operator says is wrong."""
    import bpy

    try:
        bpy.ops.gonio.render_by_wavelength(**options)
    except RuntimeError as error:
        return str(error)
    raise AssertionError("it was rendered")


@pytest.mark.blender
def test_a_white_floor_has_the_lamp_s_spectrum(tmp_path: Path):
    import math

    import bpy
    import numpy

    for name, band in (("FL11", 5), ("LED-B3", 10)):
        lamp_floor(name)
        path = tmp_path / f"{name}.exr"
        assert bpy.ops.gonio.render_by_wavelength(filepath=str(path), band=str(band)) == {"FINISHED"}
        radiance, names = spectral(path)
        assert radiance.shape == (18, 32, 400 // band)
        assert names[0] == {5: "S0.382,500000nm", 10: "S0.385,000000nm"}[band]
        # 1000 lm at 1 m, a Lambertian floor; the picture's corners are 0.06 m from its middle.
        luminance = 1000.0 / (4.0 * math.pi) / math.pi
        expected = luminance * per_lumen(name, band)
        numpy.testing.assert_allclose(radiance.mean(axis=(0, 1)), expected, rtol=5e-3, atol=1e-3 * expected.max())
    assert names[-1] == "S0.775,000000nm"
    found = EFFICACY * 10.0 * (radiance * numpy.array(LUMINOUS)).sum(axis=-1)
    numpy.testing.assert_allclose(found, luminance, rtol=6e-3)


@pytest.mark.blender
def test_light_groups_and_illuminance_are_by_wavelength(tmp_path: Path):
    """The lamp is the only light of its group; its lux are those of the illuminance."""
    import math

    import bpy
    import numpy
    import scenes

    lamp_floor("LED-B3")
    layer = bpy.context.view_layer
    layer.lightgroups.add(name="Desk")
    bpy.data.objects["Lamp"].lightgroup = "Desk"
    layer.gonio.use_pass_illuminance = True
    path = tmp_path / "groups.exr"
    assert bpy.ops.gonio.render_by_wavelength(filepath=str(path), band="10") == {"FINISHED"}
    channels = scenes.read(path)
    names = sorted(name for name in channels if name.startswith("S0."))
    for name in names:
        numpy.testing.assert_allclose(channels[f"lightgroup:Desk.{name}"], channels[name], rtol=1e-5)
        assert not channels[f"lightgroup:other.{name}"].any()
    numpy.testing.assert_allclose(channels["Illuminance"], 1000.0 / (4.0 * math.pi), rtol=8e-3)
    assert len([name for name in channels if name.startswith("Illuminance.S0.")]) == 40


@pytest.mark.blender
def test_radiance_s_files_have_bands_of_20_nm(tmp_path: Path):
    import importlib

    import bpy
    import numpy
    import scenes

    scenes.lit_floor(samples=1, width=8, height=4)
    bpy.data.objects["Floor"].data.materials[0] = glow("Glow", 2.0)
    bpy.data.objects.remove(bpy.data.objects["Lamp"])
    path = tmp_path / "wall.hsr"
    by_wavelength = importlib.import_module("gonio_extension.by_wavelength").Wanted
    assert by_wavelength.checked(path, 5).band == by_wavelength.checked(tmp_path / "WALL.HSR", 10).band == 20
    assert by_wavelength.checked(tmp_path / "wall.exr", 5).band == 5
    assert bpy.ops.gonio.render_by_wavelength(filepath=str(path)) == {"FINISHED"}
    head, rest = path.read_bytes().split(b"\n\n", 1)
    assert head.startswith(b"#?RADIANCE\n") and b"NCOMP=20" in head and b"FORMAT=Radiance_spectra" in head
    size, data = rest.split(b"\n", 1)
    assert size == b"-Y 4 +X 8"
    pixels = numpy.frombuffer(data, numpy.uint8).reshape(32, 21)
    values = ((pixels[:, :20] + 0.5) * 2.0 ** (pixels[:, 20:].astype(float) - 136)).mean(axis=0)[::-1]
    # An even spectrum has its luminance over 179 lm/W in all bands.
    expected = 2.0 * scenes.LUMENS_PER_WATT * per_lumen("D65", 20) * EFFICACY * 106.857 / 179.0
    numpy.testing.assert_allclose(values, expected, atol=0.01 * expected.max())


@pytest.mark.blender
def test_the_view_is_that_of_a_final_render(tmp_path: Path):
    """Frame, border, percentage, motion blur, what is hidden in viewports or in renders, and the view layer's samples."""
    import bpy
    import numpy
    import scenes

    scene = scenes.lit_floor(samples=1, width=64, height=36)
    render, layer = scene.render, scene.view_layers[0]
    scene.camera.data.ortho_scale = 4.0
    render.resolution_percentage, render.use_border, render.use_crop_to_border = 50, True, True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.0, 1.0, 0.0, 0.75
    layer.gonio.use_pass_luminance, layer.samples = True, 4

    def card(name, colour_of, x, **hidden):
        bpy.ops.mesh.primitive_plane_add(size=0.8, location=(x, 0, 0.5))
        thing = bpy.context.object
        thing.name = name
        thing.data.materials.append(colour_of)
        thing.hide_viewport, thing.hide_render = hidden.get("viewport", False), hidden.get("render", False)
        return thing

    card("Rendered", glow("A", 3.0), 1.4, viewport=True)
    card("Not rendered", glow("B", 50.0), 0.4, render=True)
    mover = card("Mover", glow("C", 1.0), -2.0)
    mover.keyframe_insert("location", frame=1)
    mover.location.x = 0.0
    mover.keyframe_insert("location", frame=5)
    scene.frame_set(3)
    render.use_motion_blur, render.motion_blur_shutter = True, 1.0
    scenes.render(tmp_path / "final.exr")
    final = scenes.read(tmp_path / "final.exr")["ViewLayer.Luminance.X"]
    assert bpy.ops.gonio.render_by_wavelength(filepath=str(tmp_path / "picture.exr")) == {"FINISHED"}
    radiance, _ = spectral(tmp_path / "picture.exr")
    found = EFFICACY * 10.0 * (radiance * numpy.array(LUMINOUS)).sum(axis=-1)
    assert found.shape == final.shape == (13, 32)
    # The mover's edges are of four samples in either.
    white = 3.0 * scenes.LUMENS_PER_WATT
    assert numpy.abs(found - final).max() < 0.35 * white / 3.0 and numpy.abs(found.mean(axis=0) - final.mean(axis=0)).max() < 0.05 * white
    right = numpy.s_[2:6, 26:29]
    numpy.testing.assert_allclose(found[right], white, rtol=5e-3)
    numpy.testing.assert_allclose(final[right], white, rtol=5e-3)


@pytest.mark.blender
def test_the_last_render_stays(tmp_path: Path):
    """The last render's result is still shown, and switches are as they were."""
    import bpy

    scene = lamp_floor("A")
    scene.render.use_compositing, scene.render.use_sequencer = True, False
    bpy.ops.render.render()
    result = next(image for image in bpy.data.images if image.type == "RENDER_RESULT")
    result.save_render(str(tmp_path / "before.png"))
    bpy.data.objects["Lamp"].data.gonio.quantity = 1.0
    for _ in range(2):
        assert bpy.ops.gonio.render_by_wavelength(filepath=str(tmp_path / "a.exr"), band="20") == {"FINISHED"}
    result.save_render(str(tmp_path / "after.png"))
    assert (tmp_path / "before.png").read_bytes() == (tmp_path / "after.png").read_bytes()
    assert result.render_slots.active_index == 0 and sum(slot.name == "Gonio Export" for slot in result.render_slots) == 1
    assert scene.render.use_compositing and not scene.render.use_sequencer


@pytest.mark.blender
def test_samples_and_what_is_told(tmp_path: Path):
    import importlib

    import bpy
    import scenes

    scene = lamp_floor("A")
    latest = importlib.import_module("gonio_extension.report").latest
    bpy.utils.expose_bundled_modules()
    import OpenImageIO

    for samples, kept in ((0, "1"), (3, "3")):
        assert bpy.ops.gonio.render_by_wavelength(filepath=str(tmp_path / "a.exr"), band="20", samples=samples) == {"FINISHED"}
        assert OpenImageIO.ImageBuf(str(tmp_path / "a.exr")).spec().getattribute("gonio:samples") == kept
    assert not latest().summary()
    # The lamp's spectrum cannot be read, and several views are asked for.
    bpy.data.objects["Lamp"].data.gonio.spectrum = str(tmp_path / "missing.spdx")
    scene.render.use_multiview = True
    assert bpy.ops.gonio.render_by_wavelength(filepath=str(tmp_path / "a.exr"), band="20") == {"FINISHED"}
    said = [line.text for line in latest().diagnostics]
    assert any("missing.spdx" in line for line in said) and any("stereoscopic" in line for line in said), said
    assert scenes.read(tmp_path / "a.exr")["S0.390,000000nm"].shape == (18, 32)


@pytest.mark.blender
def test_what_cannot_be_rendered_is_told(tmp_path: Path):
    import bpy

    scene = lamp_floor("A")
    path = str(tmp_path / "a.exr")
    assert "No file is named" in failure()
    assert "the ending is '.png', expected .exr or .hsr" in failure(filepath=str(tmp_path / "a.png"))
    assert "nothing can be written there: No such file or directory" in failure(filepath=str(tmp_path / "nowhere" / "a.exr"))
    (tmp_path / "folder.exr").mkdir()
    assert "it is a folder" in failure(filepath=str(tmp_path / "folder.exr"))
    scene.gonio.use_sample_subset, scene.gonio.samples, scene.gonio.sample_subset_length = True, 64, 16
    assert "Sample Subset is on" in failure(filepath=path)
    scene.gonio.use_sample_subset, scene.gonio.samples = False, 1
    # Blender's own words where it does not render at all.
    scene.render.use_border, scene.render.border_min_x, scene.render.border_max_x = True, 0.5, 0.5
    assert failure(filepath=path).strip()
    scene.render.use_border = False
    scene.camera = None
    assert "The scene has no camera" in failure(filepath=path)
    scene.render.engine = "BLENDER_WORKBENCH"
    assert "The render engine is not Gonio" in failure(filepath=path)
    assert not (tmp_path / "a.exr").exists()


@pytest.mark.blender
def test_an_export_that_fails_is_told(tmp_path: Path):
    import importlib

    import bpy

    lamp_floor("A")
    handover = importlib.import_module("gonio_extension.session.handover")
    session = handover.FinalSession
    sync = session.sync
    session.sync = lambda *_, **__: 1 / 0
    try:
        assert "division by zero" in failure(filepath=str(tmp_path / "a.exr"))
    finally:
        session.sync = sync
    assert handover.awaited() is None
    assert bpy.ops.gonio.render_by_wavelength(filepath=str(tmp_path / "a.exr"), band="20") == {"FINISHED"}


@pytest.mark.blender
def test_it_is_rendered_beside_blender_until_escape(tmp_path: Path):
    import importlib
    import time
    from types import SimpleNamespace

    import bpy

    scene = lamp_floor("A")
    module = importlib.import_module("gonio_extension.operators.render_by_wavelength")
    operator = module.GONIO_OT_render_by_wavelength
    names = ("_tell", "_arrived", "_publish", "invoke", "execute")
    said, timers, texts, asked = [], [], [], []
    fields = {name: vars(operator)[name] for name in names} | {"report": lambda self, kind, text: said.append((kind, text))}
    running = type("Running", operator.__bases__[:1], {**fields, "filepath": "", "band": "10", "samples": 0})()
    context = SimpleNamespace(
        scene=scene,
        view_layer=bpy.context.view_layer,
        window=None,
        window_manager=SimpleNamespace(
            event_timer_add=lambda pause, window: timers.append(pause) or pause,
            event_timer_remove=timers.remove,
            modal_handler_add=lambda operator: None,
            fileselect_add=asked.append,
        ),
        screen=None,
        workspace=SimpleNamespace(status_text_set=texts.append),
    )
    tick, escape = SimpleNamespace(type="TIMER"), SimpleNamespace(type="ESC")
    scene.frame_set(7)
    assert running.invoke(context, None) == {"RUNNING_MODAL"} and asked == [running]
    assert Path(running.filepath).name == "untitled_0007.exr"
    running.filepath = str(tmp_path / "a.exr")
    # There is no window here, so that it would wait.
    module.bpy = SimpleNamespace(app=SimpleNamespace(background=False), path=bpy.path, data=bpy.data)
    running.samples = 1 << 20
    assert running.execute(context) == {"RUNNING_MODAL"} and timers
    begun = time.monotonic()
    while running.modal(context, tick) == {"RUNNING_MODAL"} and time.monotonic() < begun + 0.5:
        time.sleep(0.02)
    assert texts[-1].startswith("Gonio renders by wavelength, 0:0") and texts[-1].endswith("ESC: Cancel")
    pressed = time.monotonic()
    assert running.modal(context, escape) == {"CANCELLED"} and time.monotonic() < pressed + 0.25
    assert not timers and texts[-1] is None
    assert running._found.exception(timeout=60) is not None and not (tmp_path / "a.exr").exists() and not said
    running.samples = 1
    assert running.execute(context) == {"RUNNING_MODAL"}
    while (state := running.modal(context, tick)) == {"RUNNING_MODAL"}:
        time.sleep(0.01)
    assert state == {"FINISHED"} and not timers and texts[-1] is None and (tmp_path / "a.exr").exists()
    assert said == [({"INFO"}, f"{tmp_path / 'a.exr'}: spectral radiance in 40 bands of 10 nm")]
    # The folder goes while it renders.
    gone = tmp_path / "gone"
    gone.mkdir()
    running.filepath, running.band = str(gone / "a.hsr"), "20"
    assert running.execute(context) == {"RUNNING_MODAL"}
    gone.rmdir()
    while (state := running.modal(context, tick)) == {"RUNNING_MODAL"}:
        time.sleep(0.01)
    assert state == {"CANCELLED"} and said[-1][0] == {"ERROR"} and "gone" in said[-1][1], said


@pytest.mark.blender
def test_endings_and_words():
    import importlib
    from types import SimpleNamespace

    import bpy

    operator = importlib.import_module("gonio_extension.operators.render_by_wavelength").GONIO_OT_render_by_wavelength
    for named, expected in (("/a/office", "/a/office.exr"), ("/a/office.hsr", "/a/office.hsr"), ("/a/v1.2", "/a/v1.2"), ("", "")):
        running = SimpleNamespace(filepath=named)
        assert operator.check(running, None) == (named != expected) and running.filepath == expected
    properties = bpy.ops.gonio.render_by_wavelength.get_rna_type().properties
    for name, described in properties.items():
        if name != "rna_type":
            assert described.name and len(described.description) > 10 and not described.description.endswith("."), name
    assert [item.name for item in properties["band"].enum_items] == ["5 nm", "10 nm", "20 nm"]
    assert properties["band"].default == "10"


@pytest.mark.blender
def test_its_places():
    import importlib
    from types import SimpleNamespace

    import bpy

    shown = []
    layout = SimpleNamespace(
        operator=lambda name, **_: shown.append(name),
        prop=lambda _, name, **__: shown.append(name) or SimpleNamespace(),
        separator=lambda: None,
    )
    menu = importlib.import_module("gonio_extension.ui.render_menu")
    for engine, expected in (("GONIO", ["gonio.render_by_wavelength"]), ("CYCLES", [])):
        shown.clear()
        menu._draw(SimpleNamespace(layout=layout), SimpleNamespace(engine=engine))
        assert shown == expected
    assert menu._draw in bpy.types.TOPBAR_MT_render._dyn_ui_initialize()
    layout.row = layout.column = lambda **_: layout
    shown.clear()
    bpy.types.GONIO_RENDER_PT_sampling_advanced.draw_settings(None, layout, bpy.context.scene)
    assert shown[:2] == ["spectral", "gonio.render_by_wavelength"]
