"""Lamps inside solid glass and water: what leaves is told by flux, so pictures and meters see less of the lamp's radiance by the squared index."""

import math

import gonio
import numpy as np
import pytest
from small_scenes import above, at, ball, finished
from test_lamps_in_resin import LAMPS, LUMENS, cube, resin

CLEAR = dict(transmission_color=(1.0,) * 3, transmission_depth=0.0)
GLASS, WATER = 1.5, 1.33


def clear(scene, index):
    return resin(scene, specular_ior=index, **CLEAR)


def solid_ball(scene, radius, index):
    points, triangles = ball(128)
    scene.add_instance(scene.add_mesh(points * np.float32(radius), triangles, normals=points), [clear(scene, index)])


def passed(index):
    """What a face lets pass straight."""
    return 1 - ((index - 1) / (index + 1)) ** 2


@pytest.mark.parametrize(("integrator", "lamp", "part"), [("path", "sphere", 1.0), ("whitted", "sphere", 1.0), ("whitted", "mesh", 0.96)])
def test_pictures_show_lamps_less_by_the_squared_index(integrator, lamp, part):
    def seen(in_glass):
        scene = gonio.Scene()
        scene.set(width=4, height=4, samples=256, passes=["color"], integrator=integrator)
        LAMPS[lamp](scene, (0.0, 0.0, 0.0))
        if in_glass:
            solid_ball(scene, 0.1, GLASS)
        scene.add_camera(above(8), fov=0.01)
        return np.asarray(finished(scene)["color"])[..., :3].mean()

    assert seen(True) / seen(False) == pytest.approx(part / GLASS**2, rel=0.02)


def in_water(side):
    """A lamp, and half a metre under it a meter and a camera that looks up at it."""
    scene = gonio.Scene()
    scene.set(width=4, height=4, samples=64, passes=["color"])
    scene.add_light("sphere", radius=0.01, lumens=LUMENS)
    cube(scene, clear(scene, WATER), (0, 0, 0), side=side)
    return scene


def test_what_stands_in_the_same_water_sees_lamps_as_they_are():
    scene = in_water(40.0)
    scene.add_meter((0.0, -0.5, 0.0), normal=(0.0, 1.0, 0.0))
    scene.add_meter((0.0, -0.5, 0.0), facing=(0.0, 1.0, 0.0), quantity="luminance")
    illuminance, luminance = gonio.measure(scene, samples=256).meters
    candela, nits = LUMENS / (4 * math.pi), LUMENS / (4 * math.pi**2 * 0.01**2)
    assert illuminance.value == pytest.approx(candela / 0.5**2, rel=0.01)
    # Lamps block nothing: 2 % more comes from the far side of the water, with the noise of few samples.
    assert luminance.value == pytest.approx(nits, rel=0.05)
    scene.add_camera(above(0.5), fov=0.1)
    assert np.asarray(finished(scene)["color"])[..., :3].mean() == pytest.approx(nits, rel=0.05)


def test_meters_under_water_get_what_comes_from_above():
    scene = gonio.Scene()
    scene.add_light("sphere", radius=0.002, lumens=LUMENS, transform=at(0, 1.0, 0))
    cube(scene, clear(scene, WATER), (0, 0, 0), side=1.0)
    scene.add_meter((0.0, 0.2, 0.0), normal=(0.0, 1.0, 0.0))
    found = gonio.measure(scene, samples=1024).meters[0]
    # The lamp half a metre above the water, the meter 0.3 m under it: rays near the axis fan out less there.
    assert found.value == pytest.approx(LUMENS / (4 * math.pi) * passed(WATER) / (0.5 + 0.3 / WATER) ** 2, rel=0.015, abs=4 * found.standard_error)


def test_what_is_open_holds_no_lamp():
    scene = gonio.Scene()
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], "f4")
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3), (0, 4, 5, 1)]
    faces = np.array([half for a, b, c, d in quads for half in ((a, b, c), (a, c, d))], "i4")
    scene.add_instance(scene.add_mesh(corners, np.ascontiguousarray(faces[:10])), [clear(scene, GLASS)])
    LAMPS["sphere"](scene, (0.1, 0.2, 0.3))
    scene.add_meter((0.0, -3.0, 0.0), normal=(0.0, 1.0, 0.0))
    notes = [str(note) for note in gonio.measure(scene, samples=16).diagnostics]
    assert not any("index 1.500" in note for note in notes)
