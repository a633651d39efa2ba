"""Pictures without noise."""

import gonio
import numpy as np
import pytest
from small_scenes import finished, floor_scene


# Rows that do not show the lamp.
AWAY = slice(0, 10)


def colour(film):
    return np.asarray(film["color"])[..., :3]


def whitted(**settings):
    return floor_scene(**{"integrator": "whitted", **settings})


def test_one_sample_has_no_noise():
    """Random places in a pixel change no more than neighbouring pixels differ, and paths come to the same."""
    first, second = (colour(finished(whitted(samples=1, seed=seed)))[AWAY] for seed in (1, 2))
    paths = colour(finished(floor_scene(samples=256, integrator="direct")))[AWAY]
    assert np.abs(first - second).max() < 1.5 * np.abs(np.diff(first, axis=0)).max()
    assert first.mean() == pytest.approx(paths.mean(), rel=0.02)


def test_illuminance_by_fixed_samples():
    paths, fixed = (
        np.asarray(finished(floor_scene(integrator=name, samples=samples))["illuminance"]).mean()
        for name, samples in (("direct", 256), ("whitted", 1))
    )
    assert fixed == pytest.approx(paths, rel=0.02)


def test_light_samples_have_limits():
    with pytest.raises(gonio.SettingError, match="light_samples"):
        finished(whitted(light_samples=0))
