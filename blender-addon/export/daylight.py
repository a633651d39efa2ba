# SPDX-License-Identifier: GPL-3.0-or-later
"""Sun and sky of a world's place and time, in cd/m² and lux."""

from math import cos, hypot, sin

import gonio
import numpy as np

from ..daylight import of_world
from .light_description import at_infinity

# The angle under which the sun's disc is seen, degrees.
SUN_ANGLE = 0.533


def lights(world, images, report):
    """Descriptions of the dome and of the sun."""
    try:
        daylight = of_world(world)
    except gonio.Error as problem:
        report.add("World", world.name, f"there is no daylight: {problem}", severity="ERROR")
        return []
    turn = world.gonio.north
    north, east = np.array([sin(turn), cos(turn), 0.0]), np.array([cos(turn), -sin(turn), 0.0])
    number = images.changing(("daylight", world.original.session_uid), world.name, np.array(daylight.image()))
    # The picture has the zenith on top and south in the middle.
    axes = np.stack([east, [0.0, 0.0, 1.0], -north], axis=1)
    dome = {"Dome": {"format": "LatLong"}}
    found = [at_infinity(world.name, dome, np.ones(3), axes, texture=number, spectra=daylight.sky_spectra)]
    if daylight.direct_illuminance > 0.0:
        towards_east, towards_north, up = daylight.sun_direction
        towards = towards_east * east + towards_north * north + np.array([0.0, 0.0, up])
        shape = {"Distant": {"angle_deg": SUN_ANGLE}}
        irradiance, spectra = np.array(daylight.sun_irradiance), daylight.sun_spectra
        found.append(at_infinity(world.name, shape, irradiance, facing(towards), normalized=True, spectra=spectra))
    return found


def facing(towards):
    """Axes whose third looks in a direction."""
    x, y, z = towards
    flat = hypot(x, y)
    right = np.array([-y / flat, x / flat, 0.0]) if flat > 1e-9 else np.array([1.0, 0.0, 0.0])
    return np.stack([right, np.cross(towards, right), towards], axis=1)
