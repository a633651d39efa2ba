"""What illumination maps lack of a scene's light, since it comes by light paths, is told."""

import numpy as np
import pytest
from small_scenes import at

gonio = pytest.importorskip("gonio")
light = pytest.importorskip("gonio.light").light

FEW = {"texel": 1.0, "error": 0, "paths": 1 << 14}
SIZES = {"width": 1.0, "height": 1.0, "radius": 0.1, "length": 1.0, "angle": 0.5}


def told(scene, **options):
    maps = gonio.illumination_map(scene, **{**FEW, **options})
    return [f"{origin}: {message}" for origin, message in maps.diagnostics]


@pytest.mark.parametrize(
    ("of_light", "words"),
    [
        ({"casts_shadow": False}, "casts no shadows"),
        ({"falloff": {"power": 2, "smooth": 0.0}}, "falls by nature"),
        ({"diffuse": 0.5}, "factors on diffuse"),
    ],
)
def test_lamps_that_differ(floor, of_light, words):
    scene = floor()
    described = light("odd", "sphere", (1000.0,) * 3, at(1, 2, 0), SIZES, True, {})
    for number in range(2):
        scene.put_light({**described, **of_light})
    (line,) = told(scene)
    assert line.startswith("odd: ") and words in line and line.endswith("; so with 1 more")


def test_surfaces_beyond_the_table(floor):
    """A wall of 200,002 triangles that shines is not among the lights of the table."""
    scene = floor()
    count = 100_001
    x = np.linspace(0, 1, count + 1)
    points = np.stack([np.repeat(x, 2), np.tile([1.0, 2.0], count + 1), np.full(2 * count + 2, -3.0)], axis=-1).astype("f4")
    first = 2 * np.arange(count)[:, None]
    triangles = np.concatenate([first + [0, 2, 3], first + [0, 3, 1]]).astype("i4")
    shining = scene.add_material("shining", emission_color=(100.0,) * 3)
    scene.add_instance(scene.add_mesh(points, triangles, name="wall"), [shining], name="wall")
    lines = told(scene, prims=["floor"])
    assert any(line.startswith("wall: its own light is missing") for line in lines), lines


def test_nothing_to_tell(floor):
    assert told(floor()) == []
