# SPDX-License-Identifier: GPL-3.0-or-later
"""Renders the camera's view by wavelength, to a file."""

import time
from pathlib import Path

import bpy
import gonio
from bpy.props import BoolProperty, EnumProperty, IntProperty, StringProperty

from .. import report
from ..by_wavelength import Wanted, passes_by_wavelength
from ..properties.scene import MOST_SAMPLES
from ..session import handover
from ..session.status import clock
from .beside import Beside
from .named_file import end_name
from .polling import can_run, is_engine

# What the engine, its files and Blender raise.
FAILURES = (gonio.Error, OSError, ValueError, TypeError, RuntimeError, MemoryError)

BANDS = (
    ("5", "5 nm", "80 bands: the lines of fluorescent lamps apart", 5),
    ("10", "10 nm", "40 bands, half the time", 10),
    ("20", "20 nm", "20 bands, a quarter of the time. Radiance's .hsr takes these alone", 20),
)


class GONIO_OT_render_by_wavelength(Beside, bpy.types.Operator):
    """Render the camera's view as final renders do, band by band from 380 to 780 nm, and write spectral radiance in W/(m² sr nm) to a file"""

    bl_idname = "gonio.render_by_wavelength"
    bl_label = "Render by Wavelength"

    band: EnumProperty(
        name="Band Width", description="Width of each band, in nm; files of Radiance (.hsr) have 20 nm in any case", items=BANDS, default="10"
    )
    samples: IntProperty(
        name="Samples",
        description="Samples of each pixel in each band, those of the render settings if 0. Noise is of brightness and hardly of colour: "
        "a few go far. No noise threshold or time limit ends them",
        min=0,
        max=MOST_SAMPLES,
        default=0,
    )
    filepath: StringProperty(
        name="File",
        description="The picture's file: OpenEXR (.exr) with a channel for each band, or Radiance's spectral picture (.hsr)",
        subtype="FILE_PATH",
        options={"SKIP_SAVE"},
    )
    filter_glob: StringProperty(default="*.exr;*.hsr", description="Endings of pictures by wavelength", options={"HIDDEN"})
    check_existing: BoolProperty(
        name="Check Existing", description="Warn where a file would be written over", default=True, options={"HIDDEN"}
    )

    # Whether the user was asked for the file; then it is rendered beside Blender.
    _asked = False

    @classmethod
    def poll(cls, context):
        has_camera = context.scene is not None and context.scene.camera is not None
        is_free = not bpy.app.is_job_running("RENDER")
        return can_run(cls, is_engine(context), (has_camera, "The scene has no camera"), (is_free, "Blender is rendering"))

    def invoke(self, context, event):
        """Asks for the file and the options."""
        if not self.filepath:
            blend = Path(bpy.data.filepath) if bpy.data.filepath else Path.home() / "untitled"
            self.filepath = str(blend.with_name(f"{blend.stem}_{context.scene.frame_current:04d}.exr"))
        self._asked = True
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        """Scripts wait; those who were asked for a file may end it with ESC."""
        try:
            self._wanted = Wanted.checked(Path(bpy.path.abspath(self.filepath)), int(self.band))
            handed = handover.exported(context.scene, context.view_layer)
            self._said = handed.report
            handed.scene.set(passes=passes_by_wavelength(context.view_layer))
            if self.samples > 0:
                handed.scene.set(samples=self.samples)
            if self._asked and not bpy.app.background:
                self._begun = time.monotonic()
                return self._go(context, self._wanted.render, handed.scene)
            return self._publish(self._wanted.render(handed.scene))
        except FAILURES as problem:
            return self._fail(problem)

    def _tell(self, context):
        context.workspace.status_text_set(f"Gonio renders by wavelength, {clock(time.monotonic() - self._begun)}    ESC: Cancel")

    def _arrived(self, context, found):
        try:
            return self._publish(found.result())
        except FAILURES as problem:
            return self._fail(problem)

    def check(self, context):
        """Files that were named without an ending become OpenEXR ones."""
        return end_name(self, ".exr")

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(self, "band")
        layout.prop(self, "samples")

    def _publish(self, picture):
        self._said.add_render(picture.diagnostics)
        report.publish(self._said)
        line = self._wanted.line()
        if self._wanted.band != int(self.band):
            line = f"{line}, as Radiance reads 24 at most"
        summary = self._said.summary()
        self.report({"WARNING"} if summary else {"INFO"}, f"{line}; {summary}" if summary else line)
        return {"FINISHED"}
