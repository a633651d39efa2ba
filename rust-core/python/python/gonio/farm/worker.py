"""What runs on a cluster's workers."""

from __future__ import annotations

import os
import tempfile
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any

from .._gonio import Cancelled, Error, Render, __version__, simd_level
from .. import _gonio
from ..scene import Scene
from .extra import require
from .source import Bundle, Stage, Year

# Seconds between two looks at whether a part is still wanted.
POLL = 0.25


class _Kept:
    """The last scene of this process, and a render of it that lends its trees to the next."""

    lock = threading.Lock()
    name = ""
    scene = Scene()
    render: Render | None = None


def census() -> tuple[str, str]:
    """Version of gonio and SIMD level here."""
    return __version__, simd_level


def hold(source: Any) -> Any:
    """A source as a task of its own: sent once, handed on between workers, and made again where it is lost."""
    return source


def render_part(source: Stage | Bundle, part: tuple[Any, Any], level: str) -> bytes:
    """The checkpoint of some tiles and samples of a frame (see `Scene.parts`) at a SIMD level; `gonio.Error` names the worker."""
    tiles, samples = part
    settings = {"tile_range": tuple(tiles), "sample_range": tuple(samples)}
    return _as_task(level, lambda threads, unwanted: _sums(_start(source, {**settings, "threads": threads}, unwanted), unwanted))


def annual_part(year: Year, part: tuple[int, int], level: str) -> bytes:
    """The checkpoint of a part of a year of daylight, such as (1, 4), at a SIMD level; `gonio.Error` names the worker."""

    def traced(threads: int, unwanted: Callable[[], bool]) -> bytes:
        scene, tracing = year.unpacked()
        scene.set(threads=threads)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder, "part")
            _gonio.annual(scene, year.weather, **tracing, checkpoint=path, part=part, cancelled=unwanted)
            return path.read_bytes()

    return _as_task(level, traced)


def _as_task(level: str, work: Callable[[int, Callable[[], bool]], bytes]) -> bytes:
    """Does a task with its share of the worker's cores; `work` is told how many, and whom to ask whether the task is not wanted any more."""
    from dask.system import CPU_COUNT

    worker = require().get_worker()
    key = worker.get_current_task()

    def unwanted() -> bool:
        task = worker.state.tasks.get(key)
        return task is None or task.state == "cancelled"

    # The level is looked up by every render.
    os.environ["GONIO_SIMD"] = level
    try:
        return work(max(1, CPU_COUNT // worker.state.nthreads), unwanted)
    except Cancelled:
        raise
    except (Error, OSError) as error:
        raise Error(f"worker {worker.address}: {error}") from None


def _start(source: Stage | Bundle, settings: dict[str, Any], unwanted: Callable[[], bool]) -> Render:
    """Starts a part with these settings of the scene."""
    with _Kept.lock:
        if _Kept.name != source.name:
            _Kept.scene, _Kept.name = source.scene(), source.name
        _Kept.scene.set(**settings)
        _Kept.render = Render(_Kept.scene, _Kept.render, cancelled=unwanted)
        return _Kept.render


def _sums(render: Render, unwanted: Callable[[], bool]) -> bytes:
    while not render.wait(POLL):
        if unwanted():
            render.cancel()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "part")
        render.checkpoint(path)
        return path.read_bytes()
