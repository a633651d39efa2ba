"""What breaks the USD library down ends in one line and a status of its own; files that change meanwhile do not matter."""

import os
import pathlib
import signal
import subprocess
import sys
import time

import pictures
import pytest

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the watcher is Linux's")

DEEP = '#usda 1.0\ndef "D"\n{\n    custom int[] a = ' + "[" * 200_000 + "]" * 200_000 + "\n}\n"


@pytest.mark.parametrize("command", ["render", "info", "measure"])
def test_a_crash_of_the_library_is_one_line(run, tmp_path, command):
    # The stage's own file is looked at before it is opened; what it refers to is not.
    (tmp_path / "deep.usda").write_text(DEEP)
    stage = tmp_path / "stage.usda"
    stage.write_text('#usda 1.0\ndef "A" (prepend references = @deep.usda@</D>) {}\n')
    done = run(command, stage, *(["-o", tmp_path / "a.exr"] if command == "render" else []))
    assert done.returncode == 3, (done.returncode, done.stderr)
    assert done.stderr.startswith("gonio: error: the USD library broke down (SIGSEGV) while it read ") and done.stderr.count("\n") == 1
    assert "stage.usda" in done.stderr and not (tmp_path / "a.exr").exists()


def crate(path, count=200_000):
    from pxr import Usd, UsdGeom, Vt

    stage = Usd.Stage.CreateNew(str(path))
    for number in range(4):
        mesh = UsdGeom.Mesh.Define(stage, f"/M{number}")
        points = [(i % 100 / 50 - 1, 0, i // 100 / 50 - 1) for i in range(count // 8)]
        mesh.CreatePointsAttr(Vt.Vec3fArray(points))
        mesh.CreateFaceVertexCountsAttr([3])
        mesh.CreateFaceVertexIndicesAttr([0, 1, 100])
        mesh.CreateSubdivisionSchemeAttr("none")
        mesh.AddTranslateOp().Set((0, number, 0), 1)
    stage.SetStartTimeCode(1)
    stage.SetEndTimeCode(3)
    stage.Save()


def test_a_stage_cut_short_between_frames(command, tmp_path):
    stage = tmp_path / "stage.usdc"
    crate(stage)
    line = [*command, "render", str(stage), str(tmp_path / "out.####.exr"), "--frames", "1:3", "--spp", "64", "--res", "64", "64"]
    process = subprocess.Popen(line, stderr=subprocess.PIPE, text=True)
    first = tmp_path / "out.0001.exr"
    end = time.monotonic() + 60
    while not first.exists() and time.monotonic() < end and process.poll() is None:
        time.sleep(0.01)
    os.truncate(stage, 100)
    said = process.communicate(timeout=120)[1]
    assert process.returncode == 0, said
    last = pictures.read(tmp_path / "out.0003.exr")
    assert last.shape == (64, 64)


def test_signals_reach_the_render(command, room, tmp_path):
    line = [*command, "render", str(room), str(tmp_path / "a.exr"), "--spp", "1000000", "--res", "32", "32"]
    process = subprocess.Popen(line, stderr=subprocess.PIPE, text=True)
    time.sleep(3)
    process.send_signal(signal.SIGINT)
    assert "interrupted" in process.communicate(timeout=60)[1]
    assert process.returncode == 130 and (tmp_path / "a.exr").exists()


def test_a_killed_parent_leaves_no_render(command, room, tmp_path):
    line = [*command, "render", str(room), str(tmp_path / "a.exr"), "--spp", "1000000", "--res", "32", "32", "-q"]
    process = subprocess.Popen(line)
    time.sleep(3)
    child = int(pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split()[0])
    process.kill()
    process.wait()
    end = time.monotonic() + 20
    while os.path.exists(f"/proc/{child}") and time.monotonic() < end:
        time.sleep(0.05)
    assert not os.path.exists(f"/proc/{child}")

