# SPDX-License-Identifier: GPL-3.0-or-later
"""The view transform that shows pictures which are tone-mapped already: the display's curve and nothing else."""

import bpy

from .polling import can_run

# What Color Management must say.
STANDARD = {
    "view_transform": "Standard",
    "look": "None",
    "exposure": 0.0,
    "gamma": 1.0,
    "use_curve_mapping": False,
    "use_white_balance": False,
}


def is_standard(view) -> bool:
    """Whether a scene's view settings add the display's curve alone."""
    return all(getattr(view, name, value) == value for name, value in STANDARD.items())


def show_as_is(view) -> None:
    """Makes a scene's view settings add the display's curve alone."""
    for name, value in STANDARD.items():
        if hasattr(view, name):
            setattr(view, name, value)


class GONIO_OT_use_standard_view(bpy.types.Operator):
    """Show pictures as they are: the Standard view transform without look, exposure, gamma, curves and white balance"""

    bl_idname = "gonio.use_standard_view"
    bl_label = "Use the Standard View Transform"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return can_run(cls, (context.scene is not None, "There is no scene"))

    def execute(self, context):
        show_as_is(context.scene.view_settings)
        return {"FINISHED"}
