"""The command line: size, crop, samples, random numbers and light transport."""

import re
import time

import numpy as np
import pictures
import pytest
from failures import fails


def test_resolution(picture, room):
    image = picture(room, "--res", 24, 16)
    assert image.shape == (16, 24)
    window = image.header["displayWindow"]
    assert list(window[1]) == [23, 15]


def test_width_takes_its_height_from_the_camera(picture, tmp_path):
    wide = pictures.camera().replace("verticalAperture = 20", "verticalAperture = 10")
    stage = pictures.stage(tmp_path / "wide.usda", pictures.ROOM, pictures.LAMP, wide)
    assert picture(stage, "--image-width", 40).shape == (20, 40)
    assert picture(stage, "-w", 20).shape == (10, 20)
    assert picture(stage, "--imageWidth", 20, "--res-scale", 0.5).shape == (5, 10)


@pytest.mark.parametrize("scale", ["0", "-1", "nan", "inf"])
def test_bad_scale(run, room, tmp_path, scale):
    assert "res-scale" in fails(run, "render", room, "-o", tmp_path / "a.exr", f"--res-scale={scale}")


@pytest.mark.parametrize("size", [("0", "10"), ("4000000000", "4000000000")])
def test_bad_resolution(run, room, tmp_path, size):
    assert "resolution" in fails(run, "render", room, "-o", tmp_path / "a.exr", "--res", *size)


@pytest.mark.parametrize("count", [1, 5])
def test_samples_are_those_asked_for(picture, room, count):
    assert picture(room, spp=count).header["gonio:samples"] == str(count)


def test_crop_is_the_region_of_the_whole(picture, room):
    whole = picture(room, size=128, name="whole.exr")
    part = picture(room, "--crop", 64, 0, 128, 64, size=128, name="part.exr")
    assert part.shape == (64, 64)
    assert list(part.header["dataWindow"][0]) == [64, 0] and list(part.header["displayWindow"][1]) == [127, 127]
    for name in part.channels:
        assert np.array_equal(part[name], whole[name][0:64, 64:128]), name


def test_crop_across_tiles_shows_the_same_place(picture, room):
    whole = picture(room, "--aov", "depth", size=96, spp=16, name="whole.exr")
    part = picture(room, "--aov", "depth", "--crop", 0.25, 0.5, 0.75, 0.875, size=96, spp=16, name="part.exr")
    assert part.shape == (36, 48) and list(part.header["dataWindow"][0]) == [24, 48]
    there = {name: values[48:84, 24:72] for name, values in whole.channels.items()}
    difference = np.abs(pictures.blocks(part["depth.Z"], 12) / pictures.blocks(there["depth.Z"], 12) - 1)
    assert difference.max() < 0.03, "the region is another one"


@pytest.mark.parametrize("crop", [("5", "5", "5", "9"), ("9", "0", "5", "9"), ("100", "100", "200", "200"), ("a", "0", "1", "1"), ("nan", "0", "1", "1")])
def test_bad_crop(run, room, tmp_path, crop):
    assert "crop" in fails(run, "render", room, "-o", tmp_path / "a.exr", "--res", 32, 32, "--crop", *crop)


def test_time_limit_ends_a_long_render(run, room, tmp_path):
    start = time.monotonic()
    done = run("render", room, "-o", tmp_path / "a.exr", "--res", 256, 256, "--spp", 100000, "--time-limit", 1)
    assert done.returncode == 0, done.stderr
    assert time.monotonic() - start < 10
    image = pictures.read(tmp_path / "a.exr")
    assert 0 < int(image.header["gonio:samples"]) < 100000
    assert np.isfinite(image.rgb).all() and (image["A"] > 0).any()


def test_one_seed_gives_the_same_bits_and_another_does_not(picture, room):
    first = picture(room, "--seed", 7, name="first.exr")
    assert pictures.same(first, picture(room, "--seed", 7, name="second.exr"))
    assert not pictures.same(first, picture(room, "--seed", 8, name="third.exr"))
    assert first.header["gonio:seed"] == "7"


def test_threads_do_not_change_a_bit(picture, room):
    options = ("--aov", "color,illuminance,normal,depth")
    one = picture(room, *options, "--threads", 1, size=130, spp=3, name="one.exr")
    assert pictures.same(one, picture(room, *options, "-j", 2, size=130, spp=3, name="two.exr"))
    assert pictures.same(one, picture(room, *options, "-j", 5, size=130, spp=3, name="five.exr"))


def test_direct_light_is_path_tracing_without_further_bounces(picture, room):
    direct = picture(room, "--integrator", "direct", spp=64, size=16, name="direct.exr").rgb.mean()
    stopped = picture(room, "--max-bounces", 0, spp=64, size=16, name="stopped.exr").rgb.mean()
    full = picture(room, spp=64, size=16, name="full.exr").rgb.mean()
    assert stopped == pytest.approx(direct, rel=0.02)
    assert full > direct * 1.02


def test_whitted_pictures_have_no_noise(picture, room):
    options = ("--integrator", "whitted", "--light-samples", 4)
    one = picture(room, *options, "--seed", 1, spp=1, size=32, name="one.exr").rgb
    many = picture(room, *options, "--seed", 2, spp=16, size=32, name="many.exr").rgb
    direct = picture(room, "--integrator", "direct", spp=64, size=32, name="direct.exr").rgb
    assert np.median(np.abs(one - many)) < 0.01 * many.mean()
    assert many.mean() == pytest.approx(direct.mean(), rel=0.05)


def test_adaptive_antialiasing_says_how_many_rays(run, room, tmp_path):
    common = ("render", room, "--res", 70, 70, "--integrator", "whitted")
    grid = run(*common, "--antialiasing", 4, "-o", tmp_path / "grid.exr")
    assert "16 samples a pixel" in grid.stderr, grid.stderr
    done = run(*common, "--antialiasing", "adaptive", "-o", tmp_path / "adaptive.exr")
    assert done.returncode == 0 and re.search(r"\d\.\d\d rays a pixel", done.stderr), done.stderr
    dense, adaptive = (pictures.read(tmp_path / f"{name}.exr").rgb for name in ("grid", "adaptive"))
    assert adaptive.mean() == pytest.approx(dense.mean(), rel=0.02)


def test_adaptive_antialiasing_wants_rays_without_noise(run, room, tmp_path):
    assert "whitted" in fails(run, "render", room, "--antialiasing", "adaptive", "-o", tmp_path / "a.exr")


def test_clamps(picture, room):
    free = picture(room, spp=16, name="free.exr").rgb
    dim = picture(room, "--clamp-direct", 0.2, "--clamp-indirect", 0.1, spp=16, name="dim.exr").rgb
    assert free.max() > 1 and dim.max() < 0.5 and dim.mean() < free.mean()


@pytest.mark.parametrize("name", ["box", "tent", "gaussian", "blackman-harris"])
def test_filters_keep_the_mean(picture, room, name):
    mean = picture(room, "--filter", name, "--filter-width", 2, "--aov", "alpha", spp=64, size=16)["A"].mean()
    assert mean == pytest.approx(picture(room, spp=64, size=16, name="usual.exr")["A"].mean(), abs=0.02)
