"""What placements know of themselves and of what made them, against Cycles."""

import pytest

NODES = {
    "ParticleInfo": ("Index", "Random", "Age", "Lifetime", "Location", "Size", "Velocity", "Angular Velocity"),
    "ObjectInfo": ("Location", "Color", "Alpha", "Object Index", "Material Index", "Random"),
    "HairInfo": ("Is Strand", "Intercept", "Length", "Thickness", "Tangent Normal", "Random"),
    "PointInfo": ("Position", "Radius", "Random"),
    "VolumeInfo": ("Color", "Density", "Flame", "Temperature"),
}


def shown(kind, output, **fields):
    """A material that shines with a share of an output's absolute value."""
    from beside_cycles import shining

    made, tree, colour = shining(f"{kind} {output}")
    node, size = tree.nodes.new(f"ShaderNode{kind}"), tree.nodes.new("ShaderNodeVectorMath")
    for name, value in fields.items():
        setattr(node, name, value)
    size.operation = "ABSOLUTE"
    tree.links.new(node.outputs[output], size.inputs[0])
    tree.links.new(size.outputs[0], colour)
    made.pass_index = 3
    return made


def leaf(name, cover, size):
    import bpy
    from beside_cycles import link

    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(x * size, y * size, 0) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new(name="Map").uv.foreach_set("vector", [0, 0, 1, 0, 1, 1, 0, 1])
    mesh.materials.append(cover)
    return link(bpy.data.objects.new(name, mesh))


@pytest.mark.blender
def test_placements_know_what_cycles_knows(tmp_path):
    import numpy as np
    from beside_cycles import both, scene

    cases = [(kind, output) for kind, outputs in NODES.items() for output in outputs]
    scene(len(cases))
    for number, case in enumerate(cases):
        thing = leaf(" ".join(case), shown(*case), 0.5)
        thing.location, thing.color, thing.pass_index = (number - 0.5 * len(cases) + 0.5, 0.5, 0), (0.1, 0.2, 0.3, 0.4), 7
    cycles, gonio = (picture[1] for picture in both(tmp_path))
    assert np.abs(cycles - gonio).max() < 1e-5 and cycles[:14].max() > 1.0, cycles - gonio


def emitter(output, place):
    """A grid of particles that show leaves, which fly about."""
    import bpy

    bpy.ops.mesh.primitive_plane_add(size=3.0, location=place)
    ground, shape = bpy.context.object, leaf(f"Leaf {output}", shown("ParticleInfo", output), 0.25)
    shape.location = (0.0, 0.0, -50.0)
    ground.modifiers.new("Particles", "PARTICLE_SYSTEM")
    settings = ground.particle_systems[0].settings
    settings.count, settings.frame_start, settings.frame_end, settings.lifetime, settings.lifetime_random = 12, 1, 4, 40, 0.5
    settings.render_type, settings.instance_object, settings.particle_size, settings.size_random = "OBJECT", shape, 1.0, 0.4
    settings.physics_type, settings.normal_factor, settings.effector_weights.gravity = "NEWTON", 0.02, 0.0
    settings.rotation_mode = "NONE"
    settings.use_rotations, settings.angular_velocity_mode, settings.angular_velocity_factor = True, "GLOBAL_Z", 0.7
    ground.show_instancer_for_render = False


@pytest.mark.blender
def test_instances_of_particles_know_their_particle(tmp_path):
    import bpy
    import numpy as np
    from beside_cycles import both, scene

    outputs = NODES["ParticleInfo"]
    made = scene(32 * len(outputs), 32, scale=4.0 * len(outputs), samples=16)
    for number, output in enumerate(outputs):
        emitter(output, (4.0 * number - 2.0 * len(outputs) + 2.0, 0.0, 0.0))
    for frame in range(1, 9):
        made.frame_set(frame)
    cycles, gonio = both(tmp_path)
    wrong = {}
    for number, output in enumerate(outputs):
        one, other = (picture[:, 32 * number : 32 * number + 32] for picture in (cycles, gonio))
        apart = np.abs(one - other).max(axis=2) / max(one.max(), 1e-3)
        if not (one.max() > 0.01 and np.median(apart) < 1e-3 and apart.mean() < 0.02):
            wrong[output] = one.max(), other.max(), apart.mean()
    assert not wrong, wrong
    assert bpy.context.scene.frame_current == 8


@pytest.mark.blender
def test_instances_on_faces_know_where_they_are(tmp_path):
    import bpy
    import numpy as np
    from beside_cycles import both, scene

    kinds = {"Generated": ("TexCoord", "Generated"), "UV": ("TexCoord", "UV"), "map": ("UVMap", "UV")}
    made = scene(32 * len(kinds), 32, scale=4.0 * len(kinds), samples=16)
    for number, (name, (kind, output)) in enumerate(kinds.items()):
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=4, y_subdivisions=4, size=3.0, location=(4.0 * number - 4.0, 0.0, 0.0))
        ground = bpy.context.object
        shape = leaf(name, shown(kind, output, from_instancer=True), 0.25)
        shape.parent = ground
        ground.instance_type, ground.show_instancer_for_render = "FACES", False
    cycles, gonio = both(tmp_path)
    assert cycles[:, 40:].max() > 0.3 and np.median(np.abs(cycles - gonio)) < 1e-4 and np.abs(cycles - gonio).mean() < 0.01
    assert made is bpy.context.scene
