# SPDX-License-Identifier: GPL-3.0-or-later
"""Input nodes: constants, attributes, what is known of the object, the hit and the ray."""

from ..surroundings import LAYER, OBJECT
from .registry import value_node

# Names of values that every mesh or placement can give; the space keeps them apart from names of attributes.
UV = "st"
# The points of the mesh itself.
POSITION = "blender position"
GENERATED = "blender generated"
RANDOM = "blender random"
LOCATION = "blender location"
COLOUR = "blender colour"
INDEX = "blender index"
ACTIVE_COLOUR = "blender active colour"
POINTINESS = "blender pointiness"
ISLAND = "blender island"
# Barycentric coordinates, and the positions of a triangle's three corners.
PARAMETRIC = "blender parametric"
TRIANGLE = ("blender triangle 1", "blender triangle 2", "blender triangle 3")
# The normal in the mesh's own space as it is interpolated, not made unit; and how names of tangents along UV maps begin.
SMOOTH_NORMAL, TANGENT = "blender normal", "tangents of "
# What strands of hair know of themselves, by the outputs of the Curves Info node; and their direction and normal in the object's space.
STRAND = {
    "Is Strand": "blender is strand",
    "Intercept": "blender strand intercept",
    "Length": "blender strand length",
    "Thickness": "blender strand thickness",
    "Random": "blender strand random",
    "Tangent": "blender strand tangent",
    "Normal": "blender strand normal",
}
# What every mesh can give without an attribute.
COMPUTED = frozenset({GENERATED, POSITION, POINTINESS, ISLAND, PARAMETRIC, SMOOTH_NORMAL, *TRIANGLE})
# How names of values begin that instances are given: by particles, and where on the instancer's surface they are.
GIVEN = "given "
PARTICLE, GIVEN_GENERATED, GIVEN_UV = f"{GIVEN}by particle ", f"{GIVEN}generated", f"{GIVEN}uv"
# How names begin of an attribute as one number, and of its alpha.
FACTOR, ALPHA = "factor of ", "alpha of "
# What there is in the place of attributes that are not there.
NOTHING = (0.0, 0.0, 0.0, 0.0)


@value_node("ShaderNodeValue", "ShaderNodeRGB")
def constant(t, node, context, output):
    return t.default_of(output, "VALUE" if output.type == "VALUE" else "RGBA")


@value_node("ShaderNodeUVMap")
def uv_map(t, node, context, output):
    if node.from_instancer:
        return given(t, GIVEN_UV)
    return t.primvar(node.uv_map or UV)


def given(t, name):
    """A vector that the instancer gives its instance; zero for what is none."""
    return t.instance_primvar(name, "VECTOR") if t.kind == "Material" else t.graph.vector((0.0, 0.0, 0.0))


@value_node("ShaderNodeTexCoord")
def texture_coordinates(t, node, context, output):
    name = output.identifier
    if t.is_world:
        return _world_coordinates(t, node, name)
    if name == "UV":
        return given(t, GIVEN_UV) if node.from_instancer else t.primvar(UV)
    if name == "Generated":
        return given(t, GIVEN_GENERATED) if node.from_instancer else t.primvar(GENERATED)
    if name == "Object":
        if node.object is None:
            return t.own_position()
        rows = t.ask(f"{OBJECT}{node.object.original.session_uid}") or node.object.matrix_world.inverted_safe()
        return applied(t, rows, hit(t, "Position"))
    if name == "Normal":
        return carried(t, hit(t, "Normal"), "World", "Object", "Normal")
    if name == "Reflection":
        seen_straight(t, node, context)
        normal, incoming = hit(t, "Normal"), hit(t, "Incoming")
        return normal * (normal.dot(incoming) * 2.0) - incoming
    from .camera_nodes import in_camera, in_picture

    return in_camera(t) if name == "Camera" else in_picture(t)


def seen_straight(t, node, context):
    """Tells that lamps with a surface have nobody who sees them aslant."""
    if t.kind == "Light" and t.owner.type == "AREA":
        t.tell("aslant", node, context)


def _world_coordinates(t, node, name):
    if name == "Object" and node.object is not None:
        return applied(t, node.object.matrix_world.inverted_safe(), direction(t), is_point=False)
    if name in ("Generated", "Object"):
        return direction(t)
    if name in ("Normal", "Reflection"):
        # What surrounds a scene faces it.
        return -direction(t)
    if name == "UV":
        return t.graph.vector((0.0, 0.0, 0.0))
    from .camera_nodes import in_camera, in_picture

    return in_camera(t) if name == "Camera" else in_picture(t)


def applied(t, matrix, value, is_point=True):
    """The first three rows of a matrix applied to a point or a direction."""
    rows = [[*row[:3], row[3] if is_point else 0.0] for row in matrix[:3]]
    return t.graph.add({"Transform3d": {"rows": rows}}, value, kind="VECTOR")


def carried(t, value, start, end, quantity):
    """A value carried from one space to another, "World" and "Object"."""
    return t.graph.add({"Transform": {"from": start, "to": end, "quantity": quantity}}, value, kind="VECTOR")


def direction(t):
    """The direction that a world is asked for."""
    return t.graph.add("Direction", kind="VECTOR")


def hit(t, what):
    """Position, Normal, GeometricNormal, Incoming (to where the ray came from) or FrontFacing of the hit."""
    if t.is_world:
        return t.graph.scalar(1.0) if what == "FrontFacing" else _world_geometry(t, what)
    if what == "Position":
        return t.position()
    if what == "Normal" and t.bent is not None:
        return t.bent
    return t.graph.add(what, kind="VALUE" if what == "FrontFacing" else "VECTOR")


def normal_of(t, node, context, name="Normal"):
    """A node's normal input, the hit's shading normal if nothing is linked."""
    return t.input(node, name, context) if t.linked(node, name, context) else hit(t, "Normal")


@value_node("ShaderNodeNewGeometry")
def geometry(t, node, context, output):
    name = output.identifier
    if t.is_world:
        if name == "Tangent":
            t.tell("lamp's tangent", node, context)
        return _world_geometry(t, name)
    simple = {"Position": "Position", "Normal": "Normal", "True Normal": "GeometricNormal", "Incoming": "Incoming"}
    if name == "Incoming":
        seen_straight(t, node, context)
    if name in simple:
        return hit(t, simple[name])
    if name == "Backfacing":
        return 1.0 - hit(t, "FrontFacing")
    if name == "Tangent":
        if t.kind == "Light":
            t.tell("lamp's tangent", node, context)
        from .tangent_nodes import radial_tangent

        return radial_tangent(t)
    computed = {"Pointiness": POINTINESS, "Random Per Island": ISLAND, "Parametric": PARAMETRIC}.get(name)
    if computed is None:
        return None
    if t.kind != "Material":
        # What lamps have of coordinates are those of their own surface or sphere.
        return t.primvar(UV) if name == "Parametric" else t.graph.scalar(0.0)
    return t.primvar(computed, kind="VECTOR" if name == "Parametric" else "VALUE")


def _world_geometry(t, name):
    """As if the sky were a point that looks back; it is of no mesh."""
    if name == "Position":
        return direction(t)
    if name in ("Incoming", "Normal", "True Normal", "GeometricNormal"):
        return -direction(t)
    return t.graph.vector((1.0, 0.0, 0.0)) if name == "Parametric" else t.graph.scalar(0.0)


@value_node("ShaderNodeVertexColor")
def colour_attribute(t, node, context, output):
    value = t.primvar(node.layer_name or ACTIVE_COLOUR, kind="RGBA")
    return value.component(3) if output.identifier == "Alpha" else value


@value_node("ShaderNodeAttribute")
def attribute(t, node, context, output):
    kind, name = node.attribute_type, node.attribute_name
    if t.kind == "Light" and kind != "GEOMETRY":
        t.tell("lamp's attribute", node, context)
    if kind == "VIEW_LAYER":
        return part_of(t.graph.colour(t.ask(LAYER + name) or NOTHING), output)
    if kind == "GEOMETRY":
        return _of_mesh(t, name, output)
    return part_of(t.instance_primvar(f"{kind.lower()} {name}", "RGBA"), output)


def _of_mesh(t, name, output):
    """An attribute of the mesh; how many numbers it has decides about its number and its alpha."""
    is_there = bool(name) and t.kind == "Material"
    if output.identifier == "Alpha":
        return t.primvar(ALPHA + name, (1.0,) * 4, kind="VALUE") if is_there else t.graph.scalar(1.0)
    if not is_there:
        return t.graph.colour(NOTHING)
    return t.primvar(FACTOR + name, kind="VALUE") if output.identifier == "Fac" else t.primvar(name, kind="RGBA")


def part_of(value, output):
    """What an output of the Attribute node takes of a colour; its number is the mean of its components."""
    if output.identifier == "Alpha":
        return value.component(3)
    return value.dot((1.0 / 3.0,) * 3) if output.identifier == "Fac" else value


@value_node("ShaderNodeFresnel")
def fresnel(t, node, context, output):
    seen_straight(t, node, context)
    ior = t.input(node, "IOR", context, 1.5).maximum(1e-5)
    eta = (t.graph.value(1.0) / ior).mix(ior, hit(t, "FrontFacing"))
    return cosine(t, node, context).apply("Fresnel", eta)


def cosine(t, node, context):
    """Between a node's normal and the direction to where the ray came from."""
    return normal_of(t, node, context).dot(hit(t, "Incoming"))


@value_node("ShaderNodeLayerWeight")
def layer_weight(t, node, context, output):
    seen_straight(t, node, context)
    blend = t.input(node, "Blend", context, 0.5)
    if output.identifier == "Fresnel":
        eta = (1.0 - blend).maximum(1e-5)
        eta = eta.mix(t.graph.value(1.0) / eta, hit(t, "FrontFacing"))
        return cosine(t, node, context).apply("Fresnel", eta)
    facing = abs(cosine(t, node, context))
    blend = blend.clamp(0.0, 1.0 - 1e-5)
    exponent = (t.graph.value(0.5) / (1.0 - blend)).mix(blend * 2.0, blend.less(0.5))
    return 1.0 - facing**exponent
