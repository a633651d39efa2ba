"""Lamps, worlds and surfaces of negative strength take light away, as in Cycles."""

import pytest


def floor(albedo=0.5, world=0.0, samples=64):
    """A Lambertian floor under an even world, seen from above."""
    import bpy
    from beside_cycles import scene
    from scenes import diffuse

    made = scene(8, 4, samples=samples)
    bpy.ops.mesh.primitive_plane_add(size=40.0)
    bpy.context.object.data.materials.append(diffuse("Grey", (albedo,) * 3))
    made.world.node_tree.nodes["Background"].inputs["Color"].default_value = (world, world, world, 1.0)
    made.cycles.max_bounces = 1
    return made


def lamp(kind, energy, height=30.0, **fields):
    import bpy
    from recorder import link

    made = link(bpy.data.objects.new(kind, bpy.data.lights.new(kind, kind)))
    made.data.energy, made.location = energy, (0.0, 0.0, height)
    for name, value in fields.items():
        setattr(made.data, name, value)
    return made


def nodes_of(thing):
    """The tree of a lamp's nodes and its Emission node."""
    thing.data.use_nodes = True
    tree = thing.data.node_tree
    return tree, next(node for node in tree.nodes if node.bl_idname == "ShaderNodeEmission")


def strength(tree, value):
    """An output with a value that no socket's limits hold back."""
    node = tree.nodes.new("ShaderNodeValue")
    node.outputs[0].default_value = value
    return node.outputs[0]


@pytest.mark.blender
def test_lamps_of_negative_strength(tmp_path):
    from math import pi

    from beside_cycles import both, close

    at_height = 4000.0 / (4.0 * pi * 900.0) * 0.5 / pi
    lamps = (
        ("POINT", -4000.0, {"shadow_soft_size": 0.0}, at_height),
        ("SPOT", -4000.0, {"shadow_soft_size": 0.5, "spot_blend": 0.0, "spot_size": 1.0}, at_height),
        ("SUN", -2.0, {"angle": 0.1}, 1.0 / pi),
        ("AREA", -1000.0, {"size": 0.5}, at_height),
    )
    for kind, energy, fields, expected in lamps:
        for through_nodes in (False, True):
            floor(samples=16)
            made = lamp(kind, -energy if through_nodes else energy, **fields)
            if through_nodes:
                tree, emission = nodes_of(made)
                tree.links.new(strength(tree, -1.0), emission.inputs["Strength"])
            pair = both(tmp_path)
            close(pair, 0.003)
            assert pair[1].mean() == pytest.approx(-expected, rel=0.03), (kind, through_nodes)


@pytest.mark.blender
def test_worlds_and_surfaces_of_negative_strength(tmp_path):
    import bpy
    import numpy as np
    from beside_cycles import both, close, shining

    def world(background, tree):
        tree.links.new(strength(tree, -0.5), background.inputs["Strength"])

    def textured(background, tree):
        world(background, tree)
        tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs["Color"], background.inputs["Color"])

    for change in (world, textured):
        made = floor(world=1.0, samples=256)
        bpy.data.objects["Plane"].scale = (0.05, 0.05, 1.0)
        background = made.world.node_tree.nodes["Background"]
        change(background, made.world.node_tree)
        pair = both(tmp_path, lines=("baked",) if change is textured else ())
        close(pair, 0.03)
        assert pair[1].max() < 0.0, change.__name__

    def plain(color, tree):
        tree.links.new(strength(tree, -3.0), color.node.inputs["Strength"])

    def noisy(color, tree):
        plain(color, tree)
        tree.links.new(tree.nodes.new("ShaderNodeTexNoise").outputs["Color"], color)

    def added(color, tree):
        plain(color, tree)
        color.default_value = (1.0, 0.5, 0.0, 1.0)
        both_of = tree.nodes.new("ShaderNodeAddShader")
        end = next(node for node in tree.nodes if node.bl_idname == "ShaderNodeOutputMaterial")
        tree.links.new(color.node.outputs[0], both_of.inputs[0])
        tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], both_of.inputs[1])
        tree.links.new(both_of.outputs[0], end.inputs["Surface"])

    for change in (plain, noisy, added):
        floor(world=1.0, samples=256)
        bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8, radius=1.0, location=(0.0, 0.0, 1.5))
        glow, tree, color = shining()
        change(color, tree)
        bpy.context.object.data.materials.append(glow)
        cycles, gonio = both(tmp_path)
        # The floor is darker than under the world alone, the ball negative.
        assert gonio[1:3, 3:5, 0].max() < 0.0 and gonio[0, 0, 0] < 0.5, change.__name__
        assert np.abs(cycles - gonio).max() < 0.08 and np.abs((cycles - gonio).mean()) < 0.01, (change.__name__, cycles - gonio)


@pytest.mark.blender
def test_principled_surfaces_take_no_light_away_since_5(tmp_path):
    import bpy
    from beside_cycles import both, close

    floor(world=1.0, samples=256)
    bpy.ops.mesh.primitive_plane_add(size=2.0, location=(0.0, 0.0, 1.0))
    made = bpy.data.materials.new("Principled")
    made.use_nodes = True
    tree = made.node_tree
    shader = tree.nodes["Principled BSDF"]
    shader.inputs["Emission Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    tree.links.new(strength(tree, -5.0), shader.inputs["Emission Strength"])
    bpy.context.object.data.materials.append(made)
    pair = both(tmp_path)
    close(pair, 0.03)
    assert (pair[1].min() > 0.2) == (bpy.app.version >= (5, 0, 0))


@pytest.mark.blender
def test_patterns_that_shine_and_take_away(tmp_path):
    import numpy as np
    from beside_cycles import both

    for kind in ("POINT", "AREA"):
        floor(samples=512)
        tree, emission = nodes_of(lamp(kind, 400.0, height=4.0, **({"shadow_soft_size": 0.0} if kind == "POINT" else {"size": 3.0})))
        place, parts, scaled = (tree.nodes.new(f"ShaderNode{name}") for name in ("TexCoord", "SeparateXYZ", "Math"))
        source = "Normal" if kind == "POINT" else "UV"
        tree.links.new(place.outputs[source], parts.inputs[0])
        scaled.operation = "MULTIPLY_ADD"
        scaled.inputs[1].default_value, scaled.inputs[2].default_value = (3.0, 0.0) if kind == "POINT" else (2.0, -1.0)
        tree.links.new(parts.outputs[0], scaled.inputs[0])
        tree.links.new(scaled.outputs[0], emission.inputs["Strength"])
        cycles, gonio = both(tmp_path)
        assert cycles.min() < -0.02 and cycles.max() > 0.02, kind
        assert np.abs(cycles - gonio).max() < 0.05 * np.abs(cycles).max() + 0.01, (kind, cycles - gonio)


@pytest.mark.blender
def test_clamping_and_passes_of_negative_light(tmp_path):
    import bpy
    import numpy as np
    from beside_cycles import both, close
    from recorder import module
    from scenes import read

    made = floor(samples=16)
    lamp("SUN", -2.0, angle=0.0)
    made.cycles.sample_clamp_direct = 0.3
    pair = both(tmp_path)
    close(pair, 0.01)
    assert np.allclose(pair[1], -0.3, atol=0.01)
    made.gonio.clamp_direct = 0.0
    bpy.context.view_layer.use_pass_diffuse_direct = True
    group = bpy.context.view_layer.lightgroups.add()
    group.name = "Dark"
    bpy.data.objects["SUN"].lightgroup = "Dark"
    module("compat").use_multilayer_exr(made.render.image_settings)
    made.render.filepath = str(tmp_path / "passes.exr")
    bpy.ops.render.render(write_still=True)
    channels = read(tmp_path / "passes.exr")
    direct = next(values for name, values in channels.items() if ("DiffDir" in name or "Diffuse Direct" in name) and name.endswith(".R"))
    grouped = next(values for name, values in channels.items() if "Combined_Dark" in name and name.endswith(".R"))
    assert np.allclose(direct, -2.0 / np.pi, rtol=0.01) and np.allclose(grouped, -1.0 / np.pi, rtol=0.01)
