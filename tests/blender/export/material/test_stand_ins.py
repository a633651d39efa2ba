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
        absorption, scattering = {"VolumeAbsorption": (0.2, 0.0), "VolumeScatter": (0.0, 0.8), "VolumePrincipled": (0.5, 0.5)}[kind]
        assert not lines and description["medium"]["absorption"] == pytest.approx([absorption] * 3)
        assert description["medium"]["scattering"] == pytest.approx([scattering] * 3)
        # A mix that leads to nothing is no surface either.
        mix = tree.nodes.new("ShaderNodeMixShader")
        mix.inputs["Fac"].default_value = 0.0
        tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], mix.inputs[2])
        tree.links.new(mix.outputs[0], end.inputs["Surface"])
        assert [each["model"] for each in translated(made)[0]["closures"]] == ["Transparent"]
        tree.links.remove(end.inputs["Surface"].links[0])
        # As in Cycles, nothing at all is black, and so is a volume in the place of a surface.
        tree.links.remove(end.inputs["Volume"].links[0])
        assert not translated(made)[0]["closures"]
        tree.links.new(fog.outputs[0], end.inputs["Surface"])
        assert not translated(made)[0]["closures"] and len(translated(made)[1]) == 1


@pytest.mark.blender
def test_portals_keep_where_rays_go_on(tmp_path):
    from recorder import constant, empty, material, translated

    empty()
    made, tree, end = material()
    portal = tree.nodes.new("ShaderNodeBsdfRayPortal")
    portal.inputs["Color"].default_value = (0.5, 0.6, 0.7, 1.0)
    portal.inputs["Direction"].default_value = (1.0, 0.0, 0.5)
    tree.links.new(portal.outputs[0], end.inputs["Surface"])
    description, lines = translated(made)
    [closure] = description["closures"]
    assert closure["model"] == "Portal" and constant(closure, "base_color")[:3] == pytest.approx([0.5, 0.6, 0.7])
    assert constant(closure, "portal_direction")[:3] == pytest.approx([1.0, 0.0, 0.5])
    # Without a link rays go on from the hit itself.
    number, _ = dict(closure["parameters"])["portal_position"]["Node"]
    assert description["graph"]["nodes"][number]["operation"] == "Position" and not lines


@pytest.mark.blender
def test_nodes_that_look_around_are_steps_and_those_that_fail_have_a_value(tmp_path):
    import bpy
    from recorder import constant, empty, material, translated

    empty()
    made, tree, end = material()
    near, shader = tree.nodes.new("ShaderNodeAmbientOcclusion"), tree.nodes.new("ShaderNodeBsdfPrincipled")
    near.inputs["Color"].default_value = (0.5, 0.5, 0.5, 1.0)
    tree.links.new(near.outputs["Color"], shader.inputs["Base Color"])
    tree.links.new(near.outputs["AO"], shader.inputs["Roughness"])
    bevel = tree.nodes.new("ShaderNodeBevel")
    bump = tree.nodes.new("ShaderNodeBump")
    tree.links.new(bevel.outputs[0], bump.inputs["Normal"])
    tree.links.new(bump.outputs[0], shader.inputs["Normal"])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    description, lines = translated(made)
    # Both outputs share one step.
    steps = [next(iter(each["operation"])) for each in description["graph"]["nodes"] if isinstance(each["operation"], dict)]
    assert steps.count("Occlusion") == 1 and steps.count("RoundedNormal") == 1 and not lines
    number = description["closures"][0]["normal"]
    assert "RoundedNormal" in description["graph"]["nodes"][number]["operation"]
    failing = tree.nodes.new("ShaderNodeGamma")
    tree.links.new(failing.outputs[0], shader.inputs["Coat Tint"])
    values = __import__("gonio_extension.export.material.registry", fromlist=["VALUES"]).VALUES
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


@pytest.mark.blender
def test_vector_curves_and_tangents_are_followed(tmp_path):
    from recorder import empty, evaluated, material, translated

    empty()
    made, tree, end = material()
    curves, shader, attribute = (tree.nodes.new(f"ShaderNode{name}") for name in ("VectorCurve", "Emission", "Attribute"))
    attribute.attribute_name = "place"
    curves.inputs["Fac"].default_value = 0.5
    # The first component turned over, the others as they are.
    first = curves.mapping.curves[0].points
    first[0].location, first[1].location = (-1.0, 1.0), (1.0, -1.0)
    curves.mapping.update()
    tree.links.new(attribute.outputs["Vector"], curves.inputs["Vector"])
    tree.links.new(curves.outputs[0], shader.inputs["Color"])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    description, lines = translated(made)
    [closure] = description["closures"]
    value = evaluated(description, dict(closure["parameters"])["emission_color"], {"place": (0.5, -0.25, 0.75, 0.0)})
    assert value[:3] / LUMENS_PER_WATT == pytest.approx([0.0, -0.25, 0.75], abs=2e-3) and not lines
    geometry = tree.nodes.new("ShaderNodeNewGeometry")
    tree.links.new(geometry.outputs["Tangent"], shader.inputs["Color"])
    description, lines = translated(made)
    assert {"Cross", "Normalize"} <= {node["operation"] for node in description["graph"]["nodes"] if isinstance(node["operation"], str)}
    assert not lines


@pytest.mark.blender
def test_the_report_counts_nodes_that_are_exact(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link, material

    empty()
    made, tree, end = material()
    kinds = ("TexNoise", "BsdfPrincipled", "EeveeSpecular", "MixShader")
    noise, shader, inexact, mix = (tree.nodes.new(f"ShaderNode{kind}") for kind in kinds)
    tree.links.new(noise.outputs["Color"], shader.inputs["Base Color"])
    tree.links.new(noise.outputs[0], shader.inputs["Metallic"])
    tree.nodes.new("ShaderNodeTexMagic")
    tree.links.new(shader.outputs[0], mix.inputs[1])
    tree.links.new(inexact.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], end.inputs["Surface"])
    bpy.ops.mesh.primitive_plane_add()
    bpy.context.object.data.materials.append(made)
    link(bpy.data.objects.new("Again", bpy.context.object.data))
    exported, report = exporter()
    for _ in range(2):
        exported.sync(depsgraph())
        # What nothing reads does not count.
        assert report.nodes == (3, 4), report.nodes


@pytest.mark.blender
def test_an_even_medium_is_what_volume_shaders_add_up_to(tmp_path):
    from recorder import empty, material, translated

    empty()
    made, tree, end = material("Filled")
    first, second, both = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("VolumeAbsorption", "VolumeCoefficients", "AddShader"))
    first.inputs["Color"].default_value, first.inputs["Density"].default_value = (0.5, 0.25, 1.0, 1.0), 2.0
    second.inputs["Absorption Coefficients"].default_value = (0.5, 0.0, 0.125)
    second.inputs["Scatter Coefficients"].default_value = (0.0, 0.0, 0.0)
    tree.links.new(first.outputs[0], both.inputs[0])
    tree.links.new(second.outputs[0], both.inputs[1])
    tree.links.new(both.outputs[0], end.inputs["Volume"])
    description, lines = translated(made)
    assert description["medium"]["absorption"] == pytest.approx([1.5, 1.5, 0.125]) and not lines
    second.inputs["Scatter Coefficients"].default_value = (0.1, 0.0, 0.0)
    second.inputs["Emission Coefficients"].default_value = (0.0, 2.0, 0.0)
    second.inputs["Anisotropy"].default_value = 0.25
    description, lines = translated(made)
    assert description["medium"]["scattering"] == pytest.approx([0.1, 0, 0]) and not lines
    assert description["medium"]["emission"] == pytest.approx([0, 2 * LUMENS_PER_WATT, 0])
    assert description["medium"]["anisotropy"] == pytest.approx(0.25)
    second.phase = "RAYLEIGH"
    description, lines = translated(made)
    assert description["medium"]["phase"] == "Rayleigh" and not lines
    second.phase = "HENYEY_GREENSTEIN"
    # What varies is no even medium.
    tree.links.new(first.outputs[0], end.inputs["Volume"])
    tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs["Fac"], first.inputs["Density"])
    description, lines = translated(made)
    assert "medium" not in description and not lines


@pytest.mark.blender
def test_a_camera_sees_through_the_volume_that_it_is_in_as_in_cycles(tmp_path):
    import bpy
    import numpy
    from beside_cycles import both, close, scene, shining
    from recorder import material

    made = scene(8, 8, scale=2.0, samples=16)
    # Cycles counts from where the view begins.
    made.camera.data.clip_start = 1e-4
    floor, _, colour = shining()
    colour.default_value = (1.0, 1.0, 1.0, 1.0)
    bpy.ops.mesh.primitive_plane_add(size=10)
    bpy.context.object.data.materials.append(floor)
    filled, tree, end = material("Filled")
    inside = tree.nodes.new("ShaderNodeVolumeAbsorption")
    inside.inputs["Color"].default_value, inside.inputs["Density"].default_value = (0.5, 0.25, 0.9, 1.0), 0.4
    tree.links.new(inside.outputs[0], end.inputs["Volume"])
    # From 1 m to 8 m above the floor; the camera is at 5 m.
    bpy.ops.mesh.primitive_cube_add(size=1, location=(0, 0, 4.5), scale=(6, 6, 7))
    bpy.context.object.data.materials.append(filled)
    pair = both(tmp_path)
    close(pair)
    expected = numpy.exp(-0.4 * (1 - numpy.array((0.5, 0.25, 0.9))) * 4.0)
    assert numpy.allclose(pair[1].mean((0, 1)), expected, rtol=1e-3), (pair[1].mean((0, 1)), expected)
    assert made.render.engine == "GONIO"
