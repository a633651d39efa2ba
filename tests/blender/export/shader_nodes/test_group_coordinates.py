"""Coordinates of textures within groups, where nothing is linked to the group, against Cycles."""

import pytest

SEED = (0.3, 1.7, 0.6)
TEXTURES = ("TexNoise", "TexVoronoi", "TexWave", "TexChecker", "TexGradient", "TexImage")
WAYS = ("straight", "rerouted", "muted", "uneven")


def grouped(texture, hidden, ways):
    """A maker of materials that shine with a texture in a group, whose own coordinates come from the group's unlinked input."""

    def make():
        import bpy
        from beside_cycles import shining

        made, tree, colour = shining(f"{texture} {hidden} {ways}")
        inner = bpy.data.node_groups.new("Inner", "ShaderNodeTree")
        place = inner.interface.new_socket("Vector", in_out="INPUT", socket_type="NodeSocketVector")
        place.default_value, place.hide_value = SEED, hidden
        inner.interface.new_socket("Color", in_out="OUTPUT", socket_type="NodeSocketColor")
        ends = [inner.nodes.new(kind) for kind in ("NodeGroupInput", "NodeGroupOutput", f"ShaderNode{texture}")]
        source = ends[0].outputs[0]
        if ways == "rerouted":
            way = inner.nodes.new("NodeReroute")
            way.socket_idname = "NodeSocketVector"
            inner.links.new(source, way.inputs[0])
            source = way.outputs[0]
        if ways == "muted":
            way = inner.nodes.new("ShaderNodeMapping")
            way.mute = True
            way.inputs["Vector"].default_value = SEED
            source = way.outputs[0]
        if ways == "uneven" and "Scale" in ends[2].inputs:
            inner.links.new(inner.nodes.new("ShaderNodeLightPath").outputs["Ray Length"], ends[2].inputs["Scale"])
        inner.links.new(source, ends[2].inputs["Vector"])
        inner.links.new(ends[2].outputs["Color"], ends[1].inputs[0])
        if texture == "TexImage":
            ends[2].image = bpy.data.images.get("Grid") or bpy.data.images.new("Grid", 64, 64)
            ends[2].image.generated_type = "COLOR_GRID"
        group = tree.nodes.new("ShaderNodeGroup")
        group.node_tree = inner
        if not hidden:
            group.inputs[0].default_value = SEED
        tree.links.new(group.outputs[0], colour)
        return made

    return make


CASES = {
    f"{texture} hidden={hidden} {ways}": grouped(texture, hidden, ways)
    for texture in TEXTURES
    for hidden in (False, True)
    for ways in WAYS
}


@pytest.mark.blender
def test_unlinked_inputs_of_groups_give_what_they_give_in_cycles(tmp_path):
    from beside_cycles import alike, board, both

    board(CASES, [(0, 0, 0)] * 2, samples=256)
    alike(both(tmp_path), CASES, 2, tolerance=0.06)
