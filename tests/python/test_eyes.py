"""Eyes at the points of grids, against closed forms and the melanopic ratios of lamps."""

import gonio
import numpy as np
import pytest

# Melanopic daylight efficacy ratios of CIE S 026 for illuminants of CIE 015.
RATIOS = {"A": 0.4958, "FL11": 0.5636, "LED-B1": 0.4067, "LED-B3": 0.6326, "LED-B5": 0.8552, "E": 0.9058}
CANDELA = 300.0
LAMP = np.array([0.3, 0.2, 2.6])


def room(spectrum="D65", **grid):
    """Four points on a square of 2 m, before a small lamp in an empty room."""
    made = gonio.Scene()
    radius = 0.01
    place = [[1, 0, 0, LAMP[0]], [0, 1, 0, LAMP[1]], [0, 0, 1, LAMP[2]], [0, 0, 0, 1]]
    made.add_light("sphere", (CANDELA / (np.pi * radius**2),) * 3, radius=radius, transform=place, spectrum=spectrum)
    options = {"corner": (-1, -1, 0), "edges": ((2, 0, 0), (0, 2, 0)), "spacing": 1.0, "height": 1.2, "eyes": 4, **grid}
    made.add_grid(**options)
    return made


def lux(positions, facings):
    way = LAMP - np.asarray(positions)
    return CANDELA * np.maximum(way @ np.asarray(facings).T, 0.0) / np.linalg.norm(way, axis=1)[:, None] ** 3


@pytest.mark.parametrize("name", RATIOS)
def test_melanopic_light_of_lamps(name):
    grid = gonio.measure(room(name, quantity="melanopic-edi"), samples=1024).grids[0]
    expected = lux(grid.positions, grid.facings)
    lit = expected > 1.0
    ratio = np.asarray(grid.eye_values)[lit] / expected[lit]
    assert lit.any() and np.abs(ratio - RATIOS[name]).max() < 0.002, ratio


def test_points_have_the_mean_and_the_least_over_directions():
    grid = gonio.measure(room(), samples=1024).grids[0]
    np.testing.assert_allclose(grid.facings, [(0, 1, 0), (1, 0, 0), (0, -1, 0), (-1, 0, 0)], atol=1e-12)
    expected = lux(grid.positions, grid.facings)
    np.testing.assert_allclose(grid.eye_values, expected, rtol=1e-3, atol=1e-3)
    np.testing.assert_allclose(np.ravel(grid.values), expected.mean(axis=1), rtol=1e-3)
    np.testing.assert_allclose(np.ravel(grid.leasts), expected.min(axis=1), atol=1e-3)
    errors = np.asarray(grid.eye_standard_errors)
    np.testing.assert_allclose(np.ravel(grid.standard_errors), np.sqrt((errors**2).sum(axis=1)) / 4)
    assert np.asarray(grid.least_standard_errors).shape == (2, 2)
    target = float(np.sort(expected.mean(axis=1))[1:3].mean())
    shares = grid.reaching(target)
    assert shares["points"] == {"count": 4, "share": 0.5, "standard_error": 0.0, "share_within_error": 0.0}
    assert shares["points_all_ways"]["share"] == 0.0
    assert shares["eyes"]["share"] == np.mean(expected >= target)


def test_what_errors_leave_open():
    """A wall that shines about the eyes: all points have the same light, and noise alone says which reach it."""
    made = gonio.Scene()
    made.add_light("dome", (100.0,) * 3)
    side = np.array([[-3, 3, 0], [3, 3, 0], [3, 3, 3], [-3, 3, 3]], np.float32)
    wall = made.add_mesh(side, np.array([[0, 1, 2], [0, 2, 3]], np.int32))
    made.add_instance(wall, [made.add_material(base_color=(0.5,) * 3)])
    made.add_grid(corner=(-1, -1, 0), edges=((2, 0, 0), (0, 2, 0)), spacing=0.5, height=1.2, eyes=[(0, 1, 0)])
    grid = gonio.measure(made, samples=64).grids[0]
    values, errors = np.ravel(grid.values), np.ravel(grid.standard_errors)
    target = float(np.median(values))
    found = grid.reaching(target)["points"]
    is_open = np.abs(values - target) < 2 * errors
    assert found["share_within_error"] == pytest.approx(np.mean(is_open)) and is_open.any()
    sides = max(np.sum(is_open & (values >= target)), np.sum(is_open & (values < target)))
    assert found["standard_error"] == pytest.approx(sides / values.size / 2)


def test_a_room_whose_y_is_up_and_ways_of_ones_own():
    """Eyes look around across the grid's normal, the first as near to `facing` as can be."""
    grid = gonio.measure(room(corner=(-1, 1, 1), edges=((2, 0, 0), (0, 0, -2)), height=0.2, facing=(0, 0.5, -1)), samples=16).grids[0]
    np.testing.assert_allclose(grid.facings, [(0, 0, -1), (1, 0, 0), (0, 0, 1), (-1, 0, 0)], atol=1e-12)
    grid = gonio.measure(room(eyes=np.array([[0, 0, 2.0], [1, 1, 0]])), samples=256).grids[0]
    np.testing.assert_allclose(grid.facings, [(0, 0, 1), (0.5**0.5, 0.5**0.5, 0)], atol=1e-12)
    np.testing.assert_allclose(grid.eye_values, lux(grid.positions, grid.facings), rtol=2e-3, atol=1e-3)


def test_colours_of_eyes_are_told_direction_by_direction():
    grid = gonio.measure(room("LED-B3", quantity="rf", spacing=2.0, eyes=[(0, 0, 1), (1, 0, 1)]), samples=256).grids[0]
    expected = lux(grid.positions, grid.facings).ravel()
    assert [colour["illuminance_lx"] for colour in grid.colours] == pytest.approx(expected, rel=5e-3)
    assert np.ravel(grid.values) == pytest.approx([np.mean([colour["rf"] for colour in grid.colours])])


def test_grids_without_eyes_and_bad_ones():
    grid = gonio.measure(room(eyes=None), samples=16).grids[0]
    assert grid.facings is None and grid.eye_values is None and grid.leasts is None
    assert set(grid.reaching(1.0)) == {"points"}
    for options, words in (
        ({"eyes": 0}, "eyes look nowhere"),
        ({"eyes": []}, "eyes look nowhere"),
        ({"eyes": [(0, 0, 0)]}, "eyes look nowhere"),
        ({"quantity": "cylindrical"}, "a grid of cylindrical has none"),
    ):
        with pytest.raises(gonio.Error, match=words):
            gonio.measure(room(**options), samples=16)
    with pytest.raises(ValueError, match="expected 3"):
        room(eyes=[(1, 2)])
