"""Light that clear glass and mirrors throw onto a matt floor, by light paths, as pictures show it: E = π L / ρ."""

import math

import confidence
import numpy
import pytest
from rooms import Plane, Room, facing

pytestmark = pytest.mark.validate

SECTION = "Caustics"
# So dark that hardly anything comes back from the glass.
REFLECTANCE = 0.002
FLOOR = Plane((0, 0, 0), (8, 0, 0), (0, 8, 0))
PATCH = Plane((1.2, 0.4, 0), (1.0, 0, 0), (0, 1.0, 0))
GRID, PARTS = (2, 2), 32
HEIGHT, CANDELA = 1.5, 100.0
INDEX = 1.5
# Of glass of index 1.5 at right angles.
R = 0.04
SAMPLES = 512


def sphere(radius: float, outward: bool, rings: int = 64):
    """Points, triangles and normals about the lamp; the normals are the exact sphere's."""
    theta = numpy.linspace(0.0, math.pi, rings + 1)[:, None]
    phi = numpy.arange(2 * rings)[None, :] * (math.pi / rings)
    unit = numpy.stack(numpy.broadcast_arrays(numpy.sin(theta) * numpy.cos(phi), numpy.sin(theta) * numpy.sin(phi), numpy.cos(theta)), -1)
    unit = unit.reshape(-1, 3)
    ring, sector = (part.ravel() for part in numpy.meshgrid(numpy.arange(rings), numpy.arange(2 * rings), indexing="ij"))
    following = (sector + 1) % (2 * rings)
    a, b, c, d = (r * 2 * rings + s for r, s in ((ring, sector), (ring, following), (ring + 1, following), (ring + 1, sector)))
    triangles = numpy.concatenate([numpy.stack([a, d, c], 1), numpy.stack([a, c, b], 1)]).astype("i4")
    if not outward:
        triangles, normals = triangles[:, ::-1].copy(), -unit
    else:
        normals = unit
    return (radius * unit + [0, 0, HEIGHT]).astype("f4"), triangles, normals.astype("f4")


def put_sphere(room: Room, radius: float, outward: bool, material: int) -> None:
    points, triangles, normals = sphere(radius, outward)
    room.scene.add_instance(room.scene.add_mesh(points, triangles, normals=normals), [material])


def glass(room: Room) -> int:
    return room.scene.add_material("glass", base_color=(1, 1, 1), transmission_weight=1.0, specular_roughness=0.0, specular_ior=INDEX)


def shell() -> Room:
    """A floor under the middle of a shell of glass of 20 and 25 cm, without its lamp."""
    room = Room()
    room.add(FLOOR, reflectance=REFLECTANCE)
    material = glass(room)
    put_sphere(room, 0.25, True, material)
    put_sphere(room, 0.20, False, material)
    return room


def from_a_point() -> numpy.ndarray:
    """I cos θ / d² over the cells of the patch."""
    points = PATCH.points(*GRID, PARTS) - [0, 0, HEIGHT]
    lux = CANDELA * HEIGHT / (points**2).sum(axis=-1) ** 1.5
    cells: numpy.ndarray = lux.reshape(GRID[1], PARTS, GRID[0], PARTS).mean(axis=(1, 3))
    return cells


def unpolarised(cosine: float) -> float:
    """What a solid pane lets through if light is unpolarised before each face, as rendered light is: 0.6 % less at 50° than with both
    polarisations followed."""
    inside = math.sqrt(1.0 - (1.0 - cosine**2) / INDEX**2)
    across = ((cosine - INDEX * inside) / (cosine + INDEX * inside)) ** 2
    along = ((INDEX * cosine - inside) / (INDEX * cosine + inside)) ** 2
    reflectance = 0.5 * (across + along)
    return (1 - reflectance) / (1 + reflectance)


def hold(case: str, reference: str, room: Room, expected: numpy.ndarray, samples: int = SAMPLES) -> None:
    room.scene.set(caustics="on")
    # A cell is many pixels, whose samples have places of their own.
    fine = (GRID[0] * PARTS, GRID[1] * PARTS)
    luminance = room.measured("luminance", PATCH, fine, samples, bounces=32)
    found = math.pi / REFLECTANCE * luminance.reshape(-1, GRID[1], PARTS, GRID[0], PARTS).mean(axis=(2, 4))
    confidence.hold(SECTION, case, reference, found, expected)


def test_a_point_in_a_shell_of_glass():
    """What the shell throws back goes through the middle and leaves on the other side."""
    room = shell()
    room.light("Point", CANDELA, (0, 0, HEIGHT))
    hold("point lamp in the middle of a glass shell", "I cos θ / d²", room, from_a_point())


def test_a_black_lamp_in_a_shell_of_glass():
    """A lamp that takes what comes back."""
    room = shell()
    radius = 0.05
    put_sphere(room, radius, True, room.matt(0.0))
    radius *= 1.003
    room.light({"Sphere": {"radius": radius}}, CANDELA / (math.pi * radius**2), (0, 0, HEIGHT))
    case, reference = "point lamp in the middle of a glass shell, what comes back absorbed", "I cos θ / d² · (1 − R) / (1 + R)"
    hold(case, reference, room, from_a_point() * (1 - R) / (1 + R))


@pytest.mark.parametrize("degrees", [0, 50])
def test_the_sun_through_a_pane(degrees):
    """A solid pane whose sides throw nothing onto the patch."""
    room = Room()
    room.add(FLOOR, reflectance=REFLECTANCE)
    corners = numpy.array([[-1, -1], [2.5, -1], [2.5, 2], [-1, 2]], "f4")
    points = numpy.concatenate([numpy.c_[corners, [z] * 4] for z in (0.31, 0.3)]).astype("f4")
    sides = [[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]]
    for a, b in ((0, 1), (1, 2), (2, 3), (3, 0)):
        sides += [[a, a + 4, b + 4], [a, b + 4, b]]
    room.scene.add_instance(room.scene.add_mesh(points, numpy.array(sides, "i4")), [glass(room)])
    angle = math.radians(degrees)
    room.light({"Distant": {"angle_deg": 0.53}}, 1e6, axes=facing((math.sin(angle), 0, -math.cos(angle))))
    lux = 1e6 * math.pi * math.sin(math.radians(0.265)) ** 2 * math.cos(angle) * unpolarised(math.cos(angle))
    hold(f"sun at {degrees}° through a pane of solid glass", "Fresnel's formulas, unpolarised at each face", room, numpy.full(GRID, lux))


def test_a_mirror_onto_the_floor():
    """A lamp before a mirror that stands on the floor: the source's image, seen through the mirror."""
    room = Room()
    room.add(FLOOR, reflectance=REFLECTANCE)
    mirror = room.scene.add_material("silver", base_color=(1, 1, 1), metalness=1.0, specular_roughness=0.0)
    room.add(Plane((-1.0, 0, 3), (0, 8, 0), (0, 0, 6)), material=mirror)
    room.light("Point", CANDELA, (0, 0, HEIGHT))
    points = PATCH.points(*GRID, PARTS) - [-2.0, 0, HEIGHT]
    lux = CANDELA * HEIGHT / (points**2).sum(axis=-1) ** 1.5
    expected = lux.reshape(GRID[1], PARTS, GRID[0], PARTS).mean(axis=(1, 3)) + from_a_point()
    hold("point lamp before a mirror", "I cos θ / d², twice", room, expected)
