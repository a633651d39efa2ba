"""Adaptive subdivision of the kind *Simple*: smooth faces have the normals of the mesh as it was modelled, beside Cycles."""

import pytest

# What the noise of edges in a picture of 64 pixels comes to in the mean; Blender's own normals of the cut mesh come to 0.02 and more.
ALIKE = 0.002


def normals():
    """A material that shows the normal."""
    from beside_cycles import shining

    made, tree, colour = shining("Normal")
    geometry, scaled = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("NewGeometry", "VectorMath"))
    scaled.operation = "MULTIPLY_ADD"
    scaled.inputs[1].default_value = scaled.inputs[2].default_value = (0.5, 0.5, 0.5)
    tree.links.new(geometry.outputs["Normal"], scaled.inputs[0])
    tree.links.new(scaled.outputs[0], colour)
    return made


def block(form):
    """A smooth cube or a smooth frustum of six sides."""
    import bmesh
    import bpy
    from beside_cycles import link

    made = bmesh.new()
    if form == "frustum":
        bmesh.ops.create_cone(made, segments=6, radius1=1.5, radius2=0.7, depth=1.0, cap_ends=True)
    else:
        bmesh.ops.create_cube(made, size=2.2)
    for number, face in enumerate(made.faces):
        face.smooth = form != "half flat" or number % 2 == 0
    for number, edge in enumerate(made.edges):
        edge.smooth = form != "sharp" or number % 3 != 0
    mesh = bpy.data.meshes.new(form)
    made.to_mesh(mesh)
    mesh.materials.append(normals())
    thing = link(bpy.data.objects.new(form, mesh))
    thing.rotation_euler = (0.6, 0.4, 0.3)
    return thing


def subdivided(thing, levels):
    """Adds the modifier."""
    import bpy

    modifier = thing.modifiers.new("Subdivision", "SUBSURF")
    modifier.subdivision_type, modifier.levels, modifier.render_levels = "SIMPLE", levels, levels
    if bpy.app.version >= (5, 0, 0):
        modifier.use_adaptive_subdivision = True
    else:
        bpy.context.scene.cycles.feature_set, thing.cycles.use_adaptive_subdivision = "EXPERIMENTAL", True


@pytest.mark.blender
@pytest.mark.parametrize("levels", [1, 2, 3])
@pytest.mark.parametrize("form", ["cube", "sharp", "half flat", "frustum"])
def test_normals_are_those_that_were_modelled(tmp_path, form, levels):
    import numpy as np
    from beside_cycles import both, scene

    scene(64, 64, scale=4, samples=16)
    subdivided(block(form), levels)
    cycles, gonio = both(tmp_path)
    assert np.abs(cycles - gonio).mean() < ALIKE


@pytest.mark.blender
def test_modifiers_before_may_bend_the_mesh(tmp_path):
    import numpy as np
    from beside_cycles import both, scene

    scene(64, 64, scale=4, samples=16)
    thing = block("cube")
    bent = thing.modifiers.new("Taper", "SIMPLE_DEFORM")
    bent.deform_method, bent.factor, bent.deform_axis = "TAPER", -0.4, "Z"
    subdivided(thing, 2)
    cycles, gonio = both(tmp_path)
    assert np.abs(cycles - gonio).mean() < ALIKE


@pytest.mark.blender
def test_where_modifiers_before_add_faces_normals_are_blenders():
    """Which faces were cut is not known there: four copies that are cut once look like one that is cut twice."""
    import bpy
    import numpy as np
    from recorder import depsgraph, exporter, link, quad

    for thing in list(bpy.data.objects):
        bpy.data.objects.remove(thing)
    thing = link(bpy.data.objects.new("Copies", quad("Copies")))
    thing.data.polygons.foreach_set("use_smooth", [True] * len(thing.data.polygons))
    copies = thing.modifiers.new("Copies", "ARRAY")
    copies.count = 4
    subdivided(thing, 1)
    made, report = exporter()
    made.sync(depsgraph())
    [mesh] = [mesh for mesh in made.scene.meshes if len(mesh["points"])]
    assert len(mesh["faces"]) == 32 and np.allclose(np.linalg.norm(mesh["normals"], axis=1), 1.0)
    assert not report.diagnostics
