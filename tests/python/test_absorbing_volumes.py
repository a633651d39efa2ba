"""Absorbing volumes against Beer's and Lambert's law: what cameras see through them, and what lights send through them."""

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, at, closure, finished

ABSORPTION = (0.3, 0.8, 1.5)
CORNERS = np.array([[x, y, z] for x in (-1, 1) for y in (0, 1) for z in (-1, 1)], "f4")
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
BOX = np.array([half for a, b, c, d in SIDES for half in ((a, b, c), (a, c, d))], "i4")


def filled(scene, *places, stretch=(1, 1, 1), closures=(), absorption=ABSORPTION):
    """Boxes of 2 m by 1 m by 2 m that stand at places and are full of what absorbs."""
    surface = list(closures) or [closure("Transparent", base_color=1.0)]
    material = scene.put_material({"origin": "filling", "closures": surface, "medium": {"absorption": list(absorption)}})
    mesh = scene.add_mesh(CORNERS * np.array(stretch, "f4"), BOX)
    for place in places:
        scene.add_instance(mesh, [material], transform=at(*place))


def shining_floor(**settings):
    """A floor of radiance 1, seen from 8 m above."""
    scene = gonio.Scene()
    scene.set(width=8, height=8, samples=16, passes=["color"], **settings)
    floor = scene.put_material({"origin": "floor", "closures": [closure("Emission", emission_color=1.0)]})
    scene.add_instance(scene.add_mesh(FLOOR, QUAD), [floor])
    scene.add_camera(above(8), fov=1)
    return scene


def seen(scene):
    return np.asarray(finished(scene)["color"])[..., :3].mean((0, 1))


def left(metres):
    return np.exp(-np.array(ABSORPTION) * metres)


@pytest.mark.parametrize("integrator", ["path", "whitted"])
def test_straight_light_is_absorbed(integrator):
    scene = shining_floor(integrator=integrator)
    filled(scene, (0, 1, 0))
    assert np.allclose(seen(scene), left(1.0), rtol=2e-4)


def test_volumes_that_overlap_add_up():
    scene = shining_floor()
    filled(scene, (0, 1, 0), (0, 1.5, 0), (0, 4, 0))
    assert np.allclose(seen(scene), left(3.0), rtol=5e-3)


@pytest.mark.parametrize("integrator", ["path", "whitted"])
def test_volumes_that_touch_add_up(integrator):
    """Where one ends another begins, at the same distance."""
    scene = shining_floor(integrator=integrator)
    filled(scene, (0, 1, 0), (0, 2, 0), (0, 3, 0))
    assert np.allclose(seen(scene), left(3.0), rtol=5e-3)


def test_what_a_cut_out_leaves_open_is_absorbed_too():
    scene = shining_floor()
    filled(scene, (0, 1, 0), closures=[closure("OpenPbr", geometry_opacity=0.0)])
    assert np.allclose(seen(scene), left(1.0), rtol=2e-4)


def test_without_absorption_nothing_is_lost():
    scene = shining_floor()
    filled(scene, (0, 1, 0), absorption=(0.0, 0.0, 0.0))
    assert np.array_equal(seen(scene), np.ones(3))


def lit_floor(light, box=None, **rest):
    """A white floor's middle, seen past a box from aside."""
    scene = gonio.Scene()
    scene.set(width=8, height=8, samples=64, passes=["color"], max_bounces=0)
    white = scene.put_material({"origin": "floor", "closures": [closure("Diffuse", base_color=1.0)]})
    scene.add_instance(scene.add_mesh(FLOOR, QUAD), [white])
    if box is not None:
        filled(scene, box, **rest)
    light(scene)
    # From 3 m aside of the middle, 1 m up, below boxes that stand higher.
    back = np.array([3.0, 1.0, 0.0]) / np.sqrt(10.0)
    right = np.array([0.0, 0.0, -1.0])
    up = np.cross(back, right)
    matrix = np.eye(4)
    matrix[:3, 0], matrix[:3, 1], matrix[:3, 2], matrix[:3, 3] = right, up, back, 0.8 * back * np.sqrt(10.0)
    scene.add_camera(matrix.tolist(), fov=0.5)
    return seen(scene)


def sun(scene):
    # Straight down.
    scene.add_light("distant", (3.0,) * 3, angle=0.5, transform=[[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]])


def lamp(scene):
    scene.add_light("sphere", (1000.0,) * 3, radius=0.02, transform=at(0, 4.5, 0))


@pytest.mark.parametrize("light", [sun, lamp])
def test_shadow_rays_are_dimmed(light):
    assert np.allclose(lit_floor(light, (0, 2, 0)) / lit_floor(light), left(1.0), rtol=2e-3)


def test_lights_within_are_dimmed_by_what_is_before_them():
    # The lamp's middle is half a metre above the lower side, what shines down some two thirds of its radius lower.
    assert np.allclose(lit_floor(lamp, (0, 4, 0)) / lit_floor(lamp), left(0.487), rtol=3e-3)


def test_surfaces_within_are_lit_through_it():
    # Lamp and floor are within: light goes 4.48 m to the floor, and 1.054 m from there to the box's side.
    around = {"stretch": (1, 9, 1), "absorption": (0.1, 0.2, 0.4)}
    expected = np.exp(-np.array(around["absorption"]) * (4.48 + 1.054))
    assert np.allclose(lit_floor(lamp, (0, -0.5, 0), **around) / lit_floor(lamp), expected, rtol=5e-3)


@pytest.mark.parametrize("integrator", ["path", "whitted"])
def test_a_camera_within_sees_through_what_it_stands_in(integrator):
    scene = shining_floor(integrator=integrator)
    # Full from 2 m above the floor to 9.5 m, so the camera looks through 6 m of it.
    filled(scene, (0, 2, 0), stretch=(1, 7.5, 1), absorption=(0.05, 0.1, 0.2))
    assert np.allclose(seen(scene), np.exp(-np.array((0.05, 0.1, 0.2)) * 6.0), rtol=2e-4)


def test_bodies_around_the_camera_add_up_and_those_beside_it_do_not():
    scene = shining_floor()
    filled(scene, (0, 2, 0), stretch=(1, 7.5, 1), absorption=(0.05, 0.1, 0.2))
    filled(scene, (0, 4, 0), stretch=(1, 4.5, 1), absorption=(0.1, 0.0, 0.05))
    # Above the camera and beside it.
    filled(scene, (0, 9, 0), (3, 6, 0), stretch=(1, 4, 1), absorption=(5.0, 5.0, 5.0))
    expected = np.exp(-(np.array((0.05, 0.1, 0.2)) * 6.0 + np.array((0.1, 0.0, 0.05)) * 4.0))
    assert np.allclose(seen(scene), expected, rtol=2e-4)


def test_weak_fog_is_still_there_behind_what_is_dense():
    scene = shining_floor()
    filled(scene, (0, 0, 0), stretch=(1, 9, 1), absorption=(0.01, 0.02, 0.04))
    # A millimetre that swallows a part in e.
    filled(scene, (0, 4, 0), stretch=(0.9, 0.001, 0.9), absorption=(1000.0,) * 3)
    assert np.allclose(seen(scene), np.exp(-1.0 - 8.0 * np.array((0.01, 0.02, 0.04))), rtol=1e-3)


RESIN = {"specular_ior": 1.0, "transmission_weight": 1.0, "transmission_color": (0.5, 0.5, 0.5), "transmission_depth": 0.5}


@pytest.mark.parametrize("elsewhere", [(), (ABSORPTION,)], ids=["alone", "a volume elsewhere"])
def test_solids_are_what_they_are_whatever_else_there_is(elsewhere):
    def below(y, **parameters):
        scene = shining_floor()
        filled(scene, (0, y, 0), closures=[closure("OpenPbr", **RESIN, **parameters)], absorption=(0.0,) * 3)
        for absorption in elsewhere:
            filled(scene, (5, 1, 0), absorption=absorption)
        return seen(scene)

    assert np.allclose(below(1), 0.25, rtol=2e-4)
    # What goes straight on through a cut-out is not bent into it.
    assert np.allclose(below(1, geometry_opacity=0.0), 1.0, rtol=1e-6)
    # A thin wall in it changes nothing of what lies behind.
    scene = shining_floor()
    filled(scene, (0, 1, 0), stretch=(1, 3, 1), closures=[closure("OpenPbr", **RESIN)], absorption=(0.0,) * 3)
    wall = scene.add_material("wall", thin_walled=True, transmission_weight=1.0, specular_ior=1.0, specular_roughness=0.0)
    scene.add_instance(scene.add_mesh(0.1 * FLOOR, QUAD), [wall], transform=at(0, 2.5, 0))
    assert np.allclose(seen(scene), 1 / 64, rtol=5e-4)
    # A volume within a solid, and a solid within a volume.
    scene = shining_floor()
    filled(scene, (0, 1, 0), stretch=(1, 3, 1), closures=[closure("OpenPbr", **RESIN)], absorption=(0.0,) * 3)
    filled(scene, (0, 2, 0), stretch=(0.9, 1, 0.9))
    assert np.allclose(seen(scene), left(1.0) / 64.0, rtol=5e-4)


@pytest.mark.parametrize("elsewhere", [False, True])
def test_an_open_sheet_of_resin_does_not_blacken_the_sky(elsewhere):
    scene = gonio.Scene()
    scene.set(width=8, height=8, samples=16, passes=["color"])
    sheet = scene.put_material({"origin": "sheet", "closures": [closure("OpenPbr", **RESIN)]})
    scene.add_instance(scene.add_mesh(FLOOR, QUAD), [sheet])
    if elsewhere:
        filled(scene, (50, 1, 0))
    scene.add_light("dome", (1.0,) * 3)
    scene.add_camera(above(8), fov=1)
    assert np.allclose(seen(scene), 1.0, rtol=1e-5)


@pytest.mark.parametrize("integrator", ["path", "whitted"])
def test_what_dims_straight_light_covers_what_is_behind(integrator):
    """A picture over a background shows it as dim as it is behind the glass: alpha is what does not pass, in the mean of the channels."""

    def alpha(*fill, **rest):
        scene = gonio.Scene()
        scene.set(width=8, height=8, samples=256, passes=["color"], integrator=integrator)
        filled(scene, (0, 1, 0), *fill, **rest)
        scene.add_camera(above(8), fov=1)
        return np.asarray(finished(scene)["color"])[..., 3].mean()

    tint = np.array([0.9, 0.5, 0.1])
    pane = {"closures": [closure("Transparent", base_color=(0.9, 0.5, 0.1))], "absorption": (0.0,) * 3}
    assert alpha() == pytest.approx(1 - left(1.0).mean(), rel=1e-3)
    # Into the box and out of it.
    assert alpha(**pane) == pytest.approx(1 - (tint**2).mean(), rel=1e-3)
    assert alpha(closures=[closure("Transparent", base_color=1.0)], absorption=(0.0,) * 3) == pytest.approx(0, abs=1e-6)


def lamp_over(box):
    """A meter on the floor, faced by a small lamp 4 m above it, in a box if there is one."""
    scene = gonio.Scene()
    scene.set(samples=256, max_bounces=0)
    scene.add_light("sphere", (1000.0,) * 3, radius=0.02, transform=at(0, 4, 0))
    if box is not None:
        filled(scene, box, stretch=(1, 3, 1))
    scene.add_meter((0.0, 0.0, 0.0), normal=(0.0, 1.0, 0.0))
    return gonio.measure(scene).meters[0].value


def test_meters_within_are_dimmed_by_what_they_stand_in():
    # Full from half a metre below the meter to 2.5 m above it; absorption weighs as luminance does.
    weights = np.array((0.2126, 0.7152, 0.0722))
    assert lamp_over((0, -0.5, 0)) / lamp_over(None) == pytest.approx(float(weights @ left(2.5)), rel=5e-3)


@pytest.mark.parametrize("integrator", ["path", "whitted"])
def test_thin_walls_enclose_nothing(integrator):
    """A sheet that is tinted once tints nothing that lies behind it once more."""
    seen_through = []
    for depth in (0.0, 0.01):
        scene = shining_floor(integrator=integrator)
        sheet = scene.add_material(
            "sheet", thin_walled=True, transmission_weight=1.0, transmission_color=(0.5,) * 3, transmission_depth=depth, specular_roughness=0.0
        )
        scene.add_instance(scene.add_mesh(FLOOR, QUAD), [sheet], transform=at(0, 1, 0))
        seen_through.append(seen(scene))
    assert seen_through[0].min() > 0.3
    assert np.allclose(*seen_through, rtol=1e-3)
