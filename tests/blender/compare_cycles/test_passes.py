"""Passes of data and cryptomattes of the same file in Cycles and in Gonio, pixel by pixel."""

from pathlib import Path

import blender
import compare
import numpy
import pytest
import report

pytestmark = [pytest.mark.validate, pytest.mark.timeout(2 * blender.SECONDS)]

ENGINES = ("GONIO", "CYCLES")
FILE = Path(__file__).with_name("passes.py")
SAMPLES = 256
# Share of a pass's extent, or of the unit of directions and coordinates.
MOST_APART = 1e-3
# Share of the pixels whose middle lies on the same thing in both.
LEAST_SAME = 0.998


def both(function: str, folder: Path, **arguments: int) -> list[dict[str, numpy.ndarray]]:
    """What a function of `passes.py` writes, of Gonio and of Cycles."""
    found = []
    for engine in ENGINES:
        blender.call(function, folder, file=FILE, engine=engine, **arguments)
        with numpy.load(folder / f"{engine}.npz") as written:
            found.append(dict(written))
    return found


def shown(name: str, pairs: list[tuple[numpy.ndarray, numpy.ndarray]]) -> None:
    """Writes a picture: a row a pair, Gonio's on the left, each from black to white."""
    rows = []
    for pair in pairs:
        low, high = min(each.min() for each in pair), max(each.max() for each in pair)
        rows.append(numpy.concatenate([(each - low) / max(high - low, 1e-6) for each in pair], axis=1))
    grey = (numpy.concatenate(rows)[..., None].repeat(3, axis=-1) * 255 + 0.5).astype("u1")
    report.OUT.mkdir(parents=True, exist_ok=True)
    compare.write_png(report.OUT / f"{name}.png", grey)


def within(index: numpy.ndarray) -> numpy.ndarray:
    """The pixels whose neighbours show the same number."""
    same = numpy.ones(index.shape, dtype=bool)
    for axis in (0, 1):
        for step in (-1, 1):
            same &= numpy.roll(index, step, axis=axis) == index
    return same


def test_data_is_the_same(tmp_path: Path) -> None:
    ours, theirs = both("data", tmp_path)
    names = sorted(name for name in theirs if not name.startswith("Combined"))
    assert set(names) <= set(ours) and len(names) > 12
    shown("data_passes", [(numpy.minimum(ours[name], 20.0), numpy.minimum(theirs[name], 20.0)) for name in names if numpy.ptp(theirs[name]) > 0.0])
    numbers = [name for name in names if "Index" in name]
    same = numpy.all([ours[name] == theirs[name] for name in numbers], axis=0)
    assert len(numbers) == 2 and same.mean() > LEAST_SAME, same.mean()
    inner = numpy.all([within(found[name]) for name in numbers for found in (ours, theirs)], axis=0) & same
    for name in (name for name in names if name not in numbers):
        # Where nothing is lies far away.
        far = theirs[name] > 1e9
        assert numpy.array_equal((ours[name] > 1e9)[inner], far[inner]), name
        extent = max(1.0, float(numpy.ptp(theirs[name][~far])))
        apart = numpy.abs(ours[name] - theirs[name])[inner & ~far] / extent
        print(f"{name}: largest {apart.max():.1e}, 99th percentile {numpy.percentile(apart, 99):.1e}")
        assert numpy.percentile(apart, 99) < MOST_APART, (name, apart.max())


def test_mattes_are_the_same(tmp_path: Path) -> None:
    ours, theirs = both("mattes", tmp_path, samples=SAMPLES)
    assert {name.split(".")[0] for name in ours} == {"CryptoObject", "CryptoMaterial", "CryptoAsset"}
    wanted = sorted(name for name in theirs if theirs[name].max() > 0.0)
    assert {name for name in ours if ours[name].max() > 0.0} == set(wanted)
    shown("cryptomattes", [(ours[name], theirs[name]) for name in wanted])
    for name in wanted:
        apart = numpy.abs(ours[name] - theirs[name])
        blocks = numpy.abs(compare.blocks(ours[name][..., None]) - compare.blocks(theirs[name][..., None]))
        print(f"{name}: largest {apart.max():.3f}, mean {apart.mean():.5f}, blocks {blocks.max():.4f}")
        # A pixel's edge by 256 samples of each engine: four standard errors of the difference.
        assert apart.max() < 0.08 and apart.mean() < 0.001 and blocks.max() < 0.002, name
