"""Spectra of lamps in Python. Figures: colour-science 0.4.7 (CCT, Ra, Rf) and luxpy 1.12.5 (melanopic DER) of CIE 015:2018's tables."""

import gonio
import pytest


def test_illuminants_have_their_figures():
    lamp = gonio.illuminant("LED-B3")
    assert lamp["name"] == "CIE LED-B3" and len(lamp["power"]) == 81
    found = gonio.spectrum_figures(lamp["wavelengths_nm"], lamp["power"])
    assert found["cct"] == pytest.approx(4102.5, abs=4)
    assert found["ra"] == pytest.approx(84.84, abs=0.5)
    assert found["rf"] == pytest.approx(85.32, abs=0.2)
    assert found["melanopic_der"] == pytest.approx(0.6326, abs=2e-3)
    assert (len(found["r"]), len(found["hue_bins"]), found["ra_in_range"], found["notes"]) == (15, 16, True, [])


def test_files_are_read_from_bytes():
    data = "".join(f"{nm},0;{nm / 1000}\n".replace(".", ",") for nm in range(380, 781, 5)).encode()
    lamp = gonio.read_spectrum(data, "lamp.csv")
    assert lamp["wavelengths_nm"][0] == 380 and lamp["power"][-1] == 1 and lamp["name"] == "lamp.csv"
    with pytest.raises(gonio.FormatError, match="no number") as caught:
        gonio.read_spectrum(data.replace(b"0,4\n", b"x\n"), "lamp.csv")
    assert caught.value.line == 5


def test_light_that_is_not_white_has_none():
    wavelengths = list(range(380, 781))
    found = gonio.spectrum_figures(wavelengths, [float(nm == 532) for nm in wavelengths])
    assert [found[key] for key in ("cct", "ra", "r", "rf", "hue_bins")] == [None] * 5
    for wrong in ("FL99", "D30"):
        with pytest.raises(gonio.SettingError):
            gonio.illuminant(wrong)
    with pytest.raises(gonio.SettingError, match="stands twice"):
        gonio.spectrum_figures([400, 400, 500, 600, 700], [1] * 5)
