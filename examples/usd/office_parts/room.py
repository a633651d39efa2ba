"""Walls, floor, window, luminaires, radiator, door. The room is 4.5 m wide (x), 6 m deep (z from -6 to 0) and 2.8 m high."""

import numpy
from pxr import Gf, Usd, UsdLux

from .asset import Asset
from .shapes import sheet, tube
from .textures import VIEW_CORNER, VIEW_HEIGHT, VIEW_WIDTH

LEFT, RIGHT, BACK, FRONT, HEIGHT = -2.25, 2.25, -6.0, 0.0, 2.8
# The opening in the left wall.
SILL, HEAD, WINDOW_FAR, WINDOW_NEAR = 0.86, 2.42, -5.3, -1.5
MODULE = 0.6
PANELS = [(-0.75, -1.8), (0.45, -1.8), (-0.75, -4.2), (0.45, -4.2)]


def build(stage: Usd.Stage, images: str) -> None:
    """Writes the room and its lights."""
    walls(stage, images)
    window(stage, images)
    ceiling(stage, images)
    radiator(stage, images)
    door(stage, images)
    daylight(stage, images)


def walls(stage: Usd.Stage, images: str) -> None:
    """Thick walls, so that no light gets in at the joints."""
    room = Asset(stage, "/Office/Room/Walls", images)
    outside = LEFT - 0.33
    room.add("Planks", sheet((RIGHT, 0, FRONT), (0, 0, BACK - FRONT), (LEFT - RIGHT, 0, 0), in_metres=True))
    room.span("WallPaint", (outside, -0.3, BACK - 0.3), (RIGHT + 0.3, -0.01, FRONT + 0.3))
    room.span("WallPaint", (outside, HEIGHT + 0.01, BACK - 0.3), (RIGHT + 0.3, HEIGHT + 0.3, FRONT + 0.3))
    room.span("AccentPaint", (outside, -0.2, BACK - 0.3), (RIGHT + 0.3, HEIGHT + 0.2, BACK), 0.0005)
    room.span("WallPaint", (outside, -0.2, FRONT), (RIGHT + 0.3, HEIGHT + 0.2, FRONT + 0.3), 0.0005)
    room.span("WallPaint", (RIGHT, -0.2, BACK - 0.1), (RIGHT + 0.3, HEIGHT + 0.2, FRONT + 0.1), 0.0005)
    for low, high in (
        ((outside, -0.2, BACK - 0.1), (LEFT, SILL, FRONT + 0.1)),
        ((outside, HEAD, BACK - 0.1), (LEFT, HEIGHT + 0.2, FRONT + 0.1)),
        ((outside, SILL - 0.01, BACK - 0.1), (LEFT, HEAD + 0.01, WINDOW_FAR)),
        ((outside, SILL - 0.01, WINDOW_NEAR), (LEFT, HEAD + 0.01, FRONT + 0.1)),
    ):
        room.span("WallPaint", low, high, 0.004)
    board, thickness = 0.08, 0.014
    room.span("WhiteLacquer", (LEFT, 0, BACK), (RIGHT, board, BACK + thickness))
    room.span("WhiteLacquer", (LEFT, 0, FRONT - thickness), (RIGHT, board, FRONT))
    room.span("WhiteLacquer", (LEFT, 0, BACK), (LEFT + thickness, board, FRONT))
    room.span("WhiteLacquer", (RIGHT - thickness, 0, BACK), (RIGHT, board, FRONT))
    room.write()


def window(stage: Usd.Stage, images: str) -> None:
    """Three casements in a dark frame, with a stone sill."""
    frame = Asset(stage, "/Office/Room/Window", images)
    middle, depth, bar = LEFT - 0.2, 0.07, 0.06
    for low, high in ((SILL, SILL + bar), (HEAD - bar, HEAD)):
        frame.span("WindowFrame", (middle - depth / 2, low, WINDOW_FAR), (middle + depth / 2, high, WINDOW_NEAR))
    stops = numpy.linspace(WINDOW_FAR, WINDOW_NEAR, 4)
    for stop in stops:
        centre = min(max(stop, WINDOW_FAR + bar / 2), WINDOW_NEAR - bar / 2)
        frame.span("WindowFrame", (middle - depth / 2, SILL, centre - bar / 2), (middle + depth / 2, HEAD, centre + bar / 2))
    for low, high in zip(stops, stops[1:]):
        casement(frame, middle + 0.03, low + bar * 0.7, high - bar * 0.7)
    frame.span("Stone", (LEFT - 0.17, SILL - 0.01, WINDOW_FAR + 0.001), (LEFT + 0.001, SILL + 0.02, WINDOW_NEAR - 0.001), 0.001)
    frame.span("Stone", (LEFT - 0.001, SILL - 0.01, WINDOW_FAR - 0.05), (LEFT + 0.14, SILL + 0.02, WINDOW_NEAR + 0.05), 0.005)
    frame.write()


def casement(frame: Asset, x: float, low: float, high: float) -> None:
    """A sash with its handle."""
    bottom, top, bar, depth = SILL + 0.045, HEAD - 0.045, 0.055, 0.06
    for y in (bottom, top - bar):
        frame.span("WindowFrame", (x - depth / 2, y, low), (x + depth / 2, y + bar, high), 0.006)
    for z in (low, high - bar):
        frame.span("WindowFrame", (x - depth / 2, bottom, z), (x + depth / 2, top, z + bar), 0.006)
    y, z, front = (bottom + top) / 2, high - bar / 2, x + depth / 2
    frame.span("Steel", (front, y - 0.035, z - 0.012), (front + 0.01, y + 0.035, z + 0.012))
    frame.add("Steel", tube([(front, y, z), (front + 0.03, y, z), (front + 0.042, y - 0.02, z), (front + 0.042, y - 0.12, z)], 0.008))


def ceiling(stage: Usd.Stage, images: str) -> None:
    """Mineral fibre tiles in a metal grid, and four luminous panels of 3200 cd/m² and 4000 K in it."""
    grid = Asset(stage, "/Office/Room/Ceiling", images)
    grid.add("Ceiling", sheet((LEFT, HEIGHT, BACK), (RIGHT - LEFT, 0, 0), (0, 0, FRONT - BACK), in_metres=True))
    rail, drop = 0.024, 0.006
    for x in numpy.arange(LEFT + 0.15, RIGHT, MODULE):
        grid.span("WhiteMetal", (x - rail / 2, HEIGHT - drop, BACK), (x + rail / 2, HEIGHT + 0.001, FRONT), 0.002)
    for z in numpy.arange(BACK + MODULE, FRONT, MODULE):
        grid.span("WhiteMetal", (LEFT, HEIGHT - drop, z - rail / 2), (RIGHT, HEIGHT + 0.001, z + rail / 2), 0.002)
    for n, (x, z) in enumerate(PANELS):
        centre_x, centre_z = (
            LEFT + 0.15 + MODULE * (round((x - LEFT - 0.45) / MODULE) + 0.5),
            BACK + MODULE * (round((z - BACK - 0.3) / MODULE) + 0.5),
        )
        light = UsdLux.RectLight.Define(stage, f"/Office/Lights/Panel{n}")
        light.AddTranslateOp().Set(Gf.Vec3d(centre_x, HEIGHT - 0.003, centre_z))
        light.AddRotateXOp().Set(-90.0)
        light.CreateWidthAttr(MODULE - rail)
        light.CreateHeightAttr(MODULE - rail)
        light.CreateIntensityAttr(3200.0)
        light.CreateEnableColorTemperatureAttr(True)
        light.CreateColorTemperatureAttr(4000.0)
    grid.write()


def radiator(stage: Usd.Stage, images: str) -> None:
    """A panel radiator under the window."""
    body = Asset(stage, "/Office/Room/Radiator", images)
    low, high, x = -4.9, -3.1, LEFT + 0.045
    body.span("WhiteLacquer", (x, 0.14, low), (x + 0.07, 0.70, high), 0.01)
    for z in numpy.arange(low + 0.04, high - 0.02, 0.04):
        body.span("WhiteLacquer", (x + 0.068, 0.17, z), (x + 0.078, 0.67, z + 0.026), 0.004)
    for z in (low + 0.2, high - 0.2):
        body.span("WhiteLacquer", (LEFT, 0.3, z), (x + 0.01, 0.34, z + 0.04))
    body.add("Chrome", tube([(x + 0.035, 0.18, high), (x + 0.035, 0.18, high + 0.06), (x + 0.035, 0.0, high + 0.06)], 0.009))
    body.write()


def door(stage: Usd.Stage, images: str) -> None:
    """An oak door in the right wall."""
    leaf = Asset(stage, "/Office/Room/Door", images)
    low, high, top, x = -3.25, -2.35, 2.05, RIGHT
    leaf.span("Oak", (x - 0.012, 0.008, low), (x + 0.02, top, high), 0.003)
    for z in (low - 0.075, high + 0.005):
        leaf.span("WhiteLacquer", (x - 0.024, 0, z), (x + 0.02, top + 0.075, z + 0.07), 0.004)
    leaf.span("WhiteLacquer", (x - 0.024, top + 0.005, low - 0.074), (x + 0.02, top + 0.0745, high + 0.074), 0.004)
    y, z = 1.03, high - 0.07
    leaf.span("Steel", (x - 0.02, y - 0.09, z - 0.02), (x - 0.01, y + 0.07, z + 0.02))
    leaf.add("Steel", tube([(x - 0.018, y, z), (x - 0.06, y, z), (x - 0.072, y, z - 0.02), (x - 0.072, y, z - 0.13)], 0.01))
    leaf.write()


def daylight(stage: Usd.Stage, images: str) -> None:
    """Daylight as a luminous picture of the view, in cd/m², before the window's opening."""
    sky = UsdLux.DomeLight.Define(stage, "/Office/Lights/Sky")
    # The rest of the sky, dim behind the tinted glazing: what the picture of the view does not cover.
    sky.CreateIntensityAttr(250.0)
    sky.CreateColorAttr((0.82, 0.92, 1.0))
    light = UsdLux.RectLight.Define(stage, "/Office/Lights/Daylight")
    x, y, z = VIEW_CORNER
    light.AddTranslateOp().Set(Gf.Vec3d(x, y + VIEW_HEIGHT / 2, z - VIEW_WIDTH / 2))
    light.AddRotateYOp().Set(-90.0)
    light.CreateWidthAttr(VIEW_WIDTH)
    light.CreateHeightAttr(VIEW_HEIGHT)
    light.CreateTextureFileAttr(f"{images}/view.hdr")
