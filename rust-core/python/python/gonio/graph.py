"""Graphs of shading nodes under construction: constants are folded by the renderer's own kernels, equal nodes are shared."""

import json
from array import array

from ._gonio import compute

# What a host keeps in its graphs without the renderer knowing.
HOST_OPERATIONS = ("Direction", "Lookup")

# How wide a value is; arithmetic of two takes the wider.
RANK = {"VALUE": 0, "VECTOR": 1, "RGBA": 2}


class Value:
    """A constant of four components, or a channel of a node; knows its graph, so that arithmetic on it builds nodes."""

    __slots__ = ("channel", "constant", "graph", "kind", "node")

    def __init__(self, graph, kind, constant=None, node=None, channel="Rgb"):
        self.graph, self.kind, self.constant, self.node, self.channel = graph, kind, constant, node, channel

    def input(self):
        """The form of the scene description."""
        if self.node is None:
            return {"Constant": [float(x) for x in self.constant]}
        return {"Node": [self.node, self.channel]}

    @property
    def is_constant(self):
        return self.node is None

    def is_zero(self):
        """Whether it is the constant zero (alpha aside)."""
        return self.is_constant and not any(self.constant[:3])

    def equals(self, number):
        """Whether its first three components are this constant."""
        return self.is_constant and all(abs(x - number) < 1e-7 for x in self.constant[:3])

    def component(self, index):
        """One component as a scalar."""
        if self.is_constant:
            return self.graph.scalar(self.constant[index])
        channel = "RGBA"[index] if self.channel == "Rgb" else self.channel
        return Value(self.graph, "VALUE", node=self.node, channel=channel)

    def as_kind(self, kind):
        """Blender's implicit conversion: a colour becomes its luminance, a vector the mean of its components, a scalar fills all."""
        if self.kind == kind:
            return self
        if kind == "VALUE":
            if self.kind == "RGBA":
                return self.graph.add("Luminance", self, kind="VALUE")
            return self.dot((1.0 / 3.0,) * 3)
        return Value(self.graph, kind, self.constant, self.node, self.channel)

    def _with(self, operation, *others, kind=None):
        values = [self, *(self.graph.value(other) for other in others)]
        widest = max((v.kind for v in values), key=RANK.__getitem__)
        return self.graph.add(operation, *values, kind=kind or widest)

    def __add__(self, other):
        return self._with("Add", other)

    def __sub__(self, other):
        return self._with("Subtract", other)

    def __mul__(self, other):
        return self._with("Multiply", other)

    def __truediv__(self, other):
        return self._with("Divide", other)

    def __pow__(self, other):
        return self._with("Power", other)

    def __neg__(self):
        return self * -1.0

    def __abs__(self):
        return self._with("Absolute")

    def __rsub__(self, other):
        return self.graph.value(other) - self

    __radd__ = __add__
    __rmul__ = __mul__

    def mix(self, other, share):
        """This at share 0, the other at share 1."""
        share = self.graph.value(share)
        if share.equals(0.0):
            return self
        other = self.graph.value(other)
        return other.as_kind(max(self.kind, other.kind, key=RANK.__getitem__)) if share.equals(1.0) else self._with("Mix", other, share)

    def clamp(self, low=0.0, high=1.0):
        """Held between two limits."""
        return self._with("Clamp", low, high)

    def less(self, other):
        """1 where this is less, else 0."""
        return self._with("Less", other)

    def minimum(self, other):
        return self._with("Minimum", other)

    def maximum(self, other):
        return self._with("Maximum", other)

    def floor(self):
        return self._with("Floor")

    def sign(self):
        return self._with("Sign")

    def sqrt(self):
        return self._with("SquareRoot")

    def apply(self, operation, *others):
        """Any other operation, component by component."""
        return self._with(operation, *others)

    def fraction(self):
        return self - self.floor()

    def dot(self, other):
        return self._with("Dot", other, kind="VALUE")

    def cross(self, other):
        return self._with("Cross", other, kind="VECTOR")

    def normalized(self):
        return self._with("Normalize", kind="VECTOR")

    def length(self):
        return self.dot(self).sqrt()


class Graph:
    """The nodes so far, in the order in which they can be run."""

    def __init__(self):
        self.nodes = []
        self._known = {}

    def scalar(self, x):
        return Value(self, "VALUE", (float(x),) * 4)

    def vector(self, xyz):
        x, y, z = (float(c) for c in xyz)
        return Value(self, "VECTOR", (x, y, z, 0.0))

    def colour(self, rgb):
        r, g, b, *a = (float(c) for c in rgb)
        return Value(self, "RGBA", (r, g, b, a[0] if a else 1.0))

    def value(self, anything):
        """A value from a number, a sequence of three, or a value."""
        if isinstance(anything, Value):
            return anything
        return self.scalar(anything) if isinstance(anything, (int, float)) else self.vector(anything)

    def combine(self, x, y, z, kind="VECTOR", w=None):
        """One value from scalars."""
        return self.add("Combine", x, y, z, self.scalar(1.0 if kind == "RGBA" else 0.0) if w is None else w, kind=kind)

    def add(self, operation, *inputs, kind):
        """The value of an operation: folded if it can be, shared if it is known."""
        if inputs and all(value.is_constant for value in inputs):
            folded = self._fold(operation, inputs)
            if folded is not None:
                return Value(self, kind, folded)
        simple = _simplify(operation, inputs)
        if simple is not None:
            return simple.as_kind(kind) if RANK[kind] > RANK[simple.kind] else simple
        return Value(self, kind, node=self._number(operation, inputs), channel="R" if kind == "VALUE" else "Rgb")

    def node_of(self, value):
        """The number of the node that gives a value, for what takes nodes alone: a constant gets one."""
        return self._number("Combine", [value.component(i) for i in range(4)]) if value.is_constant else value.node

    def _number(self, operation, inputs):
        """The number of a node, a new one unless it is known."""
        node = {"operation": operation, "inputs": [value.input() for value in inputs]}
        key = json.dumps(node, sort_keys=True)
        number = self._known.get(key)
        if number is None:
            number = self._known[key] = len(self.nodes)
            self.nodes.append(node)
        return number

    @staticmethod
    def _fold(operation, inputs):
        # Operations of the host alone, such as the direction that a world is asked for, are not in the table.
        known = operation if isinstance(operation, str) else next(iter(operation))
        if known in HOST_OPERATIONS:
            return None
        result = compute(operation, [array("f", value.constant) for value in inputs])
        return None if result is None else tuple(memoryview(result).tolist()[0])

    def reachable(self, inputs):
        """The nodes that these inputs need, renumbered, and the renumbered inputs."""
        wanted, stack = set(), [i["Node"][0] for i in inputs if "Node" in i]
        while stack:
            number = stack.pop()
            if number not in wanted:
                wanted.add(number)
                stack += [i["Node"][0] for i in self.nodes[number]["inputs"] if "Node" in i]
        order = {old: new for new, old in enumerate(sorted(wanted))}
        kept = [{**self.nodes[old], "inputs": [renumber(i, order) for i in self.nodes[old]["inputs"]]} for old in order]
        return kept, order


def renumber(source, order):
    """An input with its node's new number."""
    return {"Node": [order[source["Node"][0]], source["Node"][1]]} if "Node" in source else source


def _simplify(operation, inputs):
    """Additions of zero and multiplications by one are left out."""
    if operation == "Multiply":
        for a, b in (inputs, inputs[::-1]):
            if b.is_constant and all(x == 1.0 for x in b.constant[:3]) and RANK[a.kind] >= RANK[b.kind]:
                return a
            if b.is_zero():
                return Value(b.graph, max(a.kind, b.kind, key=RANK.__getitem__), (0.0, 0.0, 0.0, 0.0))
    if operation in ("Add", "Subtract") and inputs[1].is_zero() and RANK[inputs[0].kind] >= RANK[inputs[1].kind]:
        return inputs[0]
    if operation == "Add" and inputs[0].is_zero() and RANK[inputs[1].kind] >= RANK[inputs[0].kind]:
        return inputs[1]
    if operation == "Divide" and inputs[1].is_constant and all(x == 1.0 for x in inputs[1].constant[:3]):
        return inputs[0]
    return None
