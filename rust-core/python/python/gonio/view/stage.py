"""Stages as the window gets them: read in another process, the latest wish first."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .._gonio import Error
from ..scene import Scene
from .camera import Box, Description, box_of

# What a placement is called: the path of its prim, and how many of its kind there are.
Placement = tuple[str, int]


@dataclass(frozen=True, eq=False)
class Seen:
    """A stage that was read."""

    scene: Scene
    about: dict[str, Any] = field(repr=False)

    @property
    def up(self) -> str:
        """The vertical axis: Y or Z."""
        return str(self.about["up"])

    @property
    def bounds(self) -> Box | None:
        """What holds all surfaces; metres."""
        return box_of(self.about["bounds"])

    @property
    def cameras(self) -> list[Description]:
        """The stage's, as `Scene.put_camera` takes them."""
        return list(self.about["cameras"])

    @property
    def names_of_cameras(self) -> list[str]:
        """Their paths."""
        return [str(camera["origin"]["name"]) for camera in self.cameras]

    @property
    def frames(self) -> tuple[float, float] | None:
        """First and last frame, if there are several."""
        frames = self.about["frames"]
        return (frames[0], frames[1]) if frames and frames[1] > frames[0] else None

    @property
    def placements(self) -> list[Placement]:
        """By the numbers of the pass `primId`."""
        return [(name, count) for name, count in self.about["placements"]]

    @property
    def headlight(self) -> tuple[int, Description] | None:
        """The number and the description of the light at the camera, for stages without any."""
        found = self.about["headlight"]
        return (found[0], found[1]) if found else None

    @property
    def messages(self) -> list[tuple[bool, str]]:
        """What is not as the stage asked for: whether it is a warning, and the words."""
        return [(warns, text) for warns, text in self.about["messages"]]


@dataclass(frozen=True)
class Broken:
    """A stage that could not be read."""

    message: str


@dataclass(frozen=True)
class Files:
    """The files that the stage is made of."""

    paths: list[str]


Told = Seen | Broken | Files


class StageReader:
    """Reads a stage again and again; `tell` is called from a thread of its own with what came of it."""

    def __init__(self, words: Sequence[str], folder: str | os.PathLike[str], tell: Callable[[Told], None]) -> None:
        self._words, self._folder, self._tell = [*words], os.fspath(folder), tell
        self._condition = threading.Condition()
        # The frame to read, and whether the stage's files are to be told too.
        self._asked: tuple[float | None, bool] | None = None
        self._closed = False
        self._bundles = tempfile.TemporaryDirectory(prefix="gonio-view-")
        self._process = self._start()
        self._thread = threading.Thread(target=self._run, name="gonio view: stage", daemon=True)
        self._thread.start()

    def read(self, frame: float | None, *, files: bool = True) -> None:
        """Reads the stage at a frame, the first one without it, and tells its files; of several wishes that wait the latest counts."""
        with self._condition:
            self._asked = (frame, files or (self._asked is not None and self._asked[1]))
            self._condition.notify()

    def close(self) -> None:
        """Ends the other process."""
        with self._condition:
            self._closed = True
            self._condition.notify()
        self._process.kill()
        self._thread.join()
        self._end()
        self._bundles.cleanup()

    def _run(self) -> None:
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._asked is not None or self._closed)
                if self._closed or self._asked is None:
                    return
                (frame, files), self._asked = self._asked, None
            self._read(frame, files)

    def _read(self, frame: float | None, files: bool) -> None:
        path = Path(self._bundles.name, "scene.gonio")
        asked = {"words": self._words, "folder": self._folder, "frame": frame, "scene": os.fspath(path), "files": files}
        if self._process.poll() is not None:
            self._end()
            self._process = self._start()
        about = self._ask(asked)
        if about is None or self._closed:
            return
        if "error" in about:
            self._tell(Broken(about["error"]))
            return
        try:
            scene = Scene.load(path)
            # Large ones shall not lie about if this process is ended from outside.
            path.unlink()
            self._tell(Seen(scene, about))
        except (Error, OSError) as error:
            self._tell(Broken(str(error)))
        found = self._answer() if files else None
        if found is not None:
            self._tell(Files(found["files"]))

    def _ask(self, asked: dict[str, Any]) -> dict[str, Any] | None:
        line = json.dumps(asked) + "\n"
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(line.encode())
            self._process.stdin.flush()
        except OSError:
            # It has ended, which the missing answer tells.
            pass
        return self._answer()

    def _answer(self) -> dict[str, Any] | None:
        """The next line; None once the process has ended, which is told."""
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if line:
            return dict(json.loads(line))
        status = self._process.wait()
        if not self._closed:
            self._tell(Broken(_cause(status)))
        return None

    def _start(self) -> subprocess.Popen[bytes]:
        line = [sys.executable, "-m", "gonio.view.reader"]
        # The other process finds this package as this one did.
        paths = os.pathsep.join(path for path in sys.path if path)
        environment = {**os.environ, "PYTHONPATH": paths}
        return subprocess.Popen(line, stdin=subprocess.PIPE, stdout=subprocess.PIPE, env=environment)

    def _end(self) -> None:
        """Gives back what a process that has ended leaves open."""
        self._process.wait()
        for pipe in (self._process.stdin, self._process.stdout):
            if pipe is not None:
                try:
                    pipe.close()
                except OSError:
                    # What was written last finds nobody.
                    pass


def _cause(status: int) -> str:
    """Why a process ended that was to read on."""
    if status >= 0:
        return f"the process that reads stages has ended (status {status})"
    signals = {one.value: one.name for one in signal.Signals}
    name = signals.get(-status, f"signal {-status}")
    return f"the USD library broke down ({name}) over the stage: it is damaged, or was changed while it was read"
