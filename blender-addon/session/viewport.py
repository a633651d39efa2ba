# SPDX-License-Identifier: GPL-3.0-or-later
"""The rendered viewport: coarse pictures first, the latest state wins, nothing waits for long."""

import time
from dataclasses import dataclass

import gonio

from .. import report
from ..export import Exporter
from . import false_color, status
from .frame import Frame
from .passes import COMBINED, read_flat
from .view import frame_of, settings_of

# What the first picture after an edit may take, in seconds, and how long drawing waits for it.
FIRST_PICTURE = 0.06
PATIENCE = 0.06
# A first picture that has not come after this time gives way to a newer state.
LONGEST_FIRST = 1.0
COARSEST = 16
# Samples of pixels a second, until measured.
FIRST_GUESS = 5e5
# Seconds between two pictures of the last stage, at least and at most.
SHOW_EVERY = (0.1, 1.0)
MOST_SAMPLES = 1 << 24


@dataclass(frozen=True)
class Picture:
    """Pixels to draw: `width` × `height` flat RGBA float32, rows from the bottom, of the rendered part of `frame`."""

    number: int
    width: int
    height: int
    pixels: object
    frame: Frame
    # In false colour the pixels are what the screen shows, and this stands beside them.
    legend: false_color.Shown | None = None


@dataclass
class _Stage:
    """A render under way of which each pixel covers `factor` × `factor` of the viewport."""

    render: gonio.Render
    view: Frame
    frame: Frame
    factor: int
    is_first: bool
    is_last: bool
    samples: int
    # What the render's pass is shown as; None for the picture as it is.
    style: false_color.Style | None
    started: float
    shown: float


class ViewportSession:
    """What one 3D viewport shows: `sync` after edits, `look` and `advance` before each drawing, `is_waiting` in between."""

    def __init__(self, exporter=None, start=gonio.Render, now=time.monotonic) -> None:
        self.report = report.Report()
        self.exporter = exporter if exporter is not None else Exporter(self.report)
        self.picture: Picture | None = None
        self.status = ""
        self._start, self._now = start, now
        self._scene: tuple | None = None
        self._is_broken = False
        self._frame: Frame | None = None
        self._settings: tuple | None = None
        self._pixel_size = 1
        self._exposure = 1.0
        self._style: false_color.Style | None = None
        self._is_stale = True
        self._stage: _Stage | None = None
        self._is_running = False
        self._rate = FIRST_GUESS

    def sync(self, depsgraph) -> None:
        """Exports what changed; the first time, and after a change of scene or view layer, everything."""
        scene = (depsgraph.scene.session_uid, depsgraph.view_layer.name)
        whole = scene != self._scene or self._is_broken
        # An export that fails half way is done again as a whole, but not before something changes.
        self._scene, self._is_broken = scene, True
        report.publish(self.report)
        if whole:
            self.report.clear()
            self.exporter.sync(depsgraph)
        elif not self.exporter.update(depsgraph).anything:
            self._is_broken = False
            return
        self._is_broken, self._is_stale = False, True

    def look(self, depsgraph, space, region_3d, width: int, height: int, pixel_size: int = 1) -> None:
        """Takes over the view and the settings of a 3D viewport."""
        if self._scene is None:
            self.sync(depsgraph)
        frame, settings = frame_of(depsgraph.scene, space, region_3d, width, height), settings_of(depsgraph.scene)
        has_moved = self.exporter.set_view(depsgraph, space, region_3d, width, height)
        if has_moved or frame != self._frame:
            self._frame, self._is_stale = frame, True
        if (settings, pixel_size) != (self._settings, self._pixel_size):
            self._settings, self._pixel_size, self._is_stale = settings, pixel_size, True
            self._exposure = depsgraph.scene.gonio.film_exposure
        style = false_color.Style.of(depsgraph.scene.gonio)
        if style != self._style:
            self._style = style
            self._repaint(style)

    def advance(self, depsgraph) -> None:
        """Starts what has to be started and takes over a new picture if there is one."""
        try:
            if self._is_stale and not self._is_first_coming():
                self._begin(depsgraph, self._first_factor(), is_first=True)
                self._is_stale = False
            if self._is_running:
                self._collect(depsgraph)
        except gonio.Error as error:
            self._is_running, self.status = False, str(error)
            self.report.add("Render", getattr(error, "origin", None) or "", str(error), severity="ERROR")

    def is_waiting(self) -> bool:
        """Whether `advance` would have something to do; asked by a timer."""
        if not self._is_running:
            return self._is_stale
        stage = self._stage
        return stage.render.wait(0.0) or (stage.is_last and self._is_due(stage))

    @property
    def is_finished(self) -> bool:
        """Whether the picture has all its samples."""
        return not self._is_running and not self._is_stale

    def close(self) -> None:
        """Ends the render."""
        if self._stage is not None:
            self._stage.render.cancel()
        self._stage, self._is_running, self._is_stale = None, False, False

    def _is_first_coming(self) -> bool:
        """Whether the first picture of an earlier state is on its way: to give it up at each step of a drag would show nothing."""
        stage = self._stage
        if not self._is_running or not stage.is_first or self._now() - stage.started > LONGEST_FIRST:
            return False
        if not stage.render.wait(0.0):
            return True
        self._show(stage)
        return False

    def _first_factor(self) -> int:
        width, height = self._frame.size
        factor = self._pixel_size
        while factor < COARSEST and width * height / factor**2 > self._rate * FIRST_PICTURE:
            factor *= 2
        return factor

    def _begin(self, depsgraph, factor: int, *, is_first: bool) -> None:
        is_last = factor <= self._pixel_size
        frame = self._frame.reduced(factor)
        source = self._style.source if self._style else COMBINED.source
        self.exporter.settings(depsgraph, width=frame.width, height=frame.height, crop=frame.crop, preview=True, passes=[source])
        wanted = depsgraph.scene.gonio.preview_samples
        self.exporter.scene.set(samples=(wanted or MOST_SAMPLES) if is_last else 1)
        previous = self._stage.render if self._stage is not None else None
        if previous is not None:
            previous.cancel()
        self._is_running = False
        render = self._start(self.exporter.scene, previous=previous)
        now = self._now()
        self._stage = _Stage(render, self._frame, frame, factor, is_first, is_last, wanted, self._style, now, now)
        self._is_running = True

    def _collect(self, depsgraph) -> None:
        stage = self._stage
        done = stage.render.wait(PATIENCE if stage.is_first else 0.0)
        if stage.is_last:
            self.status = status.text(stage.render.progress, stage.samples)
        if done or (stage.is_last and self._is_due(stage)):
            self._show(stage)
        if not done:
            return
        self._learn(stage)
        if stage.is_last:
            self._is_running = False
            self.report.add_render(stage.render.diagnostics)
        elif not self._is_stale:
            self._begin(depsgraph, max(self._pixel_size, stage.factor // 2), is_first=False)

    def _is_due(self, stage: _Stage) -> bool:
        """Whether a picture with more samples is to be shown: they differ less and less."""
        least, most = SHOW_EVERY
        now = self._now()
        return now - stage.shown >= min(most, max(least, 0.2 * (now - stage.started))) and stage.render.progress.samples > 0

    def _show(self, stage: _Stage) -> None:
        film = stage.render.film()
        width, height = film.size
        number = self.picture.number + 1 if self.picture else 0
        if stage.style is None:
            pixels = read_flat(film, COMBINED.source, COMBINED.factor(self._exposure, 1))
            self.picture = Picture(number, width, height, pixels, stage.view)
        else:
            shown, legend = false_color.paint(film, stage.style, stage.view.height)
            self.picture = Picture(number, width, height, shown.pixels, stage.view, legend)
        stage.shown = self._now()

    def _repaint(self, style: false_color.Style | None) -> None:
        """Gives the stage other colours; another pass takes another stage."""
        stage = self._stage
        if stage is None or stage.style is None or style is None or stage.style.source != style.source:
            return
        stage.style = style
        if stage.is_last and stage.render.progress.samples > 0:
            self._show(stage)

    def _learn(self, stage: _Stage) -> None:
        """Measures how many samples a second this scene allows."""
        width, height = stage.frame.size
        progress = stage.render.progress
        self._rate = max(1e3, width * height * max(1, progress.samples) / max(progress.elapsed, 1e-3))
