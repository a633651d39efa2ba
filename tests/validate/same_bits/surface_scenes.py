"""Scenes of materials: what happens at and under surfaces."""

import os
import sys
from pathlib import Path

import gonio
import numpy as np
from elements import (
    DOWN, GLASS, GUIDES, LIGHT_PASSES, MIRROR, SIZE, UPRIGHT, at, ball, box, camera, checks, closure, dome, ground, image, light, looking,
    material, mesh, place, primvar, quad, sun, texture,
)  # fmt: skip

sys.path.append(str(Path(__file__).resolve().parents[1]))
from measured_files import ggx, isotropic_axes, isotropic_values, merl_bytes, unit

DATA = Path(os.environ.get("GONIO_SHARED", Path(__file__).resolve().parents[4] / "shared")) / "data"
MODELS = ["Diffuse", "Translucent", "Sheen", "Velvet", "Refraction", "Metallic", "Conductor", "Gltf", "PreviewSurface", "StandardSurface"]
DISTRIBUTIONS = ["MultiGgx", "Ggx", "Beckmann", "AshikhminShirley"]


def skin(scene):
    """Light under the surface, by every method, in shapes of several materials and layers."""
    scene.set(**SIZE, samples=16, clamp_indirect=4.0, passes=["color", "illuminance", "denoising_albedo", *LIGHT_PASSES])
    ground(scene)
    sphere, cube = mesh(scene, ball(12)), mesh(scene, box())
    for number, method in enumerate(["RandomWalk", "RandomWalkLegacy", "RandomWalkSkin", "Burley"]):
        radius = {"subsurface_radius": [0.2, 0.1, 0.05], "subsurface_color": [0.8, 0.5, 0.3], "subsurface_scatter_anisotropy": 0.2 * number}
        model = "Principled" if number % 2 else "OpenPbr"
        whole = material(scene, closure(model, fields={"subsurface": method}, base_color=[0.8, 0.5, 0.3], subsurface_weight=1.0, **radius))
        half = closure("Subsurface", 0.5, fields={"subsurface": method}, base_color=[0.3, 0.7, 0.4], **radius)
        place(scene, sphere, whole, at(number - 1.5, 0.45, 0, 0.45))
        place(scene, cube, material(scene, half, closure("Glossy", 0.5, specular_roughness=0.2)), at(number - 1.5, 0, 1, 0.5))
    light(scene, {"Rectangle": {"width": 1.0, "height": 0.5}}, 15.0, looking((-1, 2.5, 2), (0, 0.4, 0)))
    light(scene, {"Sphere": {"radius": 0.1}}, 80.0, at(0.5, 1.4, -1.2))
    camera(scene, (0, 1.6, 4), (0, 0.4, 0.3))


def bumpy_floor(scene, colors):
    """A floor of an image in many sizes and of normals from another."""
    bumps = texture(scene, np.random.default_rng(5).uniform([0.4, 0.4, 0.9, 1], [0.6, 0.6, 1, 1], (32, 32, 4)))
    wide = {"Transform2d": {"scale": [9.0, 9.0], "rotation_deg": 20.0, "translation": [0.1, 0.2]}}, [(0, "Rgb")]
    nodes = [
        primvar("st"),
        wide,
        image(colors, 1),
        image(bumps, 1, "Mirror"),
        ("Multiply", [(3, "Rgb"), 2.0]),
        ("Subtract", [(4, "Rgb"), 1.0]),
    ]
    nodes += [({"NormalMap": {"scale": 0.7, "uv": "st"}}, [(5, "Rgb")])]
    surface = closure(fields={"normal": 6}, base_color=(2, "Rgb"), specular_roughness=(2, "R"))
    place(scene, mesh(scene, quad(12, 12)), material(scene, surface, nodes=nodes), np.eye(4))


def sums(scene, colors):
    """Balls of three closures each, one of them transparent, with weights from nodes."""
    nodes = [
        primvar("st"),
        image(colors),
        ("SquareRoot", [(1, "R")]),
        ("Mix", [[0.9, 0.2, 0.1], [0.1, 0.3, 0.9], (1, "G")]),
        ("Fresnel", [(2, "R"), 1.5]),
    ]
    clear, sphere = closure("Transparent", 0.3, base_color=[0.5, 0.9, 0.7]), mesh(scene, ball())
    for number, model in enumerate(MODELS):
        own = closure(model, (3, "Rgb"), fields={"distribution": DISTRIBUTIONS[number % 4]}, base_color=[0.7, 0.5, 0.4])
        beside = closure("Emission", 0.1, emission_color=2.0) if number % 3 == 0 else closure("Glass", (4, "R"), specular_roughness=0.2)
        row, column = divmod(number, 5)
        place(scene, sphere, material(scene, clear, own, beside, nodes=nodes), at(column * 0.8 - 1.6, 0.35, row * 0.9 - 0.9, 0.33))


def mixes(scene):
    """Sums of closures, cut-outs, images in mip levels, bent normals, and nodes."""
    scene.set(**SIZE, samples=16)
    scene.set(passes=["color", "alpha", "albedo", "normal", "uv", "illuminance", "emission", "environment", *LIGHT_PASSES])
    fine = texture(scene, checks(128, [0.1, 0.2, 0.4], [0.9, 0.8, 0.6], alpha=0.0))
    bumpy_floor(scene, fine)
    sums(scene, fine)
    sheet = mesh(scene, quad(1.2, 1.2, 2.0))
    for number, threshold in enumerate((0.0, 0.5)):
        cut = closure(fields={"opacity_threshold": threshold}, base_color=(1, "Rgb"), geometry_opacity=(1, "A"))
        leaf = material(scene, cut, nodes=[primvar("st"), image(fine)])
        place(scene, sheet, leaf, at(number * 2.2 - 1.1, 0.7, 0.9, axes=UPRIGHT))
    light(scene, {"Rectangle": {"width": 2.0, "height": 1.0}}, 8.0, looking((-1.5, 3, 2), (0, 0, 0)), texture=fine)
    dome(scene, 0.3)
    camera(scene, (0.2, 1.1, 3.4), (0, 0.4, 0))


def glass(scene):
    """What guides of denoisers take apart: lamps in mirrors and through glass that absorbs, half-open sheets, lacquer."""
    scene.set(**SIZE, samples=16, passes=["color", "albedo", "depth", "illuminance", *GUIDES], filter="tent", crop=(9, 5, 120, 96))
    ground(scene)
    sphere, cube, flat = mesh(scene, ball()), mesh(scene, box()), mesh(scene, quad(1.2, 1.2))
    medium = {**GLASS, "transmission_color": [0.3, 0.8, 0.5], "transmission_depth": 0.4}
    place(scene, sphere, material(scene, closure(**medium)), at(-0.9, 0.5, 0.4, 0.5))
    place(scene, cube, material(scene, closure(**{**medium, "specular_roughness": 0.25})), at(0.3, 0, 0.8, 0.5))
    place(scene, flat, material(scene, closure(**MIRROR)), at(1.1, 0.8, -0.6, axes=UPRIGHT))
    pane = closure(fields={"thin_walled": True}, **GLASS, transmission_color=[0.9, 0.95, 0.8])
    place(scene, flat, material(scene, pane), at(-0.4, 0.7, 1.3, axes=UPRIGHT))
    place(scene, flat, material(scene, closure(**GLASS, geometry_opacity=0.6)), at(0.4, 1.5, 0))
    place(scene, cube, material(scene, closure(base_color=[0.3, 0.2, 0.1], coat_weight=1.0)), at(-1.6, 0, -0.8))
    light(scene, {"Rectangle": {"width": 0.6, "height": 0.6}}, 25.0, at(0.5, 2.8, 0.5, axes=DOWN))
    light(scene, {"Sphere": {"radius": 0.1}}, 120.0, at(-1.2, 1.9, 1.2))
    dome(scene, [0.2, 0.3, 0.4])
    camera(scene, (0.2, 1.5, 4.2), (0, 0.6, 0))


def brushed():
    """A table of a surface that is rougher along y."""
    theta, phi = np.linspace(0, 85, 8), np.arange(8) * 45.0
    axes = {"theta_i": theta, "phi_i": phi, "theta_o": theta, "phi_o": phi}
    theta_i, phi_i, theta_o, phi_o = np.meshgrid(*(np.radians(knots) for knots in axes.values()), indexing="ij")
    wi, wo = unit(theta_i, phi_i), unit(theta_o, phi_o)
    half = (wi + wo) / np.linalg.norm(wi + wo, axis=-1, keepdims=True)
    lobe = np.exp(-20.0 * half[..., 0] ** 2 - 4.0 * half[..., 1] ** 2)
    values = lobe[..., None] * [0.3, 0.25, 0.2]
    return gonio.MeasuredBsdf.from_table(axes, values.astype("f4"), periods={"phi_i": 360, "phi_o": 360})


def measured(scene):
    """Measured scattering: tables, MERL's half vectors, patches from a file where there is one; direct light alone."""
    scene.set(**SIZE, samples=16, integrator="direct", passes=["color", "illuminance", *LIGHT_PASSES])
    ground(scene)
    axes = isotropic_axes(polar=16, azimuths=24)
    found = [
        gonio.MeasuredBsdf.from_table(axes, isotropic_values(axes, ggx).astype("f4"), periods={"delta_phi": 360}),
        gonio.MeasuredBsdf.from_bytes(merl_bytes((20, 16, 36), lambda wi, wo: ggx(wi, wo, alpha=0.2, diffuse=0.2))[0], "made.binary"),
        brushed(),
    ]
    found += [gonio.MeasuredBsdf.from_file(path) for path in sorted(DATA.glob("bsdf/*.xml")) + sorted(DATA.glob("bsdf/*.pbsdf"))]
    sphere = mesh(scene, ball())
    for number, bsdf in enumerate(found):
        fields = {"measured": scene.put_measured(bsdf)}
        bare, coated = closure("Measured", fields=fields, specular_rotation=0.1), closure(fields=fields, coat_weight=0.6, fuzz_weight=0.2)
        place(scene, sphere, material(scene, bare), at(number * 0.8 - 1.6, 0.4, 0.5, 0.4))
        place(scene, sphere, material(scene, coated), at(number * 0.8 - 1.6, 0.4, -0.6, 0.4))
    light(scene, {"Rectangle": {"width": 0.8, "height": 0.8}}, 12.0, looking((-1, 2.5, 2), (0, 0, 0)))
    dome(scene, 0.5)
    camera(scene, (0, 1.8, 4), (0, 0.3, 0))


def sharp(scene):
    """What trees of rays follow: mirrors, glass and mixes of both under lights of every kind."""
    ground(scene)
    sphere, cube = mesh(scene, ball()), mesh(scene, box())
    place(scene, sphere, material(scene, closure(**MIRROR)), at(-0.9, 0.5, 0, 0.5))
    tinted = closure(**GLASS, transmission_color=[0.7, 0.9, 0.8], transmission_depth=0.5)
    place(scene, sphere, material(scene, tinted), at(0.4, 0.4, 0.8, 0.4))
    mixed = closure("Diffuse", 0.5, base_color=[0.8, 0.2, 0.2]), closure("Transparent", 0.3), closure("Glossy", 0.2, specular_roughness=0.0)
    place(scene, cube, material(scene, *mixed), at(1.1, 0, -0.3, 0.8))
    place(scene, cube, material(scene, closure(base_color=[0.2, 0.4, 0.7], geometry_opacity=0.7, coat_weight=1.0)), at(-0.3, 0, -1.2, 1.1))
    light(scene, {"Rectangle": {"width": 0.8, "height": 0.8}}, 10.0, at(0, 2.6, 0.5, axes=DOWN))
    light(scene, {"Sphere": {"radius": 0.2}}, 12.0, at(-1.5, 1.8, 1))
    light(scene, "Point", 3.0, looking((1.5, 2.0, 1.5), (0, 0, 0)), spot={"angle_deg": 70.0, "blend": 0.5, "stretch": [1.0, 1.0]})
    sun(scene, 1.0, (-0.4, 1.0, 0.8))
    dome(scene, [0.1, 0.15, 0.2])
    camera(scene, (0.2, 1.6, 4.2), (0, 0.5, 0))


def whitted(scene):
    """Trees of rays on a regular grid."""
    scene.set(**SIZE, integrator="whitted", antialiasing=2, light_samples=4)
    scene.set(passes=["color", "alpha", "illuminance", "depth", *LIGHT_PASSES])
    sharp(scene)


def adaptive(scene):
    """Trees of rays where the picture wants them."""
    scene.set(**SIZE, integrator="whitted", antialiasing="adaptive", light_samples=4, noise_white=4.0)
    scene.set(passes=["color", "normal", "sample_count"])
    sharp(scene)
