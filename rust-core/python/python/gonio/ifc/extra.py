"""IfcOpenShell and USD, which the extra `ifc` brings."""

from __future__ import annotations

import importlib
from typing import Any


def require(name: str) -> Any:
    """A module of ifcopenshell or pxr; ValueError with the remedy where it is absent."""
    package = "usd-core" if name.startswith("pxr") else "ifcopenshell"
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ValueError(f"IFC models need the package {package}: pip install {package} ({error})") from error
