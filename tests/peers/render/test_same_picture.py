"""The scenes of the comparison look the same in gonio and in Cycles: block by block, at a low resolution and a fixed number of samples."""

import compare
import pytest
from contest import CONTESTS, MOST_MEDIAN
from peer import Entrant, Peer, Unavailable

SCALE = 0.5
# Enough for the noise of the median block to stay below half of what is allowed.
SAMPLES = {"nine_lights": 256}
USUAL_SAMPLES = 96

pytestmark = [pytest.mark.validate, pytest.mark.timeout(900)]


def rendered(engine: str, scene: str) -> compare.Measured:
    """Two pictures of an engine."""
    with Peer(Entrant(engine, scene), scale=SCALE) as peer:
        peer.samples = SAMPLES.get(scene, USUAL_SAMPLES)
        first, second = peer.render(1), peer.render(2)
    return compare.measured(first.values, second.values, first.samples, first.seconds + second.seconds)


@pytest.mark.parametrize("scene", [contest.name for contest in CONTESTS if contest.name != "hall"])
def test_blocks_agree(scene: str) -> None:
    try:
        ours, theirs = rendered("gonio", scene), rendered("cycles", scene)
    except Unavailable as reason:
        pytest.skip(str(reason))
    assert compare.difference(ours.image, theirs.image).median < MOST_MEDIAN
