"""Illumination maps against closed forms and against path tracing of the same rooms."""

import math

import confidence
import figures
import gonio
import numpy
import pytest
from rooms import Room, box_faces, facing
from test_flux_conservation import LIGHTS

pytestmark = pytest.mark.validate

SECTION = "Illumination maps"
SIZE = (4.0, 3.0, 2.5)
REFLECTANCES = (0.2, 0.8, 0.5, 0.5, 0.1, 0.7)
PLACE = (0.7, -0.4, 0.6)
AXES = facing((-0.5, 0.3, -0.8))
PATHS = 1 << 22
SAMPLES = 1024


def mapped(room, seeds=confidence.SEEDS, **wishes):
    """Mean illuminances of all surfaces' fronts with each seed."""
    found = []
    for seed in seeds:
        room.scene.set(seed=seed)
        maps = gonio.illumination_map(room.scene, texel=1.0, error=0, **wishes)
        found.append([surface.mean() for surface in maps.surfaces])
    return numpy.array(found)


@pytest.mark.parametrize(("name", "shape", "lumens", "changes"), LIGHTS, ids=[light[0] for light in LIGHTS])
def test_a_black_box_gets_the_flux(name, shape, lumens, changes):
    room = Room()
    faces = box_faces(SIZE)
    room.add(*faces)
    room.light(shape, 1000.0 / lumens, PLACE, AXES, **changes)
    areas = numpy.array([face.area for face in faces])
    flux = (mapped(room, paths=1 << 20) * areas).sum(axis=1)
    confidence.hold(SECTION, f"flux on a black box: {name}, 1000 lm", "closed form", flux[:, None], numpy.array([1000.0]), 1e-3)


def test_white_furnace():
    room = Room()
    faces = box_faces(SIZE)
    room.add(*faces, reflectance=0.5)
    room.light("Point", 1000.0 / (4 * math.pi), PLACE)
    areas = numpy.array([face.area for face in faces])
    mean = (mapped(room, paths=PATHS) * areas).sum(axis=1) / areas.sum()
    expected = numpy.array([1000.0 / (areas.sum() * 0.5)])
    confidence.hold(SECTION, "mean of a closed room, ρ = 0.5", "Φ / (A (1 − ρ))", mean[:, None], expected, 5e-3)


LAMPS = [
    ("point", "Point", 4 * math.pi, {}),
    ("rectangle", {"Rectangle": {"width": 0.8, "height": 0.3}}, math.pi * 0.24, {}),
    ("sphere", {"Sphere": {"radius": 0.2}}, math.pi * 4 * math.pi * 0.04, {}),
    ("spot", "Point", 4 * math.pi, {"spot": {"angle_deg": 70.0, "blend": 0.4, "stretch": [1.0, 1.0]}}),
]


@pytest.mark.parametrize(("name", "shape", "lumens", "changes"), LAMPS, ids=[lamp[0] for lamp in LAMPS])
def test_maps_and_path_tracing_agree(name, shape, lumens, changes):
    """Both have noise: the row's interval is that of their difference, seed by seed."""
    room = Room()
    faces = box_faces(SIZE)
    for face, reflectance in zip(faces, REFLECTANCES, strict=True):
        room.add(face, reflectance=reflectance)
    room.light(shape, 1000.0 / lumens, PLACE, AXES, **changes)
    maps = mapped(room, paths=PATHS)
    traced = numpy.stack(
        [room.illuminance(face, (16, 16), SAMPLES, averaged=True, bounces=2048).mean(axis=(1, 2)) for face in faces], axis=1
    )
    expected = traced.mean(axis=0)
    title = f"faces of a room with six reflectances: {name}"
    figures.check(confidence.row(SECTION, title, "path tracing", maps - traced + expected, expected))
