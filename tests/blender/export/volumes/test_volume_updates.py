"""Volume objects that change, move and vanish between updates; sequences; what geometry nodes and simulations make."""

import pytest


def sequence(folder, count=3):
    """Files of balls, each twice as dense as the one before."""
    from clouds import ball, stored

    return [stored(folder / f"cloud_{number:03d}.vdb", density=2.0**number * ball()) for number in range(1, count + 1)]


def seen(scene):
    """The fields of what is placed."""
    return [scene.fields[scene.materials[each["materials"][0]]["medium"]["field"]] for each in scene.instances]


@pytest.mark.blender
def test_moved_changed_and_deleted_volumes(tmp_path):
    import bpy
    import numpy as np
    from clouds import ball, cloud, exported, filled, followed, stored
    from recorder import empty

    empty()
    made, _, shader = filled("VolumePrincipled", Density=1.0)
    first, second = (stored(tmp_path / f"{name}.vdb", density=share * ball()) for name, share in (("a", 1.0), ("b", 2.0)))
    thing, other = cloud(first, made), cloud(second, made)
    exporter, scene, _ = exported()
    found = followed(exporter)
    update = bpy.context.view_layer.update
    assert len(scene.fields) == 2
    place = next(n for n, field in enumerate(scene.fields) if field["density"][0] == str(first))
    before = scene.fields[1 - place]
    # Moved: its field and its box are sent again, the other's are not.
    thing.location.x = 4.0
    update()
    here = [field for field in scene.fields if field["density"] and isinstance(field["density"], tuple) and field["density"][0] == str(first)]
    assert found[0].geometry and len(here) == 1 and here[0]["to_world"]["columns"][3][0] >= 4.0
    assert any(field is before for field in scene.fields)
    number = next(n for n, each in enumerate(scene.instances) if each["transforms"][0, 0, 3] >= 4.0)
    assert scene.fields[scene.materials[scene.instances[number]["materials"][0]]["medium"]["field"]] is here[0]
    # Its shader: the material alone.
    calls = len(scene.calls)
    shader.inputs["Density"].default_value = 3.0
    update()
    assert found[0].shading and "fields" not in scene.calls[calls:], scene.calls[calls:]
    assert np.allclose([scene.materials[each["materials"][0]]["medium"]["scattering"][0] for each in scene.instances], 1.5)
    # Another file.
    thing.data.filepath = str(second)
    update()
    assert found[0].geometry
    assert [field["density"][0] for field in seen(scene)] == [str(second)] * 2
    # Gone: what is left has a field, and nothing names another.
    bpy.data.objects.remove(thing)
    update()
    assert found[0].transforms
    assert len(scene.instances) == 1
    assert all(material.get("medium", {}).get("field", 0) < len(scene.fields) for material in scene.materials)
    bpy.data.objects.remove(other)
    update()
    assert not scene.instances and not scene.fields


@pytest.mark.blender
def test_frames_of_a_sequence(tmp_path):
    import bpy
    from clouds import cloud, exported, followed
    from recorder import empty

    empty()
    files = sequence(tmp_path)
    thing = cloud(files[0])
    data = thing.data
    data.is_sequence, data.frame_start, data.frame_duration, data.sequence_mode = True, 1, 3, "CLIP"
    bpy.context.scene.frame_set(1)
    exporter, scene, lines = exported()
    found = followed(exporter)
    for frame, shown in ((2, 1), (3, 2), (4, None), (1, 0)):
        bpy.context.scene.frame_set(frame)
        assert found[0].anything
        assert [field["density"][0] for field in seen(scene)] == ([] if shown is None else [str(files[shown])]), frame
    data.sequence_mode = "REPEAT"
    bpy.context.scene.frame_set(5)
    assert seen(scene)[0]["density"][0] == str(files[1]) and not lines


@pytest.mark.blender
def test_an_animation_writes_what_stays_once(tmp_path):
    import bpy
    from clouds import attribute, ball, cloud, exported, filled, stored
    from recorder import depsgraph, empty

    empty()
    made, tree, shader = filled("VolumeScatter")
    power = tree.nodes.new("ShaderNodeMath")
    power.operation = "POWER"
    tree.links.new(attribute(tree, "density"), power.inputs[0])
    tree.links.new(power.outputs[0], shader.inputs["Density"])
    cloud(stored(tmp_path / "cloud.vdb", density=ball()), made)
    exporter, scene, _ = exported()
    assert scene.fields[0]["density"].max() > 0.0
    calls = len(scene.calls)
    bpy.context.scene.frame_set(2)
    exporter.sync(depsgraph())
    assert not {"fields", "meshes", "materials"} & set(scene.calls[calls:])


def made_by_nodes():
    """A cube that geometry nodes turn into a volume, beside the cube; and the node."""
    import bpy

    bpy.ops.mesh.primitive_cube_add(size=2)
    thing = bpy.context.object
    tree = bpy.data.node_groups.new("Fill", "GeometryNodeTree")
    for in_out in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=in_out, socket_type="NodeSocketGeometry")
    start, stop = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    fill, join = tree.nodes.new("GeometryNodeMeshToVolume"), tree.nodes.new("GeometryNodeJoinGeometry")
    fill.inputs["Voxel Amount"].default_value = 16
    tree.links.new(start.outputs[0], fill.inputs[0])
    for source in (fill, start):
        tree.links.new(source.outputs[0], join.inputs[0])
    tree.links.new(join.outputs[0], stop.inputs[0])
    thing.modifiers.new("Fill", "NODES").node_group = tree
    return thing, fill


@pytest.mark.blender
def test_volumes_of_geometry_nodes_leave_no_files():
    import gc
    from pathlib import Path

    import bpy
    from clouds import exported, followed
    from recorder import empty

    empty()
    thing, fill = made_by_nodes()
    exporter, scene, lines = exported()
    assert not lines and len(scene.instances) == 2 and len(scene.fields) == 1
    path, name = scene.fields[0]["density"]
    assert name == "density" and Path(path).is_file()
    folder = Path(path).parent
    followed(exporter)
    # Moved alone, its numbers are not asked again, and the file is still there.
    thing.location.x = 2.0
    bpy.context.view_layer.update()
    assert any(each["mesh"] is not None and "field" in scene.meshes[each["mesh"]] for each in scene.instances)
    assert [field["density"] for field in scene.fields if isinstance(field["density"], tuple)] == [(path, "density")]
    fill.inputs["Density"].default_value = 4.0
    bpy.context.view_layer.update()
    assert len(list(folder.iterdir())) == 1
    bpy.app.handlers.depsgraph_update_post.clear()
    bpy.app.handlers.frame_change_post.clear()
    del exporter, scene
    gc.collect()
    assert not folder.exists()


class Domain:
    """What a fluid domain's settings give of a simulation."""

    domain_resolution, noise_scale, velocity_scale = (4, 3, 2), 2, 1.0

    def __init__(self, numpy):
        class Array(list):
            def foreach_get(self, values):
                values[:] = self

        flame = numpy.linspace(0.0, 1.0, 4 * 3 * 2)
        fine = numpy.arange(8 * 6 * 4) / (8 * 6 * 4)
        self.density_grid, self.flame_grid, self.temperature_grid = Array(fine), Array(flame), Array(1.5 + flame)
        self.heat_grid, self.color_grid, self.velocity_grid = Array(), Array(), Array()


@pytest.mark.blender
def test_a_domain_fills_the_box_of_its_mesh():
    import bpy
    import numpy as np
    from clouds import exported, filled
    from recorder import empty, module

    empty()
    bpy.ops.mesh.primitive_cube_add(size=2, location=(0, 0, 5))
    thing = bpy.context.object
    made, _, _ = filled("VolumePrincipled", Density=2.0, Blackbody_Intensity=1.0)
    thing.data.materials.append(made)
    # Blender's simulations do not run everywhere.
    for name in ("gather", "volumes.sources"):
        module(f"export.{name}").domain_of = lambda thing: Domain(np) if thing.type == "MESH" else None
    _, scene, lines = exported()
    (field,) = scene.fields
    assert not lines and field["density"].shape == field["heat"].shape == (8, 6, 4)
    # Blender counts along x first.
    shares = field["density"] / field["density"].max()
    assert shares[1, 0, 0] == pytest.approx(1.0 / 191.0, rel=1e-4) and shares[0, 1, 0] == pytest.approx(8.0 / 191.0, rel=1e-4)
    columns = np.array(field["to_world"]["columns"])
    assert np.allclose(columns[:3], np.diag([2.0 / 8, 2.0 / 6, 2.0 / 4])) and np.allclose(columns[3], [-0.875, -0.8333, 4.25], atol=1e-3)
    assert np.allclose(field["heat"][:2, 0, 0], [1.5, 1.5 + 0.25 / 23.0], atol=0.02) and len(field["glow"]) == 256
