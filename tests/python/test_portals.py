"""Portals: what a camera sees through them, and what light does not."""

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, finished

# A screen 10 m beyond where rays go on, across them.
SCREEN = np.array([[110, -2, -2], [110, -2, 2], [110, 2, 2], [110, 2, -2]], "f4")


def constant(*xyz):
    return {"Constant": [*xyz, 1.0]}


def closure(model, **parameters):
    return {"weight": constant(1, 1, 1), "model": model, "parameters": [[name, constant(*value)] for name, value in parameters.items()]}


def scene(direction, **settings):
    """A floor that is a portal to x = 100 m, seen from above, and a shining screen beyond."""
    made = gonio.Scene()
    made.set(width=4, height=4, samples=4, passes=["color"], **settings)
    portal = closure("Portal", base_color=(0.5, 0.25, 1.0), portal_position=(100, 0, 0), portal_direction=direction)
    floor = made.put_material({"origin": "portal", "closures": [portal]})
    made.add_instance(made.add_mesh(FLOOR, QUAD), [floor])
    shining = made.put_material({"origin": "screen", "closures": [closure("Emission", emission_color=(2.0, 2.0, 2.0))]})
    made.add_instance(made.add_mesh(SCREEN, QUAD), [shining])
    made.add_camera(above(4), fov=10)
    return made


@pytest.mark.parametrize("integrator", ["path", "whitted"])
def test_rays_go_on_from_another_place(integrator):
    seen = np.asarray(finished(scene((3.0, 0.0, 0.0), integrator=integrator))["color"])[..., :3]
    assert np.allclose(seen, [1.0, 0.5, 2.0], rtol=1e-5)


def test_rays_go_straight_on_without_a_direction():
    # From above they go on downwards, past the screen.
    assert not np.asarray(finished(scene((0.0, 0.0, 0.0)))["color"])[..., :3].any()


def test_no_way_straight_through_is_no_way_through_a_portal():
    seen = finished(scene((1.0, 0.0, 0.0), max_transparent_bounces=0))["color"]
    assert not np.asarray(seen)[..., :3].any()
