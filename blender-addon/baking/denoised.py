# SPDX-License-Identifier: GPL-3.0-or-later
"""Denoising of bakes: the pixels between the parts of a texture are filled before, lest their black darken what lies beside them."""

import gonio
import numpy as np
from gonio.oidn import denoised_bytes


def denoised(pixels: np.ndarray, known: np.ndarray, scene, report) -> np.ndarray:
    """Light without most of its noise; as it is, with a line, where there is no denoiser. `known` says where pixels lie on the object."""
    height, width, _ = pixels.shape
    try:
        quiet = denoised_bytes(width, height, filled(pixels, known).astype(np.float32).tobytes(), None, None, None)
    except gonio.UnsupportedError:
        report.tell("bake denoising", "Scene", scene.name)
        return pixels
    return np.where(known[..., None], np.frombuffer(quiet, np.float32).reshape(height, width, 3), np.float32(0.0))


def filled(pixels: np.ndarray, known: np.ndarray) -> np.ndarray:
    """Pixels that are not known mirror known ones at the border that is next along their row or column: of the same light, and as noisy, for
    denoisers take what goes on evenly for detail."""
    # What has nothing known in its row and its column comes in the second turn.
    for _ in range(2):
        by_row, from_column = _mirrored(known)
        by_column, from_row = (each.T for each in _mirrored(known.T))
        rows, columns = np.indices(known.shape, dtype=np.int32, sparse=True)
        along = by_row <= by_column
        found = pixels[np.where(along, rows, from_row), np.where(along, from_column, columns)]
        pixels = np.where(known[..., None], pixels, found)
        known = known | (np.minimum(by_row, by_column) < max(known.shape))
    return pixels


def _mirrored(known: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """How far the nearest known pixel of a row is, and which one lies as far within; by its own number where none is."""
    height, width = known.shape
    here, none = np.arange(width, dtype=np.int32), 2 * max(height, width)
    before = np.maximum.accumulate(np.where(known, here, np.int32(-none)), axis=1)
    behind = np.minimum.accumulate(np.where(known, here, np.int32(2 * none))[:, ::-1], axis=1)[:, ::-1]
    is_before = here - before <= behind - here
    border = np.where(is_before, before, behind)
    far = np.abs(border - here)
    within = np.clip(2 * border - here + np.where(is_before, 1, -1), 0, width - 1)
    border = np.where(far < none // 2, border, here)
    return far, np.where(np.take_along_axis(known, within, axis=1), within, border)
