"""Sun and sky by place and time: their numbers, and the light that arrives in a scene."""

import datetime
import math

import gonio
import numpy as np
import pytest
from small_scenes import FLOOR, QUAD, above, finished

VIENNA = (48.21, 16.37)
SUMMER = "2025-06-21T13:00+02:00"


def horizontal(daylight, rows=256):
    """Illuminance of a level surface by the drawn sky, lx."""
    pixels = np.asarray(daylight.image(rows))
    luminance = pixels[..., :3] @ np.array([0.2126, 0.7152, 0.0722])
    polar = math.pi * (np.arange(rows) + 0.5) / rows
    weights = np.where(polar < math.pi / 2, np.sin(polar) * np.cos(polar), 0.0) * (math.pi / rows) ** 2
    return float((luminance * weights[:, None]).sum())


def test_the_sun_stands_where_the_report_says():
    place = {"elevation": 1830.14, "pressure": 820.0, "temperature": 11.0}
    found = gonio.daylight(39.742476, -105.1786, "2003-10-17T12:30:30-07:00", **place)
    assert 90.0 - found.elevation == pytest.approx(50.11162, abs=0.003)
    assert found.azimuth == pytest.approx(194.34024, abs=0.003)
    assert found.sunrise == pytest.approx(6 + 12 / 60 + 43 / 3600, abs=0.002)
    east, north, up = found.sun_direction
    assert math.degrees(math.atan2(east, north)) % 360 == pytest.approx(found.azimuth)
    assert math.degrees(math.asin(up)) == pytest.approx(found.elevation)


def test_a_datetime_is_a_time():
    zone = datetime.timezone(datetime.timedelta(hours=2))
    known = gonio.daylight(*VIENNA, datetime.datetime(2025, 6, 21, 13, 0, tzinfo=zone))
    assert known.azimuth == gonio.daylight(*VIENNA, SUMMER).azimuth
    with pytest.raises(gonio.SettingError, match="offset"):
        gonio.daylight(*VIENNA, datetime.datetime(2025, 6, 21, 13, 0))


@pytest.mark.parametrize("sky", ["perez", "hosek-wilkie", "overcast", "clear", "cie1", "cie8", "cie15"])
def test_the_picture_adds_up_to_the_illuminance(sky):
    found = gonio.daylight(*VIENNA, SUMMER, sky=sky)
    assert horizontal(found) == pytest.approx(found.diffuse_illuminance, rel=0.01)
    assert np.asarray(found.image(64))[32:, :, :3].max() == 0.0


def test_measured_irradiances_set_the_level():
    found = gonio.daylight(*VIENNA, SUMMER, direct_normal=700.0, diffuse_horizontal=150.0)
    assert found.irradiances == (700.0, 150.0)
    assert 100.0 < found.direct_illuminance / 700.0 < 115.0
    assert 100.0 < found.diffuse_illuminance / 150.0 < 150.0
    with pytest.raises(ValueError, match="go together"):
        gonio.daylight(*VIENNA, SUMMER, direct_normal=700.0)


def test_what_is_wrong_is_named():
    for change in ({"sky": "blue"}, {"turbidity": 0.0}, {"ground": 2.0}, {"dew_point": 1e9}):
        with pytest.raises(gonio.SettingError, match=next(iter(change))):
            gonio.daylight(*VIENNA, SUMMER, **change)
    with pytest.raises(gonio.SettingError, match="latitude"):
        gonio.daylight(100.0, 0.0, SUMMER)


def test_weather_files_are_read():
    text = "place Here\nlatitude 48\nlongitude -16\ntime_zone -15\nsite_elevation 200\nweather_data_file_units 1\n6 21 12.5 800 110\n"
    found = gonio.read_weather(text.encode(), "here.wea")
    assert (found["longitude"], found["utc_offset"]) == (16.0, 1.0)
    assert found["hours"] == [(6, 21, 12.5, 800.0, 110.0, None)]
    with pytest.raises(gonio.FormatError, match="here.wea:7: "):
        gonio.read_weather(text.replace("800", "x").encode(), "here.wea")


def test_weather_files_of_other_quantities_come_in_irradiances():
    text = "place Here\nlatitude 48\nlongitude -16\ntime_zone -15\nsite_elevation 200\nweather_data_file_units {}\n6 21 12.5 {} {}\n"

    def hour(units, sun, sky):
        return gonio.read_weather(text.format(units, sun, sky).encode(), "here.wea")["hours"][0][3:5]

    # Solar time is 12:32: a degree east of the zone's meridian, and the equation of time of the solstice.
    latitude, declination, angle = np.radians((48.0, 23.44, 15 * 32.3 / 60))
    sine = np.sin(latitude) * np.sin(declination) + np.cos(latitude) * np.cos(declination) * np.cos(angle)
    assert hour(2, 700, 110) == pytest.approx((700 / sine, 110), rel=2e-3)
    # What the sky of irradiances brings in lx leads back to them.
    day = gonio.daylight(48.0, 16.0, "2024-06-21T12:30+01:00", direct_normal=800.0, diffuse_horizontal=110.0, elevation=200.0)
    assert hour(3, day.direct_illuminance, day.diffuse_illuminance) == pytest.approx((800.0, 110.0), rel=2e-3)
    with pytest.raises(gonio.FormatError, match="here.wea:6: weather_data_file_units is '4'"):
        hour(4, 700, 110)


def plane_under(daylight, **frame):
    """Mean illuminance of a white plane under the open sky, lx; y is up."""
    scene = gonio.Scene()
    scene.set(width=32, height=32, samples=64, passes=["illuminance"], max_bounces=0)
    white = scene.add_material("white", base_color=(1.0, 1.0, 1.0), specular_weight=0.0)
    scene.add_instance(scene.add_mesh(FLOOR, QUAD, name="plane"), [white])
    scene.add_camera(above(8), fov=40)
    scene.add_daylight(daylight, up="Y", **frame)
    return float(np.asarray(finished(scene)["illuminance"]).mean())


@pytest.mark.parametrize("sky", ["perez", "hosek-wilkie", "overcast", "cie8", "cie12"])
def test_a_plane_has_the_sky_s_illuminance(sky):
    found = gonio.daylight(*VIENNA, SUMMER, sky=sky)
    # The sky alone, then with the sun: the sine of its height of what faces it.
    assert plane_under(found) == pytest.approx(found.global_illuminance, rel=0.01)


def test_the_sun_is_a_light_of_its_own():
    scene = gonio.Scene()
    found = gonio.daylight(*VIENNA, SUMMER)
    scene.add_daylight(found, up="Z", north=90.0)
    sky, sun = scene.to_dict()["lights"]
    assert "Dome" in sky["shape"] and sun["shape"]["Distant"]["angle_deg"] == pytest.approx(0.533)
    east, north, up = found.sun_direction
    # True north is the scene's +X.
    assert sun["transform"]["columns"][2] == pytest.approx([north, -east, up])
    assert float(np.dot(sun["emission"]["radiance"], [0.2126, 0.7152, 0.0722])) == pytest.approx(found.direct_illuminance, rel=1e-5)


def test_at_night_there_is_no_sun():
    scene = gonio.Scene()
    found = gonio.daylight(*VIENNA, "2025-06-21T01:00+02:00")
    scene.add_daylight(found)
    assert found.elevation < 0.0 and found.global_illuminance == 0.0
    assert len(scene.to_dict()["lights"]) == 1


def test_artists_skies_have_their_usual_colours():
    for model in ("single-scattering", "multiple-scattering", "preetham", "hosek-wilkie"):
        image, sun = gonio.artist_sky(model, 40.0, rows=64)
        zenith = np.asarray(image)[0, 0]
        assert zenith[2] > zenith[1] > zenith[0] > 0.0, model
        assert (sun[0] > 0.0) == model.endswith("scattering")
    with pytest.raises(gonio.SettingError, match="model"):
        gonio.artist_sky("nishita", 40.0)
