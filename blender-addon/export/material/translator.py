# SPDX-License-Identifier: GPL-3.0-or-later
"""From one Blender node tree to graph values."""

import sys
import weakref
from contextlib import contextmanager

import bpy
from gonio.graph import Graph, Value

from ...report import words_of
from ..colour_management import to_rec709
from .fallback import stand_in
from .inputs import POSITION
from .registry import VALUES
from .sockets import ABSENT, KINDS, Context, follow, input_socket

# More nodes than this in a row are not followed.
DEEPEST = 1000
# More nodes than these of one material, with those of its groups wherever they stand, are not computed.
MOST_NODES = 40_000
# The renderer's own limit of operations is 65536, and a node may take some hundred.
MOST_OPERATIONS = 60_000
# Calls that one node of a row takes.
CALLS_A_NODE = 12

# Weights of the luminance of linear Rec.709 in Cycles, as measured, before Blender 5.0 and since.
LUMINANCE = ((0.212674, 0.7151516, 0.0721754), (0.2126391, 0.7151691, 0.0721928))


@contextmanager
def _room_for_calls():
    """Python's own limit would end at some 150 nodes in a row."""
    usual = sys.getrecursionlimit()
    sys.setrecursionlimit(max(usual, DEEPEST * CALLS_A_NODE))
    try:
        yield
    finally:
        sys.setrecursionlimit(usual)


class Translator:
    """The state while one node tree is translated."""

    def __init__(
        self,
        owner,
        tree,
        images,
        report,
        *,
        kind="Material",
        measurements=None,
        is_world=False,
        is_camera_ray=True,
        version=None,
        surroundings=None,
        has_grids=False,
    ):
        # Whether it is of a volume object, whose attributes are grids.
        self.has_grids = has_grids
        self.version = tuple(version or bpy.app.version)
        self.luminance = LUMINANCE[self.version >= (5, 0, 0)]
        self.owner, self.images, self.report, self.kind, self.measurements = owner, images, report, kind, measurements
        self.is_world, self.is_camera_ray, self.asked_for_ray = is_world, is_camera_ray, False
        self.graph = Graph()
        self.root = Context(tree)
        # Weakly: in a circle with its tree it would keep the scene, with all its meshes, until Python looks for circles.
        self.root.translator = weakref.proxy(self)
        self.primvars, self.instance_primvars = set(), set()
        self.closures = []
        # How many outputs were computed, and how many ways led to shaders.
        self.computed, self.ways, self.ways_told = 0, 0, False
        self._surroundings, self.asked = surroundings, {}
        # Of a lamp's IES texture.
        self.goniogram = None
        # By which output of Light Falloff a lamp's light falls, and how smoothly.
        self.falloff = None
        self._values, self._open, self._was_full = {}, set(), False
        # Nodes that something stands in for, and that were told.
        self._stood_in = set()
        # The shading normal where displacement bends it; whether the surface has moved, and whether it is looked at as it was before.
        self.bent, self.has_moved, self._is_at_rest = None, False, False
        # While a height is taken beside the hit: along which of the two steps, and how far.
        self._step = None

    def say(self, node, context, message):
        """One report line for a node, with its path through groups."""
        self.report.add(self.kind, self.owner.name, message, **self._place(node, context))

    def tell(self, limit, node, context, subject=""):
        """The report line of an entry of the table of limits."""
        self.report.tell(limit, self.kind, self.owner.name, subject, **self._place(node, context))

    def fail(self, node, context, problem, consequence):
        """The report line of a node that could not be translated for a reason that nobody foresaw."""
        message = f"{words_of(problem)}; {consequence}"
        self.report.add(self.kind, self.owner.name, message, severity="ERROR", **self._place(node, context))

    def saw(self, node, context):
        """Counts a node for the report."""
        self.report.saw(self.kind, self.owner.name, self.path(node, context))

    def path(self, node, context):
        """A node's name behind those of the groups that it stands in."""
        return "/".join([*(group.name for group in context.groups()), node.name])

    def _place(self, node, context):
        return {"material": self.owner.name if self.kind == "Material" else None, "node": self.path(node, context)}

    def socket(self, socket, context):
        """The value that reaches an input, converted to the input's kind."""
        kind = KINDS.get(socket.type, "VALUE")
        found = follow(socket, context)
        if found is None:
            return self.default_of(None, kind)
        node, source, inner, kinds = found
        if node is None:
            value = self.default_of(source, KINDS.get(source.type, kind))
        elif node.bl_idname in ABSENT:
            self.tell("absent", node, inner, node.bl_label)
            return self.as_kind(self.default_of(socket, kind), kind)
        else:
            value = self.output(node, source, inner)
        # Since 5.0 groups are laid flat before their sockets' kinds are looked at.
        for passed in reversed(kinds) if self.version < (5, 0, 0) else ():
            value = self.as_kind(value, passed)
        return self.as_kind(value, kind)

    def as_kind(self, value, kind):
        """A value as another kind; a colour as a number is its luminance, by the weights of this Blender's Cycles."""
        if (value.kind, kind) == ("RGBA", "VALUE"):
            return value.dot(self.luminance)
        return value.as_kind(kind)

    def input(self, node, name, context, default=0.0):
        """The value of a node's input by identifier or name; the default where this Blender has no such input."""
        socket = input_socket(node, name)
        return self.graph.value(default) if socket is None else self.socket(socket, context)

    def linked(self, node, name, context):
        """Whether something feeds this input."""
        socket = input_socket(node, name)
        found = None if socket is None else follow(socket, context)
        return found is not None and found.node is not None and found.node.bl_idname not in ABSENT

    def default_of(self, socket, kind):
        """The value that an unlinked socket shows."""
        shown = getattr(socket, "default_value", None)
        if shown is None or isinstance(shown, str):
            return Value(self.graph, kind, (0.0, 0.0, 0.0, 1.0) if kind == "RGBA" else (0.0,) * 4)
        if kind == "VALUE":
            return self.graph.scalar(shown)
        components = [*shown, 0.0, 0.0][:3] if kind == "VECTOR" else to_rec709(shown)
        return self.graph.vector(components) if kind == "VECTOR" else self.graph.colour(components)

    def output(self, node, output, context):
        """The value of a node's output."""
        key = (context, node.name, output.identifier, self._step)
        if key not in self._values:
            if key in self._open:
                return self.graph.scalar(0.0)
            if len(self._open) >= DEEPEST:
                self.tell("nodes in a row", node, context)
                return self.graph.scalar(0.0)
            if self._is_full(node, context):
                return self.graph.scalar(0.0)
            self._open.add(key)
            try:
                with _room_for_calls():
                    self._values[key] = self._compute(node, output, context)
            finally:
                self._open.discard(key)
        return self._values[key]

    def _is_full(self, node, context):
        """Whether no more nodes are computed; the first one that is left out is told."""
        if self.computed <= MOST_NODES and len(self.graph.nodes) <= MOST_OPERATIONS:
            self.computed += 1
            return False
        if not self._was_full:
            self._was_full = True
            self.tell("nodes in a row", node, context, f"More than {MOST_NODES} nodes or {MOST_OPERATIONS} operations in one material")
        return True

    def _compute(self, node, output, context):
        kind = KINDS.get(output.type, "VALUE")
        self.saw(node, context)
        handler, value = VALUES.get(node.bl_idname), None
        try:
            value = None if handler is None else handler(self, node, context, output)
        except RecursionError:
            raise
        except Exception as problem:
            self._stood_in.add((context, node.name))
            self.fail(node, context, problem, "what stands in for it is used")
        if value is None:
            value = self.unsupported(node, output, context)
        return self.as_kind(value, kind)

    def unsupported(self, node, output, context):
        """The nearest sane value of a node that cannot be computed; the report has one line for a node, whichever outputs are used."""
        value, what = stand_in(self, node, output, context)
        if (context, node.name) not in self._stood_in:
            self._stood_in.add((context, node.name))
            self.say(node, context, what)
        return value

    def ask(self, key):
        """What a material asks of the scene around it; None for what is not known."""
        if self._surroundings is None:
            return None
        self.asked[key] = self._surroundings.ask(key)
        return self.asked[key]

    def stepped(self, axis, share, function):
        """What a function gives a share of a pixel beside the hit, along one of two directions in the surface."""
        outer, self._step = self._step, (axis, share)
        try:
            return function()
        finally:
            self._step = outer

    @contextmanager
    def at_rest(self):
        """Has values computed for the surface as the mesh has it, before displacement moved it."""
        self._is_at_rest, self._values = True, {}
        try:
            yield
        finally:
            self._is_at_rest, self._values = False, {}

    def bend(self, normal):
        """Has everything that is computed from now on see a bent shading normal."""
        self.bent = normal
        self._values = {}

    def primvar(self, name, fallback=(0.0, 0.0, 0.0, 0.0), kind="VECTOR"):
        """A named value of the mesh."""
        self.primvars.add(name)
        value = self.graph.add({"Primvar": {"name": name, "fallback": list(fallback)}}, kind=kind)
        if self._step is None:
            return value
        axis, share = self._step
        return value + self.graph.add({"PrimvarStep": {"name": name, "axis": axis}}, kind=kind) * share

    def position(self):
        """The hit's position in the world."""
        if self._is_at_rest:
            return self._carried_to_world(self.own_position(), "Point")
        value = self.graph.add("Position", kind="VECTOR")
        return value if self._step is None else value + self.step(self._step[0]) * self._step[1]

    def own_position(self):
        """The hit's position in its object's space."""
        if self.has_moved and not self._is_at_rest:
            return self.graph.add({"Transform": {"from": "World", "to": "Object", "quantity": "Point"}}, self.position(), kind="VECTOR")
        if not self._is_at_rest or self._step is None:
            return self.primvar(POSITION)
        # As in Cycles the place is that of the mesh, and the way beside it that of the moved surface.
        (axis, share), self._step = self._step, None
        place, way = self.primvar(POSITION), self.graph.add({"PositionStep": {"axis": axis}}, kind="VECTOR")
        if bpy.app.version < (5, 0, 0):
            # Before, it was as long as the mesh's ways are in the mean.
            way = way.normalized() * ((self.step(0).length() + self.step(1).length()) * 0.5)
        self._step = axis, share
        return place + self.graph.add({"Transform": {"from": "World", "to": "Object", "quantity": "Vector"}}, way, kind="VECTOR") * share

    def _carried_to_world(self, value, quantity):
        return self.graph.add({"Transform": {"from": "Object", "to": "World", "quantity": quantity}}, value, kind="VECTOR")

    def step(self, axis):
        """The way to the next pixel along one of two directions in the surface, in the world."""
        if self._is_at_rest:
            self.primvars.add(POSITION)
            return self._carried_to_world(self.graph.add({"PrimvarStep": {"name": POSITION, "axis": axis}}, kind="VECTOR"), "Vector")
        return self.graph.add({"PositionStep": {"axis": axis}}, kind="VECTOR")

    def instance_primvar(self, name, kind):
        """A named value of the placement."""
        self.instance_primvars.add(name)
        return self.graph.add({"Primvar": {"name": name, "fallback": [0.0] * 4}}, kind=kind)
