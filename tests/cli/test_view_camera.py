"""What `gonio view` is made of besides its window: the free camera, the pace of coarse pictures, the watch over files."""

import itertools
import math
import os
import threading

import numpy as np
import pytest
from gonio.view.camera import FreeCamera, box_of, distance_to, through
from gonio.view.pace import COARSEST, IN_TIME, Pace, reduced
from gonio.view.watcher import Watcher

BOX = ((-1.0, 0.0, -3.0), (2.0, 1.5, 0.5))


def description(eye=(1.0, 2.0, 5.0), yaw=0.4, pitch=-0.3, projection=None, aperture=(0.036, 0.024)):
    """A camera of a stage that looks down a little."""
    turn = np.array([[math.cos(yaw), 0, math.sin(yaw)], [0, 1, 0], [-math.sin(yaw), 0, math.cos(yaw)]])
    tilt = np.array([[1, 0, 0], [0, math.cos(pitch), -math.sin(pitch)], [0, math.sin(pitch), math.cos(pitch)]])
    right, up, back = (turn @ tilt).T.tolist()
    lens = projection or {"Perspective": {"focal_length": 0.05}}
    return {"projection": lens, "aperture": list(aperture), "transform": {"columns": [right, up, back, list(eye)]}, "exposure": 2.0}


def seen(camera, point, aspect=1.5):
    """Where a point is in the picture, from −1 to 1 both ways, and how far away."""
    told = camera.description(aspect)
    right, up, back, eye = (np.array(column) for column in told["transform"]["columns"])
    offset = np.array(point) - eye
    x, y, z = offset @ right, offset @ up, -(offset @ back)
    width, height = (0.5 * side for side in told["aperture"])
    scale = 1.0 if camera.is_parallel else z
    return x / scale / width, y / scale / height, z


@pytest.fixture(params=["Y", "Z"])
def camera(request):
    return FreeCamera.of(description(), request.param, 4.0)


def test_orbits_keep_the_pivot_in_the_middle(camera):
    for across, upward in itertools.product((-2.0, 0.3, 9.0), (-0.7, 0.0, 0.4)):
        turned = camera.orbited(across, upward)
        assert turned.pivot == pytest.approx(camera.pivot, abs=1e-12)
        assert seen(turned, camera.pivot) == pytest.approx((0, 0, 4.0), abs=1e-12)
        axes = np.array([turned.right, turned.up, turned.back])
        assert axes @ axes.T == pytest.approx(np.eye(3), abs=1e-12)


def test_orbits_stop_at_the_vertical(camera):
    for upward in (20.0, -20.0):
        turned = camera.orbited(0.0, upward)
        assert abs(np.dot(turned.back, camera.vertical)) == pytest.approx(math.cos(math.radians(1.0)))
        assert np.dot(turned.up, camera.vertical) > 0 or camera.vertical[2]


def test_a_drag_to_and_fro_leaves_the_view_as_it_was(camera):
    back = camera.orbited(0.7, 0.1).orbited(-0.7, -0.1).moved(0.2, -0.3).moved(-0.2, 0.3).nearer(2.0).nearer(0.5)
    assert back.eye == pytest.approx(camera.eye) and back.back == pytest.approx(camera.back)


def test_moves_follow_the_cursor(camera):
    # A quarter of the height is half the way from the middle to the edge.
    assert seen(camera.moved(0.25, 0.0), camera.pivot)[0] == pytest.approx(-0.5 / 1.5)
    assert seen(camera.moved(0.0, 0.25), camera.pivot)[1] == pytest.approx(-0.5)


@pytest.mark.parametrize("projection", [None, "Orthographic"])
@pytest.mark.parametrize("aspect", [0.5, 1.0, 2.4])
def test_a_box_is_framed(projection, aspect):
    camera = FreeCamera.of(description(projection=projection), "Y", 4.0).framing(BOX, aspect)
    corners = np.array([seen(camera, corner, aspect) for corner in itertools.product(*zip(*BOX, strict=True))])
    assert (corners[:, 2] > 0).all()
    assert 0.8 < np.abs(corners[:, :2]).max() <= 1.0
    assert camera.back == FreeCamera.of(description(), "Y", 4.0).back
    assert camera.framing(None, aspect) == camera


def test_lenses_and_exposures_are_taken_over():
    told = FreeCamera.of(description(), "Y", 4.0).description(1.5)
    assert told["aperture"] == pytest.approx([0.72, 0.48]) and told["exposure"] == 2.0
    fisheye = FreeCamera.of(description(projection={"FisheyeEquidistant": {"fov_deg": 180.0}}), "Y", 4.0)
    assert fisheye.description(1.0)["aperture"][1] == pytest.approx(2 * math.tan(math.radians(17.5)))


def test_apertures_grow_to_the_picture():
    assert through(description(), 3.0)["aperture"] == pytest.approx([0.072, 0.024])
    assert through(description(), 1.0)["aperture"] == pytest.approx([0.036, 0.036])
    fisheye = description(projection={"FisheyeEquidistant": {"fov_deg": 180.0}})
    assert through(fisheye, 3.0)["aperture"] == fisheye["aperture"]


def test_how_far_the_stage_is():
    ahead = description(eye=(0.5, 0.75, 10.0), yaw=0.0, pitch=0.0)
    assert distance_to(ahead, BOX) == pytest.approx(11.25)
    behind = description(eye=(0.5, 0.75, -10.0), yaw=0.0, pitch=0.0)
    assert distance_to(behind, BOX) > 0.0
    assert box_of(None) is None and box_of([[0, 0, None], [1, 1, 1]]) is None and box_of(BOX) == BOX


def test_the_pace_finds_what_comes_in_time():
    pace, size, speed = Pace(), (1920, 1080), 1e6
    for _ in range(20):
        width, height = reduced(size, pace.factor(size))
        pace.learn(width * height, width * height / speed)
    assert 0.5 * IN_TIME < width * height / speed < 1.5 * IN_TIME
    pace.learn(1, 1e9)
    assert pace.factor(size) == COARSEST
    pace.chosen = 2
    assert pace.factor(size) == 2 and reduced((5, 4), 2) == (3, 2)


@pytest.fixture
def watched(tmp_path):
    """A watcher over a folder's files, and the event that it sets."""
    changed = threading.Event()
    watcher = Watcher(lambda _files: changed.set(), every=0.02)
    yield tmp_path, watcher, changed
    watcher.close()


def test_saved_files_are_noticed(watched):
    folder, watcher, changed = watched
    one, other = folder / "one", folder / "other"
    one.write_text("1")
    watcher.watch([str(one), str(other)])
    assert not changed.wait(0.2)
    one.write_text("22")
    assert changed.wait(10)
    changed.clear()
    # As editors do it.
    (folder / "new").write_text("33")
    os.replace(folder / "new", one)
    assert changed.wait(10)
    changed.clear()
    other.write_text("came")
    assert changed.wait(10)
    changed.clear()
    other.unlink()
    assert changed.wait(10)


def test_what_was_saved_before_the_list_was_renewed_is_noticed(watched):
    folder, watcher, changed = watched
    file = folder / "file"
    file.write_text("1")
    watcher.watch([str(file)])
    file.write_text("22")
    watcher.watch([str(file), str(folder / "more")])
    assert changed.wait(10)
