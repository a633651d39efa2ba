"""Native instances and point instancers."""

import math

import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")


def read(tmp_path, text, **options):
    path = tmp_path / "stage.usda"
    path.write_text(f"#usda 1.0\n(\n    metersPerUnit = 1\n)\n{text}")
    return gonio.load_usd(str(path), **options)


def load(tmp_path, text, **options):
    return read(tmp_path, text, **options).to_dict()


def places(instances):
    return [transform["columns"][3] for transform in instances["transforms"]]


def by_origin(scene):
    return {s["origin"]["name"]: s for s in scene["instances"]}


INSTANCER = """
def PointInstancer "P"
{
    double3 xformOp:translate = (100, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    point3f[] positions = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)]
    int[] protoIndices = [0, 1, 0, 1]
    rel prototypes = [</P/Group>, </P/ball>]
    %s
    def Xform "Group"
    {
        double3 xformOp:translate = (0, 5, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
        def Cube "cube" {}
        def Cone "cone" {}
    }
    def Sphere "ball" {}
}
"""


def test_prototypes_keep_their_own_transform_and_all_their_shapes(tmp_path):
    sets = by_origin(load(tmp_path, INSTANCER % ""))
    assert set(sets) == {"/P/Group/cube", "/P/Group/cone", "/P/ball"}
    assert places(sets["/P/Group/cube"]) == [[100, 5, 0], [102, 5, 0]]
    assert places(sets["/P/Group/cone"]) == [[100, 5, 0], [102, 5, 0]]
    assert places(sets["/P/ball"]) == [[101, 0, 0], [103, 0, 0]]


@pytest.mark.parametrize(
    "hidden", ["int64[] invisibleIds = [1, 2]", "int64[] ids = [7, 8, 9, 10]\n    int64[] invisibleIds = [8, 9]"]
)
def test_invisible_ids(tmp_path, hidden):
    sets = by_origin(load(tmp_path, INSTANCER % hidden))
    assert places(sets["/P/Group/cube"]) == [[100, 5, 0]]
    assert places(sets["/P/ball"]) == [[103, 0, 0]]


def test_inactive_ids(tmp_path):
    text = (INSTANCER % "").replace('def PointInstancer "P"', 'def PointInstancer "P" (\n    inactiveIds = [3]\n)')
    assert places(by_origin(load(tmp_path, text))["/P/ball"]) == [[101, 0, 0]]


@pytest.mark.parametrize("name", ["quath[] orientations", "quatf[] orientationsf"])
def test_orientations_and_scales(tmp_path, name):
    from pxr import UsdGeom

    if name.endswith("f") and not hasattr(UsdGeom.PointInstancer, "GetOrientationsfAttr"):
        pytest.skip("this version of pxr has no orientationsf")
    # 90° about z takes x to y.
    half = 0.70710678
    text = INSTANCER % f"{name} = [(1, 0, 0, 0), ({half}, 0, 0, {half}), (1, 0, 0, 0), (1, 0, 0, 0)]\n    float3[] scales = [(1, 1, 1), (3, 1, 1), (1, 1, 1), (1, 1, 1)]"
    columns = by_origin(load(tmp_path, text))["/P/ball"]["transforms"][0]["columns"]
    assert columns[0] == pytest.approx([0, 3, 0], abs=2e-3)
    assert columns[1] == pytest.approx([-1, 0, 0], abs=2e-3)


def test_values_for_each_instance(tmp_path):
    body = """color3f[] primvars:displayColor = [(1, 0, 0), (0, 1, 0)] ( interpolation = "varying" )
    int[] primvars:displayColor:indices = [0, 1, 1, 0]
    float primvars:all = 5"""
    sets = by_origin(load(tmp_path, INSTANCER % body))
    cube = {p["name"]: p for p in sets["/P/Group/cube"]["primvars"]}
    assert cube["displayColor"]["interpolation"] == "Uniform"
    assert cube["displayColor"]["values"] == [1, 0, 0, 0, 1, 0]
    assert cube["all"]["interpolation"] == "Constant"
    assert cube["all"]["values"] == [5]


def test_nested_instancers_multiply(tmp_path):
    text = """
def PointInstancer "O"
{
    point3f[] positions = [(0, 10, 0), (0, 20, 0)]
    int[] protoIndices = [0, 0]
    rel prototypes = </O/I>
    float[] primvars:outer = [1, 2] ( interpolation = "vertex" )
    def PointInstancer "I"
    {
        point3f[] positions = [(1, 0, 0), (2, 0, 0), (3, 0, 0)]
        int[] protoIndices = [0, 0, 0]
        int64[] invisibleIds = [1]
        rel prototypes = </O/I/c>
        float[] primvars:inner = [10, 11, 12] ( interpolation = "vertex" )
        def Cube "c" {}
    }
}
"""
    (placed,) = load(tmp_path, text)["instances"]
    assert places(placed) == [[1, 10, 0], [3, 10, 0], [1, 20, 0], [3, 20, 0]]
    values = {p["name"]: p["values"] for p in placed["primvars"]}
    assert values == {"outer": [1, 1, 2, 2], "inner": [10, 12, 10, 12]}


def test_prototypes_below_over_and_class_are_shown_by_the_instancer_alone(tmp_path):
    text = """
over "Library"
{
    def Cube "a" {}
}
class "Patterns"
{
    def Cone "b" {}
}
def PointInstancer "P"
{
    point3f[] positions = [(1, 0, 0), (2, 0, 0)]
    int[] protoIndices = [0, 1]
    rel prototypes = [</Library/a>, </Patterns/b>]
}
"""
    sets = by_origin(load(tmp_path, text))
    assert {name: places(s) for name, s in sets.items()} == {"/Library/a": [[1, 0, 0]], "/Patterns/b": [[2, 0, 0]]}


NATIVE = """
class Xform "_chair"
{
    def Cube "seat"
    {
        double3 xformOp:translate = (0, 1, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Sphere "proxy"
    {
        uniform token purpose = "proxy"
    }
}
class Xform "_row"
{
    def Xform "first" ( instanceable = true
        references = </_chair> )
    {
    }
    def Xform "second" ( instanceable = true
        references = </_chair> )
    {
        double3 xformOp:translate = (2, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
"""


def row(name, x, extra="", applied=""):
    return f"""
def Xform "{name}" ( instanceable = true
    {applied}
    references = </_row> )
{{
    double3 xformOp:translate = ({x}, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    {extra}
}}
"""


def material(name):
    return f"""
def Material "{name}"
{{
    token outputs:surface.connect = </{name}/s.outputs:surface>
    def Shader "s"
    {{
        uniform token info:id = "UsdPreviewSurface"
        token outputs:surface
    }}
}}
"""


def test_nested_native_instances_share_one_mesh(tmp_path):
    scene = load(tmp_path, NATIVE + row("a", 0) + row("b", 10))
    assert len(scene["meshes"]) == 1
    (placed,) = scene["instances"]
    assert sorted(places(placed)) == [[0, 1, 0], [2, 1, 0], [10, 1, 0], [12, 1, 0]]


def test_instanced_and_flattened_stages_agree(tmp_path):
    text = NATIVE + row("a", 0) + row("b", 10)
    flat = load(tmp_path, text.replace("instanceable = true", ""))
    instanced = load(tmp_path, text)
    everything = lambda scene: sorted(place for s in scene["instances"] for place in places(s))
    assert everything(flat) == everything(instanced)


def test_purpose_of_an_instance_counts_inside(tmp_path):
    text = NATIVE + row("a", 0, 'uniform token purpose = "guide"')
    assert load(tmp_path, text)["instances"] == []
    assert len(load(tmp_path, text, purposes=["guide"])["instances"]) == 1


def test_invisible_instances(tmp_path):
    assert load(tmp_path, NATIVE + row("a", 0, 'token visibility = "invisible"'))["instances"] == []


def test_bindings_on_instances_differ(tmp_path):
    applied = 'prepend apiSchemas = ["MaterialBindingAPI"]'
    text = NATIVE + material("red") + material("blue")
    text += row("a", 0, "rel material:binding = </red>", applied) + row("b", 10, "rel material:binding = </blue>", applied) + row("c", 20)
    scene = load(tmp_path, text)
    assert len(scene["meshes"]) == 1
    found = {}
    for s in scene["instances"]:
        name = scene["materials"][s["materials"][0]]["origin"]["name"]
        found.setdefault(name if name in ("/red", "/blue") else None, []).extend(places(s))
    assert sorted(found["/red"]) == [[0, 1, 0], [2, 1, 0]]
    assert sorted(found["/blue"]) == [[10, 1, 0], [12, 1, 0]]
    assert sorted(found[None]) == [[20, 1, 0], [22, 1, 0]]


def test_primvars_of_instances_come_as_values_for_each(tmp_path):
    colour = "color3f[] primvars:displayColor = [({}, 0, 0)]"
    (placed,) = load(tmp_path, NATIVE + row("a", 0, colour.format(0.25)) + row("b", 10, colour.format(0.5)))["instances"]
    (primvar,) = placed["primvars"]
    assert primvar["interpolation"] == "Uniform"
    pairs = sorted(zip((place[0] for place in places(placed)), primvar["values"][::3]))
    assert pairs == [(0, 0.25), (2, 0.25), (10, 0.5), (12, 0.5)]


def test_lights_and_cameras_inside_instances(tmp_path):
    text = """
class Xform "_lamp"
{
    def SphereLight "bulb" {}
    def Camera "eye" {}
}
def Xform "a" ( instanceable = true
    references = </_lamp> )
{
    double3 xformOp:translate = (3, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
    scene = load(tmp_path, text)
    assert [light["transform"]["columns"][3] for light in scene["lights"]] == [[3, 0, 0]]
    assert [light["origin"]["name"] for light in scene["lights"]] == ["/a/bulb"]
    assert [camera["origin"]["name"] for camera in scene["cameras"]] == ["/a/eye"]


@pytest.mark.timeout(60)
def test_a_hundred_thousand_instances_share_one_mesh(tmp_path):
    places_text = ", ".join(f"({k % 300}, {k // 300}, 0)" for k in range(100_000))
    text = f'def PointInstancer "P"\n{{\n    point3f[] positions = [{places_text}]\n    int[] protoIndices = [{", ".join(["0"] * 100_000)}]\n'
    scene = read(tmp_path, text + '    rel prototypes = </P/ball>\n    def Sphere "ball"\n    {\n        double radius = 0.4\n    }\n}\n')
    said = scene.to_dict()
    assert len(said["meshes"]) == 1
    assert sum(len(instances["transforms"]) for instances in said["instances"]) == 100_000
    scene.set(width=32, height=32, samples=4, passes=["alpha"])
    scene.add_camera([[1, 0, 0, 150.5], [0, 1, 0, 150.5], [0, 0, 1, 20], [0, 0, 0, 1]])
    with gonio.Render(scene) as render:
        assert render.wait()
        alpha = memoryview(render.film()["alpha"].tobytes()).cast("f")
    # Balls of radius 0.4 on a grid of 1 cover half of it, a little more where they are seen aslant.
    assert sum(alpha) / len(alpha) == pytest.approx(math.pi * 0.16, abs=0.06)
