# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene's curves and points: those of hair, hair curves and point clouds, written again only where they differ."""

from hashlib import blake2b

import numpy as np

from ..report import words_of
from .gather import HAIR
from .slots import Slots
from .strands import of_curves, of_points, of_system, systems

# Kinds of groups, beside meshes, that are shown by what is here: the hair of an object's particle systems, and two kinds of objects.
KINDS = (HAIR, "CURVES", "POINTCLOUD")


class Fibres:
    """Numbers of the scene's curves and points, by what is in them."""

    def __init__(self, scene, report):
        self._scene, self._report = scene, report
        self._slots = {"curves": Slots(), "points": Slots()}
        # (object, data, kind) -> (list of (kind, content, material slot), values wanted, shape)
        self._known, self._seen = {}, set()
        self.any_written = False
        # Shapes over the shutter of what is read, by its number in its group.
        self._motion = {}

    def begin(self, keep_known):
        """Starts a pass; without `keep_known` everything is read again."""
        for slots in self._slots.values():
            slots.begin()
        self.any_written, self._seen = False, set()
        if not keep_known:
            self._known = {}

    def forget(self, uids):
        """Has what these objects or data-blocks show read again."""
        self._known = {key: known for key, known in self._known.items() if key[0] not in uids and key[1] not in uids}

    def of_group(self, group, primvars, depsgraph):
        """What a group shows: pairs of a kind with its number, and the material slot, None for all."""
        place, shape = (group.object_uid, group.data_uid, group.kind), _shape(depsgraph)
        self._seen.add(place)
        known = self._known.get(place)
        if known is None or known[1:] != (primvars, shape):
            known = self._known[place] = (self._read(group, primvars, shape, depsgraph.mode == "RENDER"), primvars, shape)
        return [((kind, self._slots[kind].take(key)[0]), slot) for kind, key, slot in known[0]]

    def blur(self, group, shown, primvars, forms, depsgraph):
        """Pairs of what a group shows and what stands in for it, which moves between `forms` at even times of the shutter."""
        pairs = []
        for number, before in enumerate(shown):
            shapes = [form[number] if number < len(form) else None for form in forms]
            if any(one is None or not one.is_like(shapes[0]) for one in shapes):
                self._report.add("Object", group.name, "it has other points at other times of the shutter; its form is not blurred")
                continue
            if all(np.array_equal(one.points, shapes[0].points) for one in shapes):
                continue
            self._motion[number] = shapes
            pairs.append((before, number))
        if not pairs:
            return []
        try:
            moving = self._read(group, primvars, _shape(depsgraph), depsgraph.mode == "RENDER")
        finally:
            self._motion = {}
        taken = {number: (moving[number][0], self._slots[moving[number][0]].take(moving[number][1])[0]) for _, number in pairs}
        return [(before, taken[number]) for before, number in pairs]

    def _read(self, group, primvars, shape, is_render):
        """What is there, as (kind, content, material slot); what cannot be read is left out, with a report line."""
        try:
            if group.kind == HAIR:
                return self._hair(group, primvars, shape, is_render)
            if group.kind == "CURVES":
                strands = of_curves(group.data, primvars)
                return [] if strands is None else [("curves", self._curves(group.name, strands, shape, 0), None)]
            cloud = of_points(group.data, primvars)
            return [] if cloud is None else [("points", self._points(group.name, *cloud, 0), None)]
        except Exception as problem:
            self._report.add("Object", group.name, f"{words_of(problem)}; it is left out", severity="ERROR")
            return []

    def _hair(self, group, primvars, shape, is_render):
        found, first = [], 0
        for modifier, system in systems(group.source, is_render):
            strands = of_system(group.source, modifier, system, is_render, primvars, first)
            if strands is not None:
                first += len(strands.counts)
                key = self._curves(f"{group.name} {system.name}", strands, shape, len(found))
                found.append(("curves", key, system.settings.material - 1))
        return found

    def _curves(self, name, strands, shape, number):
        arrays = (strands.points, strands.counts, strands.radii * 2.0)
        keywords = {"type": "cubic", "basis": "catmullRom", "wrap": "pinned", "shape": shape, "primvars": strands.values}
        return self._put("curves", self._scene.put_curves, arrays, {**keywords, **self._keys(number, strands.points), "name": name})

    def _points(self, name, points, radii, values, number):
        return self._put("points", self._scene.put_points, (points, radii * 2.0), {"primvars": values, **self._keys(number, points), "name": name})

    def _keys(self, number, rest):
        """The points over the shutter, where they move and are as many as at the frame."""
        shapes = self._motion.get(number)
        if shapes is None or shapes[0].points.shape != rest.shape:
            return {}
        return {"motion": np.concatenate([one.points for one in shapes])}

    def _put(self, kind, write, arrays, keywords):
        """Writes what is not there yet; gives its key."""
        digest = blake2b(digest_size=16)
        moving = [keywords["motion"]] if "motion" in keywords else []
        for array in (*arrays, *moving, *(keywords["primvars"][name] for name in sorted(keywords["primvars"]))):
            digest.update(np.ascontiguousarray(array))
        key = (digest.digest(), keywords.get("shape"), tuple(sorted(keywords["primvars"])), tuple(len(array) for array in (*arrays, *moving)))
        if key not in self._slots[kind]:
            number, _ = self._slots[kind].take(key)
            self.any_written = True
            self._slots[kind].place(lambda index: write(*arrays, index=index, **keywords), number)
        return key

    def sweep(self):
        """Frees the memory of what nothing shows any more."""
        self._known = {place: known for place, known in self._known.items() if place in self._seen}
        points, counts = np.zeros((0, 3), dtype=np.float32), np.zeros(0, dtype=np.int32)
        for number in self._slots["curves"].sweep():
            self._slots["curves"].place(lambda index: self._scene.put_curves(points, counts, 0.0, name="nothing", index=index), number)
        for number in self._slots["points"].sweep():
            self._slots["points"].place(lambda index: self._scene.put_points(points, 0.0, name="nothing", index=index), number)


def _shape(depsgraph):
    """What curves look like: ribbons that face each ray, or tubes."""
    settings = getattr(depsgraph.scene, "cycles_curves", None)
    return "ribbon" if getattr(settings, "shape", "RIBBONS") == "RIBBONS" else "round"
