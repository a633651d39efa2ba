"""Lux and cd/m² under the cursor, calculation grids, and the viewport in false colour."""

from pathlib import Path

import pytest


@pytest.mark.blender
def test_grids_become_texts_and_images():
    import importlib
    import math

    import bpy
    import numpy
    import scenes

    scenes.lit_floor()
    measuring = importlib.import_module("gonio_extension.measuring")
    floor = bpy.data.objects["Floor"]
    bpy.ops.mesh.primitive_plane_add(size=2.0, location=(0, 0, 0.5))
    plane = bpy.context.object
    plane.name = "Work plane"
    plane.gonio.is_grid, plane.gonio.is_grid_only, plane.gonio.grid_spacing = True, True, 0.5
    floor.gonio.is_grid, floor.gonio.grid_spacing, floor.gonio.grid_margin, floor.gonio.grid_height = True, 4.0, 2.0, 0.25
    assert bpy.ops.gonio.measure_grids(samples=256) == {"FINISHED"}
    # A lamp of 100 W at 1 m has 100 / 4π W/sr; the plane, which is not rendered, casts no shadow on the floor.
    intensity = 100 / (4 * math.pi) * scenes.LUMENS_PER_WATT
    readings = measuring.latest.grids
    assert set(readings) == {"Work plane", "Floor"} and readings["Work plane"].size == (4, 4) and readings["Floor"].size == (4, 4)
    for name, height in (("Work plane", 0.5), ("Floor", 0.75)):
        reading = readings[name]
        positions, values = numpy.asarray(reading.positions), numpy.asarray(reading.values).ravel()
        across = numpy.hypot(positions[:, 0], positions[:, 1])
        expected = intensity * height / (across**2 + height**2) ** 1.5
        # Light comes from the lamp alone: no bounces.
        assert numpy.allclose(values, expected, rtol=2e-3), (values, expected)
    assert bpy.data.texts["Gonio grids.csv"].as_string().count("\n") == 33
    picture = bpy.data.images["Work plane (lx)"]
    assert picture.size[0] > picture.size[1] > 100
    assert bpy.ops.gonio.measure_grids(samples=16) == {"FINISHED"}
    assert len([image for image in bpy.data.images if image.name.startswith("Work plane")]) == 1
    bpy.ops.wm.read_homefile(use_empty=True)
    assert not measuring.latest.grids


@pytest.mark.blender
def test_a_year_of_daylight_on_grids(tmp_path: Path):
    import importlib

    import bpy
    import numpy
    import scenes

    scenes.lit_floor()
    months = (31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)
    head = "place Here\nlatitude 49.52\nlongitude -8.55\ntime_zone -15\nsite_elevation 96\nweather_data_file_units 3\n"
    rows = [f"{month} {day} {hour}.500 0 {10000 if 6 < hour < 18 else 0}\n" for month, days in enumerate(months, 1) for day in range(1, days + 1) for hour in range(24)]
    weather = tmp_path / "year.wea"
    weather.write_text(head + "".join(rows))
    floor = bpy.data.objects["Floor"]
    floor.gonio.is_grid, floor.gonio.grid_spacing, floor.gonio.grid_margin, floor.gonio.grid_height = True, 4.0, 2.0, 0.25
    assert bpy.ops.gonio.annual_daylight(filepath=str(weather), samples=64) == {"FINISHED"}
    lines = importlib.import_module("gonio_extension.measuring").latest.years["Floor"]
    # Nothing stands in the light of an overcast year.
    assert lines[0].startswith("sDA 300/50 %: 100.0 %") and lines[1].startswith("ASE 1000/250 h: 0.0 %"), lines
    assert "Daylight factor: 100" in lines[3] or "Daylight factor: 99" in lines[3], lines
    picture = bpy.data.images["Floor (da_300)"]
    assert picture.size[0] > picture.size[1] > 100
    pixels = numpy.array(picture.pixels).reshape(picture.size[1], picture.size[0], 4)
    assert numpy.allclose(pixels[10, 10], pixels[-10, 400])
    with pytest.raises(RuntimeError, match=r"no\.epw"):
        bpy.ops.gonio.annual_daylight(filepath=str(tmp_path / "no.epw"))


@pytest.mark.blender
def test_grids_are_measured_beside_blender_until_escape():
    import importlib
    import time
    from types import SimpleNamespace

    import bpy
    import scenes

    scene = scenes.lit_floor()
    floor = bpy.data.objects["Floor"]
    floor.gonio.is_grid, floor.gonio.grid_spacing = True, 4.0
    operator = importlib.import_module("gonio_extension.operators.measure_grids").GONIO_OT_measure_grids
    latest = importlib.import_module("gonio_extension.measuring").latest
    names = ("invoke", "_publish")
    said, timers, texts = [], [], []
    Running = type("Running", operator.__bases__[:1], {**{name: vars(operator)[name] for name in names}, "report": lambda self, kind, text: said.append(text)})
    manager = SimpleNamespace(
        event_timer_add=lambda pause, window: timers.append(pause) or pause,
        event_timer_remove=timers.remove,
        modal_handler_add=lambda operator: None,
    )
    context = SimpleNamespace(
        scene=scene,
        view_layer=bpy.context.view_layer,
        window=None,
        window_manager=manager,
        screen=None,
        workspace=SimpleNamespace(status_text_set=texts.append),
        evaluated_depsgraph_get=bpy.context.evaluated_depsgraph_get,
    )
    tick, escape = SimpleNamespace(type="TIMER"), SimpleNamespace(type="ESC")
    running = Running()

    def finish():
        running.samples = 16
        assert running.invoke(context, None) == {"RUNNING_MODAL"}
        while (state := running.modal(context, tick)) == {"RUNNING_MODAL"}:
            time.sleep(0.01)
        assert not timers and texts[-1] is None
        return state

    running.samples = 1 << 30
    assert running.invoke(context, None) == {"RUNNING_MODAL"} and timers and texts[-1]
    assert running.modal(context, tick) == {"RUNNING_MODAL"}
    assert running.modal(context, escape) == {"CANCELLED"}
    assert running._found.done() and not timers and texts[-1] is None and not latest.grids
    assert finish() == {"FINISHED"} and set(latest.grids) == {"Floor"} and len(said) == 1
    floor.gonio.grid_margin = 100.0
    assert finish() == {"CANCELLED"} and "nothing to measure" in said[-1]
    assert operator.poll(context)
    scene.render.engine = "BLENDER_WORKBENCH"
    assert not operator.poll(context)


@pytest.mark.blender
def test_lux_and_luminance_along_a_ray():
    import importlib
    import math

    import bpy
    import pytest
    import scenes
    from mathutils import Vector

    scene = scenes.lit_floor()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    meter = importlib.import_module("gonio_extension.measuring").Meter(depsgraph)
    read = importlib.import_module("gonio_extension.operators.point_meter").reading_along
    lines = read(meter, depsgraph, scene, Vector((0.5, 0, 0.3)), Vector((0, 0, -1)), 4096)
    lux = 100 / (4 * math.pi) * scenes.LUMENS_PER_WATT / (1.25**1.5)
    assert float(lines[0].split()[1]) == pytest.approx(lux, rel=3e-3) and "lx" in lines[0]
    assert float(lines[1].split()[1]) == pytest.approx(lux / math.pi, rel=3e-3) and "cd/m²" in lines[1]
    assert lines[2] == "Floor"
    assert read(meter, depsgraph, scene, Vector((0, 0, 0.3)), Vector((0, 0, 1)), 16) == ("nothing there",)


@pytest.mark.blender
def test_the_point_meter_ends_when_its_viewport_is_gone():
    import importlib
    from types import SimpleNamespace

    import bpy

    tool = importlib.import_module("gonio_extension.operators.point_meter")
    operator = tool.GONIO_OT_point_meter
    restored = []
    window = SimpleNamespace(cursor_modal_restore=lambda: restored.append(True))
    handler = bpy.types.SpaceView3D.draw_handler_add(lambda: None, (), "WINDOW", "POST_PIXEL")
    running = SimpleNamespace(_handler=handler, poll=operator.poll)
    running.cancel = lambda context: operator.cancel(running, context)
    moved, gone = SimpleNamespace(type="MOUSEMOVE"), SimpleNamespace(area=None, window=window)
    assert operator.modal(running, gone, moved) == {"CANCELLED"} and running._handler is None and restored == [True]
    # Blender may end it once more.
    running.cancel(SimpleNamespace(area=None, window=None))


@pytest.mark.blender
def test_the_view_under_the_cursor_of_a_quad_view():
    import importlib
    from types import SimpleNamespace

    view_under = importlib.import_module("gonio_extension.operators.point_meter").view_under
    views = [SimpleNamespace(type="WINDOW", x=x, y=y, width=100, height=100) for x in (0, 100) for y in (0, 100)]
    sidebar = SimpleNamespace(type="UI", x=150, y=0, width=50, height=200)
    area = SimpleNamespace(regions=[sidebar, *views])
    found = [view_under(area, SimpleNamespace(mouse_x=x, mouse_y=y)) for x, y in ((50, 50), (50, 150), (120, 50), (120, 150), (170, 50))]
    assert found == [*views, None]


@pytest.mark.blender
def test_the_viewport_shows_false_colour():
    import bpy
    import numpy
    import scenes
    from mathutils import Matrix
    from viewport import Viewport

    scene = scenes.lit_floor()
    scene.gonio.preview_samples = 4
    scene.gonio.display, scene.gonio.false_color_max, scene.gonio.false_color_steps = "ILLUMINANCE", 1500.0, 5
    scene.gonio.use_false_color_contours = False
    view = Viewport(Matrix.Translation((0, 0, 4)))
    try:
        picture = view.finish()
        pixels = numpy.asarray(picture.pixels).reshape(-1, 4)
        assert picture.legend is not None and picture.legend.height > picture.height // 2
        assert len(numpy.unique((pixels[:, :3] * 255).round(), axis=0)) == 5
        scene.gonio.display = "COLOR"
        bpy.context.view_layer.update()
        view.draw()
        assert view.finish().legend is None
    finally:
        view.close()


@pytest.mark.blender
def test_glare_in_a_panoramic_camera(tmp_path: Path):
    import json
    import math
    import subprocess
    import sys

    import bpy
    import pytest
    import scenes

    # A sphere of 0.1 m straight ahead at 1 m, of 40 W/(m² sr), before a world of 0.2.
    scene = scenes.empty(width=400, height=400, samples=16)
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.2, 0.2, 0.2, 1)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=0.1, location=(0, 1, 0))
    material = bpy.data.materials.new("Glow")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    emission, output = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
    emission.inputs["Strength"].default_value = 40.0
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    bpy.context.object.data.materials.append(material)
    bpy.ops.object.camera_add(location=(0, 0, 0), rotation=(math.radians(90), 0, 0))
    scene.camera = bpy.context.object
    lens = scene.camera.data
    lens.type, lens.clip_start = "PANO", 0.01
    panorama = lens if hasattr(lens, "panorama_type") else lens.cycles
    panorama.panorama_type, panorama.fisheye_fov = "FISHEYE_EQUIDISTANT", math.pi
    scene.gonio.pixel_filter_type, scene.gonio.filter_width = "BOX", 1.0
    scene.view_layers[0].gonio.use_pass_luminance = True
    scenes.render(tmp_path / "eye.exr")
    run = [sys.executable, "-m", "gonio.cli"]
    ended = subprocess.run([*run, "glare", str(tmp_path / "eye.exr"), "--json"], capture_output=True, text=True, check=False)
    assert ended.returncode == 0, ended.stderr
    found = json.loads(ended.stdout)
    bright, dim, half = 40.0 * scenes.LUMENS_PER_WATT, 0.2 * scenes.LUMENS_PER_WATT, math.asin(0.1)
    of_disk = math.pi * math.sin(half) ** 2
    background = dim * (1 - of_disk / math.pi)
    ugr = 8 * math.log10(0.25 / background * bright**2 * 2 * math.pi * (1 - math.cos(half)))
    # The rim's pixels count with the disk though they are darker.
    assert found["ugr"] == pytest.approx(ugr, abs=0.3)
    assert found["eye_illuminance_lx"] == pytest.approx(of_disk * bright + math.pi * background, rel=0.01)
    shown = [*run, "falsecolor", str(tmp_path / "eye.exr"), "-o", str(tmp_path / "eye.png"), "--contours"]
    subprocess.run(shown, capture_output=True, check=True)


@pytest.mark.blender
def test_observers_on_grids_rate_the_lamps():
    import importlib
    import math

    import bpy
    import numpy
    import scenes

    scene = scenes.lit_floor()
    scene.world.gonio.use_luminance, scene.world.gonio.luminance = True, 20.0
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    measuring = importlib.import_module("gonio_extension.measuring")
    bpy.data.objects.remove(bpy.data.objects["Floor"])
    # An eye 2 m before the lamp, at its height, looking along the plane's Y axis.
    bpy.ops.mesh.primitive_plane_add(size=1.0, location=(0, -2, 1))
    plane = bpy.context.object
    plane.gonio.is_grid, plane.gonio.is_grid_only, plane.gonio.grid_spacing, plane.gonio.grid_quantity = True, True, 1.0, "ugr"
    assert bpy.ops.gonio.measure_grids(samples=1024) == {"FINISHED"}
    reading = measuring.latest.grids[plane.name]
    intensity = 100 / (4 * math.pi) * scenes.LUMENS_PER_WATT
    # Straight ahead the position index is 1; small sources count as 0.005 m².
    expected = 8 * math.log10(0.25 / 20 * 200 * intensity**2 / 4)
    assert numpy.allclose(numpy.asarray(reading.values), expected, atol=0.05), (reading.average.value, expected)
    assert measuring.grid_lines(reading)[0].startswith("UGR_avg: ")
    assert bpy.data.images[f"{plane.name} (ugr)"].size[0] > 0
    plane.rotation_euler.z = math.pi
    assert bpy.ops.gonio.measure_grids(samples=16) == {"FINISHED"}
    assert measuring.latest.grids[plane.name].max.value == 0.0


@pytest.mark.blender
def test_lamps_behind_glass_are_told_and_not_rated():
    import importlib

    import bpy
    import scenes

    scenes.lit_floor()
    measuring, report = (importlib.import_module(f"gonio_extension.{name}") for name in ("measuring", "report"))
    bpy.data.objects.remove(bpy.data.objects["Floor"])
    bpy.ops.mesh.primitive_plane_add(size=1.0, location=(0, -2, 1))
    plane = bpy.context.object
    plane.gonio.is_grid, plane.gonio.is_grid_only, plane.gonio.grid_spacing, plane.gonio.grid_quantity = True, True, 1.0, "ugr"
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.3, location=bpy.data.objects["Lamp"].location)
    glass = bpy.data.materials.new("Glass")
    glass.use_nodes = True
    tree = glass.node_tree
    tree.nodes.clear()
    shader, end = tree.nodes.new("ShaderNodeBsdfGlass"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    bpy.context.object.data.materials.append(glass)
    assert bpy.ops.gonio.measure_grids(samples=64) == {"FINISHED"}
    lines = measuring.grid_lines(measuring.latest.grids[plane.name])
    assert any("behind glass or covers at 1 points" in line for line in lines), lines
    assert report.latest().diagnostics, "what the engine says of the measurement is in the panel"


@pytest.mark.blender
def test_false_colour_is_a_pass_of_final_renders(tmp_path: Path):
    import numpy
    import scenes

    scene = scenes.lit_floor(samples=16)
    scene.render.resolution_x, scene.render.resolution_y, scene.camera.data.ortho_scale = 160, 120, 5.0
    scene.view_layers[0].gonio.use_pass_illuminance = True
    scene.view_layers[0].gonio.use_pass_illuminance_false_color = True
    scene.gonio.false_color_max, scene.gonio.false_color_steps, scene.gonio.use_false_color_contours = 1000.0, 4, False
    scenes.render(tmp_path / "a.exr")
    channels = scenes.read(tmp_path / "a.exr")
    shown = numpy.stack([channels[f"ViewLayer.Illuminance False Color.{name}"] for name in "RGB"], axis=-1)
    lux = channels["ViewLayer.Illuminance.X"]
    # The ends of the ramp and two places between, as scene-linear colours.
    ramp = numpy.array([[68, 1, 84], [49, 104, 142], [53, 183, 121], [253, 231, 37]]) / 255
    linear = numpy.where(ramp <= 0.04045, ramp / 12.92, ((ramp + 0.055) / 1.055) ** 2.4)
    expected = linear[numpy.minimum(lux // 250, 3).astype(int)]
    # The legend stands on the left, from the lower corner up.
    height, width = lux.shape
    beside = numpy.s_[:, width // 2 :]
    assert numpy.allclose(shown[beside], expected[beside], atol=0.01) and len(numpy.unique(lux[beside] // 250)) > 2
    corner = shown[height - height // 4 :, : width // 12].reshape(-1, 3)
    assert not numpy.allclose(corner, expected[height - height // 4 :, : width // 12].reshape(-1, 3), atol=0.01)
    assert len({tuple(numpy.round(pixel, 2)) for pixel in corner}) > 2


@pytest.mark.blender
def test_the_panel_knows_when_a_view_changes_false_colours():
    import importlib

    import scenes

    view = scenes.lit_floor().view_settings
    passes = importlib.import_module("gonio_extension.ui.passes")
    view.view_transform = "Standard"
    assert not passes.changes_colors(view)
    for name, value in (("exposure", 1.0), ("gamma", 2.2), ("use_curve_mapping", True), ("view_transform", "AgX")):
        setattr(view, name, value)
        assert passes.changes_colors(view), name
        view.exposure, view.gamma, view.use_curve_mapping, view.view_transform = 0.0, 1.0, False, "Standard"
