"""A plane sheet of clear glass by Fresnel and Beer, the polarisations apart: between parallel interfaces they never mix."""

import math

import numpy

INDEX = 1.52


def transmittance(cosine: numpy.ndarray, index: float = INDEX, inner: float = 1.0) -> numpy.ndarray:
    """Of unpolarised light at a cosine of incidence; `inner` is what a straight way through the glass leaves.

    T = ½ Σ (1 − r)² τ / (1 − r² τ²) over both polarisations, r being the reflectance of one interface.
    """
    cosine = numpy.asarray(cosine, float)
    inside = numpy.sqrt(1.0 - (1.0 - cosine**2) / index**2)
    passed = inner ** (1.0 / inside)
    across = ((cosine - index * inside) / (cosine + index * inside)) ** 2
    along = ((index * cosine - inside) / (index * cosine + inside)) ** 2
    total = sum((1 - r) ** 2 * passed / (1 - (r * passed) ** 2) for r in (across, along))
    result: numpy.ndarray = 0.5 * total
    return result


def diffuse_transmittance(index: float = INDEX, inner: float = 1.0) -> float:
    """Of evenly bright light from a half space: 2 ∫ T cos θ sin θ dθ."""
    x, w = numpy.polynomial.legendre.leggauss(400)
    theta = (x + 1) * math.pi / 4
    return float((w * transmittance(numpy.cos(theta), index, inner) * numpy.sin(2 * theta)).sum() * math.pi / 4)


def sheet(room, tint: float = 1.0) -> int:
    """Material of a pane without thickness: both interfaces and what is between."""
    number = room.scene.add_material("pane")
    description = room.scene.to_dict()["materials"][number]
    closure = description["closures"][0]
    closure["thin_walled"] = True
    values = {"transmission_weight": 1.0, "specular_ior": INDEX, "specular_roughness": 0.0}
    closure["parameters"] = [[name, {"Constant": [value, 1.0, 1.0, 1.0]}] for name, value in values.items()]
    closure["parameters"].append(["transmission_color", {"Constant": [tint, tint, tint, 1.0]}])
    room.scene.put_material(description, number)
    return number
