"""Light linking and shadow linking to what instancers make, beside Cycles."""

import pytest


def inside(name, *things):
    """A collection of objects that is not in the scene itself."""
    import bpy

    made = bpy.data.collections.new(name)
    for thing in things:
        made.objects.link(thing)
    return made


def instance_of(collection, name, place=(0.0, 0.0, 0.0)):
    """An empty that instances a collection."""
    import bpy

    made = bpy.data.objects.new(name, None)
    made.instance_type, made.instance_collection, made.location = "COLLECTION", collection, place
    return made


def point_mesh():
    """A mesh of one vertex."""
    import bpy

    mesh = bpy.data.meshes.new("Point")
    mesh.from_pydata([(0.0, 0.0, 0.0)], [], [])
    return mesh


def by_vertices(thing, name, place):
    """An instancer of a child on its vertex."""
    import bpy
    from recorder import link

    made = link(bpy.data.objects.new(name, point_mesh()))
    made.instance_type, made.location = "VERTS", place
    child = link(thing.copy())
    child.parent = made
    return made


def by_nodes(thing, name, place):
    """An instancer by geometry nodes."""
    import bpy
    from recorder import link
    from test_instancer import instances_with

    made = link(bpy.data.objects.new(name, point_mesh()))
    made.location = place
    group, info = instances_with("number", "INT", lambda tree: tree.nodes.new("GeometryNodeInputIndex").outputs[0])
    info.inputs[0].default_value = thing
    made.modifiers.new("Nodes", "NODES").node_group = group
    return made


def by_particles(thing, name, place):
    """An instancer by one strand of hair on a small face, which stands its instance on its side."""
    import bpy
    from recorder import link

    mesh = bpy.data.meshes.new("Face")
    mesh.from_pydata([(-0.01, -0.01, 0), (0.01, -0.01, 0), (0.01, 0.01, 0), (-0.01, 0.01, 0)], [], [(0, 1, 2, 3)])
    made = link(bpy.data.objects.new(name, mesh))
    made.location = place
    made.modifiers.new("Particles", "PARTICLE_SYSTEM")
    settings = made.particle_systems[0].settings
    settings.count, settings.type, settings.hair_length, settings.particle_size = 1, "HAIR", 1.0, 1.0
    settings.render_type, settings.instance_object, settings.use_rotation_instance = "OBJECT", thing, True
    return made


def instancers(thing, upright, inner):
    """One instancer of each kind and one of each again, side by side, those of the first half named in a collection with the `inner` objects."""
    import bpy
    from recorder import link

    whole = inside("Whole", thing)
    made = []
    for half in range(2):
        for number, make in enumerate((by_vertices, by_nodes, by_particles)):
            made.append(make(upright if make is by_particles else thing, f"{make.__name__} {half}", (2.0 * number + 8.0 * half, 0.0, 1.0)))
        made.append(link(instance_of(whole, f"collection {half}", (6.0 + 8.0 * half, 0.0, 1.0))))
    for name, place in (("outer", 16.0), ("other", 18.0)):
        nested = inside(f"Nested {name}", instance_of(whole, f"inner {name}"))
        made.append(link(instance_of(nested, name, (place, 0.0, 1.0))))
    # The outermost instancer and the object count, what is between them does not.
    chosen = [each for each in made if each.name.endswith("0")] + [bpy.data.objects["outer"], bpy.data.objects["inner other"]]
    return inside("Chosen", *chosen, *inner)


@pytest.mark.blender
def test_links_to_instancers_beside_cycles(tmp_path):
    import bpy
    import numpy as np
    from beside_cycles import both, close, scene
    from recorder import link, quad
    from scenes import diffuse

    for inner, state in ((False, "INCLUDE"), (True, "INCLUDE"), (False, "EXCLUDE")):
        made = scene(20, 6, samples=256)
        made.cycles.max_bounces = 0
        made.camera.location = (10.0, 0.0, 5.0)
        thing = bpy.data.objects.new("Thing", quad())
        thing.data.materials.append(diffuse("White", (1.0, 1.0, 1.0)))
        floor = link(bpy.data.objects.new("Floor", thing.data.copy()))
        floor.location, floor.scale = (0.0, -3.0, 0.0), (20.0, 7.0, 1.0)
        # Hair turns x up.
        upright = bpy.data.objects.new("Upright", thing.data.copy())
        upright.data.vertices.foreach_set("co", [0, 0, 0, 0, 0, 1, 0, -1, 1, 0, -1, 0])
        chosen = instancers(thing, upright, (thing, upright) if inner else ())
        for entry in chosen.collection_objects:
            entry.light_linking.link_state = state
        for name, colour, kind in (("Lit", (1, 0, 0), "receiver_collection"), ("Shaded", (0, 1, 0), "blocker_collection")):
            sun = link(bpy.data.objects.new(name, bpy.data.lights.new(name, "SUN")))
            sun.data.energy, sun.data.angle, sun.data.color, sun.rotation_euler.x = 3.0, 0.0, colour, 0.78
            setattr(sun.light_linking, kind, chosen)
        pair = both(tmp_path)
        close(pair, 0.05)
        lit, shadow = pair[1][2, ::2, 0] > 0.1, pair[1][1, ::2, 1] < 0.1
        # Nothing named counts for those whose own instancer is none of the chosen, but for the object itself; vertices have a copy of it.
        first = np.array([True] * 4 + [False] + [inner] * 3 + [True, inner])
        assert (lit == (first == (state == "INCLUDE"))).all(), (inner, state, lit)
        assert (shadow == (first == (state == "INCLUDE"))).all(), (inner, state, shadow)
