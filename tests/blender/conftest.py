"""Tests inside Blender, with each `bpy` that is at hand.

A test marked `@pytest.mark.blender` runs in a child process, in the factory's file, with the extension loaded anew (see `child.py`). It may ask
for `tmp_path` and for parameters that JSON can carry; it imports `bpy` and the extension (`extension()`) in its body. Starting Blender takes
longer than most tests, so the tests of a file share a process for as long as they pass. `GONIO_BPY` names the Pythons that have `bpy`,
separated by colons; without it the environments `.venv-bpy*` of the repository are taken.
"""

import contextlib
import json
import os
import select
import subprocess
import tempfile
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CHILD = Path(__file__).with_name("child.py")
SECONDS = 240


def pythons() -> list[Path]:
    """Pythons with a `bpy` package."""
    named = os.environ.get("GONIO_BPY")
    return [Path(each) for each in named.split(":")] if named else sorted(ROOT.glob(".venv-bpy*/bin/python"))


def pytest_configure(config):
    config.addinivalue_line("markers", "blender(seconds): runs inside Blender with the extension registered")


def pytest_generate_tests(metafunc):
    if metafunc.definition.get_closest_marker("blender"):
        metafunc.fixturenames.append("blender_python")
    if "blender_python" in metafunc.fixturenames:
        missing = pytest.param(None, marks=pytest.mark.skip("no Python with bpy: pip install bpy in .venv-bpy50, or set GONIO_BPY"))
        metafunc.parametrize("blender_python", pythons() or [missing], ids=lambda path: path.parts[-3].lstrip(".") if path else "none")


@pytest.hookimpl(tryfirst=True)
def pytest_pyfunc_call(pyfuncitem):
    marker = pyfuncitem.get_closest_marker("blender")
    if marker is None:
        return None
    values = {name: pyfuncitem.funcargs[name] for name in pyfuncitem._fixtureinfo.argnames}
    python, running = pyfuncitem.callspec.params["blender_python"], pyfuncitem.funcargs["blenders"]
    blender = running.pop(python, None) or Blender(python)
    skipped = blender.run(pyfuncitem.path, pyfuncitem.originalname, values, seconds=marker.kwargs.get("seconds", SECONDS))
    # It is back among the running ones only if nothing failed.
    running[python] = blender
    if skipped:
        pytest.skip(skipped)
    return True


@pytest.fixture(scope="module", autouse=True)
def blenders():
    """The Blenders of a file's tests, by their Pythons."""
    running: dict[Path, Blender] = {}
    yield running
    for blender in running.values():
        blender.close()


class Blender:
    """A process with `bpy` that runs functions, one after the other (see `child.py`)."""

    def __init__(self, python: Path):
        self._output, self._read = tempfile.TemporaryFile(), 0
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": self._output}
        self._process = subprocess.Popen([str(python), str(CHILD)], text=True, cwd=ROOT, **pipes)

    def run(self, file: Path, function: str, arguments: dict, *, seconds: float) -> str:
        """Runs a function, prints what it said and gives why it was skipped; where it fails, the process ends too."""
        ended = "failed"
        try:
            ended, why = self._answer(json.dumps([str(file), function, arguments], default=str), seconds)
        finally:
            print(self._said(), end="")
            if ended == "failed":
                self._process.kill()
                self._end()
        if ended == "failed":
            pytest.fail(why, pytrace=False)
        return why

    def close(self) -> None:
        """Ends the process; fails where Blender crashes at its end."""
        status, said = self._end()
        if status != 0:
            pytest.fail(f"Blender ended with {status}\n{said}", pytrace=False)

    def _answer(self, request: str, seconds: float) -> tuple[str, str]:
        """How a function ended, and why."""
        with contextlib.suppress(BrokenPipeError):
            print(request, file=self._process.stdin, flush=True)
        if not select.select([self._process.stdout], [], [], seconds)[0]:
            return "failed", f"Blender took more than {seconds} s"
        answer = self._process.stdout.readline()
        return json.loads(answer) if answer else ("failed", f"Blender ended with {self._process.wait()}")

    def _said(self) -> str:
        """What was said since it was asked last. The child writes where the file's offset is, so reading must not move that."""
        text = os.pread(self._output.fileno(), os.fstat(self._output.fileno()).st_size - self._read, self._read)
        self._read += len(text)
        return text.decode(errors="replace")

    def _end(self) -> tuple[int, str]:
        """The exit status, and what was said at the end."""
        self._process.communicate(timeout=SECONDS)
        said = self._said()
        self._output.close()
        return self._process.returncode, said


def run_alone(python: Path, file: Path, function: str, arguments: dict, *, seconds: float) -> None:
    """Runs a function in a Blender of its own; fails or skips as it does."""
    blender = Blender(python)
    skipped = blender.run(file, function, arguments, seconds=seconds)
    blender.close()
    if skipped:
        pytest.skip(skipped)


@pytest.fixture(scope="session")
def extension_zip() -> Path:
    """The packed extension: `GONIO_EXTENSION`, or the newest of `dist`."""
    named = os.environ.get("GONIO_EXTENSION")
    found = [Path(named)] if named else sorted(ROOT.glob("dist/gonio-*-linux-x64.zip"), key=lambda path: path.stat().st_mtime)
    if not found or not found[-1].is_file():
        pytest.skip("no packed extension: make extension")
    return found[-1]
