"""Lights in the same place: what they send adds up, whoever finds it, light samples or the rays of surfaces."""

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, at, finished

# Red, green and blue, each in one light alone, and of different strength.
PARTS = ((30.0, 0.0, 0.0), (0.0, 10.0, 0.0), (0.0, 0.0, 2.0))
DOWN = [[1, 0, 0, 0], [0, 0, 1, 1.0], [0, -1, 0, 0], [0, 0, 0, 1]]
SHAPES = {
    "sphere": {"radius": 0.4, "transform": at(0, 1.0, 0)},
    "disk": {"radius": 0.4, "transform": DOWN},
    "rectangle": {"width": 0.6, "height": 0.6, "transform": DOWN},
}
# Beyond eight lights their shapes stand in the tree.
OTHERS = {"beside the tree": 0, "in the tree": 12}


def seen(shape, parts, others, roughness):
    """A floor below the lights, in the mean."""
    scene = gonio.Scene()
    scene.set(width=16, height=16, samples=256, passes=["color"], filter="box", filter_width=1.0, max_bounces=1)
    floor = scene.add_material("floor", base_color=(0.8,) * 3, metalness=1.0 if roughness else 0.0, specular_roughness=roughness, specular_weight=1.0)
    scene.add_instance(scene.add_mesh(FLOOR, QUAD, name="floor"), [floor], name="floor")
    for part in parts:
        scene.add_light(shape, part, **SHAPES[shape])
    for number in range(others):
        scene.add_light("sphere", (1e-6,) * 3, radius=0.01, transform=at(50.0 + number, 1.0, 0.0))
    scene.add_camera(above(3.0), fov=20)
    return np.asarray(finished(scene)["color"])[..., :3].mean((0, 1))


@pytest.mark.parametrize("others", OTHERS)
@pytest.mark.parametrize("roughness", [0.0, 0.3], ids=["matte", "glossy"])
@pytest.mark.parametrize("shape", SHAPES)
def test_lights_in_one_place_add_up(shape, roughness, others):
    together = seen(shape, PARTS, OTHERS[others], roughness)
    alone = np.array([seen(shape, [part], OTHERS[others], roughness)[c] for c, part in enumerate(PARTS)])
    # Of a hundred thousand samples the weakest light gets the fewest.
    assert np.allclose(together, alone, rtol=0.02), together / alone - 1.0


@pytest.mark.parametrize("others", OTHERS)
def test_cameras_see_all_lights_in_one_place(others):
    scene = gonio.Scene()
    scene.set(width=8, height=8, samples=16, passes=["color"])
    for part in PARTS:
        scene.add_light("sphere", part, radius=0.4, transform=at(0, 0, 0))
    for number in range(OTHERS[others]):
        scene.add_light("sphere", (1e-6,) * 3, radius=0.01, transform=at(50.0 + number, 1.0, 0.0))
    scene.add_camera(above(5.0), fov=2)
    color = np.asarray(finished(scene)["color"])[..., :3]
    assert np.allclose(color, np.sum(PARTS, axis=0), rtol=1e-5)
