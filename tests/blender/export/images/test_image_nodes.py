"""Image textures against Cycles: the cubic filter, alpha in bytes, projections, and no image at all."""

import pytest


def picture(name, *, alpha=False, is_float=True, width=5, height=4):
    import bpy
    import numpy as np

    made = bpy.data.images.new(name, width, height, alpha=alpha, float_buffer=is_float)
    values = np.random.default_rng(7).uniform(0.1, 1.0, (height, width, 4)).astype(np.float32)
    if not alpha:
        values[..., 3] = 1.0
    made.pixels.foreach_set(values.ravel())
    if not is_float:
        made.pack()
    return made


def shown(image=None, output=0, **fields):
    """A material that shines with a texture at the board's own values as coordinates."""

    def make():
        from beside_cycles import shining

        made, tree, colour = shining("Image")
        node, source = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeVertexColor")
        source.layer_name = "a"
        node.image = None if image is None else image()
        for name, value in fields.items():
            setattr(node, name, value)
        tree.links.new(source.outputs[0], node.inputs[0])
        tree.links.new(node.outputs[output], colour)
        return made

    return make


def hidden():
    """Bytes of one colour, and of others where alpha hides them."""
    import numpy as np

    made = picture("Hidden", alpha=True, is_float=False)
    values = np.empty((4, 5, 4), dtype=np.float32)
    values[..., :3] = np.random.default_rng(9).uniform(0.1, 1.0, (4, 5, 3))
    values[..., 3] = np.array([0.0, 1.0, 1.0, 0.0, 1.0])
    values[values[..., 3] > 0.0, :3] = (0.8, 0.5, 0.2)
    made.pixels.foreach_set(values.ravel())
    made.pack()
    return made


def both_outputs(**fields):
    """As `shown`, of a texture whose alpha is in use too: it adds to the strength."""

    def make():
        made = shown(hidden, **fields)()
        tree = made.node_tree
        kinds = {node.bl_idname: node for node in tree.nodes}
        more = tree.nodes.new("ShaderNodeMath")
        tree.links.new(kinds["ShaderNodeTexImage"].outputs["Alpha"], more.inputs[0])
        more.inputs[1].default_value = 1.0
        tree.links.new(more.outputs[0], kinds["ShaderNodeEmission"].inputs["Strength"])
        return made

    return make


CASES = {
    **{
        f"cubic {wrap}": shown(lambda: picture("A"), interpolation="Cubic", extension=wrap)
        for wrap in ("REPEAT", "EXTEND", "CLIP", "MIRROR")
    },
    "smart": shown(lambda: picture("B"), interpolation="Smart"),
    "sphere": shown(lambda: picture("C"), projection="SPHERE"),
    "tube": shown(lambda: picture("D"), projection="TUBE"),
    "closest": shown(lambda: picture("E", alpha=True, is_float=False), interpolation="Closest"),
    "bytes": shown(lambda: picture("F", is_float=False)),
    "bytes, alpha": shown(lambda: picture("G", alpha=True, is_float=False)),
    "bytes, alpha alone": shown(lambda: picture("H", alpha=True, is_float=False), 1),
    "bytes, alpha, cubic": shown(lambda: picture("I", alpha=True, is_float=False), interpolation="Cubic", extension="CLIP"),
    "bytes, alpha too": both_outputs(),
    "bytes, alpha too, cubic": both_outputs(interpolation="Cubic"),
    "none": shown(),
    "no alpha": shown(output=1),
}


@pytest.mark.blender
def test_images_are_looked_up_as_in_cycles(tmp_path):
    import numpy as np
    from beside_cycles import alike, board, both

    values = np.random.default_rng(8).uniform(-0.7, 1.7, (60, 3))
    board(CASES, values)
    alike(both(tmp_path), CASES, len(values), 2e-5)
