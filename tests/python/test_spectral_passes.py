"""Light groups and illuminance by wavelength: other lamps in a finished picture, and figures of the light on surfaces."""

import gonio
import numpy as np
import pytest

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
CORNERS = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
WARM, COOL = "LED-B1", "FL11"


def place(*position):
    matrix = np.eye(4)
    matrix[:3, 3] = position
    return matrix


def room(warm=WARM, cool=COOL, passes=("color", "illuminance", "luminance", "lightgroup:Warm", "lightgroup:Cool"), samples=16):
    """A coloured corner of two squares under a lamp from each side."""
    made = gonio.Scene()
    square = made.add_mesh(SQUARE, CORNERS)
    made.add_instance(square, [made.add_material(base_color=(0.7, 0.3, 0.15), specular_weight=0.0)])
    upright = np.array([[1, 0, 0, 0], [0, 0, 1, 1], [0, -1, 0, 1], [0, 0, 0, 1]], float)
    made.add_instance(square, [made.add_material(base_color=(0.2, 0.4, 0.7), specular_weight=0.0)], transform=upright)
    made.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1]], fov=20.0)
    made.add_light("sphere", (2e4,) * 3, radius=0.05, spectrum=warm, group="Warm", transform=place(-0.5, 0, 1.5))
    made.add_light("sphere", (1e4,) * 3, radius=0.05, spectrum=cool, group="Cool", transform=place(0.5, 0, 1.5))
    made.set(width=16, height=12, samples=samples, spectral=True, passes=list(passes), caustics="off")
    return made


def lamp(name):
    found = gonio.illuminant(name)
    return found["wavelengths_nm"], found["power"]


def radiance(picture, name="color"):
    return np.asarray(picture.layer(name))


def test_groups_make_the_colour_together():
    picture = gonio.spectral_picture(room(), band=20.0)
    assert picture.names == ["color", "illuminance", "lightgroup:Warm", "lightgroup:Cool"]
    whole, parts = radiance(picture), [radiance(picture, f"lightgroup:{name}") for name in ("Warm", "Cool")]
    np.testing.assert_allclose(parts[0] + parts[1], whole, rtol=1e-4, atol=1e-7 * whole.max())
    np.testing.assert_array_equal(whole, np.asarray(picture.radiance))
    with pytest.raises(gonio.Error, match="expected one of color, illuminance"):
        picture.layer("depth")


@pytest.mark.parametrize("band", [5.0, 20.0])
def test_other_lamps_are_as_if_they_had_been_there(band):
    """The same random numbers: a relit picture is that of the other lamps but for what bands make of the walls' spectra."""
    relit = gonio.spectral_picture(room(), band=band).relit([("Warm", 1.0, lamp("LED-V1")), ("Cool", 1.0, lamp("D50"))])
    there = gonio.spectral_picture(room("LED-V1", "D50"), band=band)
    for name in ("color", "lightgroup:Warm", "lightgroup:Cool"):
        expected = radiance(there, name)
        np.testing.assert_allclose(radiance(relit, name), expected, rtol=1e-3, atol=1e-5 * expected.max(), err_msg=name)
    np.testing.assert_allclose(np.asarray(relit.color), np.asarray(there.color), rtol=1e-3)
    # FL11's table begins at 380 nm and ends at 780 nm, as the pictures do.
    assert relit.diagnostics == [] and relit.names == ["color", "lightgroup:Warm", "lightgroup:Cool"]


def test_back_and_forth_is_nothing():
    picture = gonio.spectral_picture(room(), band=10.0)
    there = picture.relit([("Warm", 2.0, lamp("A"))])
    back = there.relit([("Warm", 0.5, gonio.illuminant(WARM))])
    np.testing.assert_allclose(radiance(back), radiance(picture), rtol=1e-5)
    factors = picture.relit([("Cool", 0.0, None)])
    np.testing.assert_array_equal(radiance(factors), radiance(picture, "lightgroup:Warm"))


def test_where_a_lamp_had_no_light_is_told():
    nm = np.arange(380.0, 781.0, 10.0)
    narrow = (nm, np.where((nm > 440) & (nm < 560), 1.0, 0.0))
    picture = gonio.spectral_picture(room(warm=narrow, samples=128), band=20.0)
    relit = picture.relit([("Warm", 1.0, lamp("E"))])
    assert len(relit.diagnostics) == 1 and "'Warm' had no light in 14 bands within 380 to 780 nm" in relit.diagnostics[0][1]
    there = radiance(gonio.spectral_picture(room(warm="E", samples=128), band=20.0), "lightgroup:Warm")
    nm = np.asarray(picture.wavelengths_nm)
    seen = (nm > 440) & (nm < 560)
    # Lights are chosen by their colours too, so that the noise is another.
    means = [picture[..., seen].mean(axis=(0, 1)) for picture in (radiance(relit, "lightgroup:Warm"), there)]
    np.testing.assert_allclose(*means, rtol=0.02)
    assert (radiance(relit, "lightgroup:Warm") > 0).any(axis=(0, 1)).all()


def test_lamps_that_are_not_known_are_refused():
    made = room()
    made.add_light("sphere", (1e4,) * 3, radius=0.05, spectrum="A", group="Warm", transform=place(0, 0.5, 1.5))
    picture = gonio.spectral_picture(made, band=20.0)
    with pytest.raises(gonio.Error, match="'Warm' send is not known"):
        picture.relit([("Warm", 1.0, lamp("D50"))])
    assert picture.relit([("Warm", 0.5, None), ("Cool", 1.0, lamp("D50"))]).diagnostics == []
    with pytest.raises(gonio.Error, match="no light group 'Kitchen', expected one of Warm, Cool"):
        picture.relit([("Kitchen", 1.0, None)])
    with pytest.raises(gonio.Error, match="from 0 on"):
        picture.relit([("Warm", -1.0, None)])
    with pytest.raises(gonio.Error, match="no light groups by wavelength"):
        gonio.spectral_picture(room(passes=("color",)), band=20.0).relit([("Warm", 1.0, None)])


def test_lamps_of_one_colour_are_known_without_a_spectrum():
    """White lamps are daylight D65; a lamp of a colour has the colour's spectrum."""
    for colour in ((1.0, 1.0, 1.0), (1.0, 0.6, 0.3)):
        made = room()
        made.add_light("sphere", tuple(2e4 * part for part in colour), radius=0.05, group="Third", transform=place(0, 0.5, 1.5))
        made.set(passes=["color", "lightgroup:Third"])
        relit = gonio.spectral_picture(made, band=20.0).relit([("Third", 1.0, lamp("D65"))])
        white = room()
        luminance = 2e4 * float(np.dot(colour, (0.2126, 0.7152, 0.0722)))
        white.add_light("sphere", (luminance,) * 3, radius=0.05, group="Third", transform=place(0, 0.5, 1.5))
        white.set(passes=["color", "lightgroup:Third"])
        expected = radiance(gonio.spectral_picture(white, band=20.0), "lightgroup:Third")
        np.testing.assert_allclose(radiance(relit, "lightgroup:Third"), expected, rtol=5e-3, atol=1e-3 * expected.max())


def test_light_that_is_in_no_group_is_told():
    relit = gonio.spectral_picture(room(passes=("color", "lightgroup:Warm")), band=20.0).relit([])
    assert "of the light belongs to no group" in relit.diagnostics[0][1]


@pytest.mark.parametrize("name", ["LED-B3", "FL11"])
def test_figures_of_the_light_on_surfaces(name):
    """In an empty place they are the lamp's, and the illuminance is that of a picture without wavelengths."""
    made = gonio.Scene()
    made.add_instance(made.add_mesh(SQUARE, CORNERS), [made.add_material(base_color=(0.7, 0.2, 0.1), specular_weight=0.0)])
    made.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1]], fov=10.0)
    made.add_light("sphere", (2e4,) * 3, radius=0.05, spectrum=name, transform=place(0, 0, 1.5))
    made.set(width=8, height=8, samples=16, spectral=True, passes=["color", "illuminance"], max_bounces=0)
    picture = gonio.spectral_picture(made, band=5.0)
    found = gonio.illuminant(name)
    lamp = gonio.spectrum_figures(found["wavelengths_nm"], found["power"])
    for figure, tolerance in (("ra", 0.3), ("rf", 0.3), ("rg", 0.3)):
        values = np.asarray(picture.light_figure(figure))
        np.testing.assert_allclose(values, lamp[figure], atol=tolerance, err_msg=figure)
    with gonio.Render(made) as rendering:
        rendering.wait()
        lux = np.asarray(rendering.film()["illuminance"]).mean()
    by_wavelength = np.asarray(picture.light_figure("melanopic-edi")).mean()
    assert by_wavelength == pytest.approx(lamp["melanopic_der"] * lux, rel=0.02)


def test_figures_have_their_ranges():
    picture = gonio.spectral_picture(room(), band=20.0)
    with pytest.raises(gonio.Error, match="5 or 10 nm"):
        picture.light_figure("ra")
    assert np.asarray(picture.light_figure("melanopic-edi")).min() >= 0.0
    with pytest.raises(gonio.Error, match="ra, rf, rg, melanopic-edi"):
        picture.light_figure("cct")
    with pytest.raises(gonio.Error, match="lacks illuminance"):
        gonio.spectral_picture(room(passes=("color",)), band=20.0).light_figure("melanopic-edi")
    # Sodium's light is further from its reference than CIE 13.3 allows for (HP1: 0.0055 in Duv); TM-30 has no such limit.
    made = room("E", "E", passes=("color", "illuminance"))
    picture = gonio.spectral_picture(made, band=10.0)
    assert np.isfinite(np.asarray(picture.light_figure("rf"))).all()


def test_passes_without_wavelengths_are_told():
    picture = gonio.spectral_picture(room(passes=("color", "depth", "normal")), band=20.0)
    assert picture.names == ["color"]
    assert any("left out: depth, normal" in text for _, text in picture.diagnostics)
