"""Lamps whose nodes vary over their light."""

import pytest


def lit(lamp, build):
    """A lamp whose emission's strength and colour a function of its tree and its Emission node makes."""
    lamp.use_nodes = True
    tree = lamp.node_tree
    tree.nodes.clear()
    light, end = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputLight")
    light.inputs["Strength"].default_value = 1.0
    tree.links.new(light.outputs[0], end.inputs["Surface"])
    build(tree, light)


@pytest.mark.blender
def test_a_textured_lamp_throws_its_pattern(tmp_path):
    import bpy
    import numpy as np
    from recorder import depsgraph, empty, exporter, link

    def stripes(tree, light):
        picture = bpy.data.images.new("Stripes", 8, 8, float_buffer=True)
        pixels = np.zeros((8, 8, 4), np.float32)
        pixels[..., :3], pixels[..., 3] = (0.2, 0.4, 0.6), 1.0
        pixels[:, ::2, :3] = (1.0, 0.0, 0.2)
        picture.pixels.foreach_set(pixels.ravel())
        texture, place = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeTexCoord")
        texture.image, texture.interpolation = picture, "Closest"
        tree.links.new(place.outputs["UV"], texture.inputs["Vector"])
        tree.links.new(texture.outputs["Color"], light.inputs["Color"])

    def upwards(tree, light):
        place, split = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeSeparateXYZ")
        half = tree.nodes.new("ShaderNodeMath")
        half.operation = "MULTIPLY_ADD"
        half.inputs[1].default_value = half.inputs[2].default_value = 0.5
        tree.links.new(place.outputs["Normal"], split.inputs[0])
        tree.links.new(split.outputs["Z"], half.inputs[0])
        tree.links.new(half.outputs[0], light.inputs["Strength"])

    def texels(scene, light):
        pixels = np.asarray(scene.textures[light["texture"]]["pixels"])
        # Odd columns are bright in Blender's picture, whose first column is the last of what lamps throw along -z.
        assert pixels[0, 0, 1] == pytest.approx(0.4) and pixels[0, -1, 1] == 0.0
        return pixels.reshape(-1, 4)[:, :3].mean(axis=0, dtype=float)

    def spread(goniogram):
        angles = np.radians(goniogram["vertical_deg"])
        means = np.reshape(goniogram["factors"], (-1, len(angles)))[:-1].mean(axis=0)
        even = means * np.sin(angles)
        return float(((even[1:] + even[:-1]) * 0.5 * np.diff(angles)).sum() / (1.0 - np.cos(angles[-1])))

    # The mean of (1 + z) / 2 is 1/2 over the sphere, and (1 - cos 30°) / 4 over a cone of 60° about -z.
    cases = (
        ("AREA", stripes, (0.6, 0.2, 0.4), 1e-5),
        ("POINT", upwards, (0.5,) * 3, 1e-4),
        ("SPOT", upwards, ((1.0 - np.cos(np.pi / 6.0)) / 4.0,) * 3, 1e-3),
    )
    for kind, build, expected, tolerance in cases:
        empty()
        lamp = bpy.data.lights.new("Lamp", kind)
        if kind == "SPOT":
            lamp.spot_size, lamp.spot_blend = np.pi / 3.0, 0.0
        thing = link(bpy.data.objects.new("Lamp", lamp))
        thing.rotation_euler = (0.4, 1.1, 0.3)
        even, _ = exporter()
        full = even.sync(depsgraph()).lights[0]["emission"]["radiance"]
        lit(lamp, build)
        made, report = exporter()
        scene = made.sync(depsgraph())
        found = np.zeros(3)
        for light in scene.lights:
            found += np.array(light["emission"]["radiance"]) * (spread(light["goniogram"]) if kind != "AREA" else texels(scene, light))
        assert np.divide(found, full) == pytest.approx(expected, rel=tolerance), kind
        assert not report.diagnostics, kind


@pytest.mark.blender
@pytest.mark.parametrize("kind, size", [("POINT", 0.0), ("AREA", 0.5)])
def test_lamps_fall_off_as_in_cycles(tmp_path, kind, size):
    import bpy
    import numpy as np
    from beside_cycles import both, link, scene

    for output, smooth in (("Quadratic", 2.0), ("Linear", 0.0), ("Linear", 0.7), ("Constant", 0.0)):
        made = scene(8, 8, samples=256)
        made.cycles.max_bounces = 0
        bpy.ops.mesh.primitive_plane_add(size=20.0)
        lamp = bpy.data.lights.new("Lamp", kind)
        lamp.energy = 40.0
        if kind == "POINT":
            lamp.shadow_soft_size = size
        else:
            lamp.size = size
        placed = link(bpy.data.objects.new("Lamp", lamp))
        placed.location = (1.0, -0.5, 1.5)

        def falloff(tree, light, output=output, smooth=smooth):
            node = tree.nodes.new("ShaderNodeLightFalloff")
            node.inputs["Strength"].default_value, node.inputs["Smooth"].default_value = 3.0, smooth
            tree.links.new(node.outputs[output], light.inputs["Strength"])

        lit(lamp, falloff)
        cycles, gonio = both(tmp_path)
        assert gonio == pytest.approx(cycles, rel=0.04), (output, smooth)
        assert gonio.mean() == pytest.approx(cycles.mean(), rel=5e-3)
        assert np.ptp(gonio) > 0.1 * gonio.mean()


@pytest.mark.blender
def test_one_falloff_for_a_lamp(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link

    def two(tree, light):
        node, part = tree.nodes.new("ShaderNodeLightFalloff"), tree.nodes.new("ShaderNodeMath")
        tree.links.new(node.outputs["Linear"], part.inputs[0])
        tree.links.new(node.outputs["Constant"], part.inputs[1])
        tree.links.new(part.outputs[0], light.inputs["Strength"])

    for kind, lines in (("POINT", 1), ("SUN", 2)):
        empty()
        lamp = bpy.data.lights.new("Lamp", kind)
        link(bpy.data.objects.new("Lamp", lamp))
        lit(lamp, two)
        made, report = exporter()
        assert made.sync(depsgraph()).lights[0]["falloff"] == {"power": 1, "smooth": 0.0}
        assert 1 <= len(report.diagnostics) <= lines, [line.message for line in report.diagnostics]


@pytest.mark.blender
def test_lamps_that_the_camera_shall_not_see_shine(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link

    def hidden(tree, light):
        path, part = tree.nodes.new("ShaderNodeLightPath"), tree.nodes.new("ShaderNodeMath")
        part.operation = "SUBTRACT"
        part.inputs[0].default_value = 1.0
        tree.links.new(path.outputs["Is Camera Ray"], part.inputs[1])
        tree.links.new(part.outputs[0], light.inputs["Strength"])

    empty()
    lamp = bpy.data.lights.new("Lamp", "AREA")
    link(bpy.data.objects.new("Lamp", lamp))
    full = exporter()[0].sync(depsgraph()).lights[0]["emission"]["radiance"]
    lit(lamp, hidden)
    made, report = exporter()
    assert made.sync(depsgraph()).lights[0]["emission"]["radiance"] == pytest.approx(full)
    assert [line.message.partition(":")[0] for line in report.diagnostics] == ["Light Path"]


@pytest.mark.blender
def test_a_pattern_of_colours_shines_in_three_parts(tmp_path):
    import bpy
    import numpy as np
    from recorder import depsgraph, empty, exporter, link

    def coloured(tree, light):
        place = tree.nodes.new("ShaderNodeTexCoord")
        noise = tree.nodes.new("ShaderNodeTexNoise")
        tree.links.new(place.outputs["Normal"], noise.inputs["Vector"])
        tree.links.new(noise.outputs["Color"], light.inputs["Color"])

    empty()
    lamp = bpy.data.lights.new("Lamp", "SPOT")
    link(bpy.data.objects.new("Lamp", lamp))
    lit(lamp, coloured)
    made, report = exporter()
    lights = made.sync(depsgraph()).lights
    assert [np.flatnonzero(light["emission"]["radiance"]).tolist() for light in lights] == [[0], [1], [2]]
    assert all(0.9 < max(light["goniogram"]["factors"]) <= 1.0 + 1e-6 for light in lights) and not report.diagnostics


def _rays(tree, light):
    """A picture that the direction of the light places: four quarters of the cone."""
    import bpy
    import numpy as np

    picture = bpy.data.images.new("Quarters", 2, 2, float_buffer=True)
    pixels = np.array([(1.0, 0.1, 0.1, 1.0), (0.1, 1.0, 0.1, 1.0), (0.1, 0.1, 1.0, 1.0), (1.0, 1.0, 0.2, 1.0)], np.float32)
    picture.pixels.foreach_set(pixels.ravel())
    place, move, texture = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("TexCoord", "Mapping", "TexImage"))
    move.inputs["Location"].default_value = (0.5, 0.5, 0.0)
    texture.image, texture.interpolation = picture, "Closest"
    tree.links.new(place.outputs["Normal"], move.inputs["Vector"])
    tree.links.new(move.outputs["Vector"], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], light.inputs["Color"])


def _cells(tree, light):
    """Warm and cold cells over the sphere, brighter to one side."""
    place, cells, split, ramp = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("TexCoord", "TexChecker", "SeparateXYZ", "MapRange"))
    warm = tree.nodes.new("ShaderNodeBlackbody")
    warm.inputs[0].default_value = 2500.0
    cells.inputs["Scale"].default_value, cells.inputs["Color2"].default_value = 3.0, (0.1, 0.3, 1.0, 1.0)
    ramp.inputs["From Min"].default_value, ramp.inputs["To Min"].default_value = -1.0, 0.2
    tree.links.new(warm.outputs[0], cells.inputs["Color1"])
    tree.links.new(place.outputs["Normal"], cells.inputs["Vector"])
    tree.links.new(place.outputs["Normal"], split.inputs[0])
    tree.links.new(split.outputs["X"], ramp.inputs["Value"])
    tree.links.new(cells.outputs["Color"], light.inputs["Color"])
    tree.links.new(ramp.outputs[0], light.inputs["Strength"])


PATTERNS = {"SPOT": _rays, "POINT": _cells}


@pytest.mark.blender
@pytest.mark.parametrize("kind", list(PATTERNS))
def test_patterns_fall_where_cycles_throws_them(tmp_path, kind):
    import bpy
    import numpy as np
    from beside_cycles import both, scene
    from recorder import link, material

    made = scene(32, 32, scale=6.0, samples=256)
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    white, tree, end = material()
    tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], end.inputs["Surface"])
    bpy.context.object.data.materials.append(white)
    lamp = bpy.data.lights.new("Lamp", kind)
    lamp.energy, lamp.shadow_soft_size = 100.0, 0.0
    if kind == "SPOT":
        lamp.spot_size, lamp.spot_blend = 1.2, 0.2
    thing = link(bpy.data.objects.new("Lamp", lamp))
    thing.location, thing.rotation_euler = (0.4, -0.3, 3.0), (0.2, -0.15, 0.7)
    lit(lamp, PATTERNS[kind])
    made.cycles.max_bounces = 0
    cycles, gonio = both(tmp_path)
    assert cycles.std() > 0.2 * cycles.mean() > 0.0
    # Pixels on the edges of cells are means of a few directions.
    apart = np.abs(cycles - gonio).max(axis=-1) / cycles.max()
    assert np.quantile(apart, 0.8) < 0.02 and apart.mean() < 0.015, (np.quantile(apart, 0.8), apart.mean())
    assert np.allclose(gonio.mean(axis=(0, 1)), cycles.mean(axis=(0, 1)), rtol=0.02), (gonio.mean(axis=(0, 1)), cycles.mean(axis=(0, 1)))


@pytest.mark.blender
def test_textures_that_nothing_places_lie_in_the_lamps_own_space(tmp_path):
    """A wave over a lamp of 4 m, which shines straight down."""
    import bpy
    import numpy as np
    from beside_cycles import both, scene
    from recorder import link, material

    made = scene(32, 32, scale=5.0, samples=128)
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    white, tree, end = material()
    tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], end.inputs["Surface"])
    bpy.context.object.data.materials.append(white)
    lamp = bpy.data.lights.new("Lamp", "AREA")
    lamp.energy, lamp.size, lamp.spread = 100.0, 4.0, 0.035
    thing = link(bpy.data.objects.new("Lamp", lamp))
    thing.location, thing.visible_camera = (0.3, 0.0, 3.0), False

    def wave(tree, light):
        made = tree.nodes.new("ShaderNodeTexWave")
        made.inputs["Scale"].default_value = 0.15
        tree.links.new(made.outputs["Color"], light.inputs["Color"])

    lit(lamp, wave)
    made.cycles.max_bounces = 0
    cycles, gonio = both(tmp_path)
    assert cycles.std() > 0.3 * cycles.mean() > 0.0
    assert np.abs(cycles - gonio).mean() < 0.03 * cycles.mean() and np.allclose(gonio.mean(), cycles.mean(), rtol=0.02), (cycles.mean(), gonio.mean())
