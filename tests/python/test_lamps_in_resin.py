"""Lamps, cameras and meters inside what absorbs: Beer's and Lambert's law along every way that light is followed."""

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, at, ball, finished
from test_absorbing_volumes import closure, filled

# Half of the light is left after so many metres.
DEPTH = 0.5
HALF = dict(transmission_color=(0.5,) * 3, transmission_depth=DEPTH)
LUMENS = 1000.0


def resin(scene, **parameters):
    """Clear but for its tint; with the index of air unless another is asked for."""
    clear = dict(transmission_weight=1.0, specular_roughness=0.0, specular_ior=1.0)
    return scene.add_material("resin", **{**clear, **HALF, **parameters})


def cube(scene, material, middle, side=1.0):
    corners = (np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], "f4") * side / 2).astype("f4")
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    faces = np.array([half for a, b, c, d in sides for half in ((a, b, c), (a, c, d))], "i4")
    scene.add_instance(scene.add_mesh(corners, faces), [material], transform=at(*middle))


# Looking straight down, as small lamps as tell their place.
DOWN = [[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]]


def put(matrix, place):
    matrix = np.array(matrix, float)
    matrix[:3, 3] = place
    return matrix.tolist()


def glowing_square(scene, place):
    glow = scene.put_material({"origin": "glow", "closures": [closure("Emission", emission_color=1000.0)]})
    corners = np.array([[-1, 0, 1], [1, 0, 1], [1, 0, -1], [-1, 0, -1]], "f4") * 0.002
    scene.add_instance(scene.add_mesh(corners, QUAD), [glow], transform=at(*place))


LAMPS = {
    "sphere": lambda scene, place: scene.add_light("sphere", radius=0.002, lumens=LUMENS, transform=at(*place)),
    "point": lambda scene, place: scene.add_light("point", lumens=LUMENS, transform=at(*place)),
    "disk": lambda scene, place: scene.add_light("disk", radius=0.002, lumens=LUMENS, transform=put(DOWN, place)),
    "rectangle": lambda scene, place: scene.add_light("rectangle", width=0.004, height=0.004, lumens=LUMENS, transform=put(DOWN, place)),
    "cylinder": lambda scene, place: scene.add_light("cylinder", radius=0.002, length=0.004, lumens=LUMENS, transform=at(*place)),
    "mesh": glowing_square,
}


def goniometer(scene):
    return gonio.goniometer(scene, down=(0, -1, 0), error=0, rays=1 << 17, seed=3)


@pytest.mark.parametrize("lamp", LAMPS)
def test_goniometers_dim_lamps_of_every_kind(lamp):
    """Straight down the light comes through half of a cube's side."""

    def down(material):
        scene = gonio.Scene()
        LAMPS[lamp](scene, (0.0, 0.0, 0.0))
        if material:
            cube(scene, resin(scene), (0, 0, 0))
        found = goniometer(scene)
        return np.asarray(found.intensities)[:, 0].mean(), np.asarray(found.standard_errors)[:, 0].mean() / 2

    (dimmed, error), (bare, bare_error) = down(True), down(False)
    assert dimmed == pytest.approx(0.5 * bare, abs=4 * (error + bare_error) + 0.003 * bare)


def ball_in(parameters, index=1.5):
    """What a ball of resin lets out of a small lamp in its middle."""
    scene = gonio.Scene()
    points, triangles = ball(128)
    mesh = scene.add_mesh(points * np.float32(DEPTH), triangles, normals=points)
    scene.add_instance(mesh, [resin(scene, specular_ior=index, **parameters)])
    scene.add_light("sphere", radius=0.002, lumens=LUMENS)
    return goniometer(scene)


def test_a_ball_of_resin_keeps_what_it_absorbs():
    found = ball_in({})
    # Of 4 % that the surface reflects a quarter comes back to it, after twice the way.
    assert found.light_output_ratio.value == pytest.approx(0.96 * 0.5 / (1 - 0.04 * 0.25), rel=0.005)
    assert found.absorbed.value == pytest.approx(LUMENS * (1 - 0.4848), rel=0.005)
    assert ball_in({"transmission_depth": 0.0, "transmission_color": (1.0,) * 3}).light_output_ratio.value == pytest.approx(1.0, rel=1e-4)


def down_from(body=None):
    """Candela straight down of a lamp at a point; runs have the same paths."""
    scene = gonio.Scene()
    LAMPS["point"](scene, (0.0, 0.0, 0.0))
    if body:
        body(scene)
    return np.asarray(goniometer(scene).intensities)[:, 0].mean()


def test_what_fills_a_mesh_dims_lamps_inside():
    dimmed = down_from(lambda scene: filled(scene, (0, -0.5, 0), absorption=(2 * np.log(2),) * 3))
    assert dimmed / down_from() == pytest.approx(0.5, rel=0.005)


@pytest.mark.parametrize("meshes", [1, 2])
def test_a_bubble_around_the_lamp_absorbs_nothing(meshes):
    """A shell whose inner side looks inwards: 0.4 m of resin around 0.1 m of air."""
    scene = gonio.Scene()
    points, triangles = ball(64)
    outer, inner = (points * np.float32(0.5), triangles, points), (points * np.float32(0.1), triangles[:, ::-1], -points)
    shells = [outer, inner]
    if meshes == 1:
        shells = [tuple(np.concatenate(both) for both in ((outer[0], inner[0]), (triangles, inner[1] + len(points)), (points, -points)))]
    material = resin(scene)
    for corners, faces, normals in shells:
        mesh = scene.add_mesh(corners, np.ascontiguousarray(faces, "i4"), normals=np.ascontiguousarray(normals))
        scene.add_instance(mesh, [material])
    scene.add_light("sphere", radius=0.002, lumens=LUMENS)
    assert goniometer(scene).light_output_ratio.value == pytest.approx(0.5**0.8, rel=0.005)


def test_the_innermost_of_solids_holds_the_lamp():
    def solids(scene):
        cube(scene, resin(scene, transmission_color=(0.1,) * 3), (0, 0, 0), side=0.5)
        cube(scene, resin(scene), (0, 0, 0), side=3.0)

    # 0.25 m of the inner one; what the path leaves leads to the open.
    assert down_from(solids) / down_from() == pytest.approx(0.1**0.5, rel=0.005)


def lit_floor(**settings):
    """A floor 2 m under a small lamp in a cube of resin, seen from aside of the cube."""
    scene = gonio.Scene()
    scene.set(width=8, height=8, passes=["color"], **settings)
    floor = scene.put_material({"origin": "floor", "closures": [closure("Diffuse", base_color=1.0)]})
    scene.add_instance(scene.add_mesh(FLOOR, QUAD, name="floor"), [floor], name="floor")
    scene.add_light("sphere", radius=0.002, lumens=LUMENS, transform=at(0, 2, 0), visible=False)
    cube(scene, resin(scene), (0, 2, 0))
    matrix = np.eye(4)
    matrix[:3, 0], matrix[:3, 1], matrix[:3, 2], matrix[:3, 3] = RIGHT, np.cross(BACK, RIGHT), BACK, EYE
    scene.add_camera(matrix.tolist(), fov=FOV)
    return scene


BACK, RIGHT, EYE, FOV = np.array([3.0, 1.0, 0.0]) / np.sqrt(10.0), np.array([0.0, 0.0, -1.0]), np.array([2.4, 0.8, 0.0]), 6.0


def lux(x, z):
    """On the floor: half a metre of resin straight down, more aslant."""
    aslant = np.sqrt(1 + (x**2 + z**2) / 4)
    return LUMENS / (4 * np.pi) / 4 / aslant**3 * 0.5**aslant


def lux_in_view():
    """The mean over what the camera sees."""
    u, v = np.meshgrid(*[np.tan(np.radians(FOV / 2)) * ((np.arange(64) + 0.5) / 32 - 1)] * 2)
    to = u[..., None] * RIGHT + v[..., None] * np.cross(BACK, RIGHT) - BACK
    met = EYE - to * (EYE[1] / to[..., 1:2])
    return lux(met[..., 0], met[..., 2]).mean()


@pytest.mark.parametrize("integrator", ["path", "light"])
def test_pictures_of_what_the_lamp_lights(integrator):
    film = finished(lit_floor(samples=96, integrator=integrator, max_bounces=3))
    assert np.asarray(film["color"])[..., :3].mean() == pytest.approx(lux_in_view() / np.pi, rel=0.02)


def test_maps_of_what_the_lamp_lights():
    maps = gonio.illumination_map(lit_floor(max_bounces=1), texel=0.2, error=0, paths=1 << 19)
    floor = maps.surfaces[0]
    x, _, z = np.asarray(floor.corners).reshape(-1, 3, 3).mean(axis=1).T
    near = np.hypot(x, z) < 0.3
    assert np.asarray(floor.illuminance()).ravel()[near].mean() == pytest.approx(lux(x[near], z[near]).mean(), rel=0.03)


def test_lamps_seen_in_the_resin_are_dimmed():
    scene = gonio.Scene()
    scene.set(width=4, height=4, samples=64, passes=["color"])
    scene.add_light("sphere", (100.0,) * 3, radius=0.01)
    cube(scene, resin(scene), (0, 0, 0))
    scene.add_camera(above(8), fov=0.05)
    # The lamp's surface is 1 cm nearer than its middle.
    assert np.asarray(finished(scene)["color"])[..., :3].mean() == pytest.approx(100.0 * 0.5**0.98, rel=2e-3)


def inside(tinted, measure):
    """A white wall 0.4 m before a lamp, a camera or a meter between them; all in one cube of resin."""
    scene = gonio.Scene()
    scene.set(width=4, height=4, samples=256, passes=["color"], max_bounces=0)
    white = scene.put_material({"origin": "wall", "closures": [closure("Diffuse", base_color=1.0)]})
    scene.add_instance(scene.add_mesh(FLOOR * np.float32(0.02), QUAD), [white])
    scene.add_light("sphere", radius=0.002, lumens=LUMENS, transform=at(0.01, 0.4, 0), visible=False)
    if tinted:
        cube(scene, resin(scene), (0, 0.1, 0))
    scene.add_camera(above(0.2), fov=1)
    scene.add_meter((0.0, 0.2, 0.0), normal=(0.0, 1.0, 0.0))
    return gonio.measure(scene).meters[0].value if measure else np.asarray(finished(scene)["color"])[..., :3].mean()


@pytest.mark.parametrize(("measure", "metres"), [(True, 0.2), (False, 0.4 + 0.2)])
def test_cameras_and_meters_inside_are_dimmed(measure, metres):
    assert inside(True, measure) / inside(False, measure) == pytest.approx(0.5 ** (metres / DEPTH), rel=5e-3)


def test_light_leaves_subsurface_walks_into_what_the_path_came_through():
    """A slab of dense white wax in a filled box is dimmed as a white wall in its place is."""
    wax = dict(subsurface_weight=1.0, subsurface_color=1.0, subsurface_radius=1e-4, subsurface_radius_scale=1.0, specular_weight=0.0)

    def seen(body, absorption):
        scene = gonio.Scene()
        scene.set(width=8, height=8, samples=512, passes=["color"], max_bounces=4)
        material = scene.put_material({"origin": "wall", "closures": [closure(*body[:1], **body[1])]})
        scene.add_instance(scene.add_mesh(FLOOR * np.float32(0.1), QUAD), [material], transform=at(0, 0.5, 0))
        filled(scene, (0, 0, 0), absorption=absorption)
        scene.add_light("dome", (1.0,) * 3)
        scene.add_camera(above(4), fov=1)
        return np.asarray(finished(scene)["color"])[..., 0].mean()

    ratios = [seen(body, (0.7,) * 3) / seen(body, (0.0,) * 3) for body in (("OpenPbr", wax), ("Diffuse", {"base_color": 1.0}))]
    assert ratios[0] == pytest.approx(ratios[1], rel=0.01)
