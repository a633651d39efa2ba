# SPDX-License-Identifier: GPL-3.0-or-later
"""Arithmetic nodes on numbers: Math, Map Range, Clamp, Float Curve."""

from math import pi

from .colour import curve
from .registry import value_node


def _round(a):
    return (a + 0.5).floor()


def _truncate(a):
    return a.sign() * abs(a).floor()


def _floored_modulo(a, b):
    """The remainder with the divisor's sign."""
    rest = a.apply("Modulo", b)
    return rest + b * (rest * b).less(0.0)


def wrap(a, high, low):
    """a brought into [low, high) by whole ranges."""
    span = high - low
    return (a - span * ((a - low) / span).floor()).mix(low, 1.0 - (span * span).apply("Sign"))


def _ping_pong(a, b):
    fraction = ((a - b) / (b * 2.0)).fraction()
    return abs(fraction * b * 2.0 - b)


def _smooth_minimum(a, b, c):
    h = (c - abs(a - b)).maximum(0.0) / c
    smooth = a.minimum(b) - h * h * h * c * (1.0 / 6.0)
    return a.minimum(b).mix(smooth, c.apply("Sign").maximum(0.0))


def _hyperbolic(a, sign):
    return (a.apply("Exponential") + (-a).apply("Exponential") * sign) * 0.5


def _hyperbolic_tangent(a):
    # e^-2|a| never overflows.
    e = (abs(a) * -2.0).apply("Exponential")
    return a.sign() * (1.0 - e) / (1.0 + e)


OPERATIONS = {
    "ADD": lambda a, b, c: a + b,
    "SUBTRACT": lambda a, b, c: a - b,
    "MULTIPLY": lambda a, b, c: a * b,
    "DIVIDE": lambda a, b, c: a / b,
    "MULTIPLY_ADD": lambda a, b, c: a * b + c,
    "POWER": lambda a, b, c: a**b,
    "LOGARITHM": lambda a, b, c: a.apply("Logarithm") / b.apply("Logarithm"),
    "SQRT": lambda a, b, c: a.sqrt(),
    "INVERSE_SQRT": lambda a, b, c: a.graph.value(1.0) / a.sqrt(),
    "ABSOLUTE": lambda a, b, c: abs(a),
    "EXPONENT": lambda a, b, c: a.apply("Exponential"),
    "MINIMUM": lambda a, b, c: a.minimum(b),
    "MAXIMUM": lambda a, b, c: a.maximum(b),
    "LESS_THAN": lambda a, b, c: a.less(b),
    "GREATER_THAN": lambda a, b, c: b.less(a),
    "SIGN": lambda a, b, c: a.sign(),
    "COMPARE": lambda a, b, c: 1.0 - c.maximum(1e-5).less(abs(a - b)),
    "SMOOTH_MIN": _smooth_minimum,
    "SMOOTH_MAX": lambda a, b, c: -_smooth_minimum(-a, -b, c),
    "ROUND": lambda a, b, c: _round(a),
    "FLOOR": lambda a, b, c: a.floor(),
    "CEIL": lambda a, b, c: -((-a).floor()),
    "TRUNC": lambda a, b, c: _truncate(a),
    "FRACT": lambda a, b, c: a.fraction(),
    "MODULO": lambda a, b, c: a.apply("Modulo", b),
    "FLOORED_MODULO": lambda a, b, c: _floored_modulo(a, b),
    "WRAP": wrap,
    "SNAP": lambda a, b, c: (a / b).floor() * b,
    "PINGPONG": lambda a, b, c: _ping_pong(a, b),
    "SINE": lambda a, b, c: a.apply("Sine"),
    "COSINE": lambda a, b, c: a.apply("Cosine"),
    "TANGENT": lambda a, b, c: a.apply("Sine") / a.apply("Cosine"),
    "ARCSINE": lambda a, b, c: a.apply("ArcSine"),
    "ARCCOSINE": lambda a, b, c: a.apply("ArcCosine"),
    "ARCTANGENT": lambda a, b, c: a.apply("ArcTangent2", 1.0),
    "ARCTAN2": lambda a, b, c: a.apply("ArcTangent2", b),
    "SINH": lambda a, b, c: _hyperbolic(a, -1.0),
    "COSH": lambda a, b, c: _hyperbolic(a, 1.0),
    "TANH": lambda a, b, c: _hyperbolic_tangent(a),
    "RADIANS": lambda a, b, c: a * (pi / 180.0),
    "DEGREES": lambda a, b, c: a * (180.0 / pi),
}


@value_node("ShaderNodeMath")
def math(t, node, context, output):
    operation = OPERATIONS.get(node.operation)
    if operation is None:
        return None
    operands = [t.input(node, name, context) for name in ("Value", "Value_001", "Value_002")]
    result = operation(*operands)
    return result.clamp() if node.use_clamp else result


@value_node("ShaderNodeClamp")
def clamp(t, node, context, output):
    value, low, high = (t.input(node, name, context) for name in ("Value", "Min", "Max"))
    if node.clamp_type == "RANGE":
        low, high = low.minimum(high), low.maximum(high)
    return value.clamp(low, high)


@value_node("ShaderNodeMapRange")
def map_range(t, node, context, output):
    is_vector = node.data_type == "FLOAT_VECTOR"
    suffix = "_FLOAT3" if is_vector else None
    names = ["From_Min", "From_Max", "To_Min", "To_Max", "Steps"]
    keys = [name + suffix for name in names] if suffix else ["From Min", "From Max", "To Min", "To Max", "Steps"]
    low, high, to_low, to_high, steps = (t.input(node, key, context) for key in keys)
    value = t.input(node, "Vector" if is_vector else "Value", context)
    share = (value - low) / (high - low)
    kind = node.interpolation_type
    if kind == "STEPPED":
        share = (share * (steps + 1.0)).floor() / steps
    elif kind in ("SMOOTHSTEP", "SMOOTHERSTEP"):
        share = share.clamp()
        squared = share * share
        if kind == "SMOOTHSTEP":
            share = squared * (3.0 - share * 2.0)
        else:
            share = squared * share * (share * (share * 6.0 - 15.0) + 10.0)
    result = to_low + share * (to_high - to_low)
    if node.clamp and kind in ("LINEAR", "STEPPED"):
        result = result.clamp(to_low.minimum(to_high), to_low.maximum(to_high))
    return result


@value_node("ShaderNodeFloatCurve")
def float_curve(t, node, context, output):
    value, factor = t.input(node, "Value", context), t.input(node, "Factor", context, 1.0)
    return value.mix(t.graph.add(curve(node.mapping, [0]), value, kind="VALUE"), factor)
