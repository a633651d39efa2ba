"""The Cornell box of the validation, diffuse."""

import cornell as box
import numpy
from description import Camera, Mesh, Rectangle, Scene


def scene() -> Scene:
    """Two boxes under one wide light."""
    meshes = [Mesh(part.name, part.points, part.triangles, part.surface) for part in box.parts("diffuse")]
    light = Rectangle(numpy.array(box.light_matrix(), "f8"), box.LIGHT_WIDTH, box.LIGHT_DEPTH, (1000.0, 900.0, 750.0), behind=box.WHITE)
    return Scene(meshes, [light], Camera(numpy.array(box.camera_matrix(), "f8"), box.CAMERA_FOV))
