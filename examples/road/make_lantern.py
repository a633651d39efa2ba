"""Writes `lantern.ldt` beside this script: a made-up street lantern of 5200 lm and 45 W, two wings along the road and some light below."""

import math
import pathlib

FLUX, WATTS = 5200.0, 45.0
PLANES, GAMMAS = 24, [2.5 * i for i in range(37)]
# EULUMDAT's symmetry 3 stores the planes from C270 through C0 to C90; the others are their mirror images.
STORED = [(270 + 15 * i) % 360 for i in range(13)]


def shape(c: float, gamma: float) -> float:
    """Intensity in units of its own: C90 faces the carriageway, wings point a little towards it."""
    if gamma > 85:
        return 0.0
    c, g = math.radians(c), math.radians(gamma)
    across = math.sin(c)
    wings = math.exp(-(((gamma - 63) / 17) ** 2) - ((across - 0.2) / 0.34) ** 2)
    below = 0.22 * math.exp(-((gamma / 58) ** 2)) * (1 + 0.75 * math.sin(g) * across)
    return (wings + below) * min(1.0, (85 - gamma) / 12)


def flux() -> float:
    """Lumens of `shape`, by the midpoint rule."""
    step = 1.0
    cells = ((c + 0.5, (i + 0.5) * step) for c in range(360) for i in range(int(90 / step)))
    return sum(shape(c, gamma) * math.sin(math.radians(gamma)) for c, gamma in cells) * math.radians(1) * math.radians(step)


def main() -> None:
    head = ["gonio", 2, 3, PLANES, 15, len(GAMMAS), 2.5, "made up", "Lantern", "L-1", "lantern.ldt", "-"]
    body = [620, 280, 110, 300, 180, 0, 0, 0, 0, 100, 100, 1, 0]
    lamps = [1, 1, "LED", FLUX, "3000 K", 70, WATTS]
    per_kilolumen = 1000 / flux()
    candela = [round(shape(c, gamma) * per_kilolumen, 2) for c in STORED for gamma in GAMMAS]
    values = [*head, *body, *lamps, *["0"] * 10, *(15 * i for i in range(PLANES)), *GAMMAS, *candela]
    path = pathlib.Path(__file__).with_name("lantern.ldt")
    path.write_text("\r\n".join(str(value) for value in values) + "\r\n", "latin-1", newline="")


if __name__ == "__main__":
    main()
