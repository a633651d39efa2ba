"""Hošek and Wilkie's sky by wavelength in gonio and in Mitsuba 3, whose `sunsky` has the authors' bands: spectral radiances in a few directions."""

import json
import os
import subprocess
from pathlib import Path

import environments
import gonio
import numpy
import pytest

CHILD = Path(__file__).resolve().parent / "sky_in_mitsuba.py"
BANDS = [440.0, 480.0, 520.0, 560.0, 600.0, 640.0, 680.0]
TURBIDITY, ALBEDO = 3.0, 0.2
# In gonio's axes, east and north; the sun's azimuth is turned away below.
DIRECTIONS = [(0.3, 0.2, 0.9), (-0.5, 0.3, 0.8), (-0.8, 0.0, 0.6), (0.1, -0.9, 0.4)]
# Of a band in a direction, and in the mean over all of them.
MOST, MOST_MEAN = 0.03, 0.015

pytestmark = [pytest.mark.validate, pytest.mark.timeout(600)]


def theirs(elevation: float, directions: list[list[float]]) -> numpy.ndarray:
    """By Mitsuba; skips where it cannot be had."""
    try:
        python = os.environ.get("GONIO_PEER_MITSUBA") or environments.python_of("mitsuba")
    except environments.Unavailable as missing:
        pytest.skip(str(missing))
    command = [str(python), str(CHILD), str(elevation), str(TURBIDITY), str(ALBEDO), json.dumps(directions), json.dumps(BANDS)]
    answer = subprocess.run(command, capture_output=True, text=True, check=False)
    if "No module named" in answer.stderr:
        pytest.skip(answer.stderr.splitlines()[-1])
    assert answer.returncode == 0, answer.stderr
    return numpy.array(json.loads(answer.stdout))


@pytest.mark.parametrize("time", ["2025-06-21T13:00+02:00", "2025-06-21T17:00+02:00"])
def test_spectral_radiances_agree(time: str) -> None:
    day = gonio.daylight(48.21, 16.37, time, sky="hosek-wilkie", turbidity=TURBIDITY, ground=ALBEDO)
    east, north, _ = numpy.array(day.sun_direction) / numpy.hypot(*day.sun_direction[:2])
    directions = [numpy.array(direction) / numpy.linalg.norm(direction) for direction in DIRECTIONS]
    turned = [[float(x * east + y * north), float(y * east - x * north), float(z)] for x, y, z in directions]
    reference = theirs(day.elevation, turned)
    found = []
    for direction in directions:
        made = gonio.Scene()
        made.add_daylight(day)
        made.add_camera(gonio.look_at((0, 0, 0), tuple(direction), up=(0.1, 0.2, 1)), fov=0.5)
        made.set(width=2, height=2, samples=16)
        picture = gonio.spectral_picture(made, band=5.0)
        found.append(numpy.interp(BANDS, picture.wavelengths_nm, numpy.asarray(picture.radiance).mean(axis=(0, 1))))
    ratio = numpy.array(found) / reference
    print(numpy.round(ratio, 4).tolist())
    apart = numpy.abs(ratio - 1.0)
    assert apart.max() < MOST and apart.mean() < MOST_MEAN
