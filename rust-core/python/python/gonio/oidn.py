"""Intel's Open Image Denoise, through the package pyoidn: what the extra `denoise` brings."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from ._gonio import Film, UnsupportedError

if TYPE_CHECKING:
    import numpy

# Passes that tell noise from detail, and what of the colour has none.
GUIDES = ("denoising_albedo", "denoising_normal", "denoising_light")


def require() -> Any:
    """The package pyoidn; `gonio.UnsupportedError` with the remedy where it is absent or cannot be loaded."""
    try:
        pyoidn = importlib.import_module("pyoidn")
        # The library is loaded by the first call.
        with pyoidn.Device():
            return pyoidn
    except (ImportError, OSError) as error:
        message = f"denoising needs Intel's Open Image Denoise: pip install pyoidn ({error})"
        raise UnsupportedError(message) from error


def denoise(film: Film) -> Film:
    """A film whose colour is denoised; the passes `denoising_albedo` and `denoising_normal` guide it where the film has them.

    What the pass `denoising_light` shows of the colour stays as it is. So do alpha and all other passes, luminance and illuminance among them.
    Raises `gonio.UnsupportedError` without pyoidn.
    """
    import numpy

    color = numpy.array(film["color"])
    guides = [numpy.asarray(film[name]) if name in film.passes else None for name in GUIDES]
    color[..., :3] = _denoised(color[..., :3], *guides)
    return film.with_pass("color", color)


def denoised_bytes(width: int, height: int, color: bytes, albedo: bytes | None, normal: bytes | None, light: bytes | None) -> bytes:
    """The same for bytes of native float32 RGB; for the command line."""
    import numpy

    images = [data and numpy.frombuffer(data, numpy.float32).reshape(height, width, 3) for data in (color, albedo, normal, light)]
    return _denoised(*images).tobytes()


def _denoised(
    color: numpy.ndarray, albedo: numpy.ndarray | None, normal: numpy.ndarray | None, light: numpy.ndarray | None
) -> numpy.ndarray:
    import numpy

    pyoidn = require()
    guides: dict[str, Any] = {}
    if albedo is not None:
        guides["albedo"] = _prefiltered(pyoidn, "albedo", albedo)
        # The filter takes normals beside albedo only.
        if normal is not None:
            guides["normal"] = _prefiltered(pyoidn, "normal", normal)
    # Without what mirrors and glass show of lights, the colour has no edges that the guides do not have.
    rest = color if light is None else numpy.maximum(color - light, 0.0)
    denoised = pyoidn.denoise(numpy.ascontiguousarray(rest, numpy.float32), hdr=True, clean_aux=bool(guides), **guides)
    if albedo is not None and normal is not None:
        denoised[~rest.any(axis=-1) & _beside_nothing(albedo, normal)] = 0.0
    return denoised if light is None else denoised + light


def _beside_nothing(albedo: numpy.ndarray, normal: numpy.ndarray, reach: int = 2) -> numpy.ndarray:
    """Where the filter lets light out beside edges to where nothing is: normals, whose samples are others than the colour's, are short or none there,
    and a few pixels further on there is nothing at all. In haze before a wall there is something everywhere, though a pixel's samples may all be dark.
    """
    import numpy

    nothing = ~(albedo.any(axis=-1) | normal.any(axis=-1))
    near = nothing.copy()
    for axis in (0, 1):
        padded = numpy.pad(near, [(reach, reach) if each == axis else (0, 0) for each in (0, 1)])
        near = numpy.lib.stride_tricks.sliding_window_view(padded, 2 * reach + 1, axis=axis).any(axis=-1)
    short: numpy.ndarray = numpy.square(normal).sum(axis=-1) < 0.25
    return near & short


def _prefiltered(pyoidn: Any, name: str, image: numpy.ndarray) -> numpy.ndarray:
    """A guide without its own noise, so that the colour may follow every edge of it."""
    import numpy

    image = numpy.ascontiguousarray(image, numpy.float32)
    result = numpy.empty_like(image)
    with pyoidn.Device() as device:
        device.commit()
        with pyoidn.Filter(device, pyoidn.OIDN_FILTER_TYPE_RT) as guide:
            guide.set_image(name, image, pyoidn.OIDN_FORMAT_FLOAT3)
            guide.set_image(pyoidn.OIDN_IMAGE_OUTPUT, result, pyoidn.OIDN_FORMAT_FLOAT3)
            guide.commit()
            guide.execute()
        if (problem := device.get_error()) is not None:
            raise RuntimeError(f"Open Image Denoise: {problem}")
    return result
