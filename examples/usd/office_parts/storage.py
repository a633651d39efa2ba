"""Book shelf with its books, sideboard, picture, clock, basket."""

import numpy
from pxr import Gf, Sdf, Usd, UsdGeom

from .asset import Asset, bind, write_mesh
from .furniture import mug
from .room import BACK, RIGHT
from .shapes import box, lathe, rotation, sheet, translation

# Left, right, top and depth of the book shelf at the back wall.
SHELF = (0.62, 1.92, 2.05, 0.32)
LEVELS = [0.06, 0.45, 0.84, 1.23, 1.62]
COVERS = [
    (0.42, 0.08, 0.05),
    (0.05, 0.12, 0.22),
    (0.62, 0.56, 0.44),
    (0.10, 0.20, 0.14),
    (0.55, 0.30, 0.06),
    (0.70, 0.68, 0.64),
    (0.05, 0.05, 0.055),
    (0.30, 0.36, 0.40),
    (0.32, 0.06, 0.11),
]


def build(stage: Usd.Stage, images: str) -> None:
    """Writes all of it."""
    shelf(stage, images)
    books(stage, images)
    sideboard(stage, images)
    picture(stage, images)
    clock(stage, images)
    basket(stage, images)
    pouf(stage, images)


def shelf(stage: Usd.Stage, images: str) -> None:
    """An open oak shelf."""
    made = Asset(stage, "/Office/Furniture/Shelf", images)
    left, right, top, depth = SHELF
    front = BACK + 0.02 + depth
    for x in (left, right - 0.025):
        made.span("Oak", (x, 0, BACK + 0.02), (x + 0.025, top, front))
    for y in [*LEVELS, top]:
        made.span("Oak", (left + 0.0245, y - 0.025, BACK + 0.022), (right - 0.0245, y, front - 0.002))
    made.span("Oak", (left + 0.02, 0.05, BACK + 0.017), (right - 0.02, top - 0.01, BACK + 0.026))
    # Ornaments in the gaps that the books leave.
    made.add(
        "CeramicWhite",
        lathe(
            [
                (0, 0),
                (0.035, 0),
                (0.055, 0.03),
                (0.075, 0.09),
                (0.06, 0.16),
                (0.022, 0.20),
                (0.02, 0.25),
                (0.026, 0.262),
                (0.022, 0.262),
                (0.016, 0.25),
                (0, 0.2),
            ],
            24,
        ),
        translation(1.72, LEVELS[3], BACK + 0.19),
    )
    made.add(
        "Brass",
        lathe(
            [
                (0, 0),
                (0.05, 0),
                (0.052, 0.004),
                (0.014, 0.02),
                (0.012, 0.10),
                (0.03, 0.13),
                (0.09, 0.155),
                (0.092, 0.16),
                (0.028, 0.14),
                (0, 0.135),
            ],
            24,
        ),
        translation(0.80, LEVELS[2], BACK + 0.19),
    )
    for n, (width, height) in enumerate(((0.30, 0.28), (0.30, 0.28))):
        made.span(
            "Concrete", (1.24 + 0.325 * n, LEVELS[0], BACK + 0.04), (1.24 + 0.325 * n + width, LEVELS[0] + height, BACK + 0.31), 0.006
        )
        made.box("Steel", (1.24 + 0.325 * n + width / 2, LEVELS[0] + 0.2, BACK + 0.312), (0.05, 0.03, 0.006), 0.002)
    made.write()


def books(stage: Usd.Stage, images: str) -> None:
    """Rows of books as point instances: one prototype for covers that take the instance's colour, with its pages."""
    instancer = UsdGeom.PointInstancer.Define(stage, "/Office/Furniture/Books")
    prototypes = []
    for n, band in enumerate((0.0, 0.14)):
        path = f"/Office/Furniture/Books/Prototypes/Book{n}"
        prototypes.append(UsdGeom.Xform.Define(stage, path).GetPath())
        covers = [box((x, 0.5, 0), (0.09, 1, 1), 0.01) for x in (-0.455, 0.455)] + [box((0, 0.5, 0.47), (1, 1, 0.06), 0.02)]
        parts = [("Cover", covers), ("Paper", [box((0, 0.5, -0.02), (0.84, 0.965, 0.94), 0.002)])]
        if band:
            parts.append(("Brass", [box((0, 0.78, 0.5), (0.8, band, 0.004), 0.001), box((0, 0.2, 0.5), (0.8, 0.02, 0.004), 0.001)]))
        for material, pieces in parts:
            mesh = UsdGeom.Mesh.Define(stage, f"{path}/{material}")
            write_mesh(mesh, pieces, False)
            bind(stage, mesh.GetPrim(), "/Office/Materials", material, images)
    places, turns, scales, kinds, colours = rows_of_books()
    instancer.CreatePrototypesRel().SetTargets(prototypes)
    instancer.CreateProtoIndicesAttr(kinds)
    instancer.CreatePositionsAttr(places)
    instancer.CreateOrientationsAttr(turns)
    instancer.CreateScalesAttr(scales)
    UsdGeom.PrimvarsAPI(instancer).CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray, UsdGeom.Tokens.vertex).Set(colours)


def rows_of_books() -> tuple[list, list, list, list, list]:
    """Positions, orientations, scales, prototypes and colours; the last book of a row leans on its neighbour."""
    random = numpy.random.default_rng(21)
    places, turns, scales, kinds, colours = [], [], [], [], []
    left, right = SHELF[0] + 0.03, SHELF[1] - 0.03
    rows = [
        (LEVELS[0], left, left + 0.52),
        (LEVELS[1], left, right - 0.28),
        (LEVELS[2], left + 0.34, right),
        (LEVELS[3], left, right - 0.42),
        (LEVELS[4], left + 0.1, right - 0.1),
    ]
    for level, start, end in rows:
        x = start
        while x < end - 0.06:
            width, height, depth = 0.018 + 0.03 * random.random(), 0.20 + 0.10 * random.random(), 0.15 + 0.06 * random.random()
            is_last = x + width + 0.05 > end - 0.06
            lean = 9.0 if is_last else 0.0
            sine = float(numpy.sin(numpy.radians(lean)))
            shift = height * sine + 0.003 if is_last else 0.0
            places.append(
                Gf.Vec3f(
                    round(x + width / 2 + shift, 4),
                    round(level + width / 2 * sine + 0.0005, 4),
                    round(BACK + 0.30 - depth / 2 - 0.02 * random.random(), 4),
                )
            )
            turns.append(Gf.Quath(Gf.Rotation(Gf.Vec3d(0, 0, 1), lean).GetQuat()))
            scales.append(Gf.Vec3f(*(round(size, 4) for size in (width, height, depth))))
            kinds.append(int(random.random() < 0.35))
            colours.append(Gf.Vec3f(*COVERS[int(random.integers(len(COVERS)))]))
            x += width + 0.0015
    return places, turns, scales, kinds, colours


def sideboard(stage: Usd.Stage, images: str) -> None:
    """A low cabinet at the right wall, with a vase of thin glass, a bowl and a mug."""
    made = Asset(stage, "/Office/Furniture/Sideboard", images)
    low, high, front, top = -5.35, -3.75, RIGHT - 0.45, 0.72
    made.span("WhiteLacquer", (front + 0.02, 0.12, low + 0.002), (RIGHT - 0.02, top - 0.0245, high - 0.002), 0.004)
    made.span("Walnut", (front - 0.01, top - 0.025, low - 0.01), (RIGHT - 0.018, top, high + 0.01), 0.004)
    edges = numpy.linspace(low, high, 4)
    for a, b in zip(edges, edges[1:]):
        made.span("WhiteLacquer", (front, 0.125, a + 0.004), (front + 0.02, top - 0.03, b - 0.004), 0.003)
        made.span("Brass", (front - 0.015, 0.52, b - 0.06), (front + 0.001, 0.64, b - 0.048), 0.003)
    for x in (front + 0.06, RIGHT - 0.08):
        for z in (low + 0.08, high - 0.08):
            made.box("BlackMetal", (x, 0.06, z), (0.03, 0.125, 0.03), 0.004)
    vase = [(0.0, 0.006), (0.045, 0.006), (0.06, 0.03), (0.075, 0.10), (0.06, 0.19), (0.035, 0.25), (0.034, 0.28), (0.045, 0.31)]
    made.add("Glass", lathe(vase, 24), translation(RIGHT - 0.24, top, -4.0))
    bowl = [(0, 0.0), (0.05, 0.0), (0.055, 0.006), (0.11, 0.05), (0.135, 0.085), (0.133, 0.088), (0.105, 0.056), (0.05, 0.014), (0, 0.012)]
    made.add("CeramicBlue", lathe(bowl, 24), translation(RIGHT - 0.25, top, -4.45))
    made.write()
    mug(stage, "/Office/Furniture/MugC", images, "CeramicOrange").place(RIGHT - 0.28, top, -4.8, 130).write()


def picture(stage: Usd.Stage, images: str) -> None:
    """The painting on the back wall in a thin frame."""
    made = Asset(stage, "/Office/Furniture/Picture", images).place(-0.45, 1.62, BACK)
    width, height, bar = 0.87, 1.16, 0.022
    made.add("Painting", sheet((-width / 2, -height / 2, 0.018), (width, 0, 0), (0, height, 0)))
    for x in (-1, 1):
        made.box("Oak", (x * (width + bar) / 2, 0, 0.0165), (bar, height + 2 * bar, 0.031))
    for y in (-1, 1):
        made.box("Oak", (0, y * (height + bar) / 2, 0.016), (width + 0.002, bar, 0.03))
    made.write()


def clock(stage: Usd.Stage, images: str) -> None:
    """A wall clock over the sideboard."""
    made = Asset(stage, "/Office/Furniture/Clock", images)
    place = translation(RIGHT, 1.75, -4.55) @ rotation("z", 90)
    made.add("BlackMetal", lathe([(0.16, 0.0), (0.165, 0.002), (0.165, 0.035), (0.162, 0.038), (0.152, 0.036), (0.15, 0.02)], 32), place)
    made.add("CeramicWhite", lathe([(0.152, 0.018), (0.1, 0.019), (0, 0.019)], 32), place)
    for turn in range(0, 360, 30):
        made.add("BlackMetal", box((0.13, 0.0205, 0), (0.022, 0.002, 0.005), 0.0005), place @ rotation("y", turn))
    for turn, length in ((-35, 0.085), (62, 0.12)):
        made.add("BlackMetal", box((length / 2 - 0.012, 0.024, 0), (length, 0.002, 0.007), 0.0005), place @ rotation("y", turn))
    made.write()


def basket(stage: Usd.Stage, images: str) -> None:
    """A waste paper basket beside the desk."""
    made = Asset(stage, "/Office/Furniture/Basket", images).place(0.52, 0, -3.1)
    made.add(
        "BlackMetal",
        lathe(
            [
                (0, 0.004),
                (0.11, 0.004),
                (0.115, 0.006),
                (0.14, 0.30),
                (0.145, 0.303),
                (0.143, 0.306),
                (0.137, 0.303),
                (0.112, 0.012),
                (0, 0.012),
            ],
            24,
        ),
    )
    made.write()


def pouf(stage: Usd.Stage, images: str) -> None:
    """A round stool in velvet."""
    made = Asset(stage, "/Office/Furniture/Pouf", images).place(0.50, 0, -5.2)
    made.add(
        "Velvet",
        lathe(
            [(0, 0.012), (0.22, 0.012), (0.25, 0.03), (0.265, 0.10), (0.27, 0.28), (0.262, 0.36), (0.22, 0.395), (0.1, 0.405), (0, 0.405)],
            24,
        ),
    )
    made.add("Brass", lathe([(0.2735, 0.292), (0.2745, 0.294), (0.2745, 0.302), (0.2735, 0.304), (0.265, 0.30)], 24))
    made.write()
