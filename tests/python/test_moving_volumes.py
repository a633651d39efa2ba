"""Volumes that move and flow while the shutter is open, against quadrature over the time."""

import math

import gonio
import numpy as np
import pytest
from test_fields import depth, smooth, value
from test_media import looking, seen, within

COEFFICIENTS = {"scattering": 0.0, "absorption": 0.2}
START, END = np.array((5.3, 4.2, 0.0)), np.array((5.3, 4.2, 9.0))
TIMES = (np.arange(32) + 0.5) / 32


def lit():
    """A scene that looks along one line at an even sky."""
    scene = looking((5.3, 4.2, 20.0), (5.3, 4.2, 0.0))
    scene.add_light("dome")
    return scene


def shifted(x, y=0.0, z=0.0):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def turned(angle):
    sin, cos = math.sin(angle), math.cos(angle)
    return [[cos, -sin, 0, 0], [sin, cos, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def padded():
    """A smooth array with nothing about it."""
    return np.pad(smooth((12, 9, 9)), 4)


def test_what_is_moved_is_dimmed_as_at_each_time():
    array = smooth((20, 11, 9))
    expected = np.mean([math.exp(-0.2 * depth(array, START - (4.0 * t - 2.0, 0, 0), END - (4.0 * t - 2.0, 0, 0), 500)) for t in TIMES])
    scene = lit()
    scene.add_volume(array, motion=[shifted(-2.0), shifted(2.0)], transform=shifted(0.0), **COEFFICIENTS)
    found, error = seen(scene, 1024)
    within(found.mean(), error, expected)


def test_what_is_turned_is_dimmed_as_at_each_time():
    array = smooth((20, 11, 9))

    def at(t):
        back = np.array(turned(-(0.6 * t - 0.3)))[:3, :3]
        return math.exp(-0.2 * depth(array, back @ START, back @ END, 500))

    scene = lit()
    scene.add_volume(array, motion=[turned(-0.3), turned(0.0), turned(0.3)], **COEFFICIENTS)
    found, error = seen(scene, 1024)
    within(found.mean(), error, np.mean([at(t) for t in TIMES]))


@pytest.mark.parametrize("rests", [0.0, 0.5])
def test_even_flows_are_motions(rests):
    array = padded()
    ways = [3.0 * (t - rests) for t in TIMES]
    start, end = np.array((8.3, 8.2, 0.0)), np.array((8.3, 8.2, 17.0))
    expected = np.mean([math.exp(-0.2 * depth(array, start - (way, 0, 0), end - (way, 0, 0), 500)) for way in ways])
    scene = looking((8.3, 8.2, 30.0), (8.3, 8.2, 0.0))
    scene.add_light("dome")
    scene.add_volume(
        array, velocity=np.broadcast_to(np.float32([6.0, 0.0, 0.0]), (*array.shape, 3)).copy(), shutter_s=0.5, rests=rests, **COEFFICIENTS
    )
    found, error = seen(scene, 1024)
    within(found.mean(), error, expected)


def test_flows_that_vary_are_followed_back_twice():
    """What is at a place came from there by the flow of where the flow at the place leads back to."""
    array = padded()
    axes = np.meshgrid(*[np.arange(n) + 0.5 for n in array.shape], indexing="ij")
    velocity = np.stack([4.0 * np.sin(0.3 * axes[2]), 2.0 * np.cos(0.2 * axes[0]), 0.0 * axes[0]], axis=-1).astype("f4")

    def along(at):
        return np.array([value(velocity[..., axis], at) for axis in range(3)])

    def density(place, since):
        near = place - since * along(place)
        return value(array, place - since * along(near))

    places = [np.array((8.3, 8.2, z)) for z in (np.arange(170) + 0.5) / 10]
    expected = np.mean([math.exp(-0.2 * 0.1 * sum(density(place, t - 0.5) for place in places)) for t in TIMES[::2] + 0.5 / 32])
    scene = looking((8.3, 8.2, 30.0), (8.3, 8.2, 0.0))
    scene.add_light("dome")
    scene.add_volume(array, velocity=velocity, shutter_s=1.0, **COEFFICIENTS)
    found, error = seen(scene, 1024)
    within(found.mean(), error, expected)


def test_light_to_a_place_is_dimmed_by_what_moves():
    """Shadow rays have the times of their paths."""
    found = []
    for keys in ([shifted(-6.0), shifted(6.0)], None):
        scene = gonio.Scene()
        scene.add_camera(gonio.look_at((0, 0, 3), (0, 0, 0), (0, 1, 0)), fov=0.02)
        scene.set(width=8, height=8, filter="box", seed=3, max_bounces=0)
        floor = scene.add_mesh(np.float32([(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)]), np.int32([(0, 1, 2), (0, 2, 3)]))
        scene.add_instance(floor, [scene.add_material(base_color=(0.5,) * 3, specular_weight=0.0)])
        scene.add_light("distant", (math.pi,) * 3, transform=gonio.look_at((10, 0, 10), (0, 0, 0), (0, 1, 0)))
        place = {"motion": keys, "transform": shifted(0.0)} if keys else {"transform": shifted(500.0)}
        moved = [np.array(key) @ np.array(shifted(4.0, -2.0, 4.0)) for key in keys or []]
        scene.add_volume(
            np.ones((2, 4, 2), "f4"),
            transform=np.array(place["transform"]) @ np.array(shifted(4.0, -2.0, 4.0)),
            motion=moved,
            **COEFFICIENTS,
        )
        found.append(seen(scene, 1024))
    (moving, error), (clear, _) = found
    # The box is 2 m long along x, and 12 m in the time: the way through it is up to 2√2 m long.
    steps = np.linspace(-6.0, 6.0, 20001)
    ways = np.array([max(0.0, min(6.0, 6.0 + s) - max(4.0, 4.0 + s)) for s in steps]) * math.sqrt(2.0)
    within(moving.mean(), error, clear.mean() * np.exp(-0.2 * ways).mean())


def test_a_furnace_of_smoke_that_flows_and_moves():
    array = padded()
    axes = np.meshgrid(*[np.arange(n) + 0.5 for n in array.shape], indexing="ij")
    velocity = np.stack([5.0 * np.sin(0.3 * axes[2]), 4.0 * np.cos(0.2 * axes[0]), 3.0 * np.sin(0.4 * axes[1])], axis=-1).astype("f4")
    scene = looking((10.0, 8.0, 40.0), (10.0, 8.0, 0.0), degrees=40.0, size=16)
    scene.add_light("dome")
    scene.add_volume(
        array, velocity=velocity, shutter_s=1.0, motion=[turned(-0.1), turned(0.1)], scattering=[0.5, 2.0, 5.0], anisotropy=0.3
    )
    found, error = seen(scene, 256)
    assert found == pytest.approx([1.0] * 3, abs=0.01) and error < 0.003


def test_heat_flows_with_its_density():
    """Flames that flow evenly by their own size shine in the mean over all of the way."""
    array = np.zeros((16, 4, 4), "f4")
    array[6:8] = 1.0
    flow = np.broadcast_to(np.float32([8.0, 0.0, 0.0]), (*array.shape, 3)).copy()
    scene = looking((8.0, 2.0, 20.0), (8.0, 2.0, 0.0))
    scene.add_volume(array, heat=array, scattering=0.0, absorption=0.0, emission=3.0, velocity=flow, shutter_s=1.0)
    found, error = seen(scene, 1024)
    ways = 8.0 * (np.arange(4000) + 0.5) / 4000 - 4.0
    expected = 3.0 * 4.0 * np.mean([value(array, (8.0 - way, 2.0, 2.0)) for way in ways])
    within(found.mean(), error, expected)


def test_without_blur_nothing_flows():
    found = []
    for velocity in (None, np.ones((20, 11, 9, 3), "f4")):
        scene = lit()
        scene.add_volume(smooth((20, 11, 9)), velocity=velocity, **COEFFICIENTS)
        found.append(seen(scene, 1024, motion_blur=False))
    (still, error), (flowing, other) = found
    assert flowing.mean() == pytest.approx(still.mean(), abs=4.0 * math.hypot(error, other))


def test_one_field_in_several_things_stands_still_and_says_so():
    scene = lit()
    scene.add_volume(smooth((20, 11, 9)), **COEFFICIENTS)
    described = scene.to_dict()["instances"][0]
    place = np.array([np.eye(4)] * 2)
    scene.put_instances(
        described["mesh"], described["materials"], place, motion=np.stack([place, place + np.eye(4)[:, ::-1] * 0.1]), index=0
    )
    scene.set(samples=1)
    with gonio.Render(scene) as render:
        assert render.wait() and any("2 things that move" in text for _, text in render.diagnostics)


def test_bad_velocities():
    with pytest.raises(ValueError, match="flow"):
        lit().add_volume(smooth((4, 4, 4)), velocity=np.ones((4, 4, 5, 3), "f4"))
    with pytest.raises(gonio.SettingError, match="no_such"):
        lit().add_volume(("no_such.vdb", "density"), velocity="v")
