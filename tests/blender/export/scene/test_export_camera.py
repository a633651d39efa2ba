"""Cameras: the place of a point in the picture is Blender's."""

import pytest


def place(camera, point, width, height):
    """Where a world point falls in the picture, 0..1 from the bottom left, by the description of a camera."""
    import numpy as np

    matrix = np.array(camera["transform"]["columns"])
    x, y, z = np.linalg.solve(matrix[:3].T, np.array(point) - matrix[3])
    kind = camera["projection"]
    if kind != "Orthographic":
        focal = kind["Perspective"]["focal_length"]
        x, y = -x / z * focal, -y / z * focal
    size, offset = np.array(camera["aperture"]), np.array(camera["aperture_offset"])
    return (np.array([x, y]) - offset) / size + 0.5


@pytest.mark.blender
@pytest.mark.parametrize("kind", ["PERSP", "ORTHO"])
@pytest.mark.parametrize("fit", ["AUTO", "HORIZONTAL", "VERTICAL"])
def test_points_fall_where_blender_puts_them(tmp_path, kind, fit):
    import bpy
    import numpy as np
    from bpy_extras.object_utils import world_to_camera_view
    from mathutils import Vector
    from recorder import depsgraph, empty, exporter, link

    empty()
    scene = bpy.context.scene
    lens = bpy.data.cameras.new("Camera")
    lens.type, lens.sensor_fit, lens.shift_x, lens.shift_y, lens.lens = kind, fit, 0.13, -0.21, 35.0
    lens.sensor_width, lens.sensor_height, lens.ortho_scale = 32.0, 20.0, 5.0
    scene.camera = link(bpy.data.objects.new("Camera", lens))
    scene.camera.location, scene.camera.rotation_euler, scene.camera.scale = (3, -4, 2), (1.2, 0.1, 0.7), (2, 2, 2)
    scene.render.pixel_aspect_x, scene.render.pixel_aspect_y, scene.render.resolution_percentage = 1.0, 1.5, 100
    for width, height in ((300, 200), (200, 300)):
        scene.render.resolution_x, scene.render.resolution_y = width, height
        exported, _ = exporter()
        camera = exported.sync(depsgraph()).cameras[0]
        for point in np.random.default_rng(3).uniform(-1, 1, (8, 3)):
            wanted = world_to_camera_view(scene, scene.camera, Vector(point))[:2]
            assert place(camera, point, width, height) == pytest.approx(list(wanted), abs=2e-4)


@pytest.mark.blender
def test_depth_of_field(tmp_path):
    from math import radians

    import bpy
    from recorder import depsgraph, empty, exporter, link

    empty()
    scene = bpy.context.scene
    lens = bpy.data.cameras.new("Camera")
    scene.camera = link(bpy.data.objects.new("Camera", lens))
    target = link(bpy.data.objects.new("Target", None))
    target.location = (1.0, 2.0, -7.0)
    lens.dof.use_dof, lens.dof.aperture_fstop, lens.dof.aperture_blades = True, 2.0, 6
    lens.dof.aperture_rotation, lens.dof.aperture_ratio, lens.dof.focus_object, lens.lens = radians(15), 2.0, target, 50.0
    exported, _ = exporter()
    camera = exported.sync(depsgraph()).cameras[0]
    assert camera["lens_radius"] == pytest.approx(0.0125) and camera["focus_distance"] == pytest.approx(7.0, rel=1e-6)
    assert (camera["blades"], camera["lens_ratio"]) == (6, 2.0) and camera["blade_rotation_deg"] == pytest.approx(15.0)


@pytest.mark.blender
def test_panoramas(tmp_path):
    from math import pi

    import bpy
    from recorder import depsgraph, empty, exporter, link

    empty()
    scene = bpy.context.scene
    lens = bpy.data.cameras.new("Camera")
    lens.type, lens.sensor_width = "PANO", 36.0
    scene.camera = link(bpy.data.objects.new("Camera", lens))
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = 200, 100, 100
    exported, report = exporter()

    def shown(**fields):
        for name, value in fields.items():
            setattr(lens, name, value)
        return exported.sync(depsgraph()).cameras[0]["projection"]

    ((kind, fields),) = shown(panorama_type="EQUIRECTANGULAR", longitude_min=-1.0).items()
    assert (
        kind == "Equirectangular"
        and fields["longitude"] == pytest.approx([-1.0, pi])
        and fields["latitude"] == pytest.approx([-pi / 2, pi / 2])
    )
    assert shown(panorama_type="FISHEYE_EQUIDISTANT", fisheye_fov=pi)["FisheyeEquidistant"]["fov_deg"] == pytest.approx(180.0)
    fields = shown(panorama_type="FISHEYE_EQUISOLID", fisheye_lens=12.0)["FisheyeEquisolid"]
    assert fields["sensor"] == [36.0, 18.0] and fields["focal_length"] == 12.0 and not report.diagnostics
    shown(panorama_type="MIRRORBALL")
    assert [line.name for line in report.diagnostics] == ["Camera"]


class View:
    """What the exporter reads of a 3D view."""

    def __init__(self, **fields):
        self.__dict__.update(fields)


@pytest.mark.blender
def test_viewport(tmp_path):
    import bpy
    import numpy as np
    from recorder import depsgraph, empty, exporter

    empty()
    exported, _ = exporter()
    exported.sync(depsgraph())
    pose = np.eye(4)
    pose[:3, 3] = (1, 2, 3)
    left, right, bottom, top, near, far = -0.02, 0.06, -0.01, 0.03, 0.1, 100.0
    lens = np.array(
        [
            [2 * near / (right - left), 0, (right + left) / (right - left), 0],
            [0, 2 * near / (top - bottom), (top + bottom) / (top - bottom), 0],
            [0, 0, -(far + near) / (far - near), -2 * far * near / (far - near)],
            [0, 0, -1, 0],
        ]
    )
    space = View(clip_start=near, clip_end=far, use_local_camera=False, camera=None)
    region = View(window_matrix=lens, view_matrix=np.linalg.inv(pose), view_perspective="PERSP")
    assert exported.set_view(depsgraph(), space, region, 80, 40)
    camera = exported.scene.cameras[0]
    # Corners of the view at depth 10.
    assert place(camera, (1 + left * 100, 2 + bottom * 100, 3 - 10), 80, 40) == pytest.approx([0, 0], abs=1e-9)
    assert place(camera, (1 + right * 100, 2 + top * 100, 3 - 10), 80, 40) == pytest.approx([1, 1], abs=1e-9)
    assert not exported.set_view(depsgraph(), space, region, 80, 40)
    flat = np.array([[2 / 8, 0, 0, -0.5], [0, 2 / 4, 0, 0.25], [0, 0, -2 / 100, 0], [0, 0, 0, 1.0]])
    region = View(window_matrix=flat, view_matrix=np.linalg.inv(pose), view_perspective="ORTHO")
    assert exported.set_view(depsgraph(), space, region, 80, 40)
    camera = exported.scene.cameras[0]
    assert camera["projection"] == "Orthographic" and camera["aperture"] == [8.0, 4.0] and camera["aperture_offset"] == [2.0, -0.5]
    assert camera["transform"]["columns"][3] == [1.0, 2.0, 53.0] and camera["clipping"] == [0.0, 100.0]
    assert bpy.context.scene.camera is None
