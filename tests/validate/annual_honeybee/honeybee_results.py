"""Folders of results as honeybee's post-processing reads them, and what it makes of them."""

import functools
import json
import os
import subprocess
from pathlib import Path

import environments
import numpy as np
import pytest

CHILD = Path(__file__).with_name("honeybee_figures.py")
STATIC = "__static_apertures__"
# Names of honeybee's figures and of gonio's at each point.
NAMES = {"da": "da_300", "cda": "cda_300", "udi": "udi_100_3000", "udi_lower": "udi_below_100", "udi_upper": "udi_above_3000"}


@functools.cache
def found() -> tuple[str, str]:
    """The Python that has honeybee, and why there is none."""
    try:
        path = os.environ.get("GONIO_PEER_HONEYBEE") or str(environments.python_of("honeybee"))
    except environments.Unavailable as reason:
        return "", str(reason)
    done = subprocess.run([path, "-c", "import honeybee_radiance_postprocess"], capture_output=True)
    return path, "it is not in the Python that was named" if done.returncode else ""


def python() -> str:
    """The Python that has honeybee; skips where there is none. GONIO_PEER_HONEYBEE names one."""
    path, problem = found()
    if problem:
        pytest.skip(f"no honeybee: {problem}")
    return path


def folder(path: Path, light_paths: dict[str, list[tuple[np.ndarray, np.ndarray]]], kept: np.ndarray) -> Path:
    """Writes a grid's light by light path: for each state all of it and the direct one, points × hours in lx; `kept` hours are written."""
    points = len(next(iter(light_paths.values()))[0][0])
    path.mkdir()
    info = {"name": "Floor", "identifier": "Floor", "full_id": "Floor", "count": points, "group": ""}
    info["light_path"] = [[name] for name in light_paths]
    states = {name: [f"{state}_{name}" for state in range(len(values))] for name, values in light_paths.items() if name != STATIC}
    (path / "grids_info.json").write_text(json.dumps([info]))
    (path / "sun-up-hours.txt").write_text("".join(f"{hour}.5\n" for hour in kept))
    if states:
        (path / "grid_states.json").write_text(json.dumps({"Floor": states}))
    for name, values in light_paths.items():
        for state, arrays in enumerate(values):
            for kind, array in zip(("total", "direct"), arrays, strict=True):
                place = path / name / ("default" if name == STATIC else states[name][state]) / kind
                place.mkdir(parents=True)
                # Doubles, so that honeybee's sums do not round.
                np.save(place / "Floor.npy", array[:, kept].astype(float))
    return path


def asked(tmp_path: Path, **task: object) -> dict:
    """What honeybee answers to a task (`honeybee_figures.py`)."""
    files = tmp_path / "task.json", tmp_path / "found.json"
    files[0].write_text(json.dumps(task, default=str))
    done = subprocess.run([python(), str(CHILD), *map(str, files)], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-2000:]
    return json.loads(files[1].read_text())


def same_points(ours: dict, theirs: dict) -> None:
    """The figures of points are the same: counts of hours exactly, and sums to the rounding of 32 bits."""
    for name, field in NAMES.items():
        tolerance = {"rel": 1e-6} if name == "cda" else {"abs": 1e-9}
        assert [100 * point[field] for point in ours["points"]] == pytest.approx(theirs[name], **tolerance), name
    # Honeybee sums means in 32 bits.
    assert [point["mean_lx"] for point in ours["points"]] == pytest.approx(theirs["mean"], rel=2e-5)
    assert ours["sda_300_50"] == theirs["sda"] and ours["used_hours"] == theirs["used"]
