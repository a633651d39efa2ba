"""`--explain`: what a prim has become, and why."""

import pictures
import pytest
from failures import fails

STAGE = """
def Xform "Group" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    rel material:binding = </Looks/Red> (bindMaterialAs = "strongerThanDescendants")
    uniform token purpose = "render"
    def Mesh "Hull" (prepend apiSchemas = ["MaterialBindingAPI"])
    {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)]
        rel material:binding = </Looks/Grey>
    }
}
def Xform "Hidden"
{
    token visibility = "invisible"
    def Cube "Inside" {}
}
def Cube "Helper"
{
    uniform token purpose = "guide"
}
def RectLight "Panel" (prepend apiSchemas = ["LinkAPI"])
{
    float inputs:intensity = 1000
    float inputs:width = 2
    float inputs:height = 1
    uniform bool collection:lightLink:includeRoot = 0
    rel collection:lightLink:includes = </Group>
    double3 xformOp:translate = (0, 2, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def RenderPass "P"
{
    rel collection:matte:includes = </Group>
}
"""


@pytest.fixture
def explained(run, tmp_path):
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), STAGE, pictures.BROKEN)

    def explain(path, *options, command="render"):
        done = run(command, stage, "--explain", path, *options)
        assert done.returncode == 0, done.stderr
        return done.stdout

    explain.stage = stage
    return explain


def test_a_mesh_with_the_binding_that_won(explained):
    said = explained("/Group/Hull")
    for words in (
        "/Group/Hull: Mesh with MaterialBindingAPI",
        "visibility: visible",
        "purpose: render (by /Group), shown",
        "4 points, 1 faces; subdivision catmullClark (the schema's default), refined 2 times by complexity high",
        "triangles: 32, placed 1 times",
        "material: /Looks/Red, by /Group.material:binding (direct, inherited, stronger than those below, for all purposes)",
        "another binding: /Group/Hull.material:binding → /Looks/Grey",
        "surface: PreviewSurface, ",
    ):
        assert words in said, (words, said)
    assert "triangles: 2, placed" in explained("/Group/Hull", "--complexity", "low")


def test_what_is_left_out_and_by_whom(explained):
    assert "visibility: invisible, by /Hidden: left out" in explained("/Hidden/Inside")
    assert "purpose: guide (by /Helper), not among those shown: left out" in explained("/Helper")
    assert "purpose: guide (by /Helper), shown" in explained("/Helper", "--purposes", "guide")
    assert "told: " in explained("/Broken") and "triangles: none are in the scene" in explained("/Broken")
    assert "render pass: matte" in explained("/Group/Hull", "--render-pass", "/P")


def test_lights_cameras_and_materials(explained):
    panel = explained("/Panel")
    # π · 2 m² · 1000 cd/m².
    assert "light: rectangle 2 × 1 m, 1000 cd/m², 6283" in panel and "lm in all" in panel
    assert "lightLink includes: /Group" in panel
    assert "camera: 36.9° × 36.9°, everything sharp, from 1 to 1000000 m, exposure 1" in explained("/Cam")
    assert "surface: PreviewSurface, " in explained("/Looks/Red", command="info")


def test_a_path_that_leads_nowhere_tells_how_far_it_goes(run, explained):
    said = fails(run, "info", explained.stage, "--explain", "/Group/Hul/x")
    assert "no prim '/Group/Hul/x'" in said and "below /Group there is Hull" in said
