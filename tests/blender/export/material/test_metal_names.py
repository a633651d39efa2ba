"""Metals and spectra that materials name: known by name, read from files, or told with the material."""

from pathlib import Path

import pytest


@pytest.mark.blender
def test_materials_name_metals_and_spectra(tmp_path: Path):
    import bpy
    import scenes
    from recorder import depsgraph, exporter

    scenes.lit_floor()
    material = bpy.data.materials.new("Named")
    material.use_nodes = True
    bpy.data.objects["Floor"].data.materials.clear()
    bpy.data.objects["Floor"].data.materials.append(material)
    (tmp_path / "lamp.csv").write_text("\n".join(f"{nm},1" for nm in range(380, 781, 10)), encoding="utf-8")

    def found(metal, spectrum):
        material.gonio.metal, material.gonio.spectrum = metal, spectrum
        made, report = exporter()
        (described,) = [each for each in made.sync(depsgraph()).materials if each["origin"]["name"] == "Named"]
        return described, report.diagnostics

    described, told = found("gold", str(tmp_path / "lamp.csv"))
    assert described["closures"][0]["metal"]["name"] and len(described["spectrum"]["power"]) == 41
    described, told = found("unobtainium", "no such lamp")
    assert "metal" not in described["closures"][0] and described["spectrum"] is None
    assert {line.material for line in told if "keeps its colour" in line.text} == {"Named"} and len(told) >= 2
