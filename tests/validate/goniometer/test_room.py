"""A measured luminaire lights a floor as the whole luminaire does: block differences of both pictures under 2 %."""

import compare
import gonio
import luminaires
import meshes
import numpy
import pytest

pytestmark = [pytest.mark.validate, pytest.mark.timeout(1800)]

# Metres below the luminaire: so far that its few centimetres are a point.
DEPTH, SIDE, PIXELS, REFLECTANCE = 3.0, 4.0, 128, 0.1
ANGLES = ["--c-step", "90", "--symmetry", "rotational", "--g-step", "0.5"]
GUIDE = ["--c-step", "5", "--symmetry", "c0", "--g-step", "2.5"]
CASES = {"reflector": ANGLES, "opal": ["--c-step", "90", "--symmetry", "rotational", "--g-step", "2.5"], "lens": ANGLES, "guide": GUIDE}

FLOOR = f'''def Mesh "Floor" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-9, -9, {-DEPTH}), (9, -9, {-DEPTH}), (9, 9, {-DEPTH}), (-9, 9, {-DEPTH})]
    rel material:binding = </Matt>
}}
def Material "Matt"
{{
    token outputs:surface.connect = </Matt/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = ({REFLECTANCE}, {REFLECTANCE}, {REFLECTANCE})
        float inputs:ior = 1
        float inputs:roughness = 1
        token outputs:surface
    }}
}}
'''


def from_file(name):
    """A light with the measured intensities alone."""
    return f'''{meshes.HEAD}def SphereLight "Lamp"
{{
    asset gonio:photometry:file = @{name}@
}}
'''


def picture(stage, caustics, samples):
    """The floor from just below the luminaire, the mean of two seeds, with its noise."""
    scene = gonio.load_usd(str(stage))
    camera = scene.to_dict()["cameras"][0]
    columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1], [0, 0, -0.5 * DEPTH]]
    camera.update(projection="Orthographic", aperture=[SIDE, SIDE], transform={"columns": columns})
    scene.put_camera(camera, 0)
    scene.set(width=PIXELS, height=PIXELS, samples=samples, max_bounces=200, caustics=caustics)
    found = []
    for seed in (1, 2):
        scene.set(seed=seed)
        with gonio.Render(scene) as render:
            assert render.wait()
            found.append(numpy.asarray(render.film().read("color"), float)[..., :3])
    return compare.measured(*found, 2 * samples, 0.0)


@pytest.mark.parametrize("name", list(CASES))
def test_the_file_lights_as_the_luminaire(name, run, tmp_path):
    whole = tmp_path / "whole.usda"
    whole.write_text(luminaires.STAGES[name]() + FLOOR)
    told = run("goniometer", whole, "--luminaire", "/Lamp", "-o", tmp_path / "lamp.ldt", *CASES[name], "--rays", "50M", "--error", "0", timeout=900)
    assert told.returncode == 0, told.stderr
    (tmp_path / "file.usda").write_text(from_file("lamp.ldt") + FLOOR)
    luminaire, file = picture(whole, "on", 512), picture(tmp_path / "file.usda", "off", 64)
    found = compare.difference(luminaire.image, file.image)
    print(name, found, luminaire.noise)
    assert found.percentile95 < 0.02 + 2 * luminaire.noise and abs(found.mean) < 0.01, (found, luminaire.noise)
