"""What renders for the window: a thread that follows the latest wish, coarse at first, then finer and with all samples."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, field

from .._gonio import Cancelled, Error, Film, Render
from ..scene import Scene
from .camera import Description
from .pace import Pace, reduced

# Seconds between two looks at whether the picture is still wanted.
LOOK_EVERY = 0.02
# A coarse picture that is on its way is not given up for a newer view before so many seconds: to give up all would show nothing.
PATIENCE = 0.5
# How long the view must rest before finer pictures are begun, seconds.
REST = 0.12
# Seconds between two pictures, at first and at most: they differ less and less.
SHOW_EVERY = (0.15, 1.0)


@dataclass(frozen=True, eq=False)
class Wish:
    """What is to be rendered."""

    scene: Scene = field(repr=False)
    camera: Description = field(repr=False)
    # Pixels.
    size: tuple[int, int]
    samples: int
    passes: tuple[str, ...]
    # What coarse pictures have, while the view moves.
    coarse_passes: tuple[str, ...]
    # A light that goes along with the camera: its number and description.
    headlight: tuple[int, Description] | None = field(default=None, repr=False)


@dataclass(frozen=True, eq=False)
class Shot:
    """A picture: the film of a wish, each of whose pixels covers `factor` × `factor` of the window's."""

    wish: Wish
    film: Film = field(repr=False)
    factor: int
    # Whether it has all passes and goes on to all samples; else it is one of the coarse ones before.
    is_fine: bool
    is_finished: bool
    seconds: float


@dataclass(frozen=True)
class Failure:
    """Why there is no picture."""

    message: str


class Session:
    """Renders the latest wish; `tell` is called from the session's thread with each `Shot`, and a `Failure` where there is none."""

    def __init__(self, tell: Callable[[Shot | Failure], None], warn: Callable[[list[tuple[str, str]]], None] = lambda _: None) -> None:
        self.pace = Pace()
        self._tell, self._warn = tell, warn
        self._condition = threading.Condition()
        self._wish: Wish | None = None
        self._is_new = False
        self._closed = False
        self._forgets = False
        self._render: Render | None = None
        # The scene to which the session has added its camera, with the camera's number.
        self._prepared: tuple[Scene, int] | None = None
        self._thread = threading.Thread(target=self._run, name="gonio view: render", daemon=True)
        self._thread.start()

    def show(self, wish: Wish) -> None:
        """Renders this from now on."""
        with self._condition:
            self._wish, self._is_new = wish, True
            self._condition.notify()

    def forget(self) -> None:
        """Lends nothing of the renders so far to the next one: images may have changed under their names."""
        self._forgets = True

    def close(self) -> None:
        """Ends the render."""
        with self._condition:
            self._closed, self._is_new = True, True
            self._condition.notify()
        self._thread.join()

    def _run(self) -> None:
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._is_new)
                wish, self._is_new = self._wish, False
                if self._closed or wish is None:
                    break
            try:
                self._follow(wish)
            except Cancelled:
                continue
            except (Error, OSError, RuntimeError) as error:
                self._tell(Failure(str(error)))
        if self._render is not None:
            self._render.cancel()
            self._render.__exit__()

    def _follow(self, wish: Wish) -> None:
        """Renders a wish, coarse to fine, until another one comes."""
        factor = self.pace.factor(wish.size)
        is_first = True
        while True:
            is_last = factor == 1 and not is_first
            if not self._stage(wish, factor, is_first, is_last) or is_last:
                return
            if is_first and self._is_over(REST):
                return
            factor, is_first = (1 if factor <= 3 else factor // 2), False

    def _is_over(self, seconds: float) -> bool:
        """Whether another wish comes within so many seconds."""
        with self._condition:
            return self._condition.wait_for(lambda: self._is_new, seconds)

    def _stage(self, wish: Wish, factor: int, is_first: bool, is_last: bool) -> bool:
        """Renders a picture; whether it was finished."""
        started = time.monotonic()
        render = self._begin(wish, factor, is_last)
        shown, pause = started, SHOW_EVERY[0]
        while not render.wait(LOOK_EVERY):
            now = time.monotonic()
            if self._is_new and (self._closed or not is_first or now - started > PATIENCE):
                render.cancel()
                if is_first:
                    self.pace.learn(_pixels(wish, factor), now - started)
                return False
            if is_last and now - shown >= pause and render.progress.samples > 0:
                self._tell(Shot(wish, render.film(), factor, True, False, now - started))
                shown, pause = now, min(SHOW_EVERY[1], max(SHOW_EVERY[0], 0.2 * (now - started)))
        seconds = time.monotonic() - started
        if is_first:
            self.pace.learn(_pixels(wish, factor), seconds)
        self._tell(Shot(wish, render.film(), factor, is_last, is_last, seconds))
        return True

    def _begin(self, wish: Wish, factor: int, is_last: bool) -> Render:
        scene = wish.scene
        if self._prepared is None or self._prepared[0] is not scene:
            self._prepared = (scene, scene.put_camera(wish.camera))
            is_new_scene = True
        else:
            is_new_scene = False
        number = scene.put_camera(wish.camera, self._prepared[1])
        if wish.headlight is not None:
            scene.put_light(wish.headlight[1], wish.headlight[0])
        width, height = reduced(wish.size, factor)
        passes = wish.passes if is_last else wish.coarse_passes
        scene.set(camera=number, width=width, height=height, pixel_aspect=1.0, samples=wish.samples if is_last else 1, passes=passes)
        if self._render is not None:
            self._render.cancel()
        previous = None if self._forgets and is_new_scene else self._render
        self._forgets = self._forgets and not is_new_scene
        self._render = Render(scene, previous, cancelled=lambda: self._is_new and (self._closed or not is_new_scene))
        if is_new_scene:
            self._warn(self._render.diagnostics)
        return self._render


def _pixels(wish: Wish, factor: int) -> int:
    width, height = reduced(wish.size, factor)
    return width * height
