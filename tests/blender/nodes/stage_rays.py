"""Scenes for outputs that rays find out: blocks on a floor, balls over a mirror, balls that particles instance. For Blender."""

import bpy

from . import stage

# Samples a pixel.
SAMPLES = 256


def floor(materials: list) -> stage.Grid:
    """Cubes in a corner of floor and walls that are part of them."""
    found = stage.balls(materials, _corner, stage.LIT_BALL)
    _often(bpy.context.scene)
    # The mean of a few normals depends on how their rays are spread together.
    bpy.context.scene.cycles.sampling_pattern = "TABULATED_SOBOL"
    return found


def mirror(materials: list) -> stage.Grid:
    """Balls over a floor that reflects half of the light and scatters the other half."""
    found = stage.balls(materials, side=stage.LIT_BALL)
    scene = bpy.context.scene
    _often(scene)
    scene.cycles.max_bounces = scene.cycles.diffuse_bounces = scene.cycles.glossy_bounces = 2
    size = 2.0 * found.columns + 4.0
    mesh = bpy.data.meshes.new("Mirror")
    mesh.from_pydata([(-size, -size, -0.25), (size, -size, -0.25), (size, size, -0.25), (-size, size, -0.25)], [], [range(4)])
    mesh.materials.append(_mirror())
    scene.collection.objects.link(bpy.data.objects.new("Mirror", mesh))
    return found


def particles(materials: list) -> stage.Grid:
    """Each ball is the instance of a particle of an emitter of its own."""
    found = stage.balls(materials)
    scene = bpy.context.scene
    for thing in [each for each in scene.objects if each.name.startswith("Ball")]:
        _emitter(scene, thing)
    scene.frame_set(5)
    return found


def _often(scene: bpy.types.Scene) -> None:
    scene.cycles.samples = SAMPLES
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "BOX", 1.0


def _corner() -> bpy.types.Mesh:
    """A cube whose upper half is sunk into a larger slab: edges outwards and inwards."""
    mesh = bpy.data.meshes.new("Corner")
    corners, faces = [], []
    for half, low, high in ((0.35, -0.55, 0.1), (0.6, -0.6, -0.5)):
        first = len(corners)
        corners += [(x * half, y * half, z) for z in (low, high) for y in (-1, 1) for x in (-1, 1)]
        sides = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
        faces += [[first + number for number in side] for side in sides]
    mesh.from_pydata(corners, [], faces)
    mesh.materials.append(None)
    return mesh


def _mirror() -> bpy.types.Material:
    """Half a mirror, half grey."""
    made = bpy.data.materials.new("Mirror")
    if bpy.app.version < (5, 0, 0):
        made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    sharp, grey, both, end = (
        tree.nodes.new(f"ShaderNode{kind}") for kind in ("BsdfAnisotropic", "BsdfDiffuse", "MixShader", "OutputMaterial")
    )
    sharp.inputs["Roughness"].default_value = 0.0
    tree.links.new(sharp.outputs[0], both.inputs[1])
    tree.links.new(grey.outputs[0], both.inputs[2])
    tree.links.new(both.outputs[0], end.inputs["Surface"])
    return made


def _emitter(scene: bpy.types.Scene, thing: bpy.types.Object) -> None:
    """A small triangle that lets one particle go at the place of a thing, which is its picture."""
    mesh = bpy.data.meshes.new("Emitter")
    mesh.from_pydata([(-0.01, -0.01, 0.0), (0.01, -0.01, 0.0), (0.0, 0.01, 0.0)], [], [range(3)])
    emitter = bpy.data.objects.new("Emitter", mesh)
    emitter.location = thing.location
    scene.collection.objects.link(emitter)
    emitter.show_instancer_for_render = False
    emitter.modifiers.new("Particles", "PARTICLE_SYSTEM")
    settings = emitter.particle_systems[0].settings
    settings.count, settings.frame_start, settings.frame_end, settings.lifetime = 1, 1.0, 1.0, 40.0
    settings.render_type, settings.instance_object, settings.particle_size = "OBJECT", thing, 0.9
    settings.physics_type, settings.normal_factor, settings.effector_weights.gravity = "NEWTON", 0.3, 0.1
    settings.use_rotations, settings.angular_velocity_mode, settings.angular_velocity_factor = True, "VELOCITY", 0.7
    # The thing itself stays out of the picture.
    thing.location.z = -50.0
