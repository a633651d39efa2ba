"""A viewport that goes round a scene of 280,000 triangles. Used inside the child process."""

import math
import time
from dataclasses import dataclass

from heads import add_heads
from mathutils import Matrix, Vector
from scenes import empty
from viewport import Viewport

# From one picture to the next, radians.
STEP = math.radians(1.0)


def heads_under_a_dim_sky():
    """An empty file with the heads."""
    scene = empty()
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.05, 0.06, 0.08, 1)
    add_heads()
    return scene


def pose(angle: float) -> Matrix:
    """Where the view stands after an angle of the way round, looking at the middle."""
    at = Vector((8.0 * math.sin(angle), -8.0 * math.cos(angle), 4.0))
    return Matrix.Translation(at) @ (Vector((0.0, 0.0, 0.8)) - at).to_track_quat("-Z", "Y").to_matrix().to_4x4()


@dataclass(frozen=True)
class Pace:
    """What an orbit was like."""

    updates_a_second: float
    # From a view to the picture of it, seconds, one for each picture.
    latencies: tuple[float, ...]
    # Columns of each picture.
    widths: tuple[int, ...]


class _Dated:
    """A render that notes how old its view is when its picture is taken, and what is waited for."""

    def __init__(self, render, seen: float, orbit: "Orbit") -> None:
        self._render, self._seen, self._orbit = render, seen, orbit

    def __getattr__(self, name):
        return getattr(self._render, name)

    def wait(self, seconds):
        return self._orbit.times.add("trace", lambda: self._render.wait(seconds))

    def film(self):
        self._orbit.ages.append(time.perf_counter() - self._seen)
        return self._orbit.times.add("develop", self._render.film)


class Orbit(Viewport):
    """A viewport whose view never rests."""

    def __init__(self) -> None:
        self._angle, self._seen, self.ages = 0.0, 0.0, []
        super().__init__(pose(0.0))

    def _start(self, scene, previous):
        render = super()._start(scene, previous._render if previous is not None else None)
        return _Dated(render, self._seen, self)

    def step(self):
        """Turns the view a little and draws it; gives the picture."""
        self._angle += STEP
        self._seen = time.perf_counter()
        self.region.view_matrix = pose(self._angle).inverted()
        return self.draw()

    def go(self, seconds: float) -> Pace:
        """Turns for some seconds."""
        self.ages.clear()
        self.times.clear()
        widths, number = [], self.session.picture.number if self.session.picture else -1
        start = time.perf_counter()
        while time.perf_counter() - start < seconds:
            picture = self.step()
            if picture is not None and picture.number != number:
                number = picture.number
                widths.append(picture.width)
        taken = time.perf_counter() - start
        return Pace(len(widths) / taken, tuple(self.ages), tuple(widths))
