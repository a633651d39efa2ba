"""The command line: files of pictures."""

import numpy as np
import pictures
import pytest
from failures import fails


def test_half_floats_for_all_but_absolute_passes(picture, room):
    image = picture(room, "--half", "--aov", "color,normal,luminance,illuminance")
    assert image["R"].dtype == np.float16 and image["normal.X"].dtype == np.float16
    assert image["Luminance"].dtype == np.float32 and image["Illuminance"].dtype == np.float32


def test_png_and_jpeg_beside_exr(run, room, tmp_path):
    names = [tmp_path / name for name in ("a.exr", "a.png", "a.jpg", "b.JPEG")]
    done = run("render", room, *(x for name in names for x in ("-o", name)), "--res", 24, 16, "--spp", 2)
    assert done.returncode == 0, done.stderr
    assert done.stdout.split() == [str(name) for name in names]
    assert pictures.png_size(names[1]) == (24, 16)
    assert names[2].read_bytes()[:2] == b"\xff\xd8" and names[3].read_bytes()[-2:] == b"\xff\xd9"


def test_exposure_and_tone_map_change_the_png_alone(run, room, tmp_path):
    def both(name, *options):
        done = run("render", room, "-o", tmp_path / f"{name}.exr", "-o", tmp_path / f"{name}.png", "--res", 16, 16, "--spp", 2, *options)
        assert done.returncode == 0, done.stderr
        return pictures.read(tmp_path / f"{name}.exr"), (tmp_path / f"{name}.png").read_bytes()

    plain = both("plain")
    for name, options in {
        "brighter": ("--exposure", "1.5"),
        "darker": ("--exposure", "-2"),
        "none": ("--tonemap", "none"),
        "ev": ("--tonemap", "ev100=5"),
        "local": ("--tonemap", "local"),
        "white": ("--white", "2"),
        "wide": ("--color-space", "display-p3"),
        "absolute": ("--color-space", "rec2020-pq"),
    }.items():
        other = both(name, *options)
        assert pictures.same(plain[0], other[0]), name
        assert plain[1] != other[1], name


@pytest.mark.parametrize("operator", ["filmic", "ev100=", "ev100=x", "ev100=nan"])
def test_bad_tone_map(run, room, tmp_path, operator):
    assert "tonemap" in fails(run, "render", room, "-o", tmp_path / "a.png", "--tonemap", operator)


@pytest.mark.parametrize(
    ("option", "value"), [("--white", "0"), ("--adaptation", "-1"), ("--adaptation", "nan"), ("--color-space", "p3"), ("--exposure", "inf")]
)
def test_bad_looks(run, room, tmp_path, option, value):
    assert option.lstrip("-") in fails(run, "render", room, "-o", tmp_path / "a.png", option, value)
    assert not list(tmp_path.iterdir())


def test_jpeg_is_srgb(run, room, tmp_path):
    assert "JPEG files are sRGB" in fails(run, "render", room, "-o", tmp_path / "a.jpg", "--color-space", "display-p3")


def test_eyes_adapt_to_the_frames_of_an_animation(run, tmp_path):
    lamp = pictures.LAMP.replace("inputs:intensity = 400", "inputs:intensity.timeSamples = { 1: 400, 2: 40000 }")
    stage = pictures.stage(tmp_path / "lamp.usda", pictures.ROOM, lamp, pictures.camera())

    def frames(name, *options):
        done = run("render", stage, "-f", "1:2", "-o", tmp_path / f"{name}.#.png", "--res", 16, 16, "--spp", 4, *options)
        assert done.returncode == 0, done.stderr
        return [(tmp_path / f"{name}.{frame}.png").read_bytes() for frame in (1, 2)]

    alone, quick = frames("alone"), frames("quick", "--adaptation", 0)
    slow, still = frames("slow", "--adaptation", 0.1), frames("still", "--adaptation", "inf")
    assert alone == quick and alone[0] == slow[0] == still[0]
    assert len({alone[1], slow[1], still[1]}) == 3


def test_folders_of_the_output_are_made(run, room, tmp_path):
    path = tmp_path / "one" / "two" / "a.exr"
    assert run("render", room, "-o", path, "--res", 8, 8, "--spp", 1).returncode == 0
    assert path.exists() and [x.name for x in path.parent.iterdir()] == ["a.exr"]


def test_missing_stage(run, tmp_path):
    line = fails(run, "render", tmp_path / "absent.usda", "-o", tmp_path / "a.exr")
    assert "absent.usda" in line


@pytest.mark.parametrize("name", ["a.tif", "a", "a.exr.bak"])
def test_unknown_ending_of_the_output(run, room, tmp_path, name):
    line = fails(run, "render", room, "-o", tmp_path / name)
    assert "exr" in line and "png" in line


def test_no_output(run, room):
    assert "-o" in fails(run, "render", room)


def test_an_output_that_cannot_be_written(run, room, tmp_path):
    (tmp_path / "file").write_text("")
    fails(run, "render", room, "-o", tmp_path / "file" / "a.exr", "--res", 8, 8, "--spp", 1)
    (tmp_path / "folder.exr").mkdir()
    fails(run, "render", room, "-o", tmp_path / "folder.exr", "--res", 8, 8, "--spp", 1, "-q")
