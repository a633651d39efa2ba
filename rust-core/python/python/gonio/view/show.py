"""What is shown: a stage from a camera in a look, kept up with its files. Knows no widgets."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from PySide6.QtCore import QObject, Signal

from .camera import FreeCamera
from .look import Look, operator_of
from .probe import Probe, Reading
from .session import Failure, Session, Shot, Wish
from .stage import Broken, Files, Seen, StageReader, Told
from .viewpoint import Viewpoint
from .watcher import Watcher

# Files that hold no images.
LAYERS = {".usd", ".usda", ".usdc"}


class Show(QObject):
    """Reads, renders and watches a stage; the signals come in the thread that it lives in."""

    # A `Seen`, and whether it is the first.
    opened = Signal(object, bool)
    # Why there is no newer picture.
    failed = Signal(str)
    # A `Shot`.
    arrived = Signal(object)
    # Pairs of origin and message.
    warned = Signal(object)
    # A `Look`.
    looked = Signal(object)
    reading_began = Signal()
    # The camera is another one, or stands elsewhere.
    viewed = Signal()
    # From other threads into this one.
    _told = Signal(object)
    _shot_told = Signal(object)
    _saved = Signal(object)

    def __init__(self, command: Sequence[str], folder: str | os.PathLike[str], choices: Mapping[str, Any]) -> None:
        super().__init__()
        self._choices = choices
        self.samples: int = choices["samples"]
        self.look = self._first_look(is_camera_lit=False)
        self.viewpoint = Viewpoint()
        self.seen: Seen | None = None
        self.shot: Shot | None = None
        # Why the stage could not be read the last time, and why there was no picture.
        self.stage_problem = ""
        self.frame: float | None = choices.get("frame")
        self._size = (960, 540)
        self._is_measuring = True
        self._probe: Probe | None = None
        self._told.connect(self._take)
        self._shot_told.connect(self._take_shot)
        self._saved.connect(self._take_files)
        self._session = Session(self._shot_told.emit, self.warned.emit)
        self._reader = StageReader(command, folder, self._told.emit)
        self._watcher = Watcher(self._saved.emit)
        self._watcher.watch([os.path.abspath(Path(folder, choices["stage"]))])

    def close(self) -> None:
        """Ends the threads and the other process."""
        self._watcher.close()
        self._reader.close()
        self._session.close()

    def reload(self) -> None:
        """Reads the stage once more, with all its images."""
        self._session.forget()
        self._read(self.frame, files=True)

    def read(self, frame: float | None) -> None:
        """Reads the stage at a frame; the picture stays until then."""
        self._read(frame, files=False)

    def _read(self, frame: float | None, *, files: bool) -> None:
        self.frame = frame
        self.reading_began.emit()
        self._reader.read(frame, files=files)

    def resize(self, size: tuple[int, int]) -> None:
        """Pictures have so many pixels from now on."""
        if size != self._size:
            self._size = size
            self.refresh()

    def refresh(self) -> None:
        """Has what is wanted now rendered."""
        if self.seen is None:
            return
        aspect = self._size[0] / self._size[1]
        view, headlight = self.viewpoint.description(aspect), self.viewpoint.headlight(aspect)
        passes, coarse = self.look.passes(self._is_measuring), self.look.passes(False)
        self._session.show(Wish(self.seen.scene, view, self._size, self.samples, passes, coarse, headlight))
        self.viewed.emit()

    def move(self, how: Callable[[FreeCamera], FreeCamera]) -> None:
        """Moves the camera; the first move frees it, to turn about what is in the picture's middle."""
        middle = self.probe(0.5, 0.5) if self.viewpoint.free is None else None
        self.viewpoint.move(how, None if middle is None else middle.depth)
        self.refresh()

    def frame_all(self) -> None:
        """Shows everything, from the same side."""
        if self.seen is not None:
            bounds, aspect = self.seen.bounds, self._size[0] / self._size[1]
            self.move(lambda camera: camera.framing(bounds, aspect))

    def choose_camera(self, number: int) -> None:
        """Looks through a camera of the stage, the free one for −1."""
        self.viewpoint.choose(number)
        self.refresh()

    def choose_samples(self, samples: int) -> None:
        """Pictures have so many samples a pixel from now on."""
        self.samples = samples
        self.refresh()

    def choose_coarseness(self, factor: int) -> None:
        """How coarse pictures are while the view moves; 0 for what comes in time."""
        self._session.pace.chosen = factor

    def measure(self, is_measuring: bool) -> None:
        """Whether illuminance under the cursor is wanted."""
        self._is_measuring = is_measuring
        self.refresh()

    def set_look(self, look: Look) -> None:
        """Shows pictures so from now on; one that lacks what it takes is rendered anew."""
        if self.look.is_automatic and not look.is_automatic:
            look = look.held(None if self.shot is None else self.shot.film)
        self.look = look
        self.looked.emit(look)
        if self.shot is not None and not set(look.passes(self._is_measuring)) <= set(self.shot.wish.passes):
            self.refresh()

    def change_look(self, **changes: Any) -> None:
        """The same look with other values."""
        self.set_look(replace(self.look, **changes))

    def probe(self, across: float, down: float) -> Reading | None:
        """What lies at a place of the picture, in shares of its width and height; None outside and before there is one."""
        if self.shot is None or self.seen is None:
            return None
        if self._probe is None:
            self._probe = Probe(self.shot.film, self.seen.placements)
        width, height = self._probe.size
        return self._probe.read(int(across * width), int(down * height)) if 0.0 <= across < 1.0 and 0.0 <= down < 1.0 else None

    def _first_look(self, *, is_camera_lit: bool) -> Look:
        operator, ev = operator_of(self._choices["tonemap"], is_camera_lit)
        look = Look(
            show=self._choices["show"],
            operator=operator,
            stops=self._choices["exposure"],
            scale_max=self._choices["scale_max"],
            steps=self._choices["scale_steps"],
            decades=self._choices["scale_log"],
        )
        return look if ev is None else replace(look, is_automatic=False, ev=ev)

    def _take(self, told: Told) -> None:
        if isinstance(told, Files):
            self._watcher.watch(told.paths)
        elif isinstance(told, Broken):
            self.stage_problem = told.message
            self.failed.emit(told.message)
        else:
            is_first = self.seen is None
            self.seen, self.stage_problem = told, ""
            self.frame = told.about["frame"]
            self.viewpoint.take(told)
            if is_first and told.headlight is not None:
                self.look = self._first_look(is_camera_lit=True)
                self.looked.emit(self.look)
            self.opened.emit(told, is_first)
            self.refresh()

    def _take_files(self, saved: list[str]) -> None:
        """Reads the stage once more; images only where others than layers were saved, since that takes long."""
        if all(os.path.splitext(path)[1].lower() in LAYERS for path in saved):
            self._read(self.frame, files=True)
        else:
            self.reload()

    def _take_shot(self, shot: Shot | Failure) -> None:
        if isinstance(shot, Failure):
            self.failed.emit(shot.message)
        elif self.seen is not None and shot.wish.scene is self.seen.scene:
            # What comes late of a stage that is gone has other numbers of prims.
            self.shot, self._probe = shot, None
            self.arrived.emit(shot)
