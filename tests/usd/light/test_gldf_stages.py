"""Lights of GLDF files in stages: the variant that a prim names, at its rated flux."""

import math
import zipfile

import pytest
from test_photometric_lights import load, lux, write_ldt

PRODUCT = """<Root><Header><Manufacturer>ACME</Manufacturer></Header><GeneralDefinitions>
<Files><File id="f" contentType="ldc/eulumdat" type="localFileName">globe.ldt</File></Files>
<Photometries><Photometry id="p"><PhotometryFileReference fileId="f"/></Photometry></Photometries>
<LightSources><FixedLightSource id="led"><RatedInputPower>10</RatedInputPower></FixedLightSource></LightSources>
<Emitters>{emitters}</Emitters></GeneralDefinitions><ProductDefinitions><Variants>{variants}</Variants></ProductDefinitions></Root>"""
EMITTER = """<Emitter id="e{flux}"><FixedLightEmitter><PhotometryReference photometryId="p"/>
<LightSourceReference fixedLightSourceId="led"/><RatedLuminousFlux>{flux}</RatedLuminousFlux></FixedLightEmitter></Emitter>"""
VARIANT = """<Variant id="v{flux}"><Name><Locale language="en">{flux} lm</Locale></Name>
<Geometry><EmitterReference emitterId="e{flux}"/></Geometry></Variant>"""


@pytest.fixture
def lamp(tmp_path):
    """An even luminaire of 500 lm and one of 2000 lm."""
    write_ldt(tmp_path / "globe.ldt")
    parts = ("".join(text.format(flux=flux) for flux in (500, 2000)) for text in (EMITTER, VARIANT))
    with zipfile.ZipFile(tmp_path / "lamp.gldf", "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("product.xml", PRODUCT.format(emitters=next(parts), variants=next(parts)))
        archive.write(tmp_path / "globe.ldt", "ldc/globe.ldt")
    return tmp_path


@pytest.mark.parametrize(("variant", "flux"), [("", 500), ("2000 lm", 2000), ("v500", 500), ("2", 2000)])
@pytest.mark.parametrize("name", ["gonio:photometry:file", "inputs:shaping:ies:file"])
def test_a_prim_names_its_variant(lamp, variant, flux, name):
    body = f'asset {name} = @lamp.gldf@\n    string gonio:photometry:variant = "{variant}"'
    if name.startswith("inputs"):
        # A factor on a radiance of 1 of a sphere of radius 0.01 m: the ratio of two variants is what counts.
        body += "\n    float inputs:radius = 0.01"
        whole = lux(load(lamp, "SphereLight", body.replace(f'"{variant}"', '"v500"')))
        assert lux(load(lamp, "SphereLight", body)) == pytest.approx(whole * flux / 500, rel=2e-3)
        return
    assert lux(load(lamp, "SphereLight", body)) == pytest.approx(flux / (4 * math.pi), rel=2e-3)


def test_what_is_chosen_unasked_and_what_is_not_there_are_told(lamp):
    scene = load(lamp, "SphereLight", "asset gonio:photometry:file = @lamp.gldf@")
    assert "the first of 2 variants is taken, '500 lm'" in str(scene.diagnostics)
    body = 'asset gonio:photometry:file = @lamp.gldf@\n    string gonio:photometry:variant = "wide"'
    assert "no variant 'wide' was found among 2: '500 lm', '2000 lm'" in str(load(lamp, "SphereLight", body).diagnostics)


def test_a_luminaires_spectrum_is_its_lights(tmp_path):
    """A meter of colour has the figures of the spectrum in the file; one that cannot be used is told with the prim, the file and the line."""
    import gonio

    lamp = gonio.illuminant("LED-B3")
    grid = "".join(f'<IntData h="0" v="{v}">100</IntData>' for v in (0, 90, 180))
    rows = "".join(f'\n<PwrData w="{nm}">{power}</PwrData>' for nm, power in zip(lamp["wavelengths_nm"], lamp["power"], strict=True))
    spectral = f"<SpectralData><EmitterSpectral>{rows}</EmitterSpectral></SpectralData>"
    luminous = f"<LuminousData><LuminousIntensity>{grid}</LuminousIntensity></LuminousData>"
    path = tmp_path / "lamp.xml"
    path.write_text(f"<IESTM33-22><Emitter><Description>lamp</Description>{luminous}{spectral}</Emitter></IESTM33-22>")
    body = "asset gonio:photometry:file = @lamp.xml@"
    scene = load(tmp_path, "SphereLight", body)
    scene.add_meter((0, 0, 0.01), normal=(0, 0, 1), quantity="cct")
    [reading] = gonio.measure(scene, samples=256).meters
    assert reading.value == pytest.approx(gonio.spectrum_figures(lamp["wavelengths_nm"], lamp["power"])["cct"], abs=0.5)
    path.write_text(path.read_text().replace('w="500.0"', 'w="400"'))
    told = str(load(tmp_path, "SphereLight", body).diagnostics)
    assert "lamp.xml" in told and "its spectrum is left out: 400 nm after" in told
