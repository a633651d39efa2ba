"""Luminaires' files that are dropped on a viewport or added by the menu: lights in their place, with a symbol that is not rendered."""

from pathlib import Path

import pytest

IES = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 {size}\n1 1 10\n0 90\n0\n100 0\n"


def files(folder, **sizes):
    for name, size in sizes.items():
        (folder / f"{name}.ies").write_text(IES.format(size=size))
    return [{"name": f"{name}.ies"} for name in sizes]


@pytest.mark.blender
def test_lights_stand_in_a_row_with_their_files(tmp_path: Path):
    import bpy

    names = files(tmp_path, panel="0.3 1.2 0", spot="-0.1 -0.1 0", bare="0 0 0", box="0.2 0.4 0.1")
    found = bpy.ops.gonio.hang_luminaire(directory=str(tmp_path), files=names, location=(1, 2, 3), spacing=2.0)
    assert found == {"FINISHED"}
    panel, spot, bare, box = (bpy.data.objects[name] for name in ("panel", "spot", "bare", "box"))
    assert [tuple(round(x, 6) for x in thing.location) for thing in (panel, spot, bare, box)] == [(1, 2, 3), (3, 2, 3), (5, 2, 3), (7, 2, 2.95)]
    assert panel.data.type == "AREA" and panel.data.shape == "RECTANGLE"
    # LM-63's width lies along Y, its length along C0.
    assert (round(panel.data.size, 6), round(panel.data.size_y, 6)) == (1.2, 0.3)
    assert spot.data.shape == "DISK" and bare.data.type == "POINT" and box.data.shape == "RECTANGLE"
    for thing in (panel, spot, bare, box):
        settings = thing.data.gonio
        assert settings.use_photometry and settings.unit == "FILE" and Path(settings.file) == tmp_path / f"{thing.name}.ies"
        symbol = bpy.data.objects[f"{thing.name} symbol"]
        assert symbol.parent == thing and symbol.hide_render and not symbol.data.polygons
    assert bpy.context.view_layer.objects.active == panel and set(bpy.context.selected_objects) == {panel, spot, bare, box}


@pytest.mark.blender
def test_it_lights_as_its_file_says(tmp_path: Path):
    import importlib

    import bpy
    import gonio
    import scenes

    extension = importlib.import_module("gonio_extension")
    scene = scenes.empty()
    scene.world = None
    (name,) = files(tmp_path, bare="0 0 0")
    bpy.ops.gonio.hang_luminaire(filepath=str(tmp_path / name["name"]), location=(0, 0, 2))
    exporter = importlib.import_module(f"{extension.__name__}.export").Exporter
    report = importlib.import_module(f"{extension.__name__}.report").Report()
    exported = exporter(report).sync(bpy.context.evaluated_depsgraph_get())
    exported.add_meter((0, 0, 0))
    reading = gonio.measure(exported, samples=256).meters[0]
    # 100 cd down from 2 m.
    assert abs(reading.value - 25.0) < 0.05, reading.value


@pytest.mark.blender
def test_where_it_hangs(tmp_path: Path):
    import importlib

    import bpy
    from mathutils import Vector

    hanging = importlib.import_module("gonio_extension.operators.hang_luminaire").hanging
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)

    def under(origin, direction):
        bpy.context.view_layer.update()
        depsgraph = bpy.context.evaluated_depsgraph_get()
        found = hanging(bpy.context.scene, depsgraph, Vector(origin), Vector(direction).normalized(), 2.8)
        return found and tuple(round(x, 4) for x in found)

    assert under((0, 0, 1), (0, 0, -1)) is None
    bpy.ops.mesh.primitive_plane_add(size=10)
    assert under((1, 1, 1), (0, 0, -1)) == (1, 1, 2.8)
    bpy.ops.mesh.primitive_plane_add(size=10, location=(0, 0, 3))
    # Dropped on the floor or on the ceiling it is under the ceiling.
    assert under((1, 1, 1), (0, 0, -1)) == (1, 1, 2.995)
    assert under((1, 1, 1), (0, 0, 1)) == (1, 1, 2.995)
    bpy.ops.mesh.primitive_plane_add(size=10, location=(4, 0, 0), rotation=(0, 1.5707963, 0))
    assert under((0, 0, 1), (1, 0, 0)) == (3.995, 0, 1)


@pytest.mark.blender
def test_files_that_are_none(tmp_path: Path):
    import bpy

    (tmp_path / "no.ies").write_text("no luminaire")
    for name, words in (("no.ies", "no.ies"), ("absent.ies", "absent.ies")):
        try:
            bpy.ops.gonio.hang_luminaire(filepath=str(tmp_path / name))
        except RuntimeError as error:
            assert words in str(error), error
        else:
            raise AssertionError("it was hung")
    names = [*files(tmp_path, good="0 0 0"), {"name": "no.ies"}]
    try:
        bpy.ops.gonio.hang_luminaire(directory=str(tmp_path), files=names)
    except RuntimeError as error:
        assert "no.ies" in str(error)
    # What can be read hangs all the same.
    assert "good" in bpy.data.objects and "no" not in bpy.data.objects


@pytest.mark.blender
def test_viewports_take_files_by_their_endings():
    import bpy

    handler = bpy.types.GONIO_FH_luminaire
    assert handler.bl_file_extensions == ".ies;.ldt;.xml;.gldf;.gdtf" and handler.bl_import_operator == "gonio.hang_luminaire"

    class Area:
        type = "VIEW_3D"

    class Context:
        area, scene = Area, bpy.context.scene

    bpy.context.scene.render.engine = "GONIO"
    assert handler.poll_drop(Context)
    bpy.context.scene.render.engine = "CYCLES"
    assert not handler.poll_drop(Context)
    Context.area = None
    assert not handler.poll_drop(Context)
