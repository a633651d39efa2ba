"""Furnaces by wavelength: closed balls that glow and reflect, and surfaces that neither take nor give under a sky of one luminance."""

import gonio
import numpy as np
import pytest
from small_scenes import ball
from spectral_sums import NM, colour, lamp, seen

PART = 0.005
ERRORS = 4.0
IDENTITY = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]


def assert_close(found, expected, errors, part=PART):
    assert (abs(found - expected) < part * expected + ERRORS * errors).all(), found / expected - 1


@pytest.mark.parametrize("name", ["E", "LED-RGB1", "HP1"])
@pytest.mark.parametrize("wall", [(0.5,) * 3, (0.8,) * 3, (0.7, 0.3, 0.1), (0.1, 0.3, 0.7), (0.85, 0.8, 0.2)])
def test_a_closed_ball_that_glows(wall, name):
    """L = E / (1 - R) at each wavelength, of all reflections together."""
    made = gonio.Scene()
    material = made.add_material(base_color=wall, specular_weight=0.0, emission_color=(1.0,) * 3, spectrum=name)
    points, triangles = ball(96)
    made.add_instance(made.add_mesh(points, triangles[:, ::-1].copy()), [material])
    made.add_camera(IDENTITY, fov=60.0)
    found, errors = seen(made)
    power = lamp(name)
    assert_close(found, colour(power / (1.0 - np.asarray(gonio.colour_reflectance(wall, NM)))), errors)


GLASS = {"transmission_weight": 1.0, "specular_ior": 1.5}
FILM = {"thin_film_weight": 1.0, "thin_film_thickness": 500.0, "thin_film_ior": 1.33}
SURFACES = {
    "gloss": {"base_color": 1.0, "specular_roughness": 0.0},
    "rough gloss": {"base_color": 1.0, "specular_roughness": 0.6},
    "coat": {"base_color": 1.0, "specular_roughness": 0.3, "coat_weight": 1.0, "coat_roughness": 0.2},
    "film on gloss": {"base_color": 1.0, "specular_roughness": 0.3, **FILM},
    "metal": {"base_color": 1.0, "metalness": 1.0, "specular_roughness": 0.5},
    "clear glass": {**GLASS, "specular_roughness": 0.0},
    "frosted glass": {**GLASS, "specular_roughness": 0.2},
    "rough glass": {**GLASS, "specular_roughness": 0.5},
    "film on glass": {**GLASS, "specular_roughness": 0.0, **FILM},
    "film on rough glass": {**GLASS, "specular_roughness": 0.3, **FILM},
}


def furnace(name: str, **material) -> gonio.Scene:
    """A ball below a sky of one luminance."""
    made = gonio.Scene()
    made.add_instance(made.add_mesh(*ball(96)), [made.add_material(**material)])
    made.add_light("dome", spectrum=name)
    made.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 6], [0, 0, 0, 1]], fov=12.0)
    return made


@pytest.mark.parametrize("name", ["E", "LED-B3"])
@pytest.mark.parametrize("surface", SURFACES)
def test_what_takes_nothing_is_not_seen(surface, name):
    found, errors = seen(furnace(name, **SURFACES[surface]), samples=512, caustics="off")
    assert_close(found, colour(lamp(name)), errors)


@pytest.mark.parametrize("roughness", [0.0, 0.3])
@pytest.mark.parametrize("abbe", [64.17, 20.0])
def test_glass_that_disperses_takes_no_light(abbe, roughness):
    """Of a path's wavelengths one goes on."""
    glass = {**GLASS, "specular_roughness": roughness, "transmission_dispersion": 1 / abbe}
    found, errors = seen(furnace("D65", **glass), samples=4096, caustics="off")
    assert_close(found, colour(lamp("D65")), errors)


def test_dispersing_glass_reflects_each_wavelength_by_its_own_index():
    """Fresnel's formula at each wavelength, straight on, where what passes is lost."""
    abbe, index = 5.0, 1.5
    square, corners = np.array([[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]], np.float32), np.array([[0, 1, 2], [0, 2, 3]], np.int32)
    for nm in (450.0, 600.0):
        made = gonio.Scene()
        glass = made.add_material(**GLASS, specular_roughness=0.0, transmission_dispersion=1 / abbe)
        made.add_instance(made.add_mesh(square, corners), [glass])
        made.add_instance(made.add_mesh(3 * square - np.float32([0, 0, 1]), corners), [made.add_material(base_color=0.0, specular_weight=0.0)])
        made.add_light("dome", spectrum=(range(380, 781), [float(abs(at - nm) <= 10) for at in range(380, 781)]))
        made.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]], fov=0.1)
        found, errors = seen(made, samples=4096, caustics="off")
        own = index + (index - 1) / abbe * (nm**-2 - 587.56**-2) / (486.13**-2 - 656.27**-2)
        assert found[1] == pytest.approx(((own - 1) / (own + 1)) ** 2, rel=0.01, abs=ERRORS * errors[1])
