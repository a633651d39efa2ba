"""Images as users have them: formats, what files say of their colours, their names, and sets of tiles."""

import pathlib
import shutil

import numpy as np
import pictures
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

from pxr import Gf, Sdf  # noqa: E402

FILES = pathlib.Path(__file__).parents[1] / "images"
HEADER = '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Y"\n)\n'
PIXELS = 16
SQUARE = """
def Mesh "Square{number}" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [({number}, 0, 0), ({right}, 0, 0), ({right}, 1, 0), ({number}, 1, 0)]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
    rel material:binding = </Looks{number}>
}}
def Material "Looks{number}"
{{
    token outputs:surface.connect = </Looks{number}/Surface.outputs:surface>
    def Shader "Surface"
    {{
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (0, 0, 0)
        color3f inputs:emissiveColor.connect = </Looks{number}/Image.outputs:rgb>
        int inputs:useSpecularWorkflow = 1
        token outputs:surface
    }}
    def Shader "Image"
    {{
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @{file}@
        float2 inputs:st.connect = </Looks{number}/Reader.outputs:result>
        token inputs:wrapS = "clamp"
        token inputs:wrapT = "clamp"
        float4 inputs:fallback = (0, 0.25, 0, 1)
        {space}
        float3 outputs:rgb
    }}
    def Shader "Reader"
    {{
        uniform token info:id = "UsdPrimvarReader_float2"
        string inputs:varname = "st"
        float2 outputs:result
    }}
}}
"""


def stage(folder, files, space=""):
    """A row of squares that shine by their images, seen from the front, and nothing else."""
    squares = [SQUARE.format(number=i, right=i + 1, file=file, space=space) for i, file in enumerate(files)]
    camera = f"""
def DomeLight "Dark"
{{
    float inputs:intensity = 0
}}
def Camera "Camera"
{{
    token projection = "orthographic"
    float horizontalAperture = {10 * len(files)}
    float verticalAperture = 10
    float2 clippingRange = (0.1, 100)
    double3 xformOp:translate = ({len(files) / 2}, 0.5, 5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""
    path = folder / "stage.usda"
    path.write_text(HEADER + camera + "".join(squares))
    return path


@pytest.fixture
def shown(run, tmp_path):
    """What images show: (files, 16, 16, 3), and what is said beside."""

    def render(names, folder=FILES, space=""):
        for name in names:
            shutil.copy(folder / name, tmp_path / name)
        size = ("--res", PIXELS * len(names), PIXELS)
        done = run("render", stage(tmp_path, names, space), "-o", tmp_path / "out.exr", "--spp", 16, "--max-bounces", 0, *size)
        assert done.returncode == 0, done.stderr
        rgb = pictures.read(tmp_path / "out.exr").rgb
        return rgb.reshape(PIXELS, len(names), PIXELS, 3).transpose(1, 0, 2, 3), done.stderr

    return render


def inner(square):
    """The mean colour, the border aside."""
    return square[2:-2, 2:-2].mean(axis=(0, 1))


def test_formats_show_the_same_picture(shown):
    endings = ["png", "jpg", "tif", "tga", "bmp", "webp", "gif", "avif"]
    squares, said = shown([f"picture.{ending}" for ending in endings])
    for ending, square in zip(endings[1:], squares[1:], strict=True):
        assert np.abs(square - squares[0])[2:-2, 2:-2].mean() < 0.02, ending
    assert np.ptp(squares[0], axis=(0, 1)).max() > 0.1
    assert "picture." not in said


def test_what_is_not_supported_is_named_and_shows_the_fallback(shown, tmp_path):
    folder = tmp_path / "odd"
    folder.mkdir()
    (folder / "picture.ktx").write_bytes(b"\xabKTX 11\xbb\r\n\x1a\n" + bytes(64))
    squares, said = shown(["picture.ktx"], folder)
    assert inner(squares[0]) == pytest.approx([0, 0.25, 0], abs=1e-3)
    [line] = [line for line in said.splitlines() if "picture.ktx" in line]
    assert "KTX" in line and "convert it" in line


def test_what_a_file_says_counts_before_its_depth(shown):
    squares, _ = shown(["srgb_chunk.png", "gama_chunk.png", "iccp_chunk.png", "no_chunk.png"])
    expected = [0.216, 0.216, 0.216, 0.502]
    assert [inner(square)[0] for square in squares] == pytest.approx(expected, abs=2e-3)


def test_what_the_stage_says_counts_before_the_file(shown):
    squares, _ = shown(["srgb_chunk.png", "no_chunk.png"], space='token inputs:sourceColorSpace = "raw"')
    assert [inner(square)[0] for square in squares] == pytest.approx([0.502, 0.502], abs=2e-3)


def test_names_of_files_decide_nothing(shown):
    squares, _ = shown(["plain.png", "shrimp_raw.png", "wood.raw.png", "roughness.png", "roughness_srgb.png"])
    plain, shrimp, wood, grey, grey_too = map(inner, squares)
    assert shrimp == pytest.approx(plain, abs=1e-4) and wood == pytest.approx(plain, abs=1e-4)
    assert grey_too == pytest.approx(grey, abs=1e-4)
    # Three channels of 8 bits are sRGB, one is raw.
    assert plain[0] < 0.9 * grey[0]


@pytest.mark.parametrize("ending", ["png", "jpg", "tif", "tga", "bmp", "webp", "gif", "avif"])
def test_damaged_images_are_named_and_replaced(shown, tmp_path, ending):
    whole = (FILES / f"picture.{ending}").read_bytes()
    folder = tmp_path / "damaged"
    folder.mkdir()
    (folder / f"picture.{ending}").write_bytes(whole[: len(whole) // 3])
    squares, said = shown([f"picture.{ending}"], folder)
    assert [line for line in said.splitlines() if f"picture.{ending}" in line], said
    assert inner(squares[0]) == pytest.approx([0, 0.25, 0], abs=1e-3)


def test_tiles_inside_packages(tmp_path):
    for number in (1001, 1012):
        shutil.copy(FILES / "plain.png", tmp_path / f"tile.{number}.png")
    layer = stage(tmp_path, ["tile.<UDIM>.png"])
    with Sdf.ZipFileWriter.CreateNew(str(tmp_path / "tiles.usdz")) as package:
        package.AddFile(str(layer), "stage.usda")
        for number in (1001, 1012):
            package.AddFile(str(tmp_path / f"tile.{number}.png"), f"tile.{number}.png")
    scene = gonio.load_usd(str(tmp_path / "tiles.usdz")).to_dict()
    [texture] = scene["textures"]
    assert [tile["number"] for tile in texture["source"]["Tiles"]["tiles"]] == [1001, 1012]


def test_a_tile_that_is_missing_has_the_fallback_value(run, tmp_path):
    for number in (1001, 1003):
        shutil.copy(FILES / "plain.png", tmp_path / f"tile.{number}.png")
    layer = stage(tmp_path, ["tile.<UDIM>.png"])
    layer.write_text(layer.read_text().replace("[(0, 0), (1, 0), (1, 1), (0, 1)]", "[(-1, 0), (3, 0), (3, 1), (-1, 1)]"))
    done = run("render", layer, "-o", tmp_path / "out.exr", "--spp", 16, "--max-bounces", 0, "--res", PIXELS, PIXELS)
    assert done.returncode == 0 and done.stderr.count("no tile 1002; the fallback value is used there") == 1, done.stderr
    columns = pictures.read(tmp_path / "out.exr").rgb.reshape(PIXELS, 4, PIXELS // 4, 3)[2:-2, :, 1:-1].mean(axis=(0, 2))
    assert columns[0] == pytest.approx([0, 0.25, 0], abs=1e-3) == columns[2]
    assert columns[1] == pytest.approx(columns[3], abs=1e-3) and abs(columns[1] - columns[0]).max() > 0.05


NAMES = """lin_ap1_scene lin_ap0_scene lin_rec709_scene lin_p3d65_scene lin_rec2020_scene lin_adobergb_scene lin_ciexyzd65_scene
srgb_rec709_scene g22_rec709_scene g18_rec709_scene srgb_ap1_scene g22_ap1_scene srgb_p3d65_scene g22_adobergb_scene""".split()


@pytest.mark.parametrize("name", NAMES)
def test_names_of_colour_spaces_mean_what_usd_says(tmp_path, name):
    if not Gf.ColorSpace.IsValid(name):
        pytest.skip(f"this pxr does not know {name}")
    path = tmp_path / "stage.usda"
    surface = SQUARE.format(number=0, right=1, file="none.png", space="").replace(
        "color3f inputs:diffuseColor = (0, 0, 0)", f'color3f inputs:diffuseColor = (0.5, 0.3, 0.7) (colorSpace = "{name}")'
    )
    path.write_text(HEADER + surface)
    [material] = gonio.load_usd(str(path)).to_dict()["materials"]
    [closure] = material["closures"]
    found = dict(closure["parameters"])["base_color"]["Constant"][:3]
    expected = Gf.ColorSpace("lin_rec709_scene").Convert(Gf.ColorSpace(name), Gf.Vec3f(0.5, 0.3, 0.7)).GetRGB()
    assert found == pytest.approx(list(expected), abs=2e-3)
