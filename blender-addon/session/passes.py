# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes: Blender's names, the renderer's names, and the scale between them."""

from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum

import numpy

from .. import compat
from ..export.colour_management import to_working
from ..units import LUMENS_PER_WATT
from . import false_color
from .tone_map import ToneMap


# Metres, where a pixel shows nothing.
FARTHEST = numpy.float32(1e10)


class Scale(Enum):
    """What a pass's values are divided by on their way to Blender."""

    NONE = 0
    # Radiance times the film's exposure, in Blender's watts.
    RADIANCE = 1
    # The most samples that a pixel may have.
    SAMPLES = 2
    # Nothing: the values become colours.
    FALSE_COLOR = 3
    # Nothing: the bits are names.
    BITS = 4
    # Seconds, in thousandths.
    SECONDS = 5
    # Nothing: numbers become greys.
    GREY = 6
    # Nothing: where nothing is lies far away, as in Cycles.
    DEPTH = 7


@dataclass(frozen=True)
class Pass:
    """A pass as Blender and as the renderer know it."""

    name: str
    channels: str
    type: str
    source: str
    scale: Scale = Scale.NONE

    def factor(self, exposure: float, samples: int) -> float:
        """What the renderer's values are multiplied by."""
        if self.scale is Scale.RADIANCE:
            return exposure / LUMENS_PER_WATT
        if self.scale is Scale.SECONDS:
            return 1e3
        return 1.0 / max(1, samples) if self.scale is Scale.SAMPLES else 1.0


COMBINED = Pass("Combined", "RGBA", "COLOR", "color", Scale.RADIANCE)

# By the property of the view layer that switches the pass on.
_LAYER_PASSES = {
    "use_pass_z": Pass("Depth", "Z", "VALUE", "depth", Scale.DEPTH),
    "use_pass_mist": Pass("Mist", "Z", "VALUE", "mist"),
    "use_pass_position": Pass("Position", "XYZ", "VECTOR", "P"),
    "use_pass_normal": Pass("Normal", "XYZ", "VECTOR", "normal"),
    "use_pass_vector": Pass("Vector", "XYZW", "VECTOR", "motion"),
    "use_pass_uv": Pass("UV", "UVA", "VECTOR", "uv"),
    "use_pass_object_index": Pass("Object Index", "X", "VALUE", "object_index"),
    "use_pass_material_index": Pass("Material Index", "X", "VALUE", "material_index"),
    "use_pass_emit": Pass("Emission", "RGB", "COLOR", "emission", Scale.RADIANCE),
    "use_pass_environment": Pass("Environment", "RGB", "COLOR", "environment", Scale.RADIANCE),
    "use_pass_ambient_occlusion": Pass("Ambient Occlusion", "RGB", "COLOR", "ambient_occlusion", Scale.GREY),
} | {
    f"use_pass_{lobe}_{part}": Pass(
        f"{lobe.title()} {part.title()}", "RGB", "COLOR", f"{lobe}_{part}", Scale.NONE if part == "color" else Scale.RADIANCE
    )
    for lobe in ("diffuse", "glossy", "transmission")
    for part in ("direct", "indirect", "color")
}

# By the property of `view_layer.cycles`, which is there while Cycles is.
_CYCLES_PASSES = {
    "use_pass_volume_direct": Pass("Volume Direct", "RGB", "COLOR", "volume_direct", Scale.RADIANCE),
    "use_pass_volume_indirect": Pass("Volume Indirect", "RGB", "COLOR", "volume_indirect", Scale.RADIANCE),
    "use_pass_shadow_catcher": Pass("Shadow Catcher", "RGB", "COLOR", "shadow_catcher"),
    "pass_render_time": Pass("Render Time", "X", "VALUE", "cost", Scale.SECONDS),
}

# By the property of `view_layer.gonio`.
_OWN_PASSES = {
    "use_pass_luminance": (Pass("Luminance", "X", "VALUE", "luminance"),),
    "use_pass_illuminance": (Pass("Illuminance", "X", "VALUE", "illuminance"),),
    "use_pass_luminance_false_color": (Pass("Luminance False Color", "RGBA", "COLOR", "luminance", Scale.FALSE_COLOR),),
    "use_pass_illuminance_false_color": (Pass("Illuminance False Color", "RGBA", "COLOR", "illuminance", Scale.FALSE_COLOR),),
    "use_pass_albedo": (Pass("Albedo", "RGB", "COLOR", "albedo"),),
    "denoising_store_passes": (
        Pass("Denoising Normal", "XYZ", "VECTOR", "denoising_normal"),
        Pass("Denoising Albedo", "RGB", "COLOR", "denoising_albedo"),
    ),
    "pass_debug_sample_count": (Pass("Debug Sample Count", "X", "VALUE", "sample_count", Scale.SAMPLES),),
}

# By the property of the view layer that switches the cryptomatte on, what the names of its layers start with.
_MATTES = {
    "use_pass_cryptomatte_object": "CryptoObject",
    "use_pass_cryptomatte_material": "CryptoMaterial",
    "use_pass_cryptomatte_asset": "CryptoAsset",
}

# Properties of a view layer that ask for passes which there are.
SWITCHES = {"use_pass_combined", *_LAYER_PASSES, *_CYCLES_PASSES, *_MATTES}


def enabled_passes(layer) -> Iterator[Pass]:
    """The passes that a view layer asks for, under this Blender's names."""
    yield COMBINED
    for switch, kind in _LAYER_PASSES.items():
        if getattr(layer, switch, False):
            yield Pass(compat.pass_name(kind.name), kind.channels, kind.type, kind.source, kind.scale)
    for switch, kind in _CYCLES_PASSES.items():
        if getattr(getattr(layer, "cycles", None), switch, False):
            yield kind
    for switch, kinds in _OWN_PASSES.items():
        if getattr(layer.gonio, switch):
            yield from kinds
    for switch, name in _MATTES.items():
        if getattr(layer, switch):
            # Two ranks a layer.
            for number in range((layer.pass_cryptomatte_depth + 1) // 2):
                # Small letters keep files from half floats and from codecs that lose what eyes do not see.
                yield Pass(f"{name}{number:02}", "rgba", "COLOR", f"{name}{number:02}", Scale.BITS)
    for group in layer.lightgroups:
        # The name that Cycles gives the pass too.
        yield Pass(f"Combined_{group.name}", "RGB", "COLOR", f"lightgroup:{group.name}", Scale.RADIANCE)
    for aov in _shader_aovs(layer):
        if aov.type == "VALUE":
            yield Pass(aov.name, "X", "VALUE", f"aov_value:{aov.name}")
        else:
            yield Pass(aov.name, "RGBA", "COLOR", f"aov:{aov.name}")


def shader_aov_names(layer) -> frozenset[str]:
    """Names of the shader AOVs that a view layer asks for."""
    return frozenset(aov.name for aov in _shader_aovs(layer))


def _shader_aovs(layer) -> list:
    """The shader AOVs whose names no other pass has."""
    return [aov for aov in layer.aovs if aov.is_valid]


def register_passes(engine, scene, layer) -> None:
    """Gives Render Layers nodes their sockets."""
    for kind in enabled_passes(layer):
        engine.register_pass(scene, layer, kind.name, len(kind.channels), kind.channels, kind.type)


def add_passes(engine, layer) -> list[Pass]:
    """Gives the coming result its passes; returns them."""
    kinds = list(enabled_passes(layer))
    for kind in kinds[1:]:
        engine.add_pass(kind.name, len(kind.channels), kind.channels, layer=layer.name)
    return kinds


def sources(kinds: list[Pass]) -> list[str]:
    """The renderer's names of passes, each once."""
    return list(dict.fromkeys(kind.source for kind in kinds))


def write_passes(result, film, kinds: list[Pass], settings, samples: int) -> None:
    """Copies a film into a render result of the same size, rows from the bottom; `settings` are the scene's."""
    targets = {target.name: target for target in result.layers[0].passes}
    for kind in kinds:
        if kind.name in targets:
            targets[kind.name].rect.foreach_set(_pixels(film, kind, settings, samples))


def note_mattes(engine, film, layer: str) -> None:
    """Tells Blender the names in the cryptomattes of a view layer, by which its node and its files know them."""
    for key, text in film.matte_notes(f"{layer}.").items():
        engine.get_result().stamp_data_add_field(key, text)


def note_view(engine, film) -> None:
    """Tells Blender how the picture was taken, by which `gonio glare` reads its files."""
    for key, text in film.view_notes().items():
        engine.get_result().stamp_data_add_field(key, text)


def _pixels(film, kind: Pass, settings, samples: int) -> numpy.ndarray:
    """A pass of a film as Blender takes pixels."""
    if kind.scale is Scale.FALSE_COLOR:
        return to_working(false_color.linear(film, false_color.Style.of_source(kind.source, settings)), len(kind.channels))
    if kind == COMBINED:
        return read_combined(film, settings.film_exposure, ToneMap.of(settings))
    flat = read_flat(film, kind.source, kind.factor(settings.film_exposure, samples))
    if kind.scale is Scale.DEPTH:
        return numpy.where(flat > 0.0, flat, FARTHEST)
    if kind.scale is Scale.GREY:
        return numpy.repeat(flat, len(kind.channels))
    return to_working(flat, len(kind.channels)) if kind.type == "COLOR" and kind.scale is not Scale.BITS else flat


def read_combined(film, exposure: float, tone_map: ToneMap | None) -> numpy.ndarray:
    """The Combined pass as Blender takes pixels, in its watts or as a tone-mapped picture."""
    film, factor = (film, COMBINED.factor(exposure, 1)) if tone_map is None else (tone_map.apply(film), 1.0)
    return to_working(read_flat(film, COMBINED.source, factor), len(COMBINED.channels))


def read_flat(film, source: str, factor: float) -> numpy.ndarray:
    """A pass of a film as Blender takes pixels: flat float32, channels interleaved, rows from the bottom."""
    return numpy.frombuffer(film.read(source, scale=factor, bottom_up=True), numpy.float32)
