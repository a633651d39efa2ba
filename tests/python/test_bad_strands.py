"""Curves and points with little or wrong in them: one message and a picture, or refused by name; never a crash."""

import math

import gonio
import numpy as np
import pytest

PLACES = np.array([[-1, -1, 0], [-0.3, 0, 0], [0.3, 0, 0.2], [1, 1, 0], [-1, 1, 0], [-0.3, 0.5, 0], [0.3, 0.6, 0], [1, -1, 0.3]], "f4")
COUNTS = np.array([4, 4], "i4")
SPOILT = PLACES.copy()
SPOILT[1], SPOILT[6] = math.nan, math.inf
BAD_WIDTHS = "widths are negative, too large or not a number at"
LEFT_OUT = "are not finite or lie beyond"


def shown(kind, places=PLACES, widths=0.3, counts=COUNTS, **words):
    """The picture of a thing before a white sky, and what was said of it."""
    scene = gonio.Scene()
    scene.set(width=32, height=32, samples=4, passes=["color"])
    scene.add_light("dome", (1.0, 1.0, 1.0))
    scene.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 6], [0, 0, 0, 1]], fov=45)
    skin = scene.add_material("skin", base_color=(0.2, 0.2, 0.2))
    if kind == "curves":
        words = {"type": "cubic", "basis": "catmullRom", "wrap": "pinned", **words}
        scene.add_instance(None, [skin], curves=scene.add_curves(places, counts, widths, **words))
    else:
        scene.add_instance(None, [skin], points=scene.add_points(places, widths, **words))
    with gonio.Render(scene) as render:
        assert render.wait()
        image = np.asarray(render.film()["color"])[..., :3]
        assert np.isfinite(image).all()
        return image, [text for _, text in render.diagnostics]


def is_seen(image):
    return image.min() < 0.9


@pytest.mark.parametrize("kind", ["curves", "points"])
@pytest.mark.parametrize("width", [-0.1, math.nan, math.inf, 1e30, 3e38])
def test_widths_that_no_thing_can_have_are_told(kind, width):
    image, told = shown(kind, widths=width)
    assert len(told) == 1 and BAD_WIDTHS in told[0] and not is_seen(image)


@pytest.mark.parametrize("kind", ["curves", "points"])
def test_widths_of_nothing_tiny_or_around_the_camera(kind):
    image, told = shown(kind, widths=0.0)
    assert told == ["all widths are 0, so that nothing is seen"] and not is_seen(image)
    assert shown(kind, widths=1e-30)[1] == [] == shown(kind, widths=40.0)[1]


@pytest.mark.parametrize("kind", ["curves", "points"])
def test_some_bad_widths_leave_the_rest(kind):
    image, told = shown(kind, widths=np.array([0.3, 0, -1, math.nan, math.inf, 0.3, 0.3, 0.3], "f4"))
    assert len(told) == 1 and BAD_WIDTHS in told[0] and is_seen(image)


@pytest.mark.parametrize("kind", ["curves", "points"])
def test_places_that_are_nowhere_are_left_out(kind):
    image, told = shown(kind, SPOILT)
    assert len(told) == 1 and told[0].startswith("2 of 8 places") and LEFT_OUT in told[0] and is_seen(image)
    for places in (PLACES * math.nan, PLACES * np.float32(1e30), PLACES * np.float32(3e38)):
        image, told = shown(kind, places)
        assert told[0].startswith("8 of 8 places") and not is_seen(image)


@pytest.mark.parametrize(
    "basis, counts, few",
    [
        ("catmullRom", [1] * 8, 8),
        ("catmullRom", [1, 4, 2, 1], 2),
        ("catmullRom", [0, 8, 0], 2),
        ("bezier", [3, 5], 1),
        ("bspline", [1, 7], 1),
    ],
)
def test_curves_of_too_few_points_are_left_out(basis, counts, few):
    image, told = shown("curves", counts=np.array(counts, "i4"), basis=basis, wrap="pinned" if basis != "bezier" else "nonperiodic")
    assert any(text.startswith(f"{few} of {len(counts)} curves have too few points") for text in told), told
    assert is_seen(image) == (max(counts) > 3)


@pytest.mark.parametrize(
    "counts, problem", [([-4, 12], "element 0 is -4"), ([4, 3], "7 points in all"), ([4, 2**31 - 1], "2147483651 points in all")]
)
def test_counts_that_do_not_fit_are_refused(counts, problem):
    with pytest.raises(ValueError, match=problem):
        shown("curves", counts=np.array(counts, "i4"))


@pytest.mark.parametrize("kind", ["curves", "points"])
def test_nothing_and_one_place_make_pictures(kind):
    assert not is_seen(shown(kind, np.zeros((0, 3), "f4"), counts=np.zeros(0, "i4"))[0])
    shown(kind, PLACES * 0)
    shown("points", np.zeros((20_000, 3), "f4"))


KEYS = {
    "not finite": ([PLACES, SPOILT], "a motion key is not finite; the shape of the frame stands still"),
    "one": ([PLACES], "one motion key was found, expected two or more; the shape of the frame stands still"),
}


@pytest.mark.parametrize("kind", ["curves", "points"])
@pytest.mark.parametrize("name", KEYS)
def test_keys_that_cannot_be_used_are_told(kind, name):
    keys, problem = KEYS[name]
    image, told = shown(kind, motion=np.concatenate(keys))
    assert told == [problem] and is_seen(image)


@pytest.mark.parametrize("kind", ["curves", "points"])
def test_keys_beyond_all_bounds_and_of_other_numbers(kind):
    _, told = shown(kind, motion=np.concatenate([PLACES, PLACES * np.float32(1e30)]))
    assert len(told) == 1 and "beyond" in told[0]
    with pytest.raises(ValueError, match="11 points were found, expected 8 a key"):
        shown(kind, motion=np.concatenate([PLACES, PLACES[:3]]))
