"""Limits of contributions: they hold what arrives, dimmed by what the light has passed."""

import math

import gonio
import numpy as np
import pytest
from small_scenes import QUAD, at, closure, finished
from test_media import box


def seen(what, limit):
    """The radiance of a floor under a lamp without extent, whose light passes something that halves it."""
    scene = gonio.Scene()
    scene.add_camera(gonio.look_at((0, 0, 4), (0, 0, 0), (0, 1, 0)), fov=0.02)
    scene.set(width=4, height=4, samples=16, max_bounces=0, clamp_direct=limit, seed=3)
    square = np.float32([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]), QUAD
    white = scene.put_material({"origin": "white", "closures": [closure("Diffuse", base_color=1.0)]})
    scene.add_instance(scene.add_mesh(*square), [white])
    scene.add_light("point", (32.0 * math.pi * math.sqrt(2.0),) * 3, transform=at(2, 0, 2))
    if what == "sheet":
        half = scene.put_material({"origin": "half", "closures": [closure("Transparent", base_color=0.5)]})
        scene.add_instance(scene.add_mesh(*square), [half], transform=[[0.3, 0, 0, 1], [0, 0.3, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]])
    elif what == "fog":
        box(scene, (0.9, -0.5, 0.5), (1.1, 0.5, 1.5), absorption=math.log(2.0) / (0.2 * math.sqrt(2.0)))
    return np.asarray(finished(scene)["color"])[..., :3].mean()


@pytest.mark.parametrize(("what", "passes"), [("nothing", 1.0), ("sheet", 0.5), ("fog", 0.5)])
def test_limits_hold_what_arrives(what, passes):
    whole = seen(what, 0.0)
    assert whole == pytest.approx(passes * seen("nothing", 0.0), rel=1e-3)
    for share in (0.4, 0.8, 1.2):
        limit = share * whole
        assert seen(what, limit) == pytest.approx(min(whole, limit), rel=1e-3)
