"""What the tests of the USD front end share."""

import pytest

pytest.importorskip("gonio")
pytest.importorskip("pxr")

import pictures  # noqa: E402


@pytest.fixture(scope="session")
def room(tmp_path_factory):
    """The stage of `pictures.ROOM`."""
    return pictures.room(tmp_path_factory.mktemp("room") / "room.usda")


@pytest.fixture
def picture(run, tmp_path):
    """Renders to an EXR file and reads it."""

    def render(stage, *options, name="out.exr", size=32, spp=2):
        sizes = [] if any(str(option) in ("--res", "-w", "--image-width", "--imageWidth") for option in options) else ["--res", size, size]
        done = run("render", stage, "-o", tmp_path / name, "--spp", spp, *sizes, *options)
        assert done.returncode == 0, done.stderr
        return pictures.read(tmp_path / name)

    return render
