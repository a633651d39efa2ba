"""Tests inside Blender: each in a process of its own, with each `bpy` that is at hand.

A test marked `@pytest.mark.blender` runs in a child process that has registered the extension (see `child.py`). It may ask for `tmp_path` and for
parameters that JSON can carry; it imports `bpy` and the extension (`extension()`) in its body. `GONIO_BPY` names the Pythons that have
`bpy`, separated by colons; without it the environments `.venv-bpy*` of the repository are taken.
"""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
CHILD = Path(__file__).with_name("child.py")
SKIPPED = 77
SECONDS = 240


def pythons() -> list[Path]:
    """Pythons with a `bpy` package."""
    named = os.environ.get("GONIO_BPY")
    return [Path(each) for each in named.split(":")] if named else sorted(ROOT.glob(".venv-bpy*/bin/python"))


def pytest_configure(config):
    config.addinivalue_line("markers", "blender(seconds): runs in a process of its own with the extension registered")


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
    arguments = {name: str(value) if isinstance(value, Path) else value for name, value in values.items()}
    said = run_child(
        pyfuncitem.callspec.params["blender_python"],
        [str(CHILD), str(pyfuncitem.path), pyfuncitem.originalname, json.dumps(arguments)],
        seconds=marker.kwargs.get("seconds", SECONDS),
    )
    print(said, end="")
    return True


def run_child(python: Path, arguments: list[str], *, seconds: float = SECONDS, environment: dict[str, str] | None = None) -> str:
    """Runs a Python with bpy; fails or skips as the child says, returns what it printed."""
    ended = subprocess.run(
        [str(python), *arguments], capture_output=True, text=True, timeout=seconds, cwd=ROOT, env={**os.environ, **(environment or {})}
    )
    if ended.returncode == SKIPPED:
        pytest.skip(ended.stderr.strip().splitlines()[-1])
    if ended.returncode != 0:
        pytest.fail(f"the child ended with {ended.returncode}\n{ended.stdout[-4000:]}\n{ended.stderr[-8000:]}", pytrace=False)
    return ended.stdout


@pytest.fixture(scope="session")
def extension_zip() -> Path:
    """The packed extension: `GONIO_EXTENSION`, or the newest of `dist`."""
    named = os.environ.get("GONIO_EXTENSION")
    found = [Path(named)] if named else sorted(ROOT.glob("dist/gonio-*-linux-x64.zip"), key=lambda path: path.stat().st_mtime)
    if not found or not found[-1].is_file():
        pytest.skip("no packed extension: make extension")
    return found[-1]
