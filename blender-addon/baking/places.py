# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the pixels of a texture, or the corners of faces, lie on an object, as Blender gives them."""

from dataclasses import dataclass, replace

import numpy as np

# How far corners are moved into their faces, as a share of the greatest coordinate: many roundings, and nothing that one sees. As in Cycles.
INWARDS = 1e-4


@dataclass(frozen=True, eq=False)
class Places:
    """`triangles` (height, width), -1 where nothing lies, rows from the top; `at` (height, width, 2) are barycentric coordinates of corners 1 and 2
    in the middle of a pixel, and `steps` (height, width, 4) how both change to the next column and the next row."""

    triangles: np.ndarray
    at: np.ndarray
    steps: np.ndarray

    @property
    def known(self) -> np.ndarray:
        """Which pixels lie on the object."""
        return self.triangles >= 0

    @property
    def are_points(self) -> bool:
        """Whether all samples of a pixel lie in one place, as those of vertex colours do."""
        return not self.steps.any()


def read_places(result, width: int, height: int) -> Places:
    """The places of a render result that Blender made for baking.

    Blender counts the coordinates of corners 0 and 1, and its steps are those of half a pixel.
    """
    passes = {each.name: each for each in result.layers[0].passes}
    primitive, steps = (_read(passes[name], width, height) for name in ("BakePrimitive", "BakeDifferential"))
    # Numbers of triangles stand there bit for bit.
    triangles = np.ascontiguousarray(primitive[..., 2]).view(np.int32)
    # Elsewhere anything may stand.
    primitive, steps = (np.where(triangles[..., None] >= 0, each, np.float32(0.0)) for each in (primitive, steps))
    corner_0, corner_1 = primitive[..., 0], primitive[..., 1]
    at = np.stack([corner_1, 1.0 - corner_0 - corner_1], axis=-1)
    along_0, down_0, along_1, down_1 = (2.0 * steps[..., number] for number in range(4))
    changes = np.stack([along_1, -along_0 - along_1, down_1, -down_0 - down_1], axis=-1)
    return Places(*(np.ascontiguousarray(each) for each in (triangles, _finite(at), _finite(changes))))


def _read(kind, width: int, height: int) -> np.ndarray:
    flat = np.empty(width * height * kind.channels, dtype=np.float32)
    kind.rect.foreach_get(flat)
    return flat.reshape(height, width, kind.channels)[::-1]


def _finite(values: np.ndarray) -> np.ndarray:
    """Nothing is known of pixels where nothing lies."""
    return np.nan_to_num(values, nan=0.0, posinf=0.0, neginf=0.0).astype(np.float32)


def within_faces(thing, places: Places) -> Places:
    """Places a little nearer to the middles of their triangles, and a little spread: rounding alone would say on which side of a face they start
    that meets theirs at an edge, as a floor meets what stands on it; and what looks around a place takes its random numbers from that."""
    mesh, known = thing.data, places.known
    points = np.empty((len(mesh.vertices), 3), dtype=np.float32)
    mesh.vertices.foreach_get("co", points.reshape(-1))
    matrix = np.array(thing.matrix_world, dtype=np.float32)
    corners = (points @ matrix[:3, :3].T + matrix[:3, 3])[_triangles(mesh, "vertices")[places.triangles[known]]]
    u, v = np.moveaxis(places.at[known], -1, 0)
    weights = np.stack([1.0 - u - v, u, v], axis=-1)
    away = np.linalg.norm(corners.mean(axis=1) - (weights[..., None] * corners).sum(axis=1), axis=-1)
    share = np.minimum(INWARDS * np.abs(corners).max(axis=(1, 2)) / np.maximum(away, 1e-30), 0.5)[:, None]
    at, steps = places.at.copy(), places.steps.copy()
    at[known] += share * (1.0 / 3.0 - at[known])
    # So wide that none leaves its triangle.
    steps[known] = share / 4.0 * (1.0, 0.0, 0.0, 1.0)
    return replace(places, at=at, steps=steps)


def _triangles(mesh, of: str) -> np.ndarray:
    """The corners of triangles (count, 3), as numbers of "loops" or "vertices"."""
    mesh.calc_loop_triangles()
    corners = np.empty((len(mesh.loop_triangles), 3), dtype=np.int32)
    mesh.loop_triangles.foreach_get(of, corners.reshape(-1))
    return corners


def texture_coordinates(mesh, places: Places) -> np.ndarray:
    """Coordinates (height, width, 3) of the active UV map, 1 in the third channel; zeros without a map."""
    found = np.zeros((*places.triangles.shape, 3), dtype=np.float32)
    layer = mesh.uv_layers.active
    if layer is None:
        return found
    corners = _triangles(mesh, "loops")
    uv = np.empty((len(mesh.loops), 2), dtype=np.float32)
    layer.uv.foreach_get("vector", uv.reshape(-1))
    known = places.known
    a, b, c = np.moveaxis(uv[corners[places.triangles[known]]], 1, 0)
    u, v = places.at[known].T[..., None]
    found[known] = np.concatenate([a * (1.0 - u - v) + b * u + c * v, np.ones_like(u)], axis=1)
    return found
