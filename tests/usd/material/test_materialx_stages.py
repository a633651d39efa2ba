"""MaterialX as stages bring it: documents with definitions of their own, trees of closures, real assets, and hostile input."""

import os
import pathlib
import subprocess
import sys
import time

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

from pxr import UsdShade  # noqa: F401

HEADER = '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Y"\n)\n'
BALL = 'def Sphere "Ball" (prepend apiSchemas = ["MaterialBindingAPI"])\n{\n    double radius = 1\n    rel material:binding = </M>\n}\n'
SHARED = pathlib.Path(os.environ.get("GONIO_SHARED", pathlib.Path(__file__).parents[4] / "shared"))
ASSETS = SHARED / "data" / "usd" / "wg-assets"


def library():
    """Skips where the standard library is not installed."""
    pytest.importorskip("MaterialX", reason="the extra materialx is not installed")


def shader(name, kind, body=""):
    return f'    def Shader "{name}"\n    {{\n        uniform token info:id = "{kind}"\n        {body}\n        token outputs:out\n    }}\n'


def connected(name, to, output="out"):
    return f"token inputs:{name}.connect = </M/{to}.outputs:{output}>\n        "


def load(tmp_path, *shaders, extra=""):
    path = tmp_path / "stage.usda"
    path.write_text(
        HEADER
        + BALL
        + extra
        + 'def Material "M"\n{\n    token outputs:mtlx:surface.connect = </M/S.outputs:out>\n'
        + "".join(shaders)
        + "}\n"
    )
    return gonio.load_usd(str(path), camera_light=False)


def load_document(tmp_path, text, material="M"):
    (tmp_path / "look.mtlx").write_text(text)
    path = tmp_path / "stage.usda"
    reference = 'def "L" (references = @look.mtlx@</MaterialX/Materials>) {}\n'
    path.write_text(HEADER + BALL.replace("</M>", f"</L/{material}>") + reference)
    return gonio.load_usd(str(path), camera_light=False)


def closures(scene):
    scene = scene.to_dict()
    return scene["materials"][scene["instances"][0]["materials"][0]]["closures"]


def messages(scene):
    return " | ".join(message for _, message in scene.diagnostics if "there is no camera" not in message)


CAMERA = """
def DomeLight "Sky"
{
    float inputs:intensity = 1
}
def Camera "Camera"
{
    token projection = "orthographic"
    float horizontalAperture = 12
    float verticalAperture = 12
    double3 xformOp:translate = (0, 0, 5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


def in_furnace(tmp_path, *shaders):
    """The mean colour of a ball that is lit evenly with 1."""
    scene = load(tmp_path, *shaders, extra=CAMERA)
    scene.set(width=32, height=32, samples=64, passes=["color"])
    with gonio.Render(scene) as render:
        assert render.wait()
        picture = np.asarray(render.film()["color"])[..., :3]
    return picture.mean(axis=(0, 1)), messages(scene)


def surface(bsdf="B"):
    return shader("S", "ND_surface", connected("bsdf", bsdf))


WHITE = shader("White", "ND_oren_nayar_diffuse_bsdf", "color3f inputs:color = (1, 1, 1)")
GREY = shader("Grey", "ND_oren_nayar_diffuse_bsdf", "color3f inputs:color = (0.5, 0.5, 0.5)")
GOLD = shader("Gold", "ND_conductor_bsdf", "float2 inputs:roughness = (0.04, 0.04)")
CLEAR = shader("Clear", "ND_dielectric_bsdf", "float2 inputs:roughness = (0.01, 0.01)")
GLASS = shader("Glass", "ND_dielectric_bsdf", 'string inputs:scatter_mode = "RT"\n        float2 inputs:roughness = (0.01, 0.01)')
FUZZ = shader("Fuzz", "ND_sheen_bsdf", "float inputs:roughness = 0.5")


def layer(top, base, name="B"):
    return shader(name, "ND_layer_bsdf", connected("top", top) + connected("base", base))


@pytest.mark.parametrize(
    ("parts", "least", "most"),
    [
        ((surface("White"), WHITE), 0.99, 1.01),
        ((surface(), layer("Clear", "White"), CLEAR, WHITE), 0.97, 1.01),
        # A reflection over a metal, and fuzz over that: no more than comes, and not much less than the metal gives.
        ((surface(), layer("Clear", "Gold"), CLEAR, GOLD), 0.4, 1.01),
        ((surface(), layer("Fuzz", "Inner"), layer("Clear", "Grey", "Inner"), FUZZ, CLEAR, GREY), 0.45, 1.01),
        ((surface("Glass"), GLASS), 0.97, 1.01),
        # What is opaque hides what it lies on.
        ((surface(), layer("White", "Gold"), WHITE, GOLD), 0.99, 1.01),
        ((surface(), shader("B", "ND_multiply_bsdfF", connected("in1", "White") + "float inputs:in2 = 0.25"), WHITE), 0.24, 0.26),
        (
            (
                surface(),
                shader("B", "ND_mix_bsdf", connected("bg", "White") + connected("fg", "Grey") + "float inputs:mix = 0.5"),
                WHITE,
                GREY,
            ),
            0.74,
            0.76,
        ),
    ],
)
def test_trees_of_closures_keep_energy(tmp_path, parts, least, most):
    colour, said = in_furnace(tmp_path, *parts)
    assert not said, said
    assert least < colour.min() and colour.max() < most, colour


def test_widths_and_films_reach_the_closure(tmp_path):
    body = "float2 inputs:roughness = (0.5, 0.125)\n        float inputs:thinfilm_thickness = 300\n        float inputs:thinfilm_ior = 1.3"
    (closure,) = closures(load(tmp_path, surface("B"), shader("B", "ND_conductor_bsdf", body)))
    parameters = {name: value["Constant"][0] for name, value in closure["parameters"]}
    assert parameters["specular_roughness"] == pytest.approx(0.25**0.5)
    assert parameters["specular_anisotropy"] == pytest.approx(0.75 / 0.9)
    assert (parameters["thin_film_weight"], parameters["thin_film_thickness"], parameters["thin_film_ior"]) == (1, 300, pytest.approx(1.3))


def test_disney_principled_comes_from_its_definition(tmp_path):
    library()
    colour, said = in_furnace(tmp_path, shader("S", "ND_disney_principled", "color3f inputs:baseColor = (0.8, 0.4, 0.2)"))
    assert not said, said
    assert 0.2 < colour[2] < colour[1] < colour[0] < 1, colour


def test_a_documents_own_definition_is_used(tmp_path):
    scene = load_document(tmp_path, """<materialx version="1.39" colorspace="lin_rec709">
      <nodedef name="ND_twice_color3" node="twice"><input name="in" type="color3" value="0.25, 0.25, 0.25"/><output name="out" type="color3"/></nodedef>
      <nodegraph name="NG_twice" nodedef="ND_twice_color3">
        <multiply name="m" type="color3"><input name="in1" type="color3" interfacename="in"/><input name="in2" type="float" value="2"/></multiply>
        <output name="out" type="color3" nodename="m"/></nodegraph>
      <twice name="t" type="color3"><input name="in" type="color3" value="0.1, 0.2, 0.3"/></twice>
      <standard_surface name="s" type="surfaceshader"><input name="base" type="float" value="1"/><input name="base_color" type="color3" nodename="t"/>
        <input name="subsurface_scale" type="float" value="2" unittype="distance" unit="inch"/></standard_surface>
      <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial></materialx>""")  # fmt: skip
    (closure,) = closures(scene)
    parameters = dict(closure["parameters"])
    assert parameters["base_color"]["Constant"][:3] == pytest.approx([0.2, 0.4, 0.6])
    assert parameters["subsurface_radius"]["Constant"][0] == pytest.approx(2 * 0.0254)
    assert not messages(scene)


def test_without_the_library_one_line_says_what_it_brings(tmp_path):
    path = tmp_path / "stage.usda"
    parts = [
        shader("S", "ND_standard_surface_surfaceshader", connected("base_color", "C") + connected("specular_roughness", "D")),
        shader("C", "ND_checkerboard_color3"),
        shader("D", "ND_circle_float"),
    ]
    path.write_text(
        HEADER + BALL + 'def Material "M"\n{\n    token outputs:mtlx:surface.connect = </M/S.outputs:out>\n' + "".join(parts) + "}\n"
    )
    code = (
        f"import sys; sys.modules['MaterialX'] = None; import gonio; print(gonio.load_usd({str(path)!r}, camera_light=False).diagnostics)"
    )
    done = subprocess.run([sys.executable, "-c", code], check=False, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    assert done.stdout.count("pip install materialx") == 1, done.stdout
    assert "ND_checkerboard_color3" in done.stdout and "ND_circle_float" in done.stdout


def test_patterns_that_are_graphs_are_put_together(tmp_path):
    library()
    scene = load(
        tmp_path, shader("S", "ND_standard_surface_surfaceshader", connected("base_color", "C")), shader("C", "ND_checkerboard_color3")
    )
    assert not messages(scene)
    (closure,) = closures(scene)
    assert "Node" in dict(closure["parameters"])["base_color"]


def test_hexagons_of_one_colour_are_that_colour(tmp_path):
    image = pathlib.Path(__file__).parents[1] / "images" / "no_chunk.png"
    body = f'asset inputs:file = @{image}@ (colorSpace = "raw")\n        float2 inputs:tiling = (7, 7)\n        float inputs:falloff = 0.7'
    scene = load(
        tmp_path,
        shader("S", "ND_surface_unlit", connected("emission_color", "H")),
        shader("H", "ND_hextiledimage_color3", body),
        extra=CAMERA,
    )
    assert not messages(scene)
    scene.set(width=32, height=32, samples=16, passes=["color"], max_bounces=0)
    with gonio.Render(scene) as render:
        assert render.wait()
        picture = np.asarray(render.film()["color"])[..., :3]
    assert picture[8:24, 8:24] == pytest.approx(128 / 255, abs=1e-3)


def test_flakes_are_named_and_their_input_keeps_its_default(tmp_path):
    parts = [shader("S", "ND_open_pbr_surface_surfaceshader", connected("base_color", "N")), shader("N", "ND_flake3d")]
    scene = load(tmp_path, *parts)
    assert "flake3d" in messages(scene)
    (closure,) = closures(scene)
    assert dict(closure["parameters"])["base_color"]["Constant"][:3] == pytest.approx([0.8] * 3)


def test_bump_bends_the_normal(tmp_path):
    library()
    height = shader("H", "ND_sin_float", connected("in", "X")) + shader(
        "X", "ND_multiply_float", connected("in1", "E") + "float inputs:in2 = 60"
    )
    height += shader("E", "ND_extract_vector3", connected("in", "P")) + shader("P", "ND_position_vector3")
    bump = shader("B", "ND_bump_vector3", connected("height", "H") + "float inputs:scale = 1")
    scene = load(tmp_path, shader("S", "ND_standard_surface_surfaceshader", connected("normal", "B")), bump, height)
    assert not messages(scene)
    (closure,) = closures(scene)
    assert closure["normal"] is not None


@pytest.mark.parametrize("name", ["basic", "basicTextured_flatten"])
def test_stages_of_the_working_group(name):
    path = ASSETS / "test_assets" / "MaterialXTest" / f"{name}.usda"
    if not path.exists():
        pytest.skip("the real test data is not here (GONIO_SHARED)")
    scene = gonio.load_usd(str(path), camera_light=False)
    (closure, *_) = closures(scene)
    assert closure["model"] in ("PreviewSurface", "StandardSurface")
    # The data set lacks the images.
    assert all("image" in message for message in messages(scene).split(" | ") if message), messages(scene)


@pytest.mark.parametrize(
    "material", ["bubblegum", "glass", "gold", "plastic", "bubblegum_openpbr", "glass_openpbr", "gold_openpbr", "plastic_openpbr"]
)
def test_materials_of_the_shader_ball(tmp_path, material):
    path = ASSETS / "full_assets" / "StandardShaderBall" / "example_materials" / f"{material}.mtlx"
    if not path.exists():
        pytest.skip("the real test data is not here (GONIO_SHARED)")
    text = path.read_text()
    name = text.split('<surfacematerial name="')[1].split('"')[0]
    scene = load_document(tmp_path, text, name)
    assert not messages(scene)
    (closure,) = closures(scene)
    assert closure["model"] == ("OpenPbr" if "openpbr" in material else "StandardSurface")


# Patterns that may wait for an operation of the engine, and those that are made of them.
WAITING = {"flake2d", "flake3d", "hextilednormalmap", "unifiednoise2d", "unifiednoise3d", "randomfloat", "randomcolor"}
WAITING |= {f"{name}{dimensions}d" for name in ("noise", "fractal", "cellnoise", "worleynoise") for dimensions in (2, 3)}
# Those that only hair's distributions read, and those that say nothing without a name.
WITHOUT_USE = {
    "deon_hair_absorption_from_melanin", "chiang_hair_absorption_from_color", "chiang_hair_roughness", "geompropvalue",
    "geompropvalueuniform",
    "normalmap", "transpose", "invertmatrix", "creatematrix", "constant", "UsdPrimvarReader",
}  # fmt: skip


def test_all_patterns_of_the_library_are_known(tmp_path):
    library()
    import MaterialX
    import materialx_reference as reference

    definitions = reference.Library(pathlib.Path(MaterialX.__file__).parent / "libraries").definitions
    stage = HEADER
    categories = {}
    for number, (name, definition) in enumerate(definitions.items()):
        outputs = [each.get("name") for each in definition.findall("output") if each.get("type") in reference.COMPONENTS]
        if not outputs or definition.get("node") == "osl_set_ci" or "_surface_to_" in name:
            continue
        categories[name] = definition.get("node")
        unlit = f"color3f inputs:emission_color.connect = </M{number}/N.outputs:{outputs[0]}>"
        node = shader("N", name).replace("outputs:out", f"outputs:{outputs[0]}")
        stage += BALL.replace("Ball", f"Ball{number}").replace("</M>", f"</M{number}>")
        stage += f'def Material "M{number}"\n{{\n    token outputs:mtlx:surface.connect = </M{number}/S.outputs:out>\n'
        stage += shader("S", "ND_surface_unlit", unlit) + node + "}\n"
    path = tmp_path / "all.usda"
    path.write_text(stage)
    said = [message for _, message in gonio.load_usd(str(path), camera_light=False).diagnostics]
    unknown = {message.split("'")[1] for message in said if "is not supported" in message and message.startswith("shader node")}
    assert {categories.get(name, name) for name in unknown} <= WAITING | WITHOUT_USE
    assert len(categories) > 650


def test_ten_thousand_nodes_end_soon(tmp_path):
    parts = [shader("S", "ND_standard_surface_surfaceshader", connected("base_color", "n0"))]
    parts += [
        shader(f"n{i}", "ND_add_color3", connected("in1", f"n{(7 * i + 1) % 10_000}") + connected("in2", f"n{(3 * i + 5) % 10_000}"))
        for i in range(10_000)
    ]
    start = time.monotonic()
    scene = load(tmp_path, *parts)
    assert time.monotonic() - start < 60
    assert "too deep" in messages(scene)
    assert len(scene.diagnostics) < 20, messages(scene)[:1000]


def test_definitions_inside_themselves_end_soon(tmp_path):
    definition = """<nodedef name="ND_me{0}" node="me{0}"><output name="out" type="color3"/></nodedef>
      <nodegraph name="NG_me{0}" nodedef="ND_me{0}"><me{1} name="a" type="color3"/><me{1} name="b" type="color3"/>
        <add name="c" type="color3"><input name="in1" type="color3" nodename="a"/><input name="in2" type="color3" nodename="b"/></add>
        <output name="out" type="color3" nodename="c"/></nodegraph>"""
    definitions = "".join(definition.format(i, i + 1) for i in range(40)) + definition.format(40, 0)
    scene = load_document(tmp_path, f"""<materialx version="1.39">{definitions}<me0 name="m" type="color3"/>
      <standard_surface name="s" type="surfaceshader"><input name="base_color" type="color3" nodename="m"/></standard_surface>
      <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial></materialx>""")  # fmt: skip
    assert "definitions" in messages(scene)
    assert len(scene.diagnostics) < 80, messages(scene)[:1000]
    assert len(closures(scene)) == 1


def test_documents_include_others(tmp_path):
    folder = tmp_path / "parts"
    folder.mkdir()
    (tmp_path / "maps").mkdir()
    surface = '<standard_surface name="S" type="surfaceshader"><input name="base_color" type="color3" nodename="C"/>'
    surface += '<input name="base" type="float" value="1"/></standard_surface>'
    colour = '<{} name="C" type="color3"><input name="value" type="color3" value="0.1, 0.2, 0.3"/></{}>'.format("constant", "constant")
    (folder / "inner.mtlx").write_text(f'<materialx version="1.38" colorspace="lin_rec709">{colour}</materialx>')
    outer = '<xi:include href="inner.mtlx"/>' + surface
    (folder / "outer.mtlx").write_text(f'<materialx version="1.38" xmlns:xi="http://www.w3.org/2001/XInclude">{outer}</materialx>')
    look = '<xi:include href="parts/outer.mtlx"/><surfacematerial name="M" type="material">{}</surfacematerial>'
    look = look.format('<input name="surfaceshader" type="surfaceshader" nodename="S"/>')
    scene = load_document(tmp_path, f'<materialx version="1.38">{look}</materialx>')
    assert messages(scene) == ""
    (closure,) = closures(scene)
    assert dict(closure["parameters"])["base_color"]["Constant"][:3] == pytest.approx([0.1, 0.2, 0.3], rel=1e-5)


@pytest.mark.parametrize(
    ("included", "told"),
    [
        (None, "the document 'other.mtlx' that is included is not usable"),
        ("<materialx>", "is not usable: line 1"),
        ("<other/>", "has the root element <other>"),
        ('<materialx><xi:include href="other.mtlx"/></materialx>', "includes itself"),
        ('<materialx><xi:include href="look.mtlx"/></materialx>', "includes itself"),
        ("<materialx><xi:include/></materialx>", "without href"),
    ],
)
def test_what_cannot_be_included_is_told(tmp_path, included, told):
    if included is not None:
        (tmp_path / "other.mtlx").write_text(included)
    surface = '<standard_surface name="S" type="surfaceshader"/><surfacematerial name="M" type="material">{}</surfacematerial>'
    surface = surface.format('<input name="surfaceshader" type="surfaceshader" nodename="S"/>')
    scene = load_document(tmp_path, f'<materialx version="1.38"><xi:include href="other.mtlx"/>{surface}</materialx>')
    assert told in messages(scene)
    assert len(closures(scene)) == 1


THRICE = """<nodedef name="{0}" node="thrice"><input name="amount" type="float" value="0.1"/><output name="out_colour" type="color3"/></nodedef>
  <nodegraph name="NG_thrice" nodedef="{0}">
    <combine3 name="c" type="color3"><input name="in1" type="float" interfacename="amount"/>
      <input name="in2" type="float" interfacename="amount"/><input name="in3" type="float" interfacename="amount"/></combine3>
    <multiply name="m" type="color3"><input name="in1" type="color3" nodename="c"/><input name="in2" type="float" value="3"/></multiply>
    <output name="out_colour" type="color3" nodename="m"/></nodegraph>"""
USED = """<thrice name="t" type="color3"><input name="amount" type="float" value="0.2"/></thrice>
  <standard_surface name="S" type="surfaceshader"><input name="base" type="float" value="1"/>
    <input name="base_color" type="color3" nodename="t"/></standard_surface>
  <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial>"""


@pytest.mark.parametrize("name", ["ND_thrice_color3", "thrice_definition"])
def test_definitions_may_be_called_as_they_like(tmp_path, name):
    scene = load_document(tmp_path, f'<materialx version="1.38">{THRICE.format(name)}{USED}</materialx>')
    assert messages(scene) == ""
    (closure,) = closures(scene)
    assert dict(closure["parameters"])["base_color"]["Constant"][:3] == pytest.approx([0.6] * 3, rel=1e-5)


def test_definitions_of_the_search_path_are_found(tmp_path):
    studio = tmp_path / "studio"
    studio.mkdir()
    (studio / "nodes.mtlx").write_text(f'<materialx version="1.38">{THRICE.format("ND_thrice_color3")}</materialx>')
    (tmp_path / "look.mtlx").write_text(f'<materialx version="1.38">{USED}</materialx>')
    stage = tmp_path / "stage.usda"
    stage.write_text(HEADER + BALL.replace("</M>", "</L/M>") + 'def "L" (references = @look.mtlx@</MaterialX/Materials>) {}\n')
    code = f"import gonio; scene = gonio.load_usd({str(stage)!r}); print(scene.to_dict()['materials'][-1]['closures'], scene.diagnostics)"
    for path, is_found in [(str(studio), True), ("", False)]:
        environment = {**os.environ, "PXR_MTLX_PLUGIN_SEARCH_PATHS": path}
        told = subprocess.run([sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True, timeout=60).stdout
        assert ("thrice" not in told) == is_found, told
        assert ("0.6" in told) == is_found, told
