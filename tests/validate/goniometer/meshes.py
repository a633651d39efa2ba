"""Text of USD prims: meshes of revolution with the normals of their exact surfaces, boxes, materials and lights. Lengths are in metres."""

from collections.abc import Callable

import numpy

HEAD = '#usda 1.0\n(\n    defaultPrim = "Lamp"\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n'
# Radii, heights and the normals' shares outward and up.
Rings = tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray, numpy.ndarray]
Profile = Callable[[numpy.ndarray], Rings]
# Points, normals and faces.
Surface = tuple[numpy.ndarray, numpy.ndarray, list[list[int]]]
FlatSurface = tuple[numpy.ndarray, None, list[list[int]]]


def tuples(rows: numpy.ndarray) -> str:
    """Numbers of points or directions."""
    return ", ".join("(" + ", ".join(f"{x:.9g}" for x in row) + ")" for row in rows)


def revolved(profile: Profile, steps: int, segments: int) -> Surface:
    """A profile about the z axis, which is asked for places from 0 to 1. Faces look along the normals."""
    r, z, across, along = profile(numpy.linspace(0.0, 1.0, steps + 1))
    angle = numpy.arange(segments) * (2 * numpy.pi / segments)
    rows, bends, rings, first = [], [], [], 0
    for i in range(steps + 1):
        turns = numpy.zeros(1) if abs(r[i]) < 1e-12 else angle
        rings.append(first + (numpy.arange(segments) if len(turns) > 1 else numpy.zeros(segments, int)))
        first += len(turns)
        rows.append(numpy.stack([r[i] * numpy.cos(turns), r[i] * numpy.sin(turns), numpy.full(len(turns), z[i])], -1))
        bends.append(numpy.stack([across[i] * numpy.cos(turns), across[i] * numpy.sin(turns), numpy.full(len(turns), along[i])], -1))
    points, normals = numpy.concatenate(rows), numpy.concatenate(bends)
    faces = []
    for upper, lower in zip(rings, rings[1:], strict=False):
        for j in range(segments):
            k = (j + 1) % segments
            corners = list(dict.fromkeys([int(upper[j]), int(upper[k]), int(lower[k]), int(lower[j])]))
            a, b, c = points[corners[:3]]
            if numpy.dot(numpy.cross(b - a, c - a), normals[corners].sum(axis=0)) < 0:
                corners.reverse()
            faces.append(corners)
    return points, normals, faces


def joined(*parts: Surface) -> Surface:
    """Several surfaces as one."""
    points, normals, faces, first = [], [], [], 0
    for part_points, part_normals, part_faces in parts:
        points.append(part_points)
        normals.append(part_normals)
        faces.extend([[first + corner for corner in face] for face in part_faces])
        first += len(part_points)
    return numpy.concatenate(points), numpy.concatenate(normals), faces


def mesh(
    name: str,
    surface: Surface | FlatSurface,
    material: str,
    parts: dict[str, list[int]] | None = None,
) -> str:
    """A mesh, smooth where it has normals and else flat; `parts` binds faces to other materials."""
    points, normals, faces = surface
    subsets = "".join(
        f'''        def GeomSubset "{part}" (prepend apiSchemas = ["MaterialBindingAPI"])
        {{
            uniform token elementType = "face"
            uniform token familyName = "materialBind"
            int[] indices = [{", ".join(map(str, members))}]
            rel material:binding = </Lamp/Materials/{part}>
        }}
'''
        for part, members in (parts or {}).items()
    )
    smooth = "" if normals is None else f'        normal3f[] normals = [{tuples(normals)}] (interpolation = "vertex")\n'
    return f'''    def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        uniform token subdivisionScheme = "none"
        uniform bool doubleSided = true
        int[] faceVertexCounts = [{", ".join(str(len(face)) for face in faces)}]
        int[] faceVertexIndices = [{", ".join(str(corner) for face in faces for corner in face)}]
        point3f[] points = [{tuples(points)}]
{smooth}        rel material:binding = </Lamp/Materials/{material}>
{subsets}    }}
'''


def surface_of(name: str, identifier: str, inputs: str, context: str = "mtlx:", output: str = "out") -> str:
    """A material of one surface shader."""
    return f'''        def Material "{name}"
        {{
            token outputs:{context}surface.connect = </Lamp/Materials/{name}/Surface.outputs:{output}>
            def Shader "Surface"
            {{
                uniform token info:id = "{identifier}"
{inputs}                token outputs:{output}
            }}
        }}
'''


def glass(name: str, index: float) -> str:
    """Clear, smooth and solid; no absorption."""
    inputs = f"""                float inputs:specular_ior = {index}
                float inputs:specular_roughness = 0
                float inputs:transmission_weight = 1
"""
    return surface_of(name, "ND_open_pbr_surface_surfaceshader", inputs)


def mirror(name: str, reflectance: float) -> str:
    """Of one reflectance at all angles, which UsdPreviewSurface's metals have."""
    inputs = f"""                color3f inputs:diffuseColor = ({reflectance}, {reflectance}, {reflectance})
                float inputs:metallic = 1
                float inputs:roughness = 0
"""
    return surface_of(name, "UsdPreviewSurface", inputs, context="", output="surface")


def diffuse(name: str, reflectance: float, transmittance: float = 0.0) -> str:
    """Lambertian on both sides, and Lambertian through."""
    through = f"""            def Shader "Through"
            {{
                uniform token info:id = "ND_translucent_bsdf"
                color3f inputs:color = ({transmittance}, {transmittance}, {transmittance})
                token outputs:out
            }}
            def Shader "Sum"
            {{
                uniform token info:id = "ND_add_bsdf"
                token inputs:in1.connect = </Lamp/Materials/{name}/Back.outputs:out>
                token inputs:in2.connect = </Lamp/Materials/{name}/Through.outputs:out>
                token outputs:out
            }}
"""
    last = "Sum" if transmittance else "Back"
    return f'''        def Material "{name}"
        {{
            token outputs:mtlx:surface.connect = </Lamp/Materials/{name}/Surface.outputs:out>
            def Shader "Surface"
            {{
                uniform token info:id = "ND_surface"
                token inputs:bsdf.connect = </Lamp/Materials/{name}/{last}.outputs:out>
                token outputs:out
            }}
            def Shader "Back"
            {{
                uniform token info:id = "ND_oren_nayar_diffuse_bsdf"
                color3f inputs:color = ({reflectance}, {reflectance}, {reflectance})
                float inputs:roughness = 0
                token outputs:out
            }}
{through if transmittance else ""}        }}
'''


def light(kind: str, lumens: float, body: str, transform: str = "") -> str:
    """A light of UsdLux with a luminous flux. Lights block nothing; those with a face shine to their own −z."""
    place = f"        {transform}\n" if transform else ""
    return f"""    def {kind} "Source"
    {{
        color3f inputs:color = (1, 1, 1)
        double gonio:photometry:quantity = {lumens}
        token gonio:photometry:unit = "lm"
{body}{place}    }}
"""


def stage(materials: str, *prims: str) -> str:
    """The whole file."""
    scope = f'    def Scope "Materials"\n    {{\n{materials}    }}\n'
    return f'{HEAD}def Xform "Lamp" (kind = "component")\n{{\n{scope}{"".join(prims)}}}\n'
