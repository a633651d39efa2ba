"""Mitsuba at work on one room, in a process of its own."""

import json
import os
import subprocess
import tempfile
from pathlib import Path
from typing import Any

import environments
import in_gonio
import numpy
from coloured_rooms import ROOMS

CHILD = Path(__file__).resolve().parent / "in_mitsuba.py"
THREADS = 2


class Mitsuba:
    """The process; use it in a `with` block. `GONIO_PEER_MITSUBA` names a Python that has mitsuba; without it one is made."""

    def __init__(self, name: str, variant: str = "scalar_spectral") -> None:
        """Starts laying out a room; raises `environments.Unavailable` where Mitsuba cannot be had, `RuntimeError` where it breaks."""
        python = Path(os.environ.get("GONIO_PEER_MITSUBA") or environments.python_of("mitsuba"))
        if not python.exists():
            raise environments.Unavailable(f"{python} is not there")
        self._folder = tempfile.TemporaryDirectory()
        spectra = Path(self._folder.name) / "spectra.json"
        spectra.write_text(json.dumps(in_gonio.spectra(ROOMS[name]())))
        self._errors = (Path(self._folder.name) / "errors.txt").open("w+b")
        command = [str(python), str(CHILD), variant, name, str(spectra), str(THREADS)]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self._errors, text=True)
        said = self._answer()
        self.version: str = said["version"]
        # The lamp by Mitsuba's own table of the observer.
        self.lamp_xyz = numpy.array(said["lamp_xyz"])

    def __enter__(self) -> "Mitsuba":
        return self

    def __exit__(self, *_: object) -> None:
        self._process.communicate()
        self._errors.close()
        self._folder.cleanup()

    def render(self, samples: int, seed: int) -> tuple[numpy.ndarray, float]:
        """XYZ (height, width, 3), and the processor's seconds; `samples` is a square, as the sampler wants it."""
        assert self._process.stdin is not None
        file = Path(self._folder.name) / "picture.npy"
        self._process.stdin.write(json.dumps({"samples": samples, "seed": seed, "file": str(file)}) + "\n")
        self._process.stdin.flush()
        used: float = self._answer()["processor"]
        return numpy.load(file), used

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
        last = text.splitlines()[-1] if text else "Mitsuba ended without a word"
        raise environments.Unavailable(last) if "No module named" in last else RuntimeError(last)
