"""The office's materials: UsdPreviewSurface with textures, and two MaterialX standard surfaces."""

from dataclasses import dataclass

from pxr import Gf, Sdf, Usd, UsdShade

Colour = tuple[float, float, float]


@dataclass
class Preview:
    """A UsdPreviewSurface; `image` takes the place of `colour`, and one of its tiles has the size `tile` in metres (None: 0 to 1)."""

    colour: Colour = (0.18, 0.18, 0.18)
    roughness: float = 0.5
    metallic: float = 0.0
    image: str = ""
    normal: str = ""
    tile: tuple[float, float] | None = None
    clearcoat: float = 0.0
    nits: float = 0.0
    instance_colour: bool = False


@dataclass
class Standard:
    """A MaterialX standard surface, by its inputs."""

    inputs: dict[str, float | bool | Colour]


MATERIALS: dict[str, Preview | Standard] = {
    "WallPaint": Preview((0.80, 0.79, 0.76), 0.85),
    "AccentPaint": Preview((0.115, 0.185, 0.175), 0.8),
    "Ceiling": Preview(image="ceiling.png", roughness=0.95, tile=(0.6, 0.6)),
    "WhiteMetal": Preview((0.78, 0.78, 0.77), 0.4),
    "Planks": Preview(image="planks.png", normal="planks_normal.png", roughness=0.36, tile=(1.2, 1.2)),
    "Walnut": Preview(image="walnut.png", roughness=0.38, tile=(1.0, 0.5)),
    "Oak": Preview(image="oak.png", roughness=0.45, tile=(1.0, 0.5)),
    "WhiteLacquer": Preview((0.78, 0.78, 0.76), 0.3, clearcoat=0.3),
    "Stone": Preview((0.62, 0.61, 0.58), 0.35),
    "WindowFrame": Preview((0.10, 0.105, 0.11), 0.4),
    "Steel": Preview((0.60, 0.60, 0.59), 0.28, metallic=1.0),
    "Chrome": Preview((0.72, 0.72, 0.73), 0.14, metallic=1.0),
    "Brass": Preview((0.82, 0.62, 0.32), 0.25, metallic=1.0),
    "BlackMetal": Preview((0.025, 0.025, 0.027), 0.4),
    "BlackPlastic": Preview((0.03, 0.03, 0.032), 0.45),
    "GreyPlastic": Preview((0.14, 0.14, 0.145), 0.5),
    "LightKey": Preview((0.62, 0.62, 0.61), 0.5),
    "Aluminium": Preview((0.70, 0.70, 0.71), 0.32, metallic=1.0),
    "ScreenDiagram": Preview((0.01, 0.01, 0.01), 0.2, image="screen_diagram.png", nits=320.0),
    "ScreenText": Preview((0.01, 0.01, 0.01), 0.2, image="screen_text.png", nits=320.0),
    "Cloth": Preview(image="cloth.png", normal="cloth_normal.png", roughness=0.9, tile=(0.05, 0.05)),
    "Painting": Preview(image="painting.png", roughness=0.6),
    "Paper": Preview((0.80, 0.79, 0.75), 0.8),
    "Cover": Preview((0.3, 0.1, 0.1), 0.5, instance_colour=True),
    "CeramicWhite": Preview((0.76, 0.75, 0.72), 0.15, clearcoat=0.5),
    "CeramicOrange": Preview((0.62, 0.17, 0.05), 0.2, clearcoat=0.5),
    "CeramicBlue": Preview((0.05, 0.13, 0.24), 0.2, clearcoat=0.5),
    "Coffee": Preview((0.03, 0.012, 0.005), 0.1),
    "LampShade": Preview((0.62, 0.17, 0.05), 0.35),
    "LampInside": Preview((0.85, 0.84, 0.82), 0.6),
    "Concrete": Preview((0.40, 0.39, 0.37), 0.7),
    "Soil": Preview((0.035, 0.024, 0.016), 0.95),
    "Stem": Preview((0.10, 0.075, 0.045), 0.8),
    "Leaf": Preview((0.06, 0.16, 0.04), 0.42, instance_colour=True),
    "Glass": Standard({"base": 0.0, "specular": 1.0, "specular_roughness": 0.0, "transmission": 1.0, "thin_walled": True}),
    "Velvet": Standard(
        {"base": 0.8, "base_color": (0.56, 0.24, 0.07), "specular": 0.2, "specular_roughness": 0.6, "sheen": 0.5, "sheen_roughness": 0.4}
    ),
}


def define(stage: Usd.Stage, scope: str, name: str, folder: str) -> UsdShade.Material:
    """The material of that name under a scope, made if it is not there; `folder` leads from the layer to the images."""
    path = f"{scope}/{name}"
    material = UsdShade.Material.Get(stage, path)
    if material:
        return material
    material = UsdShade.Material.Define(stage, path)
    made_of = MATERIALS[name]
    if isinstance(made_of, Standard):
        shader = UsdShade.Shader.Define(stage, f"{path}/surface")
        shader.CreateIdAttr("ND_standard_surface_surfaceshader")
        for key, value in made_of.inputs.items():
            kind = {bool: Sdf.ValueTypeNames.Bool, float: Sdf.ValueTypeNames.Float, tuple: Sdf.ValueTypeNames.Color3f}[type(value)]
            shader.CreateInput(key, kind).Set(value)
        material.CreateSurfaceOutput("mtlx").ConnectToSource(shader.CreateOutput("out", Sdf.ValueTypeNames.Token))
        return material
    preview(stage, path, made_of, material, folder)
    return material


def preview(stage: Usd.Stage, path: str, made_of: Preview, material: UsdShade.Material, folder: str) -> None:
    """The shading network of a UsdPreviewSurface."""
    shader = UsdShade.Shader.Define(stage, f"{path}/surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    shader.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(made_of.roughness)
    if made_of.metallic:
        shader.CreateInput("metallic", Sdf.ValueTypeNames.Float).Set(made_of.metallic)
    if made_of.clearcoat:
        shader.CreateInput("clearcoat", Sdf.ValueTypeNames.Float).Set(made_of.clearcoat)
        shader.CreateInput("clearcoatRoughness", Sdf.ValueTypeNames.Float).Set(0.05)
    diffuse = shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f)
    diffuse.Set(made_of.colour)
    if made_of.image:
        place = placement(stage, path, made_of)
        image = texture(stage, f"{path}/image", f"{folder}/{made_of.image}", place, "sRGB")
        if made_of.nits:
            image.CreateInput("scale", Sdf.ValueTypeNames.Float4).Set(Gf.Vec4f(made_of.nits, made_of.nits, made_of.nits, 1))
            diffuse = shader.CreateInput("emissiveColor", Sdf.ValueTypeNames.Color3f)
        diffuse.ConnectToSource(image.CreateOutput("rgb", Sdf.ValueTypeNames.Float3))
        if made_of.normal:
            bumps = texture(stage, f"{path}/bumps", f"{folder}/{made_of.normal}", place, "raw")
            bumps.CreateInput("scale", Sdf.ValueTypeNames.Float4).Set(Gf.Vec4f(2, 2, 2, 1))
            bumps.CreateInput("bias", Sdf.ValueTypeNames.Float4).Set(Gf.Vec4f(-1, -1, -1, 0))
            shader.CreateInput("normal", Sdf.ValueTypeNames.Normal3f).ConnectToSource(bumps.CreateOutput("rgb", Sdf.ValueTypeNames.Float3))
    elif made_of.instance_colour:
        reader = UsdShade.Shader.Define(stage, f"{path}/colour")
        reader.CreateIdAttr("UsdPrimvarReader_float3")
        reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set("displayColor")
        reader.CreateInput("fallback", Sdf.ValueTypeNames.Float3).Set(made_of.colour)
        diffuse.ConnectToSource(reader.CreateOutput("result", Sdf.ValueTypeNames.Float3))
    material.CreateSurfaceOutput().ConnectToSource(shader.CreateOutput("surface", Sdf.ValueTypeNames.Token))


def placement(stage: Usd.Stage, path: str, made_of: Preview) -> UsdShade.Output:
    """Texture coordinates: st as it is, or in tiles."""
    reader = UsdShade.Shader.Define(stage, f"{path}/st")
    reader.CreateIdAttr("UsdPrimvarReader_float2")
    reader.CreateInput("varname", Sdf.ValueTypeNames.String).Set("st")
    found = reader.CreateOutput("result", Sdf.ValueTypeNames.Float2)
    if made_of.tile is None:
        return found
    transform = UsdShade.Shader.Define(stage, f"{path}/tiles")
    transform.CreateIdAttr("UsdTransform2d")
    transform.CreateInput("in", Sdf.ValueTypeNames.Float2).ConnectToSource(found)
    transform.CreateInput("scale", Sdf.ValueTypeNames.Float2).Set(Gf.Vec2f(1 / made_of.tile[0], 1 / made_of.tile[1]))
    return transform.CreateOutput("result", Sdf.ValueTypeNames.Float2)


def texture(stage: Usd.Stage, path: str, file: str, place: UsdShade.Output, colour_space: str) -> UsdShade.Shader:
    """An image that repeats."""
    shader = UsdShade.Shader.Define(stage, path)
    shader.CreateIdAttr("UsdUVTexture")
    shader.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(file)
    shader.CreateInput("sourceColorSpace", Sdf.ValueTypeNames.Token).Set(colour_space)
    for name in ("wrapS", "wrapT"):
        shader.CreateInput(name, Sdf.ValueTypeNames.Token).Set("repeat")
    shader.CreateInput("st", Sdf.ValueTypeNames.Float2).ConnectToSource(place)
    return shader
