"""Materials that ask what kind of ray shades them."""

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, at, finished, floor_scene
from test_media import box

BELOW = [[1, 0, 0, 0], [0, 0, -1, 1], [0, 1, 0, 0], [0, 0, 0, 1]]


def glowing(value):
    """A black surface that emits a value of the light path."""
    nodes = [{"operation": {"LightPath": value}, "inputs": []}]
    black = {"Constant": [0.0] * 4}
    parameters = [["base_color", black], ["specular_weight", black], ["emission_color", {"Node": [0, "Rgb"]}]]
    return {"closures": [{"weight": {"Constant": [1.0] * 4}, "model": "OpenPbr", "parameters": parameters}], "graph": {"nodes": nodes}}


def ceiling(value, floor=None, camera=None):
    """A ceiling 4 m up that emits the value, and a floor; the camera hangs in between."""
    scene = gonio.Scene()
    scene.set(width=8, height=8, samples=64, passes=["color"], filter="box")
    mesh = scene.add_mesh(FLOOR, QUAD)
    scene.add_instance(mesh, [scene.put_material(glowing(value))], transform=at(0, 4, 0))
    if floor is not None:
        scene.add_instance(mesh, [scene.add_material("floor", **floor)])
    scene.add_camera(above(2) if camera is None else camera, fov=2)
    return np.asarray(finished(scene)["color"])[..., :3]


@pytest.fixture(scope="module")
def unit():
    """What an emission of 1 looks like: emission is given in nits."""
    return float(ceiling("IsCameraRay", camera=BELOW).mean())


SEEN = {"IsCameraRay": 1, "IsReflectionRay": 0, "IsGlossyRay": 0, "IsSingularRay": 0, "IsDiffuseRay": 0, "IsShadowRay": 0}
SEEN |= {"RayDepth": 0, "RayLength": 3}
MIRRORED = {"IsCameraRay": 0, "IsReflectionRay": 1, "IsGlossyRay": 1, "IsSingularRay": 1, "IsDiffuseRay": 0, "IsTransmissionRay": 0}
MIRRORED |= {"RayDepth": 1, "GlossyDepth": 1, "DiffuseDepth": 0, "RayLength": 4}
MIRROR = {"base_color": (1.0, 1.0, 1.0), "metalness": 1.0, "specular_roughness": 0.0}


@pytest.mark.parametrize(("value", "expected"), SEEN.items())
def test_rays_of_the_camera(value, expected, unit):
    assert np.allclose(ceiling(value, camera=BELOW), expected * unit, rtol=2e-3)


@pytest.mark.parametrize(("value", "expected"), MIRRORED.items())
def test_rays_from_a_mirror(value, expected, unit):
    assert np.allclose(ceiling(value, MIRROR), expected * unit, rtol=2e-3, atol=1e-6)


SCATTERED = {"IsDiffuseRay": 1, "DiffuseDepth": 1, "IsReflectionRay": 1, "IsGlossyRay": 0, "IsCameraRay": 0}


@pytest.mark.parametrize(("value", "expected"), SCATTERED.items())
def test_rays_from_a_matt_floor(value, expected, unit):
    matt = {"base_color": (1.0, 1.0, 1.0), "specular_weight": 0.0}
    # The floor sees the square ceiling under this form factor: 10 m by 10 m at 4 m, from its middle.
    x = 5 / 4
    form = 4 / np.pi * x / np.hypot(1, x) * np.arctan(x / np.hypot(1, x))
    found = ceiling(value, matt)
    assert found.mean() == pytest.approx(expected * form * unit, rel=0.02, abs=1e-6)


def shaded(weight):
    """The floor's illuminance under a slab whose opacity reads node 1."""
    scene = floor_scene(samples=16)
    one = {"Constant": [1.0] * 4}
    nodes = [
        {"operation": {"LightPath": "IsShadowRay"}, "inputs": []},
        {"operation": "Subtract", "inputs": [one, {"Node": [0, "Rgb"]}]},
    ]
    parameters = [["base_color", {"Constant": [0.0] * 4}], ["geometry_opacity", weight]]
    slab = {"closures": [{"weight": {"Constant": [1.0] * 4}, "model": "OpenPbr", "parameters": parameters}], "graph": {"nodes": nodes}}
    scene.add_instance(scene.add_mesh(FLOOR, QUAD), [scene.put_material(slab)], transform=at(0, 1, 0))
    scene.add_camera(above(0.9), fov=60)
    return np.asarray(finished(scene)["illuminance"])[..., 0].mean()


def test_shadow_rays_pass_what_is_open_to_them_alone():
    open_slab, closed, none = (shaded(weight) for weight in ({"Node": [1, "R"]}, {"Constant": [1.0] * 4}, {"Constant": [0.0] * 4}))
    assert closed < 1e-3 * none
    assert open_slab == pytest.approx(none, rel=0.02)


@pytest.mark.parametrize(("value", "shines"), [("IsVolumeScatterRay", True), ("IsGlossyRay", False), ("IsReflectionRay", False), ("IsDiffuseRay", False)])
def test_rays_from_a_medium(value, shines):
    """A ceiling over fog that shines by what the ray is: those that fog sends are of their own kind."""
    scene = gonio.Scene()
    scene.set(width=8, height=8, samples=64)
    nodes = [{"operation": {"LightPath": value}, "inputs": []}]
    glow = {"weight": {"Constant": [1.0] * 4}, "model": "Emission", "parameters": [["emission_color", {"Node": [0, "Rgb"]}]]}
    scene.add_instance(scene.add_mesh(FLOOR, QUAD), [scene.put_material({"closures": [glow], "graph": {"nodes": nodes}})], transform=at(0, 4, 0))
    box(scene, (-3.0, 0.0, -3.0), (3.0, 2.0, 3.0), scattering=0.5)
    scene.add_camera(above(3), fov=20)
    assert (np.asarray(finished(scene)["color"])[..., :3].mean() > 0.0) == shines
