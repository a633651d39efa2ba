"""A measured material from a table: written, read, evaluated, sampled, fitted: `python measured_lobes.py measured_lobes.png brushed.gbsdf`.

The picture shows hemispheres of light for three views: the BSDF as brightness (logarithmic), and the samples that it is rendered with.
"""

import sys
from pathlib import Path

import gonio
import numpy
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[numpy.float64]
SIZE = 220
VIEWS = (0.0, 40.0, 70.0)
DECADES = 3.0


def direction(theta_deg: ArrayLike, phi_deg: ArrayLike) -> Floats:
    """Unit vectors by angles, z along the normal."""
    theta, phi = numpy.radians(numpy.asarray(theta_deg, "f8")), numpy.radians(numpy.asarray(phi_deg, "f8"))
    vectors: Floats = numpy.stack(
        numpy.broadcast_arrays(numpy.sin(theta) * numpy.cos(phi), numpy.sin(theta) * numpy.sin(phi), numpy.cos(theta)), axis=-1
    )
    return vectors


def brushed(wi: Floats, wo: Floats) -> Floats:
    """A brushed metal, Ward's model (1992) with the widths 0.18 and 0.45: what a gonioreflectometer would have given, 1/sr."""
    half = wi + wo
    half = half / numpy.linalg.norm(half, axis=-1, keepdims=True)
    slope = (half[..., 0] / 0.18) ** 2 + (half[..., 1] / 0.45) ** 2
    cosines = numpy.maximum(wi[..., 2] * wo[..., 2], 1e-3)
    lobe = numpy.exp(-slope / half[..., 2] ** 2) / (4.0 * numpy.pi * 0.18 * 0.45 * numpy.sqrt(cosines))
    values: Floats = 0.6 * lobe + 0.05 / numpy.pi
    return values


def measured(path: Path) -> gonio.MeasuredBsdf:
    """The metal as a table over both directions, written to a file and read again."""
    theta, phi = numpy.linspace(0.0, 88.0, 23), numpy.arange(0.0, 360.0, 5.0)
    wi, wo = direction(theta[:, None], phi[None, :]), direction(theta[:, None], phi[None, :])
    values = brushed(wi[:, :, None, None], wo[None, None])
    axes = {"theta_i": theta.tolist(), "phi_i": phi.tolist(), "theta_o": theta.tolist(), "phi_o": phi.tolist()}
    table = gonio.MeasuredBsdf.from_table(axes, values.astype("f4"), periods={"phi_i": 360.0, "phi_o": 360.0})
    table.write(path, title="a brushed metal")
    print(f"{path}: {path.stat().st_size / 1e6:.1f} MB")
    return gonio.MeasuredBsdf.from_file(path)


def disk() -> tuple[Floats, NDArray[numpy.bool_]]:
    """Directions of the pixels of a hemisphere seen from above, and which pixels are in it."""
    x, y = numpy.meshgrid(*[(numpy.arange(SIZE) + 0.5) / SIZE * 2.2 - 1.1] * 2)
    radius = numpy.hypot(x, y)
    inside = radius < 0.99
    z = numpy.sqrt(1.0 - numpy.where(inside, radius, 0.0) ** 2)
    return numpy.stack([numpy.where(inside, x, 0.0), numpy.where(inside, -y, 0.0), z], axis=-1), inside


def panel(bsdf: gonio.MeasuredBsdf, view: float) -> Floats:
    """One hemisphere of light: the BSDF on the left, samples on the right, 0 to 1."""
    wi, inside = disk()
    wo = direction(view, 180.0)[None]
    values = numpy.asarray(bsdf.eval(wi.reshape(-1, 3), wo)).reshape(SIZE, SIZE) / wi[..., 2]
    bright = numpy.clip(1.0 + (numpy.log10(numpy.maximum(values, 1e-9)) - 1.0) / DECADES, 0.0, 1.0)
    drawn, density = bsdf.sample(wo, numpy.random.default_rng(1).random((6000, 3)))
    samples: Floats = numpy.asarray(drawn)[numpy.asarray(density) > 0.0]
    spots = numpy.zeros((SIZE, SIZE))
    column, row = (((samples[:, 0] + 1.1) / 2.2 * SIZE).astype(int), ((1.1 - samples[:, 1]) / 2.2 * SIZE).astype(int))
    numpy.add.at(spots, (row, column), 0.35)
    return numpy.concatenate([numpy.where(inside, bright, 1.0), numpy.where(inside, numpy.minimum(spots, 1.0), 1.0)], axis=1)


def main() -> None:
    """Prints albedos and the fit, and writes the picture."""
    picture_path, table_path = sys.argv[1:3] if len(sys.argv) > 2 else ("measured_lobes.png", "brushed.gbsdf")
    bsdf = measured(Path(table_path))
    rng = numpy.random.default_rng(2)
    for view in VIEWS:
        # Sampled as a renderer would: the mean of value over density is the albedo.
        wi, found = bsdf.sample(direction(view, 180.0)[None], rng.random((20_000, 3)))
        values, density = numpy.asarray(bsdf.eval(wi, direction(view, 180.0)[None])), numpy.asarray(found)
        print(f"albedo at {view:.0f}°: {(values[:, 0] / density).mean():.3f}")
    print("nearest OpenPBR surface:", {name: numpy.round(value, 3).tolist() for name, value in bsdf.fit().items()})
    picture = numpy.concatenate([panel(bsdf, view) for view in VIEWS], axis=0)
    write_png(Path(picture_path), picture)


def write_png(path: Path, grey: Floats) -> None:
    """An 8-bit grey PNG."""
    import struct
    import zlib

    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    rows = numpy.round(grey * 255.0).astype("u1")
    height, width = rows.shape
    lines = b"".join(b"\0" + row.tobytes() for row in rows)
    header = struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines, 9)) + chunk(b"IEND", b""))


if __name__ == "__main__":
    main()
