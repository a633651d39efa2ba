# SPDX-License-Identifier: GPL-3.0-or-later
"""Which rays see an object: its own switches and those of its collections in the view layer."""

from .object_attribute import keyed

RAYS = ("camera", "diffuse", "glossy", "transmission", "volume", "shadow")
# What objects may be to the camera beside seen and unseen.
ROLES = ("holdout", "shadow_catcher")


class Visibility:
    """The switches of a view layer's objects; asks the layer about each of them only if a collection has such a switch."""

    def __init__(self, depsgraph):
        self._depsgraph, self._layer = depsgraph, depsgraph.view_layer_eval
        collections = list(_collections(depsgraph.view_layer.layer_collection))
        self._any_indirect = any(each.indirect_only for each in collections)
        self._any_holdout = any(each.holdout for each in collections)

    def of(self, thing):
        """The switches of an evaluated object as the scene takes them: the original has no keyed values while an animation is rendered."""
        seen = {
            "camera": thing.visible_camera,
            "diffuse": thing.visible_diffuse,
            "glossy": thing.visible_glossy,
            "transmission": thing.visible_transmission,
            "volume": thing.visible_volume_scatter,
            "shadow": thing.visible_shadow,
        }
        own = keyed(thing).gonio
        if own.is_grid and own.is_grid_only:
            return dict.fromkeys(RAYS, False)
        if self._any_indirect and self._known(thing).indirect_only_get(view_layer=self._layer):
            seen["camera"] = False
        if thing.is_holdout or (self._any_holdout and self._known(thing).holdout_get(view_layer=self._layer)):
            seen["holdout"] = True
        # Lamps have that switch on as a rule, and mean something else by it.
        if thing.is_shadow_catcher and thing.type != "LIGHT":
            seen["shadow_catcher"] = True
        return seen

    def _known(self, thing):
        """The object that the evaluated layer knows: what the walk gives for an instance is none of its objects."""
        return thing.original.evaluated_get(self._depsgraph)


def _collections(collection):
    yield collection
    for child in collection.children:
        yield from _collections(child)


def combined(own, parent):
    """What is left when the instancer has switches of its own."""
    both = {ray: own[ray] and parent[ray] for ray in RAYS}
    return both | {role: True for role in ROLES if own.get(role) or parent.get(role)}


def is_ordinary(seen):
    """Whether nothing is switched off."""
    return all(seen[ray] for ray in RAYS) and not any(role in seen for role in ROLES)
