"""Stages that are nested absurdly: a picture, or one line, within two minutes and 6 GB of addresses; never a crash."""

import graphs
import nests
import numpy as np
import pictures
import pytest
from bounds import judged, limited

pytestmark = [pytest.mark.validate, pytest.mark.timeout(1900)]

# Of the clock; `bounds` limits the time of the processor.
SECONDS = 1800
# What may be said beside a picture, bytes: what is wrong a hundred thousand times is not told as often.
MOST_SAID = 200_000
ALL = [*nests.HIERARCHIES, *nests.LAYERS, *nests.RELATIONSHIPS, *nests.INSTANCES, *nests.SUBSETS, *graphs.GRAPHS]


def shown(run, folder, *options):
    """Renders the stage; whether there is a picture, in which the room is still to be seen."""
    size = ("--res", 16, 16, "--spp", 1, "-j", 1)
    done = judged(run("render", "stage.usda", "-o", "a.exr", *size, *options, cwd=folder, timeout=SECONDS, preexec_fn=limited))
    assert len(done.stderr) < MOST_SAID, done.stderr[:2000]
    if done.returncode == 0:
        image = pictures.read(folder / "a.exr")
        assert np.isfinite(image.rgb).all() and image["A"].mean() > 0.6
    return done


@pytest.mark.parametrize("make", ALL, ids=lambda make: make.__name__)
def test_nests(run, tmp_path, make):
    make(tmp_path)
    shown(run, tmp_path)


@pytest.mark.parametrize("make", [*nests.INSTANCES, *graphs.GRAPHS], ids=lambda make: make.__name__)
def test_nests_that_are_asked_about(run, tmp_path, make):
    make(tmp_path)
    judged(run("info", "stage.usda", cwd=tmp_path, timeout=SECONDS, preexec_fn=limited))


@pytest.mark.parametrize("levels", [12, 40])
def test_references_that_double(run, tmp_path, levels):
    nests.doubled_references(levels)(tmp_path)
    done = shown(run, tmp_path)
    assert levels > 12 or done.returncode == 0, done.stderr
