"""Pictures without noise."""

import gonio
import numpy as np
import pytest
from small_scenes import above, ball, finished, floor_scene


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


def closure(model, weight, **parameters):
    values = [(name, {"Constant": [value] * 3 + [1.0]}) for name, value in parameters.items()]
    return {"model": model, "weight": {"Constant": [weight] * 3 + [1.0]}, "parameters": values}


@pytest.mark.parametrize("settings", [{"integrator": "whitted"}, {"passes": ["color", "denoising_light", "denoising_albedo"]}])
def test_mixes_are_left_through_the_glass_that_they_were_entered_by(settings):
    """Under an even sky a ball that keeps no light cannot be seen: half of it is clear glass, half refracts alone."""
    scene = gonio.Scene()
    scene.set(**{"width": 16, "height": 16, "samples": 64, "passes": ["color"], **settings})
    points, triangles = ball(48)
    mesh = scene.add_mesh(points, triangles, normals=points, name="ball")
    clear = {"base_color": 1.0, "specular_ior": 1.5, "specular_roughness": 0.0}
    parts = [closure("Glass", 0.5, **clear), closure("Refraction", 0.5, **clear)]
    scene.add_instance(mesh, [scene.put_material({"origin": "mix", "closures": parts})], name="ball")
    scene.add_light("dome", (1.0, 1.0, 1.0), name="sky")
    scene.add_camera(above(6), fov=10)
    assert colour(finished(scene)).mean() == pytest.approx(1.0, abs=0.03)
