"""Volumes of worlds that vary: fields about what the scene shows."""

import pytest

# All points at most, fewer than usual.
POINTS = 1 << 16


def foggy(density):
    """A world whose air scatters as much as `density` makes of the coordinates of its tree: the tree, the shader and the world."""
    import bpy

    world = bpy.context.scene.world = bpy.data.worlds.new("Air")
    if bpy.app.version < (5, 0, 0):
        world.use_nodes = True
    tree = world.node_tree
    end = next(node for node in tree.nodes if node.type == "OUTPUT_WORLD")
    shader, apart = tree.nodes.new("ShaderNodeVolumeScatter"), tree.nodes.new("ShaderNodeSeparateXYZ")
    shader.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    tree.links.new(tree.nodes.new("ShaderNodeNewGeometry").outputs["Position"], apart.inputs[0])
    tree.links.new(density(tree, apart.outputs), shader.inputs["Density"])
    tree.links.new(shader.outputs[0], end.inputs["Volume"])
    return tree, shader, world


def maths(tree, operation, *values):
    """The result of a Math node of sockets and numbers."""
    made = tree.nodes.new("ShaderNodeMath")
    made.operation = operation
    for end, value in zip(made.inputs, values, strict=False):
        if isinstance(value, float):
            end.default_value = value
        else:
            tree.links.new(value, end)
    return made.outputs[0]


def thinning(tree, along):
    """1 at the ground, 0 from two metres on."""
    return maths(tree, "MAXIMUM", maths(tree, "SUBTRACT", 1.0, maths(tree, "MULTIPLY", along["Z"], 0.5)), 0.0)


def scene_of(density):
    """An empty scene with a cube of two metres on the ground, a camera ten metres off, and such a world."""
    import bpy
    from recorder import empty, link, module

    module("export.volumes.space").POINTS = POINTS
    empty()
    bpy.ops.mesh.primitive_cube_add(size=2.0, location=(0, 0, 1))
    camera = bpy.context.scene.camera = link(bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera")))
    camera.location = (0.0, -10.0, 1.5)
    return foggy(density)


def places(field):
    """Where the points of a field are along each axis."""
    import numpy as np

    columns = np.array(field["to_world"]["columns"])
    return [columns[3][axis] + np.arange(field["density"].shape[axis]) * columns[axis][axis] for axis in range(3)]


@pytest.mark.blender
def test_height_fog_is_a_row_of_points_as_wide_as_cycles_has_worlds():
    import numpy as np
    from clouds import exported

    scene_of(thinning)
    _, scene, lines = exported()
    assert len(lines) == 1 and "far from the scene" in lines[0]
    (field,), medium = scene.fields, scene.atmosphere
    assert medium["field"] == 0 and field["density"].shape == (1, 1, 2048)
    assert [field["to_world"]["columns"][axis][axis] for axis in range(2)] == [2e4, 2e4]
    assert field["to_world"]["columns"][3][:2] == [0.0, 0.0]
    _, _, z = places(field)
    assert np.allclose(field["density"].ravel() * medium["scattering"][0], np.clip(1.0 - 0.5 * z, 0.0, None), atol=1e-5)
    # Nothing is asked far above what there is, and nothing goes on there.
    assert z[0] < 0.0 and 2.0 <= z[-1] < 2.2
    before, behind = np.array(field["beyond"])
    assert before[2] > 2048 and not behind.any() and not before[:2].any()


@pytest.mark.blender
def test_what_varies_everywhere_is_a_box_about_the_scene():
    import numpy as np
    from clouds import exported

    def waves(tree, along):
        waves = [maths(tree, "ADD", maths(tree, "SINE", along[axis]), 1.0) for axis in "XY"]
        return maths(tree, "MULTIPLY", maths(tree, "MULTIPLY", *waves), thinning(tree, along))

    scene_of(waves)
    _, scene, _ = exported()
    field, x, y, z = scene.fields[0], *places(scene.fields[0])
    wanted = (np.sin(x)[:, None, None] + 1.0) * (np.sin(y)[:, None] + 1.0) * np.clip(1.0 - 0.5 * z, 0.0, None)
    assert np.allclose(field["density"] * scene.atmosphere["scattering"][0], wanted, atol=1e-4)
    assert field["density"].size <= POINTS and min(field["density"].shape) == 32
    # All that is shown and the camera, and half of the whole around them; over the fog nothing.
    assert x[0] < -7.5 and x[-1] > 7.5 and y[0] < -15.5 and y[-1] > 7.5 and z[-1] < 2.5
    before, behind = np.array(field["beyond"])
    assert (before > 1.4 * np.array(field["density"].shape)).all() and (behind > 0.0).tolist() == [True, True, False]


@pytest.mark.blender
def test_emission_and_colours_vary_too():
    import numpy as np
    from clouds import exported

    tree, shader, _ = scene_of(thinning)
    glowing, sum_ = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeAddShader")
    end = next(node for node in tree.nodes if node.type == "OUTPUT_WORLD")
    height = next(node for node in tree.nodes if node.type == "SEPXYZ").outputs["Z"]
    tree.links.new(maths(tree, "MAXIMUM", height, 0.0), glowing.inputs["Strength"])
    for number, part in enumerate((shader, glowing)):
        tree.links.new(part.outputs[0], sum_.inputs[number])
    tree.links.new(sum_.outputs[0], end.inputs["Volume"])
    _, scene, _ = exported()
    field, (_, _, z) = scene.fields[0], places(scene.fields[0])
    sent = field["heat"].ravel() * scene.atmosphere["emission"][0]
    # More and more of it upwards: it is asked eight times as far as the scene is long.
    assert z[-1] > 8.0 * 10.0 and np.allclose(sent, 177.83 * np.maximum(z, 0.0), rtol=1e-3, atol=0.5)


@pytest.mark.blender
def test_updates_ask_again_where_the_scene_or_the_shader_is_another():
    import bpy
    from clouds import exported, followed
    from recorder import link, module

    tree, shader, _ = scene_of(thinning)
    air = module("export.volumes.air")
    asked, ask = [], air.fill
    air.fill = lambda *arguments: asked.append(1) or ask(*arguments)
    exporter, scene, _ = exported()
    found = followed(exporter)
    update = bpy.context.view_layer.update
    assert len(asked) == 1
    # Within the box nothing is asked or written.
    calls = len(scene.calls)
    lamp = link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
    update()
    lamp.location.z = 1.0
    update()
    assert len(asked) == 1 and "fields" not in scene.calls[calls:] and scene.atmosphere["field"] == 0
    # A lamp far off, then gone.
    far = link(bpy.data.objects.new("Far", lamp.data))
    far.location.x = 60.0
    update()
    assert len(asked) == 2 and found[0].anything and len(scene.fields) >= 1
    bpy.data.objects.remove(far)
    update()
    assert len(asked) == 3 and len(scene.fields) <= 2
    # Another colour; then even air, which is an update as well.
    shader.inputs["Color"].default_value = (0.5, 0.5, 0.5, 1.0)
    update()
    assert len(asked) == 4 and found[0].world
    tree.links.remove(shader.inputs["Density"].links[0])
    update()
    assert len(asked) == 4 and found[0].world and "field" not in scene.atmosphere


@pytest.mark.blender
def test_fog_follows_another_object():
    import bpy
    import numpy as np
    from clouds import exported, followed
    from recorder import link

    tree, shader, _ = scene_of(thinning)
    place = tree.nodes.new("ShaderNodeTexCoord")
    place.object = link(bpy.data.objects.new("Empty", None))
    tree.links.new(place.outputs["Object"], next(node for node in tree.nodes if node.type == "SEPXYZ").inputs[0])
    exporter, scene, _ = exported()
    followed(exporter)

    def top():
        _, _, z = places(scene.fields[scene.atmosphere["field"]])
        return float(z[-1])

    assert np.isclose(top(), 2.05, atol=0.1)
    place.object.location.z = 3.0
    bpy.context.view_layer.update()
    assert np.isclose(top(), 5.05, atol=0.1)


@pytest.mark.blender
def test_no_volume_even_ones_and_what_is_none():
    from clouds import exported

    tree, shader, _ = scene_of(lambda tree, along: maths(tree, "MULTIPLY", 0.5, 0.5))
    _, scene, lines = exported()
    assert not scene.fields and not lines and scene.atmosphere["scattering"] == pytest.approx([0.25] * 3)
    nothing = scene_of(lambda tree, along: maths(tree, "MULTIPLY", along["X"], 0.0))[0]
    assert exported()[1].atmosphere == {} or not exported()[1].fields
    end = next(node for node in nothing.nodes if node.type == "OUTPUT_WORLD")
    nothing.links.new(nothing.nodes.new("ShaderNodeBackground").outputs[0], end.inputs["Volume"])
    _, scene, lines = exported()
    assert scene.atmosphere == {} and len(lines) == 1 and "the air stays clear" in lines[0]
