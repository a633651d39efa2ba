"""A ring of fifteen colours under five lamps, D65, LED-B3, LED-RGB1, FL11 and HP1, rendered once by wavelength and relit: `python colour_ring.py colour_ring.png`.

Above as a camera that is set to daylight sees them, below adapted to each lamp, as an eye that has been there for a while. The script prints how far the colours are
from those by day.
"""

import math
import struct
import sys
import zlib
from pathlib import Path

import gonio
import numpy
from numpy.typing import NDArray
from shapes import lathe, quad

LAMPS = ("D65", "LED-B3", "LED-RGB1", "FL11", "HP1")
COLOURS, SIDE, RADIUS, RING = 15, 160, 0.055, 0.36
XYZ = numpy.array([[0.4123908, 0.3575843, 0.1804808], [0.2126390, 0.7151687, 0.0721923], [0.0193308, 0.1191948, 0.9505322]])
# Bradford's receptors, in which eyes adapt.
CONES = numpy.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])
WHITE = XYZ.sum(axis=1)

Numbers = NDArray[numpy.float64]


def of_hue(degrees: float) -> tuple[float, float, float]:
    """Linear Rec.709 of a colour of CIE Lab of lightness 60, chroma 38 and this hue."""
    a, b = 38 * math.cos(math.radians(degrees)), 38 * math.sin(math.radians(degrees))
    y = (60 + 16) / 116
    xyz = WHITE * numpy.array([y + a / 500, y, y - b / 200]) ** 3
    red, green, blue = numpy.linalg.solve(XYZ, xyz)
    return float(red), float(green), float(blue)


def build() -> gonio.Scene:
    """Matt balls around a grey one, on a grey table below a large lamp and a dim sky of the same light."""
    scene = gonio.Scene()
    quad(scene, [(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)], scene.add_material("table", base_color=0.3, specular_weight=0.0))
    ball = lathe(scene, [(RADIUS * math.sin(angle), RADIUS - RADIUS * math.cos(angle)) for angle in numpy.linspace(0.0, math.pi, 65)])
    places = [(RING * math.sin(turn), -RING * math.cos(turn)) for turn in numpy.arange(COLOURS) * 2 * math.pi / COLOURS]
    colours = [of_hue(number * 360 / COLOURS) for number in range(COLOURS)]
    for (x, z), colour in zip([*places, (0.0, 0.0)], [*colours, (0.3,) * 3], strict=True):
        material = scene.add_material(base_color=colour, specular_weight=0.0)
        scene.add_instance(ball, [material], transform=[[1, 0, 0, x], [0, 1, 0, 0], [0, 0, 1, z], [0, 0, 0, 1]])
    above = gonio.look_at((-0.9, 1.6, 0.5), (0.0, 0.0, 0.0))
    scene.add_light("rectangle", (2000.0,) * 3, width=0.6, height=0.6, transform=above, spectrum="D65", group="Lamp")
    scene.add_light("dome", (60.0,) * 3, spectrum="D65", group="Lamp")
    scene.add_camera(gonio.look_at((0.0, 2.0, 0.55), (0.0, 0.0, 0.0)), fov=26.0)
    scene.set(width=SIDE, height=SIDE, samples=64, spectral=True, passes=["color", "lightgroup:Lamp"], caustics="off")
    return scene


def adapted(linear: Numbers, lamp: str) -> Numbers:
    """Colours as they are by day to an eye that takes the lamp for white."""
    table = gonio.illuminant(lamp)
    figures = gonio.spectrum_figures(table["wavelengths_nm"], table["power"])
    x, y = figures["x"], figures["y"]
    white = CONES @ numpy.array([x / y, 1.0, (1 - x - y) / y])
    to_day = numpy.linalg.solve(CONES, ((CONES @ WHITE) / white)[:, None] * CONES)
    shown: Numbers = linear @ (numpy.linalg.solve(XYZ, to_day @ XYZ)).T
    return shown


def lab(linear: Numbers) -> Numbers:
    """CIE Lab beside D65 of luminance 1."""
    share = linear @ XYZ.T / WHITE
    root = numpy.where(share > 216 / 24389, numpy.cbrt(share), (24389 / 27 * share + 16) / 116)
    return numpy.stack([116 * root[..., 1] - 16, 500 * (root[..., 0] - root[..., 1]), 200 * (root[..., 1] - root[..., 2])], axis=-1)


def write_png(path: Path, linear: Numbers) -> None:
    """Eight bits of sRGB."""
    inside = numpy.clip(linear, 0.0, 1.0)
    encoded = numpy.where(inside <= 0.0031308, 12.92 * inside, 1.055 * inside ** (1 / 2.4) - 0.055)
    rows = (encoded * 255 + 0.5).astype("u1")
    height, width, _ = rows.shape
    # Each pixel is told as its difference from the one to its left.
    packed = b"".join(b"\1" + row.tobytes() for row in numpy.diff(rows, axis=1, prepend=numpy.zeros_like(rows[:, :1])))
    parts = ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)), (b"IDAT", zlib.compress(packed, 9)), (b"IEND", b""))
    chunks = [struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)) for kind, data in parts]
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + b"".join(chunks))


def main() -> None:
    """Writes the picture."""
    picture = gonio.spectral_picture(build(), band=10.0)
    as_camera, as_eye = [], []
    for lamp in LAMPS:
        linear = numpy.asarray(picture.relit([("Lamp", 1.0, gonio.illuminant(lamp))]).color, "f8")[..., :3]
        # Of a luminance at which the grey table is a middle grey.
        linear = linear * (0.22 / numpy.median(linear @ XYZ[1]))
        as_camera.append(linear)
        as_eye.append(adapted(linear, lamp))
        apart = numpy.linalg.norm(lab(as_eye[-1]) - lab(as_eye[0]), axis=-1)
        print(f"{lamp}: adapted, 95 of 100 pixels are within {numpy.quantile(apart, 0.95):.1f} of their colour by day in CIE Lab, all within {apart.max():.1f}")
    shown = numpy.concatenate([numpy.concatenate(row, axis=1) for row in (as_camera, as_eye)])
    write_png(Path(sys.argv[1] if len(sys.argv) > 1 else "colour_ring.png"), shown)


if __name__ == "__main__":
    main()
