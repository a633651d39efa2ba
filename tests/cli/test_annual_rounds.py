"""Rounds of `gonio annual` on disk: the bits of one undisturbed year after kills and from parts, or one clear line."""

import subprocess
import time

import facade_room
import numpy as np
import pytest
from failures import error_of
from wea_years import HOUR, write_wea


@pytest.fixture(scope="module")
def room(tmp_path_factory):
    """The stage and a weather file."""
    folder = tmp_path_factory.mktemp("room")
    light = (HOUR > 6) & (HOUR < 18)
    write_wea(folder / "year.wea", np.where(np.abs(HOUR - 12) < 3, 40000, 0), np.where(light, 9000, 0))
    (folder / "room.usda").write_text(facade_room.stage())
    return folder


def line(room, *options, spp=256, spacing=1):
    words = ["annual", room / "room.usda", "--weather", room / "year.wea", "--grid", "/Room/Floor", "--height", 0.8, "--spacing", spacing]
    return [str(word) for word in [*words, "-p", spp, "-q", *options]]


def series(folder):
    return [(folder / f"Floor_{name}.npy").read_bytes() for name in ("total", "direct")] + [(folder / "Floor_points.csv").read_text()]


def test_kills_change_no_bit(run, command, room, tmp_path):
    assert run(*line(room, "-o", tmp_path / "whole", "-j", 1, spp=8192)).returncode == 0
    kept = tmp_path / "kept"
    words = [*command, *line(room, "-o", tmp_path / "out", "--checkpoint", kept, "--checkpoint-every", 0, "--resume", spp=8192)]
    killed = 0
    for _ in range(3):
        before = kept.stat().st_mtime_ns if kept.exists() else 0
        with subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL) as process:
            # Killed as soon as it has kept another round.
            while process.poll() is None and (kept.stat().st_mtime_ns if kept.exists() else 0) == before:
                time.sleep(0.005)
            process.kill()
            killed += process.wait() != 0
    assert killed > 0
    done = subprocess.run(words, check=False, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert series(tmp_path / "out") == series(tmp_path / "whole")


def test_parts_make_the_whole(run, room, tmp_path):
    blinds = ("--closed-variant", "/Room/South{blinds=closed}")
    assert run(*line(room, *blinds, "-o", tmp_path / "whole")).returncode == 0
    parts = [tmp_path / f"{part}.rounds" for part in (1, 2, 3)]
    for part, path in enumerate(parts, 1):
        done = run(*line(room, *blinds, "--part", f"{part}/3", "--checkpoint", path, "-j", part))
        assert done.returncode == 0 and done.stdout == "", done.stderr
    done = run(*line(room, *blinds, "-o", tmp_path / "merged", "--merge", *reversed(parts)))
    assert done.returncode == 0, done.stderr
    assert series(tmp_path / "merged") == series(tmp_path / "whole")
    assert "rounds 6, 7, 8, 9, 10 of 16 are missing" in error_of(run(*line(room, *blinds, "--merge", parts[0], parts[2])))
    assert "round 6 is there twice" in error_of(run(*line(room, *blinds, "--merge", parts[1], parts[1])))
    assert "1 were asked for" in error_of(run(*line(room, "--merge", *parts)))
    assert "there cannot be 17 parts of a year, but 16" in error_of(run(*line(room, "--part", "2/17", "--checkpoint", tmp_path / "p")))


def test_finished_rounds_serve_another_schedule(run, room, tmp_path):
    kept = tmp_path / "kept"
    assert run(*line(room, "--checkpoint", kept)).returncode == 0
    wanted = run(*line(room, "--schedule", "9-17", "--blinds", 0.1))
    again = run(*line(room, "--schedule", "9-17", "--blinds", 0.1, "--checkpoint", kept, "--resume"))
    assert again.returncode == 0 and again.stdout == wanted.stdout and "sDA" in again.stdout


def test_what_cannot_be_used_is_told_in_one_line(run, room, tmp_path):
    kept = tmp_path / "kept"
    resumed = ("--checkpoint", kept, "--resume")
    assert run(*line(room, "--checkpoint", kept)).returncode == 0
    assert "is there already; resume goes on with it" in error_of(run(*line(room, "--checkpoint", kept)))
    assert "its samples is 256, 512 was asked for" in error_of(run(*line(room, *resumed, spp=512)))
    assert "its seed is 0, 3 was asked for" in error_of(run(*line(room, *resumed, "--seed", 3)))
    assert "its 20 points are others than the 80 that were asked for" in error_of(run(*line(room, *resumed, spacing=0.5)))
    assert "its points lie elsewhere" in error_of(run(*line(room, *resumed, "--margin", 0.2)))
    assert "its sky has 578 patches, 2306 were asked for" in error_of(run(*line(room, *resumed, "-m", 4)))
    assert "its suns stand elsewhere" in error_of(run(*line(room, *resumed, "--north", 30)))
    assert "its suns stand elsewhere" in error_of(run(*line(room, *resumed, "--sun-position", "radiance")))
    assert "2 were asked for" in error_of(run(*line(room, *resumed, "--closed-variant", "/Room/South{blinds=closed}")))
    assert "another scene" in error_of(run(*line(room, *resumed, "--variant", "/Room/South{blinds=closed}")))
    kept.write_bytes(kept.read_bytes()[:-9])
    assert "ends before its time" in error_of(run(*line(room, *resumed)))
    kept.write_bytes(kept.read_bytes()[:-9000])
    assert "shorter than its rounds" in error_of(run(*line(room, *resumed)))
    kept.write_bytes(b"P5 1 1")
    assert "ends before its time" in error_of(run(*line(room, *resumed)))


def test_python_keeps_and_merges_them(room, tmp_path):
    import gonio

    weather = (room / "year.wea").read_bytes()
    scene = gonio.load_usd(str(room / "room.usda"))
    scene.add_grid(corner=(0.5, 0.5, 0.8), edges=((3, 0, 0), (0, 4, 0)), spacing=1.0, name="Desks")
    (whole,) = gonio.annual(scene, weather, samples=64)
    parts = [tmp_path / f"{part}.rounds" for part in (1, 2)]
    assert [gonio.annual(scene, weather, samples=64, checkpoint=path, part=(part, 2)) for part, path in enumerate(parts, 1)] == [[], []]
    (merged,) = gonio.annual(scene, weather, samples=64, merge=parts)
    (resumed,) = gonio.annual(scene, weather, samples=64, checkpoint=parts[0], resume=True)
    for other in (merged, resumed):
        assert np.array_equal(other.total, whole.total) and np.array_equal(other.direct, whole.direct) and other.figures == whole.figures
    with pytest.raises(gonio.Error, match="part: 3 of 2 was found"):
        gonio.annual(scene, weather, samples=64, checkpoint=tmp_path / "c", part=(3, 2))
    with pytest.raises(gonio.Error, match="none was named"):
        gonio.annual(scene, weather, samples=64, part=(1, 2))
