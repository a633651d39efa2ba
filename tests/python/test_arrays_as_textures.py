"""Textures from arrays: their colours on surfaces and in lights, as their colour space says."""

import gonio
import numpy
import pytest

WHITE_SKY = (1.0, 1.0, 1.0)


def seen(image, colour_space, *, parameter="base_color", channel=None, base=(1.0, 1.0, 1.0), **more):
    """What a matt square shows under a white sky of luminance 1: its upper left, upper right, lower left and lower right quarter."""
    scene = gonio.Scene()
    scene.set(width=32, height=32, samples=16, max_bounces=1, passes=["color"], filter="box", filter_width=1.0)
    points = numpy.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], "f4")
    uvs = numpy.array([[0, 0], [1, 0], [1, 1], [0, 1]], "f4")
    square = scene.add_mesh(points, numpy.array([[0, 1, 2], [0, 2, 3]], "i4"), uvs=uvs)
    texture = scene.add_texture(image, colour_space=colour_space, wrap="clamp", **more)
    given = {"specular_weight": 0.0, "base_color": base, parameter: texture.channel(channel) if channel else texture}
    scene.add_instance(square, [scene.add_material(**given)])
    scene.add_light("dome", WHITE_SKY)
    scene.add_camera(gonio.look_at((0, 0, 10), (0, 0, 0)), fov=2 * numpy.degrees(numpy.arctan(0.1)))
    with gonio.Render(scene) as render:
        render.wait()
        colour = numpy.asarray(render.film()["color"])[..., :3]
    return numpy.array([[colour[y, x] for x in (3, 28)] for y in (3, 28)])


def linear(stored):
    return numpy.where(stored <= 0.04045, stored / 12.92, ((stored + 0.055) / 1.055) ** 2.4)


CODES = numpy.array([[[255, 0, 0], [0, 128, 0]], [[0, 0, 64], [188, 188, 188]]], "u1")


def test_bytes_are_decoded_as_their_colour_space_says():
    assert seen(CODES, "sRGB") == pytest.approx(linear(CODES / 255.0), abs=0.01)
    assert seen(CODES, "raw") == pytest.approx(CODES / 255.0, abs=0.01)


def test_floats_and_short_numbers():
    values = numpy.array([[0.2, 0.4], [0.6, 0.8]])
    for image in (values, values.astype("f4"), numpy.round(values * 65535).astype("u2"), values[..., None].astype("f4")):
        assert seen(image, "lin_rec709") == pytest.approx(numpy.repeat(values[..., None], 3, axis=-1), abs=0.01)
    wide = numpy.zeros((2, 2, 4), "f4")
    wide[..., 1] = 0.5
    wide[..., 3] = 1.0
    # AP1's green is more than Rec.709 can show: red below zero, which surfaces do not reflect.
    assert seen(wide, "ACEScg")[0, 0, 1] > 0.5 > seen(wide, "raw")[0, 0, 1] - 1e-3


def test_one_channel_of_an_image_and_repetition():
    weight = numpy.zeros((2, 2, 3), "f4")
    weight[0, :, 1] = 0.5
    # Black where it is there, the sky where it is not.
    shown = seen(weight, "raw", parameter="geometry_opacity", channel="G", base=(0.0, 0.0, 0.0))
    assert shown[0].mean() == pytest.approx(0.5, abs=0.05) and shown[1] == pytest.approx(1.0, abs=0.01)
    row = numpy.array([[0.0, 1.0]], "f4")
    assert seen(row, "raw")[0, :, 0] == pytest.approx([0.0, 1.0], abs=0.01)


def test_a_dome_from_an_array():
    scene = gonio.Scene()
    sky = numpy.zeros((64, 128, 3), "f4")
    sky[:32] = 1.0
    scene.add_light("dome", (10.0,) * 3, texture=scene.add_texture(sky, colour_space="lin_rec709"))
    # A lat-long dome's pole is +y: the upper half alone shines.
    scene.add_meter((0, 0, 0), normal=(0, 1, 0))
    scene.add_meter((0, 0, 0), normal=(0, -1, 0))
    up, below = gonio.measure(scene, samples=2048).meters
    assert up.value == pytest.approx(10.0 * numpy.pi, rel=0.01) and below.value < 0.2


def test_what_cannot_be_a_texture():
    scene = gonio.Scene()
    with pytest.raises(ValueError, match="colour_space"):
        scene.add_texture(CODES)
    with pytest.raises(gonio.SettingError, match="no such space"):
        scene.add_texture(CODES, colour_space="no such space")
    with pytest.raises(ValueError, match="expected \\(height, width\\)"):
        scene.add_texture(numpy.zeros((2, 2, 5), "f4"), colour_space="raw")
    with pytest.raises(TypeError, match="uint8"):
        scene.add_texture(numpy.zeros((2, 2), "i8"), colour_space="raw")
