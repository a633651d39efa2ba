# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file asks for that is not shown: said once, never left out in silence."""

from functools import lru_cache

from .gather import AS_MESH, HAIR, VOLUME
from .object_attribute import keyed

# By the owner of the setting: the entry of the table, where the setting stands, its values where nothing is asked for, and its name.
SCENE = (
    ("freestyle", "render.use_freestyle", (False,), ""),
    ("fast gi", "cycles.use_fast_gi", (False,), ""),
    ("filter glossy", "cycles.blur_glossy", (0.0, 1.0), ""),
    ("culling", "render.use_simplify and cycles.use_camera_cull", (False,), "Culling by camera"),
    ("culling", "render.use_simplify and cycles.use_distance_cull", (False,), "Culling by distance"),
)
LAYER = ()
OBJECT = (
    ("shadow caustics", "cycles.is_caustics_caster", (False,), ""),
    ("shadow caustics", "cycles.is_caustics_receiver", (False,), ""),
    ("shadow terminator", "shadow_terminator_shading_offset", (0.0,), "Shadow terminator's shading offset"),
)
LIGHT = (
    ("shadow caustics", "cycles.is_caustics_light", (False,), ""),
    ("lamp bounces", "cycles.max_bounces", (1024,), "Most bounces of the light"),
)
WORLD = (
    ("shadow caustics", "cycles.is_caustics_light", (False,), ""),
    ("lamp bounces", "cycles.max_bounces", (1024,), "Most bounces of the world"),
)
MATERIAL = (("bump correction", "cycles.use_bump_map_correction", (True,), ""),)
# Kinds of objects that are shown, beside those that become meshes.
SHOWN = {"MESH", "CURVES", "POINTCLOUD", VOLUME}
# Switches of passes that mean no pass that could be missing: subsurface light is part of the diffuse passes, as in Cycles.
NO_PASSES = {"use_pass_cryptomatte_accurate"} | {f"use_pass_subsurface_{part}" for part in ("direct", "indirect", "color")}
# Passes whose switches are named otherwise.
OTHER_PASSES = {"pass_render_time"}


def of_scene(depsgraph, report):
    """Settings of the scene, its view layer and its world that have no effect."""
    scene, layer = depsgraph.scene_eval, depsgraph.view_layer
    for kind, owner, settings in (("Scene", scene, SCENE), ("View Layer", layer, LAYER), ("World", scene.world, WORLD)):
        if owner is not None:
            if kind != "World":
                report.forget_all(kind)
            _tell(kind, owner, settings, report)


def of_file(scene, layer, report):
    """Settings of a scene and of all that it shows that have no effect, without an export; nodes are looked at by exports alone."""
    _tell("Scene", scene, SCENE, report)
    _tell("View Layer", layer, LAYER, report)
    if scene.world is not None:
        _tell("World", scene.world, WORLD, report)
    for thing in scene.objects:
        _tell("Object", thing, OBJECT, report)
        if thing.type == "LIGHT":
            _tell("Light", thing.data, LIGHT, report)
        for slot in thing.material_slots:
            if slot.material is not None:
                _tell("Material", slot.material, MATERIAL, report)


def of_passes(layer, known, report):
    """Passes that a view layer asks for in vain; `known` are the switches of those that there are."""
    for owner in (layer, getattr(layer, "cycles", None)):
        for setting in owner.bl_rna.properties if owner is not None else ():
            name = setting.identifier
            is_pass = (name.startswith("use_pass_") or name in OTHER_PASSES) and name not in NO_PASSES
            if is_pass and name not in known and getattr(owner, name):
                report.tell("pass", "View Layer", layer.name, f"Pass {setting.name}")


def of_material(material, report):
    """Settings of a material that have no effect."""
    _tell("Material", material, MATERIAL, report)


def of_object(group, report):
    """Settings of an object, or of its lamp, that have no effect; hair has its object's."""
    if group.kind == HAIR:
        return
    source, name = keyed(group.source), group.name
    _tell("Object", source, OBJECT, report, name)
    if group.kind == "LIGHT":
        _tell("Light", keyed(group.source.data), LIGHT, report)
        if not source.is_shadow_catcher:
            report.tell("catcher's lamp", "Object", name)
    elif group.kind not in SHOWN and group.kind not in AS_MESH:
        report.tell("kind of object", "Object", name, f"{KINDS.get(group.kind, group.kind.capitalize())} objects")


KINDS = {"GREASEPENCIL": "Grease pencil", "GPENCIL": "Grease pencil"}


def _tell(kind, owner, settings, report, name=""):
    for limit, path, usual, subject in settings:
        *switches, last = _paths(path)
        if all(_value(owner, switch, False) for switch in switches) and _value(owner, last, usual[0]) not in usual:
            report.tell(limit, kind, name or owner.name, subject)


@lru_cache(maxsize=None)
def _paths(path):
    """Several settings count together, the last of them by its value: each as its names from the owner on."""
    return [part.split(".") for part in path.split(" and ")]


def _value(owner, names, usual):
    """A setting by its path; `usual` where this Blender has none such."""
    for name in names:
        owner = getattr(owner, name, None)
        if owner is None:
            return usual
    return owner
