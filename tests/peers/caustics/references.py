"""References of the hard scenes by maps of caustics, in Mitsuba's vector mode: `references.py [scene ...] --photons 2e8 --samples 2048`.

Run by a Python that has `mitsuba`. Keeps out/peers/caustics/references/<scene>.npz with the picture and its two independent halves. Scenes that
are not named are made only where none is kept, or the one that is kept is of another form of the scene.
"""

import argparse
import hashlib
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "render"), str(HERE.parents[1] / "validate")]

import numpy  # noqa: E402
from description import described  # noqa: E402
from lineup import SCENES  # noqa: E402

FOLDER = HERE.parents[2] / "out" / "peers" / "caustics" / "references"
# Metres: the sides of the parts in which a map keeps flux, a fraction of a pixel's each.
PART = {"proof": 0.01, "lens": 0.006, "lantern": 0.004, "glass_ball": 0.0015, "pool": 0.006, "door_ajar": 0.02, "louvres": 0.01}
# Times as many camera paths as elsewhere: where diffuse surfaces light diffuse surfaces through a narrow gap or from a small spot.
MORE = {"lens": 4, "door_ajar": 4}
# Light paths and camera rays at once.
BATCH, RAYS = 4_000_000, 1_000_000


def main() -> None:
    """Makes what is asked for."""
    parser = argparse.ArgumentParser(description="References of the hard scenes by maps of caustics.")
    parser.add_argument("scenes", nargs="*", metavar="scene", help=f"which of {', '.join(SCENES)}; all without any")
    parser.add_argument("--photons", type=float, default=2e8)
    parser.add_argument("--samples", type=int, default=2048)
    parser.add_argument("--threads", type=int, default=2)
    asked = parser.parse_args()
    import drjit

    drjit.set_thread_count(asked.threads)
    FOLDER.mkdir(parents=True, exist_ok=True)
    for name in asked.scenes or [name for name in SCENES if kept(name) is None]:
        start, samples = time.perf_counter(), asked.samples * MORE.get(name, 1)
        halves = [half(name, seed, asked.photons / 2, samples // 2) for seed in (0, 1)]
        made = {"picture": numpy.mean(halves, axis=0), "halves": numpy.array(halves), "of": fingerprint(name)}
        numpy.savez(FOLDER / f"{name}.npz", photons=asked.photons, samples=samples, **made)
        print(f"{name}: {time.perf_counter() - start:.0f} s", flush=True)


def fingerprint(name: str) -> str:
    """Changes with all that a scene shows."""
    scene, found = described(name), hashlib.sha256()
    for mesh in scene.meshes:
        for array in (mesh.points, mesh.triangles, mesh.places, *([] if mesh.normals is None else [mesh.normals])):
            found.update(numpy.ascontiguousarray(array).tobytes())
        found.update(repr(mesh.surface).encode())
    found.update(repr((scene.lights, scene.camera, scene.width, scene.height, scene.bounces)).encode())
    return found.hexdigest()


def kept(name: str) -> tuple[numpy.ndarray, numpy.ndarray] | None:
    """The picture and its halves if there is one of this very scene."""
    file = FOLDER / f"{name}.npz"
    if not file.exists():
        return None
    with numpy.load(file) as found:
        is_same = "of" in found and str(found["of"]) == fingerprint(name)
        return (found["picture"], found["halves"]) if is_same else None


def half(name: str, seed: int, count: float, samples: int) -> numpy.ndarray:
    """A picture with random numbers of its own."""
    import maps
    import mitsuba
    from engine_mitsuba import camera

    scene = described(name)
    with tempfile.TemporaryDirectory() as folder:
        world = maps.World(scene, folder, PART[name])
        eye = mitsuba.load_dict(camera(scene))
        batches, flux = max(1, round(count / BATCH)), numpy.zeros((world.parts.count, 3))
        for batch in range(batches):
            flux += maps.photons(world, BATCH, 2 * batch + seed) / batches
            say(f"{name}: batch {batch + 1} of {batches}")
        # Triangles at the poles of turned bodies have no area.
        irradiance = mitsuba.Float((flux / numpy.maximum(world.parts.areas, 1e-15)[:, None]).astype("f4").ravel())
        size, at_once = (scene.width, scene.height), max(1, RAYS // (scene.width * scene.height))
        rounds = max(1, samples // at_once)
        sums = numpy.zeros((scene.height, scene.width, 3))
        for k in range(rounds):
            sums += maps.picture(world, eye, irradiance, size, at_once, 2 * k + seed + 1000000) / rounds
            say(f"{name}: picture {k + 1} of {rounds}")
        return sums


def say(line: str) -> None:
    """How far it is."""
    print(line, file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
