"""Measured materials with known answers, written by the tests: a GGX surface with a matt part, in MERL's and in our own format."""

import math

import numpy


def unit(theta, phi):
    """Directions by angles, radians, (N, 3)."""
    theta, phi = numpy.broadcast_arrays(theta, phi)
    return numpy.stack([numpy.sin(theta) * numpy.cos(phi), numpy.sin(theta) * numpy.sin(phi), numpy.cos(theta)], axis=-1)


def random_directions(count, seed, least_cosine=0.05):
    """Directions at the front, uniform in solid angle."""
    rng = numpy.random.default_rng(seed)
    z = rng.uniform(least_cosine, 1.0, count)
    phi = rng.uniform(0.0, 2.0 * numpy.pi, count)
    r = numpy.sqrt(1.0 - z * z)
    return numpy.stack([r * numpy.cos(phi), r * numpy.sin(phi), z], axis=-1)


def ggx(wi, wo, alpha=0.3, colour=(0.9, 0.6, 0.3), diffuse=0.0):
    """The BRDF in 1/sr of single-scattering GGX with height-correlated Smith masking and Schlick's reflectance, and a matt part."""
    half = wi + wo
    half = half / numpy.linalg.norm(half, axis=-1, keepdims=True)
    slope = (half[..., 0] ** 2 + half[..., 1] ** 2) / alpha**2 + half[..., 2] ** 2
    density = 1.0 / (numpy.pi * alpha**2 * slope**2)

    def masked(d):
        return 0.5 * (numpy.sqrt(1.0 + alpha**2 * (1.0 / d[..., 2] ** 2 - 1.0)) - 1.0)

    value = density / (1.0 + masked(wi) + masked(wo)) / (4.0 * wi[..., 2] * wo[..., 2])
    schlick = (1.0 - (wi * half).sum(axis=-1)) ** 5
    f0 = numpy.asarray(colour)
    return value[..., None] * (f0 + (1.0 - f0) * schlick[..., None]) + diffuse / numpy.pi


def isotropic_axes(polar=31, azimuths=60):
    """Axes of an isotropic table, degrees."""
    theta = numpy.linspace(0.0, 89.0, polar)
    return {"theta_i": theta, "theta_o": theta, "delta_phi": numpy.arange(azimuths) * 360.0 / azimuths}


def isotropic_values(axes, brdf):
    """A BRDF at the cells of such axes."""
    i, o, phi = (numpy.radians(axes[name]) for name in ("theta_i", "theta_o", "delta_phi"))
    wi = unit(i[:, None, None], numpy.zeros((1, 1, len(phi))))
    wo = unit(o[None, :, None], phi[None, None, :])
    wi, wo = numpy.broadcast_arrays(wi, wo)
    return brdf(wi, wo)


MERL_SCALE = numpy.array([1.0, 1.15, 1.66]) / 1500.0


def merl_centres(bins):
    """θh, θd and φd at the centres of bins, radians."""
    half, difference, about = (((numpy.arange(n) + 0.5) / n) for n in bins)
    return numpy.pi / 2 * half**2, numpy.pi / 2 * difference, numpy.pi * about


def merl_directions(half, difference, about):
    """The directions of half and difference angles, radians: (wi, wo)."""
    half, difference, about = numpy.broadcast_arrays(half, difference, about)
    h = unit(half, numpy.zeros_like(half))
    tangent = numpy.stack([numpy.cos(half), numpy.zeros_like(half), -numpy.sin(half)], axis=-1)
    across = numpy.cos(about)[..., None] * tangent + numpy.sin(about)[..., None] * numpy.array([0.0, 1.0, 0.0])
    along, aside = numpy.cos(difference)[..., None] * h, numpy.sin(difference)[..., None] * across
    return along + aside, along - aside


def merl_bytes(bins, brdf):
    """A MERL file of a BRDF, and its cells (…, 3) in 1/sr, NaN below the surface."""
    half, difference, about = merl_centres(bins)
    wi, wo = merl_directions(half[:, None, None], difference[None, :, None], about[None, None, :])
    above = (wi[..., 2] > 0.0) & (wo[..., 2] > 0.0)
    cells = numpy.full((*bins, 3), numpy.nan)
    cells[above] = brdf(wi[above], wo[above])
    stored = numpy.where(numpy.isnan(cells), -1.0, cells / MERL_SCALE)
    return numpy.array(bins, "<i4").tobytes() + numpy.moveaxis(stored, -1, 0).astype("<f8").tobytes(), cells


MATT = """gbsdf 1
title a matt surface
table reflection-front isotropic
channels rgb
axis theta_i linear 2
0 90
axis theta_o linear 2
0 90
axis delta_phi nearest 1
0
values text
{values}
end
"""


def matt_text(reflectance):
    """A Lambertian surface of three reflectances, in our own format as text."""
    return MATT.format(values=" ".join(str(share / math.pi) for share in reflectance * 4))
