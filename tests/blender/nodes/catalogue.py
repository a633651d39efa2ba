"""Every shader node of Blender 4.5 and 5.0, and how each is held to Cycles. No Blender needed."""

import family_colour
import family_input
import family_maths
import family_noise
import family_texture
import family_vector
from case import Node

FAMILIES = (family_input, family_texture, family_noise, family_colour, family_vector, family_maths)
NODES: dict[str, Node] = {name: node for family in FAMILIES for name, node in family.NODES.items()}
