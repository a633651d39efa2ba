"""A 3D viewport without a window: the session, and what it asks of Blender's space and region. Used inside the child process."""

import importlib
import time
from types import SimpleNamespace

import bpy
import gonio
from mathutils import Matrix

WIDTH, HEIGHT = 960, 540


class Times(dict):
    """Seconds by what they were spent on."""

    def add(self, name, work):
        """Calls a function and adds what it took."""
        start = time.perf_counter()
        try:
            return work()
        finally:
            self[name] = self.get(name, 0.0) + time.perf_counter() - start


class TimedScene:
    """A scene whose methods are timed."""

    def __init__(self, scene, times):
        self._scene, self._times = scene, times

    def __getattr__(self, name):
        method = getattr(self._scene, name)
        return lambda *arguments, **keywords: self._times.add("scene", lambda: method(*arguments, **keywords))


class Viewport:
    """Shows the open file from a place above it, and follows its edits as Blender's viewport does."""

    def __init__(self, pose):
        self.times = Times()
        self.session = importlib.import_module("gonio_extension.session").ViewportSession(start=self._start)
        exporter = self.session.exporter
        for part in (exporter._meshes, exporter._materials, exporter._instances, exporter._lights):
            part._scene = TimedScene(exporter.scene, self.times)
        lens = bpy.data.objects.new("View", bpy.data.cameras.new("View"))
        projection = lens.calc_matrix_camera(self._graph(), x=WIDTH, y=HEIGHT)
        bpy.data.objects.remove(lens)
        self.space = SimpleNamespace(use_render_border=False, use_local_camera=False, camera=None, clip_start=0.01, clip_end=1e4)
        self.region = SimpleNamespace(
            view_perspective="PERSP", view_matrix=Matrix(pose).inverted(), window_matrix=projection, perspective_matrix=projection
        )
        self.session.sync(self._graph())
        bpy.app.handlers.depsgraph_update_post.append(self._follow)

    def _graph(self):
        return bpy.context.evaluated_depsgraph_get()

    def _start(self, scene, previous):
        return self.times.add("compile", lambda: gonio.Render(scene, previous=previous))

    def _follow(self, _, graph):
        self.times.add("export", lambda: self.session.sync(graph))

    def draw(self):
        """What Blender does before it draws; gives the picture."""
        graph = self._graph()
        self.session.look(graph, self.space, self.region, WIDTH, HEIGHT)
        self.session.advance(graph)
        return self.session.picture

    def finish(self, seconds=60.0):
        """Draws until the picture has all its samples; gives it."""
        end = time.monotonic() + seconds
        while not self.session.is_finished:
            assert time.monotonic() < end, "the viewport does not come to an end"
            if self.session.is_waiting():
                self.draw()
            time.sleep(0.002)
        return self.session.picture

    def first_picture_after(self, edit):
        """Seconds from an edit to the first picture that shows it, in all and by what they were spent on: `scene` is part of `export`."""
        self.times.clear()
        before = self.session.picture.number
        start = time.perf_counter()
        edit()
        bpy.context.view_layer.update()
        updated = time.perf_counter()
        while self.draw().number == before:
            time.sleep(0.001)
        whole = time.perf_counter() - start
        self.times["depsgraph"] = updated - start - self.times.get("export", 0.0)
        self.times["picture"] = whole - sum(self.times.get(name, 0.0) for name in ("depsgraph", "export", "compile"))
        return whole, dict(self.times)

    def close(self):
        """Ends the session."""
        bpy.app.handlers.depsgraph_update_post.remove(self._follow)
        self.session.close()
