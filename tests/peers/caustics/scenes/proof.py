"""What path tracing finds too: a ball of glass and a mirror under a wide lamp. The maps that make references are held against it."""

from cornell import Diffuse, Glass, Mirror
from description import Camera, Light, Mesh, Rectangle, Scene
from lineup import BOUNCES
from shapes import ball, box, downward, facing, quad, room, smoothed

WALL = Diffuse((0.7, 0.68, 0.62))


def scene() -> Scene:
    """A closed room of 2 m."""
    left = quad("left", [(-1, 0, 1), (-1, 0, -1), (-1, 2, -1), (-1, 2, 1)], Diffuse((0.63, 0.065, 0.05)))
    meshes: list[Mesh] = [*room(1.0, 1.0, 2.0, WALL, WALL, WALL), left]
    meshes += [
        smoothed(ball("glass", (0.3, 0.45, 0.2), 0.35, Glass(1.5), 6)),
        box("mirror", (-0.45, 0.401, -0.4), (0.5, 0.8, 0.5), Mirror(0.9, 0.0), 20.0),
    ]
    lamp: list[Light] = [Rectangle(downward(0.0, 1.995, 0.0), 1.3, 1.1, (1000.0, 900.0, 750.0), (0.7, 0.68, 0.62))]
    return Scene(meshes, lamp, Camera(facing((0.2, 1.0, 0.95), (-0.1, 0.7, -0.6)), 75.0), width=96, height=96, bounces=BOUNCES)
