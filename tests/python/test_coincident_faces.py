"""Faces that lie on each other: whoever goes straight on through one of them meets the others, each once."""

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, at, finished, floor_scene

TINTS = [(0.9, 0.5, 0.2), (0.5, 0.9, 0.7), (0.7, 0.8, 0.9)]
TURNED = [[0.8, 0.48, 0.36, 0.1], [-0.6, 0.64, 0.48, 3.0], [0.0, -0.6, 0.8, 0.3], [0, 0, 0, 1]]
INTEGRATORS = ["path", "whitted"]


def constant(value):
    return {"Constant": [*(value if isinstance(value, tuple) else (value,) * 3), 1.0]}


def material(scene, model, **parameters):
    values = [[name, constant(value)] for name, value in parameters.items()]
    return scene.put_material({"origin": model, "closures": [{"weight": constant(1.0), "model": model, "parameters": values}]})


def shining_floor(**settings):
    """A floor of radiance 1, seen from 8 m above."""
    scene = gonio.Scene()
    scene.set(width=16, height=16, samples=16, passes=["color"], **settings)
    scene.add_instance(scene.add_mesh(FLOOR, QUAD), [material(scene, "Emission", emission_color=1.0)])
    scene.add_camera(above(8), fov=20)
    return scene


def sheets(scene, transform, sizes=(1.0, 0.8, 0.9)):
    """Tinted sheets that lie on each other."""
    for tint, size in zip(TINTS, sizes, strict=True):
        sheet = material(scene, "Transparent", base_color=tint)
        scene.add_instance(scene.add_mesh(FLOOR * np.float32(size), QUAD), [sheet], transform=transform)


def colour(scene):
    return np.asarray(finished(scene)["color"])[..., :3]


@pytest.mark.parametrize("transform", [at(0, 3, 0), TURNED], ids=["level", "turned"])
@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_tints_of_sheets_multiply(integrator, transform):
    scene = shining_floor(integrator=integrator)
    sheets(scene, transform)
    assert np.allclose(colour(scene), np.prod(TINTS, axis=0), rtol=1e-4)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_the_same_mesh_counts_as_often_as_it_is_there(integrator):
    scene = shining_floor(integrator=integrator)
    doubled = np.concatenate([FLOOR, FLOOR]), np.concatenate([QUAD, QUAD + 4])
    mesh, sheet = scene.add_mesh(*doubled), material(scene, "Transparent", base_color=0.5)
    for _ in range(3):
        scene.add_instance(mesh, [sheet], transform=TURNED)
    # A surface counts once where its own triangles meet, and few rays go there.
    assert np.median(colour(scene)) == pytest.approx(0.5**6, rel=1e-4)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("model", ["OpenPbr", "Transparent"])
def test_what_is_not_seen_hides_nothing_that_it_lies_on(integrator, model):
    scene = shining_floor(integrator=integrator)
    parameters = {"geometry_opacity": 0.0} if model == "OpenPbr" else {"base_color": 1.0}
    clear = material(scene, model, **parameters)
    for size in (1.0, 0.7, 0.7, 0.3):
        scene.add_instance(scene.add_mesh(FLOOR * np.float32(size), QUAD), [clear])
    assert np.allclose(colour(scene), 1.0, rtol=1e-4)


def test_light_paths_and_shadow_rays_meet_the_same():
    """Sheets between lamp and floor, the camera beneath them."""

    def lit(integrator, samples):
        scene = floor_scene(integrator=integrator, samples=samples, passes=["color"], max_bounces=1)
        sheets(scene, at(0, 1.5, 0))
        scene.add_camera(above(1.2), fov=60)
        return colour(scene).mean((0, 1))

    paths, by_light = lit("path", 64), lit("light", 1024)
    assert np.allclose(paths, by_light, rtol=0.03)
