"""Light between matt walls of one reflectance ρ (CIE 171, 5.8): in any closed room the mean illuminance is Φ / (S (1 − ρ)), where S is its area."""

import math

import confidence
import form_factors
import numpy
import pytest
from rooms import Room, box_faces

pytestmark = pytest.mark.validate

SECTION = "Interreflection"
LUMENS = 1000.0
REFLECTANCES = [0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95]
GRID = (16, 16)
SAMPLES = 16


def mean_of_faces(size, reflectance, place):
    """Mean illuminance of all faces of a box with a point source, one value a seed."""
    room = Room()
    room.add(*box_faces(size), reflectance=reflectance)
    room.light("Point", LUMENS / (4 * math.pi), place)
    total = 0.0
    for face in box_faces(size):
        found = room.illuminance(face, GRID, SAMPLES, averaged=True, bounces=2048)
        total = total + found.mean(axis=(1, 2)) * face.area
    return total / area(size)


def area(size):
    return sum(face.area for face in box_faces(size))


def hold(case, size, reflectance, place):
    expected = LUMENS / (area(size) * (1 - reflectance))
    confidence.hold(SECTION, case, "Φ / (S (1 − ρ))", mean_of_faces(size, reflectance, place)[:, None], numpy.array([expected]))


@pytest.mark.parametrize("reflectance", REFLECTANCES)
def test_cube_of_four_metres(reflectance):
    hold(f"cube 4 m, light in the middle, ρ = {reflectance}", (4.0, 4.0, 4.0), reflectance, (0, 0, 0))


@pytest.mark.parametrize("reflectance", [0.5, 0.9])
def test_corridor_with_a_light_near_its_end(reflectance):
    hold(f"corridor 12 m × 2 m × 2.5 m, light near an end, ρ = {reflectance}", (12.0, 2.0, 2.5), reflectance, (5.2, 0.3, 0.8))


def sphere(rows):
    """Points and triangles of a sphere of 1 m with twice as many columns as rows."""
    polar = numpy.pi * numpy.arange(rows + 1) / rows
    around = numpy.pi * numpy.arange(2 * rows) / rows
    points = numpy.stack(
        [numpy.outer(numpy.sin(polar), f(around)) for f in (numpy.cos, numpy.sin)] + [numpy.outer(numpy.cos(polar), around * 0 + 1)], -1
    )
    first = numpy.arange(rows)[:, None] * 2 * rows + numpy.arange(2 * rows)
    second = numpy.arange(rows)[:, None] * 2 * rows + (numpy.arange(2 * rows) + 1) % (2 * rows)
    upper = numpy.stack([first, first + 2 * rows, second + 2 * rows], -1)[: rows - 1]
    lower = numpy.stack([first, second + 2 * rows, second], -1)[1:]
    return points.reshape(-1, 3), numpy.concatenate([upper.reshape(-1, 3), lower.reshape(-1, 3)])


@pytest.mark.parametrize("reflectance", [0.5, 0.9])
def test_integrating_sphere(reflectance):
    """Everywhere the same, wherever the light is: Φ (ρ / (1 − ρ) + its own share) / 4 π R²; here from the middle, so that the share is 1."""
    room = Room()
    # Flat facets this small are off by 0.01 %.
    points, triangles = sphere(128)
    room.scene.add_instance(room.scene.add_mesh(points.astype("f4"), triangles.astype("i4")), [room.matt(reflectance)])
    room.light("Point", LUMENS / (4 * math.pi))
    everywhere = {"Equirectangular": {"longitude": [-math.pi, math.pi], "latitude": [-math.pi / 2, math.pi / 2]}}
    room.scene.put_camera({**room.camera, "projection": everywhere}, 0)
    room.scene.set(width=16, height=8, filter="box", filter_width=1.0)
    found = room.rendered("illuminance", 512, confidence.SEEDS, 2048)
    expected = numpy.full(found.shape[1:], LUMENS / (4 * math.pi * (1 - reflectance)))
    confidence.hold(SECTION, f"integrating sphere of 1 m, ρ = {reflectance}, everywhere", "Φ / (4 π R² (1 − ρ))", found, expected)


ROOM = (4.0, 3.0, 2.5)
# Floor, ceiling, and the walls at −x, +x, −y, +y.
DIFFERENT = (0.2, 0.8, 0.5, 0.5, 0.1, 0.7)
LAMP = (0.7, -0.4, 0.6)
CELLS = 2


def radiosity(parts):
    """Illuminance of the faces' cells by other walls, each face in `parts` × `parts` patches: exact form factors from their middles to the others."""
    faces = box_faces(ROOM)
    corners, reflectances, middles, normals = [], [], [], []
    for face, reflectance in zip(faces, DIFFERENT, strict=True):
        at = face.points(parts, parts).reshape(-1, 3)
        u, v = numpy.asarray(face.u) / parts / 2, numpy.asarray(face.v) / parts / 2
        corners.append(at[:, None] + numpy.array([-u - v, u - v, u + v, -u + v]))
        middles.append(at)
        normals.append(face.normal)
        reflectances.append(numpy.full(len(at), reflectance))
    patches = numpy.concatenate(corners)
    forms = numpy.concatenate(
        [
            numpy.stack([form_factors.polygon(patch, at, normal) for patch in patches], axis=1) / math.pi
            for at, normal in zip(middles, normals, strict=True)
        ]
    )
    places, facing = numpy.concatenate(middles), numpy.repeat(normals, parts**2, axis=0)
    to = numpy.array(LAMP) - places
    direct = LUMENS / (4 * math.pi) * (to * facing).sum(axis=1) / numpy.linalg.norm(to, axis=1) ** 3
    # Parts of the same plane do not see each other; what is left of 1 is the quadrature's error.
    assert numpy.abs(forms.sum(axis=1) - 1).max() < 1e-6
    total = numpy.linalg.solve(numpy.eye(len(places)) - forms * numpy.concatenate(reflectances), direct)
    step = parts // CELLS
    return (total - direct).reshape(6, CELLS, step, CELLS, step).mean(axis=(2, 4))


def test_walls_of_different_reflectances():
    """The light from other walls alone, so that the peak under the lamp is left out; and luminance as ρ E / π."""
    coarse, fine = radiosity(16), radiosity(24)
    # Richardson: the error falls with the square of a part's size.
    expected = fine + (fine - coarse) / ((24 / 16) ** 2 - 1)
    room, dark = Room(), Room()
    for face, reflectance in zip(box_faces(ROOM), DIFFERENT, strict=True):
        room.add(face, reflectance=reflectance)
        dark.add(face)
    for each in (room, dark):
        each.light("Point", LUMENS / (4 * math.pi), LAMP)
    lux, nits = [], []
    for face in box_faces(ROOM):
        straight = dark.illuminance(face, (CELLS, CELLS), 16384, [1], averaged=True)
        lux.append(room.illuminance(face, (CELLS, CELLS), 16384, averaged=True, bounces=2048) - straight)
        nits.append(room.measured("luminance", face, (CELLS, CELLS), 8192, bounces=2048))
    everything = numpy.stack(lux, axis=1)
    confidence.hold(SECTION, "room with six reflectances, light from other walls", "radiosity of 3456 patches", everything, expected)
    straight = numpy.stack([dark.illuminance(face, (CELLS, CELLS), 16384, [1], averaged=True)[0] for face in box_faces(ROOM)])
    shares = numpy.array(DIFFERENT)[:, None, None] / math.pi
    title = "luminance of the same room's faces"
    confidence.hold(SECTION, title, "ρ E / π, E by radiosity", numpy.stack(nits, axis=1), shares * (expected + straight))
