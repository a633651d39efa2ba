"""Spectra of lamps, and the switch for light with wavelengths."""

from pathlib import Path

import pytest


@pytest.mark.blender
def test_a_lamp_shines_by_its_spectrum(tmp_path: Path):
    import bpy
    import gonio
    import scenes

    def colour(*, spectral: bool):
        scene = scenes.lit_floor(samples=256, width=16, height=16)
        scene.gonio.spectral = spectral
        lamp = bpy.data.objects["Lamp"].data
        lamp.gonio.use_photometry = True
        lamp.gonio.spectrum = "LED-B1"
        scenes.render(tmp_path / "a.exr")
        layers = scenes.read(tmp_path / "a.exr")
        return [float(layers[f"ViewLayer.Combined.{channel}"].mean()) for channel in "RGB"]

    plain, spectral = (colour(spectral=spectral) for spectral in (False, True))
    assert spectral == pytest.approx(plain, rel=0.03)
    # Warm white: its chromaticity by the CIE's tables.
    figures = gonio.illuminant("LED-B1")
    found = gonio.spectrum_figures(figures["wavelengths_nm"], figures["power"])
    red, green, blue = plain
    sums = [0.4124 * red + 0.3576 * green + 0.1805 * blue, 0.2126 * red + 0.7152 * green + 0.0722 * blue, 0.0193 * red + 0.1192 * green + 0.9505 * blue]
    assert sums[0] / sum(sums) == pytest.approx(found["x"], abs=0.01)


@pytest.mark.blender
def test_what_is_no_spectrum_is_told_with_the_lamp(tmp_path: Path):
    import scenes
    from recorder import depsgraph, exporter

    scene = scenes.lit_floor()
    settings = next(thing for thing in scene.objects if thing.type == "LIGHT").data.gonio
    settings.use_photometry, settings.unit, settings.quantity = True, "CANDELA", 800.0
    settings.spectrum = str(tmp_path / "missing.spdx")
    made, report = exporter()
    light = made.sync(depsgraph()).lights[0]
    assert light["spectrum"] is None
    assert any("missing.spdx" in each.text and "keeps its colour" in each.text for each in report.diagnostics)
    settings.spectrum = "FL11"
    made, report = exporter()
    assert made.sync(depsgraph()).lights[0]["spectrum"]["name"] == "CIE FL11" and not report.diagnostics


@pytest.mark.blender
def test_files_that_are_no_spectrum_are_told_with_their_line(tmp_path: Path):
    import scenes
    from recorder import depsgraph, exporter

    scene = scenes.lit_floor()
    settings = next(thing for thing in scene.objects if thing.type == "LIGHT").data.gonio
    settings.use_photometry = True
    for name, text, message in (
        ("lamp.csv", "0.38,1\n0.48,1\n0.58,1\n0.68,1\n0.78,1\n", "lamp.csv:1: "),
        ("few.csv", "380,1\n480,1\n", "few.csv:1: 2 points"),
        ("bomb.spdx", "<!DOCTYPE l [<!ENTITY a 'b'>]><IESTM2714>&a;</IESTM2714>", "bomb.spdx:1: not XML"),
        ("folder", None, "folder' was found, expected one of A, E"),
    ):
        (tmp_path / name).mkdir() if text is None else (tmp_path / name).write_text(text)
        settings.spectrum = str(tmp_path / name)
        made, report = exporter()
        assert made.sync(depsgraph()).lights[0]["spectrum"] is None
        (told,) = [each.text for each in report.diagnostics]
        assert message in told and "keeps its colour" in told


@pytest.mark.blender
def test_a_material_shines_by_its_spectrum(tmp_path: Path):
    import bpy
    import scenes
    from recorder import depsgraph, exporter

    def colour(name):
        scene = scenes.lit_floor(samples=64, width=16, height=16)
        bpy.data.objects.remove(bpy.data.objects["Lamp"])
        bpy.ops.mesh.primitive_plane_add(size=1.0, location=(0.0, 0.0, 2.0), rotation=(3.14159265, 0.0, 0.0))
        material = bpy.data.materials.new("Glow")
        material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        emission, end = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
        emission.inputs["Strength"].default_value = 20.0
        tree.links.new(emission.outputs[0], end.inputs["Surface"])
        material.gonio.spectrum = name
        bpy.context.object.data.materials.append(material)
        bpy.context.object.visible_camera = False
        scenes.render(tmp_path / "a.exr")
        layers = scenes.read(tmp_path / "a.exr")
        return [float(layers[f"ViewLayer.Combined.{channel}"].mean()) for channel in "RGB"]

    plain, warm = (colour(name) for name in ("", "LED-B1"))
    luminance = [sum(weight * part for weight, part in zip((0.2126, 0.7152, 0.0722), found, strict=True)) for found in (plain, warm)]
    assert luminance[1] == pytest.approx(luminance[0], rel=0.01) and luminance[0] > 0.0
    assert plain[0] == pytest.approx(plain[2], rel=0.01) and warm[0] > 2 * warm[2]
    bpy.data.materials["Glow"].gonio.spectrum = "no such lamp"
    made, report = exporter()
    assert [material["spectrum"] for material in made.sync(depsgraph()).materials if "spectrum" in material] == [None]
    assert any("no such lamp" in each.text and "keeps its colour" in each.text for each in report.diagnostics)


@pytest.mark.blender
def test_a_luminaires_file_brings_its_spectrum(tmp_path: Path):
    """A TM-33 file's spectrum stands on the exported light; the lamp's own setting comes first."""
    import gonio
    import scenes
    from recorder import depsgraph, exporter

    lamp = gonio.illuminant("LED-B3")
    grid = "".join(f'<IntData h="0" v="{v}">100</IntData>' for v in (0, 90, 180))
    rows = "".join(f'<PwrData w="{nm}">{power}</PwrData>' for nm, power in zip(lamp["wavelengths_nm"], lamp["power"], strict=True))
    data = f"<LuminousData><LuminousIntensity>{grid}</LuminousIntensity></LuminousData><SpectralData><EmitterSpectral>{rows}</EmitterSpectral></SpectralData>"
    path = tmp_path / "lamp.xml"
    path.write_text(f"<IESTM33-22><Emitter><Description>lamp</Description>{data}</Emitter></IESTM33-22>")
    scene = scenes.lit_floor(samples=256, width=16, height=16)
    settings = next(thing for thing in scene.objects if thing.type == "LIGHT").data.gonio
    settings.use_photometry, settings.unit, settings.file = True, "FILE", str(path)
    made, report = exporter()
    [light] = made.sync(depsgraph()).lights
    assert not report.diagnostics and "spectrum" not in light
    assert light["goniogram"]["spectrum"]["wavelengths_nm"] == pytest.approx(lamp["wavelengths_nm"])

    def red_over_blue(*, spectral: bool):
        scene.gonio.spectral = spectral
        scenes.render(tmp_path / "a.exr")
        layers = scenes.read(tmp_path / "a.exr")
        return float(layers["ViewLayer.Combined.R"].mean() / layers["ViewLayer.Combined.B"].mean())

    assert red_over_blue(spectral=False) == pytest.approx(1.0, abs=1e-3)
    warm = red_over_blue(spectral=True)
    settings.spectrum = "LED-B3"
    assert warm == pytest.approx(red_over_blue(spectral=True), rel=0.02) and warm > 1.5
