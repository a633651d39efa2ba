"""Glasses and liquids by their index over wavelength: catalogue values, Snell's and Fresnel's laws by wavelength, names and files."""

import math

import gonio
import numpy as np
import pytest

SQUARE = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
CORNERS = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
# Index at d and Abbe number by d, F and C, as the maker's catalogue states them.
CATALOGUE = {
    "N-BK7": (1.5168, 64.17),
    "N-BAK4": (1.56883, 55.98),
    "N-SK16": (1.62041, 60.32),
    "F2": (1.62004, 36.37),
    "SF10": (1.72825, 28.41),
    "N-SF11": (1.78472, 25.68),
    "SF6": (1.80518, 25.43),
    "N-LAK22": (1.65113, 55.89),
    "N-LASF9": (1.85025, 32.17),
    "N-FK51A": (1.48656, 84.47),
    "N-SF66": (1.92286, 20.88),
    "LITHOSIL-Q": (1.45844, 67.83),
}


def index(glass, nm):
    """The index at wavelengths in nm, linear in 1/λ²."""
    order = 1 / np.asarray(glass["wavelengths_nm"])[::-1] ** 2
    return np.interp(1 / np.asarray(nm, float) ** 2, order, np.asarray(glass["n"])[::-1])


def n_sf11(nm):
    """Sellmeier's formula with the catalogue's coefficients."""
    square = (np.asarray(nm) / 1000) ** 2
    b, c = (1.73759695, 0.313747346, 1.89878101), (0.013188707, 0.0623068142, 155.23629)
    return np.sqrt(1 + sum(part * square / (square - pole) for part, pole in zip(b, c, strict=True)))


def daylight_bands(nm, width):
    """What a grey radiance of 1 cd/m² of D65 is in bands, W/(m² sr nm)."""
    daylight = gonio.illuminant("D65")
    fine = np.arange(380.0, 780.01, 0.1)
    power = np.interp(fine, daylight["wavelengths_nm"], daylight["power"])
    ler = gonio.spectrum_figures(fine, power)["ler"]
    half = width / 2
    means = np.array([np.mean(np.interp(np.linspace(a - half, a + half, 101), fine, power)) for a in nm])
    return means / ler / np.trapezoid(power, dx=0.1)


def seen(made) -> np.ndarray:
    with gonio.Render(made) as rendering:
        rendering.wait()
        return np.asarray(rendering.film()["color"], float)[..., :3].mean(axis=(0, 1))


@pytest.mark.parametrize("name", CATALOGUE)
def test_catalogue_values(name):
    found = gonio.glass(name)
    nd, abbe = CATALOGUE[name]
    assert found["ior"] == pytest.approx(nd, abs=1e-5) and found["abbe"] == pytest.approx(abbe, abs=0.05)
    d, f, c = index(found, (587.5618, 486.1327, 656.2725))
    assert (d - 1) / (f - c) == pytest.approx(abbe, abs=0.05)


@pytest.mark.parametrize(
    ("name", "nm", "expected"),
    [
        # Malitson 1965 at d and g; Daimon and Masumura 2007 at 20 °C; Peter 1923 at the sodium line; Malitson and Dodge 1972 at d; Warren and Brandt 2008.
        ("fused silica", 587.56, 1.45846),
        ("silica", 435.83, 1.46669),
        ("water", 589.3, 1.33334),
        ("diamond", 589.3, 2.4173),
        ("sapphire", 587.56, 1.76817),
        ("ice", 550.0, 1.3110),
        ("fluorite", 587.56, 1.43385),
        ("B270", 546.07, 1.5251),
        ("acrylic", 587.56, 1.4906),
        ("polycarbonate", 587.56, 1.5848),
        ("polystyrene", 587.56, 1.5916),
        ("ethanol", 587.56, 1.3608),
        ("window glass", 587.56, 1.5234),
    ],
)
def test_what_is_no_optical_glass(name, nm, expected):
    assert float(index(gonio.glass(name), nm)) == pytest.approx(expected, abs=6e-5)


def prism(lean, screen, **material):
    """A prism of 60° that a narrow view meets at an angle from its base, and behind it a far screen whose light is that of a picture across it."""
    made = gonio.Scene()
    half, apex = 0.1 * math.tan(math.radians(30)), 0.1
    section = [(-half, 0.0), (half, 0.0), (0.0, apex)]
    points = np.array([(x, y, z) for y in (-0.2, 0.2) for x, z in section], np.float32)
    faces = np.array([(0, 1, 2), (3, 5, 4), (0, 3, 4), (0, 4, 1), (1, 4, 5), (1, 5, 2), (2, 5, 3), (2, 3, 0)], np.int32)
    glass = made.add_material(transmission_weight=1.0, specular_roughness=0.0, **material)
    made.add_instance(made.add_mesh(points, faces), [glass])
    far, tall = 1000.0, 2000.0
    corners = np.array([(far, y, -z) for y, z in ((-tall, tall), (tall, tall), (tall, -0.01), (-tall, -0.01))], np.float32)
    mesh = made.add_mesh(corners, CORNERS, uvs=np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32))
    lit = made.add_texture(np.broadcast_to(np.asarray(screen, np.float32)[:, None, None], (len(screen), 4, 3)).copy(), colour_space="lin_rec709", wrap="clamp")
    made.add_instance(mesh, [made.add_material(emission_color=lit, base_color=(0.0,) * 3, specular_weight=0.0)])
    # The middle of the left face, whose normal points 30° up from -x.
    middle = np.array((-half / 2, 0.0, apex / 2))
    eye = middle - 0.3 * np.array((math.cos(lean), 0.0, math.sin(lean)))
    made.add_camera(gonio.look_at(eye, middle, up=(0.0, 0.0, 1.0)), fov=0.01)
    # Two refractions, and nothing that the prism's sides mirror.
    made.set(width=8, height=8, samples=256, spectral=True, caustics="off", max_bounces=2)
    return made


@pytest.mark.parametrize("nm", [452.5, 547.5, 652.5])
def test_a_prism_at_minimum_deviation(nm):
    """Light of N-SF11's index goes on at 2 asin(n sin 30°) − 60° from where it came, at each wavelength in its own position; and as Snell has it at all
    others in that position."""
    apex = math.radians(60)
    incidence = math.asin(float(n_sf11(nm)) * 0.5)
    lean = incidence - apex / 2
    pictures = [gonio.spectral_picture(prism(lean, screen, glass="N-SF11"), band=5.0) for screen in ((1.0, 1.0), np.linspace(0.0, 1.0, 4096))]
    bands = np.asarray(pictures[0].wavelengths_nm)
    even, ramp = (np.asarray(picture.radiance, float).mean(axis=(0, 1)) for picture in pictures)
    inner = apex - np.arcsin(np.sin(incidence) / n_sf11(bands))
    expected = incidence + np.arcsin(n_sf11(bands) * np.sin(inner)) - apex
    place = (ramp / even * 4095 + 0.5) / 4096
    # The picture's first row is the screen's top, v = 1.
    depth = place * (2000.0 - 0.01) + 0.01
    found = lean + np.arctan((depth + 0.05) / 1000.0)
    spread = expected.max() - expected.min()
    at = int(np.argmin(np.abs(bands - nm)))
    assert expected[at] == pytest.approx(2 * math.asin(float(n_sf11(nm)) * 0.5) - apex, abs=1e-9)
    np.testing.assert_allclose(found, expected, atol=0.001 * spread)


def pane(thin, angle, **material):
    """A pane between the eye and a wall of 1 cd/m², seen at an angle in degrees from its normal; all else is dark."""
    made = gonio.Scene()
    glass = made.add_material(transmission_weight=1.0, specular_roughness=0.0, thin_walled=thin, **material)
    if thin:
        made.add_instance(made.add_mesh(SQUARE, CORNERS), [glass])
    else:
        corners = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-0.002, 0.002)]
        sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        faces = [triangle for a, b, c, d in sides for triangle in ((a, b, c), (a, c, d))]
        made.add_instance(made.add_mesh(np.array(corners, np.float32), np.array(faces, np.int32)), [glass])
    shine = made.add_material(emission_color=(1.0,) * 3, base_color=(0.0,) * 3, specular_weight=0.0)
    made.add_instance(made.add_mesh(SQUARE * 20 + np.array([0, 0, -5], np.float32), CORNERS), [shine])
    sin, cos = math.sin(math.radians(angle)), math.cos(math.radians(angle))
    made.add_camera([[1, 0, 0, 0], [0, cos, -sin, -2 * sin], [0, sin, cos, 2 * cos], [0, 0, 0, 1]], fov=0.1)
    made.set(width=16, height=16, samples=64, spectral=True, caustics="off", max_bounces=32)
    return made


@pytest.mark.parametrize(("thin", "angle", "bound"), [(True, 0.0, 5e-4), (True, 60.0, 5e-4), (False, 0.0, 3e-3)])
def test_a_pane_lets_pass_what_all_its_reflections_leave(thin, angle, bound):
    """(1 − R) / (1 + R) of each polarisation, by wavelength; straight on that is 2 n / (n² + 1)."""
    picture = gonio.spectral_picture(pane(thin, angle, glass="N-SF66"), band=10.0)
    nm = np.asarray(picture.wavelengths_nm)
    n, cos = index(gonio.glass("N-SF66"), nm), math.cos(math.radians(angle))
    inner = np.sqrt(1 - (1 - cos**2) / n**2)
    reflected = [((cos - n * inner) / (cos + n * inner)) ** 2, ((n * cos - inner) / (n * cos + inner)) ** 2]
    expected = np.mean([(1 - r) / (1 + r) for r in reflected], axis=0)
    found = np.asarray(picture.radiance).mean(axis=(0, 1)) / daylight_bands(nm, 10.0)
    np.testing.assert_allclose(found, expected, atol=bound)
    assert expected.max() - expected.min() > 0.01


def ball(roughness, spectral=True, lamp=False, samples=256, size=32, **material):
    """A ball that fills the view, under a sky of 1 cd/m² or a small lamp behind it."""
    made = gonio.Scene()
    rings, sides = 48, 96
    polar, turn = np.linspace(0, math.pi, rings + 1), 2 * math.pi * np.arange(sides) / sides
    points = np.array([(math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a)) for a in polar for b in turn], np.float32)
    faces = []
    for ring in range(rings):
        for side in range(sides):
            a, b = ring * sides + side, ring * sides + (side + 1) % sides
            faces += [(a, a + sides, b + sides), (a, b + sides, b)]
    glass = made.add_material(specular_roughness=roughness, **material)
    made.add_instance(made.add_mesh(points, np.array(faces, np.int32), normals=points), [glass])
    made.add_camera(gonio.look_at((0, 0, 6), (0, 0, 0), up=(0, 1, 0)), fov=14.0)
    if lamp:
        made.add_light("rectangle", (100.0,) * 3, width=1.0, height=1.0, transform=gonio.look_at((1.0, 0.5, -5), (0, 0, 0)))
    else:
        made.add_light("dome")
    made.set(width=size, height=size, samples=samples, spectral=spectral, caustics="off", max_bounces=24)
    return made


@pytest.mark.parametrize("roughness", [0.0, 0.1, 0.4])
def test_a_furnace_of_dispersive_glass_is_white(roughness):
    # Roughness loses or adds up to a hundredth by the tables that make up for it, with and without dispersion.
    found, plain = seen(ball(roughness, glass="N-SF66")), seen(ball(roughness, spectral=False, specular_ior=1.92286, transmission_weight=1.0))
    np.testing.assert_allclose(found, plain, atol=0.012)
    np.testing.assert_allclose(found, 1.0, atol=0.03 if roughness else 0.012)


@pytest.mark.parametrize("roughness", [0.2, 0.4])
def test_rough_glass_is_as_bright_as_by_wavelength(roughness):
    """Three wavelengths that share a path, with lamps sampled and found, mean what single ones do."""
    made = ball(roughness, lamp=True, samples=2048, size=16, glass="N-SF66")
    by_wavelength = np.asarray(gonio.spectral_picture(ball(roughness, lamp=True, samples=256, size=16, glass="N-SF66"), band=10.0).color, float)
    np.testing.assert_allclose(seen(made), by_wavelength[..., :3].mean(axis=(0, 1)), rtol=0.02)


def test_without_wavelengths_the_index_is_that_at_the_line_d():
    named, stated = (seen(ball(0.2, spectral=False, samples=16, **material)) for material in ({"glass": "N-SF11"}, {"transmission_weight": 1.0, "specular_ior": 1.78472}))
    np.testing.assert_allclose(named, stated, rtol=1e-4)


def test_files(tmp_path):
    """Rows of nm or micrometres with and without k, and the database's YAML with a formula, whose thermal formulas are of other things."""
    glass = gonio.glass("N-SF11")
    rows = [(nm, float(n_sf11(nm))) for nm in range(380, 781, 5)]
    yaml = (
        "REFERENCES: |\n    1) a catalogue: 2017\nCOMMENTS: |\n    20 °C\nDATA:\n  - type: formula 2\n    wavelength_range: 0.37 2.5\n"
        "    coefficients: 0 1.73759695 0.013188707 0.313747346 0.0623068142 1.89878101 155.23629\n  - type: tabulated k\n    data: |\n        0.4 6.5E-07\n"
        "CONDITIONS:\n    temperature: 293\nPROPERTIES:\n    thermal_dispersion:\n      - type: formula A\n        coefficients: -3.56e-06 9.2e-09\n    nd: 1.78472\n"
    )
    table = "DATA:\n  - type: tabulated nk\n    data: |\n" + "\n".join(f"        {nm / 1000:.4f} {n:.8f} 1e-7" for nm, n in rows)
    forms = {
        "rows.csv": "nm,n\n" + "\n".join(f"{nm},{n:.8f}" for nm, n in rows),
        "um.txt": "\n".join(f"{nm / 1000:.4f}\t{n:.8f}" for nm, n in rows),
        "blocks.csv": "wl,n\n" + "\n".join(f"{nm / 1000:.4f},{n:.8f}" for nm, n in rows) + "\n\nwl,k\n0.4,1e-7\n0.7,1e-7\n",
        "formula.yml": yaml,
        "table.yml": table,
    }
    for name, text in forms.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
        found = gonio.read_glass(text.encode(), name)
        assert (found["ior"], found["abbe"]) == pytest.approx((glass["ior"], glass["abbe"]), abs=2e-3), name
        np.testing.assert_allclose(index(found, (400, 487, 700)), n_sf11((400, 487, 700)), atol=3e-6)
        assert any("extinction" in note for note in found["notes"]) == (name in ("blocks.csv", "formula.yml", "table.yml")), name
    described = gonio.Scene().add_material(glass=tmp_path / "formula.yml")
    assert described == 0


FORMULAS = {
    # By number: coefficients, and the index at 0.5 µm by hand.
    1: ("0 1 0.1", math.sqrt(1 + 0.25 / (0.25 - 0.01))),
    2: ("0 1 0.01", math.sqrt(1 + 0.25 / (0.25 - 0.01))),
    3: ("2 0.1 2 0.01 -2", math.sqrt(2 + 0.025 + 0.04)),
    4: ("2 0.1 2 0.1 2 0.2 0 0.2 1 0.01 -2", math.sqrt(2 + 0.025 / 0.24 + 0.2 / (0.25 - 0.2) + 0.04)),
    5: ("1.5 0.01 -2", 1.54),
    6: ("0.01 0.1 24", 1.01 + 0.1 / 20),
    7: ("1.5 0.01 0.001 0.1 0.1 0.1", 1.5 + 0.01 / 0.222 + 0.001 / 0.222**2 + 0.025 + 0.00625 + 0.0015625),
    8: ("0.3 0.01 0.1 0.01", math.sqrt((1 + 2 * (0.3 + 0.0025 / 0.15 + 0.0025)) / (1 - (0.3 + 0.0025 / 0.15 + 0.0025)))),
    9: ("2 0.01 0.1 0.1 0.2 1", math.sqrt(2 + 0.01 / 0.15 + 0.1 * 0.3 / 1.09)),
}


@pytest.mark.parametrize("number", FORMULAS)
def test_formulas(number):
    coefficients, expected = FORMULAS[number]
    text = f"DATA:\n  - type: formula {number}\n    wavelength_range: 0.45 0.78\n    coefficients: {coefficients}\n"
    if number == 4:
        # Its pole lies within light: told as an index that nothing has.
        with pytest.raises(gonio.Error, match="an index of"):
            gonio.read_glass(text.replace("0.45", "0.38").encode(), "glass.yml")
        text = text.replace("0.2 0 0.2 1", "0.2 0 0.1 1")
        expected = math.sqrt(2 + 0.025 / 0.24 + 0.2 / 0.15 + 0.04)
    found = gonio.read_glass(text.replace("0.45", "0.43").encode(), "glass.yml")
    assert float(index(found, 500.0)) == pytest.approx(expected, abs=1e-6)
    assert any("its formula goes on" in note for note in found["notes"])


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "no index of refraction"),
        ("500,1.5\n600,1.5\n700,1.5\n", "expected 440 to 640 nm"),
        ("400,1.5\n500,1.5\n", "3 at least"),
        ("400 1.5\n390 1.5\n700 1.5\n", "2: 390 after 400, expected increasing"),
        ("400 1.5\n500 -1\n700 1.5\n", "2: an index of -1, expected 1 to 5"),
        ("400 1.5\n500 nan\n700 1.5\n", "2: an index of NaN"),
        ("400 1.5\n500 1 2 3\n700 1.5\n", "2: '500 1 2 3' was found, expected a wavelength and n"),
        ("DATA:\n  - type: formula 12\n    coefficients: 1\n", "3: formula 12, expected one of 1 to 9"),
        ("DATA:\n  - type: formula 2\n    coefficients: 0 1\n", "3: 2 coefficients of formula 2"),
        ("DATA:\n  - type: formula 2\n    coefficients: 0 x 1\n", "3: .* was found, expected the coefficients of formula 2"),
        ("DATA:\n  - type: formula 2\n    wavelength_range: 0.4\n", "3: .* was found, expected the first and the last"),
        ("DATA:\n  - type: formula 2\n    coefficients: 0 1 0.01\n", "without its wavelength_range"),
        ("DATA:\n  - type: spline\n", "2: 'spline' was found, expected tabulated n"),
    ],
)
def test_bad_files(text, message):
    with pytest.raises(gonio.Error, match=message):
        gonio.read_glass(text.encode(), "glass.yml")


def told(**material):
    made = ball(0.0, samples=1, size=8, **material)
    with gonio.Render(made) as rendering:
        rendering.wait()
        return [str(each) for each in rendering.diagnostics]


def test_what_cannot_be_is_told():
    with pytest.raises(gonio.Error, match="'unobtainium' was found, expected one of N-BK7"):
        gonio.glass("unobtainium")
    assert any("lets no light pass" in each for each in told(glass="water", transmission_weight=0.0))
    assert any("lets no light pass" in each for each in told(glass="water", metal="Au"))
    assert any("and an Abbe number" in each for each in told(glass="water", transmission_dispersion=0.02))
    assert not told(glass="water")
