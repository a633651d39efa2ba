# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene's meshes: each data-block once, known by its content."""

import numpy as np

from ..report import words_of
from .compact import compact
from .deforming import with_motion
from .fingerprint import fingerprint
from .gather import AS_MESH
from .mesh import mesh_arguments
from .mesh_attributes import present
from .modelled_normals import modelled
from .passing import passing


class Meshes:
    """Numbers of the scene's meshes, by what is in them, so that the same mesh keeps its tree from frame to frame."""

    def __init__(self, scene, slots, report, pictured):
        self._scene, self._slots, self._report, self._pictured = scene, slots, report, pictured
        # Whether trees are built meanwhile: in the first pass, for later meshes may have the trees of former ones.
        self._ahead = pictured
        # (object, data) -> (content, values wanted, how it is cut, what went wrong) as of the last time it was read
        self._known, self._seen = {}, set()
        # (place in memory, values wanted) -> content, within a pass: many objects may show one mesh
        self._read_now = {}
        self.any_written = False

    def begin(self, keep_known):
        """Starts a pass; without `keep_known` every mesh is compared again."""
        self._slots.begin()
        self.any_written, self._seen, self._read_now = False, set(), {}
        if not keep_known:
            self._known = {}

    def forget(self, uids):
        """Has the data of these objects or data-blocks read again."""
        self._known = {key: known for key, known in self._known.items() if key[0] not in uids and key[1] not in uids}

    def number(self, group, primvars):
        """The number of a group's mesh; None if it has no faces or cannot be read."""
        place = (group.object_uid, group.data_uid)
        self._seen.add(place)
        known = self._known.get(place)
        if known is None or known[1:3] != (primvars, group.dicing):
            known = self._known[place] = self._known_now(group, primvars)
        key, _, _, problem = known
        if problem:
            self._report.add("Object", group.name, problem, severity="ERROR")
        return None if key is None else self._slots.take(key)[0]

    def _known_now(self, group, primvars):
        """What is known of a group's mesh once it was read; one that cannot be read is left out."""
        try:
            return self._read(group, primvars), primvars, group.dicing, ""
        except Exception as problem:
            return None, primvars, group.dicing, f"{words_of(problem)}; it is left out"

    def _read(self, group, primvars):
        """Reads a mesh and writes it to the scene if nothing like it is there; gives its key."""
        if group.kind == "MESH" and not _is_being_edited(group):
            here = (group.data.as_pointer(), primvars, group.dicing)
            if here not in self._read_now:
                with passing(group) as mesh:
                    key, arguments = self._told(group, mesh, primvars)
                self._read_now[here] = self._write(group, key, arguments)
            return self._read_now[here]
        if group.kind != "MESH" and group.kind not in AS_MESH:
            return None
        mesh = group.source.to_mesh()
        try:
            key, arguments = (None, None) if mesh is None else self._told(group, mesh, primvars)
        finally:
            group.source.to_mesh_clear()
        return self._write(group, key, arguments)

    def _told(self, group, mesh, primvars):
        """What a mesh is known by, None for one without faces; and its arguments, None where the scene has them."""
        cut = modelled(group)
        key = (fingerprint(mesh, primvars), frozenset(present(mesh, primvars)), group.dicing, cut and (cut[0].tobytes(), cut[1]))
        if key in self._slots:
            return key, None
        arguments = mesh_arguments(mesh, primvars, cut)
        return (key, arguments) if arguments else (None, None)

    def _write(self, group, key, arguments):
        """Has the scene hold a mesh by its key."""
        if arguments is not None:
            number, _ = self._slots.take(key)
            self._add(number, group, arguments)
        return key

    def _add(self, number, group, arguments):
        # Renderers that cut a mesh carry values of points and of corners over to new ones in other ways.
        self.any_written, arguments = True, compact(arguments, keeps_corners=group.dicing is not None)
        points, triangles = arguments.pop("points"), arguments.pop("triangles")
        if self._pictured and arguments["slots"] is None:
            # Pictures do not show which triangles are of one face.
            arguments["faces"] = None

        def put(index):
            made = self._scene.put_mesh(points, triangles, name=group.name, index=index, ahead=self._ahead and group.dicing is None, **arguments)
            if group.dicing is not None:
                self._scene.set_dicing(made, **dict(group.dicing))

        self._slots.place(put, number)

    def blur(self, group, primvars, forms, report):
        """The number of a group's mesh with its forms at even times of the shutter; None where it keeps its form."""
        moving, faces_differ = with_motion(group, primvars, forms)
        if faces_differ:
            report.add("Object", group.name, "its faces are others at other times of the shutter; its form is not blurred")
        if moving is None:
            return None
        with passing(group) as mesh:
            key = (fingerprint(mesh, primvars), frozenset(present(mesh, primvars)), group.dicing, hash(moving["motion"].tobytes()))
        number, is_new = self._slots.take(key)
        if is_new:
            self._add(number, group, moving)
        return number

    def sweep(self):
        """Frees the memory of meshes that nothing shows any more."""
        self._ahead = False
        self._known = {place: known for place, known in self._known.items() if place in self._seen}
        for number in self._slots.sweep():
            nothing = np.zeros((0, 3), dtype=np.float32), np.zeros((0, 3), dtype=np.int32)
            self._slots.place(lambda index, nothing=nothing: self._scene.put_mesh(*nothing, name="nothing", index=index), number)


def _is_being_edited(group):
    """Whether a mesh is open in Edit Mode, where its data-block may hold nothing of what is seen."""
    return group.data.is_editmode and group.source.type == "MESH"
