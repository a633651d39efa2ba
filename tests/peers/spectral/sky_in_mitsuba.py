"""Spectral radiances of Mitsuba's `sunsky` without its sun: run by a Python that has `mitsuba`.

    python sky_in_mitsuba.py ELEVATION TURBIDITY ALBEDO DIRECTIONS WAVELENGTHS

The sun stands over +x, +z is up. Answers in JSON with W/(m² sr nm) for each of the directions at each of the wavelengths (nm), both in JSON.
"""

import json
import sys

import mitsuba
import numpy

# A spectrum under way in this variant has so many wavelengths.
COUNT = 4


def main(elevation: float, turbidity: float, albedo: float, directions: list[list[float]], wavelengths: list[float]) -> None:
    """Asks the emitter."""
    mitsuba.set_variant("scalar_spectral")
    height = numpy.radians(elevation)
    sky = mitsuba.load_dict(
        {
            "type": "sunsky",
            "sun_direction": [float(numpy.cos(height)), 0.0, float(numpy.sin(height))],
            "turbidity": turbidity,
            "albedo": {"type": "uniform", "value": albedo},
            "sun_scale": 0.0,
        }
    )
    padded = [*wavelengths, *[wavelengths[-1]] * (-len(wavelengths) % COUNT)]
    asked = mitsuba.SurfaceInteraction3f()
    found = []
    for direction in directions:
        asked.wi = [-part for part in direction]
        values: list[float] = []
        for first in range(0, len(padded), COUNT):
            asked.wavelengths = padded[first : first + COUNT]
            values += [float(value) for value in sky.eval(asked)]
        found.append(values[: len(wavelengths)])
    print(json.dumps(found))


if __name__ == "__main__":
    main(*map(float, sys.argv[1:4]), *map(json.loads, sys.argv[4:6]))
