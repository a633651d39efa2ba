# SPDX-License-Identifier: GPL-3.0-or-later
"""Motion blur: where things are at other times of the shutter. The engine moves the frame, as Cycles has it, and puts it back."""

from dataclasses import dataclass, field
from math import floor

import numpy as np

from .deforming import form_of, forms_by_velocities, has_velocities, may_change
from .fibres import KINDS as FIBRES
from .gather import Walk
from .moving_fibres import may_move as fibres_may_move
from .moving_fibres import shapes_of
from .object_attribute import keyed
from .transforms import without_scale

# Frames from the shutter's opening to the frame that is rendered, as a share of the time that it is open.
POSITIONS = {"START": 0.0, "CENTER": 0.5, "END": 1.0}
# Points of the shutter's curve.
CURVE_POINTS = 65
# The times that motion vectors want: the frame before and the next one.
ENDS = (0.0, 1.0)
# Keys are 2^steps + 1; more steps would take an hour.
MOST_STEPS = 7


@dataclass(slots=True)
class Shutter:
    """When the shutter is open: the frame at which it opens, the frames until it is closed, and the frame at which all else stands."""

    opens: float
    length: float
    rests: float

    def frame(self, share):
        """The frame at a share of the time that it is open."""
        return self.opens + share * self.length


@dataclass(slots=True)
class Places:
    """Matrices at one time: those of cameras by session_uid, and of placements by their key."""

    cameras: dict = field(default_factory=dict)
    groups: dict = field(default_factory=dict)
    # Forms of the meshes that may change.
    forms: dict = field(default_factory=dict)


@dataclass(eq=False)
class Placed:
    """The key of what is placed with some placements of a group: the group's key, the placements' numbers, and the matrix from its own space to
    theirs."""

    group: tuple
    numbers: list
    inner: np.ndarray = field(default_factory=lambda: np.eye(4))

    def matrices(self, groups):
        """Its matrices where those of all groups are these; None where there are not as many."""
        found = groups.get(self.group)
        return None if found is None or len(found) <= max(self.numbers) else (found[self.numbers].astype(float) @ self.inner).astype(np.float32)


class _Silent:
    """Takes what was told before, of the frame itself."""

    def add(self, *_, **__):
        """Nothing is told twice."""

    tell = add

    def guard(self, *_):
        """What fails at another time stands still."""
        return _Ignored()


class _Ignored:
    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        return kind is not None and issubclass(kind, Exception)


def is_blurred(depsgraph):
    """Whether the scene and its view layer ask for motion blur."""
    return bool(depsgraph.scene.render.use_motion_blur and depsgraph.view_layer.use_motion_blur)


def shutter_of(depsgraph):
    """The scene's shutter, None where nothing is blurred."""
    scene, render = depsgraph.scene, depsgraph.scene.render
    length = float(render.motion_blur_shutter)
    if not is_blurred(depsgraph) or length <= 0.0:
        return None
    cycles = getattr(scene, "cycles", None)
    position = getattr(render, "motion_blur_position", None) or getattr(cycles, "motion_blur_position", "CENTER")
    rests = scene.frame_current + scene.frame_subframe
    return Shutter(rests - POSITIONS.get(position, 0.5) * length, length, rests)


def neighbours_of(depsgraph):
    """The frames before and after as if a shutter opened and closed there, where the pass of motion vectors is shown; else None."""
    if not getattr(depsgraph.view_layer, "use_pass_vector", False) or is_blurred(depsgraph):
        return None
    rests = depsgraph.scene.frame_current + depsgraph.scene.frame_subframe
    return Shutter(rests - 1.0, 2.0, rests)


def settings_of(depsgraph):
    """The shutter's settings for `gonio.Scene.set`."""
    scene = depsgraph.scene
    cycles = getattr(scene, "cycles", None)
    rolls = getattr(cycles, "rolling_shutter_type", "NONE") != "NONE"
    return {
        "motion_blur": is_blurred(depsgraph),
        "shutter_curve": _curve(scene.render),
        "row_exposure": float(cycles.rolling_shutter_duration) if rolls else 1.0,
    }


def _curve(render):
    """How far the shutter is open, from opening to closing; nothing where it is open all the time."""
    mapping = render.motion_blur_shutter_curve
    mapping.initialize()
    curve = mapping.curves[0]
    heights = [max(float(mapping.evaluate(curve, place)), 0.0) for place in np.linspace(0.0, 1.0, CURVE_POINTS)]
    return [] if max(heights) - min(heights) < 1e-6 else heights


def shares_of(thing):
    """The times at which an object's place is asked for, as shares of the shutter's; nothing where it is not to be blurred."""
    cycles = getattr(keyed(thing), "cycles", None)
    if not getattr(cycles, "use_motion_blur", True):
        return ()
    parts = 2 ** min(max(int(getattr(cycles, "motion_steps", 1)), 1), MOST_STEPS)
    return tuple(part / parts for part in range(parts + 1))


def cameras_of(scene):
    """The cameras that a render may see through: the scene's, and with several views all that there are."""
    others = [thing for thing in scene.objects if thing.type == "CAMERA"] if scene.render.use_multiview else []
    return ([] if scene.camera is None else [scene.camera]) + [thing for thing in others if thing != scene.camera]


def camera_keys(uid, shares, places):
    """The matrices of a camera, by session_uid, at shares of the shutter's time; nothing where it stands still."""
    keys = [places[share].cameras.get(uid) for share in shares]
    if not keys or any(key is None or not np.isfinite(key).all() for key in keys) or all((key == keys[0]).all() for key in keys):
        return []
    return [without_scale(key) for key in keys]


def seen_keys(keys, rest, matrix):
    """Keys of a camera as those of an eye beside it, which has its own matrix while the camera's is `rest`."""
    return keys if matrix is None else [key @ np.linalg.inv(without_scale(rest)) @ without_scale(matrix) for key in keys]


def keys_of(groups):
    """Names of groups that hold from frame to frame, in the order of the groups."""
    counted, keys = {}, []
    for group in groups:
        place = (group.object_uid, group.kind)
        keys.append((*place, counted.setdefault(place, 0)))
        counted[place] += 1
    return keys


def form_shares(group):
    """The times at which the form of a group's mesh, hair, curves or points is asked for; None where it keeps it."""
    may_differ = fibres_may_move(group) if group.kind in FIBRES else may_change(group)
    return shares_of(group.source) if may_differ else None


def places_at(engine, depsgraph, shutter, shares, part, forms):
    """Matrices of everything at shares of the shutter's time; the frame is put back. `forms` are the times at which forms are asked for, by
    the keys of groups, as settings at the frame say: keyed ones may be others by then."""
    found = {}
    try:
        for share in sorted(shares):
            frame = shutter.frame(share)
            whole = floor(frame)
            engine.frame_set(whole, subframe=frame - whole)
            walk = Walk(depsgraph, _Silent(), part)
            cameras = cameras_of(depsgraph.scene)
            seen = {camera.session_uid: np.array(camera.evaluated_get(depsgraph).matrix_world, dtype=float) for camera in cameras}
            groups = {key: np.array(group.matrices) for key, group in zip(keys_of(walk.groups), walk.groups, strict=True)}
            found[share] = Places(seen, groups, _forms(walk, share, depsgraph, forms))
    finally:
        whole = floor(shutter.rests)
        engine.frame_set(whole, subframe=shutter.rests - whole)
    return found


def _forms(walk, share, depsgraph, asked):
    """What meshes, hair, curves and points look like that are asked for at this share of the time."""
    forms = {}
    for key, group in zip(keys_of(walk.groups), walk.groups, strict=True):
        if share not in asked.get(key, ()):
            continue
        with _Ignored():
            forms[key] = shapes_of(group, depsgraph.mode == "RENDER") if group.kind in FIBRES else form_of(group)
    return forms


def forms_of(key, group, places, shutter, scene, ends=()):
    """What a group's mesh, or its hair, looks like at even times of the shutter; nothing where it keeps its form."""
    shares = ends or shares_of(group.source)
    if shares and has_velocities(group):
        # Ways are straight: two times say all.
        speed = scene.render.fps / scene.render.fps_base
        return forms_by_velocities(group, [(shutter.frame(share) - shutter.rests) / speed for share in (0.0, 1.0)])
    forms = [places[share].forms.get(key) for share in shares if share in places]
    return [] if any(form is None for form in forms) else forms


def moved(key, rest, shares, places):
    """The matrices of a group (K, N, 4, 4) at shares of the shutter's time; None where they stand still, or are others at other times."""
    is_part = isinstance(key, Placed)
    keys = [key.matrices(places[share].groups) if is_part else places[share].groups.get(key) for share in shares]
    if not keys or any(found is None or found.shape != rest.shape or not np.isfinite(found).all() for found in keys):
        return None
    stacked = np.stack(keys)
    return None if (stacked == stacked[0]).all() else np.ascontiguousarray(stacked)
