"""Motion blur of stages: what the camera's shutter sees move."""

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

CAMERA = """
def Camera "Eye"
{
    double shutter:open = %s
    double shutter:close = %s
    double3 xformOp:translate.timeSamples = { 1: (0, 0, 10), 2: (2, 0, 10) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""

QUAD = """
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
"""


def load(tmp_path, text, shutter=(-0.25, 0.25), **options):
    path = tmp_path / "stage.usda"
    head = '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Y"\n    timeCodesPerSecond = 24\n    startTimeCode = 1\n    endTimeCode = 2\n'
    head += ")\n"
    path.write_text(head + CAMERA % shutter + text)
    scene = gonio.load_usd(str(path), **{"frame": 1.5, "camera_light": True, **options})
    return scene.to_dict(), [" ".join(map(str, line)) for line in scene.diagnostics]


def places(motion):
    """Where transforms place their origins, x, key by key."""
    return [key["columns"][3][0] for key in motion]


def test_cameras_move(tmp_path):
    scene, _ = load(tmp_path, "")
    assert places(scene["cameras"][0]["motion"]) == pytest.approx([0.5, 1.0, 1.5])
    assert scene["cameras"][0]["transform"]["columns"][3][0] == pytest.approx(1.0)


def test_a_shutter_that_does_not_open_blurs_nothing(tmp_path):
    for shutter in ((0.0, 0.0), (0.3, 0.1)):
        assert load(tmp_path, "", shutter)[0]["cameras"][0]["motion"] == []


def test_transforms_and_lights_move(tmp_path):
    text = (
        'def Xform "X"\n{\n    double xformOp:rotateY.timeSamples = { 1: 0, 2: 180 }\n'
        '    uniform token[] xformOpOrder = ["xformOp:rotateY"]\n'
        f'def Mesh "M"\n{{{QUAD}}}\n'
        'def SphereLight "L"\n{\n    double3 xformOp:translate = (3, 0, 0)\n'
        '    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n}\n'
    )
    scene, told = load(tmp_path, text)
    axes = [key[0]["columns"][0][0] for key in scene["instances"][0]["motion"]]
    assert axes == pytest.approx([np.cos(np.pi * share) for share in (0.25, 0.5, 0.75)], abs=1e-6)
    assert places(scene["lights"][0]["motion"]) == pytest.approx([3 * np.cos(np.pi * share) for share in (0.25, 0.5, 0.75)], abs=1e-6)
    assert not any("blur" in line for line in told), told


def test_points_move(tmp_path):
    sampled = QUAD.replace(
        "point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]",
        "point3f[] points.timeSamples = {\n        1: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],\n"
        "        2: [(0, 0, 0), (1, 0, 0), (1, 1, 1), (0, 1, 1)]\n    }",
    )
    scene, _ = load(tmp_path, f'def Mesh "M"\n{{{sampled}}}\n')
    keys = [np.asarray(key["points"]).reshape(-1, 3) for key in scene["meshes"][0]["motion"]]
    assert [key[:, 2].max() for key in keys] == pytest.approx([0.25, 0.5, 0.75])


def test_velocities_take_points_on(tmp_path):
    sampled = QUAD.replace("points = [", "points.timeSamples = { 1: [").replace("(0, 1, 0)]", "(0, 1, 0)] }")
    sampled += "    vector3f[] velocities.timeSamples = { 1: [(24, 0, 0), (24, 0, 0), (24, 0, 0), (24, 0, 0)] }\n"
    scene, _ = load(tmp_path, f'def Mesh "M"\n{{{sampled}}}\n', (0.0, 0.5), frame=1.0)
    keys = [np.asarray(key["points"]).reshape(-1, 3) for key in scene["meshes"][0]["motion"]]
    assert [key[0, 0] for key in keys] == pytest.approx([0.0, 0.25, 0.5])


def test_instancers_move_by_velocities(tmp_path):
    text = f"""
def PointInstancer "P"
{{
    rel prototypes = [</P/M>]
    int[] protoIndices = [0, 0]
    point3f[] positions.timeSamples = {{ 1: [(0, 0, 0), (0, 5, 0)] }}
    vector3f[] velocities.timeSamples = {{ 1: [(24, 0, 0), (48, 0, 0)] }}
    def Mesh "M"
    {{{QUAD}}}
}}
"""
    scene, told = load(tmp_path, text, (0.0, 0.5), frame=1.0)
    found = [[place["columns"][3][0] for place in key] for key in scene["instances"][0]["motion"]]
    assert np.allclose(found, [[0, 0], [0.25, 0.5], [0.5, 1.0]]), found
    assert not any("velocities" in line for line in told), told


def test_other_topologies_stand_still_and_are_told(tmp_path):
    changing = QUAD.replace("faceVertexCounts = [4]", "faceVertexCounts.timeSamples = { 1: [4], 1.6: [3] }").replace(
        "faceVertexIndices = [0, 1, 2, 3]", "faceVertexIndices.timeSamples = { 1: [0, 1, 2, 3], 1.6: [0, 1, 2] }"
    )
    scene, told = load(tmp_path, f'def Mesh "M"\n{{{changing}}}\n')
    assert scene["meshes"][0]["motion"] == []
    assert any("/M" in line and "topology" in line for line in told), told


def test_settings_switch_it_off(tmp_path):
    for name in ("disableMotionBlur", "instantaneousShutter"):
        text = f'def RenderSettings "S"\n{{\n    uniform bool {name} = 1\n    rel camera = </Eye>\n}}\n'
        scene, _ = load(tmp_path, text, render_settings="/S")
        assert scene["cameras"][0]["motion"] == [], name


def test_the_cameras_sample_count_counts(tmp_path):
    path = tmp_path / "stage.usda"
    head = '#usda 1.0\n(\n    metersPerUnit = 1\n    startTimeCode = 1\n    endTimeCode = 2\n)\n'
    counted = "int motion:nonlinearSampleCount = 5\n    double shutter:open"
    path.write_text(head + (CAMERA % (-0.25, 0.25)).replace("double shutter:open", counted))
    scene = gonio.load_usd(str(path), frame=1.5).to_dict()
    assert places(scene["cameras"][0]["motion"]) == pytest.approx([0.5, 0.75, 1.0, 1.25, 1.5])
