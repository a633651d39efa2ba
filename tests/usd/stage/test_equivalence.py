"""Stages that say the same in different ways make the same picture."""

import numpy as np
import pictures
import pytest

# Blocks of 8 by 8 pixels with 64 samples each differ by less than this from one seed to the next; a wrong place or strength by far more.
NOISE = 0.02


@pytest.fixture
def picture(run, tmp_path):
    def render(stage, *options, name=None, spp=64):
        path = tmp_path / f"{stage.stem}_{stage.suffix[1:]}_{name}.exr"
        done = run("render", stage, "-o", path, "--res", 48, 48, "--spp", spp, "--aov", "color,illuminance,P", *options)
        assert done.returncode == 0 and "warning" not in done.stderr, done.stderr
        return pictures.read(path)

    return render


def identical(first, second):
    for name in first.channels:
        assert np.array_equal(first[name], second[name], equal_nan=True), name


def alike(first, second, limit=NOISE):
    assert pictures.difference(first, second) < limit
    assert first["Illuminance"].mean() == pytest.approx(second["Illuminance"].mean(), rel=limit)


# Ways of storing.


def test_text_crate_and_package(picture, tmp_path):
    from pxr import Usd, UsdUtils

    text = pictures.room(tmp_path / "room.usda")
    Usd.Stage.Open(str(text)).Export(str(tmp_path / "room.usdc"))
    Usd.Stage.Open(str(text)).Export(str(tmp_path / "room.usd"))
    assert UsdUtils.CreateNewUsdzPackage(str(tmp_path / "room.usdc"), str(tmp_path / "room.usdz"))
    expected = picture(text, spp=4)
    for ending in ("usdc", "usd", "usdz"):
        identical(expected, picture(tmp_path / f"room.{ending}", spp=4))


def test_flattened_layers_and_references(picture, tmp_path):
    from pxr import Usd

    (tmp_path / "things.usda").write_text(pictures.HEADER.format(metres=1, up="Y") + 'def Xform "World"\n{\n' + pictures.ROOM.replace("</Looks", "</World/Looks") + "}\n")
    (tmp_path / "light.usda").write_text(pictures.HEADER.format(metres=1, up="Y") + pictures.LAMP)
    composed = tmp_path / "composed.usda"
    header = pictures.HEADER.format(metres=1, up="Y").replace("(\n", "(\n    subLayers = [@light.usda@]\n", 1)
    composed.write_text(header + 'def "Place" (prepend references = @things.usda@</World>) {}\n' + pictures.camera())
    Usd.Stage.Open(str(composed)).Flatten().Export(str(tmp_path / "flat.usda"))
    first, second = picture(composed, spp=4), picture(tmp_path / "flat.usda", spp=4)
    identical(first, second)
    alike(first, picture(pictures.room(tmp_path / "room.usda")), 0.1)


# Instances.

PLACES = [(-1.5, 0.3, 0.5, 30), (0, 0.5, 0, 0), (1.4, 0.4, -0.6, -50), (0.6, 0.3, 1.2, 75)]
TOY = """
{specifier} Xform "{name}" {metadata}
{{
{placed}
    def Cube "Body" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        double size = 0.6
        rel material:binding = </Looks/Red>
    }}
    def Sphere "Head" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        double radius = 0.25
        rel material:binding = </Looks/Grey>
        double3 xformOp:translate = (0, 0.5, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
}}
"""
AT = """    double3 xformOp:translate = ({0}, {1}, {2})
    double xformOp:rotateY = {3}
    double3 xformOp:scale = (1, 1, 1)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateY", "xformOp:scale"]"""


def without_things(text=pictures.ROOM):
    """The room's floor and materials alone."""
    return text[: text.index('def Cube "Box"')] + text[text.index('def Scope "Looks"') :]


def explicit(path):
    toys = "".join(TOY.format(specifier="def", name=f"Toy{k}", metadata="", placed=AT.format(*place)) for k, place in enumerate(PLACES))
    return pictures.stage(path, without_things(), pictures.LAMP, pictures.camera(), toys)


def referring(path, instanceable):
    toy = TOY.format(specifier="class", name="Toy", metadata="", placed="")
    metadata = f"(prepend references = </Toy>\n    instanceable = {'true' if instanceable else 'false'})"
    places = "".join(f'def Xform "Toy{k}" {metadata}\n{{\n{AT.format(*place)}\n}}\n' for k, place in enumerate(PLACES))
    return pictures.stage(path, without_things(), pictures.LAMP, pictures.camera(), toy, places)


def scattered(path, nested=False):
    from pxr import Gf

    turns = [Gf.Rotation(Gf.Vec3d(0, 1, 0), place[3]).GetQuat() for place in PLACES]
    written = ", ".join(f"({q.GetReal():.6f}, {q.GetImaginary()[0]:.6f}, {q.GetImaginary()[1]:.6f}, {q.GetImaginary()[2]:.6f})" for q in turns)
    positions = ", ".join(f"({x}, {y}, {z})" for x, y, z, _ in PLACES)
    toy = TOY.format(specifier="def", name="Toy", metadata="", placed="")
    instancer = f"""
def PointInstancer "Toys"
{{
    int[] protoIndices = [0, 0, 0, 0]
    point3f[] positions = [{positions}]
    quath[] orientations = [{written}]
    rel prototypes = </Toys/Toy>
{toy}
}}
"""
    return pictures.stage(path, without_things(), pictures.LAMP, pictures.camera(), instancer)


def test_references_instances_and_copies(picture, tmp_path):
    copies = picture(explicit(tmp_path / "copies.usda"))
    references = picture(referring(tmp_path / "references.usda", False))
    instances = picture(referring(tmp_path / "instances.usda", True))
    alike(copies, references)
    alike(copies, instances)


def test_point_instancer_and_copies(picture, tmp_path):
    alike(picture(explicit(tmp_path / "copies.usda")), picture(scattered(tmp_path / "scattered.usda")), 0.03)


def test_hidden_instances_are_those_left_out(picture, tmp_path):
    shown = scattered(tmp_path / "shown.usda")
    text = shown.read_text()
    hidden = tmp_path / "hidden.usda"
    hidden.write_text(text.replace("int[] protoIndices", "int64[] ids = [10, 11, 12, 13]\n    int64[] invisibleIds = [11, 13]\n    int[] protoIndices"))
    fewer = pictures.stage(
        tmp_path / "fewer.usda", without_things(), pictures.LAMP, pictures.camera(),
        *(TOY.format(specifier="def", name=f"Toy{k}", metadata="", placed=AT.format(*PLACES[k])) for k in (0, 2)),
    )  # fmt: skip
    alike(picture(hidden), picture(fewer), 0.03)
    assert pictures.difference(picture(shown, name="all"), picture(fewer, name="some")) > 0.05


# Axes and units.


def test_z_up_is_y_up_turned(picture, tmp_path):
    upright = picture(pictures.room(tmp_path / "y.usda"))
    turn = "    double xformOp:rotateX = 90\n    uniform token[] xformOpOrder = [\"xformOp:rotateX\"]\n"
    inner = (pictures.ROOM + pictures.LAMP + pictures.camera()).replace("</Looks", "</World/Looks")
    turned = pictures.stage(tmp_path / "z.usda", 'def Xform "World"\n{\n' + turn + inner + "}\n", up="Z")
    lying = picture(turned)
    alike(upright, lying)
    # Passes keep the stage's own axes.
    seen = upright["A"] == 1
    assert np.abs(lying["P.Z"][seen] - upright["P.Y"][seen]).mean() < 0.05


def test_a_camera_of_our_own_stands_upright_in_both(picture, tmp_path):
    plain = pictures.stage(tmp_path / "y.usda", pictures.ROOM, pictures.LAMP)
    inner = (pictures.ROOM + pictures.LAMP).replace("</Looks", "</World/Looks")
    turn = "    double xformOp:rotateX = 90\n    uniform token[] xformOpOrder = [\"xformOp:rotateX\"]\n"
    turned = pictures.stage(tmp_path / "z.usda", 'def Xform "World"\n{\n' + turn + inner + "}\n", up="Z")
    alike(picture(plain), picture(turned))


def test_centimetres_and_metres(picture, tmp_path):
    metres = picture(pictures.room(tmp_path / "m.usda"))
    inner = (pictures.ROOM + pictures.LAMP + pictures.camera()).replace("</Looks", "</World/Looks")
    # A hundred units to the metre, all scaled up; lights keep their luminance with normalize off. Apertures are ratios to the focal length.
    grow = "    double3 xformOp:scale = (100, 100, 100)\n    uniform token[] xformOpOrder = [\"xformOp:scale\"]\n"
    centimetres = picture(pictures.stage(tmp_path / "cm.usda", 'def Xform "World"\n{\n' + grow + inner + "}\n", metres=0.01))
    alike(metres, centimetres)
    seen = metres["A"] == 1
    assert np.abs(metres["P.X"][seen] - centimetres["P.X"][seen]).mean() < 0.05, "P is in metres"


def test_normalized_lights_divide_by_square_stage_units(picture, tmp_path):
    def with_lamp(path, intensity, metres):
        scale = 1 / metres
        inner = (pictures.ROOM + pictures.LAMP.replace("400", f"{intensity}\n    bool inputs:normalize = 1") + pictures.camera()).replace("</Looks", "</World/Looks")
        grow = f"    double3 xformOp:scale = ({scale}, {scale}, {scale})\n    uniform token[] xformOpOrder = [\"xformOp:scale\"]\n"
        return pictures.stage(path, 'def Xform "World"\n{\n' + grow + inner + "}\n", metres=metres)

    metres = picture(with_lamp(tmp_path / "m.usda", 200, 1))
    alike(metres, picture(with_lamp(tmp_path / "cm.usda", 200e4, 0.01)))


def test_left_handed_faces_and_mirrored_places(picture, tmp_path):
    plain = picture(pictures.room(tmp_path / "plain.usda"))
    left = pictures.ROOM.replace("[0, 1, 2, 3]", "[3, 2, 1, 0]").replace('uniform token subdivisionScheme = "none"', 'uniform token subdivisionScheme = "none"\n    uniform token orientation = "leftHanded"')
    alike(plain, picture(pictures.stage(tmp_path / "left.usda", left, pictures.LAMP, pictures.camera())))
    mirrored = pictures.ROOM.replace('uniform token subdivisionScheme = "none"', 'uniform token subdivisionScheme = "none"\n    double3 xformOp:scale = (-1, 1, 1)\n    uniform token[] xformOpOrder = ["xformOp:scale"]')
    alike(plain, picture(pictures.stage(tmp_path / "mirrored.usda", mirrored, pictures.LAMP, pictures.camera())))


# Meshes.

BOARD = """
def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    int[] faceVertexCounts = {counts}
    int[] faceVertexIndices = {indices}
    point3f[] points = [(-2, 0, 2), (0, 0, 2), (2, 0, 2), (-2, 0, -2), (0, 0, -2), (2, 0, -2)]
    uniform token subdivisionScheme = "none"
    rel material:binding = {binding}
{more}
}}
"""
SUBSET = """
    def GeomSubset "Right" (prepend apiSchemas = ["MaterialBindingAPI"])
    {
        uniform token elementType = "face"
        uniform token familyName = "materialBind"
        int[] indices = [1]
        rel material:binding = </Looks/Red>
    }
"""


def test_subsets_and_split_meshes(picture, tmp_path):
    looks = pictures.ROOM[pictures.ROOM.index('def Scope "Looks"') :]
    whole = BOARD.format(name="Board", counts="[4, 4]", indices="[0, 1, 4, 3, 1, 2, 5, 4]", binding="</Looks/Grey>", more=SUBSET)
    left = BOARD.format(name="Left", counts="[4]", indices="[0, 1, 4, 3]", binding="</Looks/Grey>", more="")
    right = BOARD.format(name="Right", counts="[4]", indices="[1, 2, 5, 4]", binding="</Looks/Red>", more="")
    one = picture(pictures.stage(tmp_path / "one.usda", looks, whole, pictures.LAMP, pictures.camera()))
    two = picture(pictures.stage(tmp_path / "two.usda", looks, left, right, pictures.LAMP, pictures.camera()))
    alike(one, two)
    halves = one.rgb[24:, :16].mean(axis=(0, 1)), one.rgb[24:, 32:].mean(axis=(0, 1))
    assert halves[0][1] / halves[0][0] > 0.8 and halves[1][1] / halves[1][0] < 0.4


def test_quads_and_triangles(picture, tmp_path):
    looks = pictures.ROOM[pictures.ROOM.index('def Scope "Looks"') :]
    quads = BOARD.format(name="Board", counts="[4, 4]", indices="[0, 1, 4, 3, 1, 2, 5, 4]", binding="</Looks/Red>", more="")
    triangles = BOARD.format(name="Board", counts="[3, 3, 3, 3]", indices="[0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4]", binding="</Looks/Red>", more="")
    first = picture(pictures.stage(tmp_path / "quads.usda", looks, quads, pictures.LAMP, pictures.camera()))
    alike(first, picture(pictures.stage(tmp_path / "triangles.usda", looks, triangles, pictures.LAMP, pictures.camera())))


def test_a_cube_prim_and_its_mesh(picture, tmp_path):
    cube = """def Mesh "Box" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]
    point3f[] points = [(-.5, -.5, -.5), (-.5, -.5, .5), (-.5, .5, -.5), (-.5, .5, .5), (.5, -.5, -.5), (.5, -.5, .5), (.5, .5, -.5), (.5, .5, .5)]
    uniform token subdivisionScheme = "none"
"""
    plain = picture(pictures.room(tmp_path / "prim.usda"))
    text = pictures.ROOM.replace('def Cube "Box" (prepend apiSchemas = ["MaterialBindingAPI"])\n{\n    double size = 1\n', cube)
    assert text != pictures.ROOM
    alike(plain, picture(pictures.stage(tmp_path / "mesh.usda", text, pictures.LAMP, pictures.camera())))


def test_old_and_new_names_of_light_inputs(picture, tmp_path):
    old = pictures.LAMP.replace("inputs:", "")
    identical(
        picture(pictures.room(tmp_path / "new.usda"), spp=4),
        picture(pictures.stage(tmp_path / "old.usda", pictures.ROOM, old, pictures.camera()), spp=4),
    )


def test_exposure_of_a_light_is_two_to_its_power(picture, tmp_path):
    stops = pictures.LAMP.replace("400", "100\n    float inputs:exposure = 2")
    identical(
        picture(pictures.room(tmp_path / "plain.usda"), spp=4),
        picture(pictures.stage(tmp_path / "stops.usda", pictures.ROOM, stops, pictures.camera()), spp=4),
    )
