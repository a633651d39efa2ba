"""What Blender can write into USD: meshes with Principled surfaces, lamps, a camera.

What its export cannot say, or says otherwise, is left out: lamps whose temperature is off (they are written as of 6500 K), lamps that the camera
does not see, softness of spots, and suns beside other lamps (written with a quarter of their strength and half their angle).
"""

from math import radians

from scenes_texture import coloured, colours
from stage import ball, box, camera, lamp, plane, principled


def furniture() -> None:
    """A floor with a picture, a wall, balls of plastic and metal, a box."""
    plane(coloured(colours()), size=8.0)
    plane(principled(Base_Color=(0.7, 0.5, 0.35), Roughness=0.9), location=(0.0, 2.0, 0.0), rotation=(radians(90), 0.0, 0.0))
    ball(principled(Base_Color=(0.15, 0.4, 0.7), Roughness=0.4), 0.6, location=(-0.8, 0.2, 0.6))
    ball(principled(Base_Color=(0.9, 0.7, 0.4), Metallic=1.0, Roughness=0.4), 0.4, location=(0.2, -0.6, 0.4))
    box(principled(Base_Color=(0.3, 0.6, 0.3), Roughness=0.7), location=(1.1, 0.4, 0.5), rotation=(0.0, 0.0, 0.4))
    camera((0.0, -6.5, 2.4), (0.0, 0.3, 0.8), lens=50.0)


def warm(kind: str, energy: float, kelvin: float, location, rotation=(0.0, 0.0, 0.0), **fields) -> None:
    """A lamp of a temperature."""
    lamp(kind, energy, location, rotation, use_temperature=True, temperature=kelvin, **fields)


def usd_lamps() -> None:
    """A rectangle, a disk and a ball, of three temperatures."""
    furniture()
    warm("AREA", 80.0, 6500.0, (-1.2, -1.6, 3.2), (0.5, -0.3, 0.5), shape="RECTANGLE", size=1.5, size_y=0.7)
    warm("AREA", 40.0, 3500.0, (2.0, -2.0, 3.2), (0.4, 0.5, 0.0), shape="DISK", size=0.8)
    warm("POINT", 60.0, 9000.0, (1.2, -4.0, 3.6), shadow_soft_size=0.25, color=(0.6, 0.8, 1.0))


def usd_sun() -> None:
    """A sun, small enough that half its angle makes no difference."""
    furniture()
    warm("SUN", 3.0, 5000.0, (0.0, 0.0, 5.0), (0.7, -0.3, 0.4), angle=radians(0.5))
