"""Passes of data and cryptomattes, rendered inside Blender. Functions for `child.py`."""

import importlib
import sys
from pathlib import Path

import bpy
import numpy
from render import build

TESTS = Path(__file__).resolve().parents[2]
sys.path += [str(TESTS / "blender"), str(TESTS / "shared")]

from cryptomatte_reader import checked_manifests, coverage  # noqa: E402
from scenes import read, render  # noqa: E402

DATA = ("z", "mist", "position", "normal", "uv", "object_index", "material_index")
MATTES = ("object", "material", "asset")


def data(engine: str, tmp_path: Path) -> None:
    """Writes ENGINE.npz: channels (height, width) of passes of data by pass and letter, all of the pixels' middles: of the first
    sample in Cycles, by a narrow filter in Gonio."""
    scene, layer = begin(samples=1)
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "GAUSSIAN", 0.01
    for name in DATA:
        setattr(layer, f"use_pass_{name}", True)
    numpy.savez(tmp_path / f"{engine}.npz", **{name.split(".", 1)[1]: pixels for name, pixels in rendered(engine, tmp_path).items()})


def mattes(engine: str, samples: int, tmp_path: Path) -> None:
    """Writes ENGINE.npz: how much of each pixel (height, width) the names of each cryptomatte cover, by matte and name."""
    _, layer = begin(samples)
    for name in MATTES:
        setattr(layer, f"use_pass_cryptomatte_{name}", True)
    layer.pass_cryptomatte_depth = 4
    channels = {name.lower(): pixels for name, pixels in rendered(engine, tmp_path).items()}
    import OpenImageIO

    image = OpenImageIO.ImageBuf(str(tmp_path / f"{engine}.exr"))
    texts = {attribute.name: attribute.value for attribute in image.spec().extra_attribs if isinstance(attribute.value, str)}
    found = {}
    for matte, names in checked_manifests(texts, are_ids=engine == "GONIO").items():
        layers = [numpy.stack([channels[f"{matte}{number:02}.{letter}".lower()] for letter in "rgba"], axis=-1) for number in range(2)]
        found |= {f"{matte.split('.', 1)[1]}.{name}": coverage(layers, wanted) for name, wanted in names.items()}
    numpy.savez(tmp_path / f"{engine}.npz", **found)


def begin(samples: int) -> tuple[bpy.types.Scene, bpy.types.ViewLayer]:
    """Opens the scene of things; the scene and its view layer."""
    build("passes", "things", samples)
    return bpy.context.scene, bpy.context.view_layer


def rendered(engine: str, folder: Path) -> dict[str, numpy.ndarray]:
    """The channels that an engine writes, by layer, pass and letter."""
    scene = bpy.context.scene
    scene.render.engine = engine
    if engine == "GONIO":
        bpy.ops.gonio.settings_from_cycles()
        scene.gonio.use_adaptive_sampling = False
    render(folder / f"{engine}.exr")
    if engine == "GONIO":
        lines = importlib.import_module("gonio_extension.report").latest().diagnostics
        assert not lines, [line.text for line in lines]
    return read(folder / f"{engine}.exr")
