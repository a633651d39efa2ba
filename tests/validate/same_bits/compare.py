"""Holds two builds of gonio to the same bits: `compare.py --before PYTHON --after PYTHON`.

The build before writes the scenes as bundles, and both render them at every SIMD level that it has here.
Exits with 1 where a film differs or is missing.
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
LEVELS = ["scalar", "sse4.2", "avx2", "avx512", "neon"]
BUILDS = ("before", "after")


def run(python, *arguments, level=None):
    """Runs a build's Python; gives whether it went well, and what it said."""
    environment = {**os.environ, **({"GONIO_SIMD": level} if level else {})}
    done = subprocess.run([python, *map(str, arguments)], env=environment, capture_output=True, text=True, check=False)
    ending = f"\n{python} ended with {done.returncode}" if done.returncode else ""
    return done.returncode == 0, (done.stdout + done.stderr + ending).strip()


def has(python, level):
    """Whether a build has a level here: one that it has not counts as unset."""
    return run(python, "-c", "import gonio; print(gonio.simd_level)", level=level) == (True, level)


def bits(values):
    """Values as integers of their bits."""
    return values.view(f"u{values.dtype.itemsize}")


def first_difference(name, before, after):
    """The first value of a pass that differs, in words; None where none does."""
    if (before.shape, before.dtype) != (after.shape, after.dtype):
        return f"{name}: {before.dtype} {before.shape} before, {after.dtype} {after.shape} after"
    places = np.argwhere(bits(before) != bits(after))
    if not len(places):
        return None
    y, x, channel = first = tuple(int(place) for place in places[0])
    one, two = (f"{values[first]!s} ({bits(values)[first]:#0{2 + 2 * values.itemsize}x})" for values in (before, after))
    return f"{name}, pixel ({x}, {y}), channel {channel}: {one} before, {two} after; {len(places)} of {before.size} values differ"


def differences(*files):
    """What differs between the films of a scene, pass by pass."""
    missing = [f"no film {build}" for build, file in zip(BUILDS, files, strict=True) if not file.is_file()]
    if missing:
        return missing
    with np.load(files[0]) as before, np.load(files[1]) as after:
        odd = sorted(set(before.files) ^ set(after.files))
        found = [f"{name}: one build alone has this pass" for name in odd]
        both = (first_difference(name, before[name], after[name]) for name in before.files if name in after.files)
        return found + [difference for difference in both if difference]


def compared(pythons, scenes, names, level, folder):
    """Renders all scenes with both builds and prints what differs; gives the number of scenes that do."""
    for build, python in zip(BUILDS, pythons, strict=True):
        start = time.monotonic()
        (folder / build).mkdir()
        _, said = run(python, HERE / "render.py", scenes, folder / build, *names, level=level)
        print(f"{level}: {build} took {time.monotonic() - start:.1f} s" + (f"\n{said}" if said else ""), flush=True)
    differing = 0
    for name in names:
        found = differences(*(folder / build / f"{name}.npz" for build in BUILDS))
        differing += bool(found)
        others = f"; {len(found) - 1} more passes differ" if len(found) > 1 else ""
        print(f"{level:8}{name:12}" + (f"DIFFERS: {found[0]}{others}" if found else "equal"))
    return differing


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--before", required=True, help="Python that has the build before a change")
    parser.add_argument("--after", required=True, help="Python that has the build after it")
    parser.add_argument("--scenes", nargs="*", help="names of scenes; all without it")
    parser.add_argument("--levels", nargs="*", default=LEVELS, help="SIMD levels; all without it")
    options = parser.parse_args()
    pythons = options.before, options.after
    with tempfile.TemporaryDirectory() as folder:
        scenes = Path(folder) / "scenes"
        scenes.mkdir()
        built, said = run(options.before, HERE / "scenes.py", scenes)
        if not built:
            sys.exit(f"the scenes cannot be built:\n{said}")
        names = options.scenes or [path.name for path in sorted(scenes.iterdir())]
        levels = [level for level in options.levels if has(options.before, level)]
        differing = 0
        for level in levels:
            (Path(folder) / level).mkdir()
            differing += compared(pythons, scenes, names, level, Path(folder) / level)
    print(f"{differing} of {len(names) * len(levels)} films differ: scenes {' '.join(names)}, levels {' '.join(levels) or 'none'}")
    sys.exit(1 if differing or not names or not levels else 0)


if __name__ == "__main__":
    main()
