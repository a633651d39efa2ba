"""Compares the work of two builds where clocks are too noisy: `instructions.py --before PYTHON --after PYTHON`.

Counts the instructions that Valgrind sees while the scenes are rendered by one thread with two numbers of samples. What one sample more costs is their
difference, in which starting up and loading cancel; it is the same on a busy machine. Light paths are counted by `--integrator light`. Two scenes
have no number of samples.
"""

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SIDE = 48
SAMPLES = (8, 40)
WITHOUT_SAMPLES = {"adaptive", "whitted"}
RENDER = """
import sys, gonio
scene = gonio.Scene.load(sys.argv[1])
settings = {"integrator": sys.argv[3]} if len(sys.argv) > 3 else {}
scene.set(samples=int(sys.argv[2]), width=%d, height=%d, threads=1, noise_threshold=0.0, caustics="off", passes=["color"], **settings)
with gonio.Render(scene) as render:
    render.wait()
""" % (SIDE, SIDE)


def instructions(python, scene, samples, integrator):
    """The instructions of one render; None where it fails."""
    command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", python, "-c", RENDER, str(scene), str(samples), *integrator]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    found = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode or not found:
        print(f"{scene.name}: {done.stderr.strip().splitlines()[-1:]}", file=sys.stderr)
        return None
    return int(found.group(1))


def of_samples(python, scene, integrator):
    """Instructions for each sample of each pixel."""
    few, many = (instructions(python, scene, samples, integrator) for samples in SAMPLES)
    return None if few is None or many is None else (many - few) / (SIDE * SIDE * (SAMPLES[1] - SAMPLES[0]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--before", required=True, help="Python that has the build before a change")
    parser.add_argument("--after", required=True, help="Python that has the build after it")
    parser.add_argument("--scenes", nargs="*", help="names of scenes; all without it")
    parser.add_argument("--integrator", help="another integrator than the scene's: path, direct or light")
    options = parser.parse_args()
    if shutil.which("valgrind") is None:
        sys.exit("valgrind is not installed")
    integrator = [options.integrator] if options.integrator else []
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([options.before, HERE / "scenes.py", folder], check=True)
        print(f"{'scene':<12}{'before':>12}{'after':>12}  after / before, instructions a sample")
        for scene in sorted(Path(folder).iterdir()):
            if scene.name in WITHOUT_SAMPLES or options.scenes and scene.name not in options.scenes:
                continue
            before, after = (of_samples(python, scene, integrator) for python in (options.before, options.after))
            if before and after:
                print(f"{scene.name:<12}{before:>12.0f}{after:>12.0f}{after / before:>9.3f}", flush=True)


if __name__ == "__main__":
    main()
