"""The command line: passes."""

import numpy as np
import pictures
import pytest
from failures import fails


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
