"""What makes a node of the catalogue what fields alone cannot: ramps, curves, images. For Blender."""

import bpy
import numpy
from .build import bundle, closure, frame, group, menu, reroute, repeat  # noqa: F401 (found by name)


def ramp(made, node) -> None:
    """Five stops of uneven distances."""
    stops = node.color_ramp.elements
    stops[0].position, stops[0].color = 0.1, (0.8, 0.1, 0.05, 1.0)
    stops[1].position, stops[1].color = 0.9, (0.2, 0.7, 1.0, 0.3)
    for position, colour in ((0.33, (0.1, 0.9, 0.4, 0.7)), (0.37, (1.0, 1.0, 0.2, 0.9)), (0.7, (0.0, 0.05, 0.6, 0.0))):
        stops.new(position).color = colour


def curves(made, node) -> None:
    """Each curve bent otherwise."""
    for number, curve in enumerate(node.mapping.curves):
        curve.points.new(0.3, 0.15 + 0.15 * number)
        curve.points.new(0.75, 0.9 - 0.1 * number)
    node.mapping.update()


def curves_beyond(made, node) -> None:
    """Curves that go on beyond their ends."""
    node.mapping.extend = "EXTRAPOLATED"
    curves(made, node)


def picture(made, node) -> None:
    """A small float image."""
    node.image = _picture("picture", is_float=True)


def byte_picture(made, node) -> None:
    """A small image of bytes in sRGB, with alpha."""
    node.image = _picture("byte picture", is_float=False)


def opaque_picture(made, node) -> None:
    """A small image of bytes in sRGB."""
    node.image = _picture("opaque picture", is_float=False, is_opaque=True)


def distribution(made, node) -> None:
    """A luminaire's file that is brighter on one side."""
    file = bpy.data.texts.get("distribution.ies") or bpy.data.texts.new("distribution.ies")
    candela = "\n".join(" ".join(str(100 + 7 * v * v % 60 + 3 * h % 12) for v in range(0, 10)) for h in range(0, 5))
    angles = " ".join(str(20 * v) for v in range(10)) + "\n" + " ".join(str(90 * h) for h in range(5))
    file.from_string(f"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 10 5 1 2 0 0 0\n1 1 10\n{angles}\n{candela}\n")
    node.ies = file


def _picture(name: str, *, is_float: bool, is_opaque: bool = False) -> bpy.types.Image:
    found = bpy.data.images.get(name)
    if found is not None:
        return found
    made = bpy.data.images.new(name, 16, 8, alpha=not (is_float or is_opaque), float_buffer=is_float, is_data=is_float)
    made.use_half_precision = False
    values = numpy.random.default_rng(5).uniform(0.0, 1.0, (8, 16, 4)).astype("f4")
    if is_float or is_opaque:
        values[..., 3] = 1.0
    made.pixels.foreach_set(values.ravel())
    if not is_float:
        made.pack()
    return made


def normal_value(made, node) -> None:
    """The direction that a Normal node holds."""
    node.outputs["Normal"].default_value = (0.48, 0.6, 0.64)


def value_value(made, node) -> None:
    """The number that a Value node holds."""
    node.outputs[0].default_value = 0.37


def colour_value(made, node) -> None:
    """The colour that a Color node holds."""
    node.outputs[0].default_value = (0.2, 0.55, 0.9, 1.0)


def waves(made, node) -> None:
    """A height, or the components of a way, that goes in waves over the object."""
    place = made.source("hit.TexCoord.Object")
    _waves(made, node, place, (7.0, 5.0, 6.0))


def waves_on_map(made, node) -> None:
    """The same over the texture coordinates."""
    _waves(made, node, made.source("hit.TexCoord.UV"), (25.0, 15.0, 0.0))


def _waves(made, node, place, often) -> None:
    scaled = made.new("ShaderNodeVectorMath", operation="MULTIPLY")
    made.link(place, scaled.inputs[0])
    scaled.inputs[1].default_value = often
    bent = made.new("ShaderNodeVectorMath", operation="SINE")
    made.link(scaled.outputs[0], bent.inputs[0])
    end = next(each for each in node.inputs if each.name in ("Height", "Vector"))
    made.link(bent.outputs[0], end)


def portal(made, node) -> None:
    """Rays go on high above the hit, along its normal."""
    _moved(made, node, (0.0, 0.0, 50.0), "hit.NewGeometry.Normal")


def portal_beside(made, node) -> None:
    """Rays look at the ball on the left from above."""
    down = made.new("ShaderNodeCombineXYZ")
    down.inputs["Z"].default_value = -1.0
    _moved(made, node, (-2.0, 0.0, 2.0), down.outputs[0])


def _moved(made, node, way, direction) -> None:
    place = made.new("ShaderNodeVectorMath")
    made.link(made.source("hit.NewGeometry.Position"), place.inputs[0])
    place.inputs[1].default_value = way
    made.link(place.outputs[0], node.inputs["Position"])
    made.link(made.source(direction) if isinstance(direction, str) else direction, node.inputs["Direction"])


def other_object(made, node) -> None:
    """An empty somewhere else, turned and stretched."""
    found = bpy.data.objects.get("Other")
    if found is None:
        found = bpy.data.objects.new("Other", None)
        found.location, found.rotation_euler, found.scale = (0.7, -0.4, 0.2), (0.3, 0.8, -0.5), (1.2, 0.8, 2.0)
        bpy.context.scene.collection.objects.link(found)
        bpy.context.view_layer.update()
    node.object = found


def two_shaders(made, node) -> None:
    """Two shaders to mix or to add."""
    ends = [each for each in node.inputs if each.type == "SHADER"]
    for end, kind, colour in zip(ends, ("Diffuse", "Anisotropic"), ((0.8, 0.2, 0.1, 1.0), (0.1, 0.3, 0.2, 1.0)), strict=True):
        shader = made.new(f"ShaderNodeBsdf{kind}")
        shader.inputs["Color"].default_value = colour
        made.link(shader.outputs[0], end)
