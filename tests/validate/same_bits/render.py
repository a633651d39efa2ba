"""Renders bundles with the gonio of the Python that runs it and keeps all bits: `render.py SCENES FOLDER NAME ...`."""

import os
import sys
import tempfile
from pathlib import Path

import gonio
import numpy as np

# Scenes that are rendered twice more: once with an interruption, once in parts.
BROKEN_OFF = {"lamps", "crowd"}
SENSOR_SAMPLES = 256
PARTS = 6


def passes(film, prefix=""):
    """The passes of a film by their names."""
    return {prefix + name: np.asarray(film[name]) for name in film.passes}


def finished(scene, **keywords):
    """The film of the whole render."""
    with gonio.Render(scene, **keywords) as render:
        render.wait()
        return render.film()


def resumed(scene, checkpoint):
    """The film of a render that was broken off after some samples and goes on from its checkpoint."""
    with gonio.Render(scene) as render:
        next(tile for tile in render if tile.samples >= 16)
        render.checkpoint(checkpoint)
    return finished(scene, resume=checkpoint)


def merged(scene, folder):
    """The film of parts."""
    paths = []
    for part in scene.parts(PARTS):
        scene.set(**part)
        with gonio.Render(scene) as render:
            render.wait()
            paths.append(folder / f"{len(paths)}.part")
            render.checkpoint(paths[-1])
    return gonio.merge(paths)


def sensors(scene):
    """What meters and grids show."""
    found = gonio.measure(scene, samples=SENSOR_SAMPLES)
    both = {"meters": np.array([[[meter.value, meter.standard_error] for meter in found.meters]])}
    for number, grid in enumerate(found.grids):
        both[f"grid {number} {grid.quantity}"] = np.stack([np.asarray(grid.values), np.asarray(grid.standard_errors)], axis=-1)
    return both


def arrays(path):
    """Everything a scene shows, as (rows, columns, channels)."""
    scene = gonio.Scene.load(path)
    found = passes(finished(scene))
    if scene.to_dict()["grids"]:
        found |= sensors(scene)
    if path.name in BROKEN_OFF:
        with tempfile.TemporaryDirectory() as folder:
            found |= passes(resumed(scene, Path(folder) / "checkpoint"), "resumed ")
            found |= passes(merged(scene, Path(folder)), "merged ")
    return found


def main(scenes, folder, *names):
    if os.environ.get("GONIO_SIMD", gonio.simd_level) != gonio.simd_level:
        sys.exit(f"this build has no level {os.environ['GONIO_SIMD']} here")
    for name in names:
        # A scene that fails leaves no file, and the others go on.
        try:
            np.savez(Path(folder) / name, **arrays(Path(scenes) / name))
        except Exception as error:
            print(f"{name}: {type(error).__name__}: {error}", file=sys.stderr)


if __name__ == "__main__":
    main(*sys.argv[1:])
