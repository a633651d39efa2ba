"""Shapes and motion on three ways: Blender with the add-on, Blender's own USD export through `gonio render`, and Cycles.

What the exporter leaves out is put into the stage by hand, so that it hides nothing else: the shutter of the camera, and of hair and points
their widths and material. The page is `out/compare-cycles/three-ways.html`.
"""

import json
from pathlib import Path

import blender
import compare
import numpy
import OpenEXR
import pytest
import report

SAMPLES = 128
MOST_MEDIAN = 0.01
MOST_PERCENTILE95 = 0.04
# A shape key is written without the normals that go with it, and those of the mesh at rest are written: shading differs as it bends.
NORMALS_AT_REST = 0.2
SCENES = {
    name: MOST_PERCENTILE95 for name in ("hair_curves", "particle_hair", "points", "displaced", "moving_camera", "moving_things", "skinned")
}
SCENES["deforming"] = NORMALS_AT_REST
# Points of a strand's length from 0 to 1, and diameters there.
HAIR = ((0.0, 1.0), (0.02, 0.01))

pytestmark = [pytest.mark.validate, pytest.mark.timeout(2 * blender.SECONDS)]


@pytest.mark.parametrize("scene", SCENES)
def test_three_ways_agree(scene: str, tmp_path: Path, run) -> None:
    blender.call("three_ways", tmp_path, scene=scene, samples=SAMPLES)
    cycles, addon = (numpy.load(tmp_path / f"{scene}-{engine}.npy") for engine in ("CYCLES", "GONIO"))
    complete(tmp_path / f"{scene}.usdc", cover(scene))
    height, width, _ = cycles.shape
    picture = tmp_path / f"{scene}.exr"
    done = run("render", tmp_path / f"{scene}.usdc", "-o", picture, "--spp", SAMPLES, "--res", width, height, timeout=blender.SECONDS)
    assert done.returncode == 0 and "warning" not in done.stderr, done.stderr
    stage = OpenEXR.File(str(picture)).channels()["RGBA"].pixels[..., :3].astype("f8")
    pairs = {"add-on and Cycles": (addon, cycles), "USD and add-on": (stage, addon)}
    found = {name: compare.difference(*pair) for name, pair in pairs.items()}
    show(scene, pairs, found)
    for name, difference in found.items():
        assert difference.median < MOST_MEDIAN, (name, difference)
        limit = SCENES[scene] if name == "USD and add-on" else MOST_PERCENTILE95
        assert difference.percentile95 < limit, (name, difference)


def cover(scene: str) -> tuple[float, float, float]:
    """The colour of what the exporter writes without a material."""
    return (0.3, 0.45, 0.6) if scene == "points" else (0.3, 0.2, 0.15)


def complete(path: Path, colour: tuple[float, float, float]) -> None:
    """Puts into a stage what the exporter has left out."""
    from pxr import Usd, UsdGeom, UsdShade

    stage = Usd.Stage.Open(str(path))
    for prim in list(stage.Traverse()):
        if prim.IsA(UsdGeom.Camera) and stage.GetEndTimeCode() > stage.GetStartTimeCode():
            camera = UsdGeom.Camera(prim)
            assert camera.GetShutterCloseAttr().Get() == 0.0, "the exporter writes the shutter now"
            camera.CreateShutterOpenAttr(0.0)
            camera.CreateShutterCloseAttr(1.0)
        is_bare = prim.GetTypeName() in ("BasisCurves", "Points") and not UsdShade.MaterialBindingAPI(prim).ComputeBoundMaterial()[0]
        if is_bare:
            UsdShade.MaterialBindingAPI.Apply(prim).Bind(preview(stage, colour))
        if prim.IsA(UsdGeom.BasisCurves) and not UsdGeom.Curves(prim).GetWidthsAttr().HasAuthoredValue():
            curves = UsdGeom.BasisCurves(prim)
            counts = curves.GetCurveVertexCountsAttr().Get()
            curves.CreateWidthsAttr([float(numpy.interp(k / (count - 1), *HAIR)) for count in counts for k in range(count)])
            curves.SetWidthsInterpolation("vertex")
    stage.Save()


def preview(stage, colour: tuple[float, float, float]):
    """A material of the stage with a rough surface."""
    from pxr import Sdf, UsdShade

    material = UsdShade.Material.Define(stage, "/root/_materials/Bare")
    shader = UsdShade.Shader.Define(stage, "/root/_materials/Bare/Surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(colour)
    shader.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(0.8)
    material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
    return material


def show(scene: str, pairs, found) -> None:
    """Adds a scene's row to the page: both pairs, each with its difference."""
    folder = report.OUT / "three-ways"
    folder.mkdir(parents=True, exist_ok=True)
    figures = {}
    for name, (image, reference) in pairs.items():
        compare.write_strip(folder / f"{scene}-{name[:3].lower()}.png", image, reference)
        figures[name] = {"median": found[name].median, "percentile95": found[name].percentile95, "largest": found[name].largest}
    (folder / f"{scene}.json").write_text(json.dumps(figures))
    rows = [row(each, folder) for each in SCENES if (folder / f"{each}.json").is_file()]
    head = "<!doctype html><meta charset='utf-8'><title>Three ways</title><style>img { image-rendering: pixelated; width: 48% }</style>"
    told = "<p>Left of each: the first and the second named, and their difference (grey is none, white 5 % brighter).</p>"
    (report.OUT / "three-ways.html").write_text("\n".join([head, told, *rows]), encoding="utf-8")


def row(scene: str, folder: Path) -> str:
    """A scene of the page."""
    figures = json.loads((folder / f"{scene}.json").read_text())
    cells = [f"{name}: " + ", ".join(f"{key} {value:.2%}" for key, value in each.items()) for name, each in figures.items()]
    pictures = "".join(f'<img src="three-ways/{scene}-{name[:3].lower()}.png" alt="{name}">' for name in figures)
    return f"<h2>{scene}</h2><p>{'; '.join(cells)}</p>{pictures}"
