"""Path guiding: the same mean as without, closed forms, the same bits for threads, parts and checkpoints, and what is told of it."""

import numpy as np
import pytest
from small_scenes import QUAD, at, finished

gonio = pytest.importorskip("gonio")

# Of the sphere's surface, the part that is open, and the reflectance of the rest.
OPEN, WHITE = 0.01, 0.7


def sphere_with_opening(columns=96, rows=64):
    """A sphere of radius 1 m whose top is open: the zone's height is that part of the diameter."""
    polar = np.linspace(np.arccos(1.0 - 2.0 * OPEN), np.pi, rows + 1)[:, None]
    around = 2.0 * np.pi * np.arange(columns) / columns
    points = np.stack([np.sin(polar) * np.cos(around), np.cos(polar) + 0.0 * around, np.sin(polar) * np.sin(around)], axis=2)
    number = np.arange((rows + 1) * columns).reshape(rows + 1, columns)
    right = np.roll(number, -1, axis=1)
    a, b, c, d = (part.ravel() for part in (number[:-1], right[:-1], right[1:], number[1:]))
    triangles = np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)])
    return points.reshape(-1, 3).astype("f4"), triangles.astype("i4")


def integrating_sphere(**settings):
    """Under a sky of 1 cd/m², seen from inside."""
    scene = gonio.Scene()
    scene.set(**{"width": 128, "height": 128, "samples": 64, "max_bounces": 200, "passes": ["color"], **settings})
    mesh = scene.add_mesh(*sphere_with_opening(), name="sphere")
    white = scene.add_material("white", base_color=(WHITE,) * 3, specular_weight=0.0)
    scene.add_instance(mesh, [white], name="sphere")
    scene.add_light("dome", (1.0, 1.0, 1.0), name="sky")
    scene.add_camera(at(0, -0.2, 0.5), fov=60)
    return scene


def quad(*corners):
    return np.array(corners, "f4")


def two_rooms(seed=0, roughness=None, **settings):
    """A dark room that gets its light from a bright one through a gap."""
    scene = gonio.Scene()
    scene.set(**{"width": 64, "height": 48, "samples": 64, "seed": seed, "max_bounces": 8, "passes": ["color"], **settings})
    look = {"specular_weight": 0.0} if roughness is None else {"specular_weight": 1.0, "specular_roughness": roughness}
    wall = scene.add_material("wall", base_color=(0.7, 0.65, 0.6), **look)
    x, h, z = 2.0, 2.5, 3.0
    sides = {
        "floor": quad((-x, 0, z), (x, 0, z), (x, 0, -z), (-x, 0, -z)),
        "ceiling": quad((-x, h, -z), (x, h, -z), (x, h, z), (-x, h, z)),
        "back": quad((-x, 0, -z), (x, 0, -z), (x, h, -z), (-x, h, -z)),
        "front": quad((x, 0, z), (-x, 0, z), (-x, h, z), (x, h, z)),
        "left": quad((-x, 0, z), (-x, 0, -z), (-x, h, -z), (-x, h, z)),
        "right": quad((x, 0, -z), (x, 0, z), (x, h, z), (x, h, -z)),
        "partition": quad((-x, 0, 0), (x - 0.3, 0, 0), (x - 0.3, h, 0), (-x, h, 0)),
    }
    for name, points in sides.items():
        scene.add_instance(scene.add_mesh(points, QUAD, name=name), [wall], name=name)
    scene.add_light("sphere", (2000.0,) * 3, radius=0.1, transform=at(-1, 1.8, -1.8), name="lamp")
    scene.add_camera(at(-1.2, 1.3, 2.8), fov=55)
    return scene


def rendered(scene):
    """The film, and what is told of guiding."""
    with gonio.Render(scene) as render:
        assert render.wait()
        return render.film(), render.guiding


def test_an_integrating_sphere_is_as_bright_as_its_closed_form():
    film, told = rendered(integrating_sphere(guiding="on"))
    assert "cells are followed" in told and "given up" not in told
    # Every part of a sphere sees every other alike: L = ρ (f L₀ + (1 − f) L).
    expected = WHITE * OPEN / (1.0 - WHITE * (1.0 - OPEN))
    shown = np.asarray(film["color"])[64:, :, :3].mean()
    assert shown == pytest.approx(expected, rel=0.01)


@pytest.mark.parametrize("roughness", [None, 0.3])
def test_the_mean_is_that_of_paths_without(roughness):
    passes = ["color", "diffuse_indirect", "glossy_indirect"]
    pictures = {}
    for guiding in ("off", "on"):
        films = [rendered(two_rooms(seed, roughness, guiding=guiding, passes=passes)) for seed in range(8)]
        assert guiding == "off" or all("given up" not in told for _, told in films)
        pictures[guiding] = np.array([[np.asarray(film[name])[..., :3].mean() for name in passes] for film, _ in films])
    off, on = pictures["off"], pictures["on"]
    error = np.sqrt((off.var(axis=0, ddof=1) + on.var(axis=0, ddof=1)) / 8)
    for number, name in enumerate(passes[: 2 if roughness is None else 3]):
        apart = abs(off[:, number].mean() - on[:, number].mean())
        assert apart < 4.0 * error[number], f"{name}: {apart} apart, standard error {error[number]}"
        assert error[number] < 0.05 * off[:, number].mean()


def test_noise_is_less_behind_a_gap():
    long = np.asarray(finished(two_rooms(seed=99, samples=4096))["color"])[..., :3]
    errors = []
    for guiding in ("off", "on"):
        film, _ = rendered(two_rooms(guiding=guiding))
        errors.append(float(((np.asarray(film["color"])[..., :3] - long) ** 2).mean()))
    assert errors[1] < 0.8 * errors[0]


def test_the_same_bits_for_threads_parts_and_checkpoints(tmp_path):
    settings = {"width": 70, "height": 66, "samples": 32, "guiding": "on"}
    one, two = (np.asarray(finished(two_rooms(threads=threads, **settings))["color"]) for threads in (1, 2))
    assert np.array_equal(one, two)
    scene = two_rooms(**settings)
    paths = []
    for part in ((0, 16), (16, 32)):
        scene.set(sample_range=part)
        with gonio.Render(scene) as render:
            assert render.wait()
            paths.append(tmp_path / f"{len(paths)}.part")
            render.checkpoint(paths[-1])
    assert np.array_equal(np.asarray(gonio.merge(paths)["color"]), one)
    scene.set(sample_range=None)
    kept = tmp_path / "kept.part"
    with gonio.Render(scene) as render:
        next(iter(render))
        render.checkpoint(kept)
        render.cancel()
    with gonio.Render(scene, resume=kept) as render:
        assert render.wait()
        assert np.array_equal(np.asarray(render.film()["color"]), one)


def test_what_is_told():
    assert rendered(two_rooms(samples=4))[1] is None
    assert "samples are too few" in rendered(two_rooms(samples=4, guiding="auto"))[1]
    assert "this integrator" in rendered(two_rooms(samples=4, guiding="on", integrator="whitted"))[1]
    scene = two_rooms(samples=4, guiding="on")
    described = scene.to_dict()
    assert described["settings"]["guiding"] == "On"
    with pytest.raises(gonio.Error, match="guiding"):
        scene.set(guiding="perhaps")
