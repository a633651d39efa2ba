"""An engine at work on one scene, in a process of its own."""

import json
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[2]
CHILD = HERE / "child.py"
# The share of the wanted seconds that a first, rough measurement takes at least.
ENOUGH = 0.25


class Unavailable(Exception):
    """The engine cannot be had here; the message says why."""


@dataclass(frozen=True)
class Entrant:
    """An engine with its variant (`gonio`, `cycles:guided`, `mitsuba:llvm_ad_rgb`, `luxcore:BIDIRCPU`) on a scene."""

    engine: str
    scene: str


@dataclass(frozen=True)
class Picture:
    """Radiance in cd/m² (height, width, 3), and what its samples cost: seconds of the clock, and of the processor."""

    values: numpy.ndarray
    seconds: float
    processor: float
    samples: int


def python_of(engine: str) -> Path:
    """The Python that has an engine: `GONIO_PEER_<ENGINE>`, or an environment of the repository."""
    kind = engine.partition(":")[0]
    folder = {"gonio": ".venv", "cycles": ".venv-bpy50", "mitsuba": ".venv-mitsuba", "luxcore": ".venv-luxcore"}[kind]
    python = Path(os.environ.get(f"GONIO_PEER_{kind.upper()}", ROOT / folder / "bin" / "python"))
    if not python.exists():
        raise Unavailable(f"{python} is not there")
    return python


class Peer:
    """The process; use it in a `with` block."""

    def __init__(self, entrant: Entrant, *, scale: float = 1.0, threads: int = 2) -> None:
        """Starts laying out the scene, its sides multiplied by `scale`; raises `Unavailable` if the engine cannot be had."""
        python = python_of(entrant.engine)
        self.entrant = entrant
        self.samples = 1
        # Processor seconds of a render that are not its samples'.
        self._beside = 0.0
        self._folder = tempfile.TemporaryDirectory()
        self._errors = (Path(self._folder.name) / "errors.txt").open("w+b")
        command = [str(python), str(CHILD), entrant.engine, entrant.scene, str(scale), str(threads)]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors, text=True)
        said = self._answer()
        self.version: str = said["version"]
        self.preparation: float = said["preparation"] - said["jit"]
        self.jit: float = said["jit"]
        # Whether samples are milliseconds.
        self.is_timed: bool = said["is_timed"]

    def __enter__(self) -> "Peer":
        return self

    def __exit__(self, *_: object) -> None:
        self._process.communicate()
        self._errors.close()
        self._folder.cleanup()

    def render(self, seed: int) -> Picture:
        """A picture of `samples` a pixel; the engine may round them."""
        assert self._process.stdin is not None
        file = Path(self._folder.name) / "picture.npy"
        self._process.stdin.write(json.dumps({"samples": self.samples, "seed": seed, "file": str(file)}) + "\n")
        self._process.stdin.flush()
        said = self._answer()
        self.jit = said["jit"]
        return Picture(numpy.load(file), said["seconds"], said["processor"] - self._beside, said["samples"])

    def calibrate(self, seconds: float) -> None:
        """Chooses the samples that take so many seconds."""
        if self.is_timed:
            self.samples = round(1000.0 * seconds)
            return
        self._beside = self.render(0).processor
        enough = ENOUGH * seconds
        self.samples = 4
        while (first := self.render(0)).seconds < enough:
            self.samples = round(first.samples * max(2.0, min(16.0, 1.5 * enough / max(first.seconds, 1e-3))))
        self.samples = max(1, round(first.samples * seconds / first.seconds))

    def _answer(self) -> dict[str, Any]:
        assert self._process.stdout is not None
        line = self._process.stdout.readline()
        if line:
            said: dict[str, Any] = json.loads(line)
            return said
        self._process.wait()
        self._errors.seek(0)
        text = self._errors.read().decode(errors="replace").strip()
        self.__exit__()
        sys.stderr.write(text + "\n")
        raise Unavailable(f"{self.entrant.engine} ended on {self.entrant.scene}: {text.splitlines()[-1] if text else 'without a word'}")
