"""Pictures by another system's gonio, rendered in an emulator, beside the one of this machine's own level: the same within noise.

    python picture.py --emulated "qemu-aarch64-static ... bundle_picture" --output out/arm --levels neon scalar

Each level renders with seeds of its own, several times. Blocks' means are compared by Student's t, the variance pooled over all levels; the
family of all blocks, colours and levels has a confidence of 99.9 %. Needs gonio, NumPy and OpenEXR in this Python.
"""

import argparse
import shlex
import statistics
import subprocess
import sys
from pathlib import Path

import gonio
import numpy as np
import OpenEXR

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "validate"))
from test_levels import CONFIDENCE, as_normal, blocks

SEEDS = 4
SIZE = (160, 96)


def bundle(folder: Path) -> Path:
    """The office as a scene bundle, for a renderer that has no USD."""
    scene = gonio.load_usd(ROOT / "examples" / "usd" / "office.usda")
    scene.set(width=SIZE[0], height=SIZE[1], samples=16, passes=["color"])
    path = folder / "office.gonio"
    scene.save(path, images=True)
    return path


def here(scene: Path, seed: int) -> gonio.Film:
    """The film by this machine."""
    loaded = gonio.Scene.load(scene)
    loaded.set(seed=seed)
    with gonio.Render(loaded) as render:
        render.wait()
        return render.film()


def colour(film: gonio.Film) -> np.ndarray:
    return np.asarray(film["color"])[..., :3].astype("f8")


def show(film: gonio.Film, mean: np.ndarray, path: Path) -> None:
    """A mean of several renders as a picture to look at, all by the same exposure."""
    film.with_pass("color", np.dstack([mean, np.ones(mean.shape[:2])]).astype("f4")).write_picture(path, exposure=0.7)


def there(command: list[str], scene: Path, level: str, seed: int) -> np.ndarray:
    """The colour by the emulated machine."""
    path = scene.parent / f"{level}-{seed}.exr"
    subprocess.run([*command, str(scene), str(path), level, str(seed)], check=True)
    return OpenEXR.File(str(path)).channels()["RGBA"].pixels[..., :3].astype("f8")


def compare(pictures: dict[str, list[np.ndarray]], reference: str) -> bool:
    """Prints how far the levels' pictures are apart; whether that is noise."""
    found = {level: np.stack([blocks(picture) for picture in several]) for level, several in pictures.items()}
    variance = np.mean([several.var(axis=0, ddof=1) for several in found.values()], axis=0)
    known = found[reference].mean(axis=0)
    error = np.maximum(np.sqrt(variance * 2 / SEEDS), 1e-6 * known)
    tests = (len(found) - 1) * error.size
    most = statistics.NormalDist().inv_cdf(0.5 + 0.5 * CONFIDENCE ** (1 / tests))
    good = True
    for level, several in found.items():
        if level != reference:
            t = (several.mean(axis=0) - known) / error
            worst = as_normal(np.abs(np.nan_to_num(t)), len(found) * (SEEDS - 1)).max()
            ratio = several.mean() / known.mean()
            print(f"{level} against {reference}: mean {ratio:.5f}, worst block {worst:.2f} of {most:.2f} standard deviations")
            good &= bool(worst < most and np.isfinite(t).all())
    return good


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--emulated", required=True, help="the command that renders a bundle at a level of the other machine")
    parser.add_argument("--output", type=Path, default=Path("out/arm"))
    parser.add_argument("--levels", nargs="+", default=["neon", "scalar"], help="of the other machine")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    scene, command = bundle(arguments.output), shlex.split(arguments.emulated)
    own = f"{gonio.simd_level} here"
    films = [here(scene, 1 + seed) for seed in range(SEEDS)]
    pictures = {own: [colour(film) for film in films]}
    for row, level in enumerate(arguments.levels, 1):
        pictures[f"{level} there"] = [there(command, scene, level, 1 + row * SEEDS + seed) for seed in range(SEEDS)]
    for level, several in pictures.items():
        show(films[0], np.mean(several, axis=0), arguments.output / f"{level.replace(' ', '-')}.png")
    raise SystemExit(0 if compare(pictures, own) else 1)


if __name__ == "__main__":
    main()
