# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures how light leaves some of a scene's objects, for light planning."""

from math import degrees, radians
from pathlib import Path

import bpy
import gonio
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty
from mathutils import Matrix

from .. import goniophotometer, measuring, report
from .beside import Beside
from .named_file import end_name
from .polling import can_run, is_engine

# What the engine, its files and Blender raise.
FAILURES = (gonio.Error, OSError, ValueError, TypeError, RuntimeError)
# Least gap in metres between a luminaire and the lamp that is put beside it.
GAP = 0.1

KINDS = (
    ("SELECTION", "Selection", "The selected objects, in the active one's axes", 0),
    ("CHILDREN", "Object and Children", "The active object and all below it, in its axes", 1),
    ("COLLECTION", "Collection", "The active collection with those in it, in the axes of its first object without a parent", 2),
)
SYMMETRIES = (
    ("AUTO", "Auto", "The highest symmetry that the standard errors bear out", 0),
    ("NONE", "None", "All C planes as they are", 1),
    ("ROTATIONAL", "Rotational", "The same in all C planes", 2),
    ("C0", "C0-C180", "The same on both sides of the plane C0-C180", 3),
    ("C90", "C90-C270", "The same on both sides of the plane C90-C270", 4),
    ("QUADRANTS", "Quadrants", "The same in all four quadrants", 5),
)


class GONIO_OT_measure_luminaire(Beside, bpy.types.Operator):
    """Measure how light leaves lamps, glowing surfaces, reflectors and covers, and write a luminaire's file. Its -Z is nadir, its +X C0"""

    bl_idname = "gonio.measure_luminaire"
    bl_label = "Measure Luminaire"
    bl_options = {"UNDO"}

    kind: EnumProperty(name="Luminaire", description="What belongs to the luminaire", items=KINDS, default="SELECTION")
    c_step: FloatProperty(
        name="C Step",
        description="Angle from C plane to C plane; a whole turn is a multiple of it",
        default=radians(15.0),
        min=radians(0.1),
        max=radians(360.0),
        step=100,
        subtype="ANGLE",
    )
    g_step: FloatProperty(
        name="γ Step",
        description="Angle from γ to γ; half a turn is a multiple of it. A tenth of a beam's width tells the beam's shape",
        default=radians(5.0),
        min=radians(0.1),
        max=radians(90.0),
        step=100,
        subtype="ANGLE",
    )
    symmetry: EnumProperty(
        name="Symmetry", description="Which C planes the file takes to be the same; their mean is noted", items=SYMMETRIES, default="AUTO"
    )
    error: FloatProperty(
        name="Error",
        description="Standard error of the peak and of the flux, in percent of them, at which the measurement ends; 0 traces all rays",
        default=1.0,
        min=0.0,
        max=50.0,
        precision=2,
        subtype="PERCENTAGE",
    )
    rays: FloatProperty(
        name="Most Rays (Millions)",
        description="Millions of rays after which the measurement ends in any case",
        default=200.0,
        min=0.01,
        max=1e6,
    )
    seed: IntProperty(
        name="Seed",
        description="Seed of the random numbers: another one gives another measurement of the same luminaire, which tells what noise is",
        default=0,
        min=0,
    )
    watts: FloatProperty(
        name="Power",
        description="Electrical power of the luminaire that the file states; 0 states none",
        default=0.0,
        min=0.0,
        unit="POWER",
    )
    use_lamp: BoolProperty(
        name="Add Lamp", description="Add a point lamp beside the luminaire that takes its photometry from the file", default=False
    )
    filepath: StringProperty(
        name="File",
        description="The luminaire's file: EULUMDAT (.ldt), IES (.ies), TM-33 (.xml) or GLDF (.gldf); without one the figures are told alone",
        subtype="FILE_PATH",
        options={"SKIP_SAVE"},
    )
    filter_glob: StringProperty(default="*.ldt;*.ies;*.xml;*.gldf", description="Endings of luminaires' files", options={"HIDDEN"})
    check_existing: BoolProperty(
        name="Check Existing", description="Warn where a file would be written over", default=True, options={"HIDDEN"}
    )

    # Whether the user was asked for the file; then light is traced beside Blender.
    _asked = False

    @classmethod
    def poll(cls, context):
        return can_run(cls, is_engine(context))

    def invoke(self, context, event):
        """Asks for the file and the options."""
        try:
            name = self._luminaire(context).name
        except ValueError as problem:
            return self._fail(problem)
        if not self.filepath:
            folder = Path(bpy.data.filepath).parent if bpy.data.filepath else Path.home()
            self.filepath = str(folder / f"{bpy.path.clean_name(name)}.ldt")
        self._asked = True
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        """Scripts wait; those who were asked for a file may end it with ESC."""
        try:
            self._check()
            luminaire = self._luminaire(context)
        except FAILURES as problem:
            return self._fail(problem)
        try:
            self._measurement = goniophotometer.Measurement(context.evaluated_depsgraph_get(), luminaire)
            if self._asked and not bpy.app.background:
                return self._go(context, self._measurement.run, **self._options(context))
            return self._publish(context, self._measurement.run(**self._options(context)))
        except FAILURES as problem:
            return self._fail(problem, luminaire.name)

    def _tell(self, context):
        words = self._measurement.describe_progress(0.01 * self.error)
        context.workspace.status_text_set(f"Gonio measures {self._measurement.luminaire.name}: {words}    ESC: Cancel")

    def _arrived(self, context, found):
        try:
            return self._publish(context, found.result())
        except FAILURES as problem:
            return self._fail(problem, self._measurement.luminaire.name)

    def check(self, context):
        """Files that were named without an ending become EULUMDAT ones."""
        return end_name(self, ".ldt")

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in ("kind", "c_step", "g_step", "symmetry", "error", "rays", "seed", "watts", "use_lamp"):
            layout.prop(self, name)

    def _luminaire(self, context):
        return goniophotometer.chosen(context.view_layer, context.collection, self.kind)

    def _check(self) -> None:
        """What can be known to be wrong before light is traced."""
        ending = Path(self.filepath).suffix
        if self.filepath and ending.lower() not in goniophotometer.ENDINGS:
            raise ValueError(f"{self.filepath}: the ending is '{ending}', expected {', '.join(goniophotometer.ENDINGS)}")
        if self.use_lamp and not self.filepath:
            raise ValueError("The lamp takes its photometry from a file: name one")

    def _options(self, context) -> dict:
        render = context.scene.render
        return {
            "c_step": round(degrees(self.c_step), 4),
            "g_step": round(degrees(self.g_step), 4),
            "error": 0.01 * self.error,
            "rays": int(1e6 * self.rays),
            "symmetry": self.symmetry.lower(),
            "seed": self.seed,
            "threads": render.threads if render.threads_mode == "FIXED" else 0,
        }

    def _publish(self, context, reading):
        luminaire, said = self._measurement.luminaire, self._measurement.report
        said.add_render(reading.diagnostics)
        report.publish(said)
        options = {"symmetry": self.symmetry.lower(), "name": luminaire.name, "watts": self.watts or None}
        if self.filepath:
            figures, left_out = goniophotometer.write(reading, Path(bpy.path.abspath(self.filepath)), **options)
            said.add_render([*reading.diagnostics, *left_out])
        else:
            figures = goniophotometer.figures_of(reading, **options)
        lines = goniophotometer.figure_lines(reading, figures)
        measuring.latest.luminaire = (luminaire.name, *lines)
        if self.use_lamp:
            _add_lamp(context.scene, luminaire, self.filepath, reading)
        self.report({"INFO"}, f"{luminaire.name}: {', '.join(lines)}")
        if self.error > 0.0 and not reading.converged:
            self.report({"WARNING"}, f"{luminaire.name}: the error is still above {self.error:.2g} % after {reading.rays:,} rays")
        return {"FINISHED"}


def _add_lamp(scene, luminaire, file, reading) -> None:
    """Puts a lamp that shines as the luminaire does beside it, along C0: within it, its parts would stand in the light's way."""
    light = bpy.data.lights.new(f"{luminaire.name} photometry", "POINT")
    light.gonio.file = file
    light.gonio.use_photometry = True
    lamp = bpy.data.objects.new(light.name, light)
    # Files have their opening's middle at the lamp's origin.
    (low, high), body = np.array(reading.opening), np.array(reading.body)
    place = 0.5 * (low + high)
    place[0] = body[1, 0] + 0.5 * (high[0] - low[0]) + max(0.25 * (body[1, 0] - body[0, 0]), GAP)
    scene.collection.objects.link(lamp)
    lamp.matrix_world = Matrix(luminaire.frame.tolist()) @ Matrix.Translation(place.tolist())
