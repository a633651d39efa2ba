# SPDX-License-Identifier: GPL-3.0-or-later
"""What a file asks for that is not shown: said once, never left out in silence."""


def of_scene(depsgraph, report):
    """Settings of the scene that have no effect."""
    scene = depsgraph.scene
    if scene.render.use_motion_blur:
        report.add("Scene", scene.name, "motion blur is not supported; everything stands still")


def of_object(source, report):
    """Settings of an object that have no effect."""
    linking = getattr(source, "light_linking", None)
    if linking is not None and (linking.receiver_collection or linking.blocker_collection):
        report.add("Object", source.name, "light linking is not supported; it lights everything and everything blocks it")
    if source.type == "LIGHT" and not source.is_shadow_catcher:
        report.add("Object", source.name, "shadow catchers cannot leave its light out of account; it counts as all others", severity="INFO")
    for system in source.particle_systems:
        if system.settings.type == "HAIR" and system.settings.render_type == "PATH":
            report.add("Object", source.name, f"hair strands ({system.name}) are not supported; they are left out")
