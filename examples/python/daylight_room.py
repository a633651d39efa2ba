"""The daylight factor through a room with a window to the south, and a picture of a clear afternoon: `python daylight_room.py daylight_room.png`."""

import sys

import gonio
import numpy
import shapes

WIDTH, DEPTH, HEIGHT = 4.0, 6.0, 2.8
SILL, HEAD, WINDOW_WIDTH = 0.85, 2.45, 2.8
WORK_PLANE = 0.75
PLACE = (48.21, 16.37)


def add_quad(scene: gonio.Scene, corners: list[tuple[float, float, float]], reflectance: float) -> None:
    """A flat, matt quadrilateral."""
    material = scene.add_material(base_color=(reflectance,) * 3, specular_weight=0.0)
    mesh = scene.add_mesh(numpy.array(corners, "f4"), numpy.array([[0, 1, 2], [0, 2, 3]], "i4"))
    scene.add_instance(mesh, [material])


def room() -> gonio.Scene:
    """A room with reflectances of 0.7, 0.5 and 0.3 and an opening without glass in its south wall; y is up, south is +z."""
    scene = gonio.Scene()
    w, d, h = WIDTH / 2, DEPTH, HEIGHT
    add_quad(scene, [(-w, 0, d), (w, 0, d), (w, 0, 0), (-w, 0, 0)], 0.3)
    add_quad(scene, [(-w, h, 0), (w, h, 0), (w, h, d), (-w, h, d)], 0.7)
    add_quad(scene, [(-w, 0, 0), (w, 0, 0), (w, h, 0), (-w, h, 0)], 0.5)
    add_quad(scene, [(-w, 0, d), (-w, 0, 0), (-w, h, 0), (-w, h, d)], 0.5)
    add_quad(scene, [(w, 0, 0), (w, 0, d), (w, h, d), (w, h, 0)], 0.5)
    # The south wall about its window, 30 cm thick by the window's reveals.
    x = WINDOW_WIDTH / 2
    for left, right, low, high in ((-w, w, 0, SILL), (-w, w, HEAD, h), (-w, -x, SILL, HEAD), (x, w, SILL, HEAD)):
        add_quad(scene, [(left, low, d), (left, high, d), (right, high, d), (right, low, d)], 0.5)
    for a, b in (((-x, SILL), (x, SILL)), ((x, SILL), (x, HEAD)), ((x, HEAD), (-x, HEAD)), ((-x, HEAD), (-x, SILL))):
        add_quad(scene, [(*a, d), (*b, d), (*b, d + 0.3), (*a, d + 0.3)], 0.5)
    return scene


def furnish(scene: gonio.Scene) -> None:
    """A window frame with glazing bars, a board floor, and a table with two stools and a jug: what the sun draws with."""
    d, x = DEPTH, WINDOW_WIDTH / 2
    wood = scene.add_material(base_color=(0.62, 0.6, 0.56), specular_roughness=0.4)
    for left in (-x, -x / 3, x / 3, x - 0.06):
        shapes.put_box(scene, (left, SILL, d + 0.12), (left + 0.06, HEAD, d + 0.18), wood)
    for low in (SILL, SILL + 1.08, HEAD - 0.06):
        shapes.put_box(scene, (-x, low, d + 0.13), (x, low + 0.05, d + 0.17), wood)
    shapes.put_box(scene, (-x - 0.08, SILL - 0.04, d - 0.16), (x + 0.08, SILL, d), wood)
    grain = shapes.noise(64, 512, 5, 61)
    boards = numpy.stack([0.3 + 0.16 * grain, 0.19 + 0.1 * grain, 0.11 + 0.06 * grain], axis=-1).repeat(2, axis=0)
    boards[::32] *= 0.35
    oak = scene.add_material(
        base_color=scene.add_texture(boards.astype("f4"), colour_space="lin_rec709", tiles=(2, 7)), specular_roughness=0.33
    )
    w = WIDTH / 2
    shapes.quad(scene, [(-w, 0.002, 0), (-w, 0.002, d), (w, 0.002, d), (w, 0.002, 0)], oak)
    walnut = scene.add_material(base_color=(0.16, 0.085, 0.045), specular_roughness=0.3)
    shapes.put_box(scene, (-1.5, 0.7, 3.3), (-0.1, 0.74, 4.9), walnut)
    for corner in ((-1.44, 3.36), (-0.22, 3.36), (-1.44, 4.78), (-0.22, 4.78)):
        shapes.put_box(scene, (corner[0], 0, corner[1]), (corner[0] + 0.06, 0.7, corner[1] + 0.06), walnut)
    for z in (3.6, 4.35):
        seat = shapes.lathe(scene, [(0.0, 0.43), (0.17, 0.43), (0.18, 0.445), (0.17, 0.46), (0.0, 0.46)], 48)
        scene.add_instance(seat, [wood], transform=shapes.at(0.28, 0, z))
        leg = shapes.lathe(scene, [(0.02, 0.0), (0.02, 0.43)], 24)
        for turn in (0.3, 2.4, 4.5):
            scene.add_instance(leg, [wood], transform=shapes.at(0.28 + 0.12 * numpy.cos(turn), 0, z + 0.12 * numpy.sin(turn)))
    clay = scene.add_material(base_color=(0.7, 0.68, 0.64), specular_roughness=0.25)
    jug = shapes.round_profile([(0.0, 0.0), (0.06, 0.0), (0.095, 0.08), (0.075, 0.17), (0.045, 0.22), (0.06, 0.26), (0.052, 0.258), (0.04, 0.22)])
    scene.add_instance(shapes.lathe(scene, jug), [clay], transform=shapes.at(-0.75, 0.74, 4.25))
    bowl = shapes.round_profile([(0.0, 0.0), (0.05, 0.002), (0.12, 0.05), (0.13, 0.075), (0.125, 0.075), (0.11, 0.05), (0.0, 0.012)])
    blue = scene.add_material(base_color=(0.05, 0.14, 0.22), specular_roughness=0.15)
    scene.add_instance(shapes.lathe(scene, bowl), [blue], transform=shapes.at(-1.05, 0.74, 3.75))


def outside(scene: gonio.Scene) -> None:
    """A lawn one floor below, and trees at its end."""
    lawn = scene.add_material(base_color=(0.13, 0.19, 0.06), specular_weight=0.0)
    shapes.quad(scene, [(-300, -3.2, DEPTH + 1), (300, -3.2, DEPTH + 1), (300, -3.2, 400), (-300, -3.2, 400)], lawn)
    random = numpy.random.default_rng(3)
    crown = scene.add_points(random.normal(0.0, 0.33, (40, 3)).astype("f4"), random.uniform(0.5, 0.9, 40).astype("f4"))
    leaves = scene.add_material(base_color=(0.07, 0.13, 0.035), specular_weight=0.0)
    for x in numpy.arange(-70.0, 71.0, 7.0):
        size, z = random.uniform(5.0, 8.0), random.uniform(70.0, 95.0)
        place = numpy.diag([size, 0.85 * size, size, 1.0])
        place[:3, 3] = x + random.uniform(-2, 2), -1.5 + 0.3 * size, z
        scene.add_instance(points=crown, materials=[leaves], transform=place)


def finished(scene: gonio.Scene) -> gonio.Film:
    """The film of the whole render."""
    with gonio.Render(scene) as render:
        render.wait()
        return render.film()


def daylight_factors() -> list[tuple[float, float]]:
    """Metres from the window, and the illuminance there under the CIE's overcast sky over that outside in per cent."""
    scene = room()
    scene.set(width=64, height=256, samples=256, passes=["illuminance", "P"])
    sky = gonio.daylight(*PLACE, "2025-09-21T12:00+01:00", sky="overcast")
    scene.add_daylight(sky, up="Y")
    # A black strip in the work plane measures and reflects nothing; the camera looks down on it from the ceiling.
    strip = [(-0.2, WORK_PLANE, DEPTH), (0.2, WORK_PLANE, DEPTH), (0.2, WORK_PLANE, 0), (-0.2, WORK_PLANE, 0)]
    add_quad(scene, strip, 0.0)
    down = gonio.look_at((0, HEIGHT - 0.01, DEPTH / 2), (0, 0, DEPTH / 2), (0, 0, -1))
    scene.add_camera(down, fov=115.0)
    film = finished(scene)
    lux, points = numpy.asarray(film["illuminance"])[..., 0], numpy.asarray(film["P"])
    on_strip = numpy.abs(points[..., 1] - WORK_PLANE) < 1e-3
    found = []
    for place in (0.5, 1.0, 2.0, 3.0, 4.0, 5.0):
        near = on_strip & (numpy.abs(DEPTH - points[..., 2] - place) < 0.1)
        found.append((place, 100.0 * float(lux[near].mean()) / sky.diffuse_illuminance))
    return found


def main() -> None:
    """Prints the daylight factors and writes the picture."""
    for place, factor in daylight_factors():
        print(f"{place:.1f} m from the window: daylight factor {factor:.1f} %")
    scene = room()
    furnish(scene)
    outside(scene)
    day = gonio.daylight(*PLACE, "2025-09-21T15:10+02:00", ground=0.2)
    print(day)
    scene.add_daylight(day, up="Y")
    scene.set(width=960, height=640, samples=64)
    # From the back of the room towards the window, turned to the wall that the sun meets.
    scene.add_camera(gonio.look_at((1.35, 1.5, 0.45), (-0.85, 1.12, 5.2)), fov=50.0)
    shapes.finished(scene, sys.argv[1] if len(sys.argv) > 1 else "daylight_room.png", exposure=0.4, white=9.0)


if __name__ == "__main__":
    main()
