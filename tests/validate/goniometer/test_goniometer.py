"""The virtual goniophotometer against closed forms and double-precision tracers: 1 % where intensity is above a tenth of the peak."""

import by_camera
import comparing
import expected
import figures
import luminaires
import numpy
import pytest

pytestmark = pytest.mark.validate

SECTION = "Goniophotometer"
# What each scene is called on the page, with what it is compared, and at which angles: zones wide enough for their rays.
NARROW = ["--c-step", "90", "--symmetry", "rotational", "--gammas", "0:28:1,30:180:5"]
ROUND = ["--c-step", "90", "--symmetry", "rotational", "--g-step", "5"]
ROWS = {
    "reflector": ("parabolic mirror about a sphere", "closed form", NARROW),
    "lens": ("plano-convex lens before a disk", "rays through the exact surfaces", NARROW),
    "guide": ("light guide with dots", "rays through the exact box", ["--c-step", "10", "--symmetry", "c0", "--g-step", "5"]),
    "opal": ("chip under an opal cover", "radiosity", ROUND),
    "shell": ("point lamp in a glass shell", "I", ROUND),
    "screened_shell": ("point lamp in a glass shell, black above", "I (1 − R) / (1 + R)", ROUND),
}
RAYS = ["--rays", "200M", "--error", "0"]


@pytest.fixture(scope="module")
def stages(tmp_path_factory):
    return luminaires.write(tmp_path_factory.mktemp("luminaires"))


def test_a_file_of_the_expected_figures_deviates_by_nothing(tmp_path):
    for name in ROWS:
        file = tmp_path / f"{name}.ies"
        comparing.write_ies(name, file)
        assert comparing.compare(name, file, points=True).largest < 1e-5, name


def test_zones_are_the_means_of_their_solid_angles():
    kept = expected.read("opal")
    borders = numpy.radians(numpy.array([0.0, 22.5, 67.5, 112.5, 157.5, 180.0]))
    solid = 2 * numpy.pi * (numpy.cos(borders[:-1]) - numpy.cos(borders[1:]))
    means = kept.cell_means(numpy.array([0.0, 45.0, 90.0, 135.0, 180.0]))
    assert (means * solid).sum() == pytest.approx(luminaires.LUMENS * kept.ratio, rel=1e-3)


def test_stages_read_without_complaints(stages, run):
    for name, path in stages.items():
        told = run("info", path, "--strict")
        assert told.returncode == 0, (name, told.stderr)
        assert "no camera" in told.stderr or "warning" not in told.stderr.lower(), (name, told.stderr)


@pytest.mark.parametrize("name", list(by_camera.ANGLES))
def test_path_tracing_from_afar_sees_the_same(stages, name):
    for plane, gamma in by_camera.ANGLES[name]:
        found, error = by_camera.intensity(stages[name], plane, gamma)
        wanted, own = by_camera.expectation(name, plane, gamma)
        assert abs(found - wanted) < 5 * numpy.hypot(error, own) + 0.002 * wanted, (plane, gamma, found, error, wanted, own)


@pytest.mark.parametrize("name", list(ROWS))
def test_goniometer(stages, name, run, tmp_path):
    if run("goniometer", "--help").returncode != 0:
        pytest.skip("this gonio has no goniometer")
    file = tmp_path / f"{name}.ldt"
    case, reference, angles = ROWS[name]
    told = run("goniometer", stages[name], "--luminaire", "/Lamp", "-o", file, *angles, *RAYS, timeout=900)
    assert told.returncode == 0, told.stderr
    found = comparing.compare(name, file)
    print(found)
    figures.check(figures.Row(SECTION, case, reference, found.points, found.largest, comparing.LIMIT))
