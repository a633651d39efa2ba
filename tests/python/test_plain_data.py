"""Scenes and measured materials that are pickled and copied, pictures in notebooks, and where cameras look."""

import copy
import pickle
import struct
import zlib

import gonio
import numpy
import pytest
from small_scenes import finished, floor_scene


def colour(scene):
    return numpy.asarray(finished(scene)["color"])


@pytest.mark.parametrize("copied", [lambda scene: pickle.loads(pickle.dumps(scene)), copy.deepcopy, copy.copy])
def test_a_copied_scene_renders_the_same_bits(copied):
    scene = floor_scene()
    texture = scene.add_texture(numpy.full((2, 2, 3), 0.3, "f4"), colour_space="raw")
    scene.add_instance(0, [scene.add_material(base_color=texture)], transform=[[1, 0, 0, 2], [0, 1, 0, 0.1], [0, 0, 1, 0], [0, 0, 0, 1]])
    other = copied(scene)
    assert type(other) is gonio.Scene and other.to_dict() == scene.to_dict()
    before = colour(scene)
    assert numpy.array_equal(colour(other), before)
    # The copy is its own.
    other.truncate("instances", 0)
    assert numpy.array_equal(colour(scene), before)


def test_cameras_of_a_copy_follow_the_picture_as_before():
    scene = floor_scene()
    other = pickle.loads(pickle.dumps(scene))
    for each in (scene, other):
        each.set(width=64, height=16)
    assert other.to_dict()["cameras"] == scene.to_dict()["cameras"]


def test_diagnostics_travel(tmp_path):
    (tmp_path / "odd.usda").write_text('#usda 1.0\ndef Cube "c" (prepend apiSchemas = ["MaterialBindingAPI"])\n{\n    rel material:binding = </none>\n}\n')
    scene = gonio.load_usd(tmp_path / "odd.usda")
    assert pickle.loads(pickle.dumps(scene)).diagnostics == scene.diagnostics


def test_measured_materials():
    axes = {"theta_i": numpy.linspace(0, 80, 5), "theta_o": numpy.linspace(0, 80, 5), "delta_phi": numpy.linspace(0, 180, 5)}
    bsdf = gonio.MeasuredBsdf.from_table(axes, numpy.full((5, 5, 5), 0.1, "f4"))
    other = pickle.loads(pickle.dumps(bsdf))
    wi = numpy.array([[0.0, 0.6, 0.8], [0.3, 0.0, 0.954]])
    assert numpy.array_equal(numpy.asarray(other.eval(wi, wi)), numpy.asarray(bsdf.eval(wi, wi)))


def rows(png):
    """Width, height and the decoded bytes of a PNG."""
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    at, data, size = 8, b"", None
    while at < len(png):
        length, kind = struct.unpack(">I4s", png[at : at + 8])
        body = png[at + 8 : at + 8 + length]
        size = struct.unpack(">II", body[:8]) if kind == b"IHDR" else size
        data += body if kind == b"IDAT" else b""
        at += length + 12
    return size, zlib.decompress(data)


def test_notebooks_show_films_and_pictures(tmp_path):
    film = finished(floor_scene(width=24, height=16))
    size, _ = rows(film._repr_png_())
    assert size == (24, 16) and film._repr_png_() == film.picture()._repr_png_()
    shown = gonio.false_colour(numpy.asarray(film["illuminance"]), legend=False)
    assert rows(shown._repr_png_())[0] == shown.size
    assert finished(floor_scene(passes=["illuminance"]))._repr_png_() is None


@pytest.mark.parametrize("up", [(0, 1, 0), (0, 0, 1), (1, 2, 3)])
@pytest.mark.parametrize("target", [(1, 2, 3), (-4, 0, 2), (1, 9, 3), (1, 2, -7)])
def test_look_at_is_a_turn_that_looks_at_its_target(target, up):
    position = (1.0, 2.0, -3.0)
    m = numpy.array(gonio.look_at(position, target, up))
    assert m[:3, :3] @ m[:3, :3].T == pytest.approx(numpy.eye(3), abs=1e-12) and numpy.linalg.det(m[:3, :3]) == pytest.approx(1.0)
    way = numpy.subtract(target, position)
    assert -m[:3, 2] == pytest.approx(way / numpy.linalg.norm(way)) and m[:3, 3] == pytest.approx(position)
    assert numpy.dot(m[:3, 1], up) > -1e-12 and m[3].tolist() == [0, 0, 0, 1]


def test_look_at_the_same_place_is_refused():
    with pytest.raises(ValueError, match="same point"):
        gonio.look_at((1, 2, 3), (1, 2, 3))
    with pytest.raises(ValueError, match="up has no direction"):
        gonio.look_at((1, 2, 3), (0, 0, 0), (0, 0, 0))


def test_a_lamp_that_is_aimed_lights_what_it_looks_at():
    scene = gonio.Scene()
    scene.add_light("disk", lumens=100.0, radius=0.01, transform=gonio.look_at((3, 4, 0), (0, 0, 0)))
    scene.add_meter((0, 0, 0), normal=(0.6, 0.8, 0.0))
    # A small Lambertian source of 100 lm: 100 / π cd along its axis, 5 m away.
    assert gonio.measure(scene, samples=256).meters[0].value == pytest.approx(100 / numpy.pi / 25, rel=1e-3)
