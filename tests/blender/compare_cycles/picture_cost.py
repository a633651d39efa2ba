"""What a picture costs in Cycles and in Gonio at equal noise: `python picture_cost.py [head windmills] [--rounds 3] [--samples 32]`. Media: `cloud street milk fire --biased`.

The cost is seconds times the variance between two seeds, after the seconds that a picture of one sample takes. Engines render by turns, each picture in
a process of its own, so that the most memory it held is known.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy

# Since Blender 5.0 Cycles has two estimators of volumes.
BIASED = "CYCLES_BIASED"
CHILD = Path(__file__).resolve().parents[1] / "child.py"
SUITE = Path(__file__).resolve().parents[2]
SEEDS = (1, 2)


def picture(scene: str, engine: str, samples: int, threads: int, tmp_path: Path) -> None:
    """For `child.py`: writes two pictures with their seconds, those of one sample, and the memory of the process before and at most."""
    import resource

    import bpy
    import render

    render.build("cost", scene, 1)
    bpy.context.scene.render.threads_mode, bpy.context.scene.render.threads = "FIXED", threads
    if engine == "CYCLES_BIASED":
        engine, bpy.context.scene.cycles.volume_biased = "CYCLES", True
    if engine == BIASED:
        engine, bpy.context.scene.cycles.volume_biased = "CYCLES", True
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    seconds, images = [], []
    for seed, count in ((1, 1), *((seed, samples) for seed in SEEDS)):
        bpy.context.scene.cycles.seed, bpy.context.scene.cycles.samples = seed, count
        start = time.monotonic(), time.process_time()
        images.append(render.rendered(engine, tmp_path / "cost.exr"))
        seconds.append((time.monotonic() - start[0], time.process_time() - start[1]))
    memory = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    numpy.savez(tmp_path / "pictures.npz", first=images[1], second=images[2])
    (tmp_path / "cost.json").write_text(json.dumps({"seconds": seconds, "memory": memory / 1024}))


def measured(scene: str, engine: str, asked: argparse.Namespace) -> dict[str, float]:
    """Seconds beyond those of one sample, by the clock and the processor, variance over the mean's square, the mean, and MB."""
    python = os.environ.get("GONIO_BPY", str(SUITE.parent / ".venv-bpy50" / "bin" / "python")).split(":")[-1]
    with tempfile.TemporaryDirectory() as folder:
        arguments = {"scene": scene, "engine": engine, "samples": asked.samples, "threads": asked.threads, "tmp_path": folder}
        path = os.pathsep.join([str(CHILD.parent), os.environ.get("PYTHONPATH", "")])
        request = json.dumps([__file__, "picture", arguments])
        environment = {**os.environ, "PYTHONPATH": path}
        subprocess.run([python, str(CHILD)], input=request, text=True, check=True, stdout=subprocess.DEVNULL, env=environment)
        found = json.loads((Path(folder) / "cost.json").read_text())
        with numpy.load(Path(folder) / "pictures.npz") as pictures:
            first, second = (pictures[name].mean(axis=2) for name in ("first", "second"))
    if asked.keep:
        numpy.save(Path(asked.keep) / f"{scene}-{engine}.npy", 0.5 * (first + second))
    one, *whole = found["seconds"]
    clock, processor = (statistics.mean(each[kind] for each in whole) - one[kind] for kind in (0, 1))
    mean = 0.5 * (first.mean() + second.mean())
    # The mean of squares is ruled by a few bright pixels; so are both engines'.
    variance = 0.5 * float(((first - second) ** 2).mean()) / mean**2
    return {"clock": clock, "processor": processor, "start": one[0], "variance": variance, "mean": mean, "memory": found["memory"]}


def main() -> int:
    """Prints a row a scene and an engine, and the ratios of costs."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("scenes", nargs="*", default=["head", "windmills"])
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--biased", action="store_true", help="Cycles' biased estimator of volumes too; the better of the two counts")
    parser.add_argument("--keep", help="a folder for the pictures")
    asked = parser.parse_args()
    engines = ("CYCLES", *([BIASED] if asked.biased else []), "GONIO")
    for scene in asked.scenes:
        rows: dict[str, list[dict[str, float]]] = {engine: [] for engine in engines}
        for _ in range(asked.rounds):
            for engine in engines:
                rows[engine].append(measured(scene, engine, asked))
        medians = {engine: {key: statistics.median(row[key] for row in rows[engine]) for key in rows[engine][0]} for engine in engines}
        print(f"{scene}, {asked.samples} samples, {asked.threads} threads, load {os.getloadavg()[0]:.1f}")
        for engine, row in medians.items():
            print(f"  {engine:13} " + ", ".join(f"{key} {value:.4g}" for key, value in row.items()))
        gonio, peers = medians["GONIO"], [medians[engine] for engine in engines[:-1]]
        for kind in ("clock", "processor"):
            best = min(peer[kind] * peer["variance"] for peer in peers)
            print(f"  cost by the {kind}: {gonio[kind] * gonio['variance'] / best:.3f} of Cycles'")
        print(f"  memory: {gonio['memory'] / min(peer['memory'] for peer in peers):.2f} of Cycles'", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
