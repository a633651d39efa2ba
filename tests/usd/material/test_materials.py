"""Materials of USD stages: bindings, UsdPreviewSurface, MaterialX surfaces, and their networks as node graphs."""

import os
import pathlib

import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

HEADER = '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Y"\n)\n'
TRIANGLE = """
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [0, 1, 2]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    uniform token subdivisionScheme = "none"
"""
BOUND = f"""
def Mesh "Mesh" (prepend apiSchemas = ["MaterialBindingAPI"])
{{{TRIANGLE}
    rel material:binding = </M>
}}
"""


def shared(*parts):
    root = pathlib.Path(os.environ.get("GONIO_SHARED", pathlib.Path(__file__).resolve().parents[3].parent / "shared"))
    path = root.joinpath("data", "usd", *parts)
    if not path.exists():
        pytest.skip(f"{path} is not there")
    return path


def load(tmp_path, text, **options):
    path = tmp_path / "stage.usda"
    path.write_text(HEADER + text)
    return gonio.load_usd(str(path), **options).to_dict()


def surface(material):
    """A material of one closure, its parts side by side."""
    (closure,) = material["closures"]
    return material | closure


def material(scene, name):
    return surface(next(m for m in scene["materials"] if m["origin"]["name"] == name))


def bound_material(scene, index=0):
    return surface(scene["materials"][scene["instances"][0]["materials"][index]])


def constant(material, name):
    return dict(material["parameters"])[name]["Constant"]


def node(material, name):
    index, channel = dict(material["parameters"])[name]["Node"]
    return material["graph"]["nodes"][index], channel


def preview(inputs, extra=""):
    return f"""{BOUND}
def Material "M"
{{
    token outputs:surface.connect = </M/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "UsdPreviewSurface"
        {inputs}
        token outputs:surface
    }}
    {extra}
}}
"""


def test_preview_surface_has_the_defaults_of_its_specification(tmp_path):
    m = bound_material(load(tmp_path, preview("")))
    assert m["model"] == "PreviewSurface"
    assert constant(m, "base_color")[:3] == pytest.approx([0.18] * 3)
    for name, value in [("specular_roughness", 0.5), ("metalness", 0), ("specular_ior", 1.5), ("coat_weight", 0), ("coat_roughness", 0.01)]:
        assert constant(m, name)[0] == pytest.approx(value), name
    assert constant(m, "geometry_opacity")[0] == 1
    assert m["opacity_threshold"] == 0


def test_metal_keeps_its_colour_at_grazing_angles(tmp_path):
    m = bound_material(load(tmp_path, preview("color3f inputs:diffuseColor = (0.9, 0.6, 0.2)\nfloat inputs:metallic = 1")))
    assert constant(m, "metal_edge_tint") == constant(m, "base_color")


def test_specular_workflow_tints_the_reflectance_at_normal_incidence(tmp_path):
    inputs = "int inputs:useSpecularWorkflow = 1\ncolor3f inputs:specularColor = (0.08, 0.04, 0.02)\nfloat inputs:metallic = 1"
    m = bound_material(load(tmp_path, preview(inputs)))
    assert constant(m, "metalness")[0] == 0
    assert constant(m, "specular_color")[:3] == pytest.approx([2, 1, 0.5], rel=1e-5)


@pytest.mark.parametrize(
    ("inputs", "opacity", "threshold"),
    [
        ("", 1, 0),
        ('float inputs:opacity = 0.25\ntoken inputs:opacityMode = "presence"', 0.25, 0),
        ('float inputs:opacity = 0.25\nfloat inputs:opacityThreshold = 0.5\ntoken inputs:opacityMode = "transparent"', 0.25, 0.5),
        ("float inputs:opacity = 0.25\nfloat inputs:opacityThreshold = 0.5", 0.25, 0.5),
    ],
)
def test_opacity_that_removes_the_surface(tmp_path, inputs, opacity, threshold):
    m = bound_material(load(tmp_path, preview(inputs)))
    assert constant(m, "geometry_opacity")[0] == opacity
    assert m["opacity_threshold"] == pytest.approx(threshold)


@pytest.mark.parametrize("mode", ["", '\ntoken inputs:opacityMode = "transparent"'])
def test_opacity_that_leaves_the_reflection(tmp_path, mode):
    scene = load(tmp_path, preview("color3f inputs:diffuseColor = (0.4, 0.4, 0.4)\nfloat inputs:opacity = 0.25" + mode))
    whole, clear, straight = scene["materials"][scene["instances"][0]["materials"][0]]["closures"]
    assert whole["weight"]["Constant"][0] == 0.25 and constant(whole, "base_color")[0] == pytest.approx(0.4)
    assert clear["weight"]["Constant"][0] == 0.75 and constant(clear, "base_color")[0] == 0
    assert straight["model"] == "Transparent" and "Node" in straight["weight"]


TEXTURED = """
    def Shader "Reader"
    {
        uniform token info:id = "UsdPrimvarReader_float2"
        string inputs:varname.connect = </M.inputs:uvset>
        float2 outputs:result
    }
    def Shader "Place"
    {
        uniform token info:id = "UsdTransform2d"
        float2 inputs:in.connect = </M/Reader.outputs:result>
        float inputs:rotation = 90
        float2 inputs:scale = (2, 3)
        float2 inputs:translation = (0.5, 0)
        float2 outputs:result
    }
    def Shader "Image"
    {
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @image.png@
        float2 inputs:st.connect = </M/Place.outputs:result>
        token inputs:wrapS = "repeat"
        token inputs:wrapT = "mirror"
        token inputs:sourceColorSpace = "raw"
        float4 inputs:scale = (2, 2, 2, 1)
        float4 inputs:bias = (-1, -1, -1, 0)
        float4 inputs:fallback = (0.5, 0.25, 0.125, 1)
        float outputs:g
        float3 outputs:rgb
    }
    string inputs:uvset = "map1"
"""
CONNECTED = (
    "float inputs:roughness.connect = </M/Image.outputs:g>\n"
    "normal3f inputs:normal.connect = </M/Image.outputs:rgb>\n"
    "color3f inputs:diffuseColor.connect = </M.inputs:tint>"
)


def test_texture_chain_becomes_nodes(tmp_path):
    (tmp_path / "image.png").write_bytes(b"not decoded here")
    m = bound_material(load(tmp_path, preview(CONNECTED, TEXTURED + "\ncolor3f inputs:tint = (0.1, 0.2, 0.3)")))
    assert constant(m, "base_color")[:3] == pytest.approx([0.1, 0.2, 0.3])
    image, channel = node(m, "specular_roughness")
    assert channel == "G"
    assert image["operation"]["Image"]["wrap"] == ["Repeat", "Mirror"]
    assert image["operation"]["Image"]["scale"] == [2, 2, 2, 1]
    place = m["graph"]["nodes"][image["inputs"][0]["Node"][0]]
    assert place["operation"]["Transform2d"] == {"scale": [2, 3], "rotation_deg": 90, "translation": [0.5, 0]}
    reader = m["graph"]["nodes"][place["inputs"][0]["Node"][0]]
    assert reader["operation"]["Primvar"]["name"] == "map1"
    normal = m["graph"]["nodes"][m["normal"]]
    assert "NormalMap" in normal["operation"]


def test_missing_image_gives_the_fallback(tmp_path):
    scene = load(tmp_path, preview(CONNECTED, TEXTURED + "\ncolor3f inputs:tint = (0.1, 0.2, 0.3)"))
    m = bound_material(scene)
    assert constant(m, "specular_roughness")[0] == 0.25
    assert m["normal"] is None
    assert scene["textures"] == []


def test_image_colour_space_comes_from_the_shader_then_from_the_attribute(tmp_path):
    (tmp_path / "image.png").write_bytes(b"")
    scene = load(tmp_path, preview(CONNECTED, TEXTURED))
    assert [t["colour_space"] for t in scene["textures"]] == ["raw"]
    stated = TEXTURED.replace('token inputs:sourceColorSpace = "raw"', "").replace("@image.png@", '@image.png@ (colorSpace = "lin_ap1_scene")')
    scene = load(tmp_path, preview(CONNECTED, stated))
    assert [t["colour_space"] for t in scene["textures"]] == ["lin_ap1_scene"]


def test_constants_are_converted_from_their_colour_space(tmp_path):
    m = bound_material(load(tmp_path, preview('color3f inputs:diffuseColor = (0.5, 0.2, 0.1) (colorSpace = "lin_ap1_scene")')))
    assert constant(m, "base_color")[:3] == pytest.approx([0.71984, 0.16198, 0.07750], abs=2e-3)


def test_constants_take_the_colour_space_of_the_prims_above(tmp_path):
    text = preview("color3f inputs:diffuseColor = (0.5, 0.2, 0.1)")
    space = '(prepend apiSchemas = ["ColorSpaceAPI"])\n{\n    uniform token colorSpace:name = "lin_ap1_scene"'
    m = bound_material(load(tmp_path, text.replace('def Material "M"\n{', f'def Material "M" {space}')))
    assert constant(m, "base_color")[:3] == pytest.approx([0.7198, 0.1620, 0.0775], abs=2e-3)


def mtlx(shader, inputs, extra=""):
    return f"""{BOUND}
def Material "M"
{{
    token outputs:mtlx:surface.connect = </M/S.outputs:out>
    token outputs:surface.connect = </M/P.outputs:surface>
    def Shader "P"
    {{
        uniform token info:id = "UsdPreviewSurface"
        token outputs:surface
    }}
    def Shader "S"
    {{
        uniform token info:id = "{shader}"
        {inputs}
        token outputs:out
    }}
    {extra}
}}
"""


def test_materialx_context_is_preferred_and_standard_surface_folds_its_weights(tmp_path):
    inputs = """float inputs:base = 0.5
        color3f inputs:base_color = (0.8, 0.4, 0.2)
        float inputs:specular = 0.5
        float inputs:emission = 10
        color3f inputs:opacity = (1, 0, 0)
        bool inputs:thin_walled = 1
        float inputs:transmission_depth = 3"""
    m = bound_material(load(tmp_path, mtlx("ND_standard_surface_surfaceshader", inputs)))
    assert m["model"] == "StandardSurface"
    assert constant(m, "base_color")[:3] == pytest.approx([0.4, 0.2, 0.1])
    assert constant(m, "specular_scale")[0] == 0.5
    assert constant(m, "metal_edge_tint")[:3] == [0.5] * 3
    assert constant(m, "emission_color")[:3] == [10] * 3
    assert constant(m, "geometry_opacity")[0] == pytest.approx(0.2126)
    assert constant(m, "transmission_depth")[0] == 3
    assert constant(m, "coat_darkening")[0] == 0
    assert m["thin_walled"] is True


def test_open_pbr_surface(tmp_path):
    inputs = """float inputs:specular_weight = 0.5
        float inputs:thin_film_thickness = 0.25
        float inputs:emission_luminance = 100
        color3f inputs:emission_color = (1, 0.5, 0)"""
    m = bound_material(load(tmp_path, mtlx("ND_open_pbr_surface_surfaceshader", inputs)))
    assert m["model"] == "OpenPbr"
    assert constant(m, "metal_weight")[0] == constant(m, "specular_weight")[0] == 0.5
    assert constant(m, "thin_film_thickness")[0] == pytest.approx(250)
    assert constant(m, "emission_color")[:3] == [100, 50, 0]


def test_gltf_mask(tmp_path):
    inputs = "float inputs:alpha = 0.3\nint inputs:alpha_mode = 1\nfloat inputs:alpha_cutoff = 0.4\nfloat inputs:sheen_roughness = 0.5"
    m = bound_material(load(tmp_path, mtlx("ND_gltf_pbr_surfaceshader", inputs)))
    assert m["model"] == "Gltf"
    assert constant(m, "geometry_opacity")[0] == pytest.approx(0.3)
    assert m["opacity_threshold"] == pytest.approx(0.4)
    assert constant(m, "fuzz_roughness")[0] == pytest.approx(0.25)


def test_materialx_arithmetic_is_folded_and_images_are_tiled(tmp_path):
    (tmp_path / "image.png").write_bytes(b"")
    extra = """
    def Shader "Product"
    {
        uniform token info:id = "ND_multiply_float"
        float inputs:in1 = 0.5
        float inputs:in2 = 0.5
        float outputs:out
    }
    def Shader "Tiles"
    {
        uniform token info:id = "ND_tiledimage_color3"
        asset inputs:file = @image.png@
        float2 inputs:uvtiling = (4, 2)
        float2 inputs:uvoffset = (1, 0.5)
        color3f outputs:out
    }
    """
    inputs = "float inputs:specular_roughness.connect = </M/Product.outputs:out>\ncolor3f inputs:base_color.connect = </M/Tiles.outputs:out>"
    m = bound_material(load(tmp_path, mtlx("ND_open_pbr_surface_surfaceshader", inputs, extra)))
    assert constant(m, "specular_roughness")[0] == 0.25
    image, _ = node(m, "base_color")
    assert image["operation"]["Image"]["wrap"] == ["Repeat", "Repeat"]
    tile = m["graph"]["nodes"][image["inputs"][0]["Node"][0]]
    assert tile["operation"]["Transform2d"] == {"scale": [4, 2], "rotation_deg": 0, "translation": [-1, -0.5]}


def test_materialx_place2d_turns_about_its_pivot(tmp_path):
    (tmp_path / "image.png").write_bytes(b"")
    extra = """
    def Shader "Place"
    {
        uniform token info:id = "ND_place2d_vector2"
        float2 inputs:pivot = (0.5, 0.5)
        float2 inputs:scale = (0.5, 0.5)
        float inputs:rotate = 90
        float2 outputs:out
    }
    def Shader "Image"
    {
        uniform token info:id = "ND_image_color3"
        asset inputs:file = @image.png@
        float2 inputs:texcoord.connect = </M/Place.outputs:out>
        color3f outputs:out
    }
    """
    inputs = "color3f inputs:base_color.connect = </M/Image.outputs:out>"
    m = bound_material(load(tmp_path, mtlx("ND_open_pbr_surface_surfaceshader", inputs, extra)))
    image, _ = node(m, "base_color")
    place = m["graph"]["nodes"][image["inputs"][0]["Node"][0]]["operation"]["Transform2d"]
    assert place["scale"] == [2, 2]
    assert place["rotation_deg"] == -90
    # The pivot stays where it is: R(-90)(2 (0.5, 0.5)) = (1, -1).
    assert place["translation"] == pytest.approx([0.5 - 1, 0.5 + 1], abs=1e-6)


def test_materialx_normal_map_is_made_signed_in_the_image(tmp_path):
    (tmp_path / "image.png").write_bytes(b"")
    extra = """
    def Shader "Image"
    {
        uniform token info:id = "ND_image_vector3"
        asset inputs:file = @image.png@
        float3 outputs:out
    }
    def Shader "Map"
    {
        uniform token info:id = "ND_normalmap"
        float3 inputs:in.connect = </M/Image.outputs:out>
        float inputs:scale = 0.5
        float3 outputs:out
    }
    """
    m = bound_material(load(tmp_path, mtlx("ND_standard_surface_surfaceshader", "float3 inputs:normal.connect = </M/Map.outputs:out>", extra)))
    normal = m["graph"]["nodes"][m["normal"]]
    assert normal["operation"] == {"NormalMap": {"scale": 0.5, "uv": None}}
    image = m["graph"]["nodes"][normal["inputs"][0]["Node"][0]]["operation"]["Image"]
    assert image["scale"] == [2] * 4
    assert image["bias"] == [-1] * 4


def test_unknown_nodes_give_the_default_of_the_input(tmp_path):
    extra = """
    def Shader "Noise"
    {
        uniform token info:id = "ND_flake3d"
        color3f outputs:out
    }
    """
    m = bound_material(load(tmp_path, mtlx("ND_open_pbr_surface_surfaceshader", "color3f inputs:base_color.connect = </M/Noise.outputs:out>", extra)))
    assert constant(m, "base_color")[:3] == pytest.approx([0.8] * 3)


def test_circles_end(tmp_path):
    extra = """
    def Shader "A"
    {
        uniform token info:id = "ND_add_float"
        float inputs:in1.connect = </M/B.outputs:out>
        float outputs:out
    }
    def Shader "B"
    {
        uniform token info:id = "ND_add_float"
        float inputs:in1.connect = </M/A.outputs:out>
        float outputs:out
    }
    """
    bound_material(load(tmp_path, mtlx("ND_open_pbr_surface_surfaceshader", "float inputs:specular_roughness.connect = </M/A.outputs:out>", extra)))


def test_unbound_prims_show_display_colour(tmp_path):
    m = bound_material(load(tmp_path, f'def Mesh "Mesh"\n{{{TRIANGLE}\n}}\n'))
    operation = node(m, "base_color")[0]["operation"]["Primvar"]
    assert operation["name"] == "displayColor"
    assert operation["fallback"][:3] == pytest.approx([0.18] * 3)
    assert "geometry_opacity" not in dict(m["parameters"])
    opaque = f'def Mesh "Mesh"\n{{{TRIANGLE}\n    float[] primvars:displayOpacity = [0.5]\n}}\n'
    assert node(bound_material(load(tmp_path, opaque)), "geometry_opacity")[0]["operation"]["Primvar"]["name"] == "displayOpacity"


BINDINGS = """
def Material "Red"
{{
    token outputs:surface.connect = </Red/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (1, 0, 0)
        token outputs:surface
    }}
}}
def Material "Blue"
{{
    token outputs:surface.connect = </Blue/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (0, 0, 1)
        token outputs:surface
    }}
}}
def Xform "Group" (prepend apiSchemas = ["MaterialBindingAPI"{apis}])
{{
    {parent}
    def Mesh "Mesh" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{{triangle}
        {child}
    }}
}}
"""


@pytest.mark.parametrize(
    ("apis", "parent", "child", "expected"),
    [
        ("", "rel material:binding = </Red>", "", "/Red"),
        ("", "rel material:binding = </Red>", "rel material:binding = </Blue>", "/Blue"),
        ("", 'rel material:binding = </Red> (bindMaterialAs = "strongerThanDescendants")', "rel material:binding = </Blue>", "/Red"),
        ("", "rel material:binding = </Red>\nrel material:binding:full = </Blue>", "", "/Blue"),
        ("", "rel material:binding = </Red>\nrel material:binding:preview = </Blue>", "", "/Red"),
        (
            ', "CollectionAPI:some"',
            "rel collection:some:includes = </Group/Mesh>\nrel material:binding:collection:x = [</Group.collection:some>, </Blue>]\nrel material:binding = </Red>",
            "",
            "/Blue",
        ),
    ],
)
def test_bindings(tmp_path, apis, parent, child, expected):
    scene = load(tmp_path, BINDINGS.format(apis=apis, parent=parent, child=child, triangle=TRIANGLE))
    assert bound_material(scene)["origin"]["name"] == expected


def test_flattened_materialx_stage():
    scene = gonio.load_usd(str(shared("wg-assets", "test_assets", "MaterialXTest", "basicTextured_flatten.usda"))).to_dict()
    brass = material(scene, "/MaterialX/Materials/Tiled_Brass")
    image, channel = node(brass, "specular_roughness")
    assert channel == "R"
    texture = scene["textures"][image["operation"]["Image"]["texture"]]
    assert texture["source"]["File"].endswith("brass_roughness.jpg")
    assert texture["colour_space"] == "raw"


def test_materialx_documents_are_read_in_place_of_references():
    scene = gonio.load_usd(str(shared("wg-assets", "test_assets", "MaterialXTest", "basic.usda"))).to_dict()
    plastic = bound_material(scene)
    assert plastic["origin"]["name"] == "/MaterialX/Materials/USD_Plastic"
    assert constant(plastic, "base_color")[:3] == pytest.approx([0.10470402, 0.24188282, 0.818])
    assert constant(plastic, "specular_roughness")[0] == pytest.approx(0.32467532)


def test_bad_materialx_documents_do_not_stop_the_reading(tmp_path):
    for number, text in enumerate(["", "<a", "<other/>", "<!DOCTYPE m><materialx/>", "<materialx>"]):
        (tmp_path / f"doc{number}.mtlx").write_text(text)
        reference = f'def Scope "Looks" (references = @doc{number}.mtlx@</MaterialX/Materials>) {{}}\n'
        load(tmp_path, f'def Mesh "Mesh"\n{{{TRIANGLE}\n}}\n{reference}')
