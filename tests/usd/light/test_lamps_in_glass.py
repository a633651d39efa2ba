"""Lamps inside glass that stages make of spheres: a shell of two, the inner one inside out, a solid ball, and one of tinted resin."""

import json
import math

import pytest

MATERIAL = """
    def Material "Glass" {
        token outputs:mtlx:surface.connect = </W/Glass/S.outputs:out>
        def Shader "S" {
            uniform token info:id = "ND_open_pbr_surface_surfaceshader"
            float inputs:base_weight = 0
            float inputs:transmission_weight = 1
            float inputs:specular_roughness = 0
            float inputs:specular_ior = 1.5
            %s
            token outputs:out
        }
    }
"""
BALL = """
    def Sphere "%s" (prepend apiSchemas = ["MaterialBindingAPI"]) {
        double radius = %s
        uniform token orientation = "%s"
        rel material:binding = </W/Glass>
    }
"""
TINT = "color3f inputs:transmission_color = (0.5, 0.5, 0.5)\n            float inputs:transmission_depth = 0.1"
NITS = 1e6


def stage(folder, *balls, tint="", radius=0.0005):
    """A small lamp at the origin, with balls of glass about it."""
    path = folder / "lamp.usda"
    lamp = f'def SphereLight "l" {{\n float inputs:intensity = {NITS}\n float inputs:radius = {radius}\n}}'
    shapes = "".join(BALL % ball for ball in balls)
    path.write_text(f'#usda 1.0\n(metersPerUnit = 1\nupAxis = "Z")\ndef Xform "W" {{\n{lamp}\n{shapes}\n{MATERIAL % tint}}}\n')
    return path


def ratio(run, path):
    """The light output ratio."""
    done = run("goniometer", path, "--luminaire", "/W", "--error", "0", "--rays", "200k", "--c-step", 90, "--g-step", 30, "--json", "-o", path.with_suffix(".ldt"))
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["absorbed_lm"]["value"] >= 0
    return found["light_output_ratio"]["value"]


def test_a_ball_of_resin_keeps_half(run, tmp_path):
    path = stage(tmp_path, ("a", 0.1, "rightHanded"), tint=TINT)
    # Its facets lie up to half a per cent within it.
    assert ratio(run, path) == pytest.approx(0.96 * 0.5 / (1 - 0.04 * 0.25), rel=0.01)


def test_a_sphere_inside_out_makes_a_shell(run, tmp_path):
    shell = (("a", 0.1, "rightHanded"), ("b", 0.09, "leftHanded"))
    # 1 cm of tinted glass once; what the faces send back goes through more of it.
    straight = 0.5**0.1
    once, back = 0.96**2 * straight, 0.04 + 0.96**2 * straight**2 * 0.04
    assert ratio(run, stage(tmp_path, *shell, tint=TINT)) == pytest.approx(once / (1 - back), rel=0.01)
    assert ratio(run, stage(tmp_path, *shell)) == pytest.approx(1.0, rel=1e-3)


def test_meters_see_a_lamp_in_clear_glass(run, tmp_path):
    # Not a solid ball: its facets magnify, each by the squared index, so that single directions see no mean.
    shell = (("a", 0.3, "rightHanded"), ("b", 0.28, "leftHanded"))
    bare, clothed = (
        json.loads(run("measure", stage(tmp_path, *balls, radius=0.005), "--at", "0,0,-1.9999", "--normal", "0,0,1", "--spp", 1024, "--json").stdout)["meters"][0]
        for balls in ((), shell)
    )
    assert bare["value"] == pytest.approx(NITS * math.pi * 0.005**2 / 4, rel=1e-3)
    # 0.96 / 1.04 of it come straight; what the glass sends back meets the lamp's middle, and lamps block nothing.
    assert 0.96 / 1.04 * 0.98 < clothed["value"] / bare["value"] < 1.03


def test_meters_far_off_a_small_shell_see_its_lamp(run, tmp_path):
    shell = (("a", 0.05, "rightHanded"), ("b", 0.047, "leftHanded"))
    done = run("measure", stage(tmp_path, *shell, radius=0.005), "--at", "0,0,-1.9999", "--normal", "0,0,1", "--spp", 64, "--json")
    found = json.loads(done.stdout)["meters"][0]
    bare = NITS * math.pi * 0.005**2 / 4
    assert abs(found["value"] - bare) < 4.0 * found["standard_error"] + 0.03 * bare, found
    # Its own paths would meet the lamp once in tens of thousands.
    assert found["standard_error"] < 0.1 * bare, found


@pytest.mark.parametrize("roughness", ["0.3", "0.1"])
def test_meters_by_a_ball_of_rough_glass(run, tmp_path, roughness):
    path = stage(tmp_path, ("a", 0.1, "rightHanded"), radius=0.01)
    path.write_text(path.read_text().replace("specular_roughness = 0\n", f"specular_roughness = {roughness}\n"))
    at = ("--at", "0,0,-1", "--normal", "0,0,1", "--spp", 64)
    found = json.loads(run("measure", path, *at, "--json").stdout)["meters"][0]
    bare = NITS * math.pi * 0.01**2
    # From its middle light leaves the ball straight, and what facets turn aside is made up for by others.
    assert abs(found["value"] - bare) < 4.0 * found["standard_error"] + 0.04 * bare, found
    assert "leave out light that mirrors and glass send on" in run("measure", path, *at, "--integrator", "direct").stderr


SHELL = (("a", 0.3, "rightHanded"), ("b", 0.28, "leftHanded"))


@pytest.mark.parametrize("options", [("--integrator", "direct"), ("--integrator", "whitted"), ("--max-bounces", 0)], ids=str)
def test_meters_that_cannot_find_such_light_say_so(run, tmp_path, options):
    at = ("--at", "0,0,-1.9999", "--normal", "0,0,1", "--spp", 16)
    for balls in ((), SHELL):
        done = run("measure", stage(tmp_path, *balls, radius=0.005), *at, *options)
        assert done.returncode == 0 and ("leave out light that mirrors and glass send on" in done.stderr) == bool(balls), done.stderr


@pytest.mark.parametrize("options", [("--integrator", "direct"), ("--caustics", "off"), ()], ids=str)
def test_pictures_that_cannot_find_such_light_say_so(run, tmp_path, options):
    path = stage(tmp_path, *SHELL, radius=0.005)
    floor = (
        'def Mesh "Floor" {\n int[] faceVertexCounts = [4]\n int[] faceVertexIndices = [0, 1, 2, 3]\n'
        " point3f[] points = [(-1, -1, -1), (1, -1, -1), (1, 1, -1), (-1, 1, -1)]\n}\n"
        'def Camera "Eye" {\n double3 xformOp:translate = (0, 0, 2)\n uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
    )
    path.write_text(path.read_text().rstrip().removesuffix("}") + floor + "}\n")
    line = ("render", path, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1)
    assert "leaves out light" not in run(*line, *options).stderr
    done = run(*line, "--aov", "color,illuminance", *options)
    assert done.returncode == 0 and ("the illuminance pass leaves out light" in done.stderr) == bool(options), done.stderr
