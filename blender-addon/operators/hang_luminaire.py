# SPDX-License-Identifier: GPL-3.0-or-later
"""Luminaires by their makers' files: dropped on a viewport, or from the menu *Add*."""

from pathlib import Path

import bpy
import gonio
from bpy.props import BoolProperty, CollectionProperty, FloatProperty, FloatVectorProperty, StringProperty
from bpy_extras.view3d_utils import region_2d_to_location_3d, region_2d_to_origin_3d, region_2d_to_vector_3d
from mathutils import Vector

from .. import luminaire
from .point_meter import view_under
from .polling import can_run, is_engine

ENDINGS = (".ies", ".ldt", ".xml", ".gldf", ".gdtf")
# Metres before a surface, which would hide the lamp in it.
OFF = 0.005
# How level a surface is that lamps hang over, or hang from.
LEVEL = 0.5
# Smallest extent of a symbol in metres, and its stem's length.
SYMBOL, STEM = 0.1, 0.15


class GONIO_OT_hang_luminaire(bpy.types.Operator):
    """Add lights by luminaires' files, with a symbol each; dropped on a floor they hang under the ceiling above it"""

    bl_idname = "gonio.hang_luminaire"
    bl_label = "Luminaire"
    bl_options = {"REGISTER", "UNDO"}

    filepath: StringProperty(name="File", description="A luminaire's file", subtype="FILE_PATH", options={"HIDDEN", "SKIP_SAVE"})
    directory: StringProperty(name="Folder", description="Where the files are", subtype="DIR_PATH", options={"HIDDEN", "SKIP_SAVE"})
    files: CollectionProperty(
        name="Files", description="Luminaires' files", type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"}
    )
    filter_glob: StringProperty(default="*" + ";*".join(ENDINGS), description="Endings of luminaires' files", options={"HIDDEN"})
    location: FloatVectorProperty(
        name="Location", description="Where the first light's top is", subtype="XYZ", unit="LENGTH", options={"SKIP_SAVE"}
    )
    mounting_height: FloatProperty(
        name="Mounting Height", description="Height over what looks up, where no ceiling is above it", default=2.8, min=0.0, unit="LENGTH"
    )
    spacing: FloatProperty(name="Spacing", description="From one file's light to the next one's, along X", default=1.0, unit="LENGTH")
    use_symbol: BoolProperty(name="Symbol", description="Lines that show the opening and C0; they are not rendered", default=True)

    @classmethod
    def poll(cls, context):
        return can_run(cls, (context.mode == "OBJECT", "The viewport is not in Object Mode"))

    def invoke(self, context, event):
        self.location = context.scene.cursor.location
        if not self._paths():
            context.window_manager.fileselect_add(self)
            return {"RUNNING_MODAL"}
        region = view_under(context.area, event) if context.area is not None and context.area.type == "VIEW_3D" else None
        if region is not None:
            self.location = self._under(context, region, (event.mouse_x - region.x, event.mouse_y - region.y))
        return self.execute(context)

    def execute(self, context):
        hung = []
        for path in self._paths():
            try:
                place = Vector(self.location) + Vector((self.spacing * len(hung), 0.0, 0.0))
                hung.append(hang(context, path, place, self.use_symbol))
            except (OSError, gonio.Error) as problem:
                self.report({"ERROR"}, str(problem))
        if not hung:
            return {"CANCELLED"}
        for thing in context.selected_objects:
            thing.select_set(False)
        for thing in hung:
            thing.select_set(True)
        context.view_layer.objects.active = hung[0]
        return {"FINISHED"}

    def _paths(self) -> list[Path]:
        if self.files:
            return [Path(self.directory) / each.name for each in self.files if each.name]
        return [Path(self.filepath)] if self.filepath else []

    def _under(self, context, region, at) -> Vector:
        """Where a light hangs that is dropped at a place of a region."""
        origin, direction = (place(region, region.data, at) for place in (region_2d_to_origin_3d, region_2d_to_vector_3d))
        found = hanging(context.scene, context.evaluated_depsgraph_get(), origin, direction, self.mounting_height)
        return found or region_2d_to_location_3d(region, region.data, at, context.scene.cursor.location)


def hanging(scene, depsgraph, origin, direction, height):
    """Where a light hangs by the first surface along a ray: before it, or over it where it looks up; None where there is none."""
    hit, place, normal, *_ = scene.ray_cast(depsgraph, origin, direction)
    if not hit:
        return None
    if normal.dot(direction) > 0.0:
        normal = -normal
    if normal.z < LEVEL:
        return place + OFF * normal
    up = Vector((0.0, 0.0, 1.0))
    over, ceiling, *_ = scene.ray_cast(depsgraph, place + OFF * up, up)
    return ceiling - OFF * up if over else place + height * up


def hang(context, path: Path, location, use_symbol: bool):
    """A light of a luminaire's file, its nadir down; raises OSError and gonio.Error where the file is none."""
    name = path.stem
    description, _ = gonio.read_goniogram(path.read_bytes(), str(path))
    kind, sizes = opening_of(description)
    lamp = bpy.data.lights.new(name, type="AREA" if kind else "POINT")
    if kind:
        lamp.shape = kind
        lamp.size, lamp.size_y = (max(size, 1e-3) for size in sizes)
    else:
        lamp.shadow_soft_size = 0.0
    lamp.gonio.file = str(path)
    lamp.gonio.use_photometry = True
    thing = bpy.data.objects.new(name, lamp)
    # The opening of a luminaire with luminous sides has its middle at the light's origin.
    depth = float(((description.get("opening") or {}).get("size") or [0.0])[-1])
    thing.location = location - Vector((0.0, 0.0, depth / 2.0))
    collection = context.collection or context.scene.collection
    collection.objects.link(thing)
    if use_symbol:
        symbol = bpy.data.objects.new(f"{name} symbol", symbol_of(name, sizes))
        symbol.parent, symbol.hide_render, symbol.hide_select = thing, True, True
        collection.objects.link(symbol)
    return thing


def opening_of(description):
    """The kind of area lamp that looks most like a file's luminous opening, and its width along X and Y in metres; no kind of a point."""
    opening = description.get("opening") or {}
    size = [float(each) for each in opening.get("size", (0.0, 0.0))][:2]
    if opening.get("shape") in ("Rectangle", "Box") and min(size) > 0.0:
        return "RECTANGLE", size
    width = max(size) if size else 0.0
    return ("DISK", [width, width]) if width > 0.0 else (None, [0.0, 0.0])


def symbol_of(name: str, sizes):
    """The opening with its diagonals, a stem down along the nadir, and a mark at C0: edges alone."""
    x, y = (max(size, SYMBOL) / 2.0 for size in sizes)
    points = [(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0), (0, 0, 0), (0, 0, -STEM), (x, 0, 0), (x + SYMBOL / 2.0, 0, 0)]
    mesh = bpy.data.meshes.new(f"{name} symbol")
    mesh.from_pydata(points, [(0, 1), (1, 2), (2, 3), (3, 0), (0, 2), (1, 3), (4, 5), (6, 7)], [])
    return mesh


class GONIO_FH_luminaire(bpy.types.FileHandler):
    """Luminaires' files that are dropped on a 3D viewport."""

    bl_idname = "GONIO_FH_luminaire"
    bl_label = "Luminaire"
    bl_import_operator = GONIO_OT_hang_luminaire.bl_idname
    bl_file_extensions = ";".join(ENDINGS)

    @classmethod
    def poll_drop(cls, context):
        return context.area is not None and context.area.type == "VIEW_3D" and is_engine(context)[0]
