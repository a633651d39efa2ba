"""Thin glazing: sun and sky behind a pane, against Fresnel's equations with all inner reflections and absorption."""

import math

import gonio
import numpy as np
import pytest

IOR = 1.52


def transmittance(angle: float, passed: float) -> float:
    """Of unpolarised light at an angle in degrees; `passed` is what the pane's body lets through straight on."""
    cosine = math.cos(math.radians(angle))
    inside = math.sqrt(1 - (1 - cosine**2) / IOR**2)
    body = passed ** (1 / inside)
    across = ((cosine - IOR * inside) / (cosine + IOR * inside)) ** 2
    along = ((IOR * cosine - inside) / (IOR * cosine + inside)) ** 2
    return sum(0.5 * body * (1 - r) ** 2 / (1 - (r * body) ** 2) for r in (across, along))


def room(passed: float) -> gonio.Scene:
    """A floor under an endless pane, seen from between them."""
    scene = gonio.Scene()
    quad = np.array([[-50, -50, 0], [50, -50, 0], [50, 50, 0], [-50, 50, 0]], np.float32)
    floor = scene.add_mesh(quad, np.array([[0, 1, 2], [0, 2, 3]], np.int32))
    pane = scene.add_mesh(quad + np.array([0, 0, 1], np.float32), np.array([[0, 1, 2], [0, 2, 3]], np.int32))
    glass = scene.add_material(
        "pane", transmission_weight=1.0, specular_roughness=0.0, specular_ior=IOR, transmission_color=(passed,) * 3, thin_walled=True
    )
    scene.add_instance(floor, [scene.add_material(base_color=0.0, specular_weight=0.0)])
    scene.add_instance(pane, [glass])
    scene.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0.5], [0, 0, 0, 1]], fov=1.0)
    scene.set(width=16, height=16, samples=64, passes=["illuminance"])
    return scene


def lux(scene: gonio.Scene) -> float:
    with gonio.Render(scene) as rendering:
        rendering.wait()
        return float(np.asarray(rendering.film()["illuminance"]).mean())


@pytest.mark.parametrize("passed", [1.0, 0.8])
@pytest.mark.parametrize("angle", [0.0, 20.0, 40.0, 60.0, 70.0, 80.0])
def test_the_sun_behind_a_pane(angle, passed):
    sine, cosine = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    # Light along local -z, which leans by the angle.
    towards = [[cosine, 0, sine, 0], [0, 1, 0, 0], [-sine, 0, cosine, 0], [0, 0, 0, 1]]
    for size, tolerance in ((0.0, 1e-3), (0.53, 3e-3)):
        scene = room(passed)
        scene.add_light("distant", (1000.0,) * 3, angle=size, transform=towards)
        assert lux(scene) == pytest.approx(1000.0 * cosine * transmittance(angle, passed), rel=tolerance), size


def test_an_even_sky_behind_a_pane():
    angles = np.radians(np.linspace(0.05, 89.95, 900))
    through = np.array([transmittance(math.degrees(angle), 1.0) for angle in angles])
    expected = math.pi * 1000.0 * np.sum(through * np.sin(2 * angles)) * math.radians(0.1)
    scene = room(1.0)
    scene.add_light("dome", (1000.0,) * 3)
    scene.set(samples=1024)
    assert lux(scene) == pytest.approx(expected, rel=0.01)
