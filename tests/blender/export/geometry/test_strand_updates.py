"""Hair and linked lamps in one scene: what an edit in the viewport writes anew."""

import pytest


def field():
    """A ball with fur, strands beside it, and a lamp that lights the strands alone."""
    import bpy
    import numpy as np
    from recorder import empty, link, material

    empty()
    bpy.ops.mesh.primitive_uv_sphere_add(segments=8, ring_count=4)
    ball = bpy.context.object
    ball.name = "Ball"
    ball.data.materials.append(material("Skin")[0])
    ball.data.materials.append(material("Fur")[0])
    ball.modifiers.new("Fur", "PARTICLE_SYSTEM")
    fur = ball.particle_systems[0].settings
    fur.type, fur.count, fur.material = "HAIR", 20, 2
    made = bpy.data.hair_curves.new("Strands")
    made.add_curves([3] * 5)
    made.position_data.foreach_set("vector", np.arange(45, dtype=np.float32))
    strands = link(bpy.data.objects.new("Strands", made))
    lamp = link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
    lit = bpy.data.collections.new("Lit")
    lit.objects.link(strands)
    lamp.light_linking.receiver_collection = lit
    return ball, strands, lit


@pytest.mark.blender
def test_edits_write_what_they_touch(tmp_path):
    import bpy
    from recorder import depsgraph, exporter

    ball, strands, lit = field()
    fur = ball.particle_systems[0].settings
    exported, report = exporter()
    exported.sync(depsgraph())
    scene = exported.scene
    bpy.app.handlers.depsgraph_update_post.append(lambda _, graph: exported.update(graph))

    def edited(edit, *arguments):
        scene.calls.clear()
        edit(*arguments)
        bpy.context.view_layer.update()
        return set(scene.calls)

    def place(thing):
        """The numbers of the instances of an object, those of curves last."""
        return [number for number, entry in enumerate(scene.instances) if entry["name"] == thing.name]

    def lights():
        return scene.lights[0]["linking"]["receivers"]

    assert [entry.get("curves") is not None for entry in scene.instances].count(True) == 2
    assert lights() == {"Only": place(strands)}
    assert edited(setattr, lit.collection_objects[0].light_linking, "link_state", "EXCLUDE") == {"lights"}
    assert lights() == {"Except": place(strands)}
    lit.objects.link(ball)
    assert edited(setattr, lit.collection_objects[1].light_linking, "link_state", "INCLUDE") == {"lights"}
    # An emitter is linked together with its fur.
    assert lights() == {"Only": place(ball)} and len(place(ball)) == 2
    assert edited(setattr, strands, "visible_shadow", False) == {"instances"}
    assert edited(setattr, fur, "root_radius", 3.0) == {"curves", "instances"}
    # Curves take along what they have from the emitter.
    assert "meshes" not in edited(setattr, ball.location, "z", 1.0)
    assert edited(strands.data.update_tag) <= {"curves"}
    # Without fur, the numbers that are left are those of fewer instances.
    edited(setattr, ball.modifiers[0], "show_viewport", False)
    assert lights() == {"Only": place(ball)} and len(place(ball)) == 1
    bpy.app.handlers.depsgraph_update_post.clear()
    assert not report.diagnostics
