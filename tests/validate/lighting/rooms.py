"""Scenes of matt rectangles with lights, and the illuminance of planes in them; metres, z is up."""

import copy
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import gonio
import numpy
from confidence import SEEDS

# Of a camera from the plane it looks at, metres.
CLOSE = 1e-3
LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722])


@dataclass(frozen=True)
class Plane:
    """A rectangle by its middle and its whole edges; `u × v` points to the side that is measured."""

    middle: tuple[float, float, float]
    u: tuple[float, float, float]
    v: tuple[float, float, float]

    @cached_property
    def normal(self) -> numpy.ndarray:
        """Unit vector."""
        across = numpy.cross(self.u, self.v)
        return across / numpy.linalg.norm(across)

    @property
    def area(self) -> float:
        """Square metres."""
        return float(numpy.linalg.norm(numpy.cross(self.u, self.v)))

    @property
    def corners(self) -> numpy.ndarray:
        """Counter-clockwise from the measured side, (4, 3)."""
        middle, u, v = (numpy.array(axis, float) for axis in (self.middle, self.u, self.v))
        return numpy.array([middle - u / 2 - v / 2, middle + u / 2 - v / 2, middle + u / 2 + v / 2, middle - u / 2 + v / 2])

    def points(self, columns: int, rows: int, parts: int = 1) -> numpy.ndarray:
        """Middles of a grid's cells as a picture of the plane has them, `v` upwards: (rows, columns, 3)."""
        a = ((numpy.arange(columns * parts) + 0.5) / (columns * parts) - 0.5)[None, :, None]
        b = (0.5 - (numpy.arange(rows * parts) + 0.5) / (rows * parts))[:, None, None]
        return numpy.asarray(self.middle) + a * numpy.asarray(self.u) + b * numpy.asarray(self.v)


def box_faces(size: tuple[float, float, float]) -> list[Plane]:
    """The six inner faces of a box about the origin: floor, ceiling, and the walls at −x, +x, −y, +y."""
    x, y, z = size
    return [
        Plane((0, 0, -z / 2), (x, 0, 0), (0, y, 0)),
        Plane((0, 0, z / 2), (0, y, 0), (x, 0, 0)),
        Plane((-x / 2, 0, 0), (0, y, 0), (0, 0, z)),
        Plane((x / 2, 0, 0), (0, -y, 0), (0, 0, z)),
        Plane((0, -y / 2, 0), (-x, 0, 0), (0, 0, z)),
        Plane((0, y / 2, 0), (x, 0, 0), (0, 0, z)),
    ]


class Room:
    """A scene that grows."""

    def __init__(self) -> None:
        self.scene = gonio.Scene()
        self.scene.add_camera()
        self.camera = self.scene.to_dict()["cameras"][0]
        model = gonio.Scene()
        model.add_light("sphere")
        self.model = model.to_dict()["lights"][0]

    def matt(self, reflectance: float) -> int:
        """A Lambertian material."""
        return self.scene.add_material(f"matt {reflectance}", base_color=(reflectance,) * 3, specular_weight=0.0)

    def add(self, *planes: Plane, reflectance: float = 0.0, material: int | None = None) -> None:
        """Puts rectangles of one material into the scene."""
        number = self.matt(reflectance) if material is None else material
        triangles = numpy.array([[0, 1, 2], [0, 2, 3]], "i4")
        for plane in planes:
            self.scene.add_instance(self.scene.add_mesh(plane.corners.astype("f4"), triangles), [number])

    def light(self, shape: Any, strength: float, place: Any = (0, 0, 0), axes: Any = None, **changes: Any) -> None:
        """A light of a shape as scenes describe it, shining along −z of its axes (columns); cd/m², cd for points."""
        description = copy.deepcopy(self.model)
        columns = numpy.eye(3) if axes is None else numpy.asarray(axes, float)
        description.update(shape=shape, transform={"columns": [*columns.T.tolist(), [float(x) for x in place]]})
        description["emission"]["radiance"] = [strength] * 3
        # Cameras close to a plane must not look through a light's shape.
        description["visibility"]["camera"] = False
        for name, value in changes.items():
            known = description.get(name)
            description[name] = {**known, **value} if isinstance(known, dict) else value
        self.scene.put_light(description)

    def illuminance(
        self, plane: Plane, grid: tuple[int, int], samples: int, seeds: Any = SEEDS, *, averaged: bool = False, bounces: int = 0
    ) -> numpy.ndarray:
        """Lux at the middles of a grid's cells (columns, rows), or averaged over the cells: (seeds, rows, columns)."""
        return self.measured("illuminance", plane, grid, samples, seeds, averaged=averaged, bounces=bounces)

    def measured(
        self,
        quantity: str,
        plane: Plane,
        grid: tuple[int, int],
        samples: int,
        seeds: Any = SEEDS,
        *,
        averaged: bool = True,
        bounces: int = 0,
    ) -> numpy.ndarray:
        """The same of a pass, illuminance or luminance."""
        self.look_at(plane)
        self.scene.set(width=grid[0], height=grid[1], filter="box", filter_width=1.0 if averaged else 0.0)
        return self.rendered(quantity, samples, seeds, bounces)

    def look_at(self, plane: Plane) -> None:
        """Puts the camera before a plane, which fills its picture."""
        lengths = [float(numpy.linalg.norm(edge)) for edge in (plane.u, plane.v)]
        place = numpy.asarray(plane.middle) + CLOSE * plane.normal
        columns = [numpy.asarray(plane.u) / lengths[0], numpy.asarray(plane.v) / lengths[1], plane.normal, place]
        transform = {"columns": [column.tolist() for column in columns]}
        self.scene.put_camera({**self.camera, "projection": "Orthographic", "aperture": lengths, "transform": transform}, 0)

    def rendered(self, quantity: str, samples: int, seeds: Any, bounces: int) -> numpy.ndarray:
        """A pass of the camera's picture with each seed."""
        pictures, previous = [], None
        self.scene.set(samples=samples, passes=[quantity], max_bounces=bounces)
        for seed in seeds:
            self.scene.set(seed=seed)
            with gonio.Render(self.scene, previous) as render:
                assert render.wait()
                pictures.append(numpy.asarray(render.film()[quantity])[..., 0].astype(float))
                previous = render
        return numpy.array(pictures)


def facing(direction: Any, up: Any = (0.0, 1.0, 0.0)) -> numpy.ndarray:
    """Axes, as columns, of a light that shines along a direction."""
    z = -numpy.asarray(direction, float) / numpy.linalg.norm(direction)
    x = numpy.cross(up, z)
    if numpy.linalg.norm(x) < 1e-6:
        x = numpy.cross((1.0, 0.0, 0.0), z)
    x /= numpy.linalg.norm(x)
    return numpy.stack([x, numpy.cross(z, x), z], axis=1)
