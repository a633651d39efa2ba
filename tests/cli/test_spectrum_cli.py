"""`gonio spectrum`: figures, tables and drawings of lamps by name and of files that the test writes.

The figures of CIE's illuminants are those of colour-science 0.4.7 (x, CCT, Duv, Ra, Rf, Rg) and luxpy 1.12.5 (melanopic DER) of the same tables.
"""

import json
import math
import xml.etree.ElementTree as ET

import pictures
import pytest

KEYS = ("x", "cct", "duv", "ra", "rf", "rg", "melanopic_der")
LAMPS = {
    "A": (0.44756, 2855.7, 0.0000, 100, 100, 100, 0.4958),
    "FL11": (0.38052, 4000.7, 0.00015, 82.86, 80.04, 101.06, 0.5636),
    "LED-B3": (0.37566, 4102.5, -0.0006, 84.84, 85.32, 97.86, 0.6326),
    "LED-RGB1": (0.45576, 2839.5, 0.0043, 57.39, 71.00, 107.01, 0.5777),
    "E": (0.33331, 5455.5, -0.0044, 95.29, 94.71, 103.66, 0.9058),
}
TOLERANCES = (3e-4, 8, 2e-4, 0.5, 0.2, 0.2, 2e-3)


def facts(run, *arguments):
    return json.loads(run("spectrum", *arguments, "--json").stdout)


def planck(nm, kelvin):
    return nm**-5 / math.expm1(1.4388e7 / (nm * kelvin))


@pytest.fixture(scope="module")
def lamp(tmp_path_factory):
    """A blackbody of 3000 K, 380 to 780 nm, in mW as a German spreadsheet writes it."""
    path = tmp_path_factory.mktemp("lamp") / "lampe.csv"
    rows = [f"{nm},0;{1e17 * planck(nm, 3000):.6f}".replace(".", ",") for nm in range(380, 781, 5)]
    path.write_text("\n".join(["Lampe 7;12 W", "nm;mW", *rows, ""]))
    return path


@pytest.mark.parametrize("name", LAMPS)
def test_illuminants_have_their_figures(run, name):
    found = facts(run, name)
    for key, expected, tolerance in zip(KEYS, LAMPS[name], TOLERANCES, strict=True):
        assert found[key] == pytest.approx(expected, abs=tolerance), key
    assert found["name"] == f"CIE {name}" and len(found["r"]) == 15 and len(found["hue_bins"]) == 16
    assert found["ra"] == pytest.approx(sum(found["r"][:8]) / 8)
    assert found["alpha_opic"]["mel"]["der"] == found["melanopic_der"]


def test_a_file_of_a_blackbody(run, lamp):
    found = facts(run, lamp)
    assert (found["points"], found["first_nm"], found["last_nm"], found["notes"]) == (81, 380, 780, [])
    assert found["cct"] == pytest.approx(3000, abs=2)
    assert found["duv"] == pytest.approx(0, abs=1e-5)
    assert [found["ra"], found["rf"], found["rg"]] == pytest.approx([100, 100, 100], abs=0.05)
    text = run("spectrum", lamp).stdout
    for part in ("lampe.csv: 81 points from 380 to 780 nm", "Ra 100.0", "Rf 100.0, Rg 100.0", "melanopic DER: 0.5", "lm/W within 380 to 780 nm"):
        assert part in text


def test_several_lamps_make_a_table(run, lamp):
    lines = run("spectrum", "FL11", lamp, "2700K").stdout.splitlines()
    assert [line.split()[0] for line in lines] == ["lamp", "CIE", "lampe.csv", "blackbody"]
    assert "82.8" in lines[1]
    assert [found["source"] for found in facts(run, "FL11", lamp, "2700K")] == ["FL11", str(lamp), "2700K"]


def test_what_is_undefined_is_told(run, tmp_path):
    laser = tmp_path / "laser.txt"
    laser.write_text("".join(f"{nm} {math.exp(-(((nm - 532) / 2) ** 2)):.9f}\n" for nm in range(380, 781)))
    found = facts(run, laser)
    assert [found[key] for key in ("cct", "duv", "ra", "r", "rf", "rg", "hue_bins")] == [None] * 7
    assert found["x"] > 0 and found["ler"] > 500
    text = run("spectrum", laser).stdout
    assert "CCT, Duv, Ra, Rf, Rg: undefined" in text and "note: no CCT, Ra, Rf and Rg: Duv is +0." in text
    even = facts(run, "E")
    assert even["ra_in_range"] is False and "outside of CIE 13.3's range" in even["notes"][0]
    assert "Ra 95.3*" in run("spectrum", "E").stdout


def test_drawings(run, lamp, tmp_path):
    drawing, picture = tmp_path / "lamp.svg", tmp_path / "lamp.png"
    for path in (drawing, picture):
        run("spectrum", lamp, "-o", path)
    root = ET.parse(drawing).getroot()
    assert pictures.png_size(picture) == tuple(2 * int(root.get(side)) for side in ("width", "height"))
    texts = [element.text for element in root.iter("{http://www.w3.org/2000/svg}text")]
    assert "lampe.csv" in texts and any("Rf 100, Rg 100" in text for text in texts)


def test_tm27_is_read(run, tmp_path):
    path = tmp_path / "lamp.spdx"
    data = "".join(f'<SpectralData wavelength="{nm}">{1e17 * planck(nm, 4000):.6f}</SpectralData>\n' for nm in range(380, 781))
    inside = f"<SpectralQuantity>flux</SpectralQuantity><BandwidthFWHM>1</BandwidthFWHM>\n{data}"
    head = "<Header><Description>Street lamp</Description></Header>"
    document = f'<IESTM2714 xmlns="iestm2714" version="1.0">{head}<SpectralDistribution>{inside}</SpectralDistribution></IESTM2714>'
    path.write_text(document)
    found = facts(run, path)
    assert found["name"] == "Street lamp" and found["cct"] == pytest.approx(4000, abs=2)
    path.write_text(f"<!DOCTYPE a [<!ENTITY b 'c'>]>{document}")
    ended = run("spectrum", path)
    assert ended.returncode == 1 and "lamp.spdx" in ended.stderr and "not XML" in ended.stderr


def test_luminaires_of_tm33_are_read(run, tmp_path):
    """`gonio spectrum` has the figures of each spectrum, `gonio photometry` names it and keeps it in TM-33."""
    grid = "".join(f'<IntData h="0" v="{v}">100</IntData>' for v in (0, 90, 180))

    def spectrum(name, kelvin):
        rows = "".join(f'<PwrData w="{nm}">{1e17 * planck(nm, kelvin):.6f}</PwrData>\n' for nm in range(380, 781))
        return f"<EmitterSpectral><EmitterName>{name}</EmitterName><NumberWavelength>401</NumberWavelength>{rows}</EmitterSpectral>"

    def luminaire(spectra):
        data = f"<LuminousData><LuminousIntensity>{grid}</LuminousIntensity></LuminousData><SpectralData>{spectra}</SpectralData>"
        return f"<IESTM33-22><Version>1.1</Version>\n<Emitter><Description>lamp</Description>{data}</Emitter></IESTM33-22>"

    path = tmp_path / "lamp.xml"
    path.write_text(luminaire(spectrum("warm", 3000)))
    found = facts(run, path)
    assert found["name"] == "warm" and found["cct"] == pytest.approx(3000, abs=2)
    shown = run("photometry", path, "--convert", tmp_path / "again.xml").stdout
    assert "spectrum: 401 points from 380 to 780 nm" in shown
    assert facts(run, tmp_path / "again.xml")["cct"] == pytest.approx(found["cct"], abs=0.01)
    assert "a .ies file has no place for the spectrum" in run("photometry", path, "--convert", tmp_path / "again.ies").stdout
    told = json.loads(run("photometry", path, "--json").stdout)["spectrum"]
    assert told["name"] == "warm" and len(told["power"]) == 401
    path.write_text(luminaire(spectrum("warm", 3000) + spectrum("cold", 6000)))
    assert [round(lamp["cct"], -1) for lamp in json.loads(run("spectrum", path, "--json").stdout)] == [3000, 6000]
    path.write_text(luminaire(""))
    assert "no emitter with an <EmitterSpectral> was found" in run("spectrum", path).stderr


def test_errors_are_one_line_with_place(run, lamp, tmp_path):
    rows = [[nm, 1] for nm in range(380, 781, 5)]

    def broken(name, row, other):
        path = tmp_path / name
        path.write_text("\n".join(other if k == row else f"{nm};{power}" for k, (nm, power) in enumerate(rows, start=1)))
        return path

    for arguments, expected in [
        ((broken("nan.csv", 9, "420;nan"),), "nan.csv:9: power NaN at 420 nm"),
        ((broken("negative.csv", 9, "420;-5"),), "negative.csv:9: power -5 at 420 nm, expected none below zero"),
        ((broken("twice.csv", 9, "415;1"),), "twice.csv:9: 415 nm stands twice"),
        ((broken("falling.csv", 9, "400;1"),), "falling.csv:9: 400 nm after 415 nm"),
        ((broken("micrometres.csv", 1, "0.38;1"),), "micrometres.csv"),
        ((tmp_path / "none.csv",), "none.csv"),
        (("FL99",), "FL99: neither a file nor a name, which are A, E, D50"),
        (("D30",), "D30: daylight of 3002 K, expected 4000 to 25000 K"),
        ((lamp, "-o", tmp_path / "lamp.jpg"), "the ending is 'jpg', expected svg or png"),
        ((lamp, "A", "-o", tmp_path / "lamp.svg"), "one lamp is drawn, 2 were named"),
    ]:
        failed = run("spectrum", *arguments)
        assert failed.returncode == 1, arguments
        assert expected in failed.stderr
        assert len(failed.stderr.strip().split("\n")) == 1
    assert not list(tmp_path.glob("lamp.*"))
    assert run("spectrum").returncode == 2


def test_what_is_no_spectrum_ends_at_once(run, tmp_path):
    """Bombs, folders, devices and files of gigabytes."""
    parts = [10 * f"&a{k - 1};" for k in range(10)]
    laughs = "".join(f"<!ENTITY a{k} '{parts[k]}'>" for k in range(1, 10))
    bomb, folder, giant, three = (tmp_path / name for name in ("bomb.spdx", "folder.csv", "giant.csv", "three.csv"))
    bomb.write_text(f'<!DOCTYPE l [<!ENTITY a0 "lol">{laughs}]><IESTM2714>&a9;</IESTM2714>')
    folder.mkdir()
    with giant.open("wb") as file:
        file.truncate(1 << 30)
    three.write_text("380,1\n580,1\n780,1\n")
    for path, expected in ((bomb, "bomb.spdx:1: not XML"), (folder, "a folder was found"), (giant, "more than"), (three, "three.csv:1: 3 points")):
        failed = run("spectrum", path)
        assert failed.returncode == 1 and expected in failed.stderr and "Traceback" not in failed.stderr
        assert len(failed.stderr.strip().split("\n")) == 1
