"""Displacement of stages: against the same meshes displaced beforehand, watertight, bounded in memory, and told where input is bad."""

import math

import numpy as np
import pictures
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

LAMP = """
def DistantLight "Sun"
{
    float inputs:intensity = 20000
    float inputs:angle = 1
    double3 xformOp:rotateXYZ = (-40, 25, 0)
    uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]
}
def DomeLight "Sky"
{
    float inputs:intensity = 0.3
}
"""
CAMERA = """
def Camera "Cam"
{
    float focalLength = 30
    float horizontalAperture = 20
    float verticalAperture = 20
    double3 xformOp:translate = (0, 2.4, 2.4)
    double3 xformOp:rotateXYZ = (-45, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
}
"""
INSIDE = CAMERA.replace("(0, 2.4, 2.4)", "(0.1, 0.05, 0)").replace(
    "focalLength = 30", "focalLength = 8\n    float2 clippingRange = (0.01, 100)"
)
PREVIEW = """
    def Shader "Surface"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (0.6, 0.6, 0.6)
        float inputs:roughness = 1
        %s
        token outputs:surface
        token outputs:displacement
    }
"""


def waves(u, v):
    return 0.12 * np.sin(9.0 * u) * np.cos(7.0 * v)


def rows(values):
    """Numbers or tuples as USD writes them."""
    values = np.asarray(values)
    one = (lambda value: f"{value:.7g}") if values.ndim == 1 else (lambda value: f"({', '.join(f'{x:.7g}' for x in value)})")
    return f"[{', '.join(one(value) for value in values)}]"


def plate(count):
    """A square of side 2 in the plane y = 0: points, faces and coordinates."""
    u, v = (axis.ravel() for axis in np.meshgrid(np.linspace(0, 1, count + 1), np.linspace(0, 1, count + 1), indexing="ij"))
    a = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    return (
        np.stack([2 * u - 1, 0 * u, 2 * v - 1], axis=1),
        np.stack([a, a + 1, a + count + 2, a + count + 1], axis=1),
        np.stack([u, v], axis=1),
    )


def mesh(points, faces, st, *more, scheme="none"):
    """A mesh of quads that shows the material /M."""
    corners = st[faces.ravel()]
    body = [
        f"int[] faceVertexCounts = {rows(np.full(len(faces), faces.shape[1]))}",
        f"int[] faceVertexIndices = {rows(faces.ravel())}",
        f"point3f[] points = {rows(points)}",
        f'uniform token subdivisionScheme = "{scheme}"',
        f'texCoord2f[] primvars:st = {rows(corners)} (interpolation = "faceVarying")',
        'uniform token faceVaryingLinearInterpolation = "all"',
        "rel material:binding = </M>",
        *more,
    ]
    return 'def Mesh "Plate" (prepend apiSchemas = ["MaterialBindingAPI"])\n{\n' + "\n".join(body) + "\n}\n"


def heights(values):
    return f'float[] primvars:height = {rows(values)} (interpolation = "vertex")'


def shader(path, name, kind, *lines, output="float outputs:result"):
    joined = "\n        ".join(lines).replace("@/", f"<{path}/").replace(";", ">")
    return f'    def Shader "{name}"\n    {{\n        uniform token info:id = "{kind}"\n        {joined}\n        {output}\n    }}\n'


def preview(path="/M", value="float inputs:displacement.connect = @/H.outputs:result;", *nodes):
    """UsdPreviewSurface that is displaced by the primvar `height`, or as said."""
    reader = shader(path, "H", "UsdPrimvarReader_float", 'string inputs:varname = "height"')
    surface = PREVIEW % value.replace("@/", f"<{path}/").replace(";", ">")
    ends = f"    token outputs:surface.connect = <{path}/Surface.outputs:surface>\n    token outputs:displacement.connect = <{path}/Surface.outputs:displacement>\n"
    return f'def Material "{path[1:]}"\n{{\n{ends}{surface}{"".join(nodes) or reader}}}\n'


def still():
    """The same surface without displacement."""
    return preview(value="").replace("    token outputs:displacement.connect = </M/Surface.outputs:displacement>\n", "")


def materialx(kind, value, *nodes):
    """A MaterialX displacement shader over a surface of UsdPreviewSurface."""
    moved = shader("/M", "D", f"ND_displacement_{kind}", *value, output="token outputs:out")
    ends = "    token outputs:surface.connect = </M/Surface.outputs:surface>\n    token outputs:mtlx:displacement.connect = </M/D.outputs:out>\n"
    return f'def Material "M"\n{{\n{ends}{PREVIEW % ""}{moved}{"".join(nodes)}}}\n'


def waves_of_materialx():
    """The heights of `waves` of the coordinates `st`."""
    return [
        shader("/M", "St", "ND_geompropvalue_vector2", 'string inputs:geomprop = "st"', output="float2 outputs:out"),
        shader("/M", "A", "ND_multiply_vector2", "float2 inputs:in1.connect = @/St.outputs:out;", "float2 inputs:in2 = (9, 7)", output="float2 outputs:out"),
        shader("/M", "Parts", "ND_separate2_vector2", "float2 inputs:in.connect = @/A.outputs:out;", output="float outputs:outx\n        float outputs:outy"),
        shader("/M", "Sin", "ND_sin_float", "float inputs:in.connect = @/Parts.outputs:outx;", output="float outputs:out"),
        shader("/M", "Cos", "ND_cos_float", "float inputs:in.connect = @/Parts.outputs:outy;", output="float outputs:out"),
        shader("/M", "H", "ND_multiply_float", "float inputs:in1.connect = @/Sin.outputs:out;", "float inputs:in2.connect = @/Cos.outputs:out;", output="float outputs:out"),
    ]  # fmt: skip


@pytest.fixture
def shown(run, tmp_path):
    """Renders a stage of these parts; gives the picture and what was said."""

    def render(name, *parts, spp=16, options=(), size=64):
        path = pictures.stage(tmp_path / f"{name}.usda", *parts)
        done = run(
            "render", path, "-v", "-o", tmp_path / f"{name}.exr", "--res", size, size, "--spp", spp, "--aov", "color,depth,P", *options
        )
        assert done.returncode == 0, done.stderr
        return pictures.read(tmp_path / f"{name}.exr"), done.stderr

    return render


def displaced_beforehand(shown, count=48):
    points, faces, st = plate(count)
    points[:, 1] = waves(*st.T)
    return shown("before", mesh(points, faces, st), still(), LAMP, CAMERA)[0]


def alike(first, second, colour=0.01, depth=2e-3):
    """Blocks of colour, and depth where both see the plate."""
    seen = (first["A"] == 1) & (second["A"] == 1)
    assert seen.mean() > 0.4 and np.abs(first["A"] - second["A"]).mean() < 0.002
    assert np.abs(first["depth.Z"] - second["depth.Z"])[seen].mean() < depth
    assert pictures.difference(first, second) < colour
    assert first.rgb[seen].std() > 0.1 * first.rgb[seen].mean()


# The same as displaced beforehand.

ONCE = "float inputs:displacement.connect = @/H.outputs:out;"
KINDS = {
    "preview": lambda: preview(),
    "float": lambda: materialx("float", [ONCE, "float inputs:scale = 0.12"], *waves_of_materialx()),
    "vector": lambda: materialx(
        "vector3",
        ["float3 inputs:displacement.connect = @/V.outputs:out;", "float inputs:scale = 0.12"],
        *waves_of_materialx(),
        shader("/M", "V", "ND_combine3_vector3", "float inputs:in3.connect = @/H.outputs:out;", output="float3 outputs:out"),
    ),
}


@pytest.mark.parametrize("kind", KINDS)
def test_displaced_meshes_are_those_displaced_beforehand(shown, kind):
    points, faces, st = plate(48)
    picture, said = shown("here", mesh(points, faces, st, heights(waves(*st.T))), KINDS[kind](), LAMP, CAMERA)
    assert "warning" not in said, said
    alike(displaced_beforehand(shown), picture)


def test_an_image_displaces(shown, tmp_path):
    import OpenEXR

    points, faces, st = plate(48)
    # Texel centres stand where the points are, so that both say the same heights; rows run downwards.
    values = waves(*np.meshgrid(np.linspace(0, 1, 49), np.linspace(0, 1, 49), indexing="xy"))
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    grey = np.ascontiguousarray(values[::-1].astype("f4") / 0.24 + 0.5)
    OpenEXR.File(header, {"RGB": np.repeat(grey[..., None], 3, axis=2)}).write(str(tmp_path / "heights.exr"))
    at = (st * 48 + 0.5) / 49
    nodes = [
        shader("/M", "St", "UsdPrimvarReader_float2", 'string inputs:varname = "st"', output="float2 outputs:result"),
        shader(
            "/M", "H", "UsdUVTexture", "asset inputs:file = @heights.exr@", 'token inputs:sourceColorSpace = "raw"',
            "float2 inputs:st.connect = @/St.outputs:result;", "float4 inputs:scale = (0.24, 0.24, 0.24, 1)",
            "float4 inputs:bias = (-0.12, -0.12, -0.12, 0)", 'token inputs:wrapS = "clamp"', 'token inputs:wrapT = "clamp"',
            output="float outputs:r",
        ),
    ]  # fmt: skip
    moved = preview("/M", "float inputs:displacement.connect = @/H.outputs:r;", *nodes)
    picture, said = shown("here", mesh(points, faces, at), moved, LAMP, CAMERA)
    assert "warning" not in said, said
    alike(displaced_beforehand(shown), picture)


def test_complexity_auto_finds_the_shape_of_few_faces(shown):
    """Eight by eight faces say nothing of the waves by themselves; cut to pixels they are the fine mesh."""
    moved = materialx("float", [ONCE, "float inputs:scale = 0.12"], *waves_of_materialx())
    coarse = mesh(*plate(4), scheme="bilinear")
    fine = displaced_beforehand(shown, 200)
    auto, said = shown("auto", coarse, moved, LAMP, CAMERA, options=["--complexity", "auto"])
    assert "warning" not in said, said
    alike(fine, auto, colour=0.02)
    low, _ = shown("low", coarse, moved, LAMP, CAMERA, options=["--complexity", "low"])
    assert pictures.difference(fine, low) > 5 * pictures.difference(fine, auto)


# Watertight.


def ball(rings, *, own_points=False):
    """A closed sphere of quads with a seam; triangles at the poles are quads of two equal points."""
    around = 2 * rings
    longitude, latitude = np.meshgrid(2 * np.pi * np.arange(around) / around, np.pi * (np.arange(1, rings) / rings - 0.5), indexing="ij")
    grid = np.stack([np.cos(latitude) * np.cos(longitude), np.sin(latitude), -np.cos(latitude) * np.sin(longitude)], axis=2).reshape(-1, 3)
    points = np.concatenate([grid, [(0, -1, 0), (0, 1, 0)]])
    low, high = len(grid), len(grid) + 1
    faces = []
    for k in range(around):
        a, b = k * (rings - 1), (k + 1) % around * (rings - 1)
        faces += [(a + j, b + j, b + j + 1, a + j + 1) for j in range(rings - 2)]
        faces += [(low, b, a, a), (high, a + rings - 2, b + rings - 2, b + rings - 2)]
    triangles = [(f[0], f[1], f[2]) for f in faces]
    triangles += [(f[0], f[2], f[3]) for f in faces if f[2] != f[3]]
    triangles = np.array(triangles)
    turn = np.arctan2(-points[:, 2], points[:, 0]) / (2 * np.pi)
    st = np.stack([turn, 0.5 + np.arcsin(np.clip(points[:, 1], -1, 1)) / np.pi], axis=1)
    if own_points:
        points, st, triangles = points[triangles.ravel()], st[triangles.ravel()], np.arange(triangles.size).reshape(-1, 3)
    return points, triangles, st


SUBSET = """
    def GeomSubset "Other" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        uniform token elementType = "face"
        uniform token familyName = "materialBind"
        int[] indices = {}
        rel material:binding = </N>
    }}
"""


@pytest.mark.parametrize("options", [["--complexity", "low"], ["--complexity", "auto"]], ids=["as it is", "auto"])
@pytest.mark.parametrize("own_points", [False, True], ids=["shared", "split"])
def test_closed_balls_stay_closed_across_faces_and_materials(shown, options, own_points):
    """From within, no pixel sees the background, though coordinates jump at a seam and two materials say other heights."""
    points, faces, st = ball(10, own_points=own_points)
    other = np.flatnonzero((np.arange(len(faces)) // 3) % 2)
    first = materialx("float", [ONCE, "float inputs:scale = 0.3"], *waves_of_materialx())
    second = (
        first.replace("inputs:scale = 0.3", "inputs:scale = -0.2")
        .replace("(9, 7)", "(31, 23)")
        .replace('Material "M"', 'Material "N"')
        .replace("</M/", "</N/")
    )
    scheme = "none" if options[1] == "low" else "bilinear"
    thing = mesh(points, faces, st, SUBSET.format(rows(other)), scheme=scheme)
    picture, said = shown("ball", thing, first, second, LAMP, INSIDE, options=options, size=96)
    assert "warning" not in said, said
    assert picture["A"].min() == 1.0, (picture["A"] < 1).sum()
    # It did move.
    seen = np.sqrt(sum(picture[f"P.{axis}"].astype(float) ** 2 for axis in "XYZ"))
    assert seen.max() > 1.1 and seen.min() < 0.95


# Limits and bad input.


def read(tmp_path, *parts):
    path = pictures.stage(tmp_path / "stage.usda", *parts)
    scene = gonio.load_usd(str(path))
    scene.set(width=32, height=32, samples=1, passes=["color"])
    return scene


def finished(scene):
    """All that was said."""
    with gonio.Render(scene) as render:
        assert render.wait()
        return [text for _, text in [*scene.diagnostics, *render.diagnostics]]


def test_meshes_beyond_the_memory_keep_their_shape(tmp_path):
    points, faces, st = plate(48)
    scene = read(tmp_path, mesh(points, faces, st, heights(waves(*st.T))), preview(), LAMP, CAMERA)
    scene.set(displacement_memory="64K")
    told = finished(scene)
    (line,) = [text for text in told if "displacing" in text]
    assert "4608 triangles" in line and "keeps its shape" in line


def overflow(factor):
    """Heights of the primvar, times a factor twice."""
    return materialx(
        "float",
        [ONCE],
        shader("/M", "P", "ND_geompropvalue_float", 'string inputs:geomprop = "height"', output="float outputs:out"),
        shader(
            "/M",
            "F",
            "ND_multiply_float",
            "float inputs:in1.connect = @/P.outputs:out;",
            f"float inputs:in2 = {factor}",
            output="float outputs:out",
        ),
        shader(
            "/M",
            "H",
            "ND_multiply_float",
            "float inputs:in1.connect = @/F.outputs:out;",
            f"float inputs:in2 = {factor}",
            output="float outputs:out",
        ),
    )


# Heights, the factor on them, what is said, and the share of points that may have moved.
BAD = {
    "primvar": ([math.nan, math.inf, -math.inf, math.nan], 1, "169 values that are not finite"),
    "computed": ([1, -1, 1, -1], 1e30, "displacement is not a number at 169 of 169 points"),
    "some": ([1, 0, 0, 0], 1e30, "displacement is not a number at 43 of 169 points"),
}


@pytest.mark.parametrize("name", BAD)
def test_heights_that_are_no_numbers_are_told_and_move_nothing(shown, name):
    points, faces, st = plate(12)
    values, factor, told = BAD[name]
    picture, said = shown("bad", mesh(points, faces, st, heights(np.resize(values, len(points)))), overflow(factor), LAMP, CAMERA)
    assert said.count("warning") == 1 and told in said, said
    plain, _ = shown("plain", mesh(points, faces, st), still(), LAMP, CAMERA)
    assert np.abs(plain["depth.Z"] - picture["depth.Z"])[plain["A"] == 1].max() < 1e-4
    assert pictures.difference(plain, picture) < 1e-3


@pytest.mark.parametrize("height", [1e9, 3e18, 1e30, 3e38])
def test_huge_heights_make_a_picture(shown, height):
    points, faces, st = plate(12)
    text = heights(np.resize([height, -height, 0.0], len(points)))
    picture, said = shown(
        "huge", mesh(points, faces, st, text, scheme="bilinear"), preview(), LAMP, CAMERA, options=["--complexity", "auto"]
    )
    assert np.isfinite(picture.rgb).all(), said


def test_a_missing_image_is_told_and_moves_nothing(shown):
    points, faces, st = plate(12)
    node = shader("/M", "H", "UsdUVTexture", "asset inputs:file = @nowhere.png@", output="float outputs:r")
    moved = preview("/M", "float inputs:displacement.connect = @/H.outputs:r;", node)
    picture, said = shown("missing", mesh(points, faces, st), moved, LAMP, CAMERA)
    assert "nowhere.png" in said, said
    plain, _ = shown("plain", mesh(points, faces, st), still(), LAMP, CAMERA)
    assert np.abs(plain["depth.Z"] - picture["depth.Z"])[plain["A"] == 1].max() < 1e-4


def test_unknown_displacement_shaders_are_told(shown):
    points, faces, st = plate(4)
    moved = materialx("float", [ONCE]).replace("ND_displacement_float", "MyDisplacement")
    _, said = shown("unknown", mesh(points, faces, st), moved, LAMP, CAMERA)
    assert "MyDisplacement" in said, said
