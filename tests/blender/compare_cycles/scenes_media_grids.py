"""Volume objects with grids of files: smoke, clouds, fire; by both of Cycles' estimators."""

import tempfile
from math import radians
from pathlib import Path

import bpy
import numpy
from scenes_media import hall, instances_of, medium, scattered, shaded
from stage import even_world, lamp, link, node, soft_sky


def by_steps(make) -> None:
    """The scene by Cycles' marching, with short steps. It is the only way before Blender 5.0."""
    make()
    cycles = bpy.context.scene.cycles
    cycles.volume_step_rate = 0.25
    if bpy.app.version >= (5, 0, 0):
        cycles.volume_biased = True


def space(edge: int) -> numpy.ndarray:
    """Places of voxels from -1 to 1, (3, edge, edge, edge)."""
    along = numpy.linspace(-1.0, 1.0, edge)
    return numpy.array(numpy.meshgrid(along, along, along, indexing="ij"))


def lumps(x, y, z) -> numpy.ndarray:
    """Waves of three lengths that stand in for noise, from -1 to 1."""
    first = numpy.sin(5.0 * x + 1.0) * numpy.sin(4.0 * y + 2.0 * z) * numpy.cos(6.0 * z - x)
    second = numpy.sin(11.0 * x - 4.0 * y) * numpy.cos(13.0 * z + 3.0 * y + 1.0)
    return 0.6 * first + 0.4 * second


def stored(voxel: float, **grids: numpy.ndarray) -> Path:
    """A file of grids about the origin, away with Blender's session."""
    bpy.utils.expose_bundled_modules()
    import openvdb

    made = []
    for name, values in grids.items():
        grid = openvdb.FloatGrid() if values.ndim == 3 else openvdb.Vec3SGrid()
        grid.copyFromArray(values.astype("f4"), ijk=tuple(-edge // 2 for edge in values.shape[:3]))
        grid.name, grid.transform = name, openvdb.createLinearTransform(voxelSize=voxel)
        made.append(grid)
    path = Path(tempfile.mkdtemp(dir=bpy.app.tempdir)) / "grids.vdb"
    openvdb.write(str(path), grids=made)
    return path


def volume(path: Path, cover: bpy.types.Material, **placed) -> bpy.types.Object:
    """A volume object that shows a file."""
    data = bpy.data.volumes.new("Volume")
    data.filepath = str(path)
    data.materials.append(cover)
    return link("Volume", data, **placed)


def plume(edge: int) -> numpy.ndarray:
    """A thin column that widens upwards and breaks up, 0 to 1."""
    x, y, z = space(edge)
    away = numpy.hypot(x - 0.2 * numpy.sin(4.0 * z), y) / (0.45 + 0.2 * z)
    return numpy.clip(1.0 - away, 0.0, 1.0) * numpy.clip(1.0 + lumps(x, y, z), 0.0, 2.0) * 0.5 * (numpy.abs(z) < 0.95)


def heap(edge: int) -> numpy.ndarray:
    """A ball with a rough rim, dense within, 0 to 1."""
    x, y, z = space(edge)
    return numpy.clip(4.0 * (0.75 - numpy.sqrt(x * x + y * y + z * z) + 0.15 * lumps(x, y, z)), 0.0, 1.0)


def thin_smoke() -> None:
    """A plume in sun and lamp."""
    scattered(2)
    even_world(0.2, (0.6, 0.8, 1.0))
    hall()
    cover = medium("VolumePrincipled", Color=(0.7, 0.75, 0.8), Density=3.0, Anisotropy=0.3)
    volume(stored(1.0 / 20.0, density=plume(40)), cover, location=(-0.3, 0.0, 1.1))
    lamp("SUN", 3.0, (0.0, 0.0, 5.0), (0.7, -0.3, 0.4), angle=radians(4))
    lamp("POINT", 40.0, (-1.4, -0.8, 1.0), color=(1.0, 0.6, 0.3), shadow_soft_size=0.2, use_soft_falloff=True)


def dense_cloud() -> None:
    """A heap that light goes around more than through; many bounces."""
    scattered(16)
    soft_sky()
    hall()
    cover = medium("VolumePrincipled", Color=(0.95, 0.95, 0.95), Density=16.0, Anisotropy=0.5)
    volume(stored(1.0 / 24.0, density=heap(48)), cover, location=(-0.3, 0.0, 1.1), rotation=(0.2, 0.1, 0.5))
    lamp("SUN", 3.0, (0.0, 0.0, 5.0), (0.7, -0.3, 0.4), angle=radians(4))


def sparse_fire() -> None:
    """Flames in a corner of a large box of nothing, as black bodies by temperature, with a little soot."""
    scattered(1)
    even_world(0.05)
    hall()
    cover = medium("VolumePrincipled", Color=(0.3, 0.3, 0.3), Density=1.5, Blackbody_Intensity=1.0, Temperature=1800.0)
    heat = numpy.zeros((120, 120, 120))
    heat[4:64, 4:64, 4:64] = plume(60)
    volume(stored(1.0 / 40.0, density=heat, temperature=heat), cover, location=(0.8, 0.8, 1.6))


def volume_instances() -> None:
    """Instances of a collection of a volume object."""
    scattered(2)
    soft_sky()
    hall()
    cover = medium("VolumePrincipled", Color=(0.8, 0.6, 0.4), Density=5.0, Anisotropy=0.3)
    instances_of([volume(stored(1.0 / 20.0, density=heap(24)), cover)])
    lamp("SUN", 3.0, (0.0, 0.0, 5.0), (0.7, -0.3, 0.4), angle=radians(4))


def domain_smoke() -> None:
    """Volume Info as a domain of smoke and fire has it: density and flames of a file, since Blender as a module cannot simulate."""
    scattered(1)
    even_world(0.3)
    hall()
    made, tree, shader = shaded("VolumePrincipled", Color=(0.4, 0.4, 0.4), Anisotropy=0.0)
    shader.inputs["Density Attribute"].default_value = ""
    told = node(tree, "ShaderNodeVolumeInfo")
    for name, factor, target in (("Density", 4.0, "Density"), ("Flame", 2.0, "Emission Strength")):
        scaled = node(tree, "ShaderNodeMath", operation="MULTIPLY")
        tree.links.new(told.outputs[name], scaled.inputs[0])
        scaled.inputs[1].default_value = factor
        tree.links.new(scaled.outputs[0], shader.inputs[target])
    shader.inputs["Emission Color"].default_value = (1.0, 0.4, 0.1, 1.0)
    smoke = plume(40)
    flame = smoke * (numpy.arange(40) < 20)
    volume(stored(1.0 / 20.0, density=smoke, flame=flame), made, location=(-0.3, 0.0, 1.1))
    lamp("SUN", 3.0, (0.0, 0.0, 5.0), (0.7, -0.3, 0.4), angle=radians(4))


def attributes() -> None:
    """An Attribute node: density through a power, in a shader that scatters."""
    scattered(2)
    even_world(0.3)
    hall()
    made, tree, shader = shaded("VolumeScatter", Color=(0.8, 0.7, 0.6))
    power = node(tree, "ShaderNodeMath", operation="POWER")
    tree.links.new(node(tree, "ShaderNodeAttribute", attribute_name="fume").outputs["Fac"], power.inputs[0])
    power.inputs[1].default_value = 2.0
    scaled = node(tree, "ShaderNodeMath", operation="MULTIPLY")
    tree.links.new(power.outputs[0], scaled.inputs[0])
    scaled.inputs[1].default_value = 6.0
    tree.links.new(scaled.outputs[0], shader.inputs["Density"])
    volume(stored(1.0 / 20.0, fume=heap(40)), made, location=(-0.3, 0.0, 1.1))
    lamp("SUN", 3.0, (0.0, 0.0, 5.0), (0.7, -0.3, 0.4), angle=radians(4))


def thin_smoke_by_steps() -> None:
    by_steps(thin_smoke)


def dense_cloud_by_steps() -> None:
    by_steps(dense_cloud)


def sparse_fire_by_steps() -> None:
    by_steps(sparse_fire)


def volume_instances_by_steps() -> None:
    by_steps(volume_instances)


def domain_smoke_by_steps() -> None:
    by_steps(domain_smoke)


def attributes_by_steps() -> None:
    by_steps(attributes)
