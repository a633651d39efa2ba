# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender cameras, for renders and seen through in the viewport."""

from math import degrees, tan

import numpy as np

from .transforms import columns, without_scale

PINHOLE = {"lens_radius": 0.0, "focus_distance": 1.0, "blades": 0, "blade_rotation_deg": 0.0, "lens_ratio": 1.0}


def describe(source, width, height, pixel_aspect, report, depsgraph, eye=None):
    """The description of a camera object for a picture of width × height pixels; pixel_aspect is (x, y) of the render settings. `eye` is a view of a
    stereoscopic picture, with a place and a shift of its own."""
    lens = source.data
    if source.type == "LIGHT":
        return _through_lamp(source, width, height, pixel_aspect)
    shape = np.array([width * pixel_aspect[0], height * pixel_aspect[1]], dtype=float)
    sensor = _sensor(lens, shape)
    shift_x = lens.shift_x if eye is None or eye.shift_x is None else eye.shift_x
    matrix = source.matrix_world if eye is None or eye.matrix is None else eye.matrix
    projection, aperture, offset = _projection(lens, sensor, shape, source.name, report, shift_x)
    return {
        "origin": {"name": source.name, "file": ""},
        "projection": projection,
        "aperture": [float(x) for x in aperture],
        "aperture_offset": [float(x) for x in offset],
        "clipping": [float(lens.clip_start), float(lens.clip_end)],
        "transform": columns(without_scale(matrix)),
        "exposure": 1.0,
        **depth_of_field(source, depsgraph),
    }


def _sensor(lens, shape):
    """Width and height of the part of the sensor that the picture covers, mm."""
    horizontal = lens.sensor_fit == "HORIZONTAL" or (lens.sensor_fit == "AUTO" and shape[0] > shape[1])
    size = lens.sensor_height if lens.sensor_fit == "VERTICAL" else lens.sensor_width
    return size * shape / (shape[0] if horizontal else shape[1])


def _fitted(lens, sensor, shape):
    """The fitted side of the sensor: what shifts are counted in."""
    horizontal = lens.sensor_fit == "HORIZONTAL" or (lens.sensor_fit == "AUTO" and shape[0] > shape[1])
    return sensor[0] if horizontal else sensor[1]


def _projection(lens, sensor, shape, name, report, shift_x):
    shift = np.array([shift_x, lens.shift_y])
    if lens.type == "ORTHO":
        size = sensor * lens.ortho_scale / _fitted(lens, sensor, shape)
        return "Orthographic", size, shift * lens.ortho_scale
    if lens.type == "PANO":
        return panorama(lens, sensor, name, report), (1.0, 1.0), shift
    if lens.type != "PERSP":
        report.tell("kind of camera", "Camera", name, f"Cameras of type {lens.type.capitalize()}")
    return {"Perspective": {"focal_length": float(lens.lens)}}, sensor, shift * _fitted(lens, sensor, shape)


def panorama(lens, sensor, name, report):
    """The projection of a panoramic camera."""
    settings = lens if hasattr(lens, "panorama_type") else lens.cycles
    kind = settings.panorama_type
    if kind == "FISHEYE_EQUIDISTANT":
        return {"FisheyeEquidistant": {"fov_deg": degrees(settings.fisheye_fov)}}
    if kind == "FISHEYE_EQUISOLID":
        fields = {
            "focal_length": float(settings.fisheye_lens),
            "fov_deg": degrees(settings.fisheye_fov),
            "sensor": [float(x) for x in sensor],
        }
        return {"FisheyeEquisolid": fields}
    if kind != "EQUIRECTANGULAR":
        report.tell("panorama", "Camera", name, f"Panoramas of type {kind.replace('_', ' ').capitalize()}")
        return {"Equirectangular": {"longitude": [-np.pi, np.pi], "latitude": [-0.5 * np.pi, 0.5 * np.pi]}}
    longitude = [float(settings.longitude_min), float(settings.longitude_max)]
    return {"Equirectangular": {"longitude": longitude, "latitude": [float(settings.latitude_min), float(settings.latitude_max)]}}


def depth_of_field(source, depsgraph):
    """Lens and focus; a pinhole where depth of field is off."""
    lens, dof = source.data, source.data.dof
    if not dof.use_dof:
        return PINHOLE
    stop = max(dof.aperture_fstop, 1e-5)
    # An orthographic camera has no focal length; Cycles takes one of a metre.
    diameter = (1.0 if lens.type == "ORTHO" else lens.lens * 1e-3) / stop
    return {
        "lens_radius": 0.5 * diameter,
        "focus_distance": float(_focus(source, dof, depsgraph)),
        "blades": int(dof.aperture_blades) if dof.aperture_blades > 2 else 0,
        "blade_rotation_deg": degrees(dof.aperture_rotation),
        "lens_ratio": float(dof.aperture_ratio),
    }


def _focus(source, dof, depsgraph):
    """Distance along the view axis of what is sharp."""
    if dof.focus_object is None:
        return dof.focus_distance
    target = dof.focus_object.evaluated_get(depsgraph)
    place = target.matrix_world
    bone = target.pose.bones.get(dof.focus_subtarget) if target.pose and dof.focus_subtarget else None
    if bone is not None:
        place = place @ bone.matrix
    axis = np.array(source.matrix_world.col[2][:3])
    axis /= np.linalg.norm(axis) or 1.0
    return abs(float(axis @ (np.array(source.matrix_world.col[3][:3]) - np.array(place.col[3][:3]))))


def _through_lamp(source, width, height, pixel_aspect):
    """Blender can look through a lamp: a spot's cone fills the picture's longer side."""
    angle = getattr(source.data, "spot_size", 0.0) or 0.69
    shape = np.array([width * pixel_aspect[0], height * pixel_aspect[1]], dtype=float)
    aperture = 2.0 * tan(0.5 * angle) * shape / shape.max()
    return {
        "origin": {"name": source.name, "file": ""},
        "projection": {"Perspective": {"focal_length": 1.0}},
        "aperture": [float(x) for x in aperture],
        "aperture_offset": [0.0, 0.0],
        "clipping": [1e-5, 1e5],
        "transform": columns(without_scale(source.matrix_world)),
        "exposure": 1.0,
        **PINHOLE,
    }
