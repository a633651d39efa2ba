"""What of an adaptive picture depends on the machine: nothing on threads and lanes, a little on whether the level fuses multiplication
and addition.

Each picture comes from a process of its own, for the level is chosen once. The comparisons that send rays look at values which the two
families of levels round otherwise, so pixels next to a threshold may get other numbers of rays.
"""

import os
import pathlib
import subprocess
import sys

import numpy
import pytest

pytest.importorskip("gonio")

from scenes import SCENES  # noqa: E402

WIDTH, HEIGHT = 256, 192
UNFUSED, FUSED = ("scalar", "sse4.2"), ("avx2", "avx512")
# Pixels that may have another number of rays at a level of the other family, and whose colour may be off by more than rounding.
MOST_OTHER = 20
# What rounding may change of a colour where white is 1.
ROUNDING = 1e-3
RENDER = """
import os, sys
import gonio, numpy
from scenes import SCENES
name, width, height, threads, path = sys.argv[1:]
# A level that the machine does not have leaves the best one.
if gonio.simd_level != os.environ["GONIO_SIMD"]:
    sys.exit()
scene = SCENES[name](int(width), int(height))
scene.set(noise_white=1.0, antialiasing="adaptive", threads=int(threads))
render = gonio.Render(scene)
render.wait()
film = render.film()
numpy.save(path, numpy.concatenate([numpy.asarray(film["color"]), numpy.asarray(film["sample_count"])], axis=2))
"""

pytestmark = [pytest.mark.validate, pytest.mark.timeout(1200)]


@pytest.fixture(scope="module")
def render(tmp_path_factory):
    """Gives colour, coverage and number of rays of a scene at a SIMD level; skips the test where the machine does not have it."""
    folder = tmp_path_factory.mktemp("bits")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(pathlib.Path(__file__).parent), os.environ.get("PYTHONPATH", "")])}

    def rendered(name: str, level: str, threads: int = 1) -> numpy.ndarray:
        path = folder / f"{name}-{level}-{threads}.npy"
        if not path.exists():
            arguments = [name, str(WIDTH), str(HEIGHT), str(threads), str(path)]
            command = [sys.executable, "-c", RENDER, *arguments]
            subprocess.run(command, env={**environment, "GONIO_SIMD": level}, check=True, timeout=600)
        if not path.exists():
            pytest.skip(f"no {level} here")
        picture: numpy.ndarray = numpy.load(path)
        return picture

    return rendered


@pytest.mark.parametrize("level", [*UNFUSED, *FUSED])
@pytest.mark.parametrize("name", SCENES)
def test_one_thread_and_two_give_the_same_bits(render, name, level):
    assert numpy.array_equal(render(name, level, 1), render(name, level, 2))


@pytest.mark.parametrize("levels", [UNFUSED, FUSED])
@pytest.mark.parametrize("name", SCENES)
def test_lanes_do_not_change_a_bit(render, name, levels):
    """One lane and four, eight and sixteen."""
    narrow, wide = (render(name, level) for level in levels)
    assert numpy.array_equal(narrow, wide)


@pytest.mark.parametrize("name", SCENES)
def test_fused_operations_change_next_to_nothing(render, name):
    """Prints in how many pixels levels with and without fused multiplication and addition differ."""
    unfused, fused = render(name, UNFUSED[-1]), render(name, FUSED[0])
    colours = numpy.abs(unfused[..., :3] - fused[..., :3]).max(axis=2)
    rays = unfused[..., 4] != fused[..., 4]
    print(f"{name}: {(colours > 0).sum()} of {colours.size} colours differ, {(colours > ROUNDING).sum()} by more than {ROUNDING},", end=" ")
    print(f"the largest by {colours.max():.1e}; {rays.sum()} pixels have another number of rays")
    assert rays.sum() <= MOST_OTHER
    assert (colours > ROUNDING).sum() <= MOST_OTHER
