"""Objects in Edit Mode are rendered as they are being edited; what cannot be exported costs nothing else."""

import pytest

MODIFIERS = ((), ("SUBSURF",), ("NODES",), ("SUBSURF", "NODES"))


def smooth_by_nodes():
    """A tree of geometry nodes that changes no position."""
    import bpy

    tree = bpy.data.node_groups.new("Smooth", "GeometryNodeTree")
    for side in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=side, socket_type="NodeSocketGeometry")
    start, stop, smooth = (tree.nodes.new(name) for name in ("NodeGroupInput", "NodeGroupOutput", "GeometryNodeSetShadeSmooth"))
    tree.links.new(start.outputs[0], smooth.inputs[0])
    tree.links.new(smooth.outputs[0], stop.inputs[0])
    return tree


def stretched_in_edit_mode(modifiers=()):
    """A cube in Edit Mode of which the user has just pulled the sides apart, 2 to 6 wide; its half width is given too."""
    import bmesh
    import bpy

    bpy.ops.mesh.primitive_cube_add(size=2.0)
    cube = bpy.context.object
    for name in modifiers:
        modifier = cube.modifiers.new(name, name)
        if name == "NODES":
            modifier.node_group = smooth_by_nodes()
    bpy.ops.object.mode_set(mode="EDIT")
    edited = bmesh.from_edit_mesh(cube.data)
    for point in edited.verts:
        point.co.x *= 3.0
    bmesh.update_edit_mesh(cube.data)
    return cube, 3.0


@pytest.mark.blender
def test_a_mesh_is_exported_as_it_is_being_edited(tmp_path):
    import bpy
    import numpy as np
    from recorder import depsgraph, empty, exporter

    for modifiers in MODIFIERS:
        empty()
        cube, half = stretched_in_edit_mode(modifiers)
        made, report = exporter()
        scene = made.sync(depsgraph())
        [mesh] = scene.meshes
        assert len(scene.instances) == 1 and not report.diagnostics and cube.mode == "EDIT", modifiers
        assert "SUBSURF" in modifiers or mesh["points"][:, 0].max() == pytest.approx(half)
        bpy.ops.object.mode_set(mode="OBJECT")
        after, _ = exporter()
        [left] = after.sync(depsgraph()).meshes
        assert np.allclose(mesh["points"], left["points"], atol=1e-6), modifiers


@pytest.mark.blender
def test_every_kind_of_object_shows_in_edit_mode(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter

    def text():
        bpy.ops.object.text_add()

    def curve():
        bpy.ops.curve.primitive_bezier_circle_add()
        bpy.context.object.data.bevel_depth = 0.1

    kinds = {
        "MESH": bpy.ops.mesh.primitive_ico_sphere_add,
        "CURVE": curve,
        "SURFACE": bpy.ops.surface.primitive_nurbs_surface_sphere_add,
        "FONT": text,
        "META": bpy.ops.object.metaball_add,
    }
    for kind, add in kinds.items():
        empty()
        add()
        assert bpy.context.object.type == kind
        made, _ = exporter()
        before = len(made.sync(depsgraph()).meshes[0]["points"])
        bpy.ops.object.mode_set(mode="EDIT")
        assert bpy.context.object.mode == "EDIT"
        made, report = exporter()
        scene = made.sync(depsgraph())
        assert len(scene.instances) == 1 and len(scene.meshes[0]["points"]) == before and not report.diagnostics, kind


@pytest.mark.blender
def test_meshes_show_in_every_mode(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter

    for mode in ("SCULPT", "VERTEX_PAINT", "WEIGHT_PAINT", "TEXTURE_PAINT"):
        empty()
        bpy.ops.mesh.primitive_cube_add()
        bpy.ops.object.mode_set(mode=mode)
        made, report = exporter()
        scene = made.sync(depsgraph())
        assert len(scene.instances) == 1 and len(scene.meshes[0]["triangles"]) == 12 and not report.diagnostics, mode


@pytest.mark.blender
def test_two_objects_of_one_edited_mesh_both_show(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter

    empty()
    cube, half = stretched_in_edit_mode()
    twin = bpy.data.objects.new("Twin", cube.data)
    bpy.context.scene.collection.objects.link(twin)
    twin.location.z = 5.0
    made, report = exporter()
    scene = made.sync(depsgraph())
    assert sum(len(entry["transforms"]) for entry in scene.instances) == 2 and not report.diagnostics
    assert all(mesh["points"][:, 0].max() == pytest.approx(half) for mesh in scene.meshes)


def shining(thing):
    """Gives an object a surface of radiance 1."""
    import bpy

    material = bpy.data.materials.new("Shining")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    light, output = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(light.outputs[0], output.inputs[0])
    thing.data.materials.append(material)


def covered(pixels):
    """Share of a picture that shines."""
    return float((pixels[..., 0] > 0.5).mean())


@pytest.mark.blender
def test_a_final_render_in_edit_mode_shows_the_edit(tmp_path):
    import bpy
    import scenes

    for saved in (False, True):
        scene = scenes.empty(width=64, height=64, samples=4)
        bpy.ops.object.camera_add(location=(0, 0, 9))
        scene.camera = bpy.context.object
        scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 8.0
        cube, _ = stretched_in_edit_mode()
        shining(cube)
        if saved:
            path = str(tmp_path / "edited.blend")
            bpy.ops.wm.save_as_mainfile(filepath=path)
            bpy.ops.wm.open_mainfile(filepath=path)
        scenes.render(tmp_path / "edit.exr")
        channels = scenes.read(tmp_path / "edit.exr")
        pixels = next(values for name, values in channels.items() if name.endswith("Combined.R"))
        # 6 × 2 of 8 × 8.
        assert covered(pixels[..., None]) == pytest.approx(12.0 / 64.0, abs=0.01), saved


@pytest.mark.blender
def test_the_viewport_follows_edits_in_edit_mode(tmp_path):
    import bmesh
    import bpy
    import numpy
    import scenes
    from mathutils import Matrix
    from viewport import Viewport

    scene = scenes.empty()
    scene.gonio.preview_samples = 1
    bpy.ops.mesh.primitive_cube_add(size=2.0)
    cube = bpy.context.object
    shining(cube)
    view = Viewport(Matrix.Translation((0, 0, 10)))

    def share():
        picture = view.finish()
        return covered(numpy.asarray(picture.pixels).reshape(picture.height, picture.width, 4))

    before = share()
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.view_layer.update()
    assert share() == pytest.approx(before, rel=0.02)
    edited = bmesh.from_edit_mesh(cube.data)
    for point in edited.verts:
        point.co.x *= 0.5
    bmesh.update_edit_mesh(cube.data)
    bpy.context.view_layer.update()
    assert share() == pytest.approx(0.5 * before, rel=0.05)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert share() == pytest.approx(0.5 * before, rel=0.05)
    assert not view.session.report.diagnostics
    view.close()


@pytest.mark.blender
def test_edits_of_curves_and_texts_reach_the_viewport(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter

    def thicker():
        bpy.context.object.data.bevel_depth = 0.5

    def longer():
        bpy.ops.font.text_insert(text="more")

    for add, edit in ((bpy.ops.curve.primitive_bezier_circle_add, thicker), (bpy.ops.object.text_add, longer)):
        empty()
        add()
        if bpy.context.object.type == "CURVE":
            bpy.context.object.data.bevel_depth = 0.1
        bpy.ops.object.mode_set(mode="EDIT")
        made, report = exporter()
        scene = made.sync(depsgraph())
        before = scene.meshes[scene.instances[0]["mesh"]]["points"][:, 0].max()
        bpy.app.handlers.depsgraph_update_post.append(lambda _, graph, made=made: made.update(graph))
        edit()
        bpy.context.view_layer.update()
        bpy.app.handlers.depsgraph_update_post.clear()
        assert scene.meshes[scene.instances[0]["mesh"]]["points"][:, 0].max() > before + 0.1 and not report.diagnostics


@pytest.mark.blender
def test_what_cannot_be_exported_is_named_and_all_else_is_rendered(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link, module, quad

    empty()
    scene = bpy.context.scene
    scene.world = bpy.data.worlds.new("Bad world")
    for name in ("Good", "Bad"):
        link(bpy.data.objects.new(f"{name} mesh", quad(name))).data.materials.append(bpy.data.materials.new(f"{name} material"))
        link(bpy.data.objects.new(f"{name} lamp", bpy.data.lights.new(name, "POINT")))
    # Equal meshes would be one.
    bpy.data.meshes["Bad"].vertices[0].co.z = 1.0
    parts = {
        "export.meshes": ("mesh_arguments", lambda mesh, *_: mesh.name.startswith("Bad")),
        "export.lights": ("describe", lambda group, *_: group.name.startswith("Bad")),
        "export.materials": ("translate", lambda material, *_, **__: material is not None and material.name.startswith("Bad")),
        "export.world": ("domes", lambda world, *_: True),
    }
    for name, (function, is_bad) in parts.items():
        usual = getattr(module(name), function)

        def failing(*arguments, usual=usual, is_bad=is_bad, name=name, **keywords):
            if is_bad(*arguments, **keywords):
                raise KeyError(name)
            return usual(*arguments, **keywords)

        setattr(module(name), function, failing)
    made, report = exporter()
    found = made.sync(depsgraph())
    assert [entry["name"] for entry in found.instances] == ["Good mesh"]
    assert [light["origin"]["name"] for light in found.lights] == ["Good lamp"]
    told = {(line.kind, line.name): line.message for line in report.diagnostics if line.severity == "ERROR"}
    assert set(told) == {("Object", "Bad mesh"), ("Object", "Bad lamp"), ("Material", "Bad material"), ("World", "Bad world")}
    assert all(message.startswith("KeyError: ") and ";" in message for message in told.values()), told
    # The viewport goes on as well, and a problem that is gone is told no more.
    bpy.app.handlers.depsgraph_update_post.append(lambda _, graph: made.update(graph))
    bpy.data.objects.remove(bpy.data.objects["Bad mesh"])
    bpy.context.view_layer.update()
    bpy.app.handlers.depsgraph_update_post.clear()
    assert ("Object", "Bad mesh") not in {(line.kind, line.name) for line in report.diagnostics}


@pytest.mark.blender
def test_what_the_scene_refuses_leaves_all_else_in_its_place(tmp_path):
    import bpy
    import gonio
    from recorder import depsgraph, empty, exporter, link, quad

    empty()
    for number, name in enumerate(("First", "Bad", "Last")):
        thing = link(bpy.data.objects.new(name, quad(name)))
        thing.data.vertices[0].co.z = float(number)
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        texture = material.node_tree.nodes.new("ShaderNodeTexImage")
        texture.image = bpy.data.images.new(name, 2, 2)
        texture.image.generated_color = (0.25 * (number + 1), 0.0, 0.0, 1.0)
        material.node_tree.links.new(texture.outputs[0], material.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
        thing.data.materials.append(material)
    made, report = exporter()
    for function in ("put_mesh", "put_material", "put_texture"):
        usual = getattr(made.scene, function)

        def refusing(*arguments, usual=usual, **keywords):
            described = arguments[0]["origin"]["name"] if isinstance(arguments[0], dict) else keywords["name"]
            if described == "Bad":
                raise gonio.Error("refused")
            return usual(*arguments, **keywords)

        setattr(made.scene, function, refusing)
    for _ in range(2):
        scene = made.sync(depsgraph())
        assert {entry["name"]: scene.meshes[entry["mesh"]]["points"][:, 2].max() for entry in scene.instances} == {
            "First": 0.0,
            "Last": 2.0,
        }
        for entry in scene.instances:
            [number] = entry["materials"]
            [lookup] = [node["operation"]["Image"] for node in scene.materials[number]["graph"]["nodes"] if "Image" in node["operation"]]
            assert scene.textures[lookup["texture"]]["origin"]["name"] == entry["name"]
        assert {(line.kind, line.name) for line in report.diagnostics} == {("Object", "Bad"), ("Material", "Bad")}
