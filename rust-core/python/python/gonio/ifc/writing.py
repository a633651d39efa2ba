"""Prims of a stage: meshes with subsets, materials, what they are in IFC."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np

from .extra import require
from .looks import Look
from .tree import MATERIALS, ROOT, SHAPES, Names, identifier, title

# Index of glass, as models of honeybee and Radiance have it.
GLASS_INDEX = 1.52
# Shapes with as many triangles that stand several times are instances.
SHARED_FROM = 32
# What light passes as if it were not there.
NOTHING = Look("Nothing")


class Writer:
    """A USD stage in the making: metres, z up."""

    def __init__(self, path: Path, names: Names) -> None:
        self.gf, self.sdf, self.usd, self.vt = (require(f"pxr.{name}") for name in ("Gf", "Sdf", "Usd", "Vt"))
        self.geom, self.shade, self.lux = (require(f"pxr.{name}") for name in ("UsdGeom", "UsdShade", "UsdLux"))
        self.stage = self.usd.Stage.CreateInMemory(path.name)
        self.path, self.names = path, names
        self.geom.SetStageUpAxis(self.stage, self.geom.Tokens.z)
        self.geom.SetStageMetersPerUnit(self.stage, 1.0)
        self.root = self.geom.Xform.Define(self.stage, ROOT)
        self.stage.SetDefaultPrim(self.root.GetPrim())
        self._materials: dict[Look, str] = {}
        self._shared: dict[Any, str] = {}

    def save(self) -> None:
        """Writes the file, or raises ValueError."""
        try:
            done = self.stage.GetRootLayer().Export(str(self.path))
        except Exception as error:  # Of pxr.Tf, with lines of its sources.
            raise ValueError(f"{self.path} cannot be written") from error
        if not done:
            raise ValueError(f"{self.path} cannot be written")

    def about(self, path: str, entity: Any) -> Any:
        """The prim of an element with its name, class and GlobalId; an Xform where there is none yet."""
        prim = self.stage.GetPrimAtPath(path)
        if not (prim and prim.GetTypeName()):
            prim = self.geom.Xform.Define(self.stage, path).GetPrim()
        if name := title(entity):
            prim.SetDisplayName(name)
        self.custom(prim, "class", "Token", entity.is_a())
        self.custom(prim, "GlobalId", "String", entity.GlobalId or "")
        return prim

    def custom(self, prim: Any, name: str, kind: str, value: Any) -> None:
        """A custom attribute of IFC's."""
        prim.CreateAttribute(f"ifc:{name}", getattr(self.sdf.ValueTypeNames, kind), True).Set(value)

    def place(self, path: str, matrix: Any) -> None:
        """Gives a prim a matrix (on columns)."""
        prim = self.geom.Xformable(self.stage.GetPrimAtPath(path))
        if not np.allclose(matrix, np.eye(4), atol=1e-12, rtol=0.0):
            prim.AddTransformOp().Set(self.gf.Matrix4d(*np.asarray(matrix, "f8").T.reshape(-1).tolist()))

    def mesh(self, path: str, points: Any, parts: list[tuple[Look, Any]]) -> None:
        """A mesh whose faces have looks; several are subsets."""
        mesh = self.geom.Mesh.Define(self.stage, path)
        faces = np.concatenate([faces for _, faces in parts])
        used, faces = np.unique(faces, return_inverse=True)
        mesh.CreatePointsAttr(self.vt.Vec3fArray.FromNumpy(np.ascontiguousarray(points[used], "f4")))
        mesh.CreateFaceVertexIndicesAttr(self.vt.IntArray.FromNumpy(np.ascontiguousarray(faces.reshape(-1), "i4")))
        mesh.CreateFaceVertexCountsAttr(self.vt.IntArray.FromNumpy(np.full(faces.size // 3, 3, "i4")))
        mesh.CreateSubdivisionSchemeAttr(self.geom.Tokens.none)
        if len(parts) == 1:
            return self.bind(mesh.GetPrim(), parts[0][0])
        first = 0
        for number, (look, members) in enumerate(parts):
            numbers = self.vt.IntArray.FromNumpy(np.arange(first, first + len(members), dtype="i4"))
            subset = self.geom.Subset.CreateGeomSubset(mesh, f"part_{number + 1}", "face", numbers, "materialBind", "nonOverlapping")
            self.bind(subset.GetPrim(), look)
            first += len(members)
        return None

    def shared(self, path: str, key: Any, points: Any, parts: list[tuple[Look, Any]]) -> None:
        """An instance of a shape that stands several times."""
        if key not in self._shared:
            self._shared[key] = self.names.below(SHAPES, f"Shape_{len(self._shared) + 1}")
            self.stage.CreateClassPrim(SHAPES)
            self.geom.Xform.Define(self.stage, self._shared[key])
            self.mesh(f"{self._shared[key]}/Body", points, parts)
        prim = self.geom.Xform.Define(self.stage, path).GetPrim()
        prim.GetReferences().AddInternalReference(self._shared[key])
        prim.SetInstanceable(True)

    def bind(self, prim: Any, look: Look) -> None:
        """Binds the material of a look."""
        if look not in self._materials:
            self._materials[look] = self._material(look)
        material = self.shade.Material.Get(self.stage, self._materials[look])
        self.shade.MaterialBindingAPI.Apply(prim).Bind(material)

    def _material(self, look: Look) -> str:
        """An OpenPBR surface: matte, metal, or a thin pane."""
        self.geom.Scope.Define(self.stage, MATERIALS)
        path = self.names.below(MATERIALS, identifier(look.name) or "Style")
        material = self.shade.Material.Define(self.stage, path)
        material.GetPrim().SetDisplayName(look.name)
        shader = self.shade.Shader.Define(self.stage, f"{path}/Surface")
        shader.CreateIdAttr("ND_open_pbr_surface_surfaceshader")
        for name, value in _inputs(look).items():
            kind = "Bool" if isinstance(value, bool) else "Float" if isinstance(value, float) else "Color3f"
            shader.CreateInput(name, getattr(self.sdf.ValueTypeNames, kind)).Set(value if kind != "Color3f" else self.gf.Vec3f(*value))
        material.CreateSurfaceOutput("mtlx").ConnectToSource(shader.ConnectableAPI(), "out")
        return path


def _inputs(look: Look) -> dict[str, Any]:
    if look == NOTHING:
        return {"geometry_opacity": 0.0}
    if look.is_pane:
        index, tint = _pane(look.transmittance)
        pane = {"transmission_weight": 1.0, "transmission_color": tint, "geometry_thin_walled": True}
        return {**pane, "specular_ior": index, "specular_roughness": 0.0}
    if look.metal:
        return {"base_metalness": 1.0, "base_color": look.reflectance, "specular_roughness": look.roughness}
    return {"base_color": look.reflectance, "base_weight": 1.0, "specular_weight": 0.0}


def _pane(transmittance: tuple[float, float, float]) -> tuple[float, tuple[float, ...]]:
    """Index of a pane and what is left after one way through its glass, by its transmittances T at normal incidence.

    T = τ (1 − r)² / (1 − r² τ²); where glass of 1.52 reflects more than T leaves, the index is the one with which T = (1 − r) / (1 + r).
    """
    r = ((GLASS_INDEX - 1.0) / (GLASS_INDEX + 1.0)) ** 2
    most = max(transmittance)
    if most > (1.0 - r) / (1.0 + r):
        r = (1.0 - most) / (1.0 + most)
    index = (1.0 + math.sqrt(r)) / (1.0 - math.sqrt(r))
    return index, tuple(min(_tau(t, r), 1.0) for t in transmittance)


def _tau(t: float, r: float) -> float:
    if t <= 0.0:
        return 0.0
    way = (1.0 - r) ** 2
    # The root of r² t τ² + (1 − r)² τ − t, written so that nothing cancels.
    return 2.0 * t / (way + math.sqrt(way**2 + 4.0 * r * r * t * t))
