# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps whose strength is stated in photometric units or by a luminaire's file."""

from math import cos, sin

import gonio
import numpy as np

from .. import luminaire
from .spectrum import spectrum
from .transforms import columns, without_scale

QUANTITIES = {
    "LUMEN": "Lumens",
    "LAMP_LUMEN": "LampLumens",
    "CANDELA": "Candela",
    "NIT": "Nits",
    "WATT": "Watts",
}


def apply(description, lamp, colour, matrix, report):
    """Gives a lamp's description its photometry; `colour` is what tells its colour alone."""
    settings = lamp.gonio
    description["emission"]["radiance"] = [float(x) for x in colour]
    description.update(dimming=settings.dimming, maintenance=settings.maintenance)
    if lamp.type == "AREA" and settings.is_tube:
        ((_, sides),) = description["shape"].items()
        description["shape"] = {"Cylinder": {"radius": 0.5 * sides["height"], "length": sides["width"]}}
        description["spread_deg"] = 180.0
    if lamp.type in ("POINT", "SPOT") and settings.cosine_power > 0.0:
        description["shaping"].update(focus=settings.cosine_power, cone_angle_deg=90.0)
    _luminaire(description, lamp, np.asarray(matrix, dtype=float), report)
    description["quantity"] = _quantity(settings, report, lamp)
    if settings.spectrum:
        description["spectrum"] = spectrum(lamp, report, "Light")


def _quantity(settings, report, lamp):
    if settings.unit == "LUX":
        return {"Lux": {"illuminance": settings.quantity, "distance": settings.distance}}
    if settings.unit in QUANTITIES:
        return {QUANTITIES[settings.unit]: settings.quantity}
    if not settings.file:
        report.add("Light", lamp.name, "no file tells how strong the light is")
    return "Measured"


def _luminaire(description, lamp, matrix, report):
    """The file's intensities, what shines, and how it is turned."""
    try:
        found = luminaire.goniogram(lamp)
    except (OSError, gonio.Error) as error:
        # The file tells how strong the light is, not only where it shines.
        by_file = lamp.gonio.unit in ("FILE", "LAMP_LUMEN")
        report.add("Light", lamp.name, f"{error}; the light {'stays dark' if by_file else 'counts as uniform'}")
        return
    if found is None:
        return
    goniogram, warnings = found
    for warning in warnings:
        report.add("Light", lamp.name, warning)
    description["goniogram"] = goniogram
    description["spread_deg"] = 180.0
    opening = lamp.gonio.opening
    if opening == "POINT":
        description["shape"] = "Point"
    else:
        description["shape"] = {"Opening": goniogram["opening"] if opening == "FILE" else _own_opening(description["shape"])}
    # Files state openings in metres, however large the lamp was made.
    own_size = opening == "LIGHT" and lamp.type == "AREA"
    description["transform"] = columns((matrix if own_size else np.asarray(without_scale(matrix))) @ _turn(lamp.gonio.rotation))


def _own_opening(shape):
    """The opening that a lamp's shape is."""
    if shape == "Point":
        return {"shape": "Point", "size": [0.0] * 3, "heights": [0.0] * 4}
    ((kind, fields),) = shape.items()
    if kind in ("Rectangle", "Ellipse"):
        form = "Rectangle" if kind == "Rectangle" else "Disk"
        return {"shape": form, "size": [fields["width"], fields["height"], 0.0], "heights": [0.0] * 4}
    if kind == "Cylinder":
        across = 2.0 * fields["radius"]
        return {"shape": "CylinderAlongX", "size": [fields["length"], across, across], "heights": [across] * 4}
    return {"shape": "Ellipsoid", "size": [2.0 * fields["radius"]] * 3, "heights": [2.0 * fields["radius"]] * 4}


def _turn(angle):
    turn = np.eye(4)
    turn[:2, :2] = [[cos(angle), -sin(angle)], [sin(angle), cos(angle)]]
    return turn
