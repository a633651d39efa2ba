"""What heads of files say of pictures is what Blender says once it has decoded them."""

import pytest

# Kind, channels and bits of files that Blender writes.
KINDS = [
    *(("PNG", mode, depth) for mode in ("BW", "RGB", "RGBA") for depth in ("8", "16")),
    *(("JPEG", mode, "8") for mode in ("BW", "RGB")),
    *(("BMP", mode, "8") for mode in ("BW", "RGB")),
    *(("TIFF", mode, depth) for mode in ("BW", "RGB", "RGBA") for depth in ("8", "16")),
    *(("WEBP", mode, "8") for mode in ("RGB", "RGBA")),
    *(("OPEN_EXR", mode, depth) for mode in ("RGB", "RGBA") for depth in ("16", "32")),
    ("HDR", "RGB", "32"),
    ("TARGA", "RGBA", "8"),
]
# Of those nothing has to be decoded.
TOLD = {("PNG", "RGB", "8"), ("PNG", "RGBA", "8"), ("PNG", "BW", "8"), ("JPEG", "RGB", "8"), ("JPEG", "BW", "8")}


def _written(path, kind, mode, depth):
    """A file of 4 × 4 texels."""
    import bpy

    scene = bpy.context.scene
    scene.render.image_settings.file_format = kind
    scene.render.image_settings.color_mode = mode
    if kind in ("PNG", "TIFF", "OPEN_EXR"):
        scene.render.image_settings.color_depth = depth
    made = bpy.data.images.new("made", 4, 4, alpha=mode == "RGBA")
    made.save_render(str(path), scene=scene)
    bpy.data.images.remove(made)


def _png(pixels, depth, *chunks):
    """A PNG of one pixel with more chunks before its data."""
    import struct
    import zlib

    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    channels = {0: 1, 2: 3, 3: 1, 4: 2, 6: 4}[pixels]
    header = chunk(b"IHDR", struct.pack(">IIBBBBB", 1, 1, depth, pixels, 0, 0, 0))
    data = chunk(b"IDAT", zlib.compress(bytes(1 + max(channels * depth // 8, 1))))
    return b"\x89PNG\r\n\x1a\n" + header + b"".join(chunk(*each) for each in chunks) + data + chunk(b"IEND", b"")


def _agrees(path, packed=False):
    """Whether what is said beforehand is what Blender says; and whether it was said without decoding."""
    import bpy
    from recorder import Recorder, module

    images = module("export.images").Images(Recorder(), module("export.slots").Slots())
    image = bpy.data.images.load(str(path))
    if packed:
        image.pack()
    found = images.is_float(image), images.has_alpha(image)
    was_told = not image.has_data
    found = found == (image.is_float, image.depth not in (8, 16, 24, 48, 96)) and image.has_data
    bpy.data.images.remove(image)
    return found, was_told


@pytest.mark.blender
def test_heads_of_blenders_files_tell_what_blender_does(tmp_path):
    from recorder import empty

    empty()
    for kind in KINDS:
        path = tmp_path / f"{'_'.join(kind)}.{kind[0].lower()}"
        _written(path, *kind)
        for packed in (False, True):
            found, was_told = _agrees(path, packed)
            assert found, (kind, packed)
            assert was_told or kind not in TOLD, (kind, packed)


@pytest.mark.blender
def test_palettes_and_transparent_colours_are_told_as_blender_has_them(tmp_path):
    from recorder import empty

    empty()
    palette = (b"PLTE", bytes(3))
    files = {
        "palette": _png(3, 8, palette),
        "palette with alpha": _png(3, 8, palette, (b"tRNS", b"\x80")),
        "few greys": _png(0, 2),
        "a transparent grey": _png(0, 8, (b"tRNS", b"\0\1")),
        "a transparent colour": _png(2, 8, (b"tRNS", b"\0\1\0\1\0\1")),
        "grey and alpha": _png(4, 8),
        "notes before the data": _png(6, 8, (b"tEXt", b"Title\0" + 3000 * b"x")),
    }
    for name, content in files.items():
        path = tmp_path / f"{name}.png"
        path.write_bytes(content)
        assert _agrees(path)[0], name


@pytest.mark.blender
def test_files_that_are_cut_off_or_gone_are_blenders(tmp_path):
    import bpy
    from recorder import Recorder, empty, module

    empty()
    header = module("export.image_header")
    whole = _png(6, 8)
    for length in range(0, len(whole) - 30):
        (tmp_path / "cut.png").write_bytes(whole[:length])
        assert header.header_of_file(tmp_path / "cut.png").has_alpha is None, length
    assert header.header_of_file(tmp_path / "none.png") == header.Header()
    images = module("export.images").Images(Recorder(), module("export.slots").Slots())
    made = bpy.data.images.new("made", 4, 4, alpha=True, float_buffer=True)
    assert images.is_float(made) and images.has_alpha(made)
