"""The viewport's session without a window and, where time matters, without a renderer."""

import importlib
from array import array
from types import SimpleNamespace

import pytest


def part(name):
    """A module of the extension."""
    return importlib.import_module(f"gonio_extension.{name}")


class Clock:
    """Time that passes when a test says so."""

    def __init__(self):
        self.now = 0.0

    def __call__(self):
        return self.now


class Film:
    """A film of one colour, which says how it was worked on."""

    def __init__(self, size, samples, passes, history=()):
        self.size, self.samples, self.passes, self.history = size, samples, passes, history

    def __getitem__(self, name):
        assert name in ("luminance", "illuminance")
        width, height = self.size
        return [[[100.0 * x / width] for x in range(width)] for _ in range(height)]

    def read(self, name, *, scale, bottom_up):
        assert name == "color" and bottom_up
        return array("f", [scale + len(self.history)]) * (self.size[0] * self.size[1] * 4)

    def edge_aware(self):
        assert {"denoising_albedo", "denoising_normal"} <= set(self.passes)
        return Film(self.size, self.samples, ["color"], (*self.history, "edge_aware"))

    def tone_mapped(self, operator, stops, *, white):
        return Film(self.size, self.samples, ["color"], (*self.history, operator))


class Render:
    """A render that does `rate` samples of pixels a second of the clock's time."""

    rate = 1e6
    diagnostics, texture_statistics = (), None
    made = []

    def __init__(self, clock, settings):
        self.clock, self.settings, self.start, self.cancelled = clock, dict(settings), clock.now, False
        crop = settings["crop"]
        self.size = (crop[2] - crop[0], crop[3] - crop[1]) if crop else (settings["width"], settings["height"])
        Render.made.append(self)

    @property
    def progress(self):
        elapsed = self.clock.now - self.start
        samples = min(self.settings["samples"], int(elapsed * self.rate / (self.size[0] * self.size[1])))
        return SimpleNamespace(samples=samples, fraction=samples / self.settings["samples"], elapsed=elapsed, remaining=None)

    def wait(self, seconds):
        end = self.start + self.settings["samples"] * self.size[0] * self.size[1] / self.rate
        # A little later, lest the rounding of a division decide.
        self.clock.now += max(0.0, min(seconds, end + 1e-6 - self.clock.now))
        return self.cancelled or self.progress.samples >= self.settings["samples"]

    def cancel(self):
        self.cancelled = True

    def film(self):
        return Film(self.size, self.progress.samples, self.settings["passes"])


class Exporter:
    """Says what it was asked."""

    def __init__(self):
        self.calls, self.put, self.changed, self.view = [], {}, True, None
        self.scene = SimpleNamespace(set=self.put.update)

    def sync(self, depsgraph, *, preview=False):
        self.calls.append("sync")

    def update(self, depsgraph):
        self.calls.append("update")
        return SimpleNamespace(anything=self.changed)

    def set_view(self, depsgraph, space, region_3d, width, height):
        view = (region_3d.view_matrix.copy(), width, height)
        moved, self.view = view != self.view, view
        self.calls += ["view"] * moved
        return moved

    def settings(self, depsgraph, **settings):
        samples = depsgraph.scene.gonio.preview_samples
        self.put.update(samples=samples, noise_threshold=0.1, **settings)


class Stage:
    """A session with everything around it made up."""

    def __init__(self):
        import bpy
        from mathutils import Matrix

        self.clock, self.exporter = Clock(), Exporter()
        Render.made.clear()
        start = lambda scene, previous: Render(self.clock, self.exporter.put)  # noqa: E731
        self.session = part("session.viewport").ViewportSession(self.exporter, start, self.clock)
        self.depsgraph = SimpleNamespace(scene=bpy.context.scene, view_layer=bpy.context.view_layer)
        self.space = SimpleNamespace(use_render_border=False, use_local_camera=False, camera=None, clip_start=0.1, clip_end=100.0)
        self.region = SimpleNamespace(
            view_perspective="PERSP",
            view_matrix=Matrix(),
            window_matrix=Matrix(),
            perspective_matrix=Matrix(),
            view_camera_zoom=0.0,
            view_camera_offset=(0.0, 0.0),
        )
        self.size, self.turns = (1280, 720), 0

    def draw(self, pixel_size=1):
        self.session.look(self.depsgraph, self.space, self.region, *self.size, pixel_size)
        self.session.advance(self.depsgraph)

    def orbit(self):
        from mathutils import Matrix

        self.turns += 1
        self.region.view_matrix = Matrix.Translation((self.turns, 0, 0))


@pytest.mark.blender
def test_the_first_picture_is_coarse_and_quick_and_the_last_is_whole():
    stage = Stage()
    stage.session.sync(stage.depsgraph)
    stage.draw()
    assert stage.session.picture is not None and stage.clock.now < 0.15
    first = stage.session.picture
    assert first.width < 1280 / 2 and first.frame.width == 1280
    sizes = [first.width]
    for _ in range(20000):
        stage.clock.now += 0.03
        if stage.session.is_waiting():
            stage.draw()
        if stage.session.picture.width != sizes[-1]:
            sizes.append(stage.session.picture.width)
        if stage.session.is_finished:
            break
    assert stage.session.is_finished and not stage.session.is_waiting()
    assert sizes == sorted(sizes) and sizes[-1] == 1280
    assert Render.made[-1].progress.samples == stage.depsgraph.scene.gonio.preview_samples
    assert stage.exporter.calls == ["sync", "view"]


@pytest.mark.blender
def test_each_draw_of_a_long_drag_shows_something_new():
    stage = Stage()
    stage.session.sync(stage.depsgraph)
    numbers = []
    for _ in range(40):
        stage.orbit()
        stage.draw()
        numbers.append(stage.session.picture.number)
        stage.clock.now += 0.02
    assert len(set(numbers)) > 30
    assert stage.exporter.calls.count("sync") == 1 and stage.exporter.calls.count("view") == 40


@pytest.mark.blender
def test_a_slow_scene_shows_pictures_during_a_drag_too():
    stage = Stage()
    Render.rate = 2e4
    try:
        stage.session.sync(stage.depsgraph)
        for _ in range(60):
            stage.orbit()
            stage.draw()
            stage.clock.now += 0.02
        assert stage.session.picture.number > 5
    finally:
        Render.rate = 1e6


@pytest.mark.blender
def test_resizing_and_settings_export_nothing_again():
    stage = Stage()
    stage.session.sync(stage.depsgraph)
    stage.draw()
    count = len(Render.made)
    stage.size = (900, 500)
    stage.draw()
    assert len(Render.made) > count and stage.session.picture.frame.width == 900
    count = len(Render.made)
    stage.depsgraph.scene.gonio.max_bounces += 1
    stage.draw()
    assert len(Render.made) > count
    count = len(Render.made)
    stage.draw(pixel_size=4)
    assert len(Render.made) > count
    assert stage.exporter.calls.count("sync") == 1


@pytest.mark.blender
def test_a_picture_on_its_way_is_shown_as_it_was_asked_for():
    stage = Stage()
    settings = stage.depsgraph.scene.gonio
    settings.display = "LUMINANCE"
    Render.rate = 2e4
    try:
        stage.session.sync(stage.depsgraph)
        stage.session.look(stage.depsgraph, stage.space, stage.region, 320, 180)
        stage.session.advance(stage.depsgraph)
        assert stage.session.picture is None and len(Render.made) == 1
        settings.display = "COLOR"
        stage.session.look(stage.depsgraph, stage.space, stage.region, 320, 180)
        stage.clock.now += 0.8
        stage.session.advance(stage.depsgraph)
        # The first one came in false colour, and the next is under way.
        assert stage.session.picture.legend is not None and len(Render.made) == 2
    finally:
        Render.rate = 1e6


@pytest.mark.blender
def test_other_false_colours_paint_the_film_anew():
    stage = Stage()
    stage.size = (160, 90)
    settings = stage.depsgraph.scene.gonio
    settings.display, settings.false_color_max = "ILLUMINANCE", 100.0
    stage.session.sync(stage.depsgraph)
    while not stage.session.is_finished:
        stage.draw()
        stage.clock.now += 0.1
    count, number = len(Render.made), stage.session.picture.number
    for name, value in (("false_color_max", 50.0), ("false_color_steps", 4), ("use_false_color_contours", False)):
        before = bytes(stage.session.picture.pixels)
        setattr(settings, name, value)
        stage.draw()
        number += 1
        assert stage.session.picture.number == number and bytes(stage.session.picture.pixels) != before
    stage.draw()
    assert stage.session.is_finished and len(Render.made) == count and stage.session.picture.number == number
    settings.display = "LUMINANCE"
    stage.draw()
    assert len(Render.made) > count


def shade(picture):
    """How often the pixels of a picture were worked on."""
    return round(picture.pixels[0])


def rested(stage):
    """Draws until all is done; gives the pictures."""
    pictures = []
    while not stage.session.is_finished:
        if stage.session.is_waiting():
            stage.draw()
            pictures.append(stage.session.picture)
        stage.clock.now += 0.05
    return pictures


@pytest.mark.blender
def test_pictures_are_denoised_from_a_sample_on():
    stage = Stage()
    stage.size = (160, 90)
    settings = stage.depsgraph.scene.gonio
    settings.preview_samples, settings.use_preview_denoising, settings.preview_denoising_start_sample = 1024, True, 256
    Render.rate = 2e6
    try:
        stage.session.sync(stage.depsgraph)
        pictures = rested(stage)
        assert [shade(picture) for picture in (pictures[0], pictures[-1])] == [0, 1]
        assert Render.made[0].settings["passes"] == ["color"]
        # What was rendered with its guides is shown without them at once.
        count = len(Render.made)
        settings.use_preview_denoising = False
        stage.draw()
        assert shade(stage.session.picture) == 0 and len(Render.made) == count
        settings.use_preview_denoising, settings.preview_denoising_start_sample = True, 1
        stage.orbit()
        stage.draw()
        assert shade(stage.session.picture) == 1 and len(Render.made) == count + 1
    finally:
        Render.rate = 1e6


@pytest.mark.blender
def test_tone_mapping_paints_the_film_anew():
    stage = Stage()
    stage.size = (160, 90)
    settings = stage.depsgraph.scene.gonio
    stage.session.sync(stage.depsgraph)
    rested(stage)
    count = len(Render.made)
    for operator in ("PHOTOGRAPHIC", "LOCAL", "EV100"):
        settings.tone_map = operator
        stage.draw()
        # Mapped, and in the film's own unit.
        assert stage.session.picture.pixels[0] == 2.0 and len(Render.made) == count
    settings.tone_map = "NONE"
    stage.draw()
    assert stage.session.picture.pixels[0] < 1.0 and len(Render.made) == count


@pytest.mark.blender
def test_the_resolution_while_navigating():
    stage = Stage()
    settings = stage.depsgraph.scene.gonio
    stage.session.sync(stage.depsgraph)
    for name, width in (("FULL", 1280), ("HALF", 640), ("QUARTER", 320), ("EIGHTH", 160)):
        settings.preview_navigation_resolution = name
        stage.orbit()
        stage.draw()
        rested(stage)
        firsts = [render for render in Render.made if render.settings["samples"] == 1]
        assert width in {render.settings["width"] for render in firsts} and min(r.settings["width"] for r in firsts) == width
        assert all(render.settings["noise_threshold"] == 0.0 for render in firsts)
        Render.made.clear()


@pytest.mark.blender
def test_resolution_follows_what_pictures_take():
    stage = Stage()
    stage.session.sync(stage.depsgraph)
    widths = {}
    for rate in (4e6, 2e5, 4e6):
        Render.rate = rate
        for _ in range(30):
            stage.orbit()
            stage.draw()
            stage.clock.now += 0.01
        widths.setdefault(rate, []).append(stage.session.picture.width)
    Render.rate = 1e6
    assert widths[4e6][0] == widths[4e6][1] > 2 * widths[2e5][0]


@pytest.mark.blender
def test_nothing_finer_is_begun_while_the_view_moves():
    stage = Stage()
    stage.session.sync(stage.depsgraph)
    for count in range(1, 20):
        stage.orbit()
        stage.draw()
        stage.clock.now += 0.03
        assert len(Render.made) == count and not stage.session.is_waiting() and not stage.session.is_finished
    stage.clock.now += 0.1
    assert stage.session.is_waiting()


@pytest.mark.blender
def test_edits_that_change_nothing_start_nothing():
    stage = Stage()
    stage.session.sync(stage.depsgraph)
    for _ in range(300):
        stage.draw()
        stage.clock.now += 0.1
    count = len(Render.made)
    stage.exporter.changed = False
    stage.session.sync(stage.depsgraph)
    stage.draw()
    assert len(Render.made) == count
    stage.exporter.changed = True
    stage.session.sync(stage.depsgraph)
    stage.draw()
    assert len(Render.made) > count


@pytest.mark.blender
def test_a_border_is_drawn_where_it_is():
    stage = Stage()
    stage.space.use_render_border = True
    edges = {"render_border_min_x": 0.25, "render_border_max_x": 0.75, "render_border_min_y": 0.5, "render_border_max_y": 1.0}
    stage.space.__dict__.update(edges)
    stage.session.sync(stage.depsgraph)
    for _ in range(100):
        stage.draw()
        stage.clock.now += 0.1
    picture = stage.session.picture
    assert (picture.width, picture.height) == (640, 360)
    assert picture.frame.corner == (320, 360) and picture.frame.crop == (320, 0, 960, 360)


@pytest.mark.blender
def test_a_failed_export_is_done_again_as_a_whole():
    stage = Stage()
    stage.session.sync(stage.depsgraph)
    stage.draw()
    stage.exporter.update = lambda depsgraph: 1 / 0
    import unittest

    with unittest.TestCase().assertRaises(ZeroDivisionError):
        stage.session.sync(stage.depsgraph)
    stage.draw()
    stage.session.sync(stage.depsgraph)
    assert stage.exporter.calls.count("sync") == 2


@pytest.mark.blender
def test_closing_cancels():
    stage = Stage()
    stage.session.sync(stage.depsgraph)
    stage.draw()
    stage.session.close()
    assert Render.made[-1].cancelled and not stage.session.is_waiting()
