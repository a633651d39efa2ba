"""Motion blur: held to the mean of pictures of single moments, and to closed forms."""

import math

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, at, finished

FRAMES = 64
REPEATS = 4
CUBE = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)], "f4")
FACES = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
SIDES = np.array([corners for a, b, c, d in FACES for corners in ((a, b, c), (a, c, d))], "i4")
FLAT = np.array([[-1, 0, -1], [-1, 0, 1], [1, 0, 1], [1, 0, -1]], "f4")


def turned(angle, place=(0.0, 0.0, 0.0), size=1.0):
    """A turn about the y axis by radians."""
    sin, cos = math.sin(angle) * size, math.cos(angle) * size
    return [[cos, 0, sin, place[0]], [0, size, 0, place[1]], [-sin, 0, cos, place[2]], [0, 0, 0, 1]]


def camera_at(turn, place):
    """A camera that looks down and is turned about its axis."""
    return (np.array(at(*place)) @ np.array(turned(turn)) @ np.array(above(0.0))).tolist()


def bar(bend):
    """A long bar whose upper points move aside."""
    points = CUBE * np.array([3.0, 0.6, 0.4], "f4")
    points[points[:, 1] > 0.0, 2] += np.float32(bend)
    return points


# By kind: what is where at a share of the shutter's time, and the keys that say so.
KINDS = {
    "camera moves": {"camera": lambda t: camera_at(0.0, (1.5 * t - 0.75, 8.0, 0.4 * t))},
    "camera turns": {"camera": lambda t: camera_at(0.5 * t, (0.0, 8.0, 0.0)), "keys": 3},
    "instance moves": {"cube": lambda t: at(3.0 * t - 1.5, 0.8, 0.3)},
    "instance turns": {"cube": lambda t: turned(0.5 * math.pi * t, (0.5, 0.8, 0.0), 1.3)},
    "instance turns in parts": {"cube": lambda t: turned(2.5 * t, (0.5, 0.8, 0.0), 1.3), "keys": 5},
    "instance grows": {"cube": lambda t: turned(0.3, (0.5, 0.8, 0.0), 0.4 + 1.4 * t)},
    "shape changes": {"points": lambda t: bar(1.6 * t - 0.8)},
    "lamp moves": {"lamp": lambda t: at(3.0 * t - 1.5, 2.5, 0.0)},
}


def scene_of(kind, moment=None, samples=16, **settings):
    """The scene at a moment, or blurred."""
    chosen = KINDS[kind]
    times = [0.5] if moment is not None else [k / (chosen.get("keys", 2) - 1) for k in range(chosen.get("keys", 2))]

    def placed(name, usual):
        if name not in chosen:
            return {"transform": usual}
        return {"transform": chosen[name](moment)} if moment is not None else {"motion": [chosen[name](t) for t in times]}

    made = gonio.Scene()
    made.set(width=32, height=32, samples=samples, passes=["color"], filter="box", filter_width=1.0, max_bounces=2, **settings)
    grey = made.add_material("grey", base_color=(0.6, 0.6, 0.6), specular_weight=0.0)
    red = made.add_material("red", base_color=(0.8, 0.2, 0.1), specular_weight=0.0)
    made.add_instance(made.add_mesh(FLOOR, QUAD, name="floor"), [grey], name="floor")
    points, moved = CUBE, None
    if "points" in chosen:
        points = chosen["points"](0.5 if moment is None else moment)
        moved = None if moment is not None else np.concatenate([chosen["points"](t) for t in times])
    cube = made.add_mesh(points, SIDES, motion=moved, name="cube")
    made.add_instance(cube, [red], name="cube", **placed("cube", at(0.6, 0.8, 0.0)))
    made.add_light("sphere", (60.0, 60.0, 60.0), radius=0.3, visible=False, name="lamp", **placed("lamp", at(0.0, 4.0, 0.0)))
    made.add_light("dome", (0.3, 0.3, 0.3), name="sky")
    made.add_camera(fov=40, **placed("camera", above(8.0)))
    return made


def blocks(picture, side=4):
    """Means of blocks of pixels."""
    seen = np.asarray(picture["color"])[..., :3].astype(float)
    height, width, channels = seen.shape
    return seen.reshape(height // side, side, width // side, side, channels).mean(axis=(1, 3))


@pytest.mark.parametrize("kind", KINDS)
def test_blur_is_the_mean_of_moments(kind):
    blurred = np.stack([blocks(finished(scene_of(kind, samples=256, seed=seed))) for seed in range(REPEATS)])

    def moment(frame, seed):
        return blocks(finished(scene_of(kind, (frame + 0.5) / FRAMES, 8, seed=1000 + seed * FRAMES + frame)))

    moments = np.stack([np.mean([moment(frame, seed) for frame in range(FRAMES)], axis=0) for seed in range(REPEATS)])
    spread = np.sqrt((blurred.var(axis=0, ddof=1) + moments.var(axis=0, ddof=1)) / REPEATS)
    # Sixty-four moments stand for all: an edge that moves by a pixel a moment is off by a part of a step.
    spread = np.maximum(spread, 0.004 * moments.mean())
    away = (blurred.mean(axis=0) - moments.mean(axis=0)) / spread
    # Four pictures of either kind: Student's t of six degrees of freedom has a variance of 1.5.
    assert np.sqrt(np.mean(away**2)) < 1.6, np.abs(away).max()
    still = blocks(finished(scene_of(kind, 0.5, 64)))
    assert np.abs(still - moments.mean(axis=0)).max() > 10 * np.median(spread)


def sideways(motion, samples=1024, **settings):
    """A shining card of two by two metres over black, seen from above in parallel at four pixels a metre."""
    made = gonio.Scene()
    made.set(width=32, height=8, samples=samples, passes=["color"], filter="box", filter_width=1.0, **settings)
    shining = made.add_material("shining", base_color=(0.0, 0.0, 0.0), specular_weight=0.0, emission_color=(1.0, 1.0, 1.0))
    made.add_instance(made.add_mesh(FLAT, QUAD), [shining], motion=motion)
    camera = gonio.Scene()
    camera.add_camera(above(5.0))
    described = {**camera.to_dict()["cameras"][0], "projection": "Orthographic", "aperture": [8.0, 2.0]}
    made.set(camera=made.put_camera(described))
    return np.asarray(finished(made)["color"])[4, :, 0]


def covered(places, weights=None):
    """Shares of the pixels of a row that the card covers while its middle is at these places, metres."""
    edges = np.arange(33) / 4.0 - 4.0
    left, right = places[:, None] - 1.0, places[:, None] + 1.0
    share = np.clip(np.minimum(edges[1:], right) - np.maximum(edges[:-1], left), 0.0, None) * 4.0
    return np.average(share, axis=0, weights=weights)


TIMES = (np.arange(20000) + 0.5) / 20000


def test_a_card_that_moves_evenly_covers_what_it_should():
    seen = sideways([at(-2.0, 0, 0), at(2.0, 0, 0)])
    assert seen.max() > 0.4
    assert np.abs(seen / covered(np.zeros(1)).max() - covered(4.0 * TIMES - 2.0)).max() < 0.01


def test_keys_are_evenly_spaced():
    seen = sideways([at(-2.0, 0, 0), at(-2.0, 0, 0), at(2.0, 0, 0)])
    assert np.abs(seen - covered(np.interp(TIMES, [0.0, 0.5, 1.0], [-2.0, -2.0, 2.0]))).max() < 0.01


def test_the_shutter_may_be_open_for_a_part():
    seen = sideways([at(-2.0, 0, 0), at(2.0, 0, 0)], shutter=(0.25, 0.5))
    assert np.abs(seen - covered(np.linspace(-1.0, 0.0, 20001))).max() < 0.01


def test_the_shutters_curve_weighs_times():
    seen = sideways([at(-2.0, 0, 0), at(2.0, 0, 0)], shutter_curve=[0.0, 1.0, 0.0])
    assert np.abs(seen - covered(4.0 * TIMES - 2.0, np.minimum(TIMES, 1.0 - TIMES))).max() < 0.01


def test_a_rolling_shutter_shows_rows_one_after_the_other():
    made = gonio.Scene()
    made.set(width=32, height=32, samples=16, passes=["color"], filter="box", filter_width=1.0, row_exposure=0.0)
    shining = made.add_material("shining", base_color=(0.0, 0.0, 0.0), specular_weight=0.0, emission_color=(1.0, 1.0, 1.0))
    tall = made.add_mesh(FLAT * np.array([0.5, 1.0, 20.0], "f4"), QUAD)
    made.add_instance(tall, [shining], motion=[at(-3.0, 0, 0), at(3.0, 0, 0)])
    made.add_camera(above(8.0), fov=53.13)
    seen = np.asarray(finished(made)["color"])[..., 0]
    middles = (seen * np.arange(32)).sum(axis=1) / seen.sum(axis=1)
    assert np.all(np.diff(middles) > 0.0)
    assert middles[31] - middles[0] == pytest.approx(31 / 32 * 6.0 * 4.0, abs=0.7)


def test_threads_do_not_show():
    one, three = (np.asarray(finished(scene_of("instance turns", threads=threads))["color"]) for threads in (1, 3))
    assert one.tobytes() == three.tobytes()


def test_what_stands_still_is_as_ever():
    plain = np.asarray(finished(scene_of("instance moves", 0.5))["color"])
    for settings in ({"shutter": (0.0, 0.5)}, {"motion_blur": False}, {"shutter_curve": [0.0, 1.0, 0.0]}, {"row_exposure": 0.2}):
        assert np.asarray(finished(scene_of("instance moves", 0.5, **settings))["color"]).tobytes() == plain.tobytes()


def test_blur_can_be_switched_off():
    blurred = finished(scene_of("camera turns", motion_blur=False))
    assert np.asarray(blurred["color"]).tobytes() == np.asarray(finished(scene_of("camera turns", 0.5))["color"]).tobytes()


def test_an_instance_that_shines_and_moves_lights():
    def made(moment=None, seed=0):
        scene = gonio.Scene()
        scene.set(width=8, height=8, samples=1024 if moment is None else 16, passes=["color"], max_bounces=1, seed=seed)
        grey = scene.add_material("grey", base_color=(0.6, 0.6, 0.6), specular_weight=0.0)
        shining = scene.add_material("shining", base_color=(0.0, 0.0, 0.0), specular_weight=0.0, emission_color=(5.0, 5.0, 5.0))
        scene.add_instance(scene.add_mesh(FLOOR, QUAD), [grey])
        lamp = scene.add_mesh(FLAT, QUAD)
        place = {"motion": [at(-3, 2, 0), at(3, 2, 0)]} if moment is None else {"transform": at(6 * moment - 3, 2, 0)}
        scene.add_instance(lamp, [shining], **place)
        scene.add_camera(above(1.5), fov=60)
        return np.asarray(finished(scene)["color"])[..., 0].mean()

    moments = np.mean([made((frame + 0.5) / FRAMES, frame) for frame in range(FRAMES)])
    assert made() == pytest.approx(moments, rel=0.03)


@pytest.mark.parametrize(
    ("motion", "problem"),
    [
        ([at(0, 0, 0)], "one motion key"),
        ([at(0, 0, 0), at(math.nan, 0, 0)], "not finite"),
    ],
)
def test_keys_that_cannot_be_used_are_told(motion, problem):
    scene = scene_of("camera moves", 0.5)
    cube = scene.add_mesh(CUBE, SIDES, name="odd")
    scene.add_instance(cube, transform=at(1, 1, 1), motion=motion, name="odd")
    with gonio.Render(scene) as render:
        assert render.wait()
        assert np.isfinite(np.asarray(render.film()["color"])).all()
        assert any("odd" in str(line) and problem in str(line) for line in render.diagnostics), render.diagnostics


def test_other_numbers_of_matrices_are_refused():
    scene = gonio.Scene()
    mesh = scene.add_mesh(CUBE, SIDES)
    with pytest.raises(gonio.SettingError, match="motion"):
        scene.put_instances(mesh, [], np.stack([np.eye(4)] * 2), motion=np.stack([np.eye(4)] * 3))
    with pytest.raises(ValueError, match="motion"):
        scene.add_mesh(CUBE, SIDES, motion=np.zeros((9, 3), "f4"))
