"""What leaves a line in the report, how lines are counted, and which panels show."""

import pytest


@pytest.mark.blender
def test_settings_and_passes_that_are_not_followed_leave_a_line(tmp_path):
    import bpy
    import scenes
    from recorder import module

    scene = scenes.lit_floor(width=8, height=8, samples=1)
    layer = bpy.context.view_layer
    scenes.render(tmp_path / "quiet.exr")
    latest = module("report").latest
    assert not latest().diagnostics, [line.text for line in latest().diagnostics]
    scene.render.use_motion_blur = True
    layer.use_pass_vector = layer.use_pass_shadow = True
    layer.use_pass_normal = layer.use_pass_cryptomatte_object = layer.use_pass_ambient_occlusion = True
    # Nothing moves, so the Vector pass misses nothing.
    wanted = {"Pass Shadow"}
    if hasattr(scene, "cycles"):
        scene.cycles.use_fast_gi = True
        wanted.add("Fast GI Approximation")
    scenes.render(tmp_path / "told.exr")
    told = {line.message.split(":")[0] for line in latest().diagnostics}
    assert told == wanted, told


@pytest.mark.blender
def test_equal_messages_are_counted(tmp_path):
    from recorder import module

    report = module("report").Report()
    for name in ("A", "B", "C"):
        report.tell("volume", "Material", name)
    report.add("Object", "D", "dark", severity="ERROR")
    assert [(line.text, line.count) for line in report.counted] == [
        ("D: dark", 1),
        ("A and 2 more: Volume shaders of meshes that are no volume's: not supported; the inside stays empty; without a surface, rays pass", 3),
    ]
    assert report.summary() == "D: dark, and 1 more in the Gonio Report panel"
    report.forget("Material", "A")
    assert report.counted[1].text.startswith("B and 1 more: ")


@pytest.mark.blender
def test_no_panel_is_offered_in_vain(tmp_path):
    import bpy

    words = ("freestyle", "gpencil")
    for panel in bpy.types.Panel.__subclasses__():
        if "GONIO" in getattr(panel, "COMPAT_ENGINES", ()):
            assert not any(word in panel.__name__ for word in words), panel.__name__


@pytest.mark.blender
def test_what_is_gone_is_told_no_more(tmp_path):
    import bpy
    from recorder import depsgraph, empty, exporter, link, material, quad

    empty()
    scene = bpy.context.scene
    made, tree, end = material("Fog")
    tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], end.inputs["Volume"])
    thing = link(bpy.data.objects.new("Box", quad()))
    thing.data.materials.append(made)
    lamp = bpy.data.lights.new("Lamp", "SUN")
    lamp.use_nodes = True
    lamp.node_tree.nodes.clear()
    falloff, output = (lamp.node_tree.nodes.new(f"ShaderNode{name}") for name in ("LightFalloff", "OutputLight"))
    lamp.node_tree.links.new(falloff.outputs["Constant"], output.inputs[0])
    link(bpy.data.objects.new("Lamp", lamp))
    scene.render.use_freestyle = True
    exported, report = exporter()
    exported.sync(depsgraph())

    def told():
        return {line.message.partition(":")[0] for line in report.diagnostics}

    assert told() == {"Volume", "Light Falloff", "Freestyle lines"}
    bpy.app.handlers.depsgraph_update_post.append(lambda _, graph: exported.update(graph))
    thing.data.materials[0] = bpy.data.materials.new("Plain")
    bpy.context.view_layer.update()
    assert told() == {"Light Falloff", "Freestyle lines"}
    bpy.data.objects.remove(bpy.data.objects["Lamp"])
    scene.render.use_freestyle = False
    scene.update_tag()
    bpy.context.view_layer.update()
    bpy.app.handlers.depsgraph_update_post.clear()
    assert not told()


# Cycles' settings that need no line: of noise and speed alone, or of what has a line of its own.
NEED_NO_LINE = {
    "scene": (
        *(
            "rna_type",
            "name",
            "device",
            "feature_set",
            "shading_system",
            "preview_pause",
            "debug_*",
            "use_auto_tile",
            "tile_size",
            "bake_type",
        ),
        *("denoiser", "denoising_*", "preview_denois*", "sampling_pattern", "*scrambling_distance", "use_layer_samples"),
        *("light_sampling_threshold", "direct_light_sampling_type", "use_light_tree", "min_*_bounces", "*guiding*", "texture_limit*"),
        *("sample_offset", "sample_subset_length", "volume_*", "*dicing*", "max_subdivisions", "film_transparent_roughness"),
        *("*_cull_margin", "rolling_shutter_*", "fast_gi_method", "ao_bounces*"),
    ),
    "layer": ("rna_type", "name", "use_denoising", "use_pass_*", "pass_render_time"),
    "object": ("rna_type", "name", "*motion*", "*_cull", "ao_distance", "dicing_rate", "use_adaptive_subdivision", "shadow_terminator_*"),
    "light": ("rna_type", "name", "use_multiple_importance_sampling"),
    "world": ("rna_type", "name", "sampling_method", "sample_map_resolution", "volume_*", "homogeneous_volume"),
    "material": ("rna_type", "name", "emission_sampling", "volume_*", "homogeneous_volume"),
}


@pytest.mark.blender
def test_every_setting_of_cycles_is_followed_or_leaves_a_line(tmp_path):
    import unittest
    from fnmatch import fnmatch

    import bpy
    from recorder import module

    scene = bpy.context.scene
    if not hasattr(scene, "cycles"):
        raise unittest.SkipTest("this bpy has no Cycles")
    limits, taken = module("export.limits"), module("operators.from_cycles")
    owners = {
        "scene": (scene, taken.SCENE, limits.SCENE),
        "layer": (bpy.context.view_layer, taken.VIEW_LAYER, limits.LAYER),
        "object": (bpy.data.objects["Cube"], {}, limits.OBJECT),
        "light": (bpy.data.lights[0], taken.LIGHT, limits.LIGHT),
        "world": (bpy.data.worlds[0], {}, limits.WORLD),
        "material": (bpy.data.materials[0], {}, limits.MATERIAL),
    }
    for kind, (owner, followed, told) in owners.items():
        lines = {path.rpartition("cycles.")[2] for _, path, *_ in told}
        for name in owner.cycles.bl_rna.properties.keys():  # noqa: SIM118
            known = name in followed.values() or name in lines or any(fnmatch(name, pattern) for pattern in NEED_NO_LINE[kind])
            assert known, f"{kind}: nothing says that {name} is not followed"
