"""Curves and points from arrays: what is drawn, and what is refused."""

import gonio
import numpy as np
import pytest
from small_scenes import finished, floor_scene

# Two strands of four points along x.
POINTS = np.array([[x, 0.3, z] for z in (-1.0, 1.0) for x in (-3.0, -1.0, 1.0, 3.0)], "f4")
COUNTS = np.array([4, 4], "i4")


def covered(add):
    """The share of the picture that what `add` adds covers."""
    scene = floor_scene(passes=["alpha"], samples=16)
    scene.truncate("instances", 0)
    add(scene, scene.add_material("skin", base_color=(0.5, 0.3, 0.2)))
    assert not scene.diagnostics
    return float(np.asarray(finished(scene)["alpha"]).mean())


def curves(**words):
    def add(scene, skin):
        scene.add_instance(None, [skin], curves=scene.add_curves(POINTS, COUNTS, 0.4, **words))

    return add


def test_strands_cover_their_length_times_their_width():
    seen = 2 * np.tan(np.radians(20)) * (8 - 0.3)
    flat = covered(curves(shape="ribbon"))
    assert flat == pytest.approx(2 * 0.4 * seen / seen**2, rel=0.03) or flat == pytest.approx(2 * 0.4 * 6 / seen**2, rel=0.03)
    assert covered(curves(shape="round")) >= flat * 0.99


@pytest.mark.parametrize("words", [{}, {"type": "cubic", "basis": "bezier"}, {"type": "cubic", "basis": "catmullRom", "wrap": "pinned"}])
def test_types_and_wraps_reach_from_end_to_end(words):
    assert covered(curves(**words)) == pytest.approx(covered(curves()), rel=0.02)


def test_a_closed_curve_is_longer():
    assert covered(curves(wrap="periodic")) >= covered(curves())
    assert covered(curves(type="cubic", basis="bspline")) < covered(curves())


def test_points_are_spheres_or_discs():
    centres = np.array([[-1, 0.5, 0], [1, 0.5, 0.5]], "f4")

    def add(shape):
        def put(scene, skin):
            scene.add_instance(None, [skin], points=scene.add_points(centres, np.array([1.0, 0.6], "f4"), shape=shape))

        return put

    seen = 2 * np.tan(np.radians(20)) * 7.5
    assert covered(add("disc")) == pytest.approx(np.pi * (0.5**2 + 0.3**2) / seen**2, rel=0.05)
    assert covered(add("sphere")) == pytest.approx(np.pi * (0.5**2 + 0.3**2) / seen**2, rel=0.05)


def test_the_description_comes_back():
    scene = gonio.Scene()
    widths = np.linspace(0.1, 0.2, 8, dtype="f4")
    number = scene.add_curves(POINTS, COUNTS, widths, primvars={"tip": np.ones((2, 3), "f4"), "fade": (np.ones(8, "f4"), "varying")})
    skin = scene.add_material()
    scene.put_instances(None, [skin], np.eye(4)[None], curves=number)
    described = scene.to_dict()
    assert described["instances"][0]["mesh"] == {"curves": 0}
    strands = described["curves"][0]
    assert strands["widths"]["interpolation"] == "Vertex"
    assert [(p["name"], p["interpolation"], p["components"]) for p in strands["primvars"]] == [("tip", "Uniform", 3), ("fade", "Varying", 1)]


def test_scenes_are_saved_with_their_curves(tmp_path):
    scene = floor_scene(passes=["color"], samples=4)
    skin = scene.add_material("skin")
    scene.add_instance(None, [skin], curves=scene.add_curves(POINTS, COUNTS, 0.4))
    scene.add_instance(None, [skin], points=scene.add_points(POINTS, 0.2))
    scene.save(tmp_path / "strands.gonio")
    again = gonio.Scene.load(tmp_path / "strands.gonio")
    first, second = (np.asarray(finished(one)["color"]) for one in (scene, again))
    assert (first == second).all()


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"counts": np.array([4, 5], "i4")}, "counts: 9 points in all were found, expected 8"),
        ({"widths": np.ones(3, "f4")}, "widths: 3 values were found, expected 8"),
        ({"type": "quadratic"}, "expected linear or cubic"),
        ({"type": "cubic", "basis": "hermite"}, "expected one of bezier, bspline, catmullRom"),
        ({"wrap": "open"}, "expected one of nonperiodic, periodic, pinned"),
        ({"shape": "square"}, "expected one of round, ribbon"),
        ({"primvars": {"tip": (np.ones(8, "f4"), "uniform")}}, "tip: 8 values were found, expected 2"),
    ],
)
def test_what_does_not_fit_is_refused(change, message):
    arguments = {"points": POINTS, "counts": COUNTS, "widths": 0.1, **change}
    with pytest.raises((ValueError, gonio.Error), match=message):
        gonio.Scene().add_curves(**arguments)


def test_one_thing_is_placed():
    scene = gonio.Scene()
    with pytest.raises((ValueError, gonio.Error), match="one of mesh, curves and points"):
        scene.put_instances(None, [], np.eye(4)[None])
    with pytest.raises((ValueError, gonio.Error), match="3 was found, the scene has 0 curves"):
        scene.put_instances(None, [], np.eye(4)[None], curves=3)
