"""What fills all of space by a field: closed forms along straight ways, and a body that holds the same."""

import math

import gonio
import numpy as np
import pytest
from gonio.medium import medium, volume_material
from test_media import looking, seen, within

# A hundred voxels a metre high, and wide without an end that matters.
WIDE = 1e4


def air(scene, density, columns, beyond=None, heat=None, **coefficients):
    """Fills space with a field, whose columns lead from voxels to the world."""
    described = {"origin": "air", "to_world": {"columns": columns}, **({} if beyond is None else {"beyond": beyond})}
    arrays = {} if heat is None else {"heat": np.asarray(heat, "f4")}
    field = scene.put_field(described, density=np.asarray(density, "f4"), **arrays)
    scene.put_atmosphere({**medium(**coefficients), "field": field})


def layers(scene, density, **coefficients):
    """Space of which each metre along z, from 0 on, has a density."""
    air(scene, np.reshape(density, (1, 1, -1)), [[WIDE, 0, 0], [0, WIDE, 0], [0, 0, 1], [0, 0, 0.5]], **coefficients)


@pytest.mark.parametrize("degrees", [0.0, 70.0])
def test_a_sun_is_dimmed_by_all_of_its_way(degrees):
    """Height fog that thins out: e to the power of minus the integral of its density over the cosine."""
    density = np.linspace(1.0, 0.0, 100)
    towards = (math.sin(math.radians(degrees)), 0.0, math.cos(math.radians(degrees)))
    found = []
    for filled in (False, True):
        scene = gonio.Scene()
        scene.put_meter({"origin": "meter", "position": [0.0, 0.0, 0.0], "normal": [0.0, 0.0, 1.0]})
        scene.add_light("distant", (1e6,) * 3, angle=0.0, transform=gonio.look_at(towards, (0, 0, 0), (0, 1, 0)))
        if filled:
            layers(scene, density, absorption=0.01)
        found.append(gonio.measure(scene, samples=131072 if filled else 16).meters[0])
    expected = math.exp(-0.01 * density.sum() / towards[2])
    within(found[1].value / found[0].value, found[1].standard_error / found[0].value, expected, 0.01)


def test_a_sky_lights_the_ground_as_the_exponential_integral_says():
    """2 E₃ of the optical depth of all layers: .600084 at 0.3."""
    found = []
    for filled in (False, True):
        scene = gonio.Scene()
        scene.put_meter({"origin": "meter", "position": [0.0, 0.0, 0.0], "normal": [0.0, 0.0, 1.0]})
        scene.add_light("dome")
        if filled:
            layers(scene, np.linspace(1.0, 0.0, 100), absorption=0.006)
        found.append(gonio.measure(scene, samples=65536 if filled else 4096).meters[0])
    within(found[1].value / found[0].value, found[1].standard_error / found[0].value, 0.600084)


def test_a_sky_is_seen_through_it():
    density = np.linspace(1.0, 0.0, 100)
    scene = looking((0.0, 0.0, 20.0), (0.0, 3.0, 24.0))
    scene.add_light("dome")
    layers(scene, density, absorption=0.02)
    found, error = seen(scene, 1024)
    height = np.interp(np.linspace(20.0, 100.0, 8001), np.arange(100) + 0.5, density)
    within(found.mean(), error, math.exp(-0.02 * height[:-1].mean() * 80.0 / 0.8))


def test_the_outermost_values_go_on():
    """A row of eight voxels, 40 more before it and 12 behind."""
    density = np.linspace(0.2, 1.0, 8).reshape(8, 1, 1)
    columns = [[1, 0, 0], [0, WIDE, 0], [0, 0, WIDE], [0.5, 0, 0]]
    found = {}
    for side in (1.0, -1.0):
        scene = looking((4.0, 0.0, 0.0), (4.0 + side, 0.0, 0.0))
        scene.add_light("dome")
        air(scene, density, columns, [[40.0, 0.0, 0.0], [12.0, 0.0, 0.0]], absorption=0.05)
        found[side] = seen(scene, 4096)
    row = np.interp(np.linspace(0.0, 8.0, 8001), np.arange(8) + 0.5, density.ravel())
    for side, inner, outer in ((1.0, row[4000:-1].mean() * 4.0, 12.0 * 1.0), (-1.0, row[:4000].mean() * 4.0, 40.0 * 0.2)):
        within(found[side][0].mean(), found[side][1], math.exp(-0.05 * (inner + outer)))


def test_it_shines_as_far_as_it_goes():
    scene = looking((0.0, 0.0, 20.0), (0.0, 0.0, 21.0))
    density, heat = np.ones((1, 1, 100)), np.linspace(0.0, 2.0, 100).reshape(1, 1, -1)
    air(scene, density, [[WIDE, 0, 0], [0, WIDE, 0], [0, 0, 1], [0, 0, 0.5]], heat=heat, emission=0.25)
    found, _ = seen(scene, 1024)
    height = np.interp(np.linspace(20.0, 100.0, 8001), np.arange(100) + 0.5, heat.ravel())
    assert found == pytest.approx([0.25 * 80.0 * height[:-1].mean()] * 3, rel=0.01)


def test_it_scatters_as_a_body_of_it_does():
    """The field in all of space, and the box of the same field as a volume, from outside."""
    found = []
    for is_air in (True, False):
        scene = looking((3.0, -14.0, 6.0), (0.0, 0.0, 3.0), size=16, degrees=40.0)
        scene.add_light("dome", (0.5,) * 3)
        scene.add_light("sphere", (60.0,) * 3, radius=0.3, transform=[[1, 0, 0, 1.0], [0, 1, 0, 0], [0, 0, 1, 2.5], [0, 0, 0, 1]])
        described = {"origin": "fog", "to_world": {"columns": [[1, 0, 0], [0, 1, 0], [0, 0, 1], [-3.5, -3.5, 0.5]]}, "beyond": [[2.0] * 3, [1.0] * 3]}
        density = np.linspace(1.0, 0.2, 8 * 8 * 6).reshape(8, 8, 6).astype("f4")
        field = scene.put_field(described, density=density)
        fog = {**medium(scattering=(0.3, 0.2, 0.1), absorption=0.05, anisotropy=0.4), "field": field}
        if is_air:
            scene.put_atmosphere(fog)
        else:
            mesh, place = scene.put_field_box(field)
            scene.add_instance(mesh, [scene.put_material(volume_material("fog", fog))], transform=place)
        found.append(seen(scene, 1024))
    (air_seen, error), (body, other) = found
    assert air_seen == pytest.approx(body, abs=4.0 * math.hypot(error, other) + 0.004 * body.mean()), found


def test_files_and_fields_that_are_not_there(tmp_path):
    scene = gonio.Scene()
    with pytest.raises(gonio.Error, match="beyond is of arrays"):
        scene.put_field({"origin": "smoke", "beyond": [[1.0] * 3] * 2}, density=(tmp_path / "smoke.vdb", "density"))
