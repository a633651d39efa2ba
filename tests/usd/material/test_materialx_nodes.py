"""MaterialX's pattern nodes against the standard library's definitions in double precision: all in one picture, each at a few places."""

import pathlib

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")
MaterialX = pytest.importorskip("MaterialX", reason="the extra materialx is not installed")

import materialx_reference as reference

LIBRARIES = pathlib.Path(MaterialX.__file__).parent / "libraries"
DOCUMENTS = ["stdlib/stdlib_defs.mtlx", "cmlib/cmlib_defs.mtlx", "nprlib/nprlib_defs.mtlx", "pbrlib/pbrlib_defs.mtlx"]
HEADER = '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Y"\n)\ndef DomeLight "Dark"\n{\n    float inputs:intensity = 0\n}\n'
# Places that a node is evaluated at, pixels along the side of one, and nodes beside one another.
PLACES, SIDE, BESIDE = 8, 3, 16
# How far values may lie apart.
TOLERANCE = 1e-4
# Added to all values, so that negative ones are seen.
LIFT = 64.0
TYPES = {
    "float": "float",
    "integer": "float",
    "boolean": "float",
    "vector2": "float2",
    "vector3": "float3",
    "vector4": "float4",
    "color3": "color3f",
    "color4": "color4f",
}
# Where inputs lie, by category; between 0.1 and 0.9 elsewhere.
RANGES = {
    "add": (-4, 4), "subtract": (-4, 4), "multiply": (-4, 4), "modulo": (0.3, 4), "fract": (-4, 4), "absval": (-4, 4), "floor": (-4,
    4), "ceil": (-4, 4),
    "round": (-4, 4), "sign": (-4, 4), "sin": (-6, 6), "cos": (-6, 6), "tan": (-1.3, 1.3), "asin": (-1, 1), "acos": (-1, 1), "atan2":
    (-2, 2),
    "min": (-2, 2), "max": (-2, 2), "dotproduct": (-2, 2), "crossproduct": (-2, 2), "magnitude": (-2, 2), "normalize": (-2, 2),
    "safepower": (-2, 2),
    "switch": (0, 6), "trianglewave": (-3, 3), "rotate2d": (-90, 90), "rotate3d": (0.1, 9), "blackbody": (900, 15000), "distance": (-2, 2),
}  # fmt: skip
# What cannot stand in a picture of values: files, text, noise that waits for the engine, and what knows its place by itself.
LEFT_OUT = {
    "image", "tiledimage", "latlongimage", "hextiledimage", "hextilednormalmap", "triplanarprojection", "noise2d", "noise3d",
    "fractal2d", "fractal3d",
    "cellnoise2d", "cellnoise3d", "worleynoise2d", "worleynoise3d", "unifiednoise2d", "unifiednoise3d", "randomfloat", "randomcolor",
    "flake2d", "flake3d",
    "position", "normal", "tangent", "bitangent", "texcoord", "geomcolor", "geompropvalue", "geompropvalueuniform", "viewdirection",
    "time", "frame",
    "transformpoint", "transformvector", "transformnormal", "normalmap", "bump", "heighttonormal", "blur", "tiledcircles",
    "tiledcloverleafs",
    "tiledhexagons", "gooch_shade",
}  # fmt: skip


def cases(library):
    """Definitions of patterns with the output that is looked at, and the part of it: colour or alpha."""
    known = set()
    for document in DOCUMENTS:
        known |= {each.get("name") for each in reference.ElementTree.parse(LIBRARIES / document).getroot().findall("nodedef")}
    for name, definition in library.definitions.items():
        kinds = [each.get("type") for each in definition.findall("input")]
        if (
            name not in known
            or definition.get("node") in LEFT_OUT
            or any(kind not in reference.COMPONENTS for kind in kinds if kind != "string")
        ):
            continue
        for output in definition.findall("output"):
            components = reference.COMPONENTS.get(output.get("type"), 0)
            for part in range(0 if components in (0, 9, 16) else 1 + (components == 4)):
                yield definition, output.get("name"), part


def chosen(definition, random):
    """What a definition's inputs are set to."""
    low, high = RANGES.get(definition.get("node"), (0.1, 0.9))
    values = {}
    for each in definition.findall("input"):
        name, kind = each.get("name"), each.get("type")
        if kind in ("integer", "boolean"):
            # Of values that change nothing but the choice, one a definition.
            values[name] = np.full((PLACES, 1), float(random.integers(0, 2 if kind == "boolean" or name == "index" else 4)))
        elif kind.startswith("matrix"):
            values[name] = np.round(random.uniform(-1, 1, (1, reference.COMPONENTS[kind])), 3)
        elif kind in reference.COMPONENTS:
            values[name] = random.uniform(low, high, (PLACES, reference.COMPONENTS[kind])).astype(np.float32).astype(float)
    return values


def text(rows):
    """Rows as they stand in a layer."""
    rows = [", ".join(f"{x:.9g}" for x in row) for row in rows]
    return rows[0] if "," not in rows[0] and len(rows) == 1 else ", ".join(f"({row})" if "," in row else row for row in rows)


def node(name, body):
    return f'    def Shader "{name}"\n    {{\n{body}\n        token outputs:out\n    }}\n'


def piece(number, definition, output, part, values):
    """A row of squares that shine by a node's values."""
    primvars, inputs, readers = "", "", ""
    for name, rows in values.items():
        kind = next(each.get("type") for each in definition.findall("input") if each.get("name") == name)
        if kind.startswith("matrix"):
            side = int(np.sqrt(rows.shape[1]))
            inputs += f"        matrix{side}d inputs:{name} = ({text(rows.reshape(side, side))})\n"
        elif kind in ("integer", "boolean"):
            inputs += f"        {'int' if kind == 'integer' else 'bool'} inputs:{name} = {int(rows[0, 0])}\n"
        else:
            primvars += f'    {TYPES[kind]}[] primvars:{name} = [{text(rows)}] (interpolation = "uniform")\n'
            inputs += f"        token inputs:{name}.connect = </M{number}/{name}.outputs:out>\n"
            readers += node(name, f'        uniform token info:id = "ND_geompropvalue_{kind}"\n        string inputs:geomprop = "{name}"')
    result = f"</M{number}/Node.outputs:{output}>"
    if part:
        readers += node(
            "Alpha",
            f'        uniform token info:id = "ND_extract_color4"\n        token inputs:in.connect = {result}\n        int inputs:index = 3',
        )
        result = f"</M{number}/Alpha.outputs:out>"
    lifted = f'        uniform token info:id = "ND_add_color3"\n        token inputs:in1.connect = {result}\n        color3f inputs:in2 = ({LIFT}, {LIFT}, {LIFT})'
    surface = (
        f'        uniform token info:id = "ND_surface_unlit"\n        color3f inputs:emission_color.connect = </M{number}/Lift.outputs:out>'
    )
    outputs = "" if output == "out" else f"        token outputs:{output}\n"
    left, top = number % BESIDE * PLACES, number // BESIDE
    points = [(left + place + x, -top - y, 0) for place in range(PLACES) for x, y in ((0, 1), (1, 1), (1, 0), (0, 0))]
    return f"""
def Mesh "Row{number}" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = {[4] * PLACES}
    int[] faceVertexIndices = {list(range(4 * PLACES))}
    point3f[] points = {points}
{primvars}    rel material:binding = </M{number}>
}}
def Material "M{number}"
{{
    token outputs:mtlx:surface.connect = </M{number}/S.outputs:out>
{node("S", surface)}{node("Lift", lifted)}{readers}{node("Node", f'        uniform token info:id = "{definition.get("name")}"' + chr(10) + inputs + outputs)}}}
"""


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    return measured(tmp_path_factory.mktemp("materialx"))


def measured(folder):
    """What gonio and what the definitions give: category, name, output, part, both values at the places; and the messages."""
    library = reference.Library(LIBRARIES)
    random = np.random.default_rng(5)
    rows, stage = [], HEADER
    for definition, output, part in cases(library):
        values = chosen(definition, np.random.default_rng(abs(hash_of(definition.get("name")))) if part == 0 else random)
        stage += piece(len(rows), definition, output, part, values)
        expected = reference.Evaluator(library, {"UV0": np.zeros((1, 2))}).value(definition, values, output)
        rows.append((definition.get("node"), definition.get("name"), output, part, np.broadcast_to(expected, (PLACES, expected.shape[1]))))
    across, down = BESIDE * PLACES, -(-len(rows) // BESIDE)
    stage += f"""
def Camera "Camera"
{{
    token projection = "orthographic"
    float horizontalAperture = {10 * across}
    float verticalAperture = {10 * down}
    double3 xformOp:translate = ({across / 2}, {-down / 2}, 5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""
    path = folder / "nodes.usda"
    path.write_text(stage)
    scene = gonio.load_usd(str(path), camera_light=False)
    scene.set(width=across * SIDE, height=down * SIDE, samples=1, passes=["color"], max_bounces=0)
    with gonio.Render(scene) as render:
        assert render.wait()
        picture = np.asarray(render.film()["color"])[..., :3].astype(float)
    centres = picture[SIDE // 2 :: SIDE, SIDE // 2 :: SIDE].reshape(down, BESIDE, PLACES, 3).reshape(-1, PLACES, 3) - LIFT
    return [(*row, centre) for row, centre in zip(rows, centres, strict=False)], [message for _, message in scene.diagnostics]


def difference(expected, seen, part):
    """The largest difference of a node's values, as a share of one and the value."""
    expected = expected[:, 3:] if part else expected[:, :3]
    usable = np.isfinite(expected) & (np.abs(expected) < LIFT / 2)
    apart = np.abs(np.where(usable, expected - seen[:, : expected.shape[1]], 0))
    return float((apart / (1 + np.abs(np.where(usable, expected, 0)))).max())


def hash_of(name):
    """The same number for a name in every run."""
    return sum(ord(letter) * 31**place for place, letter in enumerate(name)) % (1 << 31)


def test_nodes_give_what_their_definitions_say(found):
    rows, messages = found
    wrong, checked = [], 0
    for _, name, output, part, expected, seen in rows:
        largest = difference(expected, seen, part)
        checked += 1
        if largest > TOLERANCE:
            wrong.append(f"{name}.{output}[{part}]: {largest:.2g}\n    {expected[0]} {seen[0]}")
    assert not wrong, f"{len(wrong)} of {checked} differ\n" + "\n".join(wrong)
    assert checked > 350
    assert not messages, messages[:5]
