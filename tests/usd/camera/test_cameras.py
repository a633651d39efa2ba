"""UsdGeom cameras: units, lens, exposure, choice, and the automatic camera."""

import math

import numpy as np
import pictures
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")


def load(tmp_path, text, metres=0.01, up="Y", **options):
    path = tmp_path / "stage.usda"
    path.write_text(f'#usda 1.0\n(\n    metersPerUnit = {metres}\n    upAxis = "{up}"\n)\n{text}')
    return gonio.load_usd(str(path), **options).to_dict()


def camera(tmp_path, body, **options):
    scene = load(tmp_path, f'def Camera "C"\n{{\n{body}\n}}\n', **options)
    return scene["cameras"][scene["settings"]["camera"]]


def slope(camera):
    focal_length = camera["projection"]["Perspective"]["focal_length"]
    return [a / focal_length for a in camera["aperture"]]


@pytest.mark.parametrize("metres", [1, 0.01])
def test_field_of_view_does_not_depend_on_the_unit(tmp_path, metres):
    # The aperture may be conformed to the picture in one direction; the default policy never shrinks it.
    width, height = slope(camera(tmp_path, "", metres=metres))
    assert width == pytest.approx(20.955 / 50) or height == pytest.approx(15.2908 / 50)
    assert width >= 20.955 / 50 - 1e-6
    assert height >= 15.2908 / 50 - 1e-6


def test_lens(tmp_path):
    c = camera(tmp_path, "float focalLength = 50\nfloat fStop = 2\nfloat focusDistance = 300", metres=0.01)
    assert c["lens_radius"] == pytest.approx(0.0125)
    assert c["focus_distance"] == pytest.approx(3)
    c = camera(tmp_path, "float focalLength = 0.5\nfloat fStop = 2\nfloat focusDistance = 3", metres=1)
    assert c["lens_radius"] == pytest.approx(0.0125)
    assert camera(tmp_path, "float fStop = 2")["lens_radius"] == 0
    assert camera(tmp_path, "float focusDistance = 300")["lens_radius"] == 0


def test_clipping_range_in_metres(tmp_path):
    assert camera(tmp_path, "float2 clippingRange = (10, 1000)")["clipping"] == pytest.approx([0.1, 10])


def test_orthographic_apertures_are_metres(tmp_path):
    body = 'token projection = "orthographic"\nfloat horizontalAperture = 200\nfloat verticalAperture = 112.5'
    c = camera(tmp_path, body, metres=0.01)
    assert c["projection"] == "Orthographic"
    assert c["aperture"] == pytest.approx([0.2, 0.1125], rel=1e-3)


def test_exposure(tmp_path):
    from pxr import UsdGeom

    assert camera(tmp_path, "")["exposure"] == 1
    assert camera(tmp_path, "float exposure = 3")["exposure"] == pytest.approx(8)
    if hasattr(UsdGeom.Camera, "ComputeLinearExposureScale"):
        body = "float exposure:time = 0.01\nfloat exposure:iso = 400\nfloat exposure:fStop = 4"
        assert camera(tmp_path, body)["exposure"] == pytest.approx(0.01 * 4 / 16)


THREE = 'def Xform "A"\n{\n    def Camera "left" {}\n    def Camera "main_cam" {}\n}\ndef Camera "right" {}\n'


@pytest.mark.parametrize(("wanted", "expected"), [(None, "/A/main_cam"), ("left", "/A/left"), ("/right", "/right")])
def test_choice(tmp_path, wanted, expected):
    options = {} if wanted is None else {"camera": wanted}
    scene = load(tmp_path, THREE, **options)
    assert scene["cameras"][scene["settings"]["camera"]]["origin"]["name"] == expected


def test_unknown_cameras_are_an_error(tmp_path):
    with pytest.raises(Exception, match="nope.*left"):
        load(tmp_path, THREE, camera="nope")


MESH = """
def Mesh "Mesh"
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-100, 0, 0), (300, 0, 50), (300, 200, 0), (-100, 200, 50)]
    uniform token subdivisionScheme = "none"
}
"""


@pytest.mark.parametrize("up", ["Y", "Z"])
def test_stages_without_camera_are_framed(tmp_path, up):
    scene = load(tmp_path, MESH, up=up)
    c = scene["cameras"][scene["settings"]["camera"]]
    columns = c["transform"]["columns"]
    assert columns[1][1 if up == "Y" else 2] > 0.5
    half = [0.5 * s for s in slope(c)]
    for point in [(-1, 0, 0), (3, 0, 0.5), (3, 2, 0), (-1, 2, 0.5)]:
        offset = [p - e for p, e in zip(point, columns[3])]
        x, y, z = (sum(a * b for a, b in zip(offset, axis)) for axis in columns[:3])
        assert z < 0
        assert abs(x / -z) <= half[0] and abs(y / -z) <= half[1]
    assert math.isfinite(columns[3][0])


def test_stages_without_light_get_one_at_the_camera(tmp_path):
    scene = load(tmp_path, MESH)
    (light,) = scene["lights"]
    assert list(light["shape"]) == ["Distant"] and not light["casts_shadow"]
    assert light["transform"] == scene["cameras"][scene["settings"]["camera"]]["transform"]


def test_clipping_planes_cut_in_the_camera_s_space(picture, tmp_path):
    planes = "    float4[] clippingPlanes = [(1, 0, 0, 0), (0, 0, 1, 0.07)]\n"
    wall = 'def Cube "Far"\n{\n    double size = 2\n    double3 xformOp:translate = (0, 0, -900)\n    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
    wall += 'def Cube "Near"\n{\n    double size = 2\n    double3 xformOp:translate = (0, 0, -5)\n    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
    view = 'def Camera "Cam"\n{\n    float2 clippingRange = (0.01, 10000)\n    float focalLength = 50\n    float horizontalAperture = 10\n    float verticalAperture = 10\nPLANES}\n'
    options = ["--aov", "color,depth", "--filter", "box", "--filter-width", 0.01]
    plain = picture(pictures.stage(tmp_path / "a.usda", wall, view.replace("PLANES", ""), metres=0.01), *options, name="a.exr")
    cut = picture(pictures.stage(tmp_path / "b.usda", wall, view.replace("PLANES", planes), metres=0.01), *options, name="b.exr")
    assert plain["A"].min() == 1
    # Nothing to the left of the axis, and on the right nothing beyond 0.07 of the stage's units along the axis: both cubes are gone.
    assert cut["A"].max() == 0
    half = picture(pictures.stage(tmp_path / "c.usda", wall, view.replace("PLANES", planes.replace(", (0, 0, 1, 0.07)", "")), metres=0.01), *options, name="c.exr")
    assert half["A"][:, :16].max() == 0 and half["A"][:, 16:].min() == 1
    kept = picture(pictures.stage(tmp_path / "d.usda", wall, view.replace("PLANES", planes.replace("0.07", "7").replace("(1, 0, 0, 0), ", "")), metres=0.01), *options, name="d.exr")
    assert np.array_equal(kept["depth.Z"], plain["depth.Z"])
