"""An office with a window to the south, and years of weather by a rule."""

import math

import office_room

EPW_HEAD = """LOCATION,Here,-,-,-,0,49.52,8.55,1.0,96.0
DESIGN CONDITIONS,0
TYPICAL/EXTREME PERIODS,0
GROUND TEMPERATURES,0
HOLIDAYS/DAYLIGHT SAVINGS,{leap},0,0,0
COMMENTS 1,-
COMMENTS 2,-
DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31
"""
# Slats behind the window that let no light from above the horizon straight through: a variant.
SLATS = [[(0, 0.19, z), (3.6, 0.19, z), (3.6, 0.04, z - 0.16), (0, 0.04, z - 0.16)] for z in (0.95 + 0.14 * number for number in range(12))]
BLINDS = """def Xform "Blinds" (
    variants = {{
        string position = "open"
    }}
    prepend variantSets = "position"
)
{{
    variantSet "position" = {{
        "open" {{
        }}
        "closed" {{
{slats}
        }}
    }}
}}
"""
CLOSED = "/Blinds{position=closed}"


def stage() -> str:
    """The office as a layer of USD; its blinds are open."""
    slats = "".join(office_room.mesh(f"Slat{number}", "ceiling", points) for number, points in enumerate(SLATS))
    return office_room.layer(office_room.ROOM) + BLINDS.format(slats=slats)


def hours(is_leap_year: bool = False) -> list[tuple[int, int, int]]:
    """Month, day and hour at which each interval begins."""
    lengths = [length + (is_leap_year and month == 2) for month, length in enumerate(office_room.MONTHS, 1)]
    return [(month, day, hour) for month, length in enumerate(lengths, 1) for day in range(1, length + 1) for hour in range(24)]


def light(number: int, hour: int) -> tuple[int, int]:
    """Direct normal and diffuse horizontal irradiance, W/m²: clear and grey days; in winter the sky has light before the sun is up."""
    height = math.sin(math.pi * (hour - 5) / 15)
    return round(number // 24 * 37 % 9 * 110 * height) * (9 <= hour <= 15), round((20 + number * 53 % 7 * 35) * height) * (6 <= hour <= 19)


def epw(is_leap_year: bool = False) -> str:
    """The year as an EPW file."""
    lines = []
    for number, (month, day, hour) in enumerate(hours(is_leap_year)):
        direct, diffuse = light(number, hour)
        dew_point = 5 + number % 11
        fields = [2024 if is_leap_year else 2023, month, day, hour + 1, 0, "?", 15, dew_point, 60, 101325, 0, 0, 300]
        fields += [0, direct, diffuse, 999999, 999999, 999999, 9999, 0, 0, 5, 5, 9999, 99999, 9, 999999999, 10, 0.1, 0, 88, 0.2, 0, 0]
        lines.append(",".join(str(field) for field in fields))
    return EPW_HEAD.format(leap="Yes" if is_leap_year else "No") + "\n".join(lines) + "\n"


def wea(direct: list[float], diffuse: list[float]) -> str:
    """A year in lx as a WEA file."""
    rows = zip(hours(), direct, diffuse, strict=True)
    return office_room.PLACE.format(units=3) + "".join(f"{month} {day} {hour}.500 {sun} {sky}\n" for (month, day, hour), sun, sky in rows)
