"""Malformed variants of stages: cut short, bytes flipped, nested, in circles, of wrong types, with absurd counts. The same seed makes the same file."""

import random
import re

NUMBERS = ["nan", "inf", "-inf", "1e38", "-1e38", "1e-45", "2147483647", "-2147483648", "-1", "0", "1e308"]
TYPES = ["int", "float", "double", "token", "string", "asset", "bool", "float3", "point3f[]", "int[]", "color3f[]", "texCoord2f[]", "matrix4d", "quatf[]", "timecode"]
TYPED = re.compile(r"^(\s*(?:custom |uniform )*)([a-z]\w*(?:\[\])?)( [\w:]+(?:\.\w+)?(?: =| \())", re.MULTILINE)
NUMBER = re.compile(r"(?<![\w.\"/])-?\d+(?:\.\d+)?(?:e-?\d+)?(?![\w\"])")
INTEGERS = re.compile(r"int\[\] [\w:]+ = \[([^\]]*)\]")

CIRCLES = [
    'def "C1" (prepend references = </C2>) {}\ndef "C2" (prepend references = </C1>) {}\n',
    'def "C1" (prepend inherits = </C1/In>)\n{\n    def "In" {}\n}\n',
    'def "C1" (prepend payload = @{name}@</C1>) {{}}\n',
    'class "C1" (prepend specializes = </C2>) {}\nclass "C2" (prepend specializes = </C1>) {}\ndef Cube "C3" (prepend inherits = </C1>) {}\n',
    'def PointInstancer "C1"\n{\n    int[] protoIndices = [0]\n    point3f[] positions = [(0, 0, 0)]\n    rel prototypes = </C1/In>\n    def PointInstancer "In"\n    {\n        int[] protoIndices = [0]\n        point3f[] positions = [(0, 0, 0)]\n        rel prototypes = </C1>\n    }\n}\n',
    'def Mesh "C1" (prepend apiSchemas = ["MaterialBindingAPI"])\n{\n    rel material:binding = </C2>\n}\ndef Material "C2"\n{\n    token outputs:surface.connect = </C2/N.outputs:surface>\n    def NodeGraph "N"\n    {\n        token outputs:surface.connect = </C2.outputs:surface>\n    }\n}\n',
    'def RenderSettings "C1"\n{\n    rel products = [</C1>, </C2>]\n    rel camera = </C1>\n}\ndef RenderProduct "C2"\n{\n    rel orderedVars = [</C2>, </C1>]\n}\n',
]


def cut_short(data, chance, _name):
    return data[: chance.randrange(len(data))]


def flipped(data, chance, _name):
    out = bytearray(data)
    for _ in range(chance.choice([1, 1, 2, 3, 8, 64])):
        out[chance.randrange(len(out))] ^= 1 << chance.randrange(8)
    return bytes(out)


def replaced(data, chance, _name):
    """A stretch of bytes taken out, doubled or moved."""
    start = chance.randrange(len(data))
    end = min(len(data), start + chance.choice([1, 4, 16, 256, 4096]))
    piece = data[start:end]
    return chance.choice([data[:start] + data[end:], data[:end] + piece + data[end:], piece + data[:start] + data[end:]])


def nested(text, chance, _name):
    depth = chance.choice([100, 1500, 1990, 20_000, 200_000])
    pair = chance.choice(["[]", "()", "{}"])
    kinds = [
        f"def \"Deep\"\n{{\n    custom int[] a = {pair[0] * depth}{pair[1] * depth}\n}}\n",
        'def "D" {\n' * min(depth, 20_000) + "}\n" * min(depth, 20_000),
        "def \"Deep\" (\n    customData = " + "{ dictionary a = " * min(depth, 1500) + "{}" + " }" * min(depth, 1500) + "\n)\n{\n}\n",
    ]
    return text + chance.choice(kinds)


def in_circles(text, chance, name):
    return text + chance.choice(CIRCLES).replace("{name}", name).replace("{{}}", "{}")


def of_wrong_types(text, chance, _name):
    places = list(TYPED.finditer(text))
    for place in sorted(chance.sample(places, min(len(places), chance.choice([1, 1, 3, 10]))), key=lambda match: -match.start()):
        start, end = place.span(2)
        text = text[:start] + chance.choice(TYPES) + text[end:]
    return text


def of_absurd_numbers(text, chance, _name):
    places = list(NUMBER.finditer(text))[1:]
    for place in sorted(chance.sample(places, min(len(places), chance.choice([1, 2, 5, 20]))), key=lambda match: -match.start()):
        text = text[: place.start()] + chance.choice(NUMBERS) + text[place.end() :]
    return text


def of_absurd_counts(text, chance, _name):
    places = [match for match in INTEGERS.finditer(text) if match.group(1).strip()]
    if not places:
        return of_absurd_numbers(text, chance, _name)
    place = chance.choice(places)
    numbers = place.group(1).split(",")
    for _ in range(chance.choice([1, 2, len(numbers)])):
        numbers[chance.randrange(len(numbers))] = chance.choice(["2147483647", "-1", "0", "-2147483648", "65536", "1000000000"])
    if chance.random() < 0.2:
        numbers = numbers[: len(numbers) // 2]
    return text[: place.start(1)] + ",".join(numbers) + text[place.end(1) :]


OF_BYTES = [cut_short, flipped, replaced]
OF_TEXT = [nested, in_circles, of_wrong_types, of_absurd_numbers, of_absurd_counts]


def variant(data, name, seed):
    """A variant of a file's bytes, and what was done to it."""
    chance = random.Random(f"{name} {seed}")
    is_text = data.startswith(b"#usda")
    kinds = OF_BYTES + OF_TEXT if is_text else OF_BYTES
    # In turn, so that each kind has its share.
    kind = kinds[seed % len(kinds)]
    if kind in OF_TEXT:
        return kind(data.decode(), chance, name).encode(), kind.__name__
    return kind(data, chance, name), kind.__name__
