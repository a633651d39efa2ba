# SPDX-License-Identifier: GPL-3.0-or-later
"""Vector nodes: Mapping, Vector Math, Vector Rotate, Normal, Vector Transform."""

from mathutils import Euler, Matrix, Vector

from .camera_nodes import eye
from .inputs import applied, carried
from .maths import wrap
from .registry import value_node


def transform3d(t, value, matrix):
    """A 4×4 matrix applied to a point; nothing if it is the identity."""
    if all(abs(matrix[i][j] - (1.0 if i == j else 0.0)) < 1e-9 for i in range(3) for j in range(4)):
        return value
    return applied(t, matrix, value)


def mapping_matrix(kind, location, rotation, scale):
    """The matrix of a Mapping node; None if it is not linear (a scale of zero stays zero, as Blender divides)."""
    turn = Euler(rotation, "XYZ").to_matrix().to_4x4()
    if kind == "POINT":
        return Matrix.Translation(location) @ turn @ Matrix.Diagonal((*scale, 1.0))
    inverse = Matrix.Diagonal((*(1.0 / s if s else 0.0 for s in scale), 1.0))
    if kind == "TEXTURE":
        return inverse @ turn.transposed() @ Matrix.Translation(-Vector(location))
    return turn @ (inverse if kind == "NORMAL" else Matrix.Diagonal((*scale, 1.0)))


@value_node("ShaderNodeMapping")
def mapping(t, node, context, output):
    value = t.input(node, "Vector", context)
    location, rotation, scale = (t.input(node, name, context) for name in ("Location", "Rotation", "Scale"))
    kind = node.vector_type
    if location.is_constant and rotation.is_constant and scale.is_constant:
        matrix = mapping_matrix(kind, location.constant[:3], rotation.constant[:3], scale.constant[:3])
        moved = transform3d(t, value, matrix)
    else:
        moved = _varying_mapping(t, kind, value, location, rotation, scale)
    return moved.normalized() if kind == "NORMAL" else moved


def _varying_mapping(t, kind, value, location, rotation, scale):
    if kind == "TEXTURE":
        return euler_rotated(t, value - location, rotation, inverse=True) / scale
    turned = euler_rotated(t, value / scale if kind == "NORMAL" else value * scale, rotation)
    return turned + location if kind == "POINT" else turned


def euler_rotated(t, value, rotation, inverse=False):
    """A vector turned by XYZ angles that may vary."""
    angles = [rotation.component(i) for i in range(3)]
    for axis in (2, 1, 0) if inverse else (0, 1, 2):
        angle = -angles[axis] if inverse else angles[axis]
        sine, cosine = angle.apply("Sine"), angle.apply("Cosine")
        parts = [value.component(i) for i in range(3)]
        a, b = (axis + 1) % 3, (axis + 2) % 3
        parts[a], parts[b] = parts[a] * cosine - parts[b] * sine, parts[a] * sine + parts[b] * cosine
        value = t.graph.combine(*parts)
    return value


def _refract(a, b, ior):
    b = b.normalized()
    cosine = a.dot(b)
    k = 1.0 - ior * ior * (1.0 - cosine * cosine)
    return (a * ior - b * (ior * cosine + k.sqrt())) * (1.0 - k.less(0.0))


def _reflect(a, b):
    b = b.normalized()
    return a - b * (a.dot(b) * 2.0)


OPERATIONS = {
    "ADD": lambda a, b, c, s: a + b,
    "SUBTRACT": lambda a, b, c, s: a - b,
    "MULTIPLY": lambda a, b, c, s: a * b,
    "DIVIDE": lambda a, b, c, s: a / b,
    "MULTIPLY_ADD": lambda a, b, c, s: a * b + c,
    "CROSS_PRODUCT": lambda a, b, c, s: a.cross(b),
    "PROJECT": lambda a, b, c, s: b * (a.dot(b) / b.dot(b)),
    "REFLECT": lambda a, b, c, s: _reflect(a, b),
    "REFRACT": lambda a, b, c, s: _refract(a, b, s),
    "FACEFORWARD": lambda a, b, c, s: a * (c.dot(b).less(0.0) * 2.0 - 1.0),
    "DOT_PRODUCT": lambda a, b, c, s: a.dot(b),
    "DISTANCE": lambda a, b, c, s: (a - b).length(),
    "LENGTH": lambda a, b, c, s: a.length(),
    "SCALE": lambda a, b, c, s: a * s,
    "NORMALIZE": lambda a, b, c, s: a.normalized(),
    "ABSOLUTE": lambda a, b, c, s: abs(a),
    "POWER": lambda a, b, c, s: a**b,
    "SIGN": lambda a, b, c, s: a.sign(),
    "MINIMUM": lambda a, b, c, s: a.minimum(b),
    "MAXIMUM": lambda a, b, c, s: a.maximum(b),
    "FLOOR": lambda a, b, c, s: a.floor(),
    "CEIL": lambda a, b, c, s: -((-a).floor()),
    "FRACTION": lambda a, b, c, s: a.fraction(),
    "MODULO": lambda a, b, c, s: a.apply("Modulo", b),
    "WRAP": lambda a, b, c, s: wrap(a, b, c),
    "SNAP": lambda a, b, c, s: (a / b).floor() * b,
    "SINE": lambda a, b, c, s: a.apply("Sine"),
    "COSINE": lambda a, b, c, s: a.apply("Cosine"),
    "TANGENT": lambda a, b, c, s: a.apply("Sine") / a.apply("Cosine"),
}


@value_node("ShaderNodeVectorMath")
def vector_math(t, node, context, output):
    operation = OPERATIONS.get(node.operation)
    if operation is None:
        return None
    operands = [t.input(node, name, context) for name in ("Vector", "Vector_001", "Vector_002", "Scale")]
    return operation(*operands)


@value_node("ShaderNodeVectorRotate")
def vector_rotate(t, node, context, output):
    value, centre = t.input(node, "Vector", context), t.input(node, "Center", context)
    offset, sign = value - centre, -1.0 if node.invert else 1.0
    if node.rotation_type == "EULER_XYZ":
        return euler_rotated(t, offset, t.input(node, "Rotation", context), inverse=node.invert) + centre
    axes = {"X_AXIS": (1, 0, 0), "Y_AXIS": (0, 1, 0), "Z_AXIS": (0, 0, 1)}
    axis = axes.get(node.rotation_type)
    axis = t.graph.vector(axis) if axis else t.input(node, "Axis", context).normalized()
    angle = t.input(node, "Angle", context) * sign
    # Rodrigues' rotation.
    sine, cosine = angle.apply("Sine"), angle.apply("Cosine")
    return offset * cosine + axis.cross(offset) * sine + axis * (axis.dot(offset) * (1.0 - cosine)) + centre


@value_node("ShaderNodeNormal")
def normal(t, node, context, output):
    shown = node.outputs["Normal"].default_value
    fixed = t.graph.vector(shown).normalized()
    return t.input(node, "Normal", context).normalized().dot(fixed) if output.identifier == "Dot" else fixed


@value_node("ShaderNodeVectorTransform")
def vector_transform(t, node, context, output):
    value, kind = t.input(node, "Vector", context), node.vector_type
    start, end = node.convert_from, node.convert_to
    if start == end:
        return value
    if t.is_world:
        # Nothing has a space of its own there, and normals that meet one stay as they are.
        start, end = ("WORLD" if space == "OBJECT" else space for space in (start, end))
    if "CAMERA" in (start, end):
        seen_by = eye(t)
        if seen_by is None:
            return None
        if start == "CAMERA":
            value, start = applied(t, seen_by.to_world(), value, kind == "POINT"), "WORLD"
        elif start == "OBJECT":
            value, start = _between(t, value, "OBJECT", "WORLD", kind), "WORLD"
        if end == "CAMERA":
            value = applied(t, seen_by.space, value, kind == "POINT")
            return value.normalized() if kind == "NORMAL" else value
    return value if start == end else _between(t, value, start, end, kind)


def _between(t, value, start, end, kind):
    """A value carried between the spaces of the world and of the object."""
    return carried(t, value, start.capitalize(), end.capitalize(), kind.capitalize())
