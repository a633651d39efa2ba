"""Spectra of sun and sky: illuminants of the CIE as even skies, colours as without wavelengths, the sun by its formula."""

import math
from pathlib import Path

import gonio
import numpy as np
import pytest

VIENNA = (48.21, 16.37)
CLEAR = "2025-06-21T13:00+02:00"
TO_XYZ = np.array([[0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923], [0.0193308, 0.1191948, 0.9505322]])
LUMINANCE = TO_XYZ[1]
SUN = Path(__file__).resolve().parents[2] / "rust-core" / "spectrum" / "data" / "sun.csv"
SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
CORNERS = np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def at(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def day(**settings):
    return gonio.daylight(*VIENNA, CLEAR, **settings)


def colour_of(figures):
    """Linear Rec.709 of luminance 1 of a chromaticity."""
    x, y = figures["x"], figures["y"]
    return np.linalg.solve(TO_XYZ, [x / y, 1.0, (1.0 - x - y) / y])


def under(kind, radiance, spectra, quantities=("cct", "melanopic-edi", "illuminance"), **lamp):
    """A level meter below a light, in an empty scene."""
    made = gonio.Scene()
    made.add_light(kind, tuple(map(float, radiance)), colour_spectra=spectra, **lamp)
    for quantity in quantities:
        made.add_meter((0, 0, 0), facing=(0, 0, 1), quantity=quantity)
    return gonio.measure(made, samples=4096)


@pytest.mark.parametrize("name", ["D50", "D65", "D75"])
def test_an_even_sky_of_the_d_series(name):
    lamp = gonio.illuminant(name)
    expected = gonio.spectrum_figures(lamp["wavelengths_nm"], lamp["power"])
    measured = under("dome", 100.0 * colour_of(expected), day().sky_spectra)
    cct, melanopic, lux = measured.meters
    colour = cct.colour
    assert cct.value == pytest.approx(expected["cct"], abs=5.0)
    assert colour["melanopic_edi_lx"] / colour["illuminance_lx"] == pytest.approx(expected["melanopic_der"], abs=0.002)
    assert melanopic.value / lux.value == pytest.approx(expected["melanopic_der"], abs=0.002 + 4 * melanopic.standard_error / lux.value)
    assert lux.value == pytest.approx(math.pi * 100.0, rel=2e-3)
    assert not any("D65" in message for _, message in measured.diagnostics)


def floor(daylight, samples, sides=1.0, **settings):
    """A white floor below sun and sky, seen from above."""
    made = gonio.Scene()
    made.add_instance(made.add_mesh(SQUARE * np.float32(sides), CORNERS), [made.add_material(base_color=(1.0,) * 3, specular_weight=0.0)])
    made.add_daylight(daylight)
    made.add_camera(at(0, 0, 2), fov=10.0)
    made.set(width=16, height=16, samples=samples, **settings)
    return made


def rendered(made):
    with gonio.Render(made) as rendering:
        rendering.wait()
        return np.asarray(rendering.film()["color"])[..., :3].astype(float)


@pytest.mark.parametrize("sky", ["perez", "hosek-wilkie", "clear"])
def test_a_white_floor_is_as_without_wavelengths(sky):
    plain = rendered(floor(day(sky=sky), 2048)).mean(axis=(0, 1))
    spectral = rendered(floor(day(sky=sky), 2048, spectral=True)).mean(axis=(0, 1))
    np.testing.assert_allclose(spectral, plain, rtol=0.005)


@pytest.mark.parametrize("sky", ["perez", "hosek-wilkie"])
def test_the_sky_has_its_colour_in_each_direction(sky):
    def seen(towards, **settings):
        made = gonio.Scene()
        made.add_daylight(day(sky=sky, ground=0.2))
        made.add_camera(gonio.look_at((0, 0, 0), towards, up=(0.1, 0.2, 1)), fov=20.0)
        made.set(width=4, height=4, samples=256, **settings)
        return made

    for towards in ((0.3, 0.2, 1), (1, 0, 0.2), (-1, 0.3, 0.3), (0, -1, 0.9), (0, 1, -0.5)):
        plain = rendered(seen(towards))
        by_wavelength = gonio.spectral_picture(seen(towards, spectral=True), band=10.0)
        luminance = (plain @ LUMINANCE)[..., None]
        np.testing.assert_allclose(np.asarray(by_wavelength.color)[..., :3] / luminance, plain / luminance, atol=0.005, err_msg=str(towards))
        spectral = rendered(seen(towards, spectral=True)).mean(axis=(0, 1))
        plain = plain.mean(axis=(0, 1))
        np.testing.assert_allclose(spectral / (plain @ LUMINANCE), plain / (plain @ LUMINANCE), atol=0.005, err_msg=str(towards))
        assert (np.asarray(by_wavelength.radiance) >= 0).all()


def sun_by_formula(nm, mass, turbidity, aim):
    """Irradiance outside of the atmosphere behind air, haze and 300 Dobson units of ozone, times e to a parabola that gives it a chromaticity: found here by a
    search of its own."""
    table = np.loadtxt(SUN, delimiter=",", skiprows=1)
    um = nm / 1000.0
    thickness = 0.008735 * um**-4.08 + (0.04608 * turbidity - 0.04586) * um**-1.3 + 300 * 2.687e20 * np.interp(nm, table[:, 0], table[:, 2])
    plain = np.interp(nm, table[:, 0], table[:, 1]) * np.exp(-mass * thickness)
    t = (nm - 580.0) / 200.0

    def off(parts):
        figures = gonio.spectrum_figures(nm, plain * np.exp(parts[0] * t + parts[1] * t * t))
        return np.array([figures["x"] - aim[0], figures["y"] - aim[1]])

    parts = np.zeros(2)
    for _ in range(20):
        slopes = np.stack([(off(parts + step) - off(parts - step)) / 2e-4 for step in 1e-4 * np.eye(2)], 1)
        parts = parts - np.linalg.solve(slopes, off(parts))
    return plain * np.exp(parts[0] * t + parts[1] * t * t)


@pytest.mark.parametrize(("time", "turbidity"), [(CLEAR, 3.0), ("2025-06-21T18:00+02:00", 2.0)])
def test_the_sun_has_its_spectrum(time, turbidity):
    daylight = gonio.daylight(*VIENNA, time, turbidity=turbidity)
    irradiance = np.array(daylight.sun_irradiance)
    found = under("distant", irradiance, daylight.sun_spectra, quantities=("cct", "illuminance"), angle=0.533)
    colour = found.meters[0].colour
    assert colour["illuminance_lx"] == pytest.approx(daylight.direct_illuminance, rel=2e-3)
    nm, power = np.asarray(colour["wavelengths_nm"]), np.asarray(colour["irradiance"])
    xyz = TO_XYZ @ irradiance
    figures = gonio.spectrum_figures(nm, power)
    assert [figures["x"], figures["y"]] == pytest.approx(list(xyz[:2] / xyz.sum()), abs=5e-4)
    height = daylight.elevation
    mass = 1.0 / (math.sin(math.radians(height)) + 0.50572 * (height + 6.07995) ** -1.6364)
    expected = sun_by_formula(nm, mass, turbidity, xyz[:2] / xyz.sum())
    assert figures["melanopic_der"] == pytest.approx(gonio.spectrum_figures(nm, expected)["melanopic_der"], abs=0.002)
    # A meter knows bands of 10 nm; within them the shape is that of D65.
    bands = [(nm >= low) & (nm <= low + 10) for low in range(410, 700, 10)]
    found, expected = (np.array([np.trapezoid(values[band]) for band in bands]) for values in (power, expected))
    np.testing.assert_allclose(found / found.sum(), expected / expected.sum(), rtol=0.015)


def test_pictures_without_wavelengths_do_not_change():
    made, other = floor(day(), 4), floor(day(), 4)
    for number, light in enumerate(other.to_dict()["lights"]):
        assert light.pop("colour_spectra")["wavelengths_nm"]
        other.put_light(light, number)
    assert (rendered(made) == rendered(other)).all()


def test_descriptions_keep_them(tmp_path):
    made = floor(day(sky="hosek-wilkie"), 4)
    made.save(tmp_path / "floor.gonio")
    lights = gonio.Scene.load(tmp_path / "floor.gonio").to_dict()["lights"]
    assert [light["colour_spectra"] for light in lights] == [day(sky="hosek-wilkie").sky_spectra, day(sky="hosek-wilkie").sun_spectra]


def test_a_spectrum_of_its_own_wins():
    lamp = gonio.illuminant("A")
    expected = gonio.spectrum_figures(lamp["wavelengths_nm"], lamp["power"])
    cct, *_ = under("dome", (100.0,) * 3, day().sky_spectra, spectrum="A").meters
    assert cct.value == pytest.approx(expected["cct"], abs=1.0)


def test_white_daylight_is_d65_which_is_told():
    white = day(coloured=False)
    assert white.sky_spectra is None and white.sun_spectra is None
    for daylight, is_told in ((white, True), (day(), False)):
        made = floor(daylight, 4)
        made.add_meter((0, 0, 1), facing=(0, 1, 0.5), quantity="melanopic-edi")
        measured = gonio.measure(made, samples=256)
        assert any("D65" in message for _, message in measured.diagnostics) == is_told


def test_a_sun_in_a_group_is_relit():
    daylight = day()
    made = floor(daylight, 16)
    for number, light in enumerate(made.to_dict()["lights"]):
        made.put_light({**light, "group": "Sky" if "Dome" in light["shape"] else "Sun"}, number)
    made.set(passes=["color", "lightgroup:Sun", "lightgroup:Sky"])
    picture = gonio.spectral_picture(made, band=10.0)
    relit = picture.relit([("Sun", 1.0, gonio.illuminant("D50"))])
    found = np.asarray(relit.layer("lightgroup:Sun")).mean(axis=(0, 1))
    lamp = gonio.illuminant("D50")
    power = np.interp(picture.wavelengths_nm, lamp["wavelengths_nm"], lamp["power"])
    np.testing.assert_allclose(found / found.sum(), power / power.sum(), atol=1e-3)
    with pytest.raises(gonio.Error, match="'Sky' send is not known"):
        picture.relit([("Sky", 1.0, gonio.illuminant("D50"))])


def test_what_cannot_be_used_is_told():
    made = floor(day(), 4, spectral=True)
    wrong = {"wavelengths_nm": [400.0, 700.0], "over_d65": [[1.0, 1.0], [1.0], [1.0, 1.0]]}
    made.add_light("dome", colour_spectra=wrong, name="odd dome")
    with gonio.Render(made) as rendering:
        rendering.wait()
        told = [message for message in rendering.diagnostics if "odd dome" in str(message)]
    assert len(told) == 1 and "2 wavelengths, and [2, 1, 2]" in str(told[0])
