"""Laws of optics by wavelength, in double precision: prisms, films, gold, metamers of surfaces and of lamps.

All to half a percent and the noise.
"""

import math

import gonio
import numpy as np
import pytest
from spectral_sums import NM, OBSERVER, by_band, colour, lamp, seen

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
CORNERS = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
PART = 0.005
ERRORS = 4.0
LAMPS = ("D65", "A", "FL11", "LED-B3", "LED-RGB1", "HP1")


def sheet(degrees: float = 0.0, spectrum="E", **material) -> gonio.Scene:
    """A surface below an even dome of luminance 1, seen at an angle from its normal."""
    made = gonio.Scene()
    made.add_instance(made.add_mesh(SQUARE, CORNERS), [made.add_material(**material)])
    sine, cosine = math.sin(math.radians(degrees)), math.cos(math.radians(degrees))
    made.add_camera([[1, 0, 0, 0], [0, cosine, -sine, -2 * sine], [0, sine, cosine, 2 * cosine], [0, 0, 0, 1]], fov=0.01)
    made.add_light("dome", spectrum=spectrum)
    return made


APEX, INDEX, ABBE = math.radians(60.0), 1.5168, 20.0
# The screen's distance and half its width: so far that it does not matter where a ray leaves the prism.
FAR, HALF = 1e4, 3e3


def cauchy(nm: float) -> float:
    return INDEX + (INDEX - 1) / ABBE * (nm**-2 - 587.56**-2) / (486.13**-2 - 656.27**-2)


def least_deviation(nm: float) -> float:
    """2 asin(n sin(A/2)) - A."""
    return 2 * math.asin(cauchy(nm) * math.sin(APEX / 2)) - APEX


def through_prism(incidence: float, aim: float, *, is_ramp: bool) -> gonio.Scene:
    """A ray along +x that a prism sends down, towards a screen at an angle `aim` below, which glows evenly or brighter downwards."""
    made = gonio.Scene()
    section = np.array([(0, 0), (-math.sin(APEX / 2), -math.cos(APEX / 2)), (math.sin(APEX / 2), -math.cos(APEX / 2))]) + [0, 0.5]
    turn = APEX / 2 - incidence
    section = section @ np.array([[math.cos(turn), math.sin(turn)], [-math.sin(turn), math.cos(turn)]])
    points = np.array([(x, y, z) for z in (-1, 1) for x, y in section], np.float32)
    faces = np.array([(2, 1, 0), (4, 5, 3), (4, 3, 0), (1, 4, 0), (5, 4, 1), (2, 5, 1), (3, 5, 2), (0, 3, 2)], np.int32)
    glass = {"transmission_weight": 1.0, "specular_roughness": 0.0, "specular_ior": INDEX, "transmission_dispersion": 1 / ABBE}
    made.add_instance(made.add_mesh(points, faces), [made.add_material(**glass)])
    middle = FAR * np.array([math.cos(aim), -math.sin(aim), 0])
    down, side = HALF * np.array([-math.sin(aim), -math.cos(aim), 0]), np.array([0, 0, HALF])
    screen = np.array([middle - down - side, middle + down - side, middle + down + side, middle - down + side], np.float32)
    # Between the middles of two texels a texture is a straight line.
    along = np.array([[0.25, 0.5], [0.75, 0.5], [0.75, 0.5], [0.25, 0.5]], np.float32)
    glow = made.add_texture(np.array([[0.0, 1.0]], np.float32), colour_space="raw", wrap="clamp") if is_ramp else (1.0, 1.0, 1.0)
    shine = made.add_material(base_color=0.0, specular_weight=0.0, emission_color=glow, spectrum="E")
    made.add_instance(made.add_mesh(screen, CORNERS, uvs=along), [shine])
    made.add_camera(gonio.look_at((-4, 0, 0), (0, 0, 0), up=(0, 0, 1)), fov=0.002)
    return made


def deviations(incidence: float, aim: float) -> tuple[np.ndarray, np.ndarray]:
    """Middles of bands and by how much they are bent, by where they meet the screen."""
    nm, ramp = by_band(through_prism(incidence, aim, is_ramp=True))
    _, even = by_band(through_prism(incidence, aim, is_ramp=False))
    return nm, aim + np.arctan((2 * ramp / even - 1) * HALF / FAR)


@pytest.mark.parametrize("line", [452.5, 547.5, 647.5])
def test_a_prism_bends_least_where_light_goes_through_evenly(line):
    expected = least_deviation(line)
    even = 0.5 * (expected + APEX)
    found = []
    for incidence in (even, even - math.radians(4), even + math.radians(4)):
        nm, bent = deviations(incidence, expected)
        found.append(bent[np.argmin(abs(nm - line))])
    # Of how far blue and red part, half a percent is 0.0002; a band of 5 nm is as wide as 0.0008.
    spread = least_deviation(450.0) - least_deviation(650.0)
    assert found[0] == pytest.approx(expected, abs=PART * spread)
    assert min(found[1:]) > found[0] + 0.001


def test_all_wavelengths_are_bent_by_snells_law():
    aim = least_deviation(550.0)
    incidence = 0.5 * (aim + APEX)
    nm, bent = deviations(incidence, aim)
    # A band shows the mean of its wavelengths.
    inside = lambda at: APEX - math.asin(math.sin(incidence) / cauchy(at))  # noqa: E731
    exact = lambda at: incidence + math.asin(cauchy(at) * math.sin(inside(at))) - APEX  # noqa: E731
    expected = [np.mean([exact(at + step) for step in np.linspace(-2.4, 2.4, 9)]) for at in nm]
    spread = least_deviation(450.0) - least_deviation(650.0)
    np.testing.assert_allclose(bent, expected, atol=PART * spread)


def airy(nm: np.ndarray, thickness: float, indices, degrees: float) -> np.ndarray:
    """Unpolarised reflectance of a film between two media, by amplitudes; indices are n - i k."""
    first, film, last = indices
    sine = first * math.sin(math.radians(degrees))
    cosines = [np.sqrt(1 - (sine / index) ** 2 + 0j) for index in indices]
    turn = np.exp(4j * np.pi * film * thickness * cosines[1] / nm)
    shares = []
    for is_p in (False, True):
        across = [cosine / index if is_p else cosine * index for cosine, index in zip(cosines, (first, film, last), strict=True)]
        upper, lower = ((a - b) / (a + b) for a, b in zip(across[:2], across[1:], strict=True))
        shares.append(abs((upper + lower * turn) / (1 + upper * lower * turn)) ** 2)
    return 0.5 * sum(shares)


@pytest.mark.parametrize("degrees", [0.0, 45.0, 60.0])
@pytest.mark.parametrize("thickness", [180.0, 550.0, 1500.0])
def test_films_are_airys_at_every_angle(thickness, degrees):
    film = {"thin_film_weight": 1.0, "thin_film_ior": 1.33, "thin_film_thickness": thickness}
    nm, found = by_band(sheet(degrees, base_color=0.0, specular_roughness=0.0, specular_ior=1.5, **film))
    np.testing.assert_allclose(found, airy(nm, thickness, (1.0, 1.33, 1.5), degrees), rtol=1e-4)
    nm, found = by_band(sheet(degrees, metal="gold", specular_roughness=0.0, **film))
    gold = gonio.metal("gold")
    n, k = (np.interp(nm, gold["wavelengths_nm"], gold[part]) for part in "nk")
    np.testing.assert_allclose(found, airy(nm, thickness, (1.0, 1.33, n - 1j * k), degrees), rtol=1e-4)


def test_films_are_airys_from_inside_glass():
    """What glass reflects inwards; what goes out is lost on a black board."""
    thickness = 180.0
    made = gonio.Scene()
    film = {"thin_film_weight": 1.0, "thin_film_ior": 1.33, "thin_film_thickness": thickness}
    glass = made.add_material(transmission_weight=1.0, specular_roughness=0.0, specular_ior=1.5, **film)
    made.add_instance(made.add_mesh(SQUARE, CORNERS), [glass])
    made.add_instance(made.add_mesh(50 * SQUARE + np.float32([0, 0, 1]), CORNERS), [made.add_material(base_color=0.0, specular_weight=0.0)])
    made.add_camera(gonio.look_at((0, 0, -2), (0, 0, 0), up=(1, 0, 0)), fov=0.01)
    made.add_light("dome", spectrum="E")
    nm, found = by_band(made, band=20.0, samples=256)
    np.testing.assert_allclose(found, airy(nm, thickness, (1.5, 1.33, 1.0), 0.0), atol=0.003)


# Johnson and Christy 1972: nm, n, k.
GOLD = np.array(
    [
        [397.4, 1.47, 1.952],
        [413.3, 1.46, 1.958],
        [430.5, 1.45, 1.948],
        [450.9, 1.38, 1.914],
        [471.4, 1.31, 1.849],
        [495.9, 1.04, 1.833],
        [520.9, 0.62, 2.081],
        [548.6, 0.43, 2.455],
        [582.1, 0.29, 2.863],
        [616.8, 0.21, 3.272],
        [659.5, 0.14, 3.697],
        [704.5, 0.13, 4.103],
    ]
)


@pytest.mark.parametrize("degrees", [0.0, 60.0])
def test_gold_is_that_of_johnson_and_christy(degrees):
    nm, found = by_band(sheet(degrees, metal="gold", specular_roughness=0.0))
    kept = (nm > 400) & (nm < 700)
    index = np.interp(nm, GOLD[:, 0], GOLD[:, 1]) + 1j * np.interp(nm, GOLD[:, 0], GOLD[:, 2])
    cosine = math.cos(math.radians(degrees))
    inner = np.sqrt(index**2 - (1 - cosine**2))
    s, p = (abs((a - inner) / (a + inner)) ** 2 for a in (cosine, index**2 * cosine))
    np.testing.assert_allclose(found[kept], (0.5 * (s + p))[kept], rtol=PART)


def no_colour(power: np.ndarray) -> np.ndarray:
    """A ripple over wavelengths, at most 1, that has neither colour nor luminance with this light."""
    ripple = np.cos(2 * np.pi * (NM - 380) / 80) * np.exp(-(((NM - 560) / 120) ** 4))
    bumps = np.stack([np.exp(-(((NM - at) / 40) ** 2)) for at in (450, 540, 610)], axis=1)
    ripple -= bumps @ np.linalg.solve((OBSERVER * power[:, None]).T @ bumps, colour(ripple * power))
    return ripple / abs(ripple).max()


def mirror(reflectance: np.ndarray) -> dict:
    """A body that absorbs nothing and straight on reflects this share of each wavelength."""
    root = np.sqrt(reflectance)
    return {"name": "mirror", "wavelengths_nm": NM.tolist(), "n": ((1 + root) / (1 - root)).tolist(), "k": [0.0] * len(NM)}


@pytest.mark.parametrize("name", LAMPS)
def test_surfaces_that_look_alike_by_day_part_under_lamps(name):
    power = lamp(name)
    grey = np.full(len(NM), 0.5)
    other = grey + 0.4 * no_colour(lamp("D65"))
    shown = []
    for reflectance in (grey, other):
        expected = colour(power * reflectance)
        found, errors = seen(sheet(spectrum=name, metal=mirror(reflectance), specular_roughness=0.0), samples=1024)
        assert (abs(found - expected) < PART * expected[1] + ERRORS * errors).all(), (found, expected)
        shown.append(found)
    apart = abs(shown[0] - shown[1]).max() / shown[0][1]
    assert apart < 0.002 if name == "D65" else apart > 0.005


@pytest.mark.parametrize("wall", [(0.7, 0.3, 0.1), (0.1, 0.3, 0.7), (0.1, 0.6, 0.2), (0.6, 0.1, 0.3)])
def test_lamps_that_look_alike_part_on_colours(wall):
    even = lamp("E")
    peaks = np.stack([np.exp(-(((NM - at) / 8) ** 2)) for at in (450, 540, 610)], axis=1)
    narrow = peaks @ np.linalg.solve(OBSERVER.T @ peaks, colour(even))
    reflectance = np.asarray(gonio.colour_reflectance(wall, NM))
    shown = []
    for power in (even, narrow):
        for colours, share in ((wall, reflectance), ((1.0, 1.0, 1.0), np.ones(len(NM)))):
            expected = colour(power * share)
            made = sheet(spectrum=(NM.tolist(), power.tolist()), base_color=colours, specular_weight=0.0)
            found, errors = seen(made, samples=1024)
            assert (abs(found - expected) < PART * expected[1] + ERRORS * errors).all(), (found, expected)
            shown.append(found)
    assert shown[1] == pytest.approx(shown[3], rel=0.003)
    assert abs(shown[0] - shown[2]).max() > 0.03 * shown[0][1]
