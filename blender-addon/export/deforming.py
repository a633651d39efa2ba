# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes that change their form while the shutter is open: their points and normals at its times."""

from dataclasses import dataclass

import numpy as np

from .material.inputs import PARAMETRIC, TRIANGLE
from .mesh import mesh_arguments
from .mesh_values import apart
from .modelled_normals import modelled
from .object_attribute import keyed
from .passing import passing

# The attribute of points that says where they go, metres a second.
VELOCITY = "velocity"


@dataclass(slots=True)
class Form:
    """A mesh at one time."""

    points: np.ndarray
    normals: np.ndarray | None
    faces: np.ndarray
    corners: np.ndarray | None

    def is_like(self, other):
        """Whether another form has the same faces over as many points. How they are cut into triangles may change as they bend."""
        return (
            self.points.shape == other.points.shape
            and np.array_equal(self.faces, other.faces)
            and (self.corners is None) == (other.corners is None)
            and (self.corners is None or np.array_equal(self.corners, other.corners))
            and bool(np.isfinite(other.points).all())
        )


def may_change(group):
    """Whether a group's mesh may have another form at another time."""
    # What is modelled stands in the original: its data and its modifiers.
    source = group.source.original
    if not _is_to_be_blurred(group) or has_velocities(group):
        return False
    data = source.data
    return bool(source.modifiers) or getattr(data, "shape_keys", None) is not None or source.parent_type == "ARMATURE"


def has_velocities(group):
    """Whether a group's mesh says itself where its points go."""
    if not _is_to_be_blurred(group):
        return False
    attribute = group.data.attributes.get(VELOCITY)
    return attribute is not None and (attribute.domain, attribute.data_type) == ("POINT", "FLOAT_VECTOR")


def _is_to_be_blurred(group):
    cycles = getattr(keyed(group.source), "cycles", None)
    return group.kind == "MESH" and getattr(cycles, "use_deform_motion", True)


def _form(arguments):
    return arguments and Form(arguments["points"], arguments["normals"], arguments["faces"], arguments["corners"])


def form_of(group):
    """The form of a group's mesh; None for one without faces."""
    return _form(_arguments(group, frozenset()))


def _arguments(group, primvars):
    with passing(group) as mesh:
        return mesh_arguments(mesh, primvars, modelled(group))


def forms_by_velocities(group, seconds):
    """The forms of a group's mesh so many seconds after the frame, its points going straight on; none for one without faces."""
    arguments = _arguments(group, frozenset({VELOCITY}))
    if arguments is None:
        return []
    rest, velocities = _form(arguments), np.nan_to_num(arguments["primvars"][VELOCITY], posinf=0.0, neginf=0.0)
    return [Form(rest.points + np.float32(after) * velocities, None, rest.faces, rest.corners) for after in seconds]


def with_motion(group, primvars, forms):
    """The arguments of `put_mesh` for a group with its forms at even times, and whether its faces are others at other times; None where
    nothing changes."""
    plain = _arguments(group, frozenset())
    rest = _form(plain)
    if rest is None or any(form is None or not rest.is_like(form) for form in forms):
        return None, rest is not None
    if all(np.array_equal(form.points, forms[0].points) for form in forms):
        return None, False
    arguments, forms = _arguments(group, primvars), [_laid_out(plain, form, primvars) for form in forms]
    arguments["motion"] = np.concatenate([form["points"] for form in forms])
    rest, normals = arguments["normals"], [form["normals"] for form in forms]
    if rest is not None and all(one is not None and one.shape == rest.shape for one in normals):
        arguments["motion_normals"] = np.concatenate(normals)
    return arguments, False


def _laid_out(plain, form, primvars):
    """Points and normals of a form in the order in which the mesh is told: by triangles of the mesh at the frame, where each has values
    of its own."""
    arguments = {**plain, "points": form.points, "normals": form.normals, "primvars": {}}
    return apart(arguments) if any(name in primvars for name in (PARAMETRIC, *TRIANGLE)) else arguments
