"""Looks whether files were saved. By their times, since editors put new files in the places of old ones, and networks tell nobody."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Iterable

# Seconds between two looks; what was just saved must look the same twice, or is still being written.
LOOK_EVERY = 0.25

Mark = tuple[int, int, int] | None


class Watcher:
    """Calls `changed` from a thread of its own with the files that were saved, were removed, or came."""

    def __init__(self, changed: Callable[[list[str]], None], every: float = LOOK_EVERY) -> None:
        self._changed, self._every = changed, every
        self._lock = threading.Lock()
        self._known: dict[str, Mark] = {}
        self._stop = threading.Event()
        self._thread = threading.Thread(target=self._run, name="gonio view: files", daemon=True)
        self._thread.start()

    def watch(self, files: Iterable[str]) -> None:
        """The files from now on. Those watched before are compared with how they were, so that nothing saved in between is missed."""
        with self._lock:
            before = self._known
            self._known = {path: before[path] if path in before else _mark(path) for path in files}

    def close(self) -> None:
        """Looks no more."""
        self._stop.set()
        self._thread.join()

    def _run(self) -> None:
        unsettled: dict[str, Mark] = {}
        while not self._stop.wait(self._every):
            with self._lock:
                known = dict(self._known)
            now = {path: _mark(path) for path in known}
            different = {path: mark for path, mark in now.items() if mark != known[path]}
            if different and different == unsettled:
                with self._lock:
                    self._known.update((path, mark) for path, mark in different.items() if path in self._known)
                unsettled = {}
                self._changed([*different])
            else:
                unsettled = different


def _mark(path: str) -> Mark:
    """What changes when a file is saved; None where there is none."""
    try:
        status = os.stat(path)
    except OSError:
        return None
    return status.st_mtime_ns, status.st_size, status.st_ino
