"""Motion blur as Blender's settings ask for it, held to the mean of single moments."""

import importlib

import numpy as np
import pytest


def part(name):
    """A module of the extension."""
    return importlib.import_module(f"gonio_extension.{name}")


class Engine:
    """Moves the frame, as the render engine does."""

    def __init__(self, scene, depsgraph):
        self.scene, self.depsgraph = scene, depsgraph

    def frame_set(self, frame, subframe):
        self.scene.frame_set(frame, subframe=subframe)
        self.depsgraph.update()


def exported(scene):
    """The scene as a final render exports it, with its report."""
    import bpy

    depsgraph = bpy.context.evaluated_depsgraph_get()
    told = part("report").Report()
    exporter = part("export").Exporter(told)
    exporter.sync(depsgraph)
    exporter.blur(Engine(scene, depsgraph), depsgraph)
    exporter.settings(depsgraph, width=scene.render.resolution_x, height=scene.render.resolution_y)
    return exporter.scene, told


def picture(scene, seed=0):
    import gonio

    made, _ = exported(scene)
    made.set(samples=scene.gonio.samples, noise_threshold=0.0, seed=seed, filter="box", filter_width=1.0)
    with gonio.Render(made) as render:
        assert render.wait()
        return np.asarray(render.film()["color"])[..., :3].astype(float)


def animated(samples, lamp_moves=False):
    """A cube that turns and moves, a plane that a shape key bends and a camera that moves, over a floor; or a lamp that moves too."""
    import bpy
    import scenes

    scene = scenes.lit_floor(width=32, height=32, samples=samples)
    scene.gonio.max_bounces = 1
    lamp = bpy.data.objects["Lamp"]
    lamp.data.shadow_soft_size = 0.2
    bpy.ops.mesh.primitive_cube_add(size=0.6, location=(0, 0, 0.3))
    cube = bpy.context.object
    bpy.ops.mesh.primitive_plane_add(size=0.8, location=(0.8, -0.6, 0.3))
    plane = bpy.context.object
    plane.shape_key_add(name="Basis")
    bent = plane.shape_key_add(name="Bent")
    for point in (2, 3):
        bent.data[point].co.z += 0.4
        bent.data[point].co.y += 0.3
    camera = scene.camera
    camera.data.ortho_scale = 3.0

    def key(owner, path, values):
        for frame, value in zip((1, 3), values, strict=True):
            setattr(owner, path, value)
            owner.keyframe_insert(path, frame=frame)

    key(cube, "location", ((-1.0, 0.0, 0.3), (0.6, 0.3, 0.5)))
    key(cube, "rotation_euler", ((0.0, 0.0, 0.0), (0.0, 0.0, 1.5)))
    key(bent, "value", (0.0, 1.0))
    key(camera, "location", ((0.0, 0.0, 5.0), (0.2, 0.0, 5.0)))
    if lamp_moves:
        key(lamp, "location", ((0.0, 0.0, 2.0), (0.5, 0.0, 2.0)))
    scene.frame_set(2)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0
    return scene


@pytest.mark.blender
def test_blur_is_the_mean_of_moments():
    scene = animated(256)
    for thing in scene.objects:
        if hasattr(thing, "cycles"):
            thing.cycles.motion_steps = 3
    blurred = np.mean([picture(scene, seed) for seed in range(2)], axis=0)
    scene.render.use_motion_blur = False
    scene.gonio.samples = 16
    moments = []
    for moment in range(32):
        scene.frame_set(1, subframe=0.5 + (moment + 0.5) / 32) if moment < 16 else scene.frame_set(2, subframe=(moment + 0.5) / 32 - 0.5)
        moments.append(picture(scene, 100 + moment))
    mean = np.mean(moments, axis=0)
    scene.frame_set(2)
    still = picture(scene)

    def blocks(seen):
        return seen.reshape(8, 4, 8, 4, 3).mean(axis=(1, 3))

    off = np.abs(blocks(blurred) - blocks(mean)).max() / mean.mean()
    assert off < 0.06, off
    assert np.abs(blocks(still) - blocks(mean)).max() / mean.mean() > 0.2


@pytest.mark.blender
def test_positions_steps_and_switches_are_followed():
    import bpy

    scene = animated(4, lamp_moves=True)
    cube = bpy.data.objects["Cube"]

    def places():
        made, _ = exported(scene)
        described = made.to_dict()
        motion = next((one["motion"] for one in described["instances"] if one["origin"]["name"] == "Cube"), [])
        assert (len(described["lights"][0]["motion"]) == 3) == scene.render.use_motion_blur
        return [key[0]["columns"][3][0] for key in motion], described["settings"]["shutter"]

    found, shutter = places()
    assert len(found) == 3 and found[0] < found[1] < found[2]
    assert shutter["blur"] and shutter["curve"] == [] and shutter["row_exposure"] == 1.0
    middle = found[1]
    if hasattr(scene.render, "motion_blur_position"):
        scene.render.motion_blur_position = "START"
        assert places()[0][0] == pytest.approx(middle, abs=1e-5)
        scene.render.motion_blur_position = "END"
        assert places()[0][2] == pytest.approx(middle, abs=1e-5)
        scene.render.motion_blur_position = "CENTER"
    assert scene.frame_current == 2
    if hasattr(cube, "cycles"):
        cube.cycles.motion_steps = 2
        assert len(places()[0]) == 5
        cube.cycles.use_motion_blur = False
        assert places()[0] == []
    points = scene.render.motion_blur_shutter_curve.curves[0].points
    points[0].location = (0.0, 0.0)
    scene.render.motion_blur_shutter_curve.update()
    assert len(places()[1]["curve"]) > 2
    scene.render.use_motion_blur = False
    assert places()[0] == [] and not places()[1]["blur"]


def forms(scene, name):
    """The points of a mesh at the times of the shutter (K, N, 3), and the report's lines of the object."""
    made, told = exported(scene)
    described = made.to_dict()
    shown = next(one for one in described["instances"] if one["origin"]["name"] == name)
    keys = described["meshes"][shown["mesh"]]["motion"]
    points = [np.array(key["points"]).reshape(-1, 3) for key in keys]
    return np.array(points), [line for line in told.counted if name in str(line)]


@pytest.mark.blender
def test_velocities_say_where_points_go():
    import bpy
    import scenes

    scene = scenes.lit_floor(width=8, height=8, samples=1)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter, scene.render.fps = True, 0.5, 25
    floor = bpy.data.objects["Floor"]
    rest = np.array([point.co for point in floor.data.vertices])
    assert forms(scene, "Floor")[0].size == 0
    given = np.array([[25.0 * number, 0.0, 50.0] for number in range(4)], dtype=np.float32)
    floor.data.attributes.new("velocity", "FLOAT_VECTOR", "POINT").data.foreach_set("vector", given.ravel())
    # Four points and four corners: each corner is told as a point of its own.
    corners = [loop.vertex_index for loop in floor.data.loops]
    for position, (before, after) in {"CENTER": (-0.25, 0.25), "START": (0.0, 0.5), "END": (-0.5, 0.0)}.items():
        if hasattr(scene.render, "motion_blur_position"):
            scene.render.motion_blur_position = position
        elif position != "CENTER":
            break
        found, told = forms(scene, "Floor")
        assert found == pytest.approx(np.stack([(rest + share * given / 25.0)[corners] for share in (before, after)]), abs=1e-4)
        assert not told
    if hasattr(floor, "cycles"):
        floor.cycles.use_deform_motion = False
        assert forms(scene, "Floor")[0].size == 0


@pytest.mark.blender
def test_quads_may_be_cut_otherwise_as_they_bend():
    import bpy

    scene = animated(4)
    plane = bpy.data.objects["Plane"]
    # Drawn in past the middle, a corner has Blender cut the square along its other diagonal.
    keys = plane.data.shape_keys.key_blocks
    for point in range(4):
        keys["Bent"].data[point].co = keys["Basis"].data[point].co
    keys["Bent"].data[1].co = keys["Basis"].data[2].co * 0.6
    scene.render.motion_blur_shutter = 2.0
    found, told = forms(scene, "Plane")
    assert len(found) == 3 and not told, told
    assert np.abs(found[2] - found[0]).max() > 0.5


@pytest.mark.blender
def test_faces_that_change_are_told():
    import bpy

    scene = animated(4)
    built = bpy.data.objects["Plane"].modifiers.new("Array", "ARRAY")
    for frame, count in ((1, 1), (3, 4)):
        built.count = count
        built.keyframe_insert("count", frame=frame)
    found, told = forms(scene, "Plane")
    assert not len(found) and any("faces" in str(line) for line in told), told


@pytest.mark.blender
def test_the_engine_moves_the_frame_and_puts_it_back(tmp_path):
    import bpy
    import scenes

    scene = animated(8)
    scenes.render(tmp_path / "blurred")
    assert scene.frame_current == 2
    assert not [line.text for line in part("report").latest().diagnostics]
    assert bpy.data.objects["Cube"].matrix_world.translation.x == pytest.approx(-0.2, abs=1e-3)


@pytest.mark.blender
def test_view_layers_without_motion_blur_stand_still():
    import bpy

    scene = animated(samples=64)
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 1.0
    scene.frame_set(2)
    blurred = picture(scene)
    bpy.context.view_layer.use_motion_blur = False
    still = picture(scene)
    scene.render.use_motion_blur, bpy.context.view_layer.use_motion_blur = False, True
    assert np.array_equal(still, picture(scene)) and np.abs(still - blurred).max() > 0.1 * still.max()
