"""What Blender can write into USD: meshes with Principled surfaces, lamps, a camera."""

from math import radians

import stage
from scenes_texture import coloured, colours


def usd_room() -> None:
    """A floor with a picture, a wall, balls of plastic and metal, an area light, a small ball of light and a sun."""
    stage.plane(coloured(colours()), size=8.0)
    stage.plane(stage.principled(Base_Color=(0.7, 0.5, 0.35), Roughness=0.9), location=(0.0, 2.0, 0.0), rotation=(radians(90), 0.0, 0.0))
    stage.ball(stage.principled(Base_Color=(0.15, 0.4, 0.7), Roughness=0.4), 0.6, location=(-0.8, 0.2, 0.6))
    stage.ball(stage.principled(Base_Color=(0.9, 0.7, 0.4), Metallic=1.0, Roughness=0.4), 0.4, location=(0.2, -0.6, 0.4))
    stage.box(stage.principled(Base_Color=(0.3, 0.6, 0.3), Roughness=0.7), location=(1.1, 0.4, 0.5), rotation=(0.0, 0.0, 0.4))
    stage.lamp("AREA", 80.0, (-1.2, -1.6, 3.0), (0.5, -0.3, 0.5), shape="RECTANGLE", size=1.5, size_y=0.7)
    stage.lamp("POINT", 60.0, (1.6, -2.6, 2.6), shadow_soft_size=0.25, color=(0.4, 0.7, 1.0))
    stage.lamp("SUN", 0.5, (0.0, 0.0, 5.0), (0.7, -0.3, 0.4), angle=radians(5))
    stage.camera((0.0, -6.5, 2.4), (0.0, 0.3, 0.8), lens=50.0)
