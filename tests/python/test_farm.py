"""Parts of renders in Python, and how a cluster's job hands them out and gathers them, with no cluster at all."""

import sys
import types
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from small_scenes import at, finished, floor_scene

gonio = pytest.importorskip("gonio")

PARTS = [((0, 1), (0, 16)), ((0, 1), (16, 32)), ((1, 2), (0, 16)), ((1, 2), (16, 32))]


@pytest.mark.parametrize("lights", [1, 100])
def test_parts_are_settings_of_the_scene(tmp_path, lights):
    scene = floor_scene(width=130, height=70, samples=32)
    # Beyond 64 lights a render learns which arrive where, from all of the view.
    for number in range(1, lights):
        scene.add_light("sphere", (100.0,) * 3, radius=0.05, transform=at(number % 10 - 5, 1, number // 10 - 5), name=f"lamp {number}")
    parts = scene.parts(12)
    assert len(parts) == 12 and parts[0] == {"tile_range": (0, 1), "sample_range": (0, 16)}
    paths = []
    for part in parts:
        scene.set(**part)
        with gonio.Render(scene) as render:
            assert render.wait()
            paths.append(tmp_path / f"{len(paths)}.part")
            render.checkpoint(paths[-1])
    scene.set(tile_range=None, sample_range=None)
    whole, merged = finished(scene), gonio.merge(paths)
    assert all(np.array_equal(np.asarray(whole[name]), np.asarray(merged[name])) for name in whole.passes)
    with pytest.raises(gonio.FormatError, match="tiles 0:1 are there twice|samples 0:16 are there twice"):
        gonio.merge([*paths, paths[0]])


@pytest.mark.parametrize("tiles", [(0, 0), (2, 1), (0, 7), (6, 7)])
def test_tiles_beyond_the_picture(tiles):
    scene = floor_scene(width=130, height=70)
    scene.set(tile_range=tiles)
    with pytest.raises(gonio.SettingError, match="expected a part of 0:6"):
        gonio.Render(scene)


def test_bundles_carry_images_and_tiles(tmp_path):
    scene = floor_scene()
    for name in ("wood.1001.png", "wood.1012.png", "stone.png"):
        (tmp_path / name).write_bytes(name.encode())
    for name in ("wood.<UDIM>.png", "stone.png"):
        scene.put_texture({"origin": {"name": name}, "source": {"File": str(tmp_path / name)}, "colour_space": "auto"})
    scene.save(tmp_path / "scene", images=True)
    wood, stone = (texture["source"] for texture in gonio.Scene.load(tmp_path / "scene").to_dict()["textures"])
    tiles = [(tile["number"], bytes(tile["bytes"])) for tile in wood["Tiles"]["tiles"]]
    assert tiles == [(1001, b"wood.1001.png"), (1012, b"wood.1012.png")]
    assert bytes(stone["Encoded"]["bytes"]) == b"stone.png"


class Client:
    """Runs tasks at once, in threads; the tasks of `lost` fail."""

    status = "running"

    def __init__(self, lost=()):
        self.pool, self.lost, self.cancelled, self.priorities = ThreadPoolExecutor(2), lost, [], []

    def nthreads(self):
        return {"tcp://worker": 2}

    def submit(self, function, *arguments, key, priority, pure):
        self.priorities.append(priority)
        return self.pool.submit(self._run, key)

    def _run(self, key):
        if key[1:] in self.lost:
            raise gonio.Error("worker desk at tcp://worker: no room")
        return b"%d of %d" % (key[2], key[1]) if len(key) == 3 else b"scene"

    def cancel(self, futures, force, reason):
        self.cancelled += futures

    def close(self):
        self.status = "closed"


@pytest.fixture
def job(monkeypatch, tmp_path):
    """Makes a job of so many frames with a client of the test's."""
    distributed = types.ModuleType("distributed")
    distributed.CancelledError = type("CancelledError", (Exception,), {})
    distributed.scheduler = types.SimpleNamespace(KilledWorker=type("KilledWorker", (Exception,), {}))
    monkeypatch.setitem(sys.modules, "distributed", distributed)
    from gonio.farm.job import Job
    from gonio.farm.worker import render_part

    def make(frames, client, cancelled=lambda: False):
        said = []
        cluster = types.SimpleNamespace(client=client, level="scalar", cancelled=cancelled)
        return Job(cluster, [lambda: "scene"] * frames, PARTS, render_part, tmp_path, lambda *words: said.append(words)), said

    return make


def test_frames_come_in_order_and_their_files_go(job, tmp_path):
    client = Client()
    job, said = job(3, client)
    for frame, files in enumerate(job.frames()):
        found = sorted(Path(file).read_bytes() for file in files)
        assert found == [b"%d of %d" % (part, frame) for part in range(4)]
    assert not list(tmp_path.iterdir())
    assert client.priorities == sorted(client.priorities, reverse=True)
    assert said[-1][0] == 1.0 and said[-1][1] == "12/12 parts" and said[-1][3] == "1 worker"


def test_a_part_that_fails_ends_the_job(job):
    job, _ = job(2, Client(lost={(1, 2)}))
    with pytest.raises(gonio.Error, match="worker desk at tcp://worker: no room"):
        # The part may fail before the first frame has all of its own.
        list(job.frames())


def test_a_job_that_is_cancelled_takes_everything_back(job):
    client = Client()
    job, _ = job(1, client, cancelled=lambda: True)
    with pytest.raises(gonio.Cancelled):
        next(job.frames())
    job.cancel()
    assert len(client.cancelled) == len(PARTS) + 1


@pytest.fixture
def cluster(monkeypatch):
    """Connects to workers that answer what they are asked for as the test says, by the function's name."""
    from gonio.farm import cluster

    def connect(**answers):
        client = Client()
        client.run = lambda function, *arguments, on_error: {"tcp://desk": answers[function.__name__]}
        monkeypatch.setattr(cluster, "connect", lambda address: client)
        return cluster.Cluster("tcp://farm", lambda: False)

    monkeypatch.delenv("GONIO_SIMD", raising=False)
    return connect


def test_all_workers_render_at_one_level(cluster, monkeypatch):
    assert cluster(census=(gonio.__version__, "avx2")).level == "avx2"
    assert cluster(census=(gonio.__version__, "avx2")).parts_for(3) == 3
    monkeypatch.setenv("GONIO_SIMD", "scalar")
    assert cluster(census=(gonio.__version__, "avx2")).level == "scalar"


@pytest.mark.parametrize(
    "answer, said",
    [
        (("0.0.1", "avx2"), "worker tcp://desk has gonio 0.0.1, this is "),
        (ModuleNotFoundError("No module named 'gonio'"), "worker tcp://desk cannot run gonio .*No module named 'gonio'"),
    ],
)
def test_workers_that_cannot_help(cluster, answer, said):
    with pytest.raises(gonio.Error, match=said):
        cluster(census=answer)


def test_a_file_that_a_worker_does_not_see(cluster, tmp_path):
    from gonio.farm.source import Stage, unseen

    missing = str(tmp_path / "lamp.ies")
    (tmp_path / "weather.epw").write_text("")
    assert unseen([str(tmp_path / "weather.epw"), missing]) == [missing]
    asked = cluster(census=(gonio.__version__, "avx2"), unseen=[missing])
    with pytest.raises(gonio.Error, match=r"worker tcp://desk cannot read .*lamp\.ies; put the stage"):
        asked.stages(["gonio", "render"], tmp_path, [tmp_path / "weather.epw"], False, [None])
    with pytest.raises(gonio.Error, match=r"cannot read .*lamp\.ies"):
        Stage(["gonio", "render"], tmp_path, [missing], None).scene()
