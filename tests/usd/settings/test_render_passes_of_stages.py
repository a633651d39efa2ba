"""RenderPass prims: what is pruned, hidden, hidden from the camera, and matte."""

import numpy as np
import pictures
import pytest
from failures import fails

CROWD = """
def PointInstancer "Crowd"
{
    int[] protoIndices = [0]
    point3f[] positions = [(-1.2, 0.3, 1.8)]
    rel prototypes = </Crowd/Ball>
    def Sphere "Ball"
    {
        double radius = 0.3
    }
}
def Xform "Copy" (
    instanceable = true
    prepend references = </Thing>
)
{
    double3 xformOp:translate = (1.2, 0.3, 1.8)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
class Xform "Thing"
{
    def Sphere "Ball"
    {
        double radius = 0.3
    }
}
def RenderSettings "Small"
{
    uniform int2 resolution = (48, 48)
    rel camera = </Cam>
}
def RenderSettings "Other" {}
"""


def render_pass(body, name="Pass"):
    return f'def RenderPass "{name}"\n{{\n    rel renderSource = </Small>\n{body}\n}}\n'


def without(collection, *paths, include_root="true"):
    """A collection of all but these prims."""
    listed = ", ".join(f"<{path}>" for path in paths)
    return f"    uniform bool collection:{collection}:includeRoot = {include_root}\n    rel collection:{collection}:excludes = [{listed}]\n"


def only(collection, *paths):
    listed = ", ".join(f"<{path}>" for path in paths)
    return f"    uniform bool collection:{collection}:includeRoot = 0\n    rel collection:{collection}:includes = [{listed}]\n"


@pytest.fixture
def shot(run, tmp_path):
    """Renders the room in a pass with this body; without one, plainly."""

    def render(body=None, *options, name="out.exr", spp=64):
        stage = pictures.stage(tmp_path / "stage.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), CROWD, render_pass(body or ""))
        chosen = ["--settings", "/Small"] if body is None else ["--render-pass", "/Pass"]
        done = run("render", stage, tmp_path / name, "--spp", spp, *chosen, *options)
        assert done.returncode == 0, done.stderr
        return pictures.read(tmp_path / name)

    return render


def test_a_pass_brings_its_settings_and_changes_nothing_else(shot):
    assert pictures.same(shot(name="plain.exr"), shot("", name="pass.exr"))


@pytest.mark.parametrize("option", ["-rp", "--renderPassPrimPath", "--pass"])
def test_the_names_of_other_programs(run, shot, tmp_path, option):
    shot(spp=1)
    done = run("render", tmp_path / "stage.usda", tmp_path / "b.exr", "--spp", 1, option, "/Pass")
    assert done.returncode == 0 and pictures.read(tmp_path / "b.exr").shape == (48, 48)


@pytest.mark.parametrize("body", [only("prune", "/Ball"), without("renderVisibility", "/Ball")])
def test_what_is_left_out_throws_no_shadow(shot, tmp_path, body):
    stage_without = pictures.ROOM.replace('def Sphere "Ball"', 'def Sphere "Ball" (active = false)', 1).replace("(active = false) (prepend", "(\n    active = false\n    prepend", 1)
    left_out = shot(body, name="left_out.exr")
    plain = shot(name="plain.exr")
    assert pictures.difference(left_out, plain) > 0.01
    assert "active = false" in stage_without
    stage = pictures.stage(tmp_path / "without.usda", stage_without, pictures.LAMP, pictures.camera(), CROWD, render_pass(""))
    import subprocess, sys

    line = [sys.executable, "-m", "gonio.cli", "render", str(stage), str(tmp_path / "without.exr"), "--spp", "64", "--render-pass", "/Pass"]
    assert subprocess.run(line, capture_output=True).returncode == 0
    assert pictures.same(left_out, pictures.read(tmp_path / "without.exr"))


def test_hidden_from_the_camera_alone(shot):
    plain = shot("", "--aov", "color,P,alpha", name="plain.exr")
    hidden = shot(without("cameraVisibility", "/Ball"), "--aov", "color,P,alpha", name="hidden.exr")
    gone = shot(only("prune", "/Ball"), "--aov", "color,P,alpha", name="gone.exr")
    # The floor is seen in its place, and lies in its shadow.
    assert np.abs(plain["P.Y"] - hidden["P.Y"]).max() > 0.5
    assert np.abs(gone["P.Y"] - hidden["P.Y"]).max() < 0.05
    assert hidden.rgb.mean() < 0.99 * gone.rgb.mean()


def test_matte_cuts_a_hole(shot):
    plain = shot("", name="plain.exr")
    matte = shot(only("matte", "/Ball"), name="matte.exr")
    hole = (plain["A"] > 0.99) & (matte["A"] < 0.01)
    assert 20 < hole.sum() < 600 and np.abs(matte.rgb[hole]).max() < 1e-6
    whole = (plain["A"] > 0.99) & (matte["A"] > 0.99)
    # It still throws its shadow.
    assert matte.rgb[whole].mean() == pytest.approx(plain.rgb[whole].mean(), rel=0.05)


def test_lights_out_of_the_pass(shot):
    dark = shot(without("renderVisibility", "/Lamp"), "--headlight", "none")
    assert dark.rgb.max() == 0


@pytest.mark.parametrize("path", ["/Crowd", "/Copy"])
def test_instances_are_what_their_prims_are(shot, path):
    plain = shot("", name="plain.exr", spp=16)
    matte = shot(only("matte", path), name="matte.exr", spp=16)
    hole = (plain["A"] > 0.99) & (matte["A"] < 0.01)
    columns = np.nonzero(hole)[1]
    assert len(columns) > 4 and (columns.max() < 24 if path == "/Crowd" else columns.min() > 24)


def test_a_pass_that_is_not_there(run, shot, tmp_path):
    shot(spp=1)
    said = fails(run, "render", tmp_path / "stage.usda", tmp_path / "b.exr", "--render-pass", "/Nowhere")
    assert "no RenderPass prim at '/Nowhere'" in said
