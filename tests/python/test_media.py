"""Media that scatter: fog in boxes, in all of space and about lamps, against closed forms and Chandrasekhar's functions."""

import math

import gonio
import numpy as np
import pytest
from gonio.medium import haze, medium
from small_scenes import block, closure, finished


def box(scene, low, high, closures=(), **coefficients):
    """A box of a medium."""
    surface = list(closures) or [closure("Transparent", base_color=1.0)]
    material = scene.put_material({"origin": "fog", "closures": surface, "medium": medium(**coefficients)})
    scene.add_instance(scene.add_mesh(*block(low, high)), [material])


def looking(origin, target, size=8, up=(0.0, 1.0, 0.0), degrees=0.02):
    """A scene with a camera that sees next to one direction."""
    scene = gonio.Scene()
    scene.add_camera(gonio.look_at(origin, target, up), fov=degrees)
    scene.set(width=size, height=size, filter="box", max_bounces=250, max_transparent_bounces=250, caustics="off", seed=3, passes=["color"])
    return scene


def seen(scene, samples, **settings):
    """The mean radiance of a picture, R, G, B, and its standard error, of the mean of its channels."""
    scene.set(samples=samples, **settings)
    pixels = np.asarray(finished(scene)["color"])[..., :3].reshape(-1, 3).astype(np.float64)
    return pixels.mean(0), pixels.mean(1).std() / math.sqrt(len(pixels))


def within(found, error, expected, relative=0.005):
    assert error < relative * expected, (error, expected)
    assert abs(found - expected) < 4.0 * error + 1e-4 * expected, (found, error, expected)


def test_haze_without_end_covers_once():
    """Coverage of rays that leave the scene is told where they leave it, and not where they scatter as well."""
    for transparent in (True, False):
        scene = looking((0.0, 0.0, 0.0), (0.0, 0.0, -1.0))
        scene.add_light("dome", (1.0,) * 3)
        scene.put_atmosphere(medium(scattering=0.1))
        scene.set(samples=16, film_transparent=transparent, passes=["color", "alpha"])
        film = finished(scene)
        np.testing.assert_allclose(np.asarray(film["alpha"]), 1.0, atol=1e-5)
        np.testing.assert_allclose(np.asarray(film["color"])[..., 3], 1.0, atol=1e-5)


# Radiance of a half-space that scatters evenly, under even light of 1: 1 - sqrt(1 - a) H(mu), with Chandrasekhar's H (Radiative Transfer, 1950),
# by albedo and cosine.
HALF_SPACE = {
    (0.5, 1.0): 0.11523,
    (0.8, 1.0): 0.28525,
    (0.8, 0.5): 0.36797,
    (0.95, 1.0): 0.53554,
    (0.95, 0.1): 0.73274,
    (0.99, 0.5): 0.81514,
}


@pytest.mark.parametrize(("albedo", "cosine"), HALF_SPACE)
def test_a_half_space_of_fog(albedo, cosine):
    sine = math.sqrt(1.0 - cosine**2)
    scene = looking((5.0 * sine, 5.0 * cosine, 0.0), (0.0, 0.0, 0.0), size=16, up=(0.0, 0.0, 1.0))
    scene.add_light("dome")
    box(scene, (-300.0, -60.0, -300.0), (300.0, 0.0, 300.0), scattering=albedo, absorption=1.0 - albedo)
    found, error = seen(scene, 256)
    within(found.mean(), error, HALF_SPACE[albedo, cosine], relative=0.01)


# Light that a slab scatters once, under an irradiance of 1 across the beam: (1/4 pi mu) (1 - exp(-tau (1 + 1/mu))) / (1 + 1/mu).
@pytest.mark.parametrize(("depth", "cosine"), [(0.5, 1.0), (0.5, 0.5), (2.0, 1.0)])
def test_a_slab_that_scatters_once(depth, cosine):
    sine = math.sqrt(1.0 - cosine**2)
    scene = looking((5.0 * sine, 5.0 * cosine, 0.0), (0.0, 0.0, 0.0), up=(0.0, 0.0, 1.0))
    scene.add_light("distant", transform=gonio.look_at((0, 1, 0), (0, 0, 0), (0, 0, 1)))
    box(scene, (-300.0, -depth, -300.0), (300.0, 0.0, 300.0), scattering=1.0)
    found, error = seen(scene, 256, max_volume_bounces=0, max_bounces=0)
    way = 1.0 + 1.0 / cosine
    within(found.mean(), error, (1.0 - math.exp(-depth * way)) / way / (4.0 * math.pi * cosine))


# Airlight of a lamp of 1 cd that the view passes at a distance, 10 m to either side; scattering and absorption a metre.
@pytest.mark.parametrize(
    ("distance", "scattering", "extinction", "half", "expected"),
    [(1.0, 0.1, 0.1, 10.0, 0.0072569), (1.0, 0.5, 0.5, 10.0, 0.00043501), (0.1, 0.2, 0.4, 5.0, 0.060908)],
)
def test_airlight_of_a_lamp(distance, scattering, extinction, half, expected):
    scene = looking((0.0, 0.0, half), (0.0, 0.0, 0.0), degrees=1e-4)
    scene.add_light("point", transform=gonio.look_at((distance, 0, 0), (distance, 0, -1), (0, 1, 0)))
    box(scene, (-20.0, -20.0, -half), (20.0, 20.0, half + 1.0), scattering=scattering, absorption=extinction - scattering)
    found, error = seen(scene, 256, max_volume_bounces=0, max_bounces=0)
    # The camera stands within, so that the way begins there.
    within(found.mean(), error, expected)


@pytest.mark.parametrize("anisotropy", [0.0, 0.8, -0.6])
def test_what_only_scatters_vanishes_in_even_light(anisotropy):
    scene = looking((0.0, 0.0, 5.0), (0.0, 0.0, 0.0), size=16, degrees=40.0)
    scene.add_light("dome")
    box(scene, (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0), scattering=(0.5, 1.0, 4.0), anisotropy=anisotropy)
    box(scene, (-0.5, -0.5, -3.0), (0.7, 0.5, 1.5), scattering=2.0, anisotropy=-anisotropy)
    found, error = seen(scene, 256)
    assert found == pytest.approx([1.0] * 3, abs=0.01) and error < 0.003


def test_fog_in_all_of_space_takes_the_cameras_and_the_lamps_light():
    scene = looking((0.0, 0.0, 3.0), (0.0, 0.0, 0.0))
    mesh = scene.add_mesh(np.array([[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]], "f4"), np.array([[0, 1, 2], [0, 2, 3]], "i4"))
    scene.add_instance(mesh, [scene.put_material({"origin": "wall", "closures": [closure("Emission", emission_color=2.0)]})])
    scene.put_atmosphere(medium(absorption=(0.1, 0.2, 0.4)))
    found, _ = seen(scene, 16)
    assert found == pytest.approx(2.0 * np.exp(-3.0 * np.array([0.1, 0.2, 0.4])), rel=1e-4)


def test_a_medium_that_shines():
    scene = looking((0.0, 0.0, 3.0), (0.0, 0.0, 0.0))
    box(scene, (-9.0, -9.0, -2.0), (9.0, 9.0, 0.0), absorption=(0.5, 1e-5, 2.0), emission=3.0)
    found, _ = seen(scene, 4)
    depths = 2.0 * np.array([0.5, 1e-5, 2.0])
    assert found == pytest.approx(3.0 * 2.0 * -np.expm1(-depths) / depths, rel=1e-3)


def test_haze_by_visibility():
    assert haze(100.0)["scattering"] == pytest.approx([2.9957 / 100.0] * 3, rel=1e-4)
    assert haze(100.0, contrast=0.02, albedo=0.5)["absorption"] == pytest.approx([3.912 / 200.0] * 3, rel=1e-4)
    for wrong in ({"visibility": 0.0}, {"visibility": math.nan}, {"visibility": 1.0, "contrast": 1.0}, {"visibility": 1.0, "albedo": 2.0}):
        with pytest.raises(ValueError, match="expected"):
            haze(**wrong)


@pytest.mark.parametrize("anisotropy", [0.0, 0.7])
def test_a_ball_of_fog_keeps_the_flux_of_its_lamp(anisotropy):
    scene = gonio.Scene()
    scene.add_light("point")
    box(scene, (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0), scattering=3.0, anisotropy=anisotropy)
    reading = gonio.goniometer(scene, rays=200_000)
    assert reading.light_output_ratio.value == pytest.approx(1.0, abs=1e-3)


@pytest.mark.parametrize("box_first", [True, False])
@pytest.mark.parametrize("touching", [True, False])
def test_fog_that_stands_on_a_floor_is_before_it(box_first, touching):
    scene = looking((0.3, 2.0, 0.0), (0.0, 0.0, 0.0))
    bottom = 0.0 if touching else -0.5
    if box_first:
        box(scene, (-9.0, bottom, -9.0), (9.0, 3.0, 9.0), absorption=0.7)
    floor = scene.add_material(base_color=(0.5,) * 3, specular_weight=0.0)
    scene.add_instance(scene.add_mesh(np.array([[-9, 0, -9], [-9, 0, 9], [9, 0, 9], [9, 0, -9]], "f4"), np.array([[0, 1, 2], [0, 2, 3]], "i4")), [floor])
    if not box_first:
        box(scene, (-9.0, bottom, -9.0), (9.0, 3.0, 9.0), absorption=0.7)
    scene.add_light("point", transform=gonio.look_at((0, 1, 0), (0, 0, 0), (0, 0, 1)))
    found, _ = seen(scene, 4, max_bounces=0)
    way = 1.0 + math.hypot(0.3, 2.0)
    assert found == pytest.approx([0.5 / math.pi * math.exp(-0.7 * way)] * 3, rel=2e-3)


@pytest.mark.parametrize("coefficients", [{"absorption": 0.3}, {"scattering": 1e-6, "absorption": 0.3}])
def test_fog_before_the_near_limit_is_not_seen(coefficients):
    """As in Cycles, where rays start at it: what is left of a lamp's luminance 4 m away with a limit of 1 m."""
    scene = looking((0.0, 0.0, 0.0), (0.0, 0.0, -1.0))
    from gonio.description import camera

    described = camera("near", gonio.look_at((0, 0, 0), (0, 0, -1), (0, 1, 0)), 0.02, (8, 8))
    scene.set(camera=scene.put_camera({**described, "clipping": [1.0, 1e9]}, fixed_aperture=False))
    scene.add_light("disk", (1.0,) * 3, radius=1.0, transform=gonio.look_at((0, 0, -4), (0, 0, 0), (0, 1, 0)))
    scene.put_atmosphere(medium(**coefficients))
    found, _ = seen(scene, 256)
    assert found == pytest.approx(math.exp(-0.3 * 3.0), rel=2e-3)


@pytest.mark.parametrize("lamp", ["mesh", "rectangle"])
@pytest.mark.parametrize("floor", [False, True])
def test_lamps_are_found_beside_a_sky_that_does_not_arrive(lamp, floor):
    """The glow about a lamp in endless haze, on rays that meet nothing and on those that meet a dark floor far away, is the same with a sky as without."""
    found = []
    for sky in (False, True):
        scene = looking((0.0, 0.0, 0.0), (0.0, 0.0, -1.0), size=16, degrees=10.0)
        if lamp == "mesh":
            corners = np.array([[1, -1, -10], [3, -1, -10], [3, 1, -10], [1, 1, -10]], "f4")
            shining = scene.add_material("shining", emission_color=(100.0,) * 3)
            scene.add_instance(scene.add_mesh(corners, np.array([[0, 1, 2], [0, 2, 3]], "i4")), [shining])
        else:
            scene.add_light("rectangle", (100.0,) * 3, width=2, height=2, transform=gonio.look_at((2, 0, -10), (2, 0, 0), (0, 1, 0)))
        if floor:
            dark = scene.add_material("dark", base_color=(0.0,) * 3, specular_weight=0.0)
            wall = np.array([[-900, -900, -500], [900, -900, -500], [900, 900, -500], [-900, 900, -500]], "f4")
            scene.add_instance(scene.add_mesh(wall, np.array([[0, 1, 2], [0, 2, 3]], "i4")), [dark])
        if sky:
            scene.add_light("dome", (1.0,) * 3)
        scene.put_atmosphere(medium(scattering=0.01))
        found.append(seen(scene, 64, max_bounces=1)[0][0])
    assert found[1] == pytest.approx(found[0], rel=0.03) and found[0] > 0.1


def test_what_only_bounds_fog_is_no_transparent_bounce():
    """Six boxes that absorb, one behind the other, with a limit of two transparent bounces: for rays of the camera and of shadows."""
    for straight in (2, 64):
        scene = looking((0.0, 0.0, 8.0), (0.0, 0.0, 0.0))
        for number in range(6):
            box(scene, (-1.0, -1.0, float(number)), (1.0, 1.0, number + 0.5), absorption=0.05)
        scene.add_light("dome", (1.0,) * 3)
        assert seen(scene, 16, max_transparent_bounces=straight)[0] == pytest.approx(math.exp(-0.05 * 0.5 * 6), rel=1e-4)


def test_shadow_rays_pass_the_bounds_of_fog():
    """A lamp behind six boxes, with no transparent bounce allowed: illuminance by Beer and Lambert."""
    scene = gonio.Scene()
    for number in range(6):
        box(scene, (-1.0, -1.0, float(number)), (1.0, 1.0, number + 0.5), absorption=0.05)
    scene.add_light("point", (100.0,) * 3, transform=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 9], [0, 0, 0, 1]])
    scene.add_meter((0.0, 0.0, -1.0), normal=(0.0, 0.0, 1.0))
    scene.set(samples=16, max_transparent_bounces=0)
    found = gonio.measure(scene, samples=16).meters[0].value
    assert found == pytest.approx(100.0 / 10.0**2 * math.exp(-0.05 * 0.5 * 6), rel=1e-3)


def test_a_medium_whose_mesh_is_open_sends_nothing_without_end():
    scene = looking((0.0, 0.0, 3.0), (0.0, 0.0, 0.0))
    shining = {"origin": "open", "closures": [closure("Transparent", base_color=1.0)], "medium": medium(emission=0.4)}
    mesh = scene.add_mesh(np.array([[-9, -9, 0], [9, -9, 0], [9, 9, 0], [-9, 9, 0]], "f4"), np.array([[0, 1, 2], [0, 2, 3]], "i4"))
    scene.add_instance(mesh, [scene.put_material(shining)])
    assert seen(scene, 16)[0] == pytest.approx(0.0, abs=1e-6)
