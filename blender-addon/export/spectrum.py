# SPDX-License-Identifier: GPL-3.0-or-later
"""Spectra of what shines: lamps and materials."""

import gonio

from .file_or_name import file_or_name


def spectrum(shining, report, kind, **place):
    """The spectrum that a lamp or a material names, as the core has it; None, with a line of the report at this place, where it is neither a file nor
    a name."""
    try:
        found = file_or_name(shining.gonio.spectrum, shining, gonio.read_spectrum, gonio.illuminant)
    except (OSError, gonio.Error) as error:
        report.add(kind, shining.name, f"{error}; its light keeps its colour", **place)
        return None
    return {key: found[key] for key in ("name", "wavelengths_nm", "power")}
