"""The command line: help, usage, what it says of stages, and comparing pictures."""

import json
import re

import numpy as np
import pictures
import pytest
from failures import fails

OPTIONS = """--purposes --complexity --mask --variant --session-layer --settings --strict --verbose --output --camera --frames --res --image-width
--res-scale --spp --max-bounces --integrator --filter --filter-width --aov --exposure --tonemap --crop --time-limit --seed --threads
--clamp-direct --clamp-indirect --half --disable-camera-light --list-cameras --quiet --noise-threshold --min-spp --checkpoint
--checkpoint-every --resume --samples --denoise --white --adaptation --color-space --light-samples --antialiasing --part --dask
--dask-parts --dask-send""".split()


def test_help_lists_every_option(run):
    done = run("render", "--help")
    assert done.returncode == 0 and done.stderr == ""
    for option in OPTIONS:
        assert re.search(rf"^ +(-\w, )?{option}\b", done.stdout, re.MULTILINE), option


@pytest.mark.parametrize("command", ["render", "merge", "info", "compare"])
def test_help_of_each_command(run, command):
    assert command in run("--help").stdout
    done = run(command, "-h")
    assert done.returncode == 0 and "Usage:" in done.stdout


def test_version_is_the_module_s(run):
    import gonio

    assert run("--version").stdout.strip() == f"gonio {gonio.__version__}"


@pytest.mark.parametrize("arguments", [[], ["paint"], ["render"], ["render", "a.usda", "--spp", "0"], ["render", "a.usda", "--nothing"]])
def test_wrong_usage_is_status_two(run, arguments):
    done = run(*arguments)
    assert done.returncode == 2 and "Usage" in done.stderr + done.stdout or "invalid value" in done.stderr


def test_info_as_text(run, room):
    done = run("info", room)
    assert done.returncode == 0 and done.stderr == ""
    for words in ("1 m a unit", "1 Mesh", "1 SphereLight", "camera /Cam", "light /Lamp: sphere 0.4 m across", "400 cd/m²", "materials"):
        assert words in done.stdout, words
    assert "emissive" not in done.stdout


def test_info_as_json(run, room):
    said = json.loads(run("info", room, "--json").stdout)
    assert said["metres_per_unit"] == 1 and said["up_axis"] == "Y" and said["cameras"] == ["/Cam"]
    assert said["prims"]["Mesh"] == 1 and said["instances"] == 3 and said["triangles"] > 14
    assert said["lights"][0]["path"] == "/Lamp" and "400 cd/m²" in said["lights"][0]["what"]
    assert said["bounds"][0] == pytest.approx([-3, 0, -3], abs=1e-4) and said["diagnostics"] == []


QUANTITIES = """
def SphereLight "Lamp" (prepend apiSchemas = ["LightAPI"])
{
    token gonio:photometry:unit = "lm"
    double gonio:photometry:quantity = 800
    color3f inputs:color = (1, 0.5, 0.25)
    float inputs:radius = 5
    double3 xformOp:translate = (100, 200, 300)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def RectLight "Panel"
{
    float inputs:width = 120
    float inputs:height = 60
    float inputs:intensity = 3200
}
def DistantLight "Sun"
{
    float inputs:angle = 0.5
    float inputs:intensity = 2
}
"""


def test_lights_as_numbers_with_units(run, tmp_path):
    stage = pictures.stage(tmp_path / "a.usda", QUANTITIES, pictures.camera(), metres=0.01)
    lamp, panel, sun = json.loads(run("info", stage, "--json").stdout)["lights"]
    assert (lamp["shape"], lamp["strength"], lamp["unit"], lamp["flux_lm"]) == ("sphere", 800, "lm", pytest.approx(800, rel=1e-3))
    assert lamp["size_m"] == pytest.approx([0.1] * 3) and lamp["position_m"] == pytest.approx([1, 2, 3])
    assert lamp["colour"][1] == pytest.approx(lamp["colour"][0] / 2) and np.dot(lamp["colour"], (0.2126, 0.7152, 0.0722)) == pytest.approx(1, rel=1e-3)
    assert (panel["shape"], panel["strength"], panel["unit"]) == ("rectangle", pytest.approx(3200), "cd/m²")
    assert panel["size_m"][:2] == pytest.approx([1.2, 0.6]) and panel["flux_lm"] == pytest.approx(3200 * np.pi * 1.2 * 0.6, rel=1e-3)
    assert (sun["shape"], sun["angle_deg"], sun["size_m"], sun["position_m"], sun["flux_lm"]) == ("distant", 0.5, None, None, None)
    assert (sun["strength"], sun["unit"], sun["seen_by_camera"]) == (2, "cd/m²", True)


SHINING = """
def Material "{name}"
{{
    token outputs:surface.connect = </{name}/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:emissiveColor = {colour}
        token outputs:surface
    }}
}}
def Sphere "Of{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    rel material:binding = </{name}>
}}
"""


def test_materials_that_shine_have_their_luminance(run, tmp_path):
    body = SHINING.format(name="Panel", colour=(300, 300, 300)) + SHINING.format(name="Dark", colour=(0, 0, 0))
    stage = pictures.stage(tmp_path / "a.usda", body + SHINING.format(name="Green", colour=(0, 10, 0)), pictures.camera())
    told = {each["path"]: each["luminance_cd_m2"] for each in json.loads(run("info", stage, "--json").stdout)["emissive_materials"]}
    assert told == {"/Panel": pytest.approx(300), "/Green": pytest.approx(7.152, rel=1e-3)}


@pytest.mark.parametrize("metres", [1, 0.01, 0.001])
def test_a_normalized_sun_is_told_in_lux_whatever_the_unit(run, tmp_path, metres):
    sun = 'def DistantLight "Sun"\n{\n    float inputs:angle = 0.53\n    float inputs:intensity = 50000\n    bool inputs:normalize = 1\n}\n'
    stage = pictures.stage(tmp_path / "a.usda", sun, pictures.camera(), metres=metres)
    (told,) = json.loads(run("info", stage, "--json").stdout)["lights"]
    assert (told["strength"], told["unit"]) == (pytest.approx(50000), "lx on a facing surface")
    for options in ((), ("--explain", "/Sun")):
        assert "50000 lx on a facing surface" in run("info", stage, *options).stdout


def test_parallel_light_has_no_luminance(run, tmp_path):
    sun = 'def DistantLight "Sun"\n{\n    float inputs:angle = 0\n    float inputs:intensity = 1000\n}\n'
    negative = 'def SphereLight "Taker"\n{\n    float inputs:intensity = -5\n    color3f inputs:color = (1, 0.5, 0.5)\n}\n'
    stage = pictures.stage(tmp_path / "a.usda", sun, negative, pictures.camera())
    told, taker = json.loads(run("info", stage, "--json").stdout)["lights"]
    assert (told["strength"], told["unit"]) == (pytest.approx(1000), "lx on a facing surface")
    assert taker["colour"][1] == pytest.approx(taker["colour"][0] / 2) and taker["colour"][0] > 0
    # It lights so much.
    done = run("measure", stage, "--at", "0,5,0", "--normal", "0,0,1", "--mask", "/Sun", "--json", "--spp", 16)
    assert json.loads(done.stdout)["meters"][0]["value"] == pytest.approx(1000, rel=1e-3), done.stderr


def test_a_mask_that_names_nothing_is_told(run, tmp_path):
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.camera())
    done = run("info", stage, "--mask", "/Typo")
    assert "the mask names a prim that is not there" in done.stdout + done.stderr and "/Typo" in done.stdout + done.stderr


def test_relationships_that_lead_nowhere_are_told(run, tmp_path):
    settings = (
        'def Scope "Render"\n{\n    def RenderSettings "S"\n    {\n        rel camera = </Gone>\n        rel products = [</Render/P>, </Render/Lost>]\n    }\n'
        '    def RenderProduct "P"\n    {\n        rel orderedVars = </Render/Vars/Missing>\n    }\n}\n'
    )
    lamp = 'def SphereLight "L" (prepend apiSchemas = ["CollectionAPI:lightLink"])\n{\n    rel collection:lightLink:includes = </Nobody>\n}\n'
    stage = pictures.stage(tmp_path / "a.usda", settings, lamp, pictures.ROOM, pictures.camera())
    stage.write_text(stage.read_text().replace("upAxis", 'renderSettingsPrimPath = "/Render/S"\n    upAxis', 1))
    told = [fault["message"] for fault in json.loads(run("info", stage, "--json").stdout)["diagnostics"]]
    for relationship, path in (
        ("camera", "/Gone"),
        ("products", "/Render/Lost"),
        ("orderedVars", "/Render/Vars/Missing"),
        ("collection:lightLink:includes", "/Nobody"),
    ):
        assert any(message.startswith(f"its {relationship} names <{path}>, which is not there") for message in told), (path, told)


@pytest.mark.parametrize("kind", ["displacement", "volume", "mtlx:displacement"])
def test_outputs_that_lead_nowhere_are_told(run, tmp_path, kind):
    surface = 'def Shader "S"\n{\n    uniform token info:id = "UsdPreviewSurface"\n    token outputs:surface\n}\n'
    outputs = f"token outputs:surface.connect = </M/S.outputs:surface>\n    token outputs:{kind}.connect = </M/Gone.outputs:out>\n"
    material = f'def Material "M"\n{{\n    {outputs}    {surface}}}\n'
    wall = (
        'def Mesh "W" (prepend apiSchemas = ["MaterialBindingAPI"])\n{\n    int[] faceVertexCounts = [3]\n    int[] faceVertexIndices = [0, 1, 2]\n'
        "    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n    rel material:binding = </M>\n}\n"
    )
    stage = pictures.stage(tmp_path / "a.usda", material, wall, pictures.camera())
    done = run("info", stage)
    told = f"its {kind.rpartition(':')[2]} is connected to </M/Gone.outputs:out>, which is not there"
    assert told in done.stdout + done.stderr, done.stdout + done.stderr


def test_info_of_a_frame_and_of_faults(run, tmp_path):
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.MOVING, pictures.camera(), pictures.BROKEN)
    said = json.loads(run("info", stage, "--json", "--frame", 3).stdout)
    assert "400 cd/m²" in said["lights"][0]["what"]
    assert [fault["origin"] for fault in said["diagnostics"]] == ["/Broken"]


def test_info_of_a_missing_file(run, tmp_path):
    assert "absent.usda" in fails(run, "info", tmp_path / "absent.usda")


def test_compare(run, picture, room, tmp_path):
    picture(room, "--seed", 1, name="a.exr", spp=8)
    picture(room, "--seed", 2, name="b.exr", spp=8)
    same_file = run("compare", tmp_path / "a.exr", tmp_path / "a.exr", "--max", 0)
    assert same_file.returncode == 0 and "relMSE" in same_file.stdout
    other = run("compare", tmp_path / "a.exr", tmp_path / "b.exr", "--max", 0)
    assert other.returncode == 1
    assert run("compare", tmp_path / "a.exr", tmp_path / "b.exr").returncode == 0
    assert run("compare", tmp_path / "a.exr", tmp_path / "b.exr", "--max", 10).returncode == 0
    drawn = run("compare", tmp_path / "a.exr", tmp_path / "b.exr", "--difference", tmp_path / "d.png")
    assert drawn.returncode == 0 and pictures.png_size(tmp_path / "d.png") == (32, 32)


def test_compare_chosen_channels(run, picture, room, tmp_path):
    picture(room, "--aov", "illuminance", name="a.exr")
    listed = run("compare", tmp_path / "a.exr", tmp_path / "a.exr", "--channels", "Illuminance,G").stdout
    assert "Illuminance" in listed and re.search(r"^G ", listed, re.MULTILINE) and not re.search(r"^R ", listed, re.MULTILINE)
    assert run("compare", tmp_path / "a.exr", tmp_path / "a.exr", "--channels", "X").returncode == 1


def test_compare_what_cannot_be_compared(run, picture, room, tmp_path):
    picture(room, name="a.exr")
    picture(room, name="b.exr", size=16)
    assert "32 x 32" in fails(run, "compare", tmp_path / "a.exr", tmp_path / "b.exr")
    assert "absent.exr" in fails(run, "compare", tmp_path / "absent.exr", tmp_path / "a.exr")
    (tmp_path / "bad.exr").write_bytes((tmp_path / "a.exr").read_bytes()[:200])
    assert "bad.exr" in fails(run, "compare", tmp_path / "bad.exr", tmp_path / "a.exr")
    (tmp_path / "text.exr").write_text("no picture")
    assert "text.exr" in fails(run, "compare", tmp_path / "a.exr", tmp_path / "text.exr")
