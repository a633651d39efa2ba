"""What stands in the sockets of shader graphs: wrong types, numbers that are none, details beyond all measure, images that are not there."""

import pytest
from test_bad_graphs import floor, group, shown, used

NAN, INFINITY = float("nan"), float("inf")


@pytest.mark.blender
def test_links_between_wrong_types(tmp_path):
    tree, shader, end = floor()
    noise, closure, text = (tree.nodes.new(f"ShaderNode{name}") for name in ("TexNoise", "BsdfGlass", "UVMap"))
    wrong = [
        (closure.outputs[0], shader.inputs["Color"]),
        (closure.outputs[0], shader.inputs["Normal"]),
        (closure.outputs[0], noise.inputs["Scale"]),
        (noise.outputs[1], shader.inputs["Normal"]),
        (text.outputs[0], end.inputs["Surface"]),
        (noise.outputs[0], end.inputs["Surface"]),
        (shader.outputs[0], end.inputs["Displacement"]),
        (closure.outputs[0], end.inputs["Thickness"]),
        (noise.outputs[1], end.inputs["Displacement"]),
        (noise.outputs[0], end.inputs["Volume"]),
    ]
    for source, target in wrong:
        link = tree.links.new(source, target)
        shown(tmp_path)
        tree.links.remove(link)
        tree.links.new(shader.outputs[0], end.inputs["Surface"])


@pytest.mark.blender
@pytest.mark.parametrize("number", [NAN, INFINITY, -INFINITY, 1e38, -1e38, 1e-38])
def test_numbers_that_are_none(tmp_path, number):
    tree, shader, end = floor()
    value = tree.nodes.new("ShaderNodeValue")
    value.outputs[0].default_value = number
    kinds = ("Noise", "Voronoi", "Wave", "Magic", "WhiteNoise", "Brick", "Gabor", "Checker", "Gradient")
    for kind in kinds:
        node = tree.nodes.new(f"ShaderNodeTex{kind}")
        for socket in node.inputs:
            tree.links.new(value.outputs[0], socket)
        tree.links.new(node.outputs[0], shader.inputs["Color"])
        shown(tmp_path)
        tree.nodes.remove(node)
    bump, moved = tree.nodes.new("ShaderNodeBump"), tree.nodes.new("ShaderNodeDisplacement")
    for node in (bump, moved):
        for socket in node.inputs:
            tree.links.new(value.outputs[0], socket)
    tree.links.new(bump.outputs[0], shader.inputs["Normal"])
    tree.links.new(moved.outputs[0], end.inputs["Displacement"])
    shown(tmp_path)
    for kind in ("BsdfPrincipled", "BsdfGlass", "SubsurfaceScattering", "Emission"):
        node = tree.nodes.new(f"ShaderNode{kind}")
        for socket in node.inputs:
            if socket.type in ("VALUE", "RGBA", "VECTOR"):
                tree.links.new(value.outputs[0], socket)
        tree.links.new(node.outputs[0], end.inputs["Surface"])
        shown(tmp_path)


@pytest.mark.blender
@pytest.mark.parametrize("number", [1e4, 1e9, 1e30, -1e30])
def test_details_beyond_all_measure(tmp_path, number):
    tree, shader, _ = floor()
    # A value that differs from point to point is not folded, nor held by the socket's own limits.
    place, large = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeMath")
    large.operation = "MULTIPLY"
    large.inputs[1].default_value = number
    tree.links.new(place.outputs["Position"], large.inputs[0])
    for kind in ("Noise", "Voronoi", "Wave", "Magic", "Brick", "Gabor"):
        node = tree.nodes.new(f"ShaderNodeTex{kind}")
        names = [socket.name for socket in node.inputs if socket.type == "VALUE" and socket.enabled]
        for name in names:
            tree.links.new(large.outputs[0], node.inputs[name])
            tree.links.new(node.outputs[0], shader.inputs["Color"])
            shown(tmp_path)
            tree.links.remove(node.inputs[name].links[0])
        for name in names:
            tree.links.new(large.outputs[0], node.inputs[name])
        shown(tmp_path)
        tree.nodes.remove(node)


@pytest.mark.blender
def test_images_that_are_missing_within_groups(tmp_path):
    import bpy
    from test_bad_input import broken_image

    tree, shader, _ = floor()
    inner, _, stop = group("Pictures", inputs=(), outputs=("NodeSocketColor",))
    holder, texture = used(tree, inner), inner.nodes.new("ShaderNodeTexImage")
    inner.links.new(texture.outputs[0], stop.inputs[0])
    tree.links.new(holder.outputs[0], shader.inputs["Color"])
    shown(tmp_path)
    texture.image = broken_image(tmp_path / "gone.png", None)
    assert shown(tmp_path)[1]
    for source in ("SEQUENCE", "MOVIE", "TILED"):
        texture.image = bpy.data.images.load(broken_image(tmp_path / f"{source}.png", b"").filepath)
        texture.image.source = source
        assert shown(tmp_path)[1], source
    for size in ((1, 1), (1, 4096)):
        texture.image = bpy.data.images.new("Thin", *size)
        for projection in ("FLAT", "BOX", "SPHERE", "TUBE"):
            texture.projection = projection
            shown(tmp_path)
