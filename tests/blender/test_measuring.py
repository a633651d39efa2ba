"""Lux and cd/m² under the cursor, calculation grids, and the viewport in false colour."""

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
