"""Light and shadow linking by UsdLux's collections."""

import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

FLOOR = """    def Mesh "%s"
    {
        point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        uniform token subdivisionScheme = "none"
        double3 xformOp:translate = %s
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
"""
WORLD = 'def Xform "World"\n{\n' + FLOOR % ("Left", "(-2, 0, 0)") + FLOOR % ("Right", "(2, 0, 0)") + FLOOR % ("Board", "(-2, 0, 0.5)") + "}\n"
LAMP = """
def SphereLight "%s"
{
    float inputs:radius = 0.1
    float inputs:intensity = 100
    double3 xformOp:translate = (-2, 0, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    %s
}
"""


def read(tmp_path, text):
    path = tmp_path / "stage.usda"
    path.write_text(f"#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = \"Z\"\n)\n{text}")
    return gonio.load_usd(str(path))


def links(scene, name):
    """The links of a light or of a mesh that shines, with the names of the instances in place of their numbers."""
    made = scene.to_dict()
    element = next(each for each in [*made["lights"], *made["instances"]] if each["origin"]["name"] == name)
    found = element.get("linking", {"receivers": "All", "blockers": "All"})

    def named(link):
        if link == "All":
            return link
        ((kind, sets),) = link.items()
        return {kind: sorted(made["instances"][number]["origin"]["name"] for number in sets)}

    return named(found["receivers"]), named(found["blockers"])


@pytest.mark.parametrize(
    ("collection", "expected"),
    [
        ("", ("All", "All")),
        ("uniform bool collection:lightLink:includeRoot = 1", ("All", "All")),
        ("rel collection:lightLink:excludes = [</World/Left>]", ({"Except": ["/World/Left"]}, "All")),
        ("rel collection:shadowLink:excludes = [</World/Board>]", ("All", {"Except": ["/World/Board"]})),
        (
            "uniform bool collection:lightLink:includeRoot = 0\n    rel collection:lightLink:includes = [</World/Left>]",
            ({"Only": ["/World/Left"]}, "All"),
        ),
        (
            "uniform bool collection:lightLink:includeRoot = 0\n    rel collection:lightLink:includes = [</World>]\n"
            "    rel collection:lightLink:excludes = [</World/Board>]",
            ({"Only": ["/World/Left", "/World/Right"]}, "All"),
        ),
        (
            'uniform bool collection:lightLink:includeRoot = 0\n    uniform token collection:lightLink:expansionRule = "explicitOnly"\n'
            "    rel collection:lightLink:includes = [</World>, </World/Right>]",
            ({"Only": ["/World/Right"]}, "All"),
        ),
        ("uniform bool collection:lightLink:includeRoot = 0", ({"Only": []}, "All")),
    ],
)
def test_collections(tmp_path, collection, expected):
    scene = read(tmp_path, WORLD + LAMP % ("Lamp", collection))
    assert links(scene, "/Lamp") == expected
    assert not any("link" in message for _, message in scene.diagnostics)


def test_an_expression(tmp_path):
    text = 'uniform bool collection:lightLink:includeRoot = 0\n    pathExpression collection:lightLink:membershipExpression = "/World/R*"'
    assert links(read(tmp_path, WORLD + LAMP % ("Lamp", text)), "/Lamp")[0] == {"Only": ["/World/Right"]}


def test_a_mesh_that_shines(tmp_path):
    shining = FLOOR.replace('Mesh "%s"', 'Mesh "%s" (prepend apiSchemas = ["MeshLightAPI"])') % (
        "Panel",
        "(0, 0, 3)\n        rel collection:lightLink:excludes = [</World/Left>]",
    )
    assert links(read(tmp_path, WORLD + shining), "/Panel")[0] == {"Except": ["/World/Left"]}


def test_native_instances_are_told_apart_and_point_instancers_are_one(tmp_path):
    text = """
class Xform "Chair"
{
    def Cube "Seat" {}
}
def Xform "World"
{
    def "A" (instanceable = true
        inherits = </Chair>)
    {
    }
    def "B" (instanceable = true
        inherits = </Chair>)
    {
    }
    def PointInstancer "P"
    {
        point3f[] positions = [(0, 0, 0), (1, 0, 0)]
        int[] protoIndices = [0, 0]
        rel prototypes = [</World/Ball>]
    }
    def Xform "Ball"
    {
        def Sphere "Round" {}
    }
}
"""
    lamp = LAMP % ("Lamp", "rel collection:lightLink:excludes = [</World/B>, </World/P>]")
    scene = read(tmp_path, text + lamp)
    ((kind, names),) = links(scene, "/Lamp")[0].items()
    assert kind == "Except"
    # The prototype is shown where it stands too, which nothing excludes.
    assert len(scene.to_dict()["instances"]) == 4
    assert names == ["/World/B/Seat", "/World/Ball/Round"]


def test_the_picture(tmp_path):
    import numpy as np

    excluding = "rel collection:lightLink:excludes = [</World/Right>]\n    rel collection:shadowLink:excludes = [</World/Board>]"
    camera = 'def Camera "Camera"\n{\n    double3 xformOp:translate = (0, 0, 9)\n    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'

    def colour(text):
        scene = read(tmp_path, WORLD + LAMP % ("Lamp", text) + camera)
        scene.set(width=64, height=32, samples=16, max_bounces=0, passes=["color"])
        with gonio.Render(scene) as rendering:
            rendering.wait()
            return np.asarray(rendering.film()["color"])[:, :, 1]

    plain, linked = colour(""), colour(excluding)
    assert plain[16, 48:60].max() > 0.0 and linked[16, 48:60].max() == 0.0
    assert linked[:, :32].max() > 0.0


def test_filters_are_named_by_their_type(tmp_path):
    lamp = LAMP % ("Lamp", "rel light:filters = [</Lamp/Door>]\n    def PxrRodLightFilter \"Door\" {}")
    found = [message for _, message in read(tmp_path, WORLD + lamp).diagnostics]
    assert any("a light filter of type PxrRodLightFilter is not supported" in message for message in found), found
