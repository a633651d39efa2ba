"""Nodes that look around hits with rays of their own, against closed forms."""

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, at, finished


def emitting(operation, inputs):
    """A black surface that shines as a node says."""
    nodes = [{"operation": operation, "inputs": [{"Constant": [*each, 0.0][:4]} for each in inputs]}]
    shining = {"weight": {"Constant": [1.0] * 4}, "model": "Emission", "parameters": [["emission_color", {"Node": [0, "Rgb"]}]]}
    return {"closures": [shining], "graph": {"nodes": nodes}}


def shown(material, camera, meshes, samples=64, fov=2):
    """What the camera sees of meshes, of which the first has the material; the others are black."""
    scene = gonio.Scene()
    scene.set(width=8, height=8, samples=samples, passes=["color"])
    black = scene.add_material("black", base_color=(0.0, 0.0, 0.0), specular_weight=0.0)
    for number, (points, triangles, place) in enumerate(meshes):
        used = scene.put_material(material) if number == 0 else black
        scene.add_instance(scene.add_mesh(points, triangles), [used], transform=place)
    scene.add_camera(camera, fov=fov)
    return np.asarray(finished(scene)["color"])[..., :3].mean((0, 1))


def occlusion(distance, **fields):
    operation = {"Occlusion": {"samples": 16, "inside": False, "only_local": False, **fields}}
    return emitting(operation, [(0.0, 1.0, 0.0), (distance,) * 3])


WIDE = FLOOR * 20.0
# Under a wide ceiling, 1 m high.
ROOM = [(WIDE, QUAD, at(0, 0, 0)), (WIDE, QUAD, at(0, 1, 0))]


@pytest.mark.parametrize(("distance", "expected"), [(0.0, 1.0), (0.5, 1.0), (1.25, 0.64), (2.0, 0.25), (5.0, 0.04)])
def test_a_ceiling_occludes_what_is_near_the_normal(distance, expected):
    # Rays that rise steeper than an arc cosine of 1 m over the distance meet it, which are 1 − (1 m / distance)² of them.
    assert shown(occlusion(distance), above(0.5), ROOM) == pytest.approx([expected] * 3, abs=0.01)


@pytest.mark.parametrize("fields", [{"inside": True}, {"only_local": True}])
def test_nothing_is_near_inside_or_on_the_floor_itself(fields):
    assert shown(occlusion(5.0, **fields), above(0.5), ROOM) == pytest.approx([1.0] * 3)


# Two walls of a beam whose edge runs along z, at the top of x = 0.
BEAM = np.array([[0, 0, 5], [0, 0, -5], [-5, 0, -5], [-5, 0, 5], [0, -5, 5], [0, -5, -5]], "f4")
SIDES = np.array([[0, 1, 2], [0, 2, 3], [0, 4, 5], [0, 5, 1]], "i4")


@pytest.mark.parametrize(("x", "tilt"), [(-0.5, 0.0), (-1e-3, 45.0)])
def test_edges_are_rounded_and_faces_stay(x, tilt):
    camera = [[1, 0, 0, x], [0, 0, 1, 1], [0, -1, 0, 0], [0, 0, 0, 1]]
    material = emitting({"RoundedNormal": {"samples": 16}}, [(0.2, 0.2, 0.2)])
    narrow = shown(material, camera, [(BEAM, SIDES, at(0, 0, 0))], samples=256, fov=0.05)
    assert narrow == pytest.approx([np.sin(np.radians(tilt)), np.cos(np.radians(tilt)), 0.0], abs=0.04)
