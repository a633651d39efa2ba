"""Desks and what stands on them: monitors, keyboards, lamp, mugs, papers."""

import numpy
from pxr import Gf, Usd, UsdGeom, UsdLux

from .asset import Asset, bind, write_mesh
from .shapes import box, cushion, lathe, rotation, sheet, translation, tube

TOP = 0.74
# Centres of the two desks, which stand back to back.
DESKS = [(-0.55, -2.95), (-0.55, -3.77)]


def build(stage: Usd.Stage, images: str) -> None:
    """Writes both work places."""
    for n, (x, z) in enumerate(DESKS):
        turn = 180.0 * n
        desk(stage, f"/Office/Furniture/Desk{n}", images).place(x, 0, z, turn).write()
        screen = "ScreenDiagram" if n == 0 else "ScreenText"
        monitor(stage, f"/Office/Furniture/Monitor{n}A", images, screen).place(
            x - 0.33 * (1 - 2 * n), TOP, z - 0.2 * (1 - 2 * n), turn + 9
        ).write()
        other = "ScreenText" if n == 0 else "ScreenDiagram"
        monitor(stage, f"/Office/Furniture/Monitor{n}B", images, other).place(
            x + 0.33 * (1 - 2 * n), TOP, z - 0.2 * (1 - 2 * n), turn - 9
        ).write()
        keyboard(stage, f"/Office/Furniture/Keyboard{n}", images, x, z + 0.16 * (1 - 2 * n), turn)
        mouse(stage, f"/Office/Furniture/Mouse{n}", images).place(x + 0.34 * (1 - 2 * n), TOP, z + 0.17 * (1 - 2 * n), turn + 8).write()
    mug(stage, "/Office/Furniture/MugA", images, "CeramicOrange").place(0.15, TOP, -2.93, 250).write()
    mug(stage, "/Office/Furniture/MugB", images, "CeramicWhite").place(-1.0, TOP, -4.0, 60).write()
    papers(stage, images)
    pencils(stage, images)
    lamp(stage, images)


def desk(stage: Usd.Stage, path: str, images: str) -> Asset:
    """A walnut top of 1.6 m x 0.8 m on steel frames, with a drawer unit; the user sits at +z."""
    made = Asset(stage, path, images)
    made.box("Walnut", (0, TOP - 0.0125, 0), (1.6, 0.025, 0.8), 0.004)
    for x in (-0.72, 0.72):
        for z in (-0.34, 0.34):
            made.box("BlackMetal", (x, 0.355, z), (0.05, 0.71, 0.05), 0.004)
        for y in (0.03, 0.69):
            made.box("BlackMetal", (x, y, 0), (0.048, 0.045, 0.64), 0.004)
    made.box("BlackMetal", (0, 0.67, -0.28), (1.40, 0.06, 0.03), 0.004)
    made.box("GreyPlastic", (0, 0.62, -0.2), (1.1, 0.012, 0.16))
    x = 0.47
    made.box("WhiteLacquer", (x, 0.33, 0.0), (0.40, 0.58, 0.58), 0.004)
    for y, height in ((0.155, 0.22), (0.38, 0.21), (0.555, 0.12)):
        made.box("WhiteLacquer", (x, y, 0.297), (0.392, height, 0.02), 0.003)
        made.box("Steel", (x, y + height / 2 - 0.035, 0.315), (0.14, 0.01, 0.018), 0.003)
    for wheel_x in (-0.16, 0.16):
        for z in (-0.24, 0.24):
            made.box("BlackPlastic", (x + wheel_x, 0.02, z), (0.025, 0.04, 0.04), 0.008)
    return made


def monitor(stage: Usd.Stage, path: str, images: str, screen: str) -> Asset:
    """A 27-inch screen that faces +z."""
    made = Asset(stage, path, images)
    tilt = translation(0, 0.34, 0.0) @ rotation("x", -4)
    made.add("BlackPlastic", box((0, 0, 0), (0.616, 0.364, 0.022), 0.005), tilt)
    made.add("BlackPlastic", cushion((0.36, 0.22, 0.05), 0.02), tilt @ translation(0, -0.02, -0.018))
    made.add(screen, sheet((-0.30, -0.172, 0.0114), (0.60, 0, 0), (0, 0.3465, 0)), tilt)
    made.box("Aluminium", (0, 0.21, -0.05), (0.06, 0.40, 0.016), 0.004)
    made.box("Aluminium", (0, 0.005, -0.03), (0.24, 0.01, 0.2), 0.004)
    made.add("Aluminium", box((0, 0, 0), (0.05, 0.05, 0.04), 0.004), translation(0, 0.34, -0.04))
    return made


def keyboard(stage: Usd.Stage, path: str, images: str, x: float, z: float, turn: float) -> None:
    """A flat keyboard with its keys as point instances."""
    made = Asset(stage, path, images).place(x, TOP, z, turn)
    made.box("Aluminium", (0, 0.006, 0), (0.43, 0.012, 0.125), 0.004)
    made.write()
    keys = UsdGeom.PointInstancer.Define(stage, f"{path}/Keys")
    key = UsdGeom.Mesh.Define(stage, f"{path}/Keys/Prototypes/Key")
    write_mesh(key, [box((0, 0, 0), (0.0165, 0.006, 0.0165), 0.002)], False)
    bind(stage, key.GetPrim(), "/Office/Materials", "LightKey", images)
    places, scales = [], []
    for row in range(5):
        for column in range(21):
            if column in (14, 17):
                continue
            is_bar = row == 4 and 4 <= column <= 8
            if is_bar and column != 6:
                continue
            places.append(Gf.Vec3f(-0.2 + 0.02 * column, 0.0145, -0.045 + 0.0225 * row))
            scales.append(Gf.Vec3f(6.0 if is_bar else 1.0, 1, 1.15))
    keys.CreatePrototypesRel().SetTargets([key.GetPath()])
    keys.CreateProtoIndicesAttr([0] * len(places))
    keys.CreatePositionsAttr(places)
    keys.CreateScalesAttr(scales)


def mouse(stage: Usd.Stage, path: str, images: str) -> Asset:
    """A mouse as a rounded box, low at its front."""
    made = Asset(stage, path, images)

    def shape(points: numpy.ndarray) -> numpy.ndarray:
        lowered = points + [0, 0.018, 0]
        lowered[:, 1] *= 1 + 3.5 * points[:, 2] * (points[:, 1] > 0)
        return lowered

    made.add("LightKey", cushion((0.062, 0.036, 0.108), 0.014, shape))
    return made


def mug(stage: Usd.Stage, path: str, images: str, material: str) -> Asset:
    """A mug of 8.5 cm with a handle at +x and coffee in it."""
    made = Asset(stage, path, images)
    outside = [(0, 0.0), (0.034, 0.0), (0.038, 0.002), (0.041, 0.012), (0.0415, 0.05), (0.0415, 0.092), (0.0405, 0.095), (0.0385, 0.094)]
    inside = [(0.038, 0.09), (0.038, 0.05), (0.0375, 0.014), (0.033, 0.007), (0, 0.007)]
    made.add(material, lathe(outside + inside))
    made.add(material, tube([(0.038, 0.076, 0), (0.062, 0.078, 0), (0.072, 0.052, 0), (0.062, 0.026, 0), (0.038, 0.024, 0)], 0.0055))
    made.add("Coffee", lathe([(0, 0.076), (0.038, 0.076), (0.0381, 0.0768), (0.03, 0.077), (0, 0.077)]))
    return made


def papers(stage: Usd.Stage, images: str) -> None:
    """Sheets, notebooks and a tray."""
    made = Asset(stage, "/Office/Furniture/Papers", images)
    for n, turn in enumerate((4, -3, 9, 1)):
        made.box("Paper", (0.03 + 0.006 * n, TOP + 0.001 + 0.0018 * n, -2.72 + 0.004 * n), (0.21, 0.0016, 0.297), 0.0002, turn)
    made.box("CeramicBlue", (-1.14, TOP + 0.008, -3.02), (0.15, 0.016, 0.21), 0.003, 12)
    made.box("Paper", (-1.139, TOP + 0.008, -3.021), (0.148, 0.012, 0.212), 0.0005, 12)
    made.box("CeramicOrange", (-1.145, TOP + 0.022, -3.03), (0.13, 0.012, 0.19), 0.003, -6)
    for n, turn in enumerate((-8, 3)):
        made.box("Paper", (-0.15, TOP + 0.001 + 0.0018 * n, -4.05), (0.21, 0.0016, 0.297), 0.0002, turn)
    made.write()


def pencils(stage: Usd.Stage, images: str) -> None:
    """A cup with pencils."""
    made = Asset(stage, "/Office/Furniture/Pencils", images).place(-1.24, TOP, -3.2)
    made.add(
        "BlackMetal",
        lathe(
            [
                (0, 0),
                (0.034, 0),
                (0.036, 0.002),
                (0.036, 0.05),
                (0.036, 0.098),
                (0.035, 0.1),
                (0.034, 0.098),
                (0.034, 0.05),
                (0.033, 0.004),
                (0, 0.004),
            ]
        ),
    )
    for n, material in enumerate(("Oak", "CeramicOrange", "CeramicBlue", "Oak", "Steel")):
        angle = n * 1.3
        foot = (0.02 * numpy.cos(angle + 2.5), 0.006, 0.02 * numpy.sin(angle + 2.5))
        tip = (0.03 * numpy.cos(angle), 0.155 + 0.008 * n, 0.03 * numpy.sin(angle))
        made.add(material, tube([foot, tip], 0.0036, 6))
    made.write()


def lamp(stage: Usd.Stage, images: str) -> None:
    """A task lamp with a bulb of 2700 K and 300 lm in a shade that is white inside."""
    path = "/Office/Furniture/TaskLamp"
    made = Asset(stage, path, images).place(0.12, TOP, -3.2, 208)
    elbow, head = (-0.10, 0.36, 0), (0.20, 0.50, 0)
    made.add(
        "BlackMetal",
        lathe(
            [(0, 0), (0.085, 0), (0.09, 0.003), (0.09, 0.016), (0.086, 0.02), (0.02, 0.022), (0.014, 0.03), (0.012, 0.05), (0, 0.052)], 24
        ),
    )
    made.add("Brass", tube([(0, 0.03, 0), (-0.05, 0.195, 0), elbow], 0.007))
    made.add("Brass", tube([elbow, (0.05, 0.43, 0), head], 0.007))
    for place in (elbow, head):
        made.add("BlackMetal", cushion((0.026, 0.026, 0.03), 0.006), translation(*place))
    tilt = translation(*head) @ rotation("z", 12)
    outside = [(0, 0.035), (0.016, 0.035), (0.026, 0.03), (0.028, 0.0), (0.034, -0.02), (0.06, -0.06), (0.082, -0.115), (0.0835, -0.12)]
    inside = [(0.0825, -0.1205), (0.08, -0.115), (0.058, -0.06), (0.032, -0.022), (0.02, -0.012), (0, -0.012)]
    made.add("LampShade", lathe(outside[::-1], 24), tilt)
    made.add("LampInside", lathe([outside[-1], *inside][::-1], 24), tilt)
    made.write()
    bulb = UsdLux.SphereLight.Define(stage, f"{path}/Bulb")
    bulb.AddTranslateOp().Set(Gf.Vec3d(*(tilt @ [0, -0.068, 0, 1])[:3].tolist()))
    radius, lumens = 0.026, 300.0
    bulb.CreateRadiusAttr(radius)
    bulb.CreateIntensityAttr(round(lumens / (4 * numpy.pi**2 * radius**2), 1))
    bulb.CreateEnableColorTemperatureAttr(True)
    bulb.CreateColorTemperatureAttr(2700.0)
