"""Images of Blender files: sequences, movies, packed tiles, the sides of a box."""

import pytest


def _file(path, colour, kind="PNG"):
    """An image file of 8 × 8 texels."""
    import bpy
    import numpy

    picture = bpy.data.images.new("Made", 8, 8)
    picture.pixels.foreach_set(numpy.tile(numpy.array([*colour, 1.0], dtype=numpy.float32), 64))
    picture.filepath_raw, picture.file_format = str(path), kind
    picture.save()
    bpy.data.images.remove(picture)


def _images(frame):
    from recorder import Recorder, module

    scene, report = Recorder(), module("report").Report()
    images = module("export.images").Images(scene, module("export.slots").Slots())
    images.frame = frame
    return images, scene, report


@pytest.mark.blender
def test_sequences_show_the_frames_picture_without_being_loaded(tmp_path):
    import bpy
    from recorder import empty, material

    empty()
    for number in range(1, 5):
        _file(tmp_path / f"seq.v2_{number:03d}.png", (number / 8, 0, 0))
    image = bpy.data.images.load(str(tmp_path / "seq.v2_001.png"))
    image.source = "SEQUENCE"
    _, tree, _ = material()
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image, user = image, node.image_user
    user.frame_duration, user.frame_start = 4, 3
    for is_cyclic, offset, expected in ((False, 0, [None, 1, 3, 4, 4]), (True, 0, [3, 1, 3, 1, 2]), (False, 1, [1, 2, 4, None, None])):
        user.use_cyclic, user.frame_offset = is_cyclic, offset
        for frame, number in zip((1, 3, 5, 7, 8), expected, strict=True):
            images, scene, report = _images(frame)
            found = images.texture(image, user, report)
            name = f"seq.v2_{number:03d}.png" if number else None
            if name is None:
                assert found is None and "was not found" in report.diagnostics[0].message
            else:
                assert scene.textures[found]["source"] == {"File": str(tmp_path / name)}, (is_cyclic, offset, frame)


@pytest.mark.blender
def test_another_frame_shows_another_picture_in_the_viewport(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link, material, quad

    empty()
    for number in (1, 2):
        _file(tmp_path / f"{number}.png", (number / 8, 0, 0))
    image = bpy.data.images.load(str(tmp_path / "1.png"))
    image.source = "SEQUENCE"
    made, tree, end = material()
    node, light = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeEmission")
    node.image, user = image, node.image_user
    user.frame_duration, user.frame_start, user.use_auto_refresh = 2, 1, True
    tree.links.new(node.outputs[0], light.inputs[0])
    tree.links.new(light.outputs[0], end.inputs["Surface"])
    mesh = quad()
    mesh.materials.append(made)
    link(bpy.data.objects.new("Quad", mesh))
    export, _ = exporter()
    bpy.context.scene.frame_set(1)
    scene = export.sync(depsgraph())
    assert scene.textures[0]["source"] == {"File": str(tmp_path / "1.png")}
    assert not export.update(depsgraph()).anything
    bpy.context.scene.frame_set(2)
    assert export.update(depsgraph()).shading
    [lookup] = [n["operation"]["Image"] for n in scene.materials[-1]["graph"]["nodes"] if "Image" in n["operation"]]
    assert scene.textures[lookup["texture"]]["source"] == {"File": str(tmp_path / "2.png")}


@pytest.mark.blender
def test_sequences_that_only_blender_reads_give_pixels(tmp_path):
    import bpy
    from recorder import empty, material

    empty()
    for number in (1, 2):
        _file(tmp_path / f"frame{number}.tga", (0.25 * number, 0, 0), "TARGA")
    image = bpy.data.images.load(str(tmp_path / "frame1.tga"))
    image.source = "SEQUENCE"
    _, tree, _ = material()
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image, user = image, node.image_user
    user.frame_duration, user.frame_start = 2, 1
    before = len(bpy.data.images)
    images, scene, report = _images(2)
    pixels = scene.textures[images.texture(image, user, report)]["pixels"]
    # 0.5 in sRGB.
    assert pixels[4, 4, 0] == pytest.approx(0.216, abs=3e-3) and not report.diagnostics
    assert len(bpy.data.images) == before


@pytest.mark.blender
def test_what_is_missing_is_named_and_never_fails(tmp_path):
    import bpy
    from recorder import empty, material

    empty()
    (tmp_path / "gone.avi").write_bytes(b"no movie")
    _file(tmp_path / "gone_1.tga", (1, 0, 0), "TARGA")
    movie, sequence = (bpy.data.images.load(str(tmp_path / name)) for name in ("gone.avi", "gone_1.tga"))
    movie.source, sequence.source = "MOVIE", "SEQUENCE"
    _, tree, _ = material()
    user = tree.nodes.new("ShaderNodeTexImage").image_user
    user.frame_duration, user.frame_start = 9, 1
    for image in (movie, sequence):
        images, scene, report = _images(7)
        assert images.texture(image, user, report) is None and not scene.textures
        assert [line.name for line in report.diagnostics] == [image.name]
        assert images.linear(image, report) is None


@pytest.mark.blender
def test_movies_show_the_frames_picture(tmp_path):
    import bpy
    from recorder import empty, material

    if not bpy.app.build_options.codec_ffmpeg:
        import unittest

        raise unittest.SkipTest("this Blender has no FFmpeg")
    empty()
    movie = _movie(tmp_path)
    image = bpy.data.images.load(str(movie))
    assert image.source == "MOVIE"
    _, tree, _ = material()
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image, user = image, node.image_user
    user.frame_duration, user.frame_start = 4, 1
    shown = []
    for frame in (1, 3, 2):
        images, scene, report = _images(frame)
        shown.append(float(scene.textures[images.texture(image, user, report)]["pixels"][4, 4, 0]))
    assert shown == pytest.approx([0.1, 0.3, 0.2], abs=0.03)
    assert not image.is_dirty


def _movie(folder):
    """Four frames whose red is a tenth of their number."""
    import bpy

    scene = bpy.context.scene
    world = bpy.data.worlds.new("Red")
    world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    background, end = tree.nodes.new("ShaderNodeBackground"), tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(background.outputs[0], end.inputs["Surface"])
    for frame in range(1, 5):
        background.inputs[0].default_value = (frame / 10, 0.0, 0.0, 1.0)
        background.inputs[0].keyframe_insert("default_value", frame=frame)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    scene.world, scene.camera, scene.render.engine = world, camera, "CYCLES"
    scene.cycles.samples, scene.view_settings.view_transform = 1, "Standard"
    scene.render.resolution_x = scene.render.resolution_y = 32
    scene.render.resolution_percentage = 100
    scene.frame_start, scene.frame_end = 1, 4
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "VIDEO"
    settings.file_format = "FFMPEG"
    scene.render.ffmpeg.format, scene.render.ffmpeg.codec = "AVI", "FFV1"
    scene.render.filepath = str(folder / "movie.avi")
    bpy.ops.render.render(animation=True)
    return folder / "movie.avi"


@pytest.mark.blender
def test_packed_tiles_go_along(tmp_path):
    import bpy
    from recorder import empty, material

    empty()
    for number in (1001, 1002, 1012):
        _file(tmp_path / f"tile.{number}.png", (number / 2000, 0, 0))
    image = bpy.data.images.load(str(tmp_path / "tile.1001.png"))
    image.source = "TILED"
    for number in (1002, 1012):
        image.tiles.new(number)
    image.filepath = str(tmp_path / "tile.<UDIM>.png")
    _, tree, _ = material()
    user = tree.nodes.new("ShaderNodeTexImage").image_user
    images, scene, report = _images(1)
    assert scene.textures[images.texture(image, user, report)]["source"] == {"File": str(tmp_path / "tile.<UDIM>.png")}
    image.pack()
    name, tiles = scene.textures[images.texture(image, user, report)]["data"]
    assert name == "tile.<UDIM>.png" and sorted(tiles) == [1001, 1002, 1012] and not report.diagnostics
    assert all(bytes(tile[:4]) == b"\x89PNG" for tile in tiles.values())


@pytest.mark.blender
def test_weights_of_a_boxs_sides(tmp_path):
    from gonio.graph import Graph
    from recorder import module

    weights, graph = module("export.material.box_projection")._weights, Graph()

    class Tree:
        pass

    tree = Tree()
    tree.graph = graph
    cases = [
        ((0, 0, 1), 0.0, (0, 0, 1)),
        ((0.6, 0.4, 0.1), 0.0, (1, 0, 0)),
        ((0.5, 0.5, 0), 0.0, (1, 0, 0)),
        ((0.5, 0.5, 0), 0.2, (0.5, 0.5, 0)),
        ((0, 0.55, 0.45), 0.2, (0, 0.75, 0.25)),
        ((0.45, 0, 0.55), 0.2, (0.25, 0, 0.75)),
        ((1, 1, 1), 0.2, (1 / 3, 1 / 3, 1 / 3)),
        ((1, 1, 1), 1.0, (1 / 3, 1 / 3, 1 / 3)),
        ((0.7, 0.2, 0.1), 1.0, (0.7778, 0.2222, 0)),
    ]
    for normal, blend, expected in cases:
        found = [weight.constant[0] for weight in weights(tree, [graph.scalar(x) for x in normal], blend)]
        if blend < 1.0 or normal == (1, 1, 1):
            assert found == pytest.approx(expected, abs=1e-4), (normal, blend)
        assert sum(found) == pytest.approx(1.0), (normal, blend)


@pytest.mark.blender(seconds=240)
@pytest.mark.parametrize(("form", "blend"), [("ball", 0.0), ("ball", 0.4), ("turned cube", 0.2)])
def test_a_box_looks_as_in_cycles(tmp_path, form, blend):
    import bpy
    import numpy
    from scenes import empty, read, render

    scene = empty(width=48, height=48, samples=128)
    picture = bpy.data.images.new("Quarters", 8, 8, float_buffer=form == "ball")
    pixels = numpy.ones((8, 8, 4), dtype=numpy.float32)
    pixels[:4, :4, :3], pixels[:4, 4:, :3], pixels[4:, :4, :3] = (1, 0, 0), (0, 1, 0), (0, 0, 1)
    picture.pixels.foreach_set(pixels.ravel())
    if form == "ball":
        bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16, radius=1.0)
        bpy.ops.object.shade_smooth()
    else:
        # Bytes, and a box along the object's own axes.
        picture.pack()
        bpy.ops.mesh.primitive_cube_add(size=1.6, rotation=(0.3, 0.5, 0.9))
    sphere = bpy.data.materials.new("Box")
    sphere.use_nodes = True
    tree = sphere.node_tree
    tree.nodes.clear()
    place, image, light, end = (tree.nodes.new(f"ShaderNode{each}") for each in ("TexCoord", "TexImage", "Emission", "OutputMaterial"))
    image.image, image.projection, image.projection_blend, image.interpolation = picture, "BOX", blend, "Closest"
    tree.links.new(place.outputs["Generated" if form == "ball" else "Object"], image.inputs["Vector"])
    tree.links.new(image.outputs["Color"], light.inputs["Color"])
    tree.links.new(light.outputs[0], end.inputs["Surface"])
    bpy.context.object.data.materials.append(sphere)
    bpy.ops.object.camera_add(location=(4, -5, 3.5))
    scene.camera = bpy.context.object
    scene.camera.rotation_euler = (-scene.camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.cycles.samples, scene.cycles.use_denoising = 128, False
    seen = {}
    for engine in ("GONIO", "CYCLES"):
        scene.render.engine = engine
        render(tmp_path / f"{engine}.exr")
        channels = read(tmp_path / f"{engine}.exr")
        seen[engine] = numpy.stack([next(v for k, v in channels.items() if k.endswith(f"Combined.{c}")) for c in "RGB"], axis=-1)
    ball = seen["CYCLES"].max(axis=-1) > 0.05
    assert 200 < ball.sum() < 2000
    difference = numpy.abs(seen["GONIO"] - seen["CYCLES"])[ball]
    # Edges between colours differ by their noise.
    assert numpy.median(difference) < 0.01 and difference.mean() < 0.05, (numpy.median(difference), difference.mean())


@pytest.mark.blender
@pytest.mark.parametrize(("is_packed", "lost"), [(False, 0), (True, 0), (False, 1012), (True, 1002)])
def test_tiles_lie_side_by_side_as_in_cycles(tmp_path, is_packed, lost):
    """A tile that is not there has the colour of missing images."""
    import bpy
    import numpy
    from beside_cycles import both, close, scene, shining
    from recorder import link

    made = scene(8, 8, scale=2.0)
    colours = {1001: (0.9, 0.4, 0.1), 1002: (0.1, 0.6, 0.6), 1011: (0.2, 0.2, 0.8), 1012: (0.8, 0.8, 0.1)}
    colours.pop(lost, None)
    for number, colour in colours.items():
        _file(tmp_path / f"tile.{number}.png", colour)
    image = bpy.data.images.load(str(tmp_path / "tile.1001.png"))
    image.source = "TILED"
    for number in list(colours)[1:]:
        image.tiles.new(number)
    image.filepath = str(tmp_path / "tile.<UDIM>.png")
    if is_packed:
        image.pack()
        for number in colours:
            (tmp_path / f"tile.{number}.png").unlink()
    mesh = bpy.data.meshes.new("Quad")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new(name="Map").uv.foreach_set("vector", [0, 0, 2, 0, 2, 2, 0, 2])
    material, tree, colour = shining()
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image, texture.interpolation = image, "Closest"
    tree.links.new(texture.outputs["Color"], colour)
    mesh.materials.append(material)
    link(bpy.data.objects.new("Quad", mesh))
    made.cycles.samples = 4
    pair = both(tmp_path)
    assert len(numpy.unique(pair[0].round(2).reshape(-1, 3), axis=0)) == 4
    close(pair)
