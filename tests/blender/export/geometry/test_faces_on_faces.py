"""Faces that lie on each other, one of them transparent, in closed form and beside Cycles."""

import pytest


def plane(name, size, material, turn=(0.0, 0.0, 0.0), height=0.0):
    """A square about the middle, turned."""
    import bpy
    from beside_cycles import link

    mesh = bpy.data.meshes.new(name)
    half = 0.5 * size
    mesh.from_pydata([(-half, -half, 0), (half, -half, 0), (half, half, 0), (-half, half, 0)], [], [(0, 1, 2, 3)])
    mesh.materials.append(material)
    thing = link(bpy.data.objects.new(name, mesh))
    thing.rotation_euler, thing.location.z = turn, height


def sheet(colour):
    """A Transparent shader of this colour."""
    from beside_cycles import material

    made, tree, end = material("Sheet")
    shader = tree.nodes.new("ShaderNodeBsdfTransparent")
    shader.inputs["Color"].default_value = (*colour, 1.0)
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    return made


def wall(value):
    """A material that shines evenly."""
    from beside_cycles import shining

    made, _, colour = shining("Wall")
    colour.default_value = (value, value, value, 1.0)
    return made


@pytest.mark.blender
def test_a_clear_decal_hides_nothing_of_its_wall(tmp_path):
    import numpy as np
    from beside_cycles import both, close, scene

    for turn in [(0.0, 0.0, 0.0), (0.3, 0.2, 0.1)]:
        made = scene(8, 8, samples=16)
        plane("Wall", 20.0, wall(0.72), turn)
        plane("Decal", 4.0, sheet((1.0, 1.0, 1.0)), turn)
        level = both(tmp_path)
        if turn == (0.0, 0.0, 0.0):
            close(level)
        # Cycles goes on a rounding beyond what it has met, and so loses some of the wall where it is not level.
        assert np.abs(level[1] - 0.72).max() < 1e-5
        made.camera.data.type = "PERSP"
        assert np.abs(both(tmp_path)[1] - 0.72).max() < 1e-5


@pytest.mark.blender
def test_sheets_that_lie_on_each_other_dim_as_sheets_apart(tmp_path):
    import numpy as np
    from beside_cycles import both, close, scene

    tints = [(0.9, 0.5, 0.2), (0.5, 0.9, 0.7), (0.7, 0.8, 0.9)]

    def seen(apart, turn):
        # Without Russian roulette.
        scene(8, 8, samples=16).cycles.min_transparent_bounces = 8
        plane("Wall", 40.0, wall(0.72), height=-8.0)
        for number, tint in enumerate(tints):
            plane(f"Sheet{number}", 20.0, sheet(tint), turn, number * apart)
        return both(tmp_path)

    expected = 0.72 * np.prod(tints, axis=0)
    for turn in [(0.0, 0.0, 0.0), (0.3, 0.2, 0.1)]:
        apart = seen(0.01, turn)
        close(apart)
        assert np.abs(apart[1] - expected).max() < 1e-5
        assert np.abs(seen(0.0, turn)[1] - expected).max() < 1e-5
