"""IfcOpenShell and USD, which the extra `ifc` brings."""

from __future__ import annotations

import importlib
from typing import Any

# What to do where a package is absent.
REMEDIES = {
    "ifcopenshell": "IFC models need IfcOpenShell: pip install ifcopenshell",
    "pxr": "IFC models need USD: pip install usd-core",
}


def require(name: str) -> Any:
    """A module of ifcopenshell or pxr; ValueError with the remedy where it cannot be loaded."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ValueError(f"{REMEDIES[name.split('.')[0]]} ({error})") from error
