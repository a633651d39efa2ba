# SPDX-License-Identifier: GPL-3.0-or-later
"""The world as domes: an even one, an image turned by its mapping, or whatever the nodes compute, baked."""

from dataclasses import replace
from math import cos, radians, sin

import bpy
import numpy as np
from gonio.graph import Value

from ..units import LUMENS_PER_WATT
from . import daylight
from .bake import bake
from .colour_management import to_rec709
from .daylight import facing
from .evaluate import Pictures
from .light_description import at_infinity
from .material.flatten import flatten
from .material.interior import medium
from .material.shader_outputs import outputs_of
from .material.sockets import active_output, input_socket
from .material.textures import equirectangular, mirror_ball
from .material.translator import Translator
from .sky_texture import Picture
from .visibility import RAYS

# Axes of gonio's dome (latitude-longitude by the OpenEXR convention: +Y up, +Z in the middle, longitude to the left) in Blender's
# world, where +Z is up and an image's middle lies at +X.
DOME_TO_BLENDER = np.array([[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
# Axes of the mirrored ball, seen along −Z of the dome, where Blender sees it along +Y.
BALL_TO_BLENDER = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])

# Rays by Cycles' names of a world's switches for them.
SWITCHES = {"camera": "camera", "diffuse": "diffuse", "glossy": "glossy", "transmission": "transmission", "volume": "scatter"}


class WorldTranslator(Translator):
    """Keeps which image lies how around the scene, so that it need not be baked."""

    def __init__(self, *arguments, **keywords):
        super().__init__(*arguments, **keywords)
        # node number -> (image node, direction's matrix or None)
        self.environments = {}

    def environment(self, node, context, towards):
        """The value of an environment texture: a node of its own, remembered with its image."""
        is_ball = node.projection == "MIRROR_BALL"
        uv = mirror_ball(self, towards) if is_ball else equirectangular(self, towards)
        fields = {"image": node.image.name, "closest": node.interpolation == "Closest", "repeat": not is_ball}
        value = self.graph.add({"Lookup": fields}, uv, kind="RGBA")
        number = self.images.texture(node.image, node.image_user, self.report)
        matrix = None if number is None else self._linear(towards)
        self.environments[value.node] = (node.image, number, is_ball, matrix)
        return value

    def sky(self, picture, towards, uv):
        """The value of a sky that was drawn: as an environment texture's, and its sun is remembered."""
        key = (self.owner.original.session_uid, self.is_camera_ray, len(self.environments))
        number = self.images.changing(("sky", *key), picture.name, picture.pixels)
        fields = {"image": f"{picture.name} {number}", "closest": False, "repeat": True}
        value = self.graph.add({"Lookup": fields}, uv, kind="RGBA")
        picture = replace(picture, name=fields["image"])
        self.environments[value.node] = (picture, number, False, self._linear(towards))
        return value

    def _linear(self, towards):
        """The 3×3 matrix that turns the asked direction into this one; None if it is anything else."""
        matrix, value = np.eye(3), towards.input()
        while "Node" in value:
            node = self.graph.nodes[value["Node"][0]]
            operation = node["operation"]
            if operation == "Direction":
                return matrix
            if not isinstance(operation, dict) or "Transform3d" not in operation:
                return None
            rows = np.array(operation["Transform3d"]["rows"])
            if np.abs(rows[:, 3]).max() > 1e-6:
                return None
            matrix, value = matrix @ rows[:, :3], node["inputs"][0]
        return None


def domes(world, images, report, surroundings=None):
    """Descriptions of the domes that a world amounts to, and what its nodes asked of the scene, with the answers."""
    if world is None:
        return [], {}
    report.forget("World", world.name)
    if world.gonio.use_daylight:
        return _with_visibility(world, daylight.lights(world, images, report)), {}
    tree = world.node_tree
    if tree is None or not _uses_nodes(world):
        return _with_visibility(world, [_even(world, np.array(to_rec709(world.color)))]), {}
    around = (images, report, surroundings)
    seen, t = _dome(world, tree, around, is_camera_ray=False)
    if not t.asked_for_ray:
        return _with_visibility(world, seen), t.asked
    # Camera rays see another world than the one that lights the scene.
    shown, of_camera = _dome(world, tree, around, is_camera_ray=True)
    for dome in seen:
        dome["visibility"]["camera"] = False
    for dome in shown:
        dome["visibility"].update({ray: ray == "camera" for ray in RAYS})
    return _with_visibility(world, [*seen, *shown]), t.asked | of_camera.asked


def atmosphere(world, images, report, surroundings):
    """The translator of a world's Volume, which is asked for places, and the medium that it is; None where there is none."""
    if world is None or world.node_tree is None or not _uses_nodes(world):
        return None, None
    t = Translator(world, world.node_tree, Pictures(images, report), report, kind="World", is_camera_ray=False, surroundings=surroundings)
    end = active_output(world.node_tree, "World")
    if end is None or not t.linked(end, "Volume", t.root):
        return t, None
    found = medium(t, input_socket(end, "Volume"), t.root)
    if found is None:
        t.tell("world volume", end, t.root)
    elif not found.is_plain:
        t.tell("phase", end, t.root, "Volume")
    return t, found


def _uses_nodes(world):
    return bpy.app.version >= (5, 0, 0) or world.use_nodes


def _with_visibility(world, descriptions):
    """Takes Cycles' ray switches of the world over, and its light group and its luminance."""
    switches = getattr(world, "cycles_visibility", None)
    settings = world.gonio
    for dome in descriptions:
        dome["group"] = world.lightgroup
        if settings.use_luminance and not settings.use_daylight:
            dome["emission"]["radiance"] = [x * settings.luminance / LUMENS_PER_WATT for x in dome["emission"]["radiance"]]
    for dome in descriptions if switches is not None else ():
        for ray, switch in SWITCHES.items():
            dome["visibility"][ray] &= bool(getattr(switches, switch, True))
    return [dome for dome in descriptions if any(dome["visibility"][ray] for ray in SWITCHES)]


def _dome(world, tree, around, is_camera_ray):
    images, report, surroundings = around
    known = {"kind": "World", "is_world": True, "is_camera_ray": is_camera_ray, "surroundings": surroundings}
    t = WorldTranslator(world, tree, Pictures(images, report), report, **known)
    end = active_output(tree, "World")
    if end is None:
        return [], t
    for node, context in outputs_of(t.root):
        t.tell("world aov", node, context)
    flatten(t, input_socket(end, "Surface"), t.root, t.graph.scalar(1.0))
    total = t.graph.colour((0.0, 0.0, 0.0))
    for closure in t.closures:
        if closure["model"] == "Emission":
            total = total + _value(t, dict(closure["parameters"])["emission_color"]) * _value(t, closure["weight"])
    return _described(world, t, total, images, report), t


def _value(t, source):
    if "Constant" in source:
        return Value(t.graph, "RGBA", tuple(source["Constant"]))
    number, channel = source["Node"]
    return Value(t.graph, "RGBA", node=number, channel=channel)


def _described(world, t, total, images, report):
    if total.is_constant:
        return [] if total.is_zero() else [_even(world, np.array(total.constant[:3]) / LUMENS_PER_WATT)]
    factor, node = _factored(t, total)
    if node in t.environments:
        image, number, is_ball, matrix = t.environments[node]
        orientation = None if number is None or matrix is None else _orientation(matrix, is_ball)
        if orientation is not None:
            dome = _dome_of(world, factor, orientation, number, "MirroredBall" if is_ball else "LatLong")
            return [dome, *_sun(world, image, factor, matrix)]
    if any(isinstance(image, Picture) and any(image.sun) for image, *_ in t.environments.values()):
        t.tell("sun behind nodes", active_output(t.root.tree, "World"), t.root)
    pixels = bake(t, total, report)
    number = images.baked((world.original.session_uid, t.is_camera_ray), world.name, pixels)
    return [_dome_of(world, np.ones(3), DOME_TO_BLENDER, number, "LatLong")]


def _factored(t, value):
    """A value as a constant times a node."""
    factor, source = np.ones(3), value.input()
    while "Node" in source and source["Node"][1] == "Rgb":
        node = t.graph.nodes[source["Node"][0]]
        constants = [i for i in node["inputs"] if "Constant" in i]
        if node["operation"] != "Multiply" or len(constants) != 1:
            return factor, source["Node"][0]
        factor = factor * np.array(constants[0]["Constant"][:3])
        source = next(i for i in node["inputs"] if "Node" in i)
    return factor, None


def _orientation(matrix, is_ball):
    """Axes of the dome in the world, for a direction that is multiplied by `matrix` before it is looked up; None if that bends it."""
    scale = np.cbrt(abs(np.linalg.det(matrix)))
    if scale == 0.0 or np.abs(matrix @ matrix.T / scale**2 - np.eye(3)).max() > 1e-4:
        return None
    return (matrix / scale).T @ (BALL_TO_BLENDER if is_ball else DOME_TO_BLENDER)


def _sun(world, picture, factor, matrix):
    """The disc of a sky that was drawn and is looked up in directions multiplied by `matrix`; nothing for images."""
    if not isinstance(picture, Picture) or not any(picture.sun) or picture.elevation <= 0.0:
        return []
    elevation = radians(picture.elevation)
    towards = np.linalg.solve(matrix, [0.0, cos(elevation), sin(elevation)])
    axes = facing(towards / np.linalg.norm(towards))
    shape = {"Distant": {"angle_deg": picture.diameter}}
    return [at_infinity(world.name, shape, factor * np.array(picture.sun), axes, normalized=True)]


def _even(world, radiance):
    return _dome_of(world, radiance * LUMENS_PER_WATT, DOME_TO_BLENDER, None, "LatLong")


def _dome_of(world, radiance, axes, texture, layout):
    return at_infinity(world.name, {"Dome": {"format": layout}}, radiance, axes, texture=texture)
