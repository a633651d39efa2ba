"""A Dask cluster that renders."""

from __future__ import annotations

import functools
import os
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from .._gonio import Cancelled, Error, __version__
from .extra import PATIENCE, connect
from .job import Job, Part, Report, Source, Work
from .source import REMEDY, Bundle, Stage, Year, files_of, unseen
from .worker import annual_part, census, render_part

# Parts that each of a worker's threads gets: enough for the quick to help out the slow.
PARTS_A_THREAD = 4
# The rounds of a year's tracing, of which a part has one at least.
MOST_PARTS_OF_A_YEAR = 16
# SIMD levels from the plainest to the widest.
LEVELS = ("scalar", "neon", "sse4.2", "avx2", "avx512")


class Cluster:
    """The workers of a scheduler, all with this version of gonio; `cancelled` is asked several times a second whether to stop."""

    def __init__(self, address: str, cancelled: Callable[[], bool]) -> None:
        """Connects to a scheduler's address or scheduler file; `gonio.Error` says in one line why the cluster cannot be used."""
        self.cancelled = cancelled
        self.client = connect(address)
        try:
            self._wait_for_workers(address)
            self.level = self._common_level()
        except BaseException:
            self.client.close()
            raise

    def parts_for(self, frames: int) -> int:
        """Parts that each of so many frames is best cut into."""
        return -(-PARTS_A_THREAD * self.threads() // frames)

    def threads(self) -> int:
        """Threads of all workers there are at the moment."""
        return sum(self.client.nthreads().values())

    def stages(
        self,
        arguments: Sequence[str],
        folder: str | os.PathLike[str],
        inputs: Sequence[str | os.PathLike[str]],
        send: bool,
        frames: Sequence[float | None],
    ) -> list[Callable[[], Source]]:
        """What `gonio render` with these arguments would trace at each frame, for `gather`; paths are relative to `folder`.

        With `send` the stage is read here, else by workers, all of which must see the files that `inputs` are made of.
        """
        if send:
            return [functools.partial(Bundle.of_stage, arguments, folder, frame) for frame in frames]
        files = files_of(inputs)
        for address, paths in self._on_all(unseen, files).items():
            if paths:
                raise Error(f"worker {address} cannot read {paths[0]}; {REMEDY}")
        return [functools.partial(Stage, arguments, folder, files, frame) for frame in frames]

    def gather(self, sources: Sequence[Callable[[], Source]], parts: Sequence[Part], report: Report) -> Iterator[list[str]]:
        """For each frame, whose source a function gives when its turn comes, the files of its parts; they are gone when the next is asked for.

        Leaving the iterator cancels what is under way, and closes the connection.
        """
        return self._gather(sources, parts, render_part, report)

    def annual(self, year: Year, parts: int | None, report: Report) -> Iterator[list[str]]:
        """As `gather` the files of a year's parts, which `gonio.annual` merges; without a number every thread of a worker gets four."""
        count = min(MOST_PARTS_OF_A_YEAR, parts or self.parts_for(1))
        return self._gather([lambda: year], [(number, count) for number in range(1, count + 1)], annual_part, report)

    def _gather(self, sources: Sequence[Callable[[], Source]], parts: Sequence[Part], work: Work, report: Report) -> Iterator[list[str]]:
        with tempfile.TemporaryDirectory(prefix="gonio-farm-") as folder:
            job = Job(self, sources, parts, work, Path(folder), report)
            try:
                yield from job.frames()
            finally:
                job.cancel()
                self.client.close()

    def _wait_for_workers(self, address: str) -> None:
        end = time.monotonic() + PATIENCE
        while not self.client.nthreads():
            if self.cancelled():
                raise Cancelled("the work was cancelled")
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
        answers = self._on_all(census)
        for address, (version, _) in answers.items():
            if version != __version__:
                raise Error(f"worker {address} has gonio {version}, this is {__version__}")
        levels = {level for _, level in answers.values()}
        if "neon" in levels and len(levels) > 1:
            raise Error(f"the workers' SIMD levels {', '.join(sorted(levels))} have none in common but scalar: set GONIO_SIMD=scalar")
        here = {os.environ.get("GONIO_SIMD", "").lower()}.intersection(LEVELS)
        return min(levels | here, key=LEVELS.index)
