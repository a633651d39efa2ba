"""What the scenes are built of: meshes, materials as trees of nodes, lamps, worlds, cameras. Metres, watts, radians; no files."""

import bpy
import numpy
from mathutils import Vector

GREY = (0.5, 0.5, 0.5)


def empty() -> None:
    """Begins an empty scene of 128 by 128 pixels with a black world, and Cycles set to leave nothing out."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_percentage = 100
    resolution(128, 128)
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.blur_glossy = cycles.light_sampling_threshold = 0.0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    even_world(0.0)


def resolution(width: int, height: int) -> None:
    """The picture's size, multiples of the compared blocks'."""
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = width, height


def link(name: str, data: bpy.types.ID, location=(0.0, 0.0, 0.0), rotation=(0.0, 0.0, 0.0), scale=(1.0, 1.0, 1.0)) -> bpy.types.Object:
    """Puts an object into the open scene."""
    made = bpy.data.objects.new(name, data)
    made.location, made.rotation_euler, made.scale = location, rotation, scale
    bpy.context.scene.collection.objects.link(made)
    return made


def node(tree: bpy.types.NodeTree, kind: str, **values) -> bpy.types.Node:
    """A node; names in capitals are its inputs ("Base_Color", a value or the output to link), the others fields of the node."""
    made = tree.nodes.new(kind)
    for name, value in values.items():
        if name[0].islower():
            setattr(made, name, value)
    for name, value in values.items():
        if name[0].isupper():
            fill(tree, socket(made.inputs, name.replace("_", " ")), value)
    return made


def socket(sockets, name: str) -> bpy.types.NodeSocket:
    """The socket of a name, or of an identifier: "Fac" is called otherwise since 5.0."""
    return next(each for each in sockets if name in (each.name, each.identifier) and each.enabled)


def fill(tree: bpy.types.NodeTree, end: bpy.types.NodeSocket, value) -> None:
    """Links an output to an input, or sets the input."""
    if isinstance(value, bpy.types.NodeSocket):
        tree.links.new(value, end)
    else:
        end.default_value = (*value, 1.0) if end.type == "RGBA" and len(value) == 3 else value


def blank(name: str) -> tuple[bpy.types.Material, bpy.types.NodeTree]:
    """A material whose tree is empty."""
    made = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0, 0):
        made.use_nodes = True
    made.node_tree.nodes.clear()
    return made, made.node_tree


def surface(tree: bpy.types.NodeTree, shader: bpy.types.Node) -> None:
    """Makes a shader the surface of its material."""
    node(tree, "ShaderNodeOutputMaterial", Surface=shader.outputs[0])


def material(kind: str, **values) -> bpy.types.Material:
    """A material of one shader: "BsdfDiffuse", "Emission", ..."""
    made, tree = blank(kind)
    surface(tree, node(tree, f"ShaderNode{kind}", **values))
    return made


def principled(**values) -> bpy.types.Material:
    """A Principled surface; what is not named has Blender's default."""
    return material("BsdfPrincipled", **values)


def diffuse(colour=GREY) -> bpy.types.Material:
    """A Lambertian surface."""
    return material("BsdfDiffuse", Color=colour)


def shape(make, cover: bpy.types.Material | None, *, smooth: bool = False, **placed) -> bpy.types.Object:
    """One of Blender's primitives: `make` is an operator, `placed` its arguments."""
    make(**placed)
    made = bpy.context.object
    if smooth:
        bpy.ops.object.shade_smooth()
    if cover is not None:
        made.data.materials.append(cover)
    return made


def plane(cover, size=10.0, **placed) -> bpy.types.Object:
    """A square, upwards unless turned."""
    return shape(bpy.ops.mesh.primitive_plane_add, cover, size=size, **placed)


def box(cover, size=1.0, **placed) -> bpy.types.Object:
    """A cube."""
    return shape(bpy.ops.mesh.primitive_cube_add, cover, size=size, **placed)


def ball(cover, radius=0.5, **placed) -> bpy.types.Object:
    """A smooth sphere."""
    return shape(bpy.ops.mesh.primitive_uv_sphere_add, cover, smooth=True, radius=radius, segments=96, ring_count=48, **placed)


def lamp(kind: str, energy: float, location, rotation=(0.0, 0.0, 0.0), **fields) -> bpy.types.Object:
    """A lamp: "POINT", "SUN", "SPOT", "AREA"."""
    made = bpy.data.lights.new(kind, kind)
    made.energy = energy
    for name, value in fields.items():
        setattr(made, name, value)
    return link(kind, made, location, rotation)


def ies(vertical: list[float], horizontal: list[float], candela: list[list[float]]) -> str:
    """An IES file of type C, metres, a point."""
    counts = f"1 -1 1 {len(vertical)} {len(horizontal)} 1 2 0 0 0"
    rows = [" ".join(str(value) for value in row) for row in (vertical, horizontal, *candela)]
    return "\n".join(["IESNA:LM-63-2002", "TILT=NONE", counts, "1 1 10", *rows, ""])


def distribution(thing: bpy.types.Object, text: str, strength: float) -> None:
    """Lets an IES texture drive a lamp."""
    light, file = thing.data, bpy.data.texts.new("distribution.ies")
    file.write(text)
    light.use_nodes = True
    tree = light.node_tree
    emission = next(each for each in tree.nodes if each.bl_idname == "ShaderNodeEmission")
    texture = node(tree, "ShaderNodeTexIES", ies=file, Strength=strength)
    tree.links.new(texture.outputs[0], emission.inputs["Strength"])



def looking(location, target):
    """The rotation of a lamp or a camera that looks at a point."""
    return (Vector(target) - Vector(location)).to_track_quat("-Z", "Y").to_euler()


def camera(location, target, **fields) -> bpy.types.Object:
    """The scene's camera, looking at a point."""
    data = bpy.data.cameras.new("Camera")
    for name, value in fields.items():
        setattr(data, name, value)
    made = link("Camera", data, location, looking(location, target))
    bpy.context.scene.camera = made
    return made


def new_world() -> bpy.types.NodeTree:
    """A new world's empty tree."""
    made = bpy.context.scene.world = bpy.data.worlds.new("World")
    if bpy.app.version < (5, 0, 0):
        made.use_nodes = True
    made.node_tree.nodes.clear()
    return made.node_tree


def even_world(strength: float, colour=(1.0, 1.0, 1.0)) -> None:
    """A world of one colour."""
    tree = new_world()
    shown = node(tree, "ShaderNodeBackground", Color=colour, Strength=strength)
    node(tree, "ShaderNodeOutputWorld", Surface=shown.outputs[0])


def image_world(picture: bpy.types.Image, strength: float = 1.0, rotation=(0.0, 0.0, 0.0)) -> None:
    """A latitude-longitude image around the scene, turned."""
    tree = new_world()
    place = node(tree, "ShaderNodeTexCoord")
    turned = node(tree, "ShaderNodeMapping", Vector=place.outputs["Generated"], Rotation=rotation)
    sky = node(tree, "ShaderNodeTexEnvironment", image=picture, Vector=turned.outputs[0])
    shown = node(tree, "ShaderNodeBackground", Color=sky.outputs["Color"], Strength=strength)
    node(tree, "ShaderNodeOutputWorld", Surface=shown.outputs[0])


def sky_world(kind: str, strength: float, **values) -> None:
    """A Sky Texture; `kind` is its type since Blender 5.0."""
    tree = new_world()
    old = {"SINGLE_SCATTERING": "NISHITA"} if bpy.app.version < (5, 0, 0) else {}
    sky = node(tree, "ShaderNodeTexSky", sky_type=old.get(kind, kind), **values)
    shown = node(tree, "ShaderNodeBackground", Color=sky.outputs[0], Strength=strength)
    node(tree, "ShaderNodeOutputWorld", Surface=shown.outputs[0])


def image(name: str, pixels: numpy.ndarray, *, is_float: bool = False, colours: str | None = None) -> bpy.types.Image:
    """A packed image of (height, width, 3 or 4) values, the bottom row first; `colours` names its colour space."""
    height, width, channels = pixels.shape
    made = bpy.data.images.new(name, width, height, alpha=channels == 4, float_buffer=is_float)
    if colours is not None:
        made.colorspace_settings.name = colours
    whole = numpy.ones((height, width, 4), "f4")
    whole[..., :channels] = pixels
    made.pixels.foreach_set(whole.ravel())
    made.pack()
    return made


def soft_sky() -> None:
    """A smooth world, brighter on one side: light from everywhere that still has a direction."""
    height, width = 32, 64
    up = numpy.sin(numpy.pi * ((numpy.arange(height) + 0.5) / height - 0.5))[:, None]
    around = numpy.cos(2.0 * numpy.pi * (numpy.arange(width) + 0.5) / width)[None, :]
    level = 0.35 + 0.25 * up + 0.2 * around * numpy.sqrt(1.0 - up * up)
    image_world(image("Sky", level[..., None] * numpy.array([0.9, 1.0, 1.15]), is_float=True))


def lit_floor(colour=(0.4, 0.4, 0.4)) -> None:
    """A floor under a soft sky and a wide area light."""
    plane(diffuse(colour), size=14.0)
    soft_sky()
    lamp("AREA", 150.0, (-2.5, -3.0, 4.0), (0.65, -0.45, 0.0), shape="DISK", size=4.0, color=(1.0, 0.9, 0.75))


def rows_of_balls(covers: list[bpy.types.Material], columns: int) -> None:
    """Balls on the floor in rows, the first at the back on the left, and a camera that has all in view."""
    rows = -(-len(covers) // columns)
    for number, cover in enumerate(covers):
        row, column = divmod(number, columns)
        ball(cover, 0.45, location=(column - 0.5 * (columns - 1), 0.65 * (rows - 1) - 1.3 * row, 0.45))
    camera((0.0, -8.5, 7.0), (0.0, -0.05, 0.3), lens=36.0 * 10.8 / (columns + 0.25))
