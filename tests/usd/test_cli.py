"""The command line: every option does what it says."""

import json
import re
import time

import numpy as np
import pictures
import pytest

OPTIONS = """--purposes --complexity --mask --variant --session-layer --settings --strict --verbose --output --camera --frames --res --image-width
--res-scale --spp --max-bounces --integrator --filter --filter-width --aov --exposure --tonemap --crop --time-limit --seed --threads
--clamp-direct --clamp-indirect --half --disable-camera-light --list-cameras --quiet --noise-threshold --min-spp --checkpoint
--checkpoint-every --resume --samples --denoise --white --adaptation --color-space --light-samples --antialiasing --part --dask
--dask-parts --dask-send""".split()

SETTINGS = """
def RenderSettings "Settings"
{
    int2 resolution = (20, 12)
    rel camera = </Right>
}
"""

MOVING = """
def SphereLight "Lamp"
{
    float inputs:intensity.timeSamples = { 1: 100, 2: 200, 3: 400 }
    float inputs:radius = 0.2
    double3 xformOp:translate = (1, 3, 1)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


@pytest.fixture(scope="module")
def room(tmp_path_factory):
    return pictures.room(tmp_path_factory.mktemp("room") / "room.usda")


@pytest.fixture
def picture(run, tmp_path):
    """Renders to an EXR file and reads it."""

    def render(stage, *options, name="out.exr", size=32, spp=2):
        sizes = [] if any(str(option) in ("--res", "-w", "--image-width", "--imageWidth") for option in options) else ["--res", size, size]
        done = run("render", stage, "-o", tmp_path / name, "--spp", spp, *sizes, *options)
        assert done.returncode == 0, done.stderr
        return pictures.read(tmp_path / name)

    return render


def same(first, second):
    return first.channels.keys() == second.channels.keys() and all(
        np.array_equal(first[name], second[name], equal_nan=True) for name in first.channels
    )


def fails(run, *arguments, status=1):
    done = run(*arguments)
    assert done.returncode == status, (done.returncode, done.stderr)
    lines = done.stderr.strip().splitlines()
    assert len(lines) == 1 and lines[0].startswith("gonio: error: "), done.stderr
    return lines[0]


# Help, version, usage.


def test_help_lists_every_option(run):
    done = run("render", "--help")
    assert done.returncode == 0 and done.stderr == ""
    for option in OPTIONS:
        assert re.search(rf"^ +(-\w, )?{option}\b", done.stdout, re.MULTILINE), option


@pytest.mark.parametrize("command", ["render", "merge", "info", "compare"])
def test_help_of_each_command(run, command):
    assert command in run("--help").stdout
    done = run(command, "-h")
    assert done.returncode == 0 and "Usage:" in done.stdout


def test_version_is_the_module_s(run):
    import gonio

    assert run("--version").stdout.strip() == f"gonio {gonio.__version__}"


@pytest.mark.parametrize("arguments", [[], ["paint"], ["render"], ["render", "a.usda", "--spp", "0"], ["render", "a.usda", "--nothing"]])
def test_wrong_usage_is_status_two(run, arguments):
    done = run(*arguments)
    assert done.returncode == 2 and "Usage" in done.stderr + done.stdout or "invalid value" in done.stderr


# Cameras.


def two_cameras(folder, *more):
    return pictures.stage(folder / "two.usda", pictures.ROOM, pictures.LAMP, pictures.camera("Left", -3), pictures.camera("Right", 3), *more)


def test_camera_by_name_and_by_path(picture, tmp_path):
    stage = two_cameras(tmp_path)
    named, placed = picture(stage, "--camera", "Right"), picture(stage, "-c", "/Right", name="path.exr")
    assert named.header["gonio:camera"] == "/Right"
    assert same(named, placed)
    assert not same(named, picture(stage, "--cam", "/Left", name="left.exr"))


def test_list_cameras(run, tmp_path):
    done = run("render", two_cameras(tmp_path), "--list-cameras")
    assert done.returncode == 0 and done.stdout.split() == ["/Left", "/Right"]


def test_unknown_camera_lists_those_there_are(run, tmp_path):
    line = fails(run, "render", two_cameras(tmp_path), "-o", tmp_path / "a.exr", "--camera", "Middle")
    assert "Middle" in line and "/Left" in line and "/Right" in line


def test_main_cam_is_the_primary_camera(picture, tmp_path):
    stage = pictures.stage(tmp_path / "main.usda", pictures.ROOM, pictures.LAMP, pictures.camera("Left", -3), pictures.camera("main_cam"))
    assert picture(stage).header["gonio:camera"] == "/main_cam"


def test_render_settings_choose_camera_and_resolution(picture, tmp_path):
    stage = two_cameras(tmp_path, SETTINGS)
    by_settings = picture(stage, "--settings", "/Settings", "--res-scale", "1", "--res", 20, 12)
    assert by_settings.header["gonio:camera"] == "/Right"
    over = picture(stage, "-s", "/Settings", "--camera", "Left", name="over.exr")
    assert over.header["gonio:camera"] == "/Left" and over.shape == (32, 32)


def test_resolution_of_the_settings(run, tmp_path):
    done = run("render", two_cameras(tmp_path, SETTINGS), "-s", "/Settings", "--spp", 1, "-o", tmp_path / "a.exr")
    assert done.returncode == 0, done.stderr
    assert pictures.read(tmp_path / "a.exr").shape == (12, 20)


def test_a_stage_without_camera_and_light_says_what_it_does(run, tmp_path):
    stage = pictures.stage(tmp_path / "bare.usda", pictures.ROOM)
    done = run("render", stage, "-o", tmp_path / "a.exr", "--res", 32, 32, "--spp", 4)
    assert done.returncode == 0
    assert "no camera" in done.stderr and "neutral dome" in done.stderr
    image = pictures.read(tmp_path / "a.exr")
    assert image.rgb.mean() > 0.1
    assert image["A"].max() == 1, "the camera looks past everything"
    dark = run("render", stage, "-o", tmp_path / "b.exr", "--res", 32, 32, "--spp", 4, "--disable-camera-light")
    assert "neutral dome" not in dark.stderr
    assert pictures.read(tmp_path / "b.exr").rgb.max() == 0


def test_quiet_says_nothing(run, tmp_path):
    stage = pictures.stage(tmp_path / "bare.usda", pictures.ROOM)
    done = run("render", stage, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1, "-q")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


# Frames and names.


@pytest.mark.parametrize(
    ("frames", "pattern", "names"),
    [
        ("1:3", "a.####.exr", ["a.0001.exr", "a.0002.exr", "a.0003.exr"]),
        ("1:3x2", "a.$F4.exr", ["a.0001.exr", "a.0003.exr"]),
        ("3,1", "a_$F.exr", ["a_1.exr", "a_3.exr"]),
        ("1.5", "a.###.###.exr", ["a.001.500.exr"]),
        ("2", "plain.exr", ["plain.exr"]),
    ],
)
def test_frames_and_file_names(run, tmp_path, frames, pattern, names):
    stage = pictures.stage(tmp_path / "moving.usda", pictures.ROOM, MOVING, pictures.camera())
    done = run("render", stage, "-f", frames, "-o", tmp_path / "out" / pattern, "--res", 8, 8, "--spp", 1)
    assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == sorted(names)


def test_frames_take_the_values_of_their_time(run, tmp_path):
    stage = pictures.stage(tmp_path / "moving.usda", pictures.ROOM, MOVING, pictures.camera())
    run("render", stage, "-f", "1:3", "-o", tmp_path / "a.#.exr", "--res", 16, 16, "--spp", 4, "--integrator", "direct")
    one, two, three = (pictures.read(tmp_path / f"a.{frame}.exr").rgb.mean() for frame in (1, 2, 3))
    assert two / one == pytest.approx(2, rel=1e-4) and three / one == pytest.approx(4, rel=1e-4)


def test_several_frames_need_a_place_in_the_name(run, tmp_path):
    stage = pictures.stage(tmp_path / "moving.usda", pictures.ROOM, MOVING, pictures.camera())
    line = fails(run, "render", stage, "-f", "1:3", "-o", tmp_path / "a.exr")
    assert "####" in line and not (tmp_path / "a.exr").exists()


@pytest.mark.parametrize("frames", ["x", "1:", "1:3x0", "nan", "", "1:1e30"])
def test_bad_frames(run, room, tmp_path, frames):
    assert "frames" in fails(run, "render", room, f"--frames={frames}", "-o", tmp_path / "a.####.exr")


# Size, crop, samples.


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


# Random numbers.


def test_one_seed_gives_the_same_bits_and_another_does_not(picture, room):
    first = picture(room, "--seed", 7, name="first.exr")
    assert same(first, picture(room, "--seed", 7, name="second.exr"))
    assert not same(first, picture(room, "--seed", 8, name="third.exr"))
    assert first.header["gonio:seed"] == "7"


def test_threads_do_not_change_a_bit(picture, room):
    options = ("--aov", "color,illuminance,normal,depth")
    one = picture(room, *options, "--threads", 1, size=130, spp=3, name="one.exr")
    assert same(one, picture(room, *options, "-j", 2, size=130, spp=3, name="two.exr"))
    assert same(one, picture(room, *options, "-j", 5, size=130, spp=3, name="five.exr"))


# Light transport.


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


# Passes.

PASSES = {
    "color": {"R": None, "G": None, "B": None},
    "alpha": {"A"},
    "depth": {"depth.Z"},
    "normal": {"normal.X", "normal.Y", "normal.Z"},
    "P": {"P.X", "P.Y", "P.Z"},
    "albedo": {"albedo.R", "albedo.G", "albedo.B"},
    "primId": {"primId"},
    "luminance": {"Luminance"},
    "illuminance": {"Illuminance"},
}


@pytest.mark.parametrize("name", PASSES)
def test_pass_names_in_the_file(picture, room, name):
    image = picture(room, "--aov", name)
    assert set(PASSES[name]) | {"R", "G", "B"} <= set(image.channels)


def test_units_and_white_in_the_header(picture, room):
    header = picture(room, "--aov", "color,depth,P,luminance,illuminance").header
    assert header["gonio:unit:Illuminance"] == "lx" and header["gonio:unit:Luminance"] == "cd/m2"
    assert header["gonio:unit:depth"] == "m" and header["gonio:unit:P"] == "m"
    assert "cd/m2" in header["gonio:unit:color"]
    assert header["whiteLuminance"] == 1.0
    assert header["software"].startswith("gonio ")
    assert header["gonio:stage"] == "room.usda"


def test_luminance_is_that_of_the_colour(picture, room):
    image = picture(room, "--aov", "color,luminance", spp=8)
    assert image["Luminance"] == pytest.approx(image.rgb @ [0.2126, 0.7152, 0.0722], rel=1e-4, abs=1e-6)


def test_normals_positions_and_depth_agree(picture, room):
    image = picture(room, "--aov", "normal,P,depth,primId", "--filter", "box", "--filter-width", 0.01, spp=1)
    floor = (np.abs(image["P.Y"]) < 1e-4) & (image["A"] == 1)
    assert floor.sum() > 50
    assert image["normal.Y"][floor] == pytest.approx(1, abs=1e-4)
    assert (image["depth.Z"][floor] > 3).all()
    assert np.unique(image["primId"][image["A"] == 1]).size == 3


def test_a_camera_s_exposure_scales_colour_alone(picture, tmp_path):
    brighter = pictures.camera().replace("float focalLength", "float exposure = 2\n    float focalLength")
    plain = picture(pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera()), "--aov", "color,luminance,illuminance")
    bright = picture(
        pictures.stage(tmp_path / "b.usda", pictures.ROOM, pictures.LAMP, brighter), "--aov", "color,luminance,illuminance", name="b.exr"
    )
    assert bright["G"] == pytest.approx(4 * plain["G"], rel=1e-5)
    assert bright["Luminance"] == pytest.approx(plain["Luminance"], rel=1e-5)
    assert bright["Illuminance"] == pytest.approx(plain["Illuminance"], rel=1e-5)
    assert bright.header["whiteLuminance"] == pytest.approx(0.25)


def test_unknown_pass_lists_those_there_are(run, room, tmp_path):
    line = fails(run, "render", room, "-o", tmp_path / "a.exr", "--aov", "colour")
    assert "colour" in line and "illuminance" in line


# Files.


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
        assert same(plain[0], other[0]), name
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


# What of the stage is read.


def test_purposes(picture, tmp_path):
    guide = 'def Cube "Guide"\n{\n    uniform token purpose = "guide"\n    double size = 3\n}\n'
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), guide)
    usual = picture(stage, "--aov", "depth", name="usual.exr")
    assert not same(usual, picture(stage, "--aov", "depth", "--purposes", "render,guide", name="guide.exr"))
    assert same(usual, picture(stage, "--aov", "depth", "--purposes", "default,proxy", name="proxy.exr"))


def test_unknown_purpose(run, room, tmp_path):
    assert "purposes" in fails(run, "render", room, "-o", tmp_path / "a.exr", "--purposes", "final")


def test_mask(picture, room):
    image = picture(room, "--mask", "/Floor,/Lamp,/Cam", "--aov", "P", "--filter", "box", "--filter-width", 0.01)
    assert np.abs(image["P.Y"]).max() < 1e-4


def test_variant(picture, run, tmp_path):
    text = """
def Xform "Choice" (
    variants = { string shape = "none" }
    prepend variantSets = "shape"
)
{
    variantSet "shape" = {
        "none" { }
        "big" {
            def Cube "Big"
            {
                double size = 3
            }
        }
    }
}
"""
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), text)
    assert not same(picture(stage, name="a.exr"), picture(stage, "--variant", "/Choice{shape=big}", name="b.exr"))
    assert "variant" in fails(run, "render", stage, "-o", tmp_path / "c.exr", "--variant", "shape=big")


def test_session_layer(picture, room, tmp_path):
    layer = tmp_path / "dim.usda"
    layer.write_text('#usda 1.0\nover "Lamp"\n{\n    float inputs:intensity = 200\n}\n')
    plain, dim = picture(room, name="a.exr"), picture(room, "--session-layer", layer, name="b.exr")
    assert dim["G"] == pytest.approx(plain["G"] / 2, rel=1e-4)
    assert same(dim, picture(room, "--sessionLayer", layer, name="c.exr"))


def test_complexity_refines(run, tmp_path):
    cube = """
def Mesh "Cube"
{
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]
    point3f[] points = [(-1, -1, -1), (1, -1, -1), (-1, 1, -1), (1, 1, -1), (-1, -1, 1), (1, -1, 1), (-1, 1, 1), (1, 1, 1)]
}
"""
    stage = pictures.stage(tmp_path / "a.usda", cube)
    counts = [json.loads(run("info", stage, "--json", "--complexity", level).stdout)["triangles"] for level in ("low", "medium", "high", "veryhigh")]
    assert counts == [12, 48, 192, 768]


# Warnings.

BROKEN = 'def Mesh "Broken"\n{\n    int[] faceVertexCounts = [3]\n    int[] faceVertexIndices = [0, 1, 9]\n    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n}\n'


def test_warnings_name_the_prim_and_are_fatal_with_strict(run, tmp_path):
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), BROKEN)
    done = run("render", stage, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1)
    assert done.returncode == 0 and "gonio: warning: " in done.stderr and "/Broken" in done.stderr
    strict = run("render", stage, "-o", tmp_path / "b.exr", "--res", 8, 8, "--spp", 1, "--strict")
    assert strict.returncode == 1 and "/Broken" in strict.stderr and not (tmp_path / "b.exr").exists()


def test_strict_passes_a_faultless_stage(run, room, tmp_path):
    done = run("render", room, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1, "--strict")
    assert done.returncode == 0, done.stderr


def test_many_warnings_are_cut_short_without_verbose(run, tmp_path):
    many = "".join(BROKEN.replace("Broken", f"Broken{k}") for k in range(30))
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), many)
    brief = run("render", stage, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1).stderr
    assert brief.count("gonio: warning: ") == 20 and "10 more" in brief
    assert run("render", stage, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1, "-v").stderr.count("gonio: warning: ") == 30


# info.


def test_info_as_text(run, room):
    done = run("info", room)
    assert done.returncode == 0 and done.stderr == ""
    for words in ("1 m a unit", "1 Mesh", "1 SphereLight", "camera /Cam", "light /Lamp: sphere of radius 0.2", "400 cd/m²", "materials"):
        assert words in done.stdout, words
    assert "emissive" not in done.stdout


def test_info_as_json(run, room):
    said = json.loads(run("info", room, "--json").stdout)
    assert said["metres_per_unit"] == 1 and said["up_axis"] == "Y" and said["cameras"] == ["/Cam"]
    assert said["prims"]["Mesh"] == 1 and said["instances"] == 3 and said["triangles"] > 14
    assert said["lights"][0]["path"] == "/Lamp" and "400 cd/m²" in said["lights"][0]["what"]
    assert said["bounds"][0] == pytest.approx([-3, 0, -3], abs=1e-4) and said["diagnostics"] == []


def test_info_of_a_frame_and_of_faults(run, tmp_path):
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, MOVING, pictures.camera(), BROKEN)
    said = json.loads(run("info", stage, "--json", "--frame", 3).stdout)
    assert "400 cd/m²" in said["lights"][0]["what"]
    assert [fault["origin"] for fault in said["diagnostics"]] == ["/Broken"]


def test_info_of_a_missing_file(run, tmp_path):
    assert "absent.usda" in fails(run, "info", tmp_path / "absent.usda")


# compare.


def test_compare(run, picture, room, tmp_path):
    picture(room, "--seed", 1, name="a.exr", spp=8)
    picture(room, "--seed", 2, name="b.exr", spp=8)
    same_file = run("compare", tmp_path / "a.exr", tmp_path / "a.exr", "--max", 0)
    assert same_file.returncode == 0 and "relMSE" in same_file.stdout
    other = run("compare", tmp_path / "a.exr", tmp_path / "b.exr", "--max", 0)
    assert other.returncode == 1
    assert run("compare", tmp_path / "a.exr", tmp_path / "b.exr").returncode == 0
    assert run("compare", tmp_path / "a.exr", tmp_path / "b.exr", "--max", 10).returncode == 0
    drawn = run("compare", tmp_path / "a.exr", tmp_path / "b.exr", "--difference", tmp_path / "d.png")
    assert drawn.returncode == 0 and pictures.png_size(tmp_path / "d.png") == (32, 32)


def test_compare_chosen_channels(run, picture, room, tmp_path):
    picture(room, "--aov", "illuminance", name="a.exr")
    listed = run("compare", tmp_path / "a.exr", tmp_path / "a.exr", "--channels", "Illuminance,G").stdout
    assert "Illuminance" in listed and re.search(r"^G ", listed, re.MULTILINE) and not re.search(r"^R ", listed, re.MULTILINE)
    assert run("compare", tmp_path / "a.exr", tmp_path / "a.exr", "--channels", "X").returncode == 1


def test_compare_what_cannot_be_compared(run, picture, room, tmp_path):
    picture(room, name="a.exr")
    picture(room, name="b.exr", size=16)
    assert "32 x 32" in fails(run, "compare", tmp_path / "a.exr", tmp_path / "b.exr")
    assert "absent.exr" in fails(run, "compare", tmp_path / "absent.exr", tmp_path / "a.exr")
    (tmp_path / "bad.exr").write_bytes((tmp_path / "a.exr").read_bytes()[:200])
    assert "bad.exr" in fails(run, "compare", tmp_path / "bad.exr", tmp_path / "a.exr")
    (tmp_path / "text.exr").write_text("no picture")
    assert "text.exr" in fails(run, "compare", tmp_path / "a.exr", tmp_path / "text.exr")
