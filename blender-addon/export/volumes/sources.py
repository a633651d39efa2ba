# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a volume's grids come from: files, what geometry nodes made, simulations of smoke and fire."""

import os
import tempfile
from hashlib import blake2b

import bpy

from ..gather import domain_of
from .domain import grids_of
from .stored import Stored

# Where the random name in the head of a VDB file ends.
HEAD = 57


class Sources:
    """The grids of volume objects, by object and data."""

    def __init__(self):
        self._known, self._seen, self._folder = {}, set(), None

    def begin(self, keep_known):
        """Starts a pass; without `keep_known` everything is looked at again."""
        self._seen = set()
        if not keep_known:
            self._known = {}

    def forget(self, uids):
        """Has the grids of these objects or data-blocks looked at again."""
        self._known = {key: known for key, known in self._known.items() if key[0] not in uids and key[1] not in uids}

    def sweep(self):
        """Forgets what nothing shows any more, with its temporary files."""
        self._known = {key: known for key, known in self._known.items() if key in self._seen}
        if self._folder is not None:
            kept = {os.path.basename(grids.path) for grids in self._known.values() if isinstance(grids, Stored)}
            for name in os.listdir(self._folder.name):
                if name not in kept:
                    os.remove(os.path.join(self._folder.name, name))

    def of_group(self, group):
        """The grids of a group; None where there are none, at this frame or at all."""
        key = (group.object_uid, group.data_uid)
        self._seen.add(key)
        if key not in self._known:
            self._known[key] = self._read(group)
        return self._known[key]

    def _read(self, group):
        if not isinstance(group.data, bpy.types.Volume):
            return grids_of(group.source, domain_of(group.source))
        if group.data.filepath:
            return self._file(group.data)
        return self._saved(group.data)

    def _file(self, volume):
        """The file of the frame; none beyond the ends of a clipped sequence."""
        if not volume.grids.is_loaded and not volume.grids.load():
            if volume.is_sequence and not volume.grids.frame_filepath:
                return None
            raise ValueError(volume.grids.error_message or f"'{volume.filepath}' cannot be read")
        path = volume.grids.frame_filepath
        if not path:
            return None
        found = os.stat(path)
        return Stored(path, (path, found.st_mtime_ns, found.st_size))

    def _saved(self, volume):
        """Grids that geometry nodes made are in no file: Blender writes them to one for us."""
        if not len(volume.grids):
            return None
        self._folder = self._folder or tempfile.TemporaryDirectory(prefix="gonio-volumes-")
        path = os.path.join(self._folder.name, f"{volume.session_uid}.vdb")
        if not volume.grids.save(filepath=path):
            raise ValueError("Blender cannot write its grids to a temporary file")
        with open(path, "rb") as file:
            digest = blake2b(file.read()[HEAD:], digest_size=16).digest()
        return Stored(path, ("made", digest))
