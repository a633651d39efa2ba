"""Meshes that glow by a pattern are lights: sampled by what they emit in the mean, lit by what each point emits."""

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, at, finished

SIDE = 0.2
PANEL = np.array([[-SIDE, 0, SIDE], [SIDE, 0, SIDE], [SIDE, 0, -SIDE], [-SIDE, 0, -SIDE]], "f4")
UV = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], "f4")
HEIGHT = 1.5
NITS = 1000.0
ONE = {"Constant": [1.0] * 4}
ST = {"operation": {"Primvar": {"name": "st", "fallback": [0.0] * 4}}, "inputs": []}


def constant(x):
    return {"Constant": [float(x)] * 4}


def glowing(nodes, emission, model="Emission", weight=ONE, **parameters):
    """A material that emits what a graph gives."""
    parameters = [["emission_color", emission], *([name, constant(value)] for name, value in parameters.items())]
    return {"origin": "glow", "closures": [{"weight": weight, "model": model, "parameters": parameters}], "graph": {"nodes": nodes}}


def ramp():
    """Emission by the first coordinate: none at the left edge, twice the mean at the right one."""
    nodes = [ST, {"operation": "Multiply", "inputs": [{"Node": [0, "R"]}, constant(2 * NITS)]}]
    return glowing(nodes, {"Node": [1, "Rgb"]}), lambda u, v: 2 * u, 0.05


def stripe():
    """The same as a weight of the closure, for a narrow stripe alone."""
    nodes = [ST, {"operation": "Less", "inputs": [constant(0.9), {"Node": [0, "R"]}]}]
    return glowing(nodes, constant(NITS), weight={"Node": [1, "R"]}), lambda u, v: 1.0 * (u > 0.9), 0.4


def half_there():
    """Even emission of a surface that is half open."""
    return glowing([], constant(NITS), model="OpenPbr", base_color=0.0, specular_weight=0.0, geometry_opacity=0.5), lambda u, v: 0.5 + 0 * u, 0.01


MADE = {made.__name__: made for made in (ramp, stripe, half_there)}


def room(material, samples=64, **settings):
    """A grey floor under a glowing panel."""
    scene = gonio.Scene()
    scene.set(**{"width": 16, "height": 16, "samples": samples, "passes": ["color", "illuminance"], "filter": "box", **settings})
    scene.add_instance(scene.add_mesh(FLOOR, QUAD), [scene.add_material("floor", base_color=(0.5,) * 3, specular_weight=0.0)])
    panel = scene.add_mesh(PANEL, QUAD, primvars={"st": UV})
    scene.add_instance(panel, [scene.put_material(material)], transform=at(0, HEIGHT, 0))
    scene.add_camera(above(HEIGHT - 0.2), fov=80)
    return scene


def lux_at(factor, px, pz, count):
    """Lux at a place of the floor, by the midpoint rule over the panel, so many points along its side."""
    steps = (np.arange(count) + 0.5) / count
    u, v = np.meshgrid(steps, steps)
    x, z = (2 * u - 1) * SIDE, (1 - 2 * v) * SIDE
    square = (x - px) ** 2 + (z - pz) ** 2 + HEIGHT**2
    return (NITS * factor(u, v) * HEIGHT**2 / square**2).mean() * (2 * SIDE) ** 2


def expected(factor):
    """Lux at the middle of each of the picture's pixels."""
    half = (HEIGHT - 0.2) * np.tan(np.radians(40))
    places = ((np.arange(16) + 0.5) / 8 - 1) * half
    return np.array([[lux_at(factor, px, pz, 200) for px in places] for pz in places])


@pytest.mark.parametrize("made", MADE)
def test_what_patterns_light_is_their_integral(made):
    material, factor, noise = MADE[made]()
    film = finished(room(material))
    lux, right = np.asarray(film["illuminance"])[..., 0], expected(factor)
    # Pixels are as wide as 0.2 % of curvature.
    assert lux.mean() == pytest.approx(right.mean(), rel=0.01)
    assert np.sqrt(np.mean((lux / right - 1) ** 2)) < noise


@pytest.mark.parametrize("made", MADE)
def test_paths_from_the_light_bring_the_same(made):
    material, *_ = MADE[made]()
    scene = room(material, samples=256, integrator="light", passes=["color"])
    colour = np.asarray(finished(scene)["color"])[..., :3].mean()
    paths = np.asarray(finished(room(material, passes=["color"]))["color"])[..., :3].mean()
    assert colour == pytest.approx(paths, rel=0.02)


def test_fixed_samples_ask_the_pattern_too():
    material, factor, _ = ramp()
    film = finished(room(material, integrator="whitted", passes=["illuminance"]))
    assert np.asarray(film["illuminance"])[..., 0].mean() == pytest.approx(expected(factor).mean(), rel=0.03)


def test_bright_spots_stay_within_the_clamp():
    material, *_ = stripe()
    whole, clamped = (np.asarray(finished(room(material, samples=16, clamp_direct=most))["color"])[..., :3] for most in (0.0, 1e-3))
    assert clamped.max() <= 1.01e-3 < whole.max()


def test_emission_that_counts_bounces_is_found_by_chance():
    nodes = [{"operation": {"LightPath": "RayDepth"}, "inputs": []}]
    scene = room(glowing(nodes, {"Node": [0, "Rgb"]}), samples=1024)
    even = room(glowing([], constant(1.0)), samples=1024)
    # The floor sees it after one bounce.
    found, same = (np.asarray(finished(made)["color"])[..., :3].mean() for made in (scene, even))
    assert found == pytest.approx(same, rel=0.05)


@pytest.mark.parametrize("made", MADE)
def test_goniometers_measure_patterns(made):
    material, factor, _ = MADE[made]()
    scene = gonio.Scene()
    panel = scene.add_mesh(PANEL, QUAD, primvars={"st": UV})
    scene.add_instance(panel, [scene.put_material(material)])
    found = gonio.goniometer(scene, down=(0, -1, 0), error=0, rays=1 << 20, seed=3)
    steps = (np.arange(200) + 0.5) / 200
    candela = NITS * factor(*np.meshgrid(steps, steps)).mean() * (2 * SIDE) ** 2
    # Both sides glow.
    assert found.flux.value == pytest.approx(2 * np.pi * candela, rel=0.003)
    intensities, errors = np.asarray(found.intensities), np.asarray(found.standard_errors)
    for pole in (0, -1):
        assert intensities[0, pole] == pytest.approx(candela, abs=3.5 * errors[0, pole] + 0.002 * candela)


def test_maps_show_where_patterns_shine():
    material, factor, _ = stripe()
    maps = gonio.illumination_map(room(material), texel=0.25, error=0, paths=1 << 20)
    floor = maps.surfaces[0]
    corners = np.asarray(floor.corners).reshape(-1, 3, 3)
    middles, lux = corners.mean(axis=1), np.asarray(floor.illuminance())
    right = np.array([lux_at(factor, px, pz, 100) for px, _, pz in middles])
    near = right > 0.3 * right.max()
    assert lux[near].sum() == pytest.approx(right[near].sum(), rel=0.02)
    # The stripe is at the right.
    assert (lux * middles[:, 0])[near].sum() / lux[near].sum() == pytest.approx((right * middles[:, 0])[near].sum() / right[near].sum(), abs=0.01)
