# SPDX-License-Identifier: GPL-3.0-or-later
"""Procedural textures: noise, Voronoi, wave, magic, brick, white noise, Gabor; each is one operation of the renderer."""

from .inputs import GENERATED, direction
from .textures import coordinates
from .registry import value_node

NOISES = {
    "FBM": "Fbm",
    "MULTIFRACTAL": "Multifractal",
    "HYBRID_MULTIFRACTAL": "HybridMultifractal",
    "RIDGED_MULTIFRACTAL": "RidgedMultifractal",
    "HETERO_TERRAIN": "HeteroTerrain",
}
METRICS = {"EUCLIDEAN": "Euclidean", "MANHATTAN": "Manhattan", "CHEBYCHEV": "Chebychev", "MINKOWSKI": "Minkowski"}
FEATURES = {
    "F1": "F1",
    "F2": "F2",
    "SMOOTH_F1": "SmoothF1",
    "DISTANCE_TO_EDGE": "DistanceToEdge",
    "N_SPHERE_RADIUS": "NSphereRadius",
}
# Cells have had another hash since this version.
NEW_CELLS = (5, 0, 0)


def _place(t, node, context):
    return coordinates(t, node, context, lambda: direction(t) if t.is_world else t.primvar(GENERATED))


def _inputs(t, node, context, names):
    return [t.input(node, name, context) for name in names]


def _dimensions(node, attribute):
    return int(getattr(node, attribute)[0])


def _value_and_colour(t, output, texture):
    """The first of four outputs is the value, the others are the colour's."""
    if output.type == "RGBA":
        return t.graph.combine(*(texture.component(i) for i in (1, 2, 3)), kind="RGBA")
    return texture.component(0)


@value_node("ShaderNodeTexNoise")
def noise(t, node, context, output):
    names = ("W", "Scale", "Detail", "Roughness", "Lacunarity", "Offset", "Gain", "Distortion")
    fields = {
        "dimensions": _dimensions(node, "noise_dimensions"),
        "kind": NOISES[node.noise_type],
        "normalize": node.normalize,
        "color": output.type == "RGBA",
    }
    inputs = [_place(t, node, context), *_inputs(t, node, context, names)]
    return _value_and_colour(t, output, t.graph.add({"NoiseTexture": fields}, *inputs, kind="RGBA"))


@value_node("ShaderNodeTexWhiteNoise")
def white_noise(t, node, context, output):
    fields = {"dimensions": _dimensions(node, "noise_dimensions"), "color": output.type == "RGBA"}
    inputs = _inputs(t, node, context, ("Vector", "W"))
    return _value_and_colour(t, output, t.graph.add({"WhiteNoise": fields}, *inputs, kind="RGBA"))


@value_node("ShaderNodeTexWave")
def wave(t, node, context, output):
    names = ("Scale", "Distortion", "Detail", "Detail Scale", "Detail Roughness", "Phase Offset")
    kind, axis = ("Bands", node.bands_direction) if node.wave_type == "BANDS" else ("Rings", node.rings_direction)
    fields = {"shape": kind + axis.capitalize(), "profile": {"SIN": "Sine", "SAW": "Saw", "TRI": "Triangle"}[node.wave_profile]}
    inputs = [_place(t, node, context), *_inputs(t, node, context, names)]
    return t.graph.add({"WaveTexture": fields}, *inputs, kind="VALUE")


@value_node("ShaderNodeTexMagic")
def magic(t, node, context, output):
    inputs = [_place(t, node, context), *_inputs(t, node, context, ("Scale", "Distortion"))]
    return _value_and_colour(t, output, t.graph.add({"MagicTexture": {"depth": node.turbulence_depth}}, *inputs, kind="RGBA"))


@value_node("ShaderNodeTexVoronoi")
def voronoi(t, node, context, output):
    name = output.identifier
    names = ("W", "Scale", "Detail", "Roughness", "Lacunarity", "Smoothness", "Exponent", "Randomness")
    is_place = name in ("Position", "W")
    fields = {
        "dimensions": _dimensions(node, "voronoi_dimensions"),
        "feature": FEATURES[node.feature],
        "metric": METRICS[node.distance],
        "normalize": node.normalize,
        "hash": "Lookup3" if t.version < NEW_CELLS else "Pcg",
        "part": "Position" if is_place else "ColorDistance",
    }
    inputs = [_place(t, node, context), *_inputs(t, node, context, names)]
    texture = t.graph.add({"VoronoiTexture": fields}, *inputs, kind="VECTOR" if is_place else "RGBA")
    return texture if name in ("Position", "Color") else texture.component(3)


@value_node("ShaderNodeTexBrick")
def brick(t, node, context, output):
    names = ("Scale", "Mortar Size", "Mortar Smooth", "Bias", "Brick Width", "Row Height")
    fields = {name: getattr(node, name) for name in ("offset", "offset_frequency", "squash", "squash_frequency")}
    inputs = [_place(t, node, context), *_inputs(t, node, context, names)]
    texture = t.graph.add({"BrickTexture": fields}, *inputs, kind="VECTOR")
    tint, mortar = texture.component(0), texture.component(1)
    if output.identifier == "Fac":
        return mortar
    first, second, between = _inputs(t, node, context, ("Color1", "Color2", "Mortar"))
    return first.mix(second, tint).mix(between, mortar)


@value_node("ShaderNodeTexGabor")
def gabor(t, node, context, output):
    names = ("Scale", "Frequency", "Anisotropy", "Orientation 2D", "Orientation 3D")
    inputs = [_place(t, node, context), *_inputs(t, node, context, names)]
    texture = t.graph.add({"GaborTexture": {"dimensions": int(node.gabor_type[0])}}, *inputs, kind="VECTOR")
    return texture.component(("Value", "Phase", "Intensity").index(output.identifier))


@value_node("ShaderNodeRadialTiling")
def radial_tiling(t, node, context, output):
    is_place = output.identifier == "Segment Coordinates"
    fields = {"normalize": node.normalize, "part": "Coordinates" if is_place else "Segment"}
    tiles = t.graph.add({"RadialTiling": fields}, *_inputs(t, node, context, ("Vector", "Sides", "Roundness")), kind="VECTOR")
    return tiles if is_place else tiles.component(("Segment ID", "Segment Width", "Segment Rotation").index(output.identifier))


@value_node("ShaderNodeWavelength")
def wavelength(t, node, context, output):
    # The matrix to Rec.709 is another one since this version.
    fields = {"white": "Tristimulus" if t.version < NEW_CELLS else "Chromaticity"}
    return t.graph.add({"Wavelength": fields}, *_inputs(t, node, context, ("Wavelength",)), kind="RGBA")
