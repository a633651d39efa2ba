"""Spectra that are none: one message with the file and the line, or the lamp's name, and a picture by its colour; nothing is silent, nothing hangs."""

import time

import gonio
import numpy as np
import pytest

NM = list(range(380, 781, 5))
ROWS = [(nm, "1.5") for nm in NM]


def table(rows=ROWS, between=",", end="\n"):
    return end.join(f"{nm}{between}{power}" for nm, power in rows) + end


def other(place, nm, power):
    return table([(nm, power) if k == place else row for k, row in enumerate(ROWS)])


def tm27(points=None, head="", quantity="flux"):
    points = points or "".join(f'<SpectralData wavelength="{nm}">{power}</SpectralData>\n' for nm, power in ROWS)
    inside = f"<SpectralQuantity>{quantity}</SpectralQuantity>\n{points}"
    return f"{head}<IESTM2714><SpectralDistribution>{inside}</SpectralDistribution></IESTM2714>"


LAUGHS = "".join('<!ENTITY %s "%s">' % (new, f"&{old};" * 10) for old, new in zip("zabcdefg", "abcdefgh", strict=True))
FILES = {
    "gap.csv": (table([row for row in ROWS if not 500 < row[0] < 560]), "gap.csv:26: nothing between 500 and 560 nm"),
    "unsorted.csv": (table(ROWS[::-1]), "unsorted.csv:2: 775 nm after 780 nm"),
    "twice.csv": (other(10, 425, "1"), "twice.csv:11: 425 nm stands twice"),
    "micrometres.csv": (table([(nm / 1000, power) for nm, power in ROWS]), "micrometres.csv:1: .*look like micrometres"),
    "three.csv": (table(ROWS[:3]), "three.csv:1: 3 points"),
    "nan.csv": (other(5, 405, "nan"), "nan.csv:6: power NaN at 405 nm"),
    "inf.csv": (other(5, 405, "1e999"), "inf.csv:6: power inf at 405 nm"),
    "negative.csv": (other(5, 405, "-1"), "negative.csv:6: power -1 at 405 nm"),
    "dark.csv": (table([(nm, 0) for nm in NM]), "dark.csv: no power above zero"),
    "infrared.csv": (table([(nm + 500, 1) for nm in NM]), "infrared.csv: no visible light from 880 to 1280 nm"),
    "digits.csv": (other(0, 380, "9" * (4 << 20)), "digits.csv:1: power inf at 380 nm"),
    "commas.csv": (table([(nm, "1,5") for nm in NM]), "commas.csv:1: '380,1,5': commas may stand"),
    "zero.csv": (table().replace("405", "4\x0005"), "zero.csv: byte 41: a zero byte"),
    "words.csv": ("a lamp\n", "words.csv: no line of wavelength"),
    "laughs.spdx": (tm27("&h;", f'<!DOCTYPE l [<!ENTITY z "lol">{LAUGHS}]>'), "laughs.spdx:1: not XML"),
    "outside.spdx": (tm27("&x;", '<!DOCTYPE l [<!ENTITY x SYSTEM "file:///etc/hostname">]>'), "outside.spdx:1: not XML"),
    "unsorted.spdx": (tm27('<SpectralData wavelength="500">1</SpectralData>\n' * 5), "unsorted.spdx:3: 500 nm stands twice"),
    "nan.spdx": (tm27().replace('"405">1.5', '"405">NaN'), "nan.spdx:7: power NaN"),
    "commas.spdx": (tm27().replace("1.5", "1,5"), "commas.spdx:2: power '1,5' is no number"),
    "reflectance.spdx": (tm27(quantity="reflectance"), "reflectance.spdx:1: .*no power of a source"),
    "cut.spdx": (tm27()[:-30], "cut.spdx:.*not XML"),
    "none.spdx": (tm27(" "), "none.spdx: 0 points"),
}


@pytest.mark.parametrize("name", FILES)
def test_files_are_refused_with_their_line(name, tmp_path):
    text, message = FILES[name]
    with pytest.raises(gonio.FormatError, match=message):
        gonio.read_spectrum(text.encode(), name)
    (tmp_path / name).write_text(text)
    with pytest.raises(gonio.FormatError, match=message):
        gonio.Scene().add_light("sphere", spectrum=tmp_path / name)


@pytest.mark.parametrize(
    "data",
    [
        b"\xef\xbb\xbf" + table().encode(),
        ("\ufeff" + table()).encode("utf-16-le"),
        ("\ufeff" + table()).encode("utf-16-be"),
        table(end="\r\n").encode(),
        table([(f"{nm},0", "1,5") for nm in NM], between=";").encode(),
        b"\xef\xbb\xbf" + tm27().encode(),
        ("\ufeff" + tm27(head='<?xml version="1.0" encoding="UTF-16"?>')).encode("utf-16-le"),
        tm27("<a>" * 20000 + "</a>" * 20000 + tm27().split("</SpectralQuantity>")[1].split("</SpectralDistribution>")[0]).encode(),
    ],
    ids=["BOM", "UTF-16", "UTF-16 BE", "CRLF", "decimal commas", "XML with BOM", "XML in UTF-16", "deep XML"],
)
def test_other_writings_are_read(data):
    before = time.process_time()
    found = gonio.read_spectrum(data, "lamp")
    assert (found["wavelengths_nm"], found["power"]) == ([float(nm) for nm in NM], [1.0] * len(NM))
    assert time.process_time() - before < 2.0


def picture(**lamp):
    """What a square under a dome shows, and what is told."""
    made = gonio.Scene()
    square = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    made.add_instance(made.add_mesh(square, np.array([[0, 1, 2], [0, 2, 3]], np.int32)), [made.add_material(base_color=0.5, specular_weight=0.0)])
    made.add_light("dome", name="odd lamp", **lamp)
    made.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]], fov=1.0)
    made.set(width=8, height=8, samples=4, spectral=True)
    with gonio.Render(made) as rendering:
        rendering.wait()
        return np.asarray(rendering.film()["color"])[..., :3].mean(axis=(0, 1)), [str(told) for told in rendering.diagnostics]


NUMBERS = {
    "gap": ([nm for nm in NM if not 500 < nm < 560], [1] * 70, "nothing between 500 and 560 nm"),
    "unsorted": (NM[::-1], [1] * 81, "775 nm after 780 nm"),
    "twice": ([*NM[:-1], 775], [1] * 81, "775 nm stands twice"),
    "micrometres": ([nm / 1000 for nm in NM], [1] * 81, "look like micrometres"),
    "three": (NM[:3], [1] * 3, "3 points"),
    "none": ([], [], "0 points"),
    "negative": (NM, [-1] + [1] * 80, "power -1 at 380 nm"),
    "dark": (NM, [0] * 81, "no power above zero"),
    "infrared": ([nm + 500 for nm in NM], [1] * 81, "no visible light"),
    "two lengths": (NM, [1] * 80, "81 wavelengths and 80 powers"),
}


@pytest.mark.parametrize("name", NUMBERS)
def test_lamps_of_bad_numbers_keep_their_colour_which_is_told(name):
    wavelengths, power, message = NUMBERS[name]
    shown, told = picture(spectrum=(wavelengths, power))
    assert len(told) == 1 and "odd lamp" in told[0] and message in told[0] and "its colour stands in" in told[0]
    assert shown == pytest.approx([0.5] * 3, rel=0.01)


@pytest.mark.parametrize("wrong", [5, list(zip(NM, [1.0] * 81, strict=True)), ([380, "x"], [1, 1]), (NM, None), b"LED-B3", (NM, [1j] * 81)])
def test_what_is_no_spectrum_at_all_is_named(wrong):
    for put in (lambda made: made.add_light("dome", spectrum=wrong), lambda made: made.add_material(emission_color=(1.0,) * 3, spectrum=wrong)):
        with pytest.raises(gonio.SettingError, match="spectrum: expected a name, a file"):
            put(gonio.Scene())


def test_numbers_that_are_none_are_named():
    for wrong in (float("nan"), float("inf")):
        with pytest.raises(gonio.SettingError, match=r"spectrum.power\[0\]"):
            gonio.Scene().add_light("dome", spectrum=(NM, [wrong] + [1.0] * 80))
    with pytest.raises(gonio.SettingError, match="wavelengths_nm"):
        gonio.Scene().add_light("dome", spectrum={"name": "lamp"})
    with pytest.raises(gonio.SettingError, match="'missing.csv' was found, expected one of A, E"):
        gonio.Scene().add_light("dome", spectrum="missing.csv")


def test_what_is_missing_of_a_lamp_is_told_with_it():
    nm = [at for at in NM if 450 <= at <= 650]
    _, told = picture(spectrum=(nm, [1] * len(nm)))
    assert any("odd lamp" in message and "450 to 650 nm" in message for message in told)
