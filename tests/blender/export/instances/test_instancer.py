"""Attributes and properties that instancers give their instances."""

import pytest


def instances_with(name, kind, values):
    """A tree of geometry nodes that puts an object on each point of a mesh, with an attribute of the instances."""
    import bpy

    tree = bpy.data.node_groups.new("Instances", "GeometryNodeTree")
    for side in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=side, socket_type="NodeSocketGeometry")
    names = (
        "NodeGroupInput",
        "NodeGroupOutput",
        "GeometryNodeObjectInfo",
        "GeometryNodeInstanceOnPoints",
        "GeometryNodeStoreNamedAttribute",
    )
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


def tinted(output="Color", socket="Color"):
    """A material that shines by the attribute `tint` of the instancer."""
    from recorder import material

    made, tree, end = material()
    node, shader = tree.nodes.new("ShaderNodeAttribute"), tree.nodes.new("ShaderNodeEmission")
    node.attribute_type, node.attribute_name = "INSTANCER", "tint"
    tree.links.new(node.outputs[output], shader.inputs[socket])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    return made


@pytest.mark.blender
def test_instances_have_the_attributes_of_their_instancer(tmp_path):
    import bpy
    import numpy as np
    from recorder import depsgraph, empty, exporter, link, quad

    kinds = {
        "FLOAT_VECTOR": lambda tree: tree.nodes.new("GeometryNodeInputPosition").outputs[0],
        "INT": lambda tree: tree.nodes.new("GeometryNodeInputIndex").outputs[0],
    }
    for kind, values in kinds.items():
        empty()
        made = tinted()
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
    from recorder import depsgraph, empty, exporter, link, quad

    empty()
    made = tinted("Fac", "Strength")
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
def test_many_instances_and_instances_with_ids(tmp_path):
    import time

    import bpy
    import numpy as np
    from recorder import depsgraph, empty, exporter, link, quad

    empty()
    made = tinted()
    thing = link(bpy.data.objects.new("Thing", quad()))
    thing.data.materials.append(made)
    points, count = bpy.data.meshes.new("Points"), 5000
    points.from_pydata([(float(number), 0.0, 1.0) for number in range(count)], [], [])
    # IDs run the other way.
    points.attributes.new("id", "INT", "POINT").data.foreach_set("value", np.arange(count, 0, -1, dtype=np.int32))
    holder = link(bpy.data.objects.new("Holder", points))
    group, info = instances_with("tint", "INT", lambda tree: tree.nodes.new("GeometryNodeInputIndex").outputs[0])
    holder.modifiers.new("Nodes", "NODES").node_group = group
    info.inputs[0].default_value = thing
    graph = depsgraph()
    exported, report = exporter()
    start = time.perf_counter()
    scene = exported.sync(graph)
    assert time.perf_counter() - start < 2.0
    seen = 0
    for entry in scene.instances:
        placed = entry["transforms"][:, 2, 3] == 1.0
        assert np.array_equal(entry["primvars"]["instancer tint"][placed, 0], entry["transforms"][placed, 0, 3])
        seen += int(placed.sum())
    assert seen == count and not report.diagnostics


@pytest.mark.blender
def test_objects_of_instanced_collections_have_the_attribute_of_their_instance(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link, quad

    empty()
    made = tinted()
    inside = bpy.data.collections.new("Inside")
    for number in range(2):
        thing = bpy.data.objects.new(f"Thing {number}", quad())
        thing.data.materials.append(made)
        thing.location.y = 2.0 * number
        inside.objects.link(thing)
    points = bpy.data.meshes.new("Points")
    points.from_pydata([(float(number), 0.0, 0.0) for number in range(3)], [], [])
    holder = link(bpy.data.objects.new("Holder", points))
    group, info = instances_with("tint", "INT", lambda tree: tree.nodes.new("GeometryNodeInputIndex").outputs[0])
    collection = group.nodes.new("GeometryNodeCollectionInfo")
    collection.inputs[0].default_value = inside
    group.links.new(collection.outputs[0], next(link.to_socket for link in info.outputs["Geometry"].links))
    holder.modifiers.new("Nodes", "NODES").node_group = group
    exported, report = exporter()
    found = {}
    for entry in exported.sync(depsgraph()).instances:
        for matrix, value in zip(entry["transforms"], entry["primvars"]["instancer tint"], strict=True):
            found[tuple(float(x) for x in matrix[:2, 3])] = float(value[0])
    assert found == {(float(x), y): float(x) for x in range(3) for y in (0.0, 2.0)} and not report.diagnostics


def waved():
    """A tree of geometry nodes that stores the places of points as the attribute `wave`."""
    import bpy

    tree = bpy.data.node_groups.new("Waved", "GeometryNodeTree")
    for side in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=side, socket_type="NodeSocketGeometry")
    names = ("NodeGroupInput", "NodeGroupOutput", "GeometryNodeInputPosition", "GeometryNodeStoreNamedAttribute")
    start, stop, place, store = (tree.nodes.new(each) for each in names)
    store.data_type, store.domain = "FLOAT_VECTOR", "POINT"
    store.inputs["Name"].default_value = "wave"
    tree.links.new(start.outputs[0], store.inputs[0])
    tree.links.new(place.outputs[0], store.inputs["Value"])
    tree.links.new(store.outputs[0], stop.inputs[0])
    return tree


@pytest.mark.blender
def test_curves_are_instancers_too(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link, quad

    for kind in ("NURBS", "POLY"):
        empty()
        thing = link(bpy.data.objects.new("Thing", quad()))
        thing.data.materials.append(tinted())
        thing.location.z = -50.0
        curve = bpy.data.curves.new("Way", "CURVE")
        curve.dimensions = "3D"
        line = curve.splines.new(kind)
        line.points.add(4)
        for number, point in enumerate(line.points):
            point.co = (float(number), 0.2 * number * number, 1.0, 1.0)
        if kind == "NURBS":
            line.use_endpoint_u = True
        holder = link(bpy.data.objects.new("Way", curve))
        group, info = instances_with("tint", "FLOAT_VECTOR", lambda tree: tree.nodes.new("GeometryNodeInputPosition").outputs[0])
        holder.modifiers.new("Nodes", "NODES").node_group = group
        info.inputs[0].default_value = thing
        made, report = exporter()
        scene = made.sync(depsgraph())
        seen = 0
        for entry in scene.instances:
            assert len(entry["materials"]) == 1, kind
            for matrix, tint in zip(entry["transforms"], entry["primvars"]["instancer tint"], strict=True):
                if matrix[2, 3] == 1.0:
                    assert tuple(tint[:3]) == pytest.approx(tuple(matrix[:3, 3]), abs=1e-5), kind
                    seen += 1
        assert seen >= 5 and not report.diagnostics, (kind, seen, report.diagnostics)


@pytest.mark.blender
def test_materials_see_attributes_that_geometry_nodes_store(tmp_path):
    import bpy
    import numpy as np
    from beside_cycles import both, close, scene, shining
    from recorder import link

    made = scene(8, 4, scale=8.0)
    for number, place in enumerate(((-2.0, 0.0, 0.0), (2.0, 0.0, 0.0))):
        if number:
            bpy.ops.mesh.primitive_cube_add(size=1.9, location=place)
            thing = bpy.context.object
        else:
            mesh = bpy.data.meshes.new("Quad")
            mesh.from_pydata([(0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)], [], [(0, 1, 2, 3)])
            thing = link(bpy.data.objects.new("Quad", mesh))
            thing.location = place
        material, tree, colour = shining()
        attribute = tree.nodes.new("ShaderNodeAttribute")
        attribute.attribute_name = "wave"
        tree.links.new(attribute.outputs["Vector"], colour)
        thing.data.materials.append(material)
        thing.modifiers.new("Nodes", "NODES").node_group = waved()
    made.cycles.samples = 256
    pair = [np.maximum(picture, 0.0) for picture in both(tmp_path)]
    assert pair[0].max() > 0.9
    close(pair, 0.02)
