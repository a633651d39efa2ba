"""Intensities of the stages as gonio's path tracer sees them from afar.

A parallel view of the whole luminaire has the mean luminance I / A.
It shares no light path with the goniometer, so it tells whether stage and oracle mean the same. Point lamps in glass are beyond it: no
path finds them. `python by_camera.py FOLDER` prints some angles beside the expected ones.
"""

import sys
from pathlib import Path

import expected
import gonio
import guide
import luminaires
import numpy
from optics import across, towards

LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722])
ANGLES = {
    "reflector": [(0, 0), (0, 5), (0, 10), (30, 13), (0, 30)],
    "lens": [(0, 0), (0, 4), (20, 6), (0, 20), (0, 40)],
    "guide": [(0, 0), (0, 45), (90, 60), (180, 45), (180, 120)],
    "opal": [(0, 0), (0, 60), (40, 105)],
}


def intensity(
    stage: Path, plane: float, gamma: float, side: float = 0.26, seeds: range = range(1, 5), samples: int = 64
) -> tuple[float, float]:
    """Candela and their standard error; the view is a square of a side in metres about the origin."""
    scene = gonio.load_usd(str(stage))
    view = towards(gamma, plane)
    right, up = across(view)
    camera = scene.to_dict()["cameras"][0]
    # A right-handed frame whose z looks back to the eye.
    columns = [right.tolist(), numpy.cross(view, right).tolist(), view.tolist(), view.tolist()]
    camera.update(projection="Orthographic", aperture=[side, side], transform={"columns": columns}, focus_distance=1.0)
    scene.put_camera(camera, 0)
    scene.set(width=256, height=256, samples=samples, filter="box", filter_width=1.0, max_bounces=200)
    found = []
    for seed in seeds:
        scene.set(seed=seed)
        with gonio.Render(scene) as render:
            assert render.wait()
            picture = numpy.asarray(render.film().read("color"), float)
        found.append(float((picture[..., :3] @ LUMINANCE).mean()) * side**2)
    return float(numpy.mean(found)), float(numpy.std(found, ddof=1) / len(found) ** 0.5)


def expectation(name: str, plane: float, gamma: float) -> tuple[float, float]:
    """Candela and their standard error in the very direction."""
    if name == "guide":
        return guide.by_chance(plane, gamma, 2_000_000)
    kept = expected.read(name)
    j = int(numpy.argmin(numpy.abs(kept.polar - gamma)))
    return float(kept.candela[0, j]), float(kept.error[0, j])


def main(folder: Path) -> None:
    """Prints them."""
    paths = luminaires.write(folder)
    for name, angles in ANGLES.items():
        for plane, gamma in angles:
            wanted, _ = expectation(name, plane, gamma)
            found, error = intensity(paths[name], plane, gamma)
            print(
                f"{name} C{plane} γ{gamma}: {found:.5g} ± {error:.2g} cd for {wanted:.5g} ({100 * (found / wanted - 1):+.2f} %)", flush=True
            )


if __name__ == "__main__":
    main(Path(sys.argv[1]))
