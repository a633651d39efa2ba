# SPDX-License-Identifier: GPL-3.0-or-later
"""What shading knows of the ray: Light Path and Light Falloff."""

from .camera_nodes import eye, in_camera
from .registry import value_node

# The outputs of Light Path that shading knows.
LIGHT_PATH = {
    *(f"Is {kind} Ray" for kind in ("Camera", "Shadow", "Diffuse", "Glossy", "Singular", "Reflection", "Transmission", "Volume Scatter")),
    *(f"{kind} Depth" for kind in ("Ray", "Diffuse", "Glossy", "Transmission", "Transparent")),
}
# Those that are nothing where there are no portals.
NEVER = {"Portal Depth"}


@value_node("ShaderNodeLightPath")
def light_path(t, node, context, output):
    t.asked_for_ray = True
    name = output.identifier
    if t.is_world:
        if name != "Is Camera Ray":
            t.tell("world's light path", node, context, f"Light Path: {name}")
        return t.graph.scalar(1.0 if name == "Is Camera Ray" and t.is_camera_ray else 0.0)
    if t.kind == "Light":
        # What lamps light is found by rays of no such kind.
        t.tell("lamp's light path", node, context, f"Light Path: {name}")
        return t.graph.scalar(0.0)
    if name == "Ray Length":
        return ray_length(t)
    return t.graph.scalar(0.0) if name in NEVER else known(t, name) if name in LIGHT_PATH else None


def known(t, name):
    """What the renderer knows of the ray by the name of the output."""
    return t.graph.add({"LightPath": name.replace(" ", "")}, kind="VALUE")


def ray_length(t):
    """Metres from where the ray begins: for the camera's rays the plane from which on things are seen."""
    seen_by = eye(t)
    before = t.graph.scalar(seen_by.near)
    if seen_by.is_flat:
        # The plane is further off on rays that slant.
        place = in_camera(t)
        before = before * (place.length() / place.component(2))
    return known(t, "Ray Length") - known(t, "Is Camera Ray") * before


@value_node("ShaderNodeLightFalloff")
def light_falloff(t, node, context, output):
    strength, smooth = t.input(node, "Strength", context, 100.0), t.input(node, "Smooth", context)
    if t.is_world:
        return strength
    if t.kind == "Light":
        falls = (output.identifier, float(smooth.constant[0]) if smooth.is_constant else 0.0)
        # The renderer multiplies the lamp's whole light by one law.
        is_sun = getattr(t.owner, "type", None) == "SUN" and falls != ("Quadratic", 0.0)
        if is_sun or not smooth.is_constant or t.falloff not in (None, falls):
            t.tell("light falloff", node, context, f"Light Falloff: {output.name}")
        t.falloff = t.falloff or falls
        return strength
    length = ray_length(t)
    squared = length * length
    strength = strength * {"Linear": length, "Constant": squared}.get(output.identifier, 1.0)
    softened = strength * (squared / (smooth + squared))
    return strength.mix(softened, smooth.sign().maximum(0.0))
