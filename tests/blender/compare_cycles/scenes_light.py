"""Each type of light over the same corner of a room."""

from math import radians

import bpy
import numpy
from stage import ball, box, camera, diffuse, distribution, even_world, ies, image, image_world, lamp, material, plane, principled, sky_world


def corner() -> None:
    """A floor, a wall, a plastic ball and a box, and so little light from everywhere that no part is without."""
    even_world(0.1)
    plane(diffuse((0.6, 0.6, 0.6)))
    plane(diffuse((0.7, 0.5, 0.35)), location=(0.0, 2.0, 0.0), rotation=(radians(90), 0.0, 0.0))
    ball(principled(Base_Color=(0.15, 0.4, 0.7), Roughness=0.4), 0.6, location=(-0.7, 0.2, 0.6))
    box(diffuse((0.4, 0.6, 0.3)), location=(0.9, 0.4, 0.5), rotation=(0.0, 0.0, 0.4))
    camera((0.0, -6.5, 2.4), (0.0, 0.3, 0.8), lens=50.0)


def point() -> None:
    """A point without size, and two balls, one of them with soft falloff."""
    corner()
    lamp("POINT", 90.0, (-1.6, -1.2, 2.6), color=(1.0, 0.6, 0.4), shadow_soft_size=0.0)
    lamp("POINT", 90.0, (1.8, -0.9, 2.2), color=(0.3, 0.6, 1.0), shadow_soft_size=0.3, use_soft_falloff=False)
    lamp("POINT", 30.0, (0.1, -1.8, 0.7), color=(0.4, 1.0, 0.5), shadow_soft_size=0.2, use_soft_falloff=True)


def sun() -> None:
    corner()
    lamp("SUN", 3.0, (0.0, 0.0, 5.0), (0.7, -0.3, 0.4), angle=radians(8))


def spot() -> None:
    corner()
    lamp("SPOT", 500.0, (-1.8, -2.2, 3.2), (0.65, -0.45, 0.0), spot_size=radians(70), spot_blend=0.4, shadow_soft_size=0.1)
    blue = {"color": (0.4, 0.6, 1.0), "shadow_soft_size": 0.25}
    lamp("SPOT", 300.0, (2.2, -2.0, 2.6), (0.7, 0.55, 0.0), spot_size=radians(50), spot_blend=0.0, **blue)


def goniogram() -> None:
    """Two lamps with IES textures, no plane of theirs like another, one of them turned."""
    corner()
    # Fine enough that it does not count that Cycles takes cubic curves between the angles.
    vertical, horizontal = numpy.arange(0, 181, 5), numpy.arange(0, 361, 15)
    down, around = numpy.radians(vertical), numpy.radians(horizontal)[:, None]
    candela = 900 * numpy.cos(down / 2) ** 4 * (1 + numpy.sin(down) * (0.5 * numpy.cos(around) + 0.3 * numpy.sin(2 * around)))
    text = ies(vertical, horizontal, candela.round(3))
    distribution(lamp("POINT", 1.0, (0.2, -1.4, 2.8), shadow_soft_size=0.05, use_soft_falloff=False), text, 1.0)
    distribution(lamp("POINT", 0.5, (-1.9, -1.0, 1.5), (0.3, -0.9, 0.7), color=(1.0, 0.7, 0.4), shadow_soft_size=0.0), text, 0.8)


def area(**fields) -> None:
    """An area light in the corner."""
    corner()
    lamp("AREA", 120.0, (-1.2, -1.6, 3.0), (0.5, -0.3, 0.5), **fields)


def area_square() -> None:
    area(shape="SQUARE", size=1.0)


def area_rectangle() -> None:
    area(shape="RECTANGLE", size=2.0, size_y=0.4, spread=radians(120))


def area_disk() -> None:
    area(shape="DISK", size=1.2, spread=radians(70))


def area_ellipse() -> None:
    area(shape="ELLIPSE", size=1.8, size_y=0.6, spread=radians(140))


def mesh_emitter() -> None:
    """A slab that glows close above the floor, and a glowing ball."""
    corner()
    box(material("Emission", Color=(1.0, 0.7, 0.4), Strength=2.0), location=(-0.5, -1.1, 0.2), scale=(1.2, 0.5, 0.1))
    ball(material("Emission", Color=(0.3, 0.6, 1.0), Strength=3.0), 0.3, location=(0.9, -0.9, 0.6))


def _linked(emitter, name, states, kind="receiver_collection") -> None:
    """Gives an emitter a collection of receivers or blockers; `states` are link states by object."""
    collection = bpy.data.collections.new(name)
    for thing in states:
        collection.objects.link(thing)
    for thing, entry in zip(collection.objects, collection.collection_objects, strict=True):
        entry.light_linking.link_state = states[thing]
    setattr(emitter.light_linking, kind, collection)


def light_linking() -> None:
    """A red lamp for the ball alone, a green one for all but the box, a blue one that the ball does not block, a slab that lights the floor alone."""
    even_world(0.1)
    floor = plane(diffuse((0.6, 0.6, 0.6)))
    plane(diffuse((0.7, 0.5, 0.35)), location=(0.0, 2.0, 0.0), rotation=(radians(90), 0.0, 0.0))
    round_one = ball(principled(Base_Color=(0.15, 0.4, 0.7), Roughness=0.4), 0.6, location=(-0.7, 0.2, 0.6))
    square_one = box(diffuse((0.4, 0.6, 0.3)), location=(0.9, 0.4, 0.5), rotation=(0.0, 0.0, 0.4))
    slab = box(material("Emission", Color=(1.0, 0.7, 0.4), Strength=3.0), location=(0.2, -1.4, 0.3), scale=(0.8, 0.2, 0.1))
    soft = {"shadow_soft_size": 0.2, "use_soft_falloff": False}
    red = lamp("POINT", 60.0, (-1.6, -1.2, 2.6), color=(1.0, 0.3, 0.2), **soft)
    green = lamp("POINT", 60.0, (1.8, -0.9, 2.2), color=(0.3, 1.0, 0.4), **soft)
    blue = lamp("AREA", 120.0, (-1.2, -1.0, 3.0), (0.5, -0.3, 0.5), color=(0.3, 0.5, 1.0), size=0.6)
    _linked(red, "Red", {round_one: "INCLUDE"})
    _linked(green, "Green", {square_one: "EXCLUDE"})
    _linked(blue, "Blue", {round_one: "EXCLUDE"}, "blocker_collection")
    _linked(slab, "Slab", {floor: "INCLUDE"})
    camera((0.0, -6.5, 2.4), (0.0, 0.3, 0.8), lens=50.0)


def hdri() -> None:
    """A latitude-longitude image with a low sun, turned about two axes."""
    corner()
    height, width = 128, 256
    latitude = numpy.pi * ((numpy.arange(height) + 0.5) / height - 0.5)[:, None]
    longitude = 2.0 * numpy.pi * ((numpy.arange(width) + 0.5) / width - 0.5)[None, :]
    toward = numpy.cos(latitude) * numpy.cos(0.6) * numpy.cos(longitude - 1.9) + numpy.sin(latitude) * numpy.sin(0.6)
    glow = numpy.exp((toward - 1.0) / 0.006)[..., None] * numpy.array([120.0, 100.0, 70.0])
    sky = (0.25 + 0.2 * numpy.sin(latitude) + 0.0 * longitude)[..., None] * numpy.array([0.6, 0.9, 1.4])
    image_world(image("Sky", glow + sky, is_float=True), 0.8, (0.15, -0.1, 0.7))


def sky_single() -> None:
    """Light scattered once, with a large disc of the sun."""
    corner()
    sun = {"sun_elevation": radians(28), "sun_rotation": radians(200), "sun_size": radians(3)}
    sky_world("SINGLE_SCATTERING", 0.05, **sun, altitude=300.0, air_density=1.3, ozone_density=1.5)


def sky_multiple() -> None:
    """Light scattered often, without the sun's disc."""
    corner()
    sky_world("MULTIPLE_SCATTERING", 0.2, sun_elevation=radians(12), sun_rotation=radians(160), sun_disc=False)


def sky_preetham() -> None:
    corner()
    sky_world("PREETHAM", 1.0, sun_direction=(0.4, -0.7, 0.5), turbidity=3.5)


def sky_hosek_wilkie() -> None:
    corner()
    sky_world("HOSEK_WILKIE", 3.0, sun_direction=(-0.4, -0.7, 0.6), turbidity=4.0, ground_albedo=0.4)


def negative() -> None:
    """Lamps, a ball and a shader's emission that take away of the light of a bright world and of another lamp."""
    corner()
    even_world(0.8)
    lamp("AREA", 150.0, (-1.2, -1.6, 3.0), (0.5, -0.3, 0.5), size=1.0, color=(1.0, 0.9, 0.8))
    lamp("POINT", -25.0, (1.7, -1.0, 1.2), color=(0.3, 0.6, 1.0), shadow_soft_size=0.2, use_soft_falloff=False)
    lamp("SPOT", -60.0, (-1.8, -1.2, 2.2), (0.65, -0.45, 0.0), spot_size=radians(50), spot_blend=0.3, shadow_soft_size=0.1)
    ball(material("Emission", Color=(1.0, 0.4, 0.2), Strength=-1.0), 0.25, location=(0.2, -1.1, 0.5))


def soft_falloff() -> None:
    """Lamps with soft falloff that reach into the floor, the wall and the box."""
    corner()
    lamp("POINT", 20.0, (-0.2, -1.0, 0.15), color=(1.0, 0.6, 0.4), shadow_soft_size=0.3, use_soft_falloff=True)
    lamp("POINT", 25.0, (0.1, 1.9, 1.4), color=(0.4, 1.0, 0.5), shadow_soft_size=0.25, use_soft_falloff=True)
    lamp("SPOT", 90.0, (1.2, 0.0, 1.1), (0.9, 0.6, 0.0), spot_size=radians(110), spot_blend=0.4, shadow_soft_size=0.3, use_soft_falloff=True)


def world_visibility() -> None:
    """A world that lights what scatters diffusely, and neither mirrors nor glass nor the camera show."""
    corner()
    even_world(1.2, (0.6, 0.8, 1.0))
    world = bpy.context.scene.world.cycles_visibility
    world.camera = world.glossy = world.transmission = False
    ball(material("BsdfAnisotropic", Color=(0.9, 0.9, 0.9), Roughness=0.2), 0.35, location=(0.1, -0.9, 0.35))
    ball(material("BsdfGlass", Roughness=0.0, IOR=1.45), 0.3, location=(-1.2, -0.9, 0.3))
    lamp("POINT", 60.0, (1.6, -1.2, 2.6), shadow_soft_size=0.3, use_soft_falloff=False)


def opaque_shadows() -> None:
    """Two panes and a ball that light passes, their shadows opaque on one side."""
    corner()
    for number, is_transparent in enumerate((True, False)):
        pane = material("BsdfTransparent", Color=(0.9, 0.5, 0.2))
        mixed = material("BsdfGlass", Color=(0.8, 0.9, 1.0), Roughness=0.0, IOR=1.45)
        pane.use_transparent_shadow = mixed.use_transparent_shadow = is_transparent
        plane(pane, 0.8, location=(-1.2 + 2.2 * number, -0.9, 0.9), rotation=(0.5, 0.3, 0.0))
        ball(mixed, 0.25, location=(-0.4 + 0.8 * number, -1.3, 0.25))
    lamp("POINT", 120.0, (0.0, -1.6, 3.0), shadow_soft_size=0.3, use_soft_falloff=False)


def clamped_caustics() -> None:
    """Light paths bring what two mirrors throw, under a limit on indirect light that nothing here reaches in one go."""
    corner()
    chrome = material("BsdfAnisotropic", Color=(0.9, 0.9, 0.9), Roughness=0.0)
    ball(chrome, 0.35, location=(0.1, -0.9, 0.35))
    plane(chrome, 1.0, location=(1.6, -0.6, 0.5), rotation=(0.0, radians(-75), 0.0))
    lamp("AREA", 120.0, (-1.2, -1.6, 3.0), (0.5, -0.3, 0.5), size=1.4)
    bpy.context.scene.cycles.sample_clamp_indirect = 20.0
    bpy.context.scene.gonio.caustics = "ON"
