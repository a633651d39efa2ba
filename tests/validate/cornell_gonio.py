"""The Cornell box in gonio."""

from typing import Any

import cornell
import gonio
import numpy


def render(variant: str, samples: int, seed: int) -> numpy.ndarray:
    """Radiance (height, width, 3), top row first."""
    with gonio.Render(described(variant, samples, seed)) as rendering:
        for _ in rendering:
            pass
        return numpy.asarray(rendering.film()["color"])[:, :, :3].astype("f8")


def described(variant: str, samples: int, seed: int) -> gonio.Scene:
    """The scene through the Python module."""
    size = cornell.RESOLUTION
    scene = gonio.Scene()
    scene.set(width=size, height=size, samples=samples, seed=seed, max_bounces=cornell.MAX_BOUNCES, passes=["color"])
    scene.set(filter="box", filter_width=1.0)
    for part in cornell.parts(variant):
        mesh = scene.add_mesh(part.points, part.triangles, name=part.name)
        material = scene.add_material(part.name, **parameters(part.surface))
        if isinstance(part.surface, cornell.Principled):
            follow_blender(scene, material)
        scene.add_instance(mesh, [material], name=part.name)
    radiance = [cornell.LIGHT_RADIANCE] * 3
    matrix = cornell.light_matrix()
    scene.add_light("rectangle", radiance, transform=matrix, width=cornell.LIGHT_WIDTH, height=cornell.LIGHT_DEPTH)
    scene.add_camera(cornell.camera_matrix(), fov=cornell.CAMERA_FOV)
    return scene


def follow_blender(scene: gonio.Scene, material: int) -> None:
    """Lets a material follow the rules of Blender's Principled BSDF."""
    description = scene.to_dict()["materials"][material]
    description["closures"][0]["model"] = "Principled"
    scene.put_material(description, material)


def parameters(surface: cornell.Surface) -> dict[str, Any]:
    """A surface by the names of gonio's parameter block."""
    match surface:
        case cornell.Diffuse(reflectance):
            return {"base_color": reflectance, "specular_weight": 0.0}
        case cornell.Mirror(reflectance, roughness):
            # A white metal reflects all at every angle; the factor on its lobe makes that a constant.
            return {"base_color": (1.0, 1.0, 1.0), "metalness": 1.0, "metal_weight": reflectance, "specular_roughness": roughness}
        case cornell.Glass(ior):
            return {"transmission_weight": 1.0, "specular_ior": ior, "specular_roughness": 0.0}
        case cornell.Principled():
            return {
                "base_color": surface.base_color,
                "specular_roughness": surface.roughness,
                "metalness": surface.metallic,
                "specular_color": surface.specular_tint,
                "metal_edge_tint": surface.specular_tint,
                "coat_weight": surface.coat_weight,
                "coat_roughness": surface.coat_roughness,
                "coat_ior": 1.5,
            }
