"""Elements of a scene by keywords, as the descriptions that `put_material`, `put_camera` and the like take."""

from __future__ import annotations

import math
import sys
from array import array
from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ._gonio import _setting_error, glass, illuminant, metal, read_glass, read_metal, read_spectrum, surface_parameters
from .texture import Texture

if TYPE_CHECKING:
    from .arrays import Matrix

# Names of what meters measure, and their names in descriptions.
MEASURANDS = {
    "illuminance": "Illuminance",
    "cylindrical": "Cylindrical",
    "semicylindrical": "Semicylindrical",
    "daylight-factor": "DaylightFactor",
    "luminance": "Luminance",
    "melanopic-edi": "MelanopicEdi",
    "cct": "Cct",
    "duv": "Duv",
    "ra": "Ra",
    "rf": "Rf",
    "rg": "Rg",
    "ugr": "Ugr",
}


def numbers(name: str, values: Sequence[float], count: int) -> list[float]:
    """So many floats."""
    found = array("d", [*values]).tolist()
    if len(found) != count:
        raise ValueError(f"{name}: {len(found)} numbers were found, expected {count}")
    return found


def columns(matrix: Matrix | None) -> dict[str, Any]:
    """A 4×4 matrix for column vectors (translation in the last column), or None for the identity, as descriptions have it."""
    if matrix is None:
        matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    rows = [array("d", [float(value) for value in row]) for row in matrix]
    if len(rows) != 4 or any(len(row) != 4 for row in rows):
        raise ValueError("transform: expected a 4 by 4 matrix")
    return {"columns": [[row[column] for row in rows[:3]] for column in range(4)]}


def material(name: str, parameters: Mapping[str, Any]) -> dict[str, Any]:
    """A material of one OpenPBR surface; its parameters are numbers, triples or textures, `normal` a texture of tangent-space normals, `metal` and
    `glass` what it is made of, `spectrum` what its emission is of."""
    given = dict(parameters)
    closure: dict[str, Any] = {"thin_walled": given.pop("thin_walled", False)}
    nodes: list[dict[str, Any]] = []
    if (normal := given.pop("normal", None)) is not None:
        if not isinstance(normal, Texture):
            raise _setting_error("normal", "expected a texture of tangent-space normals")
        nodes += normal.nodes(0, is_normal=True)
        closure["normal"] = len(nodes) - 1
    if (metal_of := given.pop("metal", None)) is not None:
        closure["metal"] = metal_index(metal_of)
    if (glass_of := given.pop("glass", None)) is not None:
        closure["glass"] = glass_index(glass_of)
    described = {"origin": name, "closures": [closure], "graph": {"nodes": nodes}}
    if (spectrum := given.pop("spectrum", None)) is not None:
        described["spectrum"] = lamp_spectrum(spectrum)
    closure["parameters"] = [(key, _input(key, value, nodes)) for key, value in given.items()]
    return described


def lamp_spectrum(spectrum: Any) -> dict[str, Any]:
    """What something shines with, as descriptions have it."""
    spectrum = _file_or_name(spectrum, read_spectrum, illuminant)
    if not isinstance(spectrum, Mapping):
        try:
            wavelengths, power = spectrum
            spectrum = {"wavelengths_nm": [float(nm) for nm in wavelengths], "power": [float(value) for value in power]}
        except (TypeError, ValueError) as error:
            expected = "expected a name, a file, (wavelengths in nm, power), or what `gonio.read_spectrum` gives"
            raise _setting_error("spectrum", expected) from error
    return {key: spectrum[key] for key in ("name", "wavelengths_nm", "power") if key in spectrum}


def metal_index(of: Any) -> dict[str, Any]:
    """A metal as descriptions have it."""
    return _index("metal", _file_or_name(of, read_metal, metal), ("name", "wavelengths_nm", "n", "k"))


def glass_index(of: Any) -> dict[str, Any]:
    """A glass or liquid as descriptions have it."""
    return _index("glass", _file_or_name(of, read_glass, glass), ("name", "wavelengths_nm", "n"))


def _index(kind: str, of: Any, parts: Sequence[str]) -> dict[str, Any]:
    """The parts of an index of refraction."""
    if not isinstance(of, Mapping):
        raise _setting_error(kind, f"expected a name, a file, or what `gonio.{kind}` gives")
    return {key: of[key] for key in parts if key in of}


def _file_or_name(of: Any, read: Callable[[bytes, str], Any], named: Callable[[str], Any]) -> Any:
    """What a file or a name stands for; all else as it is."""
    if not isinstance(of, (str, PathLike)):
        return of
    path = Path(of)
    return read(path.read_bytes(), path.name) if path.is_file() else named(str(of))


def _input(name: str, value: Any, nodes: list[dict[str, Any]]) -> dict[str, Any]:
    """A parameter's value as an input of a graph, which gets the nodes of textures."""
    if not isinstance(value, Texture):
        return {"Constant": _constant(name, value)}
    channel = "Rgb" if _width(name) == 3 else value.component
    nodes += value.nodes(len(nodes))
    return {"Node": [len(nodes) - 1, channel]}


def _width(name: str) -> int:
    """Numbers that a parameter takes."""
    width = surface_parameters.get(name)
    if width is None:
        raise _setting_error(name, "the surface has no parameter of this name")
    return width


def _constant(name: str, value: Any) -> list[float]:
    """A parameter's value in four components."""
    width = _width(name)
    found = array("d", [*value] if hasattr(value, "__len__") else [value] * width)
    if len(found) != width:
        raise _setting_error(name, f"{len(found)} numbers were found, expected {width}")
    return [*found, 1.0, 1.0, 1.0][:4]


def camera(name: str, transform: Matrix | None, fov: float, resolution: tuple[int, int]) -> dict[str, Any]:
    """A pinhole with a vertical field of view in degrees, for a picture of this width and height."""
    width, height = resolution
    opening = 2.0 * math.tan(math.radians(fov) * 0.5)
    return {
        "origin": name,
        "projection": {"Perspective": {"focal_length": 1.0}},
        "aperture": [opening * (width / max(height, 1)), opening],
        "aperture_offset": [0.0, 0.0],
        "lens_radius": 0.0,
        "focus_distance": 1.0,
        "clipping": [0.0, sys.float_info.max],
        "transform": columns(transform),
        "exposure": 1.0,
    }


def measurand(quantity: str) -> str:
    """What a quantity is called in descriptions."""
    if quantity not in MEASURANDS:
        raise _setting_error("quantity", f"'{quantity}' was found, expected one of {', '.join(MEASURANDS)}")
    return MEASURANDS[quantity]
