"""Squares side by side, each in a material of its own, and what colour they show."""

import gonio
import numpy as np

HEADER = '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Y"\n)\n'
SIDE = 8
CAMERA = """
def DomeLight "Dark"
{{
    float inputs:intensity = 0
}}
def Camera "Cam"
{{
    token projection = "orthographic"
    float horizontalAperture = {width}
    float verticalAperture = 10
    double3 xformOp:translate = ({middle}, 0.5, 5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""
# An emission and nothing else.
GLOW = """
        def Shader "S"
        {{
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (0, 0, 0)
            color3f inputs:specularColor = (0, 0, 0)
            int inputs:useSpecularWorkflow = 1
            float inputs:ior = 1
            color3f inputs:emissiveColor.connect = {source}
            token outputs:surface
        }}
"""


def square(number, material, extra=""):
    """A square of side 1 whose left edge is at `number`."""
    corners = [(number, 0, 0), (number + 1, 0, 0), (number + 1, 1, 0), (number, 1, 0)]
    return f"""def Mesh "square_{number}" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = {corners}
    uniform token subdivisionScheme = "none"
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
    rel material:binding = <{material}>
    {extra}
}}
"""


def glowing(name, source, *shaders):
    """A material that shines with what an output of one of its shaders gives: `T.outputs:rgb`."""
    surface = GLOW.format(source=f"</{name}/{source}>")
    body = f"token outputs:surface.connect = </{name}/S.outputs:surface>\n{surface}" + "".join(shaders)
    return f'def Material "{name}"\n{{\n{body}\n}}\n'


def shader(name, kind, body):
    """A shader prim."""
    return f'        def Shader "{name}"\n        {{\n            uniform token info:id = "{kind}"\n            {body}\n        }}\n'


def shown(path, count, *parts, strict=True):
    """Mean colours of `count` squares of a stage made of these texts, and what was told of it."""
    path.write_text(HEADER + "".join(parts) + CAMERA.format(width=10 * count, middle=count / 2))
    scene = gonio.load_usd(str(path), camera_light=False)
    scene.set(width=SIDE * count, height=SIDE, samples=4, passes=["color"])
    with gonio.Render(scene) as render:
        assert render.wait()
        picture = np.asarray(render.film()["color"])[..., :3]
    told = [message for _, message in scene.diagnostics]
    assert not (strict and told), told
    inner = picture.reshape(SIDE, count, SIDE, 3)[2:-2, :, 2:-2]
    return inner.mean(axis=(0, 2)), told
