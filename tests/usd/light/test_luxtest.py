"""Lights of the luxtest stages against quadrature: illuminance of the floor, direct light alone."""

import math

import luxtest_quadrature
import numpy as np
import pictures
import pytest

# Ten by ten points of the camera's view: straight from above the inner eight by eight lie on the floor, and the outer ones beside it.
SIDE = 10
SAMPLES = {"chosen": 8192, "every": 16384}
TOLERANCE = 0.01
# Where the cone cuts the light in two few samples count: twice the largest standard error seen there at 8192 samples a pixel.
EDGE_TOLERANCE = {"chosen": 0.03, "every": 0.02}
# Below this share of the frame's largest value the tolerance is that of the share.
SMALL = 0.01

# One or two frames for each thing the stages vary.
SHAPED = {
    "positions": (1, 3, 5),
    "sizes": (6, 10),
    "normalize": (11, 13),
    "temperatures": (16, 20),
    "cone angles": (22, 24),
    "rotated and stretched": (26, 28),
    "softness": (31, 33, 35),
    "focus": (38, 43),
    "focus tints": (47, 49),
}
DISTANT = {"directions": (1, 3, 5), "cameras": (7, 9), "angles": (11, 13, 20), "normalize": (21, 23, 30), "temperatures": (31, 35)}
EVERY = {"rect": 50, "sphere": 50, "cylinder": 50, "distant": 35}

NAMES = {
    "width": "width",
    "height": "height",
    "radius": "radius",
    "length": "length",
    "angle": "angle",
    "intensity": "intensity",
    "exposure": "exposure",
    "color": "color",
    "enable_temperature": "enableColorTemperature",
    "temperature": "colorTemperature",
    "normalize": "normalize",
    "cone_angle": "shaping:cone:angle",
    "softness": "shaping:cone:softness",
    "focus": "shaping:focus",
    "focus_tint": "shaping:focusTint",
}


def light_at(stage, frame):
    """The stage's light at a frame, for the quadrature."""
    from pxr import UsdGeom

    prim = next(prim for prim in stage.Traverse() if prim.GetTypeName().endswith("Light"))
    light = {"kind": prim.GetTypeName().removesuffix("Light").lower()}
    light["to_world"] = np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(frame))
    for name, attribute in NAMES.items():
        value = prim.GetAttribute(f"inputs:{attribute}").Get(frame) if prim.HasAttribute(f"inputs:{attribute}") else None
        if value is not None:
            light[name] = tuple(value) if hasattr(value, "__len__") else value
    return light


def occluder_at(stage, frame):
    """Centre and half axes of the small rectangle, a little enlarged; None where the stage has none."""
    from pxr import UsdGeom

    prim = stage.GetPrimAtPath("/smallAngledRect/mesh_0")
    if not prim:
        return None
    matrix = np.array(UsdGeom.Xformable(prim).ComputeLocalToWorldTransform(frame))
    return matrix[3, :3], 5.3 * matrix[0, :3], 5.3 * matrix[2, :3]


def surface_points(light, count=24):
    """Points all over a light."""
    matrix = light["to_world"]
    u, v = (axis.ravel() for axis in np.meshgrid(np.linspace(-1, 1, count), np.linspace(-1, 1, count)))
    if light["kind"] == "rect":
        local = np.stack([u * light["width"] / 2, v * light["height"] / 2, 0 * u], axis=1)
    elif light["kind"] == "disk":
        local = light["radius"] * np.stack([u * np.cos(math.pi * v), u * np.sin(math.pi * v), 0 * u], axis=1)
    elif light["kind"] == "cylinder":
        local = np.stack([u * light["length"] / 2, light["radius"] * np.cos(math.pi * v), light["radius"] * np.sin(math.pi * v)], axis=1)
    else:
        ring = np.sqrt(1 - u * u)
        local = light["radius"] * np.stack([u, ring * np.cos(math.pi * v), ring * np.sin(math.pi * v)], axis=1)
    return local @ matrix[:3, :3] + matrix[3, :3]


def directions_of(light, count=24):
    """Directions all over what a distant light covers, towards it."""
    half = math.radians(light["angle"]) / 2 + 1e-3
    u, v = (axis.ravel() for axis in np.meshgrid(np.linspace(0, 1, count), np.linspace(-1, 1, count)))
    off = half * u
    local = np.stack([np.sin(off) * np.cos(math.pi * v), np.sin(off) * np.sin(math.pi * v), np.cos(off)], axis=1)
    return local @ light["to_world"][:3, :3]


def crosses(starts, ends, occluder):
    """Whether any of the segments meets the rectangle."""
    if occluder is None:
        return False
    centre, first, second = occluder
    normal = np.cross(first, second)
    with np.errstate(all="ignore"):
        along = ((centre - starts) @ normal) / ((ends - starts) @ normal)
    at = starts + along[:, None] * (ends - starts) - centre
    inside = (np.abs(at @ first) <= first @ first) & (np.abs(at @ second) <= second @ second)
    return bool((inside & (along > 0) & (along < 1)).any())


def camera_at(stage, frame):
    """Matrix of the camera, and the tangent of half its view."""
    from pxr import UsdGeom

    camera = UsdGeom.Camera(stage.GetPrimAtPath("/cameras/camera1"))
    tangent = camera.GetHorizontalApertureAttr().Get(frame) / camera.GetFocalLengthAttr().Get(frame) / 2
    return np.array(UsdGeom.Xformable(camera).ComputeLocalToWorldTransform(frame)), tangent


def floor_points(light, occluder, camera):
    """Points of the floor that see the whole light past the small rectangle and that the camera sees: (row, column, point)."""
    matrix, tangent = camera
    eye = matrix[3:, :3]
    on_light = None if light["kind"] == "distant" else surface_points(light)
    found = []
    for row in range(SIDE):
        for column in range(SIDE):
            right, down = (((2 * k + 1) / SIDE - 1) * tangent for k in (column, row))
            towards = right * matrix[0, :3] - down * matrix[1, :3] - matrix[2, :3]
            point = eye[0] - towards * eye[0, 1] / towards[1]
            if np.abs(point).max() > 4.9 or crosses(point[None], eye, occluder):
                continue
            ends = point + 100 * directions_of(light) if on_light is None else on_light
            if crosses(np.broadcast_to(point, ends.shape), ends, occluder):
                continue
            # The light itself may stand before the floor, at most as far from its middle as its farthest point.
            if on_light is not None:
                middle = light["to_world"][3, :3]
                reach = np.linalg.norm(on_light - middle, axis=1).max() * 1.02
                towards = (eye[0] - point) / np.linalg.norm(eye[0] - point)
                beside = middle - point
                if np.linalg.norm(beside - (beside @ towards) * towards) < reach and (beside[1] > -reach):
                    continue
            found.append((row, column, point))
    return found


def cut(light, point):
    """Whether part of the light lies outside of its own cone, seen from the point."""
    angle = light.get("cone_angle")
    if light["kind"] == "distant" or angle is None or angle >= 180:
        return False
    out = point - surface_points(light)
    axis = -light["to_world"][2, :3]
    cosines = out @ axis / (np.linalg.norm(out, axis=1) * np.linalg.norm(axis))
    return bool((cosines < math.cos(math.radians(angle))).any())


def render(run, path, frames, folder, samples):
    listed = ",".join(str(frame) for frame in frames)
    done = run(
        "render", path, "-f", listed, "-o", folder / "f.####.exr", "--res", SIDE, SIDE, "--spp", samples, "--integrator", "direct",
        "--aov", "illuminance", "--filter", "box", "--filter-width", 0.0002, "-q", timeout=1700,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return {frame: pictures.read(folder / f"f.{frame:04}.exr")["Illuminance"] for frame in frames}


def wrong_points(path, images, edge_tolerance, every=1):
    """Points of all frames that differ, as text; and how many were looked at."""
    from pxr import Usd

    stage = Usd.Stage.Open(str(path))
    wrong, looked = [], 0
    for frame, image in images.items():
        light = light_at(stage, frame)
        points = floor_points(light, occluder_at(stage, frame), camera_at(stage, frame))[::every]
        expected = np.array([luxtest_quadrature.illuminance(light, point, (0.0, 1.0, 0.0)) for *_, point in points])
        found = np.array([image[row, column] for row, column, _ in points])
        assert np.isfinite(image).all(), f"frame {frame} has values that are no numbers"
        floor = SMALL * expected.max(initial=0.0)
        tolerance = np.array([edge_tolerance if cut(light, point) else TOLERANCE for *_, point in points])
        bad = np.abs(found - expected) > tolerance * np.maximum(expected, floor)
        for k in np.flatnonzero(bad):
            x, _, z = points[k][2]
            wrong.append(f"frame {frame} at ({x:.2f}, {z:.2f}): {found[k]:.5g} lx, expected {expected[k]:.5g} lx")
        looked += len(points)
        assert len(points) > 5, f"frame {frame} has too few points in view of the light"
    return wrong, looked


def stage_of(shared, kind):
    return shared("usd", "luxtest", "usd", f"{kind}.usda")


def check(run, path, frames, folder, extent, every=1):
    images = render(run, path, frames, folder, SAMPLES[extent])
    wrong, looked = wrong_points(path, images, EDGE_TOLERANCE[extent], every)
    assert not wrong, f"{len(wrong)} of {looked} points are off:\n" + "\n".join(wrong[:40])


SUBSETS = [(kind, name, frames) for kind in ("rect", "sphere", "cylinder") for name, frames in SHAPED.items()]
SUBSETS += [("distant", name, frames) for name, frames in DISTANT.items()]


@pytest.mark.parametrize(("kind", "name", "frames"), SUBSETS, ids=[f"{kind}-{name}" for kind, name, _ in SUBSETS])
def test_illuminance_of_chosen_frames(run, shared, tmp_path, kind, name, frames):
    check(run, stage_of(shared, kind), frames, tmp_path, "chosen", every=2)


@pytest.mark.validate
@pytest.mark.timeout(1800)
@pytest.mark.parametrize("kind", EVERY)
def test_illuminance_of_every_frame(run, shared, tmp_path, kind):
    check(run, stage_of(shared, kind), range(1, EVERY[kind] + 1), tmp_path, "every")
