"""Cameras, and instances from geometry nodes, in the same garden of balls and boxes."""

from math import pi, radians

import bpy
import numpy
from stage import ball, blank, box, camera, diffuse, lamp, node, plane, principled, resolution, socket, soft_sky, surface


def garden(width: int, height: int) -> None:
    """Things in a ring at several distances, coloured, under a soft sky and a sun."""
    resolution(width, height)
    plane(diffuse((0.45, 0.45, 0.4)), size=30.0)
    soft_sky()
    lamp("SUN", 2.0, (0.0, 0.0, 5.0), (0.6, -0.4, 0.2), angle=radians(10))
    for number in range(8):
        angle = 2.0 * pi * number / 8.0
        colour = tuple(0.4 + 0.35 * numpy.cos(angle + shift) for shift in (0.0, 2.1, 4.2))
        place = ((1.6 + 0.3 * number) * numpy.cos(angle), (1.6 + 0.3 * number) * numpy.sin(angle), 0.5)
        (ball if number % 2 else box)(principled(Base_Color=colour, Roughness=0.5), location=place)


def perspective_shifted() -> None:
    garden(192, 128)
    camera((0.5, -7.0, 3.0), (0.0, 0.0, 0.4), lens=35.0, shift_x=0.1, shift_y=-0.08)


def orthographic() -> None:
    garden(192, 128)
    camera((3.0, -7.0, 5.0), (0.2, 0.0, 0.4), type="ORTHO", ortho_scale=7.0)


def depth_of_field() -> None:
    """A wide, six-bladed, stretched aperture that is sharp at the near things."""
    garden(192, 128)
    lens = camera((0.5, -6.5, 2.2), (0.0, 0.0, 0.4), lens=50.0).data.dof
    lens.use_dof, lens.focus_distance, lens.aperture_fstop = True, 5.0, 0.15
    lens.aperture_blades, lens.aperture_rotation, lens.aperture_ratio = 6, 0.3, 1.5


def panoramic() -> None:
    garden(192, 96)
    camera((0.0, 0.0, 1.0), (1.0, -3.0, 0.9), type="PANO", panorama_type="EQUIRECTANGULAR")


def fisheye() -> None:
    garden(128, 128)
    camera((0.0, 0.0, 1.2), (1.0, -3.0, 0.6), type="PANO", panorama_type="FISHEYE_EQUISOLID", fisheye_lens=10.5, fisheye_fov=pi)


def instances() -> None:
    """A mesh on the points of a grid, turned and scaled at random, coloured by each instance's random number."""
    resolution(192, 128)
    plane(diffuse((0.5, 0.5, 0.5)), size=20.0)
    soft_sky()
    lamp("AREA", 150.0, (-2.5, -3.0, 4.0), (0.65, -0.45, 0.0), shape="SQUARE", size=1.5)
    camera((0.0, -7.0, 5.0), (0.0, 0.0, 0.2), lens=45.0)
    seed = ball(by_random(), 0.18)
    seed.scale = (1.0, 1.0, 1.6)
    seed.hide_render = True
    carrier = plane(None, size=5.0, location=(0.0, 0.0, 0.3))
    carrier.modifiers.new("Scatter", "NODES").node_group = scatter(seed)


def by_random() -> bpy.types.Material:
    """Coloured by the object's random number."""
    made, tree = blank("By random")
    chance = node(tree, "ShaderNodeObjectInfo").outputs["Random"]
    mixed = node(tree, "ShaderNodeCombineColor", Red=chance, Green=0.4, Blue=0.2)
    surface(tree, node(tree, "ShaderNodeBsdfPrincipled", Base_Color=mixed.outputs[0], Roughness=0.5))
    return made


def scatter(seed: bpy.types.Object) -> bpy.types.GeometryNodeTree:
    """Geometry nodes: a grid of 7 by 5 points with an instance on each."""
    tree = bpy.data.node_groups.new("Scatter", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="OUTPUT", socket_type="NodeSocketGeometry")
    grid = node(tree, "GeometryNodeMeshGrid", Size_X=4.4, Size_Y=3.2, Vertices_X=7, Vertices_Y=5)
    thing = node(tree, "GeometryNodeObjectInfo", Object=seed)
    turned = node(tree, "FunctionNodeRandomValue", data_type="FLOAT_VECTOR", Min=(-0.6, -0.6, 0.0), Max=(0.6, 0.6, 6.0), Seed=3)
    size = node(tree, "FunctionNodeRandomValue", data_type="FLOAT", Min=0.6, Max=1.4, Seed=5)
    placed = node(
        tree,
        "GeometryNodeInstanceOnPoints",
        Points=grid.outputs["Mesh"],
        Instance=thing.outputs["Geometry"],
        Rotation=socket(turned.outputs, "Value"),
        Scale=socket(size.outputs, "Value"),
    )
    node(tree, "NodeGroupOutput", Geometry=placed.outputs[0])
    return tree
