"""Shapes and motion that Blender can write into USD: each a scene for three ways to its picture."""

from math import radians

import bpy
import numpy
from scenes_hair import strands
from scenes_usd import warm
from stage import ball, blank, box, camera, image, link, node, plane, principled, resolution, shape, surface

FRAMES = (1, 2)


def rough(colour: tuple[float, float, float]) -> bpy.types.Material:
    """A surface that both formats say alike."""
    return principled(Base_Color=colour, Roughness=0.8)


def room() -> None:
    """A floor, a wall and three lamps."""
    resolution(192, 128)
    bpy.context.scene.cycles_curves.shape = "THICK"
    plane(rough((0.5, 0.5, 0.5)), size=9.0)
    plane(rough((0.6, 0.45, 0.35)), size=9.0, location=(0.0, 2.5, 0.0), rotation=(radians(90), 0.0, 0.0))
    warm("AREA", 90.0, 6500.0, (-1.4, -1.8, 3.2), (0.5, -0.35, 0.4), shape="RECTANGLE", size=1.5, size_y=0.8)
    warm("AREA", 50.0, 3500.0, (2.2, -2.0, 3.0), (0.4, 0.5, 0.0), shape="DISK", size=0.9)
    camera((0.0, -5.5, 2.0), (0.0, 0.2, 0.7), lens=50.0)


def hair_curves() -> None:
    """Hair curves on a ball, as tubes."""
    room()
    ball(rough((0.3, 0.2, 0.15)), 0.49, location=(0.0, 0.0, 0.5))
    strands(900).data.materials.append(rough((0.6, 0.35, 0.2)))


def particle_hair() -> None:
    """The hair of a particle system."""
    room()
    shape(bpy.ops.mesh.primitive_uv_sphere_add, rough((0.3, 0.2, 0.15)), smooth=True, radius=0.5, location=(0.0, 0.0, 0.6))
    emitter = bpy.context.object
    emitter.modifiers.new("Fur", "PARTICLE_SYSTEM")
    settings = emitter.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length, settings.material = "HAIR", 500, 0.35, 1
    settings.hair_step, settings.render_step, settings.display_step = 4, 4, 4
    settings.root_radius, settings.tip_radius, settings.radius_scale, settings.use_close_tip = 1.0, 0.5, 0.02, False


def points() -> None:
    """A point cloud of balls of several sizes."""
    room()
    random = numpy.random.default_rng(4)
    count = 400
    mesh = bpy.data.meshes.new("Cloud")
    mesh.from_pydata(random.uniform((-1.2, -0.8, 0.1), (1.2, 1.2, 1.5), (count, 3)).tolist(), [], [])
    thing = link("Cloud", mesh)
    bpy.ops.object.select_all(action="DESELECT")
    bpy.context.view_layer.objects.active = thing
    thing.select_set(True)
    bpy.ops.object.convert(target="POINTCLOUD")
    cloud = bpy.context.object.data
    radii = cloud.attributes.get("radius") or cloud.attributes.new("radius", "FLOAT", "POINT")
    radii.data.foreach_set("value", random.uniform(0.02, 0.12, count).astype(numpy.float32))
    cloud.materials.clear()
    cloud.materials.append(rough((0.3, 0.45, 0.6)))


def displaced() -> None:
    """A plate and a ball that an image moves."""
    room()
    v, u = numpy.meshgrid((numpy.arange(128) + 0.5) / 128, (numpy.arange(128) + 0.5) / 128, indexing="ij")
    heights = 0.5 + 0.25 * (numpy.sin(18.0 * u) + numpy.cos(14.0 * v))
    made, tree = blank("Moved")
    picture = node(tree, "ShaderNodeTexImage", image=image("Heights", numpy.repeat(heights[..., None], 3, axis=2), colours="Non-Color"))
    tree.links.new(node(tree, "ShaderNodeUVMap", uv_map="UVMap").outputs[0], picture.inputs["Vector"])
    shader = node(tree, "ShaderNodeBsdfPrincipled", Base_Color=(0.4, 0.55, 0.35), Roughness=0.8)
    surface(tree, shader)
    end = next(each for each in tree.nodes if each.bl_idname == "ShaderNodeOutputMaterial")
    moved = node(tree, "ShaderNodeDisplacement", Height=picture.outputs["Color"], Midlevel=0.5, Scale=0.2)
    tree.links.new(moved.outputs[0], end.inputs["Displacement"])
    made.displacement_method = "DISPLACEMENT"
    shape(
        bpy.ops.mesh.primitive_grid_add,
        made,
        smooth=True,
        x_subdivisions=80,
        y_subdivisions=80,
        size=2.0,
        location=(-1.1, 0.2, 0.5),
        rotation=(0.7, 0.0, 0.3),
    )
    ball(made, 0.7, location=(1.1, 0.3, 0.8))


def keyed(owner, path: str, values) -> None:
    """Keys at the frames, even ways between."""
    for frame, value in zip(FRAMES, values, strict=True):
        setattr(owner, path, value)
        owner.keyframe_insert(path, frame=frame)
    holder = owner if isinstance(owner, bpy.types.ID) else owner.id_data
    action = holder.animation_data.action
    for curve in curves_of(action):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"


def curves_of(action):
    """The curves of an action of any Blender."""
    if hasattr(action, "fcurves"):
        return action.fcurves
    return [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags for curve in bag.fcurves]


def open_shutter() -> None:
    """From the frame on to the next one."""
    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = FRAMES
    scene.frame_set(FRAMES[0])
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0
    scene.render.motion_blur_position = "START"


def things() -> list[bpy.types.Object]:
    """A box, a ball and a flat plate."""
    made = [
        box(rough((0.6, 0.3, 0.2)), 0.7, location=(-1.1, 0.0, 0.7)),
        ball(rough((0.2, 0.4, 0.6)), 0.45, location=(0.0, 0.2, 0.6)),
        box(rough((0.3, 0.5, 0.25)), 1.0, location=(1.2, 0.1, 0.8)),
    ]
    made[2].scale = (1.0, 0.1, 0.5)
    return made


def moving_camera() -> None:
    """A camera that goes sideways and turns."""
    room()
    things()
    eye = bpy.context.scene.camera
    turn = eye.rotation_euler.copy()
    keyed(eye, "location", [(-0.15, -5.5, 2.0), (0.15, -5.5, 2.1)])
    keyed(eye, "rotation_euler", [turn, (turn.x, turn.y + 0.03, turn.z + 0.04)])
    open_shutter()


def moving_things() -> None:
    """One goes, one turns about itself, one turns and goes; two share a mesh."""
    room()
    made = things()
    other = link("Other", made[2].data, (0.2, -0.6, 1.2), (0.3, 0.2, 0.1), (0.5, 0.05, 0.3))
    keyed(made[0], "location", [(-1.3, 0.0, 0.7), (-0.9, 0.0, 0.9)])
    keyed(made[2], "rotation_euler", [(0.0, 0.0, 0.0), (0.0, 0.9, 0.0)])
    keyed(other, "rotation_euler", [(0.3, 0.2, 0.1), (0.3, -0.7, 0.1)])
    keyed(other, "location", [(0.0, -0.6, 1.2), (0.3, -0.6, 1.4)])
    open_shutter()


def deforming() -> None:
    """A plate that a shape key bends."""
    room()
    shape(
        bpy.ops.mesh.primitive_grid_add,
        rough((0.6, 0.3, 0.2)),
        smooth=True,
        x_subdivisions=30,
        y_subdivisions=30,
        size=1.8,
        location=(0.0, 0.3, 0.5),
        rotation=(0.5, 0.0, 0.4),
    )
    plate = bpy.context.object
    plate.shape_key_add(name="Basis")
    bent = plate.shape_key_add(name="Bent")
    for each in bent.data:
        each.co.z += 0.5 * numpy.cos(2.5 * each.co.x) + 0.2 * each.co.y
    keyed(bent, "value", [0.0, 1.0])
    open_shutter()


def skinned() -> None:
    """A post that two bones bend."""
    room()
    shape(
        bpy.ops.mesh.primitive_cylinder_add,
        rough((0.2, 0.4, 0.6)),
        smooth=False,
        vertices=24,
        radius=0.2,
        depth=2.0,
        location=(0.0, 0.0, 1.0),
    )
    post = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.bisect(plane_co=(0, 0, 1), plane_no=(0, 0, 1))
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.armature_add(location=(0.0, 0.0, 0.0))
    rig = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    lower = rig.data.edit_bones[0]
    lower.head, lower.tail = (0, 0, 0), (0, 0, 1)
    upper = rig.data.edit_bones.new("Upper")
    upper.head, upper.tail, upper.parent = (0, 0, 1), (0, 0, 2), lower
    names = lower.name, upper.name
    bpy.ops.object.mode_set(mode="OBJECT")
    for name, holds in zip(names, (lambda z: z < 0.01, lambda z: z >= 0.01), strict=True):
        group = post.vertex_groups.new(name=name)
        group.add([each.index for each in post.data.vertices if holds(each.co.z)], 1.0, "REPLACE")
    modifier = post.modifiers.new("Rig", "ARMATURE")
    modifier.object, post.parent = rig, rig
    bone = rig.pose.bones[names[1]]
    bone.rotation_mode = "XYZ"
    keyed(bone, "rotation_euler", [(0.0, 0.0, -0.1), (0.0, 0.0, 0.7)])
    open_shutter()
