"""Lights of TM-33 and GLDF files that have spectra: they shine with them where light has wavelengths and nothing else was asked for."""

import math
import zipfile

import gonio
import numpy as np
import pytest

SQUARE = np.array([[-4, -4, 0], [4, -4, 0], [4, 4, 0], [-4, 4, 0]], np.float32)
CORNERS = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
FLUX_LM = 1000.0


def tm33(spectrum, intensity=FLUX_LM / (4 * math.pi), kind="Luminous", more="", points=None) -> bytes:
    """An even luminaire of a spectrum, whose rows begin in line 8."""
    rows = "".join(f'<IntData h="{h}" v="{v}">{intensity}</IntData>' for h in (0, 90) for v in (0, 90, 180))
    points = points or list(zip(spectrum["wavelengths_nm"], spectrum["power"], strict=True))
    spectral = "".join(f'<PwrData w="{nm}">{power}</PwrData>\n' for nm, power in points)
    return f"""<?xml version="1.0"?>
<IESTM33-22><Version>1.1</Version><Header><Description>lamp</Description></Header><Emitter>
<Quantity>1</Quantity><Description>LED engine</Description><InputWattage>10</InputWattage>
<{kind}Data>{more}<{kind}Intensity>{rows}</{kind}Intensity></{kind}Data>
<SpectralData>
<EmitterSpectral>
<NumberWavelength>{len(points)}</NumberWavelength>
{spectral}</EmitterSpectral></SpectralData></Emitter></IESTM33-22>""".encode()


def gldf(path, spectrum):
    """A product of the same luminaire, whose spectrum is a file of the archive."""
    text = "".join(f"{nm}\t{power}\r\n" for nm, power in zip(spectrum["wavelengths_nm"], spectrum["power"], strict=True))
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("ldc/lamp.xml", tm33(gonio.illuminant("E")))
        archive.writestr("spectrum/lamp.txt", text)
        archive.writestr(
            "product.xml",
            """<Root><Header><Manufacturer>maker</Manufacturer></Header><GeneralDefinitions>
<Files><File id="f" contentType="ldc/iesxml" type="localFileName">lamp.xml</File>
<File id="t" contentType="spectrum/text" type="localFileName">lamp.txt</File></Files>
<Photometries><Photometry id="p"><PhotometryFileReference fileId="f"/></Photometry></Photometries>
<Spectrums><Spectrum id="s"><SpectrumFileReference fileId="t"/></Spectrum></Spectrums>
<LightSources><FixedLightSource id="led"><SpectrumReference spectrumId="s"/></FixedLightSource></LightSources>
<Emitters><Emitter id="e"><FixedLightEmitter><PhotometryReference photometryId="p"/><LightSourceReference fixedLightSourceId="led"/>
</FixedLightEmitter></Emitter></Emitters></GeneralDefinitions><ProductDefinitions><Variants>
<Variant id="v"><Geometry><EmitterReference emitterId="e"/></Geometry></Variant></Variants></ProductDefinitions></Root>""",
        )
    return path


QUANTITIES = ("illuminance", "cct", "ra", "melanopic-edi")


def below(goniogram, quantities=QUANTITIES, **light):
    """What level meters show 2 m below a lamp in the open: E = I / 4."""
    made = gonio.Scene()
    made.add_light("luminaire", goniogram=goniogram, transform=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]], **light)
    for quantity in quantities:
        made.add_meter((0, 0, 0), quantity=quantity, facing=(0, 0, 1))
    return [reading.value for reading in gonio.measure(made, samples=1024).meters]


def floor_colour(goniogram, spectral, **light):
    """A white floor below the lamp, over its luminance."""
    made = gonio.Scene()
    floor = made.add_mesh(SQUARE, CORNERS)
    made.add_instance(floor, [made.add_material(base_color=(0.5, 0.5, 0.5), specular_weight=0.0)])
    made.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 4], [0, 0, 0, 1]], fov=0.1)
    made.add_light("luminaire", goniogram=goniogram, transform=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]], **light)
    made.set(width=8, height=8, samples=512, spectral=spectral)
    with gonio.Render(made) as rendering:
        rendering.wait()
        colour = np.asarray(rendering.film()["color"], float)[..., :3].mean(axis=(0, 1))
    return colour / (colour @ (0.2126, 0.7152, 0.0722))


@pytest.fixture
def lamp():
    return gonio.illuminant("LED-B3")


def test_descriptions_have_the_spectrum(lamp):
    found, warnings = gonio.read_goniogram(tm33(lamp), "lamp.xml")
    assert warnings == [] and found["spectrum"]["name"] == "LED engine"
    assert found["spectrum"]["wavelengths_nm"] == pytest.approx(lamp["wavelengths_nm"])
    assert found["spectrum"]["power"] == pytest.approx(np.asarray(lamp["power"]) / max(lamp["power"]), abs=1e-12)
    assert gonio.read_spectrum(tm33(lamp), "lamp.xml")["power"] == found["spectrum"]["power"]


@pytest.mark.parametrize("kind", ["TM-33", "GLDF"])
def test_meters_have_the_figures_of_the_files_spectrum(lamp, kind, tmp_path):
    """A lamp in the open has the figures of its own spectrum, and the file's lux."""
    data = tm33(lamp) if kind == "TM-33" else gldf(tmp_path / "lamp.gldf", lamp).read_bytes()
    goniogram, warnings = gonio.read_goniogram(data, "lamp")
    assert warnings == []
    own = gonio.spectrum_figures(lamp["wavelengths_nm"], lamp["power"])
    expected = FLUX_LM / (4 * math.pi) / 4
    lux, cct, ra, edi = below(goniogram)
    assert lux == pytest.approx(expected, rel=1e-3)
    assert (cct, ra) == (pytest.approx(own["cct"], abs=0.5), pytest.approx(own["ra"], abs=0.03))
    assert edi == pytest.approx(expected * own["melanopic_der"], rel=0.01)


def test_what_was_asked_for_comes_first(lamp):
    """A spectrum that the light names takes the place of the file's, and so does a colour."""
    goniogram, _ = gonio.read_goniogram(tm33(lamp), "lamp.xml")
    other = gonio.illuminant("FL2")
    named = gonio.spectrum_figures(other["wavelengths_nm"], other["power"])
    [cct] = below(goniogram, ["cct"], spectrum="FL2")
    assert cct == pytest.approx(named["cct"], abs=0.5)
    with pytest.raises(gonio.Error, match="want its spectrum"):
        below(goniogram, ["ra"], radiance=(1.0, 0.5, 0.2))


def test_pictures_with_wavelengths_alone_have_it(lamp):
    """Pictures in red, green and blue stay as they were; with wavelengths the floor has the lamp's colour."""
    goniogram, _ = gonio.read_goniogram(tm33(lamp), "lamp.xml")
    assert floor_colour(goniogram, False) == pytest.approx([1.0] * 3, abs=1e-5)
    own = floor_colour(goniogram, True)
    assert own == pytest.approx(floor_colour({**goniogram, "spectrum": None}, True, spectrum="LED-B3"), abs=2e-3)
    assert own[0] > 1.2 and own[2] < 0.7


def test_radiant_intensities_are_candela_by_the_spectrum(lamp):
    """W/sr times the spectrum's lm/W over the range that was measured."""
    bounds = "<MinWavelength>380</MinWavelength><MaxWavelength>780</MaxWavelength>"
    goniogram, warnings = gonio.read_goniogram(tm33(lamp, intensity=2.0, kind="Radiant", more=bounds), "lamp.xml")
    nm, power = (np.asarray(lamp[name]) for name in ("wavelengths_nm", "power"))
    ler = gonio.spectrum_figures(nm, power)["ler"]
    inside = (nm >= 380) & (nm <= 780)
    ler *= np.trapezoid(power, nm) / np.trapezoid(power[inside], nm[inside])
    np.testing.assert_allclose(goniogram["factors"], 2.0 * ler, rtol=1e-3)
    assert len(warnings) == 1 and "radiant intensities: they are candela by" in warnings[0]


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda nm, power: (nm / 1000, power), "line 8: its spectrum is left out: wavelengths from"),
        (lambda nm, power: (nm[::-1], power), "line 9: its spectrum is left out: "),
        (lambda nm, power: (nm, -power), "its spectrum is left out: no power above zero"),
        (lambda nm, power: (nm[::40], power[::40]), "its spectrum is left out: "),
    ],
)
def test_bad_spectra_are_told_with_their_line(lamp, change, message):
    nm, power = change(*(np.asarray(lamp[name]) for name in ("wavelengths_nm", "power")))
    found, [warning] = gonio.read_goniogram(tm33(lamp, points=list(zip(nm, power, strict=True))), "lamp.xml")
    assert warning.startswith("lamp.xml: ") and message in warning
    assert "spectrum" not in found
    with pytest.raises(gonio.Error, match=r"lamp\.xml"):
        gonio.read_spectrum(tm33(lamp, points=list(zip(nm, power, strict=True))), "lamp.xml")
