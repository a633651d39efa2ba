"""Surfaces that shine by a spectrum are lamps of that spectrum: at meters, in pictures, by light paths and by wavelength."""

import gonio
import numpy as np
import pytest
from test_colour_meters import QUANTITIES, assert_figures, figures_of, spectrum_of
from test_glowing_meshes import MADE, room


def panel(spectrum, nits=(1000.0,) * 3):
    """A panel of 1 m² over meters that look up to it, under nothing else."""
    made = gonio.Scene()
    points = np.array([[-0.5, -0.5, 2], [-0.5, 0.5, 2], [0.5, 0.5, 2], [0.5, -0.5, 2]], "f4")
    quad = np.array([[0, 1, 2], [0, 2, 3]], "i4")
    given = {} if spectrum is None else {"spectrum": spectrum}
    shining = made.add_material(base_color=(0,) * 3, specular_weight=0.0, emission_color=nits, **given)
    made.put_instances(made.add_mesh(points, quad), [shining], np.eye(4, dtype="f4").ravel(), light_group="Panel")
    return made


def measured(made, *quantities, samples=1024):
    for quantity in quantities:
        made.add_meter((0, 0, 0), facing=(0, 0, 1), quantity=quantity)
    return gonio.measure(made, samples=samples)


@pytest.mark.parametrize("name", ["LED-B3", "FL11", "HP1"])
def test_a_meter_sees_what_the_panel_is_of(name):
    found = measured(panel(name), *QUANTITIES, "melanopic-edi", "illuminance")
    assert_figures(found.meters[:5], figures_of(name))
    melanopic, lux = found.meters[5:]
    assert melanopic.value / lux.value == pytest.approx(figures_of(name)["melanopic_der"], rel=0.01)
    assert not found.diagnostics


@pytest.mark.parametrize("weight", [1.0, 0.5])
def test_mixes_do_not_shift_spectra(weight):
    """Materials of several closures before the panel's, and a panel that is one of weights."""
    made = gonio.Scene()
    half = {"weight": {"Constant": [0.5] * 4}, "model": "Diffuse"}
    made.put_material({"origin": "mix", "closures": [half, half]})
    lamp = gonio.illuminant("FL11")
    glow = {"weight": {"Constant": [weight] * 4}, "model": "Emission", "parameters": [["emission_color", {"Constant": [1000.0] * 4}]]}
    shining = {"origin": "glow", "closures": [glow], "spectrum": {key: lamp[key] for key in ("name", "wavelengths_nm", "power")}}
    points = np.array([[-0.5, -0.5, 2], [-0.5, 0.5, 2], [0.5, 0.5, 2], [0.5, -0.5, 2]], "f4")
    made.add_instance(made.add_mesh(points, np.array([[0, 1, 2], [0, 2, 3]], "i4")), [made.put_material(shining)])
    found = measured(made, *QUANTITIES, "melanopic-edi", "illuminance").meters
    assert_figures(found[:5], figures_of("FL11"))
    assert found[5].value / found[6].value == pytest.approx(figures_of("FL11")["melanopic_der"], rel=0.01)


def test_the_luminance_stays():
    """Colours count by their luminance alone, with wavelengths and without."""
    nits = (700.0, 1000.0, 1900.0)
    luminance = float(np.dot(nits, (0.2126, 0.7152, 0.0722)))
    plain = measured(panel(None, (luminance,) * 3), "illuminance").meters[0]
    for spectral in (False, True):
        made = panel("FL11", nits)
        made.set(spectral=spectral)
        found = measured(made, "illuminance").meters[0]
        assert found.value == pytest.approx(plain.value, rel=2e-3, abs=4 * found.standard_error + 4 * plain.standard_error)


@pytest.mark.parametrize("quantity", ["melanopic-edi", "ra"])
def test_a_panel_without_a_spectrum_is_refused(quantity):
    """As a lamp is: its colour does not tell these."""
    with pytest.raises(gonio.Error, match="material: it shines, and .* want its spectrum"):
        measured(panel(None), quantity)
    assert measured(panel(None), "cct").meters[0].value == pytest.approx(6504, abs=10)


def test_panels_and_lamps_mix():
    made = panel("LED-B1")
    made.add_light("sphere", (3000.0,) * 3, radius=0.2, transform=[[1, 0, 0, 0], [0, 1, 0, 1], [0, 0, 1, 2.5], [0, 0, 0, 1]], spectrum="FL11")
    both = measured(made, "cct").meters[0].colour
    parts = []
    for keep in (True, False):
        made = panel("LED-B1", (1000.0,) * 3 if keep else (0.0,) * 3)
        if not keep:
            made.add_light("sphere", (3000.0,) * 3, radius=0.2, transform=[[1, 0, 0, 0], [0, 1, 0, 1], [0, 0, 1, 2.5], [0, 0, 0, 1]], spectrum="FL11")
        parts.append(measured(made, "illuminance").meters[0].value)
    names = ("LED-B1", "FL11")
    fine = np.arange(380.0, 780.01, 0.5)
    power = 0
    for lux, name in zip(parts, names, strict=True):
        shape = np.interp(fine, *spectrum_of(name))
        power = power + lux * shape / (gonio.spectrum_figures(fine, shape)["ler"] * shape.sum())
    expected = gonio.spectrum_figures(fine, power)
    assert both["cct"] == pytest.approx(expected["cct"], abs=20 + 4 * both["standard_errors"]["cct"])
    assert both["melanopic_edi_lx"] == pytest.approx(sum(lux * figures_of(name)["melanopic_der"] for lux, name in zip(parts, names, strict=True)), rel=0.01)


@pytest.mark.parametrize("made", ["ramp", "stripe", "half_there"])
@pytest.mark.parametrize("settings", [{}, {"integrator": "light"}, {"spectral": True}], ids=["paths", "light", "spectral"])
def test_patterns_of_a_spectrum_light_as_much(made, settings):
    """Whatever knows the emission, constants, programs or light paths, the lux and the colour on the floor are those of the spectrum."""
    passes = ["color"] if settings.get("integrator") else ["color", "illuminance"]
    pictures = []
    for spectrum in (None, "FL4"):
        material = MADE[made]()[0]
        if spectrum is not None:
            lamp = gonio.illuminant(spectrum)
            material["spectrum"] = {key: lamp[key] for key in ("name", "wavelengths_nm", "power")}
        scene = room(material, samples=256, **{**settings, "passes": passes})
        with gonio.Render(scene) as render:
            assert render.wait()
            pictures.append(np.asarray(render.film()["color"])[..., :3].mean(axis=(0, 1)))
    plain, coloured = pictures
    weights = (0.2126, 0.7152, 0.0722)
    assert np.dot(coloured, weights) == pytest.approx(np.dot(plain, weights), rel=0.02)
    figures = figures_of("FL4")
    x, y, z = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]) @ coloured
    assert [x / (x + y + z), y / (x + y + z)] == pytest.approx([figures["x"], figures["y"]], abs=0.006 if settings.get("spectral") else 0.001)


def test_a_picture_by_wavelength_takes_another_panel():
    """A group of panels of one spectrum is relit as lamps are."""

    def by_wavelength(name):
        made = panel(name)
        made.add_camera([[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 0], [0, 0, 0, 1]], fov=20)
        made.set(width=4, height=4, samples=4, passes=["color", "lightgroup:Panel"])
        return gonio.spectral_picture(made, band=10)

    first, other = by_wavelength("LED-B3"), by_wavelength("FL2")
    relit = first.relit([("Panel", 1.0, gonio.illuminant("FL2"))])
    np.testing.assert_allclose(np.asarray(relit.radiance), np.asarray(other.radiance), rtol=2e-3, atol=1e-6)
