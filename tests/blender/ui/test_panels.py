"""What panels show, what presets set, and what operators that cannot run say."""

from fnmatch import fnmatch

import pytest

# Settings that Cycles' panels show and Gonio does not follow, or has a way of its own for.
OTHERS = (
    *("CyclesRenderSettings.*denois*", "CyclesRenderSettings.*guiding*", "CyclesRenderSettings.*volume*", "CyclesRenderSettings.ao_*"),
    *("CyclesRenderSettings.*cull*", "CyclesRenderSettings.*scrambling*", "CyclesRenderSettings.debug_*", "CyclesRenderSettings.texture_limit*"),
    *("CyclesRenderSettings.*min_*", "CyclesRenderSettings.*light_*", "CyclesRenderSettings.use_fast_gi", "CyclesRenderSettings.fast_gi_method"),
    *("CyclesRenderSettings.tile_size", "CyclesRenderSettings.use_auto_tile", "CyclesRenderSettings.sampling_pattern", "CyclesRenderSettings.blur_glossy"),
    *("CyclesRenderSettings.dicing_camera", "CyclesRenderSettings.offscreen_dicing_scale", "CyclesRenderSettings.device"),
    *("CyclesRenderSettings.shading_system", "CyclesRenderSettings.use_layer_samples", "CyclesRenderSettings.feature_set"),
    # Shown under other names.
    *("CyclesRenderSettings.film_transparent_*", "CyclesRenderSettings.sample_clamp_*"),
    *("CyclesObjectSettings.*cull", "CyclesObjectSettings.is_caustics_*", "CyclesObjectSettings.ao_distance"),
    *("CyclesLightSettings.*", "CyclesWorldSettings.*", "CyclesMaterialSettings.*", "CyclesCurveRenderSettings.subdivisions"),
    *("CyclesRenderLayerSettings.use_pass_volume_*", "CyclesVisibilitySettings.scatter", "Object.visible_volume_scatter"),
    *("Object.shadow_terminator_shading_offset", "WorldLighting.ao_factor", "*.*gpencil*", "SceneGpencil.*", "*.*grease_pencil*"),
    *("RenderSettings.hair_*", "RenderSettings.line_thickness*", "RenderSettings.use_freestyle", "RenderSettings.simplify_volumes"),
    # Of EEVEE, whose panel Cycles shows too.
    *("Material.*culling*", "Material.use_raytrace_refraction", "Material.surface_render_method", "Material.volume_intersection_method"),
    *("Material.*thickness*", "Material.max_vertex_displacement"),
    *("RenderSettings.use_simplify_normals", "ViewLayer.pass_alpha_threshold", "ViewLayer.use_freestyle"),
)


@pytest.mark.blender
def test_what_cycles_shows_and_gonio_follows_can_be_reached():
    import unittest

    import bpy
    from drawing import drawn_by

    if not hasattr(bpy.context.scene, "cycles"):
        raise unittest.SkipTest("Cycles is not there")
    for kind in ("SUN", "SPOT", "AREA"):
        bpy.context.collection.objects.link(bpy.data.objects.new(kind, bpy.data.lights.new(kind, kind)))
    cycles, gonio = drawn_by("CYCLES"), drawn_by("GONIO")
    assert len(cycles) > 300 and len(gonio) > 300
    names = {name for _, name in gonio}
    missing = {f"{owner}.{name}" for owner, name in cycles - gonio if name not in names}
    lost = {each for each in missing if not any(fnmatch(each, pattern) for pattern in OTHERS)}
    assert not lost, lost
    wanted = {
        *(("CyclesRenderSettings", name) for name in ("dicing_rate", "preview_dicing_rate", "max_subdivisions")),
        *(("CyclesVisibilitySettings", ray) for ray in ("camera", "diffuse", "glossy", "transmission")),
        *(("PointLight", "use_soft_falloff"), ("SpotLight", "use_soft_falloff"), ("Material", "use_transparent_shadow")),
        *(("World", "lightgroup"), ("WorldLighting", "distance"), ("Object", "shadow_terminator_geometry_offset")),
        *(("ViewLayer", "use_strand"), ("ViewLayer", "use_motion_blur"), ("ViewLayer", "use_volumes")),
    }
    assert wanted <= gonio, wanted - gonio


@pytest.mark.blender
def test_volume_objects_have_their_panels():
    import bpy
    from drawing import drawn_by

    thing = bpy.data.objects.new("Cloud", bpy.data.volumes.new("Cloud"))
    bpy.context.scene.collection.objects.link(thing)
    bpy.context.view_layer.objects.active = thing
    for name in ("DATA_PT_context_volume", "DATA_PT_volume_file", "DATA_PT_volume_grids"):
        assert "GONIO" in getattr(bpy.types, name).COMPAT_ENGINES
    assert drawn_by("GONIO", [bpy.types.GONIO_DATA_PT_volume_render]) == {("VolumeRender", "space")}


@pytest.mark.blender
def test_adaptive_subdivision_can_be_reached():
    import bpy
    from drawing import drawn_by

    cube = bpy.context.scene.objects["Cube"]
    panel = bpy.types.GONIO_OBJECT_PT_adaptive_subdivision
    assert not drawn_by("GONIO", [panel])
    made = cube.modifiers.new("Subdivision", "SUBSURF")
    if bpy.app.version < (5, 0, 0):
        assert drawn_by("GONIO", [panel]) == {("CyclesObjectSettings", "use_adaptive_subdivision"), ("CyclesObjectSettings", "dicing_rate")}
        return
    shared = {("SubsurfModifier", "use_adaptive_subdivision"), ("SubsurfModifier", "adaptive_space")}
    assert drawn_by("GONIO", [panel]) == shared | {("SubsurfModifier", "adaptive_pixel_size")}
    made.adaptive_space = "OBJECT"
    assert drawn_by("GONIO", [panel]) == shared | {("SubsurfModifier", "adaptive_object_edge_length")}
    # Another one behind it takes the place of the last.
    cube.modifiers.new("Behind", "BEVEL")
    assert not drawn_by("GONIO", [panel])


@pytest.mark.blender
def test_presets():
    import os

    import bpy

    scene = bpy.context.scene
    scene.render.engine = "GONIO"

    def names(folder):
        return {name for path in bpy.utils.preset_paths(f"gonio/{folder}") for name in os.listdir(path) if name.endswith(".py")}

    def run(panel, name):
        folder = getattr(bpy.types, panel).preset_subdir
        path = next(f"{each}/{name}.py" for each in bpy.utils.preset_paths(folder) if os.path.exists(f"{each}/{name}.py"))
        bpy.ops.script.execute_preset(filepath=path, menu_idname=panel)

    assert names("sampling") == names("viewport_sampling") == {"Final.py", "Preview.py"} and len(names("light_paths")) == 4
    run("GONIO_PT_sampling_presets", "Preview")
    assert scene.gonio.samples == 1024 and scene.gonio.adaptive_threshold == pytest.approx(0.1) and scene.gonio.use_denoising
    run("GONIO_PT_viewport_sampling_presets", "Final")
    assert scene.gonio.preview_samples == 4096 and scene.gonio.use_preview_denoising
    run("GONIO_PT_light_paths_presets", "Full_Global_Illumination")
    assert scene.gonio.max_bounces == scene.gonio.transparent_max_bounces == 32
    run("GONIO_PT_performance_presets", "Faster_Render")
    assert scene.render.use_persistent_data
    # One of the user's is added, used and taken away.
    scene.gonio.max_bounces = 5
    assert bpy.ops.gonio.light_paths_preset_add(name="Five") == {"FINISHED"}
    scene.gonio.max_bounces = 7
    run("GONIO_PT_light_paths_presets", "five" if "five.py" in names("light_paths") else "Five")
    assert scene.gonio.max_bounces == 5
    bpy.types.GONIO_PT_light_paths_presets.bl_label = "Five"
    assert bpy.ops.gonio.light_paths_preset_add(name="Five", remove_active=True) == {"FINISHED"} and len(names("light_paths")) == 4
    bpy.types.GONIO_PT_light_paths_presets.bl_label = "Light Paths Presets"


@pytest.mark.blender
def test_operators_that_cannot_run_say_why():
    import importlib

    import bpy

    asked = [kind for kind in importlib.import_module("gonio_extension.operators").CLASSES if "poll" in kind.__dict__]
    assert len(asked) >= 8
    for kind in asked:
        words = []
        kind.poll_message_set = classmethod(lambda cls, text, words=words: words.append(text))
        try:
            scene = bpy.context.scene
            scene.render.engine = "CYCLES"
            fine = kind.poll(bpy.context)
        finally:
            del kind.poll_message_set
        assert fine != bool(words), kind
    kinds = {kind.__name__ for kind in asked}
    assert {"GONIO_OT_measure_grids", "GONIO_OT_expose_for_daylight", "GONIO_OT_bake_illuminance"} <= kinds


@pytest.mark.blender
def test_operators_say_what_the_scene_lacks():
    """With Gonio as the engine, in a file without anything to work on; the panels that they name are there."""
    import importlib

    import bpy

    operators = {kind.__name__: kind for kind in importlib.import_module("gonio_extension.operators").CLASSES}
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "GONIO"
    scene.world = scene.world or bpy.data.worlds.new("World")

    def said(name):
        kind, words = operators[f"GONIO_OT_{name}"], []
        kind.poll_message_set = classmethod(lambda cls, text: words.append(text))
        try:
            return kind.poll(bpy.context), words
        finally:
            del kind.poll_message_set

    panels = {getattr(kind, "bl_label", "") for kind in bpy.types.Panel.__subclasses__()}
    for name in ("measure_grids", "annual_daylight", "dim_lights"):
        could, (words,) = said(name)
        assert not could and words.startswith("No object of the scene is a grid") and words.rsplit(", ", 1)[1] in panels, words
    for name, words in (
        ("bake_illuminance", "No mesh is active in Object Mode"),
        ("expose_for_daylight", "The world's Daylight is off"),
        ("point_meter", "The mouse is not over a 3D viewport"),
        ("render_by_wavelength", "The scene has no camera"),
    ):
        assert said(name) == (False, [words])
    scene.world.gonio.use_daylight, scene.gonio.tone_map = True, "PHOTOGRAPHIC"
    assert said("expose_for_daylight") == (False, ["Tone mapping sees to the exposure"])
    bpy.ops.mesh.primitive_plane_add()
    bpy.context.object.data.materials.append(bpy.data.materials.new("Plain"))
    bpy.context.object.gonio.is_grid = True
    scene.gonio.tone_map = "NONE"
    assert all(said(name) == (True, []) for name in ("measure_grids", "annual_daylight", "bake_illuminance", "expose_for_daylight", "illumination_map"))
    could, (words,) = said("dim_lights")
    assert not could and words.startswith("No light of the scene is in a light group") and words.rsplit(", ", 1)[1] in panels, words
    lamp = bpy.data.objects.new("Lamp", bpy.data.lights.new("Lamp", "POINT"))
    scene.collection.objects.link(lamp)
    lamp.lightgroup = "Key"
    assert said("dim_lights") == (True, [])
    bpy.ops.object.mode_set(mode="EDIT")
    assert said("illumination_map") == (False, ["Meshes take attributes in Object Mode alone"])
