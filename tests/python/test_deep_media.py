"""Deep pictures of fog: what of it covers and shines lies at its depths."""

import math

import gonio
import numpy as np
import pytest
from deep_reader import flatten, read
from gonio.medium import medium
from small_scenes import block, closure, finished

pytest.importorskip("OpenEXR")
DENSITY, NEAR, FAR = 0.8, 2.0, 4.0
WALL = np.array([[-9, -9, -5], [9, -9, -5], [9, 9, -5], [-9, 9, -5]], "f4")
QUAD = np.array([[0, 1, 2], [0, 2, 3]], "i4")


def scene_of(kind, **coefficients):
    """A camera that looks along -z through a slab of fog, even or of a grid of ones."""
    scene = gonio.Scene()
    scene.add_camera(gonio.look_at((0, 0, 0), (0, 0, -1), (0, 1, 0)), fov=0.5)
    scene.set(width=8, height=8, filter="box", samples=256, max_bounces=250, max_transparent_bounces=250, caustics="off", passes=["color", "deep"])
    if kind == "grid":
        grid = np.ones((18, 18, 2), "f4")
        place = [[1, 0, 0, -9], [0, 1, 0, -9], [0, 0, 1, -FAR], [0, 0, 0, 1]]
        scene.add_volume(grid, voxel=1.0, transform=place, **coefficients)
        return scene
    fog = scene.put_material({"origin": "fog", "closures": [closure("Transparent", base_color=1.0)], "medium": medium(**coefficients)})
    scene.add_instance(scene.add_mesh(*block((-9, -9, -FAR), (9, 9, -NEAR))), [fog])
    return scene


def pictures(scene, folder):
    film = finished(scene)
    film.write_deep_exr(folder / "deep.exr")
    pixels, flat = read(folder / "deep.exr")[1], np.asarray(film["color"]).astype("f8")
    found = flatten(pixels)
    assert abs(found[..., 3] - flat[..., 3]).max() < 1e-5 and abs(found[..., :3] - flat[..., :3]).max() < 1e-4 * flat[..., :3].max()
    for samples in pixels.flat:
        assert (np.diff(samples[:, 4]) >= 0).all() and (samples[:, 5] <= 1.064 * samples[:, 4]).all()
    return pixels


def covered(depth):
    return 1.0 - math.exp(-DENSITY * (min(max(depth, NEAR), FAR) - NEAR))


@pytest.mark.parametrize("kind", ["even", "grid"])
def test_fog_covers_by_its_depth(tmp_path, kind):
    """In even light of 1 what only scatters shines as much as it covers."""
    scene = scene_of(kind, scattering=DENSITY, anisotropy=0.3)
    scene.add_light("dome", (1.0,) * 3)
    pixels = pictures(scene, tmp_path)
    for depth in (2.0, 2.25, 2.5, 3.0, 3.5, 4.001):
        part = flatten(pixels, depth).reshape(-1, 4).mean(0)
        # Depths of fog are one within a sixteenth of an octave.
        least, most = covered(depth - 0.125), covered(depth + 0.125)
        assert least - 0.012 < part[3] < most + 0.012, (depth, part)
        assert part[:3] == pytest.approx(part[3], abs=0.02)
    assert flatten(pixels, 4.01).mean((0, 1))[3] == pytest.approx(covered(FAR), abs=0.012)


@pytest.mark.parametrize("kind", ["even", "grid"])
def test_what_is_behind_stays_behind(tmp_path, kind):
    """Fog that shines and absorbs before a black wall: its light is before the wall, which keeps its coverage."""
    scene = scene_of(kind, absorption=DENSITY, emission=2.0)
    black = scene.add_material("black", base_color=(0.0,) * 3, specular_weight=0.0)
    scene.add_instance(scene.add_mesh(WALL, QUAD), [black])
    pixels = pictures(scene, tmp_path)
    before, whole = (flatten(pixels, depth).mean((0, 1)) for depth in (4.5, np.inf))
    # Tracking meets the light of a grid by chance.
    assert before[:3] == pytest.approx(2.0 / DENSITY * covered(FAR), rel=0.001 if kind == "even" else 0.04)
    assert before[:3] == pytest.approx(whole[:3], rel=1e-4)
    assert whole[3] == pytest.approx(1.0, abs=1e-5)
    if kind == "even":
        assert before[3] == 0.0
