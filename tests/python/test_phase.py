"""Phase functions of media: white furnaces, light that is scattered once against the papers' formulas, flux, and what is told."""

import math

import gonio
import pytest
from gonio.medium import haze, medium
from test_media import box, looking, seen, within

PHASES = {
    "rayleigh": {"phase": "rayleigh"},
    "dust": {"phase": "draine", "anisotropy": 0.5, "alpha": 2.0},
    "small dust": {"phase": "draine", "anisotropy": 0.011, "alpha": 250.0},
    "backwards": {"phase": "draine", "anisotropy": -0.6, "alpha": 3.0},
    "ocean": {"phase": "fournier_forand", "ior": 1.1, "backscatter": 0.018},
    "milky": {"phase": "fournier_forand", "ior": 1.33, "backscatter": 0.1},
    "cloud": {"phase": "mie", "diameter": 20.0},
    "haze": {"phase": "mie", "diameter": 1.0},
}


def draine(g, alpha, cosine):
    """Draine, Scattering by Interstellar Dust Grains (2003), equation 6."""
    kernel = (1.0 - g * g) / (1.0 + g * g - 2.0 * g * cosine) ** 1.5
    return kernel * (1.0 + alpha * cosine**2) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0) / (4.0 * math.pi)


def fournier_forand(n, backscatter, cosine):
    """Fournier and Jonasz, Computer-based underwater imaging analysis (1999), equation 13, by the part that goes back (Mobley and others, 2002)."""
    across, back = (4.0 / (3.0 * (n - 1.0) ** 2) * part for part in (0.5, 1.0))
    nu = -math.log(2.0 * backscatter * (across - 1.0) + 1.0) / math.log(across)
    sine = (1.0 - cosine) / 2.0
    delta = back * sine
    power = delta**nu
    inner = nu * (1.0 - delta) - (1.0 - power) + (delta * (1.0 - power) - nu * (1.0 - delta)) / sine
    last = (1.0 - back**nu) / (16.0 * math.pi * (back - 1.0) * back**nu) * (3.0 * cosine**2 - 1.0)
    return inner / (4.0 * math.pi * (1.0 - delta) ** 2 * power) + last


def cloud(cosine):
    """Droplets of 20 micrometres: g, g, alpha and weight of Jendersie and d'Eon's fit (2023), equations 7 to 10."""
    return (1.0 - 0.498159) * draine(0.994610, 0.0, cosine) + 0.498159 * draine(0.593791, 27.1137, cosine)


RIGHT = {
    "rayleigh": lambda cosine: 3.0 / (16.0 * math.pi) * (1.0 + cosine**2),
    "dust": lambda cosine: draine(0.5, 2.0, cosine),
    "small dust": lambda cosine: draine(0.011, 250.0, cosine),
    "backwards": lambda cosine: draine(-0.6, 3.0, cosine),
    "ocean": lambda cosine: fournier_forand(1.1, 0.018, cosine),
    "milky": lambda cosine: fournier_forand(1.33, 0.1, cosine),
    "cloud": cloud,
}


@pytest.mark.parametrize("name", PHASES)
def test_what_only_scatters_vanishes_in_even_light(name):
    scene = looking((0.0, 0.0, 5.0), (0.0, 0.0, 0.0), size=16, degrees=40.0)
    scene.add_light("dome")
    box(scene, (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0), scattering=(0.5, 1.0, 4.0), **PHASES[name])
    # Another one overlaps, so that registers have two kinds.
    box(scene, (-0.5, -0.5, -3.0), (0.7, 0.5, 1.5), scattering=2.0, anisotropy=0.6)
    found, error = seen(scene, 1024)
    assert found == pytest.approx([1.0] * 3, abs=0.01) and error < 0.003


# A beam straight down into a slab, seen from a side above it, straight above and from below.
@pytest.mark.parametrize("cosine", [-0.5, -1.0, 0.5])
@pytest.mark.parametrize("name", RIGHT)
def test_a_slab_that_scatters_once(name, cosine):
    slant, depth = abs(cosine), 0.5
    sine = math.sqrt(1.0 - slant**2)
    height = math.copysign(5.0 * slant, -cosine)
    middle = 0.0 if cosine < 0.0 else -depth
    scene = looking((5.0 * sine, middle + height, 0.0), (0.0, middle, 0.0), up=(0.0, 0.0, 1.0))
    scene.add_light("distant", transform=gonio.look_at((0, 1, 0), (0, 0, 0), (0, 0, 1)))
    box(scene, (-300.0, -depth, -300.0), (300.0, 0.0, 300.0), scattering=1.0, **PHASES[name])
    found, error = seen(scene, 256, max_volume_bounces=0, max_bounces=0)
    if cosine < 0.0:
        way = 1.0 + 1.0 / slant
        layers = (1.0 - math.exp(-depth * way)) / way
    else:
        way = 1.0 / slant - 1.0
        layers = (math.exp(-depth) - math.exp(-depth / slant)) / way
    within(found.mean(), error, layers / slant * RIGHT[name](cosine))


@pytest.mark.parametrize("name", PHASES)
def test_a_ball_of_fog_keeps_the_flux_of_its_lamp(name):
    scene = gonio.Scene()
    scene.add_light("point")
    box(scene, (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0), scattering=3.0, **PHASES[name])
    reading = gonio.goniometer(scene, rays=200_000)
    # Factors of drawn directions are 1 in the mean alone.
    assert reading.light_output_ratio.value == pytest.approx(1.0, abs=2e-3)


def test_descriptions_name_what_differs_from_the_usual_one():
    assert "phase" not in medium(scattering=1.0, anisotropy=0.3)
    assert medium(phase="rayleigh")["phase"] == "Rayleigh"
    assert medium(phase="mie", diameter=8.0)["phase"] == {"Mie": {"diameter": 8.0}}
    assert haze(100.0, phase="draine", anisotropy=0.5)["phase"] == {"Draine": {"alpha": 1.0}}
    with pytest.raises(ValueError, match="expected one of henyey_greenstein, rayleigh"):
        medium(phase="mei")
    with pytest.raises(TypeError, match="alpha is no number of the phase function mie, which has diameter"):
        medium(phase="mie", alpha=1.0)


@pytest.mark.parametrize("numbers", [{"phase": "mie", "diameter": 80.0}, {"phase": "fournier_forand", "backscatter": 0.0}])
def test_numbers_beyond_their_range_are_told(numbers):
    scene = looking((0.0, 0.0, 5.0), (0.0, 0.0, 0.0))
    scene.add_light("dome")
    box(scene, (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0), scattering=1.0, **numbers)
    scene.set(samples=1)
    with gonio.Render(scene) as render:
        assert render.wait()
        assert sum("diameter from 0 to 50 micrometres" in text for _, text in render.diagnostics) == 1
