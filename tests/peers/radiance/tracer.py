"""A path tracer for matt rectangles and luminaires, in numpy and double precision: it shares no code with gonio or Radiance.

Direct light is integrated over jittered cells of every opening. Indirect light is a random walk: at each surface one place on one luminaire
is chosen (next event estimation), and the path goes on with the reflectance's probability.
"""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy

sys.path.append(str(Path(__file__).resolve().parents[2] / "validate" / "lighting"))

import photometric_file  # noqa: E402
import two_rooms  # noqa: E402

# Cells of an opening along C0 and C90, for direct light.
CELLS = (4, 32)
# Metres that rays start off their surface.
OFF = 1e-6


@dataclass(frozen=True)
class Tracer:
    """Rectangles in columns: corners, edges over their squared lengths, normals, reflectances; and the candela of a luminaire."""

    corner: numpy.ndarray
    u: numpy.ndarray
    v: numpy.ndarray
    normal: numpy.ndarray
    reflectance: numpy.ndarray
    luminaire: photometric_file.Table

    def crossings(self, start: numpy.ndarray, way: numpy.ndarray, number: int) -> numpy.ndarray:
        """How many times `way` it is along rays (n, 3) to a rectangle; infinite where they miss."""
        with numpy.errstate(divide="ignore", invalid="ignore"):
            t = ((self.corner[number] - start) @ self.normal[number]) / (way @ self.normal[number])
            place = start + t[:, None] * way - self.corner[number]
            a, b = place @ self.u[number], place @ self.v[number]
            return numpy.where((t > 0) & (a >= 0) & (a <= 1) & (b >= 0) & (b <= 1), t, numpy.inf)

    def nearest(self, start: numpy.ndarray, way: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
        """Distance and number of the first rectangle along rays."""
        best, which = numpy.full(len(start), numpy.inf), numpy.full(len(start), -1)
        for number in range(len(self.corner)):
            t = self.crossings(start, way, number)
            closer = t < best
            best[closer], which[closer] = t[closer], number
        return best, which

    def lit(self, place: numpy.ndarray, normal: numpy.ndarray, source: numpy.ndarray) -> numpy.ndarray:
        """Lux at places (n, 3) from luminaires with all of their light at one place each (n, 3)."""
        way = source - place
        distance = numpy.linalg.norm(way, axis=1)
        toward = way / distance[:, None]
        lux = self.luminaire.intensity(-toward) * numpy.maximum((toward * normal).sum(axis=1), 0.0) / distance**2
        lights = numpy.flatnonzero(lux > 0)
        for number in range(len(self.corner)):
            lights = lights[self.crossings(place[lights], way[lights], number) >= 1.0]
        shown = numpy.zeros(len(lux))
        shown[lights] = lux[lights]
        return shown

    def direct(self, place: numpy.ndarray, random: numpy.random.Generator) -> numpy.ndarray:
        """Lux at level places (n, 3), one jittered place in each cell of each opening."""
        total = numpy.zeros(len(place))
        up = numpy.broadcast_to([0.0, 0.0, 1.0], place.shape)
        for luminaire in two_rooms.LUMINAIRES:
            for cell in numpy.ndindex(*CELLS):
                share = (cell + random.random((len(place), 2))) / CELLS
                total += self.lit(place, up, on_opening(numpy.array(luminaire), share)) / (CELLS[0] * CELLS[1])
        return total

    def indirect(self, place: numpy.ndarray, paths: int, random: numpy.random.Generator) -> numpy.ndarray:
        """Lux at level places (n, 3) after one reflection or more, the mean of so many paths, the first bounce stratified."""
        total, owner = numpy.zeros(len(place)), numpy.repeat(numpy.arange(len(place)), paths)
        start, normal = place[owner], numpy.broadcast_to([0.0, 0.0, 1.0], (len(owner), 3))
        across = max(1, int(paths**0.5))
        number = numpy.arange(len(owner)) % paths
        first = numpy.stack([number % across / across, (number // across) / (paths / across)], axis=1)
        numbers = (first + random.random((len(owner), 2)) / (across, paths / across)) % 1.0
        while len(owner):
            way = cosine(normal, numbers)
            distance, hit = self.nearest(start + OFF * normal, way)
            towards = -numpy.sign((way * self.normal[hit]).sum(axis=1))
            start, normal = start + distance[:, None] * way, self.normal[hit] * towards[:, None]
            chosen = numpy.array(two_rooms.LUMINAIRES)[random.integers(len(two_rooms.LUMINAIRES), size=len(owner))]
            source = on_opening(chosen, random.random((len(owner), 2)))
            light = len(two_rooms.LUMINAIRES) * self.lit(start + OFF * normal, normal, source)
            total += numpy.bincount(owner, self.reflectance[hit] * light, len(place))
            on = random.random(len(owner)) < self.reflectance[hit]
            start, normal, owner = start[on], normal[on], owner[on]
            numbers = random.random((len(owner), 2))
        return total / paths


def on_opening(middle: numpy.ndarray, share: numpy.ndarray) -> numpy.ndarray:
    """Places on openings about `middle` (3,) or (n, 3), from shares (n, 2) of their sides."""
    offset = (share - 0.5) * two_rooms.OPENING
    place: numpy.ndarray = middle + numpy.concatenate([offset, numpy.zeros((len(offset), 1))], axis=1)
    return place


def cosine(normal: numpy.ndarray, numbers: numpy.ndarray) -> numpy.ndarray:
    """Directions about normals (n, 3) with a density of cos θ / π, from numbers (n, 2) below 1."""
    other = numpy.where(numpy.abs(normal[:, :1]) > 0.9, [[0.0, 1.0, 0.0]], [[1.0, 0.0, 0.0]])
    tangent = numpy.cross(other, normal)
    tangent /= numpy.linalg.norm(tangent, axis=1)[:, None]
    radius, angle = numpy.sqrt(numbers[:, :1]), 2 * numpy.pi * numbers[:, 1:]
    flat = radius * (numpy.cos(angle) * tangent + numpy.sin(angle) * numpy.cross(normal, tangent))
    direction: numpy.ndarray = flat + numpy.sqrt(1 - numbers[:, :1]) * normal
    return direction


def made() -> Tracer:
    """The tracer of the two rooms."""
    all_of = two_rooms.rectangles()
    corner, u, v = (numpy.array([getattr(each, name) for each in all_of]) for name in ("corner", "u", "v"))
    normal = numpy.cross(u, v)
    normal /= numpy.linalg.norm(normal, axis=1)[:, None]
    reflectance = numpy.array([two_rooms.REFLECTANCE[each.material] for each in all_of])
    u, v = (edge / (edge**2).sum(axis=1)[:, None] for edge in (u, v))
    return Tracer(corner, u, v, normal, reflectance, photometric_file.read(two_rooms.LUMINAIRE))


def traced(paths: int, batches: int, seed: int) -> numpy.ndarray:
    """Lux (batches, points) of independent batches that have so many paths a point each."""
    tracer, place = made(), two_rooms.points()
    streams = [numpy.random.default_rng([seed, batch]) for batch in range(batches)]
    return numpy.array([tracer.direct(place, each) + tracer.indirect(place, paths, each) for each in streams])
