"""Displaced meshes: held to the same meshes displaced beforehand, to white furnaces, and to their limits."""

import math

import gonio
import numpy as np
import pytest
from small_scenes import finished

PRIMVAR = {"operation": {"Primvar": {"name": "st", "fallback": [0.0] * 4}}, "inputs": []}


def grid(count, height=lambda u, v: 0.0 * u):
    """A square of side 2 in the plane y = 0, with heights: points, triangles and coordinates."""
    u, v = (axis.ravel() for axis in np.meshgrid(np.linspace(0, 1, count + 1), np.linspace(0, 1, count + 1), indexing="ij"))
    points = np.stack([2 * u - 1, height(u, v), 2 * v - 1], axis=1).astype("f4")
    a = (np.arange(count)[:, None] * (count + 1) + np.arange(count)).ravel()
    quads = np.stack([a, a + 1, a + count + 2, a + count + 1], axis=1)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype("i4")
    return points, triangles, np.stack([u, v], axis=1).astype("f4")


def waves(u, v):
    return 0.15 * np.sin(9.0 * u) * np.cos(7.0 * v)


def node(operation, *inputs):
    return {"operation": operation, "inputs": [{"Node": [*i]} if isinstance(i, tuple) else {"Constant": i} for i in inputs]}


def wave_nodes():
    """The same heights as nodes; the number of the last."""
    return [
        PRIMVAR,
        node("Multiply", (0, "Rgb"), [9.0, 7.0, 0.0, 0.0]),
        node("Sine", (1, "R")),
        node("Cosine", (1, "G")),
        node("Multiply", (2, "Rgb"), (3, "Rgb")),
        node("Multiply", (4, "Rgb"), [0.15] * 4),
    ]


def diffuse(colour=0.7, **more):
    parameters = [["base_color", {"Constant": [colour] * 3 + [1.0]}]]
    return {"closures": [{"model": "Diffuse", "parameters": parameters}], **more}


def lit(width=48, samples=64, camera=(0.0, 2.2, 2.2), background=None):
    made = gonio.Scene()
    made.set(width=width, height=width, samples=samples, max_bounces=3, passes=["color"], filter="box", filter_width=1.0)
    if background is None:
        made.add_light("sphere", (40.0, 40.0, 40.0), transform=[[1, 0, 0, 1.5], [0, 1, 0, 2.0], [0, 0, 1, 0.5], [0, 0, 0, 1]], radius=0.3)
    made.add_light("dome", background or (0.2, 0.2, 0.3))
    tilt = math.atan2(camera[1], camera[2])
    sin, cos = math.sin(tilt), math.cos(tilt)
    x, y, z = camera
    made.add_camera([[1, 0, 0, x], [0, cos, sin, y], [0, -sin, cos, z], [0, 0, 0, 1]], fov=45)
    return made


def picture(scene):
    return np.asarray(finished(scene)["color"])[..., :3].astype(float)


def normals_of(points, triangles):
    flat = np.cross(points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]])
    sums = np.zeros_like(points)
    for k in range(3):
        np.add.at(sums, triangles[:, k], flat)
    return (sums / np.linalg.norm(sums, axis=1, keepdims=True)).astype("f4")


@pytest.mark.parametrize("smooth", [False, True])
def test_a_displaced_mesh_is_the_mesh_displaced_beforehand(smooth):
    pictures = []
    for displaced in (True, False):
        scene = lit()
        points, triangles, st = grid(60, (lambda u, v: 0.0 * u) if displaced else waves)
        normals = None
        if smooth:
            normals = np.tile(np.array([0, 1, 0], "f4"), (len(points), 1)) if displaced else normals_of(points, triangles)
        mesh = scene.add_mesh(points, triangles, uvs=st, normals=normals)
        described = diffuse(graph={"nodes": wave_nodes()}, displacement={"value": {"Node": [5, "R"]}}) if displaced else diffuse()
        scene.add_instance(mesh, [scene.put_material(described)])
        pictures.append(picture(scene))
    # Heights differ by rounding alone; normals of points by their weights.
    difference = np.abs(pictures[0] - pictures[1])
    assert np.median(difference) < (2e-3 if smooth else 1e-4) * pictures[1].mean()
    assert difference.mean() < 0.01 * pictures[1].mean()
    assert pictures[1].std() > 0.1 * pictures[1].mean()


def ball(rings, own_points):
    """A closed sphere with a seam; each triangle has points of its own if asked for."""
    u, v = np.meshgrid(np.linspace(0, 1, 2 * rings + 1), np.linspace(0, 1, rings + 1), indexing="ij")
    longitude, latitude = 2 * np.pi * u, np.pi * (v - 0.5)
    points = np.stack([np.cos(latitude) * np.cos(longitude), np.sin(latitude), -np.cos(latitude) * np.sin(longitude)], axis=2)
    # The seam's and the poles' points are the same to the last bit.
    points[-1] = points[0]
    points[:, 0], points[:, -1] = (0, -1, 0), (0, 1, 0)
    points, st = points.reshape(-1, 3).astype("f4"), np.stack([u, v], axis=2).reshape(-1, 2).astype("f4")
    a = (np.arange(2 * rings)[:, None] * (rings + 1) + np.arange(rings)).ravel()
    quads = np.stack([a, a + rings + 1, a + rings + 2, a + 1], axis=1)
    triangles = np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]).astype("i4")
    if own_points:
        points, st = points[triangles.ravel()], st[triangles.ravel()]
        triangles = np.arange(len(points), dtype="i4").reshape(-1, 3)
    return points, triangles, st


@pytest.mark.parametrize("own_points", [False, True])
@pytest.mark.parametrize("diced", [False, True])
def test_a_displaced_ball_keeps_light_inside(own_points, diced):
    """A camera within a closed ball sees nothing of a bright sky, whatever its coordinates do at seams."""
    scene = lit(samples=16, camera=(0.0, 0.0, 0.1), background=(1e4, 1e4, 1e4))
    scene.set(max_bounces=0)
    points, triangles, st = ball(16, own_points)
    # Flat: smooth normals of so few triangles let light in between their horizon and the face, displaced or not.
    mesh = scene.add_mesh(points, triangles, uvs=st)
    if diced:
        scene.set_dicing(mesh, pixels=4.0)
    # Heights that jump at the seam.
    described = diffuse(graph={"nodes": wave_nodes()}, displacement={"value": {"Node": [5, "R"]}, "scale": 2.0})
    scene.add_instance(mesh, [scene.put_material(described)])
    assert picture(scene).max() == 0.0


def test_a_displaced_white_ball_vanishes_in_a_furnace():
    scene = lit(samples=256, camera=(0.0, 0.0, 3.0), background=(1.0, 1.0, 1.0))
    scene.set(max_bounces=64)
    points, triangles, st = ball(24, False)
    mesh = scene.add_mesh(points, triangles, uvs=st)
    described = diffuse(1.0, graph={"nodes": wave_nodes()}, displacement={"value": {"Node": [5, "R"]}, "scale": 2.0})
    scene.add_instance(mesh, [scene.put_material(described)])
    assert abs(picture(scene).mean() - 1.0) < 0.01


def test_emitters_shine_from_where_they_have_moved():
    """A square that moved to twice its distance lights the ground a quarter as much."""
    values = []
    for height in (0.0, 0.5):
        scene = gonio.Scene()
        scene.set(samples=256, max_bounces=1)
        points, triangles, st = grid(2)
        points, triangles = points * np.float32(0.05), triangles[:, ::-1].copy()
        mesh = scene.add_mesh(points, triangles, uvs=st)
        glow = {"model": "Emission", "parameters": [["emission_color", {"Constant": [100.0, 100.0, 100.0, 1.0]}]]}
        # It looks down, and moves up.
        moved = {"value": {"Constant": [-height] * 4}}
        material = scene.put_material({"closures": [glow], "displacement": moved})
        scene.add_instance(mesh, [material], transform=[[1, 0, 0, 0], [0, 1, 0, 0.5], [0, 0, 1, 0], [0, 0, 0, 1]])
        scene.add_meter((0, 0, 0), normal=(0, 1, 0))
        values.append(gonio.measure(scene).meters[0].value)
    assert values[0] > 0.0 and abs(values[1] / values[0] - 0.25) < 0.01


def test_dicing_makes_silhouettes_round():
    """A coarse ball covers the pixels of a fine one once it is diced."""
    cover = []
    for rings, diced in ((6, False), (6, True), (96, False)):
        scene = lit(width=96, samples=16, camera=(0.0, 0.0, 3.0), background=(0.0, 0.0, 0.0))
        points, triangles, st = ball(rings, False)
        mesh = scene.add_mesh(points, triangles, uvs=st, normals=points)
        if diced:
            scene.set_dicing(mesh, pixels=2.0)
        glow = {"model": "Emission", "parameters": [["emission_color", {"Constant": [1.0] * 4}]]}
        scene.add_instance(mesh, [scene.put_material({"closures": [glow]})])
        cover.append(picture(scene).mean())
    assert abs(cover[1] - cover[2]) < 0.15 * abs(cover[0] - cover[2])


def test_limits_are_told():
    scene = lit(samples=1)
    points, triangles, st = grid(60)
    mesh = scene.add_mesh(points, triangles, uvs=st)
    scene.add_instance(mesh, [scene.put_material(diffuse(graph={"nodes": wave_nodes()}, displacement={"value": {"Node": [5, "R"]}}))])
    scene.set(displacement_memory="64K")
    with gonio.Render(scene) as render:
        assert render.wait() and any("limit of displacement" in text for _, text in render.diagnostics)
    with pytest.raises(ValueError):
        scene.set_dicing(mesh, pixels=0.0)
    with pytest.raises(ValueError):
        scene.set_dicing(mesh + 1)
