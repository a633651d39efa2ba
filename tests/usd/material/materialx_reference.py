"""MaterialX's nodes in double precision, from the standard library's own definitions: its graphs are walked, numpy computes what remains.

Values are arrays of rows, one a place, with as many columns as the type has components.
"""

import pathlib
from xml.etree import ElementTree

import numpy as np

COMPONENTS = {
    "float": 1,
    "integer": 1,
    "boolean": 1,
    "vector2": 2,
    "color3": 3,
    "vector3": 3,
    "color4": 4,
    "vector4": 4,
    "matrix33": 9,
    "matrix44": 16,
}
TINY = 1e-8


class Library:
    """Definitions and graphs in the documents of a folder."""

    def __init__(self, folder):
        self.definitions, self.graphs, self.categories = {}, {}, {}
        roots = [ElementTree.parse(path).getroot() for path in sorted(pathlib.Path(folder).rglob("*.mtlx"))]
        for element in (element for root in roots for element in root):
            if element.tag == "nodedef":
                self.definitions[element.get("name")] = element
                self.categories.setdefault(element.get("node"), []).append(element)
            elif element.tag == "nodegraph" and element.get("nodedef"):
                self.graphs[element.get("nodedef")] = element

    def definition(self, node):
        """The definition that a node in a graph follows."""
        if node.get("nodedef"):
            return self.definitions[node.get("nodedef")]
        given = {each.get("name"): each.get("type") for each in node.findall("input")}
        fitting = []
        for candidate in self.categories[node.tag]:
            known = {each.get("name"): each.get("type") for each in candidate.findall("input")}
            kinds = {each.get("type") for each in candidate.findall("output")}
            if node.get("type") in kinds or node.get("type") == "multioutput":
                fitting.append((all(known.get(name) == kind for name, kind in given.items()), candidate))
        return max(fitting, key=lambda pair: pair[0])[1]


def numbers(text, kind):
    """The value of a text, as one row."""
    if kind == "boolean":
        return np.array([[float(text == "true")]])
    return np.array([[float(part) for part in text.replace(",", " ").split()]])


class Evaluator:
    """Values of nodes at places whose geometric properties are given."""

    def __init__(self, library, geometric):
        self.library, self.geometric = library, geometric

    def value(self, definition, given, output="out"):
        """An output of a definition's node; `given` has what its inputs are set to."""
        inputs = {}
        for each in definition.findall("input"):
            name, kind = each.get("name"), each.get("type")
            if name in given:
                inputs[name] = given[name]
            elif each.get("defaultgeomprop"):
                inputs[name] = self.geometric[each.get("defaultgeomprop")]
            elif each.get("value") is not None:
                inputs[name] = numbers(each.get("value"), kind) if kind in COMPONENTS else each.get("value")
            elif kind in COMPONENTS:
                inputs[name] = np.zeros((1, COMPONENTS[kind]))
            else:
                inputs[name] = ""
        graph = self.library.graphs.get(definition.get("name"))
        if graph is not None:
            return self.of_graph(graph, inputs, output)
        kind = next(each.get("type") for each in definition.findall("output") if each.get("name") == output)
        category = definition.get("node")
        if category not in PRIMITIVES:
            raise NotImplementedError(category)
        with np.errstate(all="ignore"):
            result = PRIMITIVES[category](inputs, COMPONENTS.get(kind, 1), output)
        result = np.asarray(result, float)
        return np.broadcast_to(result, (len(result), COMPONENTS.get(kind, result.shape[1])))

    def of_graph(self, graph, inputs, output):
        """An output of a graph whose interface has these values."""
        nodes = {node.get("name"): node for node in graph if node.tag not in ("input", "output")}
        known = {}

        def source(element):
            if element.get("interfacename"):
                return inputs[element.get("interfacename")]
            if element.get("nodename"):
                return node_value(element.get("nodename"), element.get("output") or "out")
            kind = element.get("type")
            return numbers(element.get("value"), kind) if kind in COMPONENTS else element.get("value")

        def node_value(name, wanted):
            if (name, wanted) not in known:
                node = nodes[name]
                definition = self.library.definition(node)
                outputs = [each.get("name") for each in definition.findall("output")]
                given = {each.get("name"): source(each) for each in node.findall("input")}
                known[name, wanted] = self.value(definition, given, wanted if wanted in outputs else outputs[0])
            return known[name, wanted]

        chosen = [each for each in graph.findall("output") if each.get("name") == output] or graph.findall("output")
        return source(chosen[0])


PRIMITIVES = {}


def primitive(*names):
    """Registers how nodes of these categories are computed."""

    def register(function):
        PRIMITIVES.update(dict.fromkeys(names, function))
        return function

    return register


def unary(name, function):
    """A node of one input."""
    PRIMITIVES[name] = lambda v, *_: function(v["in"])


def binary(name, function, a="in1", b="in2"):
    """A node of two inputs."""
    PRIMITIVES[name] = lambda v, *_: function(v[a], v[b])


for node, compute in {
    "fract": lambda x: x - np.floor(x), "absval": np.abs, "floor": np.floor, "ceil": np.ceil, "round": lambda x: np.floor(x + 0.5),
    "sign": np.sign, "sin": np.sin, "cos": np.cos, "tan": np.tan, "asin": np.arcsin, "acos": np.arccos, "sqrt": np.sqrt, "ln": np.log, "exp": np.exp,
    "dot": lambda x: x, "not": lambda x: 1 - x, "convert": lambda x: x, "magnitude": lambda x: np.linalg.norm(x, axis=1, keepdims=True),
    "normalize": lambda x: x / np.linalg.norm(x, axis=1, keepdims=True),
    "premult": lambda x: np.hstack([x[:, :3] * x[:, 3:], x[:, 3:]]), "unpremult": lambda x: np.hstack([x[:, :3] / x[:, 3:], x[:, 3:]]),
}.items():  # fmt: skip
    unary(node, compute)
for node, compute in {
    "add": np.add, "subtract": np.subtract, "multiply": np.multiply, "divide": np.divide, "modulo": lambda a, b: a - b * np.floor(a / b),
    "power": np.power, "min": np.minimum, "max": np.maximum, "and": np.minimum, "or": np.maximum,
    "dotproduct": lambda a, b: np.sum(a * b, axis=1, keepdims=True), "crossproduct": np.cross,
}.items():  # fmt: skip
    binary(node, compute)
binary("invert", lambda a, b: b - a, "in", "amount")
binary("atan2", np.arctan2, "iny", "inx")
binary("inside", np.multiply, "in", "mask")
binary("outside", lambda a, b: a * (1 - b), "in", "mask")
PRIMITIVES["constant"] = lambda v, *_: v["value"]
PRIMITIVES["clamp"] = lambda v, *_: np.minimum(np.maximum(v["in"], v["low"]), v["high"])
PRIMITIVES["mix"] = lambda v, *_: v["bg"] * (1 - v["mix"]) + v["fg"] * v["mix"]
PRIMITIVES["remap"] = lambda v, *_: v["outlow"] + (v["in"] - v["inlow"]) * (v["outhigh"] - v["outlow"]) / (v["inhigh"] - v["inlow"])
PRIMITIVES["ifgreater"] = lambda v, *_: np.where(v["value1"] > v["value2"], v.get("in1", 1.0), v.get("in2", 0.0))
PRIMITIVES["ifgreatereq"] = lambda v, *_: np.where(v["value1"] >= v["value2"], v.get("in1", 1.0), v.get("in2", 0.0))
PRIMITIVES["ifequal"] = lambda v, *_: np.where(v["value1"] == v["value2"], v.get("in1", 1.0), v.get("in2", 0.0))
PRIMITIVES["combine2"] = PRIMITIVES["combine3"] = PRIMITIVES["combine4"] = lambda v, *_: stacked([v[name] for name in sorted(v)])
# Of a matrix a row, of other values a component.
PRIMITIVES["extract"] = lambda v, columns, _: v["in"].reshape(len(v["in"]), -1, columns)[:, int(v["index"][0, 0])]
PRIMITIVES["texcoord"] = lambda v, *_: v["UV0"]


def stacked(parts):
    """Columns side by side; single rows hold for all places."""
    count = max(map(len, parts))
    return np.hstack([np.broadcast_to(part, (count, part.shape[1])) for part in parts])


def laid(function):
    """`function` of foreground and background, as much of it as `mix` says."""
    return lambda v, *_: v["mix"] * function(v["fg"], v["bg"]) + (1 - v["mix"]) * v["bg"]


def over(fg, bg):
    return fg + bg * (1 - fg[:, 3:])


def disjoint(fg, bg):
    total = fg[:, 3:] + bg[:, 3:]
    behind = np.where(np.abs(bg[:, 3:]) < TINY, 0, fg[:, :3] + bg[:, :3] * (1 - fg[:, 3:]) / bg[:, 3:])
    return stacked([np.where(total <= 1, fg[:, :3] + bg[:, :3], behind), np.minimum(total, 1)])


for node, compute in {
    "plus": lambda fg, bg: bg + fg, "minus": lambda fg, bg: bg - fg, "difference": lambda fg, bg: np.abs(bg - fg),
    "screen": lambda fg, bg: 1 - (1 - fg) * (1 - bg), "in": lambda fg, bg: fg * bg[:, 3:], "mask": lambda fg, bg: bg * fg[:, 3:],
    "out": lambda fg, bg: fg * (1 - bg[:, 3:]), "over": over, "disjointover": disjoint,
    "matte": lambda fg, bg: over(stacked([fg[:, :3] * fg[:, 3:], fg[:, 3:]]), bg),
}.items():  # fmt: skip
    PRIMITIVES[node] = laid(compute)


@primitive("burn")
def burn(v, *_):
    return np.where(np.abs(v["fg"]) < TINY, 0, laid(lambda fg, bg: 1 - (1 - bg) / fg)(v))


@primitive("dodge")
def dodge(v, *_):
    return np.where(np.abs(1 - v["fg"]) < TINY, 0, laid(lambda fg, bg: bg / (1 - fg))(v))


@primitive("smoothstep")
def smoothstep(v, *_):
    t = np.clip((v["in"] - v["low"]) / (v["high"] - v["low"]), 0, 1)
    return np.where(v["in"] >= v["high"], 1, np.where(v["in"] <= v["low"], 0, t * t * (3 - 2 * t)))


@primitive("luminance")
def luminance(v, columns, _):
    grey = np.sum(v["in"][:, :3] * v["lumacoeffs"], axis=1, keepdims=True) * np.ones((1, 3))
    return grey if columns == 3 else stacked([grey, v["in"][:, 3:]])


@primitive("rgbtohsv")
def rgb_to_hsv(v, columns, _):
    rgb = v["in"][:, :3]
    most, spread = rgb.max(axis=1), np.ptp(rgb, axis=1)
    r, g, b = rgb.T
    hue = np.where(r >= most, (g - b) / spread, np.where(g >= most, 2 + (b - r) / spread, 4 + (r - g) / spread)) / 6
    hue = np.where(spread > 0, np.where(hue < 0, hue + 1, hue), 0)
    hsv = np.stack([hue, np.where(most > 0, spread / most, 0), most], axis=1)
    return hsv if columns == 3 else stacked([hsv, v["in"][:, 3:]])


@primitive("hsvtorgb")
def hsv_to_rgb(v, columns, _):
    hue, saturation, value = v["in"][:, :3].T
    turned = 6 * (hue - np.floor(hue))
    pure = [np.clip(np.abs(np.mod(turned + offset, 6) - 3) - 1, 0, 1) for offset in (0, 4, 2)]
    rgb = np.stack([value * (1 - saturation * (1 - part)) for part in pure], axis=1)
    return rgb if columns == 3 else stacked([rgb, v["in"][:, 3:]])


@primitive("rotate2d")
def rotate_2d(v, *_):
    angle = np.radians(v["amount"])[:, 0]
    x, y = v["in"].T
    return np.stack([np.cos(angle) * x + np.sin(angle) * y, np.cos(angle) * y - np.sin(angle) * x], axis=1)


@primitive("rotate3d")
def rotate_3d(v, *_):
    axis = v["axis"] / np.linalg.norm(v["axis"], axis=1, keepdims=True)
    angle = np.radians(v["amount"])
    along = np.sum(axis * v["in"], axis=1, keepdims=True)
    return v["in"] * np.cos(angle) + np.cross(v["in"], axis) * np.sin(angle) + axis * along * (1 - np.cos(angle))


@primitive("transformmatrix")
def transform_matrix(v, columns, _):
    side = int(np.sqrt(v["mat"].shape[1]))
    matrix = v["mat"].reshape(-1, side, side)
    vector = v["in"]
    if vector.shape[1] < side:
        vector = stacked([vector, np.ones((len(vector), 1))])
    return np.einsum("ni,nij->nj", vector, np.broadcast_to(matrix, (len(vector), side, side)))[:, :columns]


@primitive("determinant")
def determinant(v, *_):
    side = int(np.sqrt(v["in"].shape[1]))
    return np.linalg.det(v["in"].reshape(-1, side, side))[:, None]


def ramp(low, high, axis):
    """A ramp between two inputs along a coordinate."""
    return lambda v, *_: v[low] + (v[high] - v[low]) * np.clip(v["texcoord"][:, axis, None], 0, 1)


def split(low, high, axis):
    """Two inputs before and behind a centre."""
    return lambda v, *_: np.where(v["texcoord"][:, axis, None] > v["center"], v[high], v[low])


PRIMITIVES["ramplr"], PRIMITIVES["ramptb"] = ramp("valuel", "valuer", 0), ramp("valueb", "valuet", 1)
PRIMITIVES["splitlr"], PRIMITIVES["splittb"] = split("valuel", "valuer", 0), split("valueb", "valuet", 1)


@primitive("roughness_anisotropy")
def roughness_anisotropy(v, *_):
    width = np.clip(v["roughness"] ** 2, TINY, 1)
    aspect = np.sqrt(1 - np.clip(v["anisotropy"], 0, 0.98))
    return stacked([np.minimum(width / aspect, 1), width * aspect])


@primitive("roughness_dual")
def roughness_dual(v, *_):
    x, y = v["roughness"][:, :1], v["roughness"][:, 1:]
    return stacked([np.clip(x * x, TINY, 1), np.clip(np.where(y < 0, x, y) ** 2, TINY, 1)])


@primitive("artistic_ior")
def artistic_ior(v, _, output):
    r = np.clip(v["reflectivity"], 0, 0.99)
    most, least = (1 + np.sqrt(r)) / (1 - np.sqrt(r)), (1 - r) / (1 + r)
    ior = most + (least - most) * v["edge_color"]
    return ior if output == "ior" else np.sqrt(np.maximum(((ior + 1) ** 2 * r - (ior - 1) ** 2) / (1 - r), 0))


@primitive("blackbody")
def blackbody(v, *_):
    kelvin = np.clip(v["temperature"], 800, 25000)
    t = 1000 / kelvin
    x = np.where(
        kelvin < 4000,
        np.polyval([-0.2661239, -0.2343580, 0.8776956, 0.179910], t),
        np.polyval([-3.0258469, 2.1070379, 0.2226347, 0.240390], t),
    )
    cold = np.polyval([3.0817580, -5.87338670, 3.75112997, -0.37001483], x)
    warm = np.polyval([-0.9549476, -1.37418593, 2.09137015, -0.16748867], x)
    red = np.polyval([-1.1063814, -1.34811020, 2.18555832, -0.20219683], x)
    y = np.where(kelvin < 2222, red, np.where(kelvin < 4000, warm, cold))
    xyz = stacked([x / y, np.ones_like(x), (1 - x - y) / y])
    return np.maximum(xyz @ np.array([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.2040, 1.0570]]).T, 0)


@primitive("chiang_hair_roughness")
def chiang_hair_roughness(v, _, output):
    along, about = np.clip(v["longitudinal"], 1e-3, 1), np.clip(v["azimuthal"], 1e-3, 1)
    variance = (0.726 * along + 0.812 * along**2 + 3.7 * along**20) ** 2
    scale = {"roughness_R": 1.0, "roughness_TT": v["scale_TT"], "roughness_TRT": v["scale_TRT"]}[output]
    return stacked([variance * scale**2, 0.265 * about + 1.194 * about**2 + 5.372 * about**22])


@primitive("deon_hair_absorption_from_melanin")
def deon_hair_absorption_from_melanin(v, *_):
    amount = -np.log(np.maximum(1 - v["melanin_concentration"], 1e-4))
    brown, red = amount * (1 - v["melanin_redness"]), amount * v["melanin_redness"]
    return np.maximum(brown * -np.log(v["eumelanin_color"]) + red * -np.log(v["pheomelanin_color"]), 0)


@primitive("chiang_hair_absorption_from_color")
def chiang_hair_absorption_from_color(v, *_):
    scale = np.polyval([0.245, 5.574, -10.73, 2.532, -0.215, 5.969], v["azimuthal_roughness"])
    return (np.log(np.clip(v["color"], 1e-3, 1)) / scale) ** 2
