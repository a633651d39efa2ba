"""Media by wavelength under `spectral=True`: closed forms under lamps, pictures by wavelength, furnaces, and greys without colour."""

import math

import gonio
import numpy as np
import pytest
from gonio.medium import medium
from small_scenes import QUAD, at, ball, closure
from test_fields import coloured_box
from test_lamps_in_resin import cube, resin
from test_media import box, looking, seen

# Linear Rec.709 of X, Y, Z.
REC709 = np.linalg.inv([[0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923], [0.0193308, 0.1191948, 0.9505322]])
NM = np.arange(380.0, 780.01, 0.5)


def spectrum_of(name):
    lamp = gonio.illuminant(name)
    return np.interp(NM, lamp["wavelengths_nm"], lamp["power"])


def coefficient(colour):
    """The spectrum of a coefficient's colour: greys are even, twice the greatest component is the polynomials' range."""
    if len(set(colour)) == 1:
        return np.full_like(NM, colour[0])
    greatest = 2.0 * max(colour)
    return greatest * np.asarray(gonio.colour_reflectance([part / greatest for part in colour], NM))


def colour_of(name, left):
    """Linear Rec.709 of a lamp of luminance 1 of which a part is left at each wavelength."""

    def luminance(figures, power):
        return figures["ler"] * np.trapezoid(power, NM)

    whole, power = spectrum_of(name), spectrum_of(name) * left
    before, after = gonio.spectrum_figures(NM, whole), gonio.spectrum_figures(NM, power)
    y = luminance(after, power) / luminance(before, whole)
    x, z = after["x"] / after["y"] * y, (1.0 - after["x"] - after["y"]) / after["y"] * y
    return REC709 @ (x, y, z)


def near(found, expected, relative=0.005):
    """Channels are told apart to a part of the brightest."""
    np.testing.assert_allclose(found, expected, atol=relative * np.abs(expected).max())


HAZE = (0.05, 0.2, 0.6)


def lamp_in(scene, name, radius=0.3, **lamp):
    scene.add_light("sphere", (1.0,) * 3, radius=radius, spectrum=name, **lamp)
    scene.set(spectral=True)


@pytest.mark.parametrize("name", ["D65", "FL11", "LED-RGB1"])
@pytest.mark.parametrize("even", [True, False])
def test_a_lamp_through_coloured_haze(name, even):
    """What is left of a lamp 3 m away is lamp times exp(-σ d), wavelength by wavelength; in a body and in a field alike."""
    scene = looking((0.0, 0.0, 3.3), (0.0, 0.0, 0.0), size=16)
    lamp_in(scene, name)
    if even:
        scene.put_atmosphere(medium(absorption=HAZE))
        ways, samples = 3.0, 256
    else:
        scene.add_volume(np.full((4, 4, 4), 1.0, "f4"), absorption=HAZE, scattering=0.0, voxel=0.5, transform=at(-1.0, -1.0, 0.8))
        ways, samples = 2.0, 2048
    found, _ = seen(scene, samples)
    near(found, colour_of(name, np.exp(-ways * coefficient(HAZE))))


@pytest.mark.parametrize("name", ["D65", "FL11"])
def test_a_slab_that_scatters_once(name):
    """E σs / (4 π) (1 - exp(-2 σ D)) / (2 σ) at each wavelength, with spectra of colours for scattering and absorption."""
    scattering, absorption, depth = (0.6, 0.3, 0.1), (0.1, 0.1, 0.5), 2.0
    scene = looking((0.0, 5.0, 0.0), (0.0, 0.0, 0.0), size=16, up=(0.0, 0.0, 1.0))
    scene.add_light("distant", spectrum=name, transform=gonio.look_at((0, 1, 0), (0, 0, 0), (0, 0, 1)))
    scene.set(spectral=True)
    box(scene, (-300.0, -depth, -300.0), (300.0, 0.0, 300.0), scattering=scattering, absorption=absorption)
    found, _ = seen(scene, 1024, max_volume_bounces=0, max_bounces=0)
    scattered, extinction = coefficient(scattering), coefficient(scattering) + coefficient(absorption)
    near(found, colour_of(name, scattered / (8.0 * math.pi * extinction) * (1.0 - np.exp(-2.0 * depth * extinction))))


def test_shadow_rays_pass_coloured_fields():
    """A floor below a slab of smoke of two colours, lit straight from above: ratio tracking by wavelength."""
    taken = np.zeros((8, 8, 8, 6), "f4")
    taken[:, :4, :, :3], taken[:, 4:, :, :3] = (0.1, 0.5, 1.0), (1.0, 0.2, 0.1)
    scene = looking((0.0, -1.5, 5.0), (0.0, -1.5, 0.0), up=(0.0, 1.0, 0.0), size=16, degrees=0.5)
    scene.add_instance(
        scene.add_mesh(np.array([[-5, -2, 5], [5, -2, 5], [5, -2, -5], [-5, -2, -5]], "f4"), QUAD),
        [scene.add_material(base_color=1.0, specular_weight=0.0)],
    )
    scene.add_camera(gonio.look_at((2.0, -1.2, 0.0), (0.0, -2.0, 0.0), (0, 1, 0)), fov=0.5)
    scene.add_light("distant", spectrum="FL11", transform=gonio.look_at((0, 1, 0), (0, 0, 0), (0, 0, 1)))
    coloured_box(scene, taken, absorption=1.0)
    scene.set(spectral=True)
    found, _ = seen(scene, 4096, max_bounces=0)
    # From the middle of one voxel to that of the next colours go straight over.
    ways = np.linspace(0.0, 1.0, 201)
    mixed = [np.add(np.multiply(1.0 - part, (0.1, 0.5, 1.0)), np.multiply(part, (1.0, 0.2, 0.1))) for part in ways]
    between = np.trapezoid([coefficient(tuple(colour)) for colour in mixed], ways, axis=0)
    depth = 0.875 * (coefficient((0.1, 0.5, 1.0)) + coefficient((1.0, 0.2, 0.1))) + 0.25 * between
    near(found, colour_of("FL11", np.exp(-depth)) / math.pi, 0.01)


def fog(scene):
    lamp_in(scene, "FL11", radius=0.1, transform=at(0.5, 0.5, 0.0))
    box(scene, (-1.0,) * 3, (1.0,) * 3, scattering=(0.3, 0.8, 1.5), absorption=(0.4, 0.1, 0.05), anisotropy=0.3)


def smoke(scene):
    scene.add_light("dome", spectrum="LED-B3")
    density = np.fromfunction(lambda x, y, z: (x + y + z) / 9.0, (4, 4, 4)).astype("f4")
    scene.add_volume(
        density, scattering=(0.5, 1.0, 2.0), absorption=(1.0, 0.3, 0.1), emission=(0.2, 0.1, 0.0), voxel=0.5, transform=at(-1.0, -1.0, -1.0)
    )


def coloured_smoke(scene):
    scene.add_light("dome", spectrum="LED-B3")
    taken = np.zeros((8, 8, 8, 6), "f4")
    taken[:, :, :4], taken[:, :, 4:] = (0.4, 1.0, 0.7, 0.1, 0.8, 0.7), (1.0, 0.3, 0.3, 1.0, 0.1, 0.0)
    coloured_box(scene, taken, sent=[1.0, 0.4, 0.1], scattering=1.5, emission=0.1)


def milk_glass(scene):
    scene.add_light("dome", spectrum="FL11")
    inside = medium(scattering=(0.3, 0.6, 1.2), absorption=(0.05, 0.4, 0.8))
    glass = closure("OpenPbr", transmission_weight=1.0, specular_roughness=0.2, specular_ior=1.3)
    points, triangles = ball(32)
    material = scene.put_material({"origin": "milk", "closures": [{**glass, "solid": inside}]})
    scene.add_instance(scene.add_mesh(points, triangles, normals=points), [material])


def skin(scene):
    scene.add_light("dome", spectrum="FL11")
    points, triangles = ball(32)
    flesh = dict(subsurface_weight=1.0, subsurface_color=(0.9, 0.5, 0.3), subsurface_radius=(0.5, 0.2, 0.1))
    scene.add_instance(scene.add_mesh(points, triangles, normals=points), [scene.add_material(specular_weight=0.0, **flesh)])


SEEDS = 8


def by_seeds(fill, samples, picture):
    """Mean colours of the same scene by other random numbers, and their standard errors."""
    found = []
    for seed in range(SEEDS):
        scene = looking((0.0, 0.0, 5.0), (0.1, 0.0, 0.0), size=8, degrees=8.0)
        fill(scene)
        scene.set(spectral=True, seed=seed + 1, samples=samples)
        found.append(picture(scene).reshape(-1, 3).mean(axis=0))
    return np.mean(found, axis=0), np.std(found, axis=0, ddof=1) / math.sqrt(SEEDS)


def assert_alike(found, expected):
    """Two means are the same within their errors and a part of the brightest channel, of which the errors are less than a hundredth."""
    (once, error), (other, own) = found, expected
    errors, brightest = np.hypot(error, own), other.max()
    assert (errors < 0.01 * brightest).all(), (once, other, errors)
    assert (np.abs(once - other) < 4.0 * errors + 0.003 * brightest).all(), (once, other, errors)


def spectral(scene):
    with gonio.Render(scene) as rendering:
        rendering.wait()
        return np.asarray(rendering.film()["color"], float)[..., :3]


def by_wavelength(scene):
    return np.asarray(gonio.spectral_picture(scene, band=5.0).color, float)[..., :3]


@pytest.mark.parametrize(
    ("fill", "samples", "of_band"), [(fog, 4096, 128), (smoke, 512, 8), (coloured_smoke, 256, 4), (milk_glass, 512, 16), (skin, 512, 16)]
)
def test_pictures_are_those_by_wavelength(fill, samples, of_band):
    """Three wavelengths a path with one flight for all of them, beside pictures of one wavelength after the other."""
    assert_alike(by_seeds(fill, samples, spectral), by_seeds(fill, of_band, by_wavelength))


@pytest.mark.parametrize("kind", ["even", "field", "colours"])
def test_what_only_scatters_vanishes_in_even_light(kind):
    """An albedo of 1 is 1 at each wavelength, of whatever colour the scattering is."""
    scene = looking((0.0, 0.0, 5.0), (0.0, 0.0, 0.0), size=16, degrees=30.0)
    scene.add_light("dome")
    scene.set(spectral=True)
    if kind == "even":
        box(scene, (-1.0,) * 3, (1.0,) * 3, scattering=(0.5, 1.0, 4.0), anisotropy=0.5)
    elif kind == "field":
        density = np.fromfunction(lambda x, y, z: (x + y + z) / 9.0, (4, 4, 4)).astype("f4")
        scene.add_volume(density, scattering=(0.5, 1.0, 3.0), voxel=0.5, transform=at(-1.0, -1.0, -1.0))
    else:
        taken = np.zeros((8, 8, 8, 6), "f4")
        taken[:, :, :4], taken[:, :, 4:] = (0.2, 1.0, 0.5) * 2, (1.0, 0.1, 0.0) * 2
        coloured_box(scene, taken, scattering=2.0)
    found, error = seen(scene, 1024)
    assert found == pytest.approx([1.0] * 3, abs=0.01) and error < 0.003


def test_grey_media_have_no_colour():
    """Grey fog about a white lamp is grey in every pixel, and as bright as without wavelengths."""
    means = []
    for is_spectral in (True, False):
        scene = looking((0.0, 0.0, 5.0), (0.1, 0.0, 0.0), size=8, degrees=20.0)
        lamp_in(scene, None, radius=0.1)
        box(scene, (-1.0,) * 3, (1.0,) * 3, scattering=0.8, absorption=0.3, emission=0.1)
        scene.set(spectral=is_spectral, samples=256)
        found = spectral(scene)
        np.testing.assert_allclose(found, found[..., 1:2] * np.ones(3), rtol=3e-5)
        means.append(found.mean())
    assert means[0] == pytest.approx(means[1], rel=0.01)


TINT, TINT_DEPTH = (0.2, 0.6, 0.8), 0.7


@pytest.mark.parametrize("name", ["D65", "FL11"])
def test_cameras_and_meters_in_tinted_glass(name):
    """A camera and a meter in a block of glass, of a depth other than a metre, see a lamp half a metre away in it."""
    scene = looking((0.0, 0.0, 0.8), (0.0, 0.0, 0.0), size=16)
    lamp_in(scene, name)
    cube(scene, resin(scene, transmission_color=TINT, transmission_depth=TINT_DEPTH), (0, 0, 0), side=4.0)
    scene.add_meter((0.0, 0.0, 0.8), facing=(0.0, 0.0, -1.0), quantity="luminance")
    found, _ = seen(scene, 256)
    tint = np.asarray(gonio.colour_reflectance(TINT, NM)) ** (0.5 / TINT_DEPTH)
    expected = colour_of(name, tint)
    near(found, expected)
    luminance = float(np.dot(expected, (0.2126, 0.7152, 0.0722)))
    reading = gonio.measure(scene, samples=16384).meters[0]
    assert reading.value == pytest.approx(luminance, rel=0.01)


def test_cameras_in_tinted_glass_by_wavelength():
    """What a camera starts in is seen by wavelength band after band."""
    scene = looking((0.0, 0.0, 0.8), (0.0, 0.0, 0.0), size=4)
    lamp_in(scene, "FL11")
    cube(scene, resin(scene, transmission_color=TINT, transmission_depth=TINT_DEPTH), (0, 0, 0), side=4.0)
    scene.set(samples=4)
    tint = np.asarray(gonio.colour_reflectance(TINT, NM)) ** (0.5 / TINT_DEPTH)
    near(by_wavelength(scene).mean(axis=(0, 1)), colour_of("FL11", tint))


def test_light_paths_from_lamps_in_tinted_glass():
    """A floor under a lamp in a block of glass in haze, by paths that start in it: inverse squares, tint and haze of the ways."""
    eye, target, view, radius, absorption = np.array([1.5, 0.5, 0.0]), np.array([0.6, -1.0, 0.0]), 20.0, 0.003, (0.02, 0.1, 0.3)
    scene = looking(eye, target, size=8, degrees=view)
    lamp_in(scene, "D65", radius=radius)
    cube(scene, resin(scene, transmission_color=TINT, transmission_depth=TINT_DEPTH), (0, 0, 0), side=1.0)
    floor = np.array([[-2, -1, 2], [2, -1, 2], [2, -1, -2], [-2, -1, -2]], "f4")
    scene.add_instance(scene.add_mesh(floor, QUAD), [scene.add_material(base_color=0.8, specular_weight=0.0)])
    scene.put_atmosphere(medium(absorption=absorption))
    found, _ = seen(scene, 4096, integrator="light")
    forward = (target - eye) / np.linalg.norm(target - eye)
    across, up = np.array([0.0, 0.0, 1.0]), np.array([-forward[1], forward[0], 0.0])
    raster = (np.arange(24) + 0.5) / 12.0 - 1.0
    left = np.zeros_like(NM)
    for x, y in np.stack(np.meshgrid(raster, raster), axis=-1).reshape(-1, 2) * math.tan(math.radians(view / 2)):
        ray = forward + x * across + y * up
        place = eye + ray * (-1.0 - eye[1]) / ray[1]
        from_lamp, to_eye = np.linalg.norm(place), np.linalg.norm(place - eye)
        # The light leaves the glass half of the way down.
        tint = np.asarray(gonio.colour_reflectance(TINT, NM)) ** (0.5 * from_lamp / TINT_DEPTH)
        left += 0.8 * radius**2 / from_lamp**3 / raster.size**2 * tint * np.exp(-(from_lamp + to_eye) * coefficient(absorption))
    near(found, colour_of("D65", left), 0.01)
