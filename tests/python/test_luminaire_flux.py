"""Luminaires of real files in a black box: all of their flux arrives on its walls, whatever their opening is."""

import math

import gonio
import numpy as np
import pytest

SIDE = 3.0
PIXELS = 32
# Each wall by the axes of the camera that looks at it: right, up, back; the box is seen from within.
AXES = np.eye(3)
VIEWS = [(AXES[(k + 1) % 3], AXES[(k + 2) % 3], -sign * AXES[k]) for k in range(3) for sign in (1.0, -1.0)]


def box(light: dict) -> gonio.Scene:
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], np.float32) * (SIDE / 2)
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    triangles = np.array([t for a, b, c, d in quads for t in ((a, b, c), (a, c, d))], np.int32)
    scene = gonio.Scene()
    scene.add_instance(scene.add_mesh(corners, triangles), [scene.add_material(base_color=0.0, specular_weight=0.0)])
    scene.add_light("luminaire", visible=False, **light)
    return scene


def wall_flux(light: dict, view, samples: int) -> tuple[float, float]:
    """Flux in lm on a wall, and its standard error by pixels that neighbour each other."""
    scene = box(light)
    right, up, back = (np.array(axis, float) for axis in view)
    if np.dot(np.cross(right, up), back) < 0:
        right, up = up, right
    matrix = np.eye(4)
    # Just before the wall, seen straight on.
    matrix[:3, :3], matrix[:3, 3] = np.stack([right, up, back], axis=1), -back * (SIDE / 2 - 0.01)
    scene.add_camera(matrix.tolist())
    camera = scene.to_dict()["cameras"][0]
    camera.update(projection="Orthographic", aperture=[SIDE, SIDE])
    scene.put_camera(camera, 0)
    scene.set(width=PIXELS, height=PIXELS, samples=samples, integrator="direct", filter="box", filter_width=1.0, passes=["illuminance"])
    with gonio.Render(scene) as rendering:
        rendering.wait()
        lux = np.asarray(rendering.film()["illuminance"])[:, :, 0].astype(float)
    noise = np.diff(lux, n=2, axis=1).std() / math.sqrt(6.0)
    area = SIDE * SIDE
    return lux.mean() * area, noise / PIXELS * area


def files(shared):
    folders = [shared("photometry", "luminaires"), shared("photometry", "shapes", "ies95"), shared("photometry", "shapes", "ldt")]
    return [path for folder in folders for path in sorted(folder.iterdir()) if path.suffix in (".ies", ".ldt")]


@pytest.mark.timeout(600)
def test_flux_of_real_files(shared):
    seen, sum_of_squares, count = set(), 0.0, 0
    for path in files(shared):
        data = path.read_bytes()
        goniogram, _ = gonio.read_goniogram(data, path.name)
        kind = (goniogram["opening"]["shape"], path.suffix, len(goniogram["horizontal_deg"]))
        if kind in seen:
            continue
        seen.add(kind)
        expected = gonio.goniogram_figures(data, path.name)["flux_lm"]
        walls = [wall_flux({"goniogram": goniogram}, view, 64) for view in VIEWS]
        found, error = sum(flux for flux, _ in walls), math.hypot(*(error for _, error in walls))
        assert abs(found - expected) < max(4.5 * error, 2e-3 * expected), (path.name, goniogram["opening"], found, error, expected)
        sum_of_squares += (found / expected - 1.0) ** 2
        count += 1
        # The same flux when it is asked for in lumens.
        half = wall_flux({"goniogram": goniogram, "lumens": expected / 2}, VIEWS[5], 64)[0]
        assert half == pytest.approx(walls[5][0] / 2, rel=2e-3, abs=1e-3 * expected), path.name
    assert len({shape for shape, _, _ in seen}) >= 4
    assert math.sqrt(sum_of_squares / count) < 5e-3
