"""What the extension adds to Blender, and takes away again."""

import importlib
import sys

import pytest

PACKAGE = "gonio_extension"


def part(name):
    """A module of the extension."""
    return importlib.import_module(f"{PACKAGE}.{name}")


@pytest.mark.blender
def test_registers_again_after_unregistering():
    import bpy

    extension = sys.modules[PACKAGE]
    for _ in range(3):
        extension.unregister()
        assert not hasattr(bpy.types.Scene, "gonio")
        assert not hasattr(bpy.types, "GONIO_RENDER_PT_sampling")
        assert not [panel for panel in bpy.types.Panel.__subclasses__() if panel.__module__.startswith("bl_ui") and _has_engine(panel)]
        extension.register()
    bpy.context.scene.render.engine = "GONIO"
    assert bpy.context.scene.gonio.samples == 1024
    assert _has_engine(bpy.types.GONIO_RENDER_PT_sampling)


def _has_engine(panel):
    return "GONIO" in getattr(panel, "COMPAT_ENGINES", ())


@pytest.mark.blender
def test_nothing_stays_registered_after_a_failure():
    import bpy

    extension = sys.modules[PACKAGE]
    extension.unregister()
    ui = part("ui")
    register = ui.register
    ui.register = lambda: 1 / 0
    try:
        with pytest_raises(ZeroDivisionError):
            extension.register()
        assert not hasattr(bpy.types.Scene, "gonio")
        assert not part("engine.render_engine").GonioRenderEngine.is_registered
    finally:
        ui.register = register
        extension.register()


def pytest_raises(kind):
    """`pytest.raises` without pytest, which a Python with bpy may lack."""
    import unittest

    return unittest.TestCase().assertRaises(kind)


@pytest.mark.blender
def test_settings_have_words_units_and_fixed_numbers():
    import bpy

    settings = bpy.context.scene.gonio
    for owner in (settings, bpy.context.view_layer.gonio, bpy.data.lights[0].gonio):
        for name, described in owner.bl_rna.properties.items():
            if name not in ("rna_type", "name"):
                assert described.name and len(described.description) > 10, name
                assert not described.description.endswith("."), name
    numbers = {item.identifier: item.value for item in settings.bl_rna.properties["pixel_filter_type"].enum_items}
    assert numbers == {"BOX": 0, "GAUSSIAN": 1, "BLACKMAN_HARRIS": 2, "TENT": 3}
    assert settings.bl_rna.properties["time_limit"].unit == "TIME_ABSOLUTE"
    assert settings.bl_rna.properties["filter_width"].subtype == "PIXEL"


@pytest.mark.blender
def test_blenders_own_panels_show():
    import bpy

    for name in (
        "RENDER_PT_format",
        "RENDER_PT_color_management",
        "DATA_PT_lens",
        "DATA_PT_camera_dof",
        "EEVEE_MATERIAL_PT_context_material",
        "OBJECT_PT_shading",
        "PARTICLE_PT_hair_shape",
    ):
        assert _has_engine(getattr(bpy.types, name)), name
    for name in ("DATA_PT_light", "RENDER_PT_simplify", "RENDER_PT_freestyle", "VIEWLAYER_PT_layer_passes"):
        assert not _has_engine(getattr(bpy.types, name, None)), name


class _Layout:
    """A layout that only looks whether the settings that it is to show exist."""

    def __init__(self):
        self.shown = []

    def prop(self, owner, name, **_):
        assert name in owner.bl_rna.properties, name
        self.shown.append(name)

    def template_curve_mapping(self, owner, name):
        self.prop(owner, name)

    def row(self, **_):
        return self

    def operator(self, *_, **__):
        return self


@pytest.mark.blender
def test_panels_of_motion_and_hair_show_what_there_is():
    import unittest
    from types import SimpleNamespace

    import bpy

    bpy.context.scene.render.engine = "GONIO"
    if not hasattr(bpy.context.scene, "cycles"):
        raise unittest.SkipTest("this bpy has no Cycles")
    layout = _Layout()
    for panel in (*part("ui.motion_blur").PANELS, *part("ui.curves").PANELS):
        assert panel.poll(bpy.context), panel.__name__
        drawn = SimpleNamespace(layout=layout, draw_settings=getattr(panel, "draw_settings", None))
        if drawn.draw_settings is not None:
            drawn.draw_settings = drawn.draw_settings.__get__(drawn)
        if hasattr(panel, "draw_header"):
            panel.draw_header(drawn, bpy.context)
        panel.draw(drawn, bpy.context)
    blurred = {"use_motion_blur", "motion_blur_position", "motion_blur_shutter", "motion_blur_shutter_curve", "rolling_shutter_type"}
    assert blurred | {"motion_steps", "use_deform_motion", "shape"} <= set(layout.shown)


@pytest.mark.blender
def test_takes_settings_from_cycles():
    import unittest

    import bpy

    scene = bpy.context.scene
    if not hasattr(scene, "cycles"):
        raise unittest.SkipTest("this bpy has no Cycles")
    scene.cycles.samples = 77
    scene.cycles.sample_clamp_indirect = 3.5
    scene.cycles.pixel_filter_type = "GAUSSIAN"
    scene.cycles.time_limit = 12.0
    bpy.context.view_layer.cycles.denoising_store_passes = True
    bpy.ops.object.light_add(type="AREA")
    bpy.context.object.data.cycles.is_portal = True
    assert bpy.ops.gonio.settings_from_cycles() == {"FINISHED"}
    taken = scene.gonio
    assert (taken.samples, taken.clamp_indirect, taken.pixel_filter_type, taken.time_limit) == (77, 3.5, "GAUSSIAN", 12.0)
    assert bpy.context.view_layer.gonio.denoising_store_passes
    assert bpy.context.object.data.gonio.is_portal
    # All of Cycles' values fit.
    names = part("operators.from_cycles").SCENE
    assert all(getattr(taken, name) == getattr(scene.cycles, source) for name, source in names.items())


@pytest.mark.blender
def test_denoising_is_a_switch():
    import bpy

    scene = bpy.context.scene
    scene.render.engine = "GONIO"
    assert not scene.gonio.use_denoising
    for _ in range(2):
        scene.gonio.use_denoising = True
        assert scene.gonio.use_denoising
    tree = part("compat").compositor_tree(scene)
    denoise = [node for node in tree.nodes if node.bl_idname == "CompositorNodeDenoise"]
    assert len(denoise) == 1
    linked = {socket.name: socket.links[0].from_socket.name for socket in denoise[0].inputs if socket.is_linked}
    assert linked == {"Image": "Image", "Normal": "Denoising Normal", "Albedo": "Denoising Albedo"}
    before = part("compat").compositor_output(tree).links[0].from_node
    while before.bl_idname == "NodeReroute":
        before = before.inputs[0].links[0].from_node
    assert before == denoise[0]
    # Off and on again it is the same node; a compositor that is off denoises nothing.
    scene.gonio.use_denoising = False
    assert not scene.gonio.use_denoising and denoise[0].mute
    scene.gonio.use_denoising = True
    assert scene.gonio.use_denoising and not denoise[0].mute
    scene.render.use_compositing = False
    assert not scene.gonio.use_denoising
    fresh = bpy.data.scenes.new("Fresh")
    fresh.gonio.use_denoising = False
    assert not fresh.gonio.use_denoising and part("compat").existing_compositor_tree(fresh) is None


@pytest.mark.blender
def test_report_lines_are_whole_in_narrow_panels():
    wrapped = part("ui.report").wrapped
    text = "Wood > Noise Texture: not supported; the value 0.5 is used"
    lines = wrapped(text, 20, len)
    assert " ".join(lines) == text and all(len(line) <= 20 for line in lines) and len(lines) == 4
    path = "C:/a/long/path/without/any/space.png"
    assert "".join(wrapped(path, 10, len)) == path and max(map(len, wrapped(path, 10, len))) == 10
    assert wrapped("short", 100, len) == ["short"] and wrapped("", 10, len) == [""]
    # However narrow, it comes to an end.
    assert "".join(wrapped("abc", 0, len)) == "abc"


@pytest.mark.blender
def test_report_jumps_to_a_node():
    import bpy

    report = part("report")
    cube = bpy.data.objects["Cube"]
    tree = cube.active_material.node_tree
    noise = tree.nodes.new("ShaderNodeTexNoise")
    told = report.Report()
    told.add("Material", cube.active_material.name, "Noise Texture is not known", material=cube.active_material.name, node=noise.name)
    told.add("Object", "Light", "dark", severity="ERROR")
    told.add("Object", "Light", "dark", severity="ERROR")
    report.publish(told)
    assert [line.severity for line in told.diagnostics] == ["ERROR", "WARNING"]
    assert told.summary() == "Light: dark, and 1 more in the Gonio Report panel"
    assert bpy.ops.gonio.report_jump(index=1) == {"FINISHED"}
    assert bpy.context.view_layer.objects.active == cube
    assert tree.nodes.active == noise
    assert bpy.ops.gonio.report_jump(index=0) == {"FINISHED"}
    assert bpy.context.view_layer.objects.active.name == "Light"
    told.forget("Object", "Light")
    assert len(told.diagnostics) == 1
    bpy.data.materials.remove(cube.active_material)
    assert bpy.ops.gonio.report_jump(index=0) == {"CANCELLED"}
    assert bpy.ops.gonio.report_jump(index=9) == {"CANCELLED"}
