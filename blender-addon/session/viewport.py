# SPDX-License-Identifier: GPL-3.0-or-later
"""The rendered viewport: coarse pictures first, the latest state wins, nothing waits for long."""

import time
from dataclasses import dataclass

import gonio

from .. import report
from ..export import Exporter
from ..properties.scene import MOST_SAMPLES
from . import status
from .appearance import Appearance, Picture
from .frame import Frame
from .pace import Pace
from .view import frame_of, settings_of

# How long drawing waits for the first picture after an edit, in seconds.
PATIENCE = 0.08
# A first picture that has not come after this time gives way to a newer state.
LONGEST_FIRST = 1.0
# How long nothing must change before finer pictures are begun: while the view moves they would be in the way.
REST = 0.1
# Seconds between two pictures of the last stage, at least and at most, and at least this many times what painting one takes.
SHOW_EVERY = (0.1, 1.0)
SHOW_SHARE = 4.0


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
    # How its film is shown; its passes allow for it.
    appearance: Appearance
    passes: list[str]
    started: float
    shown: float
    # What painting its latest picture took, seconds.
    painting: float = 0.0


class ViewportSession:
    """What one 3D viewport shows: `sync` after edits, `look` and `advance` before each drawing, `is_waiting` in between."""

    def __init__(self, exporter=None, start=gonio.Render, now=time.monotonic) -> None:
        self.report = report.Report()
        self.exporter = exporter if exporter is not None else Exporter(self.report, pictured=True)
        self.picture: Picture | None = None
        self.status = ""
        self._start, self._now = start, now
        self._scene: tuple | None = None
        self._is_broken = False
        self._frame: Frame | None = None
        self._settings: tuple | None = None
        self._pixel_size = 1
        self._appearance: Appearance | None = None
        self._is_stale = True
        self._stage: _Stage | None = None
        self._is_running = False
        # Factor of the stage that comes next, and the time from which on.
        self._finer: tuple[int, float] | None = None
        self._pace = Pace()

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
        appearance = Appearance.of(depsgraph.scene.gonio)
        if appearance != self._appearance:
            self._appearance = appearance
            self._repaint(appearance)

    def advance(self, depsgraph) -> None:
        """Starts what has to be started and takes over a new picture if there is one."""
        try:
            if self._is_stale and not self._is_first_coming():
                choice = depsgraph.scene.gonio.preview_navigation_resolution
                self._begin(depsgraph, self._pace.factor(self._frame.size, self._pixel_size, choice), is_first=True)
                self._is_stale = False
            elif self._is_rested():
                self._begin(depsgraph, self._finer[0], is_first=False)
            if self._is_running:
                self._collect(depsgraph)
        except gonio.Error as error:
            self._is_running, self._finer, self.status = False, None, str(error)
            self.report.add("Render", getattr(error, "origin", None) or "", str(error), severity="ERROR")

    def is_waiting(self) -> bool:
        """Whether `advance` would have something to do; asked by a timer."""
        if not self._is_running:
            return self._is_stale or self._is_rested()
        stage = self._stage
        return stage.render.wait(0.0) or (stage.is_last and self._is_due(stage))

    @property
    def is_finished(self) -> bool:
        """Whether the picture has all its samples."""
        return not self._is_running and not self._is_stale and self._finer is None

    def close(self) -> None:
        """Ends the render."""
        if self._stage is not None:
            self._stage.render.cancel()
        self._stage, self._is_running, self._is_stale, self._finer = None, False, False, None

    def _is_first_coming(self) -> bool:
        """Whether the first picture of an earlier state is on its way: to give it up at each step of a drag would show nothing."""
        stage = self._stage
        if not self._is_running or not stage.is_first:
            return False
        if stage.render.wait(0.0):
            self._show(stage)
            return False
        taken = self._now() - stage.started
        if taken > LONGEST_FIRST:
            self._pace.learn(stage.frame.size, taken)
        return taken <= LONGEST_FIRST

    def _is_rested(self) -> bool:
        """Whether a finer picture is to be begun."""
        return self._finer is not None and self._now() >= self._finer[1]

    def _begin(self, depsgraph, factor: int, *, is_first: bool) -> None:
        started = self._now()
        is_last = not is_first and factor <= self._pixel_size
        wanted = depsgraph.scene.gonio.preview_samples
        samples = (wanted or MOST_SAMPLES) if is_last else 1
        frame, passes = self._frame.reduced(factor), self._appearance.passes(samples)
        self.exporter.settings(depsgraph, width=frame.width, height=frame.height, crop=frame.crop, preview=True, passes=passes)
        if not is_last:
            # One sample has no noise to go by.
            self.exporter.scene.set(samples=samples, noise_threshold=0.0)
        previous = self._stage.render if self._stage is not None else None
        if previous is not None:
            previous.cancel()
        self._is_running, self._finer = False, None
        render = self._start(self.exporter.scene, previous=previous)
        self._stage = _Stage(
            render, self._frame, frame, factor, is_first, is_last, wanted, self._appearance, passes, started, shown=self._now()
        )
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
        self._is_running = False
        if stage.is_last:
            self.report.add_render(stage.render.diagnostics)
            self.report.add_texture_notes(stage.render.texture_statistics)
        elif not self._is_stale:
            finer = self._pixel_size if stage.factor <= self._pixel_size else max(self._pixel_size, stage.factor // 2)
            self._finer = (finer, self._now() + (REST if stage.is_first else 0.0))

    def _is_due(self, stage: _Stage) -> bool:
        """Whether a picture with more samples is to be shown: they differ less and less."""
        least, most = SHOW_EVERY
        now = self._now()
        pause = max(SHOW_SHARE * stage.painting, min(most, max(least, 0.2 * (now - stage.started))))
        return now - stage.shown >= pause and stage.render.progress.samples > 0

    def _show(self, stage: _Stage) -> None:
        number = self.picture.number + 1 if self.picture else 0
        before = self._now()
        self.picture = stage.appearance.paint(stage.render.film(), number, stage.view)
        stage.shown = self._now()
        stage.painting = stage.shown - before
        if stage.is_first:
            self._pace.learn(stage.frame.size, stage.shown - stage.started)

    def _repaint(self, appearance: Appearance) -> None:
        """Shows the stage in another way; one that needs other passes needs another stage."""
        stage = self._stage
        if stage is None or not set(appearance.passes(stage.samples or MOST_SAMPLES)) <= set(stage.passes):
            self._is_stale = True
            return
        stage.appearance = appearance
        if stage.is_last and stage.render.progress.samples > 0:
            self._show(stage)
