# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties of objects, and of other data-blocks, as attributes of materials."""

# How paths begin that say where an object is.
PLACES = ("location", "rotation", "scale", "delta_")


def keyed(thing):
    """An evaluated object, or its data, where it has keyframes or drivers, else its original: edits of add-ons' settings and of custom properties
    do not tag objects, so that evaluated copies may lag behind."""
    if thing is None:
        return None
    animation = getattr(thing.original, "animation_data", None)
    return thing.original if animation is None or all(path.startswith(PLACES) for path in _paths(animation)) else thing


def _paths(animation):
    """The paths of all that drivers, actions and strips animate; one of no name for strips."""
    curves, action = list(animation.drivers), animation.action
    if hasattr(action, "layers"):
        curves += [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags for curve in bag.fcurves]
    elif action is not None:
        curves += action.fcurves
    return [curve.data_path for curve in curves] + [""] * len(animation.nla_tracks)


def object_attribute(source, name):
    """A property of an evaluated object, or of its data, by the path that Blender's Attribute node takes; as a colour, None if there is none."""
    return attribute_of((keyed(source), keyed(source.data)), name)


def attribute_of(things, name):
    """A property of the first of these things that has it, custom ones before Blender's own; as a colour, None if there is none."""
    for thing in things:
        for path in (f'["{name}"]', name) if thing is not None else ():
            try:
                value = thing.path_resolve(path)
            except (ValueError, AttributeError):
                continue
            if isinstance(value, (int, float)):
                return (float(value),) * 3 + (1.0,)
            if hasattr(value, "__len__") and not isinstance(value, str) and 1 < len(value) <= 4:
                return [*(float(x) for x in value), 0.0, 1.0][:3] + [float(value[3]) if len(value) == 4 else 1.0]
    return None
