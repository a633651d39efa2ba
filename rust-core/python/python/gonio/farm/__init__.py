"""Work spread over the workers of a Dask cluster: what the extra `farm` brings (`gonio render --dask`, `gonio annual --dask`, `render` and `annual` here)."""

from __future__ import annotations

import functools
from typing import Any

from .. import _gonio
from .._gonio import AnnualReading, Film, merge
from ..scene import Scene
from .cluster import Cluster
from .source import Bundle, Year

__all__ = ["Cluster", "annual", "render"]


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


def annual(scene: Scene, weather: bytes, address: str, *, parts: int | None = None, **asked: Any) -> list[AnnualReading]:
    """What `gonio.annual` gives with these keywords, traced by the cluster whose scheduler has this address (or scheduler file), to the same bits.

    The scenes are sent with their images. `parts` is how many parts the tracing is cut into, 16 at most; without it every thread of a worker gets four.
    Raises `gonio.UnsupportedError` without Dask, `gonio.Error` with one line where the cluster cannot be used.
    """
    cluster = Cluster(address, asked.get("cancelled") or (lambda: False))
    year = Year.of(scene, weather, asked)
    # Images that travel are part of a scene: the parts are of the scenes as workers have them.
    scene, tracing = year.unpacked()
    readings = []
    for files in cluster.annual(year, parts, lambda *_: None):
        readings = _gonio.annual(scene, weather, **{**asked, **tracing}, merge=files)
    return readings
