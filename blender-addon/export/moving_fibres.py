# SPDX-License-Identifier: GPL-3.0-or-later
"""Hair, curves and points that move while the shutter is open: their points at one time."""

from dataclasses import dataclass

import numpy as np

from .gather import HAIR
from .object_attribute import keyed
from .strands import of_curves, of_points, of_system, systems

NO_VALUES = frozenset()


@dataclass(slots=True)
class Shape:
    """Points at one time, and how many of them each curve has; None for points without curves."""

    points: np.ndarray
    counts: np.ndarray | None

    def is_like(self, other):
        """Whether another shape has the same curves over as many points, which are all finite."""
        if self.points.shape != other.points.shape or (self.counts is None) != (other.counts is None):
            return False
        same = self.counts is None or np.array_equal(self.counts, other.counts)
        return bool(same and np.isfinite(self.points).all())


def may_move(group):
    """Whether the points of a group may lie elsewhere at another time."""
    # What is modelled stands in the original: its data and its modifiers.
    source = group.source.original
    if not getattr(getattr(keyed(group.source), "cycles", None), "use_deform_motion", True):
        return False
    data = source.data
    if getattr(data, "shape_keys", None) is not None or source.parent_type == "ARMATURE":
        return True
    if group.kind != HAIR:
        return bool(source.modifiers) or _is_animated(data)
    others = any(modifier.type != "PARTICLE_SYSTEM" for modifier in source.modifiers)
    return others or any(system.use_hair_dynamics for system in group.source.particle_systems)


def _is_animated(data):
    return getattr(data, "animation_data", None) is not None


def shapes_of(group, is_render):
    """What a group shows, in the order in which it is told."""
    if group.kind == HAIR:
        found = []
        for modifier, system in systems(group.source, is_render):
            strands = of_system(group.source, modifier, system, is_render, NO_VALUES, 0)
            if strands is not None:
                found.append(Shape(strands.points, strands.counts))
        return found
    if group.kind == "CURVES":
        strands = of_curves(group.data, NO_VALUES)
        return [] if strands is None else [Shape(strands.points, strands.counts)]
    cloud = of_points(group.data, NO_VALUES)
    return [] if cloud is None else [Shape(cloud[0], None)]
