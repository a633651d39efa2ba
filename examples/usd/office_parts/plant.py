"""A rubber plant, one layer that the stage loads as a payload: every leaf is a point instance of one subdivision surface."""

from pathlib import Path

import numpy
from pxr import Gf, Sdf, Usd, UsdGeom

from .asset import Asset, bind, write_mesh
from .shapes import Polygons, lathe, tube


def write(path: Path, height: float, stems: int, seed: int, leaf_length: float, pot: str) -> None:
    """Writes the layer; the pot stands on y = 0."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    made = Asset(stage, "/Plant", "./textures", "/Plant/Materials")
    stage.SetDefaultPrim(made.xform.GetPrim())
    scale = height / 1.7
    profile = [
        (0, 0),
        (0.12, 0),
        (0.13, 0.005),
        (0.165, 0.20),
        (0.175, 0.36),
        (0.175, 0.368),
        (0.172, 0.37),
        (0.16, 0.37),
        (0.157, 0.365),
        (0.155, 0.32),
        (0, 0.32),
    ]
    made.add(pot, lathe([(r * scale, y * scale) for r, y in profile], 24))
    made.add("Soil", lathe([(0, 0.325 * scale), (0.156 * scale, 0.325 * scale), (0.15 * scale, 0.331 * scale), (0, 0.34 * scale)], 16))
    random = numpy.random.default_rng(seed)
    places: list[tuple[numpy.ndarray, numpy.ndarray, float]] = []
    for n in range(stems):
        stem(made, places, random, n / stems * 2 * numpy.pi, height, scale, leaf_length)
    made.write()
    leaves(stage, places, random)
    stage.GetRootLayer().Save()


def stem(made: Asset, places: list, random: numpy.random.Generator, angle: float, height: float, scale: float, leaf_length: float) -> None:
    """One stem that leans outwards, and its leaves in a spiral."""
    lean = numpy.array([numpy.cos(angle), 0, numpy.sin(angle)])
    reach = height * (0.72 + 0.28 * random.random())
    foot = lean * 0.05 * scale + [0, 0.31 * scale, 0]
    path = []
    for t in numpy.linspace(0, 1, 6):
        path.append(foot + lean * (0.22 * t + 0.10 * t * t) * scale * (0.6 + 0.6 * random.random()) + [0, (reach - 0.31 * scale) * t, 0])
    made.add("Stem", tube([tuple(point) for point in path], 0.011 * scale, 6, 0.004 * scale))
    count = int(18 * height / 1.7) + 3
    for k in range(count):
        t = 0.22 + 0.78 * k / (count - 1)
        where = t * (len(path) - 1)
        i = min(int(where), len(path) - 2)
        point = path[i] + (path[i + 1] - path[i]) * (where - i)
        turn = angle + 2.4 * k + 0.4 * random.random()
        rise = 0.15 + 0.9 * t**3 + 0.25 * random.random()
        direction = numpy.array([numpy.cos(turn) * numpy.cos(rise), numpy.sin(rise), numpy.sin(turn) * numpy.cos(rise)])
        places.append((point, direction, leaf_length * (0.7 + 0.45 * random.random()) * (1 - 0.35 * t**4)))


def leaf() -> Polygons:
    """A leaf of length 1 along +z, folded along its middle and drooping; +y is its upper side."""
    rows, widths = numpy.linspace(0, 1, 9), [0.012, 0.012, 0.13, 0.215, 0.25, 0.235, 0.175, 0.085, 0.004]
    points, faces, uvs = [], [], []
    for length, width in zip(rows, widths):
        for side in (-1.0, -0.55, 0.0, 0.55, 1.0):
            droop = -0.30 * max(length - 0.2, 0) ** 2
            points.append((side * width, droop + 0.16 * abs(side) * width - 0.12 * width * side**4 * abs(side), length))
    for row in range(len(widths) - 1):
        for column in range(4):
            a = row * 5 + column
            faces.append([a, a + 5, a + 6, a + 1])
            uvs += [(0.0, 0.0)] * 4
    return Polygons(numpy.array(points), faces, numpy.array(uvs))


def leaves(stage: Usd.Stage, places: list, random: numpy.random.Generator) -> None:
    """The instancer of all leaves; each has its own green."""
    instancer = UsdGeom.PointInstancer.Define(stage, "/Plant/Leaves")
    mesh = UsdGeom.Mesh.Define(stage, "/Plant/Leaves/Prototypes/Leaf")
    write_mesh(mesh, [leaf()], True)
    mesh.CreateDoubleSidedAttr(True)
    bind(stage, mesh.GetPrim(), "/Plant/Materials", "Leaf", "./textures")
    turns, colours = [], []
    for _, direction, _ in places:
        yaw = Gf.Rotation(Gf.Vec3d(0, 1, 0), float(numpy.degrees(numpy.arctan2(direction[0], direction[2]))))
        pitch = Gf.Rotation(Gf.Vec3d(1, 0, 0), float(-numpy.degrees(numpy.arcsin(direction[1]))))
        roll = Gf.Rotation(Gf.Vec3d(0, 0, 1), float(random.normal() * 12))
        turns.append(Gf.Quath((roll * pitch * yaw).GetQuat()))
        green = random.random()
        colours.append(Gf.Vec3f(0.035 + 0.05 * green, 0.10 + 0.11 * green, 0.03 + 0.02 * green))
    instancer.CreatePrototypesRel().SetTargets([mesh.GetPath()])
    instancer.CreateProtoIndicesAttr([0] * len(places))
    instancer.CreatePositionsAttr([Gf.Vec3f(*numpy.round(point, 4).tolist()) for point, _, _ in places])
    instancer.CreateOrientationsAttr(turns)
    instancer.CreateScalesAttr([Gf.Vec3f(round(size, 3)) for _, _, size in places])
    colour = UsdGeom.PrimvarsAPI(instancer).CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray, UsdGeom.Tokens.vertex)
    colour.Set(colours)
