"""Media against closed forms, Chandrasekhar's functions, the exact field of a lamp in fog, and quadrature through grids.

What they keep is in `test_media_balance.py`."""

import math

import confidence
import gonio
import media_oracles as oracles
import numpy
import pytest
from fog import SECTION, box, hold, looking, lux, once, pictures, slab, slanted, sun_above
from gonio.medium import medium
from small_scenes import at

pytestmark = pytest.mark.validate

# Optical depths in R, G, B.
DEPTHS = numpy.array([0.2, 0.5, 2.0])
COSINES = (1.0, 0.5, 0.1)
# After so many a path in a picture ends.
SCATTERINGS = 256


def test_the_field_of_a_lamp_in_fog_keeps_its_flux():
    """The reference itself: what both sides of a plane get differs by what fog within leaves of the flux."""
    for albedo in (0.5, 0.8, 0.95):
        sides = [oracles.lux_of_lamp(albedo, 1.0, 1.0, towards) for towards in (True, False)]
        assert sides[0] - sides[1] == pytest.approx(oracles.net_lux_of_lamp(albedo, 1.0, 1.0), rel=1e-8)


def test_absorbing_slab():
    found = []
    for cosine in COSINES:
        scene = slanted(cosine)
        scene.add_light("dome")
        slab(scene, 1.0, absorption=DEPTHS)
        found.append(pictures(scene, 4, [1]).mean(axis=(0, 1)))
    expected = numpy.exp(-DEPTHS / numpy.array(COSINES)[:, None])
    confidence.hold_exact(SECTION, "slab that absorbs, τ 0.2, 0.5, 2, µ 1, 0.5, 0.1", "e^(−τ/µ)", numpy.array(found), expected, 1e-3)


@pytest.mark.parametrize("depth", [0.1, 0.5, 1.0, 2.0])
def test_slab_under_an_even_sky(depth):
    scene = gonio.Scene()
    scene.add_light("dome")
    scene.add_meter((0.0, 0.0, 0.0))
    # One metre above the meter.
    box(scene, (-3000.0, -3000.0, 1.0), (3000.0, 3000.0, 1.0 + depth), absorption=1.0)
    expected = [math.pi * oracles.diffuse_transmittance(depth)]
    hold(f"plane below a slab that absorbs, even sky, τ {depth}", "2 π E₃(τ)", lux(scene, 1 << 16), expected)


@pytest.mark.parametrize("albedo", [0.5, 0.8, 0.9, 0.95, 0.99, 0.999])
def test_half_space(albedo):
    found = []
    for cosine in COSINES:
        scene = slanted(cosine)
        scene.add_light("dome")
        # So deep that nothing comes through from below.
        slab(scene, 60.0 if albedo < 0.995 else 300.0, scattering=albedo, absorption=1.0 - albedo)
        found.append(pictures(scene, 256).mean(axis=(1, 2)))
    expected = [oracles.half_space_of_orders(albedo, cosine, SCATTERINGS) for cosine in COSINES]
    case = f"half-space that scatters evenly, albedo {albedo}, even light, µ 1, 0.5, 0.1"
    hold(case, "1 − √(1 − a) H(µ), Chandrasekhar, up to 256 scatterings", numpy.transpose(found), expected)


@pytest.mark.parametrize("side", ["reflects", "lets through"])
def test_slab_that_scatters_once(side):
    reference = oracles.reflected_once if side == "reflects" else oracles.transmitted_once
    found, expected = [], []
    for cosine in COSINES:
        scene = slanted(cosine, None if side == "reflects" else 1.0)
        sun_above(scene)
        slab(scene, 1.0, scattering=DEPTHS)
        found.append(once(scene, 256))
        expected.append([reference(depth, cosine) for depth in DEPTHS])
    hold(f"sun on a slab that {side} what it scatters once, τ 0.2, 0.5, 2", "closed form", numpy.concatenate(found, 1), expected)


AIRLIGHT = [
    (1.0, 0.1, 0.1, 10.0, 0.0),
    (1.0, 0.5, 0.5, 10.0, 0.0),
    (0.1, 0.2, 0.4, 5.0, 0.0),
    (1.0, 0.1, 0.1, 10.0, 0.8),
    (1.0, 0.1, 0.2, 5.0, -0.5),
]


@pytest.mark.parametrize(("distance", "scattering", "extinction", "half", "g"), AIRLIGHT)
def test_airlight_of_a_lamp(distance, scattering, extinction, half, g):
    """The camera stands within, so that the way begins there."""
    scene = looking((0.0, 0.0, -half), (0.0, 0.0, 0.0), up=(0.0, 1.0, 0.0), degrees=1e-4)
    scene.add_light("point", transform=at(distance, 0.0, 0.0))
    box(scene, (-20.0, -20.0, -half - 1.0), (20.0, 20.0, half), scattering=scattering, absorption=extinction - scattering, anisotropy=g)
    expected = [oracles.airlight(distance, scattering, extinction, half, g)]
    case = f"airlight of a lamp at {distance:g} m of the view, σs {scattering}, σt {extinction}, ± {half:g} m, g {g:g}"
    hold(case, "∫ σs p e^(−σt (s + d)) / d² ds", once(scene, 256).mean(axis=1, keepdims=True), expected)


@pytest.mark.parametrize(("albedo", "extinction", "distance"), [(0.5, 1.0, 1.0), (0.8, 0.5, 1.0), (0.9, 1.0, 1.0), (0.8, 1.0, 3.0)])
def test_a_meter_and_a_lamp_in_fog(albedo, extinction, distance):
    scene = gonio.Scene()
    scene.add_light("point")
    scene.put_atmosphere(medium(scattering=albedo * extinction, absorption=(1.0 - albedo) * extinction))
    for side in (-1.0, 1.0):
        scene.add_meter((0.0, 0.0, distance), normal=(0.0, 0.0, side))
    expected = [oracles.lux_of_lamp(albedo, extinction, distance, towards) for towards in (True, False)]
    case = f"lamp in fog without end at {distance:g} m, albedo {albedo}, σt {extinction}: towards it, away from it"
    hold(case, "Case and Zweifel's φ, over all ways to the plane", lux(scene, 1 << 21), expected)


# Places that the camera looks through along z, voxels.
PLACES = [(5.3, 4.2), (12.0, 7.7), (17.6, 2.1)]


def before_grid(x, y):
    return looking((x, y, 20.0), (x, y, 0.0), up=(0.0, 1.0, 0.0), degrees=1e-3)


def test_grid_that_absorbs():
    array = oracles.smooth((20, 11, 9))
    found, expected = [], []
    for x, y in PLACES:
        scene = before_grid(x, y)
        scene.add_light("dome")
        scene.add_volume(array, scattering=0.0, absorption=0.2)
        found.append(pictures(scene, 512).mean(axis=(1, 2)))
        expected.append(math.exp(-0.2 * float(oracles.depths(array, (x, y, 0.0), (x, y, 9.0)))))
    hold("grid that absorbs, three ways", "e^(−∫ σ ds), quadrature", numpy.transpose(found), expected)


def test_grid_that_scatters_once():
    array = oracles.smooth((20, 11, 9))
    found, expected = [], []
    for x, y in PLACES:
        scene = before_grid(x, y)
        sun_above(scene)
        scene.add_volume(array, scattering=0.2, absorption=0.05)
        found.append(once(scene, 512).mean(axis=1))
        expected.append(oracles.grid_once(array, 0.2, 0.25, x, y))
    hold("grid in the sun that scatters once, three ways", "∫ σs T T / 4π ds, quadrature", numpy.transpose(found), expected)


def test_emission_of_a_slab():
    found = []
    for cosine in COSINES:
        scene = slanted(cosine)
        slab(scene, 1.0, absorption=DEPTHS, emission=3.0)
        found.append(pictures(scene, 4, [1]).mean(axis=(0, 1)))
    expected = 3.0 * -numpy.expm1(-DEPTHS / numpy.array(COSINES)[:, None]) / DEPTHS
    case = "slab that shines and absorbs, τ 0.2, 0.5, 2, µ 1, 0.5, 0.1"
    confidence.hold_exact(SECTION, case, "ε (1 − e^(−τ/µ)) / σ", numpy.array(found), expected, 1e-3)
