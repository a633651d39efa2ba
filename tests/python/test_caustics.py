"""Caustics: where light paths run by themselves."""

import dataclasses
import sys
from pathlib import Path

import numpy as np
import pytest

PEERS = Path(__file__).resolve().parents[1] / "peers"
sys.path[:0] = [str(PEERS / "caustics"), str(PEERS / "render"), str(PEERS.parent / "validate")]

from description import described  # noqa: E402
from engine_gonio import Engine  # noqa: E402

PAY = ("lens", "lantern", "glass_ball", "pool", "louvres")
DO_NOT = ("glass", "car", "nine_lights", "door_ajar")


def small(name, caustics):
    """A picture of one sample a pixel of a scene of tests/peers, 48 pixels wide, and what is told of its lamps."""
    scene = described(name)
    engine = Engine(dataclasses.replace(scene, width=48, height=36), 2, f"caustics={caustics}")
    return engine.render(1, 1)[0], [line for line in engine._previous.diagnostics if line[1].endswith("(caustics)")]


@pytest.mark.parametrize("name", PAY + DO_NOT)
def test_light_paths_run_by_themselves_where_they_pay(name):
    (auto, told), (on, _), (off, nothing) = (small(name, caustics) for caustics in ("auto", "on", "off"))
    assert np.array_equal(auto, on if name in PAY else off)
    assert bool(told) == (name in PAY) and not nothing
    if name != "door_ajar":
        assert not np.array_equal(on, off)
