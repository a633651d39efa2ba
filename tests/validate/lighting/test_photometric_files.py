"""Every IES and EULUMDAT file at hand: its intensities as tabulated and in all directions of a render, and its flux three ways.

The files are read a second time by `photometric_file`. In the renders a point light with a file's goniogram stands in the middle of a black cube;
a camera in the same place sees in each pixel one direction of its light: I = E d² / cos θ.
"""

import dataclasses
import json
import math

import confidence
import figures
import gonio
import numpy
import photometric_file
import pytest
from rooms import Plane, Room, box_faces

pytestmark = pytest.mark.validate

SECTION = "Photometric files"
FLUX = "Flux of photometric files"
FILES = "luminaires", "shapes/ies95", "shapes/ldt"
CUBE = (2.0, 2.0, 2.0)
# Rows of a picture of all directions, and of those of a face of the cube.
ROWS, SIDE = 360, 48
UP = numpy.array([0.0, 0.0, 1.0])


@pytest.fixture(scope="module")
def files(shared):
    """All files, by name."""
    found = [path for folder in FILES for path in sorted(shared("photometry", *folder.split("/")).iterdir())]
    assert len(found) >= 40
    return found


@pytest.fixture(scope="module")
def closed_forms(files, run):
    """Lumens by `gonio photometry`, by path."""
    return {path: json.loads(run("photometry", path, "--json").stdout)["flux_lm"] for path in files}


def room_of(path):
    room = Room()
    room.add(*box_faces(CUBE))
    room.light("Point", 1.0, **photometric_file.as_light(path))
    return room


def intensities(room, columns, rows, longitude, latitude):
    """Directions and candela of a panorama's pixels about the light, degrees; longitude 0 is +x, rows run from the top."""
    # Ahead is +x, up is +z, so that longitude, which grows to the right, falls while C grows.
    axes = [[0.0, -1.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0]]
    view = {"longitude": [math.radians(x) for x in longitude], "latitude": [math.radians(x) for x in latitude]}
    room.scene.put_camera({**room.camera, "projection": {"Equirectangular": view}, "transform": {"columns": axes}}, 0)
    room.scene.set(width=columns, height=rows, samples=1, filter="box", filter_width=0.0, passes=["illuminance", "P"], max_bounces=0)
    with gonio.Render(room.scene) as render:
        assert render.wait()
        film = render.film()
    place = numpy.asarray(film["P"]).astype(float)
    distance = numpy.linalg.norm(place, axis=-1)
    # The faces of the cube are where the largest coordinate is 1.
    cosine = numpy.abs(place).max(axis=-1) / distance
    return place / distance[..., None], numpy.asarray(film["illuminance"])[..., 0] * distance**2 / cosine


def test_tabulated_intensities_are_read_exactly(files):
    largest, count = 0.0, 0
    for path in files:
        table, found = photometric_file.read(path), photometric_file.as_light(path)["goniogram"]
        assert found["horizontal_deg"] == pytest.approx(list(table.planes)) and found["vertical_deg"] == pytest.approx(list(table.polar))
        factors = numpy.array(found["factors"]).reshape(table.candela.shape)
        largest = max(largest, float((numpy.abs(factors - table.candela) / numpy.maximum(table.candela, 1e-3)).max()))
        count += table.candela.size
    figures.check(figures.Row(SECTION, "intensity at every tabulated angle as read, all files", "a second reader", count, largest, 1e-6))


def test_tabulated_intensities_are_rendered(files):
    largest, count = 0.0, 0
    for path in files:
        table = photometric_file.read(path)
        step, turn = float(table.polar[1]), min(float(table.planes[1]), 15.0)
        rows, columns = round(180 / step) - 1, round(360 / turn)
        room = room_of(path)
        _, found = intensities(room, columns, rows, (-turn / 2, 360 - turn / 2), (-90 + step / 2, 90 - step / 2))
        # A pixel's middle at longitude k · turn has C = −k · turn, and the first row is the highest.
        c, gamma = numpy.meshgrid((-turn * numpy.arange(columns)) % 360, 180 - step * (numpy.arange(rows) + 1))
        # Where a table ends the last of its angles may be missed.
        inside = gamma < table.polar[-1]
        off = numpy.abs(found - table.at(c, gamma)) / table.candela.max()
        largest, count = max(largest, float(off[inside].max())), count + int(inside.sum())
    case = "intensity at tabulated angles as rendered, of the file's peak, all files"
    figures.check(figures.Row(SECTION, case, "E d² / cos θ against a second reader", count, largest, 1e-5))


def test_intensities_between_the_angles_are_rendered(files):
    largest, count = 0.0, 0
    for path in files:
        table = photometric_file.read(path)
        direction, found = intensities(room_of(path), 361, 181, (-180, 180), (-90, 90))
        polar = numpy.degrees(numpy.arccos(-direction[..., 2]))
        off = numpy.where(numpy.abs(polar - table.polar[-1]) < 1e-3, 0.0, numpy.abs(found - table.intensity(direction)))
        largest, count = max(largest, float(off.max() / table.candela.max())), count + off.size
    case = "intensity in 65,341 directions each as rendered, of the file's peak, all files"
    figures.check(figures.Row(SECTION, case, "bilinear in a second reader's table", count, largest, 1e-5))


def test_closed_forms_of_the_flux(files, closed_forms):
    """Against Gauss and Legendre in each cell of the second reader's table."""
    x, w = numpy.polynomial.legendre.leggauss(8)
    found, expected = [], []
    for path in files:
        table = photometric_file.read(path)
        mean = 0.5 * (table.candela[1:] + table.candela[:-1])
        around = (numpy.radians(numpy.diff(table.planes))[:, None] * mean).sum(axis=0)
        polar = numpy.radians(table.polar)
        gamma = 0.5 * (polar[1:] + polar[:-1])[:, None] + 0.5 * numpy.diff(polar)[:, None] * x
        value = around[:-1, None] + (around[1:] - around[:-1])[:, None] * 0.5 * (x + 1)
        expected.append(float((value * numpy.sin(gamma) * w * 0.5 * numpy.diff(polar)[:, None]).sum()))
        found.append(closed_forms[path])
    reference = "Gauss and Legendre over a second reader's cells"
    confidence.hold_exact(SECTION, "flux by `gonio photometry`, all files", reference, numpy.array(found), numpy.array(expected), 1e-9)


def test_flux_three_ways(files, closed_forms):
    rows = []
    for path in files:
        room = room_of(path)
        direction, candela = intensities(room, 2 * ROWS, ROWS, (-180, 180), (-90, 90))
        # Evenly spaced angles: a pixel's solid angle goes with the cosine of its latitude.
        weight = numpy.sqrt(1 - direction[..., 2] ** 2) * (math.pi / ROWS) ** 2
        emitted = float((candela * weight).sum())
        arrived = sum(room.illuminance(face, (SIDE, SIDE), 16, [1], averaged=True).mean() * face.area for face in box_faces(CUBE))
        case = f"{path.parent.name}/{path.name}, {closed_forms[path]:.2f} lm"
        off = max(abs(flux / closed_forms[path] - 1) for flux in (emitted, arrived))
        rows.append(figures.Row(FLUX, case, "closed form", 2, off, 1e-3))
        figures.record(rows[-1])
    assert not [row for row in rows if not row.holds]


def luminaire(path, size):
    """A black cube with a file's luminaire, its opening shining, and the opening's extent."""
    room = Room()
    found = photometric_file.as_light(path)["goniogram"]
    room.add(*box_faces((size,) * 3))
    room.light({"Opening": found["opening"]}, 1.0, goniogram=found, quantity="Measured")
    return room, max(found["opening"]["size"])


def distinct(files):
    """The files with an extended opening, those together that have the same light."""
    lights = {}
    for path in files:
        _, size = luminaire(path, 4.0)
        if size > 0:
            lights.setdefault(json.dumps(photometric_file.as_light(path)), []).append(path)
    return list(lights.values())


def test_flux_through_the_luminous_openings(files, closed_forms):
    rows = []
    for alike in distinct(files):
        room, _ = luminaire(alike[0], 4.0)
        arrived = sum(room.illuminance(face, (24, 24), 32, averaged=True).mean(axis=(1, 2)) * face.area for face in box_faces((4.0,) * 3))
        for path in alike:
            case = f"{path.parent.name}/{path.name}, {closed_forms[path]:.2f} lm, its opening"
            row = confidence.row(FLUX, case, "closed form", arrived[:, None], numpy.array([closed_forms[path]]), 1e-3)
            # Of bodies much taller than wide noise is what the figure shows.
            rows.append(dataclasses.replace(row, limit=max(row.limit, row.uncertainty)))
            figures.record(rows[-1])
    assert not [row for row in rows if not row.holds]


def test_luminaires_are_their_intensities_from_afar(files):
    """A hundred times its extent away a luminaire with an opening is the point of the file's intensities."""
    rows = []
    for alike in distinct(files):
        _, size = luminaire(alike[0], 4.0)
        room, _ = luminaire(alike[0], 200 * size)
        table, off = photometric_file.read(alike[0]), []
        for face in box_faces((200 * size,) * 3):
            to = face.points(9, 9)
            distance = numpy.linalg.norm(to, axis=-1)
            cosine = -(to @ face.normal) / distance
            found = room.illuminance(face, (9, 9), 1024, [1])[0] * distance**2 / cosine
            expected = table.intensity(to / distance[..., None])
            off.append(numpy.abs(found - expected) / table.candela.max())
        for path in alike:
            case = f"{path.parent.name}/{path.name}, its opening from afar, of the file's peak"
            rows.append(figures.Row(SECTION, case, "I cos θ / d²", 6 * 81, float(numpy.max(off)), 0.01))
            figures.record(rows[-1])
    assert not [row for row in rows if not row.holds]


def test_stripes_are_the_same_on_two_grids(shared):
    """One distribution tabulated at even and at uneven angles."""
    pictures = []
    for name in ("uniform", "nonuniform"):
        room = Room()
        floor, wall = Plane((0, 0, -1.5), (4, 0, 0), (0, 4, 0)), Plane((-2, 0, 0), (0, 4, 0), (0, 0, 3))
        room.add(floor, wall)
        room.light("Point", 1.0, **photometric_file.as_light(shared("usd", "luxtest", f"test_stripes_{name}.ies")))
        pictures.append(numpy.concatenate([room.illuminance(plane, (128, 128), 1, [1]).ravel() for plane in (floor, wall)]))
    assert pictures[0].max() > 0
    off = numpy.abs(pictures[0] - pictures[1]).max() / pictures[0].max()
    case = "test_stripes_uniform.ies and test_stripes_nonuniform.ies, of the brightest"
    figures.check(figures.Row(SECTION, case, "each other", pictures[0].size, float(off), 1e-5))
