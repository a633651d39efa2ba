"""Shadow catchers: what they show is the light that objects take from them, which is known in closed form here."""

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, at, finished
from test_media import box

DISK = 200


def caught(*, transparent=True, samples=16, fov=2.0, **settings):
    """A catcher of 10 m by 10 m seen from 8 m above."""
    scene = gonio.Scene()
    scene.set(**{"width": 16, "height": 16, "samples": samples, "film_transparent": transparent, "passes": ["color", "alpha", "luminance"], **settings})
    grey = scene.add_material(base_color=(0.5, 0.4, 0.3), specular_weight=0.0)
    place(scene, scene.add_mesh(FLOOR, QUAD), grey, at(0, 0, 0), shadow_catcher=True)
    scene.add_camera(above(8), fov=fov)
    return scene


def place(scene, mesh, material, transform, **visibility):
    scene.put_instances(mesh, [material], np.array([transform], "f8"), visibility=visibility)


def disk(scene, height, radius=1.0, centre=0.0, **visibility):
    """A black disk that floats over the catcher."""
    angle = np.arange(DISK) / DISK * 2 * np.pi
    rim = np.stack([radius * np.cos(angle), np.zeros(DISK), radius * np.sin(angle)], -1)
    points = np.concatenate([[[0, 0, 0]], rim]).astype("f4")
    triangles = np.stack([np.zeros(DISK), np.arange(DISK) + 1, (np.arange(DISK) + 1) % DISK + 1], -1).astype("i4")
    black = scene.add_material(base_color=(0.0, 0.0, 0.0), specular_weight=0.0)
    place(scene, scene.add_mesh(points, triangles), black, at(centre, height, 0), **visibility)


def passes(scene):
    film = finished(scene)
    return [np.asarray(film[name]) for name in ("color", "alpha", "luminance")]


@pytest.mark.parametrize("integrator", ["path", "direct"])
def test_fog_before_a_catcher_covers_by_what_it_takes(integrator):
    """4 m of fog, where 1 - exp(-0.2 * 4) of the rays scatter, take as much of the catcher's light; scattered light brings some of that back."""
    scene = caught(samples=1024, fov=0.1, integrator=integrator)
    scene.add_light("distant", (900.0,) * 3, transform=[[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], visible=False)
    box(scene, (-1.0, 1.0, -1.0), (1.0, 5.0, 1.0), scattering=0.2)
    color, alpha, _ = passes(scene)
    least, most = -np.expm1(-0.8), -np.expm1(-1.6)
    if integrator == "direct":
        np.testing.assert_allclose(alpha.mean(), most, atol=1e-3)
    else:
        assert least + 0.1 < alpha.mean() < most - 0.01
    assert np.isfinite(color).all() and color[..., :3].mean() > 0.0


@pytest.mark.parametrize(("scattering", "absorption"), [(0.0, 0.4), (0.2, 0.2), (0.0, (0.4, 0.4, 0.4))])
@pytest.mark.parametrize("varies", [False, True])
def test_dark_smoke_before_a_catcher_covers_it(scattering, absorption, varies):
    """2 m of it, beside the light's way: what does not come through covers, whether smoke scatters or takes it."""
    scene = caught(samples=1024, fov=0.1, integrator="direct")
    sideways = [[1, 0, 0, 0], [0, 0.5, 0.8660254, 0], [0, -0.8660254, 0.5, 0], [0, 0, 0, 1]]
    scene.add_light("distant", (900.0,) * 3, transform=sideways, visible=False)
    if varies:
        placed = [[1, 0, 0, -0.5], [0, 1, 0, 4.0], [0, 0, 1, -0.5], [0, 0, 0, 1]]
        scene.add_volume(np.ones((2, 4, 2), "f4"), voxel=0.5, transform=placed, scattering=scattering, absorption=absorption)
    else:
        box(scene, (-0.5, 4.0, -0.5), (0.5, 6.0, 0.5), scattering=scattering, absorption=absorption)
    _, alpha, _ = passes(scene)
    np.testing.assert_allclose(alpha.mean(), -np.expm1(-0.8), atol=4e-3)


@pytest.mark.parametrize("integrator", ["path", "direct"])
def test_dark_smoke_before_a_floor_covers_all(integrator):
    """Smoke that only absorbs takes the floor's light, and neither lets anything of the background pass."""
    scene = gonio.Scene()
    scene.set(width=16, height=16, samples=256, film_transparent=True, passes=["color", "alpha"], integrator=integrator)
    scene.add_instance(scene.add_mesh(FLOOR, QUAD), [scene.add_material(base_color=(0.5,) * 3, specular_weight=0.0)])
    scene.add_camera(above(8), fov=0.1)
    scene.add_light("distant", (900.0,) * 3, transform=[[1, 0, 0, 0], [0, 0.5, 0.8660254, 0], [0, -0.8660254, 0.5, 0], [0, 0, 0, 1]], visible=False)
    placed = [[1, 0, 0, -0.5], [0, 1, 0, 4.0], [0, 0, 1, -0.5], [0, 0, 0, 1]]
    scene.add_volume(np.ones((2, 4, 2), "f4"), voxel=0.5, transform=placed, scattering=0.0, absorption=0.4)
    film = finished(scene)
    np.testing.assert_allclose(np.asarray(film["alpha"]), 1.0, atol=1e-6)


@pytest.mark.parametrize("low", [-1.0, 0.0])
def test_fog_on_a_catcher_is_no_part_of_its_own_light(low):
    """Fog that the catcher lies in: without the objects there is none, so that the way of the light counts too."""
    scene = caught(samples=1024, fov=0.1, integrator="direct")
    scene.add_light("distant", (900.0,) * 3, transform=[[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], visible=False)
    box(scene, (-1.0, low, -1.0), (1.0, 2.0, 1.0), absorption=0.2)
    _, alpha, _ = passes(scene)
    np.testing.assert_allclose(alpha.mean(), -np.expm1(-0.8), atol=4e-3)


@pytest.mark.parametrize("transparent", [True, False])
def test_nothing_is_caught_where_nothing_is(transparent):
    scene = caught(transparent=transparent, fov=80)
    scene.add_light("dome", (2.0, 3.0, 4.0))
    scene.add_light("distant", (500.0, 500.0, 500.0), visible=False)
    color, alpha, luminance = passes(scene)
    # Both halves of a path draw the same numbers: without objects they bring the same to the last bit.
    expected = [0.0, 0.0, 0.0, 0.0] if transparent else [2.0, 3.0, 4.0, 1.0]
    assert color == pytest.approx(np.broadcast_to(expected, color.shape), rel=1e-6)
    assert (alpha == expected[3]).all()
    assert luminance == pytest.approx(np.full(luminance.shape, 0.2126 * expected[0] + 0.7152 * expected[1] + 0.0722 * expected[2]), rel=1e-6)


@pytest.mark.parametrize("height", [0.5, 1.0, 3.0])
def test_a_disk_takes_its_share_of_an_even_sky(height):
    scene = caught(samples=1024, fov=0.5, max_bounces=0)
    scene.add_light("dome", (1.0, 1.0, 1.0))
    disk(scene, height, camera=False)
    color, alpha, _ = passes(scene)
    # The form factor of a disk over the point under its middle, r² / (r² + h²).
    expected = 1.0 / (1.0 + height**2)
    assert alpha.mean() == pytest.approx(expected, rel=0.01)
    assert not color[..., :3].any() and np.array_equal(color[..., 3:], alpha)


def test_a_sun_casts_a_sharp_shadow():
    for centre, expected in ((0.0, 1.0), (2.0, 0.0)):
        scene = caught(samples=16)
        # Distant lights shine along −z; this one comes from straight above.
        scene.add_light("distant", (100.0,) * 3, angle=0.001, transform=above(0))
        disk(scene, 1.0, centre=centre, camera=False)
        assert (passes(scene)[1] == expected).all()


def test_the_background_is_dimmed_and_covered():
    scene = caught(samples=1024, fov=0.5, max_bounces=0, transparent=False)
    scene.add_light("dome", (1.0, 2.0, 3.0))
    disk(scene, 1.0, camera=False)
    color, alpha, _ = passes(scene)
    assert color[..., :3].mean(axis=(0, 1)) == pytest.approx([0.5, 1.0, 1.5], rel=0.01)
    assert (alpha == 1.0).all() and (color[..., 3] == 1.0).all()


def test_objects_are_seen_and_those_behind_are_not():
    scene = caught(fov=20)
    scene.add_light("dome", (1.0, 1.0, 1.0))
    disk(scene, -1.0)
    assert not passes(scene)[1].any()
    disk(scene, 1.0, radius=0.3)
    color, alpha, _ = passes(scene)
    assert alpha[7:9, 7:9].min() == 1.0 and not color[7:9, 7:9, :3].any()
    assert 0.0 < alpha[0, 0, 0] < 0.2


def test_objects_that_shine_take_nothing():
    scene = caught(samples=64, fov=0.5)
    scene.add_light("dome", (1.0, 1.0, 1.0))
    glow = scene.add_material(emission_color=(50.0, 50.0, 50.0))
    place(scene, scene.add_mesh(FLOOR * 0.02, QUAD), glow, at(0, 1, 0), camera=False)
    color, alpha, _ = passes(scene)
    assert not alpha.any() and not color.any()


def test_light_that_objects_scatter_fills_shadows():
    def mean(bounces):
        scene = caught(samples=256, fov=0.5, max_bounces=bounces)
        scene.add_light("dome", (1.0, 1.0, 1.0))
        white = scene.add_material(base_color=(1.0, 1.0, 1.0), specular_weight=0.0)
        wall = np.array([[0.5, 0, -2], [0.5, 0, 2], [0.5, 4, 2], [0.5, 4, -2]], "f4")
        place(scene, scene.add_mesh(wall, QUAD), white, at(0, 0, 0))
        return passes(scene)[1].mean()

    assert mean(4) < 0.5 * mean(0)


def test_what_is_seen_through_holes_is_no_catcher():
    scene = caught(samples=256)
    half = scene.add_material(base_color=(0.5, 0.5, 0.5), geometry_opacity=0.5, specular_weight=0.0)
    place(scene, 0, half, at(0, 1, 0), shadow_catcher=True)
    scene.add_light("dome", (1.0, 1.0, 1.0))
    white = scene.add_material(base_color=(1.0, 1.0, 1.0), specular_weight=0.0)
    place(scene, 0, white, at(0, 0.5, 0), shadow=False, diffuse=False)
    # Half of the samples go through the upper catcher and meet the sheet under it.
    assert passes(scene)[1].mean() == pytest.approx(0.5, abs=0.01)


def test_data_passes_show_catchers():
    scene = caught(passes=["depth", "normal", "alpha"])
    scene.add_light("dome", (1.0, 1.0, 1.0))
    film = finished(scene)
    assert np.asarray(film["depth"]).mean() == pytest.approx(8.0, rel=1e-5)
    assert np.asarray(film["normal"])[..., 1] == pytest.approx(np.ones((16, 16)))
