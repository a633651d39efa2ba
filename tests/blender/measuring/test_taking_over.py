"""What Gonio takes over from what stands in a file: a lamp's power, a luminaire's flux, furniture to measure on."""

from pathlib import Path

import pytest

IES = """IESNA:LM-63-2002
TILT=NONE
1 2000 1 3 1 1 2 0 0 0
1 1 10
0 90 180
0
100 100 100
"""


@pytest.mark.blender
def test_a_lamp_is_as_bright_in_photometric_units_as_in_watts(tmp_path: Path):
    import math

    import bpy
    import scenes

    def area(lamp):
        lamp.shape, lamp.size, lamp.size_y = "ELLIPSE", 0.2, 0.1

    def spot(lamp):
        lamp.spot_size, lamp.spot_blend = math.radians(70.0), 0.6

    def coloured(lamp):
        lamp.color, lamp.exposure = (1.0, 0.5, 0.25), 1.0

    kinds = {
        "POINT": ("POINT", "LUMEN", lambda lamp: None),
        "bulb": ("POINT", "LUMEN", lambda lamp: setattr(lamp, "shadow_soft_size", 0.1)),
        "AREA": ("AREA", "LUMEN", area),
        "SPOT": ("SPOT", "LUMEN", spot),
        "SUN": ("SUN", "LUX", lambda lamp: setattr(lamp, "energy", 5.0)),
        "coloured": ("POINT", "LUMEN", coloured),
    }
    for name, (kind, unit, change) in kinds.items():
        scene = scenes.lit_floor(samples=256, width=16, height=16)
        scene.view_layers[0].gonio.use_pass_illuminance = True
        scene.camera.data.ortho_scale = 0.02
        bpy.data.objects["Lamp"].data.type = kind
        lamp = bpy.data.objects["Lamp"].data
        change(lamp)
        found = []
        for settings_on in (False, True):
            lamp.gonio.use_photometry = settings_on
            scenes.render(tmp_path / "a.exr")
            found.append(float(scenes.read(tmp_path / "a.exr")["ViewLayer.Illuminance.X"].mean()))
        assert lamp.gonio.unit == unit and found[1] == pytest.approx(found[0], rel=0.01), (name, found)
    assert lamp.gonio.quantity == pytest.approx(100.0 * 2.0 * 177.83 * (0.2126 + 0.5 * 0.7152 + 0.25 * 0.0722), rel=1e-5)


@pytest.mark.blender
def test_only_a_strength_that_nobody_stated_is_taken_over(tmp_path: Path):
    import bpy

    (tmp_path / "lamp.ies").write_text(IES)
    lamp = bpy.data.lights.new("Lamp", "POINT")
    settings = lamp.gonio
    lamp.energy = 10.0
    settings.use_photometry = True
    assert settings.quantity == pytest.approx(1778.3)
    # Other watts, other lumens, as long as nobody has touched them.
    settings.use_photometry, lamp.energy = False, 20.0
    settings.use_photometry = True
    assert settings.quantity == pytest.approx(3556.6)
    # The file's flux: 100 cd all around.
    settings.file = str(tmp_path / "lamp.ies")
    assert settings.unit == "FILE" and settings.quantity == pytest.approx(400.0 * 3.14159265, rel=1e-4)
    settings.unit, settings.quantity, settings.file = "LUMEN", 500.0, ""
    settings.file = str(tmp_path / "lamp.ies")
    settings.use_photometry = False
    settings.use_photometry = True
    assert (settings.unit, settings.quantity) == ("LUMEN", 500.0)
    # A file that cannot be read takes nothing away.
    other = bpy.data.lights.new("Other", "POINT").gonio
    other.use_photometry, other.file = True, str(tmp_path / "none.ies")
    assert other.unit == "LUMEN" and other.quantity > 0.0


@pytest.mark.blender
def test_grids_lie_on_tops_of_furniture(tmp_path: Path):
    import importlib
    import math

    import bpy
    import numpy
    import scenes

    scenes.lit_floor()
    measuring = importlib.import_module("gonio_extension.measuring")
    # A box of 1 × 2 m, its top half a metre below the lamp, and a table of a plate over four legs, turned and mirrored.
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=(0, 0, 0.25))
    box = bpy.context.object
    box.name, box.scale = "Box", (1.0, 2.0, 0.5)
    box.gonio.is_grid, box.gonio.grid_spacing = True, 0.5
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=(0, 0, 0.68))
    plate = bpy.context.object
    plate.scale = (1.2, 0.8, 0.04)
    bpy.ops.object.transform_apply(location=True, scale=True)
    for x, y in ((-1, -1), (-1, 1), (1, -1), (1, 1)):
        bpy.ops.mesh.primitive_cube_add(size=1.0, location=(0.55 * x, 0.35 * y, 0.33))
        bpy.context.object.scale = (0.06, 0.06, 0.66)
    for each in bpy.context.view_layer.objects:
        each.select_set(each.name.startswith("Cube"))
    bpy.context.view_layer.objects.active = plate
    bpy.ops.object.join()
    plate.name, plate.location, plate.rotation_euler.z, plate.scale.x = "Table", (6.0, 0.0, 0.0), 0.3, -1.0
    plate.gonio.is_grid, plate.gonio.grid_spacing = True, 0.2
    assert bpy.ops.gonio.measure_grids(samples=256) == {"FINISHED"}
    readings = measuring.latest.grids
    assert set(readings) == {"Box", "Table"} and readings["Box"].size in ((2, 4), (4, 2)) and readings["Table"].size in ((6, 4), (4, 6))
    positions, values = numpy.asarray(readings["Box"].positions), numpy.asarray(readings["Box"].values).ravel()
    assert positions[:, 2] == pytest.approx(0.5, abs=1e-3)
    across = numpy.hypot(positions[:, 0], positions[:, 1])
    expected = 100.0 / (4.0 * math.pi) * scenes.LUMENS_PER_WATT * 0.5 / (across**2 + 0.25) ** 1.5
    assert numpy.allclose(values, expected, rtol=5e-3), (values, expected)
    assert numpy.asarray(readings["Table"].positions)[:, 2] == pytest.approx(0.7, abs=1e-3)
