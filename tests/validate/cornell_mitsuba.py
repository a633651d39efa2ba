"""The Cornell box in Mitsuba 3: run by a Python that has `mitsuba`.

    python cornell_mitsuba.py VARIANT SAMPLES SEED OUT.npy
"""

import sys
from pathlib import Path
from typing import Any

import cornell
import mitsuba
import numpy

mitsuba.set_variant("scalar_rgb")


def main(variant: str, samples: int, seed: int, out: Path) -> None:
    """Renders and saves radiance (height, width, 3), top row first."""
    scene: dict[str, Any] = {
        "type": "scene",
        "integrator": {"type": "path", "max_depth": cornell.MAX_BOUNCES + 2, "rr_depth": 8},
        "camera": camera(samples),
        "light": light(),
    }
    for part in cornell.parts(variant):
        file = out.with_name(f"{variant}-{part.name}.ply")
        write_ply(file, part)
        scene[part.name] = {"type": "ply", "filename": str(file), "face_normals": True, "surface": bsdf(part.surface)}
    picture = mitsuba.render(mitsuba.load_dict(scene), seed=seed)
    numpy.save(out, numpy.asarray(picture)[:, :, :3].astype("f8"))


def rgb(value: cornell.Colour) -> dict[str, Any]:
    """A colour by value."""
    return {"type": "rgb", "value": list(value)}


def bsdf(surface: cornell.Surface) -> dict[str, Any]:
    """A surface, outer side and inner side alike unless light passes."""
    match surface:
        case cornell.Diffuse(reflectance):
            return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(reflectance)}}
        case cornell.Mirror(reflectance, roughness):
            tint = rgb((reflectance,) * 3)
            conductor = {"type": "conductor", "material": "none", "specular_reflectance": tint}
            rough = {"type": "roughconductor", "distribution": "ggx", "alpha": roughness**2} if roughness else {}
            return {"type": "twosided", "bsdf": conductor | rough}
        case cornell.Glass(ior):
            return {"type": "dielectric", "int_ior": ior, "ext_ior": 1.0}
        case cornell.Principled():
            raise NotImplementedError("Mitsuba has no surface that equals Blender's")


def light() -> dict[str, Any]:
    """The ceiling light; Mitsuba's rectangle spans -1 to 1 and shines along its local +z."""
    x, y, z = cornell.LIGHT_CENTRE
    place = mitsuba.ScalarTransform4f().look_at(origin=[x, y, z], target=[x, 0.0, z], up=[0.0, 0.0, 1.0])
    size = mitsuba.ScalarTransform4f().scale([0.5 * cornell.LIGHT_WIDTH, 0.5 * cornell.LIGHT_DEPTH, 1.0])
    emitter = {"type": "area", "radiance": rgb((cornell.LIGHT_RADIANCE,) * 3)}
    ceiling = {"type": "diffuse", "reflectance": rgb(cornell.WHITE)}
    return {"type": "rectangle", "to_world": place @ size, "emitter": emitter, "surface": ceiling}


def camera(samples: int) -> dict[str, Any]:
    """A pinhole with a box filter one pixel wide."""
    x, y, z = cornell.CAMERA_POSITION
    film = {"type": "hdrfilm", "width": cornell.RESOLUTION, "height": cornell.RESOLUTION, "rfilter": {"type": "box"}, "pixel_format": "rgb"}
    return {
        "type": "perspective",
        "fov": cornell.CAMERA_FOV,
        "near_clip": 0.01,
        "to_world": mitsuba.ScalarTransform4f().look_at(origin=[x, y, z], target=[x, y, z - 1.0], up=[0.0, 1.0, 0.0]),
        "sampler": {"type": "multijitter", "sample_count": samples},
        "film": film | {"component_format": "float32"},
    }


def write_ply(path: Path, part: cornell.Part, normals: numpy.ndarray | None = None) -> None:
    """A mesh as a binary PLY file, with normals (N, 3) at its points or without any."""
    header = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(part.points)}\n"
    header += "property float x\nproperty float y\nproperty float z\n"
    header += "" if normals is None else "property float nx\nproperty float ny\nproperty float nz\n"
    header += f"element face {len(part.triangles)}\nproperty list uchar int vertex_indices\nend_header\n"
    faces = numpy.empty(len(part.triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"], faces["corners"] = 3, part.triangles
    points = part.points if normals is None else numpy.concatenate([part.points, normals], axis=1)
    path.write_bytes(header.encode() + points.astype("<f4").tobytes() + faces.tobytes())


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), Path(sys.argv[4]))
