"""Deep pictures from the command line and from render products."""

import deep_reader as reader
import numpy as np
import pictures
import pytest
from test_render_products import SCENE, VARIABLES, settings

gonio = pytest.importorskip("gonio")

PANE = """
def Mesh "Pane"
{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, -1, 2), (1, -1, 2), (1, 1, 2), (-1, 1, 2)]
    color3f[] primvars:displayColor = [(0.6, 0.1, 0.1)]
    float[] primvars:displayOpacity = [0.5]
}
"""


def flat_of(path):
    picture = pictures.read(path)
    return np.stack([picture[channel] for channel in "RGBA"], axis=-1)


def same(deep, flat):
    _, pixels = reader.read(deep)
    found, wanted = reader.flatten(pixels), flat_of(flat)
    assert abs(found - wanted).max() < 1e-4 * max(1.0, wanted.max())
    return pixels


def test_the_command_line_writes_a_deep_picture_beside_the_flat_one(run, tmp_path):
    stage = pictures.stage(tmp_path / "stage.usda", SCENE, PANE, settings())
    done = run("render", stage, "--spp", 16, "-o", tmp_path / "flat.exr", "--deep", tmp_path / "new" / "deep.exr")
    assert done.returncode == 0, done.stderr
    pixels = same(tmp_path / "new" / "deep.exr", tmp_path / "flat.exr")
    assert np.allclose(pixels[20, 20][:, 4], [8.0, 10.0], rtol=1e-3) and np.allclose(pixels[20, 20][1, 3], 1.0)
    assert pixels[2, 2][:, 4] == pytest.approx([10.0], rel=1e-3)
    assert "deep" not in "".join(pictures.read(tmp_path / "flat.exr").channels)
    done = run("render", stage, "--spp", 4, "--deep", tmp_path / "alone.exr", "--deep-tolerance", 0.5)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == [str(tmp_path / "alone.exr")]
    _, pixels = reader.read(tmp_path / "alone.exr")
    assert max(len(samples) for samples in pixels.flat) == 1


def test_parts_are_merged_to_the_same_deep_picture(run, tmp_path):
    stage = pictures.stage(tmp_path / "stage.usda", SCENE, PANE, settings())
    common = ["render", stage, "--spp", 32]
    assert run(*common, "--deep", tmp_path / "whole.exr").returncode == 0
    for number in (1, 2):
        done = run(*common, "--deep", tmp_path / f"{number}.exr", "--part", f"{number}/2", "--checkpoint", tmp_path / f"{number}.part")
        assert done.returncode == 0, done.stderr
    done = run("merge", tmp_path / "1.part", tmp_path / "2.part", "--deep", tmp_path / "joined.exr")
    assert done.returncode == 0, done.stderr
    one, other = (reader.read(tmp_path / f"{name}.exr")[1] for name in ("whole", "joined"))
    assert all(np.array_equal(a, b) for a, b in zip(one.flat, other.flat, strict=True))
    # Checkpoints without the pass have none.
    run("render", stage, "--spp", 4, "--checkpoint", tmp_path / "flat.part")
    done = run("merge", tmp_path / "flat.part", "--deep", tmp_path / "none.exr")
    assert done.returncode != 0 and "without the pass 'deep'" in done.stderr


def test_deep_products(run, tmp_path):
    flat = 'token productName = "flat.exr"\n    rel orderedVars = [</Vars/color>]'
    deep = 'token productName = "deep.exr"\n    token productType = "deepRaster"\n    rel orderedVars = [</Vars/color>]'
    stage = pictures.stage(tmp_path / "stage.usda", SCENE, PANE, settings("", flat, deep), VARIABLES)
    done = run("render", stage, "--spp", 8, cwd=tmp_path)
    assert done.returncode == 0 and "not supported" not in done.stderr, done.stderr
    assert set(done.stdout.split()) == {"flat.exr", "deep.exr"}
    same(tmp_path / "deep.exr", tmp_path / "flat.exr")


def test_other_formats_and_what_does_not_go_with_it_are_refused(run, tmp_path):
    stage = pictures.stage(tmp_path / "stage.usda", SCENE, settings("", 'token productName = "a.png"\n    token productType = "deepRaster"'))
    for words, problem in (
        (["--deep", "a.png"], "deep pictures are .exr"),
        ([], "deep pictures are .exr"),
        (["--deep", "a.exr", "--integrator", "whitted", "--antialiasing", "adaptive"], "antialiasing"),
        (["--deep", "a.exr", "--deep-tolerance", "0"], "deep_tolerance"),
        (["--deep", "a.exr", "--frames", "1:2"], "frame number"),
    ):
        done = run("render", stage, *words, cwd=tmp_path)
        assert done.returncode != 0 and problem in done.stderr, (words, done.stderr)
    assert not list(tmp_path.glob("*.exr")) and not list(tmp_path.glob("*.png"))
