"""Passes of values that materials compute beside their surface."""

import gonio
import numpy as np
import pytest
from small_scenes import above, at, finished

WHITE = {"weight": {"Constant": [1.0] * 4}, "model": "Diffuse", "parameters": [["base_color", {"Constant": [1.0] * 4}]]}
# Two squares of 1 m side by side in the plane y = 0, two triangles each.
POINTS = np.array([[-1, 0, 0.5], [0, 0, 0.5], [1, 0, 0.5], [-1, 0, -0.5], [0, 0, -0.5], [1, 0, -0.5]], "f4")
TRIANGLES = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]], "i4")
PAINT = np.array([[1.0, 0.25, 0.0, 0.5], [1.0, 0.25, 0.0, 0.5], [0.0, 0.5, 8.0, 0.5], [0.0, 0.5, 8.0, 0.5]], "f4")


def described(*outputs, closures=(WHITE,), operation=None):
    """A material with shader outputs, which may read the primvar `paint` by way of node 0."""
    nodes = [{"operation": operation or {"Primvar": {"name": "paint", "fallback": [0.0] * 4}}, "inputs": []}]
    return {"closures": list(closures), "graph": {"nodes": nodes}, "shader_outputs": list(outputs)}


def output(name, color=(0.0,) * 4, value=(0.0,) * 4):
    """A shader output of constants, or of nodes given as (number, channel)."""

    def source(given):
        return {"Node": list(given)} if isinstance(given[1], str) else {"Constant": list(given)}

    return {"name": name, "color": source(color), "value": source(value)}


def painted(material, *passes, **settings):
    """The two squares from above with nothing around them; filters are so narrow that no pixel mixes."""
    scene = gonio.Scene()
    scene.set(**{"width": 48, "height": 24, "samples": 4, "filter": "box", "filter_width": 0.01, "passes": list(passes), **settings})
    mesh = scene.add_mesh(POINTS, TRIANGLES, primvars={"paint": PAINT})
    scene.add_instance(mesh, [scene.put_material(material)])
    scene.add_camera(above(2), fov=32)
    return scene


def regions(values):
    """Pixels of the left square, of the right one, and of the background."""
    height, width, _ = values.shape
    x = (np.arange(width) + 0.5) / width * 2 - 1
    y = (np.arange(height) + 0.5) / height * 2 - 1
    half = 2 * np.tan(np.radians(16))
    x, y = np.meshgrid(x * half * width / height, y * half)
    inside = (abs(x) < 1) & (abs(y) < 0.5)
    return values[inside & (x < 0)], values[inside & (x > 0)], values[~inside]


def test_colours_and_numbers_are_exact():
    film = finished(painted(described(output("paint", (0, "Rgb"), (0, "B"))), "color", "aov:paint", "aov_value:paint"))
    assert film.passes == ["color", "aov:paint", "aov_value:paint"]
    assert film["aov:paint"].channels == ["R", "G", "B", "A"] and film["aov_value:paint"].channels == ["value"]
    left, right, around = regions(np.asarray(film["aov:paint"]))
    assert len(left) > 50 and (left == [1.0, 0.25, 0.0, 1.0]).all()
    assert (right == [0.0, 0.5, 8.0, 1.0]).all() and (around == 0.0).all()
    left, right, around = regions(np.asarray(film["aov_value:paint"]))
    assert (left == 0.0).all() and (right == 8.0).all() and (around == 0.0).all()


def test_only_outputs_of_the_name_show():
    outputs = (output("one", value=(1.0,) * 4), output("color", value=(2.0,) * 4), output("one", value=(4.0,) * 4))
    film = finished(painted(described(*outputs), "aov_value:color", "aov_value:one", "aov_value:none", "color"))
    for name, expected in (("aov_value:color", 2.0), ("aov_value:one", 5.0), ("aov_value:none", 0.0)):
        left, _, around = regions(np.asarray(film[name]))
        assert (left == expected).all() and (around == 0.0).all(), name


def test_the_other_passes_stay_as_they_are():
    material = described(output("paint", (0, "Rgb")))
    plain, rich = (finished(painted(material, *passes)) for passes in (["color", "normal"], ["color", "aov:paint", "normal"]))
    for name in ("color", "normal"):
        assert np.asarray(plain[name]).tobytes() == np.asarray(rich[name]).tobytes()


def test_normals_are_those_before_the_surface_bends_them():
    tilt = {"operation": "Combine", "inputs": [{"Constant": [x] * 4} for x in (0.6, 0.8, 0.0, 0.0)]}
    material = described(output("normal", (0, "Rgb")), closures=[{**WHITE, "normal": 1}], operation="Normal")
    material["graph"]["nodes"].append(tilt)
    film = finished(painted(material, "normal", "aov:normal"))
    assert regions(np.asarray(film["aov:normal"]))[0][:, :3] == pytest.approx(np.array([[0.0, 1.0, 0.0]] * len(regions(np.asarray(film["normal"]))[0])))
    assert regions(np.asarray(film["normal"]))[0][:, 0].min() > 0.3


def test_what_a_transparent_shader_lets_through_is_seen():
    half = {"weight": {"Constant": [0.5] * 4}}
    clear = {**WHITE, **half, "model": "Transparent"}
    near = described(output("depth", value=(1.0,) * 4), closures=[clear, {**WHITE, **half}])
    scene = painted(near, "alpha", "aov_value:depth", samples=256)
    far = scene.put_material(described(output("depth", value=(3.0,) * 4)))
    scene.add_instance(0, [far], transform=at(0, -0.01, 0))
    film = finished(scene)
    shown = regions(np.asarray(film["aov_value:depth"]))[0].mean(axis=0)
    # Half of the samples of each pixel; those of all pixels together hardly differ from it.
    assert shown == pytest.approx(2.0, abs=0.02)
    assert np.asarray(film["alpha"]).max() == 1.0


def test_coverage_of_a_half_transparent_shader():
    half = {"weight": {"Constant": [0.5] * 4}}
    film = finished(painted(described(closures=[{**WHITE, **half, "model": "Transparent"}, {**WHITE, **half}]), "alpha", samples=256))
    assert regions(np.asarray(film["alpha"]))[0].mean() == pytest.approx(0.5, abs=0.01)


def test_bundles_keep_shader_passes(tmp_path):
    scene = painted(described(output("paint", (0, "Rgb"))), "aov:paint")
    scene.save(tmp_path / "scene.json")
    again = finished(gonio.Scene.load(tmp_path / "scene.json"))
    assert np.asarray(again["aov:paint"]).tobytes() == np.asarray(finished(scene)["aov:paint"]).tobytes()


def test_files_name_shader_passes(tmp_path):
    OpenEXR = pytest.importorskip("OpenEXR")
    finished(painted(described(output("paint", (0, "Rgb"))), "color", "aov:paint", "aov_value:paint")).write_exr(tmp_path / "a.exr")
    with OpenEXR.File(str(tmp_path / "a.exr"), separate_channels=True) as file:
        assert {"aov:paint.R", "aov:paint.A", "aov_value:paint"} <= set(file.channels())


def test_outputs_that_read_nodes_which_are_not_there():
    with pytest.raises(gonio.SceneError, match="node 7"):
        finished(painted(described(output("paint", (7, "Rgb"))), "color"))
