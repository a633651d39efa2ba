"""The sun's place and the skies' luminances against what is published."""

import datetime
import functools
import hashlib
import math
from pathlib import Path

import confidence
import figures
import general_sky
import gonio
import numpy
import perez
import pytest
from rooms import LUMINANCE, Plane, Room

pytestmark = pytest.mark.validate

SECTION = "Sun and skies"
COEFFICIENTS = Path(__file__).resolve().parents[3] / "rust-core" / "engine" / "src" / "sky" / "hosek_wilkie.f32"
# Of all 3600 numbers of ArHosekSkyModelData_RGB.h (the authors' release 1.4a) in their order, as little-endian floats.
PUBLISHED = "491919ee5aa271ce6512d325e9c1b73b32e2f34c209e0e3a2bc42f43163790a9"
# A place and a day on which the sun passes through nearly all heights.
PLACE, DAY = (20.0, 0.0), datetime.datetime(2025, 6, 21, tzinfo=datetime.UTC)
HEIGHTS = (5.0, 15.0, 30.0, 45.0, 60.0, 75.0)
BRIGHTNESSES = (0.05, 0.15, 0.3)
OUTSIDE = 1367.0 * (1.0 + 0.033 * math.cos(2 * math.pi * 172 / 365))


def degrees_off(case, found, expected, limit=0.003):
    """A row of angles."""
    off = [abs((a - b + 180.0) % 360.0 - 180.0) for a, b in zip(found, expected, strict=True)]
    figures.check(figures.Row(SECTION, case, "published position", len(off), max(off), limit, unit="degrees"))


def test_the_report_s_sun():
    """NREL/TP-560-34302, A.5."""
    air = {"elevation": 1830.14, "pressure": 820.0, "temperature": 11.0}
    sun = gonio.daylight(39.742476, -105.1786, "2003-10-17T12:30:30-07:00", **air)
    degrees_off("sun of the SPA report's example, zenith angle and azimuth", (90 - sun.elevation, sun.azimuth), (50.111622, 194.340241))


def test_a_sun_near_the_equator():
    """A value that implementations of the algorithm are tested with."""
    sun = gonio.daylight(-3.107, -60.025, "2015-06-12T09:34:11-04:00", elevation=100.0, pressure=1000.0, temperature=20.0)
    degrees_off("sun in the morning near the equator, zenith angle and azimuth", (90 - sun.elevation, sun.azimuth), (44.1425, 51.608))


@functools.cache
def when(height):
    """The morning's moment at which the sun is so high, by bisection."""
    low, high = 5.0, 12.0
    for _ in range(30):
        middle = 0.5 * (low + high)
        is_lower = gonio.daylight(*PLACE, DAY + datetime.timedelta(hours=middle)).elevation < height
        low, high = (middle, high) if is_lower else (low, middle)
    return DAY + datetime.timedelta(hours=low)


def weathers(clearness):
    """Height, brightness, both irradiances and the daylight of a table of weathers of a clearness."""
    for height in HEIGHTS:
        zenith = math.radians(90 - height)
        mass = 1.0 / (math.sin(math.radians(height)) + 0.50572 * (height + 6.07995) ** -1.6364)
        for brightness in BRIGHTNESSES:
            direct, diffuse = perez.irradiances(clearness, brightness, zenith, mass, OUTSIDE)
            if direct <= OUTSIDE:
                weather = {"direct_normal": direct, "diffuse_horizontal": diffuse, "dew_point": 11.0}
                yield height, brightness, direct, diffuse, gonio.daylight(*PLACE, when(height), sky="perez", **weather)


def drawn(day, rows=128):
    """Illuminance of level ground by the sky's picture: each pixel's share of ∫ cos θ dω is exact."""
    picture = numpy.asarray(day.image(rows))[..., :3].astype(float) @ LUMINANCE
    edges = numpy.sin(numpy.minimum(numpy.pi * numpy.arange(rows + 1) / rows, numpy.pi / 2)) ** 2
    return float((picture.mean(axis=1) * numpy.diff(edges)).sum() * math.pi)


@pytest.mark.parametrize("clearness", perez.CLASSES)
def test_perez_s_illuminances(clearness):
    values = []
    for height, brightness, direct, diffuse, day in weathers(clearness):
        zenith = math.radians(90 - height)
        sky = diffuse * perez.diffuse_efficacy(clearness, brightness, zenith)
        values.append((drawn(day), sky, day.direct_illuminance, direct * perez.direct_efficacy(clearness, brightness, zenith)))
    found, expected, sun, expected_sun = numpy.array(values).T
    # The sun's at least to a lumen.
    off = numpy.maximum(numpy.abs(found / expected - 1), numpy.abs(sun - expected_sun) / numpy.maximum(expected_sun, 1.0))
    case = f"Perez, drawn sky on level ground and sun, {len(HEIGHTS)} sun heights, up to {len(BRIGHTNESSES)} brightnesses, clearness {clearness}"
    figures.check(figures.Row(SECTION, case, "irradiances × efficacies", off.size, float(off.max()), 0.01))


def directions(count=500):
    """Directions above the horizon, evenly spread."""
    i = numpy.arange(count) + 0.5
    up, turn = i / count * 0.97 + 0.03, numpy.pi * (1 + 5**0.5) * i
    flat = numpy.sqrt(1 - up * up)
    return numpy.stack([flat * numpy.cos(turn), flat * numpy.sin(turn), up], axis=1)


def luminances(day):
    """Of all directions, over the zenith's."""
    return numpy.array([day.luminance(direction) for direction in directions().tolist()]) / day.zenith_luminance


def from_sun(day):
    """Radians of all directions."""
    return numpy.arccos(numpy.clip(directions() @ numpy.array(day.sun_direction), -1, 1))


def test_perez_s_spread_of_luminance():
    largest, count = 0.0, 0
    for clearness in perez.CLASSES:
        for height, brightness, _, _, day in weathers(clearness):
            zenith = math.radians(90 - height)
            expected = perez.relative(clearness, brightness, zenith, directions()[:, 2], from_sun(day))
            # The model is not meant for weather that would make it negative.
            if expected.min() > 0:
                expected = expected / perez.relative(clearness, brightness, zenith, 1.0, zenith)
                largest, count = max(largest, float(numpy.abs(luminances(day) / expected - 1).max())), count + len(expected)
    case = "Perez, luminances over the zenith's, the same weathers"
    figures.check(figures.Row(SECTION, case, "the paper's formula", count, largest, 0.01))


def test_the_general_skies_luminances():
    largest = 0.0
    for kind in [*general_sky.PARAMETERS, general_sky.TRADITIONAL_OVERCAST]:
        for height in HEIGHTS:
            day = gonio.daylight(*PLACE, when(height), sky=f"cie{kind}", direct_normal=0.0, diffuse_horizontal=200.0)
            expected = general_sky.relative(kind, directions(), numpy.array(day.sun_direction))
            largest = max(largest, float(numpy.abs(luminances(day) / expected - 1).max()))
    count = 16 * len(HEIGHTS) * len(directions())
    figures.check(figures.Row(SECTION, "16 CIE skies, luminances over the zenith's, 6 sun heights", "ISO 15469", count, largest, 1e-6))


def test_hosek_and_wilkie_s_coefficients():
    data = COEFFICIENTS.read_bytes()
    assert hashlib.sha256(data).hexdigest() == PUBLISHED
    figures.record(figures.Row(SECTION, "Hošek and Wilkie, coefficients", "the authors' release 1.4a", len(data) // 4, 0.0, 0.0))


def hosek_wilkie(elevation, turbidity, albedo, up, angle):
    """Luminance, cd/m², by the authors' formula on the published coefficients."""
    data = numpy.frombuffer(COEFFICIENTS.read_bytes(), "<f4").astype(float)
    shapes, means = data[: 3 * 1080].reshape(3, 2, 10, 6, 9), data[3 * 1080 :].reshape(3, 2, 10, 6)
    t = (math.radians(elevation) / (math.pi / 2)) ** (1 / 3)
    bezier = numpy.array([math.comb(5, k) * t**k * (1 - t) ** (5 - k) for k in range(6)])
    whole = min(int(turbidity), 9)
    shares = {whole - 1: 1 - (turbidity - whole), whole: turbidity - whole}
    rgb = []
    for colour in range(3):
        corners = [(ground, cell, (albedo if ground else 1 - albedo) * share) for ground in (0, 1) for cell, share in shares.items()]
        a, b, c, d, e, f, g, i, h = sum(weight * (bezier @ shapes[colour, ground, cell]) for ground, cell, weight in corners)
        mean = sum(weight * (bezier @ means[colour, ground, cell]) for ground, cell, weight in corners)
        cosine = numpy.cos(angle)
        mie = (1 + cosine**2) / (1 + h * h - 2 * h * cosine) ** 1.5
        graded = 1 + a * numpy.exp(b / (up + 0.01))
        rgb.append(mean * graded * (c + d * numpy.exp(e * angle) + f * cosine**2 + g * mie + i * numpy.sqrt(up)))
    return 683.0 * (LUMINANCE @ numpy.array(rgb))


def test_hosek_and_wilkie_s_luminances():
    largest, count = 0.0, 0
    for turbidity in (1.0, 2.5, 3.0, 5.7, 10.0):
        for albedo in (0.0, 0.3, 1.0):
            for height in HEIGHTS:
                day = gonio.daylight(*PLACE, when(height), sky="hosek-wilkie", turbidity=turbidity, ground=albedo)
                expected = hosek_wilkie(day.elevation, turbidity, albedo, directions()[:, 2], from_sun(day))
                found = luminances(day) * day.zenith_luminance
                largest, count = max(largest, float(numpy.abs(found / expected - 1).max())), count + len(expected)
    case = "Hošek and Wilkie, luminances: 5 turbidities, 3 albedos, 6 sun heights"
    figures.check(figures.Row(SECTION, case, "the authors' formula", count, largest, 1e-6))


@pytest.mark.parametrize("clearness", perez.CLASSES)
def test_level_ground_in_the_open(clearness):
    """Rendered: sun and sky of Perez's weathers on level ground."""
    zenith = math.radians(90 - 30)
    brightness = 0.1
    direct, diffuse = perez.irradiances(clearness, brightness, zenith, 1.9939, OUTSIDE)
    day = gonio.daylight(*PLACE, when(30.0), sky="perez", direct_normal=direct, diffuse_horizontal=diffuse, dew_point=11.0)
    room, ground = Room(), Plane((0, 0, 0), (1, 0, 0), (0, 1, 0))
    room.add(ground)
    room.scene.add_daylight(day, up="Z")
    found = room.illuminance(ground, (16, 16), 256).mean(axis=(1, 2))
    sun = direct * perez.direct_efficacy(clearness, brightness, zenith) * math.cos(zenith)
    expected = diffuse * perez.diffuse_efficacy(clearness, brightness, zenith) + sun
    case = f"level ground under Perez's sky and sun, 30° high, clearness {clearness}"
    confidence.hold(SECTION, case, "irradiances × efficacies", found[:, None], numpy.array([expected]))


def test_the_penumbra_of_an_edge():
    """Under half a plane 10 m up: the share of an even disc of 0.533° that is past the edge, by its segment's area."""
    height, half = 10.0, math.tan(math.radians(0.533 / 2))
    room, ground = Room(), Plane((0, 0, 0), (0.1, 0, 0), (0, 0.01, 0))
    room.add(ground, Plane((-50, 0, height), (100, 0, 0), (0, 100, 0)))
    lux = 1e5
    room.light({"Distant": {"angle_deg": 0.533}}, lux, emission={"normalized": True})
    found = room.illuminance(ground, (25, 1), 16384)
    s = numpy.clip(ground.points(25, 1)[..., 0] / (height * half), -1, 1)
    expected = lux * (0.5 + (s * numpy.sqrt(1 - s * s) + numpy.arcsin(s)) / math.pi)
    confidence.hold(SECTION, "penumbra of a straight edge 10 m above the ground", "area of a disc's segment", found, expected)
