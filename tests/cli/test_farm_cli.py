"""What `gonio render` says about clusters before there is one, and parts of a render that a farm's tasks name by number."""

import os
import re
from pathlib import Path

import numpy as np
import pictures
import pytest

PASSES = "color,illuminance,primId,sample_count"


def line(room, *options, spp=16):
    return ["render", str(room), "--res", "130", "96", "--spp", str(spp), "--aov", PASSES, "-q", *map(str, options)]


@pytest.mark.parametrize(
    "others", [("--checkpoint", "c"), ("--samples", "0:16"), ("--part", "1/2"), ("--time-limit", "5"), ("--threads", "2")]
)
def test_parts_are_the_clusters_affair(run, room, others):
    done = run(*line(room, "-o", "a.exr", "--dask", "tcp://127.0.0.1:9", *others))
    assert done.returncode == 2 and "--dask <ADDRESS>' cannot be used with" in done.stderr


def test_the_files_that_workers_need(tmp_path):
    from gonio.farm.source import files_of

    layer = pictures.room(tmp_path / "layer.usda")
    stage = tmp_path / "stage.usda"
    stage.write_text(f"#usda 1.0\n(\n    subLayers = [@{layer.name}@]\n)\n")
    assert {Path(file).name for file in files_of([stage])} == {"stage.usda", "layer.usda"}


def test_options_of_clusters_need_one(run, room):
    assert run(*line(room, "-o", "a.exr", "--dask-send")).returncode == 2
    assert run(*line(room, "-o", "a.exr", "--dask-parts", 4)).returncode == 2
    assert run(*line(room, "-o", "a.exr", "--dask", "tcp://127.0.0.1:9", "--dask-parts", 0)).returncode == 2


def test_a_cluster_without_the_extra_is_one_line(run, room, tmp_path):
    (tmp_path / "distributed.py").write_text("raise ImportError('no such thing')\n")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])}
    done = run(*line(room, "-o", tmp_path / "a.exr", "--dask", "tcp://127.0.0.1:9"), env=environment)
    assert done.returncode == 1 and len(done.stderr.splitlines()) == 1, done.stderr
    assert done.stderr.startswith("gonio: error: dask: ") and "pip install distributed" in done.stderr
    assert not (tmp_path / "a.exr").exists()


@pytest.mark.parametrize("options, count", [((), 4), ((), 9), (("--noise-threshold", 0.1, "--min-spp", 4), 3), (("--haze", 20), 3)])
def test_parts_merge_to_the_whole(run, room, tmp_path, options, count):
    assert run(*line(room, "-o", tmp_path / "whole.exr", *options, spp=48)).returncode == 0
    for number in range(1, count + 1):
        done = run(*line(room, *options, "--part", f"{number}/{count}", "--checkpoint", tmp_path / f"{number}.sums", spp=48))
        assert done.returncode == 0, done.stderr
    parts = sorted(tmp_path.glob("*.sums"))
    assert run("merge", *parts, "-o", tmp_path / "merged.exr").returncode == 0
    whole, merged = (pictures.read(tmp_path / name) for name in ("whole.exr", "merged.exr"))
    assert whole.channels.keys() == merged.channels.keys()
    assert all(np.array_equal(whole[name], merged[name], equal_nan=True) for name in whole.channels)
    for left in (parts[1:], [parts[0], *parts[2:]], parts[:-1]):
        done = run("merge", *left, "-o", tmp_path / "hole.exr")
        assert done.returncode == 1 and re.search("are missing|expected the same", done.stderr), done.stderr


def test_prototypes_that_usd_numbers_otherwise_each_time(run, tmp_path):
    office = Path(__file__).resolve().parents[2] / "examples" / "usd" / "office.usda"
    options = ("--res", 130, 80, "--spp", 1, "-q")
    for number in range(1, 5):
        done = run("render", office, *options, "--part", f"{number}/4", "--checkpoint", tmp_path / f"{number}.sums")
        assert done.returncode == 0, done.stderr
    done = run("merge", *tmp_path.glob("*.sums"), "-o", tmp_path / "merged.exr")
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("part", ["0/2", "3/2", "2", "a/b", "1/0"])
def test_parts_that_there_are_not(run, room, tmp_path, part):
    done = run(*line(room, "-o", tmp_path / "a.exr", "--part", part))
    assert done.returncode == 1 and done.stderr.startswith("gonio: error: part"), done.stderr


def test_more_parts_than_there_can_be(run, room, tmp_path):
    done = run(*line(room, "-o", tmp_path / "a.exr", "--part", "1/100"))
    assert done.returncode == 1 and "there cannot be 100 parts of this render, but 6" in done.stderr
