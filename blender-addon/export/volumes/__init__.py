# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene's volumes: fields of numbers, the boxes that hold them, and what fills these; one of each for each placement."""

from dataclasses import replace

import numpy as np
from gonio.medium import volume_material

from ..gather import fill_random
from ..instances import values_of
from ..material.inputs import RANDOM
from ..slots import Slots
from ..transforms import columns
from ..visibility import RAYS
from .asked import lacking
from .filling import Place, fill
from .flow import flowing
from .sources import Sources

# The density of what nothing shows any more.
NOTHING = np.zeros((1, 1, 1), dtype=np.float32)


class Volumes:
    """Numbers of the scene's fields, by what is in them and where; `meshes` and `materials` are the places of all of the scene's."""

    def __init__(self, scene, meshes, materials, report):
        self._scene, self._meshes, self._materials, self._report = scene, meshes, materials, report
        self._fields, self._sources = Slots(), Sources()
        # By the key of a field: the matrix that places its box.
        self._boxes = {}
        # By the number of a field: its box, and how it flows.
        self._flowing = {}
        # (object, data, placement) -> (what it was made from, filling)
        self._fillings, self._seen = {}, set()
        # Materials of this pass, and of the pass before.
        self._count = self._before = 0
        self.any_written = self.any_shaded = False

    def begin(self, keep_known):
        """Starts a pass; without `keep_known` files and simulations are looked at again."""
        self._fields.begin()
        self.any_written = self.any_shaded = False
        self._seen, self._before, self._count, self._flowing = set(), self._count, 0, {}
        self._sources.begin(keep_known)

    def forget(self, uids):
        """Has the grids of these objects or data-blocks read again."""
        self._sources.forget(uids)

    def of_group(self, group, inside, depsgraph):
        """What a group shows: a group of one placement each, its box as a kind with its number, its material's number; the placement's number, and the
        matrix from the box to its space. `inside` is a translator, the medium and the material's name and index."""
        if inside.medium is None:
            return []
        grids = self._sources.of_group(group)
        if grids is None:
            return []
        self._tell_lacking(group, inside, grids)
        wanted = frozenset(inside.translator.instance_primvars)
        if RANDOM in wanted:
            fill_random(depsgraph, [group])
        values = values_of(group, wanted)
        found = []
        for number, matrix in enumerate(group.matrices):
            if group.kept is None or group.kept[number]:
                with self._report.guard("Object", group.name, "it is left out"):
                    here = Place(matrix.astype(float), {name: value[number] for name, value in values.items()})
                    filling = self._filling((group.object_uid, group.data_uid, number), inside, grids, here)
                    if filling is not None:
                        for limit, subject in filling.told:
                            self._report.tell(limit, "Object", group.name, subject)
                        found.append(self._shown(group, number, (grids, filling), here, inside))
        return found

    def _tell_lacking(self, group, inside, grids):
        """Tells of grids that shaders ask for and the volume has not: misspelt names show nothing."""
        medium = inside.medium
        values = (medium.absorption, medium.scattering, medium.emission)
        for name, instead in sorted(lacking(inside.translator, values, grids).items()):
            self._report.add(
                "Object", group.name, f"it has no grid '{name}', which its shader asks for; {instead:g} in its place, as in Cycles"
            )

    def _filling(self, key, inside, grids, here):
        """What fills one placement, made anew where something of it is another."""
        self._seen.add(key)
        asked = (inside, grids, here.values_key(), here.matrix.tobytes())
        before, filling = self._fillings.get(key, (None, None))
        if before is None or before[:3] != asked[:3] or (filling is not None and filling.is_placed and before[3] != asked[3]):
            filling = fill(inside.translator, inside.medium, grids, here)
        self._fillings[key] = asked, filling
        return filling

    def field(self, name, filling, matrix, beyond=None):
        """The number of a field at a place, written if it is not there yet; its key, and whether it was written. `beyond` says for how many
        points it goes on before and behind its own."""
        to_world = matrix @ filling.to_object
        key = (filling.digest, to_world.tobytes(), repr(beyond))
        field, is_new = self._fields.take(key)
        if is_new:
            described = {"origin": _origin(name), "to_world": columns(to_world), "glow": filling.glow, "hottest": filling.hottest}
            described |= {} if beyond is None else {"beyond": beyond}
            sources = {"density": filling.density, "heat": filling.heat, **filling.colours()}
            self._fields.place(lambda index: self._scene.put_field(described, index, **sources), field)
            self.any_written = True
        return field, key, is_new

    def _shown(self, group, number, filled, here, inside):
        """Writes what is not there yet; gives the group of one placement, the box and the material. `filled` are the grids and what is made of them."""
        grids, filling = filled
        field, key, is_new = self.field(group.name, filling, here.matrix)
        box, is_new_too = self._meshes.take(("box", key))
        if is_new or is_new_too:
            self._meshes.place(lambda index: self._keep_box(key, field, index), box)
        flow = flowing(group, grids, filling, here)
        if flow is not None:
            self._flowing[field] = box, flow
        medium = {**filling.medium(here.density(group.data)), "field": field}
        material = self.material(_described(inside.name, medium, inside.pass_index))
        visibility = {ray: group.visibility[ray] for ray in RAYS}
        placed = np.ascontiguousarray(self._boxes[key], dtype=np.float32)[None]
        rows = [group.rows[number]]
        shown = replace(group, rows=rows, matrices=placed, kept=None, is_itself=False, visibility=visibility)
        return shown, ("mesh", box), [material], number, np.linalg.inv(here.matrix) @ self._boxes[key]

    def blur(self, shutter, rate):
        """Has volumes flow that have velocities while the shutter is open, and their boxes hold them; `rate` is that of frames a second."""
        for field, (box, flow) in self._flowing.items():
            with self._report.guard("Object", flow.name, "it does not flow"):
                self._scene.put_flow(field, columns(flow.to_world), flow.source(shutter, rate), flow.rests(shutter))
                self._scene.put_field_box(field, box)

    def _keep_box(self, key, field, index):
        _, self._boxes[key] = self._scene.put_field_box(field, index)

    def material(self, described):
        """The number of the material of one placement."""
        number, _ = self._materials.take(("volume", self._count))
        self._count += 1
        self.any_shaded |= self._materials.put(self._scene.put_material, described, number)
        return number

    def sweep(self):
        """Frees the memory of what nothing shows any more."""
        for number in range(self._count, self._before):
            self._materials.put(self._scene.put_material, _described("nothing", {}, 0), self._materials.take(("volume", number))[0])
        self._sources.sweep()
        self._fillings = {key: known for key, known in self._fillings.items() if key in self._seen}
        freed = self._fields.sweep()
        if not freed:
            return
        left = self._fields.trim()
        self._scene.truncate("fields", left)
        for number in freed:
            if number < left:
                self._fields.place(lambda index: self._scene.put_field({"origin": _origin("nothing")}, index, density=NOTHING), number)
        self._boxes = {key: box for key, box in self._boxes.items() if key in self._fields}


def _origin(name):
    return {"name": name, "file": ""}


def _described(name, medium, pass_index):
    """A material with nothing at its surface and a medium behind it."""
    return {**volume_material(name, medium), "origin": _origin(name), "pass_index": pass_index}
