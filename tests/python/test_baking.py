"""Textures baked at places on surfaces, from Python."""

import numpy as np
import pytest
from small_scenes import QUAD

gonio = pytest.importorskip("gonio")
medium = pytest.importorskip("gonio.medium").medium

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


def test_haze_does_not_dim_what_is_baked():
    """What the surface sends there, with and without haze that absorbs all around."""
    scene = gonio.Scene()
    scene.add_material("shining", base_color=(0, 0, 0), specular_weight=0, emission_color=(1.0, 2.0, 3.0))
    scene.add_instance(scene.add_mesh(SQUARE, QUAD), [0], name="square")
    scene.put_atmosphere(medium(absorption=0.5, scattering=0.2))
    scene.set(samples=16, passes=["color"])
    baking = gonio.Render.bake(scene, instance=0, **places())
    baking.wait()
    np.testing.assert_allclose(np.asarray(baking.film()["color"])[0, :2, :3], [[1.0, 2.0, 3.0]] * 2, rtol=1e-5)


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


# The square as seen from below.
BACK = QUAD[:, ::-1].copy()


def under(scene, *, triangles=BACK, height=0.0, **material):
    """Puts a square of a material half over the lit one: it lies on the side of positive x."""
    number = scene.add_material("cover", base_color=(0.5, 0.5, 0.5), specular_weight=0.0, **material)
    mesh = scene.add_mesh(SQUARE, np.ascontiguousarray(triangles))
    scene.add_instance(mesh, [number], transform=[[1, 0, 0, 1], [0, 1, 0, height], [0, 0, 1, 0], [0, 0, 0, 1]], name="cover")
    return scene


def halves(scene):
    """Illuminance and radiance of the lit square's left and right half."""
    scene.set(samples=64, passes=["illuminance", "color", "P", "albedo"])
    pixels = {"triangles": np.array([[0, 1, 0, 1]], "i4"), "places": np.array([[[0.1, 0.4], [0.2, 0.7], [0.5, 0.4], [0.55, 0.4]]], "f4")}
    baking = gonio.Render.bake(scene, instance=0, **pixels)
    assert baking.wait()
    film = baking.film()
    found = {name: np.asarray(film[name])[0] for name in ("illuminance", "color", "P", "albedo")}
    return found, found["P"][:, 0] > 0.0


@pytest.mark.parametrize("triangles", [BACK, QUAD], ids=["face to face", "back to face"])
def test_nothing_arrives_under_what_lies_on_a_surface(triangles):
    plain, right = halves(lit_square())
    covered, _ = halves(under(lit_square(), triangles=triangles))
    assert right.any() and not right.all()
    assert (covered["illuminance"][right] == 0.0).all() and (covered["color"][right, :3] == 0.0).all()
    assert covered["illuminance"][~right] == pytest.approx(plain["illuminance"][~right], rel=1e-5)
    # What the surface is stays known.
    assert covered["albedo"] == pytest.approx(plain["albedo"], rel=1e-5) and (covered["color"][:, 3] == 1.0).all()


def test_what_light_passes_covers_nothing():
    plain, _ = halves(lit_square())
    glass, _ = halves(under(lit_square(), transmission_weight=1.0))
    assert glass["illuminance"].min() >= 0.0 and glass["albedo"] == pytest.approx(plain["albedo"], rel=1e-5)
    cut_out, _ = halves(under(lit_square(), geometry_opacity=0.0))
    assert cut_out["illuminance"] == pytest.approx(plain["illuminance"], rel=1e-5)
    # Nor what lies below.
    below, _ = halves(under(lit_square(), height=-1e-3))
    assert below["illuminance"] == pytest.approx(plain["illuminance"], rel=1e-5)


def test_faces_of_one_mesh_that_face_each_other_are_covered():
    """Two boxes' sides in one mesh; neighbours in their plane hide nothing of each other, on their common edge either."""
    scene = gonio.Scene()
    scene.add_material("white", base_color=(1, 1, 1), specular_weight=0)
    points = np.concatenate([SQUARE, SQUARE + np.float32([1, 0, 0])])
    mesh = scene.add_mesh(points, np.concatenate([QUAD, BACK + 4]).astype("i4"))
    scene.add_instance(mesh, [0], name="both")
    scene.add_light("point", (100, 100, 100), transform=np.array([[1, 0, 0, 0], [0, 1, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1.0]]))
    found, right = halves(scene)
    assert (found["illuminance"][right] == 0.0).all() and (found["illuminance"][~right] > 10.0).all()
