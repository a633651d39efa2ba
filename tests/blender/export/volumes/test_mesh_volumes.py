"""Volumes of meshes that vary: the mesh itself bounds a field over its box."""

import pytest


def cube(material, along=16):
    """A cube about the origin, whose shader is asked at so many points along the longest edge."""
    import bpy
    from recorder import module

    module("export.volumes.bounds").ALONG = along
    bpy.ops.mesh.primitive_cube_add(size=2.0)
    thing = bpy.context.object
    thing.data.materials.append(material)
    return thing


def by_place(output, name="Fog"):
    """A material whose volume is as dense as a coordinate along x: the material and the shader."""
    from clouds import filled

    made, tree, shader = filled("VolumeScatter", name)
    place, apart = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeSeparateXYZ")
    if output == "Position":
        place = tree.nodes.new("ShaderNodeNewGeometry")
    tree.links.new(place.outputs[output], apart.inputs[0])
    tree.links.new(apart.outputs[0], shader.inputs["Density"])
    return made, shader


def along_x(field):
    """Densities along x, and where they are in the world."""
    import numpy as np

    columns = np.array(field["to_world"]["columns"])
    count = len(field["density"])
    middle = [edge // 2 for edge in field["density"].shape[1:]]
    places = np.arange(count)[:, None] * columns[0] + middle[0] * columns[1] + middle[1] * columns[2] + columns[3]
    return field["density"][:, middle[0], middle[1]], places


@pytest.mark.blender
@pytest.mark.parametrize("output", ["Object", "Generated", "Position"])
def test_coordinates_are_right_at_each_point(output):
    import numpy as np
    from clouds import exported
    from recorder import empty

    empty()
    thing = cube(by_place(output)[0])
    thing.location, thing.scale, thing.rotation_euler = (5, 2, 3), (2, 1, 0.5), (0.1, 0.2, 0.3)
    _, scene, lines = exported()
    assert not lines, lines
    (field,), (instance,) = scene.fields, scene.instances
    mesh = scene.meshes[instance["mesh"]]
    assert "field" not in mesh and len(mesh["points"]) >= 8
    described = scene.materials[instance["materials"][0]]
    assert described["medium"]["field"] == 0 and [each["model"] for each in described["closures"]] == ["Transparent"]
    assert field["density"].shape == (16, 16, 16) and field["heat"] is None
    # Coefficients are a metre of the world, whatever the object's scale.
    found, places = along_x(field)
    found = found * described["medium"]["scattering"][0] / 0.8
    inner = np.linalg.inv(np.array(thing.matrix_world))
    own = places @ inner[:3, :3].T + inner[:3, 3]
    wanted = {"Object": own[:, 0], "Generated": 0.5 * own[:, 0] + 0.5, "Position": places[:, 0]}[output]
    assert np.allclose(found, np.maximum(wanted, 0.0), atol=1e-4)
    # The points fill a little more than the mesh.
    assert -1.02 < own[0, 0] - 0.5 * (own[1, 0] - own[0, 0]) < -1.0


@pytest.mark.blender
def test_the_surface_stays_and_other_slots_too():
    from clouds import exported
    from recorder import empty, material

    empty()
    made, _ = by_place("Object")
    tree = made.node_tree
    glass = tree.nodes.new("ShaderNodeBsdfGlass")
    tree.links.new(glass.outputs[0], next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL").inputs["Surface"])
    thing = cube(made)
    thing.data.materials.append(material("Plain")[0])
    _, scene, lines = exported()
    assert not lines
    first, second = (scene.materials[number] for number in scene.instances[0]["materials"])
    assert "field" in first["medium"] and "medium" not in second
    assert "Transparent" not in [each["model"] for each in first["closures"]]


@pytest.mark.blender
def test_instances_share_numbers_and_have_fields_of_their_own():
    import bpy
    import numpy as np
    from clouds import exported
    from recorder import empty, link

    empty()
    thing = cube(by_place("Object")[0])
    for number in range(3):
        link(bpy.data.objects.new("Other", thing.data)).location.x = 3.0 * number + 3.0
    _, scene, lines = exported()
    assert not lines and len(scene.fields) == len(scene.instances) == 4
    assert all(np.array_equal(field["density"], scene.fields[0]["density"]) for field in scene.fields)
    shown = [scene.materials[each["materials"][0]]["medium"]["field"] for each in scene.instances]
    for each, number in zip(scene.instances, shown, strict=True):
        first = scene.fields[number]["to_world"]["columns"][3][0]
        assert first == pytest.approx(each["transforms"][0, 0, 3] - 1.002 + 2.004 / 32, abs=1e-4)


@pytest.mark.blender
def test_too_many_placements_are_even_and_told():
    import bpy
    import numpy as np
    from clouds import exported
    from recorder import empty, link, module

    empty()
    thing = cube(by_place("Generated")[0])
    inner = bpy.data.collections.new("Cubes")
    bpy.context.scene.collection.objects.unlink(thing)
    inner.objects.link(thing)
    for number in range(6):
        bearer = link(bpy.data.objects.new("Bearer", None))
        bearer.instance_type, bearer.instance_collection, bearer.location = "COLLECTION", inner, (3 * number, 0, 0)
    module("export.volumes.insides").MOST_PLACEMENTS = 4
    _, scene, lines = exported()
    assert len(lines) == 1 and "64 placements" in lines[0]
    assert len(scene.fields) == 4 and sorted(len(each["transforms"]) for each in scene.instances) == [1, 1, 1, 1, 2]
    (rest,) = [each for each in scene.instances if len(each["transforms"]) == 2]
    medium = scene.materials[rest["materials"][0]]["medium"]
    assert "field" not in medium and medium["scattering"][0] == pytest.approx(0.5 * 0.8, rel=1e-3)
    assert np.unique([each["materials"][0] for each in scene.instances]).size == 5


@pytest.mark.blender
def test_emission_by_place_is_heat():
    import numpy as np
    from clouds import exported, filled
    from recorder import empty

    empty()
    made, tree, shader = filled("VolumePrincipled", Density=2.0, Emission_Color=(1.0, 0.5, 0.25, 1.0))
    place, apart = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(place.outputs["Generated"], apart.inputs[0])
    tree.links.new(apart.outputs[0], shader.inputs["Emission Strength"])
    cube(made)
    _, scene, lines = exported()
    (field,), medium = scene.fields, scene.materials[scene.instances[0]["materials"][0]]["medium"]
    assert not lines and np.allclose(field["density"] * medium["scattering"][0], 1.0)
    sent = field["heat"][8, 8, 8] * np.array(medium["emission"])
    assert np.allclose(sent, 177.83 * 8.5 / 16 * np.array([1.0, 0.5, 0.25]), rtol=0.02) and not field["glow"]


@pytest.mark.blender
def test_updates_write_what_changed_alone():
    import bpy
    from clouds import exported, followed
    from recorder import depsgraph, empty, link, module

    empty()
    filling = module("export.volumes.insides")
    asked, ask = [], filling.fill
    filling.fill = lambda *arguments: asked.append(1) or ask(*arguments)
    made, shader = by_place("Object")
    thing, lamp = cube(made), link(bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT")))
    exporter, scene, _ = exported()
    found = followed(exporter)
    update = bpy.context.view_layer.update
    calls = len(scene.calls)
    # Another thing moves, a whole pass, and a surface that is another: nothing of the volume is asked or written.
    lamp.location.x = 3.0
    update()
    exporter.sync(depsgraph())
    assert len(asked) == 1 and not {"fields", "meshes", "materials", "instances"} & set(scene.calls[calls:])
    made.node_tree.nodes.new("ShaderNodeMath")
    update()
    assert len(asked) == 1 and "fields" not in scene.calls[calls:]
    # Moved: its field is sent again, and not asked.
    thing.location.x = 4.0
    update()
    assert found[0].geometry and len(asked) == 1
    (instance,) = scene.instances
    number = scene.materials[instance["materials"][0]]["medium"]["field"]
    assert instance["transforms"][0, 0, 3] == 4.0 and scene.fields[number]["to_world"]["columns"][3][0] > 3.0
    # Denser.
    shader.inputs["Color"].default_value = (0.5, 0.5, 0.5, 1.0)
    update()
    assert len(asked) == 2 and scene.fields[0]["density"].max() == pytest.approx(1.5 * 15 / 16 * 1.002, rel=1e-3)
    # Another form, then gone.
    for vertex in thing.data.vertices:
        vertex.co.x *= 2.0
    thing.data.update()
    update()
    medium = scene.materials[scene.instances[0]["materials"][0]]["medium"]
    assert len(asked) == 3 and scene.fields[medium["field"]]["density"].shape == (16, 9, 9)
    bpy.data.objects.remove(thing)
    update()
    assert not scene.instances and not scene.fields


@pytest.mark.blender
def test_what_follows_another_object_is_asked_when_that_moves():
    import bpy
    import numpy as np
    from clouds import exported, filled, followed
    from recorder import empty, link

    empty()
    made, tree, shader = filled("VolumeScatter", Color=(1.0, 1.0, 1.0, 1.0))
    place, apart = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeSeparateXYZ")
    place.object = link(bpy.data.objects.new("Empty", None))
    tree.links.new(place.outputs["Object"], apart.inputs[0])
    tree.links.new(apart.outputs[0], shader.inputs["Density"])
    cube(made)
    exporter, scene, lines = exported()
    found = followed(exporter)
    assert not lines

    def middle():
        medium = scene.materials[scene.instances[0]["materials"][0]]["medium"]
        return float(scene.fields[medium["field"]]["density"][8:, 8, 8].mean() * medium["scattering"][0])

    assert np.isclose(middle(), 0.5, rtol=0.01)
    place.object.location.x = -2.0
    bpy.context.view_layer.update()
    assert found[0].geometry and np.isclose(middle(), 2.5, rtol=0.01)


@pytest.mark.blender
def test_a_surface_as_a_volume_is_told():
    from clouds import exported, filled
    from recorder import empty

    empty()
    made, _, _ = filled("BsdfDiffuse")
    cube(made)
    _, scene, lines = exported()
    assert len(lines) == 1 and "the inside stays empty" in lines[0] and not scene.fields
