"""RGL files of our own writer, in Mitsuba's `measured` BSDF and in ours: the same values at 100,000 pairs of directions."""

import subprocess
from pathlib import Path

import numpy as np
import pytest

mitsuba = pytest.importorskip("mitsuba")

pytestmark = [pytest.mark.validate, pytest.mark.timeout(3600)]

REPOSITORY = Path(__file__).resolve().parents[2]
PAIRS = 100_000


def evaluated_by_us(kind: str, folder: Path) -> tuple[Path, np.ndarray]:
    """The file, and rows of wi, wo and BSDF × cosine of wi."""
    file, pairs = folder / f"{kind}.bsdf", folder / f"{kind}.pairs"
    command = ["cargo", "run", "--quiet", "--release", "-p", "gonio-formats", "--example", "write_rgl", "--"]
    subprocess.run([*command, kind, str(file), str(pairs), str(PAIRS)], cwd=REPOSITORY, check=True)
    return file, np.fromfile(pairs, dtype="<f8").reshape(-1, 9)


def evaluated_by_mitsuba(file: Path, wi: np.ndarray, wo: np.ndarray) -> np.ndarray:
    """Its cosine is the second direction's, so what it calls wi is our wo."""
    mitsuba.set_variant("scalar_rgb")
    bsdf = mitsuba.load_dict({"type": "measured", "filename": str(file)})
    context, interaction = mitsuba.BSDFContext(), mitsuba.SurfaceInteraction3f()

    def value(light: list[float], view: list[float]) -> list[float]:
        interaction.wi = view
        return list(bsdf.eval(context, interaction, light))

    return np.array([value(light, view) for light, view in zip(wi.tolist(), wo.tolist())])


@pytest.mark.parametrize("kind", ["isotropic", "anisotropic"])
def test_the_same_values_as_mitsuba(kind: str, tmp_path: Path) -> None:
    file, rows = evaluated_by_us(kind, tmp_path)
    wi, wo, ours = rows[:, :3], rows[:, 3:6], rows[:, 6:]
    theirs = evaluated_by_mitsuba(file, wi, wo)
    # Where values are a millionth of the largest one, single precision has no digits left to compare.
    bright = ours > 1e-6 * ours.max()
    difference = np.abs(ours - theirs)[bright] / ours[bright]
    print(f"{kind}: {bright.mean():.1%} compared, median {np.median(difference):.1e}, largest {difference.max():.1e}")
    assert bright.mean() > 0.9
    assert difference.max() < 1e-3
