# SPDX-License-Identifier: GPL-3.0-or-later
"""The Measured BSDF node: a file's measurement in Gonio, and what is nearest to it, or a shader of choice, in other engines."""

from pathlib import Path

import bpy
import gonio

from . import fallback_tree


def file_of(node) -> Path:
    """The file's absolute path; the library's folder counts for linked materials."""
    return Path(bpy.path.abspath(node.filepath, library=node.id_data.library))


class GonioShaderNodeMeasured(bpy.types.ShaderNodeCustomGroup):
    """Scattering as it was measured: MERL, RGL, pBRDF, UTIA, BSDF XML, Zemax and .gbsdf files"""

    bl_idname = "GonioShaderNodeMeasured"
    bl_label = "Measured BSDF"
    bl_width_default = 200.0

    filepath: bpy.props.StringProperty(
        name="File",
        description="The measurement: MERL, RGL, pBRDF, UTIA, BSDF XML, Zemax or .gbsdf",
        subtype="FILE_PATH",
        options={"PATH_SUPPORTS_BLEND_RELATIVE"},
        update=lambda self, context: self.read_file(),
    )
    status: bpy.props.StringProperty(name="Status", description="What the file holds, or why it cannot be read")
    is_readable: bpy.props.BoolProperty(name="Readable", description="Whether the file could be read when it was chosen")

    def init(self, context):
        self.node_tree = fallback_tree.shared()
        for name in fallback_tree.HIDDEN:
            self.inputs[name].hide = True
        self.status = "no file is chosen"

    def read_file(self):
        """Has other engines show the nearest surface that they know, and says what the file holds."""
        self.is_readable = False
        if not self.filepath:
            self.status = "no file is chosen"
            return
        path = file_of(self)
        try:
            measured = gonio.MeasuredBsdf.from_file(path)
            count = len(measured.channels)
            channels = "one channel" if count == 1 else f"{count} channels"
            self.status = f"{'isotropic' if measured.isotropic else 'anisotropic'}, {channels}"
            self.is_readable = True
            fallback_tree.fit(self, measured)
        except (OSError, gonio.Error) as problem:
            self.status = str(problem).removeprefix(f"{path}: ")

    def update(self):
        """Follows links: an unlinked input of a group has a value, where the nodes inside want to know that there is none."""
        for name, switch in fallback_tree.SWITCHES.items():
            # The sockets come one by one while a node is made.
            if name in self.inputs and switch in self.inputs:
                wanted = 1.0 if self.inputs[name].is_linked else 0.0
                if self.inputs[switch].default_value != wanted:
                    self.inputs[switch].default_value = wanted

    def draw_buttons(self, context, layout):
        layout.prop(self, "filepath", text="")
        layout.label(text=self.status, icon="NONE" if self.is_readable else "ERROR")

    def draw_label(self):
        return Path(self.filepath.removeprefix("//")).stem or self.bl_label
