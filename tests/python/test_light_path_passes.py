"""Passes by light path expressions, and those of first surfaces that no material has to state."""

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, at, finished, floor_scene

PARTS = ["lpe:C<RD>L", "lpe:C<RD>.+L", "lpe:C<R[GS]>L", "lpe:C<R[GS]>.+L", "lpe:C<T[GS]>L", "lpe:C<T[GS]>.+L", "lpe:CO", "lpe:CB"]


def room(*passes, **settings):
    """A lit floor below glossy, glass and shining sheets, before a dome."""
    scene = floor_scene(**{"samples": 16, "passes": ["color", *passes], **settings})
    mesh = scene.add_mesh(FLOOR * np.float32(0.2), QUAD)
    made = {
        "mirror": {"metalness": 1.0, "specular_roughness": 0.2},
        "glass": {"transmission_weight": 1.0, "specular_roughness": 0.1},
        "lamp": {"base_color": (0.0, 0.0, 0.0), "specular_weight": 0.0, "emission_color": (40.0, 40.0, 40.0)},
    }
    for place, (name, parameters) in enumerate(made.items()):
        scene.add_instance(mesh, [scene.add_material(name, **parameters)], transform=at(place * 1.5 - 1.5, 1.0, 0.5), name=name)
    scene.add_light("dome", (20.0, 30.0, 40.0), name="sky")
    return scene


def values(film, name):
    return np.asarray(film[name]).astype("f8")


def test_parts_of_the_light_sum_up_to_the_colour():
    film = finished(room(*PARTS, "lpe:C.*", "lpe:C<RD>.*L", "lpe:C.+[LO]", "lpe:C[LOB]"))
    assert film["lpe:C.*"].channels == ["R", "G", "B"]
    colour, scale = values(film, "color")[..., :3], values(film, "color").max()
    parts = {name: values(film, name) for name in PARTS}
    # The glossy sheet sees nothing but the sky.
    lit = {name for name, part in parts.items() if part.max() > 1e-3 * scale}
    assert lit >= {"lpe:C<RD>L", "lpe:C<RD>.+L", "lpe:C<R[GS]>L", "lpe:C<T[GS]>.+L", "lpe:CO"}, lit
    assert abs(sum(parts.values()) - colour).max() < 1e-5 * scale
    assert abs(values(film, "lpe:C.*") - colour).max() < 1e-5 * scale
    assert abs(parts[PARTS[0]] + parts[PARTS[1]] - values(film, "lpe:C<RD>.*L")).max() < 1e-6 * scale
    assert abs(values(film, "lpe:C.+[LO]") + values(film, "lpe:C[LOB]") - colour).max() < 1e-5 * scale


def test_expressions_are_the_light_passes_without_the_division():
    film = finished(room("lpe:C<RD>L", "diffuse_direct", "diffuse_color"))
    assert np.allclose(values(film, "lpe:C<RD>L"), values(film, "diffuse_direct") * values(film, "diffuse_color"), rtol=1e-4, atol=1e-6)


def test_expressions_of_groups_are_the_groups():
    film = finished(room("lpe:C.*<L.'other'>"))
    assert film.passes == ["color", "lightgroup:other"]
    assert np.allclose(values(film, "lightgroup:other"), values(film, "color")[..., :3], rtol=1e-5)


@pytest.mark.parametrize("name", ["lpe:C<RD>", "lpe:C[", "lpe:", "lpe:C<RD'skin'>L"])
def test_expressions_that_cannot_be_shown_are_refused(name):
    with pytest.raises(gonio.SettingError, match="there is no pass"):
        room(name)


def test_passes_leave_the_colour_as_it_is():
    more = ["lpe:C<RD>L", "Neye", "Peye", "primvars:st", "ambient_occlusion", "cost", "cryptomatte_object", "instanceId", "elementId"]
    assert finished(room(*more))["color"].tobytes() == finished(room())["color"].tobytes()


def test_the_camera_space_is_that_of_the_camera():
    film = finished(floor_scene(passes=["Neye", "Peye", "depth", "alpha"]))
    assert film["Neye"].channels == ["R", "G", "B", "A"]
    assert np.allclose(values(film, "Neye"), [0.0, 0.0, 1.0, 1.0], atol=1e-5)
    assert np.allclose(values(film, "Peye")[..., 2], -8.0, atol=1e-4)
    assert np.allclose(-values(film, "Peye")[..., 2:3], values(film, "depth"), atol=1e-4)


def test_primvars_and_numbers_of_elements():
    scene = gonio.Scene()
    names = ["primvars:wear", "instanceId", "elementId", "primId"]
    scene.set(width=32, height=32, samples=4, filter="box", filter_width=0.01, passes=names)
    mesh = scene.add_mesh(FLOOR, QUAD, primvars={"wear": np.array([[0.25, 0.5, 8.0]] * 2, "f4")})
    moves = np.array([at(-5.1, 0, 0), at(5.1, 0, 0)], "f8")
    scene.put_instances(mesh, [], moves)
    scene.add_camera(above(20), fov=40)
    film = finished(scene)
    instance, element = values(film, "instanceId")[..., 0], values(film, "elementId")[..., 0]
    assert set(np.unique(instance)) == {-1.0, 0.0, 1.0} and set(np.unique(element)) == {-1.0, 0.0, 1.0}
    left, right = instance[:, :15], instance[:, 17:]
    assert set(np.unique(left)) <= {-1.0, 0.0} and set(np.unique(right)) <= {-1.0, 1.0}
    seen = instance >= 0
    assert (values(film, "primId")[..., 0] == np.where(seen, 0.0, -1.0)).all()


def test_primvars_of_surfaces_without_a_material_are_shown():
    scene = floor_scene(passes=["primvars:wear"])
    mesh = scene.add_mesh(FLOOR * np.float32(0.4), QUAD, primvars={"wear": np.array([[0.25, 0.5, 8.0]] * 2, "f4")})
    scene.put_instances(mesh, [], np.array([at(0, 0.1, 0)], "f8"))
    middle = values(finished(scene), "primvars:wear")[16, 16]
    assert np.allclose(middle, [0.25, 0.5, 8.0, 1.0])


def test_occlusion_of_a_floor_under_a_wide_sheet():
    # Under a disc-like sheet that fills the hemisphere nothing is open; without it all is; beyond the distance it does not count.
    def seen(height, distance):
        scene = floor_scene(passes=["ambient_occlusion"], samples=64, occlusion_distance=distance)
        if height:
            wide = scene.add_mesh(FLOOR * np.float32(40.0), QUAD)
            scene.put_instances(wide, [], np.array([at(0, height, 0)], "f8"), visibility={"camera": False})
        return values(finished(scene), "ambient_occlusion")[12:20, 12:20].mean()

    assert seen(None, 10.0) == pytest.approx(1.0, abs=1e-6)
    assert seen(1.0, 0.5) == pytest.approx(1.0, abs=1e-6)
    # Cosine-weighted rays up to a distance meet a plane at height h with probability (1 - h² / d²).
    assert seen(1.0, 2.0) == pytest.approx(0.25, abs=0.01)


def test_cost_shares_out_the_time():
    with gonio.Render(room("cost", width=128, height=128)) as render:
        assert render.wait()
        cost = values(render.film(), "cost")
    assert (cost >= 0.0).all() and 0.0 < cost.sum() < 600.0
