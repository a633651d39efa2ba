"""Checkpoints, parts of renders and noise thresholds on the command line: the bits of one undisturbed render, or one clear line."""

import os
import random
import subprocess
import time

import numpy as np
import pictures
import pytest
from failures import error_of

PASSES = "color,illuminance,primId,sample_count"


def line(room, *options, size=96, spp=64):
    return ["render", str(room), "--res", str(size), str(size), "--spp", str(spp), "--aov", PASSES, "-q", *map(str, options)]


def test_parts_merge_to_the_whole(run, room, tmp_path):
    assert run(*line(room, "-o", tmp_path / "whole.exr")).returncode == 0
    parts = [tmp_path / f"{first}.part" for first in (0, 16, 48)]
    for part, samples, threads in zip(parts, ("0:16", "16:48", "48:64"), (1, 2, 3), strict=True):
        done = run(*line(room, "--samples", samples, "--checkpoint", part, "-j", threads))
        assert done.returncode == 0, done.stderr
    done = run("merge", *reversed(parts), "-o", tmp_path / "merged.exr", "-o", tmp_path / "merged.png")
    assert done.returncode == 0 and "samples 0:64 of 64" in done.stderr and (tmp_path / "merged.png").exists(), done.stderr
    whole, merged = pictures.read(tmp_path / "whole.exr"), pictures.read(tmp_path / "merged.exr")
    assert pictures.same(whole, merged)
    assert merged.header["gonio:samples"] == "64" and merged.header["gonio:camera"] == whole.header["gonio:camera"]


def test_a_finished_checkpoint_gives_the_picture_again(run, room, tmp_path):
    assert run(*line(room, "-o", tmp_path / "a.exr", "--checkpoint", tmp_path / "c")).returncode == 0
    assert run(*line(room, "-o", tmp_path / "b.exr", "--checkpoint", tmp_path / "c", "--resume")).returncode == 0
    assert pictures.same(pictures.read(tmp_path / "a.exr"), pictures.read(tmp_path / "b.exr"))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.exr", "b.exr", "c"]


def test_frames_have_checkpoints_of_their_own(run, room, tmp_path):
    options = ("-f", "1:2", "-o", tmp_path / "a.#.exr")
    assert "checkpoint" in error_of(run(*line(room, *options, "--checkpoint", tmp_path / "c", spp=1)))
    assert run(*line(room, *options, "--checkpoint", tmp_path / "c.#", spp=1)).returncode == 0
    assert (tmp_path / "c.1").exists() and (tmp_path / "c.2").exists()


def test_what_cannot_be_used_is_told_in_one_line(run, room, tmp_path):
    kept = ("--checkpoint", tmp_path / "c")
    assert run(*line(room, *kept, spp=16)).returncode == 0
    assert "--resume" in error_of(run(*line(room, *kept, spp=16)))
    assert "its samples is 16, 32 was asked for" in error_of(run(*line(room, *kept, "--resume", spp=32)))
    assert "its resolution is [96,96], [64,64] was asked for" in error_of(run(*line(room, *kept, "--resume", spp=16, size=64)))
    stage = room.read_text()
    other = tmp_path / "room.usda"
    other.write_text(stage.replace("double radius = 0.6", "double radius = 0.7"))
    assert "another scene" in error_of(run(*line(other, *kept, "--resume", spp=16)))
    assert "another scene" in error_of(run(*line(room, *kept, "--resume", "--haze", 20, spp=16)))
    (tmp_path / "c").write_bytes((tmp_path / "c").read_bytes()[:-9])
    assert "ends before its time" in error_of(run(*line(room, *kept, "--resume", spp=16)))


@pytest.mark.parametrize("samples", ["5:16", "0:0", "0:99", "16:8", "a:b", "16"])
def test_ranges_that_would_cut_blocks(run, room, tmp_path, samples):
    assert "samples: " in error_of(run(*line(room, "-o", tmp_path / "a.exr", "--samples", samples, spp=32)))


def test_a_part_knows_no_noise_threshold(run, room, tmp_path):
    said = error_of(run(*line(room, "-o", tmp_path / "a.exr", "--samples", "0:16", "--noise-threshold", 0.1)))
    assert "noise threshold" in said


def test_noise_threshold_spends_samples_where_the_noise_is(run, room, tmp_path):
    picture = {}
    for threshold in (0, 0.05):
        path = tmp_path / f"{threshold}.exr"
        assert run(*line(room, "-o", path, "--noise-threshold", threshold, "--min-spp", 16, spp=256)).returncode == 0
        picture[threshold] = pictures.read(path)
    counts = picture[0.05]["sample_count"]
    assert counts.min() == 16 and (picture[0]["sample_count"] == 256).all()
    assert 16 < counts.mean() < 200
    # Zones of 8 x 8 pixels share their number.
    assert (counts.reshape(12, 8, 12, 8) == counts.reshape(12, 8, 12, 8)[:, :1, :, :1]).all()
    means = [np.mean(picture[threshold].rgb) for threshold in (0, 0.05)]
    assert means[1] == pytest.approx(means[0], rel=5e-3)


def render_with_kills(command, room, path, kills, chance, *options, size=192, spp=512):
    """Kills a render of a second or two again and again, resuming each time; gives the picture."""
    checkpoint = path.with_suffix(".checkpoint")
    arguments = [
        *command,
        *line(room, "-o", path, "--checkpoint", checkpoint, "--checkpoint-every", "0", "--resume", *options, size=size, spp=spp),
    ]
    for _ in range(kills):
        with subprocess.Popen(arguments, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            time.sleep(chance.uniform(0.2, 1.5))
            process.kill()
    done = subprocess.run(arguments, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    return pictures.read(path)


def kill_often(run, command, room, tmp_path, renders, kills):
    chance = random.Random(7)
    for threshold in (0, 0.02):
        options = ("--noise-threshold", threshold)
        assert run(*line(room, "-o", tmp_path / "whole.exr", *options, size=192, spp=512)).returncode == 0
        whole = pictures.read(tmp_path / "whole.exr")
        for number in range(renders):
            path = tmp_path / f"{threshold}-{number}.exr"
            assert pictures.same(whole, render_with_kills(command, room, path, kills, chance, *options)), path.name


def test_kills_do_not_change_a_bit(run, command, room, tmp_path):
    kill_often(run, command, room, tmp_path, 1, 3)


def test_kills_do_not_change_a_bit_of_fog(run, command, room, tmp_path):
    for name, options in (("whole", ("--haze", 20)), ("clear", ())):
        assert run(*line(room, "-o", tmp_path / f"{name}.exr", *options, size=96, spp=256)).returncode == 0
    whole = pictures.read(tmp_path / "whole.exr")
    assert not pictures.same(whole, pictures.read(tmp_path / "clear.exr"))
    assert pictures.same(whole, render_with_kills(command, room, tmp_path / "killed.exr", 3, random.Random(3), "--haze", 20, size=96, spp=256))


def test_kills_do_not_change_a_bit_of_caustics(run, command, tmp_path):
    glass = pictures.room_with_glass(tmp_path / "glass.usda")
    options = ("--caustics", "on")
    for name, switch in (("whole", options), ("without", ("--caustics", "off"))):
        assert run(*line(glass, "-o", tmp_path / f"{name}.exr", *switch, size=96, spp=256)).returncode == 0
    whole = pictures.read(tmp_path / "whole.exr")
    assert not pictures.same(whole, pictures.read(tmp_path / "without.exr"))
    assert pictures.same(whole, render_with_kills(command, glass, tmp_path / "killed.exr", 3, random.Random(5), *options, size=96, spp=256))


@pytest.mark.validate
@pytest.mark.timeout(1800)
def test_fifty_kills_do_not_change_a_bit(run, command, room, tmp_path):
    kill_often(run, command, room, tmp_path, 5, 5)


def test_denoising_on_the_command_line(run, room, tmp_path):
    pytest.importorskip("pyoidn")
    for name, options in (("raw", ()), ("clean", ("--denoise",))):
        assert run(*line(room, "-o", tmp_path / f"{name}.exr", *options, spp=4)).returncode == 0
    raw, clean = pictures.read(tmp_path / "raw.exr"), pictures.read(tmp_path / "clean.exr")
    assert raw.channels.keys() == clean.channels.keys()
    changed = {name for name in raw.channels if not np.array_equal(raw[name], clean[name])}
    assert changed == {"R", "G", "B"}
    rough = lambda image: np.abs(np.diff(image.rgb, axis=0)).mean()  # noqa: E731
    assert rough(clean) < 0.8 * rough(raw)


def test_denoising_without_the_extra_is_one_line(run, room, tmp_path):
    (tmp_path / "pyoidn.py").write_text("raise ImportError('no such thing')\n")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])}
    done = run(*line(room, "-o", tmp_path / "a.exr", "--denoise", spp=1), env=environment)
    assert "pip install pyoidn" in error_of(done)
