"""Media of stages: MaterialX's volumes, solids that scatter, and haze that fills all of space."""

import math

import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

HEADER = '#usda 1.0\n(\n    metersPerUnit = 0.01\n    upAxis = "Y"\n)\n'
BALL = 'def Sphere "Ball" (prepend apiSchemas = ["MaterialBindingAPI"])\n{\n    double radius = 1\n    rel material:binding = </M>\n}\n'


def shader(name, kind, **inputs):
    """A shader prim; inputs are (type, value) pairs, or the name of the shader that they are connected to."""
    lines = []
    for key, value in inputs.items():
        if isinstance(value, str):
            lines.append(f"token inputs:{key}.connect = </M/{value}.outputs:out>")
        else:
            lines.append(f"{value[0]} inputs:{key} = {value[1]}")
    body = "\n        ".join(lines)
    return f'    def Shader "{name}"\n    {{\n        uniform token info:id = "{kind}"\n        {body}\n        token outputs:out\n    }}\n'


def load(tmp_path, text, **options):
    path = tmp_path / "stage.usda"
    path.write_text(HEADER + text)
    return gonio.load_usd(str(path), camera_light=False, **options)


def material(tmp_path, output, *shaders):
    scene = load(tmp_path, BALL + f'def Material "M"\n{{\n    token outputs:{output}.connect = </M/S.outputs:out>\n' + "".join(shaders) + "}\n")
    described = scene.to_dict()
    return described["materials"][described["instances"][0]["materials"][0]], _told(scene)


def _told(scene):
    """What is said of the materials; these stages have no camera."""
    return [message for _, message in scene.diagnostics if "camera" not in message and "can be seen" not in message]


MILK = shader("V", "ND_anisotropic_vdf", absorption=("color3f", "(0.1, 0.2, 0.3)"), scattering=("color3f", "(1, 2, 4)"), anisotropy=("float", "0.5"))


@pytest.mark.parametrize("output", ["volume", "mtlx:volume"])
def test_volumes_fill_meshes_by_the_stages_unit(tmp_path, output):
    found, told = material(tmp_path, output, shader("S", "ND_volume", vdf="V"), MILK)
    assert found["medium"]["absorption"] == pytest.approx([10, 20, 30])
    assert found["medium"]["scattering"] == pytest.approx([100, 200, 400])
    assert found["medium"]["anisotropy"] == pytest.approx(0.5) and not told
    # Rays pass what is a volume alone.
    assert [closure["model"] for closure in found["closures"]] == ["Transparent"]


def test_distributions_add_up_and_are_mixed(tmp_path):
    clear = shader("A", "ND_absorption_vdf", absorption=("color3f", "(1, 1, 1)"))
    found, _ = material(tmp_path, "volume", shader("S", "ND_add_vdf", in1="V", in2="A"), MILK, clear)
    assert found["medium"]["absorption"] == pytest.approx([110, 120, 130])
    found, _ = material(tmp_path, "volume", shader("S", "ND_mix_vdf", bg="V", fg="A", mix=("float", "0.25")), MILK, clear)
    assert found["medium"]["scattering"] == pytest.approx([75, 150, 300])
    shining = shader("E", "ND_uniform_edf", color=("color3f", "(1, 2, 3)"))
    found, _ = material(tmp_path, "volume", shader("S", "ND_volume", vdf="A", edf="E"), clear, shining)
    assert found["medium"]["emission"] == pytest.approx([100, 200, 300])


def test_what_is_no_volume_is_told(tmp_path):
    _, told = material(tmp_path, "volume", shader("S", "ND_cloud_of_dreams"))
    assert any("volume shader 'ND_cloud_of_dreams'" in message for message in told), told


def test_volume_materials_of_documents(tmp_path):
    (tmp_path / "look.mtlx").write_text(
        '<?xml version="1.0"?><materialx version="1.39">'
        '<anisotropic_vdf name="v" type="VDF"><input name="scattering" type="vector3" value="2, 2, 2"/></anisotropic_vdf>'
        '<volume name="f" type="volumeshader"><input name="vdf" type="VDF" nodename="v"/></volume>'
        '<volumematerial name="M" type="material"><input name="volumeshader" type="volumeshader" nodename="f"/></volumematerial></materialx>'
    )
    reference = 'def "L" (references = @look.mtlx@</MaterialX/Materials>) {}\n'
    scene = load(tmp_path, BALL.replace("</M>", "</L/M>") + reference)
    assert scene.to_dict()["materials"][0]["medium"]["scattering"] == pytest.approx([200] * 3), scene.diagnostics


@pytest.mark.parametrize("kind", ["ND_open_pbr_surface_surfaceshader", "ND_standard_surface_surfaceshader"])
def test_solids_scatter_over_the_depth_by_which_they_absorb(tmp_path, kind):
    weight = "transmission_weight" if "open" in kind else "transmission"
    milk = shader(
        "S",
        kind,
        transmission_color=("color3f", "(0.5, 0.5, 0.5)"),
        transmission_depth=("float", "2"),
        transmission_scatter=("color3f", "(0.2, 0.4, 0.9)"),
        transmission_scatter_anisotropy=("float", "0.3"),
        **{weight: ("float", "1")},
    )
    found, told = material(tmp_path, "mtlx:surface", milk)
    solid = found["closures"][0]["solid"]
    assert solid["scattering"] == pytest.approx([10, 20, 45]) and not told
    # Nothing absorbs less than nothing: all of it is raised.
    extinction = math.log(2) / 0.02
    raised = 45 - extinction
    assert solid["absorption"] == pytest.approx([extinction - 10 + raised, extinction - 20 + raised, 0], abs=1e-3)
    assert solid["anisotropy"] == pytest.approx(0.3)


def haze(tmp_path, text, **options):
    scene = load(tmp_path, f'def Xform "Air"\n{{\n{text}\n}}\n', **options)
    return scene.to_dict().get("atmosphere"), _told(scene)


def test_haze_of_a_stage(tmp_path):
    found, told = haze(tmp_path, "    double gonio:haze:visibility = 100")
    assert found["scattering"] == pytest.approx([math.log(20) / 100] * 3, rel=1e-5) and not told
    found, _ = haze(tmp_path, "    double gonio:haze:extinction = 0.1\n    color3f gonio:haze:albedo = (1, 0.5, 0)\n    double gonio:haze:anisotropy = 0")
    assert found["absorption"] == pytest.approx([0, 0.05, 0.1]) and found["anisotropy"] == 0
    found, _ = haze(tmp_path, "", haze=50.0)
    assert found["scattering"] == pytest.approx([math.log(20) / 50] * 3, rel=1e-5)


@pytest.mark.parametrize(
    ("text", "part"),
    [
        ("double gonio:haze:visibility = -1", "metres above 0"),
        ("double gonio:haze:extinction = 1\n    double gonio:haze:visibility = 1", "either gonio:haze:visibility"),
        ("double gonio:haze:visibility = 9\n    double gonio:haze:contrast = 2", "between 0 and 1"),
        ("double gonio:haze:visibility = 9\n    color3f gonio:haze:albedo = (2, 0, 0)", "from 0 to 1"),
        ("double gonio:haze:visibility = nan", "metres above 0"),
    ],
)
def test_haze_that_makes_no_sense_is_told(tmp_path, text, part):
    found, told = haze(tmp_path, f"    {text}")
    assert found is None and any(part in message for message in told), told
