"""A thousand lamps, each linked to its own room, against one lamp in one room: seconds of the same picture of one room.

Run with the Python that has gonio: `python tests/peers/linking/rooms.py [ROOMS]`. Rooms are closed boxes side by side, so that paths stay in the room
that the camera stands in, whose picture is the same however many others there are. They are measured twice: bare, as twelve triangles, where one
room is one node of a tree and whatever lies above it counts most; and with tables, chairs and shelves, a thousand triangles.
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


def block(low: tuple[float, float, float], high: tuple[float, float, float]) -> tuple[np.ndarray, np.ndarray]:
    """A box from corner to corner."""
    corners = np.array([[(low, high)[i][0], (low, high)[j][1], (low, high)[k][2]] for k in (0, 1) for j in (0, 1) for i in (0, 1)], np.float32)
    return corners, box()[1]


def piece(x: float, y: float, size: tuple[float, float, float], leg: float) -> list[tuple[np.ndarray, np.ndarray]]:
    """A top on four legs."""
    wide, deep, high = size
    parts = [block((x - wide, y - deep, high - leg), (x + wide, y + deep, high))]
    for i in (-1, 1):
        for j in (-1, 1):
            at = [x + i * (wide - leg), y + j * (deep - leg)]
            parts.append(block((at[0] - 0.5 * leg, at[1] - 0.5 * leg, 0.0), (at[0] + 0.5 * leg, at[1] + 0.5 * leg, high - leg)))
    return parts


def furnished() -> tuple[np.ndarray, np.ndarray]:
    """A closed room with a table, six chairs and two shelves of books."""
    parts = [box(), *piece(0.0, 0.1, (0.6, 0.4, 0.75), 0.05)]
    for i in (-1, 0, 1):
        for j in (-1, 1):
            chair = (0.42 * i, 0.1 + 0.62 * j)
            parts += piece(*chair, (0.17, 0.17, 0.45), 0.03)
            back = chair[1] + 0.16 * j
            parts.append(block((chair[0] - 0.17, back - 0.01, 0.5), (chair[0] + 0.17, back + 0.01, 0.9)))
    for side in (-1, 1):
        for board in range(5):
            x, z = side * 1.15, 0.1 + 0.4 * board
            parts.append(block((x - 0.15, -0.5, z), (x + 0.15, 1.3, z + 0.02)))
            books = (block((x - 0.1, -0.45 + 0.4 * k, z + 0.03), (x + 0.1, -0.15 + 0.4 * k, z + 0.3)) for k in range(4))
            parts += books
    first = np.cumsum([0, *(len(points) for points, _ in parts)])
    points = np.concatenate([points for points, _ in parts])
    return points, np.concatenate([triangles + start for (_, triangles), start in zip(parts, first, strict=False)]).astype(np.int32)


def scene(room: tuple[np.ndarray, np.ndarray], rooms: int, linked: bool) -> gonio.Scene:
    """That many rooms; the camera looks into the first."""
    made = gonio.Scene()
    mesh = made.add_mesh(*room)
    material = made.add_material(base_color=0.7, specular_weight=0.0)
    across = int(np.ceil(np.sqrt(rooms)))
    for number in range(rooms):
        x, y = ROOM * (number % across), ROOM * (number // across)
        made.put_instances(mesh, [material], np.array([[[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, 0], [0, 0, 0, 1]]], float))
        place = [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, 2.3], [0, 0, 0, 1]]
        lamp = made.add_light("rectangle", (20.0, 20.0, 20.0), width=0.6, height=0.6, transform=place, visible=False)
        if linked:
            made.link(light=lamp, receivers=[number])
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
    for kind, room in {"bare": box(), "furnished": furnished()}.items():
        print(f"{kind}, {len(room[1])} triangles")
        compare(room, rooms)


def compare(room: tuple[np.ndarray, np.ndarray], rooms: int) -> None:
    """One room, and many with and without links, by turns."""
    cases = {"one room": scene(room, 1, linked=False), f"{rooms} rooms, linked": scene(room, rooms, linked=True)}
    cases[f"{rooms} rooms, unlinked"] = scene(room, rooms, linked=False)
    found = {name: [] for name in cases}
    for _ in range(3):
        for name, made in cases.items():
            found[name].append(seconds(made))
    base = min(time for time, _ in found["one room"])
    for name, times in found.items():
        picture = times[0][1]
        print(f"  {name}: {min(time for time, _ in times):.2f} s, {min(time for time, _ in times) / base:.2f} of one room, mean {picture.mean():.4f}")


if __name__ == "__main__":
    main()
