"""IFC building models as stages: sizes, names, styles, panes, notes, and what is refused."""

import math
import re
import sys

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")
pytest.importorskip("ifcopenshell", reason="IFC models need ifcopenshell")

import gonio.ifc  # noqa: E402
from gonio.ifc.stage import build  # noqa: E402
from ifc_models import Building, moved  # noqa: E402
from pxr import Usd, UsdGeom, UsdShade  # noqa: E402

GROUND = "/Model/Site/House/Ground"


def written(building, folder):
    """The stage of a building, and the notes."""
    building.save(folder / "model.ifc")
    notes = build(folder / "model.ifc", folder / "model.usda")
    return Usd.Stage.Open(str(folder / "model.usda")), "\n".join(notes)


def corners(stage, path):
    """The triangles of a mesh in the world, metres."""
    mesh = UsdGeom.Mesh(stage.GetPrimAtPath(path))
    points = np.array(mesh.GetPointsAttr().Get(), float)
    matrix = np.array(mesh.ComputeLocalToWorldTransform(0))
    points = points @ matrix[:3, :3] + matrix[3, :3]
    return points[np.array(mesh.GetFaceVertexIndicesAttr().Get()).reshape(-1, 3)]


def areas(triangles):
    return 0.5 * np.linalg.norm(np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]), axis=1)


def looks(stage, path):
    """Inputs of the surfaces of a prim and its subsets, with the area that has them."""
    prim = stage.GetPrimAtPath(path)
    sizes = areas(corners(stage, path))
    found = []
    for subset in UsdGeom.Subset.GetAllGeomSubsets(UsdGeom.Imageable(prim)) or [None]:
        binding = UsdShade.MaterialBindingAPI(subset.GetPrim() if subset else prim).GetDirectBinding().GetMaterialPath()
        shader = UsdShade.Shader(stage.GetPrimAtPath(binding.AppendChild("Surface")))
        inputs = {i.GetBaseName(): i.Get() for i in shader.GetInputs()}
        found.append((inputs, sizes[np.array(subset.GetIndicesAttr().Get())].sum() if subset else sizes.sum()))
    return found


@pytest.mark.parametrize("schema", ["IFC2X3", "IFC4", "IFC4X3"])
@pytest.mark.parametrize("unit", ["metre", "millimetre", "foot"])
def test_sizes_are_metres_and_openings_are_cut(tmp_path, schema, unit):
    building = Building(schema, unit)
    wall = building.block("IfcWall", "Wand Süd #1", (1, 2, 0), (6, 2.2, 3))
    building.hole(wall, (2, 1.9, 1), (3, 2.3, 2))
    stage, _ = written(building, tmp_path)
    path = f"{GROUND}/Wand_Sud_1"
    triangles = corners(stage, path)
    assert triangles.reshape(-1, 3).min(axis=0) == pytest.approx([1, 2, 0], abs=1e-5)
    assert triangles.reshape(-1, 3).max(axis=0) == pytest.approx([6, 2.2, 3], abs=1e-5)
    # The hole takes a square metre of both faces and brings four sides of 0.2 m².
    assert areas(triangles).sum() == pytest.approx(2 * (5 * 0.2 + 5 * 3 + 0.2 * 3) - 2 + 0.8, rel=1e-5)
    prim = stage.GetPrimAtPath(path)
    assert prim.GetDisplayName() == "Wand Süd #1"
    assert (prim.GetAttribute("ifc:class").Get(), prim.GetAttribute("ifc:GlobalId").Get()) == ("IfcWall", wall.GlobalId)
    assert (UsdGeom.GetStageUpAxis(stage), UsdGeom.GetStageMetersPerUnit(stage)) == ("Z", 1.0)


def test_names_are_unique_and_spaces_and_openings_are_no_surfaces(tmp_path):
    building = Building()
    for x in (0, 3):
        building.block("IfcColumn", "Column", (x, 0, 0), (x + 1, 1, 3))
    building.block("IfcColumn", "柱", (6, 0, 0), (7, 1, 3))
    building.block("IfcVirtualElement", "Air", (9, 0, 0), (10, 1, 3))
    building.block("IfcSpace", "1", (0, 2, 0), (4, 6, 3))
    stage, _ = written(building, tmp_path)
    names = {prim.GetName() for prim in stage.Traverse() if prim.IsA(UsdGeom.Mesh)}
    assert names == {"Column", "Column_2", "Column_3"}
    assert stage.GetPrimAtPath(f"{GROUND}/Column_3").GetDisplayName() == "柱"


def test_surfaces_without_a_style_are_by_what_they_are(tmp_path):
    building = Building()
    wall = building.block("IfcWall", "Wall", (0, 0, 0), (4, 0.2, 3))
    building.block("IfcSlab", "Slab", (0, 0, -0.2), (4, 4, 0), PredefinedType="FLOOR")
    hung = building.block("IfcSlab", "Hung", (0, 0, 0), (4, 4, 0.2))
    # Upside down, 4 m further up.
    building.place(hung, [[1, 0, 0, 0], [0, -1, 0, 4], [0, 0, -1, 4], [0, 0, 0, 1]])
    building.block("IfcCovering", "Ceiling", (0, 0, 2.9), (4, 4, 3), PredefinedType="CEILING")
    stage, notes = written(building, tmp_path)
    assert [inputs["base_color"][0] for inputs, _ in looks(stage, f"{GROUND}/Wall")] == [0.5]
    slab = {round(inputs["base_color"][0], 3): area for inputs, area in looks(stage, f"{GROUND}/Slab")}
    assert slab == pytest.approx({0.2: 16.0, 0.8: 16.0, 0.5: 3.2}, rel=1e-5)
    triangles = corners(stage, f"{GROUND}/Hung")
    low = triangles[..., 2].max(axis=1) < 3.81
    floor = UsdGeom.Subset.Get(stage, f"{GROUND}/Hung/part_1").GetIndicesAttr().Get()
    assert looks(stage, f"{GROUND}/Hung")[0][0]["base_color"][0] == pytest.approx(0.2) and not low[np.array(floor)].any()
    assert looks(stage, f"{GROUND}/Ceiling")[0][0]["base_color"][0] == pytest.approx(0.8)
    assert f"wall 0.5: IfcWall 'Wall' ({wall.GlobalId})" in notes


def test_styles(tmp_path):
    building = Building()
    build = building.model.create_entity
    shares = [building.colour((x,) * 3) for x in (0.0, 0.3, 0.0, 0.0)]
    paints = {
        "Grey": building.style("Grey", (0.5, 0.5, 0.5)),
        "White": building.style("White", (1, 1, 1)),
        "Bytes": building.style("Bytes", (204, 204, 204)),
        "Steel": building.style("Steel", (0.8, 0.8, 0.8), method="METAL"),
        "Measured": building.surface("Measured", build("IfcSurfaceStyleLighting", *shares)),
        "Half": building.surface("Half", build("IfcSurfaceStyleRendering", building.colour((1, 1, 1)), 0.0, build("IfcNormalisedRatioMeasure", 0.5))),
    }
    for number, (name, style) in enumerate(paints.items()):
        building.block("IfcWall", name, (0, number, 0), (4, number + 0.2, 3), style)
    stage, notes = written(building, tmp_path)
    found = {name: looks(stage, f"{GROUND}/{name}")[0][0] for name in paints}
    reflected = {name: inputs["base_color"][0] for name, inputs in found.items()}
    # Colours are those of screens: 0.5 is 21 % of light, 0.8 is 60 %. Shares of light are taken as they are.
    assert reflected == pytest.approx({"Grey": 0.2140, "White": 0.9, "Bytes": 0.6038, "Steel": 0.6038, "Measured": 0.3, "Half": 0.5}, abs=1e-4)
    assert found["Steel"]["base_metalness"] == 1.0 and "whiter than white paint" in notes


def test_true_north_place_and_far_origins(tmp_path):
    building = Building()
    # True north is the model's +x; the site lies in Vienna's latitude, west of Greenwich.
    building.context.TrueNorth = building.direction((1, 0))
    building.site.RefLatitude, building.site.RefLongitude, building.site.RefElevation = (48, 12, 36, 500000), (-16, -22, -12), 171.0
    building.block("IfcWall", "Wall", (500_010, 200_000, 100), (500_015, 200_000.2, 103))
    building.block("IfcWall", "Other", (500_010, 200_010, 100), (500_015, 200_010.2, 103))
    stage, notes = written(building, tmp_path)
    triangles = corners(stage, f"{GROUND}/Wall")
    # What ran along +x runs along +y, what was at +y is at -x.
    assert np.ptp(triangles.reshape(-1, 3), axis=0) == pytest.approx([0.2, 5, 3], abs=1e-4)
    assert triangles[..., 0].mean() - corners(stage, f"{GROUND}/Other")[..., 0].mean() == pytest.approx(10, abs=1e-4)
    assert np.abs(triangles).max() < 20
    assert "turned by 90°" in notes and "moved by" in notes and "48.21014" in notes and "-16.37000" in notes
    root = stage.GetPrimAtPath("/Model")
    assert root.GetAttribute("ifc:latitude").Get() == pytest.approx(48 + 12 / 60 + 36.5 / 3600)
    assert root.GetAttribute("ifc:longitude").Get() == pytest.approx(-(16 + 22 / 60 + 12 / 3600))


def test_shapes_that_stand_several_times_are_instances(tmp_path):
    building = Building()
    build = building.model.create_entity
    star = [(math.cos(a) * r, math.sin(a) * r) for i, a in enumerate(np.arange(20) * math.pi / 10) for r in [0.5 if i % 2 else 0.3]]
    shape = building.model.create_entity("IfcShapeRepresentation", building.body, "Body", "SweptSolid", [building.prism(star, 1.0)])
    source = build("IfcRepresentationMap", building.axes(), shape)
    for x in (0, 5):
        chair = building.new("IfcFurniture", "Chair")
        building.place(chair, moved((x, 0, 0)))
        target = build("IfcCartesianTransformationOperator3D", None, None, building.point((0, 0, 0)))
        building.show(chair, [build("IfcMappedItem", source, target)], "MappedRepresentation")
    stage, _ = written(building, tmp_path)
    chairs = [prim for prim in stage.Traverse() if prim.GetDisplayName() == "Chair"]
    assert [prim.IsInstance() for prim in chairs] == [True, True] and len(stage.GetPrototypes()) == 1
    cache = UsdGeom.BBoxCache(0, ["default"])
    middles = [cache.ComputeWorldBound(prim).ComputeAlignedRange().GetMidpoint()[0] for prim in chairs]
    assert middles == pytest.approx([0, 5], abs=1e-5)


def head(building, folder):
    return building.save(folder / "whole.ifc").read_bytes()


@pytest.mark.parametrize(
    "content, words",
    [
        (None, "there is no such file"),
        (lambda whole: b"", "the file is empty"),
        (lambda whole: b"Once upon a time\n", "this is no IFC file"),
        (lambda whole: b"<?xml version='1.0'?><ifcXML/>", "export STEP"),
        (lambda whole: b"PK\x03\x04" + whole, "unpack"),
        (lambda whole: whole[: len(whole) // 2], "the file is cut off"),
        (lambda whole: whole.replace(b"'IFC4'", b"'AUTOMOTIVE_DESIGN'"), "cannot read it"),
        (lambda whole: whole.replace(b"IFCPROJECT(", b"IFCMATERIAL("), "there is no IfcProject"),
        (lambda whole: whole.replace(b"IFCWALL(", b"IFCGRID("), "no geometry"),
    ],
)
def test_what_is_no_model_is_refused(tmp_path, content, words):
    path = tmp_path / "bad.ifc"
    if content:
        building = Building()
        building.block("IfcWall", "Wall", (0, 0, 0), (4, 0.2, 3))
        path.write_bytes(content(head(building, tmp_path)))
    with pytest.raises(ValueError, match=words) as told:
        build(path, tmp_path / "bad.usda")
    assert "bad.ifc" in str(told.value) and "\n" not in str(told.value) and not (tmp_path / "bad.usda").exists()


def test_broken_models_end_in_an_error_and_the_process_goes_on(tmp_path):
    building = Building()
    wall = building.block("IfcWall", "Wall", (0, 0, 0), (4, 0.2, 3))
    building.hole(wall, (1, -0.1, 1), (2, 0.3, 2))
    whole, path = head(building, tmp_path), tmp_path / "broken.ifc"
    path.write_bytes(whole)
    notes = gonio.ifc.write_stage(path, tmp_path / "whole.usda")
    assert any("wall 0.5" in note for note in notes) and (tmp_path / "whole.usda").exists()
    # A placement that is relative to itself, which IfcOpenShell follows until its stack ends.
    lines = whole.split(b"\n")
    first = next(i for i, line in enumerate(lines) if b"IFCLOCALPLACEMENT" in line)
    number, rest = lines[first].split(b"=IFCLOCALPLACEMENT(")
    lines[first] = number + b"=IFCLOCALPLACEMENT(" + number + b"," + rest.split(b",", 1)[1]
    path.write_bytes(b"\n".join(lines))
    with pytest.raises(ValueError, match="broken.ifc"):
        gonio.ifc.write_stage(path, tmp_path / "circle.usda")
    path.write_bytes(b"")
    with pytest.raises(ValueError, match="the file is empty"):
        gonio.ifc.write_stage(path, tmp_path / "empty.usda")


def test_malformed_parts_are_told_and_the_rest_stays(tmp_path):
    building = Building()
    building.block("IfcWall", "Wall", (0, 0, 0), (4, 0.2, 3))
    lamp = building.fixture("Lamp", (0, 0, 2), building.goniometric(building.file("lamp.ies")))
    building.site.RefLatitude, building.site.RefLongitude = (48, 12, 36), (16, 22, 12)
    building.context.TrueNorth = building.model.create_entity("IfcDirection", (1.0,))
    # The lamp's last attribute, its distribution, is missing.
    text = building.save(tmp_path / "model.ifc").read_text()
    (tmp_path / "model.ifc").write_text(re.sub(r"(LIGHTEMITTINGDIODE\.,)#\d+", r"\1$", text))
    notes = "\n".join(build(tmp_path / "model.ifc", tmp_path / "model.usda"))
    assert Usd.Stage.Open(str(tmp_path / "model.usda")).GetPrimAtPath(f"{GROUND}/Wall") and "48.21000" in notes
    assert notes.count("malformed") == 2 and f"IfcLightFixture 'Lamp' ({lamp.GlobalId})" in notes


def test_without_the_package(tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "ifcopenshell", None)
    path = tmp_path / "model.ifc"
    path.write_text("ISO-10303-21;\nEND-ISO-10303-21;\n")
    with pytest.raises(ValueError, match="pip install ifcopenshell"):
        gonio.ifc.write_stage(path, tmp_path / "model.usda")


def test_targets_that_cannot_be_written(tmp_path):
    building = Building()
    building.block("IfcWall", "Wall", (0, 0, 0), (4, 0.2, 3))
    path = building.save(tmp_path / "model.ifc")
    with pytest.raises(ValueError, match="ends in .usda"):
        build(path, tmp_path / "model.txt")
    with pytest.raises(ValueError, match="cannot be written"):
        build(path, path / "model.usda")
