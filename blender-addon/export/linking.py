# SPDX-License-Identifier: GPL-3.0-or-later
"""Light linking and shadow linking: what lamps and shining meshes light, and what casts their shadows, as Blender's collections say."""

ALL = {"receivers": "All", "blockers": "All"}


def linking(thing, numbers):
    """The description of an original object's links; `numbers` are those of the instance sets that an object became, by session_uid."""
    links = thing.light_linking
    found = {"receivers": _link(links.receiver_collection, numbers), "blockers": _link(links.blocker_collection, numbers)}
    return ALL if found == ALL else found


def _link(collection, numbers):
    """Objects that are included are linked alone; without any, all but those that are excluded."""
    if collection is None:
        return "All"
    states = _states(collection)
    included = [uid for uid, state in states.items() if state == "INCLUDE"]
    chosen = included or list(states)
    sets = sorted(number for uid in chosen for number in numbers.get(uid, ()))
    if included:
        return {"Only": sets}
    return {"Except": sets} if sets else "All"


def _states(collection):
    """Whether objects are included or excluded, by session_uid: by the child collection that they are in, or by themselves, which counts more."""
    states = {}
    for child, entry in zip(collection.children, collection.collection_children, strict=True):
        states |= {thing.session_uid: entry.light_linking.link_state for thing in child.all_objects}
    for thing, entry in zip(collection.objects, collection.collection_objects, strict=True):
        states[thing.session_uid] = entry.light_linking.link_state
    return states
