"""The command line: which camera, which frames, and the names of their files."""

import pictures
import pytest
from failures import fails

SETTINGS = """
def RenderSettings "Settings"
{
    int2 resolution = (20, 12)
    rel camera = </Right>
}
"""


def two_cameras(folder, *more):
    return pictures.stage(folder / "two.usda", pictures.ROOM, pictures.LAMP, pictures.camera("Left", -3), pictures.camera("Right", 3), *more)


def test_camera_by_name_and_by_path(picture, tmp_path):
    stage = two_cameras(tmp_path)
    named, placed = picture(stage, "--camera", "Right"), picture(stage, "-c", "/Right", name="path.exr")
    assert named.header["gonio:camera"] == "/Right"
    assert pictures.same(named, placed)
    assert not pictures.same(named, picture(stage, "--cam", "/Left", name="left.exr"))


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
    assert "no camera" in done.stderr and "one at the camera" in done.stderr
    image = pictures.read(tmp_path / "a.exr")
    assert image.rgb[image["A"] == 1].mean() > 0.1
    assert image["A"].max() == 1, "the camera looks past everything"
    dark = run("render", stage, "-o", tmp_path / "b.exr", "--res", 32, 32, "--spp", 4, "--disable-camera-light")
    assert "one at the camera" not in dark.stderr
    assert pictures.read(tmp_path / "b.exr").rgb.max() == 0


def test_quiet_says_nothing(run, tmp_path):
    stage = pictures.stage(tmp_path / "bare.usda", pictures.ROOM)
    done = run("render", stage, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1, "-q")
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


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
    stage = pictures.stage(tmp_path / "moving.usda", pictures.ROOM, pictures.MOVING, pictures.camera())
    done = run("render", stage, "-f", frames, "-o", tmp_path / "out" / pattern, "--res", 8, 8, "--spp", 1)
    assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == sorted(names)


def test_frames_take_the_values_of_their_time(run, tmp_path):
    stage = pictures.stage(tmp_path / "moving.usda", pictures.ROOM, pictures.MOVING, pictures.camera())
    run("render", stage, "-f", "1:3", "-o", tmp_path / "a.#.exr", "--res", 16, 16, "--spp", 4, "--integrator", "direct")
    one, two, three = (pictures.read(tmp_path / f"a.{frame}.exr").rgb.mean() for frame in (1, 2, 3))
    assert two / one == pytest.approx(2, rel=1e-4) and three / one == pytest.approx(4, rel=1e-4)


def test_several_frames_need_a_place_in_the_name(run, tmp_path):
    stage = pictures.stage(tmp_path / "moving.usda", pictures.ROOM, pictures.MOVING, pictures.camera())
    line = fails(run, "render", stage, "-f", "1:3", "-o", tmp_path / "a.exr")
    assert "####" in line and not (tmp_path / "a.exr").exists()


@pytest.mark.parametrize("frames", ["x", "1:", "1:3x0", "nan", "", "1:1e30"])
def test_bad_frames(run, room, tmp_path, frames):
    assert "frames" in fails(run, "render", room, f"--frames={frames}", "-o", tmp_path / "a.####.exr")


@pytest.mark.parametrize(("pattern", "name"), [("a.$F4.exr", "a.0007.exr"), ("a.<F4>.exr", "a.0007.exr"), ("a.%04d.exr", "a.0007.exr"), ("a.####.exr", "a.0007.exr"), ("a.$F.exr", "a.7.exr")])  # fmt: skip
def test_a_place_for_the_frame_takes_the_stages_own(run, tmp_path, pattern, name):
    """As husk has it."""
    stage = pictures.stage(tmp_path / "s.usda", pictures.ROOM, pictures.camera())
    stage.write_text(stage.read_text().replace("upAxis", "startTimeCode = 7\n    endTimeCode = 8\n    upAxis", 1))
    done = run("render", stage, "-o", tmp_path / pattern, "--spp", 1, "--res", 4, 4)
    assert done.returncode == 0, done.stderr
    assert sorted(path.name for path in tmp_path.glob("*.exr")) == [name]


def test_a_place_for_the_frame_without_any(run, tmp_path):
    stage = pictures.stage(tmp_path / "s.usda", pictures.ROOM, pictures.camera())
    done = run("render", stage, "-o", tmp_path / "a.$F4.exr", "--spp", 1, "--res", 4, 4)
    assert done.returncode == 0 and [path.name for path in tmp_path.glob("*.exr")] == ["a.0001.exr"], done.stderr
    done = run("render", stage, "-o", tmp_path / "b.$F4.exr", "--spp", 1, "--res", 4, 4, "--default-time")
    assert done.returncode == 1 and "--default-time is of no frame" in done.stderr, done.stderr
    assert not list(tmp_path.glob("b*"))
