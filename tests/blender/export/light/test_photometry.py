"""The Photometry panel's settings: what a lamp sends, and what the panel shows."""

from pathlib import Path

import pytest

IES = """IESNA:LM-63-2002
TILT=NONE
1 2000 1 3 1 1 2 {size}
1 1 10
0 90 180
0
100 100 100
"""


@pytest.mark.blender
def test_lux_under_lamps_in_all_units(tmp_path: Path):
    import math

    import scenes

    scene = scenes.lit_floor(samples=64)
    scene.view_layers[0].gonio.use_pass_illuminance = True
    scene.camera.data.ortho_scale = 0.02
    lamp = next(thing for thing in scene.objects if thing.type == "LIGHT")
    data, settings = lamp.data, lamp.data.gonio
    settings.use_photometry = True
    # The colour and Blender's power are not part of it.
    data.color, data.energy = (1.0, 0.3, 0.1), 12345.0

    def lux():
        scenes.render(tmp_path / "a.exr")
        return float(scenes.read(tmp_path / "a.exr")["ViewLayer.Illuminance.X"].mean())

    def check(expected, relative=3e-3, **fields):
        for name, value in fields.items():
            setattr(settings, name, value)
        found = lux()
        assert math.isclose(found, expected, rel_tol=relative), (fields, found, expected)

    check(7.958, unit="LUMEN", quantity=100.0)
    check(30.0, unit="CANDELA", quantity=30.0)
    check(120.0, unit="LUX", quantity=30.0, distance=2.0)
    check(177.83 / (4 * math.pi), unit="WATT", quantity=1.0)
    check(3.0, unit="CANDELA", quantity=30.0, dimming=0.2, maintenance=0.5)
    settings.dimming = settings.maintenance = 1.0
    data.type = "AREA"
    lamp.data.shape, lamp.data.size = "SQUARE", 0.01
    settings = lamp.data.gonio
    check(31.83, unit="LUMEN", quantity=100.0)
    check(1000.0 * 1e-4, unit="NIT", quantity=1000.0)
    settings.is_tube = True
    # A tube's intensity across its axis is its flux over pi squared.
    check(100.0 / math.pi**2, relative=0.02, unit="LUMEN", quantity=100.0)
    lamp.data.type = "POINT"
    settings = lamp.data.gonio
    check(100.0 * 4.0 / (2.0 * math.pi), unit="LUMEN", quantity=100.0, cosine_power=3.0)
    lamp.data.type = "SUN"
    settings = lamp.data.gonio
    check(5000.0, unit="LUX", quantity=5000.0)
    settings.quantity = 0.0
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    scene.world.gonio.use_luminance, scene.world.gonio.luminance = True, 500.0
    check(500.0 * math.pi, relative=0.01)


@pytest.mark.blender
def test_luminaires_and_their_openings(tmp_path: Path):
    import math

    import bpy
    import numpy
    import scenes

    (tmp_path / "lamp.ies").write_text(IES.format(size="0.05 0.1 0"))
    scene = scenes.lit_floor(samples=256)
    scene.view_layers[0].gonio.use_pass_illuminance = True
    scene.camera.data.ortho_scale = 0.02
    lamp = next(thing for thing in scene.objects if thing.type == "LIGHT")
    lamp.scale = (3.0, 3.0, 3.0)
    settings = lamp.data.gonio
    settings.use_photometry, settings.unit, settings.file = True, "FILE", str(tmp_path / "lamp.ies")

    def lux():
        scenes.render(tmp_path / "a.exr")
        return float(scenes.read(tmp_path / "a.exr")["ViewLayer.Illuminance.X"].mean())

    def exported():
        from recorder import exporter

        made, report = exporter()
        light = made.sync(bpy.context.evaluated_depsgraph_get()).lights[0]
        assert not report.diagnostics, [str(each) for each in report.diagnostics]
        return light

    for opening, shape in (("FILE", "Box or Rectangle"), ("POINT", "Point"), ("LIGHT", "Point")):
        settings.opening = opening
        light = exported()
        assert light["quantity"] == "Measured"
        if shape == "Point":
            assert light["shape"] == "Point" or light["shape"]["Opening"]["shape"] == "Point"
        else:
            assert light["shape"]["Opening"]["shape"] == "Rectangle"
            assert light["shape"]["Opening"]["size"] == [0.1, 0.05, 0.0]
        assert math.isclose(lux(), 100.0, rel_tol=0.01), opening
    settings.opening, settings.rotation = "FILE", math.radians(90)
    columns = numpy.array(exported()["transform"]["columns"])
    assert numpy.allclose(columns[:3], [[0, 1, 0], [-1, 0, 0], [0, 0, 1]], atol=1e-6)
    settings.unit, settings.quantity = "LAMP_LUMEN", 1000.0
    assert math.isclose(lux(), 50.0, rel_tol=0.01)
    settings.unit, settings.quantity = "LUMEN", 400.0 * math.pi
    assert math.isclose(lux(), 100.0, rel_tol=0.01)


@pytest.mark.blender
def test_files_that_are_not_there_are_reported(tmp_path: Path):
    import scenes
    from recorder import depsgraph, exporter

    scene = scenes.lit_floor()
    settings = next(thing for thing in scene.objects if thing.type == "LIGHT").data.gonio
    settings.use_photometry, settings.unit, settings.quantity = True, "CANDELA", 800.0
    settings.file = str(tmp_path / "none.ies")
    made, report = exporter()
    light = made.sync(depsgraph()).lights[0]
    assert light["goniogram"] is None and light["quantity"] == {"Candela": 800.0}
    assert any("none.ies" in each.text and "uniform" in each.text for each in report.diagnostics)
    for unit in ("FILE", "LAMP_LUMEN"):
        settings.unit = unit
        made, report = exporter()
        made.sync(depsgraph())
        assert any("none.ies" in each.text and "dark" in each.text for each in report.diagnostics)


@pytest.mark.blender
def test_tilt_factors_that_change_beside_their_luminaire(tmp_path: Path):
    import importlib

    import bpy
    import gonio

    luminaire = importlib.import_module("gonio_extension.luminaire")
    tilted = IES.replace("TILT=NONE", "tilt = lamp.tlt").format(size="0 0 0")
    (tmp_path / "lamp.ies").write_text(tilted)
    light = bpy.data.lights.new("Lamp", "POINT")
    light.gonio.use_photometry, light.gonio.file, light.gonio.tilt = True, str(tmp_path / "lamp.ies"), 1.5707963

    def straight_down():
        return luminaire.figures(light)["cuts"][0][0][1]

    found = {}
    for factor in ("0.5", "0.25"):
        (tmp_path / "lamp.tlt").write_text(f"1\n2\n0 90\n1 {factor}\n")
        found[factor] = straight_down()
    assert abs(found["0.5"] - 2.0 * found["0.25"]) < 1e-6 * found["0.5"] and found["0.25"] > 0.0, found
    (tmp_path / "lamp.tlt").unlink()
    with pytest.raises(gonio.FormatError, match="no tilt factors"):
        straight_down()


@pytest.mark.blender
def test_portals_have_no_photometry(tmp_path: Path):
    import scenes
    from recorder import depsgraph, exporter

    (tmp_path / "lamp.ies").write_text(IES.format(size="0.05 0.1 0"))
    lamp = next(thing for thing in scenes.lit_floor().objects if thing.type == "LIGHT")
    lamp.data.type = "AREA"
    settings = lamp.data.gonio
    settings.use_photometry, settings.file, settings.is_tube, settings.is_portal = True, str(tmp_path / "lamp.ies"), True, True
    made, _ = exporter()
    light = made.sync(depsgraph()).lights[0]
    assert light["portal"] and "Rectangle" in light["shape"] and light["goniogram"] is None and "quantity" not in light


@pytest.mark.blender
def test_the_polar_diagram_is_drawn(tmp_path: Path):
    import importlib

    import numpy
    import scenes

    (tmp_path / "lamp.ies").write_text(IES.format(size="0 0 0").replace("100 100 100", "100 50 0"))
    scene = scenes.lit_floor()
    lamp = next(thing for thing in scene.objects if thing.type == "LIGHT").data
    lamp.gonio.use_photometry, lamp.gonio.file = True, str(tmp_path / "lamp.ies")
    picture = importlib.import_module("gonio_extension.ui.polar_picture")
    cuts = importlib.import_module("gonio_extension.luminaire").figures(lamp)["cuts"]
    pixels = picture.drawn(tuple(tuple(map(tuple, cut)) for cut in cuts))
    red = (pixels[..., 0] > 0.8) & (pixels[..., 2] < 0.4) & (pixels[..., 3] > 0.9)
    rows, columns = numpy.nonzero(red)
    # The peak is nadir, at the bottom; half of it to both sides; nothing up.
    assert rows.min() < 16 and abs(columns[rows.argmin()] - 128) < 8
    middle = numpy.nonzero(red[127:129].any(axis=0))[0]
    assert abs((middle.max() - middle.min()) - 118) < 6
    assert rows.max() < 134


@pytest.mark.blender
def test_light_groups_are_passes_that_sum_up(tmp_path: Path):
    import bpy
    import numpy
    import scenes

    scene = scenes.lit_floor(samples=16)
    layer = scene.view_layers[0]
    lamp = next(thing for thing in scene.objects if thing.type == "LIGHT")
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.2, 0.3, 0.5, 1.0)
    for name in ("Lamps", "Sky", "other"):
        group = layer.lightgroups.add()
        group.name = name
    lamp.lightgroup, scene.world.lightgroup = "Lamps", "Sky"
    bpy.ops.mesh.primitive_plane_add(size=0.5, location=(0.3, 0, 0.5))
    glow = bpy.data.materials.new("Glow")
    glow.use_nodes = True
    tree = glow.node_tree
    tree.nodes.clear()
    emission, output = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    bpy.context.object.data.materials.append(glow)
    scenes.render(tmp_path / "a.exr")
    channels = scenes.read(tmp_path / "a.exr")
    for colour in "RGB":
        parts = [channels[f"ViewLayer.Combined_{name}.{colour}"] for name in ("Lamps", "Sky", "other")]
        assert all(part.max() > 0.0 for part in parts), colour
        combined = channels[f"ViewLayer.Combined.{colour}"]
        assert numpy.abs(sum(parts) - combined).max() <= 1e-5 * combined.max()


@pytest.mark.blender
def test_a_stage_fixture_is_a_luminaire(tmp_path: Path):
    import importlib
    import math
    import zipfile

    import bpy
    import scenes

    description = """<GDTF DataVersion="1.2"><FixtureType Name="Head"><Geometries><Beam Name="Beam" LuminousFlux="12000" BeamAngle="20"
FieldAngle="40"/></Geometries><DMXModes><DMXMode Name="Standard" Geometry="Beam"/></DMXModes></FixtureType></GDTF>"""
    with zipfile.ZipFile(tmp_path / "head.gdtf", "w") as archive:
        archive.writestr("description.xml", description)
    scenes.empty()
    bpy.ops.object.light_add(type="POINT")
    data = bpy.context.object.data
    data.gonio.use_photometry = True
    data.gonio.file = str(tmp_path / "head.gdtf")
    figures = importlib.import_module("gonio_extension.luminaire").figures(data)
    assert math.isclose(figures["flux_lm"], 12000, rel_tol=1e-4) and math.isclose(figures["field_angle_deg"][0], 40, rel_tol=1e-4), figures
