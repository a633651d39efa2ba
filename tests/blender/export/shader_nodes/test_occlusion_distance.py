"""Ambient Occlusion nodes whose distance is 0, as files from before Blender 2.8 have them: the world's distance, against Cycles."""

import pytest


def corner(of_world):
    """A floor under a wall, 4 x 4 m, that shines by how open it is."""
    import bpy
    from beside_cycles import scene, shining
    from recorder import link

    made = scene(8, 8, scale=4.0, samples=256)
    look, tree, colour = shining()
    node = tree.nodes.new("ShaderNodeAmbientOcclusion")
    node.inputs["Distance"].default_value = 0.0
    tree.links.new(node.outputs["Color"], colour)
    mesh = bpy.data.meshes.new("Corner")
    points = [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0), (2, 2, 3), (-2, 2, 3)]
    mesh.from_pydata(points, [], [(0, 1, 2, 3), (3, 2, 4, 5)])
    mesh.materials.append(look)
    link(bpy.data.objects.new("Corner", mesh))
    if of_world is None:
        made.world = None
    else:
        made.world.light_settings.distance = of_world


@pytest.mark.blender
def test_no_distance_is_the_worlds(tmp_path):
    from beside_cycles import both, close

    means = []
    for of_world in (0.0, 0.7, 2.0, None):
        corner(of_world)
        pair = both(tmp_path)
        close(pair, 0.02)
        means.append(float(pair[1].mean()))
    assert means[0] == pytest.approx(1.0) and means == sorted(means, reverse=True) and means[2] < 0.95, means
