"""The final render's session with an engine that is made up, so that ESC can be pressed."""

import importlib
import time
from types import SimpleNamespace

import pytest


def part(name):
    """A module of the extension."""
    return importlib.import_module(f"gonio_extension.{name}")


class Engine:
    """Takes what a render engine takes, and notes when."""

    def __init__(self, breaks_after):
        self.breaks_after, self.begun = breaks_after, time.monotonic()
        self.calls, self.stats, self.fractions, self.passes, self.pressed = [], [], [], ["Combined"], None

    def path_resolve(self, path):
        import bpy

        return getattr(bpy.context.scene, path)

    def get_result(self):
        import bpy

        render = bpy.context.scene.render
        size = {"resolution_x": render.resolution_x, "resolution_y": render.resolution_y}
        return SimpleNamespace(**size, stamp_data_add_field=lambda key, text: None)

    def test_break(self):
        if self.pressed is None and time.monotonic() - self.begun > self.breaks_after:
            self.pressed = time.monotonic()
        return self.pressed is not None

    def add_pass(self, name, channels, ids, layer):
        self.passes.append(name)

    def begin_result(self, x, y, width, height, layer):
        self.calls.append("begin")
        self.size, self.written = (width, height), {}
        note = lambda name: SimpleNamespace(foreach_set=lambda values: self.written.update({name: values}))  # noqa: E731
        self.result = SimpleNamespace(layers=[SimpleNamespace(passes=[SimpleNamespace(name=name, rect=note(name)) for name in self.passes])])
        return self.result

    def update_result(self, result):
        self.calls.append("update")

    def end_result(self, result, cancel):
        self.calls.append("cancel" if cancel else "end")

    def update_stats(self, stats, info):
        self.stats.append(info)

    def update_progress(self, fraction):
        self.fractions.append(fraction)


@pytest.mark.blender
def test_escape_ends_a_long_render_at_once_and_keeps_the_picture():
    import bpy
    import scenes

    scene = scenes.lit_floor(samples=1 << 20, width=960, height=540)
    scene.view_layers[0].gonio.use_pass_illuminance = True
    # An even floor is clean long before anybody presses a key.
    scene.gonio.use_adaptive_sampling = False
    engine = Engine(breaks_after=5.0)
    session = part("session").FinalSession()
    session.render(engine, bpy.context.evaluated_depsgraph_get())
    late = time.monotonic() - engine.pressed
    assert late < 0.25, late
    assert engine.calls[0] == "begin" and engine.calls[-1] == "end" and engine.calls.count("begin") == 1
    assert 1 <= engine.calls.count("update") <= 20
    assert memoryview(engine.written["Combined"]).nbytes == 960 * 540 * 4 * 4, memoryview(engine.written["Combined"]).nbytes
    assert "Illuminance" in engine.written
    assert engine.fractions == sorted(engine.fractions) and 0.0 < engine.fractions[-1] < 1.0
    assert any("left" in line for line in engine.stats)


@pytest.mark.blender
def test_a_result_is_ended_when_the_render_fails():
    import unittest

    import bpy
    import scenes

    scenes.lit_floor(samples=1, width=16, height=16)
    engine = Engine(breaks_after=100.0)
    engine.update_stats = lambda *_: 1 / 0
    engine.breaks_after = 100.0
    final = part("session.final")
    session = final.FinalSession()
    write = final.passes.write_passes
    final.passes.write_passes = lambda *_: 1 / 0
    try:
        with unittest.TestCase().assertRaises(ZeroDivisionError):
            session.render(engine, bpy.context.evaluated_depsgraph_get())
    finally:
        final.passes.write_passes = write
    assert engine.calls == ["begin", "cancel"]


@pytest.mark.blender
def test_memory_stays_level_over_many_renders():
    import bpy
    import scenes

    scenes.lit_floor(samples=2, width=128, height=128)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=256, ring_count=128, location=(0, 0, 0.2), radius=0.02)
    depsgraph = bpy.context.evaluated_depsgraph_get()

    def resident():
        with open("/proc/self/statm", encoding="ascii") as file:
            return int(file.read().split()[1])

    sizes = []
    for _ in range(60):
        part("session").FinalSession().render(Engine(breaks_after=100.0), depsgraph)
        sizes.append(resident())
    # The allocator's own ups and downs are a few per cent.
    assert sorted(sizes[-10:])[5] <= 1.05 * max(sizes[10:30]), sizes
