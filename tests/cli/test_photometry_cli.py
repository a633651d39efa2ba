"""`gonio photometry`: figures, drawings and conversions of a file that the test writes."""

import json
import math
import pathlib
import xml.etree.ElementTree as ET

import pictures
import pytest

LAMBERTIAN_LM = 500.0


@pytest.fixture(scope="module")
def luminaire(tmp_path_factory):
    """A Lambertian downlight of 500 lm, in cd/klm of two alternative lamps."""
    angles = [i * 2.5 for i in range(37)]
    head = "ACME;1;1;1;0;37;2.5;report 7;Downlight;DL-1;dl.ldt;today;200;0;50;180;0;0;0;0;0;100;50;1,0;0;2"
    lamps = "1;LED;1000;3000 K;90;10;2;LED;3000;4000 K;80;24"
    candela = [1000 / math.pi * 0.5 * math.cos(math.radians(angle)) for angle in angles]
    values = [*head.split(";"), *lamps.split(";"), *["0.5"] * 10, 0, *angles, *candela]
    path = tmp_path_factory.mktemp("luminaire") / "downlight.ldt"
    path.write_bytes("\r\n".join(str(value) for value in values).encode("latin-1"))
    return path


def facts(run, *arguments):
    return json.loads(run("photometry", *arguments, "--json").stdout)


def test_figures(run, luminaire):
    found = facts(run, luminaire)
    assert found["flux_lm"] == pytest.approx(LAMBERTIAN_LM, rel=1e-3)
    assert found["peak_cd"] == pytest.approx(LAMBERTIAN_LM / math.pi)
    assert found["efficacy_lm_per_w"] == pytest.approx(50, rel=1e-3)
    assert found["beam_angle_deg"] == pytest.approx([120, 120], abs=0.1)
    assert found["light_output_ratio"] == pytest.approx(0.5, rel=1e-3)
    assert found["downward_fraction"] == pytest.approx(1)
    assert found["symmetry_found"] == "rotational"
    assert found["opening"]["shape"] == "disk"
    assert found["warnings"] == []


def test_text(run, luminaire):
    text = run("photometry", luminaire).stdout
    for part in ("luminaire: Downlight", "flux: 499.9 lm", "lamp set 1 (in use): 1 × LED, 1000 lm", "lamp set 2: 2 × LED, 3000 lm"):
        assert part in text


def test_lamp_sets_are_alternatives(run, luminaire):
    other = facts(run, luminaire, "--lamp-set", 2)
    assert other["flux_lm"] == pytest.approx(3 * LAMBERTIAN_LM, rel=1e-3)
    assert other["watts"] == 24
    wrong = run("photometry", luminaire, "--lamp-set", 3)
    assert wrong.returncode == 1
    assert "lamp set 3 was asked for, the file has 2" in wrong.stderr


def test_drawings(run, luminaire, tmp_path):
    polar, cone = tmp_path / "polar.svg", tmp_path / "cone.svg"
    run("photometry", luminaire, "--polar", polar, "--cone", cone)
    assert ET.parse(polar).getroot().tag.endswith("svg")
    # E = I / d².
    assert f"1 m, {LAMBERTIAN_LM / math.pi:.0f} lx" in cone.read_text()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["cone.svg", "polar.svg"]


@pytest.mark.parametrize("option", ["--polar", "--cone"])
def test_drawings_as_pictures_have_twice_the_pixels(run, luminaire, tmp_path, option):
    drawing, picture = tmp_path / "drawing.svg", tmp_path / "drawing.png"
    for path in (drawing, picture):
        run("photometry", luminaire, option, path)
    root = ET.parse(drawing).getroot()
    assert pictures.png_size(picture) == tuple(2 * int(root.get(side)) for side in ("width", "height"))


def test_conversion_keeps_the_light(run, luminaire, tmp_path):
    whole = facts(run, luminaire)
    for name in ("out.ies", "out.ldt"):
        run("photometry", luminaire, "--convert", tmp_path / name, "--rotate", 90)
        again = facts(run, tmp_path / name)
        assert again["flux_lm"] == pytest.approx(whole["flux_lm"], rel=1e-6)
        assert again["opening"]["size_m"] == pytest.approx(whole["opening"]["size_m"])
        assert again["light_output_ratio"] == pytest.approx(whole["light_output_ratio"], rel=1e-6)


def test_symmetries_are_given_and_keep_the_flux(run, tmp_path):
    path, even = tmp_path / "skew.ies", tmp_path / "even.ies"
    path.write_text("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 3 1 2 0 0 0\n1 1 10\n0 90\n0 90 180\n100 80\n100 60\n100 10\n")
    whole = facts(run, path)
    assert whole["symmetry_found"] == "about C0-C180"
    for name, found in (("rotational", "rotational"), ("quadrants", "quadrants"), ("c90", "quadrants"), ("none", "about C0-C180")):
        run("photometry", path, "--symmetry", name, "--convert", even)
        again = facts(run, even)
        assert (again["symmetry_found"], again["flux_lm"]) == (found, pytest.approx(whole["flux_lm"], rel=1e-6))
    assert run("photometry", path, "--symmetry", "odd").returncode == 2


def test_a_stated_flux_that_is_wrong_is_told(run, luminaire, tmp_path):
    lines = luminaire.read_text("latin-1").split("\n")
    lines[22] = "80"
    path = tmp_path / "wrong.ldt"
    path.write_text("\n".join(lines), "latin-1")
    (warning,) = facts(run, path)["warnings"]
    assert "80.0000 % of 1000 lm" in warning


def test_errors_are_one_line_with_place(run, luminaire, tmp_path):
    lines = luminaire.read_text("latin-1").split("\n")
    lines[60] = "rubbish"
    path = tmp_path / "broken.ldt"
    path.write_text("\n".join(lines), "latin-1")
    for arguments, expected in [
        ((path,), "broken.ldt:61: 'rubbish' was found"),
        ((tmp_path / "none.ies",), "none.ies"),
        ((luminaire, "--polar", tmp_path / "polar.jpg"), "the ending is 'jpg', expected svg or png"),
        ((luminaire, "--convert", tmp_path / "out.txt"), "the ending is 'txt', expected ies or ldt"),
    ]:
        failed = run("photometry", *arguments)
        assert failed.returncode == 1
        assert expected in failed.stderr
        assert len(failed.stderr.strip().split("\n")) == 1
    assert [entry.name for entry in tmp_path.iterdir()] == ["broken.ldt"]
    wrong = run("photometry", luminaire, "--rotate", "nan")
    assert wrong.returncode == 2 and "'nan' was found, expected a number" in wrong.stderr


def test_a_tilt_takes_the_files_factors(run, tmp_path):
    path = tmp_path / "tilting.ies"
    path.write_text("IESNA:LM-63-2002\nTILT=INCLUDE\n1\n2\n0 90\n1 0.5\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 90 180\n0\n100 100 100\n")
    assert facts(run, path)["peak_cd"] == pytest.approx(100)
    tilted = facts(run, path, "--tilt", -45)
    assert tilted["peak_cd"] == pytest.approx(75)
    assert tilted["tilt"]["factors"] == [1, 0.5]
    assert "factors by tilt from 0° to 90°" in run("photometry", path).stdout


def test_tilt_factors_are_read_from_the_file_beside(run, tmp_path):
    path = tmp_path / "tilting.ies"
    path.write_text("IESNA:LM-63-2002\nTILT=LAMP.TLT\n1 -1 1 3 1 1 2 0 0 0\n1 1 10\n0 90 180\n0\n100 100 100\n")
    alone = facts(run, path)
    assert alone["tilt"] is None
    (warning,) = alone["warnings"]
    assert "line 2: the TILT file 'LAMP.TLT' cannot be read: No such file" in warning and "TILT=NONE" in warning
    (tmp_path / "LAMP.TLT").write_text("1\n2\n0 90\n1 0.5\n")
    assert facts(run, path, "--tilt", 45)["peak_cd"] == pytest.approx(75)
    (tmp_path / "LAMP.TLT").unlink()
    (tmp_path / "LAMP.TLT").mkdir()
    assert "cannot be read" in facts(run, path)["warnings"][0]


def test_a_tilt_that_no_file_tells_of_is_refused(run, luminaire):
    ended = run("photometry", luminaire, "--tilt", 10, check=False)
    assert ended.returncode == 1 and "no tilt factors" in ended.stderr


UGR = pathlib.Path(__file__).resolve().parents[2] / "rust-core/formats/tests/data/ugr-table"


def test_the_ugr_table_is_that_of_lighting_programs(run):
    for number in ("02", "07"):
        table = facts(run, UGR / f"s{number}.ldt", "--ugr-table")["ugr_table"]
        assert table["spacing_to_height"] == 0.25 and table["rooms"][5] == [2, 12]
        found = [a + b for a, b in zip(table["crosswise"], table["endwise"], strict=True)]
        printed = [
            [[float(x) for x in line.split(",")] for line in (UGR / f"{number}.{program}.csv").read_text().split("\n")]
            for program in ("Dialux", "Relux")
        ]
        for row, *others in zip(found, *printed, strict=True):
            for value, a, b in zip(row, *others, strict=True):
                assert min(a, b) - 0.3 <= value <= max(a, b) + 0.3


def test_the_ugr_table_as_text(run):
    lines = run("photometry", UGR / "s07.ldt", "--ugr-table").stdout.splitlines()
    assert lines[0].startswith("sample_07: UGR (CIE 117, CIE 190), luminaires 0.25 times")
    assert len(lines) == 5 + 19 and lines[5].startswith("2H × 2H") and len(lines[5].split()) == 3 + 10
    wide = run("photometry", UGR / "s07.ldt", "--ugr-table", "--shr", 1)
    assert wide.returncode == 0 and wide.stdout != "\n".join(lines)
    wrong = run("photometry", UGR / "s07.ldt", "--ugr-table", "--shr", 9)
    assert wrong.returncode == 1 and "expected 0.1 to 2" in wrong.stderr


def test_flux_codes_and_bug_rating(run, luminaire, tmp_path):
    found = facts(run, luminaire)
    # A cosine: 7/16, 3/4, 15/16 of the flux down; half of the lamps' flux.
    assert found["cie_flux_codes"] == [44, 75, 94, 100, 50]
    assert found["bug"] == "B0 U0 G0" and found["zones_lm"]["front_deg"] == 90
    assert sum(found["zones_lm"]["forward"]) == pytest.approx(LAMBERTIAN_LM / 2, rel=2e-3)
    assert "CIE flux codes: 44 75 94 100 50" in run("photometry", luminaire).stdout
    point = tmp_path / "point.ies"
    point.write_text("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 180\n0\n100 100\n")
    assert facts(run, point)["beam_angle_deg"] == [180, 180]
    wrong = run("photometry", point, "--ugr-table")
    assert wrong.returncode == 1 and "no luminous opening" in wrong.stderr


# Nodes and candelas of a globe, and of one with few angles; of a pole's lantern that ends above the horizon; of a cosine.
ROUND = [
    ("0 180", "100 100", 180),
    ("0 45 90 135 180", "100 95 90 80 50", 180),
    (" ".join(str(7 * i) for i in range(16)), "100 " * 13 + "80 40 0", 180),
    ("0 20 40 60 80 100", "100 94 77 50 17 0", 120),
    # Half is between 10 and 20 degrees, at 16; once from nadir, once from zenith.
    ("0 10 20 30 90", "100 80 30 0 0", 32),
    ("90 150 160 170 180", "0 0 30 80 100", 32),
]


@pytest.mark.parametrize(("angles", "candela", "beam"), ROUND)
def test_a_beam_ends_where_the_curve_is_half(run, tmp_path, angles, candela, beam):
    path = tmp_path / "round.ies"
    path.write_text(f"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {len(angles.split())} 1 1 2 0 0 0\n1 1 10\n{angles}\n0\n{candela}\n")
    assert facts(run, path)["beam_angle_deg"] == pytest.approx([beam, beam], abs=1e-9)


def test_a_beam_that_is_not_round_ends_where_its_curves_are_half(run, tmp_path):
    head = "ACME;2;4;4;90;10;10;report 8;Oval;OV-1;ov.ldt;today;200;0;50;180;0;0;0;0;0;100;100;1;0;1"
    planes = [100, 80, 30, *[0] * 7], [100, 95, 85, 45, 5, *[0] * 5]
    lamps = [1, "LED", 1000, "3000 K", 90, 10]
    lines = [*head.split(";"), *lamps, *[0.5] * 10, 0, 90, 180, 270, *range(0, 100, 10), *planes[0], *planes[1]]
    oval = tmp_path / "oval.ldt"
    oval.write_text("\r\n".join(map(str, lines)))
    found = facts(run, oval)
    assert found["beam_angle_deg"] == pytest.approx([2 * 16, 2 * 28.75], abs=1e-9)
    assert found["field_angle_deg"] == pytest.approx([2 * (20 + 20 / 3), 2 * 38.75], abs=1e-9)
    # A wall washer, whose sides differ: 51.4 degrees to the wall, 12 from it; each plane's half is of its own greatest.
    washer = tmp_path / "washer.ies"
    washer.write_text(
        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 5 3 1 2 0 0 0\n1 1 10\n0 20 40 60 80\n0 90 180\n80 100 90 20 0\n80 60 35 0 0\n80 30 0 0 0\n"
    )
    assert facts(run, washer)["beam_angle_deg"] == pytest.approx([12 + 40 + 20 * 40 / 70, 2 * 36], abs=1e-9)
