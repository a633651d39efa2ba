# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes whose volume shader varies from place to place: each placement has a field, and materials of its own with it."""

import json
from dataclasses import replace

import numpy as np
from gonio.graph import renumber

from ..gather import fill_random
from ..given import fill_given, is_given
from ..instancer import PREFIX as INSTANCER
from ..instancer import fill_instancer
from ..instances import values_of
from ..material.inputs import RANDOM
from .bounds import bounds_of
from .filling import Place, fill

# More placements of a mesh than these have no field of their own.
MOST_PLACEMENTS = 64


class Insides:
    """What fills the scene's meshes, by what it is made of; `volumes` has the scene's fields."""

    def __init__(self, volumes, report):
        self._volumes, self._report = volumes, report
        # (object, data) -> bounds, as of the last time the mesh was read.
        self._bounds, self._seen = {}, set()
        # (content of the shader, bounds, values of the object, matrix where it counts) -> filling
        self._fillings, self._used = {}, set()

    def begin(self, keep_known):
        """Starts a pass; without `keep_known` every mesh is measured again."""
        self._seen, self._used = set(), set()
        if not keep_known:
            self._bounds = {}

    def forget(self, uids):
        """Has the meshes of these objects or data-blocks measured again."""
        self._bounds = {key: bounds for key, bounds in self._bounds.items() if key[0] not in uids and key[1] not in uids}

    def sweep(self):
        """Frees the memory of what nothing shows any more."""
        self._bounds = {key: bounds for key, bounds in self._bounds.items() if key in self._seen}
        self._fillings = {key: filling for key, filling in self._fillings.items() if key in self._used}

    def of_group(self, group, materials, described, depsgraph):
        """Groups of one placement each, or of all that have no field of their own, the numbers of their materials, and those of the placements;
        `described` are the materials that vary, by slot."""
        count = len(group.rows)
        shown = np.arange(count) if group.kept is None else np.flatnonzero(group.kept)
        first = [[number] for number in shown[:MOST_PLACEMENTS]]
        parts = [_part(group, numbers) for numbers in first]
        self._fill_values(parts, materials.uneven, depsgraph)
        made = [(part, self._numbers(part, materials, described, self._in_field)) for part in parts]
        found = [(*each, numbers) for each, numbers in zip(made, first, strict=True)]
        rest = shown[MOST_PLACEMENTS:]
        if len(rest):
            self._report.tell("volume placements", "Object", group.name)
            found.append((_part(group, rest), self._numbers(parts[0], materials, described, self._in_the_mean), rest.tolist()))
        if len(shown) < count:
            lost = np.flatnonzero(~group.kept)
            found.append((_part(group, lost), materials.numbers, lost.tolist()))
        return found

    def _fill_values(self, parts, uneven, depsgraph):
        """What the shaders want of each placement."""
        wanted = frozenset().union(*(inside.translator.instance_primvars for inside in uneven.values()))
        each = [wanted] * len(parts)
        if RANDOM in wanted:
            fill_random(depsgraph, parts)
        if any(name.startswith(INSTANCER) for name in wanted):
            fill_instancer(depsgraph, parts, each, self._report)
        if any(is_given(name) for name in wanted):
            fill_given(depsgraph, parts, each)

    def _numbers(self, part, materials, described, medium_of):
        """The numbers of one placement's materials, those that vary written for it."""
        numbers = list(materials.numbers)
        for slot, inside in materials.uneven.items():
            with self._report.guard("Object", part.name, "its inside stays empty"):
                values = values_of(part, inside.translator.instance_primvars)
                here = Place(part.matrices[0].astype(float), {name: value[0] for name, value in values.items()})
                filling = self._filling(part, inside, here)
                for limit, subject in filling.told:
                    self._report.tell(limit, "Object", part.name, subject)
                medium = medium_of(part, filling, here)
                numbers[slot] = self._volumes.material({**described[slot], "medium": medium})
        return numbers

    def _in_field(self, part, filling, here):
        """The medium of one placement."""
        return {**filling.medium(1.0), "field": self._volumes.field(part.name, filling, here.matrix)[0]}

    def _in_the_mean(self, part, filling, here):
        """A medium that is the same everywhere, with as much in the box of the mesh."""
        medium, sent = filling.medium(float(filling.density.mean())), np.ones(3)
        if filling.taken is not None:
            extinction, scattering = filling.taken.reshape(-1, 2, 3).mean(axis=0) * (filling.absorption + filling.scattering).max()
            medium.update(absorption=(extinction - scattering).tolist(), scattering=scattering.tolist())
        if filling.sent is not None:
            sent = filling.sent.reshape(-1, 3).mean(axis=0)
        elif filling.heat is not None:
            sent = np.full(3, float(filling.heat.mean()))
        return {**medium, "emission": (np.asarray(filling.emission) * sent).tolist()}

    def _filling(self, part, inside, here):
        """What fills one placement, made anew where nothing known is the same."""
        bounds = self._bounds_of(part)
        asked = (content(inside), bounds.stamp, here.values_key())
        for key in ((*asked, None), (*asked, here.matrix.tobytes())):
            if key in self._fillings:
                self._used.add(key)
                return self._fillings[key]
        filling = fill(inside.translator, inside.medium, bounds, here)
        key = (*asked, here.matrix.tobytes() if filling.is_placed else None)
        self._fillings[key] = filling
        self._used.add(key)
        return filling

    def _bounds_of(self, group):
        key = (group.object_uid, group.data_uid)
        self._seen.add(key)
        if key not in self._bounds:
            self._bounds[key] = bounds_of(group)
        return self._bounds[key]


def _part(group, numbers):
    """Some placements of a group."""
    kept = None if group.kept is None or group.kept[numbers].all() else group.kept[numbers]
    of_part = {"rows": [group.rows[number] for number in numbers], "matrices": group.matrices[numbers], "kept": kept, "instancer": {}}
    return replace(group, **of_part, is_itself=group.is_itself and numbers[0] == 0, is_filled=True)


def content(inside):
    """What a shader comes to, to be compared; itself where it looks up pictures, whose numbers tell nothing of their pixels."""
    medium = inside.medium
    sources = [value.input() for value in (medium.absorption, medium.scattering, medium.emission, medium.turned)]
    nodes, order = inside.translator.graph.reachable(sources)
    if any(isinstance(node["operation"], dict) and "Image" in node["operation"] for node in nodes):
        return inside
    return json.dumps([nodes, [renumber(source, order) for source in sources]])
