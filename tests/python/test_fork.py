"""Processes that were split off (`fork`, which multiprocessing did by default up to Python 3.13) have none of their parent's threads, and render all the same."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.skipif(not hasattr(os, "fork"), reason="the system splits no processes off")

# What all have in common; a child that waits for ever ends by a signal.
HEAD = """
import multiprocessing, os, signal, sys
import gonio, numpy as np
sys.path.insert(0, {folder!r})
from small_scenes import finished, floor_scene

def picture(threads=0):
    return float(np.asarray(finished(floor_scene(threads=threads))["color"]).sum())

def measured():
    scene = floor_scene()
    scene.add_meter((0, 0, 0), normal=(0, 1, 0))
    return gonio.measure(scene, samples=16).meters[0].value

def in_child(call):
    pid = os.fork()
    if pid == 0:
        signal.alarm(20)
        try:
            call()
            os._exit(0)
        except BaseException as error:
            print(type(error).__name__, error, file=sys.stderr)
            os._exit(1)
    assert os.waitpid(pid, 0)[1] == 0, call
"""


def run(body):
    script = HEAD.format(folder=str(Path(__file__).parents[1] / "shared")) + body
    done = subprocess.run([sys.executable, "-W", "ignore", "-c", script], capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("before", ["picture()", "picture(1)", "measured()", "floor_scene()"])
def test_children_render_what_their_parent_did(before):
    run(f"""
def same():
    assert picture() == whole and picture(1) == whole and measured() > 0

{before}
if not {before!r}.startswith("floor"):
    whole = picture()
    in_child(same)
else:
    # A parent that has done nothing yet.
    in_child(picture)
    whole = picture()
    in_child(same)
    # Children of children too.
    in_child(lambda: (picture(), in_child(same)))
""")


def test_a_child_of_a_render_under_way_starts_its_own():
    run("""
whole = picture()
slow = gonio.Render(floor_scene(samples=1 << 20))
next(slow)

def own():
    assert picture() == whole
    for call in (slow.wait, slow.film, lambda: next(slow), lambda: slow.progress):
        try:
            call()
        except RuntimeError as error:
            assert "process" in str(error)
        else:
            raise AssertionError("a render of another process")

def goes():
    global slow
    # Nobody waits for threads that are not there.
    del slow
    assert picture() == whole

for _ in range(4):
    in_child(own)
    in_child(goes)
slow.cancel()
""")


def test_pools_of_processes_render():
    run("""
def value(number):
    return picture()

if __name__ == "__main__":
    whole = picture()
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map_async(value, range(4)).get(40) == [whole] * 4
""")


def test_children_write_films_and_filter_them():
    run("""
import tempfile
film = finished(floor_scene(passes=["color", "denoising_albedo", "denoising_normal"]))
film.edge_aware()

def all_of_it():
    film.edge_aware()
    with tempfile.TemporaryDirectory() as folder:
        film.write_exr(folder + "/a.exr")
        finished(floor_scene()).write_picture(folder + "/a.png")

in_child(all_of_it)
""")
