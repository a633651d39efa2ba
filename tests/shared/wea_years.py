"""What made weather files of a whole year have in common: the head of one in lux, the dates of its hours and their middles."""

import numpy as np

MONTHS = (31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)
HEAD = "place Here\nlatitude 49.52\nlongitude -8.55\ntime_zone -15\nsite_elevation 96\nweather_data_file_units 3\n"
DATES = [(month, day, hour) for month, days in enumerate(MONTHS, 1) for day in range(1, days + 1) for hour in range(24)]
HOUR = np.arange(8760) % 24 + 0.5


def write_wea(path, direct, diffuse):
    """The file of direct normal and diffuse horizontal illuminances by hour, whole lx."""
    rows = zip(DATES, direct, diffuse, strict=True)
    path.write_text(HEAD + "".join(f"{month} {day} {hour}.500 {sun:.0f} {sky:.0f}\n" for (month, day, hour), sun, sky in rows))
