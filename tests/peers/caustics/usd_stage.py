"""A scene of this folder as a USD stage, for the command line: `usd_stage.py SCENE FILE.usda`.

Metres and y up as they are; lamps have nits, the sun what its disk has. Mirrors and glass are OpenPBR surfaces.
"""

import math
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "render"), str(HERE.parents[1] / "validate")]

import numpy  # noqa: E402
from cornell import Diffuse, Glass, Mirror  # noqa: E402
from description import Disk, Light, Mesh, Point, Rectangle, Scene, Sphere, Sun, Surface, described  # noqa: E402

HEAD = '#usda 1.0\n(\n    defaultPrim = "World"\n    metersPerUnit = 1\n    upAxis = "Y"\n)\n\ndef Xform "World"\n{\n'
MESH = """    def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        uniform bool doubleSided = 1
        uniform token subdivisionScheme = "none"
        int[] faceVertexCounts = [{counts}]
        int[] faceVertexIndices = [{indices}]
        point3f[] points = [{points}]
{normals}        rel material:binding = </World/{name}Material>
    }}
    def Material "{name}Material"
    {{
        token outputs:{context}surface.connect = </World/{name}Material/Surface.outputs:{output}>
        def Shader "Surface"
        {{
            uniform token info:id = "{shader}"
{inputs}
            token outputs:{output}
        }}
    }}
"""
PLACE = """        matrix4d xformOp:transform = {matrix}
        uniform token[] xformOpOrder = ["xformOp:transform"]
"""


def stage(scene: Scene) -> str:
    """The text of the stage; the camera is /World/Camera."""
    parts = [mesh(f"Mesh{number}", each) for number, each in enumerate(scene.meshes)]
    parts += [light(f"Light{number}", each) for number, each in enumerate(scene.lights)]
    return HEAD + "".join([*parts, camera(scene)]) + "}\n"


def mesh(name: str, part: Mesh) -> str:
    """A mesh and its material."""
    assert len(part.places) == 1 and numpy.array_equal(part.places[0], numpy.eye(4)), part.name
    normals = "" if part.normals is None else f'        normal3f[] normals = [{triples(part.normals)}] (interpolation = "vertex")\n'
    context, shader, output, values = material(part.surface)
    inputs = "\n".join(f"            {kind} inputs:{key} = {value}" for kind, key, value in values)
    counts, indices = ", ".join(["3"] * len(part.triangles)), ", ".join(map(str, part.triangles.ravel()))
    words = {"counts": counts, "indices": indices, "points": triples(part.points), "normals": normals}
    return MESH.format(name=name, context=context, shader=shader, output=output, inputs=inputs, **words)


def triples(values: numpy.ndarray) -> str:
    """Vectors as USD writes them."""
    return ", ".join("({:.9g}, {:.9g}, {:.9g})".format(*value) for value in values.tolist())


def material(surface: Surface) -> tuple[str, str, str, list[tuple[str, str, str]]]:
    """Context, shader, output, and inputs as type, name and value."""
    match surface:
        case Diffuse(reflectance):
            values = [("color3f", "diffuseColor", "({}, {}, {})".format(*reflectance)), ("int", "useSpecularWorkflow", "1")]
            return "", "UsdPreviewSurface", "surface", [*values, ("color3f", "specularColor", "(0, 0, 0)"), ("float", "ior", "1")]
        case Mirror(reflectance, roughness):
            # The tint at 82 degrees that keeps Schlick's rise down: nearly the same factor at all angles.
            tint = reflectance / (reflectance + (1.0 - reflectance) * (1.0 - math.cos(math.radians(82.0))) ** 5)
            grey = [
                ("color3f", key, "({0}, {0}, {0})".format(value)) for key, value in (("base_color", reflectance), ("specular_color", tint))
            ]
            values = [("float", "base_metalness", "1"), *grey]
        case Glass(ior):
            roughness = 0.0
            values = [("float", "transmission_weight", "1"), ("float", "specular_ior", str(ior))]
        case _:
            raise NotImplementedError(surface)
    return "mtlx:", "ND_open_pbr_surface_surfaceshader", "out", [*values, ("float", "specular_roughness", str(roughness))]


def light(name: str, lamp: Light) -> str:
    """A lamp with its radiance as intensity times colour."""
    strength = lamp.intensity if isinstance(lamp, Point) else lamp.radiance
    most = max(strength)
    values = [("color3f", "inputs:color", "({:.9g}, {:.9g}, {:.9g})".format(*(value / most for value in strength)))]
    match lamp:
        case Rectangle(_, width, height):
            kind, sizes = "RectLight", [("float", "inputs:width", width), ("float", "inputs:height", height)]
        case Disk(_, radius):
            kind, sizes = "DiskLight", [("float", "inputs:radius", radius)]
        case Sphere(_, radius):
            kind, sizes = "SphereLight", [("float", "inputs:radius", radius)]
        case Sun(_, angle):
            kind, sizes = "DistantLight", [("float", "inputs:angle", angle)]
        case _:
            raise NotImplementedError(lamp)
    values += [("float", "inputs:intensity", f"{most:.9g}"), *((each[0], each[1], f"{each[2]:.9g}") for each in sizes)]
    body = "".join(f"        {kind_of} {key} = {value}\n" for kind_of, key, value in values)
    return f'    def {kind} "{name}"\n    {{\n{body}{PLACE.format(matrix=rows(lamp.matrix))}    }}\n'


def camera(scene: Scene) -> str:
    """A pinhole: 20.955 mm of sensor across, as tall as the picture."""
    wide = 20.955
    tall = wide * scene.height / scene.width
    focal = 0.5 * tall / numpy.tan(numpy.radians(scene.camera.fov) / 2.0)
    body = (
        f"        float horizontalAperture = {wide}\n        float verticalAperture = {tall:.9g}\n        float focalLength = {focal:.9g}\n"
    )
    body += "        float2 clippingRange = (0.01, 1000)\n"
    return f'    def Camera "Camera"\n    {{\n{body}{PLACE.format(matrix=rows(scene.camera.matrix))}    }}\n'


def rows(matrix: numpy.ndarray) -> str:
    """A matrix for column vectors as USD's for row vectors."""
    return "( " + ", ".join("({:.9g}, {:.9g}, {:.9g}, {:.9g})".format(*row) for row in matrix.T.tolist()) + " )"


def main() -> None:
    """Writes the stage."""
    Path(sys.argv[2]).write_text(stage(described(sys.argv[1])))


if __name__ == "__main__":
    main()
