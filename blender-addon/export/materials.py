# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene's materials: translated once, written again only where the description differs."""

from dataclasses import dataclass

import bpy

from ..report import words_of
from .material import translate, translate_inside
from .surroundings import Surroundings


@dataclass(frozen=True, slots=True)
class Slotted:
    """The materials of an object's slots: their numbers, and the names that they want of meshes, and of placements."""

    numbers: list
    primvars: frozenset
    placed: frozenset
    # By the number of a slot: what fills meshes of it, where that varies.
    uneven: dict


@dataclass(frozen=True, slots=True, eq=False)
class Inside:
    """What fills volumes of a material: its translator and the medium, None where there is none."""

    translator: object
    medium: object
    name: str
    pass_index: int


class Materials:
    """Numbers of the scene's materials and what each wants of meshes and placements."""

    def __init__(self, scene, slots, images, measurements, report):
        self._scene, self._slots, self._images, self._measurements, self._report = scene, slots, images, measurements, report
        self._translated, self._insides, self.any_written = {}, {}, False
        # By session_uid: what fills meshes, where it varies; and whether it is to be asked anew for what is around.
        self._uneven, self.is_inside_stale = {}, False
        # The names of materials that this pass shows, by session_uid.
        self._shown, self._before = {}, {}
        # Within a pass: many objects have the same slots.
        self._slotted = {}
        # Names of the AOV Output nodes that passes show.
        self.shader_aovs = frozenset()
        self._surroundings = Surroundings()

    def begin(self, surroundings):
        """Starts a pass."""
        self._surroundings = surroundings
        self.any_written, self._slotted, self._before, self._shown = False, {}, self._shown, {}

    def sweep(self):
        """Forgets materials that nothing shows any more, and what was said of them."""
        self._surroundings = Surroundings()
        for uid in self._before.keys() - self._shown.keys():
            self.forget(uid)
            if (name := self._before[uid]) not in self._shown.values():
                self._report.forget("Material", name)

    def forget_all(self):
        """Has every material translated again."""
        self._translated, self._insides, self._uneven = {}, {}, {}

    def forget(self, uid):
        """Has one material translated again."""
        self._translated.pop(uid, None)
        self._insides.pop(uid, None)
        self._uneven.pop(uid, None)

    def look_around(self, surroundings, depsgraph):
        """Writes the materials again that asked for what is otherwise now; gives whether there are any."""
        stale = [uid for uid, translated in self._translated.items() if not surroundings.answers(translated.asked)]
        self.is_inside_stale = any(self._uneven.pop(uid, None) is not None for uid in stale)
        if not stale:
            return False
        self._surroundings = surroundings
        by_uid = {material.session_uid: material for material in bpy.data.materials}
        for uid in stale:
            if uid in by_uid:
                self._translated[uid] = self._written(by_uid[uid].evaluated_get(depsgraph), self._slots.take(uid)[0])
        self._surroundings = Surroundings()
        return True

    def of_slots(self, slots, materials, override):
        """What the materials of slots come to: session_uids of some of `materials`, or `override` in place of all of them."""
        if slots not in self._slotted:
            shown = [override] * max(1, len(slots)) if override is not None else [materials[uid] for uid in slots] or [None]
            numbers, translated = [self._number(material) for material in shown], [self._translated[_uid(material)] for material in shown]
            primvars = frozenset().union(*(each.primvars for each in translated))
            placed = frozenset().union(*(each.instance_primvars for each in translated))
            uneven = {slot: self._inside_of_meshes(shown[slot]) for slot, each in enumerate(translated) if each.is_uneven}
            self._slotted[slots] = Slotted(numbers, primvars, placed, uneven)
        return self._slotted[slots]

    def inside(self, slots, materials, override):
        """What fills volume objects with these slots: of the first material that has a medium, or of none."""
        shown = [override] if override is not None else [materials[uid] for uid in slots] or [None]
        found = [self._inside(material) for material in shown]
        return next((inside for inside in found if inside.medium is not None), found[0])

    def _inside(self, material):
        uid = _uid(material)
        self._shown[uid] = "" if material is None else material.name
        if uid not in self._insides:
            self._forget_lines(material, uid)
            t, medium = translate_inside(material, self._images, self._report)
            named = ("volume", 0) if material is None else (material.name, material.pass_index)
            self._insides[uid] = Inside(t, medium, *named)
        return self._insides[uid]

    def _inside_of_meshes(self, material):
        uid = _uid(material)
        if uid not in self._uneven:
            found = translate_inside(material, self._images, self._report, has_grids=False, surroundings=self._surroundings)
            self._uneven[uid] = Inside(*found, material.name, material.pass_index)
        return self._uneven[uid]

    def _forget_lines(self, material, uid):
        """What was said of a material, before the first of its translations."""
        if material is not None and uid not in self._translated and uid not in self._insides:
            self._report.forget("Material", material.name)

    def description(self, number):
        """What was written last of a material of the scene."""
        return self._slots.written(number)

    def _number(self, material):
        """The number of a material (None: the default one), translated and written where that is still to be done."""
        uid = _uid(material)
        self._shown[uid] = "" if material is None else material.name
        number, _ = self._slots.take(uid)
        if uid not in self._translated:
            self._forget_lines(material, uid)
            self._translated[uid] = self._written(material, number)
        return number

    def _written(self, material, number):
        """Translates and writes; a material that cannot be translated or that the scene refuses is the default one, with a report line."""
        try:
            translated = translate(
                material,
                self._images,
                self._measurements,
                self._report,
                shader_aovs=self.shader_aovs,
                surroundings=self._surroundings,
            )
            self.any_written |= self._slots.put(self._scene.put_material, translated.description, number)
        except Exception as problem:
            name = "" if material is None else material.name
            self._report.add("Material", name, f"{words_of(problem)}; a plain grey is used", severity="ERROR", material=name)
            translated = translate(None, self._images, self._measurements, self._report)
            # The scene may have refused it, and its place is free again.
            number, _ = self._slots.take(_uid(material))
            self.any_written |= self._slots.put(self._scene.put_material, translated.description, number)
        return translated


def _uid(material):
    return 0 if material is None else material.original.session_uid
