# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines of text beside the cursor."""

import blf
import gpu
from gpu_extras.batch import batch_for_shader

FONT = 0
SIZE = 14.0
PAPER = (0.05, 0.05, 0.05, 0.8)
INK = (1.0, 1.0, 1.0, 1.0)
# From the cursor to the label, and around its text, in pixels.
DISTANCE, MARGIN = 18, 8


def draw_label(at, lines) -> None:
    """Draws lines right above a point of the region, pixels from the lower left corner."""
    blf.size(FONT, SIZE)
    widths, height = [blf.dimensions(FONT, line)[0] for line in lines], 1.5 * SIZE
    left, bottom = at[0] + DISTANCE, at[1] + DISTANCE
    right, top = left + max(widths) + 2 * MARGIN, bottom + len(lines) * height + 2 * MARGIN
    shader = gpu.shader.from_builtin("UNIFORM_COLOR")
    corners = ((left, bottom), (right, bottom), (right, top), (left, top))
    gpu.state.blend_set("ALPHA")
    shader.uniform_float("color", PAPER)
    batch_for_shader(shader, "TRIS", {"pos": corners}, indices=((0, 1, 2), (0, 2, 3))).draw(shader)
    blf.color(FONT, *INK)
    for place, line in enumerate(reversed(lines)):
        blf.position(FONT, left + MARGIN, bottom + MARGIN + (place + 0.25) * height, 0)
        blf.draw(FONT, line)
    gpu.state.blend_set("NONE")
