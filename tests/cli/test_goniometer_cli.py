"""`gonio goniometer`: a luminaire of a stage, its files, and what goes wrong."""

import json
import math

import gonio
import numpy as np
import pytest

STAGE = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "{up}"
)
def Xform "World"
{{
    double3 xformOp:translate = (300, 20, 50)
    float xformOp:rotateZ = 30
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ"]
    def Xform "Lamp"
    {{
        def DiskLight "Face"
        {{
            float inputs:radius = 10
            double gonio:photometry:quantity = 1000
            token gonio:photometry:unit = "lm"
            {light}
        }}
        {part}
    }}
    def SphereLight "Other"
    {{
        float inputs:intensity = 1000
    }}
    def Mesh "Floor"
    {{
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(-900, -900, -90), (900, -900, -90), (900, 900, -90), (-900, 900, -90)]
    }}
    def Xform "Empty"
    {{
    }}
}}
"""
QUICK = ("--rays", "2M", "--error", "0", "--g-step", "10", "--c-step", "30")


@pytest.fixture
def lamp(tmp_path):
    """A Lambertian disk of 1000 lm that looks along −z, among other things."""

    def write(light="", part="", up="Z"):
        path = tmp_path / "lamp.usda"
        path.write_text(STAGE.format(light=light, part=part, up=up))
        return path

    return write


def test_a_disk_follows_lambert(run, lamp, tmp_path):
    ldt, table = tmp_path / "lamp.ldt", tmp_path / "lamp.csv"
    done = run("goniometer", lamp(), "--luminaire", "/World/Lamp", *QUICK, "-o", ldt, "--csv", table, "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["emitted_lm"]["value"] == pytest.approx(1000, rel=1e-3)
    assert found["flux_lm"]["value"] == pytest.approx(1000, rel=1e-3)
    assert found["light_output_ratio"]["value"] == pytest.approx(1, rel=1e-6)
    intensities = np.array(found["intensities_cd"])
    expected = 1000 / math.pi * np.cos(np.radians(found["gamma_deg"]))
    inside = np.array(found["gamma_deg"]) < 85
    assert intensities[:, inside] == pytest.approx(np.broadcast_to(expected[inside], (12, 9)), rel=0.06)
    assert intensities[:, inside].mean(0) == pytest.approx(expected[inside], rel=0.015)
    assert found["symmetry"] == "rotational" and found["opening_m"]["round"]
    figures = gonio.goniogram_figures(ldt.read_bytes(), "lamp.ldt")
    assert figures["peak_cd"] == pytest.approx(1000 / math.pi, rel=0.02)
    assert figures["lamp_flux_lm"] == pytest.approx(1000, rel=1e-3)
    assert table.read_text().count("\n") == 1 + 12 * 19


def test_axes_can_be_named(run, lamp):
    turned = "float xformOp:rotateX = -90\n            uniform token[] xformOpOrder = [\"xformOp:rotateX\"]"
    stage = lamp(light=turned, up="Y")
    done = run("goniometer", stage, "-l", "/World/Lamp", *QUICK, "--down", "-y", "--json")
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["peak_direction_deg"][1] == 0


def test_a_screen_has_its_illuminance(run, lamp, tmp_path):
    points = tmp_path / "screen.csv"
    done = run("goniometer", lamp(), "-l", "/World/Lamp", *QUICK, "--screen", "1,0.2,0.2,2,2", "--screen-csv", points, "--json")
    assert done.returncode == 0, done.stderr
    # A disk of radius r at distance d: π L r² / (r² + d²) on its axis, with π L = M = 1000 lm / (π r²).
    expected = 1000 / (math.pi * (0.01 + 1))
    assert json.loads(done.stdout)["screen"]["illuminance_lx"] == pytest.approx([expected] * 4, rel=0.06)
    assert points.read_text().count("\n") == 5


def test_text_says_where_the_light_went(run, lamp):
    done = run("goniometer", lamp(), "-l", "/World/Lamp", *QUICK)
    assert done.returncode == 0, done.stderr
    for words in ("sources: 1000", "light output ratio 100", "absorbed:", "cut off: 0", "peak:", "beam angle", "opening: round, 0.19", "body: 0.2000 × 0.2000 × 0.0000", "rays:"):
        assert words in done.stdout, done.stdout


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--luminaire", "/World/Nothing"), "there is no prim /World/Nothing"),
        (("--luminaire", "/World/Empty"), "no light"),
        (("--luminaire", "/World/Lamp", "--c-step", "7"), "c-step"),
        (("--luminaire", "/World/Lamp", "--error", "200%"), "error"),
        (("--luminaire", "/World/Lamp", "-o", "lamp.txt"), "lamp.txt"),
        (("--luminaire", "/World/Lamp", "--rays-file", "missing.ray"), "missing.ray"),
        (("--luminaire", "/World/Lamp", "--screen", "1,2"), "screen"),
    ],
)
def test_what_cannot_be_measured_is_told(run, lamp, options, words):
    done = run("goniometer", lamp(), *options)
    assert done.returncode == 1 and words in done.stderr and done.stderr.count("\n") == 1, done.stderr


@pytest.mark.parametrize("count", ["1e30", "5T", "0", "nan"])
def test_counts_that_are_none_are_refused(run, lamp, count):
    done = run("goniometer", lamp(), "--luminaire", "/World/Lamp", "--rays", count)
    assert done.returncode == 2 and "--rays" in done.stderr, done.stderr


def test_a_lamp_in_a_box_keeps_its_light(run, lamp):
    box = """def Cube "Box"
        {
            double size = 40
        }"""
    done = run("goniometer", lamp(part=box), "-l", "/World/Lamp", "--rays", "500k", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["flux_lm"]["value"] == 0 and "never leave" in done.stderr
    assert found["absorbed_lm"]["value"] == pytest.approx(1000, rel=1e-2)


def test_python_has_arrays(lamp, tmp_path):
    calls = []
    stage = lamp()
    found = gonio.goniometer(stage, "/World/Lamp", rays=2_000_000, error=0, g_step=10, c_step=90, progress=lambda *now: calls.append(now))
    assert np.asarray(found.intensities).shape == (4, 19) and np.asarray(found.tristimulus).shape == (76, 3)
    assert np.asarray(found.tristimulus)[:, 1] == pytest.approx(np.asarray(found.intensities).ravel())
    assert found.emitted.value == pytest.approx(found.flux.value + found.absorbed.value + found.cut_off.value)
    assert found.peak_direction[1] == 0 and not found.diagnostics
    found.write(tmp_path / "lamp.ies", symmetry="rotational")
    assert b"IES:LM-63" in (tmp_path / "lamp.ies").read_bytes()
    with pytest.raises(gonio.SettingError):
        found.write(tmp_path / "lamp.txt")
    with pytest.raises(gonio.Cancelled):
        gonio.goniometer(stage, "/World/Lamp", rays=1 << 36, error=0, progress=lambda *now: False)


def test_scenes_are_luminaires(tmp_path):
    scene = gonio.Scene()
    scene.add_light("point", (100.0,) * 3)
    found = gonio.goniometer(scene, rays=2_000_000, error=0, g_step=15, c_step=45, threads=1)
    assert np.asarray(found.intensities) == pytest.approx(np.full((8, 13), 100.0), rel=0.03)
    again = gonio.goniometer(scene, rays=2_000_000, error=0, g_step=15, c_step=45, threads=2)
    assert (np.asarray(again.intensities) == np.asarray(found.intensities)).all()
    with pytest.raises(gonio.SettingError, match="no light"):
        gonio.goniometer(gonio.Scene())


def rays_text(count=2000, bad=""):
    """A Zemax text file of rays downwards, in millimetres; each has one lumen."""
    lines = [f"{count} 4", *(f"{i % 7} {i % 5} 0 0 0 -1 1" for i in range(count))]
    return "\n".join([*lines[:9], *filter(None, [bad]), *lines[9:]]) + "\n"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("", "rays.dat"),
        ("not rays at all\n", "rays.dat"),
        (rays_text()[:900], "rays.dat:"),
        (rays_text(count=3).replace("3 4", "4000000000 4", 1), "4000000000"),
        (rays_text(count=2).replace(" -1 1", " -1 nan"), "rays.dat"),
    ],
    ids=["empty", "other", "truncated", "absurd count", "not a number"],
)
def test_broken_ray_files_are_told(run, lamp, tmp_path, text, words):
    file = tmp_path / "rays.dat"
    file.write_text(text)
    done = run("goniometer", lamp(), "-l", "/World/Lamp", *QUICK, "--rays-file", file)
    assert done.returncode == 1 and words in done.stderr and done.stderr.count("\n") == 1, done.stderr


def test_a_ray_that_is_no_ray_is_lost_alone(run, lamp, tmp_path):
    file = tmp_path / "rays.dat"
    file.write_text(rays_text(bad="0 0 nan 0 0 -1 1").replace("2000 4", "2001 4", 1))
    done = run("goniometer", lamp(), "-l", "/World/Lamp", *QUICK, "--rays-file", file, "--rays-flux", "1000", "--json")
    assert done.returncode == 0, done.stderr
    assert "1 ray" in done.stderr and json.loads(done.stdout)["flux_lm"]["value"] > 0, done.stderr


GLASS = """
        def {kind} "Glass" (prepend apiSchemas = ["MaterialBindingAPI"])
        {{
            {shape}
            rel material:binding = </World/Lamp/Clear>
        }}
        def Material "Clear"
        {{
            token outputs:surface.connect = </World/Lamp/Clear/S.outputs:surface>
            def Shader "S"
            {{
                uniform token info:id = "ND_open_pbr_surface_surfaceshader"
                float inputs:transmission_weight = 1
                float inputs:specular_roughness = 0
                token outputs:surface
            }}
        }}"""
OPEN = """int[] faceVertexCounts = [4]
            int[] faceVertexIndices = [0, 1, 2, 3]
            point3f[] points = [(-20, -20, -10), (20, -20, -10), (20, 20, -10), (-20, 20, -10)]
            uniform bool doubleSided = true"""


@pytest.mark.parametrize(("kind", "shape"), [("Sphere", "double radius = 15"), ("Mesh", OPEN)], ids=["source in a solid", "open glass"])
def test_all_light_of_odd_geometry_is_accounted_for(run, lamp, kind, shape):
    done = run("goniometer", lamp(part=GLASS.format(kind=kind, shape=shape)), "-l", "/World/Lamp", *QUICK, "--json")
    assert done.returncode == 0, done.stderr
    found = {name: json.loads(done.stdout)[name]["value"] for name in ("emitted_lm", "flux_lm", "absorbed_lm", "cut_off_lm")}
    assert found["emitted_lm"] == pytest.approx(1000, rel=1e-3)
    assert found["emitted_lm"] == pytest.approx(found["flux_lm"] + found["absorbed_lm"] + found["cut_off_lm"], rel=1e-9)
    assert found["flux_lm"] > 100, found


def test_a_beam_aside_is_told(run, lamp, tmp_path):
    # Tilted by 40° towards C 60°.
    aslant = 'float3 xformOp:rotateXYZ = (0, -40, 60)\n            uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]'
    ldt = tmp_path / "lamp.ldt"
    options = ("--rays", "2M", "--error", "0")
    done = run("goniometer", lamp(light=aslant), "-l", "/World/Lamp", *options, "-o", ldt)
    assert done.returncode == 0, done.stderr
    assert "the beam's axis lies in neither plane" in done.stdout and any(f"C{c}–C{c + 180}" in done.stdout for c in (59, 60, 61)), done.stdout
    read = run("photometry", ldt, "--json")
    aside = json.loads(read.stdout)["beam_aside"]
    assert aside["c_deg"] == pytest.approx(60, abs=1)
    # Straight down there is nothing to be told.
    done = run("goniometer", lamp(), "-l", "/World/Lamp", *options, "--json")
    assert json.loads(done.stdout)["beam_aside"] is None


def test_angles_without_an_end_have_no_error(run, lamp):
    bulb = 'def SphereLight "Bulb"\n        {\n            float inputs:radius = 5\n        }'
    done = run("goniometer", lamp(light='token visibility = "invisible"', part=bulb), "-l", "/World/Lamp", "--rays", "1M", "--error", "0")
    assert done.returncode == 0, done.stderr
    line = next(line for line in done.stdout.splitlines() if line.startswith("beam angle"))
    assert line.count("180.0° (to the horizon)") == 2 and "±" not in line, done.stdout


def test_seeds_give_other_measurements(run, lamp):
    options = ("-l", "/World/Lamp", "--rays", "300k", "--error", "0", "--json")
    one, other, again = (json.loads(run("goniometer", lamp(), *options, "--seed", seed).stdout)["intensities_cd"] for seed in ("1", "2", "1"))
    assert one == again and one != other
