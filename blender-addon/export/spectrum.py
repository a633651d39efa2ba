# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra of what shines: lamps and materials."""

from pathlib import Path

import bpy
import gonio


def spectrum(shining, report, kind):
    """The spectrum that a lamp or a material names, as the core has it; None, with a report, where it is neither a file nor a name."""
    asked = shining.gonio.spectrum
    path = Path(bpy.path.abspath(asked, library=shining.library))
    try:
        found = gonio.read_spectrum(path.read_bytes(), path.name) if path.is_file() else gonio.illuminant(asked)
    except (OSError, gonio.Error) as error:
        report.add(kind, shining.name, f"{error}; its light keeps its colour")
        return None
    return {key: found[key] for key in ("name", "wavelengths_nm", "power")}
