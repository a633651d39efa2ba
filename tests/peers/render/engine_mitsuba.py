"""Scenes in Mitsuba 3, in either of its modes; lights are surfaces there, and coats, images and copies are not for it."""

import math
import tempfile
import time
from pathlib import Path
from typing import Any

import cornell
import drjit
import mitsuba
import numpy
from cornell_mitsuba import bsdf, rgb, write_ply
from description import Disk, Light, Mesh, Point, Rectangle, Scene, Sphere, Sun, Textured

# From gonio's frames, which look and shine along -z, to those of Mitsuba's camera and of its flat shapes.
LOOKING = numpy.diag([-1.0, 1.0, -1.0, 1.0])
SHINING = numpy.diag([1.0, -1.0, -1.0, 1.0])
# Metres from the origin to the disk that stands for the sun; farther off its edge would suffer from single precision.
FAR = 1000.0


class Engine:
    """A scene laid out; pictures are radiance in cd/m², (height, width, 3), the top row first."""

    def __init__(self, scene: Scene, threads: int, variant: str) -> None:
        """`variant` is Mitsuba's own, with the integrator after a plus where it is not `path`."""
        variant, _, integrator = variant.partition("+")
        mitsuba.set_variant(variant)
        drjit.set_thread_count(threads)
        self._is_vector = variant.startswith("llvm")
        self.version = f"Mitsuba {mitsuba.__version__} {variant}" + (f", LLVM {drjit.detail.llvm_version()}" if self._is_vector else "")
        folder = Path(tempfile.mkdtemp())
        tracing = {"type": integrator or "path", "max_depth": scene.bounces + 2}
        parts: dict[str, Any] = {"type": "scene", "camera": camera(scene), "integrator": tracing}
        parts |= {f"light {number}": emitter(light) for number, light in enumerate(scene.lights)}
        parts |= {f"mesh {number}": shape(mesh, folder / f"{number}.ply") for number, mesh in enumerate(scene.meshes)}
        self._scene = mitsuba.load_dict(parts)
        self.jit = 0.0
        self.render(1, 0)

    def render(self, samples: int, seed: int) -> tuple[numpy.ndarray, float, int]:
        """A picture, the seconds that its samples took without compiling, and how many they were: a square, as the sampler wants it."""
        side = max(1, round(math.sqrt(samples)))
        with drjit.scoped_set_flag(drjit.JitFlag.KernelHistory, self._is_vector):
            drjit.kernel_history_clear()
            start = time.perf_counter()
            picture = numpy.array(mitsuba.render(self._scene, spp=side * side, seed=seed))
            seconds = time.perf_counter() - start
            compiling = sum(kernel.get("codegen_time", 0.0) + kernel.get("backend_time", 0.0) for kernel in drjit.kernel_history()) * 1e-3
        self.jit += compiling
        return picture[:, :, :3].astype("f8"), seconds - compiling, side * side


def camera(scene: Scene) -> dict[str, Any]:
    """A pinhole with a box filter one pixel wide."""
    film = {"type": "hdrfilm", "width": scene.width, "height": scene.height, "rfilter": {"type": "box"}, "pixel_format": "rgb"}
    return {
        "type": "perspective",
        "fov": scene.camera.fov,
        "fov_axis": "y",
        "near_clip": 0.01,
        "to_world": place(scene.camera.matrix @ LOOKING),
        "sampler": {"type": "multijitter"},
        "film": film | {"component_format": "float32"},
    }


def place(matrix: numpy.ndarray) -> Any:
    """A transform."""
    return mitsuba.ScalarTransform4f(matrix)


def emitter(light: Light) -> dict[str, Any]:
    """A light with the reflectance of what is close behind it."""
    match light:
        case Rectangle(matrix, width, height, radiance, behind):
            kind, size = "rectangle", (0.5 * width, 0.5 * height, 1.0, 1.0)
        case Disk(matrix, radius, radiance, behind):
            kind, size = "disk", (radius, radius, 1.0, 1.0)
        case Sun(matrix, angle, radiance):
            behind, kind, radius = (0.0, 0.0, 0.0), "disk", FAR * math.tan(math.radians(angle) / 2.0)
            matrix = matrix.copy()
            matrix[:3, 3] = FAR * matrix[:3, 2]
            size = (radius, radius, 1.0, 1.0)
        case Point(matrix, intensity):
            return {"type": "point", "position": matrix[:3, 3].tolist(), "intensity": rgb(intensity)}
        case Sphere(matrix, radius, radiance):
            black = {"type": "diffuse", "reflectance": rgb((0.0, 0.0, 0.0))}
            shines = {"type": "area", "radiance": rgb(radiance)}
            return {"type": "sphere", "center": matrix[:3, 3].tolist(), "radius": radius, "emitter": shines, "surface": black}
        case _:
            raise NotImplementedError(light)
    shines = {"type": "area", "radiance": rgb(radiance)}
    to_world = place(matrix @ SHINING @ numpy.diag(size))
    return {"type": kind, "to_world": to_world, "emitter": shines, "surface": {"type": "diffuse", "reflectance": rgb(behind)}}


def shape(mesh: Mesh, file: Path) -> dict[str, Any]:
    """A mesh with flat faces, by way of a file."""
    if len(mesh.places) != 1 or isinstance(mesh.surface, Textured):
        raise NotImplementedError(mesh.name)
    write_ply(file, cornell.Part(mesh.name, mesh.points, mesh.triangles, mesh.surface), mesh.normals)
    return {
        "type": "ply",
        "filename": str(file),
        "face_normals": mesh.normals is None,
        "to_world": place(mesh.places[0]),
        "surface": bsdf(mesh.surface),
    }
