"""UsdLux lights: strength, shapes, shaping, textures, visibility."""

import math
import os
import pathlib

import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

HEADER = '#usda 1.0\n(\n    metersPerUnit = {metres}\n    upAxis = "{up}"\n)\n'


def shared(*parts):
    root = pathlib.Path(os.environ.get("GONIO_SHARED", pathlib.Path(__file__).resolve().parents[3].parent / "shared"))
    path = root.joinpath("data", "usd", *parts)
    if not path.exists():
        pytest.skip(f"{path} is not there")
    return path


def lights(tmp_path, text, metres=1, up="Y"):
    path = tmp_path / "stage.usda"
    path.write_text(HEADER.format(metres=metres, up=up) + text)
    return gonio.load_usd(str(path)).to_dict()


def light(tmp_path, kind, body, apis="", **options):
    schemas = f'(prepend apiSchemas = [{apis}])' if apis else ""
    return lights(tmp_path, f'def {kind} "L" {schemas}\n{{\n{body}\n}}\n', **options)["lights"][0]


@pytest.mark.parametrize(
    ("kind", "body", "shape"),
    [
        ("SphereLight", "float inputs:radius = 2", {"Sphere": {"radius": 2}}),
        ("DiskLight", "", {"Disk": {"radius": 0.5}}),
        ("RectLight", "float inputs:width = 3", {"Rectangle": {"width": 3, "height": 1}}),
        ("CylinderLight", "float inputs:length = 4", {"Cylinder": {"radius": 0.5, "length": 4}}),
        ("DistantLight", "float inputs:angle = 2", {"Distant": {"angle_deg": 2}}),
        ("DomeLight", 'token inputs:texture:format = "angular"', {"Dome": {"format": "Angular"}}),
    ],
)
def test_shapes(tmp_path, kind, body, shape):
    assert light(tmp_path, kind, body)["shape"] == shape


def test_strength_is_intensity_exposure_and_colour(tmp_path):
    body = "float inputs:intensity = 3\nfloat inputs:exposure = 2\ncolor3f inputs:color = (1, 0.5, 0.25)"
    assert light(tmp_path, "SphereLight", body)["emission"]["radiance"] == pytest.approx([12, 6, 3])


def test_old_names_without_prefix(tmp_path):
    assert light(tmp_path, "SphereLight", "float intensity = 7\nfloat radius = 3")["emission"]["radiance"] == pytest.approx([7] * 3)
    assert light(tmp_path, "SphereLight", "float radius = 3")["shape"] == {"Sphere": {"radius": 3}}


@pytest.mark.parametrize("kelvin", [1000, 2700, 6500, 10000])
def test_colour_temperature_is_that_of_usd_lux(tmp_path, kelvin):
    from pxr import UsdLux

    body = f"bool inputs:enableColorTemperature = 1\nfloat inputs:colorTemperature = {kelvin}"
    expected = list(UsdLux.BlackbodyTemperatureAsRgb(kelvin))
    assert light(tmp_path, "SphereLight", body)["emission"]["radiance"] == pytest.approx(expected, rel=1e-5)
    disabled = light(tmp_path, "SphereLight", f"float inputs:colorTemperature = {kelvin}")
    assert disabled["emission"]["radiance"] == [1] * 3


@pytest.mark.parametrize("kelvin", ["nan", "inf", "-inf", "-5", "0", "1e30"])
def test_absurd_colour_temperatures_are_told_and_shine(tmp_path, kelvin):
    body = f'def SphereLight "L"\n{{\n    bool inputs:enableColorTemperature = 1\n    float inputs:colorTemperature = {kelvin}\n}}\n'
    (tmp_path / "absurd.usda").write_text(f"#usda 1.0\n{body}")
    scene = gonio.load_usd(str(tmp_path / "absurd.usda"))
    radiance = scene.to_dict()["lights"][0]["emission"]["radiance"]
    assert all(0 <= part < math.inf for part in radiance) and max(radiance) > 0
    assert any("colorTemperature" in said for _, said in scene.diagnostics) == (kelvin in ("nan", "inf", "-inf")), scene.diagnostics


def test_normalize_measures_in_stage_units(tmp_path):
    emission = light(tmp_path, "RectLight", "bool inputs:normalize = 1", metres=0.01)["emission"]
    assert emission["normalized"] is True
    assert emission["metres_per_unit"] == pytest.approx(0.01)
    assert light(tmp_path, "DomeLight", "bool inputs:normalize = 1")["emission"]["normalized"] is False


@pytest.mark.parametrize(
    ("body", "candela"),
    [
        # A sphere of 1 cd/m² shows π r² of itself; normalized, a quarter of 1 over the square of the stage's unit.
        ("bool treatAsPoint = 1\nfloat inputs:radius = 20", 0.04 * 3.14159265),
        ("bool treatAsPoint = 1\nbool inputs:normalize = 1\nfloat inputs:radius = 20", 0.25e-4),
        ("bool inputs:normalize = 1\nfloat inputs:radius = 0", 0.25e-4),
    ],
)
def test_spheres_that_are_points_keep_their_intensity(tmp_path, body, candela):
    found = light(tmp_path, "SphereLight", body, metres=0.01)
    assert found["shape"] == "Point"
    assert found["emission"]["radiance"] == pytest.approx([candela] * 3, rel=1e-6)
    assert found["emission"]["normalized"] is False


def test_transforms_are_in_metres(tmp_path):
    body = 'double3 xformOp:translate = (100, 200, 300)\nuniform token[] xformOpOrder = ["xformOp:translate"]'
    columns = light(tmp_path, "SphereLight", body, metres=0.01)["transform"]["columns"]
    assert columns[3] == pytest.approx([1, 2, 3])
    assert columns[0] == pytest.approx([0.01, 0, 0])


def test_shaping_that_changes_nothing_is_not_told_of_suns(tmp_path):
    # As Omniverse writes it to all lights.
    def told(body):
        path = tmp_path / "stage.usda"
        path.write_text(HEADER.format(metres=1, up="Y") + f'def DistantLight "L" (prepend apiSchemas = ["ShapingAPI"])\n{{\n{body}\n}}\n')
        return str(gonio.load_usd(str(path)).diagnostics)

    old = "float shaping:cone:angle = 180\n float shaping:focus\n asset shaping:ies:file"
    for body in ["", old, "float inputs:shaping:cone:angle = 180\n float inputs:shaping:focus = 0"]:
        assert "shaping" not in told(body)
    for body in ["float inputs:shaping:cone:angle = 30", "float inputs:shaping:focus = 2", "asset inputs:shaping:ies:file = @a.ies@"]:
        assert "shaping of lights at infinity is not supported" in told(body)


def test_shaping(tmp_path):
    plain = light(tmp_path, "SphereLight", "")["shaping"]
    assert plain["cone_angle_deg"] is None
    # The schema's default cone of 90 degrees holds once the API is applied.
    assert light(tmp_path, "SphereLight", "", apis='"ShapingAPI"')["shaping"]["cone_angle_deg"] == 90
    body = """float inputs:shaping:cone:angle = 30
        float inputs:shaping:cone:softness = 0.25
        float inputs:shaping:focus = 4
        color3f inputs:shaping:focusTint = (1, 0, 0)"""
    shaping = light(tmp_path, "SphereLight", body, apis='"ShapingAPI"')["shaping"]
    assert shaping == {"cone_angle_deg": 30, "cone_softness": 0.25, "focus": 4, "focus_tint": [1, 0, 0]}
    full = light(tmp_path, "SphereLight", "float inputs:shaping:cone:angle = 180", apis='"ShapingAPI"')["shaping"]
    assert full["cone_angle_deg"] is None


@pytest.mark.parametrize(
    ("line", "seen"),
    [
        ("", True),
        ("int primvars:ri:attributes:visibility:camera = 0", False),
        ("bool primvars:arnold:visibility:camera = 0", False),
        ('string primvars:karma:object:rendervisibility = "-primary"', False),
        ('string primvars:karma:object:rendervisibility = "*"', True),
        ("int primvars:ri:attributes:visibility:camera = 1", True),
    ],
)
def test_visibility_to_the_camera(tmp_path, line, seen):
    assert light(tmp_path, "RectLight", line)["visibility"]["camera"] is seen


def test_shadows_can_be_switched_off(tmp_path):
    assert light(tmp_path, "RectLight", "")["casts_shadow"] is True
    assert light(tmp_path, "RectLight", "bool inputs:shadow:enable = 0", apis='"ShadowAPI"')["casts_shadow"] is False


def test_textures(tmp_path):
    (tmp_path / "sky.exr").write_bytes(b"")
    scene = lights(tmp_path, 'def DomeLight "L"\n{\n    asset inputs:texture:file = @sky.exr@\n}\n')
    assert scene["textures"][scene["lights"][0]["texture"]]["source"]["File"].endswith("sky.exr")
    scene = lights(tmp_path, 'def DomeLight "L"\n{\n    asset inputs:texture:file = @missing.exr@\n}\n')
    assert scene["lights"][0]["texture"] is None


@pytest.mark.parametrize(
    ("kind", "pole", "up", "image_up"),
    [
        ("DomeLight", None, "Z", [0, 1, 0]),
        ("DomeLight_1", None, "Z", [0, 0, 1]),
        ("DomeLight_1", None, "Y", [0, 1, 0]),
        ("DomeLight_1", "Y", "Z", [0, 1, 0]),
        ("DomeLight_1", "Z", "Y", [0, 0, 1]),
    ],
)
def test_pole_of_domes(tmp_path, kind, pole, up, image_up):
    body = f'uniform token poleAxis = "{pole}"' if pole else ""
    assert light(tmp_path, kind, body, up=up)["transform"]["columns"][1] == pytest.approx(image_up)


MESH_LIGHT = """
def Mesh "Mesh" (prepend apiSchemas = ["MeshLightAPI"])
{
    float inputs:intensity = 5
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [0, 1, 2]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    uniform token subdivisionScheme = "none"
}
"""


def test_mesh_lights_emit_by_their_material(tmp_path):
    scene = lights(tmp_path, MESH_LIGHT)
    material = scene["materials"][scene["instances"][0]["materials"][0]]
    assert dict(material["closures"][0]["parameters"])["emission_color"]["Constant"][:3] == [5] * 3


@pytest.mark.parametrize(
    ("frame", "radius", "normalized"), [(1, 0.5, False), (6, None, None), (16, None, None)]
)
def test_luxtest_is_read_at_the_frame(frame, radius, normalized):
    from pxr import Usd, UsdLux

    path = str(shared("luxtest", "usd", "sphere.usda"))
    found = gonio.load_usd(path, frame=frame).to_dict()["lights"][0]
    stage = Usd.Stage.Open(path)
    schema = UsdLux.SphereLight.Get(stage, "/lights/sphere_light")
    expected = [c * schema.GetIntensityAttr().Get(frame) * 2 ** schema.GetExposureAttr().Get(frame) for c in schema.GetColorAttr().Get(frame)]
    if schema.GetEnableColorTemperatureAttr().Get(frame):
        black_body = UsdLux.BlackbodyTemperatureAsRgb(schema.GetColorTemperatureAttr().Get(frame))
        expected = [a * b for a, b in zip(expected, black_body)]
    assert found["emission"]["radiance"] == pytest.approx(expected, rel=1e-5)
    assert found["shape"]["Sphere"]["radius"] == pytest.approx(schema.GetRadiusAttr().Get(frame) if radius is None else radius)
    assert found["emission"]["normalized"] == (schema.GetNormalizeAttr().Get(frame) if normalized is None else normalized)
    assert found["visibility"]["camera"] is False
