"""An office under luminaires with louvres: long emitters in white troughs above crossed blades that are mirrors."""

from cornell import Diffuse, Mirror
from description import Camera, Light, Mesh, Rectangle, Scene
from lineup import BOUNCES
from shapes import box, downward, facing, quad, room

WALL = Diffuse((0.7, 0.7, 0.7))
CEILING, TROUGH = (0.8, 0.8, 0.8), (0.85, 0.85, 0.85)
BLADE = Mirror(0.9, 0.0)
X, Z, H = 2.4, 3.0, 2.8
# A luminaire's length and width, the height of blades and of the trough above them, blades across it, thickness.
LONG, WIDE, LOUVRE, DEEP, BLADES, THIN = 1.2, 0.3, 0.05, 0.06, 15, 0.001
PLACES = [(-1.1, -1.4), (1.1, -1.4), (-1.1, 1.1), (1.1, 1.1)]


def scene() -> Scene:
    """Desks below, seen from a corner."""
    meshes, lights = shell() + desks(), []
    for number, (x, z) in enumerate(PLACES):
        meshes += luminaire(number, x, z)
        lights += tubes(x, z)
    return Scene(meshes, lights, Camera(facing((1.9, 1.8, 2.7), (-0.6, 0.9, -1.2)), 62.0), width=192, height=144, bounces=BOUNCES)


def shell() -> list[Mesh]:
    """All six sides."""
    left = quad("left", [(-X, 0, Z), (-X, 0, -Z), (-X, H, -Z), (-X, H, Z)], WALL)
    return [*room(X, Z, H, Diffuse((0.25, 0.27, 0.3)), Diffuse(CEILING), WALL), left]


def desks() -> list[Mesh]:
    """Four, with a screen on each."""
    found = []
    for number, (x, z) in enumerate(PLACES):
        found.append(box(f"desk {number}", (x, 0.72, z), (1.5, 0.04, 0.8), Diffuse((0.6, 0.5, 0.38))))
        found.append(box(f"screen {number}", (x, 0.99, z - 0.2), (0.6, 0.38, 0.03), Diffuse((0.08, 0.08, 0.09))))
    return found


def luminaire(number: int, x: float, z: float) -> list[Mesh]:
    """A trough that hangs under the ceiling, and its louvre."""
    white, top = Diffuse(TROUGH), H - 0.2
    middle = top - (DEEP + LOUVRE) / 2
    parts = [box(f"top {number}", (x, top + 0.005, z), (LONG, 0.01, WIDE), white)]
    for side in (-1, 1):
        parts.append(box(f"side {number} {side}", (x, middle, z + side * (WIDE / 2 + 0.005)), (LONG + 0.02, DEEP + LOUVRE, 0.01), white))
        parts.append(box(f"end {number} {side}", (x + side * (LONG / 2 + 0.005), middle, z), (0.01, DEEP + LOUVRE, WIDE), white))
    height = top - DEEP - LOUVRE / 2
    for k in range(1, BLADES):
        parts.append(box(f"blade {number} {k}", (x + LONG * (k / BLADES - 0.5), height, z), (THIN, LOUVRE, WIDE - 0.002), BLADE))
    for k, dz in enumerate((-0.06, 0.06)):
        parts.append(box(f"rail {number} {k}", (x, height, z + dz), (LONG - 0.002, LOUVRE, THIN), BLADE))
    return parts


def tubes(x: float, z: float) -> list[Light]:
    """Two flat emitters close under the top of a trough."""
    return [Rectangle(downward(x, H - 0.2 - 0.003, z + dz), LONG - 0.1, 0.03, (9000.0, 9200.0, 9800.0), TROUGH) for dz in (-0.07, 0.07)]


def alone() -> Scene:
    """One luminaire in empty space, for what only follows light; the camera is far below."""
    view = Camera(facing((0.0, H - 3.2, 0.0), (0.0, H, 0.0), (0.0, 0.0, 1.0)), 30.0)
    return Scene(luminaire(0, 0.0, 0.0), tubes(0.0, 0.0), view, width=128, height=96, bounces=BOUNCES)
