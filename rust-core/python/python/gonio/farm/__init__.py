"""Renders spread over the workers of a Dask cluster: what the extra `farm` brings (`gonio render --dask`, `render` here)."""

from __future__ import annotations

import functools

from .._gonio import Film, merge
from ..scene import Scene
from .cluster import Cluster
from .source import Bundle

__all__ = ["Cluster", "render"]


def render(scene: Scene, address: str, *, parts: int | None = None) -> Film:
    """The film of a scene rendered by the cluster whose scheduler has this address (or scheduler file), with the bits of one process.

    The scene is sent with its images. `parts` is how many parts the picture is cut into; without it every thread of a worker gets four. Raises
    `gonio.UnsupportedError` without Dask, `gonio.Error` with one line where the cluster cannot be used.
    """
    cluster = Cluster(address, lambda: False)
    ranges = [(part["tile_range"], part["sample_range"]) for part in scene.parts(parts or cluster.parts_for(1))]
    for files in cluster.gather([functools.partial(Bundle.of, scene)], ranges, lambda *_: None):
        film = merge(files)
    return film
