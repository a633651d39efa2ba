"""Small scenes that the tests of the Python module share."""

import gonio
import numpy as np


def at(x, y, z):
    """A matrix that moves."""
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def constant(value):
    """A number or a colour as an input of a described material."""
    return {"Constant": [*(value if isinstance(value, tuple) else (value,) * 3), 1.0]}


def closure(model, **parameters):
    """A closure of a described material."""
    return {"weight": constant(1.0), "model": model, "parameters": [[name, constant(value)] for name, value in parameters.items()]}


def above(height):
    """A camera's matrix that looks straight down from a height."""
    return [[1, 0, 0, 0], [0, 0, 1, height], [0, -1, 0, 0], [0, 0, 0, 1]]


def ball(sides):
    """Points on a sphere of radius 1, which are its normals too, and triangles; so many sides around."""
    rings = sides // 2
    theta, phi = np.meshgrid(np.pi * np.arange(rings + 1) / rings, 2 * np.pi * np.arange(sides) / sides, indexing="ij")
    points = np.stack([np.sin(theta) * np.cos(phi), np.cos(theta), np.sin(theta) * np.sin(phi)], axis=-1).reshape(-1, 3).astype("f4")
    triangles = []
    for ring in range(rings):
        for side in range(sides):
            a, b = ring * sides + side, ring * sides + (side + 1) % sides
            c, d = b + sides, a + sides
            triangles += [(a, b, c)] * (ring > 0) + [(a, c, d)] * (ring < rings - 1)
    return points, np.array(triangles, "i4")


FLOOR = np.array([[-5, 0, 5], [5, 0, 5], [5, 0, -5], [-5, 0, -5]], "f4")
QUAD = np.array([[0, 1, 2], [0, 2, 3]], "i4")


def block(low, high):
    """Corners and triangles of a box along the axes."""
    corners = [[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)]
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    triangles = [corner for a, b, c, d in quads for corner in (a, b, c, a, c, d)]
    return np.array(corners, "f4"), np.array(triangles, "i4").reshape(-1, 3)


def floor_scene(**settings):
    """A grey floor of 10 m by 10 m, a small sphere light 2 m over its middle, and a camera that looks down."""
    scene = gonio.Scene()
    scene.set(**{"width": 32, "height": 32, "samples": 4, "passes": ["color", "illuminance"], **settings})
    floor = scene.add_mesh(FLOOR, QUAD, name="floor")
    grey = scene.add_material("grey", base_color=(0.5, 0.5, 0.5), specular_weight=0.0)
    scene.add_instance(floor, [grey], name="floor")
    scene.add_light("sphere", (1000.0, 1000.0, 1000.0), radius=0.1, transform=at(0, 2, 0), name="lamp")
    scene.add_camera(above(8), fov=40)
    return scene


def finished(scene):
    """The film of the whole render."""
    with gonio.Render(scene) as render:
        assert render.wait()
        return render.film()
