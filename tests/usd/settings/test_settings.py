"""UsdRender settings: choice of the prim, size, window, purposes, passes, aperture policies."""

import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

CAMERA = 'def Camera "cam"\n{\n    float horizontalAperture = 20\n    float verticalAperture = 10\n    float focalLength = 10\n}\n'


def load(tmp_path, text, metadata="", **options):
    path = tmp_path / "stage.usda"
    path.write_text(f"#usda 1.0\n(\n    metersPerUnit = 1\n    {metadata}\n)\n{CAMERA}{text}")
    return gonio.load_usd(str(path), **options).to_dict()


def settings(body, name="Settings"):
    return f'def RenderSettings "{name}"\n{{\n{body}\n}}\n'


def test_the_only_settings_prim_is_used(tmp_path):
    s = load(tmp_path, settings("uniform int2 resolution = (320, 200)"))["settings"]
    assert s["resolution"] == [320, 200]


def test_metadata_chooses_among_several(tmp_path):
    both = settings("uniform int2 resolution = (320, 200)", "A") + settings("uniform int2 resolution = (64, 32)", "B")
    assert load(tmp_path, both, 'renderSettingsPrimPath = "/B"')["settings"]["resolution"] == [64, 32]
    assert load(tmp_path, both)["settings"]["resolution"] not in ([320, 200], [64, 32])
    assert load(tmp_path, both, render_settings="/A")["settings"]["resolution"] == [320, 200]


@pytest.mark.parametrize(
    ("policy", "aperture", "pixel_aspect"),
    [
        ("expandAperture", [20, 20], 1),
        ("cropAperture", [10, 10], 1),
        ("adjustApertureWidth", [10, 10], 1),
        ("adjustApertureHeight", [20, 20], 1),
        ("adjustPixelAspectRatio", [20, 10], 2),
    ],
)
def test_aperture_policies(tmp_path, policy, aperture, pixel_aspect):
    scene = load(tmp_path, settings(f'uniform int2 resolution = (100, 100)\nuniform token aspectRatioConformPolicy = "{policy}"'))
    assert scene["cameras"][0]["aperture"] == pytest.approx(aperture)
    assert scene["settings"]["pixel_aspect"] == pytest.approx(pixel_aspect)


def test_data_window_counts_rows_from_the_top(tmp_path):
    body = "uniform int2 resolution = (200, 100)\nuniform float4 dataWindowNDC = (0.5, 0.75, 1, 1)"
    assert load(tmp_path, settings(body))["settings"]["crop"] == {"min": [100, 0], "max": [200, 25]}
    assert load(tmp_path, settings("uniform int2 resolution = (200, 100)"))["settings"]["crop"] is None


def test_camera_relationship(tmp_path):
    text = 'def Camera "other" {}\n' + settings("rel camera = </other>")
    scene = load(tmp_path, text)
    assert scene["cameras"][scene["settings"]["camera"]]["origin"]["name"] == "/other"


PRODUCT = """
def RenderSettings "Settings"
{
    uniform int2 resolution = (320, 200)
    rel products = </Product>
}
def RenderProduct "Product"
{
    token productName = "out.exr"
    rel orderedVars = [</color>, </depth>, </own>, </odd>]
}
def RenderVar "color" 
{
    uniform string sourceName = "Ci"
}
def RenderVar "depth" 
{
    uniform string sourceName = "z"
}
def RenderVar "own" 
{
    uniform string sourceName = "illuminance"
}
def RenderVar "odd" 
{
    uniform string sourceName = "something else"
}
"""


def test_render_variables_become_passes(tmp_path):
    assert load(tmp_path, PRODUCT)["settings"]["aovs"] == ["Color", "Depth", "Illuminance"]


def test_a_product_may_have_its_own_size(tmp_path):
    text = PRODUCT.replace('token productName = "out.exr"', "uniform int2 resolution = (40, 30)")
    assert load(tmp_path, text)["settings"]["resolution"] == [40, 30]


def test_depth_of_field_can_be_disabled(tmp_path):
    lens = 'def Camera "lens"\n{\n    float fStop = 2\n    float focusDistance = 3\n}\n'
    scene = load(tmp_path, lens + settings("uniform bool disableDepthOfField = 1\nrel camera = </lens>"))
    assert scene["cameras"][scene["settings"]["camera"]]["lens_radius"] == 0


def test_included_purposes(tmp_path):
    mesh = """
def Mesh "{name}"
{{
    uniform token purpose = "{name}"
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [0, 1, 2]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    uniform token subdivisionScheme = "none"
}}
"""
    meshes = "".join(mesh.format(name=name) for name in ["default", "render", "proxy", "guide"])
    shown = lambda scene: {instances["origin"]["name"] for instances in scene["instances"]}
    assert shown(load(tmp_path, meshes)) == {"/default", "/render"}
    assert shown(load(tmp_path, meshes + settings('uniform token[] includedPurposes = ["default", "proxy"]'))) == {"/default", "/proxy"}
