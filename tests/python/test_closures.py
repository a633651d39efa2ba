"""Materials as sums of closures, against closed forms: a large plane under a white dome shows its albedo, and what it emits and lets through."""

import numpy as np
import pytest

import gonio

SAMPLES = 256
PIXELS = 32 * 32


def closure(model, weight=1.0, **parameters):
    def constant(value):
        numbers = list(value) if isinstance(value, (list, tuple)) else [value] * 3
        return {"Constant": [*numbers, 1.0]}

    return {"weight": constant(weight), "model": model, "parameters": [[name, constant(value)] for name, value in parameters.items()]}


def plane(closures, sky=1.0, **settings):
    scene = gonio.Scene()
    scene.set(**{"width": 32, "height": 32, "samples": SAMPLES, **settings})
    points = np.array([[-50, 0, -50], [50, 0, -50], [50, 0, 50], [-50, 0, 50]], "f4")
    mesh = scene.add_mesh(points, np.array([[0, 2, 1], [0, 3, 2]], "i4"))
    material = scene.put_material({"origin": "plane", "closures": closures})
    scene.put_instances(mesh, [material], np.eye(4)[None])
    scene.add_light("dome", [sky] * 3)
    scene.add_camera([[1, 0, 0, 0], [0, 0, 1, 2], [0, -1, 0, 0], [0, 0, 0, 1]], fov=10)
    return scene


def mean(scene, name="color"):
    with gonio.Render(scene) as render:
        render.wait()
        values = np.asarray(render.film()[name])
        return values.reshape(-1, values.shape[2]).mean(0)


def close(found, expected):
    # Each sample lies between 0 and about 4, so five standard errors of the mean over all pixels and samples are below this.
    assert found == pytest.approx(expected, abs=5 * 2 / np.sqrt(SAMPLES * PIXELS))


def test_weights_add_up():
    half = closure("Diffuse", 0.5, base_color=0.8), closure("Diffuse", 0.5, base_color=0.2)
    close(mean(plane(half))[:3], [0.5] * 3)


def test_coloured_weights():
    close(mean(plane([closure("Diffuse", [1.0, 0.5, 0.0], base_color=0.8)]))[:3], [0.8, 0.4, 0.0])


def test_emission_beside_scattering():
    close(mean(plane([closure("Emission", emission_color=3.0), closure("Diffuse", base_color=0.5)]))[:3], [3.5] * 3)


@pytest.mark.parametrize("share", [0.0, 0.06, 1.0])
def test_what_a_thin_glow_emits_has_no_noise(share):
    """A transparent surface that emits beside, and covers by what it takes away: none of additive glow."""
    glow = closure("Emission", share or 1.0, emission_color=[3.0, 2.0, 1.0])
    scene = plane([closure("Transparent", 1.0 - share, base_color=1.0), glow], sky=0.0, samples=16)
    with gonio.Render(scene) as render:
        render.wait()
        colour = np.asarray(render.film()["color"])
    assert colour[..., :3] == pytest.approx(np.broadcast_to(np.array([3.0, 2.0, 1.0]) * (share or 1.0), (32, 32, 3)), rel=1e-5)
    assert colour[..., 3].mean() == pytest.approx(share, abs=5 * 0.5 / np.sqrt(16 * PIXELS))


def test_paths_are_not_spent_on_what_emits_alone():
    """Emission added to a diffuse surface leaves its noise as it was, and its albedo."""
    made = [closure("Diffuse", base_color=0.5)], [closure("Emission", emission_color=3.0), closure("Diffuse", base_color=0.5)]
    film = []
    for closures in made:
        with gonio.Render(plane(closures, passes=["color", "albedo"])) as render:
            render.wait()
            film.append({name: np.asarray(render.film()[name])[..., :3] for name in ("color", "albedo")})
    plain, lit = film
    assert lit["color"] - 3.0 == pytest.approx(plain["color"], abs=1e-5)
    assert lit["albedo"] == pytest.approx(plain["albedo"], abs=1e-5)


def test_transparent_closures_tint_what_is_behind():
    tinted = closure("Transparent", 0.5, base_color=[0.3, 0.5, 0.7]), closure("Diffuse", 0.5, base_color=0.5)
    close(mean(plane(tinted))[:3], [0.4, 0.5, 0.6])


def test_shadow_rays_pass_transparent_closures():
    scene = plane([closure("Diffuse", base_color=1.0)], passes=["illuminance"])
    points = np.array([[-50, 0.5, -50], [50, 0.5, -50], [50, 0.5, 50], [-50, 0.5, 50]], "f4")
    sheet = scene.add_mesh(points, np.array([[0, 2, 1], [0, 3, 2]], "i4"))
    # Half of the light comes through in its colour, the other half is swallowed.
    glass = scene.put_material({"origin": "sheet", "closures": [closure("Transparent", 0.5, base_color=0.6)]})
    scene.put_instances(sheet, [glass], np.eye(4)[None], visibility={"camera": False})
    # Straight up the sheet covers the dome but for a share of (0.5 / 50)² at its rim.
    assert mean(scene, "illuminance") == pytest.approx([np.pi * 0.3], abs=5 * np.pi / np.sqrt(SAMPLES * PIXELS) + 1e-3)


def test_no_closure_is_black_but_covers():
    scene = plane([])
    assert mean(scene).tolist() == [0.0, 0.0, 0.0, 1.0]


def test_holdouts_leave_a_hole():
    assert mean(plane([closure("Holdout")], film_transparent=True)).tolist() == [0.0] * 4


@pytest.mark.parametrize("model", ["Diffuse", "Glossy", "Glass", "Refraction", "Metallic", "Sheen", "Translucent", "Principled", "OpenPbr"])
def test_every_model_keeps_the_furnace(model):
    assert (mean(plane([closure(model)]))[:3] <= 1 + 0.01).all()


def refracted(angle, roughness, eta, count=400_000):
    """The part of light from an angle that facets (GGX) refract, which send back nothing, through an interface of an index; its standard error."""
    alpha, random = roughness**2, np.random.default_rng(5)
    wo = np.array([np.sin(angle), 0.0, np.cos(angle)])
    # Visible normals (Heitz 2018).
    view = wo * (alpha, alpha, 1.0)
    view /= np.linalg.norm(view)
    across = np.array([0.0, 1.0, 0.0])
    radius, turn = np.sqrt(random.random(count)), 2 * np.pi * random.random(count)
    x, y, share = radius * np.cos(turn), radius * np.sin(turn), 0.5 * (1.0 + view[2])
    y = (1.0 - share) * np.sqrt(1.0 - x**2) + share * y
    basis = np.stack([across, np.cross(view, across), view])
    normals = np.stack([x, y, np.sqrt(np.maximum(1.0 - x**2 - y**2, 0.0))], axis=1) @ basis
    normals = normals * (alpha, alpha, 1.0)
    normals[:, 2] = np.maximum(normals[:, 2], 1e-9)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    cosine = normals @ wo
    squared = 1.0 - (1.0 - cosine**2) / eta**2
    wi = normals * (cosine / eta - np.sqrt(np.maximum(squared, 0.0)))[:, None] - wo / eta

    def hidden(cosine):
        return 0.5 * (np.sqrt(1.0 + alpha**2 * (1.0 / cosine**2 - 1.0)) - 1.0)

    passes = (squared > 0.0) & (wi[:, 2] < 0.0) & (cosine > 0.0)
    own, other = hidden(wo[2]), hidden(np.minimum(wi[:, 2], -1e-6))
    found = np.where(passes, (1.0 + own) / (1.0 + own + other), 0.0)
    return found.mean(), found.std() / np.sqrt(count)


@pytest.mark.parametrize("roughness", [0.3, 0.8])
@pytest.mark.parametrize("degrees", [0, 45, 70])
@pytest.mark.parametrize("within", [False, True])
def test_rough_refraction_passes_what_its_facets_do(roughness, degrees, within):
    """From within also beyond the critical angle, where smooth ones pass nothing."""
    angle, side = np.radians(degrees), -1.0 if within else 1.0
    scene = plane([closure("Refraction", base_color=1.0, specular_roughness=roughness, specular_ior=1.33)], width=16, height=16, samples=1024, max_bounces=1, camera=1)
    scene.add_camera(gonio.look_at((5 * np.sin(angle), side * 5 * np.cos(angle), 0.0), (0, 0, 0), (0, 0, 1)), fov=0.1)
    with gonio.Render(scene) as render:
        render.wait()
        found = np.asarray(render.film()["color"])[..., 0].astype(float)
    expected, error = refracted(angle, roughness, 1.0 / 1.33 if within else 1.33)
    assert found.mean() == pytest.approx(expected, abs=4 * np.hypot(found.std() / 16, error) + 2e-4)


def test_light_passes_make_up_the_picture():
    kinds = "diffuse", "glossy", "transmission"
    parts = "direct", "indirect", "color"
    names = ["color", "emission", "environment", *(f"{kind}_{part}" for kind in kinds for part in parts)]
    mixed = [closure("Principled", base_color=0.6, specular_roughness=0.3), closure("Glass", 0.3), closure("Emission", emission_color=0.2)]
    scene = plane(mixed, passes=names)
    with gonio.Render(scene) as render:
        render.wait()
        film = {name: np.asarray(render.film()[name], dtype="f8") for name in names}
    lights = [(film[f"{kind}_direct"] + film[f"{kind}_indirect"]) * film[f"{kind}_color"] for kind in kinds]
    whole = film["emission"] + film["environment"] + sum(lights)
    assert whole == pytest.approx(film["color"][..., :3], rel=1e-4, abs=1e-5)


# Cycles 5.0's albedos of a closed box of 100 by 100 by 50 metres under a white sky, seen from above, with its standard error.
SUBSURFACE = {
    ("RandomWalkLegacy", 0.0): (0.76994, 0.44280, 0.16215),
    ("RandomWalkLegacy", 1.0): (0.77927, 0.46503, 0.19409),
    ("RandomWalkSkin", 0.0): (0.79247, 0.47779, 0.18456),
    ("RandomWalkSkin", 1.0): (0.79979, 0.49697, 0.21478),
}


@pytest.mark.parametrize(("method", "level"), SUBSURFACE)
def test_light_under_the_surface(method, level):
    corners = np.array([[x, y, z] for x in (-50, 50) for y in (-50, 50) for z in (-50, 0)], "f4")
    quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    triangles = np.array([[a, b, c] for a, b, c, _ in quads] + [[a, c, d] for a, _, c, d in quads], "i4")
    colour = [0.8, 0.5, 0.2]
    skin = closure("Principled", base_color=colour, subsurface_color=colour, subsurface_weight=1.0, subsurface_radius=[0.1, 0.05, 0.025])
    skin["parameters"] += [[name, {"Constant": [value] * 4}] for name, value in (("specular_weight", level), ("specular_roughness", 0.5))]
    scene = gonio.Scene()
    scene.set(width=16, height=16, samples=256, max_bounces=64)
    material = scene.put_material({"origin": "box", "closures": [skin | {"subsurface": method}]})
    scene.put_instances(scene.add_mesh(corners, triangles), [material], np.eye(4)[None])
    scene.add_light("dome", [1, 1, 1])
    scene.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 20], [0, 0, 0, 1]], fov=3)
    with gonio.Render(scene) as render:
        render.wait()
        pixels = np.asarray(render.film()["color"]).reshape(-1, 4)[:, :3]
    error = np.hypot(pixels.std(0) / 16, 1e-3)
    assert (np.abs(pixels.mean(0) - SUBSURFACE[method, level]) < 4.9 * error).all(), pixels.mean(0)


def test_a_dome_for_the_camera_alone_lights_nothing():
    scene = plane([closure("Diffuse", base_color=0.5)])
    dome = scene.to_dict()["lights"][0]
    dome["emission"]["radiance"] = [9.0] * 3
    dome["visibility"] |= {"diffuse": False, "glossy": False, "transmission": False}
    scene.put_light(dome)
    close(mean(scene)[:3], [0.5] * 3)


def test_unknown_descriptions_are_named():
    with pytest.raises(gonio.SettingError, match="material: the description is not understood"):
        gonio.Scene().put_material({"closures": [{"model": "Chrome"}]})


def test_elements_are_replaced_and_truncated():
    scene = plane([closure("Diffuse", base_color=0.2)])
    scene.put_material({"origin": "brighter", "closures": [closure("Diffuse", base_color=0.6)]}, index=0)
    close(mean(scene)[:3], [0.6] * 3)
    with pytest.raises(gonio.SettingError, match="number 7"):
        scene.put_material({"origin": "none"}, index=7)
    scene.truncate("instances", 0)
    assert scene.to_dict()["instances"] == []


def test_a_second_render_takes_over_what_has_not_changed():
    scene = plane([closure("Diffuse", base_color=0.5)])
    with gonio.Render(scene) as first:
        first.wait()
        scene.put_material({"origin": "plane", "closures": [closure("Diffuse", base_color=0.25)]}, index=0)
        with gonio.Render(scene, first) as second:
            second.wait()
            values = np.asarray(second.film()["color"])[..., :3]
    close(values.mean((0, 1)), [0.25] * 3)
