"""What surfaces look like: reflectances and transmittances by styles, or by what an element is."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from .notes import Notes

Colour = tuple[float, float, float]

# Honeybee's defaults, so that a building has the same light by either way (docs/models.md).
WALL, CEILING, FLOOR, DOOR, PANE = 0.5, 0.8, 0.2, 0.5, 0.64
# White paint; surfaces that reflect all light are drawn so, and are none.
MOST_REFLECTED = 0.9
# Words for glass in names of materials and styles.
GLASS_WORDS = ("glass", "glas", "glaz", "verre", "vitr", "vidrio", "vetro", "szkl", "стекл", "玻璃", "ガラス")
# Words that have those in them.
NO_GLASS_WORDS = ("fiberglass", "fibreglass", "glasfaser", "glass wool", "glaswool", "glaswolle", "glasvezel", "laine de verre")


@dataclass(frozen=True)
class Look:
    """A surface: what it reflects diffusely, or as a metal; what a pane of it transmits at normal incidence."""

    name: str
    reflectance: Colour = (WALL, WALL, WALL)
    transmittance: Colour = (0.0, 0.0, 0.0)
    metal: bool = False
    roughness: float = 0.3
    # Taken by what an element is.
    is_default: bool = False

    @property
    def is_pane(self) -> bool:
        """Whether light goes through."""
        return max(self.transmittance) > 0.0


def default(part: str, reflectance: float) -> Look:
    """A grey surface of a part of buildings without a style."""
    return Look(f"Default {part} {reflectance:g}", (reflectance,) * 3, is_default=True)


GLASS = Look(f"Default glass {PANE:g}", transmittance=(PANE, PANE, PANE), is_default=True)


def is_glass(name: str | None) -> bool:
    """Whether a name speaks of glass."""
    word = (name or "").lower()
    return any(glass in word for glass in GLASS_WORDS) and not any(other in word for other in NO_GLASS_WORDS)


def of_class(element: Any) -> Look:
    """The look of an element without a style, but for its faces that look up or down."""
    kind = getattr(element, "PredefinedType", None)
    if element.is_a("IfcCovering"):
        known = {"CEILING": default("ceiling", CEILING), "FLOORING": default("floor", FLOOR)}
        return known.get(kind or "", default("covering", WALL))
    if element.is_a("IfcDoor"):
        return default("door", DOOR)
    if element.is_a("IfcSite") or element.is_a("IfcGeographicElement"):
        return default("ground", FLOOR)
    return default("wall", WALL) if element.is_a("IfcWall") else default("element", WALL)


def of_style(style: Any, notes: Notes) -> Look | None:
    """The look of an IfcSurfaceStyle or of a material's; None where it says nothing."""
    parts = {part.is_a(): part for part in getattr(style, "Styles", None) or ()}
    name = style.Name or f"Style {style.id()}"
    if lighting := parts.get("IfcSurfaceStyleLighting"):
        return _of_lighting(name, lighting, notes)
    shading = parts.get("IfcSurfaceStyleRendering") or parts.get("IfcSurfaceStyleShading")
    if shading is None:
        return None
    if "IfcSurfaceStyleWithTextures" in parts:
        notes.say(f"textures of the style {name!r} are left out: it has its colour")
    return _of_shading(name, shading, notes)


def linear(colour: Sequence[float]) -> Colour:
    """Linear Rec.709 of a colour as screens show it (IEC 61966-2-1)."""
    red, green, blue = (x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055) ** 2.4 for x in (min(max(x, 0.0), 1.0) for x in colour))
    return red, green, blue


def rgb(colour: Any) -> Colour:
    """The numbers of an IfcColourRgb, 0 to 1; some programs count to 255."""
    found = float(colour.Red), float(colour.Green), float(colour.Blue)
    red, green, blue = (x / 255.0 for x in found) if max(found) > 1.0 else found
    return red, green, blue


def _of_lighting(name: str, lighting: Any, notes: Notes) -> Look:
    """Shares of light, which are taken as they are."""
    transmitted, diffuse, mirrored = (rgb(lighting[i]) for i in (2, 1, 3))
    if max(rgb(lighting.DiffuseTransmissionColour)) > 0.0:
        notes.say(f"diffuse transmission of the style {name!r} is left out")
    if max(transmitted) > 0.0:
        return Look(name, transmittance=_shares(transmitted))
    if max(diffuse) == 0.0 and max(mirrored) > 0.0:
        return Look(name, _shares(mirrored), metal=True, roughness=0.0)
    return Look(name, _shares(diffuse))


def _of_shading(name: str, shading: Any, notes: Notes) -> Look:
    colour = rgb(shading.SurfaceColour)
    transparency = getattr(shading, "Transparency", None) or 0.0
    if transparency > 0.0:
        notes.say(f"panes of the style {name!r} transmit {transparency:g}, its transparency")
        return Look(name, transmittance=(min(transparency, 1.0),) * 3)
    method = getattr(shading, "ReflectanceMethod", None)
    if method == "GLASS" or (is_glass(name) and method not in ("METAL", "MIRROR")):
        notes.say(f"the glass {name!r} does not say how transparent it is; it transmits {PANE:g}")
        return Look(name, transmittance=GLASS.transmittance)
    if method in ("METAL", "MIRROR"):
        return Look(name, linear(colour), metal=True, roughness=0.3 if method == "METAL" else 0.0)
    diffuse = getattr(shading, "DiffuseColour", None)
    if diffuse is not None and diffuse.is_a("IfcColourRgb"):
        return _limited(name, linear(rgb(diffuse)), notes)
    factor = 1.0 if diffuse is None else float(diffuse.wrappedValue)
    red, green, blue = linear(colour)
    return _limited(name, (factor * red, factor * green, factor * blue), notes)


def _limited(name: str, colour: Colour, notes: Notes) -> Look:
    if max(colour) > MOST_REFLECTED:
        notes.say(f"styles that are whiter than white paint reflect {MOST_REFLECTED:g}")
    red, green, blue = (min(max(x, 0.0), MOST_REFLECTED) for x in colour)
    return Look(name, (red, green, blue))


def _shares(colour: Colour) -> Colour:
    red, green, blue = (min(max(x, 0.0), 1.0) for x in colour)
    return red, green, blue
