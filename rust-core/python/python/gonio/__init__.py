"""Physically exact rendering on SIMD lanes, with answers in cd/m² and lux."""

from ._gonio import (
    Cancelled,
    Error,
    Film,
    FormatError,
    Pass,
    Progress,
    Render,
    Scene,
    SceneError,
    SettingError,
    Tile,
    UnsupportedError,
    __version__,
    load_usd,
    read_goniogram,
    simd_level,
)

__all__ = [
    "Cancelled",
    "Error",
    "Film",
    "FormatError",
    "Pass",
    "Progress",
    "Render",
    "Scene",
    "SceneError",
    "SettingError",
    "Tile",
    "UnsupportedError",
    "__version__",
    "load_usd",
    "read_goniogram",
    "simd_level",
]
