"""Textures baked at places on surfaces, from Python."""

import numpy as np
import pytest
from small_scenes import QUAD

gonio = pytest.importorskip("gonio")

# A square of 2 m by 2 m at the height 0, its second triangle at the corners 0, 2, 3.
SQUARE = np.array([[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]], "f4")


def lit_square():
    """A white square under a point light of 100 cd, 2 m above its middle."""
    scene = gonio.Scene()
    scene.add_material("white", base_color=(1, 1, 1), specular_weight=0)
    scene.add_instance(scene.add_mesh(SQUARE, QUAD), [0], name="square")
    scene.add_light("point", (100, 100, 100), transform=np.array([[1, 0, 0, 0], [0, 1, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1.0]]))
    scene.set(samples=16, passes=["illuminance", "P", "alpha"])
    return scene


def places():
    """A row of three pixels: the middle, a corner, and nothing."""
    return {"triangles": np.array([[0, 1, -1]], "i4"), "places": np.array([[[0.0, 0.5], [0.0, 1.0], [0.0, 0.0]]], "f4")}


def test_pixels_are_lit_where_they_lie():
    baking = gonio.Render.bake(lit_square(), instance=0, **places())
    assert baking.wait() and baking.progress.fraction == 1.0
    film = baking.film()
    lux = np.asarray(film["illuminance"])[0, :, 0]
    assert lux == pytest.approx([25.0, 100.0 * 2.0 / 6.0**1.5, 0.0], rel=1e-4)
    assert np.asarray(film["P"])[0, :2] == pytest.approx(np.array([[0, 0, 0], [-1, 0, -1]]), abs=1e-6)
    assert np.asarray(film["alpha"])[0, :, 0].tolist() == [1.0, 1.0, 0.0]


def test_steps_spread_samples_over_a_pixel():
    square = {"triangles": np.zeros((1, 1), "i4"), "places": np.full((1, 1, 2), [0.0, 0.5], "f4")}
    scene = lit_square()
    scene.set(samples=256)
    # From corner to corner along the diagonal.
    baking = gonio.Render.bake(scene, instance=0, steps=np.array([[[0.0, 1.0, 0.0, 0.0]]], "f4"), **square)
    baking.wait()
    along = np.linspace(-1, 1, 4001)
    expected = (200.0 / (4.0 + 2.0 * along**2) ** 1.5).mean()
    assert np.asarray(baking.film()["illuminance"]).item() == pytest.approx(expected, rel=0.01)


def test_what_does_not_fit_is_told(tmp_path):
    scene = lit_square()
    for changes, words in (
        ({"instance": 4}, "instance"),
        ({"placement": 1}, "placement 1"),
        ({"view": "below"}, "above or camera"),
        ({"view": "camera"}, "camera"),
        ({"places": np.zeros((1, 2, 2), "f4")}, "places"),
        ({"steps": np.zeros((1, 3, 2), "f4")}, "steps"),
        ({"triangles": np.full((1, 3), 9, "i4")}, "number 9"),
    ):
        with pytest.raises(gonio.SettingError, match=words):
            gonio.Render.bake(scene, **{"instance": 0, **places(), **changes})
    with pytest.raises(ValueError, match="height, width"):
        gonio.Render.bake(scene, instance=0, **{**places(), "triangles": np.zeros(3, "i4")})
    baking = gonio.Render.bake(scene, instance=0, **places())
    with pytest.raises(RuntimeError, match="no checkpoints"):
        baking.checkpoint(tmp_path / "a.gonio")
