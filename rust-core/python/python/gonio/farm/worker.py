"""What runs on a cluster's workers."""

from __future__ import annotations

import os
import tempfile
import threading
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from .._gonio import Cancelled, Error, Render, __version__, simd_level
from ..scene import Scene
from .extra import require
from .source import Bundle, Stage

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


def hold(source: Stage | Bundle) -> Stage | Bundle:
    """A source as a task of its own: sent once, handed on between workers, and made again where it is lost."""
    return source


def render_part(source: Stage | Bundle, part: Mapping[str, Any], level: str) -> bytes:
    """The checkpoint of a part of a frame (see `Scene.parts`) at a SIMD level; `gonio.Error` names the worker."""
    worker = require().get_worker()
    key = worker.get_current_task()

    def unwanted() -> bool:
        task = worker.state.tasks.get(key)
        return task is None or task.state == "cancelled"

    # The level is looked up by every render.
    os.environ["GONIO_SIMD"] = level
    try:
        return _sums(_start(source, part, worker.state.nthreads, unwanted), unwanted)
    except Cancelled:
        raise
    except (Error, OSError) as error:
        raise Error(f"worker {worker.address}: {error}") from None


def _start(source: Stage | Bundle, part: Mapping[str, Any], tasks: int, unwanted: Any) -> Render:
    """Starts a part with its share of the cores of a worker that does so many tasks at a time."""
    from dask.system import CPU_COUNT

    with _Kept.lock:
        if _Kept.name != source.name:
            _Kept.scene, _Kept.name = source.scene(), source.name
        _Kept.scene.set(**part, threads=max(1, CPU_COUNT // tasks))
        _Kept.render = Render(_Kept.scene, _Kept.render, cancelled=unwanted)
        return _Kept.render


def _sums(render: Render, unwanted: Any) -> bytes:
    while not render.wait(POLL):
        if unwanted():
            render.cancel()
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "part")
        render.checkpoint(path)
        return path.read_bytes()
