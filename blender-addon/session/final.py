# SPDX-License-Identifier: GPL-3.0-or-later
"""Final renders and previews of materials, lights and worlds."""

import time
from collections.abc import Iterator
from contextlib import contextmanager

import gonio

from .. import baking, report
from ..export import Exporter, limits
from . import passes, status
from .eyes import Eye, eyes
from .frame import Frame, begun_with, expected_frame, final_frame
from .result import POLL, open_result

# Seconds between two pictures, at least, and this many times what showing one takes.
SHOW_EVERY = 0.3
SHOW_SHARE = 10.0
# A preview of a material is small and wanted at once.
PREVIEW_SAMPLES = 64
PREVIEW_SECONDS = 4.0


class _Layer:
    """What a view layer keeps from one render to the next when data is persistent."""

    def __init__(self, is_rendered: bool) -> None:
        self.report = report.Report()
        self.exporter = Exporter(self.report, pictured=is_rendered)
        self.render: gonio.Render | None = None


class FinalSession:
    """Renders view layers into Blender's results. Lives as long as the engine: with persistent data, over all frames."""

    def __init__(self, *, is_rendered: bool = True) -> None:
        self._is_rendered = is_rendered
        self._layers: dict[str, _Layer] = {}

    def sync(self, depsgraph, *, preview: bool = False, engine=None) -> None:
        """Exports what changed since the last call; Blender's data is locked during its `update` callback only.
        With the engine, which moves the frame, what moves is blurred."""
        name = depsgraph.view_layer.name
        # An export that fails half way is not gone on with.
        layer = self._layers.pop(name, None) or _Layer(self._is_rendered)
        layer.report.clear()
        aovs = frozenset() if preview else passes.shader_aov_names(depsgraph.view_layer)
        layer.exporter.sync(depsgraph, preview=preview, shader_aovs=aovs)
        if engine is not None and not preview:
            layer.exporter.blur(engine, depsgraph)
        limits.of_passes(depsgraph.view_layer, passes.SWITCHES, layer.report)
        self._layers[name] = layer

    def bake(self, engine, depsgraph, thing, name: str, pass_filter: int, size: tuple[int, int]) -> report.Report:
        """Bakes a kind of an object's light; returns what is to be told about it."""
        layer_name = depsgraph.view_layer.name
        if layer_name not in self._layers:
            self.sync(depsgraph)
        layer = self._layers[layer_name]
        try:
            baking.bake(engine, depsgraph, layer, thing, name, pass_filter, size)
        except gonio.Cancelled:
            if not engine.test_break():
                raise
        return layer.report

    def hand_over(self, engine, depsgraph) -> tuple[gonio.Scene, report.Report]:
        """The scene of a view layer as its picture has it, seen by the scene's camera, and what is to be told; the session forgets it."""
        layer = self._layers.pop(depsgraph.view_layer.name)
        self._settings(depsgraph, layer, expected_frame(engine), [passes.COMBINED], False, Eye(), begun_with(engine))
        if begun_with(engine).use_multiview:
            layer.report.tell("views by wavelength", "Scene", depsgraph.scene.name)
        return layer.exporter.scene, layer.report

    def render(self, engine, depsgraph, *, preview: bool = False) -> report.Report:
        """Renders one view layer; returns what is to be told about it."""
        name = depsgraph.view_layer.name
        if name not in self._layers:
            self.sync(depsgraph, preview=preview, engine=engine)
        layer = self._layers[name]
        try:
            self._render(engine, depsgraph, layer, preview)
        except gonio.Cancelled:
            # ESC while the scene was still being laid out.
            if not engine.test_break():
                raise
        finally:
            if not depsgraph.scene.render.use_persistent_data:
                del self._layers[name]
        return layer.report

    def _render(self, engine, depsgraph, layer: _Layer, preview: bool) -> None:
        kinds = passes.add_passes(engine, depsgraph.view_layer)
        for eye in eyes(engine, depsgraph):
            if not engine.test_break():
                self._see(engine, depsgraph, layer, kinds, eye, preview)

    def _see(self, engine, depsgraph, layer: _Layer, kinds: list[passes.Pass], eye: Eye, preview: bool) -> None:
        """Renders one view, the only one but for stereoscopy."""
        begun, settings = begun_with(engine), depsgraph.scene.gonio
        frame = expected_frame(engine)
        if frame != final_frame(depsgraph.scene.render):
            layer.report.tell("frame", "Scene", depsgraph.scene.name)
        samples = self._settings(depsgraph, layer, frame, kinds, preview, eye, begun)
        with open_result(engine, frame.size, depsgraph.view_layer.name, eye.name) as result, _started(layer, engine) as render:
            shown = time.monotonic()
            pause = SHOW_EVERY / 3
            while not (done := render.wait(POLL)):
                if engine.test_break():
                    render.cancel()
                    break
                now = time.monotonic()
                if now - shown >= pause and render.progress.samples > 0:
                    passes.write_passes(result, render.film(), kinds, settings, samples)
                    engine.update_result(result)
                    shown = time.monotonic()
                    pause = max(SHOW_EVERY, SHOW_SHARE * (shown - now))
                engine.update_progress(render.progress.fraction)
                engine.update_stats("", status.text(render.progress, samples))
            layer.report.add_render(render.diagnostics)
            layer.report.add_texture_notes(render.texture_statistics)
            layer.report.add_guiding(render.guiding)
            if done or render.progress.samples > 0:
                film = render.film()
                passes.write_passes(result, film, kinds, settings, samples)
                passes.note_mattes(engine, film, depsgraph.view_layer.name)
                render_settings = depsgraph.scene.render
                # A border within the whole picture leaves the file another shape than what was rendered.
                if frame.crop is None or render_settings.use_crop_to_border:
                    passes.note_view(engine, film)

    def _settings(self, depsgraph, layer: _Layer, frame: Frame, kinds: list[passes.Pass], preview: bool, eye: Eye, begun) -> int:
        """Puts the settings into the scene; returns the samples of a pixel."""
        names = passes.sources(kinds)
        size = {"width": frame.width, "height": frame.height, "crop": frame.crop}
        layer.exporter.settings(depsgraph, **size, preview=preview, passes=names, eye=eye, aspect=(begun.pixel_aspect_x, begun.pixel_aspect_y))
        if preview:
            layer.exporter.scene.set(samples=PREVIEW_SAMPLES, time_limit=PREVIEW_SECONDS)
            return PREVIEW_SAMPLES
        own = depsgraph.view_layer.samples
        if own > 0:
            layer.exporter.scene.set(samples=own)
        return own or depsgraph.scene.gonio.samples


@contextmanager
def _started(layer: _Layer, engine) -> Iterator[gonio.Render]:
    """A render under way, cancelled when it is left before its end."""
    render = gonio.Render(layer.exporter.scene, previous=layer.render, cancelled=engine.test_break)
    try:
        yield render
    finally:
        render.cancel()
    layer.render = render
