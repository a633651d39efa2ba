"""`Scene.link`: what lights light, and what casts their shadows."""

import gonio
import numpy as np
import pytest
from small_scenes import closure


def scene() -> tuple[gonio.Scene, int]:
    """Two floors side by side, instances 0 and 1, a board over the first, and a lamp."""
    made = gonio.Scene()
    quad = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    mesh = made.add_mesh(quad, np.array([[0, 1, 2], [0, 2, 3]], np.int32))
    white = made.add_material(base_color=1.0, specular_weight=0.0)
    for x, z in ((-2.0, 0.0), (2.0, 0.0), (-2.0, 0.5)):
        made.put_instances(mesh, [white], np.array([[[1, 0, 0, x], [0, 1, 0, 0], [0, 0, 1, z], [0, 0, 0, 1]]]))
    lamp = made.add_light("point", (10.0,) * 3, transform=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]])
    made.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 9], [0, 0, 0, 1]], fov=40)
    made.set(width=64, height=32, samples=4, max_bounces=0, passes=["color"])
    return made, lamp


def colour(made: gonio.Scene) -> np.ndarray:
    with gonio.Render(made) as rendering:
        rendering.wait()
        return np.asarray(rendering.film()["color"])[:, :, 1]


def test_receivers_and_their_descriptions():
    made, lamp = scene()
    assert "linking" not in made.to_dict()["lights"][0]
    made.link(light=lamp, receivers=[0, 2])
    assert made.to_dict()["lights"][0]["linking"] == {"receivers": {"Only": [0, 2]}, "blockers": "All"}
    assert colour(made)[16, 39:46].max() == 0.0
    made.link(light=lamp, receivers_except=[0, 2])
    assert colour(made)[16, 39:46].min() > 0.0
    made.link(light=lamp)
    assert "linking" not in made.to_dict()["lights"][0]
    made.link(instances=1, blockers=[])
    assert made.to_dict()["instances"][1]["linking"]["blockers"] == {"Only": []}


def test_bundles_keep_links(tmp_path):
    made, lamp = scene()
    made.link(light=lamp, receivers=[1], blockers_except=[2])
    made.save(tmp_path / "scene.gonio")
    again = gonio.Scene.load(tmp_path / "scene.gonio")
    assert np.array_equal(colour(made), colour(again))


@pytest.mark.parametrize(
    ("keywords", "message"),
    [
        ({"light": 0, "receivers": [3]}, "3 was found, the scene has 3 instances"),
        ({"light": 0, "receivers": [1], "receivers_except": [2]}, "together"),
        ({}, "either a light or instances"),
        ({"light": 7}, "7 was found"),
    ],
)
def test_what_is_refused(keywords, message):
    with pytest.raises(Exception, match=message):
        scene()[0].link(**keywords)


def through_a_pane(integrator, *closures):
    """A floor under a panel, with a ball that shines and a pane of these closures between, seen from above; the lamps light the floor alone."""
    made = gonio.Scene()
    quad = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    mesh = made.add_mesh(quad, np.array([[0, 1, 2], [0, 2, 3]], np.int32))
    white = made.add_material("white", base_color=0.8, specular_weight=0.0)
    at = lambda z, size=1.0: [[size, 0, 0, 0], [0, size, 0, 0], [0, 0, 1, z], [0, 0, 0, 1]]  # noqa: E731
    made.put_instances(mesh, [white], np.array([at(0.0)]))
    if closures:
        pane = made.put_material({"origin": "pane", "closures": list(closures)})
        made.put_instances(mesh, [pane], np.array([at(0.6, 3.0)]))
    ball = made.add_light("sphere", (50.0,) * 3, radius=0.2, transform=at(0.3))
    panel = made.add_light("rectangle", (1.0,) * 3, width=4.0, height=4.0, transform=at(1.2), visible=False)
    for lamp in (ball, panel):
        made.link(light=lamp, receivers=[0])
    made.add_camera(at(9.0), fov=10)
    made.set(width=24, height=24, samples=256, max_bounces=1, passes=["color"], integrator=integrator, filter="box", filter_width=1.0)
    return colour(made)


@pytest.mark.parametrize("integrator", ["path", "whitted", "light"])
def test_panes_that_lamps_do_not_light_hide_nothing(integrator):
    open_air = through_a_pane(integrator)
    clear = through_a_pane(integrator, closure("Transparent", base_color=1.0))
    half = through_a_pane(integrator, closure("Transparent", base_color=0.5))
    cut_out = through_a_pane(integrator, closure("OpenPbr", geometry_opacity=0.0))
    # The ball in the middle, and the floor about it.
    places = {"ball": np.s_[11:13, 11:13], "floor": np.s_[2:6, 2:22]}
    for name, place in places.items():
        right = open_air[place].mean()
        assert clear[place].mean() == pytest.approx(right, rel=0.02), name
        assert cut_out[place].mean() == pytest.approx(right, rel=0.02), name
    # From the ball once, by the floor's light from below the pane too; the panel's light passes it twice.
    assert half[places["ball"]].mean() == pytest.approx(0.5 * open_air[places["ball"]].mean(), rel=0.02)
