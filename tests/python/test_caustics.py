"""Caustics: where light paths run by themselves, and that they bring what camera paths find."""

import dataclasses
import math
import sys
from pathlib import Path

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, at, ball

PEERS = Path(__file__).resolve().parents[1] / "peers"
sys.path[:0] = [str(PEERS / "caustics"), str(PEERS / "render"), str(PEERS.parent / "validate")]

from description import described  # noqa: E402
from engine_gonio import Engine  # noqa: E402

PAY = ("lens", "lantern", "glass_ball", "pool", "louvres")
DO_NOT = ("glass", "car", "nine_lights", "door_ajar")
SHARES = ("diffuse_indirect", "glossy_indirect")


def small(name, caustics):
    """A picture of one sample a pixel of a scene of tests/peers, 48 pixels wide, and what is told of its lamps."""
    scene = described(name)
    engine = Engine(dataclasses.replace(scene, width=48, height=36), 2, f"caustics={caustics}")
    return engine.render(1, 1)[0], [line for line in engine._previous.diagnostics if line[1].endswith("(caustics)")]


@pytest.mark.parametrize("name", PAY + DO_NOT)
def test_light_paths_run_by_themselves_where_they_pay(name):
    (auto, told), (on, _), (off, nothing) = (small(name, caustics) for caustics in ("auto", "on", "off"))
    assert np.array_equal(auto, on if name in PAY else off)
    assert bool(told) == (name in PAY) and not nothing
    if name != "door_ajar":
        assert not np.array_equal(on, off)


def block(glass, low, high, radius, **settings):
    """A block of glass over the middle of a floor, from a height to another, under a lamp at 1.1 m; a mirror far away is a reason for light paths."""
    scene = gonio.Scene()
    scene.set(width=32, height=32, max_bounces=12, threads=2, filter="box", filter_width=1.0, **settings)
    grey = scene.add_material("grey", base_color=(0.5, 0.5, 0.5), specular_weight=0.0)
    scene.add_instance(scene.add_mesh(FLOOR, QUAD, name="floor"), [grey], name="floor")
    x = 0.6
    corners = [[x * a, y, x * b] for y in (high, low) for a, b in ((-1, 1), (1, 1), (1, -1), (-1, -1))]
    sides = [[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]]
    for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)):
        sides += [[a, a + 4, b + 4], [a, b + 4, b]]
    mesh = scene.add_mesh(np.array(corners, "f4"), np.array(sides, "i4"), name="block")
    scene.add_instance(mesh, [scene.add_material("glass", transmission_weight=1.0, specular_ior=1.5, **glass)], name="block")
    mirror = scene.add_mesh(np.array([[4.9, 0, 0.1], [4.9, 0, -0.1], [4.9, 0.2, -0.1], [4.9, 0.2, 0.1]], "f4"), QUAD, name="mirror")
    scene.add_instance(mirror, [scene.add_material("mirror", metalness=1.0, specular_roughness=0.0)], name="mirror")
    scene.add_light("sphere", (100.0, 100.0, 100.0), radius=radius, transform=at(0, 1.1, 0), name="lamp")
    return scene


def means(scene, names, caustics, samples, pictures):
    """By pass, the mean of several pictures and its standard error, of other random numbers for each setting."""
    found = {}
    for number in range(pictures):
        scene.set(caustics=caustics, samples=samples, seed=number + (1000 if caustics == "on" else 0))
        with gonio.Render(scene) as render:
            assert render.wait()
            film = render.film()
        for name in names:
            found.setdefault(name, []).append(float(np.asarray(film[name], "f8")[..., :3].mean()))
    return {name: (np.mean(values), np.std(values, ddof=1) / math.sqrt(pictures)) for name, values in found.items()}


def held(scene, names, samples, most):
    """Both ways in the mean the same, within four standard errors, which are at most `most` of it."""
    on, off = (means(scene, names, *asked, 8) for asked in (("on", samples[0]), ("off", samples[1])))
    for name in names:
        (a, of_a), (b, of_b) = on[name], off[name]
        error = math.hypot(of_a, of_b)
        print(f"{name}: {a / b - 1.0:+.2%} with light paths, standard error {error / b:.2%}")
        assert error < most * b, (name, a, b, error)
        assert abs(a - b) < 4.0 * error, (name, a / b - 1.0, error / b)


COAT = {"coat_weight": 1.0, "coat_roughness": 0.0, "coat_color": (0.9, 0.7, 0.5)}


@pytest.mark.parametrize("coat", [{}, COAT], ids=["glass", "coated"])
def test_a_floor_in_clear_glass_is_as_bright_both_ways(coat):
    # Light passes the surface once before it arrives: a coat dims by the angle outside for one end of the path, and inside for the other.
    scene = block({"specular_roughness": 0.0, **coat}, -0.1, 0.3, 0.3, passes=["color"])
    scene.add_camera(above(0.9), fov=40)
    held(scene, ["color"], (64, 1024), 0.01)


def test_layers_scatter_into_the_same_passes_both_ways():
    # Light through clear glass on a lacquered floor, seen from the side: what its layers scatter depends on the view.
    scene = block({"specular_roughness": 0.0}, 0.2, 0.4, 0.3, passes=["color", *SHARES])
    lacquer = scene.add_material("lacquer", base_color=(0.6, 0.3, 0.2), specular_roughness=0.3, coat_weight=1.0, coat_roughness=0.4)
    board = scene.add_mesh(np.array([[-1, 0.01, 1], [1, 0.01, 1], [1, 0.01, -1], [-1, 0.01, -1]], "f4"), QUAD, name="board")
    scene.add_instance(board, [lacquer], name="board")
    low = math.radians(20.0)
    matrix = [[1, 0, 0, 0], [0, math.cos(low), math.sin(low), 0.5], [0, -math.sin(low), math.cos(low), 2.0], [0, 0, 0, 1]]
    scene.add_camera(matrix, fov=6)
    held(scene, ["color", *SHARES], (128, 2048), 0.03)


def underside(caustics):
    """The mean of what a mirror on the floor shows of a small board's underside, which that mirror lights."""
    scene = gonio.Scene()
    scene.set(width=32, height=32, samples=1024, max_bounces=4, filter="box", filter_width=1.0, caustics=caustics, seed=5)
    mirror = scene.add_material("mirror", base_color=(1.0, 1.0, 1.0), metalness=1.0, specular_roughness=0.0)
    scene.add_instance(scene.add_mesh(FLOOR, QUAD, name="floor"), [mirror], name="floor")
    board = scene.add_mesh(0.03 * FLOOR, QUAD, name="board")
    for height, grey in ((0.5, 0.8), (0.51, 0.0)):
        material = scene.add_material(f"grey {grey}", base_color=(grey,) * 3, specular_weight=0.0)
        scene.add_instance(board, [material], transform=at(0.5, height, 0), name=f"board {grey}")
    lamp = [[1, 0, 0, -2.0], [0, 0, 1, 2.5], [0, -1, 0, 0], [0, 0, 0, 1]]
    scene.add_light("rectangle", (10.0, 10.0, 10.0), width=3.0, height=3.0, transform=lamp)
    scene.add_camera(above(2.0), fov=60)
    with gonio.Render(scene) as render:
        assert render.wait()
        return np.asarray(render.film()["color"])[12:20, 18:25, :3].mean()


def test_small_surfaces_keep_the_light_of_photons():
    # Discs of photons are half as wide as the board, and reach beyond its edges.
    assert underside("on") == pytest.approx(underside("off"), rel=0.02)


def indirect(**settings):
    """What a ball of glass throws on a floor, as light that is not direct: means of the channels."""
    scene = gonio.Scene()
    passes = ["color", "diffuse_direct", "diffuse_indirect", "diffuse_color"]
    scene.set(**{"width": 32, "height": 32, "samples": 64, "max_bounces": 8, "filter": "box", "filter_width": 1.0, "passes": passes, **settings})
    grey = scene.add_material("grey", base_color=(0.5, 0.5, 0.5), specular_weight=0.0)
    scene.add_instance(scene.add_mesh(FLOOR, QUAD, name="floor"), [grey], name="floor")
    points, triangles = ball(48)
    glass = scene.add_material("glass", transmission_weight=1.0, specular_ior=1.5, specular_roughness=0.0)
    mesh = scene.add_mesh((0.4 * points).astype("f4"), triangles, normals=points, name="ball")
    scene.add_instance(mesh, [glass], transform=at(-1.0, 0.8, 0.0), name="ball")
    scene.add_light("sphere", (1000.0, 1000.0, 1000.0), radius=0.05, transform=at(-2.5, 2.0, 0.0), name="lamp")
    scene.add_camera([[1, 0, 0, 0.2], [0, 0, 1, 4], [0, -1, 0, 0], [0, 0, 0, 1]], fov=20)
    with gonio.Render(scene) as render:
        assert render.wait()
        film = render.film()
    light = {name: np.asarray(film[name], "f8")[..., :3] for name in passes}
    parts = [(light[f"diffuse_{part}"] * light["diffuse_color"]).mean(axis=-1) for part in ("direct", "indirect")]
    return parts, light["color"].mean(axis=-1)


@pytest.mark.parametrize("integrator", ["path", "light"])
def test_clamps_limit_what_light_paths_bring(integrator):
    (plain, bright), _ = indirect(caustics="on", integrator=integrator)
    limit = 0.05 * bright.max()
    (direct, clamped), colour = indirect(caustics="on", integrator=integrator, clamp_indirect=limit)
    assert clamped.max() == pytest.approx(limit, rel=0.05) and (bright > 4.0 * limit).sum() > 4
    # Direct light stays, and so does what is dimmer.
    assert direct == pytest.approx(plain, rel=1e-4, abs=1e-6)
    assert colour == pytest.approx(direct + clamped, rel=1e-3, abs=1e-4)
    if integrator == "light":
        (held, other), _ = indirect(caustics="on", integrator="light", clamp_direct=0.5 * plain.max())
        assert held.max() <= 0.5 * plain.max() * 1.001 and other == pytest.approx(bright, rel=1e-4, abs=1e-6)
