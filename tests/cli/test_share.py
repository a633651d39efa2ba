"""`gonio share`: pages against `gonio relight` and the tone curve's published formula, in a browser where there is one, and errors."""

import base64
import html
import html.parser
import json
import os
import re
import shutil
import subprocess

import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")
numpy = pytest.importorskip("numpy")
OpenEXR = pytest.importorskip("OpenEXR")

BROWSER = next(filter(None, map(shutil.which, ["chromium", "chromium-browser", "google-chrome"])), None)
SIZE = (96, 64)
# Rec. ITU-R BT.709, item 3.2.
WEIGHTS = numpy.array([0.2126, 0.7152, 0.0722])
# Level and colour temperature of groups.
MIXES = [{}, {"Lamps": (0.3, 0), "Sky": (1.5, 0)}, {"Lamps": (1.2, 2200), "Sky": (0, 0)}, {"Lamps": (0.05, 6500), "Sky": (0.2, 10000)}]

ROOM = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Cube "Floor"
{
    color3f[] primvars:displayColor = [(0.7, 0.35, 0.1)]
    float3 xformOp:scale = (9, 9, 0.1)
    uniform token[] xformOpOrder = ["xformOp:scale"]
}
def Cube "Block"
{
    double size = 1
    color3f[] primvars:displayColor = [(0.1, 0.3, 0.8)]
    double3 xformOp:translate = (0.3, 0, 0.6)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def SphereLight "Lamp"
{
    string gonio:lightGroup = "Lamps"
    color3f inputs:color = (1, 0.6, 0.2)
    float inputs:intensity = 4000
    float inputs:radius = 0.1
    double3 xformOp:translate = (-1, 1, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def DomeLight "Dome"
{
    string gonio:lightGroup = "Sky"
    color3f inputs:color = (0.5, 0.8, 1)
    float inputs:intensity = 40
}
def Camera "Camera"
{
    float focalLength = 24
    double3 xformOp:translate = (0, -4, 2)
    float3 xformOp:rotateXYZ = (65, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
}
"""


@pytest.fixture(scope="module")
def room(tmp_path_factory, run):
    """A stage, and its picture with light groups."""
    stage = tmp_path_factory.mktemp("share") / "room.usda"
    stage.write_text(ROOM)
    done = run("render", stage, "--res", *SIZE, "--spp", 4, "--light-groups", "-o", stage.with_suffix(".exr"), "-q")
    assert done.returncode == 0, done.stderr
    return stage


def colours(path):
    channels = OpenEXR.File(str(path), separate_channels=True).channels()
    return numpy.stack([numpy.asarray(channels[name].pixels, float) for name in "RGB"], axis=-1)


def log_average(light):
    """Of runs of 16 pixels, as docs/finishing.md has it."""
    runs = (light @ WEIGHTS).reshape(-1, 16).mean(axis=1)
    return numpy.exp(numpy.log(runs[runs > 1e-9]).mean())


def shown(light, average, stops=0.0, white=6.0):
    """Reinhard et al. 2002, equation 4, for luminance, then IEC 61966-2-1; in steps of 8 bits."""
    light = light * (0.18 * 2**stops / average)
    y = light @ WEIGHTS
    rise = ((1 + white) / white - 1) / white
    x = numpy.clip(light * ((1 + rise * y) / (1 + y))[..., None], 0, 1)
    return 255 * numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * x ** (1 / 2.4) - 0.055)


def browsed(page, script, plain=False):
    """What a script returns on a page, `show` and `controls` being the page's own."""
    if BROWSER is None:
        pytest.skip("there is no Chromium")
    code = f"""<script>
        const out = Object.assign(document.createElement('pre'), {{ id: 'found' }});
        const told = (found) => {{ out.textContent = JSON.stringify(found); document.body.append(out); }};
        window.gonio.then(async ({{ show, controls, kind }}) => {{ {script} }}).catch((error) => `error: ${{error.stack}}`).then(told);
        </script>"""
    copy = page.with_name("browsed.html")
    copy.write_text(page.read_text() + code)
    words = [BROWSER, "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--virtual-time-budget=60000"]
    words += [f"--user-data-dir={page.parent / 'profile'}", "--dump-dom", copy.as_uri() + ("#plain" if plain else "")]
    done = subprocess.run(words, capture_output=True, text=True, timeout=240, env={**os.environ, "HOME": str(page.parent)})
    found = re.search(r'<pre id="found">(.*?)</pre>', done.stdout, re.DOTALL)
    assert found, done.stdout[-2000:] + done.stderr[-2000:]
    value = json.loads(html.unescape(found[1]))
    assert not (isinstance(value, str) and value.startswith("error:")), value
    return value


def mixed(page, names, mixes, plain=False):
    """The kind of renderer, and of each mix the pixels by the first picture's exposure and by that of an adapted eye."""
    settings = [[mix.get(name, (1, 0)) for name in names] for mix in mixes]
    script = f"""
        const found = [kind];
        const text = () => {{ let out = ''; for (const byte of show.renderer.pixels()) out += String.fromCharCode(byte); return btoa(out); }};
        for (const mix of {json.dumps(settings)}) for (const adapts of [false, true]) {{
            show.adapts = adapts;
            show.choose(mix.map(([level, kelvin]) => ({{ level, kelvin }})), false);
            show.settle();
            found.push(text());
        }}
        return found;"""
    kind, *texts = browsed(page, script, plain)
    width, height = SIZE
    return kind, [numpy.frombuffer(base64.b64decode(text), numpy.uint8).reshape(height, width, 4)[..., :3] for text in texts]


class Links(html.parser.HTMLParser):
    """Addresses that a page names."""

    def __init__(self):
        super().__init__()
        self.found = []

    def handle_starttag(self, tag, attributes):
        self.found += [value for name, value in attributes if name in ("src", "href", "action", "data")]


@pytest.fixture(scope="module")
def page(room, run):
    made = room.with_suffix(".html")
    done = run("share", room.with_suffix(".exr"), "-o", made, "--watts", "Lamps=60", "--scene", "Evening:Lamps=40%@2700,Sky=0", "--title", "A <room>")
    assert done.returncode == 0, done.stderr
    assert done.stdout.strip() == str(made)
    return made


def test_pages_need_nothing_else(page):
    text = page.read_text()
    links = Links()
    links.feed(text)
    assert [link[:23] for link in links.found] == ["data:image/jpeg;base64,"]
    assert not re.search(r"https?:|url\(|@import|fetch\(|XMLHttpRequest", text)
    assert "A &lt;room&gt;" in text and "Evening" in text
    # Without scripts: a table of the groups.
    assert re.search(r'<th scope="row">Lamps</th><td>100 %</td><td>–</td><td>60 W</td>', text)
    assert page.stat().st_size < 300_000


@pytest.mark.parametrize("plain", [False, True], ids=["webgl", "canvas"])
def test_mixes_are_those_of_relight(page, room, run, plain):
    names = ["Lamps", "Sky"]
    kind, pictures = mixed(page, names, MIXES, plain)
    assert kind == ("ByCanvas" if plain else "ByGl")
    first = log_average(colours(room.with_suffix(".exr")))
    for mix, fixed, adapted in zip(MIXES, pictures[::2], pictures[1::2], strict=True):
        lit = room.with_name("lit.exr")
        groups = [f"--group={name}={level}" + (f",{kelvin}" if kelvin else "") for name, (level, kelvin) in mix.items()]
        done = run("relight", room.with_suffix(".exr"), *groups, "-o", lit)
        assert done.returncode == 0, done.stderr
        light = colours(lit)
        for picture, average in [(fixed, first), (adapted, log_average(light))]:
            # Half a step of 8 bits by the light's own steps, another half by rounding.
            assert abs(picture - shown(light, average)).max() <= 1.0, mix


def test_luminance_is_that_of_the_file(page, room):
    light = colours(room.with_suffix(".exr")) @ WEIGHTS
    places = [(3, 2), (48, 32), (90, 60)]
    found = browsed(page, f"return {json.dumps(places)}.map(([x, y]) => show.luminanceAt(x, y));")
    assert found == pytest.approx([light[y, x] for x, y in places], rel=0.004)


def test_controls_set_what_they_say(page):
    script = """
        document.querySelectorAll('.level')[0].value = 50;
        document.querySelectorAll('.level')[0].dispatchEvent(new Event('input'));
        const half = [show.mix[0].level, document.getElementById('energy-total').rows[0].cells[1].textContent];
        document.querySelectorAll('#scenes button')[1].click();
        document.dispatchEvent(new KeyboardEvent('keydown', { key: 'x' }));
        return [half, show.mix, document.querySelectorAll('#scenes button')[1].getAttribute('aria-pressed')];"""
    half, mix, pressed = browsed(page, script)
    assert half == [0.5, "30"] and pressed == "true"
    assert mix == [{"level": 0.4, "kelvin": 2700}, {"level": 0, "kelvin": 0}]


def test_stages_are_rendered_first(room, run, tmp_path):
    done = run("share", room, "-o", tmp_path / "page.html", "-w", 32, "--spp", 1, "--language", "de")
    assert done.returncode == 0, done.stderr
    assert (tmp_path / "page.exr").exists() and '<html lang="de">' in (tmp_path / "page.html").read_text()
    # Lamps are groups where the stage names none.
    stage = tmp_path / "plain.usda"
    stage.write_text("\n".join(line for line in ROOM.splitlines() if "lightGroup" not in line))
    done = run("share", stage, "-o", tmp_path / "plain.html", "-w", 32, "--spp", 1)
    assert done.returncode == 0, done.stderr
    assert re.findall(r'<th scope="row">(.*?)</th>', (tmp_path / "plain.html").read_text()) == ["Dome", "Lamp"]


def test_what_is_too_large_is_reduced_and_told(room, run, tmp_path):
    done = run("share", room.with_suffix(".exr"), "-o", tmp_path / "page.html", "--max-size", 0.085)
    assert done.returncode == 0 and "so that the page stays below 0.085 MB" in done.stderr
    assert (tmp_path / "page.html").stat().st_size <= 85_000


@pytest.mark.parametrize(
    ("options", "problem"),
    [
        (["--watts", "Lamp=3"], "there is no light group 'Lamp', expected one of Lamps, Sky"),
        (["--watts", "Lamps=many"], "expected GROUP=W"),
        (["--scene", "Night"], "expected NAME:GROUP=VALUE"),
        (["--scene", "Night:Moon=1"], "there is no light group 'Moon', expected one of Lamps, Sky"),
        (["--scene", "Night:Sky=151%"], "expected NAME:GROUP=VALUE"),
        (["--scene", "Night:Sky=1@500"], "expected NAME:GROUP=VALUE"),
        (["--max-size", "0.001"], "the page would not come below"),
    ],
)
def test_errors(room, run, tmp_path, options, problem):
    done = run("share", room.with_suffix(".exr"), "-o", tmp_path / "page.html", *options)
    assert done.returncode == 1 and problem in done.stderr, done.stderr
    assert len(done.stderr.strip().splitlines()) == 1 and not (tmp_path / "page.html").exists()


def write_exr(path, channels):
    OpenEXR.File({"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}, channels).write(str(path))


def test_files_that_make_no_page(run, tmp_path):
    even = numpy.full((4, 4), 2.0, numpy.float32)
    write_exr(tmp_path / "none.exr", {name: even for name in "RGB"})
    broken = even.copy()
    broken[1, 2] = numpy.nan
    write_exr(tmp_path / "nan.exr", {f"lightgroup:Key.{name}": broken for name in "RGB"})
    for name, problem in [("none", "it has no light groups"), ("nan", "'Key' has 3 values that are not finite, the first in column 2 and row 1")]:
        done = run("share", tmp_path / f"{name}.exr", "-o", tmp_path / "page.html")
        assert done.returncode == 1 and problem in done.stderr, done.stderr
