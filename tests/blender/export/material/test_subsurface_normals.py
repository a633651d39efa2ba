"""Normals that are the same everywhere light what scatters on a surface, and what comes out from under it, as in Cycles."""

import pytest


def leaning(kind, lean, **values):
    """A material of one shader whose normal leans towards +x by a slope."""
    from recorder import material

    made, tree, end = material(kind)
    shader, normal = tree.nodes.new(kind), tree.nodes.new("ShaderNodeNormal")
    normal.outputs[0].default_value = (lean, 0.0, 1.0)
    for name, value in values.items():
        shader.inputs[name.replace("_", " ")].default_value = value
    tree.links.new(normal.outputs[0], shader.inputs["Normal"])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    return made


MATTE = {"Specular_IOR_Level": 0.0, "Base_Color": (0.8, 0.6, 0.4, 1.0)}
SKIN = {"Subsurface_Weight": 1.0, "Subsurface_Scale": 0.05, **MATTE}
WAX = {"Scale": 0.05, "Color": (0.8, 0.6, 0.4, 1.0)}


@pytest.mark.blender
@pytest.mark.parametrize(("kind", "values"), [("BsdfPrincipled", MATTE), ("BsdfPrincipled", SKIN), ("SubsurfaceScattering", WAX)])
def test_even_normals_bend_what_is_seen_and_what_comes_out(tmp_path, kind, values):
    import bpy
    from beside_cycles import both, scene
    from recorder import link

    means = []
    for lean in (0.0, 0.4):
        scene(32, 32, scale=4.0, samples=64)
        bpy.ops.mesh.primitive_plane_add(size=40.0)
        bpy.context.object.data.materials.append(leaning(f"ShaderNode{kind}", lean, **values))
        sun = link(bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN")))
        sun.rotation_euler = (0.0, 0.9, 0.0)
        cycles, gonio = (picture.mean(axis=(0, 1)) for picture in both(tmp_path))
        assert gonio == pytest.approx(cycles, rel=0.02), lean
        means.append(gonio)
    assert (means[1] > 1.15 * means[0]).all(), means
