"""Scenes of media, and what a narrow camera sees of them with each seed; metres."""

from collections.abc import Sequence
from typing import Any

import confidence
import gonio
import numpy
from confidence import SEEDS
from gonio.medium import medium
from small_scenes import closure

Vector = Sequence[float]
SECTION = "Media"
LIMIT = 5e-3
QUADS = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]


def fill(scene: gonio.Scene, points: Any, triangles: Any, **coefficients: Any) -> None:
    """A mesh of nothing but a medium."""
    clear = [closure("Transparent", base_color=1.0)]
    material = scene.put_material({"origin": "fog", "closures": clear, "medium": medium(**coefficients)})
    scene.add_instance(scene.add_mesh(numpy.array(points, "f4"), numpy.array(triangles, "i4")), [material])


def box(scene: gonio.Scene, low: Vector, high: Vector, **coefficients: Any) -> None:
    """A box of a medium."""
    corners = [[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)]
    fill(scene, corners, [half for a, b, c, d in QUADS for half in ((a, b, c), (a, c, d))], **coefficients)


def slab(scene: gonio.Scene, depth: float, side: float = 300.0, **coefficients: Any) -> None:
    """A wide box below y = 0; its faces' diagonals are not where cameras look at."""
    box(scene, (-side, -depth, -side), (side + 37.0, 0.0, side - 11.0), **coefficients)


def looking(place: Vector, target: Vector, size: int = 16, up: Vector = (0.0, 0.0, 1.0), degrees: float = 0.02) -> gonio.Scene:
    """A scene with a camera that sees next to one direction."""
    scene = gonio.Scene()
    scene.add_camera(gonio.look_at(tuple(place), tuple(target), tuple(up)), fov=degrees)
    most = {"max_bounces": 255, "max_volume_bounces": 255, "max_transparent_bounces": 255}
    scene.set(width=size, height=size, filter="box", caustics="off", passes=["color"], **most)
    return scene


def slanted(cosine: float, below: float | None = None) -> gonio.Scene:
    """A camera that looks at the origin by the cosine to the slab's normal, from above or, `below` a slab of that depth, through it."""
    sine = (1.0 - cosine**2) ** 0.5
    if below is None:
        return looking((5.0 * sine, 5.0 * cosine, 0.0), (0.0, 0.0, 0.0))
    return looking((5.0 * sine, -below - 5.0 * cosine, 0.0), (0.0, -below, 0.0))


def pictures(scene: gonio.Scene, samples: int, seeds: Sequence[int] = SEEDS, **settings: Any) -> numpy.ndarray:
    """Radiances with each seed: (seeds, pixels, R G B)."""
    found, previous = [], None
    scene.set(samples=samples, **settings)
    for seed in seeds:
        scene.set(seed=seed)
        with gonio.Render(scene, previous) as render:
            assert render.wait()
            found.append(numpy.asarray(render.film()["color"])[..., :3].reshape(-1, 3).astype(float))
            previous = render
    return numpy.array(found)


def once(scene: gonio.Scene, samples: int) -> numpy.ndarray:
    """Means of R, G, B with each seed, of light that media scatter once: (seeds, 3)."""
    return pictures(scene, samples, max_volume_bounces=0, max_bounces=0).mean(axis=1)


def sun_above(scene: gonio.Scene) -> None:
    """1 lx from straight above."""
    scene.add_light("distant", angle=0.0, transform=gonio.look_at((0.0, 1.0, 0.0), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)))


def lux(scene: gonio.Scene, samples: int, seeds: Sequence[int] = SEEDS) -> numpy.ndarray:
    """What the scene's meters read with each seed: (seeds, meters)."""
    readings = []
    for seed in seeds:
        scene.set(seed=seed)
        readings.append([meter.value for meter in gonio.measure(scene, samples=samples).meters])
    return numpy.array(readings)


def hold(case: str, reference: str, found: Any, expected: Any, limit: float = LIMIT) -> None:
    """Records the row of a case of media and fails where it does not hold."""
    confidence.hold(SECTION, case, reference, numpy.asarray(found), numpy.asarray(expected), limit)
