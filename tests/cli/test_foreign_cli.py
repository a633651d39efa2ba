"""Command lines of usdrecord and husk, run as they are but for the program's name."""

import signal
import subprocess
import time

import numpy as np
import pictures
import pytest

STILL = pictures.LAMP
MOVING = pictures.MOVING


def moving(tmp_path, *more):
    return pictures.stage(tmp_path / "stage.usda", pictures.ROOM, MOVING, pictures.camera(), pictures.camera("Side", 1), *more)


def done(process):
    assert process.returncode == 0, process.stderr
    return process


def test_usdrecord_s_frames_and_positionals(run, tmp_path):
    moving(tmp_path)
    line = "--frames 1:3x2 --camera Side --imageWidth 24 --complexity low --renderer Storm --colorCorrectionMode disabled stage.usda out.####.exr"
    said = done(run("render", *line.split(), "--spp", 1, cwd=tmp_path))
    assert sorted(path.name for path in tmp_path.glob("*.exr")) == ["out.0001.exr", "out.0003.exr"]
    picture = pictures.read(tmp_path / "out.0003.exr")
    assert picture.shape == (24, 24) and picture.header["gonio:camera"] == "/Side"
    assert "--renderer (usdrecord and husk) changes nothing: gonio is the renderer" in said.stderr


def test_usdrecord_s_short_names(run, tmp_path):
    moving(tmp_path, 'def RenderSettings "S"\n{\n    uniform int2 resolution = (16, 8)\n}\ndef RenderSettings "T" {}\n')
    done(run("render", "-cam", "Side", "-c", "low", "-rs", "/S", "-color", "sRGB", "-d", "stage.usda", "out.exr", "--spp", 1, cwd=tmp_path))
    picture = pictures.read(tmp_path / "out.exr")
    assert picture.shape == (8, 16) and picture.header["gonio:camera"] == "/Side"


def test_usdrecord_s_draw_modes_and_what_only_measures_usd(run, tmp_path):
    ball = 'def Xform "Model" (kind = "component")\n{\n    token model:drawMode = "origin"\n    def Sphere "Ball"\n    {\n        double radius = 0.3\n    }\n}\n'
    ball = ball.replace('"component")', '"component"\n    prepend apiSchemas = ["GeomModelAPI"])')
    stage = pictures.stage(tmp_path / "stage.usda", ball, STILL, pictures.camera())
    line = [stage, "--imageWidth", 32, "--spp", 4, "--resolver", "root", "--traceToFile", "a", "--traceFormat", "chrome", "--memstats"]
    axes = done(run("render", *line, tmp_path / "axes.exr"))
    done(run("render", *line, tmp_path / "ball.exr", "--disableDrawMode"))
    axes_seen, ball_seen = ((pictures.read(tmp_path / f"{name}.exr")["A"] > 0.5).mean() for name in ("axes", "ball"))
    assert ball_seen > 2 * axes_seen
    assert "--memstats (usdrecord) changes nothing" in axes.stderr


def test_husk_s_documented_examples(run, tmp_path):
    moving(tmp_path)
    line = "-R BRAY_HdKarma -S 25 --complexity low --no-mplay --make-output-path -f 1 -n 2 -o preview/a.$F4.exr stage.usda --res 40 40 -p 1"
    done(run("render", *line.split(), cwd=tmp_path))
    assert sorted(path.name for path in (tmp_path / "preview").iterdir()) == ["a.0001.exr", "a.0002.exr"]
    assert pictures.read(tmp_path / "preview" / "a.0001.exr").shape == (10, 10)
    line = "-f 1 -n 1 --purpose geometry,render --complexity high -o beauty.$F4.exr -V 5ae --stderr log.txt --fps 24 -j 1 stage.usda -p 1 --res 8 8"
    said = done(run("render", *line.split(), cwd=tmp_path))
    assert (tmp_path / "beauty.0001.exr").exists() and "--stderr (husk) changes nothing" in said.stderr


def test_husk_s_frames_and_files(run, tmp_path):
    moving(tmp_path)
    line = "-f 1 -n 2 -i 2 --res 20 10 -p 1 -c /Side -R BRAY_HdKarma -V a2 --make-output-path -o new/out.$F4.exr,new/b.<F4>.png stage.usda"
    done(run("render", *line.split(), cwd=tmp_path))
    assert sorted(path.name for path in (tmp_path / "new").iterdir()) == ["b.0001.png", "b.0003.png", "out.0001.exr", "out.0003.exr"]
    first, second = (pictures.read(tmp_path / "new" / f"out.000{frame}.exr") for frame in (1, 3))
    assert first.shape == (10, 20)
    # The lamp is four times as strong.
    assert second.rgb.mean() == pytest.approx(4 * first.rgb.mean(), rel=0.05)


def test_default_time_and_scales(run, tmp_path):
    stage = moving(tmp_path, "")
    stage.write_text(stage.read_text().replace("    float inputs:radius", "    float inputs:intensity = 800\n    float inputs:radius"))
    for name, *options in (["a.exr", "--frame", 3], ["b.exr", "--defaultTime"]):
        done(run("render", stage, tmp_path / name, "--spp", 1, "--res", 20, 10, *options))
    a, b = pictures.read(tmp_path / "a.exr"), pictures.read(tmp_path / "b.exr")
    assert b.rgb.mean() == pytest.approx(2 * a.rgb.mean(), rel=1e-3)
    done(run("render", stage, tmp_path / "c.exr", "--spp", 1, "--res", 20, 10, "--res-scale", 50, "--pixel-aspect", 2))
    c = pictures.read(tmp_path / "c.exr")
    assert c.shape == (5, 10) and c.header["pixelAspectRatio"] == pytest.approx(2)


def test_what_is_refused_is_named_with_what_to_do(run, room, tmp_path):
    refused = run("render", room, "-o", tmp_path / "a.exr", "--slap-comp", "x.geo")
    assert refused.returncode == 2 and not (tmp_path / "a.exr").exists()
    assert refused.stderr.count("\n") == 1 and "--slap-comp of husk is not supported" in refused.stderr and "--aov" in refused.stderr


def test_lights_and_materials_that_are_left_out(run, tmp_path):
    stage = pictures.stage(tmp_path / "stage.usda", pictures.ROOM, STILL, pictures.camera())
    frames = {}
    for name, *options in [
        ["none", "--disable-scene-lights", "--headlight", "None"],
        ["camera", "--disable-scene-lights"],
        ["dome", "--disable-scene-lights", "--headlight", "dome"],
        ["grey", "--disable-scene-materials"],
        ["usual"],
    ]:
        done(run("render", stage, tmp_path / f"{name}.exr", "--spp", 16, "--res", 16, 16, *options))
        frames[name] = pictures.read(tmp_path / f"{name}.exr").rgb
    assert frames["none"].max() == 0 and frames["camera"].max() > 0.1
    # The even sky is seen where nothing is.
    assert frames["dome"].max() == pytest.approx(1, rel=1e-3)
    red = lambda image: (image[..., 0] / np.maximum(image[..., 1], 1e-6)).max()
    assert red(frames["usual"]) > 2 and red(frames["grey"]) < 1.05


def test_autocrop_leaves_out_what_is_black(run, tmp_path):
    ball = 'def Sphere "Ball"\n{\n    double radius = 0.2\n    double3 xformOp:translate = (0, 1, 0)\n    uniform token[] xformOpOrder = ["xformOp:translate"]\n}\n'
    stage = pictures.stage(tmp_path / "stage.usda", ball, STILL, pictures.camera())
    options = ["--spp", 1, "--res", 64, 64, "--filter", "box", "--filter-width", 1]
    done(run("render", stage, tmp_path / "whole.exr", *options))
    done(run("render", stage, "-o", tmp_path / "part.exr", "-o", tmp_path / "part.png", "--autocrop", "A", *options))
    whole, part = pictures.read(tmp_path / "whole.exr"), pictures.read(tmp_path / "part.exr")
    rows, columns = np.nonzero(whole["A"])
    box = [tuple(map(int, corner)) for corner in part.header["dataWindow"]]
    assert box == [(columns.min(), rows.min()), (columns.max(), rows.max())] and max(part.shape) < 64
    assert np.array_equal(part["G"], whole["G"][rows.min() : rows.max() + 1, columns.min() : columns.max() + 1])
    assert pictures.png_size(tmp_path / "part.png") == (64, 64)


def waits_for(condition, seconds=60):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.05)
    return False


def test_sigusr1_writes_the_picture_so_far(command, room, tmp_path):
    out = tmp_path / "out.exr"
    line = [*command, "render", str(room), str(out), "--spp", "1000000", "--res", "64", "64"]
    process = subprocess.Popen(line, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True)
    try:

        def asked():
            process.send_signal(signal.SIGUSR1)
            time.sleep(0.2)
            return out.exists()

        assert waits_for(lambda: process.poll() is not None or (time.sleep(1) or asked()))
        first = pictures.read(out)
        assert first.rgb.mean() > 0 and process.poll() is None
    finally:
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=60)[1]
    assert process.returncode == 130 and "snapshot with" in said
    assert int(pictures.read(out).header["gonio:samples"]) >= int(first.header["gonio:samples"])


def test_snapshots_come_by_themselves(command, room, tmp_path):
    out = tmp_path / "out.exr"
    process = subprocess.Popen([*command, "render", str(room), str(out), "--spp", "1000000", "--res", "64", "64", "--snapshot", "0.5", "-q"])
    try:
        assert waits_for(out.exists)
        first = int(pictures.read(out).header["gonio:samples"])
        assert waits_for(lambda: int(pictures.read(out).header["gonio:samples"]) > first)
    finally:
        process.kill()
        process.wait()


@pytest.mark.parametrize(("shell", "word"), [("bash", "complete -F"), ("zsh", "#compdef gonio"), ("fish", "complete -c gonio")])
def test_completion(run, shell, word):
    script = done(run("completion", shell)).stdout
    assert word in script and "render-pass" in script
    if shell == "bash":
        checked = subprocess.run(["bash", "-n"], input=script, text=True, capture_output=True)
        assert checked.returncode == 0, checked.stderr


def test_exit_status_is_in_the_help(run):
    text = run("--help").stdout
    assert "Exit status:" in text and "130" in text
