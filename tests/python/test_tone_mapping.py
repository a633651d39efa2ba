"""Looks of pictures from Python: operators, white, adaptation and colour spaces of PNG files."""

import numpy as np
import pytest
from png_reader import png
from small_scenes import finished, floor_scene

gonio = pytest.importorskip("gonio")


@pytest.fixture(scope="module")
def film():
    return finished(floor_scene(width=24, height=16, samples=8))


def shown(film, path, **look):
    film.write_picture(path, **look)
    return png(path)


@pytest.mark.parametrize("look", [{}, {"tonemap": "local", "exposure": 1.0}, {"tonemap": "ev100=3"}, {"white": 2.0, "adapted": 3.0}])
def test_pictures_in_memory_are_those_of_files(film, tmp_path, look):
    picture = film.picture(**look)
    pixels, _ = shown(film, tmp_path / "a.png", **look)
    there = np.frombuffer(picture.tobytes(), np.uint8).reshape(pixels.shape)
    assert picture.size == film.size and np.array_equal(there[..., :3], pixels[..., :3])
    picture.write(tmp_path / "b.png")
    assert np.array_equal(png(tmp_path / "b.png")[0], there)
    with pytest.raises(gonio.SettingError, match="false colour"):
        picture.legend(100)


def test_the_default_is_the_photographic_operator(film, tmp_path):
    color = np.asarray(film["color"]).astype("f8")[..., :3] * 0.18 / film.log_average()
    luminance = color @ [0.2126, 0.7152, 0.0722]
    value = np.clip(color * ((1 + luminance / 36) / (1 + luminance))[..., None], 0, 1)
    expected = np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)
    pixels, chunks = shown(film, tmp_path / "a.png")
    assert np.abs(pixels[..., :3] - 255 * expected).max() < 0.51
    assert b"cICP" not in chunks


def test_adapted_eyes_and_white(film, tmp_path):
    usual, _ = shown(film, tmp_path / "a.png")
    same, _ = shown(film, tmp_path / "b.png", adapted=film.log_average(), white=6.0)
    brighter, _ = shown(film, tmp_path / "c.png", adapted=0.5 * film.log_average())
    stops, _ = shown(film, tmp_path / "d.png", exposure=1.0)
    earlier_white, _ = shown(film, tmp_path / "e.png", white=1.0)
    assert np.array_equal(usual, same) and np.array_equal(brighter, stops)
    assert brighter.sum() > usual.sum() and earlier_white.sum() > usual.sum()


def test_colour_spaces_say_what_they_are(film, tmp_path):
    wide, chunks = shown(film, tmp_path / "a.png", space="display-p3")
    assert chunks[b"cICP"] == bytes([12, 13, 0, 1]) and wide.dtype == np.uint8
    absolute, chunks = shown(film, tmp_path / "b.png", space="rec2020-pq")
    assert chunks[b"cICP"] == bytes([9, 16, 0, 1]) and absolute.dtype.itemsize == 2
    # A display value of 1 is 203 cd/m²: 0.5807 of the curve.
    white = film.with_pass("color", np.full((16, 24, 4), 1.0, "f4"))
    pixels, _ = shown(white, tmp_path / "c.png", space="rec2020-pq", tonemap="none")
    assert pixels[..., :3] / 65535 == pytest.approx(0.5807, abs=1e-4)


def test_operators_by_name(film, tmp_path):
    for tonemap in ("local", "none", "ev100=9.5"):
        film.write_picture(tmp_path / "a.jpg", tonemap=tonemap)
    for wrong in ({"tonemap": "filmic"}, {"space": "p3"}, {"white": 0.0}, {"adapted": -1.0}, {"exposure": float("nan")}):
        with pytest.raises(gonio.SettingError):
            film.write_picture(tmp_path / "a.png", **wrong)
    with pytest.raises(gonio.SettingError, match="JPEG files are sRGB"):
        film.write_picture(tmp_path / "a.jpg", space="display-p3")


@pytest.mark.parametrize("look", [{}, {"tonemap": "local", "white": 3.0}, {"tonemap": "ev100=2"}, {"tonemap": "none", "exposure": -1.0}])
def test_light_for_a_host_s_own_curve_shows_the_same_picture(film, tmp_path, look):
    linear = film.tone_mapped(**look)
    value = np.asarray(linear["color"]).astype("f8")
    curve = np.where(value <= 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)
    pixels, _ = shown(film, tmp_path / "a.png", **look)
    assert np.abs(pixels[..., :3] - 255 * curve[..., :3]).max() < 0.51
    assert linear.passes == ["color"] and np.array_equal(value[..., 3], np.asarray(film["color"])[..., 3])
