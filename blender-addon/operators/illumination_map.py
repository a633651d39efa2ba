# SPDX-License-Identifier: GPL-3.0-or-later
"""Keeps the light that selected surfaces get: images over their UV maps, or attributes of their meshes."""

import bpy
import gonio
from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty

from .. import illumination, measuring, report
from .beside import Beside
from .polling import can_run, is_engine

# What the engine and Blender's own meshes and images raise.
FAILURES = (gonio.Error, ValueError, TypeError, RuntimeError, MemoryError)

TARGETS = (
    ("IMAGE", "Image", "An image of 32-bit floats over the active UV map, in lux", "IMAGE_DATA", 0),
    ("POINT", "Point Attribute", "An attribute of the mesh's points, in lux", "VERTEXSEL", 1),
    ("CORNER", "Face Corner Attribute", "An attribute of the faces' corners, in lux, which keeps edges sharp", "NORMALS_VERTEX_FACE", 2),
    ("FACE", "Face Attribute", "An attribute of the mesh's faces, in lux: their means", "FACESEL", 3),
)
QUANTITIES = (
    ("ILLUMINANCE", "Illuminance", "All light that arrives, in lux", 0),
    ("DIRECT", "Direct", "Light straight from lamps and sky, in lux", 1),
    ("INDIRECT", "Indirect", "Light that other surfaces have scattered, in lux", 2),
)
SIDES = (
    ("BRIGHTER", "Brighter", "The side that gets more light", 0),
    ("FRONT", "Front", "The side that the normals point to", 1),
    ("BACK", "Back", "The side that the normals point away from", 2),
)


class GONIO_OT_illumination_map(Beside, bpy.types.Operator):
    """Trace light to the selected surfaces, and keep how many lux each part of them gets in images or mesh attributes"""

    bl_idname = "gonio.illumination_map"
    bl_label = "Illumination Map"
    bl_options = {"UNDO"}

    target: EnumProperty(name="Target", description="Where the light is kept", items=TARGETS, default="IMAGE")
    quantity: EnumProperty(name="Quantity", description="Which light is kept", items=QUANTITIES, default="ILLUMINANCE")
    side: EnumProperty(name="Side", description="Which side of the faces is kept", items=SIDES, default="BRIGHTER")
    width: IntProperty(name="Width", description="Width of each image", default=256, min=1, max=16384, subtype="PIXEL")
    height: IntProperty(name="Height", description="Height of each image", default=256, min=1, max=16384, subtype="PIXEL")
    margin: IntProperty(
        name="Margin", description="Pixels by which values go beyond the faces, for filters", default=8, min=0, max=64, subtype="PIXEL"
    )
    texel: FloatProperty(
        name="Part Size",
        description="Side of the parts that triangles are divided into, of which corners take theirs; 0: about 65,000 parts in all",
        default=0.0,
        min=0.0,
        precision=3,
        unit="LENGTH",
    )
    output_name: StringProperty(
        name="Name", description="Name of the attribute; images have the object's name and this one", default="Illuminance"
    )
    error: FloatProperty(
        name="Error",
        description="Standard error of a part, in percent, averaged over what is lit, at which tracing ends; 0 traces all paths",
        default=5.0,
        min=0.0,
        max=50.0,
        precision=2,
        subtype="PERCENTAGE",
    )
    paths: FloatProperty(
        name="Most Paths (Millions)",
        description="Millions of light paths after which tracing ends in any case",
        default=50.0,
        min=0.01,
        max=1e4,
    )

    # Whether the user was asked; then light is traced beside Blender.
    _asked = False

    @classmethod
    def poll(cls, context):
        return can_run(cls, is_engine(context), (context.mode == "OBJECT", "Meshes take attributes in Object Mode alone"))

    def invoke(self, context, event):
        """Asks for the options."""
        self._asked = True
        return context.window_manager.invoke_props_dialog(self)

    def execute(self, context):
        """Scripts wait; those who were asked may end it with ESC."""
        try:
            depsgraph = context.evaluated_depsgraph_get()
            self._things = {thing.session_uid: thing for thing in context.view_layer.objects.selected}
            chosen = illumination.targets(depsgraph, self._things.values(), images=self.target == "IMAGE")
            self._mapping = illumination.Mapping(depsgraph, chosen, self._things)
            if self._asked and not bpy.app.background:
                context.workspace.status_text_set("Gonio maps the selected surfaces    ESC: Cancel")
                return self._go(context, self._mapping.run, **self._options())
            return self._publish(self._mapping.run(**self._options()))
        except FAILURES as problem:
            return self._fail(problem)

    def _arrived(self, context, found):
        try:
            return self._publish(found.result())
        except FAILURES as problem:
            return self._fail(problem)

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        own = ("width", "height", "margin") if self.target == "IMAGE" else ("texel",)
        for name in ("target", "quantity", "side", *own, "output_name", "error", "paths"):
            layout.prop(self, name)

    def _options(self) -> dict:
        options = {"side": self.side, "error": 0.01 * self.error, "paths": max(1, int(1e6 * self.paths))}
        if self.target == "IMAGE":
            return {**options, "resolution": (self.width, self.height)}
        return {**options, "texel": self.texel} if self.texel > 0.0 else options

    def _publish(self, found):
        report.publish(self._mapping.report)
        name = self.output_name or "Illuminance"
        for each in found:
            if self.target == "IMAGE":
                illumination.write_image(each, f"{each.target.name} {name}", self.quantity, self.margin)
            else:
                illumination.write_attribute(each, self._things[each.target.uid].data, name, self.quantity, self.target)
        lines = tuple(each.line() for each in found)
        measuring.latest.maps = lines
        rest = f" and {len(lines) - 1} more" if len(lines) > 1 else ""
        if self._mapping.notes:
            origin, message = self._mapping.notes[0]
            self.report({"WARNING"}, f"{lines[0]}{rest}; {origin}: {message}")
        else:
            self.report({"INFO"}, f"{lines[0]}{rest}")
        return {"FINISHED"}
