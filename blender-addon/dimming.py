# SPDX-License-Identifier: GPL-3.0-or-later
"""Levels of light groups: what they do to lights, and how panels tell them."""

import bpy

from . import luminaire

VERDICTS = {"met": "met", "within_error": "within the error", "not_met": "not met"}


def apply(scene, levels, report) -> None:
    """Dims the lights of groups; a light that cannot be dimmed to one level is named in the report and stays."""
    of_light = {}
    for thing in bpy.data.objects:
        if thing.type == "LIGHT" and thing.users_scene:
            # Lamps of other scenes were not measured.
            level = levels.get(thing.lightgroup, 1.0) if scene in thing.users_scene else 1.0
            of_light.setdefault(thing.data, set()).add(level)
    for light, found in of_light.items():
        if found == {1.0}:
            continue
        if light.library is not None:
            report.add("Light", light.name, "it is of another file, and cannot be dimmed here")
        elif len(found) > 1:
            report.add("Light", light.name, "its objects have different levels, and it is not dimmed: make it single-user")
        else:
            _dim(light, found.pop())
    if scene.world is not None and levels.get(scene.world.lightgroup, 1.0) < 1.0:
        report.add("World", scene.world.name, f"its light would be dimmed to {100 * levels[scene.world.lightgroup]:.0f} %, and is left")


def _dim(light, level) -> None:
    if luminaire.is_photometric(light):
        light.gonio.dimming *= level
    else:
        light.energy *= level


def lines(found) -> tuple[str, ...]:
    """Levels, power and verdicts of what `gonio.dim` found."""
    groups = tuple(f"{group['name']}: {100 * group['level']:.0f} %   {group['watts']:.4g} W" for group in found["groups"])
    return (*groups, f"{found['watts']:.4g} of {found['watts_full']:.4g} W", *map(_verdict, found["targets"]))


def _verdict(target) -> str:
    reached, verdict = target["reached"], VERDICTS[target["verdict"]]
    return f"{target['text']}: {verdict}" if reached is None else f"{target['text']}: {reached:.4g} ± {target['error']:.2g}, {verdict}"
