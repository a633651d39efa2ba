"""What Blender makes of renders: stereoscopy, the compositor, the sequencer, linked files, frames with persistent data."""

from pathlib import Path

import pytest


def shining_bar():
    """A thin bright bar in front of a dark world, seen in perspective."""
    import bpy
    import scenes

    scene = scenes.empty(samples=16, width=64, height=16)
    bpy.ops.mesh.primitive_plane_add(size=1.0)
    bar = bpy.context.object
    bar.name, bar.scale = "Bar", (0.05, 1.0, 1.0)
    made = bpy.data.materials.new("Shining")
    made.use_nodes = True
    shader = made.node_tree.nodes.new("ShaderNodeEmission")
    output = next(node for node in made.node_tree.nodes if node.type == "OUTPUT_MATERIAL")
    made.node_tree.links.new(shader.outputs[0], output.inputs["Surface"])
    bar.data.materials.append(made)
    bpy.ops.object.camera_add(location=(0, 0, 2))
    scene.camera = bpy.context.object
    scene.camera.name = "Camera"
    return scene


def middle(path) -> float:
    """The column around which a picture is bright."""
    import bpy
    import numpy as np

    bpy.utils.expose_bundled_modules()
    import OpenImageIO

    row = OpenImageIO.ImageBuf(str(path)).get_pixels(OpenImageIO.FLOAT)[..., 0].sum(axis=0)
    return float((row * np.arange(len(row))).sum() / row.sum())


def save(scene, path):
    import bpy

    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(path)
    assert bpy.ops.render.render(write_still=True) == {"FINISHED"}


@pytest.mark.blender
@pytest.mark.parametrize(
    ("mode", "moves"), [("OFFAXIS", 0), ("PARALLEL", 0), ("TOE", 0), ("MULTIVIEW", 0), ("OFFAXIS", 1), ("MULTIVIEW", 1)]
)
def test_each_eye_sees_what_it_sees_in_cycles(mode, moves, tmp_path: Path):
    import bpy

    scene = shining_bar()
    scene.render.use_multiview = True
    scene.camera.data.stereo.interocular_distance, scene.camera.data.stereo.convergence_distance = 0.2, 4.0
    scene.camera.data.stereo.pivot = "CENTER"
    if mode == "MULTIVIEW":
        scene.render.views_format = "MULTIVIEW"
        scene.camera.name = "Camera_L"
        bpy.ops.object.camera_add(location=(0.3, 0, 2))
        bpy.context.object.name = "Camera_R"
    else:
        scene.camera.data.stereo.convergence_mode = mode
    if moves:
        scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0
        for camera in (thing for thing in scene.objects if thing.type == "CAMERA"):
            for frame, by in ((0, -0.1), (2, 0.1)):
                camera.delta_location.y = by
                camera.keyframe_insert("delta_location", frame=frame)
    scene.render.image_settings.views_format = "INDIVIDUAL"
    found = {}
    for engine in ("GONIO", "CYCLES") if hasattr(scene, "cycles") else ("GONIO",):
        scene.render.engine = engine
        if engine == "CYCLES":
            scene.cycles.samples, scene.cycles.use_denoising = 16, False
        save(scene, tmp_path / f"{engine}.exr")
        found[engine] = [middle(tmp_path / f"{engine}_{eye}.exr") for eye in "LR"]
    left, right = found["GONIO"]
    assert left > right + 1.0, found
    assert found.get("CYCLES", found["GONIO"]) == pytest.approx(found["GONIO"], abs=0.1), found


@pytest.mark.blender
def test_compositor_and_sequencer_show_what_was_rendered(tmp_path: Path):
    import importlib

    import bpy
    import numpy as np
    import scenes

    scene = scenes.lit_floor(samples=4, width=8, height=8)
    tree = importlib.import_module("gonio_extension.compat").compositor_tree(scene)
    target = importlib.import_module("gonio_extension.compat").compositor_output(tree)
    source = target.links[0].from_socket
    bright = tree.nodes.new("CompositorNodeExposure")
    tree.links.new(source, bright.inputs[0])
    bright.inputs["Exposure"].default_value = 1.0
    tree.links.new(bright.outputs[0], target)
    scene.render.use_compositing = True
    save(scene, tmp_path / "composited.exr")
    scene.render.use_compositing = False
    save(scene, tmp_path / "plain.exr")
    bpy.utils.expose_bundled_modules()
    import OpenImageIO

    read = lambda name: OpenImageIO.ImageBuf(str(tmp_path / name)).get_pixels(OpenImageIO.FLOAT)[..., 0].mean()  # noqa: E731
    plain = read("plain.exr")
    assert np.isclose(read("composited.exr"), 2.0 * plain, rtol=1e-3)
    # A scene strip of a scene that Gonio renders.
    edit = bpy.data.scenes.new("Edit")
    edit.render.resolution_x = edit.render.resolution_y = 8
    edit.render.resolution_percentage = 100
    editor = edit.sequence_editor_create()
    strips = editor.strips if hasattr(editor, "strips") else editor.sequences
    strips.new_scene("Floor", scene, 1, 1)
    edit.frame_start = edit.frame_end = 1
    edit.render.use_sequencer, edit.view_settings.view_transform = True, "Standard"
    bpy.context.window.scene = edit
    save(edit, tmp_path / "strip.exr")
    assert read("strip.exr") > 0.5 * plain


@pytest.mark.blender
def test_linked_objects_and_their_overrides_are_rendered(tmp_path: Path):
    import bpy
    import scenes

    scenes.lit_floor(samples=4, width=8, height=8)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "library.blend"))
    scene = scenes.empty(samples=4, width=8, height=8)
    with bpy.data.libraries.load(str(tmp_path / "library.blend"), link=True) as (there, here):
        here.objects = list(there.objects)
    for thing in here.objects:
        scene.collection.objects.link(thing)
        if thing.type == "CAMERA":
            scene.camera = thing
    scene.gonio.max_bounces = 0
    scenes.render(tmp_path / "linked.exr")
    linked = scenes.read(tmp_path / "linked.exr")["ViewLayer.Combined.R"].mean()
    assert linked == pytest.approx(scenes.expected_irradiance(100.0) / 3.14159265, rel=5e-3)
    lamp = next(thing for thing in scene.objects if thing.type == "LIGHT")
    own = lamp.override_create(remap_local_usages=True)
    own.location.z = 2.0
    scenes.render(tmp_path / "moved.exr")
    moved = scenes.read(tmp_path / "moved.exr")["ViewLayer.Combined.R"].mean()
    assert moved == pytest.approx(linked / 4.0, rel=5e-3)


@pytest.mark.blender
def test_frames_with_persistent_data_are_those_without(tmp_path: Path):
    import bpy
    import numpy as np
    import scenes

    found = {}
    for persistent in (False, True):
        scene = scenes.lit_floor(samples=4, width=8, height=8)
        lamp = bpy.data.objects["Lamp"]
        for frame, height in ((1, 1.0), (2, 2.0)):
            lamp.location.z = height
            lamp.keyframe_insert("location", frame=frame)
        scene.frame_start, scene.frame_end = 1, 2
        scene.render.use_persistent_data = persistent
        scenes.render(tmp_path / f"{persistent}####.exr", animation=True)
        found[persistent] = [scenes.read(tmp_path / f"{persistent}{frame:04d}.exr")["ViewLayer.Combined.R"] for frame in (1, 2)]
    assert np.array_equal(found[False], found[True])
    assert found[True][1].mean() == pytest.approx(found[True][0].mean() / 4.0, rel=5e-3)
