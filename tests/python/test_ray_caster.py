"""Rays of one's own: what they meet, in numbers that are known."""

import gonio
import numpy
import pytest

FAR = 1000.0


def move(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def square(scene, **more):
    """Two triangles in z = 0 over [0, 2]², seen from +z."""
    points = numpy.array([[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0]], "f4")
    uvs = numpy.array([[0, 0], [1, 0], [1, 1], [0, 1]], "f4")
    return scene.add_mesh(points, numpy.array([[0, 1, 2], [0, 2, 3]], "i4"), uvs=uvs, **more)


def two_squares():
    scene = gonio.Scene()
    dark, light, lamp = (scene.add_material(base_color=(x,) * 3) for x in (0.1, 0.9, 0.5))
    mesh = square(scene, slots=numpy.array([0, 1], "i4"))
    scene.add_instance(mesh, [dark, light], transform=move(FAR, 0, 0))
    places = numpy.array([move(FAR, 0, -3), move(FAR + 10, 0, -3)], "f8")
    scene.put_instances(mesh, [lamp, lamp], places)
    # Lights block nothing, whether they stand alone or with many.
    scene.add_light("sphere", (1.0,) * 3, radius=0.2, transform=move(FAR + 1.5, 0.5, 2))
    return scene


def test_hits_are_where_the_surfaces_are():
    down = (0.0, 0.0, -2.0)
    origins = numpy.array([[FAR + 1.5, 0.5, 5], [FAR + 0.5, 1.5, 5], [FAR + 11, 0.5, 5], [FAR + 5, 0.5, 5]])
    hits = gonio.RayCaster(two_squares()).first_hits(origins, numpy.array(down))
    assert len(hits) == 4
    assert numpy.asarray(hits.hit).tolist() == [1, 1, 1, 0]
    assert numpy.asarray(hits.distance)[:3] == pytest.approx([5, 5, 8]) and numpy.isinf(numpy.asarray(hits.distance)[3])
    position = numpy.asarray(hits.position)
    assert position[:3] == pytest.approx(numpy.array([[FAR + 1.5, 0.5, 0], [FAR + 0.5, 1.5, 0], [FAR + 11, 0.5, -3]]), abs=1e-4)
    assert numpy.isnan(position[3]).all() and numpy.isnan(numpy.asarray(hits.uv)[3]).all()
    for normal in (hits.normal, hits.geometric_normal):
        assert numpy.asarray(normal)[:3] == pytest.approx(numpy.array([[0, 0, 1]] * 3))
    assert numpy.asarray(hits.uv)[:3] == pytest.approx(numpy.array([[0.75, 0.25], [0.25, 0.75], [0.5, 0.25]]), abs=1e-4)
    numbers = [numpy.asarray(values).tolist() for values in (hits.instance, hits.placement, hits.material, hits.triangle)]
    assert numbers == [[0, 0, 1, -1], [0, 0, 1, -1], [0, 1, 2, -1], [0, 1, 0, -1]]
    assert numpy.asarray(hits.triangle).dtype == numpy.int32


def test_one_origin_and_a_greatest_distance():
    caster = gonio.RayCaster(two_squares())
    angles = numpy.linspace(0.0, 2.0 * numpy.pi, 9000)
    directions = numpy.stack([numpy.sin(angles), 0 * angles, numpy.cos(angles)], axis=-1)
    origin = (FAR + 1.0, 1.0, 1.0)
    hits = caster.first_hits(numpy.array([origin]), directions.astype("f4"))
    met, distance = numpy.asarray(hits.hit) == 1, numpy.asarray(hits.distance)
    below = met & (numpy.asarray(hits.instance) == 0)
    assert below.any() and distance[below] == pytest.approx(-1.0 / directions[below, 2], rel=1e-4)
    points = numpy.array(origin) + directions[met] * distance[met, None]
    assert numpy.asarray(hits.position)[met] == pytest.approx(points, abs=1e-3)
    near = caster.first_hits(numpy.array([origin]), directions, max_distance=1.05)
    assert numpy.array_equal(numpy.asarray(near.hit) == 1, met & (distance <= 1.05))


def test_spheres_have_smooth_normals_and_no_coordinates():
    scene = gonio.Scene()
    points = scene.add_points(numpy.array([[0.0, 0.0, 0.0]], "f4"), 2.0)
    scene.add_instance(points=points, materials=[scene.add_material()])
    hits = gonio.RayCaster(scene).first_hits(numpy.array([[0.6, 0.0, 5.0]]), numpy.array([[0.0, 0.0, -1.0]]))
    assert numpy.asarray(hits.normal)[0] == pytest.approx([0.6, 0.0, 0.8], abs=1e-4)
    assert numpy.asarray(hits.distance)[0] == pytest.approx(4.2, abs=1e-4) and numpy.isnan(numpy.asarray(hits.uv)).all()


def test_empty_scenes_and_wrong_shapes():
    caster = gonio.RayCaster(gonio.Scene())
    assert not numpy.asarray(caster.first_hits(numpy.zeros((3, 3)), numpy.array([0.0, 0.0, 1.0])).hit).any()
    # No direction, or none that is a number, meets nothing.
    odd = numpy.array([[0.0, 0.0, 0.0], [numpy.nan, 0.0, 1.0]])
    assert not numpy.asarray(gonio.RayCaster(two_squares()).first_hits(numpy.zeros((2, 3)), odd).hit).any()
    with pytest.raises(gonio.SettingError, match="2 were found for 3"):
        caster.first_hits(numpy.zeros((3, 3)), numpy.ones((2, 3)))
    with pytest.raises(ValueError, match="expected \\(N, 3\\)"):
        caster.first_hits(numpy.zeros((3, 4)), numpy.ones((3, 3)))
    with pytest.raises(gonio.SettingError, match="max_distance"):
        caster.first_hits(numpy.zeros((3, 3)), numpy.ones((3, 3)), max_distance=0.0)
