"""Glare of lamps with pictures over them, and of luminaires whose prims are scaled: UGR, GR, and intensities."""

import json
from pathlib import Path

import pytest
from pictures import write_png

HEAD = '#usda 1.0\n(\n    upAxis = "Z"\n    metersPerUnit = 1\n)\n'
FLOOR = """def Mesh "Floor"
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-5, -5, 0), (5, -5, 0), (5, 5, 0), (-5, 5, 0)]
}
"""
LAMP = """def RectLight "NAME"
{
    float inputs:width = 0.5
    float inputs:height = 0.5
    float inputs:intensity = NITS
    PICTURE
    token gonio:lightGroup = "Emergency"
    double3 xformOp:translate = (0, Y, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
PICTURE = "asset inputs:texture:file = @./picture.png@"


def picture(folder: Path, levels):
    """Columns of these levels, 0 or 255, which are the same in every encoding."""
    write_png(folder / "picture.png", [[[level] * 3 for level in levels]] * 4)


def lamp(name, y, nits=5000.0, pictured=False):
    text = LAMP.replace("NAME", name).replace("NITS", str(nits)).replace("Y,", f"{y},")
    return text.replace("PICTURE", PICTURE if pictured else "")


def ugr(run, folder, lamps):
    (folder / "room.usda").write_text(HEAD + FLOOR + lamps)
    done = run("measure", str(folder / "room.usda"), "--at", "0,0,1.2", "--facing", "0,1,0", "--quantity", "ugr", "--spp", "256", "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)["meters"][0]


def test_a_lamp_is_rated_by_the_mean_of_its_picture(tmp_path, run):
    picture(tmp_path, [255] * 4)
    plain = ugr(run, tmp_path, lamp("A", 3) + lamp("B", 4.5))
    white = ugr(run, tmp_path, lamp("A", 3, pictured=True) + lamp("B", 4.5))
    assert white["value"] == pytest.approx(plain["value"], abs=0.05) and white["ugr_coverage"] == plain["ugr_coverage"]
    picture(tmp_path, [255, 0, 255, 0])
    half = ugr(run, tmp_path, lamp("A", 3, pictured=True) + lamp("B", 4.5))
    dimmed = ugr(run, tmp_path, lamp("A", 3, nits=2500.0) + lamp("B", 4.5))
    assert half["value"] == pytest.approx(dimmed["value"], abs=0.15)


def test_sports_rate_it_too(tmp_path, run):
    (tmp_path / "plan.toml").write_text(
        '[[field]]\nname = "Court"\ncorner = [-1, 0, 0]\nalong = [2, 0, 0]\nacross = [0, 2, 0]\npoints = [3, 3]\n'
        '[[observer]]\nname = "Player"\nposition = [0, 0, 1.2]\n'
    )
    picture(tmp_path, [255] * 4)
    found = []
    for pictured in (False, True):
        (tmp_path / "room.usda").write_text(HEAD + FLOOR + lamp("A", 3, pictured=pictured) + lamp("B", 4.5))
        done = run("sports", str(tmp_path / "room.usda"), "--plan", str(tmp_path / "plan.toml"), "--json")
        assert done.returncode == 0, done.stderr
        found.append(json.loads(done.stdout)["observers"][0])
    assert json.dumps(found[1]) == json.dumps(found[0])


def test_emergency_knows_no_intensity_of_pictures(tmp_path, run):
    (tmp_path / "plan.toml").write_text('groups = ["Emergency"]\n[[place]]\nname = "p"\nposition = [0, 3, 0]\nfacing = [0, 0, 1]\n')
    picture(tmp_path, [255] * 4)
    (tmp_path / "room.usda").write_text(HEAD + FLOOR + lamp("A", 3, pictured=True))
    command = ["emergency", str(tmp_path / "room.usda"), "--plan", str(tmp_path / "plan.toml")]
    done = run(*command, "--json")
    assert done.returncode == 0, done.stderr
    (lit,) = json.loads(done.stdout)["luminaires"]
    assert lit["name"] == "/A" and lit["peak_cd"] is None
    assert "unknown" in run(*command).stdout


IES = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 0.6 0.6 0\n1 1 10\n0 45 90\n0\n900 700 100\n"
SCALED = """def SphereLight "Lamp"
{
    asset gonio:photometry:file = @./lamp.ies@
    double3 xformOp:translate = (0, 3, 3)
    float3 xformOp:scale = (S, S, S)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:scale"]
}
"""


@pytest.mark.parametrize("scale", [0.01, 100.0])
def test_scales_of_prims_leave_openings_of_files_alone(tmp_path, run, scale):
    """Assets in centimetres come with a scale; neither candela nor metres of a luminaire's file follow it."""
    (tmp_path / "lamp.ies").write_text(IES)
    plain, scaled = (ugr(run, tmp_path, SCALED.replace("S, S, S", f"{s}, {s}, {s}")) for s in (1.0, scale))
    assert scaled["value"] == pytest.approx(plain["value"], abs=0.05) and plain["value"] > 10
