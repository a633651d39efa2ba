"""Illuminances by gonio and by Radiance, each in a process of its own, and the processor time that it took."""

import csv
import os
import resource
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy
import two_rooms

# Lumens a watt in Radiance.
EFFICACY = 179.0


class Unavailable(Exception):
    """The engine cannot be had or did not run; the message says why."""


@dataclass(frozen=True)
class Measured:
    """Lux of all points, and seconds of the processor (user and system, all of the process, its start included)."""

    lux: numpy.ndarray
    seconds: float


def run(command: Sequence[str | Path], folder: Path, environment: dict[str, str] | None = None, given: str = "") -> tuple[bytes, float]:
    """What a command prints, and its processor seconds; raises `Unavailable` where it fails."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        words = [str(word) for word in command]
        done = subprocess.run(words, cwd=folder, env=environment, input=given.encode(), capture_output=True, check=False)
    except OSError as error:
        raise Unavailable(str(error)) from error
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode:
        last = (done.stderr.decode(errors="replace").strip().splitlines() or [f"it ended with {done.returncode}"])[-1]
        raise Unavailable(f"{Path(command[0]).name}: {last}")
    return done.stdout, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def by_gonio(stage: Path, samples: int, seed: int) -> Measured:
    """`gonio measure` on one thread."""
    table = stage.with_suffix(".csv")
    command: list[str | Path] = [gonio(), "measure", stage, "--spp", str(samples), "--seed", str(seed), "-j", "1", "-q", "--csv", table]
    _, seconds = run(command, stage.parent)
    with table.open(newline="") as file:
        rows = list(csv.DictReader(file))
    places = numpy.array([[float(row[axis]) for axis in ("x_m", "y_m", "z_m")] for row in rows])
    assert numpy.allclose(places, two_rooms.points(), atol=1e-5), "gonio measures other points"
    return Measured(numpy.array([float(row["value"]) for row in rows]), seconds)


def gonio() -> Path:
    """The command of the Python that runs this."""
    return Path(sys.executable).with_name("gonio")


@dataclass(frozen=True)
class Radiance:
    """Its programs and what they need to find their files, and the scene's octree."""

    programs: Path
    environment: dict[str, str]
    octree: Path
    version: str
    # Processor seconds of `ies2rad` and `oconv`.
    preparation: float

    def measure(self, options: Sequence[str]) -> Measured:
        """`rtrace -I` with these options, one process."""
        given = "".join("{:.9g} {:.9g} {:.9g} 0 0 1\n".format(*place) for place in two_rooms.points())
        command: list[str | Path] = [self.programs / "rtrace", "-h", "-I", *options, self.octree]
        said, seconds = run(command, self.octree.parent, self.environment, given)
        rgb = numpy.array([[float(word) for word in line.split()] for line in said.decode().splitlines() if line.strip()])
        # All surfaces are grey, so any channel is the luminance.
        return Measured(EFFICACY * rgb[:, 1], seconds)


def packaged(python: Path) -> Path:
    """The folder of pyradiance in the environment of a Python."""
    said, _ = run([python, "-c", "import importlib.util; print(importlib.util.find_spec('pyradiance').origin)"], python.parent)
    return Path(said.decode().strip()).parent


def environment(package: Path) -> dict[str, str]:
    """In which Radiance's programs of a package find one another and their files."""
    path = f"{package / 'bin'}{os.pathsep}{os.environ['PATH']}"
    return {**os.environ, "PATH": path, "RAYPATH": f".{os.pathsep}{package / 'lib'}"}


def radiance(python: Path, folder: Path) -> Radiance:
    """Lays out the rooms for Radiance in a folder: LDT to IES by gonio, `ies2rad`, `oconv`."""
    package = packaged(python)
    programs = package / "bin"
    found = environment(package)
    run([gonio(), "photometry", two_rooms.LUMINAIRE, "--convert", folder / "luminaire.ies"], folder)
    _, luminaire = run([programs / "ies2rad", "-dm", "-t", "default", "luminaire.ies"], folder, found)
    (folder / "two_rooms.rad").write_text(description())
    octree = folder / "two_rooms.oct"
    laid_out, rooms = run([programs / "oconv", "two_rooms.rad"], folder, found)
    octree.write_bytes(laid_out)
    version, _ = run([programs / "rtrace", "-version"], folder, found)
    return Radiance(programs, found, octree, version.decode().strip(), luminaire + rooms)


def description() -> str:
    """The rooms in Radiance's words."""
    parts = [f"void plastic {name}\n0\n0\n5 {rho} {rho} {rho} 0 0\n" for name, rho in two_rooms.REFLECTANCE.items()]
    for number, rectangle in enumerate(two_rooms.rectangles()):
        corners = " ".join("{:.9g} {:.9g} {:.9g}".format(*corner) for corner in rectangle.corners())
        parts.append(f"{rectangle.material} polygon rectangle{number}\n0\n0\n12 {corners}\n")
    for number, place in enumerate(two_rooms.LUMINAIRES):
        parts.append("!xform -n luminaire{} -t {} {} {} luminaire.rad\n".format(number, *place))
    return "\n".join(parts)
