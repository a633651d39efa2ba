# SPDX-License-Identifier: GPL-3.0-or-later
"""Some objects of a view layer, exported alone and in axes of their own."""

from dataclasses import dataclass

import numpy as np

from .transforms import usable


@dataclass(frozen=True, eq=False)
class Part:
    """Which objects, by session_uid, and the matrix that leads from the axes that they are exported in to the world."""

    uids: frozenset
    frame: np.ndarray

    def shows(self, item):
        """Whether a row of the depsgraph's walk belongs to it; instances belong to what places them."""
        shown_by = item.parent if item.is_instance else item.object
        return shown_by.original.session_uid in self.uids

    def placed(self, matrices):
        """Matrices (N, 4, 4) to the world as those to the part's own axes."""
        return np.ascontiguousarray(np.linalg.inv(self.frame) @ matrices.astype(float), dtype=np.float32)


def frame_of(matrix):
    """A matrix without scale and shear: z as it is, x across it; mirrored ones stay so. Raises ValueError where an axis has no length."""
    frame = np.array(matrix, dtype=float)
    if not usable(frame[None])[0]:
        raise ValueError("its axes have no length, or are not numbers; C planes cannot be laid about them")
    x, y, z = frame[:3, :3].T
    z = z / np.linalg.norm(z)
    x = x - (x @ z) * z
    x = x / np.linalg.norm(x)
    y = y - (y @ z) * z - (y @ x) * x
    frame[:3, :3] = np.stack([x, y / np.linalg.norm(y), z], axis=1)
    return frame
