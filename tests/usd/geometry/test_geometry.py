"""UsdGeom surfaces: meshes, primvars, subsets, subdivision, quadrics, transforms, visibility, purpose, skinning."""

import math

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

QUAD = """
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
"""
PLAIN = QUAD + '    uniform token subdivisionScheme = "none"\n'


def read(tmp_path, text, metres=1, **options):
    path = tmp_path / "stage.usda"
    path.write_text(f'#usda 1.0\n(\n    metersPerUnit = {metres}\n    upAxis = "Y"\n)\n{text}')
    return gonio.load_usd(str(path), **options)


def load(tmp_path, text, **options):
    return read(tmp_path, text, **options).to_dict()


def mesh(tmp_path, body, **options):
    (only,) = load(tmp_path, f'def Mesh "M"\n{{\n{body}\n}}\n', **options)["meshes"]
    return only


def primvar(mesh, name):
    (found,) = [primvar for primvar in mesh["primvars"] if primvar["name"] == name]
    return found


def values(primvar):
    """The elements in the order of places."""
    components = primvar["components"]
    elements = [primvar["values"][i : i + components] for i in range(0, len(primvar["values"]), components)]
    return elements if primvar["indices"] is None else [elements[i] for i in primvar["indices"]]


def corners(mesh):
    return [corner for triangle in mesh["triangles"] for corner in triangle]


def extent(mesh):
    return [(min(p[i] for p in mesh["points"]), max(p[i] for p in mesh["points"])) for i in range(3)]


def test_a_quad_becomes_two_triangles_that_know_their_face(tmp_path):
    m = mesh(tmp_path, PLAIN)
    assert m["triangles"] == [[0, 1, 2], [0, 2, 3]]
    assert m["faces"] == [0, 0]
    assert m["normals"] is None
    assert m["origin"]["name"] == "/M"


@pytest.mark.parametrize("kind", ["point3f[]", "point3d[]", "point3h[]", "float3[]"])
def test_points_of_any_precision(tmp_path, kind):
    assert mesh(tmp_path, PLAIN.replace("point3f[]", kind))["points"][2] == [1, 1, 0]


def test_left_handed_faces_are_turned(tmp_path):
    m = mesh(tmp_path, PLAIN + 'uniform token orientation = "leftHanded"')
    assert m["triangles"][0] in ([0, 2, 1], [2, 1, 0], [1, 0, 2])


def test_holes_have_no_surface(tmp_path):
    body = """
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0), (2, 1, 0)]
    int[] faceVertexCounts = [4, 4]
    int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, 5, 2]
    uniform token subdivisionScheme = "none"
    int[] holeIndices = [0]
    """
    assert mesh(tmp_path, body)["faces"] == [1, 1]


def test_unauthored_scheme_is_catmull_clark_on_the_limit_surface(tmp_path):
    # Level 2 of one quad is a grid of 4 × 4 faces.
    m = mesh(tmp_path, QUAD)
    assert len(m["triangles"]) == 32
    assert set(m["faces"]) == {0}
    assert m["normals"]["interpolation"] in ("FaceVarying", "Vertex")
    assert len(mesh(tmp_path, QUAD, complexity="medium")["triangles"]) == 8
    assert len(mesh(tmp_path, QUAD, complexity="veryhigh")["triangles"]) == 128


def test_low_complexity_leaves_the_control_mesh_with_smooth_normals(tmp_path):
    m = mesh(tmp_path, QUAD, complexity="low")
    assert len(m["triangles"]) == 2
    assert values(m["normals"])[0] == pytest.approx([0, 0, 1])


def test_normals_are_ignored_on_subdivision_surfaces(tmp_path):
    wrong = "normal3f[] normals = [(1, 0, 0), (1, 0, 0), (1, 0, 0), (1, 0, 0)]"
    assert values(mesh(tmp_path, QUAD + wrong)["normals"])[0] == pytest.approx([0, 0, 1], abs=1e-6)
    assert values(mesh(tmp_path, PLAIN + wrong)["normals"])[0] == [1, 0, 0]


def test_primvars_normals_goes_before_normals(tmp_path):
    body = """
    normal3f[] normals = [(1, 0, 0), (1, 0, 0), (1, 0, 0), (1, 0, 0)]
    normal3f[] primvars:normals = [(0, 1, 0)] ( interpolation = "faceVarying" )
    int[] primvars:normals:indices = [0, 0, 0, 0]
    """
    m = mesh(tmp_path, PLAIN + body)
    assert m["normals"]["interpolation"] == "FaceVarying"
    assert all(normal == [0, 1, 0] for normal in values(m["normals"]))


INTERPOLATIONS = [
    ("constant", "[7]", "Constant", [7]),
    ("uniform", "[7]", "Uniform", [7, 7]),
    ("varying", "[1, 2, 3, 4]", "Vertex", [1, 2, 3, 4]),
    ("vertex", "[1, 2, 3, 4]", "Vertex", [1, 2, 3, 4]),
    ("faceVarying", "[1, 2, 3, 4]", "FaceVarying", [1, 2, 3, 1, 3, 4]),
]


@pytest.mark.parametrize(("interpolation", "authored", "expected", "places"), INTERPOLATIONS)
@pytest.mark.parametrize("kind", ["float[]", "double[]", "half[]", "int[]"])
def test_interpolations_and_types(tmp_path, interpolation, authored, expected, places, kind):
    m = mesh(tmp_path, PLAIN + f'{kind} primvars:a = {authored} ( interpolation = "{interpolation}" )')
    found = primvar(m, "a")
    assert found["interpolation"] == expected
    assert [value for (value,) in values(found)] == places


def test_indexed_primvars(tmp_path):
    body = """
    texCoord2f[] primvars:st = [(0, 0), (0.5, 1)] ( interpolation = "faceVarying" )
    int[] primvars:st:indices = [0, 1, 1, 0]
    """
    assert values(primvar(mesh(tmp_path, PLAIN + body), "st")) == [[0, 0], [0.5, 1], [0.5, 1], [0, 0], [0.5, 1], [0, 0]]


def test_scalars_vectors_and_strings(tmp_path):
    body = 'float3 primvars:v = (1, 2, 3)\nfloat primvars:f = 4\nstring primvars:s = "x"\ntoken[] primvars:t = ["x"]'
    m = mesh(tmp_path, PLAIN + body)
    assert primvar(m, "v")["values"] == [1, 2, 3]
    assert primvar(m, "f")["values"] == [4]
    assert {p["name"] for p in m["primvars"]} == {"v", "f"}


def test_constant_primvars_come_from_above_unless_the_mesh_has_them(tmp_path):
    text = f"""
def Xform "A"
{{
    color3f[] primvars:displayColor = [(1, 0, 0)] ( interpolation = "constant" )
    float primvars:other = 3
    def Mesh "own"
    {{
        color3f[] primvars:displayColor = [(0, 1, 0)]
{PLAIN}
    }}
    def Mesh "heir"
    {{
{PLAIN}
    }}
}}
"""
    sets = {s["origin"]["name"]: {p["name"]: p["values"] for p in s["primvars"]} for s in load(tmp_path, text)["instances"]}
    assert sets["/A/own"] == {"other": [3]}
    assert sets["/A/heir"] == {"displayColor": [1, 0, 0], "other": [3]}


def test_a_primvar_of_wrong_length_is_dropped_and_reported(tmp_path):
    scene = read(tmp_path, f'def Mesh "M"\n{{\n{PLAIN}\nfloat[] primvars:a = [1, 2] ( interpolation = "vertex" )\n}}')
    (m,) = scene.to_dict()["meshes"]
    assert m["primvars"] == []
    assert any(origin == "/M" and "'a' has 2 elements, expected 4" in message for origin, message in scene.diagnostics)


SUBSETS = """
def Mesh "M"
{
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0), (2, 1, 0)]
    int[] faceVertexCounts = [4, 4]
    int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, 5, 2]
    uniform token subdivisionScheme = "none"
    def GeomSubset "a" ( prepend apiSchemas = ["MaterialBindingAPI"] )
    {
        uniform token elementType = "face"
        uniform token familyName = "materialBind"
        int[] indices = [1]
        rel material:binding = </red>
    }
    def GeomSubset "unrelated"
    {
        uniform token familyName = "selection"
        int[] indices = [0]
    }
}
def Material "red"
{
    token outputs:surface.connect = </red/s.outputs:surface>
    def Shader "s"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (1, 0, 0)
        token outputs:surface
    }
}
"""


def test_subsets_choose_materials_by_face(tmp_path):
    scene = load(tmp_path, SUBSETS)
    (m,) = scene["meshes"]
    assert m["slots"] == [0, 0, 1, 1]
    (placed,) = scene["instances"]
    assert scene["materials"][placed["materials"][1]]["origin"]["name"] == "/red"
    assert scene["materials"][placed["materials"][0]]["origin"]["name"] != "/red"


def test_subdivided_faces_keep_their_subset(tmp_path):
    (m,) = load(tmp_path, SUBSETS.replace('"none"', '"bilinear"'), complexity="medium")["meshes"]
    assert m["slots"] == [face for face in m["faces"]]


QUADRICS = [
    ("Sphere", "double radius = 3", [(-3, 3)] * 3),
    ("Sphere", "", [(-1, 1)] * 3),
    ("Cube", "double size = 4", [(-2, 2)] * 3),
    ("Cube", "", [(-1, 1)] * 3),
    ("Cylinder", 'token axis = "X"\ndouble height = 6\ndouble radius = 2', [(-3, 3), (-2, 2), (-2, 2)]),
    ("Cylinder", "", [(-1, 1)] * 3),
    ("Cylinder_1", "double radiusTop = 0.5\ndouble radiusBottom = 2", [(-2, 2), (-2, 2), (-1, 1)]),
    ("Cone", 'token axis = "Y"', [(-1, 1)] * 3),
    ("Capsule", "", [(-0.5, 0.5), (-0.5, 0.5), (-1, 1)]),
    ("Capsule_1", "double radiusTop = 0.5\ndouble radiusBottom = 0.5\ndouble height = 3", [(-0.5, 0.5), (-0.5, 0.5), (-2, 2)]),
    ("Plane", 'token axis = "Y"\ndouble width = 4\ndouble length = 6', [(-2, 2), (0, 0), (-3, 3)]),
]


@pytest.mark.parametrize(("kind", "body", "expected"), QUADRICS)
def test_quadrics_have_their_extent_and_face_outward(tmp_path, kind, body, expected):
    from pxr import UsdGeom

    if not hasattr(UsdGeom, kind):
        pytest.skip(f"this version of pxr has no {kind}")
    (m,) = load(tmp_path, f'def {kind} "Q"\n{{\n{body}\n}}\n')["meshes"]
    for found, limits in zip(extent(m), expected):
        assert found == pytest.approx(limits, rel=0.01, abs=1e-6)
    if kind != "Plane":
        assert signed_volume(m) > 0


def signed_volume(mesh):
    total = 0
    for a, b, c in mesh["triangles"]:
        (ax, ay, az), (bx, by, bz), (cx, cy, cz) = (mesh["points"][i] for i in (a, b, c))
        total += ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)
    return total / 6


def test_equal_quadrics_share_a_mesh(tmp_path):
    text = "".join(f'def Sphere "s{i}"\n{{\ndouble3 xformOp:translate = ({i}, 0, 0)\nuniform token[] xformOpOrder = ["xformOp:translate"]\n}}\n' for i in range(5))
    scene = load(tmp_path, text)
    assert len(scene["meshes"]) == 1
    assert sorted(t["columns"][3][0] for t in scene["instances"][0]["transforms"]) == [0, 1, 2, 3, 4]


TRANSFORMS = """
def Xform "A"
{
    double3 xformOp:translate = (1, 2, 3)
    float xformOp:rotateZ = 90
    float3 xformOp:scale = (2, 2, 2)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ", "xformOp:scale"]
    def Cube "in" {}
    def Cube "reset"
    {
        double3 xformOp:translate = (9, 0, 0)
        uniform token[] xformOpOrder = ["!resetXformStack!", "xformOp:translate"]
    }
}
"""


@pytest.mark.parametrize("metres", [1, 0.01])
def test_transforms_are_in_metres(tmp_path, metres):
    (placed,) = load(tmp_path, TRANSFORMS, metres=metres)["instances"]
    inside, reset = (t["columns"] for t in placed["transforms"]) if placed["transforms"][0]["columns"][3][1] else (t["columns"] for t in reversed(placed["transforms"]))
    assert inside[0] == pytest.approx([0, 2 * metres, 0], abs=1e-12)
    assert inside[3] == pytest.approx([metres, 2 * metres, 3 * metres])
    assert reset[3] == pytest.approx([9 * metres, 0, 0])
    assert reset[0] == pytest.approx([metres, 0, 0])


def test_times(tmp_path):
    text = 'def Cube "c"\n{\ndouble3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 11: (10, 0, 0) }\nuniform token[] xformOpOrder = ["xformOp:translate"]\ntoken visibility.timeSamples = { 1: "inherited", 8: "invisible" }\n}\n'
    at = lambda frame: [t["columns"][3][0] for s in load(tmp_path, text, frame=frame)["instances"] for t in s["transforms"]]
    assert at(1) == [0]
    assert at(6) == pytest.approx([5])
    assert at(9) == []
    assert at(None) == [0]


def names(scene):
    return {s["origin"]["name"] for s in scene["instances"]}


PURPOSES = """
def Xform "hidden"
{
    token visibility = "invisible"
    def Cube "c"
    {
        token visibility = "inherited"
    }
}
def Xform "proxy"
{
    uniform token purpose = "proxy"
    def Cone "c" {}
    def Sphere "r"
    {
        uniform token purpose = "render"
    }
}
def Cylinder "guide"
{
    uniform token purpose = "guide"
}
def Plane "shown" {}
"""


def test_visibility_and_purpose(tmp_path):
    assert names(load(tmp_path, PURPOSES)) == {"/proxy/r", "/shown"}
    assert names(load(tmp_path, PURPOSES, purposes=["default", "proxy"])) == {"/proxy/c", "/shown"}
    assert names(load(tmp_path, PURPOSES, purposes=["guide"])) == {"/guide", "/shown"}


def test_element_sizes_that_count_values_are_not_believed(tmp_path):
    # As some exporters write it to texture coordinates and normals.
    uv = "float2[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] ( interpolation = \"faceVarying\"\nelementSize = 4 )"
    found = primvar(mesh(tmp_path, PLAIN + "    " + uv), "st")
    assert found["components"] == 2 and sorted(map(tuple, values(found)))[0] == (0, 0) and len(set(map(tuple, values(found)))) == 4
    triples = "float[] primvars:f = [1, 2, 3] ( interpolation = \"constant\"\nelementSize = 3 )"
    assert primvar(mesh(tmp_path, PLAIN + "    " + triples), "f")["components"] == 3


def test_inactive_abstract_and_undefined_prims_are_not_shown(tmp_path):
    text = 'def Cube "off" ( active = false ) {}\nclass Cone "pattern" {}\nover "o"\n{\ndef Sphere "s" {}\n}\ndef Plane "on" {}\n'
    assert names(load(tmp_path, text)) == {"/on"}


def test_unsupported_types_are_named_once(tmp_path):
    scene = read(tmp_path, 'def ParticleField3DGaussianSplat "a" {}\ndef ParticleField3DGaussianSplat "b" {}\n')
    messages = [message for _, message in scene.diagnostics]
    assert sum("GaussianSplat is not supported" in message and "2 places" in message for message in messages) == 1


def skinned(path):
    """An arm of two joints, whose upper one turns by 90° about z from time 1 to 10."""
    from pxr import Gf, Usd, UsdGeom, UsdSkel, Vt

    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    stage.SetStartTimeCode(1)
    root = UsdSkel.Root.Define(stage, "/R")
    skeleton = UsdSkel.Skeleton.Define(stage, "/R/Skeleton")
    skeleton.CreateJointsAttr(["a", "a/b"])
    pose = [Gf.Matrix4d(1), Gf.Matrix4d(1).SetTranslate((0, 1, 0))]
    skeleton.CreateBindTransformsAttr(pose)
    skeleton.CreateRestTransformsAttr(pose)
    animation = UsdSkel.Animation.Define(stage, "/R/Animation")
    animation.CreateJointsAttr(["a", "a/b"])
    animation.CreateTranslationsAttr([(0, 0, 0), (0, 1, 0)])
    animation.CreateScalesAttr(Vt.Vec3hArray([Gf.Vec3h(1), Gf.Vec3h(1)]))
    turned = Gf.Quatf(Gf.Rotation(Gf.Vec3d(0, 0, 1), 90).GetQuat())
    rotations = animation.CreateRotationsAttr()
    rotations.Set(Vt.QuatfArray([Gf.Quatf(1), Gf.Quatf(1)]), 1)
    rotations.Set(Vt.QuatfArray([Gf.Quatf(1), turned]), 10)
    mesh = UsdGeom.Mesh.Define(stage, "/R/M")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (1, 2, 0), (0, 2, 0)])
    mesh.CreateFaceVertexCountsAttr([4])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3])
    mesh.CreateSubdivisionSchemeAttr("none")
    binding = UsdSkel.BindingAPI.Apply(mesh.GetPrim())
    binding.CreateSkeletonRel().SetTargets(["/R/Skeleton"])
    binding.CreateJointIndicesPrimvar(False, 1).Set([0, 0, 1, 1])
    binding.CreateJointWeightsPrimvar(False, 1).Set([1, 1, 1, 1])
    UsdSkel.BindingAPI.Apply(root.GetPrim()).CreateSkeletonRel().SetTargets(["/R/Skeleton"])
    UsdSkel.BindingAPI.Apply(skeleton.GetPrim()).CreateAnimationSourceRel().SetTargets(["/R/Animation"])
    stage.Save()


@pytest.mark.parametrize(("frame", "degrees"), [(1, 0), (5.5, 45), (10, 90)])
@pytest.mark.parametrize("instanced", [False, True])
def test_skinning_at_and_between_samples(tmp_path, frame, degrees, instanced):
    path = tmp_path / "skinned.usda"
    skinned(path)
    if instanced:
        path = tmp_path / "instances.usda"
        one = 'def "{}" ( instanceable = true\nreferences = @skinned.usda@</R> )\n{{\n}}\n'
        path.write_text("#usda 1.0\n(\n    metersPerUnit = 1\n)\n" + "".join(one.format(name) for name in "ab"))
    before = (tmp_path / "skinned.usda").read_text()
    scene = gonio.load_usd(str(path), frame=frame).to_dict()
    meshes = scene["meshes"]
    turn = math.radians(degrees)
    expected = [math.cos(turn) - math.sin(turn), 1 + math.cos(turn) + math.sin(turn), 0]
    # Instances that skin alike show one mesh.
    assert len(meshes) == 1 and sum(len(each["transforms"]) for each in scene["instances"]) == (2 if instanced else 1)
    assert meshes[0]["points"][2] == pytest.approx(expected, abs=1e-5)
    assert (tmp_path / "skinned.usda").read_text() == before


@pytest.mark.parametrize("interpolation", ["vertex", "faceVarying"])
@pytest.mark.parametrize("indexed", [False, True])
def test_normals_among_the_primvars_turn_with_the_bones(tmp_path, interpolation, indexed):
    from pxr import Sdf, Usd, UsdGeom

    path = tmp_path / "skinned.usda"
    skinned(path)
    stage = Usd.Stage.Open(str(path))
    primvars = UsdGeom.PrimvarsAPI(stage.GetPrimAtPath("/R/M"))
    normals = primvars.CreatePrimvar("normals", Sdf.ValueTypeNames.Normal3fArray, interpolation)
    normals.Set([(1, 0, 0)] if indexed else [(1, 0, 0)] * 4)
    if indexed:
        normals.SetIndices([0, 0, 0, 0])
    stage.Save()
    for frame, degrees in [(1, 0), (10, 90), (5.5, 45)]:
        (mesh,) = gonio.load_usd(str(path), frame=frame).to_dict()["meshes"]
        turn = math.radians(degrees)
        turned = [math.cos(turn), math.sin(turn), 0]
        given = np.asarray(values(mesh["normals"]))
        # The lower bone stands still, the upper one turns.
        if interpolation == "vertex":
            assert given == pytest.approx(np.asarray([[1, 0, 0], [1, 0, 0], turned, turned]), abs=1e-5)
        else:
            far = [np.abs(given - normal).max(axis=1) for normal in ([1, 0, 0], turned)]
            assert np.minimum(*far).max() < 1e-5 and max(each.min() for each in far) < 1e-5


def test_a_type_that_is_unknown_is_the_one_that_the_stage_names_in_its_place(tmp_path):
    header = "metersPerUnit = 1\nfallbackPrimTypes = {\ntoken[] Blob = [\"Wobble\", \"Sphere\"]\n}"
    path = tmp_path / "a.usda"
    path.write_text("#usda 1.0\n(\n" + header + "\n)\n" + 'def Blob "b"\n{\ndouble radius = 2\n}\ndef Other "o" {}\n')
    scene = gonio.load_usd(str(path))
    assert names(scene.to_dict()) == {"/b"}
    messages = [message for _, message in scene.diagnostics]
    assert not any("Blob" in message for message in messages)
    assert any("the prim type 'Other' is unknown" in message for message in messages)


CROWD = """#usda 1.0
(
    metersPerUnit = 1
)
def Material "Red"
{
    token outputs:surface.connect = </Red/S.outputs:surface>
    def Shader "S"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (1, 0, 0)
        token outputs:surface
    }
}
def SkelAnimation "Still"
{
    uniform token[] joints = ["a", "a/b"]
    float3[] translations = [(0, 0, 0), (0, 1, 0)]
    quatf[] rotations = [(1, 0, 0, 0), (1, 0, 0, 0)]
    half3[] scales = [(1, 1, 1), (1, 1, 1)]
}
def Scope "Moved" ( prepend apiSchemas = ["SkelBindingAPI"] )
{
    rel skel:animationSource = </Still>
    %s
}
%s
"""


def member(name, place, more=""):
    return f"""def "{name}" (
    prepend apiSchemas = ["SkelBindingAPI", "MaterialBindingAPI"]
    instanceable = true
    references = @skinned.usda@</R>
)
{{
    double3 xformOp:translate = ({place}, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    {more}
}}
"""


def test_instances_that_skin_alike_share_a_mesh_and_others_do_not(tmp_path):
    skinned(tmp_path / "skinned.usda")
    # The first is bound to a material, which the others must not get; the last one's weights are a property of its own.
    red = "rel material:binding = </Red>"
    weights = "float[] primvars:skel:geomBind = [1]"
    crowd = member("A", 0, red) + member("B", 3) + member("C", 6) + member("D", 9, weights)
    (tmp_path / "crowd.usda").write_text(CROWD % (member("E", 12), crowd))
    found = gonio.load_usd(str(tmp_path / "crowd.usda"), frame=10)
    scene = found.to_dict()
    placed = {}
    for each in scene["instances"]:
        for transform in each["transforms"]:
            material = scene["materials"][each["materials"][0]]["origin"]["name"]
            placed[round(transform["columns"][3][0])] = (each["mesh"], material)
    assert set(placed) == {0, 3, 6, 9, 12}, placed
    assert placed[0][0] == placed[3][0] == placed[6][0] and len({mesh for mesh, _ in placed.values()}) == 3 == len(scene["meshes"])
    assert [placed[place][1] for place in (0, 3, 6)] == ["/Red", "displayColor", "displayColor"]
    assert all(mesh["points"][2] == pytest.approx([-1, 2, 0], abs=1e-5) for mesh in scene["meshes"])
    assert any("show what these are skinned to" in message for _, message in found.diagnostics)


# How shapes look: what an orthographic camera four units wide sees of them.

VIEWS = {"X": (0, 90, 0), "Y": (-90, 0, 0), "Z": (0, 0, 0)}
VIEW = """
def Xform "View"
{{
    double3 xformOp:rotateXYZ = {turn}
    uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]
    def Camera "cam"
    {{
        token projection = "orthographic"
        float horizontalAperture = 40
        float verticalAperture = 40
        double3 xformOp:translate = (0, 0, 10)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
}}
"""


def look(tmp_path, text, along, passes, samples=16):
    scene = read(tmp_path, text + VIEW.format(turn=VIEWS[along]), complexity="veryhigh")
    scene.set(width=64, height=64, samples=samples, passes=passes)
    with gonio.Render(scene) as render:
        assert render.wait()
        film = render.film()
    return {name: np.asarray(film[name]) for name in passes}


@pytest.mark.parametrize(
    ("kind", "body", "areas"),
    [
        ("Sphere", "double radius = 1.5", {"X": math.pi * 2.25, "Y": math.pi * 2.25, "Z": math.pi * 2.25}),
        ("Cube", "double size = 2", {"X": 4, "Y": 4, "Z": 4}),
        ("Cylinder", 'uniform token axis = "X"\ndouble radius = 1\ndouble height = 3', {"X": math.pi, "Y": 6, "Z": 6}),
        ("Cylinder", "double radius = 1\ndouble height = 3", {"X": 6, "Y": 6, "Z": math.pi}),
        ("Cone", 'uniform token axis = "Y"\ndouble radius = 1\ndouble height = 3', {"X": 3, "Y": math.pi, "Z": 3}),
        ("Capsule", "double radius = 0.5\ndouble height = 2", {"X": 2 + math.pi / 4, "Y": 2 + math.pi / 4, "Z": math.pi / 4}),
        ("Plane", 'uniform token axis = "Y"\ndouble width = 2\ndouble length = 3', {"X": 0, "Y": 6, "Z": 0}),
        ("Sphere", 'double3 xformOp:scale = (1, 0.5, 1.5)\nuniform token[] xformOpOrder = ["xformOp:scale"]',
         {"X": math.pi * 0.75, "Y": math.pi * 1.5, "Z": math.pi * 0.5}),
    ],
)  # fmt: skip
def test_silhouettes(tmp_path, kind, body, areas):
    for along, area in areas.items():
        alpha = look(tmp_path, f'def {kind} "Shape"\n{{\n{body}\n}}\n', along, ["alpha"])["alpha"]
        # Facets take up to one part in a hundred of a round outline.
        assert alpha.mean() * 16 == pytest.approx(area, rel=0.012, abs=0.02), along


def test_positions_and_normals_of_a_sphere(tmp_path):
    seen = look(tmp_path, 'def Sphere "Shape"\n{\ndouble radius = 1.5\n}\n', "Z", ["alpha", "P", "normal", "depth"], samples=4)
    inside = seen["alpha"][..., 0] == 1
    # Away from the outline, where a pixel sees much of the turn.
    inside &= np.hypot(seen["P"][..., 0], seen["P"][..., 1]) < 1.2
    place, normal = seen["P"][inside], seen["normal"][inside]
    assert inside.sum() > 500
    assert np.linalg.norm(place, axis=1) == pytest.approx(1.5, rel=0.005)
    assert (normal * place).sum(axis=1) / np.linalg.norm(place, axis=1) == pytest.approx(1, abs=0.01)
    assert place[:, 2] + seen["depth"][inside][:, 0] == pytest.approx(10, abs=0.01)


def test_the_picture_is_upright(tmp_path):
    text = 'def Cube "Shape"\n{\ndouble size = 1\ndouble3 xformOp:translate = (1.5, 0.5, 0)\nuniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
    alpha = look(tmp_path, text, "Z", ["alpha"])["alpha"][..., 0]
    rows, columns = np.nonzero(alpha > 0.5)
    assert (columns.min(), columns.max()) == (48, 63) and (rows.min(), rows.max()) == (16, 31)
