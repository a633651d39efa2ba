"""What stands for what is missing, and the words that the report has for it."""

import pytest

LUMENS_PER_WATT = 177.83


def emitted(description):
    """The constant emission of a description's only closure, in Blender's units."""
    from recorder import constant

    [closure] = description["closures"]
    assert closure["model"] == "Emission"
    return [x / LUMENS_PER_WATT for x in constant(closure, "emission_color")[:3]]


@pytest.mark.blender
def test_a_colour_or_a_value_in_a_shader_socket_is_emission(tmp_path):
    import bpy
    from recorder import empty, material, translated

    empty()
    made, tree, end = material()
    colour, value = tree.nodes.new("ShaderNodeRGB"), tree.nodes.new("ShaderNodeValue")
    colour.outputs[0].default_value, value.outputs[0].default_value = (0.9, 0.6, 0.05, 1.0), 0.4
    tree.links.new(colour.outputs[0], end.inputs["Surface"])
    description, lines = translated(made)
    assert emitted(description) == pytest.approx([0.9, 0.6, 0.05]) and not lines
    tree.links.new(value.outputs[0], end.inputs["Surface"])
    assert emitted(translated(made)[0]) == pytest.approx([0.4] * 3)
    # Half of it beside a surface.
    mix, shader = tree.nodes.new("ShaderNodeMixShader"), tree.nodes.new("ShaderNodeBsdfDiffuse")
    mix.inputs["Fac"].default_value = 0.25
    tree.links.new(shader.outputs[0], mix.inputs[1])
    tree.links.new(colour.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], end.inputs["Surface"])
    closures = translated(made)[0]["closures"]
    assert [(each["model"], each["weight"]["Constant"][0]) for each in closures] == [("Diffuse", 0.75), ("Emission", 0.25)]
    # From a group's input that nothing is linked to, and out of a group.
    group = bpy.data.node_groups.new("Paint", "ShaderNodeTree")
    group.interface.new_socket("Paint", in_out="INPUT", socket_type="NodeSocketColor")
    group.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    start, stop = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    group.links.new(start.outputs[0], stop.inputs[0])
    holder = tree.nodes.new("ShaderNodeGroup")
    holder.node_tree = group
    holder.inputs[0].default_value = (0.1, 0.2, 0.3, 1.0)
    tree.links.new(holder.outputs[0], end.inputs["Surface"])
    assert emitted(translated(made)[0]) == pytest.approx([0.1, 0.2, 0.3])


@pytest.mark.blender
def test_a_colour_in_the_socket_of_a_world_or_a_lamp_shines(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link

    empty()
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("World")
    lamp = bpy.data.lights.new("Lamp", "SUN")
    lamp.energy, lamp.angle = 2.0, 0.0
    link(bpy.data.objects.new("Lamp", lamp))
    for owner, kind in ((scene.world, "World"), (lamp, "Light")):
        owner.use_nodes = True
        tree = owner.node_tree
        tree.nodes.clear()
        colour, end = tree.nodes.new("ShaderNodeRGB"), tree.nodes.new(f"ShaderNodeOutput{kind}")
        colour.outputs[0].default_value = (0.5, 0.25, 0.125, 1.0)
        tree.links.new(colour.outputs[0], end.inputs["Surface"])
    made, report = exporter()
    sun, dome = made.sync(depsgraph()).lights
    assert dome["emission"]["radiance"] == pytest.approx([LUMENS_PER_WATT * x for x in (0.5, 0.25, 0.125)])
    assert sun["emission"]["radiance"] == pytest.approx([LUMENS_PER_WATT * x for x in (1.0, 0.5, 0.25)])
    assert not report.diagnostics


@pytest.mark.blender
def test_rays_pass_what_is_a_volume_alone(tmp_path):
    from recorder import constant, empty, material, translated

    empty()
    for kind in ("VolumePrincipled", "VolumeScatter", "VolumeAbsorption"):
        made, tree, end = material(kind)
        fog = tree.nodes.new(f"ShaderNode{kind}")
        tree.links.new(fog.outputs[0], end.inputs["Volume"])
        description, lines = translated(made)
        [closure] = description["closures"]
        assert closure["model"] == "Transparent" and constant(closure, "base_color")[:3] == [1.0] * 3
        assert len(lines) == 1 and lines[0].endswith("Volume: not supported; the inside stays empty; without a surface, rays pass")
        # As in Cycles, nothing at all is black, and so is a volume in the place of a surface.
        tree.links.remove(end.inputs["Volume"].links[0])
        assert not translated(made)[0]["closures"]
        tree.links.new(fog.outputs[0], end.inputs["Surface"])
        assert not translated(made)[0]["closures"] and len(translated(made)[1]) == 1


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
def test_a_textured_lamp_shines_with_the_mean_of_its_pattern(tmp_path):
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

    # The mean of (1 + z) / 2 is 1/2 over the sphere, and (1 - cos 30°) / 4 over a cone of 60° about -z.
    cases = (
        ("AREA", stripes, (0.6, 0.2, 0.4), 1e-6),
        ("POINT", upwards, (0.5,) * 3, 1e-3),
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
        found = made.sync(depsgraph()).lights[0]["emission"]["radiance"]
        assert np.divide(found, full) == pytest.approx(expected, rel=tolerance), kind
        [line] = report.diagnostics
        assert line.message.endswith("not supported; it shines evenly with their mean"), line


@pytest.mark.blender
def test_light_falloffs_pass_their_strength_on(tmp_path):
    import bpy
    import numpy as np
    from recorder import depsgraph, empty, exporter, link

    for output, lines in (("Quadratic", 0), ("Linear", 1), ("Constant", 1)):
        empty()
        lamp = bpy.data.lights.new("Lamp", "POINT")
        link(bpy.data.objects.new("Lamp", lamp))
        full = exporter()[0].sync(depsgraph()).lights[0]["emission"]["radiance"]

        def falloff(tree, light, output=output):
            node = tree.nodes.new("ShaderNodeLightFalloff")
            node.inputs["Strength"].default_value = 3.0
            tree.links.new(node.outputs[output], light.inputs["Strength"])

        lit(lamp, falloff)
        made, report = exporter()
        assert np.divide(made.sync(depsgraph()).lights[0]["emission"]["radiance"], full) == pytest.approx([3.0] * 3)
        assert len(report.diagnostics) == lines, output


@pytest.mark.blender
def test_nodes_have_one_line_and_a_value_that_is_seen(tmp_path):
    import bpy
    from recorder import constant, empty, material, translated

    empty()
    made, tree, end = material()
    noise, shader = tree.nodes.new("ShaderNodeTexNoise"), tree.nodes.new("ShaderNodeBsdfPrincipled")
    tree.links.new(noise.outputs["Color"], shader.inputs["Base Color"])
    tree.links.new(noise.outputs[0], shader.inputs["Roughness"])
    bevel = tree.nodes.new("ShaderNodeBevel")
    bump = tree.nodes.new("ShaderNodeBump")
    tree.links.new(bevel.outputs[0], bump.inputs["Normal"])
    tree.links.new(bump.outputs[0], shader.inputs["Normal"])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    description, lines = translated(made)
    assert constant(description["closures"][0], "base_color")[:3] == [0.5] * 3
    # A bevel that is left out leaves the normal as it is.
    assert description["closures"][0]["normal"] is None
    assert sorted(line.split(": ", 1)[1] for line in lines) == [
        "Bevel: not supported; its input Normal is passed on",
        "Noise Texture: not supported; the value 0.5 is used",
    ]
    geometry = tree.nodes.new("ShaderNodeNewGeometry")
    tree.links.new(geometry.outputs["Pointiness"], shader.inputs["Metallic"])
    assert constant(translated(made)[0]["closures"][0], "metalness")[0] == 0.5
    failing = tree.nodes.new("ShaderNodeGamma")
    tree.links.new(failing.outputs[0], shader.inputs["Coat Tint"])
    values = __import__("gonio_extension.export.material.translator", fromlist=["VALUES"]).VALUES
    values["ShaderNodeGamma"] = lambda *_: 1 / 0
    shader.inputs["Coat Weight"].default_value = 1.0
    failing.inputs["Color"].default_value = (0.3, 0.3, 0.3, 1.0)
    description, lines = translated(made)
    assert constant(description["closures"][0], "coat_color")[:3] == pytest.approx([0.3] * 3)
    assert [line for line in lines if "ZeroDivisionError" in line and "Gamma" in line], lines
    assert bpy.app.version >= (4, 5, 0)


@pytest.mark.blender
def test_a_missing_picture_in_a_world_is_magenta(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter

    empty()
    world = bpy.context.scene.world = bpy.data.worlds.new("World")
    world.use_nodes = True
    tree = world.node_tree
    background = tree.nodes["Background"]
    for kind in ("ShaderNodeTexEnvironment", "ShaderNodeTexImage"):
        node = tree.nodes.new(kind)
        node.image = bpy.data.images.new("Lost", 2, 2)
        node.image.source, node.image.filepath = "FILE", str(tmp_path / "lost.png")
        tree.links.new(node.outputs[0], background.inputs["Color"])
        made, report = exporter()
        [dome] = (scene := made.sync(depsgraph())).lights
        radiance = [x / LUMENS_PER_WATT for x in dome["emission"]["radiance"]]
        if dome["texture"] is not None:
            pixels = scene.textures[dome["texture"]]["pixels"]
            radiance = list(pixels.reshape(-1, 4).mean(axis=0, dtype=float)[:3] / LUMENS_PER_WATT)
        assert radiance == pytest.approx([1.0, 0.0, 1.0], abs=1e-4), kind
        assert any(line.severity == "ERROR" and line.kind == "Image" for line in report.diagnostics), kind


def instances_with(name, kind, values):
    """A tree of geometry nodes that puts an object on each point of a mesh, with an attribute of the instances."""
    import bpy

    tree = bpy.data.node_groups.new("Instances", "GeometryNodeTree")
    for side in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=side, socket_type="NodeSocketGeometry")
    names = ("NodeGroupInput", "NodeGroupOutput", "GeometryNodeObjectInfo", "GeometryNodeInstanceOnPoints", "GeometryNodeStoreNamedAttribute")
    start, stop, info, instances, store = (tree.nodes.new(each) for each in names)
    info.inputs["As Instance"].default_value = True
    store.data_type, store.domain = kind, "INSTANCE"
    store.inputs["Name"].default_value = name
    tree.links.new(start.outputs[0], instances.inputs["Points"])
    tree.links.new(info.outputs["Geometry"], instances.inputs["Instance"])
    tree.links.new(instances.outputs[0], store.inputs[0])
    tree.links.new(values(tree), store.inputs["Value"])
    tree.links.new(store.outputs[0], stop.inputs[0])
    return tree, info


@pytest.mark.blender
def test_instances_have_the_attributes_of_their_instancer(tmp_path):
    import bpy
    import numpy as np
    from recorder import depsgraph, empty, exporter, link, material, quad

    kinds = {
        "FLOAT_VECTOR": lambda tree: tree.nodes.new("GeometryNodeInputPosition").outputs[0],
        "INT": lambda tree: tree.nodes.new("GeometryNodeInputIndex").outputs[0],
    }
    for kind, values in kinds.items():
        empty()
        made, tree, end = material()
        node, shader = tree.nodes.new("ShaderNodeAttribute"), tree.nodes.new("ShaderNodeEmission")
        node.attribute_type, node.attribute_name = "INSTANCER", "tint"
        tree.links.new(node.outputs["Color"], shader.inputs["Color"])
        tree.links.new(shader.outputs[0], end.inputs["Surface"])
        thing = link(bpy.data.objects.new("Thing", quad()))
        thing.data.materials.append(made)
        thing["tint"] = 7.0
        points = bpy.data.meshes.new("Points")
        places = np.array([(3.0, 0.0, 0.0), (0.0, 2.0, 0.0), (1.0, 1.0, 5.0)], np.float32)
        points.from_pydata([tuple(place) for place in places], [], [])
        holder = link(bpy.data.objects.new("Holder", points))
        holder.location.x = 10.0
        group, info = instances_with("tint", kind, values)
        holder.modifiers.new("Nodes", "NODES").node_group = group
        info.inputs[0].default_value = thing
        exported, report = exporter()
        scene = exported.sync(depsgraph())
        tints = {}
        for entry in scene.instances:
            for matrix, value in zip(entry["transforms"], entry["primvars"]["instancer tint"], strict=True):
                tints[tuple(np.round(matrix[:3, 3], 4))] = tuple(value)
        expected = [(*place, 1.0) if kind == "FLOAT_VECTOR" else (number,) * 3 + (1.0,) for number, place in enumerate(places)]
        for place, value in zip(places, expected, strict=True):
            assert tints[tuple(place + (10.0, 0.0, 0.0))] == pytest.approx(value), kind
        # What nothing instances has its own property.
        assert tints[0.0, 0.0, 0.0] == pytest.approx((7.0, 7.0, 7.0, 1.0)) and not report.diagnostics


@pytest.mark.blender
def test_instances_without_the_attribute_have_their_instancers_property(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link, material, quad

    empty()
    made, tree, end = material()
    node, shader = tree.nodes.new("ShaderNodeAttribute"), tree.nodes.new("ShaderNodeEmission")
    node.attribute_type, node.attribute_name = "INSTANCER", "tint"
    tree.links.new(node.outputs["Fac"], shader.inputs["Strength"])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    inside = bpy.data.collections.new("Inside")
    thing = bpy.data.objects.new("Thing", quad())
    thing.data.materials.append(made)
    inside.objects.link(thing)
    for number, tint in enumerate((0.25, 0.75)):
        holder = link(bpy.data.objects.new(f"Holder {number}", None))
        holder.instance_type, holder.instance_collection, holder["tint"], holder.location.x = "COLLECTION", inside, tint, float(number)
    exported, _ = exporter()
    scene = exported.sync(depsgraph())
    found = {}
    for entry in scene.instances:
        for matrix, value in zip(entry["transforms"], entry["primvars"]["instancer tint"], strict=True):
            found[float(matrix[0, 3])] = float(value[0])
    assert found == {0.0: 0.25, 1.0: 0.75}


@pytest.mark.blender
def test_settings_and_passes_that_are_not_followed_leave_a_line(tmp_path):
    import bpy
    from recorder import module
    import scenes

    scene = scenes.lit_floor(width=8, height=8, samples=1)
    layer = bpy.context.view_layer
    scenes.render(tmp_path / "quiet.exr")
    latest = module("report").latest
    assert not latest().diagnostics, [line.text for line in latest().diagnostics]
    scene.render.use_motion_blur = scene.render.use_multiview = True
    layer.use_pass_vector = layer.use_pass_cryptomatte_object = layer.use_pass_ambient_occlusion = True
    layer.use_pass_normal = True
    wanted = {"Motion blur", "Stereoscopy", "Pass Vector", "Pass Cryptomatte Object", "Pass Ambient Occlusion"}
    if hasattr(scene, "cycles"):
        scene.cycles.film_transparent_glass = scene.cycles.use_fast_gi = True
        scene.cycles.caustics_refractive = False
        wanted |= {"Transparent Glass", "Fast GI Approximation", "Refractive caustics that are switched off"}
    scene.render.use_multiview = False
    wanted.discard("Stereoscopy")
    scenes.render(tmp_path / "told.exr")
    told = {line.message.split(":")[0] for line in latest().diagnostics}
    assert told == wanted


@pytest.mark.blender
def test_equal_messages_are_counted(tmp_path):
    from recorder import module

    report = module("report").Report()
    for name in ("A", "B", "C"):
        report.tell("motion blur", "Object", name)
    report.add("Object", "D", "dark", severity="ERROR")
    assert [(line.text, line.count) for line in report.counted] == [
        ("D: dark", 1),
        ("A and 2 more: Motion blur: not supported; everything stands still at the frame", 3),
    ]
    assert report.summary() == "D: dark, and 1 more in the Gonio Report panel"
    report.forget("Object", "A")
    assert report.counted[1].text.startswith("B and 1 more: ")


@pytest.mark.blender
def test_no_panel_is_offered_in_vain(tmp_path):
    import bpy

    words = ("stereoscopy", "light_linking", "shadow_linking", "bake", "render_path", "freestyle", "gpencil", "output_views")
    for panel in bpy.types.Panel.__subclasses__():
        if "GONIO" in getattr(panel, "COMPAT_ENGINES", ()):
            assert not any(word in panel.__name__ for word in words), panel.__name__
