"""A Dask cluster that renders."""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from .._gonio import Cancelled, Error, __version__
from . import source as sources
from . import worker
from .extra import PATIENCE, connect
from .job import Job, Range, Report

# Parts that each of a worker's threads gets: enough for the quick to help out the slow.
PARTS_A_THREAD = 4
# SIMD levels from the plainest to the widest.
LEVELS = ("scalar", "neon", "sse4.2", "avx2", "avx512")


class Cluster:
    """The workers of a scheduler, all with this version of gonio; `cancelled` is asked several times a second whether to stop."""

    def __init__(self, address: str, cancelled: Callable[[], bool]) -> None:
        """Connects to a scheduler's address or scheduler file; `gonio.Error` says in one line why the cluster cannot be used."""
        self.cancelled = cancelled
        self.client = connect(address)
        self._wait_for_workers(address)
        self.level = self._common_level()

    def parts_for(self, frames: int) -> int:
        """Parts that each of so many frames is best cut into."""
        return -(-PARTS_A_THREAD * self.threads() // frames)

    def threads(self) -> int:
        """Threads of all workers there are at the moment."""
        return sum(self.client.nthreads().values())

    def render(self, source: tuple[Any, ...], frames: Sequence[float | None], parts: Sequence[Range], report: Report) -> Iterator[list[str]]:
        """For each frame in order the files of its parts, which are gone when the next is asked for.

        `source` is what `gonio.farm.source.sources` takes before the frames. Leaving the iterator cancels what is under way.
        """
        *_, inputs, send = source
        if not send:
            self._check_seen(sources.files_of(inputs))
        with tempfile.TemporaryDirectory(prefix="gonio-farm-") as folder:
            yield from self.gather(sources.sources(*source, frames), parts, Path(folder), report)

    def gather(self, frames: Sequence[Callable[[], Any]], parts: Sequence[Range], folder: Path, report: Report) -> Iterator[list[str]]:
        """The same for sources that functions give, with the files in `folder`."""
        job = Job(self, frames, parts, folder, report)
        try:
            yield from job.frames()
        finally:
            job.cancel()
            self.client.close()

    def _wait_for_workers(self, address: str) -> None:
        end = time.monotonic() + PATIENCE
        while not self.client.nthreads():
            if self.cancelled():
                raise Cancelled("the render was cancelled")
            if time.monotonic() > end:
                raise Error(f"the Dask scheduler at {address} has no workers: start some with 'dask worker {address}'")
            time.sleep(0.2)

    def _on_all(self, function: Callable[..., Any], *arguments: Any) -> dict[str, Any]:
        """What a function gives on each worker; `gonio.Error` where one does not have gonio."""
        answers = self.client.run(function, *arguments, on_error="return")
        for address, answer in answers.items():
            if isinstance(answer, BaseException):
                raise Error(f"worker {address} cannot run gonio {__version__} ({type(answer).__name__}: {answer}): install it there")
        return answers

    def _common_level(self) -> str:
        """The widest SIMD level that all workers have: others would give other bits."""
        answers = self._on_all(worker.census)
        for address, (version, _) in answers.items():
            if version != __version__:
                raise Error(f"worker {address} has gonio {version}, this is {__version__}")
        levels = {level for _, level in answers.values()}
        if "neon" in levels and len(levels) > 1:
            raise Error(f"the workers' SIMD levels {', '.join(sorted(levels))} have none in common but scalar: set GONIO_SIMD=scalar")
        return min([*levels, *filter(None, [os.environ.get("GONIO_SIMD")])], key=LEVELS.index)

    def _check_seen(self, files: Sequence[str]) -> None:
        for address, unseen in self._on_all(sources.unseen, list(files)).items():
            if unseen:
                raise Error(f"worker {address} cannot read {unseen[0]}; {sources.REMEDY}")
