"""What a heavy mesh costs from Blender's file to the first sample, in gonio and in Cycles: `bench.py [--millions 4] [--rounds 3] [mesh ...]`.

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
MESHES = {
    "triangles": {"quads": False, "uv": False},
    "quads": {"quads": True, "uv": False},
    "quads-uv": {"quads": True, "uv": True},
    "quads-seam": {"quads": True, "uv": True, "seam": True},
}
ENGINES = ("GONIO", "CYCLES")


def main() -> int:
    """Measures the meshes asked for; 1 if gonio takes more memory than Cycles, or more of the processor."""
    parser = argparse.ArgumentParser(description="Memory and time of a heavy mesh in Blender, with gonio and with Cycles.")
    parser.add_argument("meshes", nargs="*", metavar="mesh", help=f"which of {', '.join(MESHES)}; all without any")
    parser.add_argument("--millions", type=float, default=4.0, help="millions of triangles")
    parser.add_argument("--rounds", type=int, default=3, help="renders of each engine, by turns")
    parser.add_argument("--threads", type=int, default=2)
    asked = parser.parse_args()
    if unknown := set(asked.meshes) - set(MESHES):
        parser.error(f"no such mesh: {', '.join(sorted(unknown))}")
    is_behind = False
    for name in asked.meshes or MESHES:
        request = {**MESHES[name], "triangles": round(1e6 * asked.millions), "threads": asked.threads}
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
    count = found["triangles"]
    memory = f"{found['peak'] / count:6.1f} bytes a triangle, {found['left'] / count:6.1f} after it"
    return f"{memory}, {1e6 * found['processor'] / count:6.3f} s of the processor a million, {found['seconds']:6.2f} s of the clock"


if __name__ == "__main__":
    sys.exit(main())
