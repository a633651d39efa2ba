"""Models are read in another process: IfcOpenShell ends its process over some broken files."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
from importlib.util import find_spec
from pathlib import Path

from .extra import REMEDIES


def write_stage(source: str | os.PathLike[str], target: str | os.PathLike[str]) -> list[str]:
    """Writes the building model `source` (.ifc) as the USD stage `target` (.usda, .usdc), in metres, z up and y north.

    Photometric tables of luminaires become .ies files beside it. Gives what was left out or taken by default, with names and GlobalIds.
    Raises ValueError for files that are no IFC models or have no geometry, and where the packages of the extra `ifc` are absent.
    """
    for module, remedy in REMEDIES.items():
        if find_spec(module) is None:
            raise ValueError(remedy)
    source, target = Path(source).absolute(), Path(target).absolute()
    # The other process finds this package as this one did.
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}
    line = [sys.executable, "-m", "gonio.ifc.reader", str(source), str(target)]
    done = subprocess.run(line, stdin=subprocess.DEVNULL, capture_output=True, encoding="utf-8", errors="replace", env=environment)
    answers = done.stdout.splitlines()
    if not answers:
        raise ValueError(_cause(source, done.returncode, done.stderr))
    answer = json.loads(answers[-1])
    if "error" in answer:
        raise ValueError(answer["error"])
    return [str(note) for note in answer["notes"]]


def _cause(source: Path, status: int, told: str) -> str:
    """Why a process ended without an answer."""
    signals = {one.value: one.name for one in signal.Signals}
    last = told.strip().splitlines()[-1:]
    why = signals.get(-status, f"signal {-status}") if status < 0 else "".join(last) or f"status {status}"
    return f"{source}: IfcOpenShell broke down ({why}) over the model: it is damaged, or too large for this machine's memory"
