"""Renders on a Dask cluster have the bits of one process: workers come, are killed and are cancelled, scenes are read or sent.

Dask and openjd have an environment of their own; gonio is the one that runs the tests.
"""

import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import environments
import gonio
import pytest

sys.path.append(str(environments.ROOT / "tests" / "shared"))
import facade_room  # noqa: E402
import numpy as np  # noqa: E402
import pictures  # noqa: E402
from wea_years import HOUR, write_wea  # noqa: E402

pytestmark = [pytest.mark.validate, pytest.mark.timeout(1800)]

PASSES = "color,illuminance,primId,sample_count"
PARTS = 24
TEMPLATE = environments.ROOT / "examples" / "farm" / "gonio.openjd.yaml"


@pytest.fixture(scope="module")
def python():
    """A Python with Dask, openjd and gonio."""
    try:
        return environments.python_of("farm")
    except environments.Unavailable as reason:
        pytest.skip(f"no environment with Dask and openjd: {reason}")


@pytest.fixture(scope="module")
def environment():
    """Variables by which other Pythons find this gonio."""
    return {**os.environ, "PYTHONPATH": str(Path(gonio.__file__).parents[1])}


@pytest.fixture(scope="module")
def room(tmp_path_factory):
    return pictures.room(tmp_path_factory.mktemp("room") / "room.usda")


class Farm:
    """A scheduler and workers without nannies, each a process that can be killed for good."""

    def __init__(self, python, environment, folder):
        self._python, self._environment, self._folder = python, environment, folder
        self.address = folder / "scheduler.json"
        self._scheduler = self._start("scheduler", "--port", "0", "--no-dashboard")
        while not self.address.exists():
            assert self._scheduler.poll() is None, self._said()
            time.sleep(0.1)
        self.workers = []

    def _start(self, what, *options):
        line = [self._python, "-m", f"distributed.cli.dask_{what}", "--scheduler-file", self.address, *options]
        with (self._folder / "log").open("ab") as log:
            return subprocess.Popen(list(map(str, line)), cwd=self._folder, env=self._environment, stdout=log, stderr=log)

    def _said(self):
        return (self._folder / "log").read_text()

    def add(self):
        name = f"worker{len(self.workers)}"
        worker = self._start(
            "worker", "--nthreads", "1", "--no-nanny", "--no-dashboard", "--name", name, "--local-directory", str(self._folder / name)
        )
        self.workers.append(worker)

    def kill(self, chance):
        """Kills one of the workers."""
        worker = chance.choice([worker for worker in self.workers if worker.poll() is None])
        worker.kill()
        worker.wait()

    def end(self):
        for process in [*self.workers, self._scheduler]:
            process.kill()
            process.wait()


@pytest.fixture
def farm(python, environment, tmp_path):
    """A cluster of four workers."""
    folder = tmp_path / "farm"
    folder.mkdir()
    farm = Farm(python, environment, folder)
    for _ in range(4):
        farm.add()
    yield farm
    farm.end()


@pytest.fixture
def temporary(tmp_path):
    """Where renders keep the parts that have come."""
    folder = tmp_path / "temporary"
    folder.mkdir()
    return folder


@pytest.fixture
def render(python, environment, temporary):
    """Starts `gonio render` on a stage; a cluster's scheduler is an option as any other."""

    def start(stage, *options, size=256, spp=512):
        line = ["render", stage, "--res", size, size, "--spp", spp, "--aov", PASSES, *options]
        line = [str(python), "-m", "gonio.cli", *map(str, line)]
        return subprocess.Popen(
            line, env={**environment, "TMPDIR": str(temporary)}, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )

    return start


def ended(process):
    """What a render that went well has said on standard error."""
    _, said = process.communicate(timeout=600)
    assert process.returncode == 0, said
    return said


def same(first, second):
    return pictures.same(pictures.read(first), pictures.read(second))


@pytest.mark.parametrize("seed", range(6))
def test_four_workers_one_killed_one_added(farm, render, room, temporary, tmp_path, seed):
    chance = random.Random(seed)
    options = ("-q", "--noise-threshold", "0.02") if seed % 2 else ("-q",)
    ended(render(room, "-o", tmp_path / "one.exr", *options))
    process = render(room, "-o", tmp_path / "farm.exr", "--dask", farm.address, "--dask-parts", PARTS, *options)
    # With more parts to come than there are workers, some are under way.
    here = chance.randrange(PARTS - 8)
    while len(list(temporary.glob("gonio-farm-*/*.part"))) < here:
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    farm.kill(chance)
    farm.add()
    ended(process)
    assert same(tmp_path / "one.exr", tmp_path / "farm.exr")


def test_frames_and_scenes_that_are_sent(farm, render, room, tmp_path):
    stage = room.read_text().replace("double radius = 0.6", "double radius.timeSamples = {1: 0.4, 3: 0.6}")
    (tmp_path / "moving.usda").write_text(stage)
    options = ("--frames", "1:3", "-q")
    ended(render(tmp_path / "moving.usda", "-o", tmp_path / "one.#.exr", *options, spp=32))
    for name, more in (("read", ()), ("sent", ("--dask-send",))):
        ended(render(tmp_path / "moving.usda", "-o", tmp_path / f"{name}.#.exr", "--dask", farm.address, *options, *more, spp=32))
        for frame in (1, 2, 3):
            assert same(tmp_path / f"one.{frame}.exr", tmp_path / f"{name}.{frame}.exr")
    assert not same(tmp_path / "one.1.exr", tmp_path / "one.3.exr")


def test_caustics_on_a_cluster(farm, render, tmp_path):
    glass = pictures.room_with_glass(tmp_path / "glass.usda")
    options = ("-q", "--caustics", "on")
    ended(render(glass, "-o", tmp_path / "one.exr", *options, spp=64))
    ended(render(glass, "-o", tmp_path / "farm.exr", "--dask", farm.address, "--dask-parts", PARTS, *options, spp=64))
    assert same(tmp_path / "one.exr", tmp_path / "farm.exr")


def test_ctrl_c_leaves_nothing(farm, render, room, temporary, tmp_path):
    process = render(room, "-o", tmp_path / "farm.exr", "--dask", farm.address, "--dask-parts", 512, spp=1 << 13)
    while not list(temporary.glob("gonio-farm-*/*.part")):
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=30)
    assert process.returncode == 130 and said.splitlines()[-1] == "gonio: interrupted", said
    assert not list(tmp_path.glob("farm.exr*")) and not list(temporary.iterdir())
    # The workers have stopped and take the next render.
    ended(render(room, "-o", tmp_path / "next.exr", "--dask", farm.address, "-q", spp=16))


def test_what_cannot_be_used_is_told_in_one_line(farm, render, room, python, environment, tmp_path):
    process = render(tmp_path / "nothing.usda", "-o", tmp_path / "a.exr", "--dask", farm.address)
    _, said = process.communicate(timeout=60)
    assert process.returncode == 1 and "nothing.usda" in said and len(said.splitlines()) == 1
    process = render(room, "-o", tmp_path / "a.exr", "--dask", "tcp://127.0.0.1:9")
    _, said = process.communicate(timeout=60)
    assert process.returncode == 1 and "no Dask scheduler answers at tcp://127.0.0.1:9" in said and len(said.splitlines()) == 1


def test_python_renders_scenes_on_a_cluster(farm, python, environment):
    script = """
import sys, numpy, gonio, gonio.farm
sys.path.append(sys.argv[2])
from small_scenes import finished, floor_scene
scene = floor_scene(width=130, height=70, samples=64)
film = gonio.farm.render(scene, sys.argv[1])
one = finished(scene)
assert all(numpy.array_equal(numpy.asarray(film[name]), numpy.asarray(one[name])) for name in one.passes)
"""
    done = subprocess.run(
        [python, "-c", script, farm.address, environments.ROOT / "tests" / "shared"],
        env=environment,
        capture_output=True,
        text=True,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr


@pytest.fixture(scope="module")
def year(tmp_path_factory):
    """A stage with two facades, and a weather file."""
    folder = tmp_path_factory.mktemp("year")
    light = (HOUR > 6) & (HOUR < 18)
    write_wea(folder / "year.wea", np.where(np.abs(HOUR - 12) < 3, 40000, 0), np.where(light, 9000, 0))
    (folder / "room.usda").write_text(facade_room.stage())
    return folder


def series(folder):
    return [(folder / f"Floor_{name}.npy").read_bytes() for name in ("total", "direct")] + [(folder / "Floor_points.csv").read_text()]


GROUPS = ("--group", "south=/Room/South", "--group", "west=/Room/West")


@pytest.mark.parametrize(
    "options", [(), ("--closed-variant", "/Room/South{blinds=closed}"), (*GROUPS, "--closed-variant", "south=/Room/South{blinds=closed}")]
)
def test_a_year_is_traced_by_a_cluster(farm, python, environment, year, tmp_path, options):
    def line(folder, *more):
        words = ["annual", year / "room.usda", "--weather", year / "year.wea", "--grid", "/Room/Floor", "--height", 0.8, "--spacing", 1, "-p", 512]
        words = [python, "-m", "gonio.cli", *words, "-q", "-o", folder, *options, *more]
        done = subprocess.run(list(map(str, words)), env=environment, capture_output=True, text=True, timeout=300)
        assert done.returncode == 0, done.stderr
        return done.stdout.replace(str(folder), "")

    assert line(tmp_path / "one") == line(tmp_path / "farm", "--dask", farm.address)
    assert series(tmp_path / "one") == series(tmp_path / "farm")


def test_python_traces_years_on_a_cluster(farm, python, environment, year):
    script = """
import sys, pathlib, numpy, gonio, gonio.farm
folder = pathlib.Path(sys.argv[2])
weather = (folder / "year.wea").read_bytes()
scene = gonio.load_usd(folder / "room.usda")
positions = [(x, y, 0.8) for x in (1.0, 3.0) for y in (1.0, 3.0)]
for position in positions:
    scene.add_meter(position)
asked = {"samples": 512, "groups": {"south": "/Room/South", "west": "/Room/West"}, "blinds": {"west": 0.1}, "closed": {"south": scene}}
(one,) = gonio.annual(scene, weather, **asked)
(farm,) = gonio.farm.annual(scene, weather, sys.argv[1], parts=5, **asked)
assert numpy.array_equal(numpy.asarray(one.total), numpy.asarray(farm.total)) and one.figures == farm.figures
"""
    done = subprocess.run(
        [python, "-c", script, farm.address, year], env=environment, capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr


def test_the_open_job_description(python, environment, render, room, tmp_path):
    openjd = python.with_name("openjd")
    done = subprocess.run([openjd, "check", TEMPLATE], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stdout + done.stderr
    script = tmp_path / "gonio"
    script.write_text(f'#!/bin/sh\nexec {python} -m gonio.cli "$@"\n')
    script.chmod(0o755)
    parameters = {"Stage": room, "OutputFolder": tmp_path, "Frames": "1-2", "Samples": 32, "Width": 128, "Passes": PASSES, "Gonio": script}
    words = [word for name, value in parameters.items() for word in ("-p", f"{name}={value}")]
    done = subprocess.run([openjd, "run", TEMPLATE, *words], env=environment, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stdout + done.stderr
    line = [
        python,
        "-m",
        "gonio.cli",
        "render",
        room,
        "--image-width",
        "128",
        "--spp",
        "32",
        "--aov",
        PASSES,
        "--frames",
        "1:2",
        "-o",
        tmp_path / "one.#.exr",
    ]
    subprocess.run(line, env=environment, check=True, timeout=120)
    for frame in (1, 2):
        assert same(tmp_path / f"one.{frame}.exr", tmp_path / f"picture.{frame}.exr")
