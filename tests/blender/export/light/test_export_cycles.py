"""The same small scene in Cycles and in gonio: scale, orientation and place of every kind of lamp, camera and world."""

import pytest

K, WIDTH, HEIGHT, SAMPLES = 177.83, 96, 72, 64

LAMPS = {
    "point": ("POINT", {"shadow_soft_size": 0.0}),
    "soft point": ("POINT", {"shadow_soft_size": 0.3}),
    "ball": ("POINT", {"shadow_soft_size": 0.5, "use_soft_falloff": False, "normalize": False}),
    "warm spot": ("SPOT", {"spot_size": 1.2, "spot_blend": 0.4, "shadow_soft_size": 0.1, "use_temperature": True, "temperature": 3000.0}),
    "sun": ("SUN", {"energy": 3.0, "angle": 0.3}),
    "square": ("AREA", {"shape": "SQUARE", "size": 1.0}),
    "rectangle": ("AREA", {"shape": "RECTANGLE", "size": 2.0, "size_y": 0.4, "spread": 2.0}),
    "ellipse": ("AREA", {"shape": "ELLIPSE", "size": 2.0, "size_y": 0.5, "exposure": 1.0}),
}
CAMERAS = {
    "shifted": {"shift_x": 0.2, "shift_y": -0.1, "sensor_fit": "VERTICAL"},
    "orthographic": {"type": "ORTHO", "ortho_scale": 7.0},
    "equirectangular": {"type": "PANO", "panorama_type": "EQUIRECTANGULAR", "longitude_min": -1.0, "latitude_max": 0.8},
    "equidistant": {"type": "PANO", "panorama_type": "FISHEYE_EQUIDISTANT"},
    "equisolid": {"type": "PANO", "panorama_type": "FISHEYE_EQUISOLID", "fisheye_lens": 10.5},
}


def surface(name, kind="BsdfDiffuse", **inputs):
    """A material of one shader."""
    from recorder import material

    made, tree, end = material(name)
    node = tree.nodes.new(f"ShaderNode{kind}")
    for socket, value in inputs.items():
        node.inputs[socket.replace("_", " ")].default_value = value
    tree.links.new(node.outputs[0], end.inputs["Surface"])
    return made


def stage(**lens):
    """A floor, a smooth ball, a box, a camera."""
    import bpy
    from mathutils import Vector
    from recorder import empty, link

    empty()
    scene = bpy.context.scene
    bpy.ops.mesh.primitive_plane_add(size=10)
    bpy.context.object.data.materials.append(surface("Floor", Color=(0.6, 0.6, 0.6, 1.0)))
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, location=(0, 0, 1))
    bpy.ops.object.shade_smooth()
    bpy.context.object.data.materials.append(surface("Ball", "BsdfPrincipled", Base_Color=(0.8, 0.3, 0.1, 1.0)))
    bpy.ops.mesh.primitive_cube_add(size=1, location=(2, -1, 0.5))
    bpy.context.object.scale = (1, -1, 0.5)
    bpy.context.object.data.materials.append(surface("Box", "BsdfPrincipled", Base_Color=(0.1, 0.3, 0.8, 1.0), Metallic=1.0))
    camera = bpy.data.cameras.new("Camera")
    for name, value in lens.items():
        setattr(camera, name, value)
    scene.camera = link(bpy.data.objects.new("Camera", camera))
    scene.camera.location = (4, -6, 4)
    scene.camera.rotation_euler = (Vector((0, 0, 0.5)) - scene.camera.location).to_track_quat("-Z", "Y").to_euler()
    return scene


def world(scene, strength, picture=None, rotation=(0, 0, 0)):
    """An even world, or a picture turned."""
    import bpy

    made = scene.world = bpy.data.worlds.new("World")
    if bpy.app.version < (5, 0, 0):
        made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    shown, end = tree.nodes.new("ShaderNodeBackground"), tree.nodes.new("ShaderNodeOutputWorld")
    shown.inputs["Strength"].default_value, shown.inputs["Color"].default_value = strength, (0.5, 0.7, 1.0, 1.0)
    tree.links.new(shown.outputs[0], end.inputs["Surface"])
    if picture is not None:
        place, mapping, image = (tree.nodes.new(f"ShaderNode{name}") for name in ("TexCoord", "Mapping", "TexEnvironment"))
        mapping.inputs["Rotation"].default_value, image.image = rotation, picture
        tree.links.new(place.outputs["Generated"], mapping.inputs["Vector"])
        tree.links.new(mapping.outputs[0], image.inputs["Vector"])
        tree.links.new(image.outputs[0], shown.inputs["Color"])


def cycles(scene, path):
    """Cycles' picture, the bottom row first."""
    import bpy
    import numpy as np

    scene.render.engine, settings = "CYCLES", scene.cycles
    settings.samples, settings.use_denoising, settings.use_adaptive_sampling = SAMPLES, False, False
    settings.sample_clamp_indirect = settings.blur_glossy = settings.light_sampling_threshold = 0.0
    settings.pixel_filter_type = "BOX"
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = WIDTH, HEIGHT, 100
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(str(path))
    pixels = np.empty(WIDTH * HEIGHT * 4, dtype=np.float32)
    picture.pixels.foreach_get(pixels)
    return pixels.reshape(HEIGHT, WIDTH, 4)[..., :3]


def ours():
    """Gonio's picture of the same file."""
    import gonio
    import numpy as np
    from recorder import depsgraph, module

    report = module("report").Report()
    exporter, graph = module("export").Exporter(report), depsgraph()
    exported = exporter.sync(graph)
    exporter.settings(graph, width=WIDTH, height=HEIGHT, passes=["color"])
    exported.set(samples=SAMPLES, filter="box", filter_width=1.0)
    with gonio.Render(exported) as render:
        render.wait()
        picture = np.frombuffer(render.film().read("color", scale=1.0 / K, bottom_up=True), dtype=np.float32)
    assert not report.diagnostics
    return picture.reshape(HEIGHT, WIDTH, 4)[..., :3]


def assert_same(scene, path):
    """Means within 1 %, blocks of 12 × 12 pixels within 1 % for the median and 8 % for all but a twentieth."""
    import numpy as np

    reference, found = cycles(scene, path), ours()

    def blocks(picture):
        return picture.reshape(HEIGHT // 12, 12, WIDTH // 12, 12, 3).mean(axis=(1, 3))

    assert found.mean() == pytest.approx(reference.mean(), rel=0.01)
    a, b = blocks(reference), blocks(found)
    difference = np.abs(a - b).max(axis=-1) / np.maximum(a.max(axis=-1), 0.1 * reference.mean())
    assert np.median(difference) < 0.01 and np.percentile(difference, 95) < 0.08, (np.median(difference), np.percentile(difference, 95))


@pytest.mark.blender
@pytest.mark.parametrize("name", LAMPS)
def test_lamps(tmp_path, name):
    import bpy
    from recorder import link

    scene = stage()
    kind, fields = LAMPS[name]
    lamp = bpy.data.lights.new(name, kind)
    for field, value in {"energy": 200.0, **fields}.items():
        setattr(lamp, field, value)
    thing = link(bpy.data.objects.new(name, lamp))
    thing.location, thing.rotation_euler, thing.scale = (-1.5, -1.5, 3.5), (0.35, -0.45, 0.6), (1.0, 0.7, 1.0)
    world(scene, 0.05)
    assert_same(scene, tmp_path / "cycles.exr")


@pytest.mark.blender
@pytest.mark.parametrize("name", CAMERAS)
def test_cameras(tmp_path, name):
    scene = stage(**CAMERAS[name])
    world(scene, 1.0)
    assert_same(scene, tmp_path / "cycles.exr")


@pytest.mark.blender
@pytest.mark.parametrize("rotation", [(0.0, 0.0, 0.0), (0.3, -0.5, 1.1)])
def test_worlds(tmp_path, rotation):
    from test_export_light import gradient_picture

    scene = stage()
    world(scene, 2.0, gradient_picture(), rotation)
    assert_same(scene, tmp_path / "cycles.exr")


@pytest.mark.blender
@pytest.mark.parametrize("kind", ["Generated", "Object", "UV", "bump", "normal map"])
def test_textures(tmp_path, kind):
    import bpy
    from recorder import material

    scene = stage()
    made, tree, end = material("Textured")
    place, mapping, shader, fraction = (
        tree.nodes.new(f"ShaderNode{name}") for name in ("TexCoord", "Mapping", "BsdfPrincipled", "VectorMath")
    )
    mapping.inputs["Rotation"].default_value, mapping.inputs["Scale"].default_value = (0.3, 0.2, 0.5), (1.3, 2.1, 0.7)
    fraction.operation = "FRACTION"
    tree.links.new(place.outputs[kind if kind in place.outputs else "UV"], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs[0], fraction.inputs[0])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    if kind in place.outputs:
        tree.links.new(fraction.outputs[0], shader.inputs["Base Color"])
    elif kind == "bump":
        bump, wave, apart = (tree.nodes.new(f"ShaderNode{name}") for name in ("Bump", "Math", "SeparateXYZ"))
        wave.operation, bump.inputs["Distance"].default_value = "SINE", 0.05
        mapping.inputs["Scale"].default_value = (40.0, 20.0, 1.0)
        tree.links.new(mapping.outputs[0], apart.inputs[0])
        tree.links.new(apart.outputs[0], wave.inputs[0])
        tree.links.new(wave.outputs[0], bump.inputs["Height"])
        tree.links.new(bump.outputs[0], shader.inputs["Normal"])
    else:
        bent = tree.nodes.new("ShaderNodeNormalMap")
        bent.inputs["Strength"].default_value, bent.inputs["Color"].default_value = 0.6, (0.7, 0.55, 0.9, 1.0)
        tree.links.new(bent.outputs[0], shader.inputs["Normal"])
    for thing in bpy.data.objects:
        if thing.type == "MESH":
            thing.data.materials[0] = made
    world(scene, 0.7)
    assert_same(scene, tmp_path / "cycles.exr")
