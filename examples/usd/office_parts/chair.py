"""An office chair, one layer that the stage instances."""

from pathlib import Path

import numpy
from pxr import Usd, UsdGeom

from .asset import Asset
from .shapes import box, cushion, lathe, rotation, translation, tube


def write(path: Path) -> None:
    """Writes the layer; the chair faces -z."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    made = Asset(stage, "/Chair", "./textures", "/Chair/Materials")
    stage.SetDefaultPrim(made.xform.GetPrim())
    base(made)
    made.add("Cloth", cushion((0.50, 0.085, 0.49), 0.035, seat), translation(0, 0.455, -0.01))
    made.box("BlackPlastic", (0, 0.405, 0), (0.40, 0.025, 0.38), 0.008)
    made.add("Cloth", cushion((0.46, 0.56, 0.06), 0.025, back), translation(0, 0.80, 0.235) @ rotation("x", 8))
    made.add("BlackPlastic", cushion((0.36, 0.44, 0.02), 0.008, back), translation(0, 0.79, 0.272) @ rotation("x", 8))
    made.add("BlackPlastic", tube([(0, 0.40, 0.12), (0, 0.395, 0.24), (0, 0.46, 0.315), (0, 0.62, 0.30), (0, 0.78, 0.305)], 0.02))
    for side in (-1, 1):
        x = 0.265 * side
        made.add(
            "BlackPlastic", tube([(0.17 * side, 0.405, 0.02), (x, 0.41, 0.02), (x + 0.012 * side, 0.50, 0.02), (x, 0.655, 0.02)], 0.015)
        )
        made.add("BlackPlastic", cushion((0.075, 0.03, 0.25), 0.012), translation(x, 0.665, -0.02))
    made.write()
    stage.GetRootLayer().Save()


def seat(points: numpy.ndarray) -> numpy.ndarray:
    """A dished cushion with a front edge that falls, narrower at the back."""
    x, y, z = points.T
    width = 1 - 0.12 * (z > 0.1)
    return numpy.stack([x * width, y - 0.25 * (0.06 - x * x) - 0.9 * numpy.clip(-z - 0.12, 0, 1) ** 2 + 0.005, z], axis=1)


def back(points: numpy.ndarray) -> numpy.ndarray:
    """A back rest bent about the body and towards the loins, narrower at the top."""
    x, y, z = points.T
    width = 1 - 0.16 * numpy.clip(y + 0.05, 0, 1) / 0.3
    return numpy.stack([x * width, y, z - 0.9 * x * x - 0.035 * numpy.cos((y + 0.12) * 6)], axis=1)


def base(made: Asset) -> None:
    """Gas spring and a star of five arms on castors."""
    made.add("Chrome", lathe([(0, 0.20), (0.016, 0.20), (0.016, 0.40), (0, 0.40)], 12))
    made.add("BlackPlastic", lathe([(0, 0.08), (0.03, 0.08), (0.033, 0.085), (0.028, 0.26), (0.026, 0.265), (0, 0.265)], 12))
    made.box("BlackPlastic", (0, 0.385, 0.02), (0.16, 0.04, 0.2), 0.01)
    for n in range(5):
        turn = rotation("y", 72 * n + 18)
        arm = tube([(0.02, 0.10, 0), (0.16, 0.095, 0), (0.31, 0.072, 0)], 0.022, end_radius=0.013)
        made.add("Chrome", arm, turn)
        made.add("BlackPlastic", tube([(0.30, 0.07, 0), (0.30, 0.045, 0)], 0.007), turn)
        wheel = lathe([(0, -0.012), (0.022, -0.012), (0.027, -0.009), (0.027, 0.009), (0.022, 0.012), (0, 0.012)], 12)
        for side in (-0.014, 0.014):
            made.add("BlackPlastic", wheel, turn @ translation(0.30, 0.027, side) @ rotation("x", 90))
        made.add("BlackPlastic", box((0.30, 0.052, 0), (0.03, 0.012, 0.03), 0.005), turn)
