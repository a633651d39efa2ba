"""Light filters of UsdLux against closed forms: barn doors, pictures, what is multiplied, and what is left out by name."""

import numpy as np
import pictures
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

# A white floor of 8 m × 8 m, seen from the lamp's height of 2 m by a camera that looks down.
FLOOR = """
def Mesh "Floor" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    point3f[] points = [(-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    color3f[] primvars:displayColor = [(0.5, 0.5, 0.5)]
}
def Camera "Camera"
{
    token projection = "orthographic"
    float horizontalAperture = 80
    float verticalAperture = 80
    double3 xformOp:translate = (0, 0, 5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
HEIGHT, INTENSITY = 2.0, 40.0
# A point of INTENSITY candela: normalized light over 4πr², of which πr² is seen.
POINT = """
def SphereLight "Lamp"
{
    float inputs:radius = 0.001
    bool treatAsPoint = 1
    bool inputs:normalize = 1
    float inputs:intensity = %s
    rel light:filters = %s
    double3 xformOp:translate = (0, 0, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    %s
}
"""
PICTURE = 64


def point(filters, *children):
    return POINT % (4 * INTENSITY, filters, "\n    ".join(children))


def filter_of(kind, body, name="Filter", z=-1.0):
    place = f'double3 xformOp:translate = (0, 0, {z})\n    uniform token[] xformOpOrder = ["xformOp:translate"]'
    return f'def {kind} "{name}"\n    {{\n    {body}\n    {place}\n    }}'


def read(tmp_path, text):
    return gonio.load_usd(str(pictures.stage(tmp_path / "stage.usda", FLOOR, text, up="Z")))


def irradiance(tmp_path, text, samples=16):
    """Lux on the floor, (64, 64, 3), y up and x to the right; 8 pixels a metre."""
    scene = read(tmp_path, text)
    scene.set(width=PICTURE, height=PICTURE, samples=samples, max_bounces=0, passes=["color"], filter="box", filter_width=1.0)
    with gonio.Render(scene) as rendering:
        rendering.wait()
        found = np.array(rendering.film()["color"])[:, :, :3]
    # Radiance of a Lambertian of 0.5.
    return found[::-1] * np.pi / 0.5


def expected():
    """Lux of the bare point at the pixels' middles."""
    middle = (np.arange(PICTURE) + 0.5) / 8 - 4
    x, y = np.meshgrid(middle, middle)
    return x, y, INTENSITY * HEIGHT / (x * x + y * y + HEIGHT**2) ** 1.5


BARN = "PxrBarnLightFilter"


def test_a_barn_throws_its_opening(tmp_path):
    # An opening of 1 × 0.5 m half way down lights 2 × 1 m of the floor.
    barn = filter_of(BARN, "float inputs:ri:lightFilter:width = 1\n    float inputs:ri:lightFilter:height = 0.5")
    found = irradiance(tmp_path, point("</Lamp/Filter>", barn))
    x, y, bare = expected()
    inside = (abs(x) < 0.9) & (abs(y) < 0.4)
    outside = (abs(x) > 1.1) | (abs(y) > 0.6)
    assert found[inside] == pytest.approx(np.repeat(bare[inside, None], 3, axis=1), rel=0.01)
    assert found[outside].max() == 0.0


def test_names_of_the_schemas_before_and_what_is_refined(tmp_path):
    body = "float inputs:width = 1\n    float inputs:height = 1\n    float inputs:scale:width = 2\n    float inputs:refine:top = 0.5"
    found = irradiance(tmp_path, point("</Lamp/Filter>", filter_of(BARN, body)))[..., 0]
    x, y, bare = expected()
    inside = (abs(x) < 1.9) & (y > -0.9) & (y < 1.9)
    outside = (abs(x) > 2.1) | (y < -1.1) | (y > 2.1)
    assert found[inside] == pytest.approx(bare[inside], rel=0.01) and found[outside].max() == 0.0


def test_a_lone_filter_of_a_shader_s_name_that_stands_beside_the_light(tmp_path):
    barn = filter_of("LightFilter", f'token lightFilter:shaderId = "{BARN}"', "Door", z=1.0)
    found = irradiance(tmp_path, point("</Door>") + barn)[..., 0]
    x, y, bare = expected()
    inside, outside = (abs(x) < 0.9) & (abs(y) < 0.9), (abs(x) > 1.1) | (abs(y) > 1.1)
    assert found[inside] == pytest.approx(bare[inside], rel=0.01) and found[outside].max() == 0.0


COLOURS = [[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (255, 255, 255)]]


@pytest.mark.parametrize("kind", ["PxrCookieLightFilter", "PxrGoboLightFilter"])
def test_a_picture_is_thrown_in_colour(tmp_path, kind):
    pictures.write_png(tmp_path / "slide.png", COLOURS)
    body = 'asset inputs:ri:lightFilter:map = @./slide.png@\n    float inputs:ri:lightFilter:width = 2\n    float inputs:ri:lightFilter:height = 2'
    found = irradiance(tmp_path, point("</Lamp/Filter>", filter_of(kind, body)), samples=256)
    x, y, bare = expected()
    # The outer half of each quarter is of one texel: 4 × 4 m are lit.
    outer = (abs(x) > 1.1) & (abs(y) > 1.1) & (abs(x) < 1.9) & (abs(y) < 1.9)
    for right, upper, colour in [(0, 1, (1, 0, 0)), (1, 1, (0, 1, 0)), (0, 0, (0, 0, 1)), (1, 0, (1, 1, 1))]:
        part = outer & ((x > 0) == right) & ((y > 0) == upper)
        # Each colour shines by itself, and a sample takes one of them.
        assert found[part].mean(axis=0) == pytest.approx(bare[part].mean() * np.array(colour), rel=0.03, abs=1e-3)
    assert found[(abs(x) > 2.1) | (abs(y) > 2.1)].max() == 0.0


def test_fill_density_and_inversion(tmp_path):
    pictures.write_png(tmp_path / "slide.png", [[(255, 255, 255)]])
    body = (
        "asset inputs:ri:lightFilter:map = @./slide.png@\n    color3f inputs:ri:lightFilter:fillColor = (0.5, 0.5, 0.5)\n"
        "    float inputs:ri:lightFilter:density = 0.5\n    bool inputs:ri:lightFilter:invert = 1"
    )
    found = irradiance(tmp_path, point("</Lamp/Filter>", filter_of("PxrCookieLightFilter", body)))[..., 0]
    x, y, bare = expected()
    inside, outside = (abs(x) < 0.9) & (abs(y) < 0.9), (abs(x) > 1.2) | (abs(y) > 1.2)
    assert found[inside] == pytest.approx(0.5 * bare[inside], rel=0.01)
    assert found[outside] == pytest.approx(0.75 * bare[outside], rel=0.01)


def test_two_filters_multiply(tmp_path):
    barn = filter_of(BARN, "float inputs:ri:lightFilter:width = 1", "Door")
    dimmer = filter_of("PxrIntMultLightFilter", "float inputs:ri:lightFilter:intensity = 0.5\n    float inputs:ri:lightFilter:exposure = -1", "Dim")
    found = irradiance(tmp_path, point("[</Lamp/Door>, </Lamp/Dim>]", barn, dimmer))[..., 0]
    x, y, bare = expected()
    inside = (abs(x) < 0.9) & (abs(y) < 0.9)
    assert found[inside] == pytest.approx(0.25 * bare[inside], rel=0.01)


RECT = """
def RectLight "Lamp"
{
    float inputs:width = 0.4
    float inputs:height = 0.4
    float inputs:intensity = 100
    rel light:filters = </Lamp/Filter>
    double3 xformOp:translate = (0, 0, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    %s
}
"""


def test_a_picture_on_a_rectangle_s_face(tmp_path):
    pictures.write_png(tmp_path / "slide.png", [[(255, 255, 255), (0, 0, 0)]])
    body = 'asset inputs:ri:lightFilter:map = @./slide.png@\n    float inputs:ri:lightFilter:width = 0.4\n    float inputs:ri:lightFilter:height = 0.4'
    whole = irradiance(tmp_path, RECT.replace("    rel light:filters = </Lamp/Filter>\n", "") % "", samples=256)
    half = irradiance(tmp_path, RECT % filter_of("PxrCookieLightFilter", body, z=0), samples=256)
    # Straight below each half of the face gives as much; the lit one is that of negative x.
    middle = slice(30, 34)
    assert half[middle, middle].mean() == pytest.approx(0.5 * whole[middle, middle].mean(), rel=0.02)
    ratio = half[..., 0].mean(axis=0) / whole[..., 0].mean(axis=0)
    assert ratio[:8].mean() > ratio[-8:].mean() + 1e-3


def overlap(low, high, start, end):
    """The share of each span from `low` to `high` that lies between two places."""
    return np.clip(np.minimum(high, end) - np.maximum(low, start), 0, None) / (high - low)


@pytest.mark.parametrize("turned", [False, True])
def test_a_large_light_throws_a_half_shadow(tmp_path, turned):
    # A square of 0.4 m, an opening of 1 × 0.8 m half way down: a place x of the floor sees the light's points s with |s + x| < 1.
    width, height = (0.8, 1) if turned else (1, 0.8)
    barn = filter_of(BARN, f"float inputs:ri:lightFilter:width = {width}\n    float inputs:ri:lightFilter:height = {height}")
    whole = irradiance(tmp_path, RECT.replace("    rel light:filters = </Lamp/Filter>\n", "") % "", samples=1024)[..., 0]
    found = irradiance(tmp_path, RECT % barn, samples=1024)[..., 0] / whole
    # Means over the light's points and over the pixels, by quadrature.
    x, y, _ = expected()
    reach = (0.8, 1.0) if turned else (1.0, 0.8)
    shares = np.zeros_like(x)
    offsets = (np.arange(8) + 0.5) / 64 - 1 / 16
    for across in offsets:
        for up in offsets:
            seen = [overlap(place - 0.2, place + 0.2, -most, most) for place, most in ((x + across, reach[0]), (y + up, reach[1]))]
            shares += seen[0] * seen[1] / 64
    # The nearer side of the light is a little brighter, which shifts the edge by less than a tenth of its width.
    assert np.abs(found - shares).max() < 0.06 and np.abs(found - shares).mean() < 0.004
    half = (shares > 0.1) & (shares < 0.9)
    assert half.sum() > 100 and ((found > 0.05) & (found < 0.95))[half].all()


def test_a_ball_throws_the_opening_as_its_points_do(tmp_path):
    # The edge of a half plane: a ball of radius r shows the part of its disk that lies beyond a chord.
    radius = "float inputs:radius = 0.2\n    bool primvars:gonio:visibility:camera = 0"
    ball = RECT.replace("RectLight", "SphereLight").replace("float inputs:width = 0.4\n    float inputs:height = 0.4", radius)
    size = [f"float inputs:ri:lightFilter:{name} = {length}" for name, length in (("width", 0), ("height", 20), ("left", 10))]
    barn = filter_of(BARN, "\n    ".join(size))
    whole = irradiance(tmp_path, ball.replace("    rel light:filters = </Lamp/Filter>\n", "") % "", samples=1024)[..., 0]
    found = (irradiance(tmp_path, ball % barn, samples=1024)[..., 0] / whole)[28:36].mean(axis=0)
    middle = (np.arange(PICTURE) + 0.5) / 8 - 4
    chord = np.clip(-middle / 0.2, -1, 1)
    expected_share = 0.5 + (chord * np.sqrt(1 - chord**2) + np.arcsin(chord)) / np.pi
    near = abs(middle) > 0.2
    assert found[near] == pytest.approx(expected_share[near], abs=0.02)
    assert np.abs(found - expected_share).max() < 0.08


def told(tmp_path, text):
    return [message for _, message in read(tmp_path, text).diagnostics]


def test_what_is_left_out_is_named(tmp_path):
    assert any("a light filter of type PxrRodLightFilter is not supported" in line for line in told(tmp_path, point("</Lamp/Filter>", filter_of("PxrRodLightFilter", ""))))
    assert any("analytic mode" in line for line in told(tmp_path, point("</Lamp/Filter>", filter_of(BARN, "int inputs:ri:lightFilter:barnMode = 1"))))
    assert any("names no picture" in line for line in told(tmp_path, point("</Lamp/Filter>", filter_of("PxrCookieLightFilter", ""))))
    absent = filter_of("PxrCookieLightFilter", "asset inputs:ri:lightFilter:map = @./absent.png@")
    assert any("'./absent.png' does not exist; the filter is left out" in line for line in told(tmp_path, point("</Lamp/Filter>", absent)))
    assert any("the light's middle" in line for line in told(tmp_path, point("</Lamp/Filter>", filter_of(BARN, "", z=0))))
    sun = 'def DistantLight "Sun"\n{\n    rel light:filters = </Door>\n}\n' + filter_of(BARN, "", "Door")
    assert any("a light filter on a light at infinity is not supported" in line for line in told(tmp_path, sun))
    mesh = FLOOR.split("def Camera")[0].replace("Floor", "Glow").replace('["MaterialBindingAPI"]', '["MeshLightAPI"]')
    mesh = mesh.replace("{\n", "{\n    rel light:filters = </Door>\n", 1)
    assert any(f"a light filter of type {BARN} is not supported" in line for line in told(tmp_path, mesh + filter_of(BARN, "", "Door")))


def test_a_light_without_filters_stays_one(tmp_path):
    assert len(read(tmp_path, point("[]")).to_dict()["lights"]) == 1


@pytest.mark.parametrize(("diffuse", "specular"), [(1, 1), (0.5, 1), (0, 1), (2, 0)])
def test_the_diffuse_multiplier(tmp_path, diffuse, specular):
    text = point("[]", f"float inputs:diffuse = {diffuse}\n    float inputs:specular = {specular}")
    found = irradiance(tmp_path, text)[..., 0]
    assert found == pytest.approx(diffuse * expected()[2], rel=0.01)


MIRROR = """
def Mesh "Mirror" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    point3f[] points = [(-4, -4, 0), (4, -4, 0), (4, 4, 0), (-4, 4, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    rel material:binding = </Metal>
}
def Material "Metal"
{
    token outputs:surface.connect = </Metal/S.outputs:surface>
    def Shader "S"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (1, 1, 1)
        float inputs:metallic = 1
        float inputs:roughness = %s
        token outputs:surface
    }
}
"""


@pytest.mark.parametrize("roughness", [0.0, 0.4])
def test_the_specular_multiplier(tmp_path, roughness):
    lamp = """
def SphereLight "Lamp"
{
    float inputs:radius = 0.5
    float inputs:intensity = 100
    double3 xformOp:translate = (0, 0, 1)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    bool primvars:gonio:visibility:camera = 0
    %s
}
"""

    def mean(factors):
        parts = MIRROR % roughness, "def Camera" + FLOOR.split("def Camera")[1], lamp % factors
        scene = gonio.load_usd(str(pictures.stage(tmp_path / "stage.usda", *parts, up="Z")))
        scene.set(width=32, height=32, samples=256, max_bounces=1, passes=["color"])
        with gonio.Render(scene) as rendering:
            rendering.wait()
            return np.array(rendering.film()["color"])[:, :, 1].mean()

    plain = mean("")
    assert plain > 0.0
    assert mean("float inputs:specular = 0.25") == pytest.approx(0.25 * plain, rel=0.03)
    assert mean("float inputs:diffuse = 0") == pytest.approx(plain, rel=0.03)


def test_a_multiplier_that_is_no_number(tmp_path):
    assert any("diffuse is -1, expected a number" in line for line in told(tmp_path, point("[]", "float inputs:diffuse = -1")))
