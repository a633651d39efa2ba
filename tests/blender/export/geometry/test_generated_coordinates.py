"""Generated coordinates of meshes that modifiers deform, against Cycles: they are those of the mesh as it was."""

import pytest


def bent(thing):
    modifier = thing.modifiers.new("Bend", "SIMPLE_DEFORM")
    modifier.deform_method, modifier.deform_axis, modifier.angle = "BEND", "Z", 1.2


def shifted(thing):
    modifier = thing.modifiers.new("Displace", "DISPLACE")
    modifier.direction, modifier.strength, modifier.mid_level = "X", 0.8, 0.0


def smoothed_after(thing):
    shifted(thing)
    thing.modifiers.new("Subdivision", "SUBSURF").render_levels = 2


def by_shape_key(thing):
    thing.shape_key_add(name="Basis")
    key = thing.shape_key_add(name="Long")
    for point in key.data:
        point.co.x *= 1.5
    key.value = 1.0


DEFORMED = {"bent": bent, "shifted": shifted, "subdivided": smoothed_after, "shape key": by_shape_key}


@pytest.mark.blender
@pytest.mark.parametrize("kind", list(DEFORMED))
def test_generated_coordinates_are_those_before_modifiers(tmp_path, kind):
    import bpy
    import numpy as np
    from beside_cycles import both, scene, shining

    scene(16, 16, scale=4.0, samples=1024)
    material, tree, colour = shining()
    place = tree.nodes.new("ShaderNodeTexCoord")
    tree.links.new(place.outputs["Generated"], colour)
    bpy.ops.mesh.primitive_grid_add(size=2.0, x_subdivisions=12, y_subdivisions=12)
    bpy.context.object.data.materials.append(material)
    DEFORMED[kind](bpy.context.object)
    cycles, gonio = both(tmp_path)
    apart = np.abs(cycles - gonio).max(axis=-1)
    assert cycles.max() > 0.5 and apart.max() < 0.04, apart.max()
