"""Trees of meshes that are built while a scene is described: the picture is the same to the bit."""

import gonio
import numpy as np
import pytest
from small_scenes import at

SIDE = 70
# Beyond this many triangles a scene has trees that do not depend on what is still to come.
MANY = 1 << 18


def ground(shift: float, side: int = SIDE) -> tuple[np.ndarray, np.ndarray]:
    """Wrinkled squares as triangles."""
    x, y = np.meshgrid(*(2 * [np.linspace(0.0, 1.0, side + 1, dtype="f4")]))
    points = np.stack([x, y, 0.1 * np.sin(9.0 * x + shift) * np.cos(7.0 * y)], axis=2).reshape(-1, 3).astype("f4")
    first = (np.arange(side)[:, None] * (side + 1) + np.arange(side)).reshape(-1, 1)
    return points, (first + np.array([0, 1, side + 2, 0, side + 2, side + 1])).reshape(-1, 3).astype("i4")


def scene_of(count: int, *, ahead: bool, change=None) -> gonio.Scene:
    """So many pieces of ground side by side under an even sky; a change is made once all are told."""
    scene = gonio.Scene()
    grey = scene.add_material("grey", base_color=(0.5, 0.5, 0.5))
    for number in range(count):
        mesh = scene.put_mesh(*ground(0.3 * number), name=f"ground {number}", ahead=ahead)
        scene.add_instance(mesh, [grey], transform=at(number % 6, number // 6, 0.0))
    if change is not None:
        change(scene, ahead)
    scene.add_light("dome", (1000.0, 1000.0, 1000.0))
    scene.add_camera(gonio.look_at((3.0, -4.0, 5.0), (3.0, 2.0, 0.0), up=(0.0, 0.0, 1.0)))
    scene.set(width=48, height=32, samples=2, seed=3)
    return scene


def picture(scene: gonio.Scene, previous: gonio.Render | None = None) -> tuple[bytes, gonio.Render]:
    """The bits of the picture, and its render."""
    render = gonio.Render(scene, previous)
    render.wait()
    return np.asarray(render.film()["color"]).tobytes(), render


def fewer(scene, ahead):
    """Most of the meshes are gone again."""
    nothing = np.zeros((0, 3), "f4"), np.zeros((0, 3), "i4")
    for number in range(4, 30):
        scene.put_mesh(*nothing, index=number, ahead=ahead)


def others(scene, ahead):
    """Some have other points."""
    for number in (0, 7, 29):
        scene.put_mesh(*ground(2.0 + number), index=number, ahead=ahead)


def finer(scene, ahead):
    """One is cut when the scene is compiled."""
    scene.set_dicing(3, length=0.01)


@pytest.mark.parametrize("change", [None, fewer, others, finer])
def test_trees_that_are_built_ahead_are_the_same(change):
    assert 30 * 2 * SIDE * SIDE > MANY
    (ahead, _), (later, _) = (picture(scene_of(30, ahead=ahead, change=change)) for ahead in (True, False))
    assert ahead == later


def test_few_triangles_have_the_trees_of_few():
    (ahead, _), (later, _) = (picture(scene_of(3, ahead=ahead)) for ahead in (True, False))
    assert ahead == later


def test_scenes_are_rendered_again_and_changed():
    pictures = []
    for ahead in (True, False):
        scene = scene_of(30, ahead=ahead)
        first, render = picture(scene)
        again, render = picture(scene, render)
        others(scene, ahead)
        changed, _ = picture(scene, render)
        pictures.append((first, again, changed))
    assert pictures[0] == pictures[1] and pictures[0][0] == pictures[0][1] != pictures[0][2]


def test_a_scene_that_is_never_rendered_ends_at_once():
    scene = scene_of(30, ahead=True)
    assert scene.to_dict()["meshes"]
    del scene


def test_a_large_mesh_is_built_with_the_others():
    def large(scene, ahead):
        scene.put_mesh(*ground(1.0, 380), index=5, ahead=ahead)

    (ahead, _), (later, _) = (picture(scene_of(30, ahead=ahead, change=large)) for ahead in (True, False))
    assert ahead == later
