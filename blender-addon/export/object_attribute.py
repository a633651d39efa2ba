# SPDX-License-Identifier: GPL-3.0-or-later
"""Properties of objects, and of other data-blocks, as attributes of materials."""


def object_attribute(source, name):
    """A property of an object, or of its data, by the path that Blender's Attribute node takes; as a colour, None if there is none."""
    return attribute_of((source, source.data), name)


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
