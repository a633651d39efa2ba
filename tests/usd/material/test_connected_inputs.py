"""Inputs that operations hold as constants, connected to what varies over the stage; and connections that lead nowhere."""

import numpy as np
import pictures
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

from squares import glowing, shader, shown, square

GREEN = (0.1, 0.7, 0.1)
READER = shader(
    "F",
    "UsdPrimvarReader_float4",
    'string inputs:varname = "tint"\n            float4 inputs:fallback = (0.2, 0.3, 0.4, 1)\n            float4 outputs:result',
)
TINT = "float4[] primvars:tint = [(0.1, 0.7, 0.1, 1)]"


def texture(body, file="not_there.png"):
    return shader("T", "UsdUVTexture", f"asset inputs:file = @{file}@\n            {body}\n            float3 outputs:rgb")


def test_a_texture_falls_back_to_what_a_primvar_says(tmp_path):
    material = glowing("M", "T.outputs:rgb", texture("float4 inputs:fallback.connect = </M/F.outputs:result>"), READER)
    found, told = shown(tmp_path / "a.usda", 2, square(0, "/M", TINT), square(1, "/M"), material, strict=False)
    assert found == pytest.approx(np.array([GREEN, (0.2, 0.3, 0.4)]), abs=1e-4)
    assert len(told) == 1 and "not_there.png" in told[0], told


def test_an_image_is_scaled_by_what_varies_and_missing_tiles_fall_back(tmp_path):
    pictures.write_png(tmp_path / "t.1001.png", np.full((2, 2, 3), 255, dtype=np.uint8))
    pictures.write_png(tmp_path / "t.1003.png", np.full((2, 2, 3), 255, dtype=np.uint8))
    body = (
        "float4 inputs:scale.connect = </M/F.outputs:result>\n            float4 inputs:fallback.connect = </M/F.outputs:result>\n"
        "            float4 inputs:bias = (0.1, 0, 0, 0)\n            float2 inputs:st.connect = </M/R.outputs:result>"
    )
    reader = shader("R", "UsdPrimvarReader_float2", 'string inputs:varname = "st"\n            float2 outputs:result')
    material = glowing("M", "T.outputs:rgb", texture(body, "t.<UDIM>.png"), READER, reader)
    beside = square(1, "/M", TINT).replace("[(0, 0), (1, 0), (1, 1), (0, 1)]", "[(1, 0), (2, 0), (2, 1), (1, 1)]")
    found, _ = shown(tmp_path / "a.usda", 2, square(0, "/M", TINT), beside, material, strict=False)
    assert found == pytest.approx(np.array([(0.2, 0.7, 0.1), GREEN]), abs=1e-4)


def test_a_reader_falls_back_to_another(tmp_path):
    reader = shader(
        "P",
        "UsdPrimvarReader_float3",
        'string inputs:varname = "own"\n            float3 inputs:fallback.connect = </M/F.outputs:result>\n            float3 outputs:result',
    )
    material = glowing("M", "P.outputs:result", reader, READER)
    own = "color3f[] primvars:own = [(0.5, 0.25, 1)]"
    found, _ = shown(tmp_path / "a.usda", 3, square(0, "/M", f"{own}\n{TINT}"), square(1, "/M", TINT), square(2, "/M"), material)
    assert found == pytest.approx(np.array([(0.5, 0.25, 1), GREEN, (0.2, 0.3, 0.4)]), abs=1e-4)


def test_materialx_images_and_properties_fall_back_to_nodes(tmp_path):
    image = shader("T", "ND_image_color3", "asset inputs:file = @no.png@\n            color3f inputs:default.connect = </M/P.outputs:out>\n            color3f outputs:out")
    property_ = shader(
        "P",
        "ND_geompropvalue_color3",
        'string inputs:geomprop = "none"\n            color3f inputs:default.connect = </M/F.outputs:result>\n            color3f outputs:out',
    )
    material = glowing("M", "T.outputs:out", image, property_, READER)
    found, _ = shown(tmp_path / "a.usda", 2, square(0, "/M", TINT), square(1, "/M"), material, strict=False)
    assert found == pytest.approx(np.array([GREEN, (0.2, 0.3, 0.4)]), abs=1e-4)


def test_coordinates_are_turned_by_what_a_primvar_says(tmp_path):
    """An eighth of a turn about the origin, scaled and moved as constants do it."""
    reader = shader("R", "UsdPrimvarReader_float2", 'string inputs:varname = "place"\n            float2 outputs:result')
    angle = shader("A", "UsdPrimvarReader_float", 'string inputs:varname = "angle"\n            float outputs:result')
    parts = "float2 inputs:in.connect = </{0}/R.outputs:result>\n            float2 inputs:scale = (2, 1)\n            float2 inputs:translation = (0.25, 0.5)\n            float2 outputs:result\n            "
    turned = glowing(
        "V", "X.outputs:result", reader, angle, shader("X", "UsdTransform2d", parts.format("V") + "float inputs:rotation.connect = </V/A.outputs:result>")
    )
    constant = glowing("C", "X.outputs:result", reader, shader("X", "UsdTransform2d", parts.format("C") + "float inputs:rotation = 30"))
    place = "float2[] primvars:place = [(0.3, 0.1)]\nfloat[] primvars:angle = [30]"
    found, _ = shown(tmp_path / "a.usda", 2, square(0, "/V", place), square(1, "/C", place), turned, constant)
    x, y = 0.6 * np.cos(np.pi / 6) - 0.1 * np.sin(np.pi / 6) + 0.25, 0.6 * np.sin(np.pi / 6) + 0.1 * np.cos(np.pi / 6) + 0.5
    assert found[:, :2] == pytest.approx(np.array([(x, y)] * 2), abs=1e-4)


def test_a_threshold_that_a_primvar_says_cuts(tmp_path):
    threshold = shader("H", "UsdPrimvarReader_float", 'string inputs:varname = "threshold"\n            float outputs:result')
    constant = shader("W", "UsdPrimvarReader_float3", 'string inputs:varname = "none"\n            float3 inputs:fallback = (1, 1, 1)\n            float3 outputs:result')
    cut = "float inputs:opacity = 0.5\n            float inputs:opacityThreshold.connect = </M/H.outputs:result>\n            token outputs:surface"
    material = glowing("M", "W.outputs:result", threshold, constant).replace("token outputs:surface\n", cut + "\n")
    own = "float[] primvars:threshold = [{}]"
    found, _ = shown(tmp_path / "a.usda", 2, square(0, "/M", own.format(0.25)), square(1, "/M", own.format(0.75)), material)
    assert found == pytest.approx(np.array([(1, 1, 1), (0, 0, 0)]), abs=1e-4)


def dangling(tmp_path, connection, extra=""):
    material = glowing("M", "gone", extra).replace("</M/gone>", connection)
    found, told = shown(tmp_path / "a.usda", 1, square(0, "/M"), material, strict=False)
    return found[0], [message for message in told if any(words in message for words in ("not there", "no output", "back to itself"))]


def test_connections_that_lead_nowhere_are_told(tmp_path):
    colour, told = dangling(tmp_path, "</M/T.outputs:rgb>")
    assert len(told) == 1 and "'emissiveColor'" in told[0] and "</M/T.outputs:rgb>" in told[0], told
    assert colour == pytest.approx([0, 0, 0])
    # Its own value is what is left.
    colour, told = dangling(tmp_path, "</M/T.outputs:rgb>\n            color3f inputs:emissiveColor = (0, 0.5, 0)")
    assert len(told) == 1 and colour == pytest.approx([0, 0.5, 0], abs=1e-4)
    # Through the material's interface.
    colour, told = dangling(tmp_path, "</M.inputs:tint>", "color3f inputs:tint.connect = </M/T.outputs:rgb>\n")
    assert len(told) == 1 and "</M/T.outputs:rgb>" in told[0], told
    # An interface without a value is no fault.
    assert dangling(tmp_path, "</M.inputs:tint>", "color3f inputs:tint\n")[1] == []


def test_interfaces_in_a_circle_are_told(tmp_path):
    graph = 'def NodeGraph "{0}"\n{{\n color3f inputs:a.connect = </M/{1}.outputs:o>\n color3f outputs:o.connect = </M/{0}.inputs:a>\n}}\n'
    _, told = dangling(tmp_path, "</M/A.outputs:o>", graph.format("A", "B") + graph.format("B", "A"))
    assert len(told) == 1 and "'emissiveColor'" in told[0] and "back to itself" in told[0], told


def test_outputs_that_nodes_do_not_have_are_told(tmp_path):
    reader = READER.replace("outputs:result", "outputs:rgb")
    _, told = dangling(tmp_path, "</M/F.outputs:rgb>", reader)
    assert len(told) == 1 and "no output 'rgb'" in told[0], told


def test_a_surface_that_is_not_there_is_told(tmp_path):
    material = 'def Material "M"\n{\n    token outputs:surface.connect = </M/Gone.outputs:surface>\n}\n'
    _, told = shown(tmp_path / "a.usda", 1, square(0, "/M"), material, strict=False)
    assert any("</M/Gone.outputs:surface>" in message for message in told), told
