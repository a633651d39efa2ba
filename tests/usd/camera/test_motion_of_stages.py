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


STRAND = """
    uniform token type = "linear"
    int[] curveVertexCounts = [2]
    float[] widths = [0.1] (interpolation = "constant")
"""


def keys_of(shape):
    """Points of a shape's keys (K, N, 3)."""
    return np.array([np.asarray(key["points"]).reshape(-1, 3) for key in shape.get("motion", [])])


def test_points_of_curves_and_points_move(tmp_path):
    places = "points.timeSamples = { 1: [(0, 0, 0), (0, 1, 0)], 2: [(0, 0, 0), (1, 1, 0)] }"
    text = f'def BasisCurves "C"\n{{{STRAND}    point3f[] {places}\n}}\ndef Points "P"\n{{    point3f[] {places}\n}}\n'
    scene, told = load(tmp_path, text)
    for shape in (scene["curves"][0], scene["points"][0]):
        assert keys_of(shape)[:, 1, 0] == pytest.approx([0.25, 0.5, 0.75])
        assert np.asarray(shape["points"]).reshape(-1, 3)[1, 0] == pytest.approx(0.5)
    assert not any("blur" in line for line in told), told


def test_velocities_take_curves_and_points_on(tmp_path):
    places = """
    point3f[] points.timeSamples = { 1: [(0, 0, 0), (0, 1, 0)] }
    vector3f[] velocities.timeSamples = { 1: [(0, 0, 0), (24, 0, 0)] }
"""
    text = f'def BasisCurves "C"\n{{{STRAND}{places}}}\ndef Points "P"\n{{{places}}}\n'
    scene, told = load(tmp_path, text, (0.0, 0.5), frame=1.0)
    for shape in (scene["curves"][0], scene["points"][0]):
        assert keys_of(shape)[:, 1, 0] == pytest.approx([0.0, 0.25, 0.5])
    assert not any("velocities" in line for line in told), told


def test_other_counts_of_curves_and_points_stand_still_and_are_told(tmp_path):
    places = "point3f[] points.timeSamples = { 1: [(0, 0, 0), (0, 1, 0)], 1.6: [(0, 0, 0), (0, 1, 0), (0, 2, 0)] }"
    curves = STRAND.replace("curveVertexCounts = [2]", "curveVertexCounts.timeSamples = { 1: [2], 1.6: [3] }")
    scene, told = load(tmp_path, f'def BasisCurves "C"\n{{{curves}    {places}\n}}\ndef Points "P"\n{{    {places}\n}}\n')
    for shape, path in ((scene["curves"][0], "/C"), (scene["points"][0], "/P")):
        assert keys_of(shape).size == 0
        assert sum(path in line and "not blurred" in line for line in told) == 1, told


def test_faces_that_turn_concave_are_blurred(tmp_path):
    bent = """
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points.timeSamples = {
        1: [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)],
        2: [(0, 0, 0), (0.1, 0.6, 0), (1, 1, 0), (0, 1, 0)]
    }
    uniform token subdivisionScheme = "none"
    normal3f[] normals = [(0, 0, 1), (0, 1, 0), (1, 0, 0), (0, 0, 1)] (interpolation = "faceVarying")
"""
    scene, told = load(tmp_path, f'def Mesh "M"\n{{{bent}}}\n', (-0.5, 0.5))
    mesh = scene["meshes"][0]
    assert np.asarray(mesh["triangles"]).reshape(-1, 3).tolist() == [[0, 1, 2], [0, 2, 3]]
    assert keys_of(mesh)[:, 1, 0] == pytest.approx([1.0, 0.55, 0.1])
    assert not any("topology" in line for line in told), told


def test_skinned_points_are_those_of_the_shutters_times(tmp_path):
    rig = """
def SkelRoot "R" (prepend apiSchemas = ["SkelBindingAPI"])
{
    def Skeleton "S" (prepend apiSchemas = ["SkelBindingAPI"])
    {
        uniform token[] joints = ["A"]
        uniform matrix4d[] bindTransforms = [((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))]
        uniform matrix4d[] restTransforms = [((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))]
        rel skel:animationSource = </R/S/Turn>
        def SkelAnimation "Turn"
        {
            uniform token[] joints = ["A"]
            float3[] translations.timeSamples = { 1: [(0, 0, 0)], 2: [(4, 0, 0)] }
            quatf[] rotations = [(1, 0, 0, 0)]
            half3[] scales = [(1, 1, 1)]
        }
    }
    def Mesh "M" (prepend apiSchemas = ["SkelBindingAPI"])
    {%s
        rel skel:skeleton = </R/S>
        matrix4d primvars:skel:geomBindTransform = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
        int[] primvars:skel:jointIndices = [0, 0, 0, 0] (
            elementSize = 1
            interpolation = "vertex"
        )
        float[] primvars:skel:jointWeights = [1, 1, 1, 1] (
            elementSize = 1
            interpolation = "vertex"
        )
    }
}
"""
    scene, _ = load(tmp_path, rig % QUAD)
    assert keys_of(scene["meshes"][0])[:, 0, 0] == pytest.approx([1.0, 2.0, 3.0])


def test_motion_vectors_want_the_frames_before_and_after(tmp_path):
    text = f'def Mesh "M"\n{{{QUAD}    double3 xformOp:translate.timeSamples = {{ 0: (-4, 0, 0), 4: (4, 0, 0) }}\n'
    text += '    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
    scene, _ = load(tmp_path, text, (0.0, 0.0), motion_vectors=True)
    assert not scene["settings"]["shutter"]["blur"]
    assert [key[0]["columns"][3][0] for key in scene["instances"][0]["motion"]] == pytest.approx([-3.0, 1.0])
    # Cameras that blur keep to their shutter.
    scene, _ = load(tmp_path, text, motion_vectors=True)
    assert scene["settings"]["shutter"]["blur"] and len(scene["instances"][0]["motion"]) == 3
    variables = """
def RenderSettings "S"
{
    uniform bool disableMotionBlur = 1
    rel camera = </Eye>
    rel products = </S/P>
    def RenderProduct "P"
    {
        rel orderedVars = </S/P/V>
        def RenderVar "V"
        {
            uniform string sourceName = "motionvector"
        }
    }
}
"""
    scene, told = load(tmp_path, text + variables, render_settings="/S")
    assert len(scene["instances"][0]["motion"]) == 2 and not scene["settings"]["shutter"]["blur"], told


def test_lights_whose_strength_changes_have_its_mean(tmp_path):
    text = 'def SphereLight "L"\n{\n    float inputs:intensity.timeSamples = { 1: 0, 1.5: 100, 2: 0 }\n    bool treatAsPoint = 0\n}\n'
    still = load(tmp_path, text, (0.0, 0.0))[0]["lights"][0]["emission"]["radiance"]
    found = load(tmp_path, text, (-0.5, 0.5))[0]["lights"][0]["emission"]["radiance"]
    # It rises and falls evenly: half of the strength of the middle.
    assert found == pytest.approx([0.5 * x for x in still])
    growing = "treatAsPoint = 0\n    float inputs:radius.timeSamples = { 1: 0.5, 2: 1 }"
    _, told = load(tmp_path, text.replace("treatAsPoint = 0", growing), (-0.5, 0.5))
    assert any("/L" in line and "form" in line for line in told), told
