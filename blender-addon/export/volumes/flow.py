# SPDX-License-Identifier: GPL-3.0-or-later
"""How volumes flow while the shutter is open, by their grids of velocities."""

from dataclasses import dataclass

import bpy
import numpy as np

from ..motion import shares_of
from ..object_attribute import keyed
from .lattice import Dense


@dataclass
class Flowing:
    """The flow of one volume: the names of its grid of velocities, or of those of x, y and z; `scale` makes ways of the object's space a frame, or a
    second, of them. `to_world` is what its field was put with."""

    name: str
    to_world: np.ndarray
    filling: object
    grids: object
    names: list
    scale: float
    per_frame: bool

    def source(self, shutter, rate):
        """What the scene takes as the flow over a shutter's time."""
        factor = self.scale * shutter.length / (1.0 if self.per_frame else rate)
        if isinstance(self.filling.density, tuple):
            return self.filling.density[0], self.names, factor
        points = Dense(self.filling.density, self.filling.to_object)
        try:
            parts = [self.grids.dense(name).on(points).values for name in self.names]
        finally:
            self.grids.forget_numbers()
        ways = parts[0] if len(parts) == 1 else np.stack(parts, axis=-1)
        voxels = ways.astype(float) @ np.linalg.inv(self.filling.to_object[:3, :3]).T
        return np.ascontiguousarray(voxels, dtype=np.float32), [factor] * 3

    def rests(self, shutter):
        """The time of the shutter at which the frame stands."""
        return (shutter.rests - shutter.opens) / shutter.length


def flowing(group, grids, filling, here):
    """The flow of one placement of a group; None where it has no velocities, or is not to be blurred."""
    if not shares_of(group.source) or not getattr(getattr(keyed(group.source), "cycles", None), "use_deform_motion", True):
        return None
    names, scale, per_frame = _velocities(group, grids)
    if not names or scale == 0.0:
        return None
    return Flowing(group.name, here.matrix @ filling.to_object, filling, grids, names, scale, per_frame)


def _velocities(group, grids):
    """The names of a group's grids of velocities, none where it has none, the factor on them, and whether they are ways of a frame."""
    data = group.data
    if isinstance(data, bpy.types.Volume):
        whole, parts = [data.velocity_grid], [getattr(data, f"velocity_{axis}_grid") for axis in "xyz"]
        names, scale, per_frame = whole if whole[0] in grids.names else parts, data.velocity_scale, data.velocity_unit == "FRAME"
    else:
        names, scale, per_frame = ["velocity"], grids.velocity_scale, True
    usable = all(name in grids.names and grids.is_scalar(name) == (len(names) == 3) for name in names)
    return (names if usable else []), float(scale), per_frame
