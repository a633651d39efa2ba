"""Frames with Persistent Data: each is the picture that it is without, in any order and after edits; a thousand leave the memory as it was."""

from pathlib import Path

import pytest

FRAMES = 4


def animated(size: int = 48):
    """Something of each kind that moves or changes, beside a floor that does not."""
    import bpy
    import scenes

    scene = scenes.lit_floor(samples=2, width=size, height=size)
    scene.camera.data.ortho_scale = 4.0
    scene.gonio.max_bounces = 2
    lamp, camera = bpy.data.objects["Lamp"], scene.camera
    bpy.ops.mesh.primitive_cube_add(size=0.4, location=(-0.6, 0, 0.3))
    mover = bpy.context.object
    mover.data.materials.append(scenes.diffuse("Changing", (0.8, 0.2, 0.1)))
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=6, y_subdivisions=6, size=1.0, location=(0.8, 0.4, 0.1))
    bender = bpy.context.object
    bender.name = "Bender"
    bender.shape_key_add(name="Flat")
    key = bender.shape_key_add(name="Bent")
    for number, point in enumerate(key.data):
        point.co.z += 0.05 * (number % 7)
    colour = mover.data.materials[0].node_tree.nodes["Diffuse BSDF"].inputs["Color"]
    strength = scene.world.node_tree.nodes["Background"].inputs["Color"]
    for frame in (1, FRAMES):
        share = frame / FRAMES
        mover.location.y, key.value, lamp.data.energy, camera.location.x = share, share, 50.0 + 100.0 * share, 0.3 * share
        colour.default_value, strength.default_value = (share, 0.2, 1.0 - share, 1.0), (0.1 * share, 0.1, 0.1, 1.0)
        for thing, path in ((mover, "location"), (key, "value"), (lamp.data, "energy"), (camera, "location")):
            thing.keyframe_insert(path, frame=frame)
        for socket in (colour, strength):
            socket.keyframe_insert("default_value", frame=frame)
    scene.frame_start, scene.frame_end = 1, FRAMES
    return scene


def edit(number: int):
    """Changes that no keyframe tells of, between two frames."""
    import bpy

    if number == 1:
        bpy.data.objects["Bender"].data.shape_keys.key_blocks["Bent"].data[0].co.z += 0.5
    if number == 2:
        bpy.ops.mesh.primitive_cube_add(size=0.3, location=(0, -1, 0.2))
        bpy.data.objects["Floor"].data.vertices[0].co.z = 0.4
    if number == 4:
        bpy.data.objects.remove(bpy.data.objects["Bender"])


@pytest.mark.blender
@pytest.mark.parametrize("blur", [False, True])
def test_frames_in_any_order_and_after_edits(tmp_path: Path, blur):
    import numpy
    import scenes

    found = {}
    for persistent in (False, True):
        scene = animated()
        scene.render.use_persistent_data, scene.render.use_motion_blur = persistent, blur
        found[persistent] = []
        for number, frame in enumerate((3, 1, 4, 2, 2)):
            edit(number)
            scene.frame_set(frame)
            path = tmp_path / f"{persistent}{number}.exr"
            scenes.render(path)
            found[persistent].append(scenes.read(path)["ViewLayer.Combined.R"])
    for kept, fresh in zip(found[True], found[False], strict=True):
        assert numpy.array_equal(kept, fresh)
    for before, after in zip(found[True][:-1], found[True][1:], strict=True):
        assert not numpy.array_equal(before, after)


@pytest.mark.validate
@pytest.mark.blender(seconds=3000)
def test_a_thousand_frames_leak_nothing(tmp_path: Path):
    import re

    import bpy
    import numpy
    from keys import curves_of

    scene = animated(size=8)
    scene.gonio.samples = 1
    scene.frame_end = 1000
    scene.render.use_persistent_data = True
    scene.render.image_settings.file_format = "PNG"
    scene.render.filepath = str(tmp_path / "####")
    # Repeats the motion, so that every frame has something new.
    for action in bpy.data.actions:
        for curve in curves_of(action):
            curve.modifiers.new("CYCLES")
    sizes = []

    def note(*_arguments):
        status = Path("/proc/self/status").read_text()
        sizes.append(int(re.search(r"VmRSS:\s+(\d+)", status).group(1)) * 1024)

    bpy.app.handlers.render_post.append(note)
    bpy.ops.render.render(animation=True)
    bpy.app.handlers.render_post.remove(note)
    assert len(sizes) == 1000
    print(f"frame 100: {sizes[99] / 1e6:.1f} MB, 500: {sizes[499] / 1e6:.1f} MB, 1000: {sizes[-1] / 1e6:.1f} MB")
    middle, last = numpy.median(sizes[100:200]), numpy.median(sizes[900:])
    assert last - middle < 8e6, (middle, last)
