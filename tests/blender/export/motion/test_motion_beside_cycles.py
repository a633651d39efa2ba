"""Motion blur beside Cycles, with the same shutter: what turns, moves, changes its form, and the camera."""

import math

import numpy as np
import pytest

WIDTH, HEIGHT, SIDE = 96, 64, 8
SAMPLES = 128


def keyed(owner, path, values, frames=(1, 3)):
    """Goes evenly from one value to another."""
    for frame, value in zip(frames, values, strict=True):
        setattr(owner, path, value)
        owner.keyframe_insert(path, frame=frame)


def box(name, size, place, colour, scale=(1, 1, 1)):
    """A cuboid of one colour, metres."""
    import bpy
    from scenes import diffuse

    bpy.ops.mesh.primitive_cube_add(size=size, location=place)
    made = bpy.context.object
    made.name, made.scale = name, scale
    made.data.materials.append(diffuse(name, colour))
    return made


def room(samples):
    """A floor with stripes under a grey sky and a sun, seen aslant."""
    import bpy
    from scenes import diffuse, empty

    scene = empty(width=WIDTH, height=HEIGHT, samples=samples)
    bpy.context.preferences.edit.keyframe_new_interpolation_type = "LINEAR"
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.3, 0.35, 0.4, 1)
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    bpy.context.object.data.materials.append(diffuse("Floor", (0.5, 0.5, 0.5)))
    for number in range(-3, 4):
        box(f"Stripe{number}", 1.0, (0.0, 1.2 * number, 0.01), (0.1, 0.2, 0.6), (8.0, 0.3, 0.02))
    bpy.ops.object.light_add(type="SUN", rotation=(0.6, 0.3, 0.0))
    bpy.context.object.data.energy = 2.0
    bpy.context.object.name = "Sun"
    bpy.ops.object.camera_add(location=(0, -5.5, 4.0), rotation=(math.radians(57), 0, 0))
    scene.camera = bpy.context.object
    return scene


def fan():
    """Four blades that turn by a quarter while the shutter is open, hung on an empty that turns."""
    import bpy

    bpy.ops.object.empty_add(location=(0.0, -0.6, 1.0), rotation=(0.9, 0.0, 0.0))
    hub = bpy.context.object
    for number in range(4):
        blade = box(f"Blade{number}", 1.0, (0.8, 0.0, 0.0), (0.8, 0.2 * number, 0.1), (1.2, 0.4, 0.05))
        bpy.ops.object.empty_add()
        arm = bpy.context.object
        arm.rotation_euler.z, arm.parent, blade.parent = 0.5 * math.pi * number, hub, arm
    keyed(hub, "rotation_euler", ((0.9, 0.0, 0.0), (0.9, 0.0, math.pi)))


def field():
    """Boxes on the faces of a grid that moves and turns."""
    import bpy

    bpy.ops.mesh.primitive_grid_add(x_subdivisions=5, y_subdivisions=5, size=5.0, location=(0, 0, 0.4))
    grid = bpy.context.object
    child = box("Seed", 0.4, (0, 0, 0), (0.2, 0.7, 0.2))
    child.parent, grid.instance_type, grid.show_instancer_for_render = grid, "FACES", False
    keyed(grid, "location", ((-0.4, 0.0, 0.4), (0.4, 0.3, 0.4)))
    keyed(grid, "rotation_euler", ((0, 0, 0), (0, 0, 0.8)))


def pan():
    """The camera looks aside."""
    import bpy

    box("Post", 0.6, (0.3, 0.0, 0.8), (0.8, 0.5, 0.1), (1, 1, 3))
    keyed(bpy.context.scene.camera, "rotation_euler", ((math.radians(57), 0, -0.2), (math.radians(57), 0, 0.2)))


def shape():
    """A ball whose upper points are drawn aside by a shape key."""
    import bpy
    from scenes import diffuse

    bpy.ops.mesh.primitive_uv_sphere_add(radius=1.0, location=(0, 0, 1.0))
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    ball.data.materials.append(diffuse("Ball", (0.8, 0.3, 0.2)))
    ball.shape_key_add(name="Basis")
    drawn = ball.shape_key_add(name="Drawn")
    for point in drawn.data:
        point.co.x += 1.2 * max(point.co.z, 0.0)
    keyed(drawn, "value", (0.0, 1.0))


def skinned():
    """A post bent by the upper of two bones."""
    import bpy
    from scenes import diffuse

    bpy.ops.object.armature_add()
    armature = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    bones = armature.data.edit_bones
    bones[0].name, bones[0].tail = "Lower", (0, 0, 1)
    upper = bones.new("Upper")
    upper.head, upper.tail, upper.parent = (0, 0, 1), (0, 0, 2.2), bones[0]
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.mesh.primitive_cylinder_add(radius=0.35, depth=2.2, location=(0, 0, 1.1))
    post = bpy.context.object
    post.data.materials.append(diffuse("Post", (0.7, 0.6, 0.2)))
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.mesh.bisect(plane_co=(0, 0, 1.0), plane_no=(0, 0, 1))
    bpy.ops.object.mode_set(mode="OBJECT")
    for name in ("Lower", "Upper"):
        group = post.vertex_groups.new(name=name)
        group.add([v.index for v in post.data.vertices if (v.co.z + 1.1 > 1.05) == (name == "Upper")], 1.0, "REPLACE")
    post.modifiers.new("Armature", "ARMATURE").object = armature
    bone = armature.pose.bones["Upper"]
    bone.rotation_mode = "XYZ"
    keyed(bone, "rotation_euler", ((0, 0, -0.7), (0, 0, 0.7)))


def flowing():
    """A ball whose points say where they go: its upper half flows aside."""
    import bpy
    from scenes import diffuse

    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.9, location=(0, 0, 0.9))
    ball = bpy.context.object
    ball.data.materials.append(diffuse("Water", (0.2, 0.5, 0.8)))
    given = np.zeros((len(ball.data.vertices), 3), dtype=np.float32)
    ball.data.vertices.foreach_get("co", given.ravel())
    given = np.stack([36.0 * np.maximum(given[:, 2], 0.0), np.zeros(len(given)), np.zeros(len(given))], axis=1).astype(np.float32)
    ball.data.attributes.new("velocity", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", given.ravel())


def lamp():
    """A lamp that passes behind a post."""
    import bpy

    box("Post", 0.5, (0.0, 0.0, 0.6), (0.6, 0.6, 0.6), (1, 1, 2))
    bpy.data.objects["Sun"].data.energy = 0.0
    bpy.ops.object.light_add(type="POINT", location=(0, 2, 2))
    bpy.context.object.data.energy, bpy.context.object.data.shadow_soft_size = 300.0, 0.1
    keyed(bpy.context.object, "location", ((-1.6, 1.5, 1.8), (1.6, 1.5, 1.8)))


def bent(name, data):
    """An object whose upper points a node group draws aside, more from frame to frame."""
    import bpy
    from scenes import diffuse

    made = bpy.data.objects.new(name, data)
    bpy.context.scene.collection.objects.link(made)
    made.data.materials.append(diffuse(name, (0.8, 0.5, 0.2)))
    tree = bpy.data.node_groups.new("Bend", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    nodes = {kind: tree.nodes.new(kind) for kind in ("NodeGroupInput", "NodeGroupOutput", "GeometryNodeSetPosition")}
    place, parts = tree.nodes.new("GeometryNodeInputPosition"), tree.nodes.new("ShaderNodeSeparateXYZ")
    amount, aside, sway = tree.nodes.new("ShaderNodeValue"), tree.nodes.new("ShaderNodeMath"), tree.nodes.new("ShaderNodeCombineXYZ")
    aside.operation = "MULTIPLY"
    for source, target in (
        (nodes["NodeGroupInput"].outputs[0], nodes["GeometryNodeSetPosition"].inputs["Geometry"]),
        (nodes["GeometryNodeSetPosition"].outputs[0], nodes["NodeGroupOutput"].inputs[0]),
        (place.outputs[0], parts.inputs[0]),
        (parts.outputs["Z"], aside.inputs[0]),
        (amount.outputs[0], aside.inputs[1]),
        (aside.outputs[0], sway.inputs["X"]),
        (sway.outputs[0], nodes["GeometryNodeSetPosition"].inputs["Offset"]),
    ):
        tree.links.new(source, target)
    made.modifiers.new("Bend", "NODES").node_group = tree
    keyed(amount.outputs[0], "default_value", (-0.8, 0.8))
    return made


def strands():
    """Hair curves that sway."""
    import bpy

    data = bpy.data.hair_curves.new("Hair")
    data.add_curves([5] * 21)
    along = np.arange(5) / 4.0
    points = [np.stack([np.full(5, 0.25 * n - 2.5), 0.4 * np.sin(n + along), 1.6 * along], axis=1) for n in range(21)]
    data.position_data.foreach_set("vector", np.concatenate(points).astype(np.float32).ravel())
    data.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", np.full(105, 0.06, dtype=np.float32))
    bent("Hair", data)


def cloud():
    """A point cloud that sways."""
    import bpy

    places = np.stack(np.meshgrid(np.linspace(-2, 2, 9), [0.0], np.linspace(0.2, 1.8, 5)), axis=-1).reshape(-1, 3)
    data = bpy.data.meshes.new("Cloud")
    data.from_pydata(places.tolist(), [], [])
    made = bent("Cloud", data)
    tree = made.modifiers[0].node_group
    last = next(node for node in tree.nodes if node.bl_idname == "NodeGroupOutput").inputs[0]
    before, to_points = last.links[0].from_socket, tree.nodes.new("GeometryNodeMeshToPoints")
    to_points.inputs["Radius"].default_value = 0.15
    dressed = tree.nodes.new("GeometryNodeSetMaterial")
    dressed.inputs["Material"].default_value = data.materials[0]
    tree.links.new(before, to_points.inputs[0])
    tree.links.new(to_points.outputs[0], dressed.inputs["Geometry"])
    tree.links.new(dressed.outputs[0], last)


KINDS = {made.__name__: made for made in (fan, field, pan, shape, skinned, flowing, strands, cloud, lamp)}
CASES = [(kind, "CENTER") for kind in KINDS if kind != "lamp"]
CASES += [(kind, position) for kind in ("pan", "skinned") for position in ("START", "END")]
MOMENTS = 16


def shown(path, engine, samples):
    """The picture of an engine (height, width, 3)."""
    import bpy
    from blender_pixels import pixels

    scene = bpy.context.scene
    scene.render.engine = engine
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    settings = scene.cycles
    settings.samples, settings.use_denoising, settings.use_adaptive_sampling = samples, False, False
    settings.sample_clamp_indirect = settings.blur_glossy = settings.light_sampling_threshold = 0.0
    if engine == "GONIO":
        bpy.ops.gonio.settings_from_cycles()
        scene.gonio.use_adaptive_sampling = False
    scene.render.filepath = str(path / f"{engine}.exr")
    bpy.ops.render.render(write_still=True)
    return pixels(path / f"{engine}.exr").astype(float)


def blocks(picture):
    """Means of blocks of pixels."""
    return picture.reshape(HEIGHT // SIDE, SIDE, WIDTH // SIDE, SIDE, 3).mean(axis=(1, 3))


def differs(one, other):
    """The largest difference of blocks, as a share of the mean."""
    return np.abs(blocks(one) - blocks(other)).max() / other.mean()


def prepared(kind, position):
    """The scene of a kind at frame 2, with the shutter open for a whole frame."""
    import unittest

    import bpy
    from keys import go_straight

    scene = room(SAMPLES)
    if not hasattr(scene, "cycles"):
        raise unittest.SkipTest("no Cycles")
    KINDS[kind]()
    go_straight(bpy.data.actions)
    scene.frame_set(2)
    # Before 5.0 the position is a setting of Cycles.
    placed = scene.render if hasattr(scene.render, "motion_blur_position") else scene.cycles
    scene.render.use_motion_blur, scene.render.motion_blur_shutter, placed.motion_blur_position = True, 1.0, position
    return scene


@pytest.mark.blender
@pytest.mark.parametrize(("kind", "position"), CASES)
def test_blur_is_that_of_cycles(kind, position, tmp_path):
    scene = prepared(kind, position)
    cycles, gonio = (shown(tmp_path, engine, SAMPLES) for engine in ("CYCLES", "GONIO"))
    scene.render.use_motion_blur = False
    still = shown(tmp_path, "GONIO", SAMPLES)
    assert differs(gonio, cycles) < 0.03, differs(gonio, cycles)
    assert differs(still, cycles) > 0.06, differs(still, cycles)


@pytest.mark.blender
def test_lamps_are_blurred_to_the_mean_of_moments(tmp_path):
    scene = prepared("lamp", "CENTER")
    gonio = shown(tmp_path, "GONIO", SAMPLES)
    scene.render.use_motion_blur = False
    still, moments = shown(tmp_path, "CYCLES", SAMPLES), []
    for moment in range(MOMENTS):
        frame = 1.5 + (moment + 0.5) / MOMENTS
        scene.frame_set(int(frame), subframe=frame - int(frame))
        moments.append(shown(tmp_path, "CYCLES", SAMPLES // 4))
    mean = np.mean(moments, axis=0)
    assert differs(gonio, mean) < 0.03, differs(gonio, mean)
    assert differs(still, mean) > 0.1, differs(still, mean)
