"""Alpha modes of images as Cycles has them: files, packed files, and pictures in memory; bytes and floats, by both outputs of the node."""

import pytest

MODES = ("STRAIGHT", "PREMUL", "CHANNEL_PACKED", "NONE")
# In the middles of texels, between some, and outside.
PLACES = [
    (0.125, 0.125, 0),
    (0.375, 0.625, 0),
    (0.625, 0.375, 0),
    (0.875, 0.375, 0),
    (0.53, 0.47, 0),
    (0.93, 0.31, 0),
    (1.3, 0.4, 0),
    (-0.05, 0.55, 0),
]
COLOUR, BOTH, ALPHA = range(3)


def texels(is_float):
    """4 × 4 texels, flat; colours that are brighter than their alpha, and some that alpha hides."""
    import numpy

    rng = numpy.random.default_rng(7)
    values = rng.random((16, 4)).astype("f4")
    values[::5, 3], values[1::5, 3] = 0.0, 1.0
    if is_float:
        values[:, :3] *= 1.5
    return values.ravel()


def new(name, is_float):
    import bpy

    image = bpy.data.images.new(name, 4, 4, alpha=True, float_buffer=is_float)
    if is_float:
        image.colorspace_settings.name = "Linear Rec.709"
    image.pixels.foreach_set(texels(is_float))
    return image


def saved(folder, kind, is_float=False, depth=None):
    """An image that is loaded from a file."""
    import bpy

    image = new("Made", is_float)
    path = folder / f"made.{kind.lower()}"
    image.filepath_raw, image.file_format = str(path), kind
    if depth is None:
        image.save()
    else:
        settings = bpy.context.scene.render.image_settings
        if hasattr(settings, "media_type"):
            settings.media_type = "IMAGE"
        settings.file_format, settings.color_mode, settings.color_depth = kind, "RGBA", depth
        bpy.context.scene.view_settings.view_transform = "Standard"
        image.save_render(str(path))
        settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    bpy.data.images.remove(image)
    image = bpy.data.images.load(str(path), check_existing=False)
    if is_float:
        image.colorspace_settings.name = "Linear Rec.709"
    return image


def packed(image):
    image.pack()
    return image


def edited(image):
    """Painted on, and not saved."""
    import numpy

    values = numpy.empty(len(image.pixels), dtype="f4")
    image.pixels.foreach_get(values)
    values[:8] = values[8:16]
    image.pixels.foreach_set(values)
    image.update()
    assert image.is_dirty
    return image


SOURCES = {
    "png": lambda folder: saved(folder, "PNG"),
    "png of 16 bits": lambda folder: saved(folder, "PNG", depth="16"),
    "tga": lambda folder: saved(folder, "TARGA"),
    "exr": lambda folder: saved(folder, "OPEN_EXR", is_float=True),
    "packed png": lambda folder: packed(saved(folder, "PNG")),
    "packed exr": lambda folder: packed(saved(folder, "OPEN_EXR", is_float=True)),
    "bytes in memory": lambda folder: new("Bytes", is_float=False),
    "floats in memory": lambda folder: new("Floats", is_float=True),
    "packed bytes": lambda folder: packed(new("Bytes", is_float=False)),
    "packed floats": lambda folder: packed(new("Floats", is_float=True)),
    "edited png": lambda folder: edited(saved(folder, "PNG")),
    "edited exr": lambda folder: edited(saved(folder, "OPEN_EXR", is_float=True)),
    "edited packed png": lambda folder: edited(packed(saved(folder, "PNG"))),
}


def case(image, outputs, interpolation, extension):
    """A maker of a material that shines with an image at the board's values."""

    def make():
        from beside_cycles import shining

        made, tree, colour = shining(image.name)
        node, place, keep = (tree.nodes.new(kind) for kind in ("ShaderNodeTexImage", "ShaderNodeVertexColor", "ShaderNodeMath"))
        node.image, node.interpolation, node.extension, place.layer_name = image, interpolation, extension, "a"
        tree.links.new(place.outputs[0], node.inputs[0])
        tree.links.new(node.outputs[1 if outputs == ALPHA else 0], colour)
        if outputs == BOTH:
            keep.operation, keep.inputs[1].default_value, keep.inputs[2].default_value = "MULTIPLY_ADD", 0.0, 1.0
            tree.links.new(node.outputs[1], keep.inputs[0])
            tree.links.new(keep.outputs[0], colour.node.inputs["Strength"])
        return made

    return make


@pytest.mark.blender
@pytest.mark.parametrize("source", list(SOURCES))
def test_alpha_modes_are_those_of_cycles(tmp_path, source):
    import bpy
    from beside_cycles import alike, board, both

    bpy.ops.wm.read_factory_settings(use_empty=True)
    cases = {}

    def maker(mode, space, outputs, interpolation, extension):
        def make():
            image = SOURCES[source](tmp_path)
            image.alpha_mode = mode
            if space is not None:
                image.colorspace_settings.name = space
            return case(image, outputs, interpolation, extension)()

        return make

    is_float = SOURCES[source](tmp_path).is_float
    for mode in MODES:
        for outputs, word in ((COLOUR, "colour"), (BOTH, "both"), (ALPHA, "alpha")):
            # What both outputs of bytes show between texels is mixed as light here, as codes in Cycles; so is what has 16 bits.
            linear = "Closest" if outputs == BOTH and not is_float or "16" in source else "Linear"
            cases[f"{mode} {word} {linear}"] = maker(mode, None, outputs, linear, "REPEAT")
            cases[f"{mode} {word} Closest"] = maker(mode, None, outputs, "Closest", "REPEAT")
            cases[f"{mode} {word} data"] = maker(mode, "Non-Color", outputs, "Linear", "REPEAT")
            cases[f"{mode} {word} clip"] = maker(mode, None, outputs, linear, "CLIP")
    board(cases, PLACES)
    # Bytes, and half floats of files.
    alike(both(tmp_path), cases, len(PLACES), tolerance=4e-3)


@pytest.mark.blender
def test_lost_pictures_are_clipped_too(tmp_path):
    import bpy
    from beside_cycles import alike, board, both

    def lost(outputs, interpolation, extension):
        def make():
            image = bpy.data.images.new("Lost", 4, 4)
            image.source, image.filepath = "FILE", str(tmp_path / "nowhere.png")
            return case(image, outputs, interpolation, extension)()

        return make

    cases = {
        f"{extension} {interpolation} {outputs}": lost(outputs, interpolation, extension)
        for extension in ("REPEAT", "EXTEND", "CLIP", "MIRROR")
        for interpolation in ("Linear", "Closest", "Cubic")
        for outputs in (COLOUR, BOTH, ALPHA)
    }
    board(cases, [*PLACES, (-0.6, 1.4, 0)])
    alike(both(tmp_path, lines=("nowhere",)), cases, len(PLACES) + 1)


@pytest.mark.blender
@pytest.mark.parametrize("mode", ["STRAIGHT", "CHANNEL_PACKED"])
def test_worlds_are_hidden_by_alpha_as_in_cycles(tmp_path, mode):
    import bpy
    from beside_cycles import both, scene

    made = scene(16, 8, samples=4)
    lens = made.camera.data
    lens.type = "PANO"
    (lens if hasattr(lens, "panorama_type") else lens.cycles).panorama_type = "EQUIRECTANGULAR"
    # One colour, for bytes are mixed as codes in Cycles.
    image = bpy.data.images.new("Even", 4, 4, alpha=True)
    image.pixels.foreach_set([0.8, 0.5, 0.3, 0.4] * 16)
    image.alpha_mode = mode
    tree = made.world.node_tree
    node = tree.nodes.new("ShaderNodeTexEnvironment")
    node.image = image
    tree.links.new(node.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    cycles, gonio = both(tmp_path, lines=("baked",) if mode == "STRAIGHT" else ())
    # Products are whole bytes in Cycles.
    assert cycles.min() > 0.0 and gonio == pytest.approx(cycles, rel=0.02, abs=1e-3)
