"""The luminaires of the comparison, with the sizes that their oracles use too.

`python luminaires.py FOLDER` writes a stage for each. Nadir is −z.

Mirrors, lenses and shells are meshes with the normals of the exact surface at their points: what a facet of size h bends is then off by h²
and not by h, and 256 facets around are fine enough for a thousandth. Diffuse surfaces have flat facets: their own area and cosines then
belong together, and only the area is off, by h² as well.
"""

import sys
from pathlib import Path

import meshes
import numpy

MM = 1e-3
LUMENS = 1000.0
AROUND = 256

# A paraboloid z = FOCUS − r² / 4 FOCUS about a sphere that shines in its focus, open to nadir.
FOCUS, RIM, BULB, REFLECTANCE = 25 * MM, 60 * MM, 8 * MM, 0.9

# A lens with a plane side up at z = −PLANE and a sphere of radius CURVE below, as thick as it is deep; a disk that shines down at z = 0.
INDEX, CURVE, LENS_RADIUS, PLANE, CHIP = 1.5, 50 * MM, 25 * MM, 90 * MM, 10 * MM
SAG = CURVE - (CURVE**2 - LENS_RADIUS**2) ** 0.5

# A plate whose edge at −x is lit, whose other edges are mirrors and whose upper side has square white dots.
GUIDE_INDEX, GUIDE, DOT, PITCH, DOT_REFLECTANCE, EDGE_REFLECTANCE = 1.49, (100 * MM, 60 * MM, 4 * MM), 3 * MM, 5 * MM, 0.9, 0.9
STRIP, GAP = (40 * MM, 3 * MM), 0.1 * MM

# A white board at z = 0, half a sphere of opal below it, and a chip between that shines down.
DOME, BOARD_REFLECTANCE, OPAL_REFLECTANCE, OPAL_TRANSMITTANCE, LED, LED_DEPTH = 30 * MM, 0.8, 0.3, 0.6, 3 * MM, 1 * MM

# Two spheres about a point lamp; in a second scene a black half sphere above the lamp.
SHELL_INDEX, INNER, OUTER, SCREEN = 1.5, 20 * MM, 30 * MM, 10 * MM


def sphere(radius: float, outward: float, first: float = 0.0, last: float = numpy.pi) -> meshes.Profile:
    """Part of a sphere about the origin, by the angle from the zenith."""

    def profile(u: numpy.ndarray) -> meshes.Rings:
        angle = first + (last - first) * u
        sine, cosine = numpy.sin(angle), numpy.cos(angle)
        sine[numpy.abs(sine) < 1e-12] = 0.0
        return radius * sine, radius * cosine, outward * sine, outward * cosine

    return profile


def disk(radius: float, height: float, up: float) -> meshes.Profile:
    """A flat disk."""
    return lambda u: (radius * u, numpy.full_like(u, height), numpy.zeros_like(u), numpy.full_like(u, up))


def reflector() -> str:
    """A sphere in the focus of a parabolic mirror."""

    def profile(u: numpy.ndarray) -> meshes.Rings:
        r = RIM * u
        length = numpy.hypot(r, 2 * FOCUS)
        return r, FOCUS - r**2 / (4 * FOCUS), -r / length, -2 * FOCUS / length

    cup = meshes.mesh("Reflector", meshes.revolved(profile, 128, AROUND), "Mirror")
    bulb = meshes.light("SphereLight", LUMENS, f"        float inputs:radius = {BULB}\n")
    return meshes.stage(meshes.mirror("Mirror", REFLECTANCE), cup, bulb)


def lens() -> str:
    """A disk near the focus of a plano-convex lens."""

    def convex(u: numpy.ndarray) -> meshes.Rings:
        r = LENS_RADIUS * u
        height = numpy.sqrt(CURVE**2 - r**2)
        return r, -(PLANE + height - (CURVE - SAG)), r / CURVE, -height / CURVE

    body = meshes.joined(meshes.revolved(disk(LENS_RADIUS, -PLANE, 1.0), 1, AROUND), meshes.revolved(convex, 128, AROUND))
    chip = meshes.light("DiskLight", LUMENS, f"        float inputs:radius = {CHIP}\n")
    return meshes.stage(meshes.glass("Glass", INDEX), meshes.mesh("Lens", body, "Glass"), chip)


def cells(length: float) -> numpy.ndarray:
    """Where the lines of the dots' grid lie along a side of the plate, dots and gaps in turn."""
    middles = numpy.arange(0.5 * PITCH, length, PITCH) - 0.5 * length
    return numpy.concatenate([[-0.5 * length], numpy.stack([middles - 0.5 * DOT, middles + 0.5 * DOT], -1).ravel(), [0.5 * length]])


def guide() -> str:
    """A plate of acrylic that is lit by its edge and scatters by its dots."""
    x, y = cells(GUIDE[0]), cells(GUIDE[1])
    top, bottom = GUIDE[2], 0.0
    points = [(a, b, top) for b in y for a in x] + [(a, b, bottom) for b in (y[0], y[-1]) for a in (x[0], x[-1])]
    wide, base = len(x), len(x) * len(y)
    faces: list[list[int]] = []
    dots = []
    for j in range(len(y) - 1):
        for i in range(wide - 1):
            if i % 2 and j % 2:
                dots.append(len(faces))
            faces.append([j * wide + i, j * wide + i + 1, (j + 1) * wide + i + 1, (j + 1) * wide + i])
    first = len(faces)
    low, high = list(range(wide)), [(len(y) - 1) * wide + i for i in range(wide)]
    left, right = [j * wide for j in range(len(y))], [j * wide + wide - 1 for j in range(len(y))]
    faces.append([base, base + 2, base + 3, base + 1])
    faces += [
        [base, base + 1, *reversed(low)],
        [base + 3, base + 2, *high],
        [base + 1, base + 3, *reversed(right)],
        [base + 2, base, *left],
    ]
    body = meshes.mesh("Guide", (numpy.array(points), None, faces), "Acrylic", {"Dots": dots, "Tape": [first + 1, first + 2, first + 3]})
    strip = meshes.light(
        "RectLight",
        LUMENS,
        f"        float inputs:width = {STRIP[1]}\n        float inputs:height = {STRIP[0]}\n",
        # Its −z to +x, its height along y.
        f"matrix4d xformOp:transform = ((0, 0, 1, 0), (0, 1, 0, 0), (-1, 0, 0, 0), ({-0.5 * GUIDE[0] - GAP}, 0, {0.5 * GUIDE[2]}, 1))\n"
        '        uniform token[] xformOpOrder = ["xformOp:transform"]',
    )
    materials = meshes.glass("Acrylic", GUIDE_INDEX) + meshes.diffuse("Dots", DOT_REFLECTANCE) + meshes.mirror("Tape", EDGE_REFLECTANCE)
    return meshes.stage(materials, body, strip)


def flat(surface: meshes.Surface) -> meshes.FlatSurface:
    """Without its normals."""
    points, _, faces = surface
    return points, None, faces


def opal() -> str:
    """A chip on a white board under an opal cover."""
    dome = meshes.revolved(sphere(DOME, 1.0, 0.5 * numpy.pi, numpy.pi), 96, AROUND)
    board = meshes.revolved(disk(DOME, 0.0, -1.0), 1, AROUND)
    chip = meshes.light(
        "DiskLight",
        LUMENS,
        f"        float inputs:radius = {LED}\n",
        f'double3 xformOp:translate = (0, 0, {-LED_DEPTH})\n        uniform token[] xformOpOrder = ["xformOp:translate"]',
    )
    materials = meshes.diffuse("Opal", OPAL_REFLECTANCE, OPAL_TRANSMITTANCE) + meshes.diffuse("White", BOARD_REFLECTANCE)
    return meshes.stage(materials, meshes.mesh("Dome", flat(dome), "Opal"), meshes.mesh("Board", flat(board), "White"), chip)


def shell(screened: bool = False) -> str:
    """A point lamp in the middle of a shell of glass; with the upper half of its light caught by a black screen."""
    both = meshes.joined(meshes.revolved(sphere(OUTER, 1.0), 128, AROUND), meshes.revolved(sphere(INNER, -1.0), 128, AROUND))
    prims = [meshes.mesh("Shell", both, "Glass")]
    materials = meshes.glass("Glass", SHELL_INDEX)
    if screened:
        prims.append(meshes.mesh("Screen", flat(meshes.revolved(sphere(SCREEN, -1.0, 0.0, 0.5 * numpy.pi), 64, AROUND)), "Black"))
        materials += meshes.diffuse("Black", 0.0)
    point = meshes.light("SphereLight", LUMENS, "        bool treatAsPoint = true\n")
    return meshes.stage(materials, *prims, point)


def screened_shell() -> str:
    """The shell about a lamp with a black screen above it."""
    return shell(screened=True)


STAGES = {"reflector": reflector, "lens": lens, "guide": guide, "opal": opal, "shell": shell, "screened_shell": screened_shell}


def write(folder: Path) -> dict[str, Path]:
    """Writes all stages."""
    folder.mkdir(parents=True, exist_ok=True)
    paths = {name: folder / f"{name}.usda" for name in STAGES}
    for name, path in paths.items():
        path.write_text(STAGES[name]())
    return paths


if __name__ == "__main__":
    for path in write(Path(sys.argv[1])).values():
        print(path)
