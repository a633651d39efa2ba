"""Whether an installed gonio renders right on this machine: a lamp's illuminance against its closed form, at every SIMD level that is here.

    python smoke.py [LEVEL ...]

Needs gonio alone, no other package. With level names, each of them must be there.
"""

import math
import os
import subprocess
import sys
from array import array

LEVELS = ("avx512", "avx2", "sse4.2", "neon", "scalar")
# Illuminance under a sphere of 0.1 m and 1000 cd/m² at 2 m: π L (r / d)².
UNDER_LAMP = math.pi * 1000 * (0.1 / 2) ** 2


def rows(kind: str, values: list[float], width: int) -> memoryview:
    """Numbers as rows, as NumPy would lay them out."""
    return memoryview(array(kind, values)).cast("B").cast(kind, shape=[len(values) // width, width])


def check() -> None:
    """At the level that the environment names."""
    import gonio

    wanted = os.environ["GONIO_SIMD"]
    if gonio.simd_level != wanted:
        print(f"{wanted}: not on this machine")
        raise SystemExit(3)
    scene = gonio.Scene()
    scene.set(width=32, height=32, samples=4, passes=["color", "illuminance"])
    floor = scene.add_mesh(rows("f", [-5, 0, 5, 5, 0, 5, 5, 0, -5, -5, 0, -5], 3), rows("i", [0, 1, 2, 0, 2, 3], 3), name="floor")
    grey = scene.add_material("grey", base_color=(0.5, 0.5, 0.5), specular_weight=0.0)
    scene.add_instance(floor, [grey], name="floor")
    lamp = [[1, 0, 0, 0], [0, 1, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1]]
    scene.add_light("sphere", (1000.0, 1000.0, 1000.0), radius=0.1, transform=lamp, name="lamp")
    scene.add_camera([[1, 0, 0, 0], [0, 0, 1, 1], [0, -1, 0, 0], [0, 0, 0, 1]], fov=4)
    scene.add_meter((0, 0, 0), normal=(0, 1, 0))
    measured = gonio.measure(scene).meters[0].value
    with gonio.Render(scene) as render:
        finished = render.wait()
        colour = memoryview(render.film()["color"])
    green = colour.cast("B").cast("f")[1 :: colour.shape[2]].tolist()
    radiance = sum(green) / len(green)
    expected = 0.5 * UNDER_LAMP / math.pi
    print(f"{wanted}: {measured:.4f} lx of {UNDER_LAMP:.4f} lx, floor {radiance:.4f} cd/m² of {expected:.4f} cd/m²")
    if not finished or abs(measured / UNDER_LAMP - 1) > 2e-3 or abs(radiance / expected - 1) > 0.01:
        raise SystemExit(1)


def main() -> None:
    asked = sys.argv[1:]
    found = []
    for level in asked or LEVELS:
        environment = {**os.environ, "GONIO_SIMD": level, "GONIO_SMOKE": "1"}
        code = subprocess.run([sys.executable, __file__], check=False, env=environment).returncode
        if code not in (0, 3) or (asked and code):
            raise SystemExit(code)
        found += [level] if code == 0 else []
    print(f"{len(found)} levels: {', '.join(found)}")
    raise SystemExit(0 if len(found) > 1 or asked else 1)


if __name__ == "__main__":
    check() if "GONIO_SMOKE" in os.environ else main()
