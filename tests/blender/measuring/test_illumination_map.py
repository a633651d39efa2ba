"""Illumination maps of selected objects: images over UV maps, attributes of meshes."""

import pytest


def mapped(**options):
    """Runs the operator."""
    import bpy

    assert bpy.ops.gonio.illumination_map(**{"error": 0.0, "paths": 1.0, **options}) == {"FINISHED"}


def failure(**options):
    """What the operator says is wrong."""
    import bpy

    try:
        bpy.ops.gonio.illumination_map(**options)
    except RuntimeError as error:
        return str(error)
    raise AssertionError("it was mapped")


def lit_square():
    """A square of 2 m, its UV map and eight by eight faces, one metre under a point lamp of 100 W; gives it and its candela."""
    import math

    import bpy
    import scenes

    scenes.empty()
    bpy.ops.object.light_add(type="POINT", location=(0, 0, 1))
    lamp = bpy.context.object.data
    lamp.energy, lamp.shadow_soft_size = 100.0, 0.0
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=8, y_subdivisions=8, size=2.0)
    square = bpy.context.object
    square.name = "Square"
    square.data.materials.append(scenes.diffuse("Grey", (0.5, 0.5, 0.5)))
    return square, 100.0 * scenes.LUMENS_PER_WATT / (4.0 * math.pi)


def lux(candela, x, y):
    """One metre below a point lamp."""
    return candela / (x * x + y * y + 1.0) ** 1.5


@pytest.mark.blender
def test_images_hold_lux_over_the_uv_map():
    import importlib

    import bpy
    import numpy

    square, candela = lit_square()
    square.location.x = 0.25
    bpy.context.scene.cursor.location = (0, 0, 0)
    mapped(width=32, height=16)
    image = bpy.data.images["Square Illuminance"]
    assert tuple(image.size) == (32, 16) and image.is_float and image.packed_file is not None and image.colorspace_settings.is_data
    pixels = numpy.array(image.pixels[:]).reshape(16, 32, 4)
    # The grid's UV map covers the square, U along X and V along Y.
    x, y = (numpy.arange(32) + 0.5) / 16 - 1 + 0.25, (numpy.arange(16) + 0.5) / 8 - 1
    expected = lux(candela, x[None, :], y[:, None])
    assert (pixels[..., 0] == pixels[..., 2]).all() and (pixels[..., 3] == 1.0).all()
    away = abs(pixels[..., 0] / expected - 1.0)
    assert away.mean() < 0.03 and away.max() < 0.15, (away.mean(), away.max())
    assert abs(pixels[..., 0].mean() / expected.mean() - 1.0) < 0.005
    lines = importlib.import_module("gonio_extension.measuring").latest.maps
    assert lines[0].startswith("Square: ") and " lx ± " in lines[0], lines
    # Nothing else is there to scatter light to it.
    mapped(width=32, height=16, quantity="INDIRECT")
    assert not numpy.array(image.pixels[:]).reshape(-1, 4)[:, :3].any() and len(bpy.data.images) == 1
    mapped(width=8, height=8, side="BACK", output_name="back")
    assert not numpy.array(bpy.data.images["Square back"].pixels[:]).reshape(-1, 4)[:, :3].any()


@pytest.mark.blender
def test_the_active_uv_map_is_taken():
    import bpy
    import numpy

    square, candela = lit_square()
    own = square.data.uv_layers.new(name="Lightmap")
    corners = numpy.empty((len(square.data.loops), 2), "f4")
    square.data.uv_layers[0].uv.foreach_get("vector", corners.reshape(-1))
    own.uv.foreach_set("vector", (0.5 * corners).reshape(-1))
    square.data.uv_layers.active = own
    assert square.data.uv_layers[0].active_render
    mapped(width=32, height=32, margin=0)
    pixels = numpy.array(bpy.data.images["Square Illuminance"].pixels[:]).reshape(32, 32, 4)[..., 0]
    # A quarter of the image, at the bottom left.
    assert pixels[:16, :16].min() > 0.15 * candela and not pixels[16:].any() and not pixels[:, 16:].any()
    mapped(width=32, height=32, margin=2)
    pixels = numpy.array(bpy.data.images["Square Illuminance"].pixels[:]).reshape(32, 32, 4)[..., 0]
    assert pixels[17, 17] > 0.15 * candela and not pixels[18:].any()


@pytest.mark.blender
def test_attributes_of_points_corners_and_faces():
    import bpy
    import numpy

    square, candela = lit_square()
    mesh = square.data
    points = numpy.array([point.co[:] for point in mesh.vertices])
    corners = points[[loop.vertex_index for loop in mesh.loops]]
    middles = numpy.array([face.center[:] for face in mesh.polygons])
    # A modifier that moves points only is no hindrance.
    square.modifiers.new("Stretch", "SIMPLE_DEFORM").angle = 0.0
    for domain, places, allowed in (("POINT", points, 0.06), ("CORNER", corners, 0.06), ("FACE", middles, 0.03)):
        mapped(target=domain, texel=0.125, paths=2.0)
        attribute = mesh.attributes["Illuminance"]
        assert (attribute.domain, attribute.data_type, len(attribute.data)) == (domain, "FLOAT", len(places))
        values = numpy.empty(len(places), "f4")
        attribute.data.foreach_get("value", values)
        away = abs(values / lux(candela, places[:, 0], places[:, 1]) - 1.0)
        assert away.mean() < allowed, (domain, away.mean())
    # Its mean is the light that arrived: faces are of one size.
    x = (numpy.arange(64) + 0.5) / 32 - 1
    assert abs(values.mean() / lux(candela, x[None, :], x[:, None]).mean() - 1.0) < 0.01


@pytest.mark.blender
def test_several_objects_and_their_own_placements():
    import importlib

    import bpy
    import numpy

    square, candela = lit_square()
    square.name = "Room/Floor"
    bpy.ops.mesh.primitive_plane_add(size=0.5, location=(0, 0, 2), rotation=(0, 0, 0))
    bpy.context.object.name = "Room"
    square.select_set(True)
    mapped(target="FACE")
    lines = importlib.import_module("gonio_extension.measuring").latest.maps
    # Lit from below, the plane's back is the brighter side.
    assert sorted(line.split(":")[0] for line in lines) == ["Room (back)", "Room/Floor"], lines
    value = bpy.data.objects["Room"].data.attributes["Illuminance"].data[0].value
    assert numpy.isclose(value, lux(candela, 0.0, 0.0), rtol=0.15)
    assert len(square.data.attributes["Illuminance"].data) == 64


@pytest.mark.blender
def test_maps_can_be_undone():
    import bpy

    square, _ = lit_square()
    if not bpy.ops.ed.undo_push.poll():
        pytest.skip("no undo here")
    bpy.context.preferences.edit.use_global_undo = True
    bpy.ops.ed.undo_push(message="before")
    mapped(width=8, height=8)
    mapped(target="POINT")
    bpy.ops.ed.undo_push(message="after")
    assert "Square Illuminance" in bpy.data.images and "Illuminance" in bpy.data.objects["Square"].data.attributes
    bpy.ops.ed.undo()
    assert "Square Illuminance" not in bpy.data.images and "Illuminance" not in bpy.data.objects["Square"].data.attributes


@pytest.mark.blender
def test_what_makes_no_map_is_told_once():
    import bpy
    import scenes

    square, _ = lit_square()
    bpy.ops.object.select_all(action="DESELECT")
    assert "No surface is selected" in failure()
    bpy.ops.mesh.primitive_plane_add(size=1.0, location=(0, 0, 0.5))
    plane = bpy.context.object
    plane.name = "Plane"
    plane.data.uv_layers.remove(plane.data.uv_layers[0])
    plane.data.update()
    assert "Plane: it has no UV map; unwrap it" in failure()
    layer = plane.data.uv_layers.new(name="Flat")
    for corner in layer.uv:
        corner.vector = (0.5, 0.5)
    assert "Plane: its UV map 'Flat' encloses nothing" in failure()
    layer.uv[0].vector = (float("nan"), 0.0)
    assert "Plane: its UV map 'Flat' encloses nothing, or is no numbers" in failure()
    bpy.ops.object.add(type="MESH")
    bpy.context.object.name = "Nothing"
    assert "Nothing: it has no faces" in failure() and "Nothing: it has no faces" in failure(target="POINT")
    bpy.data.objects.remove(bpy.context.object)
    square.select_set(True)
    bpy.context.view_layer.objects.active = square
    square.modifiers.new("Divide", "SUBSURF")
    assert "Square: its modifiers change its faces" in failure(target="CORNER")
    mapped(width=4, height=4, paths=0.1)
    square.modifiers.clear()
    twin = square.copy()
    twin.name = "Twin"
    bpy.context.scene.collection.objects.link(twin)
    twin.select_set(True)
    assert "share a mesh" in failure(target="POINT")
    bpy.data.objects.remove(twin)
    assert "another attribute 'UVMap'" in failure(target="POINT", output_name="UVMap", paths=0.1)
    bpy.data.lights[0].energy = 0.0
    square.select_set(True)
    assert "sends light" in failure()
    bpy.ops.object.mode_set(mode="EDIT")
    assert not bpy.ops.gonio.illumination_map.poll()
    bpy.ops.object.mode_set(mode="OBJECT")
    scenes.empty().render.engine = "BLENDER_WORKBENCH"
    assert not bpy.ops.gonio.illumination_map.poll()


@pytest.mark.blender
def test_overlapping_uv_maps_are_told_and_mapped():
    import importlib

    import bpy

    square, candela = lit_square()
    layer = square.data.uv_layers[0]
    # All faces lie upon each other.
    for face in square.data.polygons:
        for corner, place in zip(face.loop_indices, [(0, 0), (1, 0), (1, 1), (0, 1)], strict=True):
            layer.uv[corner].vector = place
    module = importlib.import_module("gonio_extension.operators.illumination_map")
    said = []
    operator = module.GONIO_OT_illumination_map
    fields = {name: vars(operator)[name] for name in ("execute", "_publish", "_options")}
    usual = {"target": "IMAGE", "quantity": "ILLUMINANCE", "side": "BRIGHTER", "width": 8, "height": 8, "margin": 0, "texel": 0.0}
    usual |= {"output_name": "", "error": 0.0, "paths": 0.5, "_asked": False, "report": lambda self, kind, text: said.append((kind, text))}
    assert type("Running", operator.__bases__[:1], {**fields, **usual})().execute(bpy.context) == {"FINISHED"}
    ((kind, text),) = said
    assert kind == {"WARNING"} and text.startswith("Square: ") and "share 100.0 % of the texels" in text, said
    # They show the mean.
    mean = bpy.data.images["Square Illuminance"].pixels[0]
    assert 0.4 * candela < mean < 0.8 * candela


@pytest.mark.blender
def test_it_is_mapped_beside_blender_until_escape():
    import importlib
    import time
    from types import SimpleNamespace

    import bpy

    lit_square()
    module = importlib.import_module("gonio_extension.operators.illumination_map")
    operator = module.GONIO_OT_illumination_map
    said, timers, texts = [], [], []
    names = ("_arrived", "_publish", "_options", "execute")
    fields = {name: vars(operator)[name] for name in names} | {"report": lambda self, kind, text: said.append(text)}
    usual = {"target": "IMAGE", "quantity": "ILLUMINANCE", "side": "BRIGHTER", "width": 8, "height": 8, "margin": 0, "texel": 0.0}
    running = type("Running", operator.__bases__[:1], {**fields, **usual, "output_name": "lx", "error": 0.0, "_asked": True, "_worker": None})()
    context = SimpleNamespace(
        view_layer=bpy.context.view_layer,
        window=None,
        window_manager=SimpleNamespace(
            event_timer_add=lambda pause, window: timers.append(pause) or pause,
            event_timer_remove=timers.remove,
            modal_handler_add=lambda operator: None,
        ),
        screen=None,
        workspace=SimpleNamespace(status_text_set=texts.append),
        evaluated_depsgraph_get=bpy.context.evaluated_depsgraph_get,
    )
    tick, escape = SimpleNamespace(type="TIMER"), SimpleNamespace(type="ESC")
    # There is no window here, so that it would wait.
    module.bpy = SimpleNamespace(app=SimpleNamespace(background=False))
    running.paths = 1e4
    assert running.execute(context) == {"RUNNING_MODAL"} and timers and "ESC: Cancel" in texts[-1]
    assert running.modal(context, tick) == {"RUNNING_MODAL"}
    assert running.modal(context, escape) == {"CANCELLED"}
    assert running._found.done() and not timers and texts[-1] is None and not bpy.data.images
    running.paths = 0.1
    assert running.execute(context) == {"RUNNING_MODAL"}
    while (state := running.modal(context, tick)) == {"RUNNING_MODAL"}:
        time.sleep(0.01)
    assert state == {"FINISHED"} and not timers and "Square lx" in bpy.data.images, said


@pytest.mark.blender
def test_options_have_words_and_units():
    import bpy

    properties = bpy.ops.gonio.illumination_map.get_rna_type().properties
    for name, described in properties.items():
        if name != "rna_type":
            assert described.name and len(described.description) > 10 and not described.description.endswith("."), name
    assert properties["texel"].unit == "LENGTH" and properties["error"].subtype == "PERCENTAGE"
    for name in ("target", "quantity", "side"):
        assert all(len(item.description) > 10 for item in properties[name].enum_items), name
