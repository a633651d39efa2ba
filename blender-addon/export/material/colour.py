# SPDX-License-Identifier: GPL-3.0-or-later
"""Colour nodes: Mix with its blend modes, ramps, curves (of vectors too), hue, brightness, separate and combine, blackbody."""

from ..colour_management import to_rec709
from .registry import value_node

# Rows of the tables of ramps and curves, as Cycles has them.
TABLE_SIZE = 257
# The least range of a curve.
NARROWEST = 1e-6


def _dodge(a, b, t):
    below = 1.0 - t * b
    result = (a / below).minimum(1.0).mix(1.0, below.less(1e-30))
    return result.mix(0.0, 1.0 - (a * a).sign())


def _burn(a, b, t):
    below = 1.0 - t + t * b
    return (1.0 - (1.0 - a) / below).clamp().mix(0.0, below.less(1e-30))


def _overlay(a, b, t):
    dark = a * (1.0 - t + t * b * 2.0)
    light = 1.0 - (1.0 - t + t * (1.0 - b) * 2.0) * (1.0 - a)
    return light.mix(dark, a.less(0.5))


def _soft_light(a, b, t):
    screen = 1.0 - (1.0 - b) * (1.0 - a)
    return a.mix((1.0 - a) * b * a + a * screen, t)


def _hue(a, b, t, keep_saturation):
    first, second = _hsv(a), _hsv(b)
    saturation = first.component(1) if keep_saturation else second.component(1)
    made = _rgb(a.graph, second.component(0), saturation, first.component(2))
    return a.mix(made, t * abs(second.component(1).sign()))


def _saturation(a, b, t):
    first, second = _hsv(a), _hsv(b)
    mixed = first.component(1).mix(second.component(1), t)
    return a.mix(_rgb(a.graph, first.component(0), mixed, first.component(2)), abs(first.component(1).sign()))


def _value(a, b, t):
    first, second = _hsv(a), _hsv(b)
    return _rgb(a.graph, first.component(0), first.component(1), first.component(2).mix(second.component(2), t))


def _hsv(colour):
    return colour.graph.add("RgbToHsv", colour, kind="RGBA")


def _rgb(graph, hue, saturation, value):
    return graph.add("HsvToRgb", graph.combine(hue, saturation, value, "RGBA"), kind="RGBA")


BLENDS = {
    "MIX": lambda a, b, t: a.mix(b, t),
    "ADD": lambda a, b, t: a + b * t,
    "SUBTRACT": lambda a, b, t: a - b * t,
    "MULTIPLY": lambda a, b, t: a.mix(a * b, t),
    "DIVIDE": lambda a, b, t: a.mix(a / b, t * (b * b).sign()),
    "DIFFERENCE": lambda a, b, t: a.mix(abs(a - b), t),
    "EXCLUSION": lambda a, b, t: a.mix(a + b - a * b * 2.0, t).maximum(0.0),
    "DARKEN": lambda a, b, t: a.mix(a.minimum(b), t),
    "LIGHTEN": lambda a, b, t: a.mix(a.maximum(b), t),
    "SCREEN": lambda a, b, t: 1.0 - (1.0 - t + t * (1.0 - b)) * (1.0 - a),
    "OVERLAY": _overlay,
    "DODGE": _dodge,
    "BURN": _burn,
    "SOFT_LIGHT": _soft_light,
    "LINEAR_LIGHT": lambda a, b, t: a + t * (b * 2.0 - 1.0),
    "HUE": lambda a, b, t: _hue(a, b, t, keep_saturation=True),
    "COLOR": lambda a, b, t: _hue(a, b, t, keep_saturation=False),
    "SATURATION": _saturation,
    "VALUE": _value,
}


@value_node("ShaderNodeMix")
def mix(t, node, context, output):
    kind = {"FLOAT": "Float", "VECTOR": "Vector", "RGBA": "Color"}.get(node.data_type)
    if kind is None:
        return None
    is_uniform = kind != "Vector" or node.factor_mode == "UNIFORM"
    share = t.input(node, "Factor_Float" if is_uniform else "Factor_Vector", context, 0.5)
    if node.clamp_factor:
        share = share.clamp()
    a, b = t.input(node, f"A_{kind}", context), t.input(node, f"B_{kind}", context)
    if kind != "Color":
        return a.mix(b, share)
    result = BLENDS[node.blend_type](a, b, share)
    return result.clamp() if node.clamp_result else result


@value_node("ShaderNodeMixRGB")
def mix_rgb(t, node, context, output):
    share = t.input(node, "Fac", context, 0.5).clamp()
    result = BLENDS[node.blend_type](t.input(node, "Color1", context), t.input(node, "Color2", context), share)
    return result.clamp() if node.use_clamp else result


@value_node("ShaderNodeValToRGB")
def colour_ramp(t, node, context, output):
    ramp = node.color_ramp
    table = [list(to_rec709(ramp.evaluate(i / (TABLE_SIZE - 1)))) for i in range(TABLE_SIZE)]
    fields = {"table": table, "range": [0.0, 1.0], "linear": ramp.interpolation != "CONSTANT", "extrapolate": False}
    value = t.graph.add({"Curve": fields}, t.input(node, "Fac", context, 0.5), kind="RGBA")
    return value.component(3) if output.identifier == "Alpha" else value


def curve(mapping, numbers):
    """The Curve operation of a curve mapping, over the range its points span; three curves are the colours under a common fourth."""
    mapping.update()
    used = mapping.curves if len(numbers) > 1 else [mapping.curves[numbers[0]]]
    low, high = min(one.points[0].location[0] for one in used), max(one.points[-1].location[0] for one in used)
    high = max(high, low + NARROWEST)
    table = []
    for i in range(TABLE_SIZE):
        x = low + (high - low) * i / (TABLE_SIZE - 1)
        common = mapping.evaluate(mapping.curves[3], x) if len(mapping.curves) > 3 and len(numbers) > 1 else x
        row = [mapping.evaluate(mapping.curves[n], common) for n in numbers]
        table.append([*row, *[row[-1]] * (4 - len(row))])
    return {"Curve": {"table": table, "range": [low, high], "linear": True, "extrapolate": mapping.extend == "EXTRAPOLATED"}}


@value_node("ShaderNodeRGBCurve")
def rgb_curves(t, node, context, output):
    colour, factor = t.input(node, "Color", context), t.input(node, "Fac", context, 1.0)
    return colour.mix(t.graph.add(curve(node.mapping, [0, 1, 2]), colour, kind="RGBA"), factor)


@value_node("ShaderNodeVectorCurve")
def vector_curves(t, node, context, output):
    vector, factor = t.input(node, "Vector", context), t.input(node, "Fac", context, 1.0)
    return vector.mix(t.graph.add(curve(node.mapping, [0, 1, 2]), vector, kind="VECTOR"), factor)


@value_node("ShaderNodeInvert")
def invert(t, node, context, output):
    colour = t.input(node, "Color", context)
    return colour.mix(1.0 - colour, t.input(node, "Fac", context, 1.0))


@value_node("ShaderNodeGamma")
def gamma(t, node, context, output):
    colour = t.input(node, "Color", context)
    # Negative components stay as they are.
    return colour.maximum(0.0) ** t.input(node, "Gamma", context, 1.0) + colour.minimum(0.0)


@value_node("ShaderNodeBrightContrast")
def brightness_contrast(t, node, context, output):
    contrast = t.input(node, "Contrast", context)
    colour = t.input(node, "Color", context)
    return (colour * (contrast + 1.0) + (t.input(node, "Bright", context) - contrast * 0.5)).maximum(0.0)


@value_node("ShaderNodeHueSaturation")
def hue_saturation(t, node, context, output):
    colour = t.input(node, "Color", context)
    hsv = _hsv(colour)
    hue = (hsv.component(0) + t.input(node, "Hue", context, 0.5) + 0.5).fraction()
    saturation = (hsv.component(1) * t.input(node, "Saturation", context, 1.0)).clamp()
    value = hsv.component(2) * t.input(node, "Value", context, 1.0)
    return colour.mix(_rgb(t.graph, hue, saturation, value), t.input(node, "Fac", context, 1.0)).maximum(0.0)


@value_node("ShaderNodeRGBToBW")
def grey(t, node, context, output):
    return t.as_kind(t.input(node, "Color", context), "VALUE")


@value_node("ShaderNodeSeparateColor", "ShaderNodeSeparateRGB", "ShaderNodeSeparateHSV")
def separate(t, node, context, output):
    colour = t.input(node, "Color" if node.bl_idname != "ShaderNodeSeparateRGB" else "Image", context)
    mode = {"ShaderNodeSeparateRGB": "RGB", "ShaderNodeSeparateHSV": "HSV"}.get(node.bl_idname) or node.mode
    if mode != "RGB":
        colour = _hsv(colour)
    if mode == "HSL":
        saturation, lightness = _hsl(colour.component(1), colour.component(2))
        return (colour.component(0), saturation, lightness)[list(node.outputs).index(output)]
    return colour.component(list(node.outputs).index(output))


@value_node("ShaderNodeCombineColor", "ShaderNodeCombineRGB", "ShaderNodeCombineHSV")
def combine(t, node, context, output):
    parts = [t.socket(socket, context) for socket in list(node.inputs)[:3]]
    mode = {"ShaderNodeCombineRGB": "RGB", "ShaderNodeCombineHSV": "HSV"}.get(node.bl_idname) or node.mode
    if mode == "HSL":
        hue, saturation, lightness = parts
        value = lightness + saturation * lightness.minimum(1.0 - lightness)
        return _rgb(t.graph, hue, (1.0 - lightness / value) * 2.0 * value.sign(), value)
    return _rgb(t.graph, *parts) if mode == "HSV" else t.graph.combine(*parts, "RGBA")


def _hsl(saturation, value):
    """Saturation and lightness of HSL from HSV's saturation and value; lightness is 1 at most."""
    spread = value * saturation
    both = value * 2.0 - spread
    lightness = (both * 0.5).minimum(1.0)
    return spread / both.mix(2.0 - both, (0.5 - lightness).less(0.0)), lightness


@value_node("ShaderNodeSeparateXYZ")
def separate_xyz(t, node, context, output):
    return t.input(node, "Vector", context).component("XYZ".index(output.identifier))


@value_node("ShaderNodeCombineXYZ")
def combine_xyz(t, node, context, output):
    return t.graph.combine(*(t.input(node, name, context) for name in "XYZ"))


@value_node("ShaderNodeBlackbody")
def blackbody(t, node, context, output):
    return t.graph.add("Blackbody", t.input(node, "Temperature", context, 6500.0), kind="RGBA")
