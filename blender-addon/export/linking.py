# SPDX-License-Identifier: GPL-3.0-or-later
"""Light linking and shadow linking: what lamps and shining meshes light, and what casts their shadows, as Blender's collections say."""

ALL = {"receivers": "All", "blockers": "All"}


class Named:
    """The objects, by session_uid, that receivers and blockers of any light among some objects name. Such an instancer's own links hold for
    its instances, as in Cycles; instances of others have those of the object that is instanced."""

    def __init__(self, objects=()):
        self.receivers, self.blockers = set(), set()
        for thing in objects:
            links = thing.original.light_linking
            for collection, named in ((links.receiver_collection, self.receivers), (links.blocker_collection, self.blockers)):
                if collection is not None:
                    named.update(_states(collection))


class Sets:
    """The numbers of the instance sets of each object, by session_uid: of those that receive light, and of those that block it, by its links."""

    def __init__(self):
        self.receivers, self.blockers = {}, {}

    def add(self, group, number):
        """Counts a set that a group became."""
        self.receivers.setdefault(group.receiver_uid, []).append(number)
        self.blockers.setdefault(group.blocker_uid, []).append(number)


def linking(thing, sets):
    """The description of an original object's links among the `Sets` of the scene."""
    links = thing.light_linking
    found = {"receivers": _link(links.receiver_collection, sets.receivers), "blockers": _link(links.blocker_collection, sets.blockers)}
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
