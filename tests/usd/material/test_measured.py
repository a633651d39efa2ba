"""Measured materials: what the shader and the prim type say, files that cannot be read, and pictures against closed forms."""

import subprocess
import sys

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

HEADER = '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n'
SHADER = """def Material "Paint"
{{
    token outputs:gonio:surface.connect = </Paint/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "gonio:MeasuredBSDF"
        asset inputs:file = @{file}@
        {body}
        token outputs:surface
    }}
}}
"""
BALL = """def Sphere "Ball" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    double radius = 1
    rel material:binding = </Paint>
}
def DomeLight "Sky"
{
    float inputs:intensity = 1
}
def DistantLight "Sun"
{
    float inputs:intensity = 50
    float inputs:angle = 20
    double xformOp:rotateX = 40
    uniform token[] xformOpOrder = ["xformOp:rotateX"]
}
def Camera "Camera"
{
    token projection = "orthographic"
    float horizontalAperture = 22
    float verticalAperture = 22
    double3 xformOp:translate = (0, 0, 4)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


TYPED = """import sys, gonio
print(gonio.load_usd(sys.argv[1]).to_dict()["materials"][0]["closures"][0]["model"])
from pxr import Usd
stage = Usd.Stage.Open(sys.argv[1])
print(stage.GetPrimAtPath("/Paint/S").GetAttribute("inputs:scale").Get())
"""


def write_table(path, coordinates, axes, values):
    """A text table of luminance; axes are (name, degrees)."""
    lines = ["gbsdf 1", f"table reflection-front {coordinates}", "bilateral yes"]
    for name, degrees in axes:
        lines += [f"axis {name} linear {len(degrees)}", " ".join(f"{x:.9g}" for x in degrees)]
    lines += ["values text", " ".join(f"{x:.7g}" for x in np.ravel(values)), "end"]
    path.write_text("\n".join(lines) + "\n")


def grey(path, albedo):
    axes = [("theta_i", [0, 80]), ("theta_o", [0, 80]), ("delta_phi", [0, 180])]
    write_table(path, "isotropic", axes, np.full(8, albedo / np.pi))


def ggx(path, alpha):
    """GGX with height-correlated shadowing and Fresnel 1, over half and difference angles that lie denser near the normal."""
    half, difference, azimuth = 90 * np.linspace(0, 1, 120) ** 1.5, np.linspace(0, 90, 90), np.linspace(0, 180, 37)
    h, d, phi = np.meshgrid(*(np.radians(x) for x in (half, difference, azimuth)), indexing="ij")
    cosines = [np.cos(h) * np.cos(d) - sign * np.sin(h) * np.sin(d) * np.cos(phi) for sign in (1, -1)]
    slope = (np.sin(h) / alpha) ** 2 + np.cos(h) ** 2
    a, b = (np.maximum(c, 1e-3) for c in cosines)
    stretch_a, stretch_b = (np.sqrt(alpha**2 * (1 - c**2) + c**2) for c in (a, b))
    values = 0.5 / (np.pi * alpha**2 * slope**2 * (stretch_a * b + stretch_b * a))
    write_table(path, "half-difference", [("theta_h", half), ("theta_d", difference), ("phi_d", azimuth)], values)


def load(tmp_path, body="", material=SHADER, file="paint.gbsdf"):
    path = tmp_path / "stage.usda"
    path.write_text(HEADER + material.format(file=file, body=body) + BALL)
    return gonio.load_usd(str(path))


def picture(scene, samples=64):
    scene.set(width=44, height=44, samples=samples)
    with gonio.Render(scene) as rendering:
        rendering.wait()
        return np.asarray(rendering.film()["color"])[:, :, :3]


def closure(scene):
    return scene.to_dict()["materials"][0]["closures"][0]


def diagnostics(scene):
    return " ".join(str(line) for line in scene.diagnostics)


def test_inputs_are_those_of_the_shader(tmp_path):
    grey(tmp_path / "paint.gbsdf", 0.5)
    body = "color3f inputs:tint = (0.5, 1, 0.25)\nfloat inputs:scale = 2\nfloat inputs:rotation = 90"
    found = closure(load(tmp_path, body))
    assert (found["model"], found["measured"]) == ("Measured", 0)
    parameters = dict(found["parameters"])
    assert parameters["base_color"]["Constant"][:3] == [0.5, 1, 0.25]
    assert parameters["specular_scale"]["Constant"][0] == 2
    assert parameters["specular_rotation"]["Constant"][0] == 0.25


def test_the_prim_type_has_the_shader_and_its_defaults(tmp_path):
    grey(tmp_path / "paint.gbsdf", 0.5)
    material = SHADER.replace('Shader "S"', 'GonioMeasuredBSDF "S"').replace('uniform token info:id = "gonio:MeasuredBSDF"', "")
    path = tmp_path / "stage.usda"
    path.write_text(HEADER + material.format(file="paint.gbsdf", body="") + BALL)
    # In a process of its own: schemas are looked for when the first stage is opened, which here may have been long ago.
    run = subprocess.run([sys.executable, "-c", TYPED, str(path)], capture_output=True, text=True, check=False)
    assert run.stdout.split() == ["Measured", "1.0"], run.stderr


def test_shaders_share_a_file(tmp_path):
    grey(tmp_path / "paint.gbsdf", 0.5)
    other = SHADER.replace('"Paint"', '"Other"').replace("/Paint/", "/Other/").format(file="paint.gbsdf", body="")
    other += 'def Cube "Box" (prepend apiSchemas = ["MaterialBindingAPI"])\n{\n    rel material:binding = </Other>\n}\n'
    path = tmp_path / "stage.usda"
    path.write_text(HEADER + SHADER.format(file="paint.gbsdf", body="") + other + BALL)
    assert len(gonio.load_usd(str(path)).to_dict()["measured"]) == 1


@pytest.mark.parametrize("content", [None, "", "gbsdf 1\ntable", "\x00\x01binary"])
def test_files_that_cannot_be_read_are_told_and_leave_grey(tmp_path, content):
    if content is not None:
        (tmp_path / "paint.gbsdf").write_text(content)
    scene = load(tmp_path)
    assert "paint.gbsdf" in diagnostics(scene)
    assert closure(scene)["measured"] is None
    scene.set(integrator="direct")
    found = picture(scene)
    grey(tmp_path / "other.gbsdf", 0.18)
    expected = load(tmp_path, file="other.gbsdf")
    expected.set(integrator="direct")
    assert found.mean() == pytest.approx(picture(expected).mean(), rel=0.01)


def test_more_light_than_there_was_is_told_by_name(tmp_path):
    grey(tmp_path / "paint.gbsdf", 1.5)
    scene = load(tmp_path)
    scene.set(width=8, height=8, samples=1)
    with gonio.Render(scene) as rendering:
        rendering.wait()
        told = " ".join(str(line) for line in rendering.diagnostics)
    assert "paint.gbsdf" in told and "1.5" in told


def test_a_grey_table_is_lamberts_law(tmp_path):
    grey(tmp_path / "paint.gbsdf", 0.5)
    scene = load(tmp_path, "color3f inputs:tint = (0.5, 1, 0.25)")
    measured = picture(scene)
    lambert = {"model": "Diffuse", "parameters": [["base_color", {"Constant": [0.25, 0.5, 0.125, 1]}]]}
    scene.put_material({"origin": "lambert", "closures": [lambert]}, 0)
    # Both sample by the cosine nearly alone; what is left is noise of half a per cent of a pixel's mean.
    assert measured.mean((0, 1)) == pytest.approx(picture(scene).mean((0, 1)), rel=0.005)


def test_weights_mix_two_measurements(tmp_path):
    grey(tmp_path / "paint.gbsdf", 0.6)
    grey(tmp_path / "other.gbsdf", 0.2)
    other = SHADER.replace('"Paint"', '"Other"').replace("/Paint/", "/Other/").format(file="other.gbsdf", body="")
    other += 'def Cube "Box" (prepend apiSchemas = ["MaterialBindingAPI"])\n{\n    rel material:binding = </Other>\n    double size = 0.01\n}\n'
    path = tmp_path / "stage.usda"
    path.write_text(HEADER + SHADER.format(file="paint.gbsdf", body="") + other + BALL)
    scene = gonio.load_usd(str(path))
    half = {"Constant": [0.5] * 4}
    closures = [{"model": "Measured", "measured": number, "weight": half} for number in (0, 1)]
    names = [material["origin"] for material in scene.to_dict()["materials"]]
    number = next(place for place, name in enumerate(names) if "Paint" in str(name))
    scene.put_material({"origin": "mixed", "closures": closures}, number)
    mixed = picture(scene, 256).mean()
    lambert = {"model": "Diffuse", "parameters": [["base_color", {"Constant": [0.4] * 4}]]}
    scene.put_material({"origin": "lambert", "closures": [lambert]}, number)
    assert mixed == pytest.approx(picture(scene, 256).mean(), rel=0.005)


def brushed(path):
    """Reflects towards azimuths near the tangent's alone: a table of two polar angles and eight azimuths."""
    axes = [
        ("theta_i linear", [0, 80]),
        ("phi_i periodic 360", np.arange(0, 360, 45)),
        ("theta_o linear", [0, 80]),
        ("phi_o periodic 360", [0, 180]),
    ]
    along = np.abs(np.cos(np.radians(axes[1][1]))) ** 4
    lines = ["gbsdf 1", "table reflection-front anisotropic"]
    for name, degrees in axes:
        lines += [f"axis {name} {len(degrees)}", " ".join(map(str, degrees))]
    values = np.broadcast_to(along[None, :, None, None] * 0.3, (2, 8, 2, 2))
    path.write_text("\n".join([*lines, "values text", " ".join(map(str, values.ravel())), "end"]) + "\n")


SQUARE = """def Mesh "Square" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    texCoord2f[] primvars:st = {st} (interpolation = "vertex")
    rel material:binding = </Paint>
}}
"""


def test_tangents_follow_texture_coordinates_that_nothing_else_reads(tmp_path):
    brushed(tmp_path / "paint.gbsdf")
    lights = BALL[BALL.index("def DistantLight") :]

    def brightness(st, body=""):
        path = tmp_path / "square.usda"
        path.write_text(HEADER + SHADER.format(file="paint.gbsdf", body=body) + SQUARE.format(st=st) + lights)
        return picture(gonio.load_usd(str(path)), 64)[22, 22, 1]

    # The sun stands in the plane of y and z.
    across = brightness("[(0, 0), (1, 0), (1, 1), (0, 1)]")
    along = brightness("[(0, 1), (0, 0), (1, 0), (1, 1)]")
    assert along > 5 * across
    # A quarter turn of the tangent and one of the coordinates cancel.
    assert brightness("[(0, 0), (1, 0), (1, 1), (0, 1)]", "float inputs:rotation = 90") == pytest.approx(along, rel=0.02)


def test_a_table_of_ggx_shows_the_ggx_sphere(tmp_path):
    ggx(tmp_path / "paint.gbsdf", 0.25)
    scene = load(tmp_path)
    measured = picture(scene, 4096)
    glossy = {"model": "Glossy", "distribution": "Ggx", "parameters": [["base_color", {"Constant": [1, 1, 1, 1]}],
              ["specular_roughness", {"Constant": [0.5] * 4}]]}
    scene.put_material({"origin": "ggx", "closures": [glossy]}, 0)
    expected = picture(scene, 4096)
    assert measured.mean() == pytest.approx(expected.mean(), rel=0.003)
    blocks = [image.mean(2).reshape(11, 4, 11, 4).mean((1, 3)) for image in (measured, expected)]
    # Blocks of 16 pixels, lit: the difference of the pictures, noise included, within one per cent.
    lit = blocks[1] > 0.1 * blocks[1].max()
    difference = np.abs(blocks[0] - blocks[1])[lit] / blocks[1][lit]
    assert np.sqrt((difference**2).mean()) < 0.01
