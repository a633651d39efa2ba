"""Figures of the light's colour on illumination maps, against lamps in an empty room and against meters in a coloured one."""

import gonio
import numpy as np
import pytest
from small_scenes import QUAD

FLOOR = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], "f4")
WALL = np.array([[1.5, -2, 0], [1.5, 2, 0], [1.5, 2, 3], [1.5, -2, 3]], "f4")
UVS = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], "f4")
QUANTITIES = ("cct", "duv", "ra", "rf", "rg")
# What rounding may change of figures.
ROUNDING = {"cct": 0.6, "duv": 0.00003, "ra": 0.05, "rf": 0.05, "rg": 0.05}
ERRORS = 4.0


def room(*spectra, wall=None):
    """A dark floor under lamps, and a wall of a colour beside them."""
    made = gonio.Scene()
    floor = made.add_mesh(FLOOR, QUAD, uvs=UVS)
    made.add_instance(floor, [made.add_material(base_color=(0.0,) * 3, specular_weight=0.0)], name="/Floor")
    if wall is not None:
        made.add_instance(made.add_mesh(WALL, QUAD), [made.add_material(base_color=wall, specular_weight=0.0)], name="/Wall")
    for number, spectrum in enumerate(spectra):
        x = 0.3 - 0.8 * number
        made.add_light("sphere", (20000.0,) * 3, radius=0.05, transform=[[1, 0, 0, x], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]], spectrum=spectrum)
    return made


def mapped(scene, **options):
    options = {"uv": "st", "resolution": (2, 2), "error": 0.0, "paths": 1 << 20, "figures": True, **options}
    return gonio.illumination_map(scene, prims=["/Floor"], **options).surfaces[0]


@pytest.mark.parametrize("name", ["LED-B3", "FL11", "HP1"])
def test_a_lamp_in_an_empty_room_has_its_figures(name):
    lamp = gonio.illuminant(name)
    expected = gonio.spectrum_figures(lamp["wavelengths_nm"], lamp["power"])
    floor = mapped(room(name))
    for quantity in QUANTITIES:
        values, errors = np.asarray(floor.figure(quantity)), np.asarray(floor.figure_errors(quantity))
        assert values.shape == (2, 2) and errors.max() < 1e-3 * abs(values).max()
        np.testing.assert_allclose(values, expected[quantity], atol=ROUNDING[quantity])
    lux = np.asarray(floor.illuminance())
    np.testing.assert_allclose(np.asarray(floor.figure("melanopic-edi")) / lux, expected["melanopic_der"], atol=0.002)
    np.testing.assert_allclose(np.asarray(floor.figure_errors("melanopic-edi")), expected["melanopic_der"] * np.asarray(floor.standard_errors()), rtol=0.01)
    together = floor.colour()
    assert together["cct"] == pytest.approx(expected["cct"], abs=ROUNDING["cct"])
    assert np.isnan(np.asarray(floor.figure("ra", "back"))).all() and floor.colour("back") is None


@pytest.mark.parametrize("options", [{}, {"uv": None, "resolution": None, "texel": 1.0}])
def test_maps_equal_meters(options):
    """A red wall and two lamps: each part has what a grid of its middle and neighbourhood has."""
    scene = room("LED-B3", "FL11", wall=(0.8, 0.15, 0.05))
    floor = mapped(scene, **options, paths=1 << 22)
    side = 6
    scene.add_grid(corner=(-1, -1, 0), edges=((2, 0, 0), (0, 2, 0)), spacing=2 / side, quantity="cct")
    found = gonio.measure(scene, samples=4096)
    # The mean spectrum over the floor, weighed by the light of its points.
    colours = found.grids[0].colours
    nm = np.asarray(colours[0]["wavelengths_nm"])
    power = np.mean([np.asarray(colour["irradiance"]) for colour in colours], axis=0)
    expected = gonio.spectrum_figures(nm, power)
    together = floor.colour()
    for quantity, coarse in (("cct", 12.0), ("duv", 0.0004), ("ra", 0.4), ("rf", 0.4), ("rg", 0.4)):
        error = together["standard_errors"][quantity]
        assert together[quantity] == pytest.approx(expected[quantity], abs=ERRORS * error + coarse), quantity
    # Light has wavelengths here and there: as many lux, and as much melanopic light.
    edi = np.mean([colour["melanopic_edi_lx"] for colour in colours])
    errors = np.array([colour["standard_errors"]["melanopic_edi_lx"] for colour in colours])
    off = ERRORS * np.hypot(np.sqrt((errors**2).sum()) / errors.size, floor.flux_error() / floor.area) + 0.01 * edi
    assert np.nanmean(np.asarray(floor.figure("melanopic-edi"))) == pytest.approx(edi, abs=off)
    lux, error = together["illuminance_lx"], together["standard_errors"]["illuminance_lx"]
    assert floor.mean() == pytest.approx(lux, abs=ERRORS * np.hypot(error, floor.flux_error() / floor.area) + 2e-3 * lux)
    # The wall warms the light.
    assert expected["cct"] < 4050
    if options:
        corners = np.asarray(floor.corners).reshape(-1, 3, 3)
        places = corners.mean(axis=1)
    else:
        places = np.array([(x, y, 0.0) for y in (0.5, -0.5) for x in (-0.5, 0.5)])
    values = {quantity: np.ravel(floor.figure(quantity)) for quantity in (*QUANTITIES, "melanopic-edi")}
    errors = {quantity: np.ravel(floor.figure_errors(quantity)) for quantity in values}
    parts = np.ravel(floor.illuminance())
    scene.truncate("grids", 0)
    scene.truncate("meters", 0)
    for place in places:
        for quantity in QUANTITIES:
            scene.add_meter(tuple(place), quantity=quantity)
    readings = gonio.measure(scene, samples=4096).meters
    for part in range(len(places)):
        for number, quantity in enumerate(QUANTITIES):
            reading = readings[part * len(QUANTITIES) + number]
            # Parts are a metre wide: their mean is not quite the value of their middle.
            width = {"cct": 25.0, "duv": 0.0006, "ra": 0.7, "rf": 0.7, "rg": 0.7}[quantity]
            off = ERRORS * np.hypot(errors[quantity][part], reading.standard_error) + width
            assert values[quantity][part] == pytest.approx(reading.value, abs=off), (part, quantity)
        colour = readings[part * len(QUANTITIES)].colour
        ratio = values["melanopic-edi"][part] / parts[part]
        assert ratio == pytest.approx(colour["melanopic_edi_lx"] / colour["illuminance_lx"], abs=0.01)


def test_figures_are_the_same_bits_for_any_number_of_threads():
    found = []
    for threads in (1, 2):
        scene = room("LED-B3", wall=(0.8, 0.15, 0.05))
        scene.set(threads=threads)
        found.append(np.asarray(mapped(scene, paths=1 << 16).figure("ra")))
    assert np.array_equal(*found)


def test_views_of_figures():
    scene = room("LED-B3")
    scene.set(width=16, height=16)
    scene.add_camera([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1]], fov=20)
    maps = gonio.illumination_map(scene, prims=["/Floor"], uv="st", resolution=(4, 4), error=0.0, paths=1 << 18, figures=True)
    lamp = gonio.illuminant("LED-B3")
    expected = gonio.spectrum_figures(lamp["wavelengths_nm"], lamp["power"])
    for smooth in (False, True):
        seen = np.asarray(maps.view(scene, quantity="cct", smooth=smooth))
        np.testing.assert_allclose(seen[np.isfinite(seen)], expected["cct"], atol=0.6)
        assert np.isfinite(seen).mean() > 0.5


def test_what_makes_no_figures_is_told():
    scene = gonio.Scene()
    scene.add_instance(scene.add_mesh(FLOOR, QUAD, uvs=UVS), name="/Floor")
    scene.add_light("sphere", (1000.0,) * 3, radius=0.1, transform=[[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 2], [0, 0, 0, 1]], name="Bulb")
    with pytest.raises(gonio.Error, match="Bulb.*figures of colour want its spectrum"):
        mapped(scene)
    plain = mapped(scene, figures=False, paths=1 << 14)
    assert np.isnan(np.asarray(plain.figure("ra"))).all() and plain.colour() is None
    with pytest.raises(gonio.SettingError, match="cct, duv, ra, rf, rg, melanopic-edi"):
        plain.figure("ugr")
    with pytest.raises(gonio.SettingError, match="MiB"):
        mapped(room("LED-B3"), resolution=(2000, 2000))
