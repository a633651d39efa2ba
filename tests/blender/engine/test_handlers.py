"""What handlers change between the frames of an animation."""

import pytest


def animation(tmp_path, change, frames, *, persistent, at="frame_change_pre"):
    """The channels of each frame's file, with a handler that changes the scene."""
    import bpy
    import scenes

    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, frames
    scene.render.use_persistent_data = persistent

    def handler(changed, *_):
        change(changed, changed.frame_current)

    getattr(bpy.app.handlers, at).append(handler)
    try:
        scenes.render(tmp_path / "frame_", animation=True)
    finally:
        getattr(bpy.app.handlers, at).remove(handler)
    return [scenes.read(tmp_path / f"frame_{number:04}.exr") for number in range(1, frames + 1)]


def window(**size):
    """A plane before the camera that shines by where it is in the picture."""
    import bpy
    import scenes

    scene = scenes.empty(samples=1, **size)
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    made = bpy.data.materials.new("Window")
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    place, light, end = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("TexCoord", "Emission", "OutputMaterial"))
    tree.links.new(place.outputs["Window"], light.inputs["Color"])
    tree.links.new(light.outputs[0], end.inputs["Surface"])
    bpy.context.object.data.materials.append(made)
    bpy.ops.object.camera_add(location=(0, 0, 5))
    scene.camera = bpy.context.object
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 4.0
    scene.gonio.pixel_filter_type = "BOX"
    return scene


def combined(channels):
    """The red and green of the Combined pass."""
    import numpy as np

    name = next(each for each in channels if each.endswith("Combined.R"))[:-1]
    return np.stack([channels[name + "R"], channels[name + "G"]], axis=-1)


def places(width, height):
    """What a window shows."""
    import numpy as np

    x, y = (np.arange(width) + 0.5) / width, 1.0 - (np.arange(height) + 0.5) / height
    return np.stack(np.meshgrid(x, y), axis=-1)


@pytest.mark.blender
def test_borders_and_sizes_that_handlers_change(tmp_path):
    import bpy
    import numpy as np
    from recorder import module

    def on_and_off(scene, frame):
        scene.render.use_border = frame == 2
        scene.render.border_min_x, scene.render.border_max_x = 0.25, 0.75

    def moved(scene, frame):
        scene.render.use_border = True
        scene.render.border_min_x, scene.render.border_max_x = 0.125 * frame, 0.125 * frame + 0.5

    def sized(scene, frame):
        scene.render.resolution_x, scene.render.resolution_percentage, scene.render.pixel_aspect_x = 16 * frame, 100 // frame, frame

    whole = places(32, 16)
    for persistent in (False, True):
        for at in ("frame_change_pre", "render_pre"):
            window(width=32, height=16)
            # Blender's own rule: borders lie where they lay at the start, and are on where they were on before the frame's handler.
            bpy.context.scene.render.border_min_x, bpy.context.scene.render.border_max_x = 0.25, 0.75
            shown = [combined(frame) for frame in animation(tmp_path, on_and_off, 3, persistent=persistent, at=at)]
            for frame, found in enumerate(shown, 1):
                expected = whole if frame < 3 else whole[:, 8:24]
                assert found.shape == expected.shape and np.allclose(found, expected, atol=0.04), (persistent, at, frame)
            lines = [line for line in module("report").latest().diagnostics if line.message.startswith("Resolution, border")]
            assert [line.severity for line in lines] == ["INFO"]
        for change in (moved, sized):
            scene = window(width=32, height=16)
            scene.render.border_min_x, scene.render.border_max_x, scene.render.use_border = 0.125, 0.625, change is moved
            for frame, channels in enumerate(animation(tmp_path, change, 3, persistent=persistent), 1):
                found, expected = combined(channels), whole
                if change is moved:
                    found, expected = found[:, 4:20], whole[:, 4:20]
                assert np.allclose(found, expected, atol=0.04), (persistent, change.__name__, frame, found.shape)


@pytest.mark.blender
def test_all_else_that_handlers_change(tmp_path):
    import bpy
    import numpy as np

    for persistent in (False, True):
        scene = window(width=16, height=8)
        other = bpy.data.objects.new("Other", bpy.data.cameras.new("Other"))
        scene.collection.objects.link(other)
        other.location, other.data.type, other.data.ortho_scale = (100.0, 0.0, 5.0), "ORTHO", 4.0
        first, layer = scene.camera, scene.view_layers[0]
        scene.view_layers.new("Second").use = False

        def change(scene, frame, first=first, other=other):
            layer, second = scene.view_layers[0], scene.view_layers["Second"]
            scene.camera = other if frame == 2 else first
            scene.render.film_transparent = frame == 2
            scene.gonio.samples = frame
            scene.gonio.film_exposure = float(frame)
            layer.use_pass_z = frame != 1
            layer.use_pass_cryptomatte_object = frame == 3
            layer.gonio.use_pass_luminance = frame == 3
            # Blender looks before the handlers which layers are used.
            second.use = frame == 2
            scene.render.use_simplify, scene.render.simplify_subdivision_render = frame == 3, 0

        frames = animation(tmp_path, change, 3, persistent=persistent)
        name = layer.name
        whole = places(16, 8)
        for frame, channels in enumerate(frames, 1):
            found = np.stack([channels[f"{name}.Combined.{each}"] for each in "RGA"], axis=-1)
            if frame == 2:
                # Nothing is before the other camera.
                assert not found.any(), persistent
            else:
                assert np.allclose(found[..., :2], frame * whole, atol=0.1) and (found[..., 2] == 1.0).all(), (persistent, frame)
            assert any("Depth" in each for each in channels) == (frame != 1)
            assert any("CryptoObject" in each for each in channels) == (frame == 3)
            assert any("Luminance" in each for each in channels) == (frame == 3)
            assert any(each.startswith("Second.Combined") for each in channels) == (frame == 3)
        depth = next(frames[2][each] for each in frames[2] if each.startswith(f"{name}.Depth"))
        assert np.allclose(depth, 5.0)
