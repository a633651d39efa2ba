"""UGR of six luminaires in an office of 6 by 4.5 m against a calculation that shares nothing with gonio."""

import csv
import pathlib

import numpy as np
import pytest
from cie117 import Luminaire, Room

gonio = pytest.importorskip("gonio")

FILE = pathlib.Path(__file__).resolve().parents[2] / "rust-core/formats/tests/data/ugr-table/s07.ldt"
SIDES = (6.0, 4.5, 2.8)
REFLECTANCES = {"ceiling": 0.7, "wall": 0.5, "floor": 0.2}
PLACES = [(x, y, 2.79) for x in (1.0, 3.0, 5.0) for y in (1.125, 3.375)]
# Eyes with their lines of sight and the luminaires ahead that are left out.
EYES = [
    ((3.0, 0.6, 1.2), (0, 1, 0), 3),
    ((0.5, 2.25, 1.2), (1, 0, 0), 2),
    ((5.7, 4.2, 1.2), (-1, 0, 0), 2),
    ((1.0, 4.4, 1.5), (0, -1, 0), 1),
]


@pytest.fixture(scope="module")
def office():
    scene = gonio.Scene()
    x, y, z = SIDES
    corners = np.array([(i, j, k) for k in (0, z) for j in (0, y) for i in (0, x)], "f4")
    faces = {"floor": [(0, 1, 3, 2)], "ceiling": [(4, 6, 7, 5)], "wall": [(0, 4, 5, 1), (1, 5, 7, 3), (3, 7, 6, 2), (2, 6, 4, 0)]}
    for name, quads in faces.items():
        triangles = np.array([corner for a, b, c, d in quads for corner in ((a, b, c), (a, c, d))], "i4")
        mesh = scene.add_mesh(corners, triangles, name=name)
        grey = scene.add_material(name, base_color=(REFLECTANCES[name],) * 3, specular_weight=0.0)
        scene.add_instance(mesh, [grey], name=name)
    goniogram, _ = gonio.read_goniogram(FILE.read_bytes(), FILE.name)
    for place in PLACES:
        transform = np.eye(4)
        transform[:3, 3] = place
        scene.add_light("luminaire", goniogram=goniogram, transform=transform.tolist())
    return scene


@pytest.fixture(scope="module")
def by_hand():
    return Room(SIDES, REFLECTANCES, Luminaire(FILE), PLACES)


def test_observers_in_an_office(office, by_hand):
    for eye, ahead, _ in EYES:
        office.add_meter(eye, facing=ahead, quantity="ugr")
    found = gonio.measure(office, samples=4096)
    for reading, (eye, ahead, expected_out) in zip(found.meters, EYES):
        expected, left_out = by_hand.ugr(eye, ahead)
        print(f"{eye} towards {ahead}: {reading.value:.2f} ± {reading.standard_error:.2f}, by hand {expected:.2f}, {left_out} left out")
        assert reading.value == pytest.approx(expected, abs=0.3)
        assert reading.coverage.left_out == left_out == expected_out
        assert 0 < reading.coverage.share_left_out < 1 and "left out (CIE 117)" in reading.coverage.note
    # What a table's last value beyond its end made of the first.
    assert found.meters[0].value < 19
    assert next(csv.DictReader(found.csv().splitlines()))["left_out"] == "3"
    # No luminaire is small: both ratings are one.
    assert found.meters[0].small_sources == 0 and found.meters[0].as_in_tables.value == found.meters[0].value


def test_the_luminaires_own_table():
    table = gonio.ugr_table(FILE.read_bytes(), FILE.name)
    assert len(table["rooms"]) == 19 and table["rooms"][0] == (2, 2) and table["reflectances"][0] == (0.7, 0.5, 0.2)
    # As Relux prints it: 19.4 and 21.7.
    assert table["crosswise"][0][0] == pytest.approx(19.4, abs=0.3)
    assert table["endwise"][0][4] == pytest.approx(21.7, abs=0.3)
    with pytest.raises(gonio.FormatError, match="spacing to height ratio"):
        gonio.ugr_table(FILE.read_bytes(), FILE.name, spacing=0)
