"""Hair: strands of a particle system, hair curves, and shaders of hair one by one."""

import bpy
import numpy
from stage import blank, camera, diffuse, link, lit_floor, material, node, resolution, shape, surface

MELANIN = {"parametrization": "MELANIN", "Melanin": 0.5, "Melanin_Redness": 0.3}


def strands(count: int, *, length: float = 0.35, seed: int = 1) -> bpy.types.Object:
    """Curves that stand on half a ball and droop."""
    random = numpy.random.default_rng(seed)
    roots = random.normal(size=(count, 3))
    roots[:, 2] = numpy.abs(roots[:, 2])
    roots *= 0.5 / numpy.linalg.norm(roots, axis=1, keepdims=True)
    t = numpy.linspace(0.0, 1.0, 8)[None, :, None]
    along = roots / 0.5 + random.normal(size=roots.shape) * 0.2
    points = roots[:, None] + along[:, None] * t * length
    points[..., 2] += 0.5 - 0.4 * length * t[..., 0] ** 2
    made = bpy.data.hair_curves.new("Strands")
    made.add_curves([8] * count)
    made.position_data.foreach_set("vector", points.astype(numpy.float32).reshape(-1))
    radii = numpy.repeat((0.006 * (1.0 - 0.8 * t[0, :, 0]))[None], count, axis=0)
    made.attributes.new("radius", "FLOAT", "POINT").data.foreach_set("value", radii.astype(numpy.float32).reshape(-1))
    return link("Strands", made)


def hair_curves() -> None:
    """Hair curves with Chiang's model, as tubes."""
    resolution(192, 192)
    bpy.context.scene.cycles_curves.shape = "THICK"
    lit_floor()
    shape(bpy.ops.mesh.primitive_uv_sphere_add, diffuse((0.3, 0.2, 0.15)), smooth=True, radius=0.49, location=(0.0, 0.0, 0.5))
    strands(1500).data.materials.append(material("BsdfHairPrincipled", **MELANIN))
    camera((0.0, -4.5, 2.0), (0.0, 0.0, 0.5), lens=60.0)


def hair_ribbons() -> None:
    """The same as ribbons, with the colour of each strand by the Curves Info node."""
    hair_curves()
    bpy.context.scene.cycles_curves.shape = "RIBBONS"
    made, tree = blank("By strand")
    info, ramp = node(tree, "ShaderNodeHairInfo"), node(tree, "ShaderNodeCombineXYZ")
    for output, end in (("Intercept", "X"), ("Random", "Y"), ("Length", "Z")):
        tree.links.new(info.outputs[output], ramp.inputs[end])
    surface(tree, node(tree, "ShaderNodeBsdfDiffuse", Color=ramp.outputs[0]))
    strands_of = bpy.data.objects["Strands"].data
    strands_of.materials.clear()
    strands_of.materials.append(made)


def hair_elliptic() -> None:
    """Huang's model, whose strands are flat along the normals of the curves, as ribbons."""
    hair_curves()
    bpy.context.scene.cycles_curves.shape = "RIBBONS"
    strands_of = bpy.data.objects["Strands"].data
    strands_of.materials.clear()
    strands_of.materials.append(material("BsdfHairPrincipled", model="HUANG", Aspect_Ratio=0.6, **MELANIN))


def fur() -> None:
    """A ball with the hair of a particle system, its children included, coloured directly."""
    resolution(192, 192)
    bpy.context.scene.cycles_curves.shape = "THICK"
    lit_floor()
    ball = shape(bpy.ops.mesh.primitive_uv_sphere_add, diffuse((0.3, 0.2, 0.15)), smooth=True, radius=0.4, location=(0.0, 0.0, 0.5))
    ball.data.materials.append(material("BsdfHairPrincipled", parametrization="COLOR", Color=(0.6, 0.3, 0.15), Roughness=0.25))
    ball.modifiers.new("Fur", "PARTICLE_SYSTEM")
    settings = ball.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length, settings.material = "HAIR", 400, 0.25, 2
    settings.child_type, settings.rendered_child_count = "SIMPLE", 4
    settings.root_radius, settings.tip_radius, settings.radius_scale = 1.0, 0.2, 0.02
    camera((0.0, -4.5, 2.0), (0.0, 0.0, 0.5), lens=60.0)


def tube(cover: bpy.types.Material, x: float, *, around: int = 96) -> None:
    """An open upright tube whose triangles begin with an edge along it, which Cycles takes for the direction of hair on meshes."""
    turns = 2.0 * numpy.pi * numpy.arange(around) / around
    ring = numpy.stack([0.3 * numpy.cos(turns), 0.3 * numpy.sin(turns)], axis=1)
    points = [(*place, z) for place in ring for z in (0.0, 1.5)]
    triangles, corners = [], []
    for i in range(around):
        a, b = 2 * i, 2 * ((i + 1) % around)
        triangles += [(a + 1, a, b), (b, b + 1, a + 1)]
        low, high = i / around, (i + 1) / around
        corners += [(1.0, low), (0.0, low), (0.0, high), (0.0, high), (1.0, high), (1.0, low)]
    mesh = bpy.data.meshes.new("Tube")
    mesh.from_pydata(points, [], triangles)
    mesh.uv_layers.new(name="Map").uv.foreach_set("vector", numpy.array(corners, dtype=numpy.float32).reshape(-1))
    mesh.materials.append(cover)
    link("Tube", mesh, (x, 0.0, 0.0))


def hair_shaders() -> None:
    """Shaders of hair on tubes: both parts of the older one, and Chiang's in three ways to say its colour; edges run both ways."""
    resolution(64 * 5, 96)
    lit_floor()
    older = {"Color": (0.6, 0.4, 0.3), "RoughnessU": 0.4, "RoughnessV": 0.7, "Tangent": (0.0, 0.0, 1.0)}
    covers = [
        material("BsdfHair", component="Reflection", **older),
        material("BsdfHair", component="Transmission", **older),
        material("BsdfHairPrincipled", Offset=0.0, **MELANIN),
        material("BsdfHairPrincipled", parametrization="COLOR", Color=(0.5, 0.3, 0.2), Roughness=0.5, Radial_Roughness=0.6, Offset=0.0),
        material("BsdfHairPrincipled", parametrization="ABSORPTION", Coat=0.5, IOR=1.4, Offset=0.0),
    ]
    for number, cover in enumerate(covers):
        tube(cover, number - 2.0)
    camera((0.0, -8.5, 4.0), (0.0, 0.0, 0.7), lens=60.0)
