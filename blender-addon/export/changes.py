# SPDX-License-Identifier: GPL-3.0-or-later
"""What an update changed, and what a depsgraph says was touched."""

from dataclasses import dataclass, field

import bpy


@dataclass
class Changes:
    """Which parts of the scene are not what they were."""

    camera: bool = False
    transforms: bool = False
    geometry: bool = False
    shading: bool = False
    lights: bool = False
    world: bool = False

    @property
    def anything(self) -> bool:
        """Whether there is something to render anew."""
        return any((self.camera, self.transforms, self.geometry, self.shading, self.lights, self.world))


@dataclass
class Touched:
    """What `depsgraph.updates` lists, sorted by what has to be done."""

    placements: bool = False
    # Evaluated objects that moved and of which nothing else is said, by session_uid.
    moved: dict = field(default_factory=dict)
    geometry: set = field(default_factory=set)
    materials: set = field(default_factory=set)
    every_material: bool = False
    world: bool = False
    camera: bool = False

    @property
    def nothing(self) -> bool:
        """Whether the list was empty."""
        return not (self.placements or self.moved or self.geometry or self.materials or self.every_material or self.world or self.camera)


def touched(depsgraph) -> Touched:
    """Reads the list of updates."""
    found = Touched()
    for update in depsgraph.updates:
        _sort(found, update, update.id.original)
    return found


def _sort(found, update, block):
    if isinstance(block, bpy.types.Object):
        if block.type == "CAMERA":
            found.camera = True
        elif update.is_updated_transform and not (update.is_updated_geometry or update.is_updated_shading):
            found.moved[block.session_uid] = update.id
        else:
            # Switches of visibility, slots and properties come as shading or as neither.
            found.placements = True
        if update.is_updated_geometry:
            found.geometry.add(block.session_uid)
    elif isinstance(block, bpy.types.Material):
        found.materials.add(block.session_uid)
    elif isinstance(block, bpy.types.Image):
        # Materials and worlds that use an image or a node group are listed themselves; lamps are not.
        found.every_material = found.world = found.placements = True
    elif isinstance(block, bpy.types.World):
        found.world = True
    elif isinstance(block, bpy.types.Light):
        found.placements = True
    elif isinstance(block, bpy.types.Camera):
        found.camera = True
    elif isinstance(block, (bpy.types.Mesh, bpy.types.Curve, bpy.types.MetaBall, bpy.types.Volume)):
        found.placements = True
        # The mesh of an edited material is listed too, unchanged.
        if update.is_updated_geometry:
            found.geometry.add(block.session_uid)
    elif isinstance(block, bpy.types.Collection):
        found.placements = True
    elif isinstance(block, bpy.types.Scene):
        # Lists the camera in use, the world, the layers' overrides; all of them are compared, not rewritten.
        found.placements = found.world = found.camera = True
