"""Weights out of their range are held and told once: nothing under a white sky of 1 is brighter than 1, in all of the surfaces that stages have."""

import gonio
import numpy as np
import pytest

STAGE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def DomeLight "Sky"
{
}
def Mesh "Floor" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)]
    rel material:binding = </M>
}
def Camera "Eye"
{
    double3 xformOp:translate = (0, 0, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Material "M"
{
    token outputs:CONTEXTsurface.connect = </M/S.outputs:out>
    def Shader "S"
    {
        uniform token info:id = "NODE"
        WHITE
        float inputs:NAME = VALUE
        token outputs:out
    }
}
"""
WHITE = "color3f inputs:base_color = (1, 1, 1)"
SURFACES = {
    "UsdPreviewSurface": ("", "color3f inputs:diffuseColor = (1, 1, 1)", ("opacity", "clearcoat", "metallic", "roughness", "clearcoatRoughness")),
    "ND_open_pbr_surface_surfaceshader": (
        "mtlx:",
        WHITE,
        ("base_weight", "base_metalness", "specular_roughness", "transmission_weight", "fuzz_weight", "coat_weight", "geometry_opacity"),
    ),
    "ND_standard_surface_surfaceshader": ("mtlx:", WHITE, ("base", "metalness", "transmission", "sheen", "coat", "specular_roughness")),
    "ND_gltf_pbr_surfaceshader": ("mtlx:", WHITE + "\nint inputs:alpha_mode = 2", ("metallic", "roughness", "transmission", "clearcoat", "alpha")),
}
CASES = [(node, name) for node, (*_, names) in SURFACES.items() for name in names]


@pytest.mark.parametrize(("node", "name"), CASES)
def test_what_is_out_of_range_is_held_and_told(tmp_path, node, name):
    context, white, _ = SURFACES[node]
    for value in ("255", "-3", "1e38", "nan"):
        text = STAGE
        for word, becomes in (("CONTEXT", context), ("NODE", node), ("WHITE", white), ("NAME", name), ("VALUE", value)):
            text = text.replace(word, becomes)
        path = tmp_path / "stage.usda"
        path.write_text(text)
        scene = gonio.load_usd(str(path))
        scene.set(width=16, height=16, samples=64, threads=1, passes=["color"])
        with gonio.Render(scene) as render:
            assert render.wait()
            colour = np.asarray(render.film()["color"])[..., :3].astype("f8")
            said = [text for _, text in [*scene.diagnostics, *render.diagnostics]]
        assert np.isfinite(colour).all() and colour.min() >= 0, (value, colour.min())
        error = colour.mean(-1).std() / 16
        assert colour.mean() < 1.0 + 4.0 * error + 0.005, (value, colour.mean(), error)
        about = [text for text in said if "not finite" in text or "outside" in text]
        assert about and len(set(about)) == len(about), (value, said)
