"""What media keep: even light in furnaces and in balance, and the flux of lamps that the goniophotometer measures."""

import math

import confidence
import gonio
import media_oracles as oracles
import numpy
import pytest
from fog import box, fill, hold, looking, pictures
from small_scenes import ball

pytestmark = pytest.mark.validate


def furnace(body, scene):
    """Puts what only scatters in the camera's way."""
    parts = {"scattering": (0.5, 1.0, 4.0), "anisotropy": 0.3}
    if body == "sphere":
        fill(scene, *ball(64), **parts)
    elif body == "box":
        box(scene, (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0), **parts)
    else:
        place = [[1, 0, 0, -1.0], [0, 1, 0, -0.55], [0, 0, 1, -0.45], [0, 0, 0, 1]]
        scene.add_volume(oracles.smooth((20, 11, 9)), scattering=(0.5, 2.0, 8.0), anisotropy=0.3, voxel=0.1, transform=place)


@pytest.mark.parametrize("body", ["sphere", "box", "grid"])
def test_white_furnace(body):
    scene = looking((0.0, 0.0, 5.0), (0.0, 0.0, 0.0), size=32, up=(0.0, 1.0, 0.0), degrees=9.0)
    scene.add_light("dome")
    furnace(body, scene)
    found = pictures(scene, 128)
    hold(f"white furnace: {body} that only scatters, even light", "1", found.mean(axis=1), [1.0] * 3)
    # No sparks: a single pixel of a render within ten standard errors of it.
    assert (found.max(axis=(0, 1)) < 1.0 + 10.0 * found.std(axis=(0, 1))).all(), (found.max(axis=(0, 1)), found.std(axis=(0, 1)))


@pytest.mark.parametrize(("even", "varying"), [(0.1, 0.0), (0.0, 0.3), (0.1, 0.3)])
def test_in_balance_with_even_light(even, varying):
    """Where media send what they absorb of even light of 1, and scatter besides, there is light of 1 everywhere (Kirchhoff)."""
    scene = looking((1.0, 1.0, 9.0), (1.0, 1.0, 0.0), up=(0.0, 1.0, 0.0))
    scene.add_light("dome")
    box(scene, (-1.0, -1.0, 0.0), (3.0, 3.0, 2.0), absorption=even, scattering=0.4, emission=even)
    scene.add_volume(numpy.ones((2, 2, 2), "f4"), scattering=0.2, absorption=varying, emission=varying)
    case = f"haze and a grid that send what they absorb, {even:g} and {varying:g} a metre, even light"
    hold(case, "1 (Kirchhoff)", pictures(scene, 256).mean(axis=(1, 2))[:, None], [1.0])


def ratio(scene, rays):
    """Light output ratio with each seed."""
    return numpy.array([[gonio.goniometer(scene, rays=rays, error=0, seed=seed).light_output_ratio.value] for seed in confidence.SEEDS])


@pytest.mark.parametrize("body", ["ball", "cube"])
def test_goniophotometer_of_a_lamp_in_what_absorbs(body):
    absorption = 0.7236
    scene = gonio.Scene()
    scene.add_light("point")
    if body == "ball":
        fill(scene, *ball(256), absorption=absorption)
        expected, reference = math.exp(-absorption), "e^(−σ r)"
    else:
        box(scene, (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0), absorption=absorption)
        expected, reference = oracles.left_in_a_box(absorption, 1.0), "mean of e^(−σ d) over all directions"
    case = f"goniophotometer: lamp in a {body} that absorbs, light output ratio {100 * expected:.1f} %"
    hold(case, reference, ratio(scene, 200_000), [expected])


@pytest.mark.parametrize("g", [0.0, 0.7])
def test_goniophotometer_of_a_lamp_in_what_scatters(g):
    scene = gonio.Scene()
    scene.add_light("point")
    fill(scene, *ball(64), scattering=3.0, anisotropy=g)
    hold(f"goniophotometer: lamp in a ball that scatters, g {g:g}, light output ratio", "1", ratio(scene, 50_000), [1.0], 1e-3)
