"""The parts of a render, or of a year of daylight, on their way through a cluster."""

from __future__ import annotations

import functools
import queue
import time
import uuid
import warnings
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._gonio import Cancelled, Error
from .extra import require
from .source import Bundle, Stage, Year
from .worker import hold

if TYPE_CHECKING:
    from .cluster import Cluster

# A part of a picture: tiles and samples, first and behind the last. One of a year: its number and how many there are.
Part = tuple[Sequence[int], Sequence[int]] | tuple[int, int]
# What of a frame, or of a year, is sent to workers.
Source = Stage | Bundle | Year
# Does a part of a source at a SIMD level, on a worker.
Work = Callable[[Any, Any, str], bytes]
# Told how much is done, from 0 to 1 and in words, the seconds left if they can be told, and what goes on.
Report = Callable[[float, str, float | None, str], Any]

# Seconds between two looks at whether the work was cancelled.
POLL = 0.2
# Seconds between two questions for how many workers there are.
WORKERS_POLL = 2.0


class Job:
    """All parts of all frames: handed out frame by frame, gathered into files as they come.

    A part is named by its key. Where a worker is lost Dask gives its parts to others, and a part that comes twice has the same bits under the
    same name, so that no sample is lost or doubled.
    """

    def __init__(
        self,
        cluster: Cluster,
        frames: Sequence[Callable[[], Source]],
        parts: Sequence[Part],
        work: Work,
        folder: Path,
        report: Report,
    ) -> None:
        self._cluster, self._frames, self._parts, self._work = cluster, frames, parts, work
        self._folder, self._report = folder, report
        self._name = f"gonio-{uuid.uuid4().hex[:12]}"
        self._futures: dict[tuple[int, int], Any] = {}
        self._held: dict[int, Any] = {}
        self._arrivals: queue.SimpleQueue[tuple[tuple[int, int], BaseException | None]] = queue.SimpleQueue()
        self._files: list[list[str]] = [[] for _ in frames]
        self._handed_out = 0
        self._start = time.monotonic()
        self._workers, self._threads, self._asked = 0, 0, 0.0

    def frames(self) -> Iterator[list[str]]:
        """For each frame in order the files of its parts, which are gone when the next is asked for."""
        for frame, files in enumerate(self._files):
            self._hand_out(frame)
            while len(files) < len(self._parts):
                self._take_arrival()
                self._hand_out(frame)
            del self._held[frame]
            yield files
            for path in files:
                Path(path).unlink()

    def cancel(self) -> None:
        """Takes back what is under way; workers stop within a second."""
        futures, self._futures = [*self._futures.values(), *self._held.values()], {}
        if futures and self._cluster.client.status == "running":
            self._cluster.client.cancel(futures, force=True, reason="the work was cancelled")

    def _hand_out(self, frame: int) -> None:
        """Submits frames, the one that is waited for at least, until all workers have enough to do."""
        self._count_workers()
        while self._handed_out < len(self._frames) and (self._handed_out <= frame or len(self._futures) < 2 * self._threads):
            self._submit(self._handed_out)
            self._handed_out += 1

    def _submit(self, frame: int) -> None:
        client, order = self._cluster.client, {"priority": -frame, "pure": False}
        with warnings.catch_warnings():
            # Dask warns of large arguments, which a scene may well be.
            warnings.simplefilter("ignore", UserWarning)
            source = client.submit(hold, self._frames[frame](), key=(f"{self._name}-scene", frame), **order)
        self._held[frame] = source
        for number, part in enumerate(self._parts):
            key = (f"{self._name}-part", frame, number)
            future = client.submit(self._work, source, part, self._cluster.level, key=key, **order)
            self._futures[frame, number] = future
            future.add_done_callback(functools.partial(self._arrived, (frame, number)))

    def _arrived(self, ticket: tuple[int, int], future: Any) -> None:
        """Keeps a part in a file; runs in a thread of Dask's."""
        try:
            self._path(ticket).write_bytes(future.result())
            self._arrivals.put((ticket, None))
        except Exception as error:
            self._arrivals.put((ticket, error))

    def _path(self, ticket: tuple[int, int]) -> Path:
        return self._folder / "{}-{}.part".format(*ticket)

    def _take_arrival(self) -> None:
        """Waits for the next part, and says now and then how far the whole is."""
        while True:
            if self._cluster.cancelled():
                raise Cancelled("the work was cancelled")
            self._tell()
            try:
                ticket, error = self._arrivals.get(timeout=POLL)
            except queue.Empty:
                self._count_workers()
                continue
            if error is not None:
                raise Error(_explained(error)) from error
            del self._futures[ticket]
            self._files[ticket[0]].append(str(self._path(ticket)))
            return self._tell()

    def _tell(self) -> None:
        done, total = sum(map(len, self._files)), len(self._frames) * len(self._parts)
        left = (time.monotonic() - self._start) * (total - done) / done if done else None
        self._report(done / total, f"{done}/{total} parts", left, f"{self._workers} worker{'s' if self._workers != 1 else ''}")

    def _count_workers(self) -> None:
        if time.monotonic() - self._asked < WORKERS_POLL:
            return
        threads = self._cluster.client.nthreads()
        self._workers, self._threads, self._asked = len(threads), sum(threads.values()), time.monotonic()


def _explained(error: BaseException) -> str:
    """Why a part did not come, in one line."""
    distributed = require()
    if isinstance(error, distributed.scheduler.KilledWorker):
        count, last = error.allowed_failures + 1, error.last_worker.address
        return f"a part of the work was lost with {count} workers, the last {last}: do they have memory enough?"
    if isinstance(error, distributed.CancelledError):
        return f"the cluster has given up the work ({error})"
    return str(error) or type(error).__name__
