"""What the goniophotometer's files say of a luminaire: where its light leaves, how much goes up, which kind it is, and how sure its figures are."""

import csv
import math

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")

# An open reflector, wider at its mouth, about a tube: a trough of 0.2 m by 1.24 m.
TOP, MOUTH, HALF, DEPTH = 0.05, 0.1, 0.62, 0.1
CORNERS = np.array([(s * w, t * HALF, z) for z, w in ((0.0, TOP), (-DEPTH, MOUTH)) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
TOP_FACE, SIDES = (0, 1, 2, 3), [(0, 3, 7, 4), (1, 5, 6, 2), (0, 4, 5, 1), (3, 2, 6, 7)]


def turned(degrees):
    """About y: what looks down looks towards C0 as well."""
    c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return np.array([(c, 0, -s, 0), (0, 1, 0, 0), (s, 0, c, 0), (0, 0, 0, 1)])


def moved(x=0.0, y=0.0, z=0.0):
    transform = np.eye(4)
    transform[:3, 3] = (x, y, z)
    return transform


def add_mesh(scene, points, quads, place, reflectance=0.85):
    triangles = np.array([corner for a, b, c, d in quads for corner in ((a, b, c), (a, c, d))], "i4")
    mesh = scene.add_mesh(np.asarray(points, "f4"), triangles)
    paint = scene.add_material(f"paint {len(points)} {reflectance}", base_color=(reflectance,) * 3, specular_weight=0.0)
    scene.add_instance(mesh, [paint], transform=place.tolist())


def add_trough(scene, place, faces=(TOP_FACE, *SIDES)):
    add_mesh(scene, CORNERS, faces, place)
    along_y = np.eye(4)
    along_y[:3, :3] = [(0, -1, 0), (1, 0, 0), (0, 0, 1)]
    scene.add_light("cylinder", radius=0.013, length=1.2, lumens=3000, transform=(place @ moved(z=-0.04) @ along_y).tolist())


def measured(scene, rays=1_000_000, **options):
    return gonio.goniometer(scene, rays=rays, error=0, **options)


def lines_of(reading, tmp_path, **options):
    reading.write(tmp_path / "luminaire.ldt", **options)
    return (tmp_path / "luminaire.ldt").read_bytes().decode("latin-1").split("\r\n")


def table(lines, area=None):
    """The UGR table of an EULUMDAT file, with another luminous area (length, width, four heights in mm) in the place of its own."""
    lines = list(lines)
    if area is not None:
        lines[15:21] = [str(number) for number in area]
    found = gonio.ugr_table("\r\n".join(lines).encode("latin-1"), "luminaire.ldt")
    return np.array(found["crosswise"] + found["endwise"], float)


def same(a, b, tolerance=0.1):
    assert np.nanmax(np.abs(a - b)) < tolerance, (a[:2], b[:2])


def test_the_mouth_of_an_open_reflector(tmp_path):
    scene = gonio.Scene()
    add_trough(scene, np.eye(4))
    reading = measured(scene)
    lines = lines_of(reading, tmp_path)
    length, width, *heights = map(float, lines[15:21])
    assert length == pytest.approx(1240, rel=0.01) and width == pytest.approx(200, rel=0.01) and heights == [0] * 4
    assert np.asarray(reading.opening)[:, 2] == pytest.approx(-DEPTH, abs=1e-3) and reading.opening_area == pytest.approx(0.248, rel=0.01)
    same(table(lines), table(lines, (1240, 200, 0, 0, 0, 0)))
    found = table(lines)
    # Crosswise in 2H × 2H and endwise in 2H × 6H, 70/50/20.
    assert found[0, 0] == pytest.approx(16.7, abs=0.15) and found[19 + 3, 0] == pytest.approx(20.1, abs=0.15)


def test_the_mouth_of_a_tilted_reflector(tmp_path):
    scene = gonio.Scene()
    add_trough(scene, turned(40))
    lines = lines_of(measured(scene), tmp_path)
    # A rectangle aslant: its floor plan, and towards C0 what it rises.
    side = 2000 * MOUTH * math.sin(math.radians(40))
    area = (1240, 2000 * MOUTH * math.cos(math.radians(40)), side, 0, 0, 0)
    heights = [float(line) for line in lines[17:21]]
    assert heights[0] == pytest.approx(side, rel=0.05) and heights[1:] == [0] * 3
    same(table(lines), table(lines, area))


def test_two_mouths_are_two_parts(tmp_path):
    scene = gonio.Scene()
    for x in (-0.3, 0.3):
        add_trough(scene, moved(x=x))
    reading = measured(scene)
    assert len(reading.opening_parts) == 2 and reading.opening_area == pytest.approx(2 * 0.248, rel=0.02)
    lines = lines_of(reading, tmp_path)
    length, width, *heights = map(float, lines[15:21])
    assert length * width == pytest.approx(2 * 248000, rel=0.02) and heights == [0] * 4
    same(table(lines), table(lines, (1240, 400, 0, 0, 0, 0)))


def test_a_wall_washer_shines_to_one_side(tmp_path):
    scene = gonio.Scene()
    add_trough(scene, np.eye(4), (TOP_FACE, SIDES[0], *SIDES[2:]))
    lines = lines_of(measured(scene), tmp_path)
    length, width, *heights = map(float, lines[15:21])
    assert length * width == pytest.approx(248000, rel=0.1) and heights[0] > 50 and heights[1:] == [0] * 3
    # The open side leans outwards: from γ = 65° it shows 1.24 m times what it is high less what it leans.
    shown = 1240 * (1e3 * DEPTH - 1e3 * (MOUTH - TOP) / math.tan(math.radians(65)))
    assert heights[0] * length == pytest.approx(shown, rel=0.12)


def test_a_globe_is_no_cylinder(tmp_path):
    scene = gonio.Scene()
    scene.add_light("sphere", radius=0.15, lumens=1000)
    reading = measured(scene)
    reading.write(tmp_path / "globe.ies")
    assert np.diff(np.asarray(reading.opening), axis=0)[0] == pytest.approx(0.3, rel=0.02) and reading.round
    # LM-63 has spheres: all three extents negative.
    text = (tmp_path / "globe.ies").read_text().split("TILT=NONE")[1].split()
    assert [float(x) for x in text[7:10]] == pytest.approx([-0.3] * 3, rel=0.02)


def test_no_light_above_the_horizon(tmp_path):
    # A disk, and a lamp under a plate that is as good as endless: the first falls to 0 at the horizon, the other jumps there.
    disk, lamp = gonio.Scene(), gonio.Scene()
    disk.add_light("disk", radius=0.05, lumens=1000)
    lamp.add_light("point", lumens=1000)
    add_mesh(lamp, [(-1e3, -1e3, 0.001), (1e3, -1e3, 0.001), (1e3, 1e3, 0.001), (-1e3, 1e3, 0.001)], [(0, 1, 2, 3)], np.eye(4), 0.0)
    for scene in (disk, lamp):
        reading = measured(scene)
        assert reading.flux_up.value == pytest.approx(0, abs=1e-3 * reading.flux.value)
        intensities = np.asarray(reading.intensities)
        assert (intensities[:, np.asarray(reading.gamma) > 90] == 0).all() and intensities[:, 18].max() < 1e-2 * intensities.max()
    lines = lines_of(measured(disk), tmp_path)
    figures = gonio.goniogram_figures("\r\n".join(lines).encode("latin-1"), "disk.ldt")
    assert float(lines[21]) == 100 and figures["downward_fraction"] == 1 and "U0" in figures["bug"]


def test_light_above_the_horizon_is_counted(tmp_path):
    scene = gonio.Scene()
    scene.add_light("disk", radius=0.05, lumens=700)
    scene.add_light("disk", radius=0.05, lumens=300, transform=(moved(z=0.02) @ np.diag([1.0, -1, -1, 1])).tolist())
    reading = measured(scene)
    assert reading.flux_up.value == pytest.approx(300, rel=0.02)
    assert float(lines_of(reading, tmp_path)[21]) == pytest.approx(70, abs=0.6)


@pytest.mark.parametrize(("light", "kind"), [({}, "1"), ({"tilt": 40}, "3"), ({"tilt": 40, "turn": 33}, "3"), ({"long": True, "tilt": 40}, "2")])
def test_the_kind_is_one_that_readers_know(tmp_path, light, kind):
    scene = gonio.Scene()
    c, s = math.cos(math.radians(light.get("turn", 0))), math.sin(math.radians(light.get("turn", 0)))
    place = np.array([(c, -s, 0, 0), (s, c, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1)]) @ turned(light.get("tilt", 0))
    shape = ("rectangle", {"width": 0.1, "height": 1.2}) if light.get("long") else ("disk", {"radius": 0.05})
    scene.add_light(shape[0], lumens=1000, transform=place.tolist(), **shape[1])
    lines = lines_of(measured(scene, 500_000), tmp_path, symmetry=None if light else "rotational")
    assert lines[1] == kind, lines[:5]


def test_noise_does_not_raise_the_peak():
    # Each of 864 directions has an error of several per cent: the greatest of them is far above what is true.
    scene = gonio.Scene()
    scene.add_light("point", candela=100)
    peaks, errors = [], []
    for seed in range(12):
        found = measured(scene, 400_000, seed=seed, symmetry="none")
        peaks.append(found.peak.value)
        errors.append(found.peak.standard_error)
        assert np.asarray(found.intensities).max() > 108
    assert np.mean(peaks) == pytest.approx(100, abs=4 * np.sqrt(np.mean(np.square(errors)) / 12))
    # A cosine, with a symmetry.
    disk = gonio.Scene()
    disk.add_light("disk", radius=0.05, candela=100)
    found = [measured(disk, 400_000, seed=seed).peak for seed in range(6)]
    assert np.mean([peak.value for peak in found]) == pytest.approx(100, abs=1.5)


def test_it_stops_by_the_error_of_the_file():
    scene = gonio.Scene()
    scene.add_light("point", candela=100)
    found = gonio.goniometer(scene, error=0.01)
    assert found.converged and found.rays < 5_000_000 and found.peak.standard_error < 1
    # All planes on their own take far more.
    assert not gonio.goniometer(scene, error=0.01, rays=2_000_000, symmetry="none").converged


def test_nothing_is_made_of_noise():
    # White walls absorb nothing: what noise makes of that is not below 0, and its error is told.
    scene = gonio.Scene()
    scene.add_light("point", lumens=1000)
    add_mesh(scene, CORNERS, (TOP_FACE, *SIDES), moved(z=0.05), 1.0)
    for seed in range(3):
        found = measured(scene, 300_000, seed=seed)
        assert found.absorbed.value >= 0 and found.light_output_ratio.value <= 1 and not found.diagnostics
        assert found.absorbed.value < 4 * found.absorbed.standard_error + 1e-3 * 1000
        assert found.emitted.value == pytest.approx(found.flux.value + found.absorbed.value + found.cut_off.value)


def test_files_hold_no_more_than_the_sources_send(tmp_path):
    scene = gonio.Scene()
    scene.add_light("point", lumens=1000, cosine_power=40)
    reading = measured(scene, g_step=10)
    lines = lines_of(reading, tmp_path)
    figures = gonio.goniogram_figures("\r\n".join(lines).encode("latin-1"), "beam.ldt")
    assert figures["flux_lm"] <= figures["lamp_flux_lm"] * (1 + 1e-9) and float(lines[22]) <= 100


def test_small_sources_have_two_ratings(tmp_path):
    # A downlight of 6 cm in a room: CIE 147 takes it as 0.005 m² wide, CIE 117's formula as wide as it is, as tables do.
    goniogram = ["", "1", "1", "1", "0", "19", "5", "", "spot", "", "", "", "60", "0", "10", "60", "0", "0", "0", "0", "0", "100", "100", "1", "0", "1"]
    goniogram += ["-1", "", "1000", "", "", "0", *["0"] * 10, "0", *[str(5 * k) for k in range(19)]]
    goniogram += [str(1000 / math.pi * math.cos(math.radians(5 * k))) for k in range(18)] + ["0"]
    lamp, _ = gonio.read_goniogram("\r\n".join(goniogram).encode(), "spot.ldt")
    scene = gonio.Scene()
    scene.add_light("luminaire", goniogram=lamp, transform=moved(0, 2, 1.5).tolist())
    scene.add_light("dome", (20.0,) * 3)
    scene.add_meter((0, 0, 0), facing=(0, 1, 0), quantity="ugr")
    found = gonio.measure(scene, samples=256)
    reading = found.meters[0]
    shown = math.pi / 4 * 0.06**2 * 1.5 / 2.5
    assert reading.small_sources == 1
    assert reading.as_in_tables.value - reading.value == pytest.approx(8 * math.log10(0.005 / shown), abs=0.02)
    (row,) = csv.DictReader(found.csv().splitlines())
    assert float(row["ugr_as_in_tables"]) == pytest.approx(reading.as_in_tables.value, abs=1e-5)
    # Points have no luminance, and no rating in tables.
    scene.add_light("point", candela=10, transform=moved(0.5, 2, 1.5).tolist())
    reading = gonio.measure(scene, samples=256).meters[0]
    assert reading.small_sources == 2 and reading.as_in_tables is None and reading.value > 0
