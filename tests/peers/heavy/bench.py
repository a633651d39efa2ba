"""What heavy scenes cost from Blender's file to the first sample, in gonio and in Cycles: `bench.py [--millions 4] [--rounds 3] [scene ...]`.

Each render runs in a Blender of its own: 64 × 64 pixels, one sample. Memory is the peak above what the open file takes. `GONIO_BPY` names the
Python that has `bpy` and gonio, else it is that of `.venv-bpy50`.
"""

import argparse
import json
import os
import statistics
import subprocess
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
PYTHON = os.environ.get("GONIO_BPY", str(HERE.parents[2] / ".venv-bpy50/bin/python"))
SCENES = {
    "triangles": {"things": "mesh", "quads": False, "uv": False},
    "quads": {"things": "mesh", "quads": True, "uv": False},
    "quads-uv": {"things": "mesh", "quads": True, "uv": True},
    "quads-seam": {"things": "mesh", "quads": True, "uv": True, "seam": True},
    # As many triangles as asked for in objects of 20,000.
    "objects": {"things": "objects", "each": 20_000},
    # As many placements as triangles are asked for.
    "instances": {"things": "instances"},
}
ENGINES = ("GONIO", "CYCLES")


def main() -> int:
    """Measures the scenes asked for; 1 if gonio takes more memory than Cycles, or more of the processor."""
    parser = argparse.ArgumentParser(description="Memory and time of a heavy scene in Blender, with gonio and with Cycles.")
    parser.add_argument("scenes", nargs="*", metavar="scene", help=f"which of {', '.join(SCENES)}; all without any")
    parser.add_argument("--millions", type=float, default=4.0, help="millions of triangles, or of instances")
    parser.add_argument("--rounds", type=int, default=3, help="renders of each engine, by turns")
    parser.add_argument("--threads", type=int, default=2)
    asked = parser.parse_args()
    if unknown := set(asked.scenes) - set(SCENES):
        parser.error(f"no such scene: {', '.join(sorted(unknown))}")
    is_behind = False
    for name in asked.scenes or SCENES:
        request = {**SCENES[name], "count": round(1e6 * asked.millions), "threads": asked.threads}
        rounds = [{engine: run(engine, request) for engine in ENGINES} for _ in range(asked.rounds)]
        found = {engine: middle([each[engine] for each in rounds]) for engine in ENGINES}
        for engine, figures in found.items():
            print(f"{name:10} {engine:7} {line(figures)}", flush=True)
        is_behind |= any(found["GONIO"][figure] > found["CYCLES"][figure] for figure in ("peak", "processor"))
    return int(is_behind)


def run(engine: str, request: dict[str, Any]) -> dict[str, float]:
    """What one render took."""
    done = subprocess.run([PYTHON, str(HERE / "child.py"), engine, json.dumps(request)], capture_output=True, text=True, check=False)
    if done.returncode != 0 or not done.stdout:
        sys.stderr.write(done.stderr)
        raise SystemExit(f"{engine} ended with {done.returncode}")
    found: dict[str, float] = json.loads(done.stdout)
    return found


def middle(rounds: list[dict[str, float]]) -> dict[str, float]:
    """The median of each figure."""
    return {figure: statistics.median(each[figure] for each in rounds) for figure in rounds[0]}


def line(found: dict[str, float]) -> str:
    """A row of the table."""
    count = found["count"]
    memory = f"{found['peak'] / count:6.1f} bytes each, {found['left'] / count:6.1f} after it"
    return f"{memory}, {1e6 * found['processor'] / count:6.3f} s of the processor a million, {found['seconds']:6.2f} s of the clock"


if __name__ == "__main__":
    sys.exit(main())
