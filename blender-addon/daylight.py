# SPDX-License-Identifier: GPL-3.0-or-later
"""What a world's settings say of sun and sky, for its panel and for the export."""

from functools import lru_cache

import gonio


def of_world(world):
    """The `gonio.Daylight` of a world's settings; raises `gonio.Error` where there is no such day."""
    s = world.gonio
    measured = (s.direct_normal, s.diffuse_horizontal) if s.use_irradiance else (None, None)
    sky = s.sky.lower().replace("_", "-")
    return _daylight(s.latitude, s.longitude, _time(s), s.elevation, sky, s.turbidity, *measured, s.ground, s.use_colour)


def _time(settings) -> str:
    """ISO 8601, to the millisecond."""
    milliseconds = round(settings.hour * 3_600_000.0)
    minutes, milliseconds = divmod(milliseconds, 60_000)
    offset = round(settings.utc_offset * 60.0)
    date = f"{settings.year:04d}-{settings.month:02d}-{settings.day:02d}"
    clock = f"{minutes // 60:02d}:{minutes % 60:02d}:{milliseconds / 1000.0:06.3f}"
    return f"{date}T{clock}{'-' if offset < 0 else '+'}{abs(offset) // 60:02d}:{abs(offset) % 60:02d}"


# Panels ask at every redraw.
@lru_cache(maxsize=16)
def _daylight(latitude, longitude, time, elevation, sky, turbidity, direct_normal, diffuse_horizontal, ground, coloured):
    return gonio.daylight(
        latitude,
        longitude,
        time,
        elevation=elevation,
        sky=sky,
        turbidity=turbidity,
        direct_normal=direct_normal,
        diffuse_horizontal=diffuse_horizontal,
        ground=ground,
        coloured=coloured,
    )
