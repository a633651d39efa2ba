"""The Cornell box in gonio."""

import json
from pathlib import Path
from typing import Any

import cornell
import gonio
import numpy

MAGIC = b"gonio1\n"


def render(variant: str, samples: int, seed: int, folder: Path) -> numpy.ndarray:
    """Radiance (height, width, 3), top row first."""
    scene = described(variant, samples, seed)
    bundle = folder / f"{variant}.gonio"
    write_bundle(bundle, with_fixed_filter(scene.to_dict(), variant))
    with gonio.Render(gonio.Scene.load(bundle)) as rendering:
        for _ in rendering:
            pass
        return numpy.asarray(rendering.film()["color"])[:, :, :3].astype("f8")


def described(variant: str, samples: int, seed: int) -> gonio.Scene:
    """The scene through the Python module."""
    size = cornell.RESOLUTION
    scene = gonio.Scene()
    scene.set(width=size, height=size, samples=samples, seed=seed, max_bounces=cornell.MAX_BOUNCES, passes=["color"])
    for part in cornell.parts(variant):
        mesh = scene.add_mesh(part.points, part.triangles, name=part.name)
        scene.add_instance(mesh, [scene.add_material(part.name, **parameters(part.surface))], name=part.name)
    radiance = [cornell.LIGHT_RADIANCE] * 3
    matrix = cornell.light_matrix()
    scene.add_light("rectangle", radiance, transform=matrix, width=cornell.LIGHT_WIDTH, height=cornell.LIGHT_DEPTH)
    scene.add_camera(cornell.camera_matrix(), fov=cornell.CAMERA_FOV)
    return scene


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


def with_fixed_filter(scene: dict[str, Any], variant: str) -> dict[str, Any]:
    """What the Python module has no keyword for: the pixel filter, and whose rules a material follows."""
    scene["settings"] |= {"filter": "Box", "filter_width": 1.0}
    for material, part in zip(scene["materials"], cornell.parts(variant), strict=True):
        if isinstance(part.surface, cornell.Principled):
            material["model"] = "Principled"
    return scene


def write_bundle(path: Path, scene: dict[str, Any]) -> None:
    """Writes a scene bundle."""
    text = json.dumps(scene).encode()
    path.write_bytes(MAGIC + f"{len(text)}\n".encode() + text)
