"""Volumes of UsdVol: fields of files, where they are placed, what their materials make of them, and files that cannot be used."""

import math

import numpy as np
import pytest
import vdb_file
from small_scenes import finished

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

HEADER = '#usda 1.0\n(\n    metersPerUnit = 0.1\n    upAxis = "Z"\n)\n'
X, Y, Z = np.mgrid[0:6, 0:5, 0:4]
CLOUD = (1.0 + X + 10 * Y + 100 * Z).astype(np.float32) / 500
HEAT = (CLOUD * 2000).astype(np.float32)


def volume(name="Cloud", fields="density heat", body="", inside="", bound=True, file="cloud.vdb"):
    """A volume whose fields have the names of their grids."""
    relations = "".join(f"    rel field:{field} = <{field}>\n" for field in fields.split())
    prims = "".join(
        f'    def OpenVDBAsset "{field}"\n    {{\n        asset filePath = @{file}@\n        token fieldName = "{field}"\n        {inside}\n    }}\n'
        for field in fields.split()
    )
    binding = "    rel material:binding = </M>\n" if bound else ""
    return f'def Volume "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])\n{{\n{relations}{binding}    {body}\n{prims}}}\n'


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


def field(name, prop):
    return shader(name, "ND_geompropvalue_float", geomprop=("string", f'"{prop}"'))


def times(name, by, value):
    return shader(name, "ND_multiply_vector3FA", in1=("float3", value), in2=by)


def material(*shaders, output="volume"):
    return f'def Material "M"\n{{\n    token outputs:{output}.connect = </M/S.outputs:out>\n' + "".join(shaders) + "}\n"


SMOKE = material(
    shader("S", "ND_volume", vdf="V"),
    shader("V", "ND_anisotropic_vdf", absorption="A", scattering="B", anisotropy=("float", "0.3")),
    times("A", "D", "(1, 2, 3)"),
    times("B", "D", "(4, 5, 6)"),
    field("D", "density"),
)


def load(tmp_path, text, file=True, **options):
    if file:
        vdb_file.write(tmp_path / "cloud.vdb", ("density", CLOUD), ("heat", HEAT), voxel=0.5, shift=(1, 2, 3))
    path = tmp_path / "stage.usda"
    path.write_text(HEADER + text)
    scene = gonio.load_usd(str(path), camera_light=False, **options)
    told = [message for _, message in scene.diagnostics if "camera" not in message and "can be seen" not in message]
    return scene.to_dict(), told


def columns(described):
    return np.array(described["to_world"]["columns"])


def medium(scene, number=0):
    return scene["materials"][scene["instances"][number]["materials"][0]]["medium"]


def at_voxel(described, place, lattice="density"):
    """The value of a lattice at whole coordinates."""
    found = described[lattice]
    for number, brick in enumerate(found["bricks"]):
        inner = np.array(place) - brick
        if ((inner >= 0) & (inner < 8)).all():
            return found["values"][512 * number + 64 * inner[0] + 8 * inner[1] + inner[2]]
    return 0.0


def test_grids_are_placed_by_field_volume_and_unit(tmp_path):
    inside = 'double3 xformOp:translate = (0, 0, 7)\n        uniform token[] xformOpOrder = ["xformOp:translate"]'
    body = 'double3 xformOp:scale = (2, 2, 2)\n    uniform token[] xformOpOrder = ["xformOp:scale"]'
    scene, told = load(tmp_path, SMOKE + volume(body=body, inside=inside))
    assert not told
    (described,) = scene["fields"]
    # Voxels of half a unit, twice as large, a unit 0.1 m; the corner at (1, 2, 3), moved by 7, twice as far.
    assert columns(described)[:3] == pytest.approx(np.eye(3) * 0.1)
    assert columns(described)[3] == pytest.approx([0.2, 0.4, 2.0])
    assert at_voxel(described, (5, 4, 3)) == pytest.approx(CLOUD[5, 4, 3]) and described["heat"] is None
    found = medium(scene)
    assert found["absorption"] == pytest.approx([10, 20, 30]) and found["scattering"] == pytest.approx([40, 50, 60])
    assert found["anisotropy"] == pytest.approx(0.3) and found["field"] == 0
    assert scene["instances"][0]["origin"]["name"] == "/Cloud"
    assert np.array(scene["instances"][0]["transforms"][0]["columns"]) == pytest.approx(columns(described))


def test_a_field_elsewhere_has_its_own_transformation_alone(tmp_path):
    elsewhere = """def Xform "Files" {
    double3 xformOp:translate = (100, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def OpenVDBAsset "density" {
        asset filePath = @cloud.vdb@
        token fieldName = "density"
        double3 xformOp:translate = (0, 5, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
"""
    here = 'def Volume "Cloud" (prepend apiSchemas = ["MaterialBindingAPI"])'
    here += "{\n rel field:density = </Files/density>\n rel material:binding = </M>\n}\n"
    scene, told = load(tmp_path, SMOKE + elsewhere + here)
    assert columns(scene["fields"][0])[3] == pytest.approx([0.1, 0.7, 0.3]) and not told


def test_emission_follows_heat_in_proportion_or_by_a_curve(tmp_path):
    glow = shader("E", "ND_uniform_edf", color="C")
    linear = material(shader("S", "ND_volume", edf="E"), glow, times("C", "H", "(1, 2, 3)"), field("H", "heat"))
    scene, told = load(tmp_path, linear + volume())
    (described,) = scene["fields"]
    assert medium(scene)["emission"] == pytest.approx([10, 20, 30]) and described["glow"] == [] and not told
    assert described["hottest"] == pytest.approx(HEAT.max())
    square = shader("C", "ND_power_vector3FA", in1="H", in2=("float", "2"))
    curve = material(shader("S", "ND_volume", edf="E"), glow, square, shader("H", "ND_geompropvalue_vector3", geomprop=("string", '"heat"')))
    scene, told = load(tmp_path, curve + volume())
    (described,) = scene["fields"]
    hottest = float(HEAT.max())
    expected = np.linspace(0, hottest, 256) ** 2
    assert np.array(described["glow"]) == pytest.approx(np.repeat(expected[:, None], 3, 1), rel=1e-4) and not told
    assert medium(scene)["emission"] == pytest.approx([10, 10, 10])
    assert at_voxel(described, (5, 4, 3), "heat") == pytest.approx(hottest)


def test_density_and_heat_share_a_box(tmp_path):
    both = material(
        shader("S", "ND_volume", vdf="V", edf="E"),
        shader("V", "ND_absorption_vdf", absorption="A"),
        times("A", "D", "(1, 1, 1)"),
        shader("E", "ND_uniform_edf", color="C"),
        times("C", "H", "(2, 2, 2)"),
        field("D", "density"),
        field("H", "heat"),
    )
    scene, told = load(tmp_path, both + volume())
    assert len(scene["fields"]) == 1 and not told
    assert medium(scene)["absorption"] == pytest.approx([10] * 3) and medium(scene)["emission"] == pytest.approx([20] * 3)
    # Grids with other voxels have boxes of their own, one within the other.
    vdb_file.write(tmp_path / "fire.vdb", ("heat", HEAT), voxel=0.25)
    apart = volume(fields="density").replace(
        "rel field:density", 'rel field:heat = <fire>\n    rel field:density'
    ).rstrip("}\n") + '}\n    def OpenVDBAsset "fire" { asset filePath = @fire.vdb@\n token fieldName = "heat"\n }\n}\n'
    scene, told = load(tmp_path, both + apart)
    assert [medium(scene, n)["emission"] != [0.0] * 3 for n in (0, 1)] == [False, True] and not told, told
    assert columns(scene["fields"][1])[0, 0] == pytest.approx(0.025)


def test_without_a_material_volumes_scatter_by_their_density(tmp_path):
    scene, told = load(tmp_path, volume(bound=False))
    assert medium(scene)["scattering"] == pytest.approx([10] * 3) and medium(scene)["absorption"] == [0] * 3
    assert len(told) == 1 and "no material says what it is" in told[0], told


def test_even_coefficients_fill_the_box(tmp_path):
    even = material(shader("S", "ND_absorption_vdf", absorption=("color3f", "(1, 2, 3)")))
    scene, told = load(tmp_path, even + volume())
    assert scene.get("fields", []) == [] and medium(scene)["absorption"] == pytest.approx([10, 20, 30])
    assert any("follows no field; the box" in message for message in told), told
    (mesh,) = scene["meshes"]
    # From the outer faces of the voxels, lattice coordinates.
    assert np.ptp(np.array(mesh["points"]).reshape(-1, 3), 0) == pytest.approx(CLOUD.shape)


def test_standard_volume_of_arnold(tmp_path):
    arnold = material(
        shader("S", "arnold:standard_volume", density=("float", "2"), scatter_color=("color3f", "(0.5, 0.5, 1)"), scatter_anisotropy=("float", "0.4"),
               transparent=("color3f", f"({math.exp(-1)}, {math.exp(-1)}, {math.exp(-3)})"), emission_mode=("string", '"channel"'),
               emission=("float", "3")),
        output="arnold:volume",
    )  # fmt: skip
    scene, told = load(tmp_path, arnold + volume())
    found = medium(scene)
    assert found["scattering"] == pytest.approx([10, 10, 60], rel=1e-4) and found["absorption"] == pytest.approx([10, 10, 0], rel=1e-4, abs=1e-4)
    assert found["emission"] == pytest.approx([30] * 3) and found["anisotropy"] == pytest.approx(0.4) and not told
    hot = material(shader("S", "arnold:standard_volume", temperature_channel=("string", '"heat"'), blackbody_kelvin=("float", "1")))
    scene, told = load(tmp_path, hot + volume())
    (described,) = scene["fields"]
    kelvin = float(HEAT.max())
    # Stefan and Boltzmann's law in the engine's scale, times the colour of the node Blackbody, whose luminance is near 1.
    luminance = np.dot(described["glow"][-1], [0.2126, 0.7152, 0.0722])
    assert luminance == pytest.approx(5.670373e-14 / math.pi * kelvin**4, rel=0.1) and not told
    assert described["glow"][0] == [0, 0, 0]


def test_instances_share_their_numbers(tmp_path):
    instancer = """def PointInstancer "Herd" {
    point3f[] positions = [(0, 0, 0), (10, 0, 0), (20, 0, 0)]
    int[] protoIndices = [0, 0, 0]
    rel prototypes = </Herd/Cloud>
"""
    scene, told = load(tmp_path, SMOKE + instancer + volume() + "}\n")
    assert [columns(described)[3, 0] for described in scene["fields"]] == pytest.approx([0.1, 1.1, 2.1]) and not told
    assert [medium(scene, number)["field"] for number in range(3)] == [0, 1, 2]
    native = f'class "Proto" {{\n{volume()}}}\ndef "A" (\ninstanceable = true\ninherits = </Proto>\n) {{}}\n'
    native += 'def Xform "B" (\ninstanceable = true\ninherits = </Proto>\n) { double3 xformOp:translate = (0, 1, 0)\n'
    native += 'uniform token[] xformOpOrder = ["xformOp:translate"]\n }\n'
    scene, told = load(tmp_path, SMOKE + native)
    assert sorted(instances["origin"]["name"] for instances in scene["instances"]) == ["/A/Cloud", "/B/Cloud"] and not told, told
    assert medium(scene)["absorption"] == pytest.approx([10, 20, 30])


def test_what_is_hidden_is_left_out(tmp_path):
    scene, _ = load(tmp_path, SMOKE + volume(body='token visibility = "invisible"') + volume("Guide", body='uniform token purpose = "guide"'))
    assert scene.get("fields", []) == []


def test_files_follow_time(tmp_path):
    vdb_file.write(tmp_path / "a.vdb", ("density", CLOUD))
    vdb_file.write(tmp_path / "b.vdb", ("density", 3 * CLOUD))
    text = SMOKE + volume(fields="density").replace("asset filePath = @cloud.vdb@", "asset filePath.timeSamples = { 1: @a.vdb@, 2: @b.vdb@ }")
    for frame, factor in [(1.0, 1), (1.5, 1), (2.0, 3)]:
        scene, told = load(tmp_path, text, frame=frame)
        assert at_voxel(scene["fields"][0], (2, 2, 2)) == pytest.approx(factor * CLOUD[2, 2, 2], rel=1e-5) and not told


SHUTTER = 'def Camera "C" { double shutter:open = -0.5\n double shutter:close = 0.5\n }\n'


def test_volumes_move_while_the_shutter_is_open(tmp_path):
    body = 'double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 10: (10, 0, 0) }\n    uniform token[] xformOpOrder = ["xformOp:translate"]'
    scene, told = load(tmp_path, SMOKE + SHUTTER + volume(body=body), frame=5.0)
    assert columns(scene["fields"][0])[3, 0] == pytest.approx(0.6)
    (places,) = scene["instances"]
    shift = [np.array(key[0]["columns"])[3, 0] - columns(scene["fields"][0])[3, 0] for key in places["motion"]]
    assert shift == pytest.approx([-0.05, 0.0, 0.05]) and not told


def test_other_files_within_the_shutter_are_told(tmp_path):
    vdb_file.write(tmp_path / "a.vdb", ("density", CLOUD))
    vdb_file.write(tmp_path / "b.vdb", ("density", 3 * CLOUD))
    text = SMOKE + volume(fields="density").replace("asset filePath = @cloud.vdb@", "asset filePath.timeSamples = { 1: @a.vdb@, 2: @b.vdb@ }")
    scene, told = load(tmp_path, SHUTTER + text, frame=2.0)
    assert at_voxel(scene["fields"][0], (2, 2, 2)) == pytest.approx(3 * CLOUD[2, 2, 2], rel=1e-5)
    assert len(told) == 1 and "grids are others at other times of the shutter" in told[0]


@pytest.mark.parametrize("parts", [False, True])
def test_velocities_let_volumes_flow(tmp_path, parts):
    """Stage units a second, a shutter of a 24th of a second that rests in its middle, voxels of half a unit."""
    velocity = np.zeros((*CLOUD.shape, 3), np.float32)
    velocity[..., 0], velocity[..., 2] = 24.0, -12.0
    names = ["vel_x", "vel_y", "vel_z"] if parts else ["velocity"]
    grids = [(name, velocity[..., axis] if parts else velocity) for axis, name in enumerate(names)]
    if parts:
        grids[1] = (names[1], np.full(CLOUD.shape, 1e-9, np.float32))
    vdb_file.write(tmp_path / "cloud.vdb", ("density", CLOUD), *grids, voxel=0.5)
    text = SMOKE + volume(fields=" ".join(["density", *names]))
    scene, told = load(tmp_path, SHUTTER + text, file=False)
    flow = scene["fields"][0]["flow"]
    assert flow["most"] == pytest.approx([2.0, 0.0, 1.0], abs=1e-6) and flow["rests"] == pytest.approx(0.5) and not told
    still, _ = load(tmp_path, text, file=False)
    assert "flow" not in still["fields"][0]
    least, greatest = (np.array(described["meshes"][0]["points"]).reshape(-1, 3) for described in (still, scene))
    assert greatest.max(0) - least.max(0) == pytest.approx([1.0, 0.0, 0.5], abs=1e-6)


def test_boxes_that_flow_are_found_beside_meshes_that_cannot_be_used(tmp_path):
    velocity = np.zeros((*CLOUD.shape, 3), np.float32)
    velocity[..., 0] = 24.0
    vdb_file.write(tmp_path / "cloud.vdb", ("density", CLOUD), ("vel", velocity), voxel=0.5)
    broken = 'def Mesh "Torn" { int[] faceVertexCounts = [3]\n int[] faceVertexIndices = [0, 1, 7]\n point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n }\n'
    text = SHUTTER + SMOKE + 'def Sphere "Ball" {}\n' + volume(fields="density vel")
    whole, _ = load(tmp_path, text, file=False)
    scene, told = load(tmp_path, broken + text, file=False)
    assert any("Torn" in name for name, _ in gonio.load_usd(str(tmp_path / "stage.usda"), camera_light=False).diagnostics), told
    boxes = [np.array(described["meshes"][-1]["points"]).reshape(-1, 3) for described in (whole, scene)]
    assert len(scene["meshes"]) == len(whole["meshes"]) and boxes[1] == pytest.approx(boxes[0])
    assert np.ptp(boxes[1], 0)[0] > CLOUD.shape[0] + 1


def test_velocities_that_are_none_are_told(tmp_path):
    vdb_file.write(tmp_path / "cloud.vdb", ("density", CLOUD), ("vel", CLOUD))
    scene, told = load(tmp_path, SHUTTER + SMOKE + volume(fields="density vel"), file=False)
    assert "flow" not in scene["fields"][0] and len(told) == 1 and "expected vectors; it does not flow" in told[0]


def test_flowing_volumes_render_as_moved_ones(tmp_path):
    """Even velocities are a motion."""
    means = []
    velocity = np.zeros((14, 9, 8, 3), np.float32)
    velocity[..., 0] = 48.0
    cloud = np.pad(20 * CLOUD, ((4, 4), (2, 2), (2, 2)))
    vdb_file.write(tmp_path / "cloud.vdb", ("density", cloud), ("vel", velocity))
    # The camera looks through the middle of the cloud's 0.6 m along z.
    camera = SHUTTER.replace("{ ", '{ double3 xformOp:translate = (5.5, 4.5, 40)\n uniform token[] xformOpOrder = ["xformOp:translate"]\n float focalLength = 4000\n ', 1)
    body = 'double3 xformOp:translate.timeSamples = { 0: (0, 0, 0), 10: (20, 0, 0) }\n    uniform token[] xformOpOrder = ["xformOp:translate"]'
    light = 'def DomeLight "L" { float inputs:intensity = 1\n }\n'
    for fields, move, shift in [("density vel", "", 0.0), ("density", body, 10.0)]:
        seen = camera.replace("(5.5,", f"({5.5 + shift},")
        path = tmp_path / "stage.usda"
        path.write_text(HEADER + SMOKE + seen + light + volume(fields=fields, body=move))
        scene = gonio.load_usd(str(path), camera_light=False, frame=5.0)
        scene.set(width=8, height=8, samples=512, max_bounces=32, filter="box", seed=5)
        pixels = np.asarray(finished(scene)["color"])[..., :3].mean(-1)
        means.append((pixels.mean(), pixels.std() / 8))
    (flowing, error), (moving, other) = means
    assert flowing == pytest.approx(moving, abs=4 * math.hypot(error, other)) and error < 0.01 * flowing and flowing < 0.9, means


def test_grids_of_one_name_are_told_apart_by_their_number(tmp_path):
    vdb_file.write(tmp_path / "cloud.vdb", ("density", CLOUD), ("density", 2 * CLOUD))
    scene, told = load(tmp_path, SMOKE + volume(fields="density", inside="int fieldIndex = 1"), file=False)
    assert at_voxel(scene["fields"][0], (1, 1, 1)) == pytest.approx(2 * CLOUD[1, 1, 1]) and not told


def test_files_in_packages(tmp_path):
    from pxr import UsdUtils

    vdb_file.write(tmp_path / "cloud.vdb", ("density", CLOUD))
    (tmp_path / "stage.usda").write_text(HEADER + SMOKE + volume(fields="density"))
    package = tmp_path / "cloud.usdz"
    assert UsdUtils.CreateNewUsdzPackage(str(tmp_path / "stage.usda"), str(package))
    (tmp_path / "cloud.vdb").unlink()
    scene = gonio.load_usd(str(package), camera_light=False).to_dict()
    assert at_voxel(scene["fields"][0], (1, 1, 1)) == pytest.approx(CLOUD[1, 1, 1])


def broken_file(tmp_path, kind):
    """Writes a file with a defect; gives what is said of it."""
    path = tmp_path / "cloud.vdb"
    grids = {"empty": 0 * CLOUD, "vector": np.stack([CLOUD] * 3, -1), "not finite": np.full_like(CLOUD, np.nan)}
    vdb_file.write(path, ("density", grids.get(kind, CLOUD)), kind="level set" if kind == "level set" else "fog volume")
    data = path.read_bytes()
    match kind:
        case "missing":
            path.unlink()
            return "does not exist"
        case "truncated":
            path.write_bytes(data[:-20])
            return "cloud.vdb, byte"
        case "foreign":
            path.write_bytes(b"hello, this is text")
            return "neither an OpenVDB nor a NanoVDB file"
        case "empty":
            return "is empty: no voxel is active"
        case "vector":
            return "holds vectors (vec3s), expected numbers"
        case "not finite":
            return "values is a finite number"
        case "level set":
            return "is a level set"
    vdb_file.write(path, ("smoke", CLOUD))
    return "there is no grid 'density'; it has smoke"


@pytest.mark.parametrize("kind", ["missing", "truncated", "foreign", "empty", "vector", "not finite", "level set", "another name"])
def test_broken_files_are_told_once_and_the_rest_is_there(tmp_path, kind):
    expected = broken_file(tmp_path, kind)
    text = SMOKE + volume(fields="density") + 'def Sphere "Ball" {}\n' + volume("Other", fields="density", bound=False)
    scene, told = load(tmp_path, text, file=False)
    assert [instances["origin"]["name"] for instances in scene["instances"]] == ["/Ball"]
    found = [message for message in told if expected in message]
    assert len(found) == 2 and all("cloud.vdb" in message for message in found), told


def test_voxels_that_are_no_numbers_are_empty(tmp_path):
    """The rest of the cloud is there, and the numbers are told when it is laid out."""
    spoilt = CLOUD.copy()
    spoilt[1, 1, 1], spoilt[0, 1, 2] = np.nan, np.inf
    vdb_file.write(tmp_path / "cloud.vdb", ("density", spoilt))
    scene, told = load(tmp_path, SMOKE + volume(fields="density"), file=False)
    assert not told and at_voxel(scene["fields"][0], (1, 1, 1)) == 0.0
    assert at_voxel(scene["fields"][0], (1, 1, 2)) == pytest.approx(CLOUD[1, 1, 2])
    shown = gonio.load_usd(str(tmp_path / "stage.usda"), camera_light=False)
    shown.set(width=4, height=4, samples=1)
    with gonio.Render(shown) as render:
        assert render.wait() and np.isfinite(np.asarray(render.film()["color"])).all()
        assert any("2 of its values are no finite numbers" in message for _, message in render.diagnostics)


def test_what_is_no_field_is_told(tmp_path):
    text = 'def Volume "V" { rel field:density = </V/f>\n def Field3DAsset "f" { asset filePath = @a.f3d@\n }\n}\ndef Volume "W" {}\n'
    text += 'def Volume "Lost" { rel field:density = </Nowhere>\n }\n'
    scene, told = load(tmp_path, text)
    assert any("'Field3DAsset' is not supported" in message for message in told), told
    assert any("the volume has no field" in message for message in told), told
    assert any("</Nowhere>, which does not exist" in message for message in told), told


SQUARED = shader("P", "ND_power_float", in1="D", in2=("float", "2"))


def test_coefficients_follow_a_field_by_a_curve(tmp_path):
    """What absorbs by the square of the density: one lattice, and coefficients of its densest place."""
    curve = material(shader("S", "ND_absorption_vdf", absorption="A"), times("A", "P", "(1, 2, 3)"), SQUARED, field("D", "density"))
    scene, told = load(tmp_path, curve + volume())
    (described,), found = scene["fields"], medium(scene)
    assert not told and not described.get("taken") and found["scattering"] == [0.0] * 3
    for place in ((1, 1, 1), (5, 4, 3), (2, 0, 3)):
        absorption = np.array(found["absorption"]) * at_voxel(described, place)
        assert absorption == pytest.approx(10 * np.array([1, 2, 3]) * CLOUD[place] ** 2, rel=1e-3, abs=1e-3)


def test_colours_vary_where_curves_differ(tmp_path):
    """Absorption by the square of the density, scattering by itself: colours of extinction and scattering by voxel."""
    curve = material(
        shader("S", "ND_volume", vdf="V"), shader("V", "ND_anisotropic_vdf", absorption="A", scattering="B"),
        times("A", "P", "(1, 2, 3)"), SQUARED, times("B", "D", "(4, 0, 2)"), field("D", "density"),
    )  # fmt: skip
    scene, told = load(tmp_path, curve + volume())
    (described,), found = scene["fields"], medium(scene)
    assert not told and found["absorption"] == [0.0] * 3 and len(set(found["scattering"])) == 1
    for place in ((1, 1, 1), (5, 4, 3), (2, 0, 3)):
        value = CLOUD[place]
        scattering = 10 * np.array([4, 0, 2]) * value
        extinction = scattering + 10 * np.array([1, 2, 3]) * value**2
        numbers = [found["scattering"][0] * at_voxel({"part": lattice}, place, "part") for lattice in described["taken"]]
        assert numbers == pytest.approx([*extinction, *scattering], rel=1e-3, abs=1e-3)
        assert found["scattering"][0] * at_voxel(described, place) == pytest.approx(max(extinction), rel=1e-3, abs=1e-3)


def test_coefficients_that_begin_above_nothing_are_told(tmp_path):
    less = shader("P", "ND_subtract_float", in1=("float", "2"), in2="D")
    curve = material(shader("S", "ND_absorption_vdf", absorption="A"), times("A", "P", "(1, 1, 1)"), less, field("D", "density"))
    scene, told = load(tmp_path, curve + volume())
    assert any("above 0 where the field 'density' is 0" in message for message in told), told
    value = medium(scene)["absorption"][0] * at_voxel(scene["fields"][0], (1, 1, 1))
    assert value == pytest.approx(10 * max(2.0 - CLOUD[1, 1, 1], 0.0), rel=1e-3)


def test_what_no_field_can_do_is_told(tmp_path):
    several = material(
        shader("S", "ND_absorption_vdf", absorption="A"), times("A", "B", "(1, 1, 1)"), shader("B", "ND_multiply_float", in1="D", in2="H"),
        field("D", "density"), field("H", "heat"),
    )  # fmt: skip
    scene, told = load(tmp_path, several + volume() + 'def Sphere "Ball" {}\n')
    assert [instances["origin"]["name"] for instances in scene["instances"]] == ["/Ball"]
    assert any("several fields at once (density, heat)" in message for message in told), told
    _, told = load(tmp_path, material(shader("S", "ND_absorption_vdf", absorption="A"), times("A", "D", "(1, 1, 1)"), field("D", "wool")) + volume())
    assert any("asks for 'wool', which is no field of the volume" in message for message in told), told
    # A mesh has no fields.
    ball = 'def Sphere "Ball" (prepend apiSchemas = ["MaterialBindingAPI"]) { rel material:binding = </M>\n }\n'
    _, told = load(tmp_path, SMOKE + ball)
    assert any("a volume that varies from place to place" in message for message in told), told


def test_constant_primvars_count(tmp_path):
    scaled = material(
        shader("S", "ND_absorption_vdf", absorption="A"), times("A", "B", "(1, 1, 1)"), shader("B", "ND_multiply_float", in1="D", in2="K"),
        field("D", "density"), field("K", "strength"),
    )  # fmt: skip
    body = 'float primvars:strength = 4 (interpolation = "constant")'
    scene, told = load(tmp_path, scaled + volume(body=body))
    assert medium(scene)["absorption"] == pytest.approx([40] * 3) and not told


VIEW = """def Camera "C" {
    token projection = "orthographic"
    float horizontalAperture = 0.01
    float verticalAperture = 0.01
    float2 clippingRange = (0.01, 1000)
    double3 xformOp:translate = (3.5, 3.5, 20)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


@pytest.mark.parametrize("fire", [False, True])
def test_pictures_show_what_the_grid_says(tmp_path, fire):
    """Down the middle of a grid of 8³ voxels of 1: e to the power of minus eight times the coefficient; its glow by the square of the heat, 3 at
    most, by the midpoint rule in small steps."""
    vdb_file.write(tmp_path / "cloud.vdb", ("density", np.ones((8, 8, 8))), ("heat", np.full((8, 8, 8), 3.0)))
    shining = [shader("E", "ND_uniform_edf", color="P"), shader("P", "ND_power_vector3FA", in1="H", in2=("float", "2")),
               shader("H", "ND_geompropvalue_vector3", geomprop=("string", '"heat"'))]  # fmt: skip
    volume_shader = shader("S", "ND_volume", vdf="V", edf="E") if fire else shader("S", "ND_volume", vdf="V")
    look = material(volume_shader, shader("V", "ND_absorption_vdf", absorption="A"), times("A", "D", "(0.05, 0.1, 0.2)"), field("D", "density"),
                    *(shining if fire else []))  # fmt: skip
    sky = "" if fire else 'def DomeLight "Sky" { float inputs:intensity = 1\n}\n'
    (tmp_path / "stage.usda").write_text(HEADER + look + volume() + VIEW + sky)
    scene = gonio.load_usd(str(tmp_path / "stage.usda"), camera_light=False)
    scene.set(width=16, height=16, samples=64, filter="box", passes=["color"], caustics="off")
    pixels = np.asarray(finished(scene)["color"])[..., :3].reshape(-1, 3).astype(np.float64)
    found, error = pixels.mean(0), pixels.std(0) / 16
    coefficients = np.array([0.05, 0.1, 0.2])
    expected = np.exp(-8 * coefficients)
    if fire:
        along = (np.arange(90000) + 0.5) / 10000 - 1
        filled = np.clip(np.minimum(along + 1, 8 - along), 0, 1)
        depth = np.cumsum(filled) / 10000
        expected = ((3 * filled[:, None]) ** 2 * np.exp(-depth[:, None] * coefficients)).sum(0) / 10000
    assert (np.abs(found - expected) < 4.5 * error + 0.002 * expected).all(), (found, error, expected)
    assert (error < 0.02 * expected).all()
