"""Luminaires of lamps, reflectors and covers, measured in Blender and written for light planning."""

from pathlib import Path

import pytest


def disk_lamp(watts=10.0, location=(0, 0, 0), rotation=(0, 0, 0)):
    """A Lambertian disk that shines along its -Z."""
    import bpy

    bpy.ops.object.light_add(type="AREA", location=location, rotation=rotation)
    lamp = bpy.context.object
    lamp.name = "Disk"
    lamp.data.shape, lamp.data.size, lamp.data.energy = "DISK", 0.2, watts
    return lamp


def open_cylinder(radius=0.1, depth=0.2):
    """A black tube without ends, about the origin."""
    import bpy
    import scenes

    bpy.ops.mesh.primitive_cylinder_add(vertices=256, radius=radius, depth=depth, end_fill_type="NOTHING")
    tube = bpy.context.object
    tube.name = "Tube"
    tube.data.materials.append(scenes.diffuse("Black", (0, 0, 0)))
    return tube


def measure(**options):
    """Runs the operator with all rays: figures are held to 1 %."""
    import bpy

    assert bpy.ops.gonio.measure_luminaire(**{"error": 0.0, "rays": 4.0, **options}) == {"FINISHED"}


def failure(**options):
    """What the operator says is wrong."""
    import bpy

    try:
        bpy.ops.gonio.measure_luminaire(**options)
    except RuntimeError as error:
        return str(error)
    raise AssertionError("it was measured")


def cut(path, plane=0):
    """γ and cd of a file's plane C0-C180 or C90-C270, those of its C0 or C90 half, and all of its figures."""
    import gonio
    import numpy

    figures = gonio.goniogram_figures(path.read_bytes(), str(path))
    half = numpy.array([point for point in figures["cuts"][plane] if point[0] >= 0.0])
    return half[:, 0], half[:, 1], figures


@pytest.mark.blender
def test_a_disk_is_lambertian(tmp_path: Path):
    import importlib
    import math

    import bpy
    import numpy
    import scenes

    # The floor and the other lamp are no part of it, nor is the world.
    scene = scenes.lit_floor()
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    disk_lamp(location=(0, 0, 0.1))
    measure(filepath=str(tmp_path / "disk.ldt"), kind="SELECTION")
    flux = 10.0 * scenes.LUMENS_PER_WATT
    for plane in (0, 1):
        gamma, intensity, figures = cut(tmp_path / "disk.ldt", plane)
        expected = flux / math.pi * numpy.cos(numpy.radians(gamma))
        lit = gamma < 88.0
        assert numpy.allclose(intensity[lit], expected[lit], rtol=0.01, atol=0.002 * flux / math.pi), (gamma, intensity / expected)
        assert (intensity[gamma > 93.0] == 0.0).all()
    assert math.isclose(figures["flux_lm"], flux, rel_tol=0.01) and figures["luminaire"] == "Disk"
    lines = importlib.import_module("gonio_extension.measuring").latest.luminaire
    assert lines[0] == "Disk" and "lm" in lines[1] and lines[2] == "light output ratio 100.0 %" and "beam 120° × 120°" in lines, lines
    assert len([thing for thing in bpy.data.objects if thing.type == "LIGHT"]) == 2


@pytest.mark.blender
def test_a_tube_cuts_off_at_its_rim(tmp_path: Path):
    import math

    import bpy
    import scenes

    scenes.empty()
    tube = open_cylinder()
    bpy.ops.object.light_add(type="POINT", location=(0, 0, 0.05))
    lamp = bpy.context.object
    lamp.data.energy, lamp.data.shadow_soft_size = 10.0, 0.0
    lamp.parent = tube
    bpy.context.view_layer.objects.active = tube
    measure(filepath=str(tmp_path / "tube.ies"), kind="CHILDREN", g_step=math.radians(1.0))
    gamma, intensity, figures = cut(tmp_path / "tube.ies")
    even = 10.0 * scenes.LUMENS_PER_WATT / (4.0 * math.pi)
    down, up = math.degrees(math.atan2(0.1, 0.15)), 180.0 - math.degrees(math.atan2(0.1, 0.05))
    for angle, found in zip(gamma, intensity, strict=True):
        # Cells reach half a degree to either side.
        if angle < down - 1.0 or angle > up + 1.0:
            assert math.isclose(found, even, rel_tol=0.05), (angle, found, even)
        elif down + 1.0 < angle < up - 1.0:
            assert found == 0.0, (angle, found)
    share = 0.5 * (2.0 - math.cos(math.radians(down)) + math.cos(math.radians(up)))
    assert math.isclose(figures["flux_lm"], share * 10.0 * scenes.LUMENS_PER_WATT, rel_tol=0.01)


@pytest.mark.blender
def test_turned_and_moved_luminaires_have_the_same_file(tmp_path: Path):
    import math

    import bpy
    import numpy
    import scenes

    scenes.empty()
    tube = open_cylinder()
    lamp = disk_lamp(location=(0.02, 0, 0.0), rotation=(0.0, math.radians(25.0), 0.0))
    lamp.data.size = 0.05
    lamp.parent = tube
    bpy.context.view_layer.objects.active = tube
    for name in ("plain", "moved"):
        measure(filepath=str(tmp_path / f"{name}.ldt"), kind="CHILDREN", symmetry="NONE")
        tube.location, tube.rotation_euler = (3.0, -2.0, 1.5), (1.0, 0.7, -2.2)
        bpy.context.view_layer.update()
    plain, moved = ((tmp_path / f"{name}.ldt").read_text("latin-1").splitlines() for name in ("plain", "moved"))
    # The luminaire's and the opening's extents in mm.
    extents = numpy.array([plain[12:21], moved[12:21]], dtype=float)
    assert len(plain) == len(moved) and numpy.allclose(*extents, atol=0.5), extents
    for plane in (0, 1):
        (_, one, figures), (_, other, _) = (cut(tmp_path / f"{name}.ldt", plane) for name in ("plain", "moved"))
        assert numpy.abs(one - other).max() < 0.02 * figures["peak_cd"], (one, other)
    # Light leaves aslant, towards C180.
    across = dict(map(tuple, figures["cuts"][0]))
    assert across[-25.0] > 1.1 * across[25.0]


@pytest.mark.blender
def test_a_lamp_takes_the_file(tmp_path: Path):
    import importlib
    import math

    import bpy
    import scenes

    scenes.empty()
    disk = disk_lamp(location=(1, 2, 3), rotation=(0.3, 0.0, 0.0))
    measure(filepath=str(tmp_path / "disk.xml"), use_lamp=True)
    (lamp,) = (thing for thing in bpy.data.objects if thing.type == "LIGHT" and thing != disk)
    settings = lamp.data.gonio
    assert lamp.data.type == "POINT" and settings.use_photometry and settings.unit == "FILE" and not lamp.hide_render
    assert math.isclose(settings.quantity, 10.0 * scenes.LUMENS_PER_WATT, rel_tol=0.01)
    bpy.context.view_layer.update()
    apart = disk.matrix_world.inverted() @ lamp.matrix_world
    assert apart.translation.x > 0.2 and abs(apart.translation.y) < 0.01 and abs(apart.translation.z) < 0.01
    assert all(math.isclose(apart[i][j], float(i == j), abs_tol=1e-5) for i in range(3) for j in range(3))
    assert importlib.import_module("gonio_extension.luminaire").figures(lamp.data)["beam_angle_deg"][0] > 110.0
    # Measured again, the lamp alone says the same.
    bpy.ops.object.select_all(action="DESELECT")
    lamp.select_set(True)
    bpy.context.view_layer.objects.active = lamp
    measure(filepath=str(tmp_path / "again.ldt"))
    assert math.isclose(cut(tmp_path / "again.ldt")[2]["flux_lm"], settings.quantity, rel_tol=0.01)


@pytest.mark.blender
def test_a_product_has_the_meshes_and_lamps_take_it(tmp_path: Path):
    import importlib
    import math
    import zipfile
    from io import BytesIO

    import bpy
    import scenes

    scenes.empty()
    tube = open_cylinder()
    lamp = disk_lamp()
    lamp.parent = tube
    bpy.context.view_layer.objects.active = tube
    measure(filepath=str(tmp_path / "tube.gldf"), kind="CHILDREN", use_lamp=True)
    with zipfile.ZipFile(tmp_path / "tube.gldf") as product:
        assert product.namelist() == ["product.xml", "ldc/luminaire.ldt", "geo/luminaire.l3d"]
        with zipfile.ZipFile(BytesIO(product.read("geo/luminaire.l3d"))) as model:
            mesh = model.read("part1-Tube/part1-Tube.obj").decode().splitlines()
    assert len([line for line in mesh if line.startswith("v ")]) == 512
    (copy,) = (thing for thing in bpy.data.objects if thing.type == "LIGHT" and thing != lamp)
    assert math.isclose(copy.data.gonio.quantity, cut(tmp_path / "tube.gldf")[2]["flux_lm"], rel_tol=1e-3)
    said = importlib.import_module("gonio_extension.report").latest().diagnostics
    assert len([line for line in said if "0 W stands there" in line.message]) == 1, said


@pytest.mark.blender
def test_what_cannot_be_measured_is_told(tmp_path: Path):
    import bpy
    import scenes

    scenes.empty()
    assert "Nothing is selected" in failure()
    bpy.context.view_layer.objects.active = None
    assert "No object is active" in failure(kind="CHILDREN")
    assert "empty" in failure(kind="COLLECTION")
    tube = open_cylinder()
    assert "Tube: no light source is within" in failure()
    assert "the ending is '.txt'" in failure(filepath=str(tmp_path / "tube.txt"))
    assert "name one" in failure(use_lamp=True)
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.5)
    shell = bpy.context.object
    shell.name = "Shell"
    shell.data.materials.append(tube.data.materials[0])
    lamp = disk_lamp()
    lamp.parent = shell
    bpy.context.view_layer.objects.active = shell
    assert "Shell: no light leaves: " in failure(kind="CHILDREN", rays=1.0)
    tube.scale = (0, 0, 0)
    bpy.context.view_layer.objects.active = tube
    bpy.context.view_layer.update()
    assert "Tube: its axes have no length" in failure(kind="CHILDREN")
    operator = bpy.types.GONIO_OT_measure_luminaire
    bpy.context.scene.render.engine = "BLENDER_WORKBENCH"
    assert not operator.poll(bpy.context)


@pytest.mark.blender
def test_collections_and_their_instances_are_luminaires(tmp_path: Path):
    import math

    import bpy
    import scenes

    scene = scenes.lit_floor()
    fitting = bpy.data.collections.new("Fitting")
    scene.collection.children.link(fitting)
    # The first object without a parent says where nadir is: along the world's +Y.
    bpy.ops.object.empty_add(location=(0, 0, 2), rotation=(math.radians(90.0), 0, 0))
    root = bpy.context.object
    lamp = disk_lamp()
    lamp.parent = root
    for thing in (root, lamp):
        for collection in thing.users_collection:
            collection.objects.unlink(thing)
        fitting.objects.link(thing)
    bpy.context.view_layer.active_layer_collection = bpy.context.view_layer.layer_collection.children["Fitting"]
    measure(kind="COLLECTION", filepath=str(tmp_path / "one.ldt"))
    bpy.ops.object.collection_instance_add(collection="Fitting", location=(5, 0, 0), rotation=(0, math.radians(90.0), 0))
    scene.view_layers[0].layer_collection.children["Fitting"].exclude = True
    measure(filepath=str(tmp_path / "two.ldt"))
    flux = 10.0 * scenes.LUMENS_PER_WATT
    for name in ("one", "two"):
        assert math.isclose(cut(tmp_path / f"{name}.ldt")[2]["flux_lm"], flux, rel_tol=0.01), name
    gamma, intensity, _ = cut(tmp_path / "one.ldt")
    assert intensity[0] > 0.95 * flux / math.pi and intensity[-1] == 0.0
    # The instance lies along Y of the collection: C90.
    gamma, intensity, _ = cut(tmp_path / "two.ldt", 1)
    assert math.isclose(intensity[list(gamma).index(90.0)], flux / math.pi, rel_tol=0.03)


@pytest.mark.blender
def test_glowing_meshes_are_sources(tmp_path: Path):
    import math

    import bpy
    import numpy
    import scenes

    scenes.empty()
    bpy.ops.mesh.primitive_plane_add(size=0.1, rotation=(math.pi, 0, 0), location=(0, 0, 1))
    panel = bpy.context.object
    material = bpy.data.materials.new("Glow")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    emission, output = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
    emission.inputs["Strength"].default_value = 20.0
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    panel.data.materials.append(material)
    measure(filepath=str(tmp_path / "panel.ldt"), kind="CHILDREN")
    gamma, intensity, figures = cut(tmp_path / "panel.ldt")
    expected = 20.0 * scenes.LUMENS_PER_WATT * 0.01 * numpy.abs(numpy.cos(numpy.radians(gamma)))
    apart = numpy.abs(gamma - 90.0) > 4.0
    assert numpy.allclose(intensity[apart], expected[apart], rtol=0.01, atol=0.01 * expected[0]), intensity / expected
    assert math.isclose(figures["flux_lm"], 2.0 * math.pi * expected[0], rel_tol=0.01)


@pytest.mark.blender
def test_it_is_measured_beside_blender_until_escape(tmp_path: Path):
    import importlib
    import time
    from types import SimpleNamespace

    import bpy
    import scenes

    scene = scenes.empty()
    disk_lamp()
    module = importlib.import_module("gonio_extension.operators.measure_luminaire")
    operator = module.GONIO_OT_measure_luminaire
    latest = importlib.import_module("gonio_extension.measuring").latest
    names = ("_tell", "_arrived", "_publish", "_options", "_luminaire", "_check", "execute")
    said, timers, texts = [], [], []
    fields = {name: vars(operator)[name] for name in names} | {"report": lambda self, kind, text: said.append(text)}
    usual = {"kind": "SELECTION", "c_step": 0.2617994, "g_step": 0.0872665, "symmetry": "AUTO", "error": 0.0, "seed": 0, "watts": 0.0}
    asked = {"_asked": True, "_worker": None, "use_lamp": False, "filepath": str(tmp_path / "disk.ldt")}
    running = type("Running", operator.__bases__[:1], {**fields, **usual, **asked})()
    context = SimpleNamespace(
        scene=scene,
        view_layer=bpy.context.view_layer,
        collection=bpy.context.collection,
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
    module.bpy = SimpleNamespace(app=SimpleNamespace(background=False), path=bpy.path, data=bpy.data)
    running.rays = 1e6
    assert running.execute(context) == {"RUNNING_MODAL"} and timers
    while running.modal(context, tick) == {"RUNNING_MODAL"} and "M rays, peak ±" not in texts[-1]:
        time.sleep(0.02)
    assert texts[-1].startswith("Gonio measures Disk: ")
    assert running.modal(context, escape) == {"CANCELLED"}
    assert running._found.done() and not timers and texts[-1] is None and not latest.luminaire and not (tmp_path / "disk.ldt").exists()
    running.rays = 0.3
    assert running.execute(context) == {"RUNNING_MODAL"}
    while (state := running.modal(context, tick)) == {"RUNNING_MODAL"}:
        time.sleep(0.01)
    assert state == {"FINISHED"} and not timers and texts[-1] is None and latest.luminaire and (tmp_path / "disk.ldt").exists()
    running.filepath = str(tmp_path / "nowhere" / "disk.ldt")
    assert running.execute(context) == {"RUNNING_MODAL"}
    while (state := running.modal(context, tick)) == {"RUNNING_MODAL"}:
        time.sleep(0.01)
    assert state == {"CANCELLED"} and said[-1].startswith("Disk: "), said


@pytest.mark.blender
def test_options_have_words_and_units():
    import bpy

    properties = bpy.ops.gonio.measure_luminaire.get_rna_type().properties
    for name, described in properties.items():
        if name != "rna_type":
            assert described.name and len(described.description) > 10 and not described.description.endswith("."), name
    units = {name: properties[name].unit for name in ("c_step", "g_step", "watts")}
    assert units == {"c_step": "ROTATION", "g_step": "ROTATION", "watts": "POWER"} and properties["error"].subtype == "PERCENTAGE"


@pytest.mark.blender
def test_frames_are_rigid_and_places_within_them_are_known():
    import importlib

    import bpy
    import numpy
    import scenes

    part = importlib.import_module("gonio_extension.export.part")
    around = importlib.import_module("gonio_extension.export.surroundings")
    slanted = numpy.array([[0.0, -2.0, 0.5, 1.0], [3.0, 0.1, 0.0, 2.0], [0.0, 0.3, 4.0, 3.0], [0.0, 0.0, 0.0, 1.0]])
    for mirror in (1.0, -1.0):
        frame = part.frame_of(slanted @ numpy.diag([mirror, 1.0, 1.0, 1.0]))
        axes = frame[:3, :3]
        assert numpy.allclose(axes.T @ axes, numpy.eye(3)) and numpy.isclose(numpy.linalg.det(axes), mirror)
        assert numpy.allclose(axes[:, 2] * numpy.linalg.norm(slanted[:3, 2]), slanted[:3, 2]) and (frame[:3, 3] == [1.0, 2.0, 3.0]).all()
        assert axes[:, 0] @ slanted[:3, 0] * mirror > 2.5
    scenes.empty()
    bpy.ops.object.empty_add(location=(4, 5, 6), rotation=(0.1, 0.2, 0.3))
    thing, own = bpy.context.object, part.Part(frozenset(), frame)
    seen = around.Surroundings(None, bpy.context.evaluated_depsgraph_get(), own).ask(f"object {thing.session_uid}")
    point = numpy.array([0.3, -0.2, 0.7, 1.0])
    assert numpy.allclose(numpy.array(seen) @ point, (numpy.array(thing.matrix_world.inverted()) @ frame @ point)[:3], atol=1e-5)
    assert numpy.allclose(own.placed(slanted[None]), numpy.linalg.inv(frame) @ slanted[None], atol=1e-6)
