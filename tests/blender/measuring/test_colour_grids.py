"""Grids that measure the colour of light, in Blender."""

import pytest


@pytest.mark.blender
def test_a_grid_of_colour_rendering():
    import importlib

    import bpy
    import gonio
    import numpy
    import scenes

    scene = scenes.lit_floor()
    measuring = importlib.import_module("gonio_extension.measuring")
    settings = bpy.data.objects["Lamp"].data.gonio
    settings.use_photometry, settings.spectrum = True, "LED-B3"
    scene.gonio.false_color_max = 1000.0
    floor = bpy.data.objects["Floor"]
    floor.gonio.is_grid, floor.gonio.grid_spacing = True, 10.0
    lamp = gonio.illuminant("LED-B3")
    figures = gonio.spectrum_figures(lamp["wavelengths_nm"], lamp["power"])
    for quantity, unit, symbol in (("ra", "", "Ra"), ("cct", "K", "CCT"), ("duv", "", "Duv"), ("rf", "", "Rf"), ("rg", "", "Rg")):
        floor.gonio.grid_quantity = quantity
        assert bpy.ops.gonio.measure_grids(samples=256) == {"FINISHED"}
        reading = measuring.latest.grids["Floor"]
        assert reading.unit == unit and numpy.asarray(reading.values).shape == (2, 2)
        assert numpy.allclose(numpy.asarray(reading.values), figures[quantity], rtol=1e-3), quantity
        lines = measuring.grid_lines(reading)
        assert lines[0].startswith(f"{symbol}_avg: ") and not any("U0" in line for line in lines)
        assert bpy.data.images[f"Floor ({unit or quantity})"].size[0] > 0


@pytest.mark.blender
def test_lamps_without_a_spectrum_have_no_colour_rendering():
    import bpy
    import scenes

    scenes.lit_floor()
    floor = bpy.data.objects["Floor"]
    floor.gonio.is_grid, floor.gonio.grid_spacing, floor.gonio.grid_quantity = True, 10.0, "ra"
    with pytest.raises(RuntimeError, match="Lamp.*spectrum"):
        bpy.ops.gonio.measure_grids(samples=64)


@pytest.mark.blender
def test_eyes_at_the_points_of_a_grid():
    import importlib

    import bpy
    import numpy
    import scenes

    scenes.lit_floor()
    measuring = importlib.import_module("gonio_extension.measuring")
    settings = bpy.data.objects["Lamp"].data.gonio
    settings.use_photometry, settings.spectrum = True, "LED-B3"
    floor = bpy.data.objects["Floor"].gonio
    floor.is_grid, floor.grid_spacing, floor.grid_height, floor.grid_eyes = True, 10.0, 1.2, 4
    found = {}
    for quantity in ("illuminance", "melanopic-edi"):
        floor.grid_quantity = quantity
        assert bpy.ops.gonio.measure_grids(samples=1024) == {"FINISHED"}
        reading = measuring.latest.grids["Floor"]
        assert numpy.allclose(reading.facings, [(0, 1, 0), (1, 0, 0), (0, -1, 0), (-1, 0, 0)], atol=1e-6)
        eyes = numpy.asarray(reading.eye_values)
        assert eyes.shape == (4, 4) and numpy.allclose(numpy.ravel(reading.values), eyes.mean(axis=1))
        assert any(line.startswith("Least eye of 4 directions: ") and line.endswith(" lx") for line in measuring.grid_lines(reading))
        found[quantity] = eyes.mean()
    # The floor is grey, so that the light keeps the lamp's ratio.
    assert found["melanopic-edi"] / found["illuminance"] == pytest.approx(0.6326, rel=0.02)
    # What eyes do not have is measured on the surface.
    floor.grid_quantity = "cylindrical"
    assert bpy.ops.gonio.measure_grids(samples=64) == {"FINISHED"} and measuring.latest.grids["Floor"].facings is None
