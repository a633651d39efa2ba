# SPDX-License-Identifier: GPL-3.0-or-later
"""What materials may ask of the scene around them: the camera, and properties of the view layer."""

from dataclasses import dataclass

import numpy as np

from .object_attribute import attribute_of

# Keys of the camera and of how far ambient occlusion looks, and how keys begin of the view layer's properties, and of objects by their
# session_uid.
CAMERA, OCCLUSION, LAYER, OBJECT = "camera", "occlusion", "layer ", "object "


@dataclass(frozen=True)
class Eye:
    """A camera as shading sees it: three rows that take points of the world to its space, which looks along +z, and three that take them
    to the picture's coordinates times a third; None where the picture's projection is no matrix. It sees from `near` metres on: from a
    plane that rays slant through where `is_flat`, else that far along each ray."""

    space: tuple
    picture: tuple | None
    near: float = 0.0
    is_flat: bool = False

    def to_world(self):
        """The three rows back."""
        return np.linalg.inv([*self.space, (0.0, 0.0, 0.0, 1.0)])[:3].tolist()


class Surroundings:
    """The scene as of now; holds Blender data, so it is not kept."""

    def __init__(self, camera=None, depsgraph=None, part=None):
        self._camera, self._depsgraph, self._part, self._objects = camera, depsgraph, part, None

    def ask(self, key):
        """The camera, a distance of the world, a property of the view layer, the scene or the world, or the matrix to an object's space;
        None if there is none."""
        if key == CAMERA:
            return None if self._camera is None else eye_of(self._camera)
        if self._depsgraph is None:
            return None
        if key.startswith(OBJECT):
            return self._to_object(int(key.removeprefix(OBJECT)))
        layer, scene, world = self._depsgraph.view_layer, self._depsgraph.scene, self._depsgraph.scene_eval.world
        if key == OCCLUSION:
            return None if world is None else world.light_settings.distance
        return attribute_of((layer, scene, world), key.removeprefix(LAYER))

    def _to_object(self, uid):
        if self._objects is None:
            self._objects = {thing.original.session_uid: thing for thing in self._depsgraph.objects}
        thing = self._objects.get(uid)
        if thing is None:
            return None
        to_object = np.array(thing.matrix_world.inverted_safe())
        return _rows(*(to_object if self._part is None else to_object @ self._part.frame)[:3])

    def answers(self, asked):
        """Whether the answers of earlier are still right."""
        return all(self.ask(key) == answer for key, answer in asked.items())


def eye_of(description):
    """The eye of a camera's description."""
    pose = np.eye(4)
    pose[:3] = np.array(description["transform"]["columns"], dtype=float).T
    x, y, back, _ = np.linalg.inv(pose)
    ahead = -back
    projection, near = description["projection"], float(description["clipping"][0])
    return Eye(_rows(x, y, ahead), _picture(description, x, y, ahead), near, projection != "Orthographic" and "Perspective" in projection)


def _picture(description, x, y, ahead):
    projection = description["projection"]
    (width, height), (right, up) = description["aperture"], description["aperture_offset"]
    if projection == "Orthographic":
        one = np.array([0.0, 0.0, 0.0, 1.0])
        return _rows(x / width + (0.5 - right / width) * one, y / height + (0.5 - up / height) * one, one)
    if "Perspective" not in projection:
        return None
    length = projection["Perspective"]["focal_length"]
    across = length / width * x + (0.5 - right / width) * ahead
    return _rows(across, length / height * y + (0.5 - up / height) * ahead, ahead)


def _rows(*rows):
    return tuple(tuple(float(value) for value in row) for row in rows)
