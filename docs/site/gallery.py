"""Pictures of the gallery, each made by a file of `examples`: `python docs/site/gallery.py` renders into out/gallery what is not there yet.

Runs in the Python that has gonio. A picture is made anew when its command, its file or the engine has changed.
"""

from __future__ import annotations

import hashlib
import importlib.util
import shlex
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "out" / "gallery"


@dataclass(frozen=True)
class Picture:
    """A picture, what it shows, the file that made it, and the commands, run from the repository's root."""

    name: str
    title: str
    words: str
    source: str
    commands: tuple[str, ...]

    def place(self) -> Path:
        return OUT / self.name


OFFICE = "examples/usd/office.usda"
LARGE = "--res 960 540 --spp 48 --denoise"


def script(name: str, title: str, words: str, *files: str) -> Picture:
    """A picture by a script of `examples/python`, which also writes other files."""
    source = f"examples/python/{name}.py"
    named = " ".join(f"out/gallery/{file}" for file in (f"{name}.png", *files))
    return Picture(f"{name}.png", title, words, source, (f"python {source} {named}",))


PICTURES = (
    Picture(
        "office.png",
        "An office",
        "Four ceiling panels, a task lamp of 300 lm, daylight in the window.",
        OFFICE,
        (f"gonio render {OFFICE} -o out/gallery/office.exr -o out/gallery/office.png {LARGE} --exposure 0.7",),
    ),
    Picture(
        "office_luminance.png",
        "Luminances in the office",
        "The first picture in steps of cd/m² over three decades, of its colour after the noise was taken out.",
        OFFICE,
        ("gonio falsecolor out/gallery/office.exr -o out/gallery/office_luminance.png --quantity luminance --log 3 --steps 9 --max 5000",),
    ),
    Picture(
        "office_plane.png",
        "Lux on the work plane",
        "A calculation grid 0.75 m above the floor, with isolines and values.",
        OFFICE,
        (
            f"gonio measure {OFFICE} --grid /Office/Room/Walls/Planks --height 0.75 --margin 0.5 --spacing 0.4 --max 1000"
            " --spp 1024 -o out/gallery/office_plane.png",
        ),
    ),
    Picture(
        "office_map.png",
        "Lux on all surfaces",
        "An illumination map, seen from the stage's camera.",
        OFFICE,
        (f"gonio map {OFFICE} --view /Office/Camera --image-width 960 --paths 16000000 --max 1000 -o out/gallery/office_map.png",),
    ),
    script("night_street", "A street after rain", "A street lamp's light distribution, wet asphalt, and what people left on."),
    script("relief_wall", "A relief in grazing light", "Displacement, cut to a pixel, and four wall washers."),
    script(
        "cad_to_room",
        "From a luminaire's parts to a room",
        "A downlight's geometry goes through the virtual goniophotometer; its EULUMDAT file lights the gallery.",
        "downlight.ldt",
    ),
    script("caustics", "Caustics", "Two glasses and a brass ring beside one small lamp: light paths bring the bright lines."),
    script("prism", "A prism", "Light with wavelengths: a slit of sunlight, and glass that parts its colours."),
    script("daylight_room", "Sun through a window", "September in Vienna. The script prints the room's daylight factors as well."),
    script("depth_of_field", "Depth of field", "Candles of 12 lm, glass, and a fast lens."),
    script(
        "beams_in_haze",
        "Beams in haze",
        "Five spots, and air that scatters: contrast falls to 5 % within thirty metres. The script also draws a plan of lux.",
        "beams_in_haze_plan.png",
    ),
    script("cloud", "A cloud", "An array of densities in the morning sun; light is scattered up to 64 times."),
    script("metals", "Metals by name", "Silver, aluminium, chromium, iron, titanium, brass, copper and gold, by measured indices."),
    script("colour_ring", "Colours under five lamps", "D65, LED-B3, LED-RGB1, FL11 and HP1: rendered once by wavelength, relit; above without, below with adaptation."),
    script("glasses", "Glasses by name", "Stones of water, N-BK7, sapphire, N-SF66, diamond and moissanite before a small lamp, by their index at each wavelength."),
    script("car_paint", "Car paints", "Tables of measurements under a clear coat."),
    script("hair", "Hair", "A braid of twenty-seven thousand hairs between two rim lights."),
    script("pinwheels", "Motion blur", "Pinwheels that turn while the shutter is open."),
    Picture(
        "office_sun.png",
        "The office in the sun",
        "The same stage in Vienna, on a late afternoon in March.",
        OFFICE,
        (f"gonio render {OFFICE} -o out/gallery/office_sun.png {LARGE} --exposure 0.5 --sun 48.21,16.37,2025-03-21T16:30+01:00",),
    ),
    script("cornell_box", "The Cornell box", "Built from numpy arrays."),
    script("lux_on_a_desk", "Lux on a desk", "From above, in steps of lux. The script prints the desk's mean, lowest and highest illuminance."),
    Picture(
        "sundial.png",
        "A sundial",
        "Sun and sky from attributes of the stage; 15:00 on the clock.",
        "examples/usd/sundial.usda",
        ("gonio render examples/usd/sundial.usda -o out/gallery/sundial.png --tonemap none --frames 9 --res 960 640 --spp 64 --denoise",),
    ),
    Picture(
        "downlight.svg",
        "A downlight, measured",
        "The virtual goniophotometer's polar diagram of an LED in a reflector.",
        "examples/usd/downlight.usda",
        (
            "gonio goniometer examples/usd/downlight.usda --luminaire /World/Downlight --g-step 2.5 --error 1% -o out/gallery/measured_downlight.ldt"
            " --polar out/gallery/downlight.svg",
        ),
    ),
    script("measured_lobes", "Lobes of a measured metal", "In columns light from 0°, 40° and 70°; in rows the metal, its copy in a file, and how densely samples fall.", "brushed.gbsdf"),
)


def stamp(picture: Picture) -> str:
    """Changes when the picture may: with its commands, its file, and the engine."""
    engine = Path(importlib.util.find_spec("gonio._gonio").origin).stat()
    seen = hashlib.sha256(f"{picture.commands} {engine.st_size} {engine.st_mtime_ns}".encode())
    for path in (picture.source, "examples/python/shapes.py"):
        seen.update((ROOT / path).read_bytes())
    return seen.hexdigest()


def run(command: str) -> None:
    """Runs `gonio` or `python` of this Python, from the repository's root."""
    program, *arguments = shlex.split(command)
    line = [sys.executable, *(["-m", "gonio.cli"] if program == "gonio" else []), *arguments]
    done = subprocess.run(line, cwd=ROOT, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{command}\n{done.stdout}{done.stderr}")


def make(picture: Picture) -> None:
    """Makes a picture that is not there as it would be now."""
    mark, now = OUT / f"{picture.name}.stamp", stamp(picture)
    if picture.place().exists() and mark.exists() and mark.read_text() == now:
        return
    started = time.monotonic()
    for command in picture.commands:
        run(command)
    mark.write_text(now)
    print(f"{picture.name}: {time.monotonic() - started:.1f} s", flush=True)


def page() -> str:
    """The gallery as Markdown, with links from the repository's root."""
    lines = [
        "# Gallery",
        "",
        "Each picture with the file that made it. `make docs` renders them in about twenty minutes on two cores; what is there already stays.",
        "",
    ]
    lines += ["More about each stands in the [README of the examples](examples/README.md).", "", '<div class="gallery" markdown>', ""]
    for picture in PICTURES:
        lines += figure(picture)
    return "\n".join([*lines, "</div>", ""])


def figure(picture: Picture) -> list[str]:
    path = picture.place()
    shown = f"![{picture.title}]({path.relative_to(ROOT)})" if path.exists() else "*Not rendered: `make docs` does that.*"
    words = [f"**{picture.title}.** {picture.words} From [{Path(picture.source).name}]({picture.source}).", ""]
    return ["<div markdown>", "", shown, "", *words, "```", *picture.commands, "```", "", "</div>", ""]


if __name__ == "__main__":
    OUT.mkdir(parents=True, exist_ok=True)
    for each in PICTURES:
        make(each)
