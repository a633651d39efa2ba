"""Media that vary: grids of densities and of heat, against quadrature, furnaces and even media."""

import math

import gonio
import numpy as np
import pytest
from gonio.medium import medium, volume_material
from small_scenes import closure, finished
from test_media import box, looking, seen, within


def smooth(shape, seed=1):
    """An array that varies gently, with zeros in a corner."""
    axes = [np.linspace(0.0, 1.0, n) for n in shape]
    x, y, z = np.meshgrid(*axes, indexing="ij")
    made = 0.5 + 0.5 * np.sin(7.0 * x + 3.0 * seed) * np.cos(5.0 * y) * np.sin(4.0 * z + 1.0)
    made[x + y + z < 0.5] = 0.0
    return made.astype("f4")


def value(array, point):
    """The trilinear value of an array at a point in voxels from its corner; its outermost values reach to its faces."""
    at = [min(max(c - 0.5, 0.0), n - 1.0) for c, n in zip(point, array.shape, strict=True)]
    low = [min(int(c), n - 2) if n > 1 else 0 for c, n in zip(at, array.shape, strict=True)]
    total = 0.0
    for corner in np.ndindex(2, 2, 2):
        weight = math.prod((c - l) if s else 1.0 - (c - l) for c, l, s in zip(at, low, corner, strict=True))
        if weight:
            total += weight * array[tuple(l + s for l, s in zip(low, corner, strict=True))]
    return total


def depth(array, start, end, steps=4000):
    """Optical depth of a way through an array of voxels of edge 1."""
    start, end = np.array(start, float), np.array(end, float)
    places = [start + (end - start) * (i + 0.5) / steps for i in range(steps)]
    return sum(value(array, place) for place in places) * np.linalg.norm(end - start) / steps


def test_what_absorbs_dims_as_quadrature_says():
    array = smooth((20, 11, 9))
    expected = math.exp(-0.2 * depth(array, (5.3, 4.2, 0.0), (5.3, 4.2, 9.0)))
    scene = looking((5.3, 4.2, 20.0), (5.3, 4.2, 0.0))
    scene.add_light("dome")
    scene.add_volume(array, scattering=0.0, absorption=0.2)
    found, error = seen(scene, 256)
    within(found.mean(), error, expected)


def test_light_is_dimmed_on_its_way_to_a_meter():
    array = smooth((20, 11, 9))
    scene = gonio.Scene()
    scene.put_meter({"origin": "meter", "position": [5.3, 4.2, -1.0], "normal": [0.0, 0.0, 1.0]})
    scene.add_light("point", (100.0,) * 3, transform=[[1, 0, 0, 7.3], [0, 1, 0, 5.2], [0, 0, 1, 12.0], [0, 0, 0, 1]])
    scene.add_volume(array, scattering=0.0, absorption=0.2)
    meter = gonio.measure(scene, samples=32768).meters[0]
    start, way = np.array([5.3, 4.2, -1.0]), np.array([2.0, 1.0, 13.0])
    ends = [start + way * (part / 13.0) for part in (1.0, 10.0)]
    clear = gonio.Scene()
    clear.put_meter({"origin": "meter", "position": [5.3, 4.2, -1.0], "normal": [0.0, 0.0, 1.0]})
    clear.add_light("point", (100.0,) * 3, transform=[[1, 0, 0, 7.3], [0, 1, 0, 5.2], [0, 0, 1, 12.0], [0, 0, 0, 1]])
    expected = gonio.measure(clear, samples=16).meters[0].value * math.exp(-0.2 * depth(array, *ends))
    within(meter.value, meter.standard_error, expected, 0.01)


def test_a_furnace_of_smoke():
    scene = looking((10.0, 5.0, 30.0), (10.0, 5.0, 0.0), degrees=60.0, size=16)
    scene.add_light("dome")
    scene.add_volume(smooth((20, 11, 9)), scattering=[0.5, 2.0, 5.0], anisotropy=0.3)
    box(scene, (4.0, -1.0, -3.0), (12.0, 6.0, 12.0), scattering=0.1, anisotropy=-0.4)
    found, error = seen(scene, 256)
    assert found == pytest.approx([1.0] * 3, abs=0.01) and error < 0.003


@pytest.mark.parametrize("lamp", ["outside", "inside", "sun"])
def test_a_grid_of_ones_is_an_even_medium(lamp):
    found = []
    for even in (True, False):
        scene = looking((2.0, 2.5, 9.0), (0.2, 0.1, 0.0), degrees=40.0, size=16)
        if lamp == "sun":
            scene.add_light("distant", transform=gonio.look_at((1, 3, 0), (0, 0, 0), (0, 0, 1)))
        else:
            height = 0.3 if lamp == "inside" else 2.5
            scene.add_light("sphere", (40.0,) * 3, radius=0.2, transform=[[1, 0, 0, 0.1], [0, 1, 0, height], [0, 0, 1, 0.2], [0, 0, 0, 1]])
        parts = {"scattering": (0.9, 0.7, 0.4), "absorption": (0.1, 0.05, 0.6), "anisotropy": 0.5}
        if even:
            box(scene, (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0), **parts)
        else:
            place = [[1, 0, 0, -1.0], [0, 1, 0, -1.0], [0, 0, 1, -1.0], [0, 0, 0, 1]]
            scene.add_volume(np.ones((5, 4, 8), "f4"), voxel=(0.4, 0.5, 0.25), transform=place, **parts)
        found.append(seen(scene, 1024))
    (even, error), (grid, other) = found
    assert grid == pytest.approx(even, abs=4.0 * math.hypot(error, other) + 0.004 * even.mean()), (found,)


def test_heat_shines_by_its_table():
    array = smooth((20, 11, 9))
    table = [(0.0, 0.0, 0.0), (1.0, 0.5, 0.0), (2.0, 0.5, 4.0)]
    scene = looking((5.3, 4.2, 20.0), (5.3, 4.2, 0.0))
    scene.add_volume(np.zeros_like(array), heat=array, emission=3.0, glow=table)
    found, _ = seen(scene, 256)
    steps, hottest = 4000, float(array.max())
    heats = [value(array, (5.3, 4.2, 9.0 * (i + 0.5) / steps)) / hottest * 2.0 for i in range(steps)]
    expected = [3.0 * 9.0 * np.mean([np.interp(heat, [0.0, 1.0, 2.0], [row[c] for row in table]) for heat in heats]) for c in range(3)]
    assert found == pytest.approx(expected, rel=0.01)


def test_even_emission_behind_smoke_that_takes_it():
    # Both in one box: emission a metre, extinction a metre of each.
    scene = looking((1.0, 1.0, 9.0), (1.0, 1.0, 0.0))
    box(scene, (-1.0, -1.0, 0.0), (3.0, 3.0, 2.0), absorption=0.3, emission=2.0)
    scene.add_volume(np.ones((2, 2, 2), "f4"), scattering=0.0, absorption=0.5)
    found, error = seen(scene, 1024)
    within(found.mean(), error, 2.0 * -math.expm1(-0.8 * 2.0) / 0.8)


@pytest.mark.parametrize(("even", "varying"), [(0.1, 0.0), (0.0, 0.3), (0.1, 0.3)])
def test_haze_and_fire_in_balance_are_not_seen(even, varying):
    """Where media send what they absorb of even light of 1, and scatter besides, there is light of 1 everywhere (Kirchhoff)."""
    scene = looking((1.0, 1.0, 9.0), (1.0, 1.0, 0.0))
    scene.add_light("dome", (1.0,) * 3)
    box(scene, (-1.0, -1.0, 0.0), (3.0, 3.0, 2.0), absorption=even, scattering=0.4, emission=even)
    scene.add_volume(np.ones((2, 2, 2), "f4"), scattering=0.2, absorption=varying, emission=varying)
    found, error = seen(scene, 4096)
    within(found.mean(), error, 1.0)


def test_smoke_keeps_the_flux_of_its_lamp():
    scene = gonio.Scene()
    scene.add_light("point", transform=[[1, 0, 0, 9.3], [0, 1, 0, 4.2], [0, 0, 1, 5.1], [0, 0, 0, 1]])
    scene.add_volume(smooth((20, 11, 9)), scattering=0.8, anisotropy=0.4)
    reading = gonio.goniometer(scene, rays=200_000)
    assert reading.light_output_ratio.value == pytest.approx(1.0, abs=1e-3)


def test_what_is_no_field_is_told():
    scene = gonio.Scene()
    with pytest.raises(ValueError, match=r"the shape is \[2, 2\], expected \(nx, ny, nz\)"):
        scene.add_volume(np.ones((2, 2), "f4"))
    with pytest.raises(ValueError, match="is NaN, expected a finite number"):
        scene.add_volume(np.full((2, 2, 2), np.nan, "f4"))
    with pytest.raises(gonio.Error, match="no_such.vdb"):
        scene.add_volume(("no_such.vdb", "density"))
    scene.add_volume(np.ones((2, 2, 2), "f4"), transform=[[0, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    scene.add_camera(None)
    scene.add_light("dome")
    scene.set(width=2, height=2, samples=1)
    with gonio.Render(scene) as render:
        assert render.wait()
        assert any("the volume is left out" in str(told) for told in render.diagnostics)


def test_the_same_bits_whatever_the_threads():
    pictures = []
    for threads in (1, 2):
        scene = looking((10.0, 5.0, 30.0), (10.0, 5.0, 0.0), degrees=60.0, size=48)
        scene.add_light("dome")
        scene.add_volume(smooth((20, 11, 9)), scattering=1.0, absorption=0.1)
        scene.set(samples=4, threads=threads)
        pictures.append(np.asarray(finished(scene)["color"]).tobytes())
    assert pictures[0] == pictures[1]


def test_light_along_a_lattice_is_not_lost():
    # A sun over a long box: its rays have no component across the lattice.
    scene = gonio.Scene()
    scene.put_meter({"origin": "meter", "position": [1.0, 1.0, -1.0], "normal": [0.0, 0.0, 1.0]})
    scene.add_light("distant", (1e6,) * 3, angle=0.0)
    clear = gonio.measure(scene, samples=16).meters[0].value
    scene.add_volume(np.ones((2, 2, 300), "f4"), scattering=0.0, absorption=0.002)
    meter = gonio.measure(scene, samples=16384).meters[0]
    within(meter.value, meter.standard_error, clear * math.exp(-0.6), 0.01)


def test_smoke_that_touches_glass_sends_no_light_of_its_own():
    """Where faces coincide a ray may carry smoke's name out into the open: nothing collides there, however far it goes."""
    scene = gonio.Scene()
    scene.add_light("dome", (7.0, 7.0, 7.0))
    # Two voxels of 1 m a way: from 1 m to the pane at 3 m.
    scene.add_volume(np.ones((2, 2, 2), "f4"), transform=[[1, 0, 0, -0.5], [0, 1, 0, 1], [0, 0, 1, -0.5], [0, 0, 0, 1]], scattering=1.0)
    pane = closure("OpenPbr", transmission_weight=1.0, specular_roughness=0.0)
    pane["solid"] = medium(scattering=2.0)
    box(scene, (-3, 3, -3), (3, 3.1, 3), [pane])
    scene.add_camera(gonio.look_at((0.0, 0.1, 0.0), (0.0, 3.0, 0.01), up=(0.0, 0.0, 1.0)), fov=60.0)
    scene.set(width=48, height=48, samples=64, max_bounces=6, caustics="off")
    shown = np.asarray(finished(scene)["color"])[..., :3]
    assert np.isfinite(shown).all()
    assert shown.min() >= 0.0 and shown.max() < 8.0


def coloured_box(scene, taken, sent=None, **coefficients):
    """A box of 2 m of voxels of 0.25 m with these arrays of colours about the origin."""
    taken = np.broadcast_to(np.asarray(taken, "f4"), (8, 8, 8, 6))
    described = {"origin": "box", "to_world": {"columns": [[0.25, 0, 0], [0, 0.25, 0], [0, 0, 0.25], [-0.875] * 3]}}
    arrays = {"density": np.ascontiguousarray(taken[..., :3].max(axis=-1)), "taken": np.ascontiguousarray(taken)}
    if sent is not None:
        arrays["sent"] = np.ascontiguousarray(np.broadcast_to(np.asarray(sent, "f4"), (8, 8, 8, 3)))
    field = scene.put_field(described, **arrays)
    mesh, place = scene.put_field_box(field)
    material = scene.put_material(volume_material("box", {**medium(**coefficients), "field": field}))
    scene.add_instance(mesh, [material], transform=place)


def test_colours_that_vary_dim_as_they_are():
    """Half of the way through red smoke and half through blue, by Beer and Lambert; even colours as those of an even medium."""
    taken = np.zeros((8, 8, 8, 6), "f4")
    taken[:, :, :4, :3], taken[:, :, 4:, :3] = (0.2, 1.0, 0.5), (1.0, 0.1, 0.3)
    scene = looking((0.0, 0.0, 5.0), (0.0, 0.0, 0.0))
    scene.add_light("dome", (1.0,) * 3)
    coloured_box(scene, taken, absorption=1.5)
    found, _ = seen(scene, 1024)
    # From the middle of one voxel to that of the next colours go straight over.
    depth = 1.5 * 0.25 * (4.0 * np.array([0.2, 1.0, 0.5]) + 4.0 * np.array([1.0, 0.1, 0.3]))
    assert found == pytest.approx(np.exp(-depth), rel=0.02)


def test_even_colours_are_an_even_medium():
    """Scattered and sent light of arrays whose numbers are the same everywhere."""
    found = []
    for is_field in (False, True):
        scene = looking((0.0, 0.0, 5.0), (0.0, 0.0, 0.0), size=16, degrees=20.0)
        scene.add_light("dome", (1.0,) * 3)
        if is_field:
            coloured_box(scene, [0.3, 0.8, 1.0, 0.3, 0.4, 0.1], sent=[1.0, 0.5, 0.0], scattering=2.0, emission=0.5)
        else:
            box(scene, (-1.0,) * 3, (1.0,) * 3, scattering=(0.6, 0.8, 0.2), absorption=(0.0, 0.8, 1.8), emission=(0.5, 0.25, 0.0))
        found.append(seen(scene, 256)[0])
    assert found[1] == pytest.approx(found[0], rel=0.01)
