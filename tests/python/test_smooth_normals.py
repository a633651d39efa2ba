"""Smooth normals far from the faces': in a white room white balls of few faces vanish, in every model, but for what the faces hide."""

import math

import numpy as np
import pytest
from small_scenes import ball

import gonio

SIDES, SIZE = 8, 32
METAL = {"base_color": 1.0, "metalness": 1.0, "specular_roughness": 0.0}
COATED = {"base_color": 1.0, "specular_weight": 0.0, "coat_weight": 1.0, "coat_roughness": 0.0}
GLASS = {"transmission_weight": 1.0, "specular_roughness": 0.0}


def pictured(model, **parameters):
    scene = gonio.Scene()
    scene.set(width=SIZE, height=SIZE, samples=64, max_bounces=64)
    points, triangles = ball(SIDES)
    mesh = scene.add_mesh(points, triangles, normals=points)
    described = [[name, {"Constant": [value] * 3 + [1.0]}] for name, value in parameters.items()]
    closure = {"weight": {"Constant": [1.0] * 4}, "model": model, "parameters": described}
    scene.put_instances(mesh, [scene.put_material({"origin": "ball", "closures": [closure]})], np.eye(4)[None])
    scene.add_light("dome", [1, 1, 1])
    sin, cos = math.sin(math.radians(10)), math.cos(math.radians(10))
    scene.add_camera([[1, 0, 0, 0], [0, cos, sin, 8 * sin], [0, -sin, cos, 8 * cos], [0, 0, 0, 1]], fov=15.7)
    with gonio.Render(scene) as render:
        assert render.wait()
        return np.asarray(render.film()["color"])[..., 0]


@pytest.mark.parametrize("model", ["OpenPbr", "Principled", "PreviewSurface", "StandardSurface", "Gltf"])
def test_no_model_loses_what_its_lobes_mirror(model):
    tint = {"metal_edge_tint": 1.0} if model == "StandardSurface" else {}
    metal = pictured(model, **METAL, **tint)
    assert metal.min() > 0.98 and metal.max() < 1.02
    coated = pictured(model, **COATED)
    # Under the coat the faces hide a part of what diffuse lobes send.
    assert coated.min() > 0.8 and coated.mean() > 0.975 and coated.max() < 1.1


@pytest.mark.parametrize("model", ["OpenPbr", "Principled", "StandardSurface", "Gltf"])
def test_glass_keeps_its_edges(model):
    glass = pictured(model, **GLASS, base_color=1.0)
    assert glass.mean() > 0.97 and (glass < 0.5).mean() < 0.02 and glass.max() < 1.02
