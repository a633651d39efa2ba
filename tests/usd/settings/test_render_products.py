"""UsdRender's pictures: data windows beyond the picture, products as files, variables as layers."""

import numpy as np
import pictures
import pytest

gonio = pytest.importorskip("gonio")

SCENE = """
def Camera "Cam"
{
    float focalLength = 50
    float horizontalAperture = 36
    float verticalAperture = 36
    double3 xformOp:translate = (0, 0, 10)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def DomeLight "Sky"
{
    float inputs:intensity = 0.5
}
def Mesh "Wall"
{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-10, -10, 0), (10, -10, 0), (10, 10, 0), (-10, 10, 0)]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
    color3f[] primvars:displayColor = [(0.1, 0.5, 0.2)]
    float primvars:wear = 0.75
}
"""
# The camera sees 7.2 m of it.
SEEN = 7.2 / 20

VARIABLES = """
def Scope "Vars"
{
    def RenderVar "color" { SOURCE "C.*[LO]"
        uniform token sourceType = "lpe" }
    def RenderVar "uv" { SOURCE "st"
        uniform token sourceType = "primvar" }
    def RenderVar "dc" { SOURCE "displayColor"
        uniform token sourceType = "primvar" }
    def RenderVar "worn" { SOURCE "wear"
        uniform token dataType = "float"
        uniform token sourceType = "primvar" }
    def RenderVar "N" { SOURCE "Neye" }
    def RenderVar "eye" { SOURCE "Peye" }
    def RenderVar "Pc" { SOURCE "P" }
    def RenderVar "Pg" { SOURCE "P" }
    def RenderVar "direct" { SOURCE "C<RD>[<L.>O]"
        uniform token sourceType = "lpe" }
    def RenderVar "all" { SOURCE "C<RD>.*[<L.>O]"
        uniform token sourceType = "lpe" }
}
""".replace("SOURCE", "uniform string sourceName =").replace("{ ", "{\n        ").replace(" }", "\n    }")
ALL = "[" + ", ".join(f"</Vars/{name}>" for name in ["color", "uv", "dc", "worn", "N", "eye", "Pc", "Pg", "direct", "all"]) + "]"


def settings(body="", *products):
    listed = ", ".join(f"</P{number}>" for number in range(len(products)))
    text = f'def RenderSettings "S"\n{{\n    rel camera = </Cam>\n    uniform int2 resolution = (40, 40)\n    {body}\n    rel products = [{listed}]\n}}\n'
    return text + "".join(f'def RenderProduct "P{number}"\n{{\n    {product}\n}}\n' for number, product in enumerate(products))


def windows(picture):
    ends = lambda window: [tuple(int(x) for x in end) for end in window]
    return ends(picture.header["dataWindow"]), ends(picture.header["displayWindow"])


def rendered(run, tmp_path, *parts, options=(), spp=4):
    stage = pictures.stage(tmp_path / "stage.usda", SCENE, *parts)
    done = run("render", stage, "--spp", spp, *options, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    return done


def uv(picture):
    return picture["uv.R"], picture["uv.G"]


@pytest.mark.parametrize(
    ("window", "data", "shape"),
    [
        ("(-0.1, -0.1, 1.1, 1.1)", [(-4, -4), (43, 43)], (48, 48)),
        ("(0.5, 0.5, 1.25, 1.5)", [(20, -20), (49, 19)], (40, 30)),
        ("(0.5, 0, 1, 0.5)", [(20, 20), (39, 39)], (20, 20)),
    ],
)
def test_the_data_window(run, tmp_path, window, data, shape):
    body = f"uniform float4 dataWindowNDC = {window}"
    rendered(run, tmp_path, settings(body, f"rel orderedVars = {ALL}"), VARIABLES, options=["-o", "a.exr"])
    picture = pictures.read(tmp_path / "a.exr")
    assert windows(picture) == (data, [(0, 0), (39, 39)])
    assert picture.shape == shape
    # What a pixel shows does not depend on the window.
    u, v = uv(picture)
    column, row = data[0][0] + np.arange(shape[1]), data[0][1] + np.arange(shape[0])
    assert np.abs(u.mean(axis=0) - (0.5 + SEEN * ((column + 0.5) / 40 - 0.5))).max() < 0.006
    assert np.abs(v.mean(axis=1) - (0.5 - SEEN * ((row + 0.5) / 40 - 0.5))).max() < 0.006


def test_a_window_follows_the_size_of_the_picture_and_gives_way_to_a_crop(run, tmp_path):
    body = "uniform float4 dataWindowNDC = (-0.25, 0, 1, 1)"
    rendered(run, tmp_path, settings(body), options=["-o", "a.exr", "--res", 80, 80])
    assert windows(pictures.read(tmp_path / "a.exr")) == ([(-20, 0), (79, 79)], [(0, 0), (79, 79)])
    rendered(run, tmp_path, settings(body), options=["-o", "b.exr", "--crop", 0, 0, 10, 20])
    assert windows(pictures.read(tmp_path / "b.exr")) == ([(0, 0), (9, 19)], [(0, 0), (39, 39)])


def test_the_shape_of_pixels_is_in_the_file(run, tmp_path):
    rendered(run, tmp_path, settings("uniform float pixelAspectRatio = 2"), options=["-o", "a.exr"])
    assert pictures.read(tmp_path / "a.exr").header["pixelAspectRatio"] == pytest.approx(2)


def test_products_are_files_of_their_own_size(run, tmp_path):
    own = 'token productName = "deep/second.exr"\n    uniform int2 resolution = (20, 12)'
    done = rendered(run, tmp_path, settings("", 'token productName = "first.png"', own))
    assert done.stdout.split() == ["first.png", "deep/second.exr"]
    assert pictures.png_size(tmp_path / "first.png") == (40, 40)
    assert pictures.read(tmp_path / "deep" / "second.exr").shape == (12, 20)


def test_products_have_their_own_variables_and_a_name_each_frame(run, tmp_path):
    first = 'token productName.timeSamples = { 1: "one.exr", 2: "two.exr" }\n    rel orderedVars = [</Vars/color>, </Vars/uv>]'
    second = 'token productName = "b.####"\n    rel orderedVars = [</Vars/N>]'
    rendered(run, tmp_path, settings("", first, second), VARIABLES, options=["--frames", "1:2"])
    assert {path.name for path in tmp_path.glob("*.exr")} == {"one.exr", "two.exr", "b.0001.exr", "b.0002.exr"}
    assert "uv.R" in pictures.read(tmp_path / "one.exr").channels and "N.R" not in pictures.read(tmp_path / "one.exr").channels
    assert "N.R" in pictures.read(tmp_path / "b.0002.exr").channels


@pytest.mark.parametrize(
    ("parts", "options", "said"),
    [
        ([], [], "no file was given"),
        ([settings("", 'token productName = "a.tif"')], [], "expected exr, png or jpg"),
        ([settings("", 'token productName = "a.exr"')], ["--frames", "1:2"], "several frames need a place"),
        ([settings("", 'token productName = "a.exr"', 'token productName = "a.exr"')], [], "written twice"),
    ],
)
def test_names_that_cannot_be_written(run, tmp_path, parts, options, said):
    stage = pictures.stage(tmp_path / "stage.usda", SCENE, *parts)
    done = run("render", stage, "--spp", 1, *options, cwd=tmp_path)
    assert done.returncode == 1 and said in done.stderr


def test_variables_are_layers_by_their_names(run, tmp_path):
    rendered(run, tmp_path, settings("", f'token productName = "out.exr"\n    rel orderedVars = {ALL}'), VARIABLES, spp=64)
    picture = pictures.read(tmp_path / "out.exr")
    middle = lambda name: float(picture[name][20, 20])
    assert [middle(f"dc.{c}") for c in "RGB"] == pytest.approx([0.1, 0.5, 0.2], rel=1e-4)
    assert middle("worn") == pytest.approx(0.75)
    assert [middle(f"N.{c}") for c in "RGB"] == pytest.approx([0, 0, 1], abs=1e-5)
    assert middle("eye.B") == pytest.approx(-10, rel=1e-4)
    assert picture["Pc.X"].shape == picture["Pg.X"].shape
    # Under an even sky nothing comes from other surfaces: direct light is the colour.
    for c in "RGB":
        assert middle(f"direct.{c}") == pytest.approx(middle(c), rel=1e-3)
        assert middle(f"all.{c}") == pytest.approx(middle(c), rel=1e-3)


def test_normals_of_a_turned_camera_are_in_its_space(run, tmp_path):
    turned = SCENE.replace("(0, 0, 10)", "(10, 0, 10)").replace('["xformOp:translate"]', '["xformOp:translate", "xformOp:rotateY"]\n    float xformOp:rotateY = 45', 1)
    stage = pictures.stage(tmp_path / "stage.usda", turned, settings("", f'token productName = "out.exr"\n    rel orderedVars = {ALL}'), VARIABLES)
    done = run("render", stage, "--spp", 4, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    picture = pictures.read(tmp_path / "out.exr")
    half = 0.5**0.5
    assert [float(picture[f"N.{c}"][20, 20]) for c in "RGB"] == pytest.approx([-half, 0, half], abs=1e-4)


def test_variables_that_are_not_there_are_named(run, tmp_path):
    odd = 'def RenderVar "odd"\n{\n    uniform string sourceName = "C<RD\'skin\'>L"\n    uniform token sourceType = "lpe"\n}\n'
    done = rendered(run, tmp_path, settings("", 'token productName = "out.exr"\n    rel orderedVars = [</odd>]'), odd)
    assert "'C<RD'skin'>L' (lpe): labels of surfaces are not told apart" in done.stderr and "is not supported" in done.stderr


# Three settings as studios have them.

# A shot: one beauty with layers for compositing in halves and floats, one data picture, and one picture for eyes.
SHOT = settings(
    "uniform float pixelAspectRatio = 1",
    'token productName = "beauty.####.exr"\n    rel orderedVars = [</Vars/Ci>, </Vars/uv>, </Vars/worn>]',
    'token productName = "data.####.exr"\n    rel orderedVars = [</Vars/depth>, </Vars/N>]',
    'token productName = "view.####.png"\n    rel orderedVars = </Vars/Ci>',
)
SHOT_VARIABLES = VARIABLES.replace(
    'def Scope "Vars"\n{',
    """def Scope "Vars"
{
    def RenderVar "Ci"
    {
        uniform token dataType = "color4h"
        uniform string sourceName = "Ci"
    }
    def RenderVar "depth"
    {
        uniform token dataType = "float"
        uniform string sourceName = "z"
    }""",
)

# A catalogue: two cameras with a resolution each, cropped and with overscan, squeezed pixels, one policy each.
SECOND_CAMERA = SCENE[SCENE.index("def Camera") : SCENE.index("def DomeLight")].replace('"Cam"', '"Wide"').replace("horizontalAperture = 36", "horizontalAperture = 72")
CATALOGUE = settings(
    "bool disableDepthOfField = 1",
    'token productName = "front.exr"\n    uniform int2 resolution = (30, 20)\n    uniform token aspectRatioConformPolicy = "cropAperture"',
    'token productName = "wide.exr"\n    uniform int2 resolution = (40, 10)\n    rel camera = </Wide>\n    uniform float4 dataWindowNDC = (-0.1, -0.1, 1.1, 1.1)\n    uniform token aspectRatioConformPolicy = "adjustApertureHeight"',
    'token productName = "squeezed.exr"\n    uniform int2 resolution = (20, 40)\n    uniform token aspectRatioConformPolicy = "adjustPixelAspectRatio"',
)


def test_a_shot_with_three_products(run, tmp_path):
    done = rendered(run, tmp_path, SHOT, SHOT_VARIABLES, options=["--frames", "7:8"])
    assert sorted(done.stdout.split()) == sorted(f"{name}.000{frame}.{ending}" for frame in (7, 8) for name, ending in [("beauty", "exr"), ("data", "exr"), ("view", "png")])
    beauty, data = pictures.read(tmp_path / "beauty.0008.exr"), pictures.read(tmp_path / "data.0008.exr")
    assert {name: values.dtype.itemsize for name, values in beauty.channels.items()} == {
        **dict.fromkeys("RGBA", 2),
        **dict.fromkeys(["uv.R", "uv.G", "uv.B", "uv.A", "worn"], 4),
    }
    assert {"depth.Z", "N.R", "N.G", "N.B"} <= set(data.channels) and all(values.dtype.itemsize == 4 for values in data.channels.values())
    assert float(data["depth.Z"][20, 20]) == pytest.approx(10, rel=1e-4)


def test_a_catalogue_of_cameras_and_policies(run, tmp_path):
    rendered(run, tmp_path, CATALOGUE, SECOND_CAMERA)
    front, wide, squeezed = (pictures.read(tmp_path / f"{name}.exr") for name in ("front", "wide", "squeezed"))
    assert front.shape == (20, 30) and front.header["gonio:camera"] == "/Cam"
    assert wide.header["gonio:camera"] == "/Wide" and windows(wide) == ([(-4, -1), (43, 10)], [(0, 0), (39, 9)])
    assert squeezed.shape == (40, 20) and squeezed.header["pixelAspectRatio"] == pytest.approx(2)


def test_colours_in_another_gamut(run, tmp_path):
    plain = settings("", f'token productName = "rec709.exr"\n    rel orderedVars = {ALL}')
    rendered(run, tmp_path, plain, VARIABLES, spp=16)
    body = 'uniform token renderingColorSpace = "lin_ap1_scene"'
    rendered(run, tmp_path, settings(body, f'token productName = "ap1.exr"\n    rel orderedVars = {ALL}'), VARIABLES, spp=16)
    rec709, ap1 = pictures.read(tmp_path / "rec709.exr"), pictures.read(tmp_path / "ap1.exr")
    # From linear Rec.709 to ACEScg (Bradford), as OCIO's configurations have it.
    to_ap1 = np.array([[0.6131, 0.3395, 0.0474], [0.0702, 0.9164, 0.0134], [0.0206, 0.1096, 0.8698]])
    assert np.abs(rec709.rgb @ to_ap1.T - ap1.rgb).max() < 2e-4
    direct = lambda picture: np.stack([picture[f"direct.{c}"] for c in "RGB"], axis=-1)
    assert np.abs(direct(rec709) @ to_ap1.T - direct(ap1)).max() < 2e-4
    # Numbers are no colours.
    assert np.array_equal(rec709["worn"], ap1["worn"]) and np.array_equal(rec709["Pc.X"], ap1["Pc.X"])
    assert "chromaticities" in ap1.header and "chromaticities" not in rec709.header


def test_a_colour_space_that_is_not_linear_is_told(run, tmp_path):
    done = rendered(run, tmp_path, settings('uniform token renderingColorSpace = "srgb_texture"', 'token productName = "a.exr"'))
    assert "renderingColorSpace is 'srgb_texture'" in done.stderr


def test_names_of_products_take_the_stages_frame(run, tmp_path):
    names = ["beauty.$F4.exr", "renders/util.<F4>.exr", "deep.%04d.exr", "q.####.exr"]
    kinds = ["raster", "raster", "deepRaster", "raster"]
    product = 'def RenderProduct "P{}"\n{{\n    token productName = "{}"\n    token productType = "{}"\n    rel orderedVars = [</C>]\n}}\n'
    products = "".join(product.format(number, *each) for number, each in enumerate(zip(names, kinds, strict=True)))
    targets = ", ".join(f"</P{number}>" for number in range(len(names)))
    settings = (
        f'def RenderSettings "S"\n{{\n    rel camera = </Cam>\n    uniform int2 resolution = (6, 6)\n    rel products = [{targets}]\n}}\n'
        f'def RenderVar "C"\n{{\n    uniform string sourceName = "C"\n}}\n{products}'
    )
    stage = pictures.stage(tmp_path / "s.usda", SCENE, settings)
    stage.write_text(stage.read_text().replace("upAxis", "startTimeCode = 7\n    endTimeCode = 8\n    upAxis", 1))
    done = run("render", stage, "--spp", 1, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    found = sorted(str(path.relative_to(tmp_path)) for path in tmp_path.rglob("*.exr"))
    assert found == ["beauty.0007.exr", "deep.0007.exr", "q.0007.exr", "renders/util.0007.exr"]
