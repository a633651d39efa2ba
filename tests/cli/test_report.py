"""`gonio report`: the page's figures against closed forms, that it holds everything itself, and its errors."""

import base64
import datetime
import html.parser
import math
import re

import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

# An even 100 cd all around, 4π · 100 lm, 12 W.
LUMINAIRE = """IESNA:LM-63-2002
[MANUFAC] A<b>ME & Sons
[LUMINAIRE] Globe
TILT=NONE
1 -1 1 3 1 1 2 0 0 0
1 1 12
0 90 180
0
100 100 100
"""

STAGE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "Floor" {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-2, -1, 0), (2, -1, 0), (2, 1, 0), (-2, 1, 0)]
    uniform token subdivisionScheme = "none"
    double gonio:grid:spacing = 0.5
    double gonio:grid:margin = 0.25
}
def Xform "Desk" {
    token gonio:meter:quantity = "illuminance"
}
def Camera "Eye" {
    float2 clippingRange = (0.01, 100)
    double3 xformOp:translate = (0, 0, 5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Camera "Round" {
    double gonio:fisheye = 180
    float horizontalAperture = 20
    float verticalAperture = 20
    double3 xformOp:translate = (0, 0, 1)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def SphereLight "Left" (inherits = </Globe>) {
    double3 xformOp:translate = (-1, 0, 2)
}
def SphereLight "Right" (inherits = </Globe>) {
    double3 xformOp:translate = (1, 0, 2)
}
def SphereLight "Dimmed" (inherits = </Globe>) {
    float gonio:photometry:dimming = 0.5
    double3 xformOp:translate = (0, 0, 2)
}
def RectLight "Panel" {
    double gonio:photometry:quantity = 300
    double3 xformOp:translate = (0, 0, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def DistantLight "Sun" {
    float inputs:angle = 0.5
    float inputs:intensity = 0
}
class "Globe" {
    asset gonio:photometry:file = @globe.ies@
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def PortalLight "Window" {
}
"""
GLOBE_LM = 4 * math.pi * 100


@pytest.fixture
def stage(tmp_path):
    (tmp_path / "globe.ies").write_text(LUMINAIRE)
    path = tmp_path / "hall.usda"
    path.write_text(STAGE)
    return path


class Reader(html.parser.HTMLParser):
    """Tables as lists of rows of texts, pictures as their bytes, all other text, and whether every element ends."""

    def __init__(self, text):
        super().__init__()
        self.tables, self.pictures, self.words, self.open = [], [], [], []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        if tag not in ("meta", "img"):
            self.open.append(tag)
        if tag == "table":
            self.tables.append([])
        elif tag == "tr":
            self.tables[-1].append([])
        elif tag in ("td", "th"):
            self.tables[-1][-1].append("")
        elif tag == "img":
            kind, data = re.fullmatch(r"data:image/(\w+);base64,(.*)", dict(attributes)["src"]).groups()
            self.pictures.append((kind, base64.b64decode(data, validate=True)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, text):
        if self.open and self.open[-1] in ("td", "th"):
            self.tables[-1][-1][-1] += text
        else:
            self.words.append(text)

    def table(self, first):
        """The rows of the table whose first column has this name."""
        return next(rows for rows in self.tables if rows[0][0] == first)


def written(run, path, stage, *arguments):
    ended = run("report", stage, "-o", path, "--spp", 4, "-w", 64, "--point-spp", 1024, "--max-bounces", 0, *arguments, timeout=120)
    assert ended.returncode == 0, ended.stderr
    text = path.read_text(encoding="utf-8")
    return text, Reader(text), ended


@pytest.fixture
def page(run, stage, tmp_path):
    return written(run, tmp_path / "hall.html", stage)


def test_the_schedule_counts_flux_and_power(page):
    _, reader, _ = page
    names, *rows, totals = reader.table("type")
    found = {(row[0], row[7]): dict(zip(names, row, strict=True)) for row in rows}
    assert len(rows) == 3
    full, half = found["Globe", "100 %"], found["Globe", "50 %"]
    assert (full["file"], full["maker"], full["count"], half["count"]) == ("globe.ies", "A<b>ME & Sons", "2", "1")
    assert float(full["flux, lm"]) == pytest.approx(GLOBE_LM, abs=0.6)
    assert float(half["flux, lm"]) == pytest.approx(GLOBE_LM / 2, abs=0.6)
    assert float(half["lm/W"]) == pytest.approx(GLOBE_LM / 12, abs=0.6)
    assert float(full["flux in all, lm"]) == pytest.approx(2 * GLOBE_LM, abs=1.1)
    assert float(full["power in all, W"]) == pytest.approx(24)
    panel = next(dict(zip(names, row, strict=True)) for row in rows if row[0] != "Globe")
    assert (panel["flux, lm"], panel["power, W"], panel["file"]) == ("300", "–", "–")
    totals = dict(zip(names, totals, strict=True))
    assert totals["count"] == "4"
    assert float(totals["flux in all, lm"]) == pytest.approx(2.5 * GLOBE_LM + 300, abs=1)
    assert totals["power in all, W"] == "36 without 1 unknown"


def test_grids_and_meters_have_their_figures(page):
    _, reader, _ = page
    names, row = reader.table("grid")
    row = dict(zip(names, row, strict=True))
    assert (row["grid"], row["points"], row["spacing, m"]) == ("/Floor", "21", "0.50 × 0.50")
    average, least = float(row["average"].split()[0]), float(row["least"].split()[0])
    assert float(row["U0"]) == pytest.approx(least / average, abs=0.01)
    _, meter = reader.table("meter")
    # E = I h / d³ of each globe, and 300 lm by Lambert's law from 1 m² 3 m above: within a few per cent Φ / (π h²).
    globes = 100 / 4 * 0.5 + 2 * 100 * 2 / 5**1.5
    assert float(meter[3].split()[0]) == pytest.approx(globes + 300 / (math.pi * 9), rel=0.02)
    words = " ".join(reader.words)
    # Under an open sky the grid's area stands for a room's, and the page says so.
    figures = r"36 W of 3 lights over 8.00 m² of the grid /Floor \(there is no closed room about it\) are 4.50 W/m², ([\d.]+) W/m² per 100 lx"
    density = re.search(figures + "; the power of 1 lights is unknown", words)
    assert float(density[1]) == pytest.approx(450 / average, abs=0.02)


def test_pictures_drawings_and_notes_stand_in_the_page(page):
    text, reader, ended = page
    assert reader.open == []
    kinds = [kind for kind, _ in reader.pictures]
    # Two cameras, each in colour and in false colour, and the grid.
    assert kinds == ["jpeg", "png", "jpeg", "png", "png"]
    for kind, data in reader.pictures:
        assert data.startswith(b"\x89PNG" if kind == "png" else b"\xff\xd8")
    words = " ".join(reader.words)
    assert "C90–C270" in words and "manufacturer: A<b>ME & Sons" in words
    assert "/Sun: distant" in words
    assert "DGP:" in words
    assert "PortalLight" in words and "PortalLight" in ended.stderr
    # Nothing is fetched from elsewhere.
    assert not re.search(r"(?:src|href)=\"(?!data:)", text) and "@import" not in text and "<script src" not in text
    assert "A<b>ME" not in text


def test_the_head_says_what_where_and_when(run, stage, tmp_path):
    sun = ("--sun", "48.21,16.37,2025-06-21T13:00+02:00", "--sky", "overcast")
    about = ("--project", "Hall <b>", "--place", "Vienna", "--date", "1 May 2025")
    _, reader, _ = written(run, tmp_path / "head.html", stage, "--no-pictures", *about, *sun)
    words = [word.strip() for word in reader.words]
    for fact in ("hall", "Hall <b>", "Vienna", "1 May 2025", "2025-06-21T13:00+02:00, overcast sky", "hall.usda"):
        assert fact in words, fact
    text, reader, _ = written(run, tmp_path / "plain.html", stage, "--no-pictures", *sun)
    words = [word.strip() for word in reader.words]
    assert "48.21° north, 16.37° east" in words and datetime.date.today().isoformat() in words
    assert "@media print" in text and "@page" in text


def test_values_are_round_and_in_metres(run, stage, tmp_path):
    path = tmp_path / "hall.usda"
    size = "float inputs:width = 0.6000001\n    float inputs:height = 1.2"
    path.write_text(path.read_text() + f'def RectLight "Old" {{\n    float inputs:intensity = 3199.9998\n    {size}\n}}\n')
    text, reader, _ = written(run, tmp_path / "round.html", path, "--no-pictures")
    assert any(row[0] == "rectangle 0.6 × 1.2 m, 3200 cd/m²" for row in reader.table("type"))
    assert "units" not in text and "3199" not in text
    for cell in reader.table("grid")[1][4:7]:
        # Both have the same places, four digits at most.
        value, error = re.fullmatch(r"([\d.]+) ± ([\d.]+)\slx", cell).groups()
        assert len(value.replace(".", "")) <= 4 and len(value.partition(".")[2]) == len(error.partition(".")[2]) and float(error) > 0


def test_pictures_are_denoised_where_that_is_possible(run, stage, tmp_path):
    pytest.importorskip("pyoidn")
    denoised, reader, _ = written(run, tmp_path / "a.html", stage, "--camera", "Eye")
    noisy, other, _ = written(run, tmp_path / "b.html", stage, "--camera", "Eye", "--no-denoise")
    assert "4 samples a pixel, denoised" in denoised and "denoised" not in noisy
    assert reader.pictures[0] != other.pictures[0] and reader.pictures[1] != other.pictures[1]


def test_one_camera_or_none(run, stage, tmp_path):
    _, reader, _ = written(run, tmp_path / "one.html", stage, "--camera", "Eye", "--title", "A <hall>")
    assert len(reader.pictures) == 3 and "A <hall>" in reader.words
    _, reader, _ = written(run, tmp_path / "none.html", stage, "--no-pictures", "--grid", "/Floor", "--spacing", 1, "--quiet")
    assert [kind for kind, _ in reader.pictures] == ["png"]


def test_the_same_page_again(run, stage, tmp_path):
    texts = [written(run, tmp_path / name, stage, "-j", threads)[0] for name, threads in (("a.html", 1), ("b.html", 2))]
    assert texts[0] == texts[1]


def test_errors_are_one_line_and_leave_nothing(run, stage, tmp_path):
    output = tmp_path / "page.html"
    for arguments, words in (
        (("-o", tmp_path / "page.docx"), "expected html or htm or pdf"),
        (("-o", output, "--camera", "Nobody"), "there is no camera 'Nobody'"),
        (("-o", output, "--grid", "/Nothing"), "/Nothing"),
        (("-o", output, "--steps", 0), "steps"),
        (("-o", output, "--max-luminance", 0), "max"),
        (("-o", output, "--strict"), "PortalLight"),
    ):
        ended = run("report", stage, "--quiet", *arguments, check=False)
        assert ended.returncode == 1 and words in ended.stderr and len(ended.stderr.splitlines()) == 1, (arguments, ended.stderr)
    (tmp_path / "file").write_text("")
    ended = run("report", stage, "--quiet", "--no-pictures", "-o", tmp_path / "file" / "page.html", check=False)
    assert ended.returncode == 1 and len(ended.stderr.splitlines()) == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "globe.ies", "hall.usda"]


def test_a_stage_without_lights_cameras_and_grids(run, tmp_path):
    bare = tmp_path / "bare.usda"
    bare.write_text('#usda 1.0\n(\n    upAxis = "Z"\n)\ndef Cube "Box" {\n}\n')
    _, reader, _ = written(run, tmp_path / "bare.html", bare)
    assert "The stage has no lights with a place." in reader.words
    assert len(reader.pictures) == 2


def walls(y0, y1, doors=()):
    """Points of upright rectangles along x at y0 and y1, and along y at 0 and 6 m, 2.8 m high; doors are holes of 0.9 by 2.1 m at y1."""
    def along_x(y, x0, x1, z0=0):
        return [(x0, y, z0), (x1, y, z0), (x1, y, 2.8), (x0, y, 2.8)]

    found = along_x(y0, 0, 6) + [(x, y, z) for x in (0, 6) for y, z in ((y0, 0), (y1, 0), (y1, 2.8), (y0, 2.8))]
    start = 0
    for door in doors:
        found += along_x(y1, start, door) + along_x(y1, door, door + 0.9, 2.1)
        start = door + 0.9
    return found + along_x(y1, start, 6)


def test_power_density_is_the_rooms(run, tmp_path):
    """An office of 6 by 4.5 m with two luminaires, and through a door a corridor with a third: the grid covers 5 by 3.5 m of the office."""
    (tmp_path / "globe.ies").write_text(LUMINAIRE)
    points = [(x, y, z) for z in (0, 2.8) for x, y in ((0, 0), (6, 0), (6, 6.3), (0, 6.3))]
    points += walls(0, 4.5, doors=[4.6]) + walls(4.5, 6.3)[4:]
    counts = ", ".join(["4"] * (len(points) // 4))
    indices = ", ".join(str(k) for k in range(len(points)))
    corners = ", ".join(str(tuple(map(float, point))) for point in points)
    lamp = 'def SphereLight "L{}" (inherits = </Globe>) {{\n    double3 xformOp:translate = {}\n}}\n'
    lamps = "".join(lamp.format(k, place) for k, place in enumerate([(1, 1, 2.5), (5, 3, 2.5), (3, 5.4, 2.5)]))
    stage = tmp_path / "office.usda"
    stage.write_text(f"""#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "Office" {{
    int[] faceVertexCounts = [{counts}]
    int[] faceVertexIndices = [{indices}]
    point3f[] points = [{corners}]
    uniform token subdivisionScheme = "none"
    uniform bool doubleSided = 1
}}
def Xform "Plane" {{
    token gonio:grid:quantity = "illuminance"
    double2 gonio:grid:size = (5, 3.5)
    double gonio:grid:spacing = 0.5
    double3 xformOp:translate = (3, 2.25, 0.75)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
{lamps}
class "Globe" {{
    asset gonio:photometry:file = @globe.ies@
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
""")
    _, reader, _ = written(run, tmp_path / "office.html", stage, "--no-pictures", "--grid-density")
    words = " ".join(reader.words)
    assert re.search(r"24 W of 2 lights over 27\.00 m² of the room about /Plane are 0\.89 W/m²", words), words
    assert re.search(r"36 W of 3 lights over 17\.50 m² of the grid /Plane are 2\.06 W/m²", words), words
    _, reader, _ = written(run, tmp_path / "room.html", stage, "--no-pictures")
    assert "of the grid" not in " ".join(reader.words)
