"""Light Path and Light Falloff in materials, and nodes that Cycles has not, against Cycles."""

import pytest


def shown(kind, output, prepare=None):
    """A maker of materials that shine with a node's output."""

    def make():
        from beside_cycles import shining

        made, tree, colour = shining(f"{kind} {output}")
        node = tree.nodes.new(f"ShaderNode{kind}")
        if prepare is not None:
            prepare(node)
        tree.links.new(node.outputs[output], colour)
        return made

    return make


def smooth(value):
    def prepare(node):
        node.inputs["Strength"].default_value, node.inputs["Smooth"].default_value = 2.0, value

    return prepare


def tinted(node):
    node.inputs["Color"].default_value = (0.2, 0.5, 0.7, 1.0)


CASES = {
    **{
        f"{output} {value}": shown("LightFalloff", output, smooth(value))
        for output in ("Quadratic", "Linear", "Constant")
        for value in (0, 3)
    },
    "length": shown("LightPath", "Ray Length"),
    **{f"to rgb {output}": shown("ShaderToRGB", output) for output in ("Color", "Alpha")},
    "squeeze": shown("Squeeze", 0),
    "stroke": shown("UVAlongStroke", 0),
    **{f"occlusion {output}": shown("AmbientOcclusion", output, tinted) for output in ("Color", "AO")},
}
LINES = ("Shader to RGB", "Squeeze", "UV along", "UV Along")


@pytest.mark.blender
def test_rays_are_as_long_as_in_cycles(tmp_path):
    from beside_cycles import alike, board, both

    made = board(CASES, [(0, 0, 0)] * 2)
    alike(both(tmp_path, lines=LINES), CASES, 2)
    for lens in ("PERSP", "PANO"):
        made.camera.data.type = lens
        made.camera.data.angle, made.camera.data.clip_start = 1.3, 1.5
        made.camera.location = (20.0, 0.5, 9.0)
        made.cycles.samples = 200
        cycles, gonio = both(tmp_path, lines=LINES)
        assert cycles.max() > 5.0 and abs(cycles - gonio).mean() < 0.02 * cycles.mean(), lens


@pytest.mark.blender
def test_shaders_that_cycles_has_not_are_none():
    from recorder import empty, material, translated

    empty()
    made, tree, end = material()
    mix, plain = tree.nodes.new("ShaderNodeMixShader"), tree.nodes.new("ShaderNodeBsdfDiffuse")
    tree.links.new(tree.nodes.new("ShaderNodeEeveeSpecular").outputs[0], mix.inputs[1])
    tree.links.new(plain.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], end.inputs["Surface"])
    description, lines = translated(made)
    assert [closure["model"] for closure in description["closures"]] == ["Diffuse"] and len(lines) == 1
