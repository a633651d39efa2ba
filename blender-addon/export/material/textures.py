# SPDX-License-Identifier: GPL-3.0-or-later
"""Texture nodes: images and environments, checker and gradient."""

from math import pi

import numpy as np

from ..colour_management import gonio_name
from .box_projection import box_projection
from .image_filter import clipped_alpha, decoded, divided, multiplied_encoded
from .inputs import GENERATED, UV, direction, hit
from .sockets import follow, input_socket
from .registry import value_node
from .vectors import mapping_matrix, transform3d

WRAP = {"REPEAT": "Repeat", "EXTEND": "Clamp", "CLIP": "Black", "MIRROR": "Mirror"}
FILTERS = {"Closest": "Closest", "Linear": "Linear", "Cubic": "Cubic", "Smart": "Cubic"}
# Of sRGB's bytes, which Cycles mixes as they are encoded.
FILTERS_OF_CODES = {"Closest": "Closest", "Linear": "LinearCodes", "Cubic": "CubicCodes", "Smart": "CubicCodes"}
# What Blender shows for an image that is missing.
MISSING = (1.0, 0.0, 1.0, 1.0)
# Since this version Blender lays groups flat before Cycles sees them: a group's unlinked input is a constant, no longer nothing.
LAID_FLAT = (5, 0, 0)
# Textures that Blender leaves to Cycles even where all their inputs are constants.
PICTURES = frozenset({"ShaderNodeTexImage", "ShaderNodeTexEnvironment", "ShaderNodeTexSky", "ShaderNodeTexIES"})


def _is_placed(t, node, context):
    """Whether a texture's vector input says where it is looked up."""
    if t.linked(node, "Vector", context):
        return True
    own = input_socket(node, "Vector")
    found = None if own is None or t.version < LAID_FLAT else follow(own, context)
    if found is None or found.node is not None or found.output.node.type != "GROUP":
        return False
    # Blender computes procedural textures of constants itself, whatever it shows of the group's input.
    return not found.output.hide_value or (node.bl_idname not in PICTURES and _is_even(t, node, context, own))


def _is_even(t, node, context, place):
    """Whether all inputs of a texture but its coordinates are constants."""
    return all(t.socket(socket, context).is_constant for socket in node.inputs if socket.enabled and socket != place)


def coordinates(t, node, context, usual):
    """The vector input, or where nothing is linked what `usual` gives, through the node's own mapping. A mesh is asked for no more than that."""
    value = t.input(node, "Vector", context) if _is_placed(t, node, context) else usual()
    legacy = node.texture_mapping
    scale = tuple(legacy.scale)
    if legacy.vector_type == "POINT" and not any(legacy.translation) and not any(legacy.rotation) and scale == (1.0, 1.0, 1.0):
        return value
    return transform3d(t, value, mapping_matrix(legacy.vector_type, legacy.translation, legacy.rotation, scale))


@value_node("ShaderNodeTexImage")
def image_texture(t, node, context, output):
    place = coordinates(t, node, context, lambda: direction(t) if t.is_world else t.primvar(UV))
    if node.projection == "BOX":
        sides = box_projection(t, place, node.projection_blend)
        texels = [_texel(t, node, context, output, uv) * weight for uv, weight in sides]
        return texels[0] + texels[1] + texels[2]
    uv = _wrapped_around(t, place, node.projection) if node.projection in ("SPHERE", "TUBE") else place
    return _texel(t, node, context, output, uv)


def _texel(t, node, context, output, uv):
    wrap, image = WRAP[node.extension], node.image
    if output.identifier == "Alpha" and image is not None and image.alpha_mode == "NONE" and wrap == "Black":
        return clipped_alpha(t, uv, image.size, node.interpolation == "Closest")
    if t.kind == "Material" and image is not None and _is_encoded(t, image):
        is_product = _is_product(t, image) and node.outputs["Color"].is_linked
        # Where both outputs are in use, one picture serves them: light, for that is what is divided by alpha again, from afar too.
        is_divided = is_product and node.outputs["Alpha"].is_linked
        is_light = is_divided and node.interpolation != "Closest"
        product = "light" if is_light else "codes" if is_product else None
        number = t.images.of_bytes(image, node.image_user, t.report, product)
        if number is not None:
            texel = _look_up(t, node, number, uv, wrap, is_light=is_light)
            if output.identifier == "Alpha" or not is_product:
                return _with_alpha(t, node, output, texel)
            return divided(texel, is_encoded=not is_light) if is_divided else texel
    number = None if image is None else t.images.texture(image, node.image_user, t.report)
    if number is None:
        return _missing(t, node, output, uv, wrap)
    return _with_alpha(t, node, output, _look_up(t, node, number, uv, wrap))


def _missing(t, node, output, uv, wrap):
    """What is shown of no image, and of a lost one: a single texel, which can be clipped."""
    texel = t.graph.colour(MISSING)
    if node.image is not None and wrap == "Black":
        number = t.images.baked(("lost",), "Lost", np.full((1, 1, 4), MISSING, np.float32))
        texel = look_up(t, number, uv, (wrap, wrap), FILTERS[node.interpolation])
        if output.identifier != "Alpha":
            texel = divided(texel) if node.outputs["Alpha"].is_linked else texel
            # Its bytes are mixed as they are.
            return decoded(texel) if _is_srgb(node.image) else texel
    return texel.component(3) if output.identifier == "Alpha" else texel


def _sample(t, node, context, uv, wrap):
    number = None if node.image is None else t.images.texture(node.image, node.image_user, t.report)
    return t.graph.colour(MISSING) if number is None else _look_up(t, node, number, uv, wrap)


def _look_up(t, node, number, uv, wrap, is_light=False):
    filters = FILTERS_OF_CODES if _is_encoded(t, node.image) and not is_light else FILTERS
    return look_up(t, number, uv, (wrap, wrap), filters[node.interpolation], MISSING)


def look_up(t, number, uv, wrap, texture_filter="Linear", fallback=(0.0, 0.0, 0.0, 0.0)):
    """The texel of a picture of the scene."""
    fields = {"texture": number, "wrap": list(wrap), "filter": texture_filter, "fallback": list(fallback)}
    return t.graph.add({"Image": {**fields, "scale": [1.0] * 4, "bias": [0.0] * 4}}, uv, kind="RGBA")


def _is_encoded(t, image):
    """Whether an image's colours are bytes of sRGB, which Cycles decodes after it filtered them."""
    return not t.images.is_float(image) and _is_srgb(image)


def _is_srgb(image):
    space = image.colorspace_settings
    return not space.is_data and gonio_name(space.name) == "srgb_texture"


def _is_associated(t, image):
    """Cycles' rule: colours are filtered as multiplied by alpha, and divided by it again where the Alpha output is in use too; data, and
    what has no alpha, never."""
    return image.alpha_mode not in ("NONE", "CHANNEL_PACKED") and not image.colorspace_settings.is_data and t.images.has_alpha(image)


def _is_product(t, image):
    """Whether colours are still to be multiplied."""
    return _is_associated(t, image) and not t.images.stores_premultiplied(image)


def _with_alpha(t, node, output, texel):
    """A texel as an output shows it."""
    image = node.image
    if output.identifier == "Alpha":
        return t.graph.scalar(1.0) if image is None or image.alpha_mode == "NONE" else texel.component(3)
    if image is None or texel.is_constant:
        return texel
    if _is_product(t, image):
        if node.outputs["Alpha"].is_linked:
            # What hides where nothing is seen stays hidden.
            return texel * texel.component(3).sign()
        is_byte = not t.images.is_float(image) and node.interpolation == "Closest"
        return multiplied_encoded(t, texel, is_byte) if _is_srgb(image) else texel * texel.component(3)
    return divided(texel) if _is_associated(t, image) and node.outputs["Alpha"].is_linked else texel


def _wrapped_around(t, value, projection):
    """Blender's sphere and tube projections of coordinates in 0..1."""
    centred = value * 2.0 - 1.0
    x, y, z = (centred.component(i) for i in range(3))
    u = (1.0 - x.apply("ArcTangent2", y) * (1.0 / pi)) * 0.5
    if projection == "TUBE":
        return t.graph.combine(u, (z + 1.0) * 0.5, t.graph.scalar(0.0))
    return t.graph.combine(u, 1.0 - (z / centred.length()).apply("ArcCosine") * (1.0 / pi), t.graph.scalar(0.0))


@value_node("ShaderNodeTexEnvironment")
def environment_texture(t, node, context, output):
    towards = coordinates(t, node, context, lambda: direction(t) if t.is_world else hit(t, "Position"))
    if t.is_world and node.image is not None:
        return _hidden(t, node, t.environment(node, context, towards))
    uv = mirror_ball(t, towards) if node.projection == "MIRROR_BALL" else equirectangular(t, towards)
    return _hidden(t, node, _sample(t, node, context, uv, "Repeat"))


def _hidden(t, node, texel):
    """A texel of a panorama, whose alpha no output tells: its colours are multiplied by it."""
    if texel.is_constant or not _is_product(t, node.image) or not t.images.is_seen_through(node.image, t.report):
        return texel
    return multiplied_encoded(t, texel, False) if _is_srgb(node.image) else texel * texel.component(3)


def equirectangular(t, towards):
    """Texture coordinates of a direction: u falls with the longitude from +X over +Y, v rises with the latitude."""
    x, y, z = (towards.component(i) for i in range(3))
    u = y.apply("ArcTangent2", x) * (-0.5 / pi) + 0.5
    v = z.apply("ArcTangent2", (x * x + y * y).sqrt()) * (1.0 / pi) + 0.5
    return t.graph.combine(u, v, t.graph.scalar(0.0))


def mirror_ball(t, towards):
    """Texture coordinates of a direction on a ball seen along +Y."""
    moved = towards.normalized() - (0.0, 1.0, 0.0)
    ball = moved / ((moved.component(1) * -0.5).sqrt() * 2.0)
    return t.graph.combine(ball.component(0) * 0.5 + 0.5, ball.component(2) * 0.5 + 0.5, t.graph.scalar(0.0))


@value_node("ShaderNodeTexChecker")
def checker(t, node, context, output):
    place = coordinates(t, node, context, lambda: direction(t) if t.is_world else t.primvar(GENERATED)) * t.input(node, "Scale", context)
    # Blender's own nudge, which keeps faces that lie on a border in one colour.
    cell = ((place + 1e-6) * 0.999999).floor()
    odd = (cell.dot((1.0, 1.0, 1.0)) * 0.5).fraction() * 2.0
    first = 1.0 - odd.maximum(0.0).minimum(1.0)
    if output.identifier == "Fac":
        return odd
    return t.input(node, "Color2", context).mix(t.input(node, "Color1", context), 1.0 - first)


@value_node("ShaderNodeTexGradient")
def gradient(t, node, context, output):
    place = coordinates(t, node, context, lambda: direction(t) if t.is_world else t.primvar(GENERATED))
    x, y = place.component(0), place.component(1)
    inside = (1.0 - place.length()).maximum(0.0)
    ramp = x.clamp()
    kinds = {
        "LINEAR": lambda: x,
        "QUADRATIC": lambda: x.maximum(0.0) * x.maximum(0.0),
        "EASING": lambda: ramp * ramp * (3.0 - ramp * 2.0),
        "DIAGONAL": lambda: (x + y) * 0.5,
        "RADIAL": lambda: y.apply("ArcTangent2", x) * (0.5 / pi) + 0.5,
        "SPHERICAL": lambda: (0.999999 - place.length()).maximum(0.0),
        "QUADRATIC_SPHERE": lambda: inside * inside,
    }
    return kinds[node.gradient_type]().clamp()
