"""What MaterialX's nodes know of places on surfaces: squares that are turned, scaled and moved, seen as light, against closed forms."""

import math

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

# A unit is 10 cm. The squares are two units wide, turned by 90 degrees about the view, and a row of them is seen from the front.
HEADER = '#usda 1.0\n(\n    metersPerUnit = 0.1\n    upAxis = "Y"\n)\ndef DomeLight "Dark"\n{\n    float inputs:intensity = 0\n}\n'
SQUARE = """
def Xform "Place{number}"
{{
    double3 xformOp:translate = ({middle}, 0, 0)
    double3 xformOp:rotateXYZ = (0, 0, 90)
    float3 xformOp:scale = (2, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ", "xformOp:scale"]
    def Mesh "Square" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        uniform token subdivisionScheme = "none"
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)]
        texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
        rel material:binding = </M{number}>
    }}
}}
def Material "M{number}"
{{
    token outputs:mtlx:surface.connect = </M{number}/S.outputs:out>
    def Shader "S"
    {{
        uniform token info:id = "ND_surface_unlit"
        color3f inputs:emission_color.connect = </M{number}/Lift.outputs:out>
        token outputs:out
    }}
    def Shader "Lift"
    {{
        uniform token info:id = "ND_add_color3"
        token inputs:in1.connect = </M{number}/N.outputs:out>
        color3f inputs:in2 = (64, 64, 64)
        token outputs:out
    }}
{shaders}}}
"""
# The size that a picture of this camera has of itself.
WIDTH, HEIGHT = 1280, 68


def shader(name, kind, body=""):
    return f'    def Shader "{name}"\n    {{\n        uniform token info:id = "{kind}"\n        {body}\n        token outputs:out\n    }}\n'


def reads(number, name, to):
    return f"token inputs:{name}.connect = </M{number}/{to}.outputs:out>\n        "


def space(name):
    return f'string inputs:space = "{name}"'


# The node that is looked at with those that it reads, and what the middle of its square must show, which lies at m.
FROM_OBJECT = '\n        string inputs:fromspace = "object"\n        string inputs:tospace = "world"'
TO_OBJECT = '\n        string inputs:fromspace = "world"\n        string inputs:tospace = "object"'
CASES = {
    "position object": (lambda n: shader("N", "ND_position_vector3"), lambda m: (0, 0, 0)),
    "position world": (lambda n: shader("N", "ND_position_vector3", space("world")), lambda m: (m, 0, 0)),
    "normal object": (lambda n: shader("N", "ND_normal_vector3"), lambda m: (0, 0, 1)),
    "normal world": (lambda n: shader("N", "ND_normal_vector3", space("world")), lambda m: (0, 0, 1)),
    "tangent object": (lambda n: shader("N", "ND_tangent_vector3"), lambda m: (1, 0, 0)),
    "tangent world": (lambda n: shader("N", "ND_tangent_vector3", space("world")), lambda m: (0, 1, 0)),
    "bitangent object": (lambda n: shader("N", "ND_bitangent_vector3"), lambda m: (0, 1, 0)),
    "bitangent world": (lambda n: shader("N", "ND_bitangent_vector3", space("world")), lambda m: (-1, 0, 0)),
    "view direction": (lambda n: shader("N", "ND_viewdirection_vector3"), lambda m: (0, 0, -1)),
    "coordinates": (lambda n: shader("N", "ND_texcoord_vector2"), lambda m: (0.5, 0.5)),
    "point to world": (
        lambda n: shader("N", "ND_transformpoint_vector3", "float3 inputs:in = (0.25, 0, 0)" + FROM_OBJECT),
        lambda m: (m, 0.5, 0),
    ),
    "vector to world": (
        lambda n: shader("N", "ND_transformvector_vector3", "float3 inputs:in = (0.25, 0, 0)" + FROM_OBJECT),
        lambda m: (0, 0.5, 0),
    ),
    "vector to object": (
        lambda n: shader("N", "ND_transformvector_vector3", "float3 inputs:in = (0, 0.5, 0)" + TO_OBJECT),
        lambda m: (0.25, 0, 0),
    ),
    "normal to world": (
        lambda n: shader("N", "ND_transformnormal_vector3", "float3 inputs:in = (3, 0, 0)" + FROM_OBJECT),
        lambda m: (0, 1, 0),
    ),
    # A slope of 16 along u and of 32 along v.
    "height": (lambda n: shader("N", "ND_heighttonormal_vector3", reads(n, "in", "H")) + slope(n), lambda m: coded(-1, -2, 1)),
    "height, half": (
        lambda n: shader("N", "ND_heighttonormal_vector3", "float inputs:scale = 0.5\n        " + reads(n, "in", "H")) + slope(n),
        lambda m: coded(-0.5, -1, 1),
    ),
    "normal map": (lambda n: shader("N", "ND_normalmap_float", "float3 inputs:in = (1, 0.5, 0.5)"), lambda m: (0, 1, 0)),
    "normal map, two strengths": (
        lambda n: shader("N", "ND_normalmap_vector2", "float2 inputs:scale = (1, 0.5)\n        float3 inputs:in = (1, 1, 1)"),
        lambda m: tuple(np.array([-0.5, 1, 1]) / 1.5),
    ),
    "normal map in a frame": (
        lambda n: shader(
            "N",
            "ND_normalmap_float",
            "float3 inputs:in = (1, 0.5, 0.75)\n        float3 inputs:normal = (1, 0, 0)\n        float3 inputs:tangent = (0, 0, 1)",
        ),
        lambda m: tuple(np.array([0.5, 0, 1]) / math.sqrt(1.25)),
    ),
}


def slope(n):
    """A height of 16 u + 32 v."""
    return shader("H", "ND_dotproduct_vector2", reads(n, "in1", "UV") + "float2 inputs:in2 = (16, 32)") + shader(
        "UV", "ND_texcoord_vector2"
    )


def coded(*direction):
    direction = np.array(direction, float)
    return tuple(direction / np.linalg.norm(direction) * 0.5 + 0.5)


@pytest.fixture(scope="module")
def middles(tmp_path_factory):
    """What the middles of the squares show."""
    stage = HEADER
    for number, (shaders, _) in enumerate(CASES.values()):
        stage += SQUARE.format(number=number, middle=2 * number + 1, shaders=shaders(number))
    stage += f"""
def Camera "Camera"
{{
    token projection = "orthographic"
    float horizontalAperture = {20 * len(CASES)}
    float verticalAperture = 20
    double3 xformOp:translate = ({len(CASES)}, 0, 5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""
    path = tmp_path_factory.mktemp("places") / "places.usda"
    path.write_text(stage)
    scene = gonio.load_usd(str(path), camera_light=False)
    assert not scene.diagnostics
    scene.set(width=WIDTH, height=HEIGHT, samples=16, passes=["color"], max_bounces=0)
    with gonio.Render(scene) as render:
        assert render.wait()
        columns = [int((number + 0.5) / len(CASES) * WIDTH) for number in range(len(CASES))]
        picture = np.asarray(render.film()["color"])[HEIGHT // 2, columns, :3]
    return dict(zip(CASES, picture.astype(float) - 64, strict=True))


@pytest.mark.parametrize("name", CASES)
def test_places(middles, name):
    middle = 2 * list(CASES).index(name) + 1
    expected = CASES[name][1](middle)
    # Positions and coordinates differ within a pixel.
    tolerance = 0.02 if name.startswith(("position", "coordinates")) else 1e-3
    assert middles[name][: len(expected)] == pytest.approx(expected, abs=tolerance)
