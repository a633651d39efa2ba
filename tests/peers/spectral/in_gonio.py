"""The rooms in gonio, and what their colours and lamps mean as numbers over wavelengths."""

from typing import Any

import gonio
import numpy
from coloured_rooms import BOUNCES, HEIGHT, LAMP_DEPTH, LAMP_WIDTH, WIDTH, Gloss, Metal, Room, Surface, camera_matrix, colours, lamp_matrix
from cornell import Diffuse, Glass

# All that is told of spectra lies here, nm; between the points they are linear for both renderers.
WAVELENGTHS = numpy.arange(380.0, 781.0)
# Linear Rec.709 to XYZ of its luminance.
XYZ = numpy.array([[0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923], [0.0193308, 0.1191948, 0.9505322]])


def spectra(room: Room) -> dict[str, Any]:
    """The room's spectra for a renderer that has none of its own: reflectances by colour, the lamp's power in W/(m² sr nm) at 1 cd/m²."""
    power = lamp_power(room.lamp)
    luminance = figures(room.lamp)["ler"] * numpy.trapezoid(power, WAVELENGTHS)
    reflectances = {repr(colour): list(gonio.colour_reflectance(colour, WAVELENGTHS.tolist())) for colour in colours(room)}
    return {"nm": WAVELENGTHS.tolist(), "reflectances": reflectances, "lamp": (power / luminance).tolist()}


def lamp_power(name: str) -> numpy.ndarray:
    """The power of an illuminant at the wavelengths, linear between the points of its table."""
    table = gonio.illuminant(name)
    power: numpy.ndarray = numpy.interp(WAVELENGTHS, table["wavelengths_nm"], table["power"])
    return power


def figures(name: str) -> dict[str, Any]:
    """What an illuminant means, in closed form."""
    return gonio.spectrum_figures(WAVELENGTHS.tolist(), lamp_power(name).tolist())


def lamp_xyz(name: str) -> numpy.ndarray:
    """The XYZ of an illuminant at 1 cd/m²."""
    x, y = figures(name)["x"], figures(name)["y"]
    return numpy.array([x / y, 1.0, (1.0 - x - y) / y])


def described(room: Room, **settings: Any) -> gonio.Scene:
    """The room by the Python module."""
    scene = gonio.Scene()
    scene.set(width=WIDTH, height=HEIGHT, max_bounces=BOUNCES, passes=["color"], filter="box", filter_width=1.0, spectral=True)
    scene.set(**settings)
    for part in room.parts:
        mesh = scene.add_mesh(part.points, part.triangles, name=part.name)
        scene.add_instance(mesh, [put_surface(scene, part.surface)], name=part.name)
    spectrum = (WAVELENGTHS.tolist(), lamp_power(room.lamp).tolist())
    if room.ceiling is None:
        scene.add_light("dome", spectrum=spectrum)
    else:
        scene.add_light("rectangle", transform=lamp_matrix(), width=LAMP_WIDTH, height=LAMP_DEPTH, spectrum=spectrum)
    scene.add_camera(camera_matrix(room).tolist(), fov=room.fov)
    return scene


def put_surface(scene: gonio.Scene, surface: Surface) -> int:
    """A material; rough ones scatter once, as the other renderer's."""
    match surface:
        case Diffuse(colour):
            return scene.add_material(base_color=colour, specular_weight=0.0)
        case Glass(ior):
            return scene.add_material(transmission_weight=1.0, specular_ior=ior, specular_roughness=0.0)
        case Gloss(colour, roughness):
            return single_scattering(scene, "Glossy", base_color=colour, specular_roughness=roughness)
        case Metal(colour, roughness):
            # OpenPBR's tint at 82 degrees is 1: Schlick's curve.
            return single_scattering(scene, "OpenPbr", base_color=colour, metalness=1.0, specular_roughness=roughness)
    raise NotImplementedError(surface)


def single_scattering(scene: gonio.Scene, model: str, **parameters: Any) -> int:
    """A material of a model with GGX alone."""
    material = scene.add_material(**parameters)
    description = scene.to_dict()["materials"][material]
    description["closures"][0] |= {"model": model, "distribution": "Ggx"}
    return scene.put_material(description, material)


def rendered(scene: gonio.Scene, previous: gonio.Render | None = None) -> gonio.Render:
    """A finished render, in which nothing was other than asked for."""
    rendering = gonio.Render(scene, previous)
    rendering.wait()
    assert not rendering.diagnostics, rendering.diagnostics
    return rendering


def xyz(rendering: gonio.Render) -> numpy.ndarray:
    """XYZ (height, width, 3), Y in cd/m², the top row first."""
    # In the picture D65's table is (1, 1, 1), though Rec.709's white is rounded and has 0.04 % more of Z.
    white = numpy.linalg.solve(XYZ, lamp_xyz("D65"))
    found: numpy.ndarray = numpy.asarray(rendering.film()["color"])[:, :, :3].astype("f8") * white @ XYZ.T
    return found
