"""Bakes into vertex colours: corners that lie on other faces, and noise that samples take out."""

from pathlib import Path

import pytest


def box_on_floor(place, turn, samples):
    """A box of many faces that stands on a wide floor, under an even world of 1."""
    import bpy
    import scenes

    scene = scenes.empty(samples=samples)
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    scene.world.light_settings.distance = 1.0
    bpy.ops.mesh.primitive_plane_add(size=200.0)
    bpy.context.object.data.materials.append(scenes.diffuse("Floor", (0.35, 0.35, 0.35)))
    bpy.ops.mesh.primitive_cube_add(size=1.2, location=(*place, 0.6), rotation=(0.0, 0.0, turn))
    box = bpy.context.object
    box.data.materials.append(scenes.diffuse("Box", (0.5, 0.5, 0.5)))
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.subdivide(number_cuts=9)
    bpy.ops.object.mode_set(mode="OBJECT")
    box.data.color_attributes.active_color = box.data.color_attributes.new("Baked", "FLOAT_COLOR", "CORNER")
    bpy.ops.object.select_all(action="DESELECT")
    box.select_set(True)
    bpy.context.view_layer.objects.active = box
    return box


def baked(box, kind, **keywords):
    """What a bake brings to the corners of faces (count, 3)."""
    import bpy
    import numpy as np

    assert bpy.ops.object.bake(type=kind, target="VERTEX_COLORS", **keywords) == {"FINISHED"}
    return np.array([corner.color[:3] for corner in box.data.color_attributes["Baked"].data])


def heights(box):
    """How high corners of sides are; those of top and bottom are not a number."""
    import numpy as np

    found = np.full(len(box.data.loops), np.nan)
    for face in box.data.polygons:
        if abs(face.normal.z) < 0.5:
            found[face.loop_start : face.loop_start + face.loop_total] = [box.data.vertices[number].co.z + 0.6 for number in face.vertices]
    return found


@pytest.mark.blender
@pytest.mark.parametrize(("place", "turn"), [((-1.0, 0.0), 0.0), ((37.3, -12.1), 0.6)])
def test_corners_on_a_floor_see_half_of_the_world(place, turn, tmp_path: Path):
    import numpy as np

    box = box_on_floor(place, turn, samples=64)
    corners = heights(box)
    lowest = corners < 1e-3
    assert lowest.sum() == 80
    open_ = baked(box, "AO")[:, 0]
    assert np.allclose(open_[lowest], 0.5, atol=0.02), (open_[lowest].mean(), open_[lowest].max())
    light = baked(box, "DIFFUSE", pass_filter={"DIRECT"})[:, 0]
    assert np.isclose(light[lowest].mean(), 0.5, rtol=0.01) and light[lowest].max() < 0.6, (light[lowest].mean(), light[lowest].max())
    # The underside sees nothing, the top all.
    flat = box.matrix_world.translation.z
    assert flat == pytest.approx(0.6) and (np.sort(open_[np.isnan(corners)]) == np.repeat([0.0, 1.0], 400)).all()


@pytest.mark.blender
def test_samples_take_the_noise_out_of_occlusion(tmp_path: Path):
    import numpy as np

    noise = []
    for samples in (4, 64):
        box = box_on_floor((0.0, 0.0), 0.0, samples)
        middle = np.isclose(heights(box), 0.6)
        assert middle.sum() == 160
        noise.append(baked(box, "AO")[middle, 0].std())
    # 16 times the rays: at most a quarter, with room for chance.
    assert 0.0 < noise[1] < 0.35 * noise[0], noise
