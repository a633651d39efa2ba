"""Lamps that nothing blocks among so many lights that it is learned which arrive where."""

import gonio
import numpy as np
import pytest
from small_scenes import QUAD, at, closure, finished


def seen(samples, seeds, strong=10_000.0):
    """The mean radiance of a floor at the edge of the shadow of a strong lamp, one of a hundred, where a weak one lights it that casts none."""
    square = np.float32([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)])
    scene = gonio.Scene()
    scene.add_camera(gonio.look_at((0, 0, 3), (0, 0, 0), (0, 1, 0)), fov=30)
    scene.set(width=32, height=32, filter="box", max_bounces=0, samples=samples, passes=["color"])
    white = scene.put_material({"origin": "white", "closures": [closure("Diffuse", base_color=1.0)]})
    floor, roof = scene.add_mesh(square * 4, QUAD), scene.add_mesh(square, QUAD)
    scene.add_instance(floor, [white])
    scene.add_instance(roof, [white], transform=at(-1.05, 0.0, 3.5))
    scene.add_light("sphere", (strong,) * 3, radius=0.05, transform=at(0.0, 0.0, 6.0))
    for number in range(100):
        scene.add_light("sphere", (strong * 1e-4,) * 3, radius=0.02, transform=at(0.1 * number % 3 - 1.5, 0.03 * number - 1.5, 5.5))
    scene.add_light("point", (1.0,) * 3, transform=at(0.5, 0.5, 2.0))
    lights = scene.to_dict()["lights"]
    scene.put_light({**lights[-1], "casts_shadow": False}, len(lights) - 1)
    means = []
    for seed in seeds:
        scene.set(seed=seed)
        means.append(np.asarray(finished(scene)["color"])[:, :10, :3].mean())
    return np.mean(means), np.std(means) / np.sqrt(len(means))


def test_lamps_without_shadows_are_learned():
    expected, error = seen(1, range(8), strong=0.0)
    found, other = seen(64, range(4))
    assert found == pytest.approx(expected, abs=5 * np.hypot(error, other) + 0.01 * expected)
    assert other < 0.02 * expected
