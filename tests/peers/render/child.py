"""Renders one scene with one engine, in the Python that has the engine: `child.py ENGINE SCENE SCALE THREADS`.

Answers in lines of JSON: first about laying out the scene, then, for each line `{"samples": ..., "seed": ..., "file": ...}`, about a
picture, which it saves as an array.
"""

import dataclasses
import importlib
import json
import os
import sys
import time
from pathlib import Path
from typing import Any

import numpy

HERE = Path(__file__).resolve().parent
# The validation's Cornell box and what it knows of the other renderers; the scenes full of caustics, for `scenes` lies in two folders.
sys.path[:0] = [str(HERE), str(HERE.parent / "caustics"), str(HERE.parents[1] / "validate")]

# What engines print must not come between the answers.
answers = os.fdopen(os.dup(1), "w")
os.dup2(2, 1)


def main(engine: str, name: str, scale: float, threads: int) -> None:
    """Lays out the scene, then renders for as long as it is asked to."""
    # Some engines work on the waiting thread too.
    os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:threads])
    from description import described
    from processor import processor_seconds

    scene = described(name)
    scene = dataclasses.replace(scene, width=round(scene.width * scale), height=round(scene.height * scale))
    module, _, variant = engine.partition(":")
    made = importlib.import_module(f"engine_{module}").Engine
    start = time.perf_counter()
    running = made(scene, threads, *([variant] if variant else []))
    is_timed = getattr(running, "is_timed", False)
    answer(version=running.version, preparation=time.perf_counter() - start, jit=getattr(running, "jit", 0.0), is_timed=is_timed)
    for line in sys.stdin:
        asked = json.loads(line)
        before = processor_seconds()
        picture, seconds, samples = running.render(asked["samples"], asked["seed"])
        used = processor_seconds() - before
        numpy.save(asked["file"], picture)
        answer(seconds=seconds, samples=samples, processor=used, jit=getattr(running, "jit", 0.0))


def answer(**values: Any) -> None:
    """A line for who asked."""
    answers.write(json.dumps(values) + "\n")
    answers.flush()


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]), int(sys.argv[4]))
