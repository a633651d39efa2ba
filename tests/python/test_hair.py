"""Fibres of the hair model on curves and meshes: white ones vanish before a white world, and light paths bring what camera paths find."""

import numpy as np
import pytest

import gonio

SIZE, SAMPLES = 48, 64
BOUNCES = 200


def closure(model, **parameters):
    def constant(value):
        numbers = list(value) if isinstance(value, (list, tuple)) else [value] * 3
        return {"Constant": [*numbers, 1.0]}

    return {"weight": constant(1.0), "model": model, "parameters": [[name, constant(value)] for name, value in parameters.items()]}


def tuft(closures, shape="round", count=60, **settings):
    """Bent strands all over a picture, before a white dome."""
    scene = gonio.Scene()
    scene.set(width=SIZE, height=SIZE, samples=SAMPLES, max_bounces=BOUNCES, max_glossy_bounces=BOUNCES, max_transmission_bounces=BOUNCES, **settings)
    random = np.random.default_rng(1)
    roots, ways = random.uniform(-1, 1, (count, 3)), random.normal(size=(count, 3))
    bends = random.normal(size=(count, 3)) * 0.3
    t = np.linspace(-1, 1, 6)[None, :, None]
    points = (roots[:, None] + ways[:, None] * t + bends[:, None] * t * t).astype("f4").reshape(-1, 3)
    curves = scene.add_curves(points, np.full(count, 6, "i4"), 0.05, type="cubic", basis="catmullRom", wrap="pinned", shape=shape)
    material = scene.put_material({"origin": "hair", "closures": closures})
    scene.add_instance(None, [material], curves=curves)
    scene.add_light("dome", [1, 1, 1])
    scene.add_camera([[1, 0, 0, 0], [0, 0, 1, 6], [0, -1, 0, 0], [0, 0, 0, 1]], fov=25)
    return scene


def picture(scene, name="color"):
    with gonio.Render(scene) as render:
        assert render.wait()
        return np.asarray(render.film()[name])[..., :3]


def means(image):
    """Means of blocks of 8 × 8 pixels."""
    return image.reshape(SIZE // 8, 8, SIZE // 8, 8, 3).mean((1, 3, 4))


@pytest.mark.parametrize(("shape", "tilt"), [("round", 0.0), ("ribbon", 0.0), ("round", 0.1), ("ribbon", 0.1), ("ribbon", -0.1)])
def test_white_fibres_vanish_before_a_white_world(shape, tilt):
    image = picture(tuft([closure("Hair", hair_absorption=0.0, hair_tilt=tilt)], shape))
    # Every path keeps its weight; what bounces on for ever is lost with Russian roulette's noise.
    assert np.abs(means(image) - 1.0).max() < 0.02, means(image)
    assert abs(image.mean() - 1.0) < 0.003


@pytest.mark.parametrize("shape", ["round", "ribbon"])
def test_smooth_elliptic_fibres_vanish_too(shape):
    fibre = closure("HairElliptic", hair_absorption=0.0, hair_tilt=0.0, specular_roughness=0.3, hair_aspect=0.7, hair_turn=0.4)
    image = picture(tuft([fibre], shape))
    # Facets lose a hundredth under the round surface at each of many strands.
    assert np.abs(means(image) - 1.0).max() < 0.04, means(image)
    assert 0.98 < image.mean() < 1.003


def lit_by_a_sun(shape):
    """Dark strands under a sun of 10° and an even world."""
    scene = tuft([closure("Hair", hair_absorption=[0.25, 0.5, 1.4], hair_variance=[0.02, 0.005, 0.08], hair_scale=0.3)], shape)
    scene.truncate("lights", 0)
    scene.add_light("dome", [0.2] * 3)
    place = np.eye(4)
    # Light comes along −z; the other axes do not matter.
    place[:3, 2] = 0.8, 0.36, 0.48
    place[:3, 1] = -0.36 / 0.877268, 0.8 / 0.877268, 0.0
    place[:3, 0] = np.cross(place[:3, 1], place[:3, 2])
    scene.add_light("distant", [3] * 3, angle=10, transform=place.tolist())
    return picture(scene)


def test_ribbons_are_as_bright_as_tubes():
    tubes, ribbons = lit_by_a_sun("round"), lit_by_a_sun("ribbon")
    assert abs(ribbons.mean() / tubes.mean() - 1.0) < 0.02
    # No pixel shines out of all others: where R alone is left, at the edges, all light is reflected.
    assert ribbons.max() < 1.5 * tubes.max() and ribbons.max() < 2.0, (tubes.max(), ribbons.max())
    apart = np.abs(means(ribbons) - means(tubes)) / means(tubes)
    assert np.median(apart) < 0.05 and apart.max() < 0.3, apart


@pytest.mark.parametrize("model", ["HairReflection", "HairTransmission"])
def test_the_older_lobes_keep_all_light(model):
    image = picture(tuft([closure(model, base_color=1.0, hair_widths=[0.3, 0.6, 0.0], hair_tilt=0.0)]))
    # Directions along the fibre are left out.
    assert abs(image.mean() - 1.0) < 0.01


def test_absorbing_fibres_have_their_colour():
    image = picture(tuft([closure("Hair", hair_absorption=[0.1, 0.5, 2.0])], count=300))
    red, green, blue = image[12:-12, 12:-12].mean((0, 1))
    assert 1.0 > red > green > blue > 0.0


def test_light_behind_a_fibre_shines_through():
    # A tube before a lamp: what passes it is brighter in the middle than what it reflects at the same height.
    scene = gonio.Scene()
    scene.set(width=32, height=32, samples=64)
    line = np.array([[-3, 0, 0], [3, 0, 0]], "f4")
    curves = scene.add_curves(line, np.array([2], "i4"), 0.5)
    material = scene.put_material({"origin": "hair", "closures": [closure("Hair", hair_absorption=0.0)]})
    scene.add_instance(None, [material], curves=curves)
    scene.add_light("sphere", [100, 100, 100], radius=0.2, transform=[[1, 0, 0, 0], [0, 1, 0, -4], [0, 0, 1, 0], [0, 0, 0, 1]])
    scene.add_camera([[1, 0, 0, 0], [0, 0, 1, 6], [0, -1, 0, 0], [0, 0, 0, 1]], fov=4)
    behind = picture(scene).mean()
    assert behind > 0.0 and np.isfinite(behind)


def reflected_towards(side, tilt):
    """What a strand along x reflects to a view across it, of light that is 0.4 from across it towards x times `side`."""
    scene = gonio.Scene()
    scene.set(width=8, height=8, samples=64, max_bounces=0)
    curves = scene.add_curves(np.array([[-3, 0, 0], [3, 0, 0]], "f4"), np.array([2], "i4"), 0.5)
    lobes = closure("Hair", hair_tilt=tilt, hair_variance=0.02, hair_scale=0.5, hair_tint_tt=0.0, hair_tint_trt=0.0)
    scene.add_instance(None, [scene.put_material({"origin": "hair", "closures": [lobes]})], curves=curves)
    place = np.eye(4)
    place[:3, 2] = side * np.sin(0.4), -np.cos(0.4), 0.0
    place[:3, 1] = 0.0, 0.0, 1.0
    place[:3, 0] = np.cross(place[:3, 1], place[:3, 2])
    scene.add_light("distant", [1] * 3, angle=2, transform=place.tolist())
    scene.add_camera([[1, 0, 0, 0], [0, 0, -1, -6], [0, 1, 0, 0], [0, 0, 0, 1]], fov=3)
    return float(picture(scene).mean())


def test_scales_that_lean_to_the_root_reflect_light_from_there():
    # θi + θo is −2 tilts.
    root, tip = reflected_towards(-1.0, 0.2), reflected_towards(1.0, 0.2)
    assert root > 20.0 * tip > 0.0, (root, tip)
    assert reflected_towards(1.0, -0.2) == pytest.approx(root, rel=0.02)


def triangle_of_fibres(fibres, uvs, normals=None):
    """A triangle whose sides differ, under a sun, of the older lobe: what it shows hangs on where fibres lie."""
    scene = gonio.Scene()
    scene.set(width=16, height=16, samples=32)
    lobe = {**closure("HairReflection", base_color=1.0, hair_widths=[0.2, 0.3, 0.0]), "fibres": fibres}
    corners = np.array([[-3, 0, 3], [3, 0, 3], [-1, 0, -4]], "f4")
    mesh = scene.add_mesh(corners, np.array([[0, 1, 2]], "i4"), uvs=np.array(uvs, "f4"), normals=normals)
    scene.add_instance(mesh, [scene.put_material({"origin": "hair", "closures": [lobe]})])
    scene.add_light("distant", [3] * 3, angle=20, transform=[[1, 0, 0, 0], [0, 0.6, 0.8, 0], [0, -0.8, 0.6, 0], [0, 0, 0, 1]])
    scene.add_camera([[1, 0, 0, 0], [0, 0, 1, 8], [0, -1, 0, 0], [0, 0, 0, 1]], fov=5)
    return picture(scene)


def test_fibres_lie_along_an_edge_of_a_triangle():
    first, second = [[0, 0], [1, 0], [0, 1]], [[0, 0], [0, 1], [1, 0]]
    along = {edge: triangle_of_fibres(edge, first) for edge in ("Coordinate", "FirstEdge", "SecondEdge")}
    assert along["FirstEdge"].mean() > 0.0 and np.allclose(along["FirstEdge"], along["Coordinate"], rtol=1e-4)
    assert np.allclose(along["SecondEdge"], triangle_of_fibres("Coordinate", second), rtol=1e-4)
    assert not np.allclose(along["SecondEdge"].mean(), along["FirstEdge"].mean(), rtol=0.05)
    # They lie about the triangle's own normal.
    leaning = np.array([[0.3, 1.0, 0.0]] * 3, "f4")
    assert np.array_equal(along["FirstEdge"], triangle_of_fibres("FirstEdge", first, leaning))
