"""Balls of few faces with smooth normals under the sun: what starts from the curved surface is lit as a ball of many faces is."""

import numpy as np
import pytest
from small_scenes import ball

import gonio

SIZE, LUX = 48, np.pi
# How far the ball is turned, radians: neither a corner nor the middle of a face lies where the light only just arrives.
TURNED = {"distant": 0.1, "sphere": 0.0}


def pictured(sides, terminator, *, inside=False, lamp="distant"):
    """A white ball lit from the right, seen along −z."""
    scene = gonio.Scene()
    scene.set(width=SIZE, height=SIZE, samples=64, max_bounces=0)
    points, triangles = ball(sides)
    mesh = scene.add_mesh(points, triangles, normals=points)
    white = scene.add_material("white", base_color=(1.0, 1.0, 1.0), specular_weight=0.0)
    cos, sin = np.cos(TURNED[lamp]), np.sin(TURNED[lamp])
    turned = np.array([[cos, 0, sin, 0], [0, 1, 0, 0], [-sin, 0, cos, 0], [0, 0, 0, 1]])
    scene.put_instances(mesh, [white], turned[None], shadow_terminator=terminator)
    if lamp == "distant":
        scene.add_light("distant", [LUX] * 3, angle=0.0, transform=[[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0], [0, 0, 0, 1]])
    else:
        scene.add_light("sphere", [400.0] * 3, radius=0.2, transform=[[1, 0, 0, 4], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    scene.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0 if inside else 8], [0, 0, 0, 1]], fov=90 if inside else 15.0)
    with gonio.Render(scene) as render:
        assert render.wait()
        return np.asarray(render.film()["color"])[..., 0]


def off(shown, right):
    """How far the middle of the ball is off, where its outline does not count, as a share of what is lit in full."""
    middle = slice(SIZE // 4, -SIZE // 4)
    return np.abs(shown - right)[middle, middle].mean() / right.max()


@pytest.mark.parametrize("lamp", ["distant", "sphere"])
def test_a_ball_of_few_faces_is_lit_as_a_round_one(lamp):
    right = pictured(256, 0.0, lamp=lamp)
    plain, lifted = (off(pictured(16, terminator, lamp=lamp), right) for terminator in (0.0, 0.1))
    assert plain > 0.002 and lifted < 0.5 * plain, (plain, lifted)


def test_flat_faces_and_fine_meshes_are_as_they_were():
    fine = pictured(256, 0.0)
    assert np.abs(pictured(256, 0.1) - fine).max() < 0.02 * fine.max()


def test_no_light_comes_into_what_is_closed():
    assert pictured(16, 1.0, inside=True).max() == 0.0
    assert pictured(16, 1.0, inside=True, lamp="sphere").max() == 0.0


def test_a_cosine_is_asked_for():
    scene = gonio.Scene()
    with pytest.raises(gonio.SettingError, match="shadow_terminator: 2 was found, expected a cosine from 0 to 1"):
        scene.put_instances(None, [], np.eye(4)[None], points=0, shadow_terminator=2.0)
