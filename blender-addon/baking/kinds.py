# SPDX-License-Identifier: GPL-3.0-or-later
"""What can be baked: the passes that each kind wants, and how they make up its colour."""

from dataclasses import dataclass

import numpy as np

from ..units import LUMENS_PER_WATT

# Blender's bits of what a bake takes in.
EMIT, DIFFUSE, GLOSSY, TRANSMISSION = 1 << 1, 1 << 2, 1 << 3, 1 << 4
DIRECT, INDIRECT, COLOR = 1 << 6, 1 << 7, 1 << 8
LOBES = {"diffuse": DIFFUSE, "glossy": GLOSSY, "transmission": TRANSMISSION}
EVERYTHING = EMIT | DIFFUSE | GLOSSY | TRANSMISSION | DIRECT | INDIRECT
# Samples of what is the same for every path but for textures.
FEW_SAMPLES = 16


@dataclass(frozen=True)
class Kind:
    """A kind of bake: the renderer's passes, what they stand for, and whether it is seen from the camera where that is asked for."""

    passes: tuple[str, ...]
    # "light", "data" and "share" as they are, "uv", which Blender's mesh has itself, or "world", by the place; and the stand-in for the material.
    meaning: str = "light"
    seen: bool = True
    few: bool = False
    stand_in: str = ""


DATA = {
    # Blender turns it to the space that was asked for.
    "NORMAL": Kind(("normal",), "data", seen=False, few=True),
    "POSITION": Kind(("P",), "data", seen=False, few=True),
    "UV": Kind((), "uv", seen=False, few=True),
    "ROUGHNESS": Kind(("emission",), "share", seen=False, few=True, stand_in="roughness"),
    "AO": Kind(("emission",), "share", seen=False, stand_in="occlusion"),
    "ILLUMINANCE": Kind(("illuminance",), "data", seen=False),
    "EMIT": Kind(("emission",)),
    "ENVIRONMENT": Kind(("P",), "world", seen=False, few=True),
}


def kind_of(name: str, pass_filter: int) -> Kind:
    """A kind by Blender's name. Raises ValueError for those that there are not."""
    if name in DATA:
        return DATA[name]
    if name == "COMBINED":
        wanted = [lobe for lobe, bit in LOBES.items() if pass_filter & bit]
        if pass_filter & EVERYTHING == EVERYTHING:
            return Kind(("color",))
        emission = ("emission",) if pass_filter & EMIT else ()
        return Kind((*emission, *_parts(wanted, pass_filter | COLOR)))
    if name.lower() in LOBES:
        return Kind(_parts([name.lower()], pass_filter), few=not pass_filter & (DIRECT | INDIRECT))
    raise ValueError(f"Gonio has nothing to bake of the kind {name.capitalize()}")


def _parts(lobes, pass_filter: int) -> tuple[str, ...]:
    parts = [part for part, bit in (("direct", DIRECT), ("indirect", INDIRECT), ("color", COLOR)) if pass_filter & bit]
    return tuple(f"{lobe}_{part}" for lobe in lobes for part in parts)


def colour_of(kind: Kind, read, exposure: float) -> np.ndarray:
    """Pixels (height, width, 3); `read` gives a pass by name as (height, width, channels), as the renderer has it."""
    if kind.meaning == "light":
        return _light(kind.passes, read, exposure)
    values = read(kind.passes[0])
    return np.repeat(values, 3, axis=2) if values.shape[2] == 1 else values[..., :3]


def _light(passes, read, exposure: float) -> np.ndarray:
    factor = exposure / LUMENS_PER_WATT
    rgb = {name: read(name)[..., :3] for name in passes}
    total = sum(factor * rgb[name] for name in ("color", "emission") if name in rgb)
    for lobe in LOBES:
        light = [rgb[name] for name in (f"{lobe}_direct", f"{lobe}_indirect") if name in rgb]
        colour = rgb.get(f"{lobe}_color")
        if light:
            total = total + factor * sum(light) * (1.0 if colour is None else colour)
        elif colour is not None:
            total = total + colour
    return total
