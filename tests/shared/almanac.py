"""Where the sun stands in the hours of a common year: by Meeus' formulas of low accuracy as NOAA's calculator has them, and by Radiance's.

They share nothing with gonio's own. Places are degrees north and east, and hours ahead of universal time.
"""

import numpy as np

HERE = (49.52, 8.55, 1.0)
# Days from noon of 1 January 2000 to midnight before 1 January 2025.
TO_2025 = 25 * 365 + 7 - 0.5
SEEN = -0.2665


def seen(hours, place=HERE, elevation_m=96):
    """Degrees above the horizon as refraction lifts the sun, and radians clockwise from north, at hours of clocks since midnight before 1 January 2025."""
    latitude, longitude, ahead = place
    days = TO_2025 + (hours - ahead) / 24
    century = days / 36525
    anomaly = np.radians(357.52911 + 35999.05029 * century)
    centre = (1.914602 - 0.004817 * century) * np.sin(anomaly) + 0.019993 * np.sin(2 * anomaly) + 0.000289 * np.sin(3 * anomaly)
    node = np.radians(125.04 - 1934.136 * century)
    ecliptic = np.radians(280.46646 + 36000.76983 * century + centre - 0.00569 - 0.00478 * np.sin(node))
    tilt = np.radians(23.439291 - 0.013004 * century + 0.00256 * np.cos(node))
    declination = np.arcsin(np.sin(tilt) * np.sin(ecliptic))
    ascension = np.degrees(np.arctan2(np.cos(tilt) * np.sin(ecliptic), np.cos(ecliptic)))
    turn, north = np.radians(280.46061837 + 360.98564736629 * days + longitude - ascension), np.radians(latitude)
    height = np.degrees(np.arcsin(np.sin(north) * np.sin(declination) + np.cos(north) * np.cos(declination) * np.cos(turn)))
    azimuth = np.pi + np.arctan2(np.sin(turn), np.cos(turn) * np.sin(north) - np.tan(declination) * np.cos(north))
    # Saemundsson's refraction, in the standard atmosphere.
    thin = (1 - 2.25577e-5 * elevation_m) ** 5.25588 * 1013.25 / 1010 * 283 / (288 - 0.0065 * elevation_m)
    lift = thin * 1.02 / 60 / np.tan(np.radians(height + 10.3 / (height + 5.11)))
    return np.where(height < -0.8333, height, height + lift), azimuth


def of_hours(place=HERE, elevation_m=96):
    """Heights in degrees and azimuths in radians of the year's 8760 hours: in their middles, or in the middle of the part in which the sun is up."""
    start = np.arange(8760.0)
    is_up = lambda hours: seen(hours, place, elevation_m)[0] > SEEN  # noqa: E731
    from_start, to_end = is_up(start), is_up(start + 1)
    down, up = np.where(from_start, start + 1, start), np.where(from_start, start, start + 1)
    for _ in range(20):
        middle = 0.5 * (down + up)
        down, up = np.where(is_up(middle), down, middle), np.where(is_up(middle), middle, up)
    rises, sets = ~from_start & to_end, from_start & ~to_end
    time = np.where(rises, 0.5 * (up + start + 1), np.where(sets, 0.5 * (start + up), start + 0.5))
    return seen(time, place, elevation_m)


def directions(place=HERE):
    """Unit vectors of the year's hours: east, north, up."""
    height, azimuth = of_hours(place)
    return _vectors(np.radians(height), azimuth)


def of_radiance(place=HERE):
    """The same by the formulas of Radiance's sun.c, in the middles of the hours."""
    latitude, longitude, ahead = place
    day, hour = np.arange(8760) // 24 + 1, np.arange(8760) % 24 + 0.5
    declination = 0.4093 * np.sin(2 * np.pi / 365 * (day - 81))
    adjusted = 0.170 * np.sin(4 * np.pi / 373 * (day - 80)) - 0.129 * np.sin(2 * np.pi / 355 * (day - 8))
    turn, north = (hour + adjusted + longitude / 15 - ahead) * np.pi / 12, np.radians(latitude)
    up = np.sin(north) * np.sin(declination) - np.cos(north) * np.cos(declination) * np.cos(turn)
    ahead = np.cos(north) * np.sin(declination) + np.sin(north) * np.cos(declination) * np.cos(turn)
    return np.stack([np.cos(declination) * np.sin(turn), ahead, up], axis=1)


def _vectors(height, azimuth):
    return np.stack([np.cos(height) * np.sin(azimuth), np.cos(height) * np.cos(azimuth), np.sin(height)], axis=1)
