"""What media do to light, in double precision: closed forms, exact series and quadrature; metres, and coefficients one over metres."""

import functools
import math
from typing import Any

import numpy

Array = numpy.ndarray


@functools.cache
def legendre(count: int) -> tuple[Array, Array]:
    """Places and weights of Gauss and Legendre from -1 to 1."""
    return numpy.polynomial.legendre.leggauss(count)


def gauss(low: float, high: float, count: int = 200) -> tuple[Array, Array]:
    """The same of an interval."""
    x, w = legendre(count)
    return low + (high - low) * 0.5 * (x + 1.0), w * 0.5 * (high - low)


def to_infinity(start: float, count: int = 400) -> tuple[Array, Array]:
    """Places beyond `start`, and weights, dense towards it: the trapezoid rule over the logarithm of what lies between."""
    y = numpy.linspace(-40.0, 7.0, count)
    x = numpy.exp(y)
    return start + x, x * (y[1] - y[0])


def diffuse_transmittance(depth: float) -> float:
    """2 E₃(τ): what of even light passes a slab to a plane behind it, 2 ∫ µ exp(−τ/µ) dµ."""
    cosine, weight = gauss(0.0, 1.0, 300)
    return float(2.0 * (weight * cosine * numpy.exp(-depth / cosine)).sum())


def half_space(albedo: Any, cosine: float) -> Any:
    """Radiance of a half-space that scatters evenly, in even light of 1: 1 − √(1 − a) H(µ), with H by its integral
    (Chandrasekhar, Radiative Transfer, 1950): ln H(µ) = −(µ/π) ∫₀^∞ ln(1 − a arctan(t)/t) / (1 + µ² t²) dt. Albedos may be complex."""
    # t = tan φ.
    angle, weight = gauss(0.0, math.pi / 2.0, 300)
    t = numpy.tan(angle)
    grown = numpy.log(1.0 - numpy.asarray(albedo)[..., None] * angle / t) * (1.0 + t * t) / (1.0 + (cosine * t) ** 2)
    return 1.0 - numpy.sqrt(1.0 - numpy.asarray(albedo)) * numpy.exp(-cosine / math.pi * (weight * grown).sum(axis=-1))


def half_space_of_orders(albedo: float, cosine: float, most: int) -> float:
    """The same of light that was scattered so often at most: the terms of the series in the albedo, by Cauchy's integral over a circle."""
    count, radius = 4096, 0.9995
    circle = half_space(radius * numpy.exp(2j * math.pi * numpy.arange(count) / count), cosine)
    terms = numpy.fft.fft(circle).real[: most + 1] / count / radius ** numpy.arange(most + 1)
    return float((terms * albedo ** numpy.arange(most + 1)).sum())


def reflected_once(depth: float, cosine: float) -> float:
    """Radiance of a slab that scatters evenly and once, lit by 1 lx straight on, from the lit side; all that is taken is scattered."""
    way = 1.0 + 1.0 / cosine
    return -math.expm1(-depth * way) / way / (4.0 * math.pi * cosine)


def transmitted_once(depth: float, cosine: float) -> float:
    """The same from the other side: (1/4πµ) ∫₀^τ exp(−t − (τ − t)/µ) dt."""
    t, weight = gauss(0.0, depth)
    return float((weight * numpy.exp(-t - (depth - t) / cosine)).sum()) / (4.0 * math.pi * cosine)


def henyey_greenstein(g: float, cosine: Array) -> Array:
    """Per steradian, by the cosine between the directions before and after."""
    found: Array = (1.0 - g * g) / (4.0 * math.pi * (1.0 + g * g - 2.0 * g * cosine) ** 1.5)
    return found


def airlight(distance: float, scattering: float, extinction: float, half: float, g: float) -> float:
    """What a lamp of 1 cd sends once scattered along a way of 2·half, seen from its end, that passes it at a distance half way:
    ∫ σs p(θ) exp(−σt (s + d)) / d² ds, over the angle from the lamp."""
    angle, weight = gauss(-math.atan(half / distance), math.atan(half / distance), 300)
    along, away = distance * numpy.tan(angle), distance / numpy.cos(angle)
    # Light goes from the lamp to the place, on along the way to its end at −half: against `along`.
    phase = henyey_greenstein(g, -along / away)
    return float((weight * phase * numpy.exp(-extinction * (half + along + away))).sum()) * scattering / distance


def scalar_of_lamp(albedo: float, r: Array) -> Array:
    """ρ² φ(ρ) of φ, the radiance over all directions at a distance of ρ mean free paths from an even lamp of 1 lm in what scatters evenly
    and has no end: the pole and the cut of its Fourier transform (Case and Zweifel, Linear Transport Theory, 1967)."""
    low, high = 0.0, 1.0
    for _ in range(200):
        kappa = 0.5 * (low + high)
        low, high = (kappa, high) if albedo * math.atanh(kappa) < kappa else (low, kappa)
    pole = 2.0 * kappa**2 * (1.0 - kappa**2) / (albedo * (kappa**2 - 1.0 + albedo))
    t, weight = to_infinity(1.0)
    log = 0.5 * numpy.log1p(2.0 / (t - 1.0).clip(1e-300))
    # Without the 1, which is the light that was never scattered.
    cut = weight * (t * t / ((t - albedo * log) ** 2 + (0.5 * math.pi * albedo) ** 2) - 1.0)
    flat = numpy.atleast_1d(r).ravel()
    ways = numpy.concatenate([numpy.exp(-part[:, None] * t) @ cut for part in numpy.array_split(flat, 1 + flat.size // 4000)])
    found: Array = (flat * (pole * numpy.exp(-kappa * flat) + ways) + numpy.exp(-flat)) / (4.0 * math.pi)
    return found.reshape(numpy.shape(r))


def lux_of_lamp(albedo: float, extinction: float, distance: float, towards: bool) -> float:
    """Lux of a plane across the direction to an even lamp of 1 cd in fog without end, facing it or away, of all orders of scattering: what
    the fog scatters towards the plane, (a/4π) φ exp(−s) along each direction, and the lamp itself."""
    r = extinction * distance
    side = 1.0 if towards else -1.0
    parts, weights = gauss(0.0, 1.0, 60)
    total = 0.0
    for part, weight in zip(parts, weights, strict=True):
        # Dense towards the lamp, where ways pass it closely.
        angle = 0.5 * math.pi * part**2
        nearest, before = r * math.sin(angle), side * r * math.cos(angle)
        # s = before + nearest tan t, dense at both ends.
        unit, share = gauss(0.0, 1.0, 150)
        smooth, slope = unit**3 * (10.0 - 15.0 * unit + 6.0 * unit**2), 30.0 * (unit * (1.0 - unit)) ** 2
        start = -math.atan2(before, nearest)
        width = 0.5 * math.pi - start
        t = start + width * smooth
        s = (before + nearest * numpy.tan(t)).clip(0.0)
        source = scalar_of_lamp(albedo, numpy.minimum(nearest / numpy.cos(t), 700.0)) * numpy.exp(-s)
        total += weight * math.pi * part * math.cos(angle) * width * float((share * slope * source).sum())
    scattered = 0.5 * albedo * total / r
    direct = math.exp(-r) / (4.0 * math.pi * r * r) if towards else 0.0
    return 4.0 * math.pi * extinction**2 * (scattered + direct)


def net_lux_of_lamp(albedo: float, extinction: float, distance: float) -> float:
    """Lux towards less lux away: of the lamp's flux what fog within the distance does not take, over the sphere."""
    r, weight = gauss(0.0, extinction * distance)
    taken = (1.0 - albedo) * 4.0 * math.pi * float((weight * scalar_of_lamp(albedo, r)).sum())
    return (1.0 - taken) / distance**2


def left_in_a_box(extinction: float, half: float) -> float:
    """Mean over all directions of exp(−σ d) from the middle of a cube to its faces."""
    u, w = gauss(0.0, 1.0)
    r = numpy.sqrt(1.0 + u[:, None] ** 2 + u[None, :] ** 2)
    # A quarter of each of six faces.
    return float(24.0 * (w[:, None] * w[None, :] * numpy.exp(-extinction * half * r) / r**3).sum()) / (4.0 * math.pi)


def smooth(shape: tuple[int, int, int], seed: int = 1) -> Array:
    """Densities that vary gently, with nothing in a corner, in single precision as a scene has them."""
    x, y, z = numpy.meshgrid(*[numpy.linspace(0.0, 1.0, n) for n in shape], indexing="ij")
    made = 0.5 + 0.5 * numpy.sin(7.0 * x + 3.0 * seed) * numpy.cos(5.0 * y) * numpy.sin(4.0 * z + 1.0)
    made[x + y + z < 0.5] = 0.0
    return made.astype("f4")


def densities(array: Array, places: Array) -> Array:
    """Trilinear values at places (…, 3) in voxels; values stand in the middles of voxels, and the outermost reach to the faces."""
    last = numpy.array(array.shape) - 1
    at = numpy.clip(numpy.asarray(places, float) - 0.5, 0.0, last)
    low = numpy.minimum(at.astype(int), last - 1)
    part = at - low
    total = numpy.zeros(at.shape[:-1])
    for corner in numpy.ndindex(2, 2, 2):
        weight = numpy.prod(numpy.where(numpy.array(corner) == 1, part, 1.0 - part), axis=-1)
        total += weight * array[tuple(numpy.moveaxis(low + corner, -1, 0))]
    return total


def depths(array: Array, start: Array, end: Array, steps: int = 2000) -> Array:
    """Integrals of the density along straight ways (…, 3), by the midpoint rule."""
    start, end = numpy.asarray(start, float), numpy.asarray(end, float)
    part = ((numpy.arange(steps) + 0.5) / steps)[:, None]
    places = start[..., None, :] + (end - start)[..., None, :] * part
    found: Array = densities(array, places).mean(axis=-1) * numpy.linalg.norm(end - start, axis=-1)
    return found


def grid_once(array: Array, scattering: float, extinction: float, x: float, y: float, steps: int = 800) -> float:
    """Radiance towards +z at (x, y) of a grid that scatters evenly and once the light of 1 lx that comes straight down along −y."""
    top, back = float(array.shape[1]), float(array.shape[2])
    z = back * (numpy.arange(steps) + 0.5) / steps
    here = numpy.stack([numpy.full(steps, x), numpy.full(steps, y), z], -1)
    density = densities(array, here)
    step = back / steps
    # What lies before a place, half of its own step with it.
    before = (density[::-1].cumsum()[::-1] - 0.5 * density) * step
    above = depths(array, here, here + [0.0, top - y, 0.0])
    return float((density * numpy.exp(-extinction * (before + above))).sum()) * step * scattering / (4.0 * math.pi)
