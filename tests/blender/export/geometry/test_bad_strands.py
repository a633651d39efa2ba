"""Hair, hair curves and point clouds with little or wrong in them: a message and a picture, never a crash."""

import pytest


def strands(points, radii, name="Strands"):
    """A hair curves object through the given points, one array a curve, with a radius for each point."""
    import bpy
    import numpy as np

    made = bpy.data.hair_curves.new(name)
    if len(points):
        made.add_curves([len(each) for each in points])
        made.position_data.foreach_set("vector", np.concatenate(points).astype(np.float32).reshape(-1))
        values = np.resize(np.asarray(radii, dtype=np.float32), sum(len(each) for each in points))
        made.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", values)
    thing = bpy.data.objects.new(name, made)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def seen(tmp_path, width=32):
    """The picture (rows, columns, 3), all finite, and the report's lines."""
    import bpy
    import numpy
    import scenes
    from recorder import module

    scene = bpy.context.scene
    scene.render.resolution_x = scene.render.resolution_y = width
    scene.gonio.samples = 4
    scenes.render(tmp_path / "picture.exr")
    channels = scenes.read(tmp_path / "picture.exr")
    found = numpy.stack([next(values for name, values in channels.items() if name.endswith(f"Combined.{c}")) for c in "RGB"], axis=-1)
    assert numpy.isfinite(found).all() and found.max() > 0.0
    return found, [line.text for line in module("report").latest().diagnostics]


def lines(number=3, points=4):
    import numpy as np

    x = np.linspace(-0.5, 0.5, number)
    return [np.stack([np.full(points, each), np.linspace(-0.5, 0.5, points), np.full(points, 0.3)], axis=1) for each in x]


@pytest.mark.blender
def test_widths_and_places_that_no_strand_can_have(tmp_path):
    import numpy as np
    import scenes

    nan, inf = float("nan"), float("inf")
    spoilt = lines()
    spoilt[1][2] = nan, inf, 0.0
    cases = {
        "zero": (lines(), [0.0], "widths are 0"),
        "negative": (lines(), [-0.1], "not a number"),
        "not a number": (lines(), [nan], "not a number"),
        "huge": (lines(), [1e30], "not a number"),
        "some": (lines(), [0.1, -0.1, nan, inf], "not a number"),
        "places": (spoilt, [0.1], "not finite"),
        "far": ([each * 1e30 for each in lines()], [0.1], "not finite"),
        "one point": (lines(points=1), [0.1], None),
        "one point among others": ([*lines(), np.array([(0.0, 0.0, 1.0)])], [0.1], None),
        "none": ([], [], None),
        "around the camera": (lines(), [50.0], None),
    }
    for name, (points, radii, told) in cases.items():
        scenes.lit_floor()
        thing = strands(points, radii, name)
        _, said = seen(tmp_path)
        assert len(said) <= 2 and (told is None or any(told in line for line in said)), (name, said)
        thing.scale = (0.0, 1.0, 1.0)
        seen(tmp_path)


@pytest.mark.blender
def test_particle_hair_with_settings_at_their_ends(tmp_path):
    import bpy
    import scenes

    for settings in (
        {"root_radius": 0.0, "tip_radius": 0.0},
        {"radius_scale": 0.0},
        {"radius_scale": 1e6},
        {"hair_length": 0.0},
        {"hair_length": 1e6},
        {"count": 0},
        {"render_step": 0},
        {"material": 30_000},
    ):
        scenes.lit_floor()
        bpy.ops.mesh.primitive_uv_sphere_add(radius=0.3, location=(0.0, 0.0, 0.5))
        ball = bpy.context.object
        ball.modifiers.new("Fur", "PARTICLE_SYSTEM")
        made = ball.particle_systems[0].settings
        made.type, made.count = "HAIR", 30
        for name, value in settings.items():
            setattr(made, name, value)
        _, said = seen(tmp_path)
        assert len(said) <= 2, (settings, said)


@pytest.mark.blender
def test_clouds_whose_points_change_over_the_shutter(tmp_path):
    """Geometry nodes that give another number of points at every moment: told, and shown as they are at the frame."""
    import bpy
    import scenes

    scenes.lit_floor()
    mesh = bpy.data.meshes.new("Cloud")
    thing = bpy.data.objects.new("Cloud", mesh)
    bpy.context.scene.collection.objects.link(thing)
    tree = bpy.data.node_groups.new("Grow", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    points, end, time = (tree.nodes.new(kind) for kind in ("GeometryNodePoints", "NodeGroupOutput", "GeometryNodeInputSceneTime"))
    times = tree.nodes.new("ShaderNodeMath")
    times.operation = "MULTIPLY"
    times.inputs[1].default_value = 10.0
    points.inputs["Radius"].default_value = 0.3
    tree.links.new(time.outputs["Frame"], times.inputs[0])
    tree.links.new(times.outputs[0], points.inputs["Count"])
    tree.links.new(points.outputs[0], end.inputs[0])
    thing.modifiers.new("Grow", "NODES").node_group = tree
    bpy.context.scene.render.use_motion_blur = True
    bpy.context.scene.frame_set(3)
    _, said = seen(tmp_path)
    assert len(said) <= 2, said
    print(said)
