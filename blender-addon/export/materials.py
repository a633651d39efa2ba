# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene's materials: translated once, written again only where the description differs."""

import gonio

from .material import translate


class Materials:
    """Numbers of the scene's materials and what each wants of meshes and placements."""

    def __init__(self, scene, slots, images, report):
        self._scene, self._slots, self._images, self._report = scene, slots, images, report
        self._translated, self.any_written = {}, False
        # Names of the AOV Output nodes that passes show.
        self.shader_aovs = frozenset()

    def begin(self):
        """Starts a pass."""
        self.any_written = False

    def forget_all(self):
        """Has every material translated again."""
        self._translated = {}

    def forget(self, uid):
        """Has one material translated again."""
        self._translated.pop(uid, None)

    def number(self, material):
        """The number of a material (None: the default one), translated and written where that is still to be done."""
        uid = 0 if material is None else material.original.session_uid
        number, _ = self._slots.take(uid)
        if uid not in self._translated:
            if material is not None:
                self._report.forget("Material", material.name)
            self._translated[uid] = self._written(material, number)
        return number

    def _written(self, material, number):
        """Translates and writes; a material that the scene refuses is the default one, with a report line."""
        translated = translate(material, self._images, self._report, shader_aovs=self.shader_aovs)
        try:
            self.any_written |= self._slots.put(self._scene.put_material, translated.description, number)
        except (gonio.Error, ValueError, TypeError) as problem:
            self._report.add("Material", material.name, f"{problem}; a plain grey is used", severity="ERROR", material=material.name)
            translated = translate(None, self._images, self._report)
            self.any_written |= self._slots.put(self._scene.put_material, translated.description, number)
        return translated

    def wants(self, materials):
        """The names that these materials want of meshes, and of placements."""
        primvars, placements = set(), set()
        for material in materials:
            translated = self._translated[0 if material is None else material.original.session_uid]
            primvars |= translated.primvars
            placements |= translated.instance_primvars
        return primvars, placements
