"""Volumes that move and flow while the shutter is open."""

import pytest


def moving(thing, *, ways=((-2.0, 0.0, 0.0), (2.0, 0.0, 0.0))):
    """Moves an object evenly from frame 1 to 3, and goes to frame 2."""
    import bpy
    from keys import go_straight

    for frame, place in zip((1, 3), ways, strict=True):
        thing.location = place
        thing.keyframe_insert("location", frame=frame)
    go_straight(bpy.data.actions)
    bpy.context.scene.frame_set(2)


def blurred(shutter=0.5):
    import bpy

    made = bpy.context.scene
    made.render.use_motion_blur, made.render.motion_blur_shutter, made.render.fps = True, shutter, 24
    return made


@pytest.mark.blender(seconds=900)
def test_a_cloud_that_moves_and_turns(tmp_path):
    from clouds import ball, cloud, filled, stored
    from test_clouds_beside_cycles import alike, lit, look

    look(samples=64)
    made, _, _ = filled("VolumePrincipled", Color=(0.8, 0.7, 0.5, 1.0), Density=3.0, Anisotropy=0.3)
    thing = cloud(stored(tmp_path / "cloud.vdb", voxel=0.2, corner=(-4, -6, -6), density=ball()), made)
    thing.scale = (1.2, 0.6, 0.9)
    for frame, angle in ((1, -0.6), (3, 1.4)):
        thing.rotation_euler = (0.2, 0.3, angle)
        thing.keyframe_insert("rotation_euler", frame=frame)
    moving(thing, ways=((-1.0, 0.5, 0.0), (1.0, -0.5, 0.3)))
    blurred(1.0)
    lit()
    alike(tmp_path)


@pytest.mark.blender(seconds=900)
def test_a_mesh_whose_inside_varies_moves(tmp_path):
    import bpy
    from clouds import filled
    from test_clouds_beside_cycles import alike, lit, look

    look(samples=64)
    made, tree, shader = filled("VolumeScatter")
    place, noise = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeTexGradient")
    tree.links.new(place.outputs["Generated"], noise.inputs["Vector"])
    tree.links.new(noise.outputs["Fac"], shader.inputs["Density"])
    bpy.ops.mesh.primitive_cube_add(size=1.4)
    thing = bpy.context.object
    thing.data.materials.append(made)
    moving(thing, ways=((-0.8, 0.4, 0.0), (0.8, -0.4, 0.0)))
    blurred(1.0)
    lit()
    alike(tmp_path)


def picture(path, thing_of):
    """A shining cloud's picture in Gonio."""
    import bpy
    from blender_pixels import pixels
    from clouds import attribute, filled
    from test_clouds_beside_cycles import look

    scene = look(samples=256)
    made, tree, shader = filled("VolumePrincipled", Density=0.0)
    tree.links.new(attribute(tree, "density"), shader.inputs["Emission Strength"])
    thing_of(made)
    scene.render.engine = "GONIO"
    bpy.ops.gonio.settings_from_cycles()
    scene.gonio.use_adaptive_sampling = False
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    return pixels(path)[..., 0]


@pytest.mark.blender(seconds=600)
@pytest.mark.parametrize(
    "unit, names, baked", [("FRAME", "whole", False), ("SECOND", "whole", False), ("FRAME", "parts", False), ("FRAME", "whole", True)]
)
def test_even_velocities_are_motions(tmp_path, unit, names, baked):
    import numpy as np
    from clouds import ball, cloud, stored

    dense = np.pad(ball(), 6)
    speed = np.zeros((*dense.shape, 3), np.float32)
    speed[..., 0], speed[..., 1] = 2.0, 1.0
    if unit == "SECOND":
        speed *= 24.0
    grids = (
        {"velocity": speed} if names == "whole" else {f"velocity_{axis}": speed[..., number].copy() for number, axis in enumerate("xyz")}
    )
    corner = (-12, -12, -12)

    def flowing(material):
        if baked:
            node = material.node_tree.nodes["Attribute"]
            shader = node.outputs["Fac"].links[0].to_node
            wave = material.node_tree.nodes.new("ShaderNodeMath")
            wave.operation, wave.inputs[1].default_value = "POWER", 1.0001
            material.node_tree.links.new(node.outputs["Fac"], wave.inputs[0])
            material.node_tree.links.new(wave.outputs[0], shader.inputs["Emission Strength"])
        thing = cloud(stored(tmp_path / "flow.vdb", voxel=0.125, corner=corner, density=dense, **grids), material)
        thing.data.velocity_unit, thing.rotation_euler = unit, (0.0, 0.0, 0.3)
        blurred()

    def moved(material):
        thing = cloud(stored(tmp_path / "still.vdb", voxel=0.125, corner=corner, density=dense), material)
        thing.rotation_euler = (0.0, 0.0, 0.3)
        way = np.array([[np.cos(0.3), -np.sin(0.3)], [np.sin(0.3), np.cos(0.3)]]) @ (2.0, 1.0)
        moving(thing, ways=((*-way, 0.0), (*way, 0.0)))
        blurred()

    found, expected = picture(tmp_path / "flow.exr", flowing), picture(tmp_path / "moved.exr", moved)
    assert found.mean() == pytest.approx(expected.mean(), rel=0.01)
    apart = np.abs(found - expected).reshape(8, 4, 8, 4).mean((1, 3))
    assert apart.max() < 0.05 * expected.max(), apart
