"""Where rays go in a pixel: regular grids, and adaptive antialiasing of pictures without noise."""

import gonio
import numpy as np
import pytest
from small_scenes import finished, floor_scene

# What is shown as white.
WHITE = 2000.0


def colour(film):
    return np.asarray(film["color"])[..., :3]


def whitted(**settings):
    return floor_scene(**{"integrator": "whitted", "passes": ["color", "sample_count"], **settings})


def test_rays_follow_edges():
    film = finished(whitted(antialiasing="adaptive", noise_white=WHITE))
    counts = np.asarray(film["sample_count"])[..., 0]
    assert set(np.unique(counts)) <= {1.0, 5.0, 9.0, 13.0, 17.0, 21.0, 25.0}
    assert counts.min() == 1.0 < counts.max()


@pytest.mark.parametrize("method", ["adaptive", "high", "paper"])
def test_near_a_dense_grid(method):
    dense = colour(finished(whitted(antialiasing=16)))
    single = colour(finished(whitted(antialiasing=1)))
    found = colour(finished(whitted(antialiasing=method, noise_white=WHITE)))
    distance = [np.sqrt(((np.minimum(picture, WHITE) - np.minimum(dense, WHITE)) ** 2).mean()) for picture in (found, single)]
    assert distance[0] < 0.5 * distance[1]


def test_other_passes_come_from_pixels_middles():
    film = finished(whitted(antialiasing="adaptive", passes=["color", "depth", "normal"]))
    depth, normal = (np.asarray(film[name]) for name in ("depth", "normal"))
    assert depth[0, 0, 0] == pytest.approx(8.0, rel=1e-5)
    assert normal[0, 0] == pytest.approx([0.0, 1.0, 0.0], abs=1e-6)


@pytest.mark.parametrize(
    ("settings", "words"),
    [
        ({"integrator": "path", "antialiasing": "adaptive"}, "whitted"),
        ({"integrator": "whitted", "antialiasing": "adaptive", "samples": 4}, "samples"),
    ],
)
def test_settings_that_do_not_go_together(settings, words):
    scene = floor_scene()
    scene.set(**dict(sorted(settings.items())))
    with pytest.raises(gonio.SettingError, match=words):
        finished(scene)


def test_unknown_antialiasing():
    with pytest.raises(gonio.SettingError, match="adaptive"):
        gonio.Scene().set(antialiasing="fine")
