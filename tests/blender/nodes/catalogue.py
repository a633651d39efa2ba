"""Every shader node of Blender 4.5 and 5.0, and how each is held to Cycles. No Blender needed."""

from . import (
    family_colour,
    family_input,
    family_maths,
    family_noise,
    family_shader,
    family_structure,
    family_texture,
    family_vector,
)
from .case import Node

FAMILIES = (family_input, family_texture, family_noise, family_colour, family_vector, family_maths, family_shader, family_structure)
NODES: dict[str, Node] = {name: node for family in FAMILIES for name, node in family.NODES.items()}
