"""Light groups that are dimmed to targets."""

import pytest


@pytest.mark.blender
def test_lights_are_dimmed_to_targets():
    import importlib

    import bpy
    import numpy
    import scenes

    scene, lamps = _two_lamps(bpy, scenes)
    measuring = importlib.import_module("gonio_extension.measuring")
    assert bpy.ops.gonio.measure_grids(samples=16) == {"FINISHED"}
    full = numpy.asarray(measuring.latest.grids["Desk.001"].values).mean()
    # The left lamp is photometric, the other has Blender's watts.
    bpy.ops.gonio.dim_lights(mean=0.75 * full, samples=16, is_applied=False)
    assert [lamp.data.energy for lamp in lamps] == [100.0, 100.0] and lamps[0].data.gonio.dimming == 1.0
    told = measuring.latest.levels
    assert told[0].startswith("Left: ") and told[1].startswith("Right: ") and "Desk.001.mean>=" in told[-1]
    assert bpy.ops.gonio.dim_lights(mean=0.75 * full, is_even=True, samples=16) == {"FINISHED"}
    assert lamps[0].data.gonio.dimming == pytest.approx(0.75, rel=1e-3) and lamps[1].data.energy == pytest.approx(75.0, rel=1e-3)
    assert bpy.ops.gonio.measure_grids(samples=16) == {"FINISHED"}
    assert numpy.asarray(measuring.latest.grids["Desk.001"].values).mean() == pytest.approx(0.75 * full, rel=1e-3)
    # What cannot be reached is told, and lights are as near as they come.
    assert bpy.ops.gonio.dim_lights(mean=10 * full, samples=16) == {"FINISHED"}
    assert measuring.latest.levels[-1].endswith("not met")
    with pytest.raises(RuntimeError, match="nothing measured is called 'Table'"):
        bpy.ops.gonio.dim_lights(mean=0.0, targets="Table.min>=100", samples=16)


@pytest.mark.blender
def test_lights_of_several_groups_are_left():
    import importlib

    import bpy
    import scenes

    scene, lamps = _two_lamps(bpy, scenes)
    lamps[1].data = lamps[0].data
    dimming = importlib.import_module("gonio_extension.dimming")
    report = importlib.import_module("gonio_extension.report").Report()
    dimming.apply(scene, {"Left": 0.5, "Right": 0.25}, report)
    assert lamps[0].data.gonio.dimming == 1.0
    assert any("single-user" in line.message for line in report.diagnostics)
    dimming.apply(scene, {"Left": 0.5, "Right": 0.5}, report)
    assert lamps[0].data.gonio.dimming == 0.5
    # Light of no group keeps its strength, as does a lamp that it shares.
    lamps[1].lightgroup = ""
    dimming.apply(scene, {"Left": 0.5}, report)
    assert lamps[0].data.gonio.dimming == 0.5
    scene.world.lightgroup = "Left"
    dimming.apply(scene, {"Left": 0.5}, report)
    assert any(line.kind == "World" for line in report.diagnostics)


def _two_lamps(bpy, scenes):
    scene = scenes.lit_floor()
    left = bpy.data.objects["Lamp"]
    left.location.x, left.lightgroup = -1.0, "Left"
    right = bpy.data.objects.new("Other", bpy.data.lights.new("Other", "POINT"))
    scene.collection.objects.link(right)
    right.location, right.lightgroup = (1.0, 0.0, 1.0), "Right"
    right.data.energy, right.data.shadow_soft_size = 100.0, 0.0
    left.data.gonio.use_photometry, left.data.gonio.unit, left.data.gonio.quantity = True, "LUMEN", 1000.0
    bpy.ops.mesh.primitive_plane_add(size=2.0, location=(0.25, 0, 0.1))
    desk = bpy.context.object
    desk.name = "Desk.001"
    desk.gonio.is_grid, desk.gonio.is_grid_only, desk.gonio.grid_spacing = True, True, 0.5
    scene.world = scene.world or bpy.data.worlds.new("World")
    return scene, [left, right]
