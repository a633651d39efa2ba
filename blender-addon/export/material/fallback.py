# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands in for nodes that cannot be computed: their usual mean, or the value of a socket."""

from .sockets import KINDS, input_socket

# Mean of a texture's scalar output; its colour output is grey of the same value unless it mixes colours of its own.
MEANS = {
    "ShaderNodeTexNoise": 0.5,
    "ShaderNodeTexVoronoi": 0.5,
    "ShaderNodeTexWave": 0.5,
    "ShaderNodeTexMagic": 0.5,
    "ShaderNodeTexGabor": 0.5,
    "ShaderNodeTexWhiteNoise": 0.5,
    "ShaderNodeTexMusgrave": 0.5,
    "ShaderNodeTexPointDensity": 0.0,
    "ShaderNodeAmbientOcclusion": 1.0,
    "ShaderNodeTexIES": 1.0,
    "ShaderNodeHairInfo": 0.5,
    "ShaderNodeParticleInfo": 0.5,
}
# Mean radiance of the upper half of Blender's default skies without the sun, by cosine, W/(m² sr); measured with Cycles.
SKIES = {
    "SINGLE_SCATTERING": (1.69, 2.14, 2.81),
    "NISHITA": (1.74, 2.17, 2.82),
    "MULTIPLE_SCATTERING": (1.74, 2.86, 4.83),
    "PREETHAM": (0.37, 0.57, 1.06),
    "HOSEK_WILKIE": (0.050, 0.086, 0.146),
}


def stand_in(translator, node, output, context):
    """The value that stands in for an output, and words that say so."""
    kind = KINDS.get(output.type, "VALUE")
    graph = translator.graph
    if node.bl_idname == "ShaderNodeTexSky":
        return graph.colour(SKIES.get(node.sky_type, SKIES["PREETHAM"])), "an even sky of its usual brightness without the sun is used"
    if node.bl_idname == "ShaderNodeTexBrick":
        first, second = (translator.input(node, f"Color{n}", context) for n in (1, 2))
        return (first.mix(second, 0.5) if kind == "RGBA" else graph.scalar(0.1)), "the mean of its colours is used"
    if node.bl_idname in MEANS:
        mean = MEANS[node.bl_idname]
        return graph.value(mean), f"its mean {mean:g} is used"
    through = _same_kind_input(node, output)
    if through is not None:
        return translator.socket(through, context), f"its input {through.name} is passed on"
    return translator.default_of(output, kind), "its socket's value is used"


def _same_kind_input(node, output):
    """The input that a node most likely changes: the one of the output's name, else the first of its type."""
    named = input_socket(node, output.name)
    if named is not None and named.type == output.type and named.enabled:
        return named
    return next((s for s in node.inputs if s.type == output.type and s.enabled and not s.hide_value), None)
