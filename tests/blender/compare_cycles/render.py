"""Scenes rendered inside Blender. Functions for `child.py`."""

import importlib
import sys
import time
from pathlib import Path

import bpy
import numpy
import stage

# What the suites that compare pictures share.
sys.path.append(str(Path(__file__).resolve().parents[2] / "validate"))

from blender_pixels import pixels  # noqa: E402

SEEDS = (1, 2)


def render(theme: str, scene: str, engine: str, samples: int, told: str, tmp_path: Path) -> None:
    """Writes SCENE-ENGINE.npz: `first` and `second`, renderings with different seeds, and the `seconds` that both took together.

    They are radiance (height, width, 3) in W/(m² sr), the top row first. Gonio may tell lines of the severities in `told`.
    """
    build(theme, scene, samples)
    write_pair(engine, tmp_path / f"{scene}-{engine}", tuple(told.split()))


def write_pair(engine: str, path: Path, told: tuple[str, ...] = ()) -> None:
    """Writes PATH.npz as `render` does, of the open scene."""
    start, images = time.monotonic(), []
    for seed in SEEDS:
        bpy.context.scene.cycles.seed = seed
        images.append(rendered(engine, path.with_suffix(".exr"), told))
    numpy.savez(path.with_suffix(".npz"), first=images[0], second=images[1], seconds=time.monotonic() - start)


def export_usd(scene: str, samples: int, tmp_path: Path) -> None:
    """Writes SCENE.usdc with its images, and Gonio's picture of the file as SCENE.npy."""
    build("usd", scene, samples)
    bpy.ops.wm.usd_export(filepath=str(tmp_path / f"{scene}.usdc"), export_textures_mode="NEW")
    numpy.save(tmp_path / f"{scene}.npy", rendered("GONIO", tmp_path / f"{scene}-addon.exr"))


def three_ways(scene: str, samples: int, tmp_path: Path) -> None:
    """Writes SCENE.usdc with all that Blender's exporter can write, and both engines' pictures of the open file as SCENE-ENGINE.npy."""
    build("shapes", scene, samples)
    options = {"export_hair": True, "export_animation": bpy.context.scene.render.use_motion_blur}
    bpy.ops.wm.usd_export(filepath=str(tmp_path / f"{scene}.usdc"), export_textures_mode="NEW", **options)
    for engine in ("CYCLES", "GONIO"):
        numpy.save(tmp_path / f"{scene}-{engine}.npy", rendered(engine, tmp_path / f"{scene}-{engine}.exr"))


def random_pair(seed: int, samples: int, tmp_path: Path) -> None:
    """Writes ENGINE.npz as `render` does, of a scene by chance, for both engines."""
    importlib.import_module("scenes_random").build(seed)
    bpy.context.scene.cycles.samples = samples
    for engine in ("CYCLES", "GONIO"):
        write_pair(engine, tmp_path / engine, told=("INFO",))


def build(theme: str, scene: str, samples: int) -> None:
    """Makes a scene the open one."""
    stage.empty()
    getattr(importlib.import_module(f"scenes_{theme}"), scene)()
    bpy.context.scene.cycles.samples = samples


def rendered(engine: str, path: Path, told: tuple[str, ...] = ()) -> numpy.ndarray:
    """The open scene, or what it bakes into the image `Baked`. Gonio takes its settings from those of Cycles, and may not have to leave anything out.
    It may tell lines of these severities."""
    scene = bpy.context.scene
    scene.render.engine = engine
    if engine == "GONIO":
        bpy.ops.gonio.settings_from_cycles()
        # Nothing of the comparison's is left to what the engine would choose.
        scene.gonio.use_adaptive_sampling = False
    baked = bpy.data.images.get("Baked")
    if baked is not None:
        bpy.ops.object.bake(type=scene.cycles.bake_type)
    else:
        scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
        scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True)
    if engine == "GONIO":
        lines = importlib.import_module("gonio_extension.report").latest().diagnostics
        assert all(line.severity in told for line in lines), [line.text for line in lines]
    return pixels(path) if baked is None else image_pixels(baked)


def image_pixels(image: bpy.types.Image) -> numpy.ndarray:
    """The colours (height, width, 3) of an image, the top row first."""
    flat = numpy.empty(len(image.pixels), dtype="f4")
    image.pixels.foreach_get(flat)
    return flat.reshape(image.size[1], image.size[0], 4)[::-1, :, :3]
