"""Writers of image files and noise that tiles; numpy and the standard library alone."""

import struct
import zlib
from pathlib import Path

import numpy


def write_png(path: Path, pixels: numpy.ndarray, palette: numpy.ndarray | None = None) -> None:
    """Writes uint8 pixels (H, W, 3), or with a palette (N, 3) indices (H, W)."""
    height, width = pixels.shape[:2]
    colour_type = 2 if palette is None else 3
    rows = pixels.reshape(height, -1)
    if palette is None:
        # Differences to the pixel on the left (filter 1) compress flat and smooth images better.
        left = numpy.concatenate([numpy.zeros((height, 3), numpy.uint8), rows[:, :-3]], axis=1)
        rows = numpy.concatenate([numpy.ones((height, 1), numpy.uint8), rows - left], axis=1)
    else:
        rows = numpy.concatenate([numpy.zeros((height, 1), numpy.uint8), rows], axis=1)
    chunks = [(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour_type, 0, 0, 0))]
    if palette is not None:
        chunks.append((b"PLTE", palette.astype(numpy.uint8).tobytes()))
    chunks += [(b"IDAT", zlib.compress(rows.astype(numpy.uint8).tobytes(), 9)), (b"IEND", b"")]
    with path.open("wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for name, data in chunks:
            file.write(struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data)))


def write_hdr(path: Path, radiance: numpy.ndarray) -> None:
    """Writes a Radiance picture (H, W, 3) with shared exponents, uncompressed."""
    height, width = radiance.shape[:2]
    largest = radiance.max(axis=2)
    mantissa, exponent = numpy.frexp(numpy.maximum(largest, 1e-30))
    scale = numpy.where(largest > 1e-6, mantissa * 256 / numpy.maximum(largest, 1e-30), 0)
    pixels = numpy.zeros((height, width, 4), numpy.uint8)
    pixels[..., :3] = radiance * scale[..., None]
    pixels[..., 3] = numpy.where(largest > 1e-6, exponent + 128, 0)
    header = f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n"
    path.write_bytes(header.encode() + pixels.tobytes())


def noise(random: numpy.random.Generator, shape: tuple[int, int], cells: tuple[int, int]) -> numpy.ndarray:
    """Smooth values from 0 to 1 (H, W) that tile: random ones on a grid of `cells` (down, across), interpolated."""
    grid = random.random(cells)
    rows, columns = (numpy.arange(size) * count / size for size, count in zip(shape, cells))
    i, j = rows.astype(int), columns.astype(int)
    s, t = (rows - i)[:, None], (columns - j)[None]
    s, t = s * s * (3 - 2 * s), t * t * (3 - 2 * t)
    below, right = (i + 1) % cells[0], (j + 1) % cells[1]
    top = grid[i][:, j] * (1 - t) + grid[i][:, right] * t
    bottom = grid[below][:, j] * (1 - t) + grid[below][:, right] * t
    return top * (1 - s) + bottom * s


def octaves(random: numpy.random.Generator, shape: tuple[int, int], cells: tuple[int, int], count: int) -> numpy.ndarray:
    """Noise with finer and fainter noise on it, from 0 to 1."""
    total = sum(noise(random, shape, (cells[0] << n, cells[1] << n)) / 2**n for n in range(count))
    return total / (2 - 2.0 ** (1 - count))


def ramp(stops: list[tuple[float, float, float]], count: int = 64) -> numpy.ndarray:
    """A palette (count, 3) between colours given as sRGB values from 0 to 255."""
    places = numpy.linspace(0, len(stops) - 1, count)
    return numpy.stack([numpy.interp(places, range(len(stops)), channel) for channel in zip(*stops)], axis=1)


def indices(values: numpy.ndarray, count: int = 64) -> numpy.ndarray:
    """Values from 0 to 1 as places in a palette."""
    return numpy.clip(values * (count - 1) + 0.5, 0, count - 1).astype(numpy.uint8)


def normals(height: numpy.ndarray, strength: float) -> numpy.ndarray:
    """The tangent-space normal map (H, W, 3) of a height that tiles; `strength` in pixels of height."""
    slope_u = (numpy.roll(height, -1, 1) - numpy.roll(height, 1, 1)) * strength / 2
    # Rows go down while v goes up.
    slope_v = (numpy.roll(height, 1, 0) - numpy.roll(height, -1, 0)) * strength / 2
    vectors = numpy.stack([-slope_u, -slope_v, numpy.ones_like(height)], axis=2)
    vectors /= numpy.linalg.norm(vectors, axis=2, keepdims=True)
    return numpy.round(vectors * 127.5 + 127.5).astype(numpy.uint8)
