"""A short way to write node trees of many nodes: each call makes one node and gives its output; and the stage for materials."""

import bpy
import numpy
from stage import ball, blank, camera, diffuse, lamp, node, plane, resolution, shape, soft_sky, socket

Socket = bpy.types.NodeSocket


class Tree:
    """Nodes of one tree."""

    def __init__(self, tree: bpy.types.NodeTree) -> None:
        self.tree = tree

    def make(self, kind: str, output: str | int = 0, **values) -> Socket:
        """A node's output, by name or by place."""
        made = node(self.tree, f"ShaderNode{kind}", **values)
        return made.outputs[output] if isinstance(output, int) else socket(made.outputs, output)

    def place(self, name: str = "Object", **values) -> Socket:
        """Texture coordinates through a Mapping."""
        return self.make("Mapping", Vector=self.make("TexCoord", name), **values)

    def noise(self, place: Socket, scale: float, output: str = "Factor", **values) -> Socket:
        """A Noise Texture; its value is called otherwise before 5.1."""
        return self.make("TexNoise", 0 if output == "Factor" else "Color", Vector=place, Scale=scale, **values)

    def cells(self, place: Socket, scale: float, output: str = "Distance", **values) -> Socket:
        """A Voronoi Texture."""
        return self.make("TexVoronoi", output, Vector=place, Scale=scale, **values)

    def math(self, operation: str, *operands, **fields) -> Socket:
        """A Math node; operands are numbers or outputs."""
        made = node(self.tree, "ShaderNodeMath", operation=operation, **fields)
        return self.filled(made, operands)

    def vector(self, operation: str, *operands) -> Socket:
        """A Vector Math node that gives a vector."""
        return self.filled(node(self.tree, "ShaderNodeVectorMath", operation=operation), operands)

    def scaled(self, value: Socket, factor) -> Socket:
        """A vector times a number."""
        return self.make("VectorMath", operation="SCALE", Vector=value, Scale=factor)

    def filled(self, made: bpy.types.Node, operands) -> Socket:
        """Operands put into a node's inputs in their order."""
        for end, value in zip(made.inputs, operands, strict=False):
            if isinstance(value, Socket):
                self.tree.links.new(value, end)
            else:
                end.default_value = value
        return made.outputs[0]

    def spread(self, value: Socket, low: float, high: float, to_low: float = 0.0, to_high: float = 1.0, **fields) -> Socket:
        """A Map Range."""
        return self.make("MapRange", Value=value, From_Min=low, From_Max=high, To_Min=to_low, To_Max=to_high, **fields)

    def ramp(self, value: Socket, *stops: tuple[float, tuple], interpolation: str = "LINEAR") -> Socket:
        """A Color Ramp."""
        made = node(self.tree, "ShaderNodeValToRGB", Fac=value)
        made.color_ramp.interpolation = interpolation
        points = made.color_ramp.elements
        while len(points) < len(stops):
            points.new(0.5)
        for point, (position, colour) in zip(points, stops, strict=True):
            point.position, point.color = position, (*colour, 1.0)
        return made.outputs[0]

    def mix(self, share, first, second, blend_type: str = "MIX") -> Socket:
        """A Mix node of colours."""
        made = node(self.tree, "ShaderNodeMix", data_type="RGBA", blend_type=blend_type)
        for name, value in (("Factor", share), ("A", first), ("B", second)):
            end = socket(made.inputs, name)
            if isinstance(value, Socket):
                self.tree.links.new(value, end)
            else:
                end.default_value = (*value, 1.0) if isinstance(value, tuple) else value
        return socket(made.outputs, "Result")

    def between(self, share, first: Socket, second: Socket) -> Socket:
        """A Mix Shader."""
        return self.filled(node(self.tree, "ShaderNodeMixShader"), (share, first, second))

    def bump(self, height: Socket, strength, distance: float, **values) -> Socket:
        """A Bump node."""
        return self.make("Bump", Height=height, Strength=strength, Distance=distance, **values)

    def group(self, inner: bpy.types.NodeTree, **values) -> bpy.types.Node:
        """A group node."""
        return node(self.tree, "ShaderNodeGroup", node_tree=inner, **values)

    def end(self, shader: Socket, displacement: Socket | None = None) -> None:
        """The output node."""
        last = node(self.tree, "ShaderNodeOutputMaterial", Surface=shader)
        if displacement is not None:
            self.tree.links.new(displacement, last.inputs["Displacement"])


def begun(name: str) -> tuple[bpy.types.Material, Tree]:
    """A material with an empty tree."""
    made, tree = blank(name)
    return made, Tree(tree)


def inner(name: str, inputs: dict[str, str], outputs: dict[str, str]) -> tuple[bpy.types.NodeTree, Tree, bpy.types.Node, bpy.types.Node]:
    """A node group: itself, its nodes, and its two ends; sockets are "Float", "Vector", "Color"."""
    made = bpy.data.node_groups.new(name, "ShaderNodeTree")
    for way, sockets in (("INPUT", inputs), ("OUTPUT", outputs)):
        for label, kind in sockets.items():
            made.interface.new_socket(label, in_out=way, socket_type=f"NodeSocket{kind}")
    return made, Tree(made), made.nodes.new("NodeGroupInput"), made.nodes.new("NodeGroupOutput")


def on_stage(cover: bpy.types.Material, floor: bpy.types.Material | None = None) -> None:
    """The material on a ball, a ring, and a wavy sheet, under a soft sky and a lamp; the floor may have a material of its own."""
    resolution(192, 128)
    plane(floor or diffuse((0.4, 0.4, 0.4)), size=12.0)
    ball(cover, 0.75, location=(-1.05, -0.2, 0.75)).color = (0.9, 0.6, 0.3, 1.0)
    ring = shape(
        bpy.ops.mesh.primitive_torus_add, cover, smooth=True, major_radius=0.5, minor_radius=0.22, major_segments=64, minor_segments=24
    )
    ring.location, ring.rotation_euler = (0.75, -0.6, 0.5), (0.9, 0.2, 0.0)
    sheet(cover, lambda u, v: 0.12 * numpy.sin(5.0 * u) * numpy.cos(3.0 * v), location=(0.3, 1.3, 0.9), rotation=(1.2, 0.0, -0.1))
    lit()


def lit() -> None:
    """The light and the camera of the stage."""
    soft_sky()
    lamp("AREA", 150.0, (-2.5, -3.0, 4.0), (0.65, -0.45, 0.0), shape="SQUARE", size=1.5, color=(1.0, 0.92, 0.8))
    camera((0.0, -7.0, 4.2), (0.0, 0.1, 0.65), lens=62.0)


def sheet(cover: bpy.types.Material, height, size=(3.2, 1.8), **placed) -> bpy.types.Object:
    """A smooth grid with UV coordinates whose heights are a function of its coordinates."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=48, y_subdivisions=48, size=1.0)
    made = bpy.context.object
    points = numpy.empty(3 * len(made.data.vertices), "f4")
    made.data.vertices.foreach_get("co", points)
    whole = points.reshape(-1, 3) * (*size, 1.0)
    whole[:, 2] = height(whole[:, 0], whole[:, 1])
    made.data.vertices.foreach_set("co", whole.astype("f4").ravel())
    made.data.update()
    bpy.ops.object.shade_smooth()
    made.data.materials.append(cover)
    made.location, made.rotation_euler = placed["location"], placed["rotation"]
    return made
