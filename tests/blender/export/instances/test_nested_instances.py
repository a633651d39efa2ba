"""Attributes of instances within instances, beside Cycles."""

import pytest

# Metres from one outermost instancer to the next.
APART = 9


def shown():
    """A material whose colour is three attributes of instancers, the first of them in all components."""
    from beside_cycles import shining

    made, tree, colour = shining()
    parts = tree.nodes.new("ShaderNodeCombineXYZ")
    for number, name in enumerate(("inner", "outer", "property")):
        node = tree.nodes.new("ShaderNodeAttribute")
        node.attribute_type, node.attribute_name = "INSTANCER", name
        tree.links.new(node.outputs["Fac"], parts.inputs[number])
    tree.links.new(parts.outputs[0], colour)
    return made


def points(name, step):
    """Two points."""
    import bpy

    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(0.0, 0.0, 0.0), step], [], [])
    return mesh


def numbered(name, first, fill):
    """A tree that puts what `fill` gives on each point, with the attribute `name` that counts from `first`."""
    import bpy
    from test_instancer import instances_with

    def values(tree):
        index, add = tree.nodes.new("GeometryNodeInputIndex"), tree.nodes.new("ShaderNodeMath")
        add.inputs[1].default_value = first
        tree.links.new(index.outputs[0], add.inputs[0])
        return add.outputs[0]

    tree, info = instances_with(name, "FLOAT", values)
    if isinstance(fill, bpy.types.Object):
        info.inputs[0].default_value = fill
        return tree
    end = next(link.to_socket for link in info.outputs["Geometry"].links)
    if isinstance(fill, bpy.types.Collection):
        source = tree.nodes.new("GeometryNodeCollectionInfo")
        source.inputs[0].default_value = fill
    else:
        source, line = tree.nodes.new("GeometryNodeGroup"), tree.nodes.new("GeometryNodeMeshLine")
        source.node_tree = fill
        line.inputs["Count"].default_value, line.inputs["Offset"].default_value = 2, (0.0, 2.0, 0.0)
        tree.links.new(line.outputs[0], source.inputs[0])
    tree.links.new(source.outputs[0], end)
    return tree


def with_nodes(name, tree, step):
    """An object of two points with geometry nodes."""
    import bpy

    made = bpy.data.objects.new(name, points(name, step))
    made.modifiers.new("Nodes", "NODES").node_group = tree
    return made


def collection(name, *things):
    import bpy

    made = bpy.data.collections.new(name)
    for thing in things:
        made.objects.link(thing)
    return made


def placed(collection, **properties):
    """An empty that instances a collection."""
    import bpy

    made = bpy.data.objects.new("Empty", None)
    made.instance_type, made.instance_collection = "COLLECTION", collection
    for name, value in properties.items():
        made[name] = value
    return made


def by_vertices(child):
    """An object whose two vertices instance a child."""
    import bpy
    from recorder import link

    made = bpy.data.objects.new("Vertices", points("Vertices", (4.0, 0.0, 0.0)))
    made.instance_type, link(child).parent = "VERTS", made
    return made


def instancers():
    """Instancers of all kinds within one another."""
    import bpy
    from recorder import quad

    thing, alone = (bpy.data.objects.new(name, quad()) for name in ("Thing", "Alone"))
    made = shown()
    for each in (thing, alone):
        each.data.materials.append(made)
    alone.location, alone["property"] = (1.0, -2.0, 0.0), 0.125
    inner = with_nodes("Inner", numbered("inner", 0.5, thing), (0.0, 2.0, 0.0))
    both, along = collection("Both", alone, inner), (4.0, 0.0, 0.0)
    nested = collection("Nested", placed(both, property=0.25))
    return (
        with_nodes("Objects", numbered("outer", 1.0, inner), along),
        with_nodes("Geometries", numbered("outer", 2.0, numbered("inner", 3.0, thing)), along),
        with_nodes("Collection", numbered("outer", 0.75, both), along),
        placed(both, property=0.5),
        placed(nested, outer=0.7),
        with_nodes("Nested collection", numbered("outer", 0.25, nested), along),
        by_vertices(with_nodes("Child", numbered("inner", 1.5, thing), (0.0, 2.0, 0.0))),
        # The innermost that has the attribute counts.
        with_nodes("Same", numbered("inner", 9.0, inner), along),
        with_particles(made),
    )


def with_particles(cover):
    """A strand of hair that shows a quad, with a property of the settings and one of the object of the same name."""
    import bpy
    from recorder import quad

    thing = bpy.data.objects.new("Upright", quad())
    thing.data.vertices.foreach_set("co", [0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1])
    thing.data.materials.append(cover)
    mesh = bpy.data.meshes.new("Wall")
    mesh.from_pydata([(0, -0.01, 0.49), (0, 0.01, 0.49), (0, 0.01, 0.51), (0, -0.01, 0.51)], [], [(0, 1, 2, 3)])
    made = bpy.data.objects.new("Particles", mesh)
    made.modifiers.new("Particles", "PARTICLE_SYSTEM")
    settings = made.particle_systems[0].settings
    settings.count, settings.type, settings.hair_length, settings.particle_size = 1, "HAIR", 1.0, 1.0
    settings.render_type, settings.instance_object, settings.use_rotation_instance = "OBJECT", thing, True
    settings["property"], made["property"], made["outer"] = 0.6, 0.3, 0.4
    return made


@pytest.mark.blender
def test_attributes_of_instances_within_instances(tmp_path):
    import bpy
    import numpy as np
    from beside_cycles import both, close, scene
    from recorder import link

    count = 9
    made = scene(count * APART, 8)
    made.camera.location = (0.5 * count * APART, 1.0, 50.0)
    for number, instancer in enumerate(instancers()):
        link(instancer).location.x = number * APART
    assert number == count - 1
    pair = both(tmp_path)
    close(pair, 1e-5)
    values = [{tuple(np.round(each, 3)) for each in pair[1][:, APART * k : APART * (k + 1)].reshape(-1, 3)} for k in range(count)]
    assert {(0.5, 1.0, 0.0), (1.5, 2.0, 0.0)} <= values[0] and {(3.0, 2.0, 0.0), (4.0, 3.0, 0.0)} <= values[1]
    assert {(0.5, 0.75, 0.0), (1.5, 1.75, 0.0), (0.0, 0.75, 0.125)} <= values[2]
    assert {(0.5, 0.0, 0.5), (1.5, 0.0, 0.5), (0.0, 0.0, 0.5)} <= values[3]
    # The outermost empty's property alone counts, and the object's own.
    assert {(0.5, 0.7, 0.0), (0.0, 0.7, 0.125)} <= values[4] and {(0.5, 0.25, 0.0), (1.5, 1.25, 0.0)} <= values[5]
    assert {(1.5, 0.0, 0.0), (2.5, 0.0, 0.0)} <= values[6] and {(0.5, 0.0, 0.0), (1.5, 0.0, 0.0)} <= values[7]
    # Settings of particles come before the instancer's object.
    assert (0.0, 0.4, 0.6) in values[8], values[8]
