# SPDX-License-Identifier: GPL-3.0-or-later
"""What metal and what glass a material is made of."""

import gonio

from ..file_or_name import file_or_name


def metal(material, report):
    """The metal that a material names, as the core has it; None, with a report, where it is neither a name nor a file."""
    found = _found(material.gonio.metal, material, gonio.read_metal, gonio.metal, "the material keeps its colours", report)
    return None if found is None else {key: found[key] for key in ("name", "wavelengths_nm", "n", "k")}


def glass(material, report):
    """The glass or liquid that a material names, likewise."""
    found = _found(material.gonio.glass, material, gonio.read_glass, gonio.glass, "the material keeps its index", report)
    return None if found is None else {key: found[key] for key in ("name", "wavelengths_nm", "n")}


def _found(asked, material, read, named, otherwise, report):
    if not asked:
        return None
    try:
        found = file_or_name(asked, material, read, named)
    except (OSError, gonio.Error) as error:
        report.add("Material", material.name, f"{error}; {otherwise}", material=material.name)
        return None
    for note in found["notes"]:
        report.add("Material", material.name, f"{found['name']}: {note}", material=material.name)
    return found
