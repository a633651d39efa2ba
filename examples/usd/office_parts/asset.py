"""Gathers polygons by material and writes them as meshes of one prim."""

import numpy
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, Vt

from .materials import define
from .shapes import Polygons, box, rotation, transformed, translation

Vector = tuple[float, float, float]


class Asset:
    """A prim in the making: `add` polygons, `box` for short, then `write`."""

    def __init__(self, stage: Usd.Stage, path: str, images: str, scope: str = "/Office/Materials") -> None:
        self.stage, self.path, self.images, self.scope = stage, path, images, scope
        self.xform = UsdGeom.Xform.Define(stage, path)
        self.pieces: dict[tuple[str, bool], list[Polygons]] = {}

    def place(self, x: float, y: float, z: float, turn: float = 0.0) -> "Asset":
        """Moves the whole prim, turned about y by degrees."""
        self.xform.AddTranslateOp().Set(Gf.Vec3d(x, y, z))
        if turn:
            self.xform.AddRotateYOp().Set(turn)
        return self

    def add(self, material: str, polygons: Polygons, matrix: numpy.ndarray | None = None) -> None:
        """Adds a shape, moved by a rigid matrix."""
        shape = polygons if matrix is None else transformed(polygons, matrix)
        self.pieces.setdefault((material, shape.normals is None), []).append(shape)

    def box(self, material: str, centre: Vector, size: Vector, bevel: float = 0.003, turn: float = 0.0) -> None:
        """Adds a bevelled box, turned about its own vertical axis by degrees."""
        if turn:
            self.add(material, box((0, 0, 0), size, bevel), translation(*centre) @ rotation("y", turn))
        else:
            self.add(material, box(centre, size, bevel))

    def span(self, material: str, low: Vector, high: Vector, bevel: float = 0.003) -> None:
        """Adds a bevelled box between two corners."""
        centre = tuple((a + b) / 2 for a, b in zip(low, high))
        self.box(material, centre, tuple(b - a for a, b in zip(low, high)), bevel)

    def write(self) -> Usd.Prim:
        """Writes a mesh for each material and kind of surface."""
        for (material, is_smooth), pieces in self.pieces.items():
            mesh = UsdGeom.Mesh.Define(self.stage, f"{self.path}/{material}{'Smooth' if is_smooth else ''}")
            write_mesh(mesh, pieces, is_smooth)
            bind(self.stage, mesh.GetPrim(), self.scope, material, self.images)
        return self.xform.GetPrim()


def bind(stage: Usd.Stage, prim: Usd.Prim, scope: str, material: str, images: str) -> None:
    """Binds a material, made if it is not there."""
    UsdShade.MaterialBindingAPI.Apply(prim).Bind(define(stage, scope, material, images))


def write_mesh(mesh: UsdGeom.Mesh, pieces: list[Polygons], is_smooth: bool) -> None:
    """One mesh from several pieces."""
    starts = numpy.cumsum([0] + [len(piece.points) for piece in pieces])
    faces = [[start + i for i in face] for start, piece in zip(starts, pieces) for face in piece.faces]
    points = rounded(numpy.concatenate([piece.points for piece in pieces]))
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    mesh.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(numpy.stack([points.min(axis=0), points.max(axis=0)])))
    mesh.CreateFaceVertexCountsAttr([len(face) for face in faces])
    mesh.CreateFaceVertexIndicesAttr([int(i) for face in faces for i in face])
    uvs = rounded(numpy.concatenate([piece.uvs for piece in pieces]))
    values, indices = numpy.unique(uvs, axis=0, return_inverse=True)
    primvar = UsdGeom.PrimvarsAPI(mesh).CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, UsdGeom.Tokens.faceVarying)
    primvar.Set(Vt.Vec2fArray.FromNumpy(values))
    primvar.SetIndices(Vt.IntArray.FromNumpy(indices.ravel().astype(numpy.int32)))
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.catmullClark if is_smooth else UsdGeom.Tokens.none)
    if not is_smooth:
        mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(rounded(numpy.concatenate([piece.normals for piece in pieces]))))
        mesh.SetNormalsInterpolation(UsdGeom.Tokens.vertex)


def rounded(values: numpy.ndarray) -> numpy.ndarray:
    """Tenths of a millimetre keep the text short."""
    return numpy.ascontiguousarray(numpy.round(values, 4) + 0.0, dtype=numpy.float32)
