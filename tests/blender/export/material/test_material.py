"""Blender's shader trees as closures and graphs."""

import pytest

LUMENS_PER_WATT = 177.83


@pytest.mark.blender
def test_principled_has_every_socket(tmp_path):
    import bpy
    from recorder import constant, empty, material, translated

    empty()
    made, tree, end = material()
    node = tree.nodes.new("ShaderNodeBsdfPrincipled")
    tree.links.new(node.outputs[0], end.inputs["Surface"])
    values = {
        "Metallic": ("metalness", 0.25),
        "Roughness": ("specular_roughness", 0.35),
        "IOR": ("specular_ior", 1.7),
        "Alpha": ("geometry_opacity", 0.6),
        "Diffuse Roughness": ("diffuse_roughness", 0.4),
        "Subsurface Weight": ("subsurface_weight", 0.1),
        "Subsurface Anisotropy": ("subsurface_scatter_anisotropy", 0.2),
        "Anisotropic": ("specular_anisotropy", 0.3),
        "Anisotropic Rotation": ("specular_rotation", 0.15),
        "Transmission Weight": ("transmission_weight", 0.45),
        "Coat Weight": ("coat_weight", 0.55),
        "Coat Roughness": ("coat_roughness", 0.05),
        "Coat IOR": ("coat_ior", 1.6),
        "Sheen Weight": ("fuzz_weight", 0.65),
        "Sheen Roughness": ("fuzz_roughness", 0.75),
        "Thin Film Thickness": ("thin_film_thickness", 300.0),
        "Thin Film IOR": ("thin_film_ior", 1.4),
    }
    for socket, (_, value) in values.items():
        node.inputs[socket].default_value = value
    node.inputs["Base Color"].default_value = (0.64, 0.25, 0.04, 1.0)
    node.inputs["Specular IOR Level"].default_value = 0.7
    node.inputs["Subsurface Radius"].default_value = (1.0, 0.5, 0.25)
    node.inputs["Subsurface Scale"].default_value = 0.2
    node.inputs["Emission Color"].default_value = (1.0, 0.5, 0.0, 1.0)
    node.inputs["Emission Strength"].default_value = 3.0
    description, lines = translated(made)
    closure, *metal = description["closures"]
    assert closure["model"] == "Principled" and not lines
    if bpy.app.version < (5, 0, 0):
        # Films do not lie on metal there.
        assert [made["weight"]["Constant"][0] for made in (closure, *metal)] == [0.75, 0.25]
        assert [constant(made, "metalness")[0] for made in (closure, *metal)] == [0.0, 1.0]
        assert "thin_film_thickness" not in dict(metal[0]["parameters"])
        del values["Metallic"]
    for name, value in values.values():
        assert constant(closure, name)[0] == pytest.approx(value, rel=1e-6), name
    assert constant(closure, "specular_weight")[0] == pytest.approx(1.4, rel=1e-6)
    assert constant(closure, "transmission_color")[:3] == pytest.approx([0.8, 0.5, 0.2], rel=1e-6)
    assert constant(closure, "subsurface_radius")[:3] == pytest.approx([0.2, 0.1, 0.05], rel=1e-6)
    assert constant(closure, "emission_color")[:3] == pytest.approx([3 * LUMENS_PER_WATT, 1.5 * LUMENS_PER_WATT, 0.0], rel=1e-6)
    # Around the object's z axis, by nodes.
    assert closure["tangent"] is not None


@pytest.mark.blender
def test_mixed_and_added_shaders_become_weighted_closures(tmp_path):
    from recorder import empty, material, translated

    empty()
    made, tree, end = material()
    diffuse, glossy, light = (tree.nodes.new(f"ShaderNode{name}") for name in ("BsdfDiffuse", "BsdfAnisotropic", "Emission"))
    mix, add, outer = (tree.nodes.new(f"ShaderNode{name}") for name in ("MixShader", "AddShader", "MixShader"))
    mix.inputs["Fac"].default_value = 0.25
    outer.inputs["Fac"].default_value = 0.5
    tree.links.new(diffuse.outputs[0], mix.inputs[1])
    tree.links.new(glossy.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], add.inputs[0])
    tree.links.new(light.outputs[0], add.inputs[1])
    tree.links.new(add.outputs[0], outer.inputs[1])
    tree.links.new(diffuse.outputs[0], outer.inputs[2])
    tree.links.new(outer.outputs[0], end.inputs["Surface"])
    description, _ = translated(made)
    found = [(closure["model"], closure["weight"]["Constant"][0]) for closure in description["closures"]]
    assert found == [("Diffuse", 0.375), ("Glossy", 0.125), ("Emission", 0.5), ("Diffuse", 0.5)]


@pytest.mark.blender
def test_groups_reroutes_and_muted_nodes_are_followed(tmp_path):
    import bpy
    from recorder import constant, empty, material, translated

    empty()
    inner = bpy.data.node_groups.new("Inner", "ShaderNodeTree")
    inner.interface.new_socket("Factor", in_out="INPUT", socket_type="NodeSocketFloat")
    inner.interface.new_socket("Result", in_out="OUTPUT", socket_type="NodeSocketFloat")
    start, stop, double = inner.nodes.new("NodeGroupInput"), inner.nodes.new("NodeGroupOutput"), inner.nodes.new("ShaderNodeMath")
    double.operation = "MULTIPLY"
    double.inputs[1].default_value = 2.0
    inner.links.new(start.outputs[0], double.inputs[0])
    inner.links.new(double.outputs[0], stop.inputs[0])
    made, tree, end = material()
    outer = bpy.data.node_groups.new("Outer", "ShaderNodeTree")
    outer.interface.new_socket("Factor", in_out="INPUT", socket_type="NodeSocketFloat")
    outer.interface.new_socket("Result", in_out="OUTPUT", socket_type="NodeSocketFloat")
    first, last, nested = outer.nodes.new("NodeGroupInput"), outer.nodes.new("NodeGroupOutput"), outer.nodes.new("ShaderNodeGroup")
    nested.node_tree = inner
    outer.links.new(first.outputs[0], nested.inputs[0])
    outer.links.new(nested.outputs[0], last.inputs[0])
    shader, reroute, muted = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("NodeReroute"), tree.nodes.new("ShaderNodeMath")
    one, two = tree.nodes.new("ShaderNodeGroup"), tree.nodes.new("ShaderNodeGroup")
    one.node_tree = two.node_tree = outer
    one.inputs[0].default_value = 0.1
    tree.links.new(one.outputs[0], two.inputs[0])
    tree.links.new(two.outputs[0], reroute.inputs[0])
    muted.mute = True
    tree.links.new(reroute.outputs[0], muted.inputs[0])
    tree.links.new(muted.outputs[0], shader.inputs["Roughness"])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    description, lines = translated(made)
    assert constant(description["closures"][0], "diffuse_roughness")[0] == pytest.approx(0.4) and not lines


@pytest.mark.blender
def test_unsupported_nodes_are_reported_once_with_their_place(tmp_path):
    import bpy
    from recorder import constant, empty, material, translated

    empty()
    group = bpy.data.node_groups.new("Rust", "ShaderNodeTree")
    group.interface.new_socket("Fac", in_out="OUTPUT", socket_type="NodeSocketFloat")
    # Without a file it is as good as unknown.
    lost, stop = group.nodes.new("ShaderNodeTexIES"), group.nodes.new("NodeGroupOutput")
    group.links.new(lost.outputs[0], stop.inputs[0])
    made, tree, end = material("木")
    holder, shader = tree.nodes.new("ShaderNodeGroup"), tree.nodes.new("ShaderNodeBsdfPrincipled")
    holder.node_tree = group
    for socket in ("Roughness", "Metallic"):
        tree.links.new(holder.outputs[0], shader.inputs[socket])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    description, lines = translated(made)
    assert len(lines) == 1 and lines[0].startswith("木 > Group/IES Texture: "), lines
    assert constant(description["closures"][0], "specular_roughness")[0] == 1.0


@pytest.mark.blender
def test_images_become_textures(tmp_path):
    import bpy
    from recorder import Recorder, empty, material, module

    empty()
    picture = bpy.data.images.new("Kept", 4, 2)
    picture.filepath_raw, picture.file_format = str(tmp_path / "kept.png"), "PNG"
    picture.save()
    kept = bpy.data.images.load(str(tmp_path / "kept.png"))
    packed = bpy.data.images.load(str(tmp_path / "kept.png"))
    packed.pack()
    made_up = bpy.data.images.new("Made up", 8, 4, float_buffer=True)
    data = bpy.data.images.load(str(tmp_path / "kept.png"))
    data.colorspace_settings.name = "Non-Color"
    lost = bpy.data.images.load(str(tmp_path / "kept.png"))
    lost.filepath = str(tmp_path / "lost.png")
    scene, report = Recorder(), module("report").Report()
    images = module("export.images").Images(scene, module("export.slots").Slots())
    _, tree, _ = material()
    node = tree.nodes.new("ShaderNodeTexImage")
    numbers = [images.texture(image, node.image_user, report) for image in (kept, packed, made_up, data, lost)]
    assert numbers == [0, 1, 2, 3, None]
    assert scene.textures[0]["source"] == {"File": str(tmp_path / "kept.png")}
    assert scene.textures[1]["data"][1][:4] == b"\x89PNG"
    assert scene.textures[2]["pixels"].shape == (4, 8, 4)
    assert [texture["colour_space"] for texture in scene.textures] == ["srgb_texture", "srgb_texture", "raw", "raw"]
    assert [line.name for line in report.diagnostics] == [lost.name] and report.diagnostics[0].severity == "ERROR"
    assert images.texture(kept, node.image_user, report) == 0 and len(scene.textures) == 4


@pytest.mark.blender
def test_image_reaches_a_parameter_through_uv_map_and_mapping(tmp_path):
    import bpy
    from recorder import empty, material, translated

    empty()
    made, tree, end = material()
    uv, mapping, image, shader, normal = (
        tree.nodes.new(f"ShaderNode{name}") for name in ("UVMap", "Mapping", "TexImage", "BsdfPrincipled", "NormalMap")
    )
    uv.uv_map = "Second"
    mapping.inputs["Scale"].default_value = (2.0, 3.0, 1.0)
    image.image, image.extension, image.interpolation = bpy.data.images.new("Picture", 4, 4), "EXTEND", "Closest"
    tree.links.new(uv.outputs[0], mapping.inputs["Vector"])
    tree.links.new(mapping.outputs[0], image.inputs["Vector"])
    tree.links.new(image.outputs["Color"], shader.inputs["Base Color"])
    tree.links.new(image.outputs["Color"], normal.inputs["Color"])
    tree.links.new(normal.outputs[0], shader.inputs["Normal"])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    description, lines = translated(made)
    nodes = description["graph"]["nodes"]
    names = [next(iter(n["operation"])) if isinstance(n["operation"], dict) else n["operation"] for n in nodes]
    assert names[:3] == ["Primvar", "Transform3d", "Image"] and names.count("Image") == 1 and not lines
    assert nodes[0]["operation"]["Primvar"]["name"] == "Second"
    lookup = nodes[2]["operation"]["Image"]
    assert (lookup["wrap"], lookup["filter"], lookup["texture"]) == (["Clamp", "Clamp"], "Closest", 0)
    assert names[description["closures"][0]["normal"]] == "Multiply" and "Transform" in names


@pytest.mark.blender
def test_every_shader_node_translates(tmp_path):
    import bpy
    from recorder import empty, material, translated

    empty()
    made, tree, _ = material()
    picture = bpy.data.images.new("Picture", 4, 4)
    for name in sorted(each for each in dir(bpy.types) if each.startswith("ShaderNode")):
        for linked in (False, True):
            tree.nodes.clear()
            try:
                node = tree.nodes.new(name)
            except RuntimeError:
                break
            end, light, source = (tree.nodes.new(f"ShaderNode{each}") for each in ("OutputMaterial", "Emission", "VertexColor"))
            tree.links.new(light.outputs[0], end.inputs["Surface"])
            if hasattr(node, "image"):
                node.image = picture
            for socket in node.inputs if linked else ():
                if socket.type != "SHADER":
                    tree.links.new(source.outputs[0], socket)
            for output in node.outputs:
                tree.links.new(output, end.inputs["Surface"] if output.type == "SHADER" else light.inputs["Color"])
                description, _ = translated(made)
                assert len(description["closures"]) <= 2, name


@pytest.mark.blender
def test_single_closures_have_their_colour_where_the_core_reads_it(tmp_path):
    from recorder import constant, empty, material, translated

    empty()
    for name in ("Diffuse", "Anisotropic", "Glass", "Refraction", "Transparent", "Translucent", "Sheen"):
        made, tree, end = material(name)
        shader = tree.nodes.new(f"ShaderNodeBsdf{name}")
        shader.inputs["Color"].default_value = (0.1, 0.2, 0.3, 1.0)
        tree.links.new(shader.outputs[0], end.inputs["Surface"])
        description, _ = translated(made)
        assert constant(description["closures"][0], "base_color")[:3] == pytest.approx([0.1, 0.2, 0.3]), name
    made, tree, end = material("Skin")
    shader = tree.nodes.new("ShaderNodeSubsurfaceScattering")
    shader.falloff = "RANDOM_WALK_SKIN"
    shader.inputs["Color"].default_value, shader.inputs["IOR"].default_value = (0.1, 0.2, 0.3, 1.0), 1.7
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    [closure] = translated(made)[0]["closures"]
    assert constant(closure, "base_color")[:3] == pytest.approx([0.1, 0.2, 0.3])
    assert constant(closure, "subsurface_ior")[0] == pytest.approx(1.7)


@pytest.mark.blender
def test_a_bump_of_the_base_leaves_the_coat_smooth(tmp_path):
    from recorder import empty, material, translated

    empty()
    made, tree, end = material()
    shader, bump, noise = (tree.nodes.new(f"ShaderNode{name}") for name in ("BsdfPrincipled", "Bump", "TexNoise"))
    shader.inputs["Coat Weight"].default_value = 1.0
    tree.links.new(noise.outputs[0], bump.inputs["Height"])
    tree.links.new(bump.outputs[0], shader.inputs["Normal"])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    description, lines = translated(made)
    (closure,) = description["closures"]
    assert not lines and description["graph"]["nodes"][closure["coat_normal"]]["operation"] == "Normal"
    assert closure["normal"] != closure["coat_normal"]
    tree.links.new(bump.outputs[0], shader.inputs["Coat Normal"])
    (closure,) = translated(made)[0]["closures"]
    assert closure["normal"] == closure["coat_normal"]


@pytest.mark.blender
def test_what_has_no_material_is_as_in_cycles(tmp_path):
    import bpy
    from beside_cycles import both, link, scene

    made = scene(8, 8, samples=256)
    made.cycles.max_bounces = 0
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    lamp = bpy.data.lights.new("Lamp", "AREA")
    lamp.size, lamp.energy = 0.5, 40.0
    link(bpy.data.objects.new("Lamp", lamp)).location = (1.0, -0.5, 1.5)
    cycles, gonio = both(tmp_path)
    # Since Blender 5.0 that is a Principled BSDF, before a diffuse one: 7 % apart under the lamp.
    assert gonio == pytest.approx(cycles, rel=0.04)
    assert gonio.mean() == pytest.approx(cycles.mean(), rel=5e-3)
