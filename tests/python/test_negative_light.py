"""Lights and surfaces of negative radiance take light away: what is lit by them is the negative of what their opposites light."""

import gonio
import numpy as np
import pytest
from png_reader import png
from small_scenes import FLOOR, QUAD, above, at, ball, finished

PANEL = np.array([[-0.3, 0, 0.3], [0.3, 0, 0.3], [0.3, 0, -0.3], [-0.3, 0, -0.3]], "f4")
UV = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], "f4")
PASSES = ["color", "luminance", "illuminance", "diffuse_direct", "diffuse_indirect", "glossy_direct", "lightgroup:lamps"]


def downward(x, y, z):
    """A matrix whose −z points down."""
    return [[1, 0, 0, x], [0, 0, 1, y], [0, -1, 0, z], [0, 0, 0, 1]]


def glowing(scene, sign):
    """A material whose emission grows along a side."""
    st = {"operation": {"Primvar": {"name": "st", "fallback": [0.0] * 4}}, "inputs": []}
    scaled = {"operation": "Multiply", "inputs": [{"Node": [0, "R"]}, {"Constant": [600.0 * sign] * 4}]}
    closure = {"weight": {"Constant": [1.0] * 4}, "model": "Emission", "parameters": [["emission_color", {"Node": [1, "Rgb"]}]]}
    return scene.put_material({"origin": "glow", "closures": [closure], "graph": {"nodes": [st, scaled]}})


def light(scene, kind, strength, height=2.0):
    """A light of a kind above the middle of the floor."""
    radiance = np.array([1.0, 0.8, 0.6]) * strength
    place = downward(0, height, 0)
    sizes = {
        "point": (30.0, {"transform": at(0, 2, 0)}),
        "sphere": (300.0, {"transform": at(0, height, 0), "radius": 0.15}),
        "cylinder": (300.0, {"transform": at(0, height, 0), "radius": 0.05, "length": 0.8}),
        "rectangle": (200.0, {"transform": place, "width": 0.5, "height": 0.4}),
        "disk": (200.0, {"transform": place, "radius": 0.3}),
        "distant": (10.0, {"transform": downward(0, 0, 0), "angle": 2.0}),
        "dome": (3.0, {}),
    }
    if kind in sizes:
        factor, described = sizes[kind]
        scene.add_light(kind, tuple(radiance * factor), group="lamps", **described)
    elif kind == "panorama":
        sky = np.ones((8, 16, 3), "f4")
        sky[2, 3] = 30.0
        texture = scene.add_texture(sky, colour_space="lin_rec709")
        scene.add_light("dome", tuple(radiance), texture=texture, group="lamps")
    else:
        panel = scene.add_mesh(PANEL, QUAD, primvars={"st": UV})
        cover = glowing(scene, strength) if kind == "pattern" else scene.add_material(emission_color=tuple(radiance * 200.0), base_color=0.0)
        scene.put_instances(panel, [cover], np.array([at(0, 2, 0)], "f4"), light_group="lamps")


KINDS = ("point", "sphere", "cylinder", "rectangle", "disk", "distant", "dome", "panorama", "surface", "pattern")


def room(lights, **settings):
    """A floor with a rough metal ball and a glass one under lights: a kind, a strength, and a height if need be."""
    scene = gonio.Scene()
    scene.set(**{"width": 16, "height": 16, "samples": 16, "passes": PASSES, "threads": 2, **settings})
    grey = scene.add_material("grey", base_color=(0.5, 0.4, 0.3), specular_roughness=0.3)
    scene.add_instance(scene.add_mesh(FLOOR, QUAD, name="floor"), [grey], name="floor")
    points, triangles = ball(24)
    mesh = scene.add_mesh(points * 0.4, triangles, normals=points)
    metal = scene.add_material("metal", metalness=1.0, specular_roughness=0.2)
    glass = scene.add_material("glass", transmission_weight=1.0, specular_roughness=0.0)
    scene.add_instance(mesh, [metal], transform=at(-0.7, 0.4, 0))
    scene.add_instance(mesh, [glass], transform=at(0.7, 0.4, 0))
    for described in lights:
        light(scene, *described)
    scene.add_camera(above(3.5), fov=50)
    return scene


def passes(scene):
    film = finished(scene)
    return {name: np.asarray(film[name])[..., :3].astype(float) for name in PASSES}


CROWD = [(kind, 1.0 + 0.1 * number) for number in range(8) for kind in KINDS if kind not in ("dome", "panorama", "distant", "pattern")]
WAYS = {
    "one_by_one": {},
    "clamped": {"clamp_direct": 2.0, "clamp_indirect": 1.0},
    "caustics": {"caustics": "on"},
    "caustics_clamped": {"caustics": "on", "clamp_direct": 2.0, "clamp_indirect": 1.0},
    "adaptive": {"noise_threshold": 0.2, "min_samples": 4},
    "guided": {"guiding": "on", "samples": 32},
    "light": {"integrator": "light", "passes": ["color"]},
    "whitted": {"integrator": "whitted"},
}


@pytest.mark.parametrize("way", [*WAYS, "crowd"])
def test_what_takes_light_away_is_the_opposite_of_what_brings_it(way):
    lights = CROWD if way == "crowd" else [(kind, 1.0) for kind in KINDS if way != "light" or kind not in ("dome", "panorama")]
    settings = WAYS.get(way, {})
    films = [finished(room([(kind, sign * strength) for kind, strength in lights], **settings)) for sign in (1.0, -1.0)]
    for name in settings.get("passes", PASSES):
        bright, dark = (np.asarray(film[name])[..., :3] for film in films)
        # Trees of rays have no indirect light of diffuse surfaces.
        assert bright.max() > 0.0 or (way, name) == ("whitted", "diffuse_indirect"), name
        assert np.array_equal(dark, -bright), (name, np.abs(dark + bright).max())


# Surfaces hide each other.
@pytest.mark.parametrize("kind", [kind for kind in KINDS if kind not in ("surface", "pattern")])
def test_two_and_one_less_are_one(kind):
    settings = {"samples": 256, "max_bounces": 1, "caustics": "off"}
    # Rays that meet a lamp go on behind it.
    both, alone = passes(room([(kind, 2.0), (kind, -1.0, 1.999)], **settings)), passes(room([(kind, 1.0)], seed=5, **settings))
    for name in ("color", "illuminance", "lightgroup:lamps"):
        right = alone[name].mean()
        assert both[name].mean() == pytest.approx(right, rel=0.08), name


def test_lux_under_a_point_that_takes_away():
    """A point of −8 cd at 2 m beside a sun of 5 lx."""
    scene = gonio.Scene()
    scene.add_instance(scene.add_mesh(FLOOR, QUAD, name="floor"), [scene.add_material(base_color=0.0, specular_weight=0.0)])
    scene.add_light("point", (-8.0,) * 3, transform=at(0, 2, 0))
    scene.add_light("distant", (5.0,) * 3, transform=downward(0, 0, 0), angle=0.0)
    for x in (0.0, 3.0):
        scene.add_meter((x, 0, 0), normal=(0, 1, 0))
    found = [meter.value for meter in gonio.measure(scene).meters]
    assert found == pytest.approx([5.0 - 8.0 / 4.0, 5.0 - 8.0 * 2.0 / 13.0**1.5], rel=1e-3)
    (floor,) = gonio.illumination_map(scene, texel=1.0, error=0, paths=1 << 18).surfaces
    corners = np.asarray(floor.corners).reshape(-1, 3, 3)
    middles = corners.mean(axis=1)
    right = 5.0 - 8.0 * 2.0 / (middles[:, 0] ** 2 + middles[:, 2] ** 2 + 4.0) ** 1.5
    errors = np.asarray(floor.standard_errors())
    assert np.abs(np.asarray(floor.illuminance()) - right).mean() < 2.0 * errors.mean()


def test_lumens_are_taken_away_by_the_sign_of_the_colour():
    def lux(radiance, **quantity):
        scene = gonio.Scene()
        scene.add_light("point", radiance, transform=at(0, 2, 0), **quantity)
        scene.add_meter((0, 0, 0), normal=(0, 1, 0))
        return gonio.measure(scene).meters[0].value

    assert lux((-1.0,) * 3, lumens=400.0) == pytest.approx(-400.0 / (4.0 * np.pi) / 4.0)
    assert lux((1.0,) * 3, lumens=400.0) == pytest.approx(400.0 / (4.0 * np.pi) / 4.0)


@pytest.mark.parametrize("kind", ["sphere", "surface", "pattern"])
def test_goniometers_refuse_what_takes_away(kind):
    scene = gonio.Scene()
    light(scene, kind, -1.0)
    with pytest.raises(gonio.Error, match="intensities are zero or more"):
        gonio.goniometer(scene, down=(0, -1, 0), error=0, rays=1 << 18)


def test_glare_of_lights_that_take_away_is_told():
    def rated(*strengths):
        scene = gonio.Scene()
        scene.add_light("dome", (25.0,) * 3)
        for strength in strengths:
            scene.add_light("sphere", (4000.0 * strength,) * 3, radius=0.1, transform=at(strength, 3, 1), name=f"lamp {strength}")
        scene.add_meter((0, 0, 0), facing=(0, 1, 0), quantity="ugr")
        found = gonio.measure(scene, samples=1024)
        return found.meters[0].value, [line for line in found.diagnostics if "no source of glare" in line[1]]

    (alone, nothing), (beside, told) = rated(0.5), rated(0.5, -0.5)
    assert beside == pytest.approx(alone, abs=0.05) and not nothing and len(told) == 1


def test_files_keep_what_is_negative_and_pictures_are_black(tmp_path):
    film = finished(room([("sphere", -1.0)], passes=["color"]))
    film.write_picture(tmp_path / "dark.png")
    pixels, _ = png(tmp_path / "dark.png")
    assert np.asarray(film["color"])[..., :3].min() < 0.0 and not pixels[..., :3].any()
