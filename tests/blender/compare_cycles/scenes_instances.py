"""What instancers give their instances: attributes through several levels, light and shadow by links; and a border of an animation."""

from math import radians

import bpy
from stage import ball, blank, box, camera, diffuse, even_world, lamp, link, node, plane, principled, socket, surface


def by_instancer() -> bpy.types.Material:
    """Coloured by attributes of the inner and of the outer instances, and by a property of the outermost instancer."""
    made, tree = blank("By instancer")
    values = [node(tree, "ShaderNodeAttribute", attribute_type="INSTANCER", attribute_name=name) for name in ("inner", "outer", "whole")]
    red, green, blue = (socket(each.outputs, "Fac") for each in values)
    mixed = node(tree, "ShaderNodeCombineColor", Red=red, Green=green, Blue=blue)
    surface(tree, node(tree, "ShaderNodeBsdfPrincipled", Base_Color=mixed.outputs[0], Roughness=0.5))
    return made


def row(name: str, thing: bpy.types.Object, count: int, step: tuple[float, float, float], attribute: str) -> bpy.types.Object:
    """A row of instances with an attribute that grows from 0.1 to 0.9; not in the scene."""
    tree = bpy.data.node_groups.new(name, "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    places = node(tree, "GeometryNodeMeshLine", Count=count, Offset=step)
    source = node(tree, "GeometryNodeObjectInfo", Object=thing, As_Instance=True)
    placed = node(tree, "GeometryNodeInstanceOnPoints", Points=places.outputs[0], Instance=source.outputs["Geometry"])
    number = node(tree, "GeometryNodeInputIndex")
    grown = node(tree, "ShaderNodeMath", operation="MULTIPLY_ADD")
    tree.links.new(number.outputs[0], grown.inputs[0])
    grown.inputs[1].default_value, grown.inputs[2].default_value = 0.8 / (count - 1), 0.1
    stored = node(tree, "GeometryNodeStoreNamedAttribute", data_type="FLOAT", domain="INSTANCE", Geometry=placed.outputs[0], Name=attribute)
    tree.links.new(grown.outputs[0], stored.inputs["Value"])
    node(tree, "NodeGroupOutput", Geometry=stored.outputs[0])
    made = bpy.data.objects.new(name, bpy.data.meshes.new(name))
    made.modifiers.new("Row", "NODES").node_group = tree
    return made


def nested_attributes() -> None:
    """Rows of rows of balls, by geometry nodes alone and by a collection that an empty instances."""
    plane(diffuse((0.5, 0.5, 0.5)))
    even_world(0.6)
    lamp("POINT", 90.0, (-1.6, -2.2, 3.6), shadow_soft_size=0.3, use_soft_falloff=False)
    seed = ball(by_instancer(), 0.16, location=(0.0, 0.0, -5.0))
    inner = row("Inner", seed, 4, (0.0, 0.45, 0.0), "inner")
    outer = row("Outer", inner, 4, (0.42, 0.0, 0.0), "outer")
    bpy.context.scene.collection.objects.link(outer)
    outer.location, outer["whole"] = (-1.75, -0.7, 0.2), 0.2
    inside = bpy.data.collections.new("Inside")
    inside.objects.link(row("Row", inner, 4, (0.42, 0.0, 0.0), "outer"))
    holder = link("Holder", None, location=(0.35, -0.7, 0.2))
    holder.instance_type, holder.instance_collection, holder["whole"] = "COLLECTION", inside, 0.8
    camera((0.0, -6.0, 4.0), (0.0, 0.0, 0.2), lens=55.0)


def linked_instances() -> None:
    """Three instances of a collection: a lamp lights one of them alone, another lamp's light passes one of them."""
    even_world(0.15)
    plane(diffuse((0.6, 0.6, 0.6)))
    inside = bpy.data.collections.new("Inside")
    plastic = principled(Base_Color=(0.7, 0.7, 0.7), Roughness=0.5)
    for thing in (ball(plastic, 0.3, location=(0.0, 0.0, 0.9)), box(diffuse(), 0.6, location=(0.0, 0.0, 0.3))):
        bpy.context.scene.collection.objects.unlink(thing)
        inside.objects.link(thing)
    holders = [link(f"Holder {n}", None, location=(1.3 * n - 1.3, 0.0, 0.0), rotation=(0.0, 0.0, 0.3 * n)) for n in range(3)]
    for holder in holders:
        holder.instance_type, holder.instance_collection = "COLLECTION", inside
    warm = lamp("POINT", 60.0, (-1.6, -2.2, 2.6), color=(1.0, 0.4, 0.2), shadow_soft_size=0.2, use_soft_falloff=False)
    cold = lamp("AREA", 150.0, (0.5, -1.5, 3.4), (0.4, 0.1, 0.0), color=(0.4, 0.6, 1.0), size=0.6)
    for emitter, kind, holder, state in ((warm, "receiver", holders[1], "INCLUDE"), (cold, "blocker", holders[2], "EXCLUDE")):
        chosen = bpy.data.collections.new(kind)
        chosen.objects.link(holder)
        chosen.collection_objects[0].light_linking.link_state = state
        setattr(emitter.light_linking, f"{kind}_collection", chosen)
    camera((0.0, -6.5, 2.6), (0.0, 0.2, 0.6), lens=50.0)


def bordered() -> None:
    """A part of the picture, with data kept from one rendering to the next."""
    even_world(0.3)
    plane(diffuse((0.6, 0.6, 0.6)))
    ball(principled(Base_Color=(0.15, 0.4, 0.7), Roughness=0.4), 0.6, location=(-0.5, 0.2, 0.6))
    box(diffuse((0.4, 0.6, 0.3)), location=(0.9, 0.4, 0.5), rotation=(0.0, 0.0, radians(20)))
    lamp("POINT", 90.0, (-1.6, -1.2, 2.6), shadow_soft_size=0.3, use_soft_falloff=False)
    camera((0.0, -6.5, 2.4), (0.0, 0.3, 0.8), lens=50.0)
    render = bpy.context.scene.render
    render.use_persistent_data = render.use_border = render.use_crop_to_border = True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.25, 0.875, 0.125, 0.625
