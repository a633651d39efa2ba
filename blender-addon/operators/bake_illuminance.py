# SPDX-License-Identifier: GPL-3.0-or-later
"""Bakes lux, for which Blender's own operator has no name."""

import bpy

from ..baking import wanted
from .polling import can_run, is_engine


def context_has_bytes() -> bool:
    """Whether images are baked to that cannot hold lux."""
    if bpy.context.scene.render.bake.target != "IMAGE_TEXTURES":
        return False
    materials = [slot.material for thing in bpy.context.selected_objects for slot in thing.material_slots if slot.material is not None]
    nodes = [material.node_tree.nodes.active for material in materials if material.node_tree is not None]
    images = [node.image for node in nodes if node is not None and getattr(node, "image", None) is not None]
    return any(not image.is_float for image in images)


class GONIO_OT_bake_illuminance(bpy.types.Operator):
    """Bake the illuminance of the selected objects, in lux, to their active images or vertex colours. Images are to hold floats"""

    bl_idname = "gonio.bake_illuminance"
    bl_label = "Bake Illuminance"

    @classmethod
    def poll(cls, context):
        is_open = is_engine(context)[0] and bpy.ops.object.bake.poll()
        return can_run(cls, is_engine(context), (is_open, "No mesh is active in Object Mode"))

    def execute(self, context):
        return self._bake("EXEC_DEFAULT")

    def invoke(self, context, _event):
        return self._bake("INVOKE_DEFAULT")

    def _bake(self, how):
        if context_has_bytes():
            self.report({"WARNING"}, "An active image holds bytes: lux above 1 are cut off. Use a 32-bit float image")
        wanted.set_kind("ILLUMINANCE")
        try:
            outcome = bpy.ops.object.bake(how, type="EMIT")
        except RuntimeError as problem:
            wanted.set_kind("")
            self.report({"ERROR"}, str(problem).strip())
            return {"CANCELLED"}
        # In the window it goes on by itself, and ends with a handler's call.
        if "RUNNING_MODAL" in outcome:
            return {"FINISHED"}
        wanted.set_kind("")
        return outcome
