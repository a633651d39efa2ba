# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that change their form while the shutter is open: their points and normals at its times."""

from dataclasses import dataclass

import numpy as np

from .mesh import mesh_arguments


@dataclass(slots=True)
class Form:
    """A mesh at one time."""

    points: np.ndarray
    normals: np.ndarray | None
    triangles: np.ndarray
    corners: np.ndarray | None

    def is_like(self, other):
        """Whether another form has the same triangles over as many points."""
        return (
            self.points.shape == other.points.shape
            and np.array_equal(self.triangles, other.triangles)
            and (self.corners is None) == (other.corners is None)
            and (self.corners is None or np.array_equal(self.corners, other.corners))
            and bool(np.isfinite(other.points).all())
        )


def may_change(group):
    """Whether a group's mesh may have another form at another time."""
    source = group.source.original
    if group.kind != "MESH" or not getattr(getattr(source, "cycles", None), "use_deform_motion", True):
        return False
    data = source.data
    return bool(source.modifiers) or getattr(data, "shape_keys", None) is not None or source.parent_type == "ARMATURE"


def form_of(group):
    """The form of a group's mesh; None for one without faces."""
    arguments = mesh_arguments(group.data, frozenset())
    return arguments and Form(arguments["points"], arguments["normals"], arguments["triangles"], arguments["corners"])


def with_motion(arguments, forms):
    """The arguments of `put_mesh` with the forms at even times; None where nothing changes, or the triangles do."""
    rest = Form(arguments["points"], arguments["normals"], arguments["triangles"], arguments["corners"])
    if any(form is None or not rest.is_like(form) for form in forms):
        return None
    if all(np.array_equal(form.points, forms[0].points) for form in forms):
        return None
    arguments["motion"] = np.ascontiguousarray(np.stack([form.points for form in forms]))
    normals = [form.normals for form in forms]
    if rest.normals is not None and all(one is not None and one.shape == rest.normals.shape for one in normals):
        arguments["motion_normals"] = np.ascontiguousarray(np.stack(normals))
    return arguments


def topology_differs(arguments, forms):
    """Whether the triangles are others at other times."""
    rest = Form(arguments["points"], arguments["normals"], arguments["triangles"], arguments["corners"])
    return any(form is None or not rest.is_like(form) for form in forms)
