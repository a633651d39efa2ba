"""What `Scene.add_light` takes, as a light's description."""

from __future__ import annotations

from array import array
from collections.abc import Mapping, Sequence
from os import PathLike
from typing import TYPE_CHECKING, Any, TypedDict

from ._gonio import _setting_error, blackbody_rgb
from .description import columns, lamp_spectrum, numbers
from .texture import Texture

if TYPE_CHECKING:
    from .arrays import Matrix

# Keyword arguments that tell the strength in place of the radiance, and their names in descriptions.
QUANTITIES = {"lumens": "Lumens", "lamp_lumens": "LampLumens", "candela": "Candela", "lux": "Lux", "nits": "Nits", "watts": "Watts"}

# Keyword arguments that descriptions have as they are given.
AS_GIVEN = ("dimming", "maintenance", "spot", "group", "goniogram", "texture", "spectrum", "colour_spectra")

# A luminaire that has no extent.
POINT = {"shape": "Point", "size": [0.0] * 3, "heights": [0.0] * 4}


class Photometry(TypedDict, total=False):
    """A light's photometric keyword arguments; None leaves one out."""

    lumens: float | None
    lamp_lumens: float | None
    candela: float | None
    # Illuminance, or illuminance and distance in metres.
    lux: float | tuple[float, float] | None
    nits: float | None
    watts: float | None
    temperature: float | None
    dimming: float
    maintenance: float
    goniogram: Mapping[str, Any] | None
    opening: Mapping[str, Any] | None
    cosine_power: float
    # Full angle in degrees, and blend.
    spot: tuple[float, float] | None
    group: str
    # Multiplies the radiance over a rectangle or a dome.
    texture: Texture | None
    # A name such as "LED-B3", a file, wavelengths in nm and power, or what `illuminant` and `read_spectrum` give.
    spectrum: str | PathLike[str] | Mapping[str, Any] | tuple[Sequence[float], Sequence[float]] | None
    # What red, green and blue of its colour are where light has wavelengths, as `Daylight.sky_spectra` gives it.
    colour_spectra: Mapping[str, Any] | None


def light(
    name: str,
    shape: str,
    radiance: Sequence[float],
    transform: Matrix | None,
    sizes: Mapping[str, float],
    visible: bool,
    photometry: Photometry,
) -> dict[str, Any]:
    """The description of a light of a shape; `sizes` are the width, height, radius, length and angle that shapes may have."""
    given: dict[str, Any] = {key: value for key, value in photometry.items() if value is not None}
    quantity, goniogram = _quantity(given), given.get("goniogram")
    emitter = _shape(shape, sizes, given.get("opening") or (goniogram or {}).get("opening") or POINT)
    if quantity is None and goniogram is not None and shape in {"point", "luminaire"}:
        quantity = "Measured"
    if "texture" in given:
        given["texture"] = given["texture"].number
    if "spot" in given:
        given["spot"] = dict(zip(("angle_deg", "blend"), numbers("spot", given["spot"], 2), strict=True))
    if "spectrum" in given:
        given["spectrum"] = lamp_spectrum(given["spectrum"])
    return {
        "origin": name,
        "shape": emitter,
        "emission": {"radiance": _radiance(radiance, given), "normalized": shape == "distant", "metres_per_unit": 1.0},
        "quantity": quantity,
        "shaping": _shaping(given.get("cosine_power", 0.0)),
        "transform": columns(transform),
        "visibility": {"camera": visible},
        "casts_shadow": True,
        **{key: given[key] for key in AS_GIVEN if key in given},
    }


def _quantity(given: Mapping[str, Any]) -> Any:
    """The quantity among the arguments, None without one."""
    quantity = None
    for key, value in given.items():
        if key not in Photometry.__annotations__:
            raise _setting_error(key, "a light has no setting of this name")
        if key not in QUANTITIES:
            continue
        if quantity is not None:
            raise _setting_error(key, "a light has one quantity, and another was given beside it")
        if key == "lux":
            illuminance, distance = value if hasattr(value, "__len__") else (value, 1.0)
            value = {"illuminance": illuminance, "distance": distance}
        quantity = {QUANTITIES[key]: value}
    return quantity


def _shape(shape: str, sizes: Mapping[str, float], opening: Mapping[str, Any]) -> Any:
    """The emitter of a name."""

    def sized(kind: str, *names: str) -> dict[str, Any]:
        return {kind: {name: sizes[name] for name in names}}

    match shape:
        case "rectangle":
            return sized("Rectangle", "width", "height")
        case "disk" | "sphere":
            return sized(shape.title(), "radius")
        case "cylinder":
            return sized("Cylinder", "radius", "length")
        case "point":
            return "Point"
        case "luminaire":
            return {"Opening": opening}
        case "distant":
            return {"Distant": {"angle_deg": sizes["angle"]}}
        case "dome":
            return {"Dome": {"format": "Automatic"}}
    expected = "rectangle, disk, sphere, cylinder, point, luminaire, distant or dome"
    raise _setting_error("shape", f"'{shape}' was found, expected {expected}")


def _radiance(radiance: Sequence[float], given: Mapping[str, Any]) -> list[float]:
    """The radiance with the temperature's colour; float32 before they are multiplied, as descriptions have it."""
    found = array("f", numbers("radiance", radiance, 3))
    if "temperature" not in given:
        return found.tolist()
    return [value * colour for value, colour in zip(found, blackbody_rgb(given["temperature"]), strict=True)]


def _shaping(power: float) -> dict[str, Any]:
    """I = I₀ · cosⁿ θ, to the front alone; a power of 0 leaves the light as it is."""
    cone = {"cone_angle_deg": 90.0, "focus": power} if power > 0.0 else {"cone_angle_deg": None, "focus": 0.0}
    return {**cone, "cone_softness": 0.0, "focus_tint": [0.0] * 3}
