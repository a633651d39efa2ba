"""RGL files of our own writer, in Mitsuba's `measured` BSDF and in ours: the same values at 100,000 pairs of directions."""

import subprocess
from pathlib import Path

import environments
import gonio
import numpy
import pytest

pytestmark = [pytest.mark.validate, pytest.mark.timeout(3600)]

HERE = Path(__file__).resolve().parent
PAIRS = 100_000


def written_by_us(kind: str, folder: Path) -> Path:
    """The measurement of a GGX surface."""
    file = folder / f"{kind}.bsdf"
    command = ["cargo", "run", "--quiet", "--release", "-p", "gonio-formats", "--example", "write_rgl", "--", kind, str(file)]
    subprocess.run(command, cwd=environments.ROOT, check=True)
    return file


def random_pairs() -> numpy.ndarray:
    """Rows of wi and wo, uniform over the hemisphere down to 3° above the surface."""
    rng = numpy.random.default_rng(17)
    z, phi = rng.uniform(0.05, 1.0, (PAIRS, 2)), rng.uniform(0.0, 2.0 * numpy.pi, (PAIRS, 2))
    sine = numpy.sqrt(1.0 - z * z)
    return numpy.stack([sine * numpy.cos(phi), sine * numpy.sin(phi), z], axis=-1).reshape(PAIRS, 6)


def evaluated_by_mitsuba(file: Path, pairs: numpy.ndarray) -> numpy.ndarray:
    """BSDF × cosine of wi; skips where Mitsuba cannot be had."""
    try:
        python = environments.python_of("mitsuba")
    except environments.Unavailable as reason:
        pytest.skip(f"Mitsuba cannot be installed: {reason}")
    rows, out = file.with_suffix(".pairs.npy"), file.with_suffix(".values.npy")
    numpy.save(rows, pairs)
    subprocess.run([str(python), str(HERE / "rgl_mitsuba.py"), str(file), str(rows), str(out)], check=True)
    return numpy.load(out)


@pytest.mark.parametrize("kind", ["isotropic", "anisotropic"])
def test_the_same_values_as_mitsuba(kind: str, tmp_path: Path) -> None:
    file, pairs = written_by_us(kind, tmp_path), random_pairs()
    bsdf = gonio.MeasuredBsdf.from_file(file)
    assert bsdf.isotropic == (kind == "isotropic")
    ours = numpy.asarray(bsdf.eval(pairs[:, :3].copy(), pairs[:, 3:].copy()))
    theirs = evaluated_by_mitsuba(file, pairs)
    # Where values are a millionth of the largest one, single precision has no digits left to compare.
    bright = ours > 1e-6 * ours.max()
    difference = numpy.abs(ours - theirs)[bright] / ours[bright]
    print(f"{kind}: {bright.mean():.1%} compared, median {numpy.median(difference):.1e}, largest {difference.max():.1e}")
    assert bright.mean() > 0.9
    assert difference.max() < 1e-3
