# SPDX-License-Identifier: GPL-3.0-or-later
"""What metal a material is made of."""

from pathlib import Path

import bpy
import gonio


def metal(material, report):
    """The metal that a material names, as the core has it; None, with a report, where it is neither a name nor a file."""
    asked = material.gonio.metal
    if not asked:
        return None
    path = Path(bpy.path.abspath(asked, library=material.library))
    try:
        found = gonio.read_metal(path.read_bytes(), path.name) if path.is_file() else gonio.metal(asked)
    except (OSError, gonio.Error) as error:
        report.add("Material", material.name, f"{error}; the material keeps its colours", material=material.name)
        return None
    for note in found["notes"]:
        report.add("Material", material.name, f"{found['name']}: {note}", material=material.name)
    return {key: found[key] for key in ("name", "wavelengths_nm", "n", "k")}
