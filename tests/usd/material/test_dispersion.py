"""Dispersion of glass: OpenPBR's scale of an Abbe number, standard_surface's Abbe number, and glTF's 20 over it."""

import pytest
from test_materials import BOUND, bound_material, load, mtlx

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

OPEN_PBR, STANDARD, GLTF = (f"ND_{name}_surfaceshader" for name in ("open_pbr_surface", "standard_surface", "gltf_pbr"))
SCALE, ABBE = "float inputs:transmission_dispersion_scale = ", "float inputs:transmission_dispersion_abbe_number = "


def dispersion(scene):
    """1 over the Abbe number of the first thing's material."""
    found = dict(bound_material(scene)["parameters"]).get("transmission_dispersion", {"Constant": [0.0]})
    return found["Constant"][0]


@pytest.mark.parametrize(
    ("shader", "inputs", "expected"),
    [
        (OPEN_PBR, "", 0.0),
        # The Abbe number alone bends nothing.
        (OPEN_PBR, f"{ABBE}40", 0.0),
        (OPEN_PBR, f"{SCALE}1", 1 / 20),
        (OPEN_PBR, f"{SCALE}0.5\n        {ABBE}40", 1 / 80),
        (STANDARD, "", 0.0),
        (STANDARD, "float inputs:transmission_dispersion = 40", 1 / 40),
        (GLTF, "float inputs:dispersion = 0.5", 1 / 40),
    ],
)
def test_abbe_numbers(tmp_path, shader, inputs, expected):
    assert dispersion(load(tmp_path, mtlx(shader, inputs))) == pytest.approx(expected, rel=1e-6)


def test_a_documents_graph_says_the_scale(tmp_path):
    """By an input of the document that a product reads."""
    (tmp_path / "doc.mtlx").write_text(
        '<materialx version="1.39"><input name="half" type="float" value="0.5"/>'
        '<nodegraph name="G"><input name="in" type="float" interfacename="half"/><multiply name="m" type="float">'
        '<input name="in1" type="float" interfacename="in"/><input name="in2" type="float" value="0.5"/></multiply>'
        '<output name="o" type="float" nodename="m"/></nodegraph>'
        '<open_pbr_surface name="S" type="surfaceshader"><input name="transmission_weight" type="float" value="1"/>'
        '<input name="transmission_dispersion_scale" type="float" nodegraph="G" output="o"/>'
        '<input name="transmission_dispersion_abbe_number" type="float" value="50"/></open_pbr_surface>'
        '<surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>'
    )
    scene = load(tmp_path, BOUND.replace("</M>", "</L/Materials/M>") + 'def "L" (references = @doc.mtlx@</MaterialX>) {}\n')
    assert dispersion(scene) == pytest.approx(0.25 / 50, rel=1e-6)


def test_a_scale_that_varies_is_told(tmp_path):
    reader = (
        'def Shader "R"\n    {\n        uniform token info:id = "UsdPrimvarReader_float"\n        string inputs:varname = "scale"\n'
        "        float outputs:result\n    }"
    )
    text = mtlx(OPEN_PBR, "float inputs:transmission_dispersion_scale.connect = </M/R.outputs:result>", reader)
    load(tmp_path, text.replace("rel material", "float[] primvars:scale = [0.5]\n    rel material"))
    told = [message for _, message in gonio.load_usd(str(tmp_path / "stage.usda")).diagnostics]
    assert any("transmission_dispersion_scale" in message for message in told), told
