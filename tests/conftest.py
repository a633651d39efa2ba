"""Marks and tools that all Python tests share."""

import os
import pathlib
import subprocess
import sys

import pytest

REPOSITORY = pathlib.Path(__file__).resolve().parents[1]


def pytest_configure(config):
    config.addinivalue_line("markers", "validate: slow; run by `pytest -m validate`, left out without -m")


def pytest_collection_modifyitems(config, items):
    if config.getoption("-m"):
        return
    slow = [item for item in items if item.get_closest_marker("validate")]
    if slow:
        config.hook.pytest_deselected(items=slow)
        items[:] = [item for item in items if not item.get_closest_marker("validate")]


def gonio_command():
    """The console script of the Python that runs the tests."""
    script = pathlib.Path(sys.executable).with_name("gonio")
    return [str(script)] if script.exists() else [sys.executable, "-m", "gonio.cli"]


@pytest.fixture(scope="session")
def command():
    """What starts gonio, for tests that handle the process themselves."""
    return gonio_command()


@pytest.fixture(scope="session")
def run():
    """Runs gonio with the arguments; gives the finished process with its text."""

    def call(*arguments, timeout=60, **options):
        line = gonio_command() + [str(argument) for argument in arguments]
        return subprocess.run(line, capture_output=True, text=True, errors="replace", timeout=timeout, **options)

    return call


@pytest.fixture(scope="session")
def shared():
    """Finds shared test data; skips the test where it is absent."""

    def find(*parts):
        root = pathlib.Path(os.environ.get("GONIO_SHARED", REPOSITORY.parent / "shared"))
        path = root.joinpath("data", *parts)
        if not path.exists():
            pytest.skip(f"{path} is not there")
        return path

    return find


@pytest.fixture(scope="session")
def room(tmp_path_factory):
    """The stage of `pictures.ROOM`."""
    import pictures

    return pictures.room(tmp_path_factory.mktemp("room") / "room.usda")


@pytest.fixture
def picture(run, tmp_path):
    """Renders to an EXR file and reads it."""
    import pictures

    def render(stage, *options, name="out.exr", size=32, spp=2):
        sizes = [] if any(str(option) in ("--res", "-w", "--image-width", "--imageWidth") for option in options) else ["--res", size, size]
        done = run("render", stage, "-o", tmp_path / name, "--spp", spp, *sizes, *options)
        assert done.returncode == 0, done.stderr
        return pictures.read(tmp_path / name)

    return render
