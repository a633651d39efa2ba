"""What files contain in spite of everything: a message and a picture, never a crash."""

import importlib

import pytest


def told():
    """The lines of the report that the panel shows, and of the last final render."""
    return [(line.kind, line.name) for line in importlib.import_module("gonio_extension.report").latest().diagnostics]


def picture(tmp_path, width=32, height=32, samples=4):
    """Renders the open file and gives its Combined pass as (rows, columns, 3); all numbers are finite."""
    import bpy
    import numpy
    import scenes

    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y, scene.gonio.samples = width, height, samples
    scenes.render(tmp_path / "picture.exr")
    channels = scenes.read(tmp_path / "picture.exr")
    found = numpy.stack([next(values for name, values in channels.items() if name.endswith(f"Combined.{c}")) for c in "RGB"], axis=-1)
    assert found.shape == (height, width, 3) and numpy.isfinite(found).all()
    return found


def textured(thing, image, kind="ShaderNodeTexImage"):
    """Gives an object a material of an emission that shows an image."""
    import bpy

    material = bpy.data.materials.new(thing.name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    texture, shader, output = (tree.nodes.new(name) for name in (kind, "ShaderNodeEmission", "ShaderNodeOutputMaterial"))
    texture.image = image
    tree.links.new(texture.outputs[0], shader.inputs[0])
    tree.links.new(shader.outputs[0], output.inputs[0])
    thing.data.materials.append(material)
    return material


def broken_image(path, content):
    """An image whose file holds these bytes, or none for None."""
    import bpy

    picture = bpy.data.images.new(path.stem, 2, 2)
    picture.filepath_raw, picture.file_format = str(path), "PNG"
    picture.save()
    loaded = bpy.data.images.load(str(path))
    if content is None:
        path.unlink()
    else:
        path.write_bytes(content)
    return loaded


@pytest.mark.blender
def test_images_that_are_missing_or_broken(tmp_path):
    import bpy
    import scenes

    scene = scenes.lit_floor()
    floor = bpy.data.objects["Floor"]
    for name, content in (("gone", None), ("empty", b""), ("cut", b"\x89PNG\r\n\x1a\n\x00\x00"), ("noise", b"\x00\xff" * 99)):
        floor.data.materials.clear()
        textured(floor, broken_image(tmp_path / f"{name}.png", content))
        picture(tmp_path)
        assert told(), name
    floor.data.materials.clear()
    textured(floor, None)
    picture(tmp_path)
    tree = scene.world.node_tree
    sky = tree.nodes.new("ShaderNodeTexEnvironment")
    sky.image = broken_image(tmp_path / "sky.png", None)
    tree.links.new(sky.outputs[0], tree.nodes["Background"].inputs[0])
    picture(tmp_path)
    assert told()


@pytest.mark.blender
def test_names_in_any_script(tmp_path):
    import bpy
    import scenes

    names = ("地板", "أرضية", "Пол", "床🎥👩🏽‍🚀", "é" * 20, "tab\tnew\nline", "../../x", "%s{0}\\")
    for name in names:
        scene = scenes.lit_floor()
        floor = bpy.data.objects["Floor"]
        folder = tmp_path / "".join(letter for letter in name if letter.isalnum() or ord(letter) > 127)
        folder.mkdir(exist_ok=True)
        file = folder / f"{folder.name[:20]}.png"
        image = bpy.data.images.new(name, 2, 2)
        image.filepath_raw, image.file_format = str(file), "PNG"
        image.pixels.foreach_set([1.0, 0.0, 0.0, 1.0] * 4)
        image.save()
        image.source, image.filepath = "FILE", str(file)
        floor.data.materials.clear()
        material = textured(floor, image)
        for block in (floor, floor.data, material, scene, scene.world, scene.camera, scene.camera.data, bpy.context.view_layer):
            block.name = name
        floor.data.uv_layers[0].name = name
        attribute = floor.data.attributes.new(name, "FLOAT", "FACE")
        node = material.node_tree.nodes.new("ShaderNodeAttribute")
        node.name, node.attribute_name = name, attribute.name
        lost = material.node_tree.nodes.new("ShaderNodeScript")
        lost.name = name
        found = picture(tmp_path)
        assert found[..., 0].min() > 0.9 and found[..., 1].max() < 0.01, name


@pytest.mark.blender
def test_transforms_that_no_picture_can_show(tmp_path):
    import bpy
    import scenes

    scenes.lit_floor()
    floor = bpy.data.objects["Floor"]
    nan, huge = float("nan"), 1e38
    bad = [{"location": (nan, 0, 0)}, {"scale": (0, 0, 0)}, {"scale": (1, 0, 1)}, {"scale": (nan, 1, 1)}, {"location": (huge, huge, huge)}]
    bad += [{"rotation_euler": (float("inf"), 0, 0)}, {"scale": (huge, huge, huge)}, {"scale": (1e-30, 1e-30, 1e-30)}]
    for number, values in enumerate(bad):
        for kind, data in (("Thing", floor.data), ("Lamp", bpy.data.objects["Lamp"].data), ("Sun", bpy.data.lights.new("Sun", "SUN"))):
            thing = bpy.data.objects.new(f"{kind} {number}", data)
            bpy.context.scene.collection.objects.link(thing)
            for name, value in values.items():
                setattr(thing, name, value)
    assert picture(tmp_path).max() > 0.0
    assert {("Object", "Thing 0"), ("Object", "Thing 1"), ("Object", "Lamp 0")} <= set(told())


@pytest.mark.blender
def test_cameras_that_see_nothing(tmp_path):
    import bpy
    import scenes

    for values in ({"location": (float("nan"), 0, 0)}, {"scale": (0, 0, 0)}, {"location": (1e38, 0, 0)}):
        scene = scenes.lit_floor()
        for name, value in values.items():
            setattr(scene.camera, name, value)
        try:
            picture(tmp_path)
        except RuntimeError as problem:
            assert "camera" in str(problem).lower(), problem
    scene = scenes.lit_floor()
    bpy.data.objects.remove(scene.camera)
    try:
        picture(tmp_path)
        raise AssertionError("a picture without a camera")
    except RuntimeError as problem:
        assert "camera" in str(problem).lower(), problem


@pytest.mark.blender
def test_meshes_with_little_or_wrong_in_them(tmp_path):
    import bpy
    import scenes

    scenes.lit_floor()
    bpy.data.objects["Floor"].data.materials.clear()

    def add(name, points, edges, faces, index=0):
        mesh = bpy.data.meshes.new(name)
        mesh.from_pydata(points, edges, faces)
        bpy.context.scene.collection.objects.link(bpy.data.objects.new(name, mesh))
        mesh.polygons.foreach_set("material_index", [index] * len(faces))
        return mesh

    nan = float("nan")
    corners = [(0, 0, 0.1), (0.01, 0, 0.1), (0, 0.01, 0.1)]
    add("Empty", [], [], [])
    add("Points", corners, [], [])
    add("Edges", corners, [(0, 1)], [])
    add("No area", [corners[0]] * 3, [], [(0, 1, 2)])
    add("Not a number", [(nan, nan, nan), *corners[1:]], [], [(0, 1, 2)])
    add("Far", [(1e38, 1e38, 1e38), *corners[1:]], [], [(0, 1, 2)])
    add("Slot", corners, [], [(0, 1, 2)], 30_000)
    add("Nothing in the slot", corners, [], [(0, 1, 2)]).materials.append(None)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Letters", bpy.data.curves.new("Letters", "FONT")))
    assert picture(tmp_path).max() > 0.0


# Blender's own triangulation, which grows faster than the points, takes a minute or more.
@pytest.mark.validate
@pytest.mark.blender(seconds=1200)
def test_a_polygon_of_a_million_points(tmp_path):
    import bpy
    import numpy
    import scenes

    scenes.lit_floor()
    bpy.data.objects.remove(bpy.data.objects["Floor"])
    count = 1_000_000
    angles = numpy.arange(count) / count * 2.0 * numpy.pi
    mesh = bpy.data.meshes.new("Disk")
    mesh.vertices.add(count)
    mesh.loops.add(count)
    mesh.polygons.add(1)
    points = numpy.stack([numpy.cos(angles), numpy.sin(angles), 0.0 * angles], axis=1).astype(numpy.float32)
    mesh.vertices.foreach_set("co", points.ravel())
    mesh.loops.foreach_set("vertex_index", numpy.arange(count, dtype=numpy.int32))
    mesh.polygons.foreach_set("loop_start", [0])
    mesh.update(calc_edges=True)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("Disk", mesh))
    assert picture(tmp_path).min() > 0.0


@pytest.mark.blender
def test_nodes_in_a_row_and_in_a_ring(tmp_path):
    import bpy
    import scenes

    scenes.lit_floor()
    tree = bpy.data.objects["Floor"].data.materials[0].node_tree
    shader = next(node for node in tree.nodes if node.bl_idname == "ShaderNodeBsdfDiffuse")
    before = tree.nodes.new("ShaderNodeNewGeometry").outputs["Position"]
    for _ in range(300):
        node = tree.nodes.new("ShaderNodeMath")
        tree.links.new(before, node.inputs[0])
        before = node.outputs[0]
    tree.links.new(before, shader.inputs["Roughness"])
    picture(tmp_path)
    assert not told()
    # Blender takes the time of all links to add one, so that a longer row cannot be made here.
    translator = importlib.import_module("gonio_extension.export.material.translator")
    usual, translator.DEEPEST = translator.DEEPEST, 100
    picture(tmp_path)
    translator.DEEPEST = usual
    # What stands in for the row's beginning makes a roughness above 1, which is told too.
    assert [kind for kind, _ in told()] == ["Material", "Render"]
    ring = [tree.nodes.new("ShaderNodeMixShader") for _ in range(2)]
    for a, b in (ring, ring[::-1]):
        tree.links.new(a.outputs[0], b.inputs[1])
    tree.links.new(ring[0].outputs[0], next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL").inputs[0])
    picture(tmp_path)


@pytest.mark.blender
def test_data_deleted_while_the_viewport_renders(tmp_path):
    import bpy
    import scenes
    from mathutils import Matrix
    from viewport import Viewport

    scene = scenes.lit_floor()
    scene.gonio.preview_samples, scene.gonio.max_bounces = 4, 4
    floor = bpy.data.objects["Floor"]
    image = bpy.data.images.new("Image", 4, 4)
    material = textured(floor, image)
    view = Viewport(Matrix.Translation((0, 0, 5)))
    view.draw()
    blocks = (image, material, floor.data.materials[0], scene.camera, bpy.data.objects["Lamp"].data, scene.world, floor.data)
    for block in blocks:
        # In the midst of the render of what was there before.
        bpy.data.batch_remove([block])
        bpy.context.view_layer.update()
        for _ in range(3):
            assert view.draw() is not None
    bpy.ops.mesh.primitive_cube_add()
    for _ in range(3):
        view.draw()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    view.session.close()
