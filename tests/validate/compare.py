"""Block differences of two renderings, and the pictures and the table that show them."""

import struct
import zlib
from dataclasses import dataclass
from pathlib import Path

import numpy

BLOCK = 16
# A part of the image's mean that keeps dark blocks from dividing by next to nothing.
FLOOR = 0.01
DIFFERENCE_GAIN = 20.0


@dataclass(frozen=True)
class Measured:
    """A rendering as the mean of two with different seeds, and what it cost."""

    image: numpy.ndarray
    noise: float
    samples: int
    seconds: float


@dataclass(frozen=True)
class Difference:
    """Differences of gonio from a reference, relative: over blocks and channels, and of the whole image's mean."""

    median: float
    percentile95: float
    largest: float
    mean: float


def measured(first: numpy.ndarray, second: numpy.ndarray, samples: int, seconds: float) -> Measured:
    """The mean of two independent renderings of `samples` each; its noise is the relative standard error of blocks, as RMS over them."""
    a, b = blocks(first), blocks(second)
    mean = 0.5 * (a + b)
    # The difference of two has twice the standard deviation of their mean.
    error = 0.5 * numpy.abs(a - b) / scale(mean)
    return Measured(0.5 * (first + second), float(numpy.sqrt((error**2).mean())), 2 * samples, seconds)


def difference(image: numpy.ndarray, reference: numpy.ndarray) -> Difference:
    """How far an image is from a reference."""
    a, b = blocks(image), blocks(reference)
    relative = numpy.abs(a - b) / scale(b)
    median, high = numpy.percentile(relative, [50, 95])
    return Difference(float(median), float(high), float(relative.max()), float(abs(a.mean() / b.mean() - 1.0)))


def scale(reference: numpy.ndarray) -> numpy.ndarray:
    """What differences from blocks are divided by; light may be negative."""
    whole: numpy.ndarray = numpy.abs(reference) + FLOOR * numpy.abs(reference).mean()
    return whole


def blocks(image: numpy.ndarray, side: int = BLOCK) -> numpy.ndarray:
    """Means over squares of pixels, per channel."""
    height, width, channels = image.shape
    means: numpy.ndarray = image.reshape(height // side, side, width // side, side, channels).mean(axis=(1, 3))
    return means


def write_strip(path: Path, image: numpy.ndarray, reference: numpy.ndarray) -> None:
    """A PNG: the image, the reference, and the relative difference of their blocks, amplified about middle grey (white is +5 %)."""
    exposure = 0.25 / reference.mean()
    relative = (blocks(image) - blocks(reference)) / scale(blocks(reference))
    squares = (0.5 + 0.5 * DIFFERENCE_GAIN * relative).repeat(BLOCK, axis=0).repeat(BLOCK, axis=1)
    shown = [encoded(image * exposure), encoded(reference * exposure), squares]
    write_png(path, (numpy.clip(numpy.concatenate(shown, axis=1), 0.0, 1.0) * 255 + 0.5).astype("u1"))


def write_png(path: Path, pixels: numpy.ndarray) -> None:
    """Bytes (height, width, 3) as a PNG."""
    rows = numpy.concatenate([numpy.zeros((len(pixels), 1), "u1"), pixels.reshape(len(pixels), -1)], axis=1)
    header = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], 8, 2, 0, 0, 0)
    chunks = [(b"IHDR", header), (b"IDAT", zlib.compress(rows.tobytes())), (b"IEND", b"")]
    sealed = [struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in chunks]
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(sealed))


def encoded(linear: numpy.ndarray) -> numpy.ndarray:
    """The sRGB curve, nearly."""
    shown: numpy.ndarray = numpy.clip(linear, 0.0, 1.0) ** (1.0 / 2.2)
    return shown


def row(variant: str, other: str, ours: Measured, theirs: Measured, d: Difference, picture: str) -> str:
    """A line of the table."""
    cells = [variant, other, f"{d.median:.2%}", f"{d.percentile95:.2%}", f"{d.largest:.2%}", f"{d.mean:.3%}"]
    cells += [f"{m.noise:.2%}" for m in (ours, theirs)]
    cells += [f"{m.samples} in {m.seconds:.0f} s" for m in (ours, theirs)]
    return "| " + " | ".join([*cells, f"[picture]({picture})"]) + " |"


def table(rows: list[str]) -> str:
    """The table as Markdown."""
    heads = ["variant", "reference", "median", "95th percentile", "largest", "image mean", "noise of gonio", "noise of the reference"]
    heads += ["samples of gonio", "samples of the reference", "gonio, reference, difference (grey is none, white +5 %)"]
    return "\n".join(["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads), *rows])
