"""Lamps and worlds by Cycles' laws."""

import pytest

K = 177.83


@pytest.mark.blender
def test_laws_of_lamps(tmp_path):
    from math import pi, radians, sin

    import bpy
    from recorder import depsgraph, empty, exporter, link

    empty()

    def lamp(kind, **fields):
        made = bpy.data.lights.new(kind, kind)
        made.energy = 100.0
        for name, value in fields.items():
            setattr(made, name, value)
        thing = link(bpy.data.objects.new(f"{len(expected)}", made))
        thing.scale = (2.0, 1.0, 1.0)
        return thing

    expected = []

    def case(form, radiance, kind, **fields):
        expected.append((form, radiance, lamp(kind, **fields)))

    soft, hard = {"use_soft_falloff": True}, {"use_soft_falloff": False}
    case("Point", 100 / (4 * pi), "POINT", shadow_soft_size=0.0)
    case({"Sphere": {"radius": 0.5}}, 100 / (4 * pi * pi * 0.25), "POINT", shadow_soft_size=0.5, **hard)
    case(
        {"FacingDisk": {"radius": 0.5}},
        100 / (4 * pi * pi * 0.25),
        "SPOT",
        shadow_soft_size=0.5,
        spot_size=radians(60),
        spot_blend=0.25,
        **soft,
    )
    case({"Sphere": {"radius": 0.5}}, 100 / pi, "POINT", shadow_soft_size=0.5, normalize=False, **hard)
    case({"Distant": {"angle_deg": 0.0}}, 100.0, "SUN", angle=0.0)
    case({"Distant": {"angle_deg": 10.0}}, 100 / (pi * sin(radians(5)) ** 2), "SUN", angle=radians(10))
    case({"Rectangle": {"width": 0.5, "height": 0.5}}, 100 / (pi * 0.5), "AREA", shape="SQUARE", size=0.5)
    case({"Rectangle": {"width": 0.5, "height": 0.25}}, 100 / pi, "AREA", shape="RECTANGLE", size=0.5, size_y=0.25, normalize=False)
    case({"Ellipse": {"width": 0.5, "height": 0.5}}, 100 / (pi * 0.5 * pi / 4), "AREA", shape="DISK", size=0.5, spread=radians(40))
    case("Point", 100 / (4 * pi) * 4, "POINT", shadow_soft_size=0.0, exposure=2.0)
    exported, report = exporter()
    lights = {light["origin"]["name"]: light for light in exported.sync(depsgraph()).lights}
    for shape, radiance, thing in expected:
        light = lights[thing.name]
        found, wanted = light["shape"], shape
        if isinstance(wanted, dict):
            ((kind, fields),) = wanted.items()
            assert found[kind] == pytest.approx(fields, rel=1e-5), thing.name
        else:
            assert found == wanted
        assert light["emission"]["radiance"][0] == pytest.approx(radiance * K, rel=1e-5), (thing.name, shape)
        # A lamp is seen by the camera only if the user switched that on.
        assert light["visibility"]["camera"] is thing.visible_camera
    spot = lights["2"]["spot"]
    assert (spot["angle_deg"], spot["blend"], spot["stretch"]) == (pytest.approx(60.0, rel=1e-5), 0.25, [2.0, 1.0])
    assert lights["8"]["spread_deg"] == pytest.approx(40.0, rel=1e-5) and not report.diagnostics


@pytest.mark.blender
def test_temperature_and_nodes_of_lamps(tmp_path):
    from array import array

    import bpy
    from gonio.graph import compute
    from recorder import depsgraph, empty, exporter, link

    empty()
    warm = bpy.data.lights.new("Warm", "SUN")
    warm.use_temperature, warm.temperature, warm.angle, warm.energy = True, 3000.0, 0.0, 1.0
    link(bpy.data.objects.new("Warm", warm))
    noded = bpy.data.lights.new("Noded", "SUN")
    noded.energy, noded.angle, noded.use_nodes = 2.0, 0.0, True
    emission = next(node for node in noded.node_tree.nodes if node.bl_idname == "ShaderNodeEmission")
    emission.inputs["Color"].default_value, emission.inputs["Strength"].default_value = (1.0, 0.5, 0.25, 1.0), 3.0
    link(bpy.data.objects.new("Noded", noded))
    exported, _ = exporter()
    radiance = {light["origin"]["name"]: light["emission"]["radiance"] for light in exported.sync(depsgraph()).lights}
    assert [x / K for x in radiance["Warm"]] == pytest.approx([1.7708, 0.8443, 0.2722], abs=1e-3)
    assert [x / K for x in radiance["Noded"]] == pytest.approx([6.0, 3.0, 1.5], rel=1e-5)
    for kelvin in range(500, 13000, 137):
        warm.temperature = kelvin
        if kelvin >= 800:
            colour = memoryview(compute("Blackbody", [array("f", [kelvin] * 4)])).tolist()[0][:3]
            assert colour == pytest.approx(list(warm.temperature_color), abs=4e-3)


def world_of(build):
    """Domes of a world whose tree `build` fills; it gets the tree and returns the socket that goes to the output."""
    import bpy
    from recorder import Recorder, module

    world = bpy.data.worlds.new("World")
    if bpy.app.version < (5, 0, 0):
        world.use_nodes = True
    tree = world.node_tree
    tree.nodes.clear()
    tree.links.new(build(tree), tree.nodes.new("ShaderNodeOutputWorld").inputs["Surface"])
    scene, report = Recorder(), module("report").Report()
    images = module("export.images").Images(scene, module("export.slots").Slots())
    return module("export.world").domes(world, images, report)[0], scene, report


def looked_up(dome, pixels, direction):
    """What a dome shows in a direction, by the OpenEXR convention: +Y up, +Z in the middle, longitude growing to the left."""
    import numpy as np

    axes = np.array(dome["transform"]["columns"][:3])
    x, y, z = np.linalg.solve(axes.T, np.array(direction, dtype=float) / np.linalg.norm(direction))
    rows, columns = pixels.shape[:2]
    u, v = 0.5 - np.arctan2(x, z) / (2 * np.pi), 0.5 - np.arcsin(np.clip(y, -1, 1)) / np.pi
    return pixels[min(int(v * rows), rows - 1), min(int(u * columns), columns - 1), :3] * np.array(dome["emission"]["radiance"]) / K


@pytest.mark.blender
def test_even_world(tmp_path):
    from recorder import empty

    empty()

    def build(tree):
        node = tree.nodes.new("ShaderNodeBackground")
        node.inputs["Color"].default_value, node.inputs["Strength"].default_value = (0.2, 0.4, 0.6, 1.0), 0.5
        return node.outputs[0]

    (dome,), _, report = world_of(build)
    assert dome["emission"]["radiance"] == pytest.approx([0.1 * K, 0.2 * K, 0.3 * K], rel=1e-5)
    assert dome["texture"] is None and not report.diagnostics


def directions():
    import numpy as np

    random = np.random.default_rng(7)
    return random.normal(size=(40, 3))


def gradient_picture():
    """A picture whose colour tells its place: u in red, v in green; 64 × 32."""
    import bpy
    import numpy as np

    picture = bpy.data.images.new("Place", 64, 32, float_buffer=True)
    picture.colorspace_settings.name = "Non-Color"
    u, v = np.meshgrid((np.arange(64) + 0.5) / 64, (np.arange(32) + 0.5) / 32)
    picture.pixels.foreach_set(np.stack([u, v, u * 0, u * 0 + 1], axis=-1).astype(np.float32).ravel())
    return picture


def place_in_cycles(direction):
    """Texture coordinates of a direction in Cycles' latitude-longitude images."""
    import numpy as np

    x, y, z = direction / np.linalg.norm(direction)
    return -np.arctan2(y, x) / (2 * np.pi) + 0.5, np.arcsin(z) / np.pi + 0.5


@pytest.mark.blender
@pytest.mark.parametrize("kind", ["plain", "turned", "tinted", "baked"])
def test_environment_lies_as_in_cycles(tmp_path, kind):
    import numpy as np
    from mathutils import Euler
    from recorder import empty

    empty()
    angles = (0.3, -0.5, 1.1)

    def build(tree):
        image, shown = tree.nodes.new("ShaderNodeTexEnvironment"), tree.nodes.new("ShaderNodeBackground")
        image.image = gradient_picture()
        shown.inputs["Strength"].default_value = 2.0
        colour = image.outputs[0]
        if kind != "plain":
            place, mapping = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeMapping")
            mapping.inputs["Rotation"].default_value = angles
            tree.links.new(place.outputs["Generated"], mapping.inputs["Vector"])
            tree.links.new(mapping.outputs[0], image.inputs["Vector"])
        if kind in ("tinted", "baked"):
            change = tree.nodes.new("ShaderNodeMix" if kind == "tinted" else "ShaderNodeGamma")
            if kind == "tinted":
                change.data_type, change.blend_type = "RGBA", "MULTIPLY"
                change.inputs[0].default_value = 1.0
                change.inputs[7].default_value = (0.5, 0.25, 1.0, 1.0)
            else:
                change.inputs["Gamma"].default_value = 2.0
            tree.links.new(colour, change.inputs[6 if kind == "tinted" else 0])
            colour = change.outputs[2 if kind == "tinted" else 0]
        tree.links.new(colour, shown.inputs["Color"])
        return shown.outputs[0]

    (dome,), scene, report = world_of(build)
    assert len(scene.textures) == (2 if kind == "baked" else 1)
    pixels = scene.textures[dome["texture"]]["pixels"]
    turn = np.eye(3) if kind == "plain" else np.array(Euler(angles, "XYZ").to_matrix())
    for direction in directions():
        u, v = place_in_cycles(turn @ direction)
        expected = 2.0 * np.array({"tinted": (0.5 * u, 0.25 * v, 0.0), "baked": (u * u, v * v, 0.0)}.get(kind, (u, v, 0.0)))
        # Half a texel of the picture is 1/128 and 1/64; at the seam u is anything.
        if 0.02 < u < 0.98:
            assert np.abs(looked_up(dome, pixels, direction) - expected).max() < 0.035, (direction, expected)
    assert all(line.severity == "INFO" for line in report.diagnostics)


@pytest.mark.blender
def test_camera_rays_may_see_another_world(tmp_path):
    from recorder import empty

    empty()

    def build(tree):
        path, mix, lit, shown = (tree.nodes.new(f"ShaderNode{name}") for name in ("LightPath", "MixShader", "Background", "Background"))
        lit.inputs["Color"].default_value, shown.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0), (1.0, 0.0, 0.0, 1.0)
        tree.links.new(path.outputs["Is Camera Ray"], mix.inputs["Fac"])
        tree.links.new(lit.outputs[0], mix.inputs[1])
        tree.links.new(shown.outputs[0], mix.inputs[2])
        return mix.outputs[0]

    (lighting, seen), _, _ = world_of(build)
    assert lighting["emission"]["radiance"] == pytest.approx([K, K, K]) and seen["emission"]["radiance"] == pytest.approx([K, 0.0, 0.0])
    assert not lighting["visibility"]["camera"] and lighting["visibility"]["diffuse"]
    assert seen["visibility"]["camera"] and not seen["visibility"]["diffuse"]
