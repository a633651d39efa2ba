"""The command line: what of a stage is read, and warnings."""

import json

import numpy as np
import pictures
import pytest
from failures import fails


def test_purposes(picture, tmp_path):
    guide = 'def Cube "Guide"\n{\n    uniform token purpose = "guide"\n    double size = 3\n}\n'
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), guide)
    usual = picture(stage, "--aov", "depth", name="usual.exr")
    assert not pictures.same(usual, picture(stage, "--aov", "depth", "--purposes", "render,guide", name="guide.exr"))
    assert pictures.same(usual, picture(stage, "--aov", "depth", "--purposes", "default,proxy", name="proxy.exr"))


def test_unknown_purpose(run, room, tmp_path):
    assert "purposes" in fails(run, "render", room, "-o", tmp_path / "a.exr", "--purposes", "final")


def test_mask(picture, room):
    image = picture(room, "--mask", "/Floor,/Lamp,/Cam", "--aov", "P", "--filter", "box", "--filter-width", 0.01)
    assert np.abs(image["P.Y"]).max() < 1e-4


def test_variant(picture, run, tmp_path):
    text = """
def Xform "Choice" (
    variants = { string shape = "none" }
    prepend variantSets = "shape"
)
{
    variantSet "shape" = {
        "none" { }
        "big" {
            def Cube "Big"
            {
                double size = 3
            }
        }
    }
}
"""
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), text)
    assert not pictures.same(picture(stage, name="a.exr"), picture(stage, "--variant", "/Choice{shape=big}", name="b.exr"))
    assert "variant" in fails(run, "render", stage, "-o", tmp_path / "c.exr", "--variant", "shape=big")


def test_session_layer(picture, room, tmp_path):
    layer = tmp_path / "dim.usda"
    layer.write_text('#usda 1.0\nover "Lamp"\n{\n    float inputs:intensity = 200\n}\n')
    plain, dim = picture(room, name="a.exr"), picture(room, "--session-layer", layer, name="b.exr")
    assert dim["G"] == pytest.approx(plain["G"] / 2, rel=1e-4)
    assert pictures.same(dim, picture(room, "--sessionLayer", layer, name="c.exr"))


def test_complexity_refines(run, tmp_path):
    cube = """
def Mesh "Cube"
{
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]
    point3f[] points = [(-1, -1, -1), (1, -1, -1), (-1, 1, -1), (1, 1, -1), (-1, -1, 1), (1, -1, 1), (-1, 1, 1), (1, 1, 1)]
}
"""
    stage = pictures.stage(tmp_path / "a.usda", cube)
    counts = [json.loads(run("info", stage, "--json", "--complexity", level).stdout)["triangles"] for level in ("low", "medium", "high", "veryhigh")]
    assert counts == [12, 48, 192, 768]


def test_warnings_name_the_prim_and_are_fatal_with_strict(run, tmp_path):
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), pictures.BROKEN)
    done = run("render", stage, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1)
    assert done.returncode == 0 and "gonio: warning: " in done.stderr and "/Broken" in done.stderr
    strict = run("render", stage, "-o", tmp_path / "b.exr", "--res", 8, 8, "--spp", 1, "--strict")
    assert strict.returncode == 1 and "/Broken" in strict.stderr and not (tmp_path / "b.exr").exists()


def test_strict_passes_a_faultless_stage(run, room, tmp_path):
    done = run("render", room, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1, "--strict")
    assert done.returncode == 0, done.stderr


def test_many_warnings_are_cut_short_without_verbose(run, tmp_path):
    many = "".join(pictures.BROKEN.replace("Broken", f"Broken{k}") for k in range(30))
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), many)
    brief = run("render", stage, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1).stderr
    assert brief.count("gonio: warning: ") == 20 and "10 more" in brief
    assert run("render", stage, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1, "-v").stderr.count("gonio: warning: ") == 30
