"""The daylight factor through a room with a window to the south, and a picture of a clear afternoon: `python daylight_room.py daylight_room.png`."""

import sys

import gonio
import numpy

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
    down = [[1, 0, 0, 0], [0, 0, 1, HEIGHT - 0.01], [0, -1, 0, DEPTH / 2], [0, 0, 0, 1]]
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
    day = gonio.daylight(*PLACE, "2025-09-21T14:30+02:00", ground=0.2)
    print(day)
    scene.add_daylight(day, up="Y")
    scene.set(width=480, height=360, samples=512, passes=["color"])
    # From the back of the room towards the window, turned a little to the wall that the sun meets.
    turn = numpy.radians(195.0)
    sine, cosine = numpy.sin(turn), numpy.cos(turn)
    scene.add_camera([[cosine, 0, sine, -1.2], [0, 1, 0, 1.5], [-sine, 0, cosine, 0.5], [0, 0, 0, 1]], fov=62.0)
    finished(scene).write_picture(sys.argv[1] if len(sys.argv) > 1 else "daylight_room.png")


if __name__ == "__main__":
    main()
