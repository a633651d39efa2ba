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
    """A picture, what it shows, the file that made it, and the commands, run from the repository's root; `kept` stands beside its file."""

    name: str
    title: str
    words: str
    source: str
    commands: tuple[str, ...] = ()
    kept: str = ""

    def place(self) -> Path:
        return ROOT / self.kept if self.kept else OUT / self.name


OFFICE = "examples/usd/office.usda"
SMALL = "--res 480 320 --spp 16 --denoise"
PICTURES = (
    Picture(
        "office.png",
        "An office",
        "Four ceiling panels, a task lamp of 300 lm, daylight in the window.",
        OFFICE,
        (f"gonio render {OFFICE} -o out/gallery/office.exr -o out/gallery/office.png {SMALL} --exposure 0.7 --aov color,luminance",),
    ),
    Picture(
        "office_sun.png",
        "The office in the sun",
        "The same stage in Vienna, on a late afternoon in March.",
        OFFICE,
        (f"gonio render {OFFICE} -o out/gallery/office_sun.png {SMALL} --sun 48.21,16.37,2025-03-21T16:30+01:00",),
    ),
    Picture(
        "office_luminance.png",
        "Luminances in the office",
        "The first picture in false colour: cd/m² over three decades.",
        OFFICE,
        ("gonio falsecolor out/gallery/office.exr -o out/gallery/office_luminance.png --quantity luminance --log 3",),
    ),
    Picture(
        "office_plane.png",
        "Lux on the work plane",
        "A calculation grid 0.75 m above the floor, with isolines and values.",
        OFFICE,
        (
            f"gonio measure {OFFICE} --grid /Office/Room/Walls/Planks --height 0.75 --margin 0.5 --spacing 0.4 --max 1000"
            " --spp 256 -o out/gallery/office_plane.png",
        ),
    ),
    Picture(
        "office_map.png",
        "Lux on all surfaces",
        "An illumination map, seen from the stage's camera.",
        OFFICE,
        (f"gonio map {OFFICE} --view /Office/Camera --image-width 480 --paths 2000000 --max 1000 -o out/gallery/office_map.png",),
    ),
    Picture(
        "sundial.png",
        "A sundial",
        "Sun and sky from attributes of the stage; 15:00 on the clock.",
        "examples/usd/sundial.usda",
        ("gonio render examples/usd/sundial.usda -o out/gallery/sundial.png --tonemap none --frames 9 --res 480 320 --spp 16",),
    ),
    Picture(
        "cornell_box.png",
        "The Cornell box",
        "Built from numpy arrays.",
        "examples/python/cornell_box.py",
        ("python examples/python/cornell_box.py out/gallery/cornell_box.png",),
    ),
    Picture(
        "lux_on_a_desk.png",
        "A desk from above",
        "The script prints the desk's mean, lowest and highest illuminance.",
        "examples/python/lux_on_a_desk.py",
        ("python examples/python/lux_on_a_desk.py out/gallery/lux_on_a_desk.png",),
    ),
    Picture(
        "daylight_room.png",
        "Sun through a window",
        "The script prints the room's daylight factors.",
        "examples/python/daylight_room.py",
        ("python examples/python/daylight_room.py out/gallery/daylight_room.png",),
    ),
    Picture(
        "measured_lobes.png",
        "Lobes of a measured metal",
        "The metal, its copy in a file, and where samples fall.",
        "examples/python/measured_lobes.py",
        ("python examples/python/measured_lobes.py out/gallery/measured_lobes.png out/gallery/brushed.gbsdf",),
    ),
    Picture(
        "measured.png",
        "Measured materials",
        "A brushed metal, a car paint and a woven shade, each from a file of its own format.",
        "examples/usd/make_measured_stage.py",
        (
            "python examples/usd/make_measured_stage.py out/gallery/brushed.gbsdf out/gallery/measured",
            f"gonio render out/gallery/measured/measured.usda -o out/gallery/measured.png {SMALL}",
        ),
    ),
    Picture(
        "downlight.svg",
        "A downlight, measured",
        "The virtual goniophotometer's polar diagram of an LED in a reflector.",
        "examples/usd/downlight.usda",
        (
            "gonio goniometer examples/usd/downlight.usda --luminaire /World/Downlight --error 1% -o out/gallery/downlight.ldt"
            " --polar out/gallery/downlight.svg",
        ),
    ),
    Picture(
        "room.png",
        "A room in Blender",
        "Made and rendered without a window.",
        "examples/blender/make_room.py",
        kept="examples/blender/room.png",
    ),
    Picture(
        "measured_ball.png",
        "A measured ball in Blender",
        "Brushed metal through the node *Measured BSDF*.",
        "examples/blender/make_measured_ball.py",
        kept="examples/blender/measured_ball.png",
    ),
)


def stamp(picture: Picture) -> str:
    """Changes when the picture may: with its commands, its file, and the engine."""
    engine = Path(importlib.util.find_spec("gonio._gonio").origin).stat()
    seen = hashlib.sha256(f"{picture.commands} {engine.st_size} {engine.st_mtime_ns}".encode())
    seen.update((ROOT / picture.source).read_bytes())
    return seen.hexdigest()


def run(command: str) -> None:
    """Runs `gonio` or `python` of this Python, from the repository's root."""
    program, *arguments = shlex.split(command)
    line = [sys.executable, *(["-m", "gonio.cli"] if program == "gonio" else []), *arguments]
    done = subprocess.run(line, cwd=ROOT, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{command}\n{done.stdout}{done.stderr}")


def make(picture: Picture) -> None:
    """Makes a picture that is not kept and not there as it would be now."""
    mark, now = OUT / f"{picture.name}.stamp", "" if picture.kept else stamp(picture)
    if picture.kept or (picture.place().exists() and mark.exists() and mark.read_text() == now):
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
        "Each picture with the file that made it. They are small, and have few samples: `make docs` renders them.",
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
    commands = ["```", *picture.commands, "```", ""] if picture.commands else []
    return ["<div markdown>", "", shown, "", *words, *commands, "</div>", ""]


if __name__ == "__main__":
    OUT.mkdir(parents=True, exist_ok=True)
    for each in PICTURES:
        make(each)
