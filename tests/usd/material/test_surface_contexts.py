"""Surfaces of other renderers: known shaders in any render context, closures of MaterialX, materials of phones, Arnold and Omniverse."""

import pictures
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

HEADER = '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Y"\n)\n'
BALL = 'def Sphere "Ball" (prepend apiSchemas = ["MaterialBindingAPI"])\n{\n    rel material:binding = </M>\n}\n'


def shader(name, body, kind=None):
    kind = f'uniform token info:id = "{kind}"' if kind else ""
    return f'    def Shader "{name}"\n    {{\n        {kind}\n        {body}\n        token outputs:out\n    }}\n'


def load(tmp_path, *shaders, context="mtlx", surface="S"):
    path = tmp_path / "stage.usda"
    output = f"outputs:{context}:surface" if context else "outputs:surface"
    material = f'def Material "M"\n{{\n    token {output}.connect = </M/{surface}.outputs:out>\n' + "".join(shaders) + "}\n"
    path.write_text(HEADER + BALL + material)
    return gonio.load_usd(str(path), camera_light=False)


def material(scene):
    scene = scene.to_dict()
    return scene["materials"][scene["instances"][0]["materials"][0]]


def only(scene):
    (closure,) = material(scene)["closures"]
    return closure


def constant(closure, name):
    return dict(closure["parameters"])[name]["Constant"]


def messages(scene):
    return " | ".join(message for _, message in scene.diagnostics)


def near(found, expected):
    return found[: len(expected)] == pytest.approx(expected, rel=1e-5)


@pytest.mark.parametrize("context", ["kma", "glslfx", "arnold", "ri", ""])
@pytest.mark.parametrize(
    ("kind", "base"),
    [
        ("ND_standard_surface_surfaceshader", "base_color"),
        ("UsdPreviewSurface", "diffuseColor"),
        ("ND_open_pbr_surface_surfaceshader", "base_color"),
        ("arnold:standard_surface", "base_color"),
        ("arnold:openpbr_surface", "base_color"),
    ],
)
def test_a_known_surface_is_used_in_any_context(tmp_path, context, kind, base):
    scene = load(tmp_path, shader("S", f"color3f inputs:{base} = (0.1, 0.7, 0.2)", kind), context=context)
    assert near(constant(only(scene), "base_color"), [0.1, 0.7, 0.2])
    assert "not supported" not in messages(scene)


def test_arnold_has_the_parameters_of_standard_surface(tmp_path):
    body = "float inputs:base = 0.5\n        float inputs:specular_IOR = 1.4\n        float inputs:coat = 0.25\n        float inputs:metalness = 1"
    closure = only(load(tmp_path, shader("S", body, "arnold:standard_surface"), context="arnold"))
    assert closure["model"] == "StandardSurface"
    assert near(constant(closure, "base_color"), [0.4] * 3)
    assert [constant(closure, name)[0] for name in ["specular_ior", "coat_weight", "metalness"]] == pytest.approx([1.4, 0.25, 1])


def test_arnold_nodes_feed_it(tmp_path, image):
    parts = [
        shader("S", "color3f inputs:base_color.connect = </M/I.outputs:out>\n        float inputs:specular_roughness.connect = </M/I.outputs:g>", "arnold:standard_surface"),
        shader("I", f'string inputs:filename = "{image}"\n        float inputs:sscale = 2\n        float outputs:g', "arnold:image"),
    ]
    made = material(load(tmp_path, *parts, context="arnold"))
    assert [next(iter(n["operation"])) if isinstance(n["operation"], dict) else n["operation"] for n in made["graph"]["nodes"]] == ["Primvar", "Transform2d", "Image"]
    assert dict(made["closures"][0]["parameters"])["specular_roughness"]["Node"][1] == "G"


def test_the_universal_context_goes_before_those_of_others(tmp_path):
    path = tmp_path / "stage.usda"
    two = 'def Material "M"\n{\n    token outputs:arnold:surface.connect = </M/A.outputs:out>\n    token outputs:surface.connect = </M/B.outputs:out>\n'
    two += shader("A", "", "arnold:standard_surface") + shader("B", "", "UsdPreviewSurface") + "}\n"
    path.write_text(HEADER + BALL + two)
    assert only(gonio.load_usd(str(path), camera_light=False))["model"] == "PreviewSurface"


def test_what_is_there_is_said_where_nothing_is_known(tmp_path):
    said = messages(load(tmp_path, shader("S", "", "PxrSurface"), context="ri"))
    assert "'PxrSurface' (render context ri) is not supported" in said
    body = 'uniform token info:implementationSource = "sourceAsset"\n        uniform asset info:mdl:sourceAsset = @Own.mdl@\n        uniform token info:mdl:sourceAsset:subIdentifier = "Carpet"'
    assert "'mdl:Carpet' (render context mdl) is not supported" in messages(load(tmp_path, shader("S", body), context="mdl"))


def png(path):
    """Writes a picture of one colour, (0.5, 0.25, 1) as it is encoded."""
    return pictures.write_png(path, [[(128, 64, 255)]])


@pytest.fixture
def image(tmp_path):
    """A picture of one colour."""
    return png(tmp_path / "texel.png")


def test_realitykit_is_lit_like_a_preview_surface(tmp_path):
    body = "color3f inputs:baseColor = (0.8, 0.1, 0.1)\n        float inputs:roughness = 0.4\n        float inputs:clearcoat = 0.5"
    closure = only(load(tmp_path, shader("S", body, "ND_realitykit_pbr_surfaceshader")))
    assert closure["model"] == "PreviewSurface"
    assert near(constant(closure, "base_color"), [0.8, 0.1, 0.1])
    assert [constant(closure, name)[0] for name in ["specular_roughness", "coat_weight", "specular_scale"]] == pytest.approx([0.4, 0.5, 1])


def test_realitykit_unlit_shines(tmp_path):
    body = "color3f inputs:color = (0.2, 0.6, 1)\n        float inputs:opacity = 0.5"
    closure = only(load(tmp_path, shader("S", body, "ND_realitykit_unlit_surfaceshader")))
    assert near(constant(closure, "emission_color"), [0.2, 0.6, 1])
    assert constant(closure, "base_color")[0] == 0 and constant(closure, "geometry_opacity")[0] == 0.5


def test_a_surface_of_closures(tmp_path):
    diffuse = shader("B", "color3f inputs:color = (0.8, 0.1, 0.1)\n        float inputs:weight = 0.5", "ND_oren_nayar_diffuse_bsdf")
    closure = only(load(tmp_path, shader("S", "token inputs:bsdf.connect = </M/B.outputs:out>", "ND_surface"), diffuse))
    assert near(constant(closure, "base_color"), [0.8, 0.1, 0.1])
    assert closure["weight"]["Constant"][0] == 0.5 and constant(closure, "specular_weight")[0] == 0


def test_a_dielectric_over_a_diffuse_base_is_one_surface(tmp_path):
    parts = [
        shader("S", "token inputs:bsdf.connect = </M/L.outputs:out>\n        token inputs:edf.connect = </M/E.outputs:out>", "ND_surface"),
        shader("L", "token inputs:top.connect = </M/D.outputs:out>\n        token inputs:base.connect = </M/B.outputs:out>", "ND_layer_bsdf"),
        shader("D", "float inputs:ior = 1.4\n        float2 inputs:roughness = (0.04, 0.04)", "ND_dielectric_bsdf"),
        shader("B", "color3f inputs:color = (0.3, 0.3, 0.3)", "ND_oren_nayar_diffuse_bsdf"),
        shader("E", "color3f inputs:color = (3, 2, 1)", "ND_uniform_edf"),
    ]
    surface, glow = material(load(tmp_path, *parts))["closures"]
    assert [constant(surface, name)[0] for name in ["specular_weight", "specular_ior", "specular_roughness"]] == pytest.approx([1, 1.4, 0.2])
    assert near(constant(surface, "base_color"), [0.3] * 3)
    assert near(constant(glow, "emission_color"), [3, 2, 1])


def test_surface_unlit_shines_through_its_opacity(tmp_path):
    shining, straight = material(load(tmp_path, shader("S", "color3f inputs:emission_color = (0.1, 0.7, 0.1)\n        float inputs:opacity = 0.75", "ND_surface_unlit")))["closures"]
    assert near(constant(shining, "emission_color"), [0.1, 0.7, 0.1]) and shining["weight"]["Constant"][0] == 0.75
    assert straight["model"] == "Transparent" and straight["weight"]["Constant"][0] == 0.25


@pytest.mark.parametrize(
    ("mixer", "inputs"), [("ND_mix_surfaceshader", ["bg", "fg"]), ("arnold:mix_shader", ["shader1", "shader2"])]
)
def test_mixes_of_surfaces(tmp_path, mixer, inputs):
    under, over = (f"token inputs:{name}.connect = </M/{target}.outputs:out>" for name, target in zip(inputs, "BF"))
    parts = [
        shader("S", f"{under}\n        {over}\n        float inputs:mix = 0.25", mixer),
        shader("F", "color3f inputs:base_color = (0.8, 0.1, 0.1)", "ND_standard_surface_surfaceshader"),
        shader("B", "color3f inputs:base_color = (0.1, 0.1, 0.8)", "ND_standard_surface_surfaceshader"),
    ]
    back, front = material(load(tmp_path, *parts))["closures"]
    assert back["weight"]["Constant"][0] == 0.75 and near(constant(back, "base_color"), [0.1, 0.1, 0.8])
    assert front["weight"]["Constant"][0] == 0.25 and near(constant(front, "base_color"), [0.8, 0.1, 0.1])


def test_a_mix_of_itself_ends(tmp_path):
    body = "token inputs:bg.connect = </M/S.outputs:out>\n        token inputs:fg.connect = </M/S.outputs:out>"
    assert material(load(tmp_path, shader("S", body, "ND_mix_surfaceshader")))["closures"] == []


def test_closures_of_a_document(tmp_path):
    (tmp_path / "look.mtlx").write_text("""<materialx version="1.38">
      <oren_nayar_diffuse_bsdf name="B" type="BSDF"><input name="color" type="color3" value="0.2, 0.4, 0.6"/></oren_nayar_diffuse_bsdf>
      <multiply name="H" type="BSDF"><input name="in1" type="BSDF" nodename="B"/><input name="in2" type="float" value="0.5"/></multiply>
      <surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="H"/></surface>
      <surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>""")
    path = tmp_path / "stage.usda"
    path.write_text(HEADER + BALL.replace("</M>", "</L/M>") + 'def "L" (references = @look.mtlx@</MaterialX/Materials>) {}\n')
    closure = only(gonio.load_usd(str(path), camera_light=False))
    assert near(constant(closure, "base_color"), [0.2, 0.4, 0.6]) and closure["weight"]["Constant"][0] == 0.5


def mdl(name, body):
    source = 'uniform token info:implementationSource = "sourceAsset"\n        '
    source += f'uniform asset info:mdl:sourceAsset = @{name}.mdl@\n        uniform token info:mdl:sourceAsset:subIdentifier = "{name}"\n        '
    return shader("S", source + body)


def test_omni_pbr(tmp_path):
    body = """color3f inputs:diffuse_color_constant = (0.4, 0.6, 0.8)
        color3f inputs:diffuse_tint = (0.5, 1, 1)
        float inputs:reflection_roughness_constant = 0.25
        float inputs:metallic_constant = 1
        bool inputs:enable_emission = 1
        color3f inputs:emissive_color = (1, 1, 0)
        float inputs:emissive_intensity = 10"""
    closure = only(load(tmp_path, mdl("OmniPBR", body), context="mdl"))
    assert near(constant(closure, "base_color"), [0.2, 0.6, 0.8])
    assert constant(closure, "specular_roughness")[0] == 0.25 and constant(closure, "metalness")[0] == 1
    assert constant(closure, "specular_ior")[0] == pytest.approx(1.5)
    assert near(constant(closure, "emission_color"), [10, 10, 0])


def test_omni_pbr_with_one_image_for_roughness_and_metal(tmp_path, image):
    body = f"""bool inputs:enable_ORM_texture = 1
        asset inputs:ORM_texture = @{image}@
        float inputs:reflection_roughness_texture_influence = 1
        float inputs:metallic_texture_influence = 1"""
    parameters = dict(only(load(tmp_path, mdl("OmniPBR", body), context="mdl"))["parameters"])
    assert [parameters[name]["Node"][1] for name in ("specular_roughness", "metalness")] == ["G", "B"]


def test_omni_glass(tmp_path):
    closure = only(load(tmp_path, mdl("OmniGlass", "color3f inputs:glass_color = (0.9, 1, 0.9)\n        bool inputs:thin_walled = 1"), context="mdl"))
    assert closure["thin_walled"] and constant(closure, "transmission_weight")[0] == 1
    assert near(constant(closure, "transmission_color"), [0.9, 1, 0.9])
    assert constant(closure, "specular_ior")[0] == pytest.approx(1.491)


def test_a_mixed_ball_has_both_colours(picture, tmp_path):
    parts = [
        shader("S", "token inputs:bg.connect = </M/B.outputs:out>\n        token inputs:fg.connect = </M/F.outputs:out>\n        float inputs:mix = 0.5", "ND_mix_surfaceshader"),
        shader("F", "color3f inputs:emission_color = (2, 0, 0)", "ND_surface_unlit"),
        shader("B", "color3f inputs:emission_color = (0, 0, 4)", "ND_surface_unlit"),
    ]
    load(tmp_path, *parts)
    seen = picture(tmp_path / "stage.usda", size=8, spp=256)
    assert seen.rgb[seen["A"] > 0.999].mean(axis=0) == pytest.approx([1, 0, 2], rel=0.05, abs=0.02)


BY_NAME = [
    shader("S", "color3f inputs:diffuseColor.connect = </M/T.outputs:rgb>", "UsdPreviewSurface"),
    shader("T", "asset inputs:file.connect = </M/R.outputs:result>\n        float4 inputs:fallback = (0.1, 0.2, 0.3, 1)\n        float3 outputs:rgb", "UsdUVTexture"),
    shader("R", 'string inputs:varname = "picture"\n        string outputs:result', "UsdPrimvarReader_string"),
]


def named(tmp_path, *shaders):
    """Balls that name their images, one by its parent, one not at all."""
    for name in ["one", "two"]:
        png(tmp_path / f"{name}.png")
    body = "    rel material:binding = </M>\n"
    ball = lambda name, line: f'def Sphere "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])\n{{\n{body}    {line}\n}}\n'
    text = ball("A", 'string primvars:picture = "one.png"') + ball("B", "asset primvars:picture = @two.png@") + ball("C", "")
    text += ball("E", 'double radius = 3\n    string primvars:picture = "./one.png"')
    text += 'def Xform "Group"\n{\n    string primvars:picture = "two.png"\n' + ball("D", "double radius = 2") + "}\n"
    text += 'def Material "M"\n{\n    token outputs:surface.connect = </M/S.outputs:out>\n' + "".join(shaders) + "}\n"
    path = tmp_path / "stage.usda"
    path.write_text(HEADER + text)
    return gonio.load_usd(str(path), camera_light=False)


def image_of(scene, ball):
    """The file's name of the first image of a ball's material; None without one."""
    instances = next(i for i in scene["instances"] if i["origin"]["name"] == ball)
    nodes = scene["materials"][instances["materials"][0]]["graph"]["nodes"]
    images = [node["operation"]["Image"] for node in nodes if isinstance(node["operation"], dict) and "Image" in node["operation"]]
    return scene["textures"][images[0]["texture"]]["source"]["File"].rsplit("/", 1)[-1] if images else None


def test_primvars_name_images(tmp_path):
    loaded = named(tmp_path, *BY_NAME)
    scene = loaded.to_dict()
    found = {name: image_of(scene, name) for name in ["/A", "/B", "/C", "/E", "/Group/D"]}
    assert found == {"/A": "one.png", "/B": "two.png", "/C": None, "/E": "one.png", "/Group/D": "two.png"}
    assert "no image file is named" in messages(loaded)


def test_primvars_name_images_of_materialx(tmp_path):
    parts = [
        shader("S", "color3f inputs:base_color.connect = </M/T.outputs:out>", "ND_standard_surface_surfaceshader"),
        shader("T", "asset inputs:file.connect = </M/R.outputs:out>", "ND_image_color3"),
        shader("R", 'string inputs:geomprop = "picture"', "ND_geompropvalue_string"),
    ]
    scene = named(tmp_path, *parts).to_dict()
    assert [image_of(scene, name) for name in ["/A", "/B", "/C"]] == ["one.png", "two.png", None]


def test_outputs_that_shaders_do_not_declare_are_followed(tmp_path):
    # As exporters of Omniverse write them: the connection names an output, the shader has none.
    path = tmp_path / "stage.usda"
    colour = "float3 inputs:fallback = (0.2, 0.4, 0.6)"
    primvar = f'    def Shader "P"\n    {{\n uniform token info:id = "UsdPrimvarReader_float3"\n {colour}\n    }}\n'
    surface = '    def Shader "S"\n    {\n uniform token info:id = "UsdPreviewSurface"\n color3f inputs:diffuseColor.connect = </M/P.outputs:result>\n    }\n'
    path.write_text(HEADER + BALL + f'def Material "M"\n{{\n token outputs:surface.connect = </M/S.outputs:surface>\n{surface}{primvar}}}\n')
    scene = gonio.load_usd(str(path), camera_light=False)
    assert "displayColor" not in messages(scene)
    assert "[0.2, 0.4, 0.6" in str(material(scene)).replace("0.20000000298023224", "0.2")


@pytest.mark.parametrize(
    ("node", "body", "expected"),
    [
        ("complement", "color3f inputs:input = (0.1, 0.2, 0.3)", [0.9, 0.8, 0.7]),
        ("max", "color3f inputs:input1 = (0.1, 0.5, 0.3)\ncolor3f inputs:input2 = (0.2, 0.2, 0.2)", [0.2, 0.5, 0.3]),
        ("pow", "color3f inputs:base = (0.5, 0.2, 1)\ncolor3f inputs:exponent = (2, 2, 2)", [0.25, 0.04, 1]),
        ("float_to_rgb", "float inputs:r = 0.1\nfloat inputs:g = 0.2\nfloat inputs:b = 0.3", [0.1, 0.2, 0.3]),
        ("rgb_to_float", 'color3f inputs:input = (0.1, 0.2, 0.6)\nstring inputs:mode = "average"', [0.3] * 3),
        ("rgb_to_float", 'color3f inputs:input = (0.1, 0.2, 0.6)\nstring inputs:mode = "max"', [0.6] * 3),
        ("rgb_to_float", 'color3f inputs:input = (1, 1, 1)\nstring inputs:mode = "luminance"', [1] * 3),
        ("range", "color3f inputs:input = (0.25, 0.5, 1)\nfloat inputs:output_min = 0.2\nfloat inputs:output_max = 0.6", [0.3, 0.4, 0.6]),
        ("range", "color3f inputs:input = (0.25, 0.5, 2)\nbool inputs:smoothstep = 1", [0.15625, 0.5, 1]),
        ("range", "color3f inputs:input = (0.25, 0.5, 0.75)\nfloat inputs:contrast = 2", [0, 0.5, 1]),
        ("color_correct", "color3f inputs:input = (0.1, 0.2, 0.3)", [0.1, 0.2, 0.3]),
        ("color_correct", "color3f inputs:input = (0.1, 0.2, 0.3)\nfloat inputs:exposure = 1", [0.2, 0.4, 0.6]),
        ("color_correct", "color3f inputs:input = (0.25, 0.04, 1)\nfloat inputs:gamma = 2", [0.5, 0.2, 1]),
        ("color_correct", "color3f inputs:input = (0.2, 0.4, 0.4)\nfloat inputs:saturation = 0", [0.4] * 3),
        ("color_correct", "color3f inputs:input = (0.5, 0, 0)\nfloat inputs:hue_shift = 0.33333333", [0, 0.5, 0]),
        ("color_correct", "color3f inputs:input = (0.1, 0.2, 0.3)\ncolor3f inputs:multiply = (2, 1, 1)\ncolor3f inputs:add = (0, 0.5, 0)", [0.2, 0.7, 0.3]),
    ],
)
def test_arnold_arithmetic(tmp_path, node, body, expected):
    surface = shader("S", "color3f inputs:base_color.connect = </M/N.outputs:out>\n        float inputs:base = 1", "arnold:standard_surface")
    scene = load(tmp_path, surface, shader("N", body, f"arnold:{node}"), context="arnold")
    assert "not supported" not in messages(scene)
    found = constant(only(scene), "base_color")
    assert found[:3] == pytest.approx(expected, abs=1e-5)
