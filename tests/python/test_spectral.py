"""Light with wavelengths: lamps by spectrum, colours as spectra, thin films, dispersion and melanopic light against closed forms."""

import math

import gonio
import numpy as np
import pytest

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
CORNERS = np.array([[0, 1, 2], [0, 2, 3]], np.int32)


def line(nm: float) -> tuple[list[float], list[float]]:
    """A lamp of one line, which is a nanometre or two wide."""
    return [nm - 2, nm - 1, nm, nm + 1, nm + 2], [0, 1, 1, 1, 0]


def scene(size: float = 1.0, **settings) -> tuple[gonio.Scene, int]:
    """A square about the origin, seen from above, and the number of its mesh."""
    made = gonio.Scene()
    square = made.add_mesh(SQUARE * np.float32(size), CORNERS)
    made.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]], fov=1.0)
    made.set(width=8, height=8, samples=512, spectral=True, **settings)
    return made, square


def rgb(made: gonio.Scene) -> np.ndarray:
    """What the picture shows, pixel by pixel."""
    with gonio.Render(made) as rendering:
        rendering.wait()
        return np.asarray(rendering.film()["color"], float)[..., :3]


def lit(colour, **lamp) -> np.ndarray:
    """The mean of a matt surface of a colour under an even dome."""
    made, square = scene()
    made.add_instance(square, [made.add_material(base_color=colour, specular_weight=0.0)])
    made.add_light("dome", **lamp)
    return rgb(made).mean(axis=(0, 1))


def luminance(colour) -> float:
    return float(np.dot(colour, (0.2126, 0.7152, 0.0722)))


def chromaticity(colour) -> np.ndarray:
    """x, y of linear Rec.709."""
    xyz = np.array([[0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923], [0.0193308, 0.1191948, 0.9505322]]) @ colour
    return xyz[:2] / xyz.sum()


def test_grey_scenes_have_no_colour():
    made, square = scene()
    made.add_instance(square, [made.add_material(base_color=0.5, specular_roughness=0.4)])
    made.add_light("dome", (0.3, 0.3, 0.3))
    made.add_light("sphere", (50.0, 50.0, 50.0), radius=0.3, transform=[[1, 0, 0, 1], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]])
    made.set(samples=4)
    found = rgb(made)
    # Each path's three wavelengths are white together: noise there is, but none of it in colour.
    assert found.std() > 1e-4
    assert np.abs(found - found[..., 1:2]).max() < 2e-5 * found.max()


@pytest.mark.parametrize("colour", [(0.6, 0.1, 0.05), (0.1, 0.5, 0.2), (0.05, 0.1, 0.7), (0.8, 0.7, 0.1), (0.02, 0.02, 0.03)])
def test_colours_under_daylight_are_those_of_rgb(colour):
    assert lit(colour) == pytest.approx(colour, rel=0.01, abs=0.003)


@pytest.mark.parametrize("nm", [450, 520, 546, 600, 640])
def test_colours_reflect_as_their_spectra_do(nm):
    colour = (0.7, 0.3, 0.1)
    lamp = {"spectrum": line(nm)}
    share = luminance(lit(colour, **lamp)) / luminance(lit((1.0, 1.0, 1.0), **lamp))
    assert share == pytest.approx(gonio.colour_reflectance(colour, [nm])[0], abs=0.01)


@pytest.mark.parametrize("name", ["A", "LED-B3", "FL2", "D50"])
def test_a_lamp_has_the_colour_of_its_spectrum(name):
    figures = gonio.spectrum_figures(*(gonio.illuminant(name)[key] for key in ("wavelengths_nm", "power")))
    for spectral in (False, True):
        made, square = scene()
        made.add_instance(square, [made.add_material(base_color=1.0, specular_weight=0.0)])
        made.add_light("dome", (2.0, 2.0, 2.0), spectrum=name)
        made.set(spectral=spectral, samples=2048)
        found = rgb(made).mean(axis=(0, 1))
        assert luminance(found) == pytest.approx(2.0, rel=0.01)
        assert chromaticity(found) == pytest.approx([figures["x"], figures["y"]], abs=0.003)


def test_metamers_part_under_another_lamp():
    # Two greys to the eye by day: one even, one of two colours that make it up.
    grey = lit((0.5, 0.5, 0.5), spectrum="LED-B1")
    assert grey / grey.sum() == pytest.approx(lit((1.0,) * 3, spectrum="LED-B1") / lit((1.0,) * 3, spectrum="LED-B1").sum(), abs=2e-3)
    # Under sodium's light a blue and a red of one luminance differ by far more than they do by day.
    red, blue = (0.5, 0.08, 0.05), (0.05, 0.1, 0.5)
    by_day = luminance(lit(red)) / luminance(lit(blue))
    by_sodium = luminance(lit(red, spectrum="HP1")) / luminance(lit(blue, spectrum="HP1"))
    assert by_sodium > 1.5 * by_day


def airy(nm: float, thickness: float, indices) -> float:
    """Reflectance straight on of a film between two media."""
    before, film, behind = indices
    r1, r2 = (before - film) / (before + film), (film - behind) / (film + behind)
    turn = np.exp(4j * math.pi * film * thickness / nm)
    return float(abs((r1 + r2 * turn) / (1 + r1 * r2 * turn)) ** 2)


@pytest.mark.parametrize("thickness", [180.0, 550.0, 1500.0])
@pytest.mark.parametrize("nm", [450, 550, 650])
def test_thin_films_are_airys(nm, thickness):
    found = []
    for weight in (1.0, 0.0):
        made, square = scene()
        glossy = {"base_color": 0.0, "specular_roughness": 0.0, "specular_ior": 1.5}
        film = {"thin_film_weight": weight, "thin_film_ior": 1.33, "thin_film_thickness": thickness}
        made.add_instance(square, [made.add_material(**glossy, **film)])
        made.add_light("dome", spectrum=line(nm))
        found.append(luminance(rgb(made).mean(axis=(0, 1))))
    bare = ((1.5 - 1) / (1.5 + 1)) ** 2
    # A line is four nanometres wide: thick films turn a little within it.
    steps = np.linspace(-2.0, 2.0, 81)
    expected = np.average([airy(nm + step, thickness, (1.0, 1.33, 1.5)) for step in steps], weights=np.interp(steps, [-2, -1, 1, 2], [0, 1, 1, 0]))
    assert found[0] / found[1] == pytest.approx(expected / bare, rel=0.005)


def cauchy(nm: float, index: float, abbe: float) -> float:
    """By the index at the d line and the Abbe number."""
    rise = (index - 1) / abbe / (486.13**-2 - 656.27**-2)
    return index + rise * (nm**-2 - 587.56**-2)


@pytest.mark.parametrize(("nm", "is_seen"), [(450, True), (650, False)])
def test_glass_bends_by_wavelength(nm, is_seen):
    """Through a face of glass, seen at 60°, blue and red rays land on both sides of an edge below."""
    index, abbe, depth = 1.6, 15.0, 1.0
    sine = math.sin(math.radians(60))
    blue, red = (depth * math.tan(math.asin(sine / cauchy(at, index, abbe))) for at in (450, 650))
    edge = 0.5 * (blue + red)
    assert red - blue > 0.02
    made = gonio.Scene()
    face = made.add_mesh(SQUARE * np.float32(50), CORNERS)
    glass = {"transmission_weight": 1.0, "specular_roughness": 0.0, "specular_ior": index}
    made.add_instance(face, [made.add_material(**glass, transmission_dispersion=1 / abbe)])
    # The floor glows up to the edge, which faces -x of where the rays come from.
    strip = np.array([[-40, -40, -depth], [edge, -40, -depth], [edge, 40, -depth], [-40, 40, -depth]], np.float32)
    made.add_instance(made.add_mesh(strip, CORNERS), [made.add_material(base_color=1.0, specular_weight=0.0)])
    made.add_light("sphere", (1e4,) * 3, radius=0.2, spectrum=line(nm), transform=[[1, 0, 0, -5], [0, 1, 0, 0], [0, 0, 1, -0.5], [0, 0, 0, 1]])
    # Looking along +x and down by 30°, at the origin of the face.
    back, up = np.array([-sine, 0, 0.5]), np.array([0.5, 0, sine])
    made.add_camera(gonio.look_at(tuple(3 * back), (0, 0, 0), up=tuple(up)), fov=0.05)
    made.set(width=4, height=4, samples=512, spectral=True, caustics="off")
    found = luminance(rgb(made).mean(axis=(0, 1)))
    assert (found > 1e-3) == is_seen, found


@pytest.mark.parametrize(("name", "ratio"), [("LED-B3", 0.6326), ("LED-B5", 0.8552), ("A", 0.4958), ("D65", 1.0), ("E", 0.9058)])
def test_melanopic_light_at_the_eye(name, ratio):
    made = gonio.Scene()
    made.add_light("sphere", (1000.0,) * 3, radius=0.5, spectrum=name, transform=[[1, 0, 0, 0], [0, 1, 0, 5], [0, 0, 1, 1.2], [0, 0, 0, 1]])
    for quantity in ("illuminance", "melanopic-edi"):
        made.add_meter((0, 0, 1.2), normal=(0, 1, 0), facing=(0, 1, 0), quantity=quantity)
    made.set(samples=4096)
    lux, melanopic = (reading.value for reading in gonio.measure(made).meters)
    assert melanopic / lux == pytest.approx(ratio, rel=0.01)


def test_lamps_without_a_spectrum_have_no_melanopic_figure():
    made = gonio.Scene()
    made.add_light("sphere", (1000.0,) * 3, name="warm lamp")
    made.add_meter((0, 0, 1.2), quantity="melanopic-edi")
    with pytest.raises(gonio.Error, match="warm lamp.*spectrum"):
        gonio.measure(made)


@pytest.mark.parametrize("wrong", ["LED-B33", ([500, 400, 300, 200, 100], [1] * 5), ([400, 500, 600, 700, 800], [1, 1, -1, 1, 1])])
def test_what_is_no_spectrum_is_told(wrong):
    made, square = scene()
    made.add_instance(square, [made.add_material()])
    if isinstance(wrong, str):
        with pytest.raises(gonio.Error, match="LED-B33"):
            made.add_light("dome", spectrum=wrong)
        return
    made.add_light("dome", spectrum=wrong, name="odd dome")
    with gonio.Render(made) as rendering:
        rendering.wait()
        told = [message for message in rendering.diagnostics if "spectrum" in str(message)]
        picture = np.asarray(rendering.film()["color"])
    assert len(told) == 1 and "odd dome" in str(told[0])
    assert picture[..., :3].max() > 0
