"""A measured luminaire lights a floor as the whole luminaire does: within 2 % in each block of half a metre."""

import gonio
import luminaires
import meshes
import numpy
import pytest

pytestmark = [pytest.mark.validate, pytest.mark.timeout(1800)]

# Metres below the luminaire: so far that its few centimetres are a point.
DEPTH, SIDE, CELLS = 3.0, 4.0, 8
PATHS = 1 << 25
ANGLES = ["--c-step", "90", "--symmetry", "rotational", "--g-step", "0.5"]
GUIDE = ["--c-step", "5", "--symmetry", "c0", "--g-step", "2.5"]
CASES = {"reflector": ANGLES, "opal": ["--c-step", "90", "--symmetry", "rotational", "--g-step", "2.5"], "lens": ANGLES, "guide": GUIDE}

FLOOR = f'''def Mesh "Floor" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [
        ({-SIDE / 2}, {-SIDE / 2}, {-DEPTH}), ({SIDE / 2}, {-SIDE / 2}, {-DEPTH}),
        ({SIDE / 2}, {SIDE / 2}, {-DEPTH}), ({-SIDE / 2}, {SIDE / 2}, {-DEPTH})
    ]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
    rel material:binding = </Matt>
}}
def Material "Matt"
{{
    token outputs:surface.connect = </Matt/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (0, 0, 0)
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


def lux(stage):
    """Illuminances of the floor's cells by light paths, and their standard errors over their mean."""
    scene = gonio.load_usd(str(stage))
    maps = gonio.illumination_map(scene, prims=["/Floor"], uv="st", resolution=(CELLS, CELLS), error=0, paths=PATHS, max_bounces=500)
    of_floor = maps.surfaces[0].illuminance(), maps.surfaces[0].standard_errors()
    found, errors = (numpy.asarray(values, float).reshape(CELLS, CELLS) for values in of_floor)
    return found, errors / found.mean()


@pytest.mark.parametrize("name", list(CASES))
def test_the_file_lights_as_the_luminaire(name, run, tmp_path):
    whole = tmp_path / "whole.usda"
    whole.write_text(luminaires.STAGES[name]() + FLOOR)
    options = ("--luminaire", "/Lamp", "-o", tmp_path / "lamp.ldt", *CASES[name], "--rays", "50M", "--error", "0")
    told = run("goniometer", whole, *options, timeout=900)
    assert told.returncode == 0, told.stderr
    (tmp_path / "file.usda").write_text(from_file("lamp.ldt") + FLOOR)
    luminaire, file = lux(whole), lux(tmp_path / "file.usda")
    apart = numpy.abs(luminaire[0] - file[0]) / numpy.maximum(file[0], 0.1 * file[0].max())
    noise = float(numpy.hypot(luminaire[1], file[1]).max())
    print(name, f"largest {apart.max():.2%}, mean {luminaire[0].mean() / file[0].mean() - 1:+.2%}, noise up to {noise:.2%}")
    assert apart.max() < 0.02 + 3 * noise and abs(luminaire[0].mean() / file[0].mean() - 1) < 0.01
