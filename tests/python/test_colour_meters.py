"""Colour of the light at meters and grids: CCT, Duv, Ra, Rf, Rg, against the figures of lamps, an integrating sphere and a radiosity by wavelength."""

import gonio
import numpy as np
import pytest
from gonio.medium import medium

# Standard errors that a figure may be off, and what rounding may change of it.
ERRORS = 4.0
ROUNDING = {"cct": 0.5, "duv": 0.00002, "ra": 0.03, "rf": 0.03, "rg": 0.03}
QUANTITIES = tuple(ROUNDING)


def at(x, y, z):
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]


def under(*lamps, quantities=QUANTITIES, **settings):
    """What level meters at the origin show below lamps."""
    made = gonio.Scene()
    for lamp in lamps:
        made.add_light("sphere", (1000.0,) * 3, radius=0.1, transform=at(0, 0, 3), **lamp)
    for quantity in quantities:
        made.add_meter((0, 0, 0), quantity=quantity)
    made.set(**settings)
    return gonio.measure(made, samples=1024)


def assert_figures(found, expected, scale=1.0):
    for quantity, reading in zip(QUANTITIES, found, strict=True):
        off = scale * ROUNDING[quantity] + ERRORS * reading.standard_error
        assert reading.value == pytest.approx(expected[quantity], abs=off), quantity


def spectrum_of(name):
    lamp = gonio.illuminant(name)
    return np.asarray(lamp["wavelengths_nm"]), np.asarray(lamp["power"])


def figures_of(name):
    return gonio.spectrum_figures(*spectrum_of(name))


@pytest.mark.parametrize("name", ["A", "D65", "FL11", "FL2", "FL4", "LED-B1", "LED-B3", "LED-B5", "LED-RGB1", "HP1", "E"])
def test_a_meter_sees_the_lamp_in_an_empty_room(name):
    expected = figures_of(name)
    found = under({"spectrum": name}).meters
    assert_figures(found, expected)
    colour = found[0].colour
    assert colour["melanopic_edi_lx"] / colour["illuminance_lx"] == pytest.approx(expected["melanopic_der"], abs=0.002)
    assert [colour[quantity] for quantity in QUANTITIES] == [reading.value for reading in found]


def test_the_spectrum_has_the_lux_of_the_light():
    found = under({"spectrum": "FL11"}, quantities=("illuminance", "cct"))
    lux, colour = found.meters[0], found.meters[1].colour
    error = colour["standard_errors"]["illuminance_lx"]
    assert colour["illuminance_lx"] == pytest.approx(lux.value, abs=ERRORS * np.hypot(error, lux.standard_error) + 1e-3 * lux.value)
    nm, power = spectrum_of("FL11")
    assert np.asarray(colour["wavelengths_nm"]).tolist() == nm.tolist()
    found = np.asarray(colour["irradiance"])
    np.testing.assert_allclose(found / found.max(), power / power.max(), atol=1e-5)


def test_two_lamps_mix():
    """The sum of two spectra, not the mean of two figures; a line stays as narrow as it is."""
    nm = np.sort(np.concatenate([np.arange(380.0, 781.0, 10.0), [588.0, 589.0, 589.5]]))
    line = (nm, np.isin(nm, [589.0, 589.5]).astype(float))
    found = under({"spectrum": "LED-B1"}, {"spectrum": tuple(list(column) for column in line)}).meters
    lamps = [spectrum_of("LED-B1"), line]
    nm = np.unique(np.concatenate([lamps[0][0], line[0]]))
    # Both of the same luminance.
    fine = np.arange(380.0, 780.01, 0.05)
    luminous = [gonio.spectrum_figures(fine, np.interp(fine, *lamp))["ler"] * np.interp(fine, *lamp).sum() for lamp in lamps]
    power = sum(np.interp(nm, *lamp, left=0, right=0) / lumens for lamp, lumens in zip(lamps, luminous, strict=True))
    # Sums at the points of a spectrum and integrals differ a little.
    assert_figures(found, gonio.spectrum_figures(nm, power), scale=20.0)


def ball(radius, rings=64):
    """A ball whose faces look inwards."""
    theta, phi = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings, endpoint=False), indexing="ij")
    points = radius * np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1)
    ring, step = np.meshgrid(np.arange(rings), np.arange(2 * rings), indexing="ij")
    place = lambda i, j: i * 2 * rings + j % (2 * rings)  # noqa: E731
    quads = [place(ring, step), place(ring, step + 1), place(ring + 1, step + 1), place(ring + 1, step)]
    triangles = np.concatenate([np.stack([quads[0], quads[2], quads[1]], -1), np.stack([quads[0], quads[3], quads[2]], -1)])
    return points.reshape(-1, 3).astype(np.float32), triangles.reshape(-1, 3).astype(np.int32)


def test_an_integrating_sphere_of_a_colour():
    """Direct light, and of a wall of reflectance R what the sphere gives back: in all E = direct / (1 - R)."""
    colour = (0.7, 0.55, 0.35)
    made = gonio.Scene()
    wall = made.add_material(base_color=colour, specular_weight=0.0)
    made.add_instance(made.add_mesh(*ball(1.0)), [wall])
    made.add_light("sphere", (1000.0,) * 3, radius=0.02, spectrum="LED-B3")
    for quantity in QUANTITIES:
        made.add_meter((0.0, 0.0, -0.995), normal=(0, 0, 1), quantity=quantity)
    found = gonio.measure(made, samples=8192).meters
    nm, power = spectrum_of("LED-B3")
    expected = gonio.spectrum_figures(nm, power / (1.0 - np.asarray(gonio.colour_reflectance(colour, nm))))
    # The ball is of flat faces.
    assert_figures(found, expected, scale=10.0)
    # The wall changes the lamp's colour by much more than that.
    assert abs(expected["cct"] - figures_of("LED-B3")["cct"]) > 500


def radiosity(reflectances, power, lamp, meter, patches=12):
    """Irradiance by wavelength at a place on the floor of a unit cube with walls of these reflectances, of a small lamp: its direct light and, by square patches,
    what the walls send on."""
    steps = (np.arange(patches) + 0.5) / patches
    u, v = [part.ravel() for part in np.meshgrid(steps, steps)]
    places, normals, walls = [], [], []
    for wall in range(6):
        axis, side = wall // 2, wall % 2
        place = np.empty((len(u), 3))
        place[:, axis], place[:, (axis + 1) % 3], place[:, (axis + 2) % 3] = side, u, v
        normal = np.zeros(3)
        normal[axis] = 1 - 2 * side
        places.append(place), normals.append(np.tile(normal, (len(u), 1))), walls.append(np.full(len(u), wall))
    place, normal, wall = np.concatenate(places), np.concatenate(normals), np.concatenate(walls)
    area = 1.0 / patches**2

    def kernel(at, facing):
        way = place[None] - at[:, None]
        squared = (way**2).sum(-1)
        cosines = np.maximum((way * facing[:, None]).sum(-1), 0) * np.maximum(-(way * normal[None]).sum(-1), 0)
        # A disc's form factor, which stays below 1 where patches meet.
        return cosines / np.maximum(squared, 1e-12) / (np.pi * squared + area) * area

    factors = kernel(place, normal)
    # Of a closed room they add up to 1.
    factors /= factors.sum(1, keepdims=True)
    from_lamp = lambda at, facing: np.maximum(((lamp - at) * facing).sum(-1), 0) / ((lamp - at) ** 2).sum(-1) ** 1.5  # noqa: E731
    direct, up = from_lamp(place, normal), np.array([[0.0, 0.0, 1.0]])
    seen = kernel(meter[None], up)[0]
    seen /= seen.sum()
    found = []
    for reflectance, of_lamp in zip(np.transpose(reflectances), power, strict=True):
        sent = np.linalg.solve(np.eye(len(place)) - reflectance[wall][:, None] * factors, reflectance[wall] * direct * of_lamp)
        found.append(from_lamp(meter[None], up)[0] * of_lamp + seen @ sent)
    return np.array(found)


def cube_walls():
    """The faces of a unit cube, by axis and side, each as a mesh that looks inwards."""
    for wall in range(6):
        axis, side = wall // 2, wall % 2
        corners = np.zeros((4, 3), np.float32)
        corners[:, axis] = side
        corners[:, (axis + 1) % 3], corners[:, (axis + 2) % 3] = [0, 1, 1, 0], [0, 0, 1, 1]
        triangles = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
        yield corners, triangles if side == 0 else triangles[:, ::-1].copy()


def test_a_coloured_room_by_radiosity():
    colours = [(0.7, 0.15, 0.1), (0.1, 0.25, 0.6), (0.6, 0.6, 0.55), (0.6, 0.6, 0.55), (0.35, 0.25, 0.15), (0.8, 0.8, 0.8)]
    made = gonio.Scene()
    for (corners, triangles), colour in zip(cube_walls(), colours, strict=True):
        made.add_instance(made.add_mesh(corners, triangles), [made.add_material(base_color=colour, specular_weight=0.0)])
    lamp, meter = np.array([0.5, 0.5, 0.7]), np.array([0.3, 0.45, 0.0])
    made.add_light("sphere", (1000.0,) * 3, radius=0.01, spectrum="FL11", transform=at(*lamp))
    for quantity in QUANTITIES:
        made.add_meter((*meter[:2], 0.001), quantity=quantity)
    found = gonio.measure(made, samples=16384).meters
    nm, power = spectrum_of("FL11")
    by_wall = [gonio.colour_reflectance(colour, nm) for colour in colours]
    expected = gonio.spectrum_figures(nm, radiosity(by_wall, power, lamp, meter))
    # Patches of a twelfth of the room.
    assert_figures(found, expected, scale=20.0)
    assert abs(expected["ra"] - figures_of("FL11")["ra"]) > 2


def test_colour_temperature_of_lamps_without_a_spectrum():
    """Their colour is enough for CCT and Duv, which is told; colour rendering is not told by it."""
    made = gonio.Scene()
    made.add_light("sphere", (1000.0, 780.0, 530.0), radius=0.1, transform=at(0, 0, 3), name="warm lamp")
    made.add_meter((0, 0, 0), quantity="cct")
    measured = gonio.measure(made, samples=256)
    rgb = np.array([1000.0, 780.0, 530.0])
    x, y, z = np.array([[0.412391, 0.357584, 0.180481], [0.212639, 0.715169, 0.072192], [0.019331, 0.119195, 0.950532]]) @ rgb
    # McCamy's formula, good to some kelvin.
    n = (x / (x + y + z) - 0.3320) / (0.1858 - y / (x + y + z))
    assert measured.meters[0].value == pytest.approx(449 * n**3 + 3525 * n**2 + 6823.3 * n + 5520.33, abs=30)
    assert any("daylight D65 of their colour" in message for _, message in measured.diagnostics)
    made.add_meter((0, 0, 0), quantity="ra")
    with pytest.raises(gonio.Error, match="warm lamp.*colour rendering.*spectrum"):
        gonio.measure(made, samples=256)


def test_beside_the_colour_temperature_of_a_colour_stands_no_colour_rendering():
    made = gonio.Scene()
    made.add_light("sphere", (1000.0, 780.0, 530.0), radius=0.1, transform=at(0, 0, 3), name="warm lamp")
    made.add_meter((0, 0, 0), quantity="cct")
    colour = gonio.measure(made, samples=256).meters[0].colour
    assert [colour[name] for name in ("ra", "rf", "rg", "melanopic_der", "melanopic_edi_lx")] == [None] * 5


def test_what_is_not_white_has_no_colour_temperature():
    """No figure, and why, in place of a number that means nothing; nor where no light comes."""
    green = ([380, 500, 520, 540, 560, 580, 780], [0, 0, 1, 1, 0, 0, 0])
    fine = np.arange(380.0, 781.0, 5.0)
    found = under({"spectrum": (list(fine), list(np.interp(fine, *green)))})
    assert all(np.isnan(reading.value) for reading in found.meters)
    assert any("not white" in message for _, message in found.diagnostics)
    assert found.meters[0].colour["melanopic_edi_lx"] > 0
    made = gonio.Scene()
    made.add_light("sphere", (1000.0,) * 3, radius=0.1, transform=at(0, 0, -3), spectrum="A")
    made.add_meter((0, 0, 0), quantity="ra")
    dark = gonio.measure(made, samples=256)
    assert np.isnan(dark.meters[0].value) and any("no light" in message for _, message in dark.diagnostics)


def test_a_bulb_of_clear_glass():
    """What light paths bring is by wavelength: a bulb in a shell of clear glass has the lamp's figures."""
    made = gonio.Scene()
    points, triangles = ball(0.2)
    shell = made.add_mesh(points, triangles[:, ::-1].copy())
    inner = made.add_mesh(*ball(0.19))
    glass = made.add_material(transmission_weight=1.0, specular_ior=1.5, specular_roughness=0.0)
    for mesh in (shell, inner):
        made.add_instance(mesh, [glass], transform=at(0, 0, 3))
    made.add_light("sphere", (1e5,) * 3, radius=0.01, spectrum="LED-B3", transform=at(0, 0, 3))
    for quantity in (*QUANTITIES, "illuminance"):
        made.add_meter((0, 0, 0), quantity=quantity)
    *found, lux = gonio.measure(made, samples=2048).meters
    assert_figures(found, figures_of("LED-B3"))
    colour = found[0].colour
    error = np.hypot(colour["standard_errors"]["illuminance_lx"], lux.standard_error)
    assert lux.value > 0 and colour["illuminance_lx"] == pytest.approx(lux.value, abs=ERRORS * error)


def test_where_light_has_no_room_to_be_counted_there_is_no_figure():
    """A meter in a joint of two walls gets light by glass, and has no room for the disc that it is counted on: no figure, and no 0 lx either."""
    made = gonio.Scene()
    glass = made.add_material(transmission_weight=1.0, specular_ior=1.5, specular_roughness=0.0)
    made.add_instance(made.add_mesh(*ball(0.2)[:1], ball(0.2)[1][:, ::-1].copy()), [glass], transform=at(0, 0, 3))
    made.add_instance(made.add_mesh(*ball(0.19)), [glass], transform=at(0, 0, 3))
    made.add_light("sphere", (1e5,) * 3, radius=0.01, spectrum="LED-B3", transform=at(0, 0, 3))
    wall = made.add_mesh(np.array([[0, -1, 0], [0, 1, 0], [0, 1, 1], [0, -1, 1]], np.float32), np.array([[0, 1, 2], [0, 2, 3]], np.int32))
    made.add_instance(wall, [made.add_material(base_color=(0, 0, 0), specular_weight=0.0)])
    for quantity in ("illuminance", "cct"):
        made.add_meter((0, 0, 0), quantity=quantity)
    measured = gonio.measure(made, samples=16)
    assert all(np.isnan(reading.value) for reading in measured.meters)
    assert np.isnan(measured.meters[1].colour["illuminance_lx"])
    assert sum("disc about the meter" in message for _, message in measured.diagnostics) == 2


def test_a_lamp_in_coloured_haze():
    """Media are seen by wavelength: what absorption leaves of a lamp's light, by Beer and Lambert."""
    absorption = (0.05, 0.2, 0.6)
    made = gonio.Scene()
    made.put_atmosphere(medium(absorption=absorption))
    made.add_light("sphere", (1000.0,) * 3, radius=0.1, spectrum="A", transform=at(0, 0, 3))
    for quantity in QUANTITIES:
        made.add_meter((0, 0, 0), quantity=quantity)
    nm, power = spectrum_of("A")
    # Coefficients are spectra of colours: twice the greatest is the polynomials' range.
    greatest = 2.0 * max(absorption)
    coefficient = greatest * np.asarray(gonio.colour_reflectance([part / greatest for part in absorption], nm))
    expected = gonio.spectrum_figures(nm, power * np.exp(-2.9 * coefficient))
    assert_figures(gonio.measure(made, samples=1024).meters, expected, scale=20.0)


def test_a_grid_of_colour_temperatures():
    """Two lamps side by side: warm there, cool here, and a scale from the least to the greatest."""
    made = gonio.Scene()
    for x, name in ((-2.0, "LED-B1"), (2.0, "LED-B5")):
        made.add_light("sphere", (1e5,) * 3, radius=0.05, spectrum=name, transform=at(x, 0, 1))
    made.add_grid(corner=(-2.5, -0.5, 0), edges=((5, 0, 0), (0, 1, 0)), spacing=1.0, quantity="cct")
    grid = gonio.measure(made, samples=256).grids[0]
    values = np.asarray(grid.values)
    assert grid.unit == "K" and values.shape == (1, 5)
    assert (np.diff(values[0]) > 0).all() and 2700 < values[0, 0] < 3000 and 6000 < values[0, 4] < 6700
    assert len(grid.colours) == 5 and grid.colours[0]["cct"] == values[0, 0]
    assert min(grid.picture().size) > 0


def test_more_samples_do_not_change_a_figure():
    """Bits are the same whoever asks for how many quantities at a place."""
    one = under({"spectrum": "FL11"}, quantities=("ra",)).meters[0]
    all_of_them = under({"spectrum": "FL11"}).meters[QUANTITIES.index("ra")]
    assert one.value == all_of_them.value and one.standard_error == all_of_them.standard_error
