"""The crate `eulumdat-goniosim` and gonio on the same luminaire, one after the other: `goniosim.py --photons 2e7 [--gonio COMMAND] [--sample PROGRAM]`.

The crate is under the AGPL. It runs as a program of its own, is linked with nothing, and lies outside the project:

    cargo install eulumdat-goniosim --root FOLDER        then  GONIOSIM=FOLDER/bin/goniosim

Its program sends a luminaire's light, by its EULUMDAT file, through a cover and collects it again. It prints the throughput and its seconds with two
digits, so they should be many. `--sample` is a program of one's own around the Quick Start of the crate's page (an LED, a white housing, an opal
cover), also outside the project; it gets the number of photons and prints what it likes. What its housing looks like the page does not say: the stage
that gonio gets has four walls 25 mm from the axis, 50 mm long, and a cover that scatters all it lets pass. Speeds compare, figures do not.

`--gonio` has {stage}, {photons} and {out}: a stage of the same luminaire with the same cover in /World, how many light paths, and the .ldt to write,
as in `gonio goniometer {stage} --luminaire /World --rays {photons} --error 0 -o {out}`; without `--error 0` fewer are traced.
The crate's own `compare` says how alike the two are.
"""

import argparse
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

LUMINAIRE = Path(__file__).resolve().parents[1] / "radiance" / "luminaire.ldt"
# Covers by the crate's names: index of refraction, thickness in metres. Its catalogue has 4 % and 92 % or 90 % for what they reflect and let pass.
COVERS = {"": None, "clear_pmma_3mm": (1.49, 0.003), "clear_glass_4mm": (1.52, 0.004)}
DISTANCE = 0.04
# A cover that all light below meets.
WIDE = 2.0
HEAD = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)

def Xform "World"
{
    def RectLight "Source"
    {
        asset gonio:photometry:file = @luminaire.ldt@
    }
"""
COVER = """    def Mesh "Cover" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        uniform token subdivisionScheme = "none"
        int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
        int[] faceVertexIndices = [0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7]
        point3f[] points = [{points}]
        rel material:binding = </World/Clear>
    }}
    def Material "Clear"
    {{
        token outputs:mtlx:surface.connect = </World/Clear/Surface.outputs:out>
        def Shader "Surface"
        {{
            uniform token info:id = "ND_open_pbr_surface_surfaceshader"
            float inputs:transmission_weight = 1
            float inputs:specular_ior = {ior}
            float inputs:specular_roughness = 0
            token outputs:out
        }}
    }}
"""


SAMPLE = """    def DiskLight "Led"
    {{
        float inputs:radius = 0.001
        double gonio:photometry:quantity = 1000
        token gonio:photometry:unit = "lm"
    }}
{meshes}    def Material "White"
    {{
        token outputs:surface.connect = </World/White/Surface.outputs:surface>
        def Shader "Surface"
        {{
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (0.85, 0.85, 0.85)
            int inputs:useSpecularWorkflow = 1
            color3f inputs:specularColor = (0, 0, 0)
            float inputs:ior = 1
            token outputs:surface
        }}
    }}
    def Material "Opal"
    {{
        token outputs:mtlx:surface.connect = </World/Opal/Surface.outputs:out>
        def Shader "Surface"
        {{
            uniform token info:id = "ND_open_pbr_surface_surfaceshader"
            bool inputs:geometry_thin_walled = 1
            float inputs:subsurface_weight = 1
            color3f inputs:subsurface_color = (1, 1, 1)
            float inputs:specular_weight = 0
            token outputs:out
        }}
    }}
"""
QUAD = """    def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        uniform bool doubleSided = 1
        uniform token subdivisionScheme = "none"
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [{points}]
        rel material:binding = </World/{material}>
    }}
"""


def main() -> int:
    """1 where the crate's program is not there."""
    parser = argparse.ArgumentParser(description="Photons a second of eulumdat-goniosim and of gonio on the same luminaire.")
    parser.add_argument("--photons", type=float, default=2e7)
    parser.add_argument("--gonio", help="a command with {stage}, {photons} and {out}")
    parser.add_argument("--sample", help="a program around the crate's Quick Start; gets the number of photons")
    asked = parser.parse_args()
    program = os.environ.get("GONIOSIM") or shutil.which("goniosim")
    if program is None:
        print("no goniosim: cargo install eulumdat-goniosim --root FOLDER, then GONIOSIM=FOLDER/bin/goniosim", file=sys.stderr)
        return 1
    photons = int(asked.photons)
    for cover in COVERS:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            theirs = trace(program, cover, photons, folder)
            print(f"{cover or 'free':16} goniosim {photons / theirs[0] / 1e6:8.2f} M photons/s, {theirs[1]:.1f} % come out")
            if asked.gonio:
                print(of_gonio(asked.gonio, program, written(cover, folder), photons))
    if asked.sample:
        print(subprocess.run([asked.sample, str(photons)], capture_output=True, text=True, check=True).stdout)
        if asked.gonio:
            with tempfile.TemporaryDirectory() as name:
                (Path(name) / "stage.usda").write_text(sample())
                print(of_gonio(asked.gonio, program, Path(name) / "stage.usda", photons))
    return 0


def trace(program: str, cover: str, photons: int, folder: Path) -> tuple[float, float]:
    """Seconds, and per cent of the light that comes out."""
    command = [program, "trace", str(LUMINAIRE), "-o", str(folder / "theirs.ldt"), "--photons", str(photons)]
    command += ["--cover", cover, "--distance", str(1000 * DISTANCE)] if cover else []
    said = subprocess.run(command, capture_output=True, text=True, check=True)
    found = re.search(r"throughput: ([\d.]+)%, Elapsed: ([\d.]+)s", said.stdout + said.stderr)
    if found is None:
        raise ValueError(said.stdout + said.stderr)
    return float(found[2]), float(found[1])


def of_gonio(command: str, program: str, stage: Path, photons: int) -> str:
    """The same of gonio, the whole command, and how alike the files are where there are two."""
    folder = stage.parent
    words = [word.format(stage=stage, photons=photons, out=folder / "ours.ldt") for word in shlex.split(command)]
    start = time.perf_counter()
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    seconds = time.perf_counter() - start
    lines = [f"{'':16} gonio    {photons / seconds / 1e6:8.2f} M photons/s"]
    lines += [f"    {line}" for line in (done.stdout + done.stderr).splitlines()[-8:]]
    if (folder / "ours.ldt").exists() and (folder / "theirs.ldt").exists():
        alike = subprocess.run(
            [program, "compare", str(folder / "theirs.ldt"), str(folder / "ours.ldt")], capture_output=True, text=True, check=False
        )
        lines += [
            line
            for line in (alike.stdout + alike.stderr).splitlines()
            if line.startswith(("Similarity", "Light Output", "Max Int", "Beam"))
        ]
    return "\n".join(lines)


def written(cover: str, folder: Path) -> Path:
    """The stage: the luminaire shines down from the origin, the cover lies across."""
    shutil.copyfile(LUMINAIRE, folder / "luminaire.ldt")
    text, glass = HEAD, COVERS[cover]
    if glass is not None:
        ior, thickness = glass
        half, levels = WIDE / 2, (-DISTANCE - thickness, -DISTANCE)
        corners = [(x, y, z) for z in levels for x, y in ((-half, -half), (half, -half), (half, half), (-half, half))]
        text += COVER.format(points=", ".join(map(str, corners)), ior=ior)
    (folder / "stage.usda").write_text(text + "}\n")
    return folder / "stage.usda"


def sample() -> str:
    """The stage of the Quick Start, as far as its page tells."""
    wide, low, cover = 0.025, -0.05, 0.03
    around = [(-wide, -wide), (wide, -wide), (wide, wide), (-wide, wide)]
    sides = [[(*a, 0.001), (*b, 0.001), (*b, low), (*a, low)] for a, b in zip(around, around[1:] + around[:1], strict=True)]
    faces = [("Lid", [(*corner, 0.001) for corner in around], "White")]
    faces += [(f"Side{number}", side, "White") for number, side in enumerate(sides)]
    faces.append(("Cover", [(x / wide * cover, y / wide * cover, -DISTANCE) for x, y in around], "Opal"))
    meshes = "".join(QUAD.format(name=name, points=", ".join(map(str, points)), material=material) for name, points, material in faces)
    return HEAD.partition("    def RectLight")[0] + SAMPLE.format(meshes=meshes) + "}\n"


if __name__ == "__main__":
    sys.exit(main())
