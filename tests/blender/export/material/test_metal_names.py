"""Metals, glasses and spectra that materials name: known by name, read from files, or told with the material."""

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


@pytest.mark.blender
def test_materials_name_glasses(tmp_path: Path):
    import bpy
    import scenes
    from recorder import depsgraph, exporter

    scenes.lit_floor()
    material = bpy.data.materials.new("Clear")
    material.use_nodes = True
    tree = material.node_tree
    shader = tree.nodes.new("ShaderNodeBsdfGlass")
    tree.links.new(shader.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    bpy.data.objects["Floor"].data.materials.clear()
    bpy.data.objects["Floor"].data.materials.append(material)
    (tmp_path / "glass.csv").write_text("\n".join(f"{nm},{1.5 + 4000 / nm**2}" for nm in range(380, 781, 10)), encoding="utf-8")

    def found(glass):
        material.gonio.glass = glass
        made, report = exporter()
        (described,) = [each for each in made.sync(depsgraph()).materials if each["origin"]["name"] == "Clear"]
        return described["closures"][0], [line.text for line in report.diagnostics if line.material == "Clear"]

    closure, told = found("BK7")
    assert closure["glass"]["name"] == "N-BK7" and "k" not in closure["glass"] and not told
    closure, told = found(str(tmp_path / "glass.csv"))
    assert len(closure["glass"]["n"]) == 41 and not told
    closure, told = found("unobtainium")
    assert "glass" not in closure and any("keeps its index" in text for text in told)
