"""Instances, view layers, and updates that redo only what changed."""

import pytest


def generator(name, mesh, own_material):
    """An object whose geometry nodes put a cube of their own, with a material of its own, on each of its points."""
    import bpy
    from recorder import link

    tree = bpy.data.node_groups.new(name, "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    add = tree.nodes.new
    start, stop, scatter, cube, painted, joined = (
        add("NodeGroupInput"),
        add("NodeGroupOutput"),
        add("GeometryNodeInstanceOnPoints"),
        add("GeometryNodeMeshCube"),
        add("GeometryNodeSetMaterial"),
        add("GeometryNodeJoinGeometry"),
    )
    painted.inputs["Material"].default_value = own_material
    for source, target in (
        (cube.outputs[0], painted.inputs[0]),
        (painted.outputs[0], scatter.inputs["Instance"]),
        (start.outputs[0], scatter.inputs["Points"]),
        (scatter.outputs[0], joined.inputs[0]),
        (start.outputs[0], joined.inputs[0]),
        (joined.outputs[0], stop.inputs[0]),
    ):
        tree.links.new(source, target)
    thing = link(bpy.data.objects.new(name, mesh))
    thing.modifiers.new(name, "NODES").node_group = tree
    return thing


@pytest.mark.blender
def test_geometry_nodes_collections_and_particles(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link, quad

    empty()
    own, base = bpy.data.materials.new("Own"), bpy.data.materials.new("Base")
    carrier = quad("Carrier")
    carrier.materials.append(base)
    generator("Generator", carrier, own)
    part, hidden = bpy.data.objects.new("Part", quad()), bpy.data.collections.new("Hidden")
    hidden.objects.link(part)
    hidden.objects.link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
    placed = link(bpy.data.objects.new("Placed", None))
    placed.instance_type, placed.instance_collection, placed.location = "COLLECTION", hidden, (5, 0, 0)
    meadow = link(bpy.data.objects.new("Meadow", quad()))
    meadow.modifiers.new("Grass", "PARTICLE_SYSTEM")
    grass = meadow.particle_systems[0].settings
    grass.count, grass.type, grass.render_type, grass.instance_object = 10, "HAIR", "OBJECT", part
    meadow.show_instancer_for_viewport = meadow.show_instancer_for_render = False
    exported, report = exporter()
    scene = exported.sync(depsgraph())
    shown = {}
    for entry in scene.instances:
        materials = [scene.materials[number]["origin"]["name"] for number in entry["materials"]]
        triangles = len(scene.meshes[entry["mesh"]]["triangles"])
        shown.setdefault(entry["name"], []).append((triangles, len(entry["transforms"]), materials[-1]))
    assert sorted(shown["Generator"]) == [(2, 1, "Base"), (12, 4, "Own")]
    assert shown["Part"] == [(2, 11, "default")] and "Meadow" not in shown
    assert [light["origin"]["name"] for light in scene.lights] == ["Lamp"]
    assert scene.lights[0]["transform"]["columns"][3] == [5.0, 0.0, 0.0] and not report.diagnostics


@pytest.mark.blender
def test_visibility_and_overrides(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link, quad

    empty()
    scene, layer = bpy.context.scene, bpy.context.view_layer
    for name in ("Excluded", "Held", "Indirect"):
        collection = bpy.data.collections.new(name)
        scene.collection.children.link(collection)
        collection.objects.link(bpy.data.objects.new(name, quad()))
    layer.layer_collection.children["Excluded"].exclude = True
    layer.layer_collection.children["Held"].holdout = True
    layer.layer_collection.children["Indirect"].indirect_only = True
    for name in ("camera", "diffuse", "glossy", "transmission", "shadow"):
        setattr(link(bpy.data.objects.new(name, quad())), f"visible_{name}", False)
    link(bpy.data.objects.new("volume", quad())).visible_volume_scatter = False
    link(bpy.data.objects.new("catcher", quad())).is_shadow_catcher = True
    exported, report = exporter()
    recorded = exported.sync(depsgraph())
    assert not report.diagnostics
    usual = dict.fromkeys(("camera", "diffuse", "glossy", "transmission", "volume", "shadow"), True)
    found = {
        entry["name"]: {key for key, value in entry["visibility"].items() if value is not usual.get(key)} for entry in recorded.instances
    }
    assert found == {
        "Held": {"holdout"},
        "Indirect": {"camera"},
        **{name: {name} for name in ("camera", "diffuse", "glossy", "transmission", "volume", "shadow")},
        "catcher": {"shadow_catcher"},
    }
    layer.material_override = bpy.data.materials.new("Clay")
    recorded = exported.sync(depsgraph())
    assert {recorded.materials[entry["materials"][0]]["origin"]["name"] for entry in recorded.instances} == {"Clay"}


@pytest.mark.blender
def test_updates_redo_only_what_changed(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link, material, quad

    empty()
    scene = bpy.context.scene
    made, tree, end = material()
    shader = tree.nodes.new("ShaderNodeBsdfPrincipled")
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    shared = quad()
    shared.materials.append(made)
    one, two = (link(bpy.data.objects.new(name, shared)) for name in ("One", "Two"))
    lamp = link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
    scene.camera = link(bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera")))
    scene.world = bpy.data.worlds.new("World")
    exported, _ = exporter()
    recorded = exported.sync(depsgraph())
    seen = []

    def watch(_, graph):
        seen.append(exported.update(graph))

    bpy.app.handlers.depsgraph_update_post.append(watch)

    def after(edit):
        seen.clear()
        recorded.calls.clear()
        edit()
        bpy.context.view_layer.update()
        flags = {name for changes in seen for name, value in vars(changes).items() if value}
        return flags, sorted(set(recorded.calls))

    def bend():
        shared.vertices[0].co.z = 0.5
        shared.update()

    assert after(lambda: None) == (set(), [])
    assert after(lambda: setattr(one, "location", (1, 2, 3))) == ({"transforms"}, ["instances"])
    assert after(lambda: setattr(scene.camera, "location", (1, 2, 3))) == ({"camera"}, ["cameras"])
    assert after(lambda: setattr(shader.inputs["Roughness"], "default_value", 0.1)) == ({"shading"}, ["materials"])
    assert after(lambda: setattr(lamp.data, "energy", 55.0)) == ({"lights"}, ["lights"])
    flags, calls = after(bend)
    assert "geometry" in flags and "meshes" in calls and "materials" not in calls
    flags, calls = after(lambda: bpy.data.objects.remove(two))
    assert flags == {"transforms"} and "meshes" not in calls
    bpy.app.handlers.depsgraph_update_post.remove(watch)


@pytest.mark.blender
def test_a_moving_mesh_takes_no_more_places(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link, quad

    empty()
    mesh, exported = quad(), exporter()[0]
    link(bpy.data.objects.new("Flag", mesh))
    for frame in range(20):
        mesh.vertices[0].co.z = frame
        mesh.update()
        scene = exported.sync(depsgraph())
    assert len(scene.meshes) <= 2 and len(scene.instances) == 1
    assert scene.meshes[scene.instances[0]["mesh"]]["points"][0, 2] == 19.0


@pytest.mark.blender
def test_values_of_placements(tmp_path):
    import bpy
    import numpy as np
    from recorder import depsgraph, empty, exporter, link, material, quad

    empty()
    made, tree, end = material()
    shader, about, attribute = (tree.nodes.new(f"ShaderNode{name}") for name in ("BsdfPrincipled", "ObjectInfo", "Attribute"))
    attribute.attribute_type, attribute.attribute_name = "OBJECT", "wear"
    tree.links.new(about.outputs["Random"], shader.inputs["Roughness"])
    tree.links.new(about.outputs["Color"], shader.inputs["Base Color"])
    tree.links.new(attribute.outputs["Fac"], shader.inputs["Metallic"])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    mesh = quad()
    mesh.materials.append(made)
    for number in range(3):
        thing = link(bpy.data.objects.new(f"Thing {number}", mesh))
        thing.color, thing["wear"] = (number / 4, 0.5, 1.0, 1.0), 0.25 * number
    exported, _ = exporter()
    scene = exported.sync(depsgraph())
    values = [entry["primvars"] for entry in scene.instances]
    assert len({float(value["blender random"][0, 0]) for value in values}) == 3
    assert all(0.0 <= value["blender random"][0, 0] <= 1.0 for value in values)
    for number, value in enumerate(values):
        assert np.allclose(value["blender colour"][0], (number / 4, 0.5, 1.0, 1.0)) and np.isclose(
            value["object wear"][0, 0], 0.25 * number
        )


@pytest.mark.blender
def test_what_moves_comes_out_as_after_a_whole_export(tmp_path):
    import bpy
    import numpy as np
    from recorder import depsgraph, empty, exporter, link, quad

    empty()
    shared, part = quad(), bpy.data.collections.new("Part")
    part.objects.link(bpy.data.objects.new("Inside", shared))
    one, two = (link(bpy.data.objects.new(name, shared)) for name in ("One", "Two"))
    lamp = link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
    axis, placed = link(bpy.data.objects.new("Axis", None)), link(bpy.data.objects.new("Placed", None))
    placed.instance_type, placed.instance_collection = "COLLECTION", part
    two.parent, lamp.parent = axis, two
    carrier = generator("Generator", quad("Carrier"), None)
    moved, _ = exporter()
    moved.sync(depsgraph())
    bpy.app.handlers.depsgraph_update_post.append(lambda _, graph: moved.update(graph))
    things = (one, two, axis, placed, carrier, lamp, part.objects[0])
    edits = [(thing, "location", (1.0 + number, 2.0, 3.0)) for number, thing in enumerate(things)]
    edits += [(one, "scale", (0, 1, 1)), (one, "location", (9, 9, 9)), (one, "scale", (1, 1, 1)), (two, "visible_camera", False)]
    for thing, name, value in edits:
        setattr(thing, name, value)
        graph = depsgraph()
        whole, _ = exporter()
        whole.sync(graph)
        for a, b in zip(moved.scene.instances, whole.scene.instances, strict=True):
            assert (a["name"], a["visibility"]) == (b["name"], b["visibility"]), (thing, name)
            assert np.array_equal(a["transforms"], b["transforms"]), (thing, name)
        assert moved.scene.lights == whole.scene.lights, (thing, name)
    bpy.app.handlers.depsgraph_update_post.clear()
