"""Cryptomattes of Blender's objects: as Cycles', and as Blender's own node reads them."""

import pytest

SIZE = 64
LAYER = "ViewLayer"


def scene_of_sheets(samples=64):
    """Three slanted sheets one over the other, seen from above; two of them hang on an empty."""
    import bpy
    import scenes

    scene = scenes.empty(width=SIZE, height=SIZE, samples=samples)
    scene.render.film_transparent = True
    bpy.ops.object.empty_add()
    parent = bpy.context.object
    parent.name = "Parent"
    materials = [scenes.diffuse(name, (0.5, 0.5, 0.5)) for name in ("Stone", "Paint")]
    for number, (name, material) in enumerate((("Floor", 0), ("Größe", 1), ("Wire", 1))):
        place, turn = (0.1 * number, -0.15 * number, 0.3 * number), (0, 0, 0.4 * number)
        bpy.ops.mesh.primitive_plane_add(size=1.6 - 0.5 * number, location=place, rotation=turn)
        thing = bpy.context.object
        thing.name = name
        thing.data.materials.append(materials[material])
        if number:
            thing.parent = parent
    bpy.ops.object.camera_add(location=(0, 0, 5), rotation=(0, 0, 0))
    scene.camera = bpy.context.object
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 2.0
    layer = scene.view_layers[0]
    for kind in ("object", "material", "asset"):
        setattr(layer, f"use_pass_cryptomatte_{kind}", True)
    layer.pass_cryptomatte_depth = 4
    return scene


def mattes(path, are_ids=True):
    """By the matte's name, the coverage of each name in its manifest."""
    import bpy
    import numpy
    import scenes

    bpy.utils.expose_bundled_modules()
    import OpenImageIO
    from cryptomatte_reader import checked_manifests, coverage

    image = OpenImageIO.ImageBuf(str(path))
    texts = {attribute.name: attribute.value for attribute in image.spec().extra_attribs if isinstance(attribute.value, str)}
    channels = scenes.read(path)
    found = {}
    for matte, names in checked_manifests(texts, are_ids).items():
        count = sum(channel.startswith(matte) and channel.lower().endswith(".r") for channel in channels)
        by_letter = {channel.lower(): pixels for channel, pixels in channels.items()}
        layers = [numpy.stack([by_letter[f"{matte}{number:02}.{c}".lower()] for c in "rgba"], axis=-1) for number in range(count)]
        assert len(layers) == 2
        found[matte] = {name: coverage(layers, wanted) for name, wanted in names.items()}
    return found


def scene_of_things(samples=64):
    """A curve, a text, and two instances of a collection of a cube and a ball, seen from above before nothing."""
    import bpy
    import scenes

    scene = scene_of_sheets(samples)
    for thing in [each for each in scene.objects if each.type in ("MESH", "EMPTY")]:
        bpy.data.objects.remove(thing)
    paint, stone = bpy.data.materials["Paint"], scenes.diffuse("Marble", (0.9, 0.9, 0.9))
    bpy.ops.curve.primitive_bezier_circle_add(radius=0.7)
    bpy.context.object.name, bpy.context.object.data.bevel_depth = "Ring", 0.1
    bpy.context.object.data.materials.append(paint)
    bpy.ops.object.text_add(location=(-0.6, -0.9, 0.2))
    bpy.context.object.name, bpy.context.object.data.size = "Text", 0.5
    bpy.context.object.data.materials.append(stone)
    inside = bpy.data.collections.new("Inside")
    for name, add, x in (("Cube", bpy.ops.mesh.primitive_cube_add, 0.0), ("Ball", bpy.ops.mesh.primitive_ico_sphere_add, 0.3)):
        add(location=(x, 0.1, 0.0), scale=(0.15, 0.15, 0.15))
        thing = bpy.context.object
        thing.name = name
        thing.data.materials.append(stone if name == "Cube" else paint)
        scene.collection.objects.unlink(thing)
        inside.objects.link(thing)
    for number in range(2):
        holder = bpy.data.objects.new(f"Holder {number}", None)
        holder.instance_type, holder.instance_collection = "COLLECTION", inside
        holder.location, holder.rotation_euler = (0.7 * number - 0.5, 0.4 - 0.5 * number, 0.5), (0, 0, 0.4 + number)
        scene.collection.objects.link(holder)
    return scene


SCENES = {"sheets": scene_of_sheets, "things": scene_of_things}


@pytest.mark.blender
@pytest.mark.parametrize("kind", list(SCENES))
def test_mattes_are_those_of_cycles(tmp_path, kind):
    import scenes

    scene = SCENES[kind]()
    scene.gonio.pixel_filter_type, scene.gonio.filter_width = "BLACKMAN_HARRIS", 1.5
    scenes.render(tmp_path / "gonio.exr")
    mine = mattes(tmp_path / "gonio.exr")
    assert set(mine) == {f"{LAYER}.{name}" for name in ("CryptoObject", "CryptoMaterial", "CryptoAsset")}
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 64, False
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BLACKMAN_HARRIS", 1.5
    scenes.render(tmp_path / "cycles.exr")
    theirs = mattes(tmp_path / "cycles.exr", are_ids=False)
    assert set(mine) == set(theirs)
    for matte, covers in mine.items():
        for name, cover in covers.items():
            other = theirs[matte].get(name)
            if other is None:
                # Cycles lists what shows nothing, and so may we: never what shows.
                assert cover.max() == 0.0, (matte, name)
                continue
            assert abs(cover - other).max() < 0.25 and abs(cover - other).mean() < 0.004, (matte, name)
    wanted = {"sheets": {"CryptoAsset": "Parent", "CryptoObject": "Größe"}, "things": {"CryptoMaterial": "Marble", "CryptoObject": "Ring"}}
    assert all(mine[f"{LAYER}.{matte}"][name].max() == 1.0 for matte, name in wanted[kind].items())


DATA = ("z", "mist", "position", "normal", "vector", "uv", "object_index", "material_index")
# The same on both sides of Blender 5.0.
COLOURS = (".R", ".G", ".B", ".A")


def saved(path, codec, depth):
    """The last render's channels from a multilayer file, those of colours left out."""
    import importlib

    import bpy
    import scenes

    settings = bpy.context.scene.render.image_settings
    importlib.import_module("gonio_extension.compat").use_multilayer_exr(settings)
    settings.exr_codec, settings.color_depth = codec, depth
    bpy.data.images["Render Result"].save_render(str(path))
    channels = scenes.read(path)
    # Coverage of a pass of coordinates is data too.
    return {name: values for name, values in channels.items() if not name.endswith(COLOURS) or ".UV." in name}


@pytest.mark.blender
def test_names_and_data_keep_their_bits_in_every_file(tmp_path):
    import bpy
    import numpy

    scene = scene_of_sheets(samples=8)
    for switch in DATA:
        setattr(scene.view_layers[0], f"use_pass_{switch}", True)
    # No half float.
    bpy.data.objects["Floor"].pass_index = bpy.data.materials["Paint"].pass_index = 4097
    whole, lost = {}, {}
    for engine in ("CYCLES", "GONIO"):
        scene.render.engine, scene.cycles.samples = engine, 1
        bpy.ops.render.render()
        whole[engine] = saved(tmp_path / f"{engine}.exr", "ZIP", "32")
        for codec, depth in (("ZIP", "16"), ("DWAA", "32"), ("DWAA", "16"), ("DWAB", "16"), ("B44", "16")):
            found = saved(tmp_path / f"{engine}{codec}{depth}.exr", codec, depth)
            assert found.keys() == whole[engine].keys()
            same = {name: numpy.array_equal(found[name].view("u4"), values.view("u4")) for name, values in whole[engine].items()}
            lost[engine, codec, depth] = {name for name in same if not same[name]}
    found = whole["GONIO"]
    # Every channel by the letter that Cycles gives it.
    assert found.keys() == whole["CYCLES"].keys() and sum("Crypto" in name for name in found) == 24 and len(found) > 40
    assert any(values.max() == 4097 for name, values in found.items() if "Ob" in name or "OB" in name)
    for (engine, *file), names in lost.items():
        # DWA takes a Y for luminance, whoever writes it.
        assert all(name.endswith(".Y") and file[0].startswith("DWA") for name in names) and names <= lost["CYCLES", *file], (engine, file, names)


def matte_node(scene, kind, name, picture=None):
    """A compositor that shows the matte of one name, from the render or from a picture."""
    import importlib

    compat = importlib.import_module("gonio_extension.compat")
    tree = compat.compositor_tree(scene)
    node = tree.nodes.new("CompositorNodeCryptomatteV2")
    if picture is not None:
        node.source, node.image = "IMAGE", picture
    node.layer_name = f"{LAYER}.{kind}" if picture is None else kind
    node.matte_id = name
    output = compat.compositor_output(tree)
    if output is None:
        output = tree.nodes.new("CompositorNodeComposite").inputs[0]
    tree.links.new(node.outputs["Matte"], output)
    scene.render.use_compositing = True


def composited(path):
    """The composited picture's first channel, rows from the top."""
    import bpy
    import scenes

    settings = bpy.context.scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    bpy.context.scene.render.filepath = str(path)
    assert bpy.ops.render.render(write_still=True) == {"FINISHED"}
    return scenes.read(path)["R"]


@pytest.mark.blender
@pytest.mark.parametrize(("kind", "name"), [("CryptoObject", "Größe"), ("CryptoMaterial", "Paint"), ("CryptoAsset", "Parent")])
def test_blenders_node_pulls_the_matte_of_a_render(tmp_path, kind, name):
    import scenes

    scene = scene_of_sheets(samples=16)
    scenes.render(tmp_path / "mattes.exr")
    expected = mattes(tmp_path / "mattes.exr")[f"{LAYER}.{kind}"][name]
    matte_node(scene, kind, name)
    found = composited(tmp_path / "matte.exr")
    assert expected.max() == 1.0 and abs(found - expected).max() <= 1 / 255


@pytest.mark.blender
def test_blenders_node_pulls_the_matte_of_a_file_of_gonio(tmp_path):
    import bpy
    import gonio
    import numpy
    import scenes

    from cryptomatte_reader import coverage, identifier
    from matte_sheets import sheets

    with gonio.Render(sheets()) as render:
        assert render.wait()
        film = render.film()
    film.write_exr(tmp_path / "mattes.exr")
    expected = coverage([numpy.asarray(film[f"CryptoObject{n:02}"]) for n in range(3)], identifier("/World/wire"))
    scene = scenes.empty(width=64, height=48, samples=1)
    bpy.ops.object.camera_add()
    scene.camera = bpy.context.object
    matte_node(scene, "CryptoObject", "/World/wire", bpy.data.images.load(str(tmp_path / "mattes.exr")))
    found = composited(tmp_path / "matte.exr")
    assert expected.max() > 0.8 and abs(found - expected).max() <= 1 / 255


def occlusion(path):
    """The Ambient Occlusion pass of a render (height, width)."""
    import bpy
    import scenes

    scenes.render(path)
    return scenes.read(path)[f"{LAYER}.{'Ambient Occlusion' if bpy.app.version >= (5, 0, 0) else 'AO'}.R"]


@pytest.mark.blender
@pytest.mark.parametrize("distance", [0.3, 10.0])
def test_occlusion_is_that_of_cycles(tmp_path, distance):
    import bpy
    import scenes

    scene = scenes.empty(width=32, height=32, samples=256)
    bpy.ops.mesh.primitive_plane_add(size=10.0)
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=(-0.8, 0, 0.5))
    bpy.ops.mesh.primitive_torus_add(location=(1.0, 0, 0.4), major_radius=0.6, minor_radius=0.2)
    bpy.ops.object.camera_add(location=(0, -3, 4), rotation=(0.6435, 0, 0))
    scene.camera = bpy.context.object
    scene.world.light_settings.distance = distance
    scene.view_layers[0].use_pass_ambient_occlusion = True
    mine = occlusion(tmp_path / "gonio.exr")
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 256, False
    theirs = occlusion(tmp_path / "cycles.exr")
    apart = abs((mine - theirs).reshape(8, 4, 8, 4).mean(axis=(1, 3)))
    assert theirs.min() < 0.6 and apart.max() < 0.04 and abs(mine.mean() - theirs.mean()) < 0.005, (apart.max(), mine.mean(), theirs.mean())


@pytest.mark.blender
def test_passes_of_occlusion_catchers_and_time(tmp_path):
    import bpy
    import scenes

    scene = scenes.empty(width=32, height=32, samples=16)
    bpy.ops.mesh.primitive_plane_add(size=10.0)
    bpy.context.object.is_shadow_catcher = True
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=(0, 0, 0.5))
    bpy.ops.object.light_add(type="SUN", rotation=(0.6, 0.3, 0.0))
    bpy.ops.object.camera_add(location=(0, 0, 8), rotation=(0, 0, 0))
    scene.camera = bpy.context.object
    layer = scene.view_layers[0]
    layer.use_pass_ambient_occlusion = layer.cycles.use_pass_shadow_catcher = True
    timed = hasattr(layer.cycles, "pass_render_time")
    if timed:
        layer.cycles.pass_render_time = True
    scenes.render(tmp_path / "passes.exr")
    channels = scenes.read(tmp_path / "passes.exr")
    occlusion = channels[f"{LAYER}.{'Ambient Occlusion' if bpy.app.version >= (5, 0, 0) else 'AO'}.R"]
    shadow = channels[f"{LAYER}.Shadow Catcher.G"]
    assert 0.0 < occlusion[16, 16] <= 1.0
    assert shadow.min() < 0.1 and shadow[0, 0] == pytest.approx(1.0, abs=0.05)
    if timed:
        assert (channels[f"{LAYER}.Render Time.X"] >= 0.0).all() and channels[f"{LAYER}.Render Time.X"].max() > 0.0
