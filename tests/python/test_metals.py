"""Metals by their indices of refraction: Fresnel's formulas by wavelength, their colours, names and files."""

import math

import gonio
import numpy as np
import pytest

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
CORNERS = np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def mirror(angle=0.0, samples=16, spectrum=None, **material):
    """A square of a metal under an even dome of 1 cd/m², seen at an angle in degrees from its normal."""
    made = gonio.Scene()
    square = made.add_mesh(SQUARE, CORNERS)
    made.add_instance(square, [made.add_material(**{"specular_roughness": 0.0, **material})])
    sin, cos = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    made.add_camera([[1, 0, 0, 0], [0, cos, -sin, -2 * sin], [0, sin, cos, 2 * cos], [0, 0, 0, 1]], fov=0.1)
    made.add_light("dome", **({} if spectrum is None else {"spectrum": spectrum}))
    made.set(width=8, height=8, samples=samples)
    return made


def seen(made) -> np.ndarray:
    with gonio.Render(made) as rendering:
        rendering.wait()
        return np.asarray(rendering.film()["color"], float)[..., :3].mean(axis=(0, 1))


def fresnel(metal, nm, angle=0.0):
    """Unpolarised reflectance at wavelengths, by complex numbers."""
    index = np.interp(nm, metal["wavelengths_nm"], metal["n"]) + 1j * np.interp(nm, metal["wavelengths_nm"], metal["k"])
    cos = math.cos(math.radians(angle))
    inner = np.sqrt(index**2 - (1 - cos**2))
    s = np.abs((cos - inner) / (cos + inner)) ** 2
    p = np.abs((index**2 * cos - inner) / (index**2 * cos + inner)) ** 2
    return 0.5 * (s + p)


def test_gold_of_johnson_and_christy():
    """At 549 nm they measured 0.42 + 2.44 i, at 497 nm 1.04 + 1.83 i; the tables have steps of 5 nm."""
    gold = gonio.metal("gold")
    assert gold["name"] == "Au-Johnson"
    place = gold["wavelengths_nm"].index(550.0)
    assert gold["n"][place] == pytest.approx(0.424, abs=0.005) and gold["k"][place] == pytest.approx(2.472, abs=0.03)
    red, green, blue = gold["color"]
    assert red > green > blue and red == pytest.approx(1.0, abs=0.05) and 0.3 < blue < 0.45


@pytest.mark.parametrize(("name", "angle"), [("Au", 0.0), ("Cu-McPeak", 60.0), ("Al", 80.0), ("brass", 30.0)])
def test_mirrors_by_wavelength_are_fresnels(name, angle):
    made = mirror(angle, metal=name)
    made.set(spectral=True)
    picture = gonio.spectral_picture(made, band=10.0)
    nm = np.asarray(picture.wavelengths_nm)
    daylight = gonio.illuminant("D65")
    fine = np.arange(380.0, 780.01, 0.1)
    power = np.interp(fine, daylight["wavelengths_nm"], daylight["power"])
    ler = gonio.spectrum_figures(fine, power)["ler"]
    bands = np.array([np.trapezoid(np.interp(np.linspace(a - 5, a + 5, 101), fine, power), dx=0.1) / 10 for a in nm])
    found = np.asarray(picture.radiance).mean(axis=(0, 1)) * ler * np.trapezoid(power, dx=0.1) / bands
    np.testing.assert_allclose(found, fresnel(gonio.metal(name), nm, angle), atol=2e-3)


@pytest.mark.parametrize("name", ["Au", "Cu", "Ag", "brass", "Cr", "W", "C"])
def test_pictures_in_colour_are_those_by_wavelength(name):
    """Under daylight a mirror has the same colour in red, green and blue as by wavelength, straight on and at 60 degrees; up to 0.995, as gold's red lies
    beyond Rec.709."""
    for angle, bound in ((0.0, 1e-3), (60.0, 0.02)):
        colour = seen(mirror(angle, metal=name))
        made = mirror(angle, samples=512, metal=name)
        made.set(spectral=True)
        np.testing.assert_allclose(colour, np.minimum(seen(made), 0.995), atol=bound)
    assert seen(mirror(metal=name)) == pytest.approx([min(part, 0.995) for part in gonio.metal(name)["color"]], abs=2e-3)


def test_under_lamps_gold_is_by_its_spectrum():
    """Under an LED gold's luminance is Fresnel's, by the lamp's spectrum."""
    lamp, gold = gonio.illuminant("LED-B3"), gonio.metal("gold")
    made = mirror(metal="gold", samples=1024, spectrum="LED-B3")
    made.set(spectral=True)
    nm = np.arange(380.0, 780.5, 1.0)
    power = np.interp(nm, lamp["wavelengths_nm"], lamp["power"])
    luminous = np.array([gonio.spectrum_figures([a - 1, a - 0.5, a, a + 0.5, a + 1], [0, 1, 1, 1, 0])["ler"] for a in nm])
    expected = np.sum(power * luminous * fresnel(gold, nm)) / np.sum(power * luminous)
    assert float(np.dot(seen(made), (0.2126, 0.7152, 0.0722))) == pytest.approx(expected, rel=0.01)


def test_a_rough_metal_loses_no_more_than_it_absorbs():
    """A furnace: a metal that absorbs nothing is as bright as its sky, rough or not, in colour and by wavelength."""
    nm = [380.0, 500.0, 600.0, 780.0]
    lossless = {"name": "lossless", "wavelengths_nm": nm, "n": [1e-6] * 4, "k": [2.0, 3.0, 4.0, 5.0]}
    for spectral in (False, True):
        made = mirror(metal=lossless, specular_roughness=0.6, samples=1024)
        made.set(spectral=spectral)
        assert seen(made) == pytest.approx([1.0] * 3, abs=0.02)


def test_files(tmp_path):
    """Rows of nm, n and k, rows of micrometres, and the blocks that the database of refractive indices exports."""
    gold = gonio.metal("Au")
    rows = list(zip(gold["wavelengths_nm"], gold["n"], gold["k"], strict=True))
    forms = {
        "rows.csv": "nm,n,k\n" + "\n".join(f"{nm},{n},{k}" for nm, n, k in rows),
        "micrometres.yml": "DATA:\n  - type: tabulated nk\n    data: |\n" + "\n".join(f"        {nm / 1000:.6f} {n} {k}" for nm, n, k in rows),
        "blocks.csv": "wl,n\n" + "\n".join(f"{nm / 1000:.6f},{n}" for nm, n, k in rows) + "\n\nwl,k\n" + "\n".join(f"{nm / 1000:.6f},{k}" for nm, n, k in rows),
    }
    for name, text in forms.items():
        (tmp_path / name).write_text(text)
        found = gonio.read_metal(text.encode(), name)
        assert (found["n"], found["k"]) == (gold["n"], gold["k"]), name
        assert found["wavelengths_nm"] == pytest.approx(gold["wavelengths_nm"])
    assert seen(mirror(metal=tmp_path / "rows.csv")) == pytest.approx(seen(mirror(metal="Au")), abs=1e-6)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no extinction k"),
        ("400,1.5\n500,1.5\n700,1.5\n", "no extinction k"),
        ("400 1 2\n390 1 2\n700 1 2\n", "expected increasing"),
        ("500 1 2\n600 1 2\n700 1 2\n", "expected 400 to 700 nm"),
        ("400 1 2\n500 -1 2\n700 1 2\n", "expected 0 to 100"),
        ("400 1 2\n500 1 nan\n700 1 2\n", "expected 0 to 100"),
        ("400 1 2\n500 1 2 3 4\n700 1 2\n", "2: '500 1 2 3 4'"),
    ],
)
def test_bad_files(text, message):
    with pytest.raises(gonio.Error, match=message):
        gonio.read_metal(text.encode(), "metal.csv")


def test_what_cannot_be_metal_is_told():
    with pytest.raises(gonio.Error, match="'unobtainium' was found, expected one of Ag-Johnson"):
        gonio.metal("unobtainium")
    made = mirror(metal="Au", metalness=0.0)
    with gonio.Render(made) as rendering:
        rendering.wait()
        assert any("no part of it is metallic" in str(told) for told in rendering.diagnostics)
