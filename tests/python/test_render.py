"""Renders: tiles, progress, cancelling, films, the GIL, and light that is known in closed form."""

import gc
import math
import pathlib
import signal
import threading
import time

import gonio
import numpy as np
import pytest


def test_illuminance_and_luminance_in_closed_form(floor, render):
    film = render(floor(samples=256, width=9, height=9, integrator="direct", passes=["color", "luminance", "illuminance"]))
    # A sphere of luminance L and radius r sends I = L pi r² in all directions; under it E = I / d².
    intensity = 1000 * math.pi * 0.1**2
    lux = np.asarray(film["illuminance"])[..., 0]
    half = 8 * math.tan(math.radians(20))
    x, z = np.meshgrid(*[(np.arange(9) + 0.5) / 9 * 2 * half - half] * 2)
    away = np.sqrt(x * x + z * z + 4)
    expected = intensity * 2 / away**3
    # The light itself hides the middle from the camera.
    seen = np.hypot(x, z) > 0.7
    assert lux[seen] == pytest.approx(expected[seen], rel=0.04)
    luminance = np.asarray(film["luminance"])[..., 0]
    assert luminance[seen] == pytest.approx(0.5 / math.pi * lux[seen], rel=0.05)


def test_a_furnace_is_even(render):
    scene = gonio.Scene()
    scene.set(width=16, height=16, samples=64)
    rng = np.random.default_rng(1)
    points = rng.uniform(-1, 1, (60, 3)).astype("f4")
    triangles = np.arange(60, dtype="i4").reshape(-1, 3)
    scene.add_instance(scene.add_mesh(points, triangles), [scene.add_material(base_color=(1.0, 1.0, 1.0), specular_weight=0.0)])
    scene.add_light("dome", (2.0, 2.0, 2.0))
    scene.set(max_bounces=60)
    scene.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 4], [0, 0, 0, 1]])
    assert np.asarray(render(scene)["color"])[..., :3].mean() == pytest.approx(2, rel=0.02)


def test_tiles_cover_the_picture_with_all_samples(floor):
    samples = np.zeros((100, 150), int)
    with gonio.Render(floor(width=150, height=100, samples=5)) as render:
        for tile in render:
            assert 0 < tile.width <= 64 and 0 < tile.height <= 64
            area = samples[tile.y : tile.y + tile.height, tile.x : tile.x + tile.width]
            assert area.shape == (tile.height, tile.width)
            assert (area <= tile.samples).all() and tile.samples <= 5
            area[:] = tile.samples
        assert (samples == 5).all()
        progress = render.progress
        assert progress.fraction == 1 and progress.samples == 5 and progress.rays > 0 and progress.elapsed > 0
        assert next(render, None) is None, "a finished render stays finished"
        assert render.film().samples == 5


def test_progress_grows(floor):
    with gonio.Render(floor(width=128, height=128, samples=20000)) as render:
        seen = []
        for _ in range(5):
            render.wait(0.1)
            seen.append(render.progress.fraction)
        assert seen == sorted(seen) and 0 <= seen[0] < 1 and seen[-1] > 0
        assert render.progress.remaining is None or render.progress.remaining > 0


def test_wait_with_a_timeout(floor):
    with gonio.Render(floor(width=256, height=256, samples=100000)) as render:
        start = time.monotonic()
        assert render.wait(0.3) is False
        assert 0.25 < time.monotonic() - start < 1.5
        assert render.wait(0) is False


def test_cancel_ends_soon_with_a_film(floor):
    with gonio.Render(floor(width=512, height=512, samples=100000)) as render:
        render.wait(0.7)
        start = time.monotonic()
        render.cancel()
        with pytest.raises(gonio.Cancelled):
            render.wait()
        took = time.monotonic() - start
        film = render.film()
    values = np.asarray(film["color"])
    assert np.isfinite(values).all() and values.max() > 0
    # Promised is 0.1 s on a machine of its own.
    assert took < 0.3, f"{took:.3f} s"


def test_cancel_ends_the_iteration(floor):
    with gonio.Render(floor(width=512, height=512, samples=100000)) as render:
        for count, _ in enumerate(render):
            if count == 3:
                render.cancel()
        assert render.progress.fraction < 1


def test_leaving_the_block_ends_the_render_soon(floor):
    render = gonio.Render(floor(width=512, height=512, samples=100000))
    with render:
        render.wait(0.3)
        start = time.monotonic()
    assert time.monotonic() - start < 0.4
    for use in (render.film, render.cancel, render.wait, lambda: render.progress, lambda: next(render)):
        with pytest.raises(RuntimeError, match="closed"):
            use()


def test_an_exception_passes_through_the_block(floor):
    with pytest.raises(KeyError), gonio.Render(floor(samples=100000, width=256, height=256)):
        raise KeyError("mine")


def test_a_dropped_render_stops(floor):
    before = threading.active_count()
    render = gonio.Render(floor(width=512, height=512, samples=100000))
    start = time.monotonic()
    del render
    gc.collect()
    # All samples would take minutes; a busy machine takes its time to end threads.
    assert time.monotonic() - start < 10.0 and threading.active_count() == before


def test_the_gil_is_free_while_rendering(floor):
    def count(seconds):
        counted, end = 0, time.monotonic() + seconds
        while time.monotonic() < end:
            counted += 1
        return counted

    counted = []
    with gonio.Render(floor(width=512, height=512, samples=100000, threads=1)) as render:
        worker = threading.Thread(target=lambda: counted.append(count(0.6)))
        worker.start()
        assert render.wait(0.8) is False
        worker.join()
    # With the GIL held the thread would not have had a turn; a tenth leaves room for busy machines.
    assert counted[0] > count(0.6) / 10


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no alarms on this system")
def test_signals_come_through(floor):
    def alarm(*_):
        raise InterruptedError("alarm")

    old = signal.signal(signal.SIGALRM, alarm)
    try:
        with gonio.Render(floor(width=512, height=512, samples=100000)) as render:
            signal.setitimer(signal.ITIMER_REAL, 0.3)
            start = time.monotonic()
            with pytest.raises(InterruptedError):
                render.wait()
            assert time.monotonic() - start < 1.5
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, old)


def test_time_limit(floor):
    with gonio.Render(floor(width=128, height=128, samples=10**6, time_limit=0.5)) as render:
        start = time.monotonic()
        assert render.wait()
        assert time.monotonic() - start < 5
        assert 0 < render.film().samples < 10**6


# Films.


def test_film_buffers(floor, render):
    names = ["color", "alpha", "depth", "normal", "P", "albedo", "primId", "luminance", "illuminance"]
    film = render(floor(width=40, height=24, passes=names))
    assert film.size == (40, 24) and film.samples == 4 and film.passes == names
    channels = {"color": 4, "normal": 3, "P": 3, "albedo": 3}
    for name in names:
        part = film[name]
        values = np.asarray(part)
        assert part.shape == values.shape == (24, 40, channels.get(name, 1)) and len(part.channels) == values.shape[2]
        assert values.dtype == np.float32 and values.flags.c_contiguous
        assert np.frombuffer(part.tobytes(), "f4").reshape(part.shape).tolist() == values.tolist()
        assert np.asarray(part, dtype="f8").dtype == np.float64
        assert np.isfinite(values).all() or name == "depth"
        assert not values.flags.writeable, "arrays are views of the film"
        turned = np.asarray(film.read(name, scale=2.0, bottom_up=True))
        factor = [2, 2, 2, 1][: values.shape[2]]  # coverage is no amount of light
        assert np.array_equal(turned, values[::-1] * np.float32(factor), equal_nan=True)


def test_a_missing_pass_lists_those_there_are(floor, render):
    film = render(floor())
    with pytest.raises(KeyError, match="color, illuminance"):
        film["depth"]


def test_depth_position_and_normal_of_a_floor(floor, render):
    film = render(floor(width=16, height=16, passes=["depth", "P", "normal", "albedo"]))
    place, normal = np.asarray(film["P"]), np.asarray(film["normal"])
    corner = (slice(0, 4), slice(0, 4))
    assert np.abs(place[corner][..., 1]).max() < 1e-3 and normal[corner][..., 1] == pytest.approx(1, abs=1e-3)
    assert np.asarray(film["depth"])[corner] == pytest.approx(8, rel=0.35)
    assert np.asarray(film["albedo"])[corner] == pytest.approx(0.5, abs=1e-3)
    # Rows come from the top: the camera's up is -z here.
    assert place[0, 8, 2] < place[15, 8, 2] and place[8, 0, 0] < place[8, 15, 0]


def test_writing_pictures(floor, render, tmp_path):
    film = render(floor())
    film.write_exr(tmp_path / "a.exr")
    film.write_exr(str(tmp_path / "half.exr"), half=True)
    film.write_picture(tmp_path / "a.png")
    film.write_picture(tmp_path / "a.jpg", tonemap="none", exposure=-3.0)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.exr", "a.jpg", "a.png", "half.exr"]
    exr = pytest.importorskip("OpenEXR")
    file = exr.File(str(tmp_path / "a.exr"), separate_channels=True)
    assert np.array_equal(file.channels()["G"].pixels, np.asarray(film["color"])[..., 1])
    assert np.array_equal(file.channels()["Illuminance"].pixels, np.asarray(film["illuminance"])[..., 0])
    with pytest.raises(gonio.SettingError, match="tonemap"):
        film.write_picture(tmp_path / "b.png", tonemap="filmic")
    with pytest.raises(OSError):
        film.write_exr("/nowhere/absent/a.exr")
    with pytest.raises((gonio.Error, ValueError, OSError)):
        film.write_picture(tmp_path / "b.tif")


def test_a_film_outlives_its_render_and_a_partial_film_can_be_taken(floor):
    render = gonio.Render(floor(width=128, height=128, samples=100000))
    with render:
        render.wait(0.4)
        early = render.film()
        render.wait(0.3)
        late = render.film()
    assert 0 <= early.samples <= late.samples < 100000
    assert np.isfinite(np.asarray(late["color"])).all()


def test_a_glowing_mesh_lights_a_large_floor_as_a_lamp_of_its_shape_does(floor, render):
    def lux(add):
        scene = floor(samples=256, passes=["illuminance"], max_bounces=0)
        scene.truncate("lights", 0)
        add(scene)
        values = np.asarray(render(scene)["illuminance"])[..., 0].copy()
        # What the panel hides, and its edges.
        values[12:20, 12:20] = 0.0
        return values

    def panel(scene):
        glow = scene.add_material(base_color=(0, 0, 0), specular_weight=0.0, emission_color=(10.0, 10.0, 10.0))
        corners = np.array([[-0.5, 0.1, 0.5], [0.5, 0.1, 0.5], [0.5, 0.1, -0.5], [-0.5, 0.1, -0.5]], "f4")
        scene.add_instance(scene.add_mesh(corners, np.array([[0, 1, 2], [0, 2, 3]], "i4")), [glow])

    def lamp(scene):
        scene.add_light("rectangle", (10.0, 10.0, 10.0), transform=[[1, 0, 0, 0], [0, 0, 1, 0.1], [0, -1, 0, 0], [0, 0, 0, 1]], visible=False)

    mesh, rectangle = lux(panel), lux(lamp)
    assert mesh.sum() == pytest.approx(rectangle.sum(), rel=0.01)
    # Rows from the panel outwards, where light comes in ever lower.
    assert np.allclose(mesh.sum(axis=1), rectangle.sum(axis=1), rtol=0.04)


def test_stacks_of_panes_are_measured_once(floor, render):
    def lux(panes):
        scene = floor(samples=64, passes=["illuminance"])
        pane = scene.add_material(base_color=(1.0, 1.0, 1.0), transmission_weight=0.95, thin_walled=True, specular_roughness=0.0)
        for number in range(panes):
            scene.add_instance(0, [pane], transform=[[1, 0, 0, 0], [0, 1, 0, 3 + 0.1 * number], [0, 0, 1, 0], [0, 0, 0, 1]])
        scene.add_light("dome", (1.0, 1.0, 1.0))
        return np.asarray(render(scene)["illuminance"]).mean()

    # The uppermost pane is what is measured, and an even sky is all that it sees from above; what lies under it makes no difference.
    assert lux(8) == pytest.approx(math.pi, rel=0.02)


# Determinism.


def arrays(film):
    return {name: np.asarray(film[name]).tobytes() for name in film.passes}


def test_threads_and_repetition_give_the_same_bits(floor, render):
    first = arrays(render(floor(width=130, height=70, threads=1)))
    assert first == arrays(render(floor(width=130, height=70, threads=2)))
    assert first == arrays(render(floor(width=130, height=70, threads=7)))
    assert first != arrays(render(floor(width=130, height=70, seed=1)))


def test_two_renders_at_once(floor, render):
    expected = arrays(render(floor(samples=64)))
    with gonio.Render(floor(samples=64)) as one, gonio.Render(floor(samples=64)) as two:
        assert one.wait() and two.wait()
        assert arrays(one.film()) == arrays(two.film()) == expected


def test_a_scene_changed_while_it_renders(floor, render):
    scene = floor(samples=200)
    expected = arrays(render(scene))
    with gonio.Render(scene) as running:
        scene.add_light("dome", (9.0, 9.0, 9.0))
        scene.set(width=7)
        assert running.wait()
        assert arrays(running.film()) == expected


# Bundles.


def rich_scene(floor):
    scene = floor(samples=3, width=40, height=30, passes=["color", "normal", "illuminance"])
    rng = np.random.default_rng(3)
    points = rng.uniform(-1, 1, (300, 3)).astype("f4") + np.array([0, 1, 0], "f4")
    triangles = np.arange(300, dtype="i4").reshape(-1, 3)
    mesh = scene.add_mesh(points, triangles, uvs=rng.uniform(size=(300, 2)), slots=(np.arange(100) % 2).astype("i4"), name="Späne")
    gold = scene.add_material("gold", base_color=(0.9, 0.7, 0.3), metalness=1.0, specular_roughness=0.3)
    looks = [gold, scene.add_material("glass", transmission_weight=1.0)]
    scene.add_instance(mesh, looks, transform=[[0.5, 0, 0, 1], [0, 0.5, 0, 0.25], [0, 0, 0.5, 0], [0, 0, 0, 1]])
    scene.add_light("rectangle", (3.0, 2.0, 1.0), width=0.5, height=2.0)
    scene.add_light("dome", (0.1, 0.1, 0.2))
    return scene


def test_a_bundle_renders_the_same_bits(floor, render, tmp_path):
    scene = rich_scene(floor)
    scene.save(tmp_path / "scene.json")
    again = gonio.Scene.load(tmp_path / "scene.json")
    assert again.to_dict() == scene.to_dict()
    assert arrays(render(again)) == arrays(render(scene))
    again.save(tmp_path / "again.json")
    assert arrays(render(gonio.Scene.load(str(tmp_path / "again.json")))) == arrays(render(scene))


def test_broken_bundles_are_errors(floor, tmp_path):
    rich_scene(floor).save(tmp_path / "scene.json")
    files = sorted(path for path in tmp_path.rglob("*") if path.is_file())
    assert files
    for file in files:
        whole = file.read_bytes()
        for broken in (b"", whole[: len(whole) // 2], whole[:-1], b"\xff" * 50):
            file.write_bytes(broken)
            with pytest.raises((gonio.Error, OSError)) as caught:
                gonio.Scene.load(tmp_path / "scene.json")
            assert "panick" not in str(caught.value)
        file.write_bytes(whole)
    files[-1].unlink()
    with pytest.raises((gonio.Error, OSError)):
        gonio.Scene.load(tmp_path / "scene.json")


@pytest.mark.parametrize("seed", range(20))
def test_altered_bundles_never_crash(floor, tmp_path, seed):
    rich_scene(floor).save(tmp_path / "scene.json")
    rng = np.random.default_rng(seed)
    for file in [path for path in tmp_path.rglob("*") if path.is_file()]:
        data = bytearray(file.read_bytes())
        for _ in range(3):
            data[rng.integers(len(data))] = rng.integers(256)
        file.write_bytes(bytes(data))
    try:
        scene = gonio.Scene.load(tmp_path / "scene.json")
        scene.set(width=8, height=8, samples=1, time_limit=5.0)
        with gonio.Render(scene) as render:
            render.wait()
            assert np.isfinite(np.asarray(render.film()["color"])).all()
    except (gonio.Error, OSError, KeyError):
        pass


def test_a_stage_and_its_bundle(render, tmp_path):
    pytest.importorskip("pxr")
    text = pathlib.Path(__file__).resolve().parents[1] / "shared" / "pictures.py"
    made = {}
    pytest.importorskip("OpenEXR")
    exec(compile(text.read_text(), str(text), "exec"), made)  # noqa: S102
    scene = gonio.load_usd(made["room"](tmp_path / "room.usda"))
    scene.set(width=32, height=32, samples=2)
    scene.save(tmp_path / "room.json")
    assert arrays(render(gonio.Scene.load(tmp_path / "room.json"))) == arrays(render(scene))


def test_a_compilation_that_is_not_wanted_any_more_is_cancelled():
    scene = gonio.Scene()
    steps = np.arange(1500)
    x, y = np.meshgrid(steps, steps, indexing="ij")
    points = np.stack([x, np.zeros_like(x), y], -1).reshape(-1, 3).astype("f4")
    first = (x[:-1, :-1] * 1500 + y[:-1, :-1]).reshape(-1)
    triangles = np.stack([first, first + 1, first + 1500], -1).astype("i4")
    mesh = scene.add_mesh(points, triangles)
    scene.add_instance(mesh)
    scene.add_camera()
    asked = []
    with pytest.raises(gonio.Cancelled):
        gonio.Render(scene, cancelled=lambda: asked.append(1) or len(asked) > 1)
    assert len(asked) == 2


def test_what_is_asked_while_compiling_may_fail(floor):
    def fails():
        raise ZeroDivisionError

    scene = floor()
    # A small scene may be ready before anybody asks.
    try:
        gonio.Render(scene, cancelled=fails).cancel()
    except ZeroDivisionError:
        pass
