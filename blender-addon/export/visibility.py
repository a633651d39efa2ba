# SPDX-License-Identifier: GPL-3.0-or-later
"""Which rays see an object: its own switches and those of its collections in the view layer."""

RAYS = ("camera", "diffuse", "glossy", "transmission", "shadow")
# What objects may be to the camera beside seen and unseen.
ROLES = ("holdout", "shadow_catcher")


def ray_visibility(thing, view_layer):
    """The switches of an object as the scene takes them."""
    seen = {ray: bool(getattr(thing, f"visible_{ray}", True)) for ray in RAYS}
    if thing.indirect_only_get(view_layer=view_layer):
        seen["camera"] = False
    if thing.is_holdout or thing.holdout_get(view_layer=view_layer):
        seen["holdout"] = True
    # Lamps have that switch on as a rule, and mean something else by it.
    if thing.is_shadow_catcher and thing.type != "LIGHT":
        seen["shadow_catcher"] = True
    return seen


def combined(own, parent):
    """What is left when the instancer has switches of its own."""
    both = {ray: own[ray] and parent[ray] for ray in RAYS}
    return both | {role: True for role in ROLES if own.get(role) or parent.get(role)}


def is_ordinary(seen):
    """Whether nothing is switched off."""
    return all(seen[ray] for ray in RAYS) and not any(role in seen for role in ROLES)
