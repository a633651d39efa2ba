"""`gonio photometry` on GLDF: archives that the test writes with Python's zipfile."""

import json
import math
import zipfile

import pytest

FLUX_LM = 1000.0

PRODUCT = """<?xml version="1.0" encoding="utf-8"?>
<Root><Header><Manufacturer>ACME</Manufacturer><FormatVersion major="1" minor="0" pre-release="3"/></Header>
<GeneralDefinitions>
<Files><File id="f" contentType="ldc/eulumdat" type="localFileName">lamp.ldt</File>
<File id="w" contentType="document/pdf" type="url">https://example.org/lamp.pdf</File>
<File id="t" contentType="spectrum/text" type="localFileName">power.txt</File></Files>
<Photometries><Photometry id="p"><PhotometryFileReference fileId="f"/></Photometry></Photometries>
<Spectrums><Spectrum id="warm"><SpectrumFileReference fileId="t"/></Spectrum></Spectrums>
<LightSources><FixedLightSource id="led"><Name><Locale language="en">LED</Locale></Name><RatedInputPower>12.5</RatedInputPower>
<SpectrumReference spectrumId="warm"/><ColorInformation><ColorRenderingIndex>90</ColorRenderingIndex>
<CorrelatedColorTemperature>3000</CorrelatedColorTemperature></ColorInformation></FixedLightSource></LightSources>
<Emitters>
<Emitter id="low"><FixedLightEmitter emergencyBehaviour="Combined"><PhotometryReference photometryId="p"/>
<LightSourceReference fixedLightSourceId="led"/><RatedLuminousFlux>1000</RatedLuminousFlux>
<EmergencyBallastLumenFactor>0.1</EmergencyBallastLumenFactor></FixedLightEmitter></Emitter>
<Emitter id="high"><FixedLightEmitter><PhotometryReference photometryId="p"/>
<LightSourceReference fixedLightSourceId="led"/><RatedLuminousFlux>2500</RatedLuminousFlux></FixedLightEmitter></Emitter>
</Emitters></GeneralDefinitions>
<ProductDefinitions><ProductMetaData><Name><Locale language="de">Leuchte</Locale><Locale language="en">Lamp</Locale></Name></ProductMetaData>
<Variants>
<Variant id="a"><ProductNumber><Locale language="en">L-1000</Locale></ProductNumber><Name><Locale language="en">low</Locale></Name>
<Mountings><Ceiling><SurfaceMounted/></Ceiling></Mountings><Geometry><EmitterReference emitterId="low"/></Geometry></Variant>
<Variant id="b"><ProductNumber><Locale language="en">L-2500</Locale></ProductNumber><Name><Locale language="en">high</Locale></Name>
<Geometry><EmitterReference emitterId="high"/></Geometry></Variant>
</Variants></ProductDefinitions></Root>"""


def photometry():
    """A Lambertian downlight as EULUMDAT: lamps of 1000 lm, light output ratio 1."""
    angles = [i * 2.5 for i in range(37)]
    head = "inside;1;1;1;0;37;2.5;report 7;Downlight;DL-1;dl.ldt;today;200;0;50;180;0;0;0;0;0;100;100;1,0;0;1;-1;LED;1000;3000 K;90;10"
    candela = [1000 / math.pi * math.cos(math.radians(angle)) for angle in angles]
    values = [*head.split(";"), *["0.5"] * 10, 0, *angles, *candela]
    return "\r\n".join(str(value) for value in values)


def write(path, product=PRODUCT, **files):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("product.xml", product)
        archive.writestr("ldc/lamp.ldt", photometry())
        archive.writestr("spectrum/power.txt", "".join(f"{nm};{1 + (nm > 560)}\n" for nm in range(380, 781, 20)))
        for name, content in files.items():
            archive.writestr(name, content)
    return path


@pytest.fixture(scope="module")
def lamp(tmp_path_factory):
    return write(tmp_path_factory.mktemp("gldf") / "lamp.gldf")


def test_variants_are_listed(run, lamp):
    text = run("photometry", lamp).stdout
    for part in (
        "manufacturer: ACME",
        "product: Lamp",
        "file: GLDF 1.0-rc.3, 3 files, 2 variants",
        "variant 1: low (L-1000): 1000.0 lm, 12.5 W, 80.0 lm/W",
        "emitter low: LED, ldc/lamp.ldt, 1000 lm rated, 12.5 W, 3000 K, Ra 90, spectrum warm, in emergencies too, times 0.1",
        "in emergencies: 100.0 lm",
        "mounting: ceiling, surface mounted",
        "variant 2: high (L-2500): 2500.0 lm",
        "the product rates it 2500 lm: that counts",
        "spectrum warm: spectrum/power.txt",
        "not in the archive, and not fetched: https://example.org/lamp.pdf",
    ):
        assert part in text, part


def test_listing_for_machines(run, lamp):
    found = json.loads(run("photometry", lamp, "--json").stdout)
    assert found["manufacturer"] == "ACME"
    assert found["name"] == {"de": "Leuchte", "en": "Lamp"}
    assert [variant["flux_lm"] for variant in found["variants"]] == pytest.approx([1000, 2500])
    assert found["variants"][0]["emergency_flux_lm"] == pytest.approx(100)
    light = found["variants"][1]["emitters"][0]["lights"][0]
    assert (light["photometry"], light["rated_flux_lm"], light["cct_k"], light["ra"]) == ("ldc/lamp.ldt", 2500, 3000, 90)
    assert found["files"][1]["url"] == "https://example.org/lamp.pdf"


@pytest.mark.parametrize("how", [("--variant", "high"), ("--variant", "L-2500"), ("--variant", "2"), ("#HIGH",)])
def test_a_variant_is_chosen(run, lamp, how):
    file = f"{lamp}{how[0]}" if len(how) == 1 else lamp
    found = json.loads(run("photometry", file, *(how if len(how) == 2 else ()), "--json").stdout)
    assert found["flux_lm"] == pytest.approx(2500)
    assert found["peak_cd"] == pytest.approx(2500 / math.pi, rel=1e-3)
    assert found["watts"] == 12.5
    assert ["LUMCAT", "L-2500"] in found["header"]


@pytest.mark.parametrize("ending", ["ies", "ldt"])
def test_a_variant_is_converted(run, lamp, tmp_path, ending):
    file = tmp_path / f"high.{ending}"
    assert run("photometry", lamp, "--variant", "high", "--convert", file).returncode == 0
    assert json.loads(run("photometry", file, "--json").stdout)["flux_lm"] == pytest.approx(2500, rel=1e-4)


def test_names_that_are_none(run, lamp, tmp_path):
    wrong = run("photometry", lamp, "--variant", "wide")
    assert wrong.returncode == 1
    assert "no variant 'wide' was found among 2: 'low', 'high'" in wrong.stderr
    plain = tmp_path / "lamp.ldt"
    plain.write_text(photometry())
    assert "the file is no GLDF or GDTF archive" in run("photometry", plain, "--variant", "wide").stderr


@pytest.mark.parametrize(
    ("product", "message"),
    [
        ("<Root>\n</Rot>", "product.xml: line 2: not XML"),
        ("<Product/>", "product.xml: line 1: <Product> was found, expected GLDF's <Root>"),
        ('<!DOCTYPE Root [<!ENTITY a "aa">]>\n<Root>&a;</Root>', "product.xml: line 1: not XML"),
        (PRODUCT.replace(">lamp.ldt<", ">gone.ldt<"), "ldc/gone.ldt: is not in the archive"),
        (PRODUCT.replace('photometryId="p"', 'photometryId="q"'), "no photometry 'q' is defined"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(run, tmp_path, product, message):
    found = run("photometry", write(tmp_path / "wrong.gldf", product), "--variant", "1")
    assert found.returncode == 1
    assert message in found.stderr


def test_archives_without_a_product(run, tmp_path):
    file = tmp_path / "no.gldf"
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("other.txt", "x")
    found = run("photometry", file)
    assert found.returncode == 1
    assert "no product.xml is in the archive, expected one in a GLDF file; it holds 'other.txt'" in found.stderr


def test_spectra_of_a_product(run, lamp):
    found = json.loads(run("spectrum", lamp, "--json").stdout)
    assert (found["points"], found["first_nm"], found["last_nm"]) == (21, 380, 780)


def test_roads_take_a_variant(run, lamp, tmp_path):
    write(tmp_path / "lamp.gldf")
    run("photometry", lamp, "--variant", "high", "--convert", tmp_path / "high.ldt")
    road = """[road]
carriageway_width = 7.0
lanes = 2
surface = "lambert"
reflectance = 0.2
[[row]]
luminaire = "{}"
spacing = 30
height = 8
overhang = 0.5
side = "right"
"""
    found = []
    for number, name in enumerate(("lamp.gldf#high", "high.ldt")):
        file = tmp_path / f"road{number}.toml"
        file.write_text(road.format(name))
        found.append(json.loads(run("road", file, "--json").stdout))
    names = [name for name in found[0] if isinstance(found[0][name], float)]
    assert names
    for name in names:
        assert found[0][name] == pytest.approx(found[1][name], rel=1e-4), name
