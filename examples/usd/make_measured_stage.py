"""Writes a stage with three measured materials of three formats: `python make_measured_stage.py brushed.gbsdf FOLDER`.

The balls are a brushed metal from the given file (`examples/python/measured_lobes.py` writes it) and a car paint as MERL has it; before the lamp
hangs a shade as WINDOW's BSDF XML. Paint and shade are made up here from closed forms and written beside the stage. Needs usd-core and numpy.
"""

import shutil
import sys
from pathlib import Path

import numpy
from pxr import Gf, Sdf, Usd, UsdGeom, UsdLux, UsdShade

MERL_BINS, MERL_SCALE = (90, 45, 90), numpy.array([1.0, 1.15, 1.66]) / 1500.0
# Klems' half basis: borders of rings in degrees, and patches in each ring.
BORDERS, PATCHES = (0.0, 6.5, 19.5, 32.5, 46.5, 61.5, 76.5, 90.0), (1, 8, 12, 16, 20, 12, 4)


def ggx(alpha, half, view, light):
    """GGX's distribution with height-correlated shadowing over cosines of the half vector's, the view's and the light's angles, 1/sr."""
    slope = (1.0 - half**2) / alpha**2 + half**2
    stretched = [numpy.sqrt(alpha**2 * (1.0 - c**2) + c**2) for c in (view, light)]
    return 0.5 / (numpy.pi * alpha**2 * slope**2 * (stretched[0] * light + stretched[1] * view))


def write_paint(path):
    """A red paint with flakes under a clear coat: MERL's layout, in single precision and with fewer bins."""
    centres = [(numpy.arange(n) + 0.5) / n for n in MERL_BINS]
    theta_h, theta_d, phi_d = numpy.meshgrid(
        centres[0] ** 2 * numpy.pi / 2, centres[1] * numpy.pi / 2, centres[2] * numpy.pi, indexing="ij"
    )
    level, tilt = numpy.cos(theta_h) * numpy.cos(theta_d), numpy.sin(theta_h) * numpy.sin(theta_d) * numpy.cos(phi_d)
    view, light = level + tilt, level - tilt
    fresnel = 0.04 + 0.96 * (1.0 - numpy.cos(theta_d)) ** 5
    cosines = numpy.cos(theta_h), numpy.maximum(view, 0.02), numpy.maximum(light, 0.02)
    flakes, coat = (1.0 - fresnel) ** 2 * ggx(0.35, *cosines), fresnel * ggx(0.1, *cosines)
    value = [base / numpy.pi + flake * flakes + coat for base, flake in ((0.10, 0.30), (0.008, 0.05), (0.006, 0.03))]
    planes = [numpy.where((view > 0.0) & (light > 0.0), x / scale, -1.0) for x, scale in zip(value, MERL_SCALE, strict=True)]
    path.write_bytes(numpy.array(MERL_BINS, "<i4").tobytes() + numpy.array(planes, "<f4").tobytes())


def patches():
    """Unit vectors of the patches' middles, and their projected solid angles in sr."""
    middles, areas = [], []
    for low, high, count in zip(BORDERS, BORDERS[1:], PATCHES, strict=False):
        theta = numpy.radians(0.5 * (low + high)) if low else 0.0
        for phi in 2.0 * numpy.pi * numpy.arange(count) / count:
            middles.append((numpy.sin(theta) * numpy.cos(phi), numpy.sin(theta) * numpy.sin(phi), numpy.cos(theta)))
            areas.append(numpy.pi * (numpy.sin(numpy.radians(high)) ** 2 - numpy.sin(numpy.radians(low)) ** 2) / count)
    return numpy.array(middles), numpy.array(areas)


def write_shade(path):
    """A woven shade: a fiftieth of the light passes straight, some is scattered about that direction, and some by Lambert's law."""
    middles, areas = patches()
    # Light's patches are numbered by where it goes to.
    spread = numpy.exp((middles @ middles.T - 1.0) / 0.1)
    through = 0.2 * spread / (spread.T @ areas) + 0.2 / numpy.pi + numpy.diag(0.02 / areas)
    back = numpy.full_like(through, 0.45 / numpy.pi)
    rings = "".join(
        f"<AngleBasisBlock><nPhis>{count}</nPhis>"
        f"<ThetaBounds><LowerTheta>{low}</LowerTheta><UpperTheta>{high}</UpperTheta></ThetaBounds></AngleBasisBlock>\n"
        for low, high, count in zip(BORDERS, BORDERS[1:], PATCHES, strict=False)
    )
    blocks = ""
    for direction, values in (("Transmission Front", through), ("Reflection Front", back), ("Reflection Back", back)):
        rows = "\n".join(" ".join(f"{x:.6g}" for x in row) for row in values)
        blocks += f"""<WavelengthData><Wavelength unit="Integral">Visible</Wavelength><WavelengthDataBlock>
<WavelengthDataDirection>{direction}</WavelengthDataDirection>
<ColumnAngleBasis>Half</ColumnAngleBasis><RowAngleBasis>Half</RowAngleBasis>
<ScatteringData>\n{rows}\n</ScatteringData></WavelengthDataBlock></WavelengthData>\n"""
    path.write_text(f"""<?xml version="1.0" encoding="UTF-8"?>
<WindowElement xmlns="http://windows.lbl.gov"><Optical><Layer><Material><Name>Woven shade</Name></Material>
<DataDefinition><IncidentDataStructure>Columns</IncidentDataStructure>
<AngleBasis><AngleBasisName>Half</AngleBasisName>\n{rings}</AngleBasis></DataDefinition>
{blocks}</Layer></Optical></WindowElement>
""")


def measured(stage, name, file):
    """A material that shows a file."""
    material = UsdShade.Material.Define(stage, f"/World/{name}")
    shader = UsdShade.Shader.Define(stage, f"/World/{name}/Measured")
    shader.CreateIdAttr("gonio:MeasuredBSDF")
    shader.CreateInput("file", Sdf.ValueTypeNames.Asset).Set(f"./{file}")
    surface = shader.CreateOutput("surface", Sdf.ValueTypeNames.Token)
    material.CreateOutput("gonio:surface", Sdf.ValueTypeNames.Token).ConnectToSource(surface)
    return material


def matt(stage):
    """A grey floor."""
    material, shader = UsdShade.Material.Define(stage, "/World/Matt"), UsdShade.Shader.Define(stage, "/World/Matt/Surface")
    shader.CreateIdAttr("UsdPreviewSurface")
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(0.32, 0.32, 0.34))
    shader.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(0.9)
    material.CreateSurfaceOutput().ConnectToSource(shader.CreateOutput("surface", Sdf.ValueTypeNames.Token))
    return material


def mesh(stage, name, points, normals, st, quads, material):
    """Quads with a texture coordinate at each point, which tangents follow."""
    prim = UsdGeom.Mesh.Define(stage, f"/World/{name}")
    prim.CreatePointsAttr(points.astype("f4"))
    prim.CreateFaceVertexCountsAttr(numpy.full(len(quads), 4, "i4"))
    prim.CreateFaceVertexIndicesAttr(quads.astype("i4").ravel())
    prim.CreateSubdivisionSchemeAttr("none")
    prim.CreateNormalsAttr(normals.astype("f4"))
    prim.SetNormalsInterpolation("vertex")
    primvars = UsdGeom.PrimvarsAPI(prim)
    primvars.CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, "vertex").Set(st.astype("f4"))
    UsdShade.MaterialBindingAPI.Apply(prim.GetPrim()).Bind(material)


def grid(columns, rows):
    """Texture coordinates of a grid of points, and its quads."""
    u, v = numpy.meshgrid(numpy.linspace(0.0, 1.0, columns + 1), numpy.linspace(0.0, 1.0, rows + 1))
    first = (numpy.arange(rows)[:, None] * (columns + 1) + numpy.arange(columns)).ravel()
    return numpy.stack([u.ravel(), v.ravel()], axis=1), first[:, None] + numpy.array([0, 1, columns + 2, columns + 1])


def ball(stage, name, middle, material):
    """A ball of radius 1 m that was turned on a lathe: u goes around its axis, which leans."""
    st, quads = grid(96, 48)
    phi, theta = 2.0 * numpy.pi * st[:, 0], numpy.pi * (1.0 - st[:, 1])
    normals = numpy.stack([numpy.sin(theta) * numpy.cos(phi), numpy.sin(theta) * numpy.sin(phi), numpy.cos(theta)], axis=1)
    lean = numpy.radians(55.0)
    normals = normals @ numpy.array([[1, 0, 0], [0, numpy.cos(lean), -numpy.sin(lean)], [0, numpy.sin(lean), numpy.cos(lean)]])
    mesh(stage, name, normals + middle, normals, st, quads, material)


def sheet(stage, name, corner, along, up, material):
    """A rectangle in m that faces along × up."""
    st, quads = grid(1, 1)
    normal = numpy.cross(along, up) / numpy.linalg.norm(numpy.cross(along, up))
    mesh(stage, name, corner + st[:, :1] * along + st[:, 1:] * up, numpy.tile(normal, (4, 1)), st, quads, material)


def lamp(stage, name, place, aim, size, luminance):
    """A square light that looks at a point; size in m, luminance in cd/m²."""
    light = UsdLux.RectLight.Define(stage, f"/World/{name}")
    light.CreateWidthAttr(size)
    light.CreateHeightAttr(size)
    light.CreateIntensityAttr(luminance)
    light.AddTransformOp().Set(Gf.Matrix4d().SetLookAt(Gf.Vec3d(*place), Gf.Vec3d(*aim), Gf.Vec3d(0, 0, 1)).GetInverse())


def main() -> None:
    """The files, then the stage."""
    brushed, folder = Path(sys.argv[1]), Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    if brushed.resolve() != (folder / "brushed.gbsdf").resolve():
        shutil.copy(brushed, folder / "brushed.gbsdf")
    write_paint(folder / "paint.binary")
    write_shade(folder / "shade.xml")
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageMetersPerUnit(stage, 1.0)
    UsdGeom.SetStageUpAxis(stage, "Z")
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/World").GetPrim())
    ball(stage, "Left", numpy.array([-1.25, 0.0, 1.0]), measured(stage, "Brushed", "brushed.gbsdf"))
    ball(stage, "Right", numpy.array([1.25, 0.0, 1.0]), measured(stage, "Paint", "paint.binary"))
    shade = measured(stage, "Shade", "shade.xml")
    sheet(stage, "Blind", numpy.array([-2.8, 2.2, 0.4]), numpy.array([5.6, 0.0, 0.0]), numpy.array([0.0, 0.0, 3.0]), shade)
    grey = matt(stage)
    sheet(stage, "Floor", numpy.array([-10.0, -10.0, 0.0]), numpy.array([20.0, 0.0, 0.0]), numpy.array([0.0, 17.0, 0.0]), grey)
    sheet(stage, "Wall", numpy.array([-10.0, 7.0, 0.0]), numpy.array([20.0, 0.0, 0.0]), numpy.array([0.0, 0.0, 8.0]), grey)
    lamp(stage, "Key", (-4.0, -3.5, 5.0), (0.0, 0.0, 1.0), 1.2, 9000.0)
    lamp(stage, "Behind", (0.5, 5.0, 2.2), (0.0, 2.0, 1.8), 1.5, 5000.0)
    camera = UsdGeom.Camera.Define(stage, "/World/Camera")
    camera.CreateFocalLengthAttr(45.0)
    camera.CreateHorizontalApertureAttr(32.0)
    camera.CreateVerticalApertureAttr(18.0)
    view = Gf.Matrix4d().SetLookAt(Gf.Vec3d(0.0, -8.2, 2.5), Gf.Vec3d(0.0, 0.0, 1.25), Gf.Vec3d(0, 0, 1))
    camera.AddTransformOp().Set(view.GetInverse())
    stage.Export(str(folder / "measured.usda"))


main()
