"""A hall of 100 identical bays with five IES luminaires each, seen from one of them: what it costs beside that bay alone.

Cost is the relative variance of a picture times the processor time of its samples, as in tests/peers/render/cost.py. Both scenes are rendered with
the same samples in turns, two seeds a round; what counts is the median over rounds of the ratio. The figures are printed: `pytest -s`.
"""

import itertools
import math
import statistics
import time

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")

pytestmark = [pytest.mark.validate, pytest.mark.timeout(1800)]

SIDE, HEIGHT, BAYS = 6.0, 3.2, 10
# The hall may cost so many times the bay.
MOST = 2.0
ROUNDS, SAMPLES, SIZE = 5, 64, (192, 128)
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
# The share of pixels with the most variance that is left out, in both alike: fireflies.
OUTLIERS = 0.001


def luminaire() -> bytes:
    """A recessed panel of 0.6 m by 0.6 m with batwings, about 3500 lm: I = 1000 cos γ (1 + w sin² 2γ) cd, w from 0.6 in C0 to 1 in C90."""
    gammas = [5.0 * k for k in range(19)]
    head = "IESNA:LM-63-2002\n[LUMINAIRE] Panel\nTILT=NONE\n1 -1 1 19 3 1 2 0.6 0.6 0\n1 1 32"
    rows = [gammas, [0.0, 45.0, 90.0]]
    for wings in (0.6, 0.8, 1.0):
        angles = [math.radians(gamma) for gamma in gammas]
        rows.append([max(0.0, 1000 * math.cos(angle)) * (1 + wings * math.sin(2 * angle) ** 2) for angle in angles])
    return "\n".join([head, *(" ".join(f"{value:.3f}" for value in row) for row in rows)]).encode()


def placed(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def quad(scene, material, corners):
    mesh = scene.add_mesh(np.array(corners, "f4"), np.array([[0, 1, 2], [0, 2, 3]], "u4"))
    scene.add_instance(mesh, [material])


def wall(scene, material, start, end):
    """Upright, seen from both sides."""
    (x0, y0), (x1, y1) = start, end
    quad(scene, material, [(x0, y0, 0), (x1, y1, 0), (x1, y1, HEIGHT), (x0, y0, HEIGHT)])


def built(bays: int, *, is_open: bool):
    """A square of bays with walls around it, and between the bays if it is not open; the camera stands in the middle one, about the origin."""
    scene = gonio.Scene()
    scene.set(width=SIZE[0], height=SIZE[1], samples=SAMPLES, max_bounces=8, passes=["color"], filter="box", filter_width=1.0)
    floor, white = (scene.add_material(name, base_color=colour) for name, colour in (("floor", (0.3,) * 3), ("white", (0.7,) * 3)))
    low = -SIDE * (bays // 2) - SIDE / 2
    high = low + SIDE * bays
    quad(scene, floor, [(low, low, 0), (high, low, 0), (high, high, 0), (low, high, 0)])
    quad(scene, white, [(low, low, HEIGHT), (low, high, HEIGHT), (high, high, HEIGHT), (high, low, HEIGHT)])
    edges = [low, high] if is_open else [low + SIDE * k for k in range(bays + 1)]
    for edge in edges:
        wall(scene, white, (edge, low), (edge, high))
        wall(scene, white, (low, edge), (high, edge))
    lamp, warnings = gonio.read_goniogram(luminaire(), "panel.ies")
    assert warnings == []
    for column, row in itertools.product(range(bays), repeat=2):
        x, y = (SIDE * (number - bays // 2) for number in (column, row))
        for dx, dy in ((-1.7, -1.7), (1.7, -1.7), (0, 0), (-1.7, 1.7), (1.7, 1.7)):
            scene.add_light("luminaire", goniogram=lamp, transform=placed(x + dx, y + dy, HEIGHT - 0.02))
    desk = np.array([(-1, -0.5, 0.75), (1, -0.5, 0.75), (1, 0.5, 0.75), (-1, 0.5, 0.75)], "f4")
    quad(scene, white, desk)
    scene.add_camera(looking((2.4, 2.4, 1.7), (0.0, 0.0, 0.9)), fov=65.0)
    return scene


def looking(eye, target):
    """From a corner of the bay, at an eye's height, towards the other; z is up."""
    back = np.subtract(eye, target) / np.linalg.norm(np.subtract(eye, target))
    right = np.cross((0, 0, 1), back) / np.linalg.norm(np.cross((0, 0, 1), back))
    return [*np.column_stack([right, np.cross(back, right), back, eye]).tolist(), [0, 0, 0, 1]]


class Entrant:
    """A scene laid out, and its pictures."""

    def __init__(self, scene):
        self.scene = scene
        self.render = gonio.Render(scene)
        self.render.wait()

    def picture(self, seed):
        """Luminances, and the processor's seconds of the samples."""
        self.scene.set(seed=seed)
        render = gonio.Render(self.scene, previous=self.render)
        start = time.process_time()
        render.wait()
        seconds = time.process_time() - start
        self.render = render
        return np.asarray(render.film()["color"])[..., :3].astype("f8") @ LUMINANCE, seconds


def cost(first, second, known):
    """Relative variance and seconds of two pictures with different seeds."""
    variance = np.sort((0.5 * ((first[0] - second[0]) / known) ** 2).ravel())
    kept = variance.size - round(OUTLIERS * variance.size)
    return variance[:kept].mean(), 0.5 * (first[1] + second[1])


def measured(*, is_open):
    """Ratios of the hall to the bay: relative variance, processor time, and their product."""
    entrants = [Entrant(built(BAYS, is_open=is_open)), Entrant(built(1, is_open=is_open))]
    pictures = [[], []]
    for seed in range(1, 2 * ROUNDS + 1):
        for entrant, made in zip(entrants, pictures, strict=True):
            made.append(entrant.picture(seed))
    costs = []
    for made in pictures:
        mean = np.mean([values for values, _ in made], axis=0)
        known = mean + 0.01 * mean.mean()
        costs.append([cost(a, b, known) for a, b in zip(made[::2], made[1::2], strict=True)])
    variance, seconds = (statistics.median(a[k] / b[k] for a, b in zip(*costs, strict=True)) for k in (0, 1))
    whole = statistics.median(a[0] * a[1] / (b[0] * b[1]) for a, b in zip(*costs, strict=True))
    print(f"\n500 luminaires over 5: variance {variance:.2f}, processor time {seconds:.2f}, cost {whole:.2f}")
    return whole


def test_a_hundred_walled_bays_cost_at_most_two():
    assert measured(is_open=False) <= MOST


def test_a_hundred_open_bays_are_told():
    """Without walls the whole hall's light arrives in the bay, which is another picture: its cost is only printed."""
    assert measured(is_open=True) > 0
