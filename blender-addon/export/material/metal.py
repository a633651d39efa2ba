# SPDX-License-Identifier: GPL-3.0-or-later
"""What metal a material is made of."""

import gonio

from ..file_or_name import file_or_name


def metal(material, report):
    """The metal that a material names, as the core has it; None, with a report, where it is neither a name nor a file."""
    asked = material.gonio.metal
    if not asked:
        return None
    try:
        found = file_or_name(asked, material, gonio.read_metal, gonio.metal)
    except (OSError, gonio.Error) as error:
        report.add("Material", material.name, f"{error}; the material keeps its colours", material=material.name)
        return None
    for note in found["notes"]:
        report.add("Material", material.name, f"{found['name']}: {note}", material=material.name)
    return {key: found[key] for key in ("name", "wavelengths_nm", "n", "k")}
