"""Writes office.usda, its layers and its textures: an office of 4.5 m x 6 m in metres, candelas a square metre and kelvins.

Run it with a Python that has usd-core and numpy: `python examples/usd/make_office.py`.
"""

from pathlib import Path

from office_parts import chair, furniture, plant, room, storage, textures
from pxr import Gf, Sdf, Usd, UsdGeom, UsdRender

HERE = Path(__file__).resolve().parent
IMAGES = "./office/textures"


def reference(stage: Usd.Stage, path: str, layer: str, place: tuple[float, float, float], turn: float, is_payload: bool = False) -> None:
    """Brings a layer in as an instance."""
    xform = UsdGeom.Xform.Define(stage, path)
    prim = xform.GetPrim()
    if is_payload:
        prim.GetPayloads().AddPayload(f"./office/{layer}")
    else:
        prim.GetReferences().AddReference(f"./office/{layer}")
    prim.SetInstanceable(True)
    xform.AddTranslateOp().Set(Gf.Vec3d(*place))
    xform.AddRotateYOp().Set(turn)


def camera(stage: Usd.Stage) -> None:
    """A shift lens of 24 mm on 36 mm film: looks level, so that verticals stay upright."""
    prim = UsdGeom.Camera.Define(stage, "/Office/Camera")
    prim.AddTranslateOp().Set(Gf.Vec3d(*textures.EYE))
    prim.AddRotateYOp().Set(20.0)
    # Tenths of a metre.
    prim.CreateFocalLengthAttr(0.24)
    prim.CreateHorizontalApertureAttr(0.36)
    prim.CreateVerticalApertureAttr(0.2025)
    prim.CreateVerticalApertureOffsetAttr(-0.022)
    prim.CreateClippingRangeAttr(Gf.Vec2f(0.01, 100.0))


def settings(stage: Usd.Stage) -> None:
    """1280 x 720 through that camera."""
    prim = UsdRender.Settings.Define(stage, "/Render/Settings")
    prim.CreateResolutionAttr(Gf.Vec2i(1280, 720))
    prim.CreateCameraRel().SetTargets([Sdf.Path("/Office/Camera")])
    stage.SetMetadata("renderSettingsPrimPath", "/Render/Settings")


def main() -> None:
    """Writes everything beside this script."""
    layers = HERE / "office"
    textures.write_all(layers / "textures")
    for name in ("chair.usda", "plant.usda", "desk_plant.usda"):
        (layers / name).unlink(missing_ok=True)
    chair.write(layers / "chair.usda")
    plant.write(layers / "plant.usda", 1.95, 5, 2, 0.30, "Concrete")
    plant.write(layers / "desk_plant.usda", 0.42, 5, 4, 0.11, "CeramicWhite")
    path = HERE / "office.usda"
    path.unlink(missing_ok=True)
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageUpAxis(stage, UsdGeom.Tokens.y)
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/Office").GetPrim())
    room.build(stage, IMAGES)
    furniture.build(stage, IMAGES)
    storage.build(stage, IMAGES)
    reference(stage, "/Office/Furniture/Chair0", "chair.usda", (-0.38, 0, -2.22), 24.0)
    reference(stage, "/Office/Furniture/Chair1", "chair.usda", (-0.55, 0, -4.52), 195.0)
    reference(stage, "/Office/Furniture/Plant", "plant.usda", (-1.35, 0, -5.45), 0.0, is_payload=True)
    reference(stage, "/Office/Furniture/DeskPlant", "desk_plant.usda", (2.02, 0.72, -5.15), 40.0, is_payload=True)
    camera(stage)
    settings(stage)
    stage.GetRootLayer().Save()


if __name__ == "__main__":
    main()
