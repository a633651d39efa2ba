"""Where the light of `scenes/prism.py` lands by Snell's law and what arrives by Fresnel's, in double precision: nothing here is from a renderer.

Colours are linear Rec.709 of a white lamp. gonio's light keeps its wavelength on all of its way, and colours are those of the CIE's observer under
D65. LuxCore has a wavelength at each surface of glass, drawn evenly from 380 to 780 nm anew, and a ramp of colours of its own that light is multiplied
by there: what enters as one wavelength leaves as another. Both schemes are reckoned here, each for its renderer.
"""

import functools
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import gonio
import numpy
from description import Dispersing, Scene, Spot, Sun
from scenes import prism

OBSERVER = Path(__file__).resolve().parents[3] / "rust-core" / "formats" / "src" / "bsdf" / "observer.f32"
XYZ = numpy.array([[0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923], [0.0193308, 0.1191948, 0.9505322]])
LUMINANCE = XYZ[1]
# Half the height of the screen's part that is compared, m.
HALF_BAND = 0.02
# Points over the slit's width, and over as much of its height as lights that part.
ACROSS, UPWARDS = 40, 4
# Bins along the screen, m.
EDGES = numpy.linspace(-0.06, 0.1, 1601)


@dataclass(frozen=True)
class Landed:
    """Rays at the screen: place along it and upwards in m, and flux in lm."""

    along: numpy.ndarray
    up: numpy.ndarray
    flux: numpy.ndarray


def landed(scene: Scene, entering_nm: float, leaving_nm: float) -> Landed:
    """Rays evenly over the slit; the glass has one wavelength's index where they enter and another's where they leave."""
    glass = glass_of(scene)
    points, directions, flux = sent(scene.lights[0])
    tilt = numpy.array([-prism.SECTION[2, 1], 0.0, prism.SECTION[1, 0]]) / prism.SIDE
    for corner, normal, eta in ((prism.ENTRY, tilt, 1.0 / index(glass, entering_nm)), (prism.EXIT, tilt * (-1, 1, 1), index(glass, leaving_nm))):
        points = points + directions * (((corner - points) @ normal) / (directions @ normal))[:, None]
        # Normals look against the light where it enters and along it where it leaves.
        towards = -numpy.sign(directions @ normal)[:, None] * normal
        directions, passed = refracted(directions, towards, eta)
        flux = flux * passed
    points = points + directions * (((prism.TARGET - points) @ prism.AWAY) / (directions @ prism.AWAY))[:, None]
    return Landed((points - prism.TARGET) @ prism.ALONG, (points - prism.TARGET) @ prism.UP, flux)


def centroid(scene: Scene, nm: float) -> float:
    """Where light of a wavelength lands on the mean."""
    rays = landed(scene, nm, nm)
    return float(rays.flux @ rays.along / rays.flux.sum())


def glass_of(scene: Scene) -> Dispersing:
    return next(mesh.surface for mesh in scene.meshes if isinstance(mesh.surface, Dispersing))


def index(glass: Dispersing, nm: float) -> float:
    a, b = glass.cauchy()
    return a + b / (nm / 1000.0) ** 2


def sent(light: object) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    """Rays at the slit: points, directions, flux in lm."""
    width, half = prism.HALF_SLIT[0], numpy.radians(0.5 * prism.SUN_ANGLE_DEG)
    height = HALF_BAND / spread(light)
    across, up = numpy.meshgrid(middles(width, ACROSS), middles(height, UPWARDS), indexing="ij")
    points = prism.MIDDLE + across.reshape(-1, 1) * prism.ACROSS + up.reshape(-1, 1) * prism.UP
    part = 4.0 * width * height / len(points)
    match light:
        case Spot(matrix, _, _, intensity):
            away = points - matrix[:3, 3]
            distance = numpy.linalg.norm(away, axis=1)
            directions = away / distance[:, None]
            return points, directions, intensity[0] * part * (directions @ prism.TOWARDS) / distance**2
        case Sun(_, _, radiance):
            # A ring in which the disk's mean square in one direction is: of the blur only the width counts.
            turns = 2.399963 * numpy.arange(len(points))
            ring = numpy.sqrt(0.5) * half * numpy.stack([numpy.cos(turns), numpy.sin(turns)], axis=1)
            directions = prism.TOWARDS + ring @ numpy.stack([prism.ACROSS, prism.UP])
            flux = radiance[0] * numpy.pi * numpy.sin(half) ** 2 * part
            return points, directions / numpy.linalg.norm(directions, axis=1)[:, None], numpy.full(len(points), flux)
    raise NotImplementedError(light)


def spread(light: object) -> float:
    """How much higher the light of a slit is at the screen: glass of the thickness between entry and exit is seen as thin as its index has it."""
    if isinstance(light, Sun):
        return 1.0
    glass = float(numpy.linalg.norm(prism.EXIT - prism.ENTRY)) / prism.INDEX
    return 1.0 + (prism.SLIT + glass + prism.SCREEN) / prism.SPOT_DISTANCE


def middles(half: float, count: int) -> numpy.ndarray:
    """Of equal parts from -half to half."""
    made: numpy.ndarray = (numpy.arange(count) + 0.5) * (2.0 * half / count) - half
    return made


def refracted(directions: numpy.ndarray, normal: numpy.ndarray, eta: float) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Directions behind a surface by Snell's law, and the share that passes by Fresnel's; `eta` is the index before it over that behind it."""
    cosine = -(directions * normal).sum(axis=1)
    behind = numpy.sqrt(1.0 - eta**2 * (1.0 - cosine**2))
    across, along = ((eta * a - b) / (eta * a + b) for a, b in ((cosine, behind), (behind, cosine)))
    made = eta * directions + (eta * cosine - behind)[:, None] * normal
    return made, 1.0 - 0.5 * (across**2 + along**2)


@functools.cache
def daylight() -> tuple[numpy.ndarray, numpy.ndarray]:
    """Wavelengths from 380 to 780 nm, and what each has of white D65 of luminance 1, in linear Rec.709; colours outside have values below zero."""
    nm = numpy.arange(380.0, 781.0)
    table = gonio.illuminant("D65")
    power = numpy.interp(nm, table["wavelengths_nm"], table["power"])
    xyz = numpy.fromfile(OBSERVER, "<f4").reshape(-1, 3)[20:421] * power[:, None]
    rgb = xyz / xyz[:, 1].sum() @ numpy.linalg.inv(XYZ).T
    # The table's white is (1, 1, 1), though the space's own is rounded.
    return nm, rgb / rgb.sum(axis=0)


@functools.cache
def ramp() -> tuple[numpy.ndarray, numpy.ndarray]:
    """Wavelengths in the middles of 80 steps, and LuxCore's colours, which sum to (1, 1, 1) but for its rounding."""
    nm = numpy.arange(382.5, 780.0, 5.0)
    corners = [380.0, 440.0, 490.0, 510.0, 580.0, 645.0, 780.0]
    values = [(1, 0, 1), (0, 0, 1), (0, 1, 1), (0, 1, 0), (1, 1, 0), (1, 0, 0), (1, 0, 0)]
    rgb = numpy.stack([numpy.interp(nm, corners, column) for column in numpy.transpose(values)], axis=1)
    rgb *= numpy.interp(nm, [380.0, 420.0, 700.0, 780.0], [0.3, 1.0, 1.0, 0.3])[:, None]
    return nm, rgb / (0.5652729, 0.36875, 0.265375) / len(nm)


def keeping(scene: Scene) -> numpy.ndarray:
    """Flux of red, green and blue in each bin along the compared part of the screen, by gonio's scheme."""
    bins = numpy.zeros((len(EDGES) - 1, 3))
    for nm, colour in zip(*daylight(), strict=True):
        bins += binned(landed(scene, nm, nm))[:, None] * colour
    return bins


def anew(scene: Scene) -> numpy.ndarray:
    """The same by LuxCore's scheme."""
    bins, (wavelengths, colours) = numpy.zeros((len(EDGES) - 1, 3)), ramp()
    for entering, first in zip(wavelengths, colours, strict=True):
        for leaving, second in zip(wavelengths, colours, strict=True):
            colour = first * second
            if colour.any():
                bins += binned(landed(scene, entering, leaving))[:, None] * colour
    return bins


SCHEMES: dict[str, Callable[[Scene], numpy.ndarray]] = {"gonio": keeping, "luxcore": anew}


def binned(rays: Landed) -> numpy.ndarray:
    """Flux in each bin."""
    found, _ = numpy.histogram(rays.along, EDGES, weights=rays.flux)
    return found


def radiance(bins: numpy.ndarray) -> numpy.ndarray:
    """What the screen shows of flux in bins, cd/m²."""
    shown: numpy.ndarray = bins * prism.REFLECTANCE / numpy.pi / (numpy.diff(EDGES)[:, None] * 2.0 * HALF_BAND)
    return shown
