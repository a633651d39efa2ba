# SPDX-License-Identifier: GPL-3.0-or-later
"""What fills all of space: the Volume of the world, even or by a field about the scene."""

from dataclasses import dataclass

import numpy as np

from .asked import Asked
from .filling import Place, fill
from .insides import content
from .space import space_of

# The box of a scene is at least so many metres long, and ends at eighths of a power of two, so that it seldom changes.
LEAST_EDGE, EIGHTHS = 1.0, 8.0
# What the report says of all of them.
COARSE = "What of its volume is finer than the points at which it is asked, or far from the scene"
# The world's own space is that of its volume.
WORLD = Place(np.eye(4), {})


@dataclass(frozen=True, eq=False)
class Uneven:
    """A volume that varies: its translator, the medium, and the world's name."""

    translator: object
    medium: object
    name: str


class Air:
    """The medium of all of space; `volumes` has the scene's fields."""

    def __init__(self, scene, volumes, report):
        self._scene, self._volumes, self._report = scene, volumes, report
        self._inside, self._corners = None, np.empty((0, 3))
        # What was written last, and whether anything was since somebody looked.
        self._written, self.any_written = {}, False
        # (content of the shader, box) and the filling with what it was asked on, of the last time.
        self._filled = (None, None, None)

    def show(self, t, medium, name, depsgraph):
        """Fills space with what a world's volume is; clear air without a medium."""
        self._inside = None if medium is None or medium.is_even else Uneven(t, medium, name)
        if self._inside is None:
            self._write({} if medium is None else medium.described())
        else:
            self._put(depsgraph)

    def place(self, groups, depsgraph):
        """Keeps the field of a volume that varies, laid about what the groups show now."""
        self._corners = np.concatenate([np.empty((0, 3)), *(_corners(group) for group in groups)])
        if self._inside is not None:
            self._put(depsgraph)

    def _put(self, depsgraph):
        described, name = {}, self._inside.name
        with self._report.guard("World", name, "the air stays clear"):
            space, filling = self._filling(_box(self._corners, depsgraph))
            for limit, subject in [("uneven air", COARSE), *(() if filling is None else filling.told)]:
                self._report.tell(limit, "World", name, subject)
            if filling is not None:
                described = {**filling.medium(1.0), "field": self._volumes.field(name, filling, np.eye(4), space.beyond)[0]}
        self._write(described)

    def _write(self, described):
        if described != self._written:
            self._scene.put_atmosphere(described)
            self._written, self.any_written = described, True

    def _filling(self, box):
        """Where the volume is asked, and what it is there, made anew where something of it is another."""
        inside, key = self._inside, (content(self._inside), np.array(box).tobytes())
        if self._filled[0] != key:
            values = (inside.medium.absorption, inside.medium.scattering, inside.medium.turned), (inside.medium.emission,)
            found = Asked(inside.translator, _Nothing, WORLD, values[0]), Asked(inside.translator, _Nothing, WORLD, values[1])
            space = space_of(found, *box)
            filling = None if space is None else fill(inside.translator, inside.medium, space, WORLD)
            self._filled = key, space, filling
        return self._filled[1:]


class _Nothing:
    """Grids that a world has: none."""

    names = {}


def _corners(group):
    """The least and the greatest places of what a group shows; of lamps at infinity none."""
    if group.kind == "LIGHT" and group.data.type == "SUN":
        return np.empty((0, 3))
    placed = group.matrices if group.kept is None else group.matrices[group.kept]
    bounds = np.zeros((8, 3)) if group.kind == "LIGHT" else np.array(group.source.bound_box, dtype=float)
    low, high = bounds.min(axis=0), bounds.max(axis=0)
    if not len(placed) or not (low <= high).all():
        return np.empty((0, 3))
    middle = placed[:, :3, :3] @ (0.5 * (low + high)) + placed[:, :3, 3]
    half = np.abs(placed[:, :3, :3]) @ (0.5 * (high - low))
    return np.stack([(middle - half).min(axis=0), (middle + half).max(axis=0)])


def _box(corners, depsgraph):
    """The box of what is shown and of the scene's camera."""
    camera = depsgraph.scene.camera
    eye = [] if camera is None else [np.array(camera.evaluated_get(depsgraph).matrix_world)[:3, 3]]
    points = np.array([*corners, *eye]) if len(corners) or eye else np.zeros((1, 3))
    low, high = points.min(axis=0), points.max(axis=0)
    step = 2.0 ** np.ceil(np.log2(max(float((high - low).max()), LEAST_EDGE))) / EIGHTHS
    return np.floor(low / step) * step, (np.floor(high / step) + 1.0) * step
