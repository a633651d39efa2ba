"""The peers of the hard scenes agree where they should: on direct light, and the maps of references with path tracing."""

import json
import subprocess
import sys
from pathlib import Path

import pytest

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "render")]

from direct import MOST, engines, held_against  # noqa: E402
from errors import error  # noqa: E402
from lineup import SCENES  # noqa: E402
from peer import Entrant, Peer, Unavailable, python_of  # noqa: E402

pytestmark = [pytest.mark.validate, pytest.mark.timeout(900)]


@pytest.mark.parametrize("scene", SCENES)
def test_lamps_are_equally_strong(scene: str) -> None:
    pictures = {}
    for engine in engines(scene):
        try:
            with Peer(Entrant(engine, f"{scene}.bare")) as peer:
                peer.calibrate(8.0)
                pictures[engine] = peer.render(1).values
        except Unavailable as reason:
            if engine == "gonio":
                pytest.skip(str(reason))
    for engine, picture in pictures.items():
        ratio, blocks = held_against(picture, pictures["gonio"])
        # Of single blocks some engines keep noise.
        assert abs(ratio - 1.0) < MOST and blocks < 2.0 * MOST, (engine, ratio, blocks)


def test_maps_show_what_path_tracing_shows() -> None:
    try:
        python = python_of("mitsuba")
    except Unavailable as reason:
        pytest.skip(str(reason))
    done = subprocess.run([str(python), str(HERE / "proof.py")], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout.splitlines()[-1])
    assert found["median"] < 0.005 and found["mean"] < 0.002, found


def test_a_black_picture_has_error_one() -> None:
    numpy = pytest.importorskip("numpy")
    lit = numpy.ones((32, 32, 3))
    of = error(0.0 * lit, lit)
    assert abs(of.coarse - 1.0 / 1.02**2) < 1e-9 and of.black == 1.0
    assert error(lit, lit).whole == 0.0
