"""A measured material from a table: written, read, evaluated, sampled, fitted: `python measured_lobes.py measured_lobes.png brushed.gbsdf`.

The picture shows hemispheres of light for light from 0°, 40° and 70°: the metal above, its copy below, and below that how densely samples fall.
"""

import sys
from pathlib import Path

import gonio
import numpy
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[numpy.float64]
# Pixels across a hemisphere's square, and half of that square's side; the hemisphere's radius is 1.
SIZE, EDGE = 260, 1.06
SAMPLES = 2_000_000
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
    x, y = numpy.meshgrid(*[(numpy.arange(SIZE) + 0.5) / SIZE * 2.0 * EDGE - EDGE] * 2)
    radius = numpy.hypot(x, y)
    inside = radius < 0.99
    z = numpy.sqrt(1.0 - numpy.where(inside, radius, 0.0) ** 2)
    return numpy.stack([numpy.where(inside, x, 0.0), numpy.where(inside, -y, 0.0), z], axis=-1), inside


def density(bsdf: gonio.MeasuredBsdf, view: float, cosines: Floats) -> Floats:
    """How densely samples fall, 1/sr, counted in pixels."""
    # Points that fill the cube evenly: multiples of the powers of a root of x⁴ = x + 1, without their whole parts.
    even = numpy.arange(SAMPLES)[:, None] * 1.2207440846057596 ** -numpy.arange(1.0, 4.0) % 1.0
    jitter = numpy.random.default_rng(1).random((SAMPLES, 3)) / SAMPLES ** (1 / 3)
    wi, found = bsdf.sample(direction(view, 180.0)[None], (even + jitter) % 1.0)
    kept: Floats = numpy.asarray(wi)[numpy.asarray(found) > 0.0]
    edges = numpy.linspace(-EDGE, EDGE, SIZE + 1)
    counts = numpy.histogram2d(-kept[:, 1], kept[:, 0], bins=(edges, edges))[0]
    # A pixel covers so much of the sphere, by how it is turned away.
    densities: Floats = counts / SAMPLES / (2.0 * EDGE / SIZE) ** 2 * cosines
    return densities


def panels(bsdf: gonio.MeasuredBsdf, view: float) -> Floats:
    """Three hemispheres of light from one direction, one above the other: the metal, its copy in the file (both times the cosine), and the samples; 1/sr."""
    wi, inside = disk()
    wo = direction(view, 180.0)[None]
    metal = brushed(wi, wo[None]) * wi[..., 2]
    copy = numpy.asarray(bsdf.eval(wi.reshape(-1, 3), wo)).reshape(SIZE, SIZE)
    shown = (metal, copy, density(bsdf, view, wi[..., 2]))
    return numpy.concatenate([numpy.where(inside, values, numpy.nan) for values in shown], axis=0)


def main() -> None:
    """Prints albedos and the fit, and writes the picture."""
    picture_path, table_path = sys.argv[1:3] if len(sys.argv) > 2 else ("measured_lobes.png", "brushed.gbsdf")
    bsdf = measured(Path(table_path))
    rng = numpy.random.default_rng(2)
    for view in VIEWS:
        # Sampled as a renderer would: the mean of value over density is the albedo.
        wi, found = bsdf.sample(direction(view, 180.0)[None], rng.random((20_000, 3)))
        values, densities = numpy.asarray(bsdf.eval(wi, direction(view, 180.0)[None])), numpy.asarray(found)
        print(f"albedo at {view:.0f}°: {(values[:, 0] / densities).mean():.3f}")
    print("nearest OpenPBR surface:", {name: numpy.round(value, 3).tolist() for name, value in bsdf.fit().items()})
    picture = numpy.concatenate([panels(bsdf, view) for view in VIEWS], axis=1)
    gonio.false_colour(picture.astype("f4"), max=3.0, steps=15, log=DECADES, unit="1/sr").write(picture_path)


if __name__ == "__main__":
    main()
