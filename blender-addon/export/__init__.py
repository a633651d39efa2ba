# SPDX-License-Identifier: GPL-3.0-or-later
"""From evaluated Blender data to a `gonio.Scene`: everything once, then only what changed."""

import gonio

from . import camera, collecting, limits, settings, view, world
from .changes import Changes, touched
from .gather import Walk, fill_random
from .given import fill_given, is_given
from .images import Images
from .instancer import PREFIX as INSTANCER
from .instancer import fill_instancer
from .instances import Instances
from .lights import Lights
from .material.inputs import RANDOM
from .materials import Materials
from .measured import Measurements
from .meshes import Meshes
from .slots import Slots
from .surroundings import Surroundings

__all__ = ["Changes", "Exporter"]


class Exporter:
    """One session's scene and what is known of it; holds no Blender data between calls. A part is exported without the world and the camera."""

    def __init__(self, report, part=None):
        self.report, self._part = report, part
        self.scene = gonio.Scene()
        self._textures = Slots()
        self._images = Images(self.scene, self._textures)
        self._measured = Slots()
        self._materials = Materials(self.scene, Slots(), self._images, Measurements(self.scene, self._measured), report)
        self._meshes = Meshes(self.scene, Slots(), report)
        self._instances = Instances(self.scene, report)
        self._lights = Lights(self.scene, self._images, report)
        self._camera, self._follows_view, self._synced = None, False, False

    def sync(self, depsgraph, *, preview=False, shader_aovs=frozenset()):
        """Exports everything, of AOV Output nodes those named; what is as it was is found by comparing and is not written again."""
        self._images.go_to(depsgraph.scene_eval.frame_current)
        self._textures.begin()
        self._measured.begin()
        self._materials.shader_aovs = shader_aovs
        self._everything(depsgraph)
        self._textures.sweep()
        self._measured.sweep()
        self._synced = True
        return self.scene

    def update(self, depsgraph):
        """Exports what `depsgraph.updates` says was touched; gives what came out different."""
        if not self._synced:
            self.sync(depsgraph)
            return Changes(True, True, True, True, True, True)
        found = touched(depsgraph)
        if self._images.go_to(depsgraph.scene_eval.frame_current):
            # No update tells of the pictures of a sequence.
            found.every_material = found.world = True
        changes = Changes()
        if found.nothing:
            return changes
        if found.geometry:
            self._meshes.forget(found.geometry)
        if found.every_material:
            self._materials.forget_all()
        for uid in found.materials:
            self._materials.forget(uid)
        if found.placements or found.geometry or found.materials or found.every_material:
            self._placements(depsgraph, changes, keep_known=True)
        elif found.moved:
            self._moves(depsgraph, changes, found.moved)
        if found.world:
            self._world(depsgraph)
        if found.world or found.placements:
            limits.of_scene(depsgraph, self.report)
        if found.world or found.placements or found.moved:
            changes.shading |= self._materials.look_around(self._surroundings(depsgraph), depsgraph)
        self._lights.write()
        changes.lights = self._lights.any_written
        changes.world = found.world and self._lights.any_written
        if found.camera or found.placements or found.moved:
            changes.camera = self._scene_camera(depsgraph)
        return changes

    def set_view(self, depsgraph, space_view3d, region_3d, width, height):
        """Looks where a 3D view looks."""
        self._follows_view = True
        self.report.forget_all("Camera")
        return self._put_camera(view.describe(depsgraph, space_view3d, region_3d, width, height, self.report), depsgraph)

    def settings(self, depsgraph, *, width, height, crop=None, preview=False, passes=("color",)):
        """Sets resolution, samples, limits and passes."""
        arguments = settings.settings(depsgraph, width=width, height=height, crop=crop, preview=preview, passes=passes)
        if not self._follows_view:
            self._scene_camera(depsgraph, (width, height))
        self.scene.set(**arguments)
        return arguments

    def _everything(self, depsgraph):
        self._materials.forget_all()
        self._placements(depsgraph, Changes(), keep_known=False)
        if self._part is not None:
            self._lights.write()
            return
        self._world(depsgraph)
        self._lights.write()
        self._scene_camera(depsgraph)
        limits.of_scene(depsgraph, self.report)

    def _world(self, depsgraph):
        """The world that the view layer shows; one that cannot be exported is black."""
        layer = depsgraph.view_layer_eval
        shown = getattr(layer, "world_override", None) or depsgraph.scene_eval.world
        self._lights.domes([])
        self.report.forget_all("World")
        if shown is not None:
            with self.report.guard("World", shown.name, "the world is black"):
                self._lights.domes(world.domes(shown, self._images, self.report))

    def _moves(self, depsgraph, changes, moved):
        """New places of objects; everything is walked over where they may take others along."""
        if self._instances.move(moved):
            changes.transforms |= self._instances.any_written
        else:
            self._placements(depsgraph, changes, keep_known=True)

    @collecting.put_off()
    def _placements(self, depsgraph, changes, keep_known):
        """Meshes, materials, placements and lamps of everything that the depsgraph shows."""
        self._meshes.begin(keep_known)
        self._materials.begin(self._surroundings(depsgraph))
        # All objects are looked at anew.
        self.report.forget_all("Object")
        walk = Walk(depsgraph, self.report, self._part)
        override = depsgraph.view_layer_eval.material_override
        entries = []
        for group in walk.groups:
            with self.report.guard("Object", group.name, "it is left out"):
                limits.of_object(group, self.report)
                if group.kind != "LIGHT":
                    materials = self._materials.of_slots(group.slots, walk.materials, override)
                    mesh = self._meshes.number(group, materials.primvars)
                    if mesh is not None:
                        entries.append((group, mesh, materials.numbers, materials.placed))
        fill_random(depsgraph, [group for group, _, _, wanted in entries if RANDOM in wanted])
        given = [(group, wanted) for group, _, _, wanted in entries if any(name.startswith(INSTANCER) for name in wanted)]
        fill_instancer(depsgraph, [group for group, _ in given], [wanted for _, wanted in given], self.report)
        given = [(group, wanted) for group, _, _, wanted in entries if any(is_given(name) for name in wanted)]
        fill_given(depsgraph, [group for group, _ in given], [wanted for _, wanted in given])
        self._instances.write(entries)
        self._materials.sweep()
        self._lights.lamps([group for group in walk.groups if group.kind == "LIGHT"], self._instances.numbers)
        self._meshes.sweep()
        changes.geometry |= self._meshes.any_written
        changes.shading |= self._materials.any_written
        changes.transforms |= self._instances.any_written

    def _scene_camera(self, depsgraph, size=None):
        """The scene's camera, unless a 3D view was set; gives whether it differs."""
        source = depsgraph.scene.camera
        if self._follows_view or source is None:
            return False
        self.report.forget_all("Camera")
        render = depsgraph.scene.render
        share = render.resolution_percentage / 100.0
        width, height = size or (int(render.resolution_x * share), int(render.resolution_y * share))
        aspect = (render.pixel_aspect_x, render.pixel_aspect_y)
        return self._put_camera(camera.describe(source.evaluated_get(depsgraph), width, height, aspect, self.report, depsgraph), depsgraph)

    def _put_camera(self, description, depsgraph):
        if description == self._camera:
            return False
        self.scene.put_camera(description, index=None if self._camera is None else 0)
        self._camera = description
        self._materials.look_around(self._surroundings(depsgraph), depsgraph)
        return True

    def _surroundings(self, depsgraph):
        return Surroundings(self._camera, depsgraph, self._part)
