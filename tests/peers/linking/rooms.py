"""A thousand lamps, each linked to its own room, against one lamp in one room: seconds of the same picture of one room.

Run with the Python that has gonio: `python tests/peers/linking/rooms.py [ROOMS]`. Rooms are closed boxes side by side, so that paths stay in the room
that the camera stands in, whose picture is the same however many others there are.
"""

import sys
import time

import gonio
import numpy as np

ROOM, SAMPLES, SIDE = 3.0, 64, 256


def box() -> tuple[np.ndarray, np.ndarray]:
    """A closed room."""
    x, y, z = 0.45 * ROOM, 0.45 * ROOM, 2.4
    corners = np.array([[i * x, j * y, k] for k in (0.0, z) for j in (-1, 1) for i in (-1, 1)], np.float32)
    quads = [(0, 1, 3, 2), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3), (0, 4, 5, 1), (4, 6, 7, 5)]
    triangles = [[(a, b, c), (a, c, d)] for a, b, c, d in quads]
    return corners, np.array(triangles, np.int32).reshape(-1, 3)


def scene(rooms: int, linked: bool) -> gonio.Scene:
    """That many rooms; the camera looks into the first."""
    made = gonio.Scene()
    mesh = made.add_mesh(*box())
    material = made.add_material(base_color=0.7, specular_weight=0.0)
    across = int(np.ceil(np.sqrt(rooms)))
    for room in range(rooms):
        x, y = ROOM * (room % across), ROOM * (room // across)
        made.put_instances(mesh, [material], np.array([[[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]]], float))
        place = [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, 2.3], [0, 0, 0, 1]]
        lamp = made.add_light("rectangle", (20.0, 20.0, 20.0), width=0.6, height=0.6, transform=place, visible=False)
        if linked:
            made.link(light=lamp, receivers=[room])
    made.add_camera([[1, 0, 0, 0], [0, 0, -1, -1.2], [0, 1, 0, 1.2], [0, 0, 0, 1]], fov=60)
    made.set(width=SIDE, height=SIDE, samples=SAMPLES, threads=1, max_bounces=4, passes=["color"])
    return made


def seconds(made: gonio.Scene) -> tuple[float, np.ndarray]:
    """Processor seconds of the picture, and the picture; the scene is compiled before."""
    rendering = gonio.Render(made)
    start = time.process_time()
    with rendering:
        rendering.wait()
        found = time.process_time() - start
        return found, np.asarray(rendering.film()["color"])[:, :, 1].astype(float)


def main() -> None:
    rooms = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
    cases = {"one room": scene(1, linked=False), f"{rooms} rooms, linked": scene(rooms, linked=True)}
    cases[f"{rooms} rooms, unlinked"] = scene(rooms, linked=False)
    found = {name: [] for name in cases}
    for _ in range(3):
        for name, made in cases.items():
            found[name].append(seconds(made))
    base = min(time for time, _ in found["one room"])
    for name, times in found.items():
        picture = times[0][1]
        print(f"{name}: {min(time for time, _ in times):.2f} s, {min(time for time, _ in times) / base:.2f} of one room, mean {picture.mean():.4f}")


if __name__ == "__main__":
    main()
