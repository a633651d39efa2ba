# SPDX-License-Identifier: GPL-3.0-or-later
"""Daylight of a world: place, time and weather."""

from math import radians

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from .switch import switch
from .tag import tag_data

# Latitude and longitude in degrees, and hours that clocks are ahead of UTC in winter.
CITIES = {
    "AMSTERDAM": ("Amsterdam", 52.37, 4.90, 1.0),
    "ATHENS": ("Athens", 37.98, 23.73, 2.0),
    "BEIJING": ("Beijing", 39.90, 116.41, 8.0),
    "BERLIN": ("Berlin", 52.52, 13.41, 1.0),
    "BUENOS_AIRES": ("Buenos Aires", -34.60, -58.38, -3.0),
    "CAIRO": ("Cairo", 30.04, 31.24, 2.0),
    "CAPE_TOWN": ("Cape Town", -33.92, 18.42, 2.0),
    "CHICAGO": ("Chicago", 41.88, -87.63, -6.0),
    "DELHI": ("Delhi", 28.61, 77.21, 5.5),
    "DUBAI": ("Dubai", 25.20, 55.27, 4.0),
    "HELSINKI": ("Helsinki", 60.17, 24.94, 2.0),
    "HONG_KONG": ("Hong Kong", 22.32, 114.17, 8.0),
    "ISTANBUL": ("Istanbul", 41.01, 28.98, 3.0),
    "JAKARTA": ("Jakarta", -6.21, 106.85, 7.0),
    "LAGOS": ("Lagos", 6.52, 3.38, 1.0),
    "LIMA": ("Lima", -12.05, -77.04, -5.0),
    "LONDON": ("London", 51.51, -0.13, 0.0),
    "LOS_ANGELES": ("Los Angeles", 34.05, -118.24, -8.0),
    "MADRID": ("Madrid", 40.42, -3.70, 1.0),
    "MEXICO_CITY": ("Mexico City", 19.43, -99.13, -6.0),
    "MOSCOW": ("Moscow", 55.76, 37.62, 3.0),
    "MUMBAI": ("Mumbai", 19.08, 72.88, 5.5),
    "NAIROBI": ("Nairobi", -1.29, 36.82, 3.0),
    "NEW_YORK": ("New York", 40.71, -74.01, -5.0),
    "OSLO": ("Oslo", 59.91, 10.75, 1.0),
    "PARIS": ("Paris", 48.86, 2.35, 1.0),
    "REYKJAVIK": ("Reykjavik", 64.15, -21.94, 0.0),
    "ROME": ("Rome", 41.90, 12.50, 1.0),
    "SAO_PAULO": ("São Paulo", -23.55, -46.63, -3.0),
    "SEOUL": ("Seoul", 37.57, 126.98, 9.0),
    "SINGAPORE": ("Singapore", 1.35, 103.82, 8.0),
    "STOCKHOLM": ("Stockholm", 59.33, 18.07, 1.0),
    "SYDNEY": ("Sydney", -33.87, 151.21, 10.0),
    "TOKYO": ("Tokyo", 35.68, 139.69, 9.0),
    "TORONTO": ("Toronto", 43.65, -79.38, -5.0),
    "VIENNA": ("Vienna", 48.21, 16.37, 1.0),
    "WARSAW": ("Warsaw", 52.23, 21.01, 1.0),
    "ZURICH": ("Zürich", 47.37, 8.54, 1.0),
}

# The numbers are stored in files: never change or reuse one.
SKIES = (
    ("PEREZ", "All Weathers (Perez)", "Luminances by two irradiances: measured ones, or those of a cloudless day", 0),
    ("HOSEK_WILKIE", "Clear (Hošek-Wilkie)", "A clear to hazy sky with its own colours and luminances", 1),
    ("OVERCAST", "CIE Overcast", "The traditional overcast sky: three times brighter at the zenith than at the horizon, no sun", 16),
    ("CIE1", "CIE 1", "Overcast, steep gradation, even about the sun", 101),
    ("CIE2", "CIE 2", "Overcast, steep gradation, slightly brighter towards the sun", 102),
    ("CIE3", "CIE 3", "Overcast, moderately graded, even about the sun", 103),
    ("CIE4", "CIE 4", "Overcast, moderately graded, slightly brighter towards the sun", 104),
    ("CIE5", "CIE 5", "Uniform", 105),
    ("CIE6", "CIE 6", "Partly cloudy, not graded, slightly brighter towards the sun", 106),
    ("CIE7", "CIE 7", "Partly cloudy, not graded, brighter about the sun", 107),
    ("CIE8", "CIE 8", "Partly cloudy, not graded, with a distinct corona", 108),
    ("CIE9", "CIE 9", "Partly cloudy, the sun is veiled", 109),
    ("CIE10", "CIE 10", "Partly cloudy, brighter about the sun", 110),
    ("CIE11", "CIE 11", "White-blue, with a distinct corona", 111),
    ("CIE12", "CIE 12", "Clear, clean air", 112),
    ("CIE13", "CIE 13", "Clear, polluted air", 113),
    ("CIE14", "CIE 14", "Cloudless, turbid, with a broad corona", 114),
    ("CIE15", "CIE 15", "White-blue, turbid, with a broad corona", 115),
)


def _take_city(settings, context) -> None:
    """Puts the place of the chosen city into the fields, which may be changed after."""
    if settings.city != "NONE":
        _, settings.latitude, settings.longitude, settings.utc_offset = CITIES[settings.city]
    tag_data(settings, context)


def _number(name, description, default, low, high, **more):
    return FloatProperty(name=name, description=description, default=default, min=low, max=high, update=tag_data, **more)


def _whole(name, description, default, low, high):
    return IntProperty(name=name, description=description, default=default, min=low, max=high, update=tag_data)


class GonioWorldSettings(bpy.types.PropertyGroup):
    """Settings of one world."""

    use_luminance: switch(
        "Luminance", "State in cd/m² how bright the background is, whose picture and strength then are factors on it", tag_data
    )
    luminance: _number("Luminance", "Luminance in cd/m² of a background of strength 1, white where there is no picture", 1000.0, 0.0, 1e9)
    use_daylight: switch(
        "Daylight", "Light the scene by sun and sky of a place and a time, in lux, in the place of the world's nodes", tag_data
    )
    city: EnumProperty(
        name="City",
        description="Put the coordinates and the time zone of a city into the fields below",
        items=[("NONE", "Choose a City", "Leave the coordinates as they are"), *((key, city[0], "") for key, city in CITIES.items())],
        default="NONE",
        update=_take_city,
    )
    latitude: _number("Latitude", "Degrees north of the equator, south is negative", 48.21, -90.0, 90.0, precision=4, step=10)
    longitude: _number("Longitude", "Degrees east of Greenwich, west is negative", 16.37, -180.0, 180.0, precision=4, step=10)
    elevation: _number("Elevation", "Height above the sea", 0.0, -500.0, 9000.0, unit="LENGTH", step=1000)
    year: _whole("Year", "Year of the Gregorian calendar", 2025, 1600, 2999)
    month: _whole("Month", "1 is January", 6, 1, 12)
    day: _whole("Day", "Day of the month", 21, 1, 31)
    hour: _number(
        "Hour", "Time of day in hours on the clock of the time zone, 14.5 is half past two. Keyframes animate the day", 12.0, 0.0, 24.0
    )
    utc_offset: _number(
        "UTC Offset", "Hours that the clock is ahead of UTC; one more in summer where clocks are changed", 1.0, -14.0, 14.0, step=50
    )
    north: _number(
        "North", "Angle from the scene's +Y to true north, clockwise seen from above", 0.0, radians(-360.0), radians(360.0), subtype="ANGLE"
    )
    sky: EnumProperty(name="Sky", description="How luminance is spread over the sky", items=SKIES, default="PEREZ", update=tag_data)
    turbidity: _number("Turbidity", "Haze by Linke: 2 in the mountains, 3 in the country, 5 in a city", 3.0, 1.0, 10.0)
    use_irradiance: switch(
        "Measured Irradiance", "Take the brightness of sun and sky from measured values, as weather files have them", tag_data
    )
    direct_normal: _number("Direct Normal", "Irradiance by the sun's disc of a surface that faces it, in W/m²", 800.0, 0.0, 1500.0)
    diffuse_horizontal: _number("Diffuse Horizontal", "Irradiance by the sky of a level surface, in W/m²", 100.0, 0.0, 1500.0)
    ground: _number(
        "Ground Albedo",
        "Share of the light that the ground beyond the scene reflects; it shows below the horizon, black if 0",
        0.0,
        0.0,
        1.0,
    )
    use_colour: BoolProperty(
        name="Colors", description="Blue sky and warm sun; without it both are white, as bright as with it", default=True, update=tag_data
    )
