# SPDX-License-Identifier: GPL-3.0-or-later
"""Files of measured materials: read once, kept from one export to the next."""

import gonio

from ..file_version import file_version


class Measurements:
    """Numbers of the scene's measured materials."""

    def __init__(self, scene, slots):
        self._scene, self._slots = scene, slots

    def number(self, path):
        """The number of a file as it is now; raises OSError or `gonio.Error` where it cannot be read."""
        key = (str(path), *file_version(path))
        # A file that cannot be read takes no place.
        found = None if key in self._slots else gonio.MeasuredBsdf.from_file(path)
        number, is_new = self._slots.take(key)
        if is_new:
            self._slots.place(self._scene.put_measured, number, found, name=path.name)
        return number
