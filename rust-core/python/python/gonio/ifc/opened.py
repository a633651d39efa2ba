"""IFC files: opened, or refused with what is wrong with them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from .extra import require

# IfcOpenShell holds a file in some ten times its size.
MOST_BYTES = 2 << 30
# A STEP file says what it is near its start, and its end is its last word.
HEAD = b"ISO-10303-21"
END = b"END-ISO-10303-21"
LOOKED_AT = 4096


def open_model(path: Path) -> Any:
    """The model; ValueError for what is no whole IFC file of a schema that is known."""
    problem = _problem(path)
    if problem:
        raise ValueError(f"{path}: {problem}")
    ifcopenshell = require("ifcopenshell")
    try:
        model = ifcopenshell.open(str(path))
        projects = model.by_type("IfcProject")
    except Exception as error:  # IfcOpenShell has several of its own, without a common base.
        raise ValueError(f"{path}: IfcOpenShell cannot read it: {error}; IFC2X3, IFC4 and IFC4X3 are read") from error
    if not projects:
        raise ValueError(f"{path}: there is no IfcProject; export the whole model")
    return model


def _problem(path: Path) -> str | None:
    """What is wrong with a file, as far as its ends tell."""
    if not path.exists():
        return "there is no such file"
    if not path.is_file():
        return "a folder, a pipe or a device was found, expected a file"
    try:
        size = path.stat().st_size
        with path.open("rb") as file:
            head = file.read(LOOKED_AT)
            file.seek(max(0, size - LOOKED_AT))
            tail = file.read()
    except OSError as error:
        return str(error.strerror or error)
    if size == 0:
        return "the file is empty"
    if head.startswith(b"PK"):
        return "this is a zip archive; unpack the .ifc file in it"
    if HEAD not in head:
        return f"this is no IFC file, which begins with {HEAD.decode()}; XML and other forms of IFC are not read, export STEP (.ifc)"
    if END not in tail:
        return f"the file is cut off: {END.decode()} at its end is missing"
    if size > MOST_BYTES:
        return f"{size / 2**30:.1f} GiB are more than the {MOST_BYTES >> 30} GiB that are read; export storeys or disciplines by themselves"
    return None
