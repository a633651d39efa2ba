# SPDX-License-Identifier: GPL-3.0-or-later
"""From evaluated Blender data to a `gonio.Scene`: everything once, then only what changed."""

import gonio

from . import camera, collecting, limits, motion, settings, view, world
from .changes import Changes, touched
from .gather import VOLUME, Walk, fill_random
from .fibres import KINDS as FIBRES
from .fibres import Fibres
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
from .transforms import columns
from .volumes import Volumes
from .volumes.air import Air
from .volumes.insides import Insides

__all__ = ["Changes", "Exporter"]


class Exporter:
    """One session's scene and what is known of it; holds no Blender data between calls. A part is exported without the world and the camera. For
    pictures trees are built while the rest is exported, and less is told of meshes (`pictured`)."""

    def __init__(self, report, part=None, *, pictured=False):
        self.report, self._part = report, part
        self.scene = gonio.Scene()
        self._textures = Slots()
        self._images = Images(self.scene, self._textures)
        self._measured = Slots()
        meshes, materials = Slots(), Slots()
        self._materials = Materials(self.scene, materials, self._images, Measurements(self.scene, self._measured), report)
        self._meshes = Meshes(self.scene, meshes, report, pictured)
        self._volumes = Volumes(self.scene, meshes, materials, report)
        self._insides = Insides(self._volumes, report)
        self._air = Air(self.scene, self._volumes, report)
        self._fibres = Fibres(self.scene, report)
        self._instances = Instances(self.scene, report)
        self._lights = Lights(self.scene, self._images, report)
        self._camera, self._world_asked, self._follows_view, self._synced = None, {}, False, False
        # Where cameras that move are at even times of the shutter, by session_uid.
        self._camera_motion = {}
        # Values that materials want of meshes, by the keys of groups.
        self._primvars = {}
        # At which times of the shutter their forms are asked for, by the keys of groups; None for those that keep them.
        self._form_shares = {}
        # What the groups show, by their keys.
        self._shown = {}

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

    def blur(self, engine, depsgraph):
        """Exports where things are while the shutter is open; what was exported before stays at the frame."""
        scene, self._camera_motion = depsgraph.scene, {}
        self.scene.set(**motion.settings_of(depsgraph))
        shutter, ends = motion.shutter_of(depsgraph), ()
        if shutter is None:
            # Nothing is blurred: motion vectors may be asked for.
            shutter, ends = motion.neighbours_of(depsgraph), motion.ENDS
        if shutter is None:
            return
        # Settings are those at the frame, which the original objects do not have while an animation is rendered.
        cameras = {camera.session_uid: ends or motion.shares_of(camera.evaluated_get(depsgraph)) for camera in motion.cameras_of(scene)}
        seen = {share for shares in cameras.values() for share in shares}
        shares = {*ends} or {*self._instances.shares(), *self._lights.shares(), *seen}
        forms = {key: ends or asked for key, asked in self._form_shares.items() if asked is not None}
        places = motion.places_at(engine, depsgraph, shutter, shares, self._part, forms)
        self._instances.blur(places, self._forms(depsgraph, places, shutter, ends), ends)
        if not ends:
            self._lights.blur(places)
            self._volumes.blur(shutter, scene.render.fps / scene.render.fps_base)
        self._camera_motion = {uid: motion.camera_keys(uid, asked, places) for uid, asked in cameras.items()}

    def _forms(self, depsgraph, places, shutter, ends):
        """What stands in for the meshes, hair, curves and points that change their form, by the keys of their groups and what these show."""
        changed, walk = {}, Walk(depsgraph, self.report, self._part)
        for key, group in zip(motion.keys_of(walk.groups), walk.groups, strict=True):
            if key not in self._primvars:
                continue
            with self.report.guard("Object", group.name, "its form is not blurred"):
                forms = motion.forms_of(key, group, places, shutter, depsgraph.scene, ends)
                if not forms:
                    continue
                if group.kind in FIBRES:
                    shown = self._fibres.blur(group, self._shown[key], self._primvars[key], forms, depsgraph)
                    changed.update({(key, before): after for before, after in shown})
                elif (number := self._meshes.blur(group, self._primvars[key], forms, self.report)) is not None:
                    changed[key, "mesh"] = ("mesh", number)
        return changed

    def sync_world(self, depsgraph):
        """Exports the world and nothing else."""
        self._images.go_to(depsgraph.scene_eval.frame_current)
        self._textures.begin()
        self._world(depsgraph)
        self._lights.write()
        self._textures.sweep()
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
        self._air.any_written = False
        if found.nothing:
            return changes
        if found.geometry:
            self._meshes.forget(found.geometry)
            self._fibres.forget(found.geometry)
            self._volumes.forget(found.geometry)
            self._insides.forget(found.geometry)
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
            self._look_around(depsgraph, changes)
        self._lights.write()
        changes.lights = self._lights.any_written
        changes.world = self._air.any_written or (found.world and self._lights.any_written)
        if found.camera or found.placements or found.moved:
            changes.camera = self._scene_camera(depsgraph)
        return changes

    def set_view(self, depsgraph, space_view3d, region_3d, width, height):
        """Looks where a 3D view looks."""
        self._follows_view = True
        self.report.forget_all("Camera")
        return self._put_camera(view.describe(depsgraph, space_view3d, region_3d, width, height, self.report), depsgraph)

    def settings(self, depsgraph, *, width, height, crop=None, preview=False, passes=("color",), eye=None, aspect=None):
        """Sets resolution, samples, limits and passes; `eye` is a view of a stereoscopic picture, `aspect` a pixel's width and height where
        they are not the scene's."""
        render = depsgraph.scene.render
        aspect = aspect or (render.pixel_aspect_x, render.pixel_aspect_y)
        arguments = settings.settings(depsgraph, width=width, height=height, crop=crop, preview=preview, passes=passes, aspect=aspect)
        if not self._follows_view:
            self._scene_camera(depsgraph, (width, height), eye, aspect)
        self.scene.set(**arguments)
        return arguments

    def own_entry(self, thing):
        """The number of the instances whose first placement is an original object itself, and the numbers of its materials; None without any."""
        return self._instances.own(thing.session_uid)

    def material(self, number):
        """The description of a material of the scene."""
        return self._materials.description(number)

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
        shown = (getattr(layer, "world_override", None) or depsgraph.scene_eval.world) if layer.use_sky else None
        self._lights.domes([])
        self.report.forget_all("World")
        self._world_asked, filled = {}, (None, None)
        if shown is not None:
            with self.report.guard("World", shown.name, "the world is black"):
                descriptions, self._world_asked = world.domes(shown, self._images, self.report, self._surroundings(depsgraph))
                self._lights.domes(descriptions)
                filled = world.atmosphere(shown, self._images, self.report, self._surroundings(depsgraph))
                self._world_asked = self._world_asked | (filled[0].asked if filled[0] is not None else {})
        self._air.show(*filled, "" if shown is None else shown.name, depsgraph)

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
        self._fibres.begin(keep_known)
        self._volumes.begin(keep_known)
        self._insides.begin(keep_known)
        self._materials.begin(self._surroundings(depsgraph))
        # All objects are looked at anew.
        self.report.forget_all("Object")
        walk = Walk(depsgraph, self.report, self._part)
        keyed = list(zip(walk.groups, motion.keys_of(walk.groups), strict=True))
        self._air.place(walk.groups, depsgraph)
        layer = depsgraph.view_layer_eval
        override = layer.material_override
        entries, keys, self._primvars, self._shown, self._form_shares = [], [], {}, {}, {}
        for group, key in keyed:
            with self.report.guard("Object", group.name, "it is left out"):
                limits.of_object(group, self.report)
                if group.kind == VOLUME and layer.use_volumes:
                    inside = self._materials.inside(group.slots, walk.materials, override)
                    filled = self._volumes.of_group(group, inside, depsgraph)
                    entries += [(*each[:3], frozenset()) for each in filled]
                    keys += [motion.Placed(key, [number], inner) for *_, number, inner in filled]
                elif group.kind not in ("LIGHT", VOLUME) and (layer.use_strand if group.kind in FIBRES else layer.use_solid):
                    materials = self._materials.of_slots(group.slots, walk.materials, override)
                    if materials.uneven and group.kind not in FIBRES:
                        filled = self._filled(group, materials, depsgraph)
                        entries += [(*each[:3], materials.placed) for each in filled]
                        keys += [motion.Placed(key, numbers) for *_, numbers in filled]
                        continue
                    for shown, numbers in self._surfaces(group, materials, depsgraph):
                        entries.append((group, shown, numbers, materials.placed))
                        keys.append(key)
                        self._primvars[key] = materials.primvars
                        self._form_shares[key] = motion.form_shares(group)
                        self._shown.setdefault(key, []).append(shown)
        fill_random(depsgraph, [group for group, _, _, wanted in entries if RANDOM in wanted])
        given = [(group, wanted) for group, _, _, wanted in entries if any(name.startswith(INSTANCER) for name in wanted)]
        fill_instancer(depsgraph, [group for group, _ in given], [wanted for _, wanted in given], self.report)
        given = [(group, wanted) for group, _, _, wanted in entries if any(is_given(name) for name in wanted)]
        fill_given(depsgraph, [group for group, _ in given], [wanted for _, wanted in given])
        self._instances.write(entries, keys)
        self._materials.sweep()
        self._lights.lamps([(group, key) for group, key in keyed if group.kind == "LIGHT"], self._instances.sets)
        self._meshes.sweep()
        self._fibres.sweep()
        self._volumes.sweep()
        self._insides.sweep()
        changes.geometry |= self._meshes.any_written or self._fibres.any_written or self._volumes.any_written
        changes.shading |= self._materials.any_written or self._volumes.any_shaded
        changes.transforms |= self._instances.any_written

    def _filled(self, group, materials, depsgraph):
        """The placements of a mesh whose inside varies, one by one, and their numbers."""
        mesh = self._meshes.number(group, materials.primvars)
        if mesh is None:
            return []
        described = {slot: self._materials.description(materials.numbers[slot]) for slot in materials.uneven}
        found = self._insides.of_group(group, materials, described, depsgraph)
        return [(part, ("mesh", mesh), numbers, placed) for part, numbers, placed in found]

    def _surfaces(self, group, materials, depsgraph):
        """What a group shows: kinds of surfaces with their numbers, and the materials of each."""
        if group.kind not in FIBRES:
            mesh = self._meshes.number(group, materials.primvars)
            return [] if mesh is None else [(("mesh", mesh), materials.numbers)]
        last = len(materials.numbers) - 1
        shown = self._fibres.of_group(group, materials.primvars, depsgraph)
        return [(place, [materials.numbers[min(max(slot or 0, 0), last)]]) for place, slot in shown]

    def _scene_camera(self, depsgraph, size=None, eye=None, aspect=None):
        """The scene's camera, unless a 3D view was set; gives whether it differs."""
        source = depsgraph.scene.camera if eye is None or eye.camera is None else eye.camera
        if self._follows_view or source is None:
            return False
        self.report.forget_all("Camera")
        render = depsgraph.scene.render
        share = render.resolution_percentage / 100.0
        width, height = size or (int(render.resolution_x * share), int(render.resolution_y * share))
        aspect = aspect or (render.pixel_aspect_x, render.pixel_aspect_y)
        seen_by = source.evaluated_get(depsgraph)
        description = camera.describe(seen_by, width, height, aspect, self.report, depsgraph, eye)
        keys = motion.seen_keys(self._camera_motion.get(source.session_uid, []), seen_by.matrix_world, eye and eye.matrix)
        return self._put_camera({**description, "motion": [columns(key) for key in keys]}, depsgraph)

    def _put_camera(self, description, depsgraph):
        description = {"motion": [], **description}
        if description == self._camera:
            return False
        self.scene.put_camera(description, index=None if self._camera is None else 0)
        self._camera = description
        if self._look_around(depsgraph, Changes()):
            self._lights.write()
        return True

    def _look_around(self, depsgraph, changes):
        """Materials that asked for what is otherwise now, with what fills meshes by them, and the world; gives whether that did."""
        changes.shading |= self._materials.look_around(self._surroundings(depsgraph), depsgraph)
        if self._materials.is_inside_stale:
            self._placements(depsgraph, changes, keep_known=True)
        is_world_stale = not self._surroundings(depsgraph).answers(self._world_asked)
        if is_world_stale:
            self._world(depsgraph)
        return is_world_stale

    def _surroundings(self, depsgraph):
        return Surroundings(self._camera, depsgraph, self._part)
