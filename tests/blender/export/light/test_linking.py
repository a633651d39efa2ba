"""Light linking and shadow linking as Blender's collections say."""

import pytest


@pytest.mark.blender
def test_links_of_lamps_and_meshes(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link, material, quad

    empty()
    mesh = quad()
    things = [link(bpy.data.objects.new(name, mesh)) for name in "ABC"]
    a, b, c = things
    made, tree, end = material("Glow")
    tree.links.new(tree.nodes.new("ShaderNodeEmission").outputs[0], end.inputs["Surface"])
    shining = link(bpy.data.objects.new("S", quad()))
    shining.data.materials.append(made)
    lamp = link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
    exported, _ = exporter()

    def collection(name, states, children=()):
        found = bpy.data.collections.new(name)
        for thing in states:
            found.objects.link(thing)
        for thing, entry in zip(found.objects, found.collection_objects, strict=True):
            entry.light_linking.link_state = states[thing]
        for child, state in children:
            found.children.link(child)
            found.collection_children[-1].light_linking.link_state = state
        return found

    def links(name):
        scene = exported.sync(depsgraph())
        names = [entry["name"] for entry in scene.instances]
        if name == "Lamp":
            found = scene.lights[0].get("linking")
        else:
            found = scene.instances[names.index(name)]["linking"]
        if found is None:
            return None

        def named(one):
            return one if one == "All" else {kind: sorted(names[number] for number in sets) for kind, sets in one.items()}

        return named(found["receivers"]), named(found["blockers"])

    assert links("Lamp") is None and links("S") is None
    lamp.light_linking.receiver_collection = collection("Included", {a: "INCLUDE", b: "EXCLUDE"})
    assert links("Lamp") == ({"Only": ["A"]}, "All")
    lamp.light_linking.receiver_collection = collection("Excluded", {b: "EXCLUDE"})
    lamp.light_linking.blocker_collection = collection("Blockers", {c: "INCLUDE"})
    assert links("Lamp") == ({"Except": ["B"]}, {"Only": ["C"]})
    # An object's own state counts more than that of the child collection it is in.
    inner = bpy.data.collections.new("Inner")
    for thing in (a, b):
        inner.objects.link(thing)
    lamp.light_linking.receiver_collection = collection("Nested", {b: "EXCLUDE"}, [(inner, "INCLUDE")])
    lamp.light_linking.blocker_collection = bpy.data.collections.new("Nothing")
    assert links("Lamp") == ({"Only": ["A"]}, "All")
    shining.light_linking.receiver_collection = collection("Shone on", {c: "EXCLUDE"})
    assert links("S") == ({"Except": ["C"]}, "All")


@pytest.mark.blender
def test_the_picture_of_links(tmp_path):
    import bpy
    import numpy as np
    from recorder import depsgraph, empty, link, module, quad

    import gonio

    empty()
    mesh = quad()
    left, right = (link(bpy.data.objects.new(name, mesh)) for name in ("Left", "Right"))
    left.location.x, right.location.x = -1.0, 1.0
    lamp = link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
    lamp.location = (0.5, 0.5, 2.0)
    only = bpy.data.collections.new("Only")
    only.objects.link(left)
    camera = link(bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera")))
    camera.data.type, camera.data.ortho_scale, camera.location = "ORTHO", 4.0, (0.5, 0.5, 5.0)
    bpy.context.scene.camera = camera
    exported = module("export").Exporter(module("report").Report())

    def colour():
        scene = exported.sync(depsgraph())
        exported.settings(depsgraph(), width=64, height=64, passes=("color",))
        scene.set(samples=8)
        with gonio.Render(scene) as rendering:
            rendering.wait()
            return np.asarray(rendering.film()["color"])[:, :, 1]

    plain = colour()
    lamp.light_linking.receiver_collection = only
    linked = colour()
    assert plain[32, 8:24].max() > 0.0 and plain[32, 40:56].max() > 0.0
    assert linked[32, 8:24].max() > 0.0 and linked[32, 40:56].max() == 0.0


@pytest.mark.blender
def test_links_name_the_right_things_where_one_fails(tmp_path):
    import sys

    import bpy
    from recorder import depsgraph, empty, exporter, link, quad

    empty()
    mesh = quad()
    for name in "ABC":
        link(bpy.data.objects.new(name, mesh))
    lamp = link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
    chosen = bpy.data.collections.new("Chosen")
    chosen.objects.link(bpy.data.objects["C"])
    lamp.light_linking.receiver_collection = chosen
    exported, report = exporter()
    module = sys.modules[type(exported._instances).__module__]
    sound = module.linking

    def failing(source, numbers):
        if source.name == "A":
            raise ValueError("no links")
        return sound(source, numbers)

    module.linking = failing
    try:
        scene = exported.sync(depsgraph())
    finally:
        module.linking = sound
    only = scene.lights[0]["linking"]["receivers"]["Only"]
    assert [scene.instances[number]["name"] for number in only] == ["C"]
    assert any("no links" in line.text for line in report.diagnostics)
